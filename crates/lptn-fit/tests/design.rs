//! Planned measurements of one body against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::design::{Design, DesignTask, design};
use lptn_netlist::{Netlist, parse};
use lptn_solve::Proceed;

/// 220.6 W, 0.3 K/W and 2659 J/K: 797.7 s.
const R: f64 = 0.3;
const TAU: f64 = 0.3 * 2659.0;
const EVERY: f64 = 5.0;
const NOISE: f64 = 0.1;

fn body(sensors: &str, plan: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nP = \"220.6 W\"\nR = \"0.3 K/W\"\nC = \"2659 J/K\"\n\
         [node]\nbody = {{ C = \"C\", T0 = \"25 degC\" }}\n\
         [boundary]\nroom = {{ T = \"25 degC\" }}\n\
         [resistor]\nskin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n\
         [source]\nheat = {{ into = \"body\", P = \"P\" }}\n{sensors}\n\
         [plan.next]\nevery = \"5 s\"\nduration = \"30 min\"\nnoise = \"0.1 K\"\n{plan}\n"
    );
    parse("body.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn planned(netlist: &Netlist) -> Design {
    let study = &netlist.studies.plans[0];
    let task = DesignTask::of(netlist, study, (2, &|_, _| Proceed::Continue)).unwrap();
    design(&task, &|_, _| Proceed::Continue).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} is not {expected}");
}

/// dT/dP of every row of so many.
fn by_power(rows: usize) -> Vec<f64> {
    (0..rows).map(|k| R * -f64::exp_m1(-EVERY * k as f64 / TAU)).collect()
}

#[test]
fn analytic_error_of_a_power_is_that_of_the_sum_of_squares() {
    let netlist = body("", "know = { P = \"0.001 W\" }\nplace = { ring = { of = \"body.T\" } }");
    let design = planned(&netlist);
    let error =
        |rows: usize| NOISE / by_power(rows).iter().map(|slope| slope * slope).sum::<f64>().sqrt();
    for (seconds, errors) in design.curve.iter().take_while(|(seconds, _)| *seconds <= 1800.0) {
        let rows = (seconds / EVERY).round() as usize + 1;
        near(errors[0], error(rows), 1e-9);
    }
    let plan = design.plan.unwrap();
    assert!(!plan.reached);
    near(plan.errors[0], error(361) / 8.0_f64.sqrt(), 1e-9);
    assert_eq!(plan.runs, vec![(0, 361); 8]);
    assert_eq!(design.never.map(|never| never.told), None);
}

/// The shortest time is exact to a sample.
#[test]
fn the_shortest_time_is_the_first_row_that_reaches_the_target() {
    let netlist = body("", "know = { P = \"0.1 %\" }\nplace = { ring = { of = \"body.T\" } }");
    let plan = planned(&netlist).plan.unwrap();
    let squares: Vec<f64> = by_power(361)
        .iter()
        .scan(0.0, |sum, slope| {
            *sum += slope * slope;
            Some(*sum)
        })
        .collect();
    let wanted = (NOISE / 0.2206_f64).powi(2);
    let rows = squares.iter().position(|sum| *sum >= wanted).unwrap() + 1;
    assert_eq!(plan.runs, vec![(0, rows)]);
    assert!(plan.reached);
}

/// A power and an offset of 0 ± 1.7 K. However long the run is, the steady temperature tells their
/// sum R P + offset alone; what separates them is the rise, in which the derivative along that
/// sum is -R exp(-t / tau), and the `±`.
#[test]
fn analytic_limit_beside_an_offset() {
    let netlist = body(
        "[sensor]\ntc = { offset = \"0 ± 1.7 K\" }",
        "know = { P = \"0.001 W\" }\nplace = { ring = { of = \"body.T\", sensor = \"tc\" } }",
    );
    let design = planned(&netlist);
    let plan = design.plan.unwrap();
    let squares = 1.0 / -f64::exp_m1(-2.0 * EVERY / TAU);
    let runs = plan.runs.len() as f64;
    let told = runs * squares / NOISE.powi(2) + 1.7_f64.powi(-2);
    near(plan.limits.unwrap()[0], 1.0 / (R * told.sqrt()), 2e-3);
    // one run of the table, by the normal equations of two unknowns
    let slopes = by_power(361);
    let sum = |of: &dyn Fn(f64) -> f64| slopes.iter().map(|s| of(*s)).sum::<f64>() / NOISE.powi(2);
    let (aa, ab, bb) = (sum(&|s| s * s), sum(&|s| s), sum(&|_| 1.0) + 1.7_f64.powi(-2));
    near(design.next[0].errors[0], (bb / (aa * bb - ab * ab)).sqrt(), 1e-9);
    near(design.next[0].errors[1], (aa / (aa * bb - ab * ab)).sqrt(), 1e-9);
}

