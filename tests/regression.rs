//! One test for each fixed mistake.

use crate::support;

use lptn::prelude::*;
use lptn_network::{Area, ConductorKind, Context, Path};
use lptn_solve::{RunStatus, TransientError, Watch};
use support::assembled;

/// The ledger of a run that broke off held no heat of sources and boundaries at all.
#[test]
fn ledger_of_a_broken_run_holds_what_was_done() {
    let mut b = NetworkBuilder::new();
    let node = b.node("mass", HeatCapacity(100.0), Temperature::celsius(20.0));
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("path", node, air, Conductance(1.0));
    let heat = b.expression("1 [W/s^0.5] * (300 [s] - t)^0.5", None).unwrap();
    b.source("fading", node, heat);
    let error = Transient::until(Time(400.0)).every(Time(10.0)).solve(&assembled(b)).unwrap_err();
    let TransientError::Stopped { time, partial, .. } = error else { panic!("{error}") };
    assert!(time > 250.0 && time <= 300.0, "stopped at {time} s");
    assert_eq!(partial.end(), RunStatus::Failed(time));
    let ledger = partial.ledger();
    let exact = (300_f64.powf(1.5) - (300.0 - time).powf(1.5)) * 2.0 / 3.0;
    assert!(
        (ledger.sources[0] - exact).abs() < 1e-3 * exact,
        "{} J of {exact} J",
        ledger.sources[0]
    );
    assert!(ledger.relative_residual().unwrap().abs() < 1e-8);
}

/// Watches of a network without state kept the temperature of the start as peak and end.
#[test]
fn watches_of_a_network_without_state_see_peak_and_end() {
    let mut b = NetworkBuilder::new();
    let middle = b.massless("middle");
    let swing = b.expression("20 [degC] + 10 [K] * sin(2 * pi * t / 100 [s])", None).unwrap();
    let (left, right) =
        (b.boundary("left", swing), b.boundary("right", Temperature::celsius(20.0)));
    b.resistor("a", left, middle, Conductance(1.0));
    b.resistor("b", middle, right, Conductance(1.0));
    let mut run = Transient::until(Time(60.0)).every(Time(10.0));
    run.watch = vec![Watch { node: middle, level: Some(273.15 + 22.0) }];
    let seen = run.solve(&assembled(b)).unwrap().watched()[0];
    let omega = std::f64::consts::PI / 50.0;
    assert!((seen.peak.0 - 298.15).abs() < 1e-3 && (seen.peak.1 - 25.0).abs() < 0.1, "{seen:?}");
    assert!((seen.last() - 293.15 - 5.0 * (omega * 60.0).sin()).abs() < 1e-9);
    assert!((seen.crossed.unwrap() - 0.4_f64.asin() / omega).abs() < 0.01);
}

/// A massless node that leaps at a jump of its source crosses its level at that time, not before.
#[test]
fn a_leap_over_a_level_has_the_time_of_the_jump() {
    let mut b = NetworkBuilder::new();
    let sink = b.node("sink", HeatCapacity(1000.0), Temperature::celsius(20.0));
    let junction = b.massless("junction");
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("package", junction, sink, Resistance(1.0));
    b.resistor("fins", sink, air, Resistance(1.0));
    let step = b.expression("if(t < 100 [s], 0 [W], 30 [W])", None).unwrap();
    b.source("step", junction, step);
    let mut run = Transient::until(Time(200.0)).every(Time(50.0));
    run.watch = vec![Watch { node: junction, level: Some(273.15 + 40.0) }];
    let seen = run.solve(&assembled(b)).unwrap().watched()[0];
    assert!((seen.crossed.unwrap() - 100.0).abs() < 1e-9, "{seen:?}");
}

fn one_node(capacity: f64, conductance: f64, heat: &str) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let node = b.node("mass", HeatCapacity(capacity), Temperature(300.0));
    let air = b.boundary("air", Temperature(300.0));
    b.resistor("path", node, air, Conductance(conductance));
    let heat = b.expression(heat, None).expect("it compiles");
    b.source("heat", node, heat);
    assembled(b)
}

