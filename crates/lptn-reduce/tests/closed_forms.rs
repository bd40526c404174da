//! The two-node gearbox: every number from the 2 x 2 eigenproblem written out here.
#![allow(clippy::unwrap_used, reason = "the helpers are part of the tests")]

use crate::common;

use common::{assembled, near, two_nodes};
use lptn_analysis::RunAnalysis;
use lptn_network::{HeatCapacity, HeatFlow, NetworkBuilder, NodeId, Resistance, Temperature, Time};
use lptn_reduce::{
    Definition, Judge, LeastSquaresWindow, ReduceError, Reduction, ReductionOptions,
};

/// Printed values: capacity, half of its last digit, error in %, half of its last digit. Source:
/// the numbers that the reduction was asked to reach, found with numpy and scipy.
type Printed = [[f64; 4]; 4];

/// The step response `R - r_1 exp(-t/tau_1) - r_2 exp(-t/tau_2)` at node s of C_s -R_int- C_a
/// -R_amb- ground.
struct Exact {
    resistance: f64,
    tau: [f64; 2],
    r: [f64; 2],
    c: [f64; 2],
    r_amb: f64,
}

impl Exact {
    fn new(c: [f64; 2], r_int: f64, r_amb: f64) -> Self {
        // symmetric form of C^-1/2 G C^-1/2
        let (g_i, g_o) = (1.0 / r_int, 1.0 / r_amb);
        let (a, b, d) = (g_i / c[0], -g_i / f64::sqrt(c[0] * c[1]), (g_i + g_o) / c[1]);
        let fast = 0.5 * (a + d) + f64::hypot(0.5 * (a - d), b);
        let rates = [(a * d - b * b) / fast, fast];
        let share = rates.map(|rate| b * b / (b * b + (rate - a) * (rate - a)) / c[0]);
        Self {
            resistance: r_int + r_amb,
            tau: rates.map(f64::recip),
            r: [share[0] / rates[0], share[1] / rates[1]],
            c,
            r_amb,
        }
    }

    fn step(&self, t: f64) -> f64 {
        self.resistance
            - self.r[0] * (-t / self.tau[0]).exp()
            - self.r[1] * (-t / self.tau[1]).exp()
    }

    /// The largest error of `C_eq = capacity` by brute force: size over `R_eq`, and when.
    fn error(&self, capacity: f64) -> (f64, f64) {
        let tau = self.resistance * capacity;
        let times = (0..400_000).map(|k| 1e-2 * 10_f64.powf(f64::from(k) / 66_000.0));
        let error = |t: f64| (self.step(t) / self.resistance + f64::exp_m1(-t / tau)).abs();
        times
            .map(|t| (error(t), t))
            .fold((0.0, 0.0), |best, next| if next.0 > best.0 { next } else { best })
    }

    /// Least squares by Simpson's rule and a ternary search: nothing of the library's closed forms.
    fn least_squares(&self, window: f64) -> f64 {
        let cost = |capacity: f64| {
            let tau = self.resistance * capacity;
            let n = 20_000;
            let value = |k: i32| {
                let t = window * f64::from(k) / f64::from(n);
                (self.step(t) + self.resistance * f64::exp_m1(-t / tau)).powi(2)
            };
            let weight = |k: i32| if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
            (0..=n).map(|k| weight(k) * value(k)).sum::<f64>()
        };
        let (mut a, mut b) = (0.3 * self.c[0], 1.5 * (self.c[0] + self.c[1]));
        for _ in 0..60 {
            let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if cost(x) < cost(y) { b = y } else { a = x }
        }
        0.5 * (a + b)
    }

    fn capacities(&self, window: f64) -> [f64; 4] {
        let ratio = self.r_amb / self.resistance;
        [
            self.c[0] + self.c[1],
            self.c[0] + self.c[1] * ratio * ratio,
            self.tau[0] / self.resistance,
            self.least_squares(window),
        ]
    }
}

