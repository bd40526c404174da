//! Limits, peaks and levels of runs between their rows, against exponentials; and how much is
//! looked at for that.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test fails by panicking, in its helpers too; numbers that are given"
)]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, IntegratorChoice, NetworkBuilder, Temperature, Time,
};
use lptn_solve::{LimitSeen, Solution, SteadyState, Transient, Watch};

/// Time constant of the body in s.
const TAU: f64 = 500.0;

/// A body from 20 degC towards 100 degC with limits, and more sections.
fn system(limits: &str, more: &str) -> ThermalSystem {
    let text = format!(
        "format = 1\n[node]\nbody = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\nskin = {{ massless = true }}\n[boundary]\nair = \
         {{ T = \"20 degC\" }}\n[resistor]\nfilm = {{ from = \"skin\", to = \"air\", R = \"0.25 K/W\" }}\nwall = {{ from = \
         \"body\", to = \"skin\", R = \"0.25 K/W\" }}\n[source]\nheat = {{ into = \"body\", P = \"160 W\" \
         }}\n[limit]\n{limits}\n[run]\nstop = \"1000 s\"\n{more}\n"
    );
    let netlist = lptn_netlist::parse("limits.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

/// The rise of the body in K at a time in s.
fn rise(time: f64) -> f64 {
    -80.0 * (-time / TAU).exp_m1()
}

/// When it has risen by so many K, in s.
fn reaches(kelvin: f64) -> f64 {
    -TAU * (-kelvin / 80.0).ln_1p()
}

fn run(system: &ThermalSystem) -> Solution {
    Transient::until(Time(1000.0)).at(&[]).tolerance(1e-6).solve(system).unwrap()
}

fn seen(limit: &str) -> (LimitSeen, Solution) {
    let solution = run(&system(&format!("limit = {{ {limit} }}"), ""));
    (solution.limits()[0], solution)
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

#[test]
fn a_limit_that_is_kept_has_its_worst_at_the_end() {
    let (seen, _) = seen("of = \"body.T\", below = \"95 degC\"");
    near(seen.margin, 75.0 - rise(1000.0), 1e-5);
    assert_eq!((seen.worst_at, seen.broken_at, seen.open), (1000.0, None, 0.0));
    let (seen, _) = self::seen("of = \"body.T\", above = \"15 degC\"");
    near(seen.margin, 5.0, 0.0);
    assert_eq!((seen.worst_at, seen.broken_at), (0.0, None));
}

#[test]
fn a_limit_is_broken_when_its_quantity_passes_it() {
    for kelvin in [1.0, 33.3, 60.0] {
        let (seen, _) = seen(&format!("of = \"body.T\", below = \"{} degC\"", 20.0 + kelvin));
        near(seen.broken_at.unwrap(), reaches(kelvin), 1e-4);
        near(seen.margin, kelvin - rise(1000.0), 1e-5);
        near(seen.worst_at, 1000.0, 0.0);
        // the massless skin stands in the middle
        let (seen, _) =
            self::seen(&format!("of = \"skin.T\", below = \"{} degC\"", 20.0 + 0.5 * kelvin));
        near(seen.broken_at.unwrap(), reaches(kelvin), 1e-4);
        near(seen.margin, 0.5 * (kelvin - rise(1000.0)), 1e-5);
    }
    // at the start
    let (seen, _) = seen("of = \"body.T\", above = \"25 degC\"");
    near(seen.margin, -5.0, 1e-12);
    assert_eq!((seen.worst_at, seen.broken_at), (0.0, Some(0.0)));
}

/// What a temperature passes by less than its error is reached and not passed.
#[test]
fn a_limit_that_is_passed_by_less_than_the_tolerance_is_kept() {
    let end = 20.0 + rise(1000.0);
    let kept = |by: f64| {
        let (seen, _) = seen(&format!("of = \"body.T\", below = \"{:.12} degC\"", end - by));
        (seen.margin, seen.broken_at.is_some())
    };
    assert_eq!(kept(5e-6), (0.0, false));
    let (margin, broken) = kept(2e-5);
    assert!(broken && (margin + 2e-5).abs() < 5e-6, "{margin}");
    let (margin, broken) = kept(-2e-5);
    assert!(!broken && (margin - 2e-5).abs() < 5e-6, "{margin}");
    // the start is exact
    let (seen, _) = seen("of = \"body.T\", above = \"20.000002 degC\"");
    assert!(seen.margin < -1.9e-6 && seen.broken_at == Some(0.0), "{seen:?}");
    let (seen, _) = self::seen("of = \"body.T\", above = \"20.0000000005 degC\"");
    assert_eq!((seen.margin, seen.broken_at), (0.0, None));
}

/// A worst that the error cannot tell from that of the start is there.
#[test]
fn a_worst_that_the_error_cannot_tell_from_an_end_is_there() {
    // the rise from 0 to its end and back: |rise - half| is as large at both ends
    let half = 0.5 * rise(1000.0);
    let of = |more: f64| {
        let text =
            format!("of = \"abs(body.T - {:.12} [degC])\", below = \"80 K\"", 20.0 + half + more);
        seen(&text).0
    };
    assert_eq!([of(1e-6).worst_at, of(-1e-6).worst_at], [0.0, 0.0]);
    assert_eq!([of(1e-3).worst_at, of(-1e-3).worst_at], [0.0, 1000.0]);
    near(of(1e-3).margin, 80.0 - half - 1e-3, 1e-5);
}

/// The mean of the rise is that of its exponential, and is known at the end.
#[test]
fn a_limit_of_a_mean_is_judged_at_the_end() {
    let mean = 80.0 - 80.0 * TAU / 1000.0 * -(-1000.0 / TAU).exp_m1();
    for (below, broken) in [(60.0, true), (65.0, mean > 45.0), (90.0, false)] {
        let (seen, _) = seen(&format!("of = \"mean(body.T)\", below = \"{below} degC\""));
        near(seen.margin, below - 20.0 - mean, 1e-5);
        assert_eq!((seen.worst_at, seen.broken_at.is_some()), (1000.0, broken), "{below}");
    }
    let (seen, _) = seen("of = \"mean(body.T)\", above = \"30 degC\"");
    near(seen.margin, mean - 10.0, 1e-5);
    assert!(seen.broken_at.is_none());
}

/// Functionals of the rise 80 K (1 - exp(-t/TAU)) in closed form, all known at the end.
#[test]
fn limits_of_numbers_over_time_have_closed_forms() {
    let mean = 80.0 - 80.0 * TAU / 1000.0 * -(-1000.0 / TAU).exp_m1();
    for (of, bound, value, tolerance) in [
        ("integral(body.T - 20 [degC])", "below = \"50000 K s\"", 5e4 - 1000.0 * mean, 1e-2),
        ("integral(film.Q)", "above = \"40 kJ\"", 2000.0 * mean - 4e4, 2e-2),
        ("time_over(body.T, 60 [degC])", "below = \"200 s\"", reaches(40.0) - 800.0, 1e-4),
        ("time_under(body.T, 60 [degC])", "below = \"200 s\"", 200.0 - reaches(40.0), 1e-4),
        ("last(body.T)", "below = \"80 degC\"", 60.0 - rise(1000.0), 1e-5),
        ("min(body.T)", "below = \"25 degC\"", 5.0, 1e-9),
        ("max(body.T)", "above = \"90 degC\"", rise(1000.0) - 70.0, 1e-5),
        ("mean(abs(body.T - 60 [degC]))", "below = \"25 K\"", 25.0 - of_bend(), 1e-5),
    ] {
        let (seen, _) = seen(&format!("of = \"{of}\", {bound}"));
        near(seen.margin, value, tolerance);
        let broken = (value < 0.0).then_some(1000.0);
        assert_eq!((seen.worst_at, seen.broken_at, seen.open), (1000.0, broken, 0.0), "{of}");
    }
}

/// The mean of |rise - 40 K|: before the passage 40 K - rise, after it rise - 40 K.
fn of_bend() -> f64 {
    let passes = reaches(40.0);
    let integral = |t: f64| 80.0 * (t + TAU * (-t / TAU).exp_m1());
    let before = 40.0 * passes - integral(passes);
    (before + integral(1000.0) - integral(passes) - 40.0 * (1000.0 - passes)) / 1000.0
}

/// The largest value is below a bound if all values are: the limit tells when it is first broken.
#[test]
fn a_limit_of_the_largest_value_is_one_of_every_moment() {
    for (of, bound) in [("body.T", "below = \"70 degC\""), ("body.T", "above = \"25 degC\"")] {
        let (plain, _) = seen(&format!("of = \"{of}\", {bound}"));
        let name = if bound.starts_with("below") { "max" } else { "min" };
        assert_eq!(plain, seen(&format!("of = \"{name}({of})\", {bound}")).0);
    }
}

/// A life at a constant rate of ageing twice that at the reference is half the life there. The rate
/// is exp(E/k (1/T_ref - 1/T)); its mean is by Simpson's rule on the closed form of the rise.
#[test]
fn a_limit_of_a_life_is_that_of_the_mean_rate() {
    let rate = |t: f64| {
        (1.602_176_634e-19 / 1.380_649e-23 * (1.0 / 333.15 - 1.0 / (293.15 + rise(t)))).exp()
    };
    let count = 20_000;
    let at = |k: i32| rate(1000.0 * f64::from(k) / f64::from(count));
    let weight = |k: i32| {
        if k == 0 || k == count {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let mean = (0..=count).map(|k| weight(k) * at(k)).sum::<f64>() / (3.0 * f64::from(count));
    let (seen, _) = seen("of = \"life(body.T, 1000 [h], 60 [degC], 1 [eV])\", above = \"500 h\"");
    let exact = 3.6e6 / mean - 1.8e6;
    near(seen.margin, exact, 1e-6 * exact.abs().max(1e6));
}

/// The numbers are the same for any rows, and in steady state those that do not end are not judged.
#[test]
fn numbers_over_time_do_not_depend_on_rows() {
    let system = system(
        "a = { of = \"integral(film.Q)\", below = \"1 J\" }\n\
         b = { of = \"time_over(body.T, 60 [degC])\", below = \"1 s\" }\n\
         c = { of = \"mean(body.T)\", below = \"90 degC\" }",
        "",
    );
    let coarse = run(&system);
    let fine =
        Transient::until(Time(1000.0)).every(Time(0.5)).tolerance(1e-6).solve(&system).unwrap();
    assert_eq!(coarse.limits(), fine.limits());
    let state = SteadyState::solve(&system, 0.0).unwrap();
    let margins = state.limit_margins(system.network(), 0.0).unwrap();
    assert!(margins[0].is_nan() && margins[1].is_nan());
    near(margins[2], -10.0, 1e-9);
}

/// A bell over temperature, and a kink, inside one step of the integrator.
#[test]
fn a_valley_of_a_margin_inside_a_step_is_found() {
    for (middle, width) in [(40.0, 2.0), (70.3, 0.1), (85.0, 0.01)] {
        let bell = format!("exp(-((body.T - {middle} [degC]) / {width} [K])^2)");
        let (seen, _) = seen(&format!("of = \"{bell}\", below = 0.5"));
        near(seen.margin, -0.5, 1e-6);
        near(seen.worst_at, reaches(middle - 20.0), 1e-2);
        let half = width * 2.0_f64.ln().sqrt();
        near(seen.broken_at.unwrap(), reaches(middle - 20.0 - half), 2e-3);
        let kink = format!("of = \"abs(body.T - {middle} [degC])\", above = \"{width} K\"");
        let (seen, _) = self::seen(&kink);
        near(seen.margin, -width, 1e-5);
        near(seen.worst_at, reaches(middle - 20.0), 1e-2);
        near(seen.broken_at.unwrap(), reaches(middle - 20.0 - width), 1e-3);
    }
}

/// Heat flows, and what cannot be judged.
#[test]
fn limits_of_heat_flows_are_seen_too() {
    let (seen, _) = seen("of = \"film.Q\", below = \"100 W\"");
    near(seen.margin, 100.0 - 2.0 * rise(1000.0), 1e-4);
    near(seen.broken_at.unwrap(), reaches(50.0), 1e-4);
}

#[test]
fn several_limits_are_told_as_events_in_the_order_of_time() {
    let limits = "b = { of = \"body.T\", below = \"70 degC\" }\na = { of = \"body.T\", below = \"30 degC\" }\nc = \
                  { of = \"body.T\", below = \"99 degC\" }";
    let solution = run(&system(limits, ""));
    let times: Vec<f64> = solution.events().iter().map(|event| event.time).collect();
    assert_eq!(times.len(), 2);
    near(times[0], reaches(10.0), 1e-4);
    near(times[1], reaches(50.0), 1e-4);
}

/// In steady state the body stands at 100 degC.
#[test]
fn a_steady_state_has_margins() {
    let limits = "a = { of = \"body.T\", below = \"90 degC\" }\nb = { of = \"body.T\", below = \"100 degC\" }\nc = \
                  { of = \"body.T\", above = \"100 degC\" }\nd = { of = \"skin.T\", below = \"65 degC\" }";
    let system = system(limits, "");
    let state = SteadyState::solve(&system, 0.0).unwrap();
    let margins = state.limit_margins(system.network(), 0.0).unwrap();
    assert_eq!(margins.len(), 4);
    for (found, expected) in margins.iter().zip([-10.0, 0.0, 0.0, 5.0]) {
        near(*found, expected, 1e-9);
        assert!(*found >= 0.0 || expected < 0.0, "rounding breaks nothing");
    }
}

/// Looks are those of steps and of what happens in them: as measured, with a tenth to spare.
#[test]
fn looks_are_few() {
    let measured = |limits: &str, placed: u64| {
        let solution = run(&system(limits, ""));
        let (looks, steps) = (solution.looks().placed, solution.statistics().steps);
        assert!(steps <= 6, "{steps} steps, 5 measured");
        assert!(
            looks * 10 <= placed * 11 && looks * 10 >= placed * 9,
            "{looks}, {placed} measured"
        );
    };
    measured("", 3);
    measured("a = { of = \"body.T\", below = \"99 degC\" }", 133);
    measured("a = { of = \"body.T\", below = \"70 degC\" }", 139);
    measured("a = { of = \"mean(body.T)\", below = \"70 degC\" }", 123);
    measured("a = { of = \"abs(body.T - 60 [degC])\", below = \"70 K\" }", 86);
    measured("a = { of = \"exp(-((body.T - 60 [degC]) / 0.1 [K])^2)\", below = 2 }", 935);
}

/// The body is heated for 300 s, then left alone: it is hottest there. The skin is at its half.
#[test]
fn peaks_and_levels_are_those_of_the_curve() {
    let text = "format = 1\n[node]\nbody = { C = \"1 kJ/K\", T0 = \"20 degC\" }\nskin = { C = \"0.5 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nair = { T \
                = \"20 degC\" }\n[resistor]\nfilm = { from = \"skin\", to = \"air\", R = \"0.25 K/W\" }\nwall = { from = \
                \"body\", to = \"skin\", R = \"0.25 K/W\" }\n[source]\nheat = { into = \"body\", P = \"160 W * exp(-t / 200 [s])\" \
                }\n[run]\nstop = \"1000 s\"\n";
    let text = text.replace("160 W * exp", "160 [W] * exp");
    let netlist = lptn_netlist::parse("peaks.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    // by the classical method of Runge and Kutta, 0.02 s a step
    let rates = |t: f64, [a, b]: [f64; 2]| {
        let wall = 4.0 * (a - b);
        [(160.0 * (-t / 200.0).exp() - wall) / 1e3, (wall - 4.0 * b) / 5e2]
    };
    let (h, mut state, mut peaks, mut crossed) = (0.02, [0.0; 2], [(0.0, 0.0); 2], [None; 2]);
    for k in 0..50_000 {
        let t = f64::from(k) * h;
        let ahead =
            |r: [f64; 2], part: f64| [state[0] + part * h * r[0], state[1] + part * h * r[1]];
        let a = rates(t, state);
        let b = rates(t + 0.5 * h, ahead(a, 0.5));
        let c = rates(t + 0.5 * h, ahead(b, 0.5));
        let d = rates(t + h, ahead(c, 1.0));
        let next: [f64; 2] =
            std::array::from_fn(|i| state[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        for i in 0..2 {
            if next[i] > peaks[i].0 {
                peaks[i] = (next[i], t + h);
            }
            if state[i] < 3.0 && next[i] >= 3.0 && crossed[i].is_none() {
                crossed[i] = Some(t + h * (3.0 - state[i]) / (next[i] - state[i]));
            }
        }
        state = next;
    }
    for hottest_only in [false, true] {
        let level = (!hottest_only).then_some(296.15);
        let watch = netlist.network.node_ids().map(|node| Watch { node, level }).collect();
        let settings = Transient { watch, hottest_only, ..Transient::until(Time(1000.0)) };
        let solution = settings.at(&[]).tolerance(1e-6).solve(&system).unwrap();
        let watched = solution.watched();
        for i in 0..(if hottest_only { 1 } else { 2 }) {
            near(watched[i].peak.0, 293.15 + peaks[i].0, 1e-5);
            near(watched[i].peak.1, peaks[i].1, 0.2);
            near(watched[i].last(), 293.15 + state[i], 1e-5);
            if !hottest_only {
                near(watched[i].crossed.unwrap(), crossed[i].unwrap(), 1e-3);
            }
        }
        let (looks, measured) = (solution.looks(), if hottest_only { 137 } else { 296 });
        assert!(
            looks.searched * 10 <= measured * 11 && looks.searched * 10 >= measured * 9,
            "{looks:?}"
        );
        assert!(looks.placed <= 2250 && looks.placed >= 1850, "{looks:?}, 2050 measured");
    }
}

/// A run that begins later has the mean of its own time.
#[test]
fn the_mean_of_a_run_that_begins_later_is_that_of_its_time() {
    let system = system("m = { of = \"mean(body.T)\", below = \"90 degC\" }", "");
    let settings = Transient { start: 3000.0, ..Transient::until(Time(4000.0)) };
    let solution = settings.at(&[3000.0, 4000.0]).tolerance(1e-6).solve(&system).unwrap();
    let mean = 80.0 - 80.0 * TAU / 1000.0 * -(-1000.0 / TAU).exp_m1();
    near(solution.limits()[0].margin, 70.0 - mean, 1e-5);
    near(solution.limits()[0].worst_at, 4000.0, 0.0);
}

/// A film with the slope of a fourth root at its start: the margin there is far from the least one.
#[test]
fn an_infinite_slope_at_the_start_leaves_nothing_open() {
    let text = "format = 1\n[node]\nb = { C = \"500 J/K\", T0 = \"20 degC\" }\n[boundary]\nair = { T = \"20 \
                degC\" }\n[resistor]\nr = { from = \"b\", to = \"air\", R = \"1 K/W\" }\n[source]\ns = { into = \"b\", P \
                = \"100 W\" }\n[limit]\nx = { of = \"5 + 0.5 * (abs(b.T - air.T) / 1 [K])^0.25\", below = 8 \
                }\n[run]\nstop = \"1000 s\"\n";
    let network = lptn_netlist::parse("net.toml", text).unwrap().network;
    let system = ThermalSystem::assemble(&network).unwrap();
    let solution = Transient::until(Time(1000.0)).tolerance(1e-6).solve(&system).unwrap();
    let seen = solution.limits()[0];
    // 100 K (1 - exp(-t / 500 s))
    near(seen.margin, 3.0 - 0.5 * (-100.0 * (-2.0_f64).exp_m1()).powf(0.25), 1e-6);
    assert_eq!((seen.worst_at, seen.open), (1000.0, 0.0));
}

/// Water of 60 degC that pushes out water of 20 degC arrives after 10 s, at a node without capacity.
#[test]
fn a_jump_that_leaves_a_pipe_leaves_nothing_open() {
    let text = "format = 1\n[boundary]\na = { T = \"60 degC\" }\nb = { T = \"20 degC\" }\n[node]\nn = { massless \
                = true }\n[pipe]\np = { from = \"a\", to = \"n\", mcp = \"100 W/K\", C = \"1 kJ/K\", T0 = \"20 degC\" \
                }\n[advection]\no = { from = \"n\", to = \"b\", mcp = \"100 W/K\" }\n[limit]\nx = { of = \"n.T\", \
                below = \"70 degC\" }\n[run]\nstop = \"20 s\"\n";
    let network = lptn_netlist::parse("net.toml", text).unwrap().network;
    let system = ThermalSystem::assemble(&network).unwrap();
    let solution = Transient::until(Time(20.0)).tolerance(1e-5).solve(&system).unwrap();
    let seen = solution.limits()[0];
    near(seen.margin, 10.0, 1e-5);
    assert_eq!(seen.open, 0.0);
}

/// A bell far narrower than any look may stand wherever the body goes: the margin may be off by its
/// height.
#[test]
fn what_may_hide_however_closely_it_is_looked_at_leaves_a_margin_open() {
    let bell = "exp(-((body.T - 60 [degC]) / 1e-9 [K])^2)";
    let (seen, _) = seen(&format!("of = \"{bell}\", below = 2"));
    near(seen.open, 1.0, 1e-6);
    let (seen, _) = self::seen("of = \"exp(-((body.T - 60 [degC]) / 5 [K])^2)\", below = 2");
    assert_eq!(seen.open, 0.0);
}

/// The tops of watched nodes are placed one by one where there are few nodes; of two nodes among
/// 3000 what the points of the step tell is taken for it.
#[test]
fn tops_of_many_nodes_are_taken_from_the_points() {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature(300.0));
    let nodes: Vec<_> = (0..3000)
        .map(|k| b.node(&format!("n{k}"), HeatCapacity(100.0), Temperature(300.0)))
        .collect();
    for (k, &node) in nodes.iter().enumerate() {
        b.resistor(&format!("r{k}"), node, air, Conductance(1.0));
    }
    for (k, &node) in nodes.iter().take(2).enumerate() {
        let heat = b.expression("50 [W] * sin(2 * pi * t / 300 [s])", None).unwrap();
        b.source(&format!("q{k}"), node, heat);
    }
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let run = |watched: usize| {
        let watch = nodes[..watched].iter().map(|&node| Watch { node, level: None }).collect();
        let settings = Transient { watch, ..Transient::until(Time(300.0)) };
        settings.at(&[]).tolerance(1e-4).solve(&system).unwrap()
    };
    let (one, two) = (run(1), run(2));
    assert!(one.looks().placed > two.looks().placed, "{:?} {:?}", one.looks(), two.looks());
    let (a, b) = (one.watched()[0].peak, two.watched()[1].peak);
    near(a.0, b.0, 1e-3);
    near(a.1, b.1, 0.5);
}

/// Twelve bodies that start at one temperature differ by rounding in the first steps. Their largest
/// difference bends wherever another one becomes the hottest: noise cut such a step 4,096 times.
#[test]
fn bodies_that_begin_alike_are_looked_at_as_others_are() {
    let text = |start: f64| {
        let one = |k: usize| {
            let (c, t) = (900 + k, 25.0 + start * k as f64);
            format!(
                "[node.b{k}]\nC = \"{c} J/K\"\nT0 = \"{t} degC\"\n[resistor.r{k}]\nfrom = \"b{k}\"\nto = \
                 \"air\"\nR = \"0.5 K/W\"\n[source.h{k}]\ninto = \"b{k}\"\nP = \"19 W\"\n"
            )
        };
        let bodies: String = (0..12).map(one).collect();
        let all = (0..12).map(|k| format!("b{k}.T")).collect::<Vec<_>>().join(", ");
        format!(
            "format = 1\n[boundary]\nair = {{ T = \"25 degC\" }}\n{bodies}[limit]\nalike = {{ of = \
             \"max({all}) - min({all})\", below = \"5 K\" }}\n"
        )
    };
    let looks = |start: f64| {
        let netlist = lptn_netlist::parse("alike.toml", &text(start)).unwrap();
        let system = ThermalSystem::assemble(&netlist.network).unwrap();
        let run = Transient::until(Time(600.0)).at(&[]).tolerance(1e-9);
        let run = Transient { integrator: IntegratorChoice::Cvode, ..run };
        let solution = run.solve(&system).unwrap();
        (solution.looks().placed, solution.statistics().steps, solution.limits()[0].margin)
    };
    let (alike, apart) = (looks(0.0), looks(0.5));
    assert!(alike.0 * apart.1 < 2 * apart.0 * alike.1, "{alike:?} {apart:?}");
    // the time constants 450 s and 455.5 s: 9.5 K (exp(-t/455.5 s) - exp(-t/450 s))
    let difference = |t: f64| 9.5 * ((-t / 455.5).exp() - (-t / 450.0).exp());
    let most = (0..6000).map(|k| difference(0.1 * f64::from(k))).fold(0.0, f64::max);
    near(alike.2, 5.0 - most, 1e-7);
}
