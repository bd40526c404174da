//! Proven bounds of periodic steady states: against closed forms, dense matrix exponentials, and
//! cycles of Runge-Kutta's method that are brought to repeat themselves.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use std::fmt::Write as _;

use crate::certificate::{AIR, Written, check, count, solved, spread};
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{CycleMethod, Periodic, PeriodicError, Transient, Uncertified};

/// Rows of a cycle.
const ROWS: usize = 20;

fn certified(network: &Network, tolerance: f64, period: f64) -> Periodic {
    found(network, tolerance, period).unwrap()
}

fn found(network: &Network, tolerance: f64, period: f64) -> Result<Periodic, PeriodicError> {
    let system = ThermalSystem::assemble(network).unwrap();
    let settings = Transient::until(Time(period)).every(Time(period / ROWS as f64));
    let settings = Transient { certify: true, ..settings.tolerance(tolerance) };
    Periodic::find(&system, &settings)
}

fn parsed(text: &str) -> Network {
    lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}")).network
}

/// A signal that is 1 for a part of every period in s, and else `low`.
fn duty(on: f64, period: f64, low: f64) -> String {
    format!(
        "format = 1\n[signal]\nduty = {{ t = [\"0 s\", \"{on} s\"], v = [1, {low}], \
         interp = \"previous\", after_end = \"repeat\", period = \"{period} s\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n"
    )
}

/// 1000 J/K and 0.5 W/K with 100 W for 300 s of every 1000 s: in closed form
/// `T = air + 200 K (1 - exp(-t/tau)) + x exp(-t/tau)` while the heat is on.
#[test]
fn a_square_wave_on_one_node_is_within_its_bounds() {
    let text = duty(300.0, 1000.0, 0.0)
        + "[node]\nbody = { C = \"1000 J/K\", T0 = \"20 degC\" }\n\
           [resistor]\nskin = { from = \"body\", to = \"air\", G = \"0.5 W/K\" }\n\
           [source]\nheat = { into = \"body\", P = \"100 [W] * duty\" }\n";
    let tau = 2000.0_f64;
    let start =
        200.0 * (1.0 - (-300.0 / tau).exp()) * (-700.0 / tau).exp() / (1.0 - (-1000.0 / tau).exp());
    let on = |t: f64| 200.0 + (start - 200.0) * (-t / tau).exp();
    let rise = |t: f64| if t <= 300.0 { on(t) } else { on(300.0) * (-(t - 300.0) / tau).exp() };
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let found = certified(&parsed(&text), tolerance, 1000.0);
        assert_eq!(found.method, CycleMethod::Modes);
        let times = found.solution.times().to_vec();
        let mut ratios = Vec::new();
        check(&found.solution, &|row, _| AIR + rise(times[row]), &|_| 1e-11, &mut ratios);
        let node = found.solution.network().node("body").unwrap();
        let most = found.solution.largest_bound(node).unwrap();
        assert!(most < tolerance, "{most}");
    }
}

/// `exp(a h) - 1` by its series after halvings; without the 1, slow parts keep their digits.
fn exponential(a: &[Vec<f64>], h: f64) -> Vec<Vec<f64>> {
    let size = a.iter().map(|row| row.iter().map(|x| (x * h).abs()).sum::<f64>());
    let halvings = size.fold(0.0, f64::max).max(1e-9).log2().ceil().max(0.0) as i32 + 3;
    let scale = h / 2f64.powi(halvings);
    let scaled = |row: &Vec<f64>| row.iter().map(|x| x * scale).collect();
    let a: Vec<Vec<f64>> = a.iter().map(scaled).collect();
    let (mut sum, mut term) = (a.clone(), a.clone());
    for k in 2..16 {
        term = product(&term, &a);
        term.iter_mut().flatten().for_each(|x| *x /= f64::from(k));
        sum.iter_mut().flatten().zip(term.iter().flatten()).for_each(|(sum, x)| *sum += x);
    }
    (0..halvings).for_each(|_| sum = then(&sum, &sum));
    sum
}

fn product(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = b[0].len();
    let of =
        |row: &Vec<f64>| (0..n).map(|j| row.iter().zip(b).map(|(x, b)| x * b[j]).sum()).collect();
    a.iter().map(of).collect()
}

/// `(1 + b) (1 + a) - 1`
fn then(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut all = product(b, a);
    let parts = a.iter().flatten().zip(b.iter().flatten());
    all.iter_mut().flatten().zip(parts).for_each(|(all, (a, b))| *all += a + b);
    all
}