/// Least squares weighs correlated values as independent ones; its variance is
/// x^T Omega x / (x^T x)^2.
#[test]
fn analytic_error_with_a_drift() {
    let netlist = body(
        "",
        "know = { P = \"0.001 W\" }\ndrift = \"0.05 K\"\ndrift_time = \"2 min\"\n\
         place = { ring = { of = \"body.T\" } }",
    );
    let (slopes, mut form) = (by_power(361), 0.0);
    for (i, a) in slopes.iter().enumerate() {
        for (j, b) in slopes.iter().enumerate() {
            let apart = EVERY * i.abs_diff(j) as f64;
            let white = if i == j { NOISE * NOISE } else { 0.0 };
            form += a * b * (white + 0.0025 * f64::exp(-apart / 120.0));
        }
    }
    let squares: f64 = slopes.iter().map(|s| s * s).sum();
    near(planned(&netlist).next[0].errors[0], form.sqrt() / squares, 1e-9);
}

/// Of one body and the record of one step P, R and C are not determined, however long.
#[test]
fn what_no_record_tells_is_named() {
    let netlist = body(
        "",
        "know = { P = \"5 %\" }\nvary = [\"R\", \"C\"]\nplace = { ring = { of = \"body.T\" } }",
    );
    let design = planned(&netlist);
    let never = design.never.unwrap();
    assert_eq!((never.told.rank, never.told.unseparated.len()), (2, 1));
    let determined = never.told.unseparated[0].determined.as_ref().unwrap();
    assert_eq!(determined[0].terms, [(0, 1), (1, 1)]);
    assert!(design.plan.is_none());
}

/// A `±` of R makes P known to the same part of it, and no longer record helps.
#[test]
fn what_is_known_beforehand_is_a_limit() {
    let mut text = body("", "know = { P = \"5 %\" }\nplace = { r = { of = \"body.T\" } }");
    assert_eq!(planned(&text).plan.unwrap().runs.len(), 1);
    text = parse(
        "body.toml",
        "format = 1\n[param]\nP = \"220.6 W\"\nR = \"0.3 ± 0.006 K/W\"\nC = \"2659 J/K\"\n[node]\n\
         body = { C = \"C\", T0 = \"25 degC\" }\n[boundary]\nroom = { T = \"25 degC\" }\n\
         [resistor]\nskin = { from = \"body\", to = \"room\", R = \"R\" }\n[source]\n\
         heat = { into = \"body\", P = \"P\" }\n[plan.next]\nknow = { P = \"1 %\" }\n\
         vary = [\"R\", \"C\"]\nevery = \"5 s\"\nduration = \"2 h\"\n\
         place = { r = { of = \"body.T\", noise = \"0.1 K\" } }\n",
    )
    .unwrap();
    let plan = planned(&text).plan.unwrap();
    assert!(!plan.reached);
    // P R is known exactly in the end
    near(plan.limits.as_ref().unwrap()[0], 0.02 * 220.6, 1e-4);
    let (cause, part) = plan.causes[0].unwrap();
    assert_eq!(cause, 1);
    assert!(part > 0.99);
}

#[test]
fn costs_and_budgets_count() {
    let plan = |budget: f64| {
        body(
            "",
            &format!(
                "know = {{ P = \"0.1 %\" }}\nplace = {{ ring = {{ of = \"body.T\", cost = 40 }} }}\n\
                 cost = {{ run = 10, hour = 60 }}\nbudget = {budget}"
            ),
        )
    };
    let rich = planned(&plan(100.0)).plan.unwrap();
    assert!(rich.reached);
    let minutes = (rich.runs[0].1 - 1) as f64 * EVERY / 60.0;
    near(rich.cost, 50.0 + minutes, 1e-12);
    let poor = planned(&plan(51.0)).plan.unwrap();
    assert!(!poor.reached && poor.cost <= 51.0);
    assert!(planned(&plan(49.0)).plan.is_none());
}
