//! Limits in steady state and in runs, against closed forms written out here.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support::Numbers;
use lptn::prelude::*;

fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{found} is not {exact} within {within:e}");
}

fn solved(text: &str, transient: &Transient) -> lptn_solve::Solution {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}"));
    transient.solve(&ThermalSystem::assemble(&netlist.network).unwrap()).unwrap()
}

/// Validation case "incropera_5_1_thermocouple" (Incropera, Fundamentals of Heat and Mass Transfer,
/// 6th ed., Example 5.1): a bead of time constant 1 s in gas of 200 degC is at 199 degC after ln
/// 175 s.
#[test]
fn thermocouple_reaches_its_level_when_the_textbook_says() {
    let text = "format = 1\n[default]\nT0 = \"25 degC\"\n[node]\nbead = { C \
        = \"0.0006261444181549207 J/K\" }\n\
                [boundary]\ngas = { T = \"200 degC\" }\n[convection]\ne0 = { from = \"bead\", to \
                = \"gas\", \
                h = \"400 W/(m^2 K)\", area = \"1.5653610453873015e-06 m^2\" }\n\
                [limit]\nlevel = { of = \"bead.T\", below = \"199 degC\" }\n\
                never = { of = \"bead.T\", below = \"201 degC\" }\n\
                always = { of = \"gas.T - bead.T\", below = \"0 K\" }\n";
    // the rows say nothing: only start and stop
    let solution = solved(text, &Transient::until(Time(8.0)).at(&[]).tolerance(1e-7));
    let [level, never, always] = solution.limits() else { panic!("three limits") };
    close(level.broken_at.unwrap(), 5.164_785_973_923_514_5, 1e-6);
    close(level.broken_at.unwrap(), 5.2, 0.05); // the textbook's rounding
    let end = 200.0 - 175.0 * (-8.0_f64).exp();
    close(level.margin, 199.0 - end, 1e-6);
    close(level.worst_at, 8.0, 1e-12);
    assert_eq!(never.broken_at, None);
    close(never.margin, 201.0 - end, 1e-6);
    assert_eq!(always.broken_at, Some(0.0));
    close(always.margin, -175.0, 1e-9);
    close(always.worst_at, 0.0, 1e-12);
}

/// C = 100 J/K, G = 10 W/K: tau = 10 s. A pulse of 100 W for 10 s lifts the node by 10 (1 - 1/e) K,
/// then it cools.
#[test]
fn the_worst_of_a_pulse_is_found_between_two_rows() {
    let text = "format = 1\n[node]\na = { T0 = \"20 degC\", C = \"100 J/K\" }\n[boundary]\nair = { \
        T = \"20 degC\" }\n\
                [resistor]\nr = { from = \"a\", to = \"air\", G = \"10 W/K\" }\n\
                [source]\np = { into = \"a\", P = \"if(t < 10 [s], 100 [W], 0 [W])\" }\n\
                [limit]\nrise = { of = \"a.T - air.T\", below = \"5 K\" }\n";
    let solution = solved(text, &Transient::until(Time(100.0)).at(&[]).tolerance(1e-7));
    let [rise] = solution.limits() else { panic!("one limit") };
    let peak = 10.0 * -f64::exp_m1(-1.0);
    close(rise.margin, 5.0 - peak, 1e-6);
    close(rise.worst_at, 10.0, 1e-9);
    close(rise.broken_at.unwrap(), 10.0 * 2.0_f64.ln(), 1e-6);
}

