//! A result has the same value with its gradient as without, and its gradient is the difference of
//! runs, whatever the form of its quantity.

use lptn_netlist::parse;
use lptn_solve::Proceed;
use lptn_study::sweep::{Cases, SweepTask};

/// Steps of P and G as parts of themselves.
const STEP: f64 = 1e-3;

/// Quantities that jump, bend or have a pulse at times that the run ignores.
const QUANTITIES: [&str; 12] = [
    "block.T - air.T",
    "cooling.Q",
    "if(t < 310 [s], block.T - air.T, 0 [K])",
    "if(t < 310 [s], 2, 0.5) * cooling.Q",
    "if(abs(t - 500 [s]) < 60 [s], cooling.Q, 0 [W])",
    "if(t > 100 [s], if(t < 205 [s], cooling.Q, 0 [W]), 1 [W])",
    "if(duty > 0.5, block.T - air.T, 0 [K])",
    "if(ramp > 3, 1, 0.3) * (block.T - air.T)",
    "duty * cooling.Q",
    "pulse * (block.T - air.T)",
    "min(ramp, 4) * (block.T - air.T)",
    "logged * (block.T - air.T) + coupled * 1 [K]",
];

/// Quantities that bend with a temperature, which have a gradient at one moment, and one that is
/// flat at its least value.
const BENT: [&str; 3] =
    ["max(block.T - air.T, 10 [K])", "abs(shell.T - 30 [degC])", "((shell.T - air.T) / 10 [K])^6"];

const NETLIST: &str = r#"format = 1
[param]
P = "40 W"
G = "2 W/K"
[node]
block = { C = "500 J/K", T0 = "25 degC" }
shell = { C = "200 J/K", T0 = "25 degC" }
[boundary]
air = { T = "25 degC" }
[resistor]
joint = { from = "block", to = "shell", G = "5 W/K" }
cooling = { from = "shell", to = "air", G = "G" }
[source]
heat = { into = "block", P = "if(t < 700 [s], P, 0.2 * P)" }
[signal]
duty = { t = ["0 s", "300 s"], v = [1, 0], interp = "previous", after_end = "hold" }
ramp = { t = ["0 s", "1000 s"], v = [0, 10] }
pulse = { t = ["0 s", "499.9 s", "500 s", "500.1 s", "1000 s"], v = [0, 0, 1, 0, 0] }
logged = { t = ["0 s", "90 s", "211 s", "405 s", "610 s", "1000 s"], v = [1, 3, 2, 5, 1, 2] }
coupled = "if(ramp > 6, 1, 2) * logged"
[run]
stop = "1000 s"
tolerance = "1e-10 K"
[sweep.grad]
method = "list"
over = "run"
"#;

fn task(functional: &str, quantities: &[&str]) -> SweepTask {
    let report = |(place, of): (usize, &&str)| format!("r{place} = \"{functional}({of})\"");
    let reports: Vec<String> = quantities.iter().enumerate().map(report).collect();
    let around = |own: f64, at: [f64; 5], unit: &str| {
        at.map(|steps| format!("\"{} {unit}\"", own * (1.0 + STEP * steps))).join(", ")
    };
    let [p, g] = [[0.0, 1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, -1.0]];
    let text = format!(
        "{NETLIST}axes = {{ P = [{}], G = [{}] }}\nreport = {{ {} }}\n",
        around(40.0, p, "W"),
        around(2.0, g, "W/K"),
        reports.join(", ")
    );
    let netlist = parse("gradient.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let study = netlist.studies.sweeps[0].clone();
    let cases = Cases::new(study.plan(&netlist.network).unwrap());
    SweepTask::new(netlist, study, cases).unwrap()
}

/// Differences over 1e-3 of a parameter err by 1e-6 of themselves; extremes move a little too.
#[test]
fn a_result_has_the_same_value_with_its_gradient_and_the_slope_of_runs() {
    for functional in ["mean", "integral", "last", "max", "min"] {
        let bent = match functional {
            "last" | "max" => &BENT[..],
            "min" => &BENT[..1],
            _ => &BENT[2..],
        };
        let quantities = [&QUANTITIES, bent].concat();
        let task = task(functional, &quantities);
        let runs: Vec<Vec<f64>> = (0..5)
            .map(|case| task.candidate(case, &|| Proceed::Continue).unwrap().reports)
            .collect();
        let every = (quantities.len(), &[][..]);
        let found = task.gradients(&[40.0, 2.0], every, &|_| Proceed::Continue);
        let found = found.unwrap_or_else(|error| panic!("{functional}: {error}"));
        for (place, quantity) in quantities.iter().enumerate() {
            let (value, own) = (found.values[place], runs[0][place]);
            let name = format!("{functional}({quantity})");
            assert!((value - own).abs() <= 1e-7 * own.abs() + 1e-8, "{name}: {value} {own}");
            for (k, parameter) in [40.0, 2.0].into_iter().enumerate() {
                let [above, below] = [1, 2].map(|side| runs[2 * k + side][place]);
                let by = (above - below) / (2.0 * STEP * parameter);
                let slope = found.slopes[place][k];
                let size = by.abs().max(1e-4 * own.abs() / parameter);
                assert!((slope - by).abs() <= 1e-5 * size + 1e-7, "{name}: {slope} {by}");
            }
        }
    }
}

/// The least value of a quantity that is zero in a bend, and the integral of one.
#[test]
fn a_bend_has_no_gradient() {
    for (functional, quantity) in [("min", BENT[1]), ("mean", BENT[0]), ("integral", BENT[1])] {
        let task = task(functional, &[quantity]);
        let found = task.gradients(&[40.0, 2.0], (1, &[]), &|_| Proceed::Continue);
        let code = lptn_units::Problem::code(&found.unwrap_err());
        assert_eq!(code, "gradient::bends", "{functional}({quantity})");
    }
}
