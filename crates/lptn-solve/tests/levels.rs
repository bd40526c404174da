//! For how long a quantity is above zero, however often it passes zero within a step, against
//! closed forms.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::PI;

use lptn_assembly::ThermalSystem;
use lptn_netlist::parse;
use lptn_solve::{ColumnSeen, Selection, Transient, Window};

/// Time constant of the body in s.
const TAU: f64 = 500.0;

/// Length of the run in s.
const STOP: f64 = 1000.0;

/// A body from 20 degC towards 100 degC, and what was seen of an expression over its run.
fn seen(expression: &str, tolerance: f64) -> ColumnSeen {
    let text = format!(
        "format = 1\n[node]\nbody = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \
         \"20 degC\" }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", R = \"0.5 K/W\" \
         }}\n[source]\nheat = {{ into = \"body\", P = \"160 W\" }}\n[run]\nstop = \"1000 s\"\nreport = {{ over = \"{expression}\" }}\n"
    );
    let netlist = parse("levels.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let network = &netlist.network;
    let of = Selection::matching(network, &["over".to_owned()]).unwrap();
    let window = Window { name: "run".into(), from: 0.0, to: STOP, of };
    let run = Transient::until(lptn_network::Time(STOP)).at(&[]).tolerance(tolerance);
    let system = ThermalSystem::assemble(network).unwrap();
    let solution = run.window(window).solve(&system).unwrap();
    solution.windows()[0].columns[0].clone()
}

/// When the body has a temperature in degC, in s.
fn reaches(celsius: f64) -> f64 {
    -TAU * ((100.0 - celsius) / 80.0).ln()
}

fn near(seen: &ColumnSeen, expected: f64, error: f64) {
    assert!((seen.positive - expected).abs() < error, "{} s for {expected} s", seen.positive);
}

#[test]
fn what_passes_zero_many_times_in_a_step() {
    let share = (PI - 2.0 * 0.9_f64.asin()) / (2.0 * PI);
    let found = seen("sin(2 * pi * t / 8 [s]) - 0.9", 1e-3);
    near(&found, STOP * share, 1e-3);
    let below = seen("0.9 - sin(2 * pi * t / 8 [s])", 1e-3);
    near(&below, STOP * (1.0 - share), 1e-3);
}

#[test]
fn a_narrow_top_between_two_steps() {
    for (middle, half) in [(60.0, 2.0), (30.0, 0.2), (80.0, 0.05), (45.0, 0.005)] {
        let text = format!("{} - ((body.T - {middle} [degC]) / 1 [K])^2", half * half);
        let expected = reaches(middle + half) - reaches(middle - half);
        near(&seen(&text, 1e-4), expected, 1e-2);
        let hole = format!("((body.T - {middle} [degC]) / 1 [K])^2 - {}", half * half);
        near(&seen(&hole, 1e-4), STOP - expected, 1e-2);
    }
}

#[test]
fn a_kink_between_two_steps() {
    for (middle, half) in [(60.0, 2.0), (30.0, 0.2), (80.0, 0.05)] {
        let expected = reaches(middle + half) - reaches(middle - half);
        let text = format!("{half} [K] - abs(body.T - {middle} [degC])");
        near(&seen(&text, 1e-4), expected, 1e-2);
        let text = format!("abs(body.T - {middle} [degC]) - {half} [K]");
        near(&seen(&text, 1e-4), STOP - expected, 1e-2);
    }
}

#[test]
fn what_begins_or_ends_at_zero_is_where_its_neighbours_are() {
    near(&seen("body.T - 20 [degC]", 1e-5), STOP, 1e-6);
    near(&seen("20 [degC] - body.T", 1e-5), 0.0, 1e-6);
    near(&seen("(1000 [s] - t) / 1 [s]", 1e-5), STOP, 1e-6);
    near(&seen("(t - 1000 [s]) / 1 [s]", 1e-5), 0.0, 1e-6);
}

#[test]
fn what_never_passes_zero() {
    near(&seen("2 + sin(2 * pi * t / 8 [s])", 1e-5), STOP, 1e-9);
    near(&seen("-2 - sin(2 * pi * t / 8 [s])", 1e-5), 0.0, 1e-9);
}

#[test]
fn a_mean_is_open_if_it_may_be_off_by_more_than_a_millionth() {
    let mut column = seen("body.T - 20 [degC]", 1e-5);
    assert!(column.open < 1e-9 && !column.is_open());
    for (open, is_open) in [(9e-7, false), (1e-6, false), (1.1e-6, true), (1.0, true)] {
        column.open = open;
        assert_eq!(column.is_open(), is_open, "{open}");
    }
}

/// A bell far narrower than the steps: the largest value of a column is its top.
#[test]
fn a_bell_between_two_steps_is_the_largest_value() {
    for width in [1.0, 0.01, 1e-4] {
        let column = seen(&format!("exp(-((body.T - 60 [degC]) / {width:?} [K])^2)"), 1e-4);
        assert!((column.max.0 - 1.0).abs() < 1e-6, "{width}: {:?}", column.max);
        assert!((column.max.1 - reaches(60.0)).abs() < 1e-2, "{width}: {:?}", column.max);
    }
}