/// C dT/dt = P sin(w t) - G T from rest: T = P (G sin wt - wC cos wt + wC exp(-t/tau)) / (G^2 +
/// (wC)^2).
#[test]
fn a_short_excursion_inside_a_step_is_seen() {
    let (c, g, p, w) = (100.0_f64, 10.0, 100.0, 0.2);
    let scale = p / (g * g + w * w * c * c);
    let rise =
        |t: f64| scale * (g * (w * t).sin() - w * c * (w * t).cos() + w * c * (-t * g / c).exp());
    // the first peak, by the zero of the derivative
    let slope = |t: f64| g * (w * t).cos() + w * c * (w * t).sin() - g * (-t * g / c).exp();
    let (mut low, mut high) = (5.0, 15.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 { low = middle } else { high = middle }
    }
    let peak = rise(low);
    let text = format!(
        "format = 1\n[node]\na = {{ T0 = \"20 degC\", C = \"100 J/K\" }}\n[boundary]\nair = {{ T \
         = \"20 degC\" }}\n\
         [resistor]\nr = {{ from = \"a\", to = \"air\", G = \"10 W/K\" }}\n\
         [source]\np = {{ into = \"a\", P = \"100 [W] * sin(t * 0.2 [1/s])\" }}\n\
         [limit]\nrise = {{ of = \"a.T - air.T\", below = \"{:.17} K\", severity = \"warning\" \
         }}\n",
        peak - 1e-5
    );
    let solution = solved(&text, &Transient::until(Time(30.0)).at(&[]).tolerance(1e-8));
    let [limit] = solution.limits() else { panic!("one limit") };
    close(limit.margin, -1e-5, 1e-6);
    close(limit.worst_at, low, 1e-2);
    // it is above the level for 2 sqrt(2e-5 / |T''|) s around the peak
    let curvature = scale
        * (-g * w * w * (w * low).sin()
            + w * w * w * c * (w * low).cos()
            + w * g * g / c * (-low * g / c).exp());
    let expected = low - (2e-5 / curvature.abs()).sqrt();
    close(limit.broken_at.unwrap(), expected, 2e-3);
}

#[test]
fn limits_of_a_network_without_state_are_judged_too() {
    let text = "format = 1\n[node]\na = { massless = true }\n[boundary]\nair = { T = \"20 degC\" \
        }\n\
                [resistor]\nr = { from = \"a\", to = \"air\", R = \"2 K/W\" }\n\
                [source]\np = { into = \"a\", P = \"t * 1 [W/s]\" }\n\
                [limit]\nhot = { of = \"a.T\", below = \"30 degC\" }\n";
    let solution = solved(text, &Transient::until(Time(8.0)).at(&[]));
    let [hot] = solution.limits() else { panic!("one limit") };
    close(hot.broken_at.unwrap(), 5.0, 1e-9);
    close(hot.margin, -6.0, 1e-9);
}

#[test]
fn steady_margins_have_the_sign_of_the_limit() {
    let text = "format = 1\n[node]\na = { T0 = \"20 degC\", C = \"1 J/K\" }\n[boundary]\nair = { T \
        = \"20 degC\" }\n\
                [resistor]\nr = { from = \"a\", to = \"air\", R = \"2 K/W\" }\n[source]\np = { \
                into = \"a\", P = \"5 W\" }\n\
                [limit]\nhot = { of = \"a.T\", below = \"27 degC\" }\nwarm = { of = \"a.T\", above \
                = \"27 degC\" }\n";
    let netlist = lptn_netlist::parse("net.toml", text).unwrap();
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let margins =
        SteadyState::solve(&system, 0.0).unwrap().limit_margins(&netlist.network, 0.0).unwrap();
    close(margins[0], -3.0, 1e-9);
    close(margins[1], 3.0, 1e-9);
}

/// A hub of aluminium on a shaft of steel, both at one temperature: 78 um of 100 mm are lost 78e-6 /
/// (0.1 (23.6e-6 - 12.0e-6)) = 67.24 K above 25 degC, at 92.24 degC. Both warm by 0.1 K/s.
#[test]
fn an_interference_fit_is_lost_where_the_hub_has_outgrown_the_shaft() {
    let text = "format = 1
[node]
hub = { T0 = '25 degC', C = '200 J/K' }
shaft = { T0 = '25 degC', C = '800 J/K' }
[boundary]
air = { T = '25 degC' }
[resistor]
hardly = { from = 'shaft', to = 'air', R = '1e9 K/W' }
[source]
into_hub = { into = 'hub', P = '20 W' }
into_shaft = { into = 'shaft', P = '80 W' }
[press_fit.ring]
from = 'hub'
to = 'shaft'
diameter = '100 mm'
hub_diameter = '130 mm'
length = '30 mm'
interference = '78 um'
T_fit = '25 degC'
alpha = ['23.6e-6 1/K', '12e-6 1/K']
E = ['70 GPa', '210 GPa']
poisson = [0.33, 0.3]
k = ['167 W/(m K)', '45 W/(m K)']
slope = 0.15
roughness = '1 um'
hardness = '1.1 GPa'
[limit]
held = { of = 'ring.margin', above = '0 K' }
";
    let run = solved(text, &Transient::until(Time(1200.0)).at(&[]).tolerance(1e-6));
    let broken: f64 = run.limits()[0].broken_at.unwrap();
    let warm = 25.0 + 0.1 * broken;
    assert!((warm - 92.24).abs() < 0.1, "lost at {warm} degC");
    assert!((broken - 672.41).abs() < 0.05, "lost after {broken} s");
}