/// Steps grew over quiet stretches and jumped over what came after them, and the ledger closed all
/// the same.
#[test]
fn pulses_of_smooth_inputs_are_not_jumped_over() {
    let day = 86_400.0;
    // each row: heat, stop, exact heat put in: half waves of a sine carry 2/w, a triangle half its
    // base, a Gauss curve sqrt(pi) of its width
    let sun = 200.0 * day / std::f64::consts::PI;
    let cases = [
        ("200 [W] * max(0, sin(2*pi*t/86400 [s]))", 10.0 * day, 10.0 * sun),
        ("200 [W] * max(0, -cos(2*pi*t/86400 [s]))", 10.0 * day, 10.0 * sun),
        ("500 [W] * max(0, sin(2*pi*(t - 6 [h])/24 [h]))", 3.0 * day, 3.0 * 2.5 * sun),
        ("100 [W] * max(0, 1-abs(t-1800 [s])/60 [s])", 3600.0, 6000.0),
        (
            "1000 [W] * exp(-((t-1800 [s])/30 [s])^2)",
            3600.0,
            30_000.0 * std::f64::consts::PI.sqrt(),
        ),
        ("400 [W] * max(0,1-abs(t-40000 [s])/600 [s])", day, 240_000.0),
        ("60 [W]*sin(pi*t/10[s])^20", 36_000.0, 60.0 * 36_000.0 * 0.176_197_052_001_953_12),
    ];
    for (heat, stop, exact) in cases {
        let solution = Transient::until(Time(stop)).solve(&one_node(500.0, 5.0, heat)).unwrap();
        let found = solution.ledger().sources[0];
        assert!((found - exact).abs() < 2e-3 * exact, "{heat}: {found} J of {exact} J");
    }
}

/// A row at the time of a jump held the values before it when the two times differed by rounding.
#[test]
fn rows_at_a_jump_hold_the_values_after_it() {
    for minutes in 1..25 {
        let heat = format!("if(t < {minutes} [min], 100 [W], 0 [W])");
        let system = one_node(500.0, 5.0, &heat);
        let solution =
            Transient::until(Time::minutes(25.0)).every(Time::minutes(1.0)).solve(&system).unwrap();
        let heat = solution.source_heat(system.network().source_ids().next().unwrap());
        let expected: Vec<f64> = (0..=25).map(|k| if k < minutes { 100.0 } else { 0.0 }).collect();
        assert_eq!(heat, expected, "jump at {minutes} min");
    }
}

/// A conductance of 1e-5 W/K beside one of 1e9 W/K was rounded away on the diagonal of the matrix.
#[test]
fn steady_state_keeps_small_conductances_beside_large_ones() {
    for (large, small, heat) in
        [(1e6, 1e-3, 1.0), (1e8, 1e-5, 1e-2), (1e9, 1e-4, 1e-1), (1e9, 1e-5, 1e-3)]
    {
        let mut b = NetworkBuilder::new();
        let zero = Temperature(300.0);
        let (hot, cold) =
            (b.node("a", HeatCapacity(1.0), zero), b.node("b", HeatCapacity(1.0), zero));
        let air = b.boundary("air", zero);
        b.resistor("large", hot, cold, Conductance(large));
        b.resistor("small", cold, air, Conductance(small));
        b.source("heat", hot, HeatFlow(heat));
        let steady = SteadyState::solve(&assembled(b), 0.0).unwrap();
        let rise = steady.temperatures[cold.index()] - 300.0;
        assert!((rise - heat / small).abs() < 1e-9 * heat / small, "{large}, {small}: {rise} K");
        assert!((steady.boundary_heat[0] + heat).abs() < 1e-9 * heat, "{large}, {small}");
    }
}

/// Massless nodes behind large conductances opened the books, and a hub of many boundaries had no
/// steady state.
#[test]
fn massless_nodes_do_not_open_the_books() {
    for large in [1e3, 1e7, 1e9] {
        let mut b = NetworkBuilder::new();
        let node = b.node("node", HeatCapacity(50.0), Temperature(300.0));
        let (junction, air) = (b.massless("junction"), b.boundary("air", Temperature(300.0)));
        b.resistor("small", node, junction, Conductance(1.0));
        b.resistor("large", junction, air, Conductance(large));
        b.source("heat", node, HeatFlow(1.0));
        let solution = Transient::until(Time(500.0)).tolerance(1e-7).solve(&assembled(b)).unwrap();
        let residual = solution.ledger().relative_residual().unwrap();
        assert!(residual.abs() < 1e-11, "{large}: {residual:e}");
    }
    let mut b = NetworkBuilder::new();
    let hub = b.massless("hub");
    for i in 0..1000 {
        let boundary = b.boundary(&format!("b{i}"), Temperature(300.0));
        b.resistor(&format!("r{i}"), hub, boundary, Conductance(1.0));
    }
    let steady = SteadyState::solve(&assembled(b), 0.0).unwrap();
    assert_eq!(steady.temperatures[0].to_bits(), 300.0_f64.to_bits());
}

