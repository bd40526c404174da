//! How much work runs take whose steps are guarded: as measured, with room. What guards them is
//! held to closed forms elsewhere; here it must not cost more, nor do less.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{Proceed, RunStatus, Solution, Transient};

/// A run of 1000 s of bodies of a netlist to 1e-5 K.
fn run(sections: &str) -> Solution {
    let text = format!(
        "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n{sections}\n[run]\nstop = \"1000 s\"\n"
    );
    let netlist = lptn_netlist::parse("work.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    Transient::until(Time(1000.0)).at(&[1000.0]).tolerance(1e-5).solve(&system).unwrap()
}

/// Holds the steps, evaluations, restarts and factorisations of a run to what was measured, and the
/// ends of bodies to tiny steps of their rates in K/s, both in degC.
fn takes<const N: usize>(
    sections: &str,
    rates: impl Fn([f64; N]) -> [f64; N],
    measured: [u64; 4],
) -> Solution {
    let solution = run(sections);
    let found = solution.statistics();
    let found = [found.steps, found.flow_evaluations, found.restarts, found.factorizations];
    println!("{found:?}");
    let mut exact = [20.0; N];
    for _ in 0..STEPS {
        let ahead = |by: [f64; N], part: f64| -> [f64; N] {
            std::array::from_fn(|i| exact[i] + part * 1000.0 / f64::from(STEPS) * by[i])
        };
        let a = rates(exact);
        let b = rates(ahead(a, 0.5));
        let c = rates(ahead(b, 0.5));
        let d = rates(ahead(c, 1.0));
        exact = ahead(std::array::from_fn(|i| a[i] + 2.0 * (b[i] + c[i]) + d[i]), 1.0 / 6.0);
    }
    for (node, exact) in solution.network().node_ids().zip(exact) {
        let kelvin = *solution.temperature(node).unwrap().last().unwrap();
        let off = (kelvin - 273.15 - exact).abs();
        assert!(off < 3e-4 * solution.growth(), "{} for {exact} degC", kelvin - 273.15);
    }
    // elementary functions differ in their last digits between builds, and steps with them
    for (found, measured) in found.into_iter().zip(measured) {
        assert!(found <= measured + measured / 10 + 2, "{found} for {measured}");
        assert!(5 * found + 10 >= measured, "{found} for {measured}");
    }
    solution
}

const STEPS: u32 = 400_000;

/// A body of 1 kJ/K with 1 mW/K to air and a heat.
fn heated(heat: &str) -> String {
    format!(
        "[node]\nbody = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", G = \
         \"1 mW/K\" }}\n[source]\nheat = {{ into = \"body\", P = \"{heat}\" }}\n"
    )
}

fn alone(heat: impl Fn(f64) -> f64) -> impl Fn([f64; 1]) -> [f64; 1] {
    move |[t]| [(heat(t) - 1e-3 * (t - 20.0)) / 1e3]
}

#[test]
fn a_bell_over_temperature_is_not_passed_and_costs_some_steps() {
    let bell = |t: f64, middle: f64, width: f64| (-((t - middle) / width).powi(2)).exp();
    let text = "100 [W] * (1 + exp(-((T - 60 [degC]) / 2 [K])^2))";
    takes(&heated(text), alone(|t| 100.0 * (1.0 + bell(t, 60.0, 2.0))), [203, 436, 0, 225]);
    let text = "100 [W] * (1 + exp(-((T - 70 [degC]) / 0.1 [K])^2))";
    takes(&heated(text), alone(|t| 100.0 * (1.0 + bell(t, 70.0, 0.1))), [137, 288, 0, 151]);
    let text = "100 [W] * (1 - 0.9 * exp(-((T - 40 [degC]) / 1 [K])^2) - 0.5 * exp(-((T - 80 [degC]) / 3 [K])^2))";
    let heat = |t: f64| 100.0 * (1.0 - 0.9 * bell(t, 40.0, 1.0) - 0.5 * bell(t, 80.0, 3.0));
    takes(&heated(text), alone(heat), [402, 839, 0, 425]);
}

#[test]
fn kinks_end_steps() {
    let text = "100 [W] - 2 [W/K] * max(T - 60 [degC], 0 [K])";
    takes(&heated(text), alone(|t| 100.0 - 2.0 * (t - 60.0).max(0.0)), [61, 127, 0, 71]);
    let text = "50 [W] + 2 [W/K] * abs(T - 45 [degC])";
    takes(&heated(text), alone(|t| 50.0 + 2.0 * (t - 45.0).abs()), [114, 247, 2, 124]);
    let text = "100 [W] - 1 [W/K] * min(abs(T - 50 [degC]), 20 [K])";
    takes(&heated(text), alone(|t| 100.0 - (t - 50.0).abs().min(20.0)), [134, 282, 2, 162]);
    // one that is borne
    let text = "100 [W] - 1e-3 [W/K] * max(T - 60 [degC], 0 [K])";
    takes(&heated(text), alone(|t| 100.0 - 1e-3 * (t - 60.0).max(0.0)), [28, 60, 1, 32]);
}

#[test]
fn a_table_over_temperature_is_met_at_its_knots() {
    let text = format!(
        "{}[table]\nf = {{ x = [0, 40, 41, 60, 200], x_unit = \"degC\", y = [1, 1, 0.3, 0.9, 0.2] }}\n",
        heated("100 [W] * f(T)")
    );
    let knots = [(0.0, 1.0), (40.0, 1.0), (41.0, 0.3), (60.0, 0.9), (200.0, 0.2)];
    let f = move |t: f64| {
        let place = knots.partition_point(|knot| knot.0 <= t).clamp(1, 4);
        let ((a, b), (c, d)) = (knots[place - 1], knots[place]);
        b + (d - b) * (t - a) / (c - a)
    };
    takes(&text, alone(move |t| 100.0 * f(t)), [192, 408, 3, 215]);
}

#[test]
fn a_band_switches_twice() {
    let text = "100 [W] - if(abs(T - 61 [degC]) < 0.5 [K], 60 [W], 0 [W])";
    let heat = |t: f64| if (t - 61.0_f64).abs() < 0.5 { 40.0 } else { 100.0 };
    takes(&heated(text), alone(heat), [42, 91, 2, 44]);
}

/// Two bodies, with a bell over the mean of both, over both, and a kink.
#[test]
fn several_temperatures_are_guarded_together() {
    let two = |g: &str, heat: &str| {
        format!(
            "[node]\nbody = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\nlid = {{ C = \"300 J/K\", T0 = \"20 degC\" \
             }}\n[resistor]\nskin = {{ from = \"lid\", to = \"air\", G = \"1 W/K\" }}\njoint = {{ from = \"body\", to = \
             \"lid\", G = \"{g}\" }}\n[source]\nheat = {{ into = \"body\", P = \"{heat}\" }}\n"
        )
    };
    let rates = |g: fn(f64, f64) -> f64, heat: fn(f64, f64) -> f64| {
        move |[a, b]: [f64; 2]| {
            let joint = g(a, b) * (a - b);
            [(heat(a, b) - joint) / 1e3, (joint - (b - 20.0)) / 300.0]
        }
    };
    let bell = "3 [W/K] * (1 + 2 * exp(-((T_mean - 50 [degC]) / 1 [K])^2))";
    let g = |a: f64, b: f64| 3.0 * (1.0 + 2.0 * (-(0.5 * (a + b) - 50.0).powi(2)).exp());
    takes(&two(bell, "100 [W]"), rates(g, |_, _| 100.0), [301, 634, 0, 317]);
    let heat = "100 [W] * (1 + exp(-(((T - 60 [degC]) + (lid.T - 40 [degC])) / 2 [K])^2))";
    let both = |a: f64, b: f64| 100.0 * (1.0 + (-((a - 60.0 + b - 40.0) / 2.0).powi(2)).exp());
    takes(&two("3 W/K", heat), rates(|_, _| 3.0, both), [2738, 2839, 0, 2744]);
    let kink = "3 [W/K] + 0.1 [W/K^2] * max(T_mean - 45 [degC], 0 [K])";
    let g = |a: f64, b: f64| 3.0 + 0.1 * (0.5 * (a + b) - 45.0).max(0.0);
    takes(&two(kink, "100 [W]"), rates(g, |_, _| 100.0), [128, 285, 1, 143]);
}

/// A heat that grows with temperature makes errors grow: the run is made anew to a tolerance that
/// makes up for it.
#[test]
fn errors_that_grow_are_made_up_for_by_smaller_steps() {
    let text = "5 [W] + 1.5 [W/K] * (T - 20 [degC])";
    let solution = takes(&heated(text), alone(|t| 5.0 + 1.5 * (t - 20.0)), [52, 113, 0, 57]);
    let grown = 1.499_f64.exp();
    assert!((solution.growth() / grown - 1.0).abs() < 0.02, "{} {grown}", solution.growth());
    assert!(solution.error_is_bounded());
    let text = "5 [W] + 6 [W/K] * (T - 20 [degC])";
    let solution = takes(&heated(text), alone(|t| 5.0 + 6.0 * (t - 20.0)), [225, 464, 0, 232]);
    assert!(solution.growth() > 300.0, "{}", solution.growth());
}

/// A kink that is met makes the integrator begin anew, one that nothing passes does not.
#[test]
fn the_integrator_begins_anew_behind_a_kink() {
    let restarts = |at: f64| {
        let text = format!(
            "50 [W] + 20 [W/K] * max(T - {at} [degC], 0 [K]) - 21 [W/K] * max(T - {at} [degC], 0 \
             [K])"
        );
        run(&heated(&text)).statistics().restarts
    };
    assert_eq!([restarts(45.0) > 0, restarts(90.0) > 0], [true, false]);
}

/// A shaft that stores next to nothing, in a hub that lets go: its kink is sharper than the times
/// of floating-point numbers. Steps that did not move the time began over and over, for minutes.
#[test]
fn steps_that_do_not_move_the_time_end() {
    let text = r#"format = 1
[node]
hub = { C = "176.28927879448378 J/K", T0 = "20 degC" }
shaft = { C = "1e-8 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
out = { from = "shaft", to = "air", R = "5.442078984803678 K/W" }
skin = { from = "hub", to = "air", R = "1.6977874238819841 K/W" }
[source]
heat = { into = "hub", P = "43.41202431958908 W" }
[press_fit.fit]
from = "hub"
to = "shaft"
diameter = "0.05411174549308492 m"
hub_diameter = "0.10822349098616985 m"
length = "0.02705587274654246 m"
interference = "0.00002517496749280824 m"
h_gap = "330.02477987304604 W/(m^2 K)"
alpha = ["2.3e-05 1/K", "1.15e-05 1/K"]
E = ["70 GPa", "210 GPa"]
poisson = [0.33, 0.3]
k = ["150 W/(m K)", "46 W/(m K)"]
slope = 0.1
roughness = "1 um"
hardness = "1.5 GPa"
[run]
stop = "1197.206882009998 s"
"#;
    let netlist = lptn_netlist::parse("work.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    for stop in [490.0, 1197.206882009998] {
        let run = Transient::until(Time(stop)).at(&[stop]).tolerance(1e-6);
        let mut steps = 0;
        let solution = run.solve_observed(&system, &mut |_| {
            steps += 1;
            if steps < 20_000 { Proceed::Continue } else { Proceed::Interrupt }
        });
        assert_eq!(solution.unwrap().end(), RunStatus::Reached, "{steps} steps to {stop} s");
    }
}