fn check(r_int: f64, r_amb: f64, printed_tau: [f64; 2], printed: Printed) {
    let c = [1000.0, 1659.0];
    let exact = Exact::new(c, r_int, r_amb);
    assert!(
        (exact.tau[0] - printed_tau[0]).abs() < 5e-3
            && (exact.tau[1] - printed_tau[1]).abs() < 5e-3
    );
    let (system, [steel, _]) = two_nodes(c, r_int, r_amb, 220.6);
    let run = RunAnalysis::until(Time(1500.0));
    let judge = Judge::Run;
    let options = ReductionOptions { run: Some(run), judge, ..Default::default() };
    let reduction = Reduction::new(&system, steel, &options).unwrap();
    near(reduction.norton.resistance, r_int + r_amb, 1e-14);
    near(reduction.norton.boundary_weights[0], 1.0, 1e-14);
    let dynamics = reduction.dynamics.unwrap();
    near(dynamics.step.as_ref().unwrap().slowest().tau, exact.tau[0], 1e-12);
    near(dynamics.step.as_ref().unwrap().terms[1].tau, exact.tau[1], 1e-10);
    near(dynamics.step.as_ref().unwrap().terms[1].resistance, exact.r[1], 1e-8);
    assert_eq!(dynamics.window, Some(LeastSquaresWindow::Run(1500.0)));
    for ((pair, capacity), printed) in
        dynamics.pairs.iter().zip(exact.capacities(1500.0)).zip(printed)
    {
        let tight = if pair.definition == Definition::LeastSquares { 1e-6 } else { 1e-11 };
        near(pair.capacity, capacity, tight);
        let [printed_capacity, its_half_digit, printed_error, half_digit] = printed;
        assert!((pair.capacity - printed_capacity).abs() <= its_half_digit, "{pair:?}");
        let (error, time) = exact.error(pair.capacity);
        near(pair.step.unwrap().relative.unwrap(), error, 1e-7);
        assert!(
            (pair.step.unwrap().relative.unwrap() * 100.0 - printed_error).abs() <= half_digit,
            "{pair:?}"
        );
        near(pair.step.unwrap().time, time, 1e-3);
        // the run is a step of 220.6 W from rest, cut off at 1500 s: the same error times 220.6 W,
        // in K
        let run = pair.run.unwrap();
        near(run.kelvin, error * (r_int + r_amb) * 220.6, 1e-4);
        near(run.relative.unwrap(), error * (r_int + r_amb) / exact.step(1500.0), 1e-4);
    }
}

#[test]
fn nearly_one_node() {
    let tau_1_over_r =
        Exact::new([1000.0, 1659.0], 1.7 / 220.6, 65.5 / 220.6).tau[0] / (67.2 / 220.6);
    let printed = [
        [2659.0, 1e-9, 1.25, 0.005],
        [2576.12, 0.005, 0.91, 0.005],
        [tau_1_over_r, 1e-8, 0.94, 0.005],
        [2570.40, 0.005, 0.905, 0.0005],
    ];
    check(1.7 / 220.6, 65.5 / 220.6, [792.42, 4.79], printed);
}

#[test]
fn clearly_two_nodes() {
    let tau_1_over_r = Exact::new([1000.0, 1659.0], 0.1, 0.3).tau[0] / 0.4;
    let printed = [
        [2659.0, 1e-9, 12.1, 0.05],
        [1933.2, 0.05, 5.1, 0.05],
        [tau_1_over_r, 1e-8, 6.3, 0.05],
        [1885.22, 0.005, 4.757, 0.0005],
    ];
    check(0.1, 0.3, [838.33, 59.37], printed);
}

#[test]
fn the_pair_with_the_smallest_error_is_recommended() {
    let (system, [steel, _]) = two_nodes([1000.0, 1659.0], 0.1, 0.3, 220.6);
    let with_run =
        ReductionOptions { run: Some(RunAnalysis::until(Time(1500.0))), ..Default::default() };
    for options in [with_run, ReductionOptions::default()] {
        for judge in Judge::ALL {
            let by = if options.run.is_some() { judge } else { Judge::Step };
            let options = ReductionOptions { judge, ..options.clone() };
            let reduction = Reduction::new(&system, steel, &options).unwrap();
            let recommended = reduction.dynamics.unwrap().recommended;
            assert_eq!(
                (recommended.definition, recommended.by),
                (Definition::LeastSquares, Some(by))
            );
        }
    }
}

#[test]
fn one_node_is_its_own_equivalent_by_all_definitions() {
    let (system, nodes) = common::chain(&[2659.0], &[3.25]);
    let options = ReductionOptions {
        run: Some(RunAnalysis::until(Time(900.0))),
        window: Some(400.0),
        ..Default::default()
    };
    let dynamics = Reduction::new(&system, nodes[0], &options).unwrap().dynamics.unwrap();
    for pair in &dynamics.pairs {
        near(pair.capacity, 2659.0, 1e-12);
        assert!(pair.step.unwrap().relative.unwrap() < 1e-12, "{pair:?}");
        assert!(pair.run.unwrap().kelvin < 1e-9 && pair.run.unwrap().relative.is_none());
    }
    assert_eq!(dynamics.recommended.definition, Definition::Sum);
}