/// A step written as `if(t > 0 [s], ..)` was not there yet in the steady state at the start.
#[test]
fn steady_state_at_the_start_sees_a_step_that_begins_there() {
    let system = one_node(500.0, 5.0, "if(t > 0 [s], 100 [W], 0 [W])");
    assert!((SteadyState::solve(&system, 0.0).unwrap().temperatures[0] - 320.0).abs() < 1e-9);
}

/// Temperatures below 0 K were given as results.
#[test]
fn nothing_is_colder_than_absolute_zero() {
    let system = one_node(500.0, 5.0, "-5000 [W]");
    assert_eq!(SteadyState::solve(&system, 0.0).unwrap_err().code(), "solve::below_absolute_zero");
    let error = Transient::until(Time(1000.0)).solve(&system).unwrap_err();
    assert_eq!(error.code(), "solve::below_absolute_zero");
}

/// The peak was that of a parabola through coarse points: at tight tolerances it erred by many of
/// them.
#[test]
fn peaks_are_as_accurate_as_rows() {
    let mut b = NetworkBuilder::new();
    let hot = b.node("hot", HeatCapacity(100.0), Temperature(400.0));
    let cold = b.node("cold", HeatCapacity(300.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(300.0));
    b.resistor("joint", hot, cold, Conductance(2.0));
    b.resistor("skin", cold, air, Conductance(1.0));
    let system = assembled(b);
    // T_cold = 300 + a (exp(-p t) - exp(-q t)) with p, q the roots of s^2 - 0.03 s + 2/30000 and
    // a = 100 x 2/300 / (q - p); its top is at ln(q/p)/(q - p)
    let (sum, product) = (0.02 + 0.01, 2.0 / 30_000.0_f64);
    let q = 0.5 * (sum + f64::sqrt(sum * sum - 4.0 * product));
    let p = product / q;
    let time = (q / p).ln() / (q - p);
    let peak = 300.0 + 100.0 * 2.0 / 300.0 / (q - p) * ((-p * time).exp() - (-q * time).exp());
    for tolerance in [1e-5, 1e-6, 1e-7] {
        let mut run = Transient::until(Time(600.0)).at(&[]).tolerance(tolerance);
        run.watch = vec![Watch { node: cold, level: None }];
        let seen = run.solve(&system).unwrap().watched()[0];
        assert!(
            (seen.peak.0 - peak).abs() < 10.0 * tolerance,
            "{tolerance:e}: {:e} K",
            seen.peak.0 - peak
        );
    }
}

/// Parameters of one network were applied to another by their position.
#[test]
fn parameters_of_another_network_are_refused() {
    let one = support::shipped("gearbox.toml").0.network;
    let other = support::shipped("gearbox_speed.toml").0.network;
    assert_eq!(
        one.with(&other.overrides()).unwrap_err().0[0].code(),
        "network::foreign_parameters"
    );
}

/// An id of another builder made an index out of range.
#[test]
fn ends_of_another_builder_are_refused() {
    let mut other = NetworkBuilder::new();
    other.massless("a");
    let foreign = other.massless("b");
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(1.0), Temperature(300.0));
    b.resistor("path", node, foreign, Conductance(1.0));
    assert_eq!(b.build().unwrap_err().0[0].code(), "network::foreign_id");
}

/// More temperatures than memory holds ended the process.
#[test]
fn a_run_that_does_not_fit_in_memory_is_refused() {
    let system = support::grid(60, 1.0, (1, 1));
    let error = Transient::until(Time(1e6)).every(Time(0.2)).solve(&system).unwrap_err();
    assert_eq!(error.code(), "run::settings");
}

/// The promise of ten tolerances was given to networks that remember a thousand periods of what
/// drives them.
#[test]
fn a_very_long_memory_makes_no_promise() {
    let heat = "1000 [W] * sin(2 * pi * t / 100 [s])";
    let run = Transient::until(Time(1e5)).every(Time(100.0)).tolerance(1e-3);
    let long = run.solve(&one_node(1000.0, 0.01, heat)).unwrap();
    assert!(!long.error_is_bounded());
    assert!(run.solve(&one_node(1000.0, 1.0, heat)).unwrap().error_is_bounded());
}

