//! A posterior in the place of a netlist's own values: what counts, and what is said of it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use lptn_netlist::{
    Netlist, Posterior, PosteriorOf, PosteriorQuantity, Rejected, Taken, parse_with,
};
use lptn_units::{Correlations, Distribution, Spread};

fn quantity(name: &str, value: f64, unit: &str, spread: Option<Spread>) -> PosteriorQuantity {
    PosteriorQuantity {
        name: name.to_owned(),
        of: if name.contains('.') { PosteriorOf::Sensor } else { PosteriorOf::Parameter },
        value,
        unit: unit.to_owned(),
        spread,
        half_width: spread.map(|spread| 2.0 * spread.sigma(value)),
        degrees_of_freedom: None,
        bounds: (f64::NEG_INFINITY, f64::INFINITY),
        prior: None,
    }
}

const FACTOR: Spread = Spread::of(0.3, 0.03, Distribution::Lognormal);

/// R = 0.3 ± 0.03 K/W (lognormal), P = 100 ± 2 W, an offset, and T_room on a bound.
fn found() -> Posterior {
    let mut correlations = Correlations::none(3);
    correlations.set(0, 1, -0.75);
    correlations.set(1, 2, 1.0 / 3.0);
    Posterior {
        network: "body".to_owned(),
        fit: "all".to_owned(),
        quantities: vec![
            quantity("R", 0.3, "K/W", Some(FACTOR)),
            quantity("P", 100.0, "W", Some(Spread::normal(2.0))),
            quantity("tc.offset", 0.1, "K", Some(Spread::normal(0.5))),
            quantity("T_room", 293.15, "K", None),
        ],
        correlations,
    }
}

fn json(posterior: &Posterior) -> String {
    let mut bytes = Vec::new();
    posterior.write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn read(param: &str, uncertainty: &str, posterior: &str) -> Result<Netlist, Rejected> {
    let text = format!(
        "format = 1\n[param]\n{param}\n[node]\nbody = {{ C = \"2 kJ/K\", T0 = \"T_room\" }}\n[boundary]\n\
         room = {{ T = \"T_room\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"P\" }}\n{uncertainty}\n"
    );
    parse_with("body.toml", &text, &mut |_| Ok(posterior.as_bytes().to_vec()))
}

const OWN: &str = "R = \"0.25 K/W\"\nP = \"90 W\"\nT_room = \"25 degC\"";
const NAMED: &str = "[uncertainty]\nposterior = \"posterior.json\"";

fn value(netlist: &Netlist, name: &str) -> f64 {
    netlist.network.parameter_value(netlist.network.parameter(name).unwrap())
}

fn sigmas(netlist: &Netlist) -> Vec<(String, f64)> {
    let name =
        |id: lptn_network::ParameterId| netlist.network.parameters()[id.index()].name.clone();
    let sigma = |id, spread: Spread| spread.sigma(netlist.network.parameter_value(id));
    netlist.overrides().uncertain().into_iter().map(|(id, s)| (name(id), sigma(id, s))).collect()
}

/// The correlation of R and P.
fn tied(netlist: &Netlist) -> f64 {
    let ids = ["R", "P"].map(|name| netlist.network.parameter(name).unwrap());
    netlist.overrides().correlations_of(&ids).between(0, 1)
}

fn codes(netlist: &Netlist) -> Vec<&'static str> {
    netlist.warnings.iter().map(|warning| warning.code).collect()
}