/// Two bodies that are joined and one by itself, in closed form, over air of 20 degC.
struct Bodies {
    c: [f64; 3],
    g: [f64; 3],
    power: [f64; 3],
    start: [f64; 3],
}

impl Bodies {
    fn random(numbers: &mut Numbers) -> Self {
        let mut three = |low, high| [0; 3].map(|_| numbers.between(low, high));
        let (c, g) = (three(200.0, 3000.0), three(0.5, 20.0));
        Self { c, g, power: three(-60.0, 400.0), start: three(10.0, 120.0) }
    }

    fn text(&self) -> String {
        let Self { c, g, power, start } = self;
        let node = |i: usize| format!("{{ C = \"{} J/K\", T0 = \"{} degC\" }}", c[i], start[i]);
        let source = |to: &str, i: usize| format!("{{ into = \"{to}\", P = \"{} W\" }}", power[i]);
        format!(
            "format = 1\n[node]\na = {}\nb = {}\nc = {}\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
             [resistor]\nab = {{ from = \"a\", to = \"b\", G = \"{} W/K\" }}\n\
             b_air = {{ from = \"b\", to = \"air\", G = \"{} W/K\" }}\n\
             c_air = {{ from = \"c\", to = \"air\", G = \"{} W/K\" }}\n\
             [source]\npa = {}\npb = {}\npc = {}\n",
            node(0),
            node(1),
            node(2),
            g[0],
            g[1],
            g[2],
            source("a", 0),
            source("b", 1),
            source("c", 2)
        )
    }

    /// Temperatures in degC: a sum of exponentials from the characteristic equation.
    fn at(&self, t: f64) -> [f64; 3] {
        let Self { c, g, power, start } = self;
        let (a11, a12) = (-g[0] / c[0], g[0] / c[0]);
        let (a21, a22) = (g[0] / c[1], -(g[0] + g[1]) / c[1]);
        let (half, det) = (0.5 * (a11 + a22), a11 * a22 - a12 * a21);
        let root = (half * half - det).sqrt();
        let rates = [half + root, half - root];
        let steady_b = (power[0] + power[1]) / g[1];
        let steady = [steady_b + power[0] / g[0], steady_b];
        let rest = [start[0] - 20.0 - steady[0], start[1] - 20.0 - steady[1]];
        let v = rates.map(|r| [a12, r - a11]);
        let det_v = v[0][0] * v[1][1] - v[1][0] * v[0][1];
        let w = [
            (rest[0] * v[1][1] - rest[1] * v[1][0]) / det_v,
            (rest[1] * v[0][0] - rest[0] * v[0][1]) / det_v,
        ];
        let joined = |i: usize| {
            20.0 + steady[i] + (0..2).map(|k| w[k] * v[k][i] * (rates[k] * t).exp()).sum::<f64>()
        };
        let alone = power[2] / g[2];
        let third = 20.0 + alone + (start[2] - 20.0 - alone) * (-g[2] / c[2] * t).exp();
        [joined(0), joined(1), third]
    }
}

/// An expression with bends, as it is written and in numbers. Temperatures are in degC.
type Bent = (String, Box<dyn Fn([f64; 3]) -> f64>);

/// A table of a rising temperature whose values go up and down by as many kelvin as its points lie
/// apart, so that errors of temperatures count about once.
fn table(numbers: &mut Numbers, range: (f64, f64)) -> (String, Vec<(f64, f64)>) {
    let count = numbers.between(3.0, 14.0).floor();
    let gap = (range.1 - range.0 + 2.0) / count;
    let mut points = Vec::new();
    let mut x = range.0 - 1.0;
    while x < range.1 + 1.0 + gap {
        points.push((x, numbers.between(0.0, gap)));
        x += gap * numbers.between(0.3, 1.0);
    }
    let list = |of: &dyn Fn(&(f64, f64)) -> f64| {
        points.iter().map(|point| of(point).to_string()).collect::<Vec<_>>().join(", ")
    };
    let text = format!(
        "[table]\nloss = {{ x = [{}], y = [{}], x_unit = \"degC\", y_unit = \"W\", outside = \
         \"hold\" }}\n",
        list(&|point| point.0),
        list(&|point| point.1)
    );
    (text, points)
}

fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    let k = points.partition_point(|point| point.0 <= x).clamp(1, points.len() - 1);
    let [(x0, y0), (x1, y1)] = [points[k - 1], points[k]];
    if x <= points[0].0 {
        points[0].1
    } else if x >= points[points.len() - 1].0 {
        points[points.len() - 1].1
    } else {
        y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
    }
}

/// A table, an expression, and a temperature of the first body at which it is least: a bell may be
/// narrower than any look.
fn bent(kind: usize, numbers: &mut Numbers, seen: &[[f64; 3]]) -> (String, Bent, Option<f64>) {
    let range = |i: usize| {
        let of = seen.iter().map(|t| t[i]);
        (of.clone().fold(f64::INFINITY, f64::min), of.fold(f64::NEG_INFINITY, f64::max))
    };
    let inside = |numbers: &mut Numbers, i: usize| {
        let (low, high) = range(i);
        numbers.between(low - 0.05 * (high - low), high + 0.05 * (high - low))
    };
    let (x, y) = (inside(numbers, 0), inside(numbers, 2));
    let none = String::new();
    let (table, bent): (String, Bent) = match kind {
        0 => (none, (format!("abs(a.T - {x} [degC])"), Box::new(move |t| (t[0] - x).abs()))),
        1 => (none, ("kelvin(min(a.T, c.T))".into(), Box::new(|t| t[0].min(t[2]) + 273.15))),
        2 => {
            let text = format!("kelvin(max(a.T, b.T, c.T, {y} [degC]))");
            (none, (text, Box::new(move |t| t[0].max(t[1]).max(t[2]).max(y) + 273.15)))
        }
        3 => {
            let text = format!("abs(min(a.T, c.T) - {x} [degC]) - 0.5 * abs(b.T - {y} [degC])");
            let value = move |t: [f64; 3]| (t[0].min(t[2]) - x).abs() - 0.5 * (t[1] - y).abs();
            (none, (text, Box::new(value)))
        }
        4 => {
            let (low, high) = range(0);
            let width = (high - low) * 10_f64.powf(numbers.between(-4.0, -1.0));
            let text = format!("-3 [K] * exp(-((a.T - {x} [degC]) / {width} [K])^2)");
            let value = move |t: [f64; 3]| -3.0 * (-((t[0] - x) / width).powi(2)).exp();
            return (none, (text, Box::new(value)), Some(x));
        }
        _ => {
            let (text, points) = table(numbers, range(0));
            let written = "loss(a.T) * 1 [K/W] - 0.3 * abs(a.T - c.T)".to_owned();
            let value = move |t: [f64; 3]| interpolated(&points, t[0]) - 0.3 * (t[0] - t[2]).abs();
            (text, (written, Box::new(value)))
        }
    };
    (table, bent, None)
}

/// Looks of the closed form: the least value between any two of them is that of a bend or of a
/// parabola, found on a finer set.
const LOOKS: u32 = 4000;

/// The least value over the run and the mean, by looking often; near the least value, more often.
fn by_looking(of: &dyn Fn(f64) -> f64, stop: f64) -> (f64, f64) {
    let at = |k: f64, from: f64, to: f64| from + (to - from) * k / f64::from(LOOKS);
    let (mut from, mut to, mut least) = (0.0, stop, (f64::INFINITY, 0.0));
    let mut sum = 0.0;
    for round in 0..4 {
        for k in 0..=LOOKS {
            let time = at(f64::from(k), from, to);
            let value = of(time);
            if round == 0 {
                sum += if k == 0 || k == LOOKS { 0.5 * value } else { value };
            }
            if value < least.0 {
                least = (value, time);
            }
        }
        let around = 2.0 * (to - from) / f64::from(LOOKS);
        (from, to) = ((least.1 - around).max(0.0), (least.1 + around).min(stop));
    }
    (least.0, sum / f64::from(LOOKS))
}

/// Whether the first body passes a temperature.
fn passes(bodies: &Bodies, x: f64, stop: f64) -> bool {
    let above = |k: u32| bodies.at(stop * f64::from(k) / f64::from(LOOKS))[0] > x;
    (1..=LOOKS).any(|k| above(k) != above(0))
}

/// Limits on random expressions with bends over steps as long as a linear network takes them: the
/// margins are those of the closed form to ten tolerances, and so are windows, whose mean is looked
/// up on a coarse set.
#[test]
fn limits_with_bends_are_as_good_as_temperatures() {
    const TOLERANCE: f64 = 1e-5;
    let mut numbers = Numbers(34);
    let mut broken = 0;
    for case in 0..300 {
        let bodies = Bodies::random(&mut numbers);
        let stop = numbers.between(20.0, 2000.0);
        let seen: Vec<[f64; 3]> = (0..=50).map(|k| bodies.at(stop * f64::from(k) / 50.0)).collect();
        let (table, (text, value), bell) = bent(case % 6, &mut numbers, &seen);
        let of = |t: f64| value(bodies.at(t));
        let (mut least, mean) = by_looking(&of, stop);
        if let Some(x) = bell.filter(|x| passes(&bodies, *x, stop)) {
            least = value([x, 0.0, 0.0]);
        }
        let bound = least + numbers.between(-0.5, 0.5) + 0.02;
        let net = format!(
            "{}{table}[limit]\nbent = {{ of = \"{text}\", above = \"{bound} K\" }}\naverage = {{ of = \
             \"mean({text})\", above = \"{bound} K\" }}\n[run]\nstop = \
             \"{stop} s\"\nreport = {{ bent = \"{text}\" }}\nwindow = {{ all = {{ from = \"0 s\", \
             to = \"{stop} s\" }} }}\n",
            bodies.text()
        );
        let netlist =
            lptn_netlist::parse("net.toml", &net).unwrap_or_else(|e| panic!("{e}\n{net}"));
        let network = &netlist.network;
        let transient = Transient::of(network, netlist.run.as_ref().unwrap()).at(&[]);
        let of_report = lptn_solve::Selection::matching(network, &["bent".to_owned()]).unwrap();
        let window = lptn_solve::Window { name: "all".into(), from: 0.0, to: stop, of: of_report };
        let transient = Transient { windows: vec![window], tolerance: TOLERANCE, ..transient };
        let system = ThermalSystem::assemble(network).unwrap();
        let solution = transient.solve(&system).unwrap();
        let [limit, of_mean] = solution.limits() else { panic!("two limits") };
        let column = &solution.windows()[0].columns[0];
        let within = 10.0 * TOLERANCE;
        let told = format!("case {case}\n{net}");
        assert!((column.min.0 - least).abs() < within, "min {} {least} {told}", column.min.0);
        let margin = least - bound;
        let found = if limit.margin.abs() < within { margin } else { limit.margin };
        assert!((found - margin).abs() < within, "margin {} {margin} {told}", limit.margin);
        assert_eq!(limit.broken_at.is_some(), limit.margin < 0.0, "{told}");
        broken += usize::from(limit.broken_at.is_some());
        if bell.is_some() {
            continue; // a flank may be as steep as 1e4 K/K
        }
        if let Some(time) = limit.broken_at.filter(|time| *time > 0.0) {
            assert!((of(time) - bound).abs() < within, "broken at {time} {told}");
        }
        // which a coarse set is good for
        let range = seen
            .iter()
            .map(|t| value(*t))
            .fold((f64::MAX, f64::MIN), |r, v| (r.0.min(v), r.1.max(v)));
        assert!((of_mean.margin - (column.mean - bound)).abs() < within, "{told}");
        let apart = (column.mean - mean).abs();
        assert!(apart < within + 1e-5 * (range.1 - range.0), "mean {} {mean} {told}", column.mean);
    }
    assert!((60..240).contains(&broken), "{broken}");
}