/// Numbers between two others, one after the other.
fn numbers(seed: u64) -> impl FnMut(f64, f64) -> f64 {
    // the generator of Knuth's MMIX (The Art of Computer Programming 2, 3.3.4)
    let mut state = seed.wrapping_mul(977).wrapping_add(29);
    move |from, to| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random linear network with one heat that is on for 6 of 20 rows, as a text, and the rise of
/// each node over air in each row of its periodic steady state.
fn linear(seed: u64, period: f64) -> (String, Vec<Vec<f64>>) {
    let mut next = numbers(seed);
    let nodes = 1 + next(0.0, 5.0) as usize;
    let mut text = duty(0.3 * period, period, 0.0);
    let mut a = vec![vec![0.0; nodes + 1]; nodes + 1];
    let capacities: Vec<f64> = (0..nodes).map(|_| 10f64.powf(next(0.0, 3.0))).collect();
    text += "[node]\n";
    for (i, c) in capacities.iter().enumerate() {
        writeln!(text, "n{i} = {{ C = \"{c} J/K\", T0 = \"20 degC\" }}").unwrap();
    }
    text += "[resistor]\n";
    for i in 0..nodes {
        let (g, j) = (10f64.powf(next(-1.0, 1.0)), next(0.0, i as f64) as usize);
        a[i][i] -= g / capacities[i];
        let mut to = "air".to_owned();
        if i > 0 {
            a[i][j] += g / capacities[i];
            a[j][i] += g / capacities[j];
            a[j][j] -= g / capacities[j];
            to = format!("n{j}");
        }
        writeln!(text, "p{i} = {{ from = \"n{i}\", to = \"{to}\", G = \"{g} W/K\" }}").unwrap();
    }
    writeln!(text, "[source]\nheat = {{ into = \"n0\", P = \"50 [W] * duty\" }}").unwrap();
    let rise = repeated(a, 50.0 / capacities[0], period / ROWS as f64);
    (text, rise)
}

/// The rows of the periodic steady state of `x' = a x + (b, 0, ..)`, with `b` on for 6 rows.
fn repeated(mut a: Vec<Vec<f64>>, b: f64, h: f64) -> Vec<Vec<f64>> {
    let n = a.len() - 1;
    let off = exponential(&a, h);
    a[0][n] = b;
    let on = exponential(&a, h);
    let step = |row: usize| if row < 6 { &on } else { &off };
    let cycle = (1..ROWS).fold(on.clone(), |all, row| then(&all, step(row)));
    let rest = cycle[..n].iter().map(|row| row[..n].iter().map(|x| -x).collect()).collect();
    let start = solved(rest, cycle[..n].iter().map(|row| row[n]).collect());
    let mut rows = vec![start];
    for row in 0..ROWS {
        let last: Vec<Vec<f64>> = rows[row].iter().chain([&1.0]).map(|x| vec![*x]).collect();
        let next = product(step(row), &last);
        rows.push(next[..n].iter().zip(&rows[row]).map(|(change, x)| x + change[0]).collect());
    }
    rows
}

#[test]
fn linear_networks_stay_within_their_bounds() {
    for tolerance in [1e-3, 1e-6] {
        let mut ratios = Vec::new();
        for seed in 0..count(12) {
            let period = [20.0, 200.0, 2000.0][seed as usize % 3];
            let (text, rise) = linear(seed, period);
            let found = certified(&parsed(&text), tolerance, period);
            check(&found.solution, &|row, node| AIR + rise[row][node], &|_| 2e-11, &mut ratios);
        }
        let (median, most) = spread(&mut ratios);
        println!("{tolerance:e} K, linear cycles: bound over error {median:.3}, 95 % {most:.2}");
        assert!(median <= 5.0 && most <= 50.0, "{median} {most}");
    }
}

/// Rows of a cycle from a start, by Runge-Kutta's method, with all heats at 40 % from its half on.
fn rows(of: &[Written; 2], start: &[f64], (period, steps): (f64, usize)) -> Vec<Vec<f64>> {
    let step = period / steps as f64;
    let mut rows = vec![start.to_vec()];
    let mut t = start.to_vec();
    for i in 0..steps {
        let of = &of[usize::from(2 * i >= steps)];
        let along =
            |k: &[f64], by: f64| -> Vec<f64> { t.iter().zip(k).map(|(t, k)| t + by * k).collect() };
        let k1 = of.slopes(&t);
        let k2 = of.slopes(&along(&k1, 0.5 * step));
        let k3 = of.slopes(&along(&k2, 0.5 * step));
        let k4 = of.slopes(&along(&k3, step));
        for (j, t) in t.iter_mut().enumerate() {
            *t += step / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
        }
        if (i + 1) % (steps / ROWS) == 0 {
            rows.push(t.clone());
        }
    }
    rows
}

/// The rows of the cycle that repeats itself, by Newton's method from a start.
fn repeats(of: &[Written; 2], near: &[f64], span: (f64, usize)) -> Vec<Vec<f64>> {
    let mut start = near.to_vec();
    for _ in 0..4 {
        let end = |start: &[f64]| rows(of, start, span)[ROWS].clone();
        let now = end(&start);
        let n = start.len();
        let mut slopes = vec![vec![0.0; n]; n];
        for j in 0..n {
            let mut moved = start.clone();
            moved[j] += 1e-2;
            let moved = end(&moved);
            for i in 0..n {
                slopes[i][j] = f64::from(u8::from(i == j)) - (moved[i] - now[i]) / 1e-2;
            }
        }
        let step = solved(slopes, now.iter().zip(&start).map(|(now, t)| now - t).collect());
        start.iter_mut().zip(step).for_each(|(t, step)| *t += step);
    }
    rows(of, &start, span)
}

#[test]
fn nonlinear_networks_stay_within_their_bounds() {
    let (mut ratios, mut proven, mut all) = (Vec::new(), 0, 0);
    for seed in 0..count(8) {
        let period = [30.0, 300.0][seed as usize % 2];
        let [high, mut low] = [Written::new(seed), Written::new(seed)];
        low.heats.iter_mut().for_each(|heat| heat.0 *= 0.4);
        let begin = "format = 1\n[boundary]\nair = { T = \"20 degC\" }\n";
        let text = high.text().replace(begin, &duty(0.5 * period, period, 0.4));
        let text = text.replace(" [W] +", " [W] * duty +");
        let network = parsed(&text);
        let Ok(found) = found(&network, 1e-5, period) else { continue };
        all += 1;
        if found.solution.certificate().unwrap().is_err() {
            continue;
        }
        proven += 1;
        let at = |row: usize| -> Vec<f64> {
            network.node_ids().map(|id| found.solution.temperature(id).unwrap()[row]).collect()
        };
        let both = [high, low];
        let right = repeats(&both, &at(0), (period, 8000));
        let rough = repeats(&both, &at(0), (period, 4000));
        let apart = right.iter().flatten().zip(rough.iter().flatten());
        let own = apart.map(|(a, b)| (a - b).abs()).fold(1e-10, f64::max);
        check(&found.solution, &|row, node| right[row][node], &|_| own, &mut ratios);
    }
    println!("{proven} of {all} nonlinear cycles are proven");
    assert!(proven * 10 >= all * 8, "{proven}");
    let (median, most) = spread(&mut ratios);
    println!("nonlinear cycles: bound over error {median:.3}, 95 % {most:.2}");
    assert!(median <= 10.0 && most <= 100.0, "{median} {most}");
}

#[test]
fn bounds_are_the_same_again() {
    let (text, _) = linear(4, 200.0);
    let bounds = || {
        let found = certified(&parsed(&text), 1e-5, 200.0).solution;
        let of = |id| found.bounds(id).unwrap().into_iter().map(f64::to_bits).collect::<Vec<_>>();
        found.network().node_ids().map(of).collect::<Vec<_>>()
    };
    assert_eq!(bounds(), bounds());
}

/// Heat that falls with another temperature by 3 W/K and rises with it by as much: the eigenvalues
/// are -1 and +-3i per 100 s, but with absolute values 2 is one of them.
#[test]
fn a_cycle_that_bounds_do_not_contract_says_so() {
    let text = duty(50.0, 100.0, 0.0)
        + "[node]\na = { C = \"100 J/K\", T0 = \"20 degC\" }\nb = { C = \"100 J/K\", T0 = \"20 degC\" }\n\
           [resistor]\nsa = { from = \"a\", to = \"air\", G = \"1 W/K\" }\n\
           sb = { from = \"b\", to = \"air\", G = \"1 W/K\" }\n\
           [source]\nqa = { into = \"a\", P = \"9 [W] * duty - 3 [W/K] * (b.T - 20 [degC])\" }\n\
           qb = { into = \"b\", P = \"3 [W/K] * (a.T - 20 [degC])\" }\n";
    let found = certified(&parsed(&text), 1e-5, 100.0);
    let reason = found.solution.certificate().unwrap().as_ref().unwrap_err();
    assert_eq!(reason.code(), "certify::cycle", "{reason}");
    let Uncertified::Cycle { share, .. } = *reason else { panic!("{reason}") };
    assert!(share >= 1.0, "{share}");
    let node = found.solution.network().node("a").unwrap();
    assert!(found.solution.bounds(node).is_none());
}
