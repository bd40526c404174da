//! Gradients of steady states and runs, against closed forms of one body.

use lptn_netlist::parse;
use lptn_solve::Proceed;
use lptn_study::sweep::{Cases, SweepTask};
use lptn_study::{GradientError, Gradients};

const POWER: f64 = 40.0;
const CONDUCTANCE: f64 = 2.0;
const CAPACITY: f64 = 500.0;
const STOP: f64 = 1000.0;

/// One body in air of 25 degC, heated by P, cooled by G.
fn text(over: &str, reports: &str, more: &str) -> String {
    format!(
        "format = 1\n[param]\nP = \"40 W\"\nG = \"2 W/K\"\nt_on = \"100 s\"\n[node]\nblock = {{ C = \
         \"500 J/K\", T0 = \"25 degC\" }}\n[boundary]\nair = {{ T = \"25 degC\" }}\n[resistor]\n\
         cooling = {{ from = \"block\", to = \"air\", G = \"G\" }}\n[limit]\nwarm = {{ of = \
         \"block.T\", below = \"60 degC\" }}\n[run]\nstop = \"1000 s\"\ntolerance = \"1e-9 K\"\n\
         output = {{ every = \"20 s\" }}\n[sweep.grad]\nmethod = \"list\"\nover = \"{over}\"\naxes = {{ \
         P = [\"40 W\"], G = [\"2 W/K\"] }}\nreport = {{ {reports} }}\n{more}"
    )
}

const CONSTANT: &str = "[source]\nheat = { into = \"block\", P = \"P\" }\n";

fn gradients(text: &str, margins: bool) -> Result<Gradients, GradientError> {
    let netlist = parse("gradient.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let study = netlist.studies.sweeps[0].clone();
    let cases = Cases::new(study.plan(&netlist.network).unwrap());
    let task = SweepTask::new(netlist, study, cases).unwrap();
    let limits: Vec<_> = task.network().limit_ids().filter(|_| margins).collect();
    task.gradients(&[POWER, CONDUCTANCE], &limits, &|_| Proceed::Continue)
}

#[track_caller]
fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let size = expected.abs().max(0.1);
        assert!((found - expected).abs() <= 1e-8 * size, "{found:e} is not {expected:e}");
    }
}

/// T = T_air + P / G; the margin is 60 degC - T, the heat P.
#[test]
fn a_steady_state_has_its_closed_form() {
    let reports = "T = \"block.T\", Q = \"cooling.Q\", twice = \"P * kelvin(block.T)\"";
    let found = gradients(&text("steady", reports, CONSTANT), true).unwrap();
    let (by_p, by_g) = (1.0 / CONDUCTANCE, -POWER / CONDUCTANCE.powi(2));
    let t = 298.15 + POWER / CONDUCTANCE;
    near(&found.values, &[t, POWER, POWER * t, 333.15 - t]);
    near(&found.slopes[0], &[by_p, by_g]);
    near(&found.slopes[1], &[1.0, 0.0]);
    near(&found.slopes[2], &[t + POWER * by_p, POWER * by_g]);
    near(&found.slopes[3], &[-by_p, -by_g]);
}

/// With x = exp(-G t / C): T = T_air + P/G (1 - x), its mean T_air + P/G (1 - C / (G t) (1 - x)).
#[test]
fn a_run_has_its_closed_form() {
    let reports = "end = \"last(block.T)\", top = \"max(block.T)\", mean = \"mean(block.T)\", \
                   heat = \"integral(cooling.Q)\"";
    let found = gradients(&text("run", reports, CONSTANT), true).unwrap();
    let (p, g, c, t) = (POWER, CONDUCTANCE, CAPACITY, STOP);
    let x = (-g * t / c).exp();
    let rise = p / g * (1.0 - x);
    let by_g = -p / g.powi(2) * (1.0 - x) + p / g * x * t / c;
    let part = c / (g * t) * (1.0 - x);
    let part_by_g = -part / g + c / (g * t) * x * t / c;
    let mean = p / g * (1.0 - part);
    let mean_by_g = -p / g.powi(2) * (1.0 - part) - p / g * part_by_g;
    near(&found.values, &[298.15 + rise, 298.15 + rise, 298.15 + mean, g * t * mean, 35.0 - rise]);
    near(&found.slopes[0], &[rise / p, by_g]);
    near(&found.slopes[1], &[rise / p, by_g]);
    near(&found.slopes[2], &[mean / p, mean_by_g]);
    near(&found.slopes[3], &[g * t * mean / p, t * mean + g * t * mean_by_g]);
    near(&found.slopes[4], &[-rise / p, -by_g]);
}