/// A network of two boundaries and the paths between them was refused as empty; what passes is its
/// answer.
#[test]
fn two_boundaries_and_a_path_are_a_network() {
    let mut b = NetworkBuilder::new();
    let (hot, cold) =
        (b.boundary("hot", Temperature(400.0)), b.boundary("cold", Temperature(300.0)));
    b.resistor("path", hot, cold, Conductance(2.0));
    let system = assembled(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    assert_eq!(
        (steady.conductor_heat.as_slice(), steady.temperatures.len()),
        ([200.0].as_slice(), 0)
    );
    assert_eq!(steady.boundary_heat, [200.0, -200.0]);
    let run = Transient::until(Time(60.0)).every(Time(10.0)).solve(&system).unwrap();
    assert_eq!(run.boundary_heat(hot), Some(vec![200.0; 7]));
    assert!((run.ledger().boundaries[0] - 12_000.0).abs() < 1e-8 && run.ledger().closes());
    let nothing = NetworkBuilder::new().build().unwrap_err();
    assert_eq!(nothing.0[0].code(), "network::empty");
}

/// Without any source a network that is not linear was "unbalanced": what Newton's method left was
/// all its heat.
#[test]
fn networks_that_come_to_rest_have_a_steady_state() {
    for ambient in [0.0, 300.0] {
        let mut b = NetworkBuilder::new();
        let [bright, still] =
            ["bright", "still"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(400.0)));
        let space = b.boundary("space", Temperature(ambient));
        let area = Path::radiation(Area(0.04));
        b.conductor("glow", ConductorKind::Radiation, (bright.into(), space.into()), area);
        let film =
            b.expression_in(Context::Link, "0.35 [W/K] * abs(dT / 1 [K])^0.25", None).unwrap();
        b.resistor("film", still, space, Path::conductance(film));
        let steady = SteadyState::solve(&assembled(b), 0.0).unwrap();
        // heat that grows with the fourth power is gone within Newton's last digit, 1e-9 K, times
        // that power
        let off = steady.temperatures.iter().map(|t| (t - ambient).abs()).fold(0.0, f64::max);
        assert!(off < 1e-8, "{ambient} K: {:?}", steady.temperatures);
    }
}

/// How a run breaks off that leaves the range of a law: its time, its message and its steps.
fn edge_of(conductance: &str) -> (f64, String, u64) {
    let text = format!(
        "format = 1\n[boundary]\nroom = {{ T = \"20 degC\" }}\n\
         [table]\ng = {{ x = [0, 40], y = [1, 1], x_unit = \"K\", y_unit = \"W/K\" }}\n\
         [node]\nmass = {{ T0 = \"20 degC\", C = \"1 kJ/K\" }}\n\
         [resistor]\npath = {{ from = \"mass\", to = \"room\", G = \"{conductance}\" }}\n\
         [source]\nheat = {{ into = \"mass\", P = \"100 W\" }}\n"
    );
    let netlist = lptn::parse("edge.toml", &text).expect("it reads");
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    let error = Transient::until(Time(3600.0))
        .every(Time(100.0))
        .solve(&system)
        .expect_err("it breaks off");
    assert_eq!(error.code(), "solve::input", "{error}");
    let message = error.to_string();
    let TransientError::Stopped { time, partial, .. } = error else { panic!("{message}") };
    assert!(partial.times().len() >= 5, "{:?}", partial.times());
    (time, message, partial.statistics().steps)
}

/// A run that left a table shrank its steps ten million times and then blamed the integrator.
#[test]
fn a_run_that_leaves_a_table_stops_there_and_names_it() {
    let (time, message, steps) = edge_of("g(dT)");
    // 100 K (1 - exp(-t / 1000 s)) = 40 K
    let end = -1000.0 * 0.6_f64.ln();
    assert!((time - end).abs() < 1e-3, "stopped at {time} s, not at {end} s");
    assert!(message.contains("`G` of `path`") && message.contains("table `g`"), "{message}");
    assert!(steps < 10_000, "{steps} steps");
}

/// So did one whose conductance became negative.
#[test]
fn a_run_whose_conductance_becomes_negative_stops_there_and_names_it() {
    let (time, message, steps) = edge_of("1 [W/K] + 0 [1/K] * g(0 [K]) * dT - 20 [mW/K^2] * dT");
    // 1000 dx/dt = 100 - x + 0.02 x^2 up to x = 50 K
    let root = (4.0 * 0.02 * 100.0 - 1.0_f64).sqrt();
    let end = 1000.0 * 2.0 / root * 2.0 * (1.0 / root).atan();
    assert!((time - end).abs() < 1e-3, "stopped at {time} s, not at {end} s");
    assert!(message.contains("`G` of `path` makes a negative conductance"), "{message}");
    assert!(steps < 10_000, "{steps} steps");
}