#[test]
fn a_posterior_reads_back_as_it_was_written() {
    let text = json(&found());
    let netlist = read(OWN, NAMED, &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let again = &netlist.posterior().unwrap().posterior;
    assert_eq!(again.quantities, found().quantities);
    assert_eq!(again.network, "body");
    for i in 0..3 {
        for j in 0..3 {
            let (a, b) = (again.correlations.between(i, j), found().correlations.between(i, j));
            assert!((a - b).abs() < 1e-15, "{a} {b}");
        }
    }
    // of a logarithm: (0.03 / 0.3)^2, and -0.75 x 0.1 x 2
    let covariance = again.covariance();
    assert!((covariance[0][0] - 0.01).abs() < 1e-16 && (covariance[0][1] + 0.15).abs() < 1e-15);
    assert!(text.contains("\"of\": [\"ln R\",\"P\",\"tc.offset\"]"), "{text}");
}

#[test]
fn values_and_errors_are_taken_when_they_are_asked_for() {
    let mut netlist = read(OWN, NAMED, &json(&found())).unwrap();
    assert!((value(&netlist, "R") - 0.25).abs() < 1e-15, "a fit begins with the netlist's own");
    netlist.believe().unwrap();
    assert!((value(&netlist, "R") - 0.3).abs() < 1e-15);
    assert!((value(&netlist, "T_room") - 293.15).abs() < 1e-12);
    assert_eq!(sigmas(&netlist), [("R".to_owned(), 0.03), ("P".to_owned(), 2.0)]);
    assert!((tied(&netlist) + 0.75).abs() < 1e-15);
    assert_eq!(codes(&netlist), ["posterior::bound"]);
    // what is set goes before it; a `±` forgets the correlation, a value alone does not
    netlist.set(&["R=0.4 K/W".to_owned()]).unwrap();
    assert!((tied(&netlist) + 0.75).abs() < 1e-15);
    assert!((value(&netlist, "R") - 0.4).abs() < 1e-15);
    netlist.set(&["R=0.4 ± 0.1 K/W".to_owned()]).unwrap();
    assert!(tied(&netlist).abs() < 1e-300);
}

/// A part of a posterior is its marginal: the rows and columns that are left.
#[test]
fn a_part_of_a_posterior_can_be_taken() {
    let only = "[uncertainty]\nposterior = { file = \"p.json\", only = [\"P\"] }";
    let mut netlist = read(OWN, only, &json(&found())).unwrap();
    netlist.believe().unwrap();
    assert_eq!(sigmas(&netlist), [("P".to_owned(), 2.0)]);
    assert!((value(&netlist, "R") - 0.25).abs() < 1e-15);
    assert!(codes(&netlist).is_empty());
    // with a correlation to what the netlist itself knows of
    let more = format!("{only}\ncorrelation = {{ R = {{ P = 0.5 }} }}");
    let own = OWN.replace("0.25 K/W", "0.25 ± 0.05 K/W");
    let mut netlist = read(&own, &more, &json(&found())).unwrap();
    netlist.believe().unwrap();
    assert!((tied(&netlist) - 0.5).abs() < 1e-15);
    let expanded = netlist.expanded();
    assert!(expanded.contains("posterior = { file = \"p.json\", only = [\"P\"] }"), "{expanded}");
    assert!(expanded.contains("correlation = { R = { P = 0.5 } }"), "{expanded}");
}

#[test]
fn what_a_posterior_leaves_open_is_said() {
    let mut posterior = found();
    posterior.network = "gearbox".to_owned();
    posterior.quantities[1].degrees_of_freedom = Some(4.0);
    posterior.quantities[1].half_width = Some(5.55);
    posterior.quantities[1].bounds = (97.0, 200.0);
    let own = OWN.replace("90 W", "90 ± 5 W");
    let mut netlist = read(&own, NAMED, &json(&posterior)).unwrap();
    assert!(codes(&netlist).is_empty(), "nothing is taken yet");
    netlist.believe().unwrap();
    let told = codes(&netlist);
    for code in ["other_network", "prior", "few_degrees", "bound"] {
        assert!(told.contains(&format!("posterior::{code}").as_str()), "{code}: {told:?}");
    }
    // the `±` of the netlist does not count
    assert_eq!(sigmas(&netlist)[1], ("P".to_owned(), 2.0));
}

#[test]
fn a_posterior_of_the_command_line_takes_the_place_of_the_named_one() {
    let mut other = found();
    other.quantities[0].value = 0.35;
    other.quantities.push(quantity("Q", 1.0, "W", Some(Spread::normal(1.0))));
    let mut correlations = Correlations::none(4);
    correlations.set(0, 1, 0.5);
    other.correlations = correlations;
    let mut netlist = read(OWN, NAMED, &json(&found())).unwrap();
    let path = Path::new("other.json");
    let bytes = json(&other).into_bytes();
    let refused = netlist.take_posterior(path, &bytes, Taken::All).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, "posterior::unknown_parameter");
    netlist.take_posterior(path, &bytes, Taken::Known).unwrap();
    netlist.believe().unwrap();
    assert!((value(&netlist, "R") - 0.35).abs() < 1e-15);
    assert!(netlist.inputs().any(|(name, _)| name == "other.json"));
    let lost = netlist.take_posterior(path, b"{}", Taken::All).unwrap_err();
    assert_eq!(lost.diagnostics[0].code, "posterior::format");
}

/// What stands beside the covariance was not looked at: a file with its rows under other names, or
/// with the correlations of another fit, was taken without a word.
#[test]
fn labels_that_contradict_the_covariance_are_refused() {
    let sound = json(&found());
    let refused = |from: &str, to: &str| {
        let other = sound.replacen(from, to, 1);
        assert_ne!(other, sound, "{from}");
        let problem = read(OWN, NAMED, &other).unwrap_err().diagnostics.remove(0);
        assert_eq!(problem.code, "posterior::member");
        problem.message
    };
    let own = r#""of": ["ln R","P","tc.offset"]"#;
    for other in [r#"["P","ln R","tc.offset"]"#, r#"["R","P","tc.offset"]"#, r#"["ln R","P"]"#] {
        let told = refused(own, &format!("\"of\": {other}"));
        assert!(told.contains("`ln R`, `P` and `tc.offset`, in this order"), "{told}");
    }
    refused(own, "\"of\": 3");
    let (_, rows) = sound.split_once("\"correlation\"").unwrap();
    let opposite = rows.replace("-0.75", "0.75");
    let told = refused(rows, &opposite);
    assert!(told.contains("contradict each other for ln R and P"), "{told}");
    refused(rows, &rows.replacen("[1.0,-0.75,0.0],", "", 1));
    // without them the quantities say it
    let alone = sound.replace(own, "\"also\": 1").replace("\"correlation\"", "\"more\"");
    assert!(read(OWN, NAMED, &alone).is_ok());
}