/// Heated for 300 s: the maximum is there, T_air + P/G (1 - exp(-300 G / C)).
#[test]
fn a_maximum_inside_of_a_run_has_its_closed_form() {
    let source = "[source]\nheat = { into = \"block\", P = \"if(t < 300 [s], P, 0 [W])\" }\n";
    let found = gradients(&text("run", "top = \"max(block.T)\"", source), false).unwrap();
    let x = (-CONDUCTANCE * 300.0 / CAPACITY).exp();
    let rise = POWER / CONDUCTANCE * (1.0 - x);
    near(&found.values, &[298.15 + rise]);
    let by_g = -rise / CONDUCTANCE + POWER / CONDUCTANCE * x * 300.0 / CAPACITY;
    near(&found.slopes[0], &[rise / POWER, by_g]);
}

/// With P (1 - t / s), tau = C/G and a = P/G (1 + tau/s): T = T_air + a (1 - exp(-t/tau)) - P t / (s G),
/// largest at tau ln(a s G / (P tau)). A peak is flat, so that the run knows its moment only to the
/// root of the tolerance.
#[test]
fn a_smooth_peak_has_its_closed_form() {
    let falling = "[source]\nheat = { into = \"block\", P = \"P * (1 - t / 800 [s])\" }\n";
    let (p, s) = (POWER, 800.0);
    let of = |g: f64, t: f64| {
        let tau = CAPACITY / g;
        p / g * ((1.0 + tau / s) * (1.0 - (-t / tau).exp()) - t / s)
    };
    let tau = CAPACITY / CONDUCTANCE;
    let peak = tau * ((1.0 + tau / s) * s / tau).ln();
    let h = 1e-3;
    let side = |k: f64| of(CONDUCTANCE + k * h, peak) - of(CONDUCTANCE - k * h, peak);
    let by_g = (45.0 * side(1.0) - 9.0 * side(2.0) + side(3.0)) / (60.0 * h);
    let top = of(CONDUCTANCE, peak);
    for tolerance in ["1e-8 K", "1e-9 K", "1e-10 K", "1e-11 K"] {
        let text = text("run", "top = \"max(block.T)\"", falling).replace("1e-9 K", tolerance);
        let found = gradients(&text, true).unwrap();
        near(&found.values, &[298.15 + top, 35.0 - top]);
        near(&found.slopes[0], &[top / p, by_g]);
        near(&found.slopes[1], &[-top / p, -by_g]);
    }
}

/// A jump at a fixed time moves with no parameter: the integral of the power is 300 s P.
#[test]
fn an_integral_over_a_fixed_jump_is_exact() {
    let source = "[source]\nheat = { into = \"block\", P = \"if(t < 300 [s], P, 0 [W])\" }\n";
    let found = gradients(&text("run", "E = \"integral(heat.P)\"", source), false).unwrap();
    near(&found.values, &[300.0 * POWER]);
    near(&found.slopes[0], &[300.0, 0.0]);
}

#[test]
fn results_without_an_exact_gradient_are_refused() {
    let code = |over: &str, reports: &str, more: &str| {
        let error = gradients(&text(over, reports, more), false).unwrap_err();
        lptn_units::Problem::code(&error)
    };
    // max(T, T_0) bends at the steady state, which is 45 degC
    let bend = "T = \"max(block.T, 45 [degC])\"";
    assert_eq!(code("steady", bend, CONSTANT), "gradient::bends");
    let over = "T = \"time_over(block.T, 30 [degC])\"";
    assert_eq!(code("run", over, CONSTANT), "gradient::functional");
    let pipe = "[pipe]\nsupply = { from = \"air\", to = \"block\", mcp = \"1 W/K\", C = \"10 \
                J/K\", T0 = \"25 degC\" }\n[advection]\nout = { from = \"block\", to = \"air\", mcp = \"1 W/K\" }\n";
    assert_eq!(code("run", "T = \"last(block.T)\"", pipe), "gradient::differences");
}

/// The power is on from P seconds over 1 W on, and parameters move that time.
#[test]
fn a_jump_that_parameters_move_is_refused() {
    let source = "[source]\nheat = { into = \"block\", P = \"if(t < P * 1 [s/W], 0 [W], P)\" }\n";
    let error = gradients(&text("run", "E = \"integral(heat.P)\"", source), false).unwrap_err();
    let code = lptn_units::Problem::code(&error);
    assert!(["gradient::jumps", "gradient::differences"].contains(&code), "{code}");
}
