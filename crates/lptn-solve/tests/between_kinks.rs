//! Comparisons of `abs`, `min` and `max` of linear functions of time switch at their exact times.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::Transient;

/// A body of 1 kJ/K with 2 W/K to air of its temperature, heated by `power`.
fn network(power: &str, more: &str) -> Network {
    let text = format!(
        "format = 1\n[boundary]\nair = {{ T = \"0 degC\" }}\n[node]\nbody = {{ C = \"1 kJ/K\", T0 = \
         \"0 degC\" }}\n{more}[resistor]\nskin = {{ from = \"body\", to = \"air\", G = \"2 W/K\" }}\n\
         [source]\nheat = {{ into = \"body\", P = \"{power}\" }}\n"
    );
    let netlist = lptn_netlist::parse("net.toml", &text).unwrap_or_else(|r| panic!("{r}\n{text}"));
    netlist.network
}

/// The rise in K at `t` after 100 W from `on` to `off`, all in s, by superposition.
fn rise(on: f64, off: f64, t: f64) -> f64 {
    let step = |from: f64| if t > from { 50.0 * (1.0 - (-(t - from) / 500.0).exp()) } else { 0.0 };
    step(on) - step(off)
}

fn holds(power: &str, more: &str, pulses: &[(f64, f64)]) {
    let network = network(power, more);
    let times = network.breakpoints(0.0, 1000.0).unwrap();
    for time in pulses.iter().flat_map(|(on, off)| [*on, *off]).filter(|t| (1.0..999.0).contains(t))
    {
        assert!(times.iter().any(|found| (found - time).abs() < 1e-9), "{power}: {times:?}");
    }
    let system = ThermalSystem::assemble(&network).unwrap();
    let settings = Transient::until(Time(1000.0)).every(Time(250.0)).tolerance(1e-7);
    let solution = settings.solve(&system).unwrap();
    let found = solution.temperature(network.node("body").unwrap()).unwrap();
    for (row, time) in solution.times().iter().enumerate() {
        let right: f64 = pulses.iter().map(|(on, off)| rise(*on, *off, *time)).sum();
        assert!(
            (found[row] - 273.15 - right).abs() < 1e-5,
            "{power}, {time}: {} {right}",
            found[row]
        );
    }
}

const HOUR: &str =
    "[signal]\nhour = { t = [\"0 s\", \"1000 s\"], v = [\"-180 deg\", \"180 deg\"] }\n";

/// Reference: the roots by hand, and the superposition of exponentials.
#[test]
fn absolute_values_and_extremes_of_the_time() {
    holds("if(abs(t - 500 [s]) < 200 [s], 100 [W], 0 [W])", "", &[(300.0, 700.0)]);
    holds("if(abs(t - 500 [s]) > 200 [s], 100 [W], 0 [W])", "", &[(0.0, 300.0), (700.0, 2e3)]);
    holds("if(min(t, 900 [s] - t) > 123 [s], 100 [W], 0 [W])", "", &[(123.0, 777.0)]);
    holds("if(max(t, 700 [s] - 2 * t) < 500 [s], 100 [W], 0 [W])", "", &[(100.0, 500.0)]);
}

/// `abs` inside `abs`: two pulses around 300 s and 700 s.
#[test]
fn absolute_values_inside_others() {
    let power = "if(abs(abs(t - 500 [s]) - 200 [s]) < 50 [s], 100 [W], 0 [W])";
    holds(power, "", &[(250.0, 350.0), (650.0, 750.0)]);
}

/// The hour angle of a surface as a signal of two points, by itself and as a named value.
#[test]
fn absolute_values_of_a_signal() {
    holds("if(abs(hour) < 90 [deg], 100 [W], 0 [W])", HOUR, &[(250.0, 750.0)]);
    holds("if(abs(hour - 18 [deg]) < 90 [deg], 100 [W], 0 [W])", HOUR, &[(300.0, 800.0)]);
    let named = format!("{HOUR}[value]\nangle = \"hour - 18 [deg]\"\n");
    holds("if(abs(angle) < 90 [deg], 100 [W], 0 [W])", &named, &[(300.0, 800.0)]);
}

/// Curves and products are refused as before.
#[test]
fn curves_inside_absolute_values_are_refused() {
    for power in ["if(abs(t^2) < 5 [s^2], 1 [W], 0 [W])", "if(t * abs(t) < 5 [s^2], 1 [W], 0 [W])"]
    {
        let text = format!(
            "format = 1\n[boundary]\nair = {{ T = \"0 degC\" }}\n[node]\nbody = {{ C = \"1 kJ/K\", T0 = \
             \"0 degC\" }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", G = \"2 W/K\" }}\n\
             [source]\nheat = {{ into = \"body\", P = \"{power}\" }}\n"
        );
        let refused = lptn_netlist::parse("net.toml", &text).expect_err(power);
        assert_eq!(refused.diagnostics[0].code, "network::comparison_not_linear", "{power}");
    }
}
