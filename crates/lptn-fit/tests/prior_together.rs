//! What is known of parameters together, before a fit and before a plan.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::design::{Design, DesignTask, design};
use lptn_fit::network::{NetworkFit, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::Proceed;

/// A body that is heated from 20 degC; its record is 60 K (1 - exp(-t / 600 s)) over that.
fn body(param: &str, more: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\n{param}\n[node]\nbody = {{ C = \"C\", T0 = \"20 degC\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"air\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"P\" }}\n{more}\n"
    );
    let times = [30.0, 90.0, 180.0, 300.0, 480.0, 720.0, 1080.0, 1600.0, 2400.0];
    let row = |t: f64| format!("{t},{:.9}\n", 20.0 - 60.0 * f64::exp_m1(-t / 600.0));
    let csv = "t [s],ring [degC]\n".to_owned() + &times.map(row).concat();
    parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn fitted(uncertainty: &str) -> NetworkFit {
    let netlist = body(
        "R = \"0.3 ± 0.03 K/W\"\nC = \"2 kJ/K\"\nP = \"190 ± 9 W\"",
        &format!(
            "{uncertainty}\n[fit.all]\ndata = \"r.csv\"\ncolumn = {{ ring = \"body.T\" }}\n\
             sigma = \"0.1 K\"\nvary = [\"R\", \"C\", \"P\"]"
        ),
    );
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 2).unwrap();
    fit_network(&task).unwrap()
}

fn planned(uncertainty: &str) -> Design {
    let netlist = body(
        "R = \"0.3 K/W\"\nC = \"2659 ± 265.9 J/K\"\nP = \"220.6 ± 20 W\"",
        &format!(
            "{uncertainty}\n[plan.next]\nknow = {{ P = \"1 W\" }}\nvary = [\"R\", \"C\"]\n\
             place = {{ ring = {{ of = \"body.T\", noise = \"0.1 K\" }} }}\nevery = \"5 s\"\n\
             duration = \"30 min\""
        ),
    );
    let study = &netlist.studies.plans[0];
    let task = DesignTask::of(&netlist, study, (2, &|_, _| Proceed::Continue)).unwrap();
    design(&task, &|_, _| Proceed::Continue).unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} is not {expected}");
}

/// `correlation` of `[uncertainty]` was read by every verb but fits: R was known to three times what
/// a correlation of 0.9 leaves. The record tells P R and R C, so that along P / R only what is known
/// beforehand tells. Values and errors by SciPy (`least_squares` over the residuals of the record and
/// `L^-1 r`, `inv(J.T @ J)`): of nine values without noise the errors are those of `sigma`.
#[test]
fn a_fit_counts_how_what_is_known_is_correlated() {
    let expected = [
        (
            "",
            [0.312_716_144_795_528, 1_918.631_766_875_29, 191.865_313_394_113],
            [0.013_183_533_165_592, 81.052_485_476_016, 8.085_423_873_405_8],
        ),
        (
            "[uncertainty]\ncorrelation = { P = { R = 0.9 } }",
            [0.310_718_576_030_078, 1_930.983_634_679_31, 193.099_619_041_631],
            [0.004_366_090_343_182_8, 27.713_673_022_753_7, 2.707_498_305_412_22],
        ),
        (
            "[uncertainty]\ncorrelation = { P = { R = -0.9 } }",
            [0.324_794_853_151_167, 1_847.167_142_688_64, 184.724_645_253_124],
            [0.012_055_823_048_236_9, 68.555_047_470_204_2, 6.843_906_008_998_63],
        ),
    ];
    for (uncertainty, values, errors) in expected {
        let fit = fitted(uncertainty);
        for (i, parameter) in fit.parameters.iter().enumerate() {
            near(parameter.value, values[i], 1e-5);
            near(parameter.standard_error.unwrap(), errors[i], 1e-4);
        }
    }
}

/// The same of a plan. Errors of P, R and C after one run, and the parts of the variance of P that
/// come from what is known of P and of C, by NumPy: `inv(J.T @ J + Lambda)` with the derivatives of
/// the closed form and `Lambda = inv(D K D)`.
#[test]
fn a_plan_counts_how_what_is_known_is_correlated() {
    let expected = [
        ("", [14.817_103_747_670_8, 0.020_150_863_537_120_9, 178.598_284_912_909]),
        (
            "[uncertainty]\ncorrelation = { P = { C = 0.9 } }",
            [19.997_695_316_932_4, 0.027_195_689_835_543_4, 241.045_339_521_756],
        ),
        (
            "[uncertainty]\ncorrelation = { P = { C = -0.9 } }",
            [4.691_155_555_876_06, 0.006_381_822_925_433_23, 56.545_575_167_257_7],
        ),
    ];
    for (uncertainty, errors) in expected {
        let design = planned(uncertainty);
        let found = &design.next[0].errors;
        (0..3).for_each(|i| near(found[i], errors[i], 1e-6));
    }
    // after so many runs the record is as good as exact, and shares are those of its limit
    let causes = planned("[uncertainty]\ncorrelation = { P = { C = 0.9 } }").plan.unwrap().causes;
    let (cause, share) = causes[0].unwrap();
    assert_eq!(cause, 0);
    near(share, 0.968_4, 1e-3);
}

/// A task that was put together by hand may have what no netlist can say.
#[test]
fn correlations_that_cannot_be_are_refused() {
    let netlist = body(
        "R = \"0.3 ± 0.03 K/W\"\nC = \"2 ± 0.1 kJ/K\"\nP = \"190 ± 9 W\"",
        "[fit.all]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\nsigma = \"0.1 K\"\n\
         vary = [\"R\", \"C\", \"P\"]",
    );
    let mut task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 2).unwrap();
    task.correlations.set(0, 1, 0.9);
    task.correlations.set(1, 2, 0.9);
    task.correlations.set(0, 2, -0.9);
    let error = fit_network(&task).unwrap_err();
    assert_eq!(lptn_units::Problem::code(&error), "fit::correlations");
}
