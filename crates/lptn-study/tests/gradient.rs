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
    task.gradients(&[POWER, CONDUCTANCE], (task.study().reports.len(), &limits), &|_| {
        Proceed::Continue
    })
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

/// Rise of the block over the air in K after a time in s, and its derivatives by P and G.
fn rise(time: f64) -> [f64; 3] {
    let x = (-CONDUCTANCE * time / CAPACITY).exp();
    let own = POWER / CONDUCTANCE * (1.0 - x);
    [own, own / POWER, -own / CONDUCTANCE + POWER / CONDUCTANCE * x * time / CAPACITY]
}

/// A quantity that compares the time, or reads a signal that drives nothing, jumps and bends at
/// times that the run ignores. With k = G/C, the integral of the rise until t is P/G (t - (1 - exp(-k t))/k).
#[test]
fn a_quantity_has_jumps_and_bends_of_its_own() {
    let duty = "duty = { t = [\"0 s\", \"300 s\"], v = [1, 0], interp = \"previous\", after_end = \"hold\" }\n";
    let pulse = "pulse = { t = [\"0 s\", \"499.95 s\", \"500 s\", \"500.05 s\", \"1000 s\"], v = [0, 0, \
                 1, 0, 0] }\n";
    let more = format!("{CONSTANT}[signal]\n{duty}{pulse}");
    let reports = "half = \"integral(if(t < 300 [s], block.T - air.T, 0 [K]))\", \
                   driven = \"integral(duty * (block.T - air.T))\", \
                   switched = \"integral(if(duty > 0.5, block.T - air.T, 0 [K]))\", \
                   short = \"integral(pulse * cooling.Q)\", \
                   end = \"last(if(t > 900 [s], 1, 2) * (block.T - air.T))\", \
                   top = \"max(if(t < 200 [s], 1, 0.1) * (block.T - air.T))\"";
    let found = gradients(&text("run", reports, &more), true).unwrap();
    let (p, g, c) = (POWER, CONDUCTANCE, CAPACITY);
    let (k, t) = (g / c, 300.0);
    let x = (-k * t).exp();
    let half = p / g * (t - (1.0 - x) / k);
    let half = [half, half / p, -half / g + p / g * ((1.0 - x) / (k * g) - t * x / g)];
    // a triangle of half width h times exp(-k t) has the integral h (1 + (k h)^2 / 12) exp(-k 500)
    let (h, x) = (0.05, (-k * 500.0).exp());
    let w = h * (1.0 + (k * h).powi(2) / 12.0);
    let short = p * h - p * x * w;
    let short = [short, short / p, p * x * (500.0 * w - h.powi(3) * k / 6.0) / c];
    let expected = [half, half, half, short, rise(STOP), rise(200.0)];
    for (place, [value, by_p, by_g]) in expected.into_iter().enumerate() {
        near(&found.values[place..=place], &[value]);
        near(&found.slopes[place], &[by_p, by_g]);
    }
}

/// The same without capacities: a resistance carries the power, which rises with time.
#[test]
fn a_network_without_capacities_has_jumps_of_its_results_too() {
    let text = text("run", "half = \"integral(if(t < 300 [s], block.T - air.T, 0 [K]))\"", "")
        .replace("C = \"500 J/K\", T0 = \"25 degC\"", "massless = true")
        + "[source]\nheat = { into = \"block\", P = \"P * t / 1000 [s]\" }\n";
    let found = gradients(&text, false).unwrap();
    let half = POWER / CONDUCTANCE * 300.0 * 300.0 / 2000.0;
    near(&found.values, &[half]);
    near(&found.slopes[0], &[half / POWER, -half / CONDUCTANCE]);
}

/// Values and derivatives at many times of one run.
#[test]
fn a_record_has_its_closed_form() {
    let reports = "r = \"last(block.T - air.T)\", h = \"last(if(t < 300 [s], 2, 1) * cooling.Q)\"";
    let netlist = parse("gradient.toml", &text("run", reports, CONSTANT)).unwrap();
    let study = netlist.studies.sweeps[0].clone();
    let cases = Cases::new(study.plan(&netlist.network).unwrap());
    let task = SweepTask::new(netlist, study, cases).unwrap();
    let series = |times: &[f64]| {
        task.gradient_series(&[POWER, CONDUCTANCE], (2, times), &|_| Proceed::Continue)
    };
    let times = [0.0, 7.5, 299.0, 300.0, 301.0, 1000.0];
    let found = series(&times).unwrap();
    for (row, time) in times.into_iter().enumerate() {
        let [value, by_p, by_g] = rise(time);
        let at = |one: &lptn_study::GradientSeries| {
            [one.values[row], one.slopes[0][row], one.slopes[1][row]]
        };
        near(&at(&found[0]), &[value, by_p, by_g]);
        let factor = CONDUCTANCE * if time < 300.0 { 2.0 } else { 1.0 };
        let heat = [factor * value, factor * by_p, factor * (by_g + value / CONDUCTANCE)];
        near(&at(&found[1]), &heat);
    }
    let code = lptn_units::Problem::code(&series(&[1200.0]).unwrap_err());
    assert_eq!(code, "gradient::outside");
}

#[test]
fn a_comparison_that_temperatures_or_parameters_move_is_refused() {
    let code = |report: &str| {
        let error = gradients(&text("run", report, CONSTANT), false).unwrap_err();
        lptn_units::Problem::code(&error)
    };
    for functional in ["mean", "integral", "max", "min"] {
        for quantity in [
            "if(block.T > 35 [degC], 1, 0)",
            "if(cooling.Q > 10 [W], 1, 0)",
            "if(t < P * 1 [s/W], block.T - air.T, 0 [K])",
        ] {
            let report = format!("r = \"{functional}({quantity})\"");
            assert_eq!(code(&report), "gradient::moving_jump", "{report}");
        }
    }
    let report = "r = \"last(if(block.T > 35 [degC], 2, 1) * (block.T - air.T))\"";
    let found = gradients(&text("run", report, CONSTANT), false).unwrap();
    near(&found.slopes[0], &rise(STOP).map(|x| 2.0 * x)[1..]);
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