/// The time constants that `check` prints left out streams: a sump that oil follows in seconds took
/// minutes.
#[test]
fn time_constants_of_nodes_count_the_streams_into_them() {
    let mut b = NetworkBuilder::new();
    let sump = b.node("sump", HeatCapacity(3000.0), Temperature::celsius(40.0));
    let tank = b.node("tank", HeatCapacity(800.0), Temperature::celsius(40.0));
    let cooler = b.boundary("cooler", Temperature::celsius(40.0));
    b.conductor("feed", ConductorKind::Advection, (cooler.into(), sump.into()), rate(90.0));
    b.conductor("back", ConductorKind::Advection, (tank.into(), sump.into()), rate(-90.0));
    b.resistor("skin", sump, cooler, Conductance(10.0));
    b.resistor("foot", tank, cooler, Conductance(10.0));
    let stiffness = lptn_solve::Stiffness::of(&b.build().unwrap()).unwrap();
    assert_eq!((stiffness.slowest.0, stiffness.fastest.0), (sump, tank));
    assert!(
        (stiffness.slowest.1 - 30.0).abs() < 1e-12 && (stiffness.fastest.1 - 8.0).abs() < 1e-12
    );
}

fn rate(value: f64) -> Path {
    Path::stream(Conductance(value))
}

/// Two materials with tables of cp shared one curve, the first: the text that calls a table was the
/// same for both. Each node takes 1 kJ: 2 K at 500 J/K, 1 K at 1000 J/K.
#[test]
fn tables_of_two_materials_are_two() {
    let (netlist, system) = support::parsed(
        "format = 1\n[material]\n\
         a = { cp = { x = [0, 100], y = [500, 500], x_unit = \"degC\", y_unit = \"J/(kg K)\" } }\n\
         b = { cp = { x = [0, 100], y = [1000, 1000], x_unit = \"degC\", y_unit = \"J/(kg K)\" } \
         }\n[node]\n\
         a = { material = \"a\", mass = \"1 kg\", T0 = \"20 degC\" }\n\
         b = { material = \"b\", mass = \"1 kg\", T0 = \"20 degC\" }\n[source]\n\
         heat_a = { into = \"a\", P = \"10 W\" }\nheat_b = { into = \"b\", P = \"10 W\" \
         }\n[run]\nstop = \"100 s\"\n",
    );
    let solution = support::transient(&netlist).solve(&system).unwrap();
    let last = solution.row(solution.times().len() - 1);
    support::close(last[0], 295.15, 1e-6);
    support::close(last[1], 294.15, 1e-6);
}

/// `at` and `stop` that are the same time in two units gave two rows at the end, or were refused.
#[test]
fn a_row_at_the_stop_in_another_unit_is_the_stop() {
    for (stop, at) in [("1.0161111111111112 h", "3658 s"), ("3658 s", "1.0161111111111112 h")] {
        let text = format!(
            "format = 1\n[node]\na = {{ C = \"1 J/K\", T0 = \"20 degC\" }}\n[run]\nstop \
             = \"{stop}\"\n\
             output = {{ at = [\"100 s\", \"{at}\"] }}\n"
        );
        let (netlist, _) = support::parsed(&text);
        assert_eq!(support::transient(&netlist).rows().unwrap().len(), 3, "{text}");
    }
}

/// A product with a coefficient of 0 that stands before a temperature was taken without end, and
/// the stack overflowed. 5 W over 2 W/K are 2.5 K.
#[test]
fn a_coefficient_of_zero_is_a_number_like_any_other() {
    let (_, steady) = support::settled(
        "format = 1\n[param]\nk = \"0 W/K\"\n[node]\na = { C = \"800 J/K\", T0 = \"100 degC\" }\n\
         [boundary]\nroom = { T = \"20 degC\" }\n[resistor]\n\
         wall = { from = \"a\", to = \"room\", G = \"2 [W/K] + k * (abs(dT) / 1 [K])^(1/4)\" }\n\
         [source]\np = { into = \"a\", P = \"5 W\" }\n",
    );
    support::close(steady.temperatures[0], 295.65, 1e-9);
}
