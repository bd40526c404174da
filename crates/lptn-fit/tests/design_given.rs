//! Plans that begin with records which are there.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::design::{Design, DesignError, DesignTask, design};
use lptn_netlist::parse_with;
use lptn_solve::Proceed;

/// A body whose record is 60 K (1 - exp(-t / 600 s)) over 20 degC, with a scatter of 0.1 K.
fn planned(power: &str, vary: &str, more: &str) -> Result<(Vec<f64>, Design), DesignError> {
    let text = format!(
        "format = 1\n[param]\nR = \"0.3 K/W\"\nC = \"2 kJ/K\"\nP = \"{power}\"\n\
         [node]\nbody = {{ C = \"C\", T0 = \"20 degC\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"air\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"P\" }}\n[fit.h]\ndata = \"r.csv\"\n\
         column = {{ ring = \"body.T\" }}\nsigma = \"0.1 K\"\nvary = {vary}\n\
         [plan.n]\nknow = {{ R = \"1 %\" }}\nvary = [\"C\"]\ngiven = [\"h\"]\nplace = {{ ring = \
         {{ of = \"body.T\", noise = \"0.1 K\" }} }}\nevery = \"1 s\"\nduration = \"30 min\"\n{more}"
    );
    let row = |k: u32| {
        let (t, odd) = (10.0 * f64::from(k), f64::from(k % 2));
        format!("{t},{:.9}\n", 19.9 + 0.2 * odd - 60.0 * f64::exp_m1(-t / 600.0))
    };
    let csv = "t [s],ring [degC]\n".to_owned() + &(0..=180).map(row).collect::<String>();
    let netlist = parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes())).unwrap();
    let study = &netlist.studies.plans[0];
    let task = DesignTask::of(&netlist, study, (2, &|_, _| Proceed::Continue))?;
    let design = design(&task, &|_, _| Proceed::Continue)?;
    Ok((task.values.clone(), design))
}

/// The fit varied P too, of which 60 W of 200 W are not known, and the plan did not name it: it
/// counted as exact, and R as known to a thousandth. The record tells P R, and so would any run: R
/// is known as well as P, to 30 %.
#[test]
fn analytic_what_the_given_fit_varies_is_not_known_either() {
    let (values, design) = planned("200 ± 60 W", "[\"R\", \"C\", \"P\"]", "").unwrap();
    let power = values[2];
    assert!((power - 200.0).abs() < 1.0, "{power}");
    for errors in [&design.before, &design.next[0].errors] {
        let (found, expected) = (errors[0] / values[0], 60.0 / power);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} is not {expected}");
    }
    assert!(!design.plan.unwrap().reached);
}

/// Without the `±` the fit is not determined; it counted as known.
#[test]
fn a_given_fit_that_is_not_determined_tells_no_more() {
    let (_, design) = planned("200 W", "[\"R\", \"C\", \"P\"]", "").unwrap();
    assert!(design.before.iter().all(|error| error.is_infinite()), "{:?}", design.before);
    assert!(design.never.is_some() && design.plan.is_none());
    // with a P that is known the same records tell R at once
    let (_, design) = planned("200 W", "[\"R\", \"C\"]", "").unwrap();
    assert!(design.plan.unwrap().runs.is_empty());
}

/// A run that sets what the records were fitted with had its value overwritten.
#[test]
fn what_a_run_sets_is_not_found_from_records() {
    let run = "run.low.set = { P = \"50 W\" }\n";
    let error = planned("200 ± 60 W", "[\"R\", \"C\", \"P\"]", run).unwrap_err();
    assert!(matches!(error, DesignError::Set { .. }), "{error}");
    assert!(planned("200 W", "[\"R\", \"C\"]", run).is_ok());
}
