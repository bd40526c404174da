//! What a fit leaves behind, against a closed form and against a random walk.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, Posterior, parse_with};
use lptn_units::{Distribution, Spread};

/// One body of 2 kJ/K over 0.3 K/W.
fn body(param: &str, fit: &str, rows: &[(f64, f64)]) -> Netlist {
    let text = format!(
        "format = 1\n[param]\n{param}\n[node]\nbody = {{ C = \"C\", T0 = \"T_room\" }}\n[boundary]\n\
         room = {{ T = \"T_room\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"P\" }}\n[fit.all]\ndata = \"r.csv\"\n\
         column = {{ ring = \"body.T\" }}\n{fit}\n"
    );
    let mut csv = String::from("t [s],ring [degC]\n");
    rows.iter().for_each(|(t, value)| csv += &format!("{t},{value}\n"));
    parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn posterior(netlist: &Netlist) -> Option<Posterior> {
    let task = NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2).unwrap();
    let names: Vec<String> = task.unknowns().into_iter().map(|unknown| unknown.name).collect();
    fit_network(&task).unwrap().posterior(&task, ("body", "all"), &names)
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// T = T_room + P R (1 - exp(-t / R C)) is linear in T_room and P: generalised least squares with
/// sigma of 1.5 K and both priors, `inv(J.T @ J)` of NumPy 1.24.2.
#[test]
fn analytic_a_linear_posterior_is_that_of_least_squares() {
    let rows = [(60.0, 31.8), (300.0, 48.9), (600.0, 62.4), (1200.0, 76.1), (2400.0, 84.2)];
    let netlist = body(
        "R = \"0.3 K/W\"\nC = \"2 kJ/K\"\nT_room = \"25 ± 2 degC\"\nP = \"190 ± 15 W\"",
        "sigma = \"1.5 K\"\nvary = [\"T_room\", \"P\"]",
        &rows,
    );
    let found = posterior(&netlist).unwrap();
    let [room, power] = &found.quantities[..] else { panic!("{found:?}") };
    assert!((room.value - 273.15 - 25.750_132_439_652_81).abs() < 1e-6, "{}", room.value);
    near(power.value, 195.732_417_470_531_83, 1e-7);
    near(room.spread.unwrap().sigma(room.value), 1.096_136_982_946_256_8, 1e-6);
    near(power.spread.unwrap().sigma(power.value), 5.578_937_368_082_129, 1e-6);
    near(found.correlations.between(0, 1), -0.814_461_008_072_333_7, 1e-6);
    // the covariance is what all of that says, in the units of the quantities
    let covariance = found.covariance();
    near(covariance[1][1], 5.578_937_368_082_129_f64.powi(2), 2e-6);
    near(covariance[0][1], covariance[1][0], 1e-15);
    assert_eq!(room.spread.unwrap().distribution, Distribution::Normal);
    assert_eq!(room.prior.unwrap().spread, Spread::normal(2.0));
}

/// Estimates of ln R and ln C between bounds. A random walk of Metropolis over ln R and ln C with a
/// flat prior (NumPy, 4000 chains of 2700 steps, an error of the deviations of 0.1 %) has
/// deviations of 0.015256 and 0.027924 and a correlation of 0.5908.
#[test]
fn a_posterior_in_logarithms_is_that_of_a_random_walk() {
    let t = [30.0, 90.0, 180.0, 300.0, 480.0, 720.0, 1080.0, 1600.0, 2400.0];
    let y = [28.2, 32.9, 40.8, 49.2, 57.6, 66.8, 75.6, 80.5, 84.0];
    let rows: Vec<(f64, f64)> = t.into_iter().zip(y).collect();
    let netlist = body(
        "R = \"0.25 K/W\"\nC = \"2.4 kJ/K\"\nT_room = \"25 degC\"\nP = \"200 W\"",
        "sigma = \"1 K\"\nvary = { R = { from = \"0.05 K/W\", to = \"2 K/W\" }, \
         C = { from = \"500 J/K\", to = \"9 kJ/K\" } }",
        &rows,
    );
    let found = posterior(&netlist).unwrap();
    near(found.quantities[0].value, 0.299_837_783_086_928_66, 1e-6);
    near(found.quantities[1].value, 1_993.717_091_109_469_7, 1e-6);
    let covariance = found.covariance();
    near(covariance[0][0].sqrt(), 0.015_256, 0.02);
    near(covariance[1][1].sqrt(), 0.027_924, 0.02);
    near(found.correlations.between(0, 1), 0.590_8, 0.02);
    // least squares in logarithms, SciPy
    near(covariance[0][0].sqrt(), 0.015_238_655_100_789_788, 1e-5);
    near(covariance[1][1].sqrt(), 0.027_904_044_476_390_995, 1e-5);
    assert!(
        found
            .quantities
            .iter()
            .all(|quantity| { quantity.spread.unwrap().distribution == Distribution::Lognormal })
    );
}

/// A lognormal prior is one more measurement of the logarithm. A body of 1 J/K is settled after
/// 1000 s, at 200 R over the room: R makes (ln(R / 0.3) / 0.0015)^2 + ((200 R - 60.3) / 0.0903)^2
/// least, by Brent's method (SciPy 1.10).
#[test]
fn analytic_a_lognormal_prior_is_one_more_measurement_of_the_logarithm() {
    let netlist = body(
        "R = \"0.3 K/W ± 0.15 % (lognormal)\"\nC = \"1 J/K\"\nT_room = \"25 degC\"\nP = \"200 W\"",
        "sigma = \"0.0903 K\"\nvary = { R = { from = \"0.05 K/W\", to = \"2 K/W\" } }",
        &[(1000.0, 85.3)],
    );
    let found = posterior(&netlist).unwrap();
    near(found.quantities[0].value, 0.300_748_906_705_627_2, 1e-8);
    let prior = found.quantities[0].prior.unwrap();
    near(prior.spread.sigma(prior.value), 0.00045, 1e-9);
}

/// Of what records do not determine there is no posterior.
#[test]
fn there_is_no_posterior_where_values_are_not_determined() {
    let rows: Vec<(f64, f64)> = (0..40)
        .map(|k| 60.0 * f64::from(k))
        .map(|t| (t, 25.0 + 60.0 * (1.0 - f64::exp(-t / 600.0))))
        .collect();
    let netlist = body(
        "R = \"0.25 K/W\"\nC = \"2.4 kJ/K\"\nT_room = \"25 degC\"\nP = \"200 W\"",
        "vary = [\"R\", \"C\", \"P\"]",
        &rows,
    );
    assert_eq!(posterior(&netlist), None);
}
