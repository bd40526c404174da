//! Limits in steady state and in runs, against closed forms written out here.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn::prelude::*;

fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{found} is not {exact} within {within:e}");
}

fn solved(text: &str, transient: &Transient) -> lptn::solve::Solution {
    let netlist = lptn::netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}"));
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
    let netlist = lptn::netlist::parse("net.toml", text).unwrap();
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
