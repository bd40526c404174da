//! Switches that the error of a run decides, against closed forms.
//!
//! A body of 100 J/K with 1 W/K to 20 degC and 10 W rises as `T = 30 - 10 exp(-t/100 s)` in degC.
//! `fan` switches a heat of 5 W into a part of 10 J/K: a change of rates of 0.5 K/s. A quantity that
//! switches is accurate to a tenth of the tolerance.

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{Solution, Transient, Unbounded, Undecided};

const TOLERANCE: f64 = 1e-5;

/// The run of a fan that starts at this temperature in degC and of a body under this power.
fn run(threshold: f64, power: &str) -> Solution {
    let text = format!(
        r#"format = 1
[node]
body = {{ C = "100 J/K", T0 = "20 degC" }}
part = {{ C = "10 J/K", T0 = "20 degC" }}
[boundary]
air = {{ T = "20 degC" }}
[resistor]
skin = {{ from = "body", to = "air", R = "1 K/W" }}
edge = {{ from = "part", to = "air", R = "1 K/W" }}
[control]
fan = {{ sense = "body", on_above = "{threshold} degC", off_below = "15 degC" }}
[source]
heat = {{ into = "body", P = "{power}" }}
fan_heat = {{ into = "part", P = "5 [W] * fan" }}
"#
    );
    let read = lptn_netlist::parse("net.toml", &text).unwrap();
    let system = ThermalSystem::assemble(&read.network).unwrap();
    Transient::until(Time(7200.0)).tolerance(TOLERANCE).solve(&system).unwrap()
}

fn undecided(solution: &Solution) -> Option<Undecided> {
    match solution.why_unbounded() {
        Some(Unbounded::Switch(undecided)) => Some(undecided),
        None => None,
        Some(other) => panic!("{other:?}"),
    }
}

/// The time in s at which the body is this far below 30 degC.
fn time_of(below: f64) -> f64 {
    100.0 * (10.0 / below).ln()
}

#[test]
fn a_threshold_that_is_the_steady_state_is_not_determined() {
    let solution = run(30.0, "10 W");
    let found = undecided(&solution).unwrap();
    assert!(!found.switches && found.to > 7199.999, "{found:?}");
    let from = time_of(0.1 * TOLERANCE);
    assert!((found.from - from).abs() < 0.01 * from, "{found:?}, not {from}");
    // 5 W into 10 J/K, from then on
    assert!((found.error / (0.5 * (7200.0 - found.from)) - 1.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_switch_below_the_steady_state_is_as_uncertain_as_the_approach_is_slow() {
    for below in [1e-5, 1e-3, 1e-2] {
        let solution = run(30.0 - below, "10 W");
        let found = undecided(&solution).unwrap();
        let (from, to) = (time_of(below + 0.1 * TOLERANCE), time_of(below));
        assert!(found.switches, "{found:?}");
        // the error of the body moves the switch within the stay
        assert!((found.to - to).abs() <= to - from, "{found:?}, not {to}");
        let error = 0.5 * (to - from);
        assert!((found.error / error - 1.0).abs() < 0.2, "{found:?}, not {error}");
    }
}

#[test]
fn a_quick_switch_and_a_threshold_out_of_reach_are_determined() {
    for threshold in [22.0, 29.0, 29.9, 30.0001, 31.0] {
        assert_eq!(undecided(&run(threshold, "10 W")), None, "{threshold}");
    }
}

/// Under 10 W sin(t/100 s) the body's rise is 5 K (sin x - cos x + exp(-x)), x = t/100 s, whose
/// highest value is at the zero of cos x + sin x - exp(-x).
#[test]
fn a_peak_that_just_touches_the_threshold_is_not_determined() {
    let (mut low, mut high) = (1.0_f64, 3.0_f64);
    for _ in 0..60 {
        let x = 0.5 * (low + high);
        if x.cos() + x.sin() - (-x).exp() > 0.0 { low = x } else { high = x }
    }
    // later peaks are 5 sqrt(2) K, lower than the first
    let highest = 20.0 + 5.0 * (low.sin() - low.cos() + (-low).exp());
    let power = "10 [W] * sin(t / 100 [s] * 1 [rad])";
    let found = undecided(&run(highest + 2e-7, power)).unwrap();
    assert!(!found.switches && found.from < 100.0 * low && 100.0 * low < found.to, "{found:?}");
    for off in [-1e-2, 1e-4, 1e-2] {
        assert_eq!(undecided(&run(highest + off, power)), None, "{off}");
    }
}