/// A pulse into a light port: temperatures have a kink where it ends, and a parabola through rows
/// on both sides of it would promise an error that is nowhere. By superposition the error is that
/// of the step, less the same later.
#[test]
fn the_error_of_a_pulse_is_not_that_of_a_parabola_over_its_end() {
    let (c, r_int, r_amb, ambient) = ([1.0, 1000.0], 0.1, 0.3, Temperature::celsius(25.5));
    let exact = Exact::new(c, r_int, r_amb);
    let mut b = NetworkBuilder::new();
    let pulse = b.expression("if(t < 300 [s], 100 [W], 0 [W])", None).unwrap();
    let [port, wall] =
        [("port", c[0]), ("wall", c[1])].map(|(n, c)| b.node(n, HeatCapacity(c), ambient));
    let air = b.boundary("air", ambient);
    b.resistor("inner", port, wall, Resistance(r_int));
    b.resistor("outer", wall, air, Resistance(r_amb));
    b.source("heat", port, pulse);
    let options =
        ReductionOptions { run: Some(RunAnalysis::until(Time(600.0))), ..Default::default() };
    let dynamics = Reduction::new(&assembled(b), port, &options).unwrap().dynamics.unwrap();
    for pair in &dynamics.pairs {
        let tau = exact.resistance * pair.capacity;
        let miss = |t: f64| {
            if t > 0.0 { exact.step(t) + exact.resistance * (-t / tau).exp_m1() } else { 0.0 }
        };
        let error = |t: f64| 100.0 * (miss(t) - miss(t - 300.0)).abs();
        let after = (0..200_000).map(|k| 1e-4 * 10_f64.powf(f64::from(k) / 30_000.0));
        let times = after.flat_map(|t| [t.min(600.0), 300.0 + t.min(300.0)]).chain([300.0]);
        let (expected, _) =
            times.map(|t| (error(t), t)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        near(pair.run.unwrap().kelvin, expected, 1e-5);
    }
    near(dynamics.rise.unwrap(), 100.0 * exact.step(300.0), 1e-6);
}

/// A ramp into a massless port that ends at once: the error is largest just before the end, where
/// the port leaps. Port and node behind it: `s R_int + s R_amb (t - tau (1 - exp(-t/tau)))` at a
/// slope of s, the same without R_int for the one-node network.
#[test]
fn the_error_of_a_leaping_port_is_largest_just_before_it_leaps() {
    let (c, r_int, r_amb, slope, zero) = (1000.0, 0.5, 0.5, 2.0, Temperature::celsius(0.0));
    let mut b = NetworkBuilder::new();
    let ramp = b.expression("if(t < 50 [s], 2 [W/s] * t, 0 [W])", None).unwrap();
    let (port, wall, air) =
        (b.massless("port"), b.node("wall", HeatCapacity(c), zero), b.boundary("air", zero));
    b.resistor("inner", port, wall, Resistance(r_int));
    b.resistor("outer", wall, air, Resistance(r_amb));
    b.source("heat", port, ramp);
    let options =
        ReductionOptions { run: Some(RunAnalysis::until(Time(100.0))), ..Default::default() };
    let reduction = Reduction::new(&assembled(b), port, &options).unwrap();
    let rise = |r: f64, tau: f64, t: f64| slope * r * (t + tau * (-t / tau).exp_m1());
    // the fourth is so small a capacity that the one-node network errs by more after the leap
    for pair in &reduction.dynamics.as_ref().unwrap().pairs[..3] {
        let tau = (r_int + r_amb) * pair.capacity;
        let port = |t: f64| slope * r_int * t + rise(r_amb, r_amb * c, t);
        let error = |t: f64| (port(t) - rise(r_int + r_amb, tau, t)).abs();
        let run = pair.run.unwrap();
        near(run.kelvin, error(50.0), 1e-6);
        near(run.relative.unwrap(), error(50.0) / port(50.0), 1e-6);
        near(run.time, 50.0, 1e-8);
    }
}

/// Nine tenths of the rise come at once: of all capacities none at all is nearest, and its error is
/// the last tenth.
#[test]
fn a_massless_port_may_be_best_without_capacity() {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let (port, wall, air) =
        (b.massless("port"), b.node("wall", HeatCapacity(1000.0), zero), b.boundary("air", zero));
    b.resistor("inner", port, wall, Resistance(0.9));
    b.resistor("outer", wall, air, Resistance(0.1));
    b.source("heat", port, lptn_network::HeatFlow(50.0));
    let system = assembled(b);
    let options =
        ReductionOptions { run: Some(RunAnalysis::until(Time(1000.0))), ..Default::default() };
    let reduction = Reduction::new(&system, port, &options).unwrap();
    let dynamics = reduction.dynamics.as_ref().unwrap();
    let pair = dynamics.pair(Definition::LeastSquares).unwrap();
    assert!(pair.capacity.abs() < f64::MIN_POSITIVE);
    near(pair.step.unwrap().kelvin, 0.1, 1e-9);
    near(pair.run.unwrap().kelvin, 5.0, 1e-6);
    let by_step = Reduction::new(
        &system,
        port,
        &ReductionOptions { window: Some(1000.0), ..Default::default() },
    )
    .unwrap();
    assert_eq!(by_step.dynamics.unwrap().recommended.definition, Definition::LeastSquares);
    let one = reduction.network(&system, 0.0, Some(pair)).unwrap();
    assert!(one.nodes()[0].massless);
    // with a capacity the one-node network misses what comes at once
    near(dynamics.pair(Definition::Sum).unwrap().step.unwrap().kelvin, 0.9, 1e-9);
}

/// Regression: any node without a path to a boundary was a `reduce::no_ground`, however far from
/// the port. The numbers are those of the two nodes alone; 3 loose nodes are solved by dense, 43 by
/// sparse factors.
#[test]
fn islands_without_ground_do_not_matter_to_a_port_that_has_one() {
    for loose in [3_usize, 43] {
        let (c, r_int, r_amb) = ([1000.0, 1659.0], 0.1, 0.3);
        let zero = Temperature::celsius(0.0);
        let mut b = NetworkBuilder::new();
        let chain: Vec<NodeId> =
            (0..loose).map(|i| b.node(&format!("n{i}"), HeatCapacity(50.0), zero)).collect();
        let steel = b.node("steel", HeatCapacity(c[0]), zero);
        let aluminium = b.node("aluminium", HeatCapacity(c[1]), zero);
        let alone = b.node("alone", HeatCapacity(7.0), zero);
        let junction = b.massless("junction");
        let bed = b.boundary("bed", zero);
        b.resistor("internal", steel, aluminium, Resistance(r_int));
        b.resistor("outer", aluminium, bed, Resistance(r_amb));
        b.resistor("end", chain[0], junction, Resistance(3.0));
        for (i, pair) in chain.windows(2).enumerate() {
            b.resistor(&format!("r{i}"), pair[0], pair[1], Resistance(0.2));
        }
        b.source("P_disp", steel, HeatFlow(220.6));
        b.source("elsewhere", chain[1], HeatFlow(1000.0));
        let system = common::assembled(b);
        let run = Some(RunAnalysis::until(Time(1500.0)));
        let options = ReductionOptions { run, judge: Judge::Run, ..Default::default() };
        let reduction = Reduction::new(&system, steel, &options).unwrap();
        near(reduction.norton.resistance, r_int + r_amb, 1e-14);
        near(reduction.inputs.heat, 220.6, 1e-14);
        assert_eq!(reduction.norton.response.iter().filter(|rise| **rise > 0.0).count(), 2);
        let exact = Exact::new(c, r_int, r_amb);
        let dynamics = reduction.dynamics.unwrap();
        for (pair, capacity) in dynamics.pairs.iter().zip(exact.capacities(1500.0)) {
            let tight = if pair.definition == Definition::LeastSquares { 1e-6 } else { 1e-11 };
            near(pair.capacity, capacity, tight);
            near(
                pair.run.unwrap().kelvin,
                exact.error(pair.capacity).0 * (r_int + r_amb) * 220.6,
                1e-4,
            );
        }
        for port in [chain[0], junction, alone] {
            let error = Reduction::new(&system, port, &options).unwrap_err();
            let ReduceError::NoGround { names } = error else { panic!("{error:?}") };
            assert!(
                !names.contains(&"steel".to_owned()) && (port == alone) == (names == ["alone"]),
                "{names:?}"
            );
        }
    }
}

/// As asked for; as long as the run where the run judges; else five of the slowest time constants,
/// 2659 J/K over 3.25 W/K, whatever the run is.
#[test]
fn the_window_is_that_of_the_question() {
    let (system, nodes) = common::chain(&[2659.0], &[3.25]);
    let window = |run: Option<RunAnalysis>, window: Option<f64>, judge: Judge| {
        let options = ReductionOptions { run, window, judge, ..Default::default() };
        let reduction = Reduction::new(&system, nodes[0], &options).unwrap();
        reduction.dynamics.unwrap().window.unwrap()
    };
    let run = Some(RunAnalysis::until(Time(1500.0)).lasting(400.0, 1500.0));
    assert_eq!(window(run.clone(), None, Judge::Run), LeastSquaresWindow::Run(1100.0));
    assert_eq!(window(run.clone(), Some(30.0), Judge::Run), LeastSquaresWindow::Given(30.0));
    for found in [window(None, None, Judge::Run), window(run, None, Judge::Step)] {
        let LeastSquaresWindow::TimeConstants(length) = found else { panic!("{found:?}") };
        near(length, 5.0 * 2659.0 / 3.25, 1e-12);
    }
}

#[test]
fn a_window_must_be_a_time() {
    let (system, nodes) = common::chain(&[1.0], &[1.0]);
    for window in [0.0, -1.0, f64::NAN] {
        let error = Reduction::new(
            &system,
            nodes[0],
            &ReductionOptions { window: Some(window), ..Default::default() },
        )
        .unwrap_err();
        assert_eq!(error.code(), "reduce::window");
    }
}
