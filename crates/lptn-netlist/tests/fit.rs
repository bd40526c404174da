//! `[fit.NAME]`: what is asked, in numbers. Expected numbers are conversions written out here.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use lptn_netlist::{Certainty, Netlist, parse_with};
use lptn_network::{End, Varied};
use lptn_units::{Dimension, Type};

const FIT: &str = include_str!("good/fit.toml");

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good")
}

fn parse(text: &str) -> Netlist {
    parse_with("fit.toml", text, &mut |path| std::fs::read(folder().join(path)))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

/// rad/s in one rpm.
const RPM: f64 = std::f64::consts::TAU / 60.0;

#[test]
fn analytic_bounds_priors_and_deviations_are_in_si() {
    let netlist = parse(FIT);
    let [fit] = netlist.studies.fits.as_slice() else { panic!("one fit") };
    assert_eq!(fit.name, "block");
    let plan = fit.plan(&netlist.network, &netlist.overrides()).unwrap();
    let network = &netlist.network;
    let name = |varied: &Varied| network.parameters()[varied.parameter.index()].name.as_str();
    let names: Vec<&str> = plan.varied.iter().map(name).collect();
    assert_eq!(names, ["a", "R", "C"]);
    let [a, r, c] = plan.varied.as_slice() else { panic!("three parameters") };
    near(network.parameter_value(a.parameter), 0.1 / RPM);
    near(a.bounds.0, 0.01 / RPM);
    near(a.bounds.1, 1.0 / RPM);
    assert_eq!((a.prior, c.prior), (None, None));
    near(network.parameter_value(r.parameter), 0.3);
    near(r.bounds.0, 0.1);
    assert_eq!(
        (r.bounds.1, c.bounds.0, c.bounds.1),
        (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY)
    );
    near(r.prior.unwrap(), 0.05);
    let sigmas: Vec<f64> = plan.sigmas.iter().map(|sigma| sigma.unwrap()).collect();
    assert_eq!(sigmas, [0.2, 5.0, 0.2]);
}

#[test]
fn analytic_records_are_read_by_name_in_their_own_units() {
    let netlist = parse(FIT);
    let fit = &netlist.studies.fits[0];
    let [first, second] = fit.records.as_slice() else { panic!("two records") };
    assert_eq!((first.csv.as_str(), second.csv.as_str()), ("block_1000.csv", "block_2000.csv"));
    assert_eq!(second.record.time, [0.0, 60.0, 120.0]);
    for record in [first, second] {
        let names: Vec<&str> =
            record.record.columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["ring", "heat", "rise"]);
    }
    // 78.8 degF is 26 degC; a rise in K is a difference where a difference is observed
    near(second.record.columns[0].values[0], 299.15);
    near(second.record.columns[2].values[1], 19.0);
    assert!(first.record.columns[1].values[3].is_nan());
    let gaps: Vec<&str> = netlist.warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(gaps, ["record::gaps"]);
}

#[test]
fn analytic_each_record_has_the_network_it_was_measured_on() {
    let mut netlist = parse(FIT);
    let omega = netlist.network.parameter("omega").unwrap();
    let run = |netlist: &Netlist, record: usize| {
        let plan = netlist.studies.fits[0].plan(&netlist.network, &netlist.overrides()).unwrap();
        netlist.network.with(&plan.parameters[record]).unwrap().parameter_value(omega)
    };
    near(run(&netlist, 0), 1000.0 * RPM);
    near(run(&netlist, 1), 2000.0 * RPM);
    // what is set for all records is that of those that do not set it
    netlist.set(&["omega=1500rpm".to_owned()]).unwrap();
    near(run(&netlist, 0), 1500.0 * RPM);
    near(run(&netlist, 1), 2000.0 * RPM);
}

#[test]
fn what_is_observed_is_a_result_of_the_network() {
    let netlist = parse(FIT);
    let fit = &netlist.studies.fits[0];
    let steel = netlist.network.node("steel").unwrap();
    assert_eq!(fit.observed[0].end, Some(End::Node(steel)));
    assert_eq!((fit.observed[1].end, fit.observed[2].end), (None, None));
    assert_eq!(fit.observed[1].ty, Type::of(Dimension::POWER));
    let mut scope = netlist.network.evaluation();
    scope.set_temperatures(&[350.0], &[300.0]);
    near(fit.observed[0].value.at(&mut scope).unwrap(), 350.0);
    near(fit.observed[2].value.at(&mut scope).unwrap(), 50.0);
}

#[test]
fn regression_a_fit_is_kept_by_the_expansion() {
    let text = parse(FIT).expanded();
    assert!(text.contains("[fit.block]\n"), "{text}");
    assert!(text.contains("{ csv = \"block_2000.csv\", set = { omega = "), "{text}");
    assert!(text.contains("rise = { of = \"steel.T - air.T\", sigma = \"0.2 K\" }"), "{text}");
    assert_eq!(parse(&text).expanded(), text);
}

/// 0.5 % of 1 as the half width of a rectangle is a standard deviation of 0.005 / sqrt(3).
#[test]
fn analytic_a_gain_in_percent_may_be_a_rectangle() {
    let sensor = |gain: &str| {
        let sensor = format!("[sensor.tc]\ngain = \"{gain}\"\n\n[fit.block]");
        let netlist = parse(&FIT.replace("[fit.block]", &sensor));
        netlist.studies.sensors[0].gain
    };
    let within = |gain: &str, expected: f64| match sensor(gain).certainty {
        Certainty::Deviation(sigma) => near(sigma, expected),
        other => panic!("{other:?}"),
    };
    within("1 ± 0.5 % (rectangle)", 0.005 / 3_f64.sqrt());
    within("1 ± 0.5% (rectangle)", 0.005 / 3_f64.sqrt());
    within("1 ± 0.5 %", 0.005);
    within("1.1 ± 0.5 %", 0.0055);
    within("10 ± 0.1", 0.1);
}
