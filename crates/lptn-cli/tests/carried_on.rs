//! Command line: what a fit found is carried on to runs, sizes and comparisons.

use crate::common;

use common::Folder;
use serde_json::Value;

/// One body of 2 kJ/K; P and R are measured together.
const BODY: &str = "format = 1\n[param]\nR = \"0.25 K/W\"\nP = \"190 ± 15 W\"\n\
    T_room = \"25 ± 2 degC\"\nG_fan = \"1 W/K\"\n[node]\nbody = { C = \"2 kJ/K\", T0 = \"T_room\" }\n\
    [boundary]\nroom = { T = \"T_room\" }\n[resistor]\n\
    skin = { from = \"body\", to = \"room\", R = \"R\" }\n\
    [source]\nheat = { into = \"body\", P = \"P\" }\n[limit]\nhot = { of = \"body.T\", below = \
    \"95 degC\" }\n[run]\nstop = \"3 h\"\noutput = { every = \"10 min\" }\n\
    [fit.all]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\nsigma = \"1.5 K\"\n\
    vary = { T_room = {}, P = {}, R = { from = \"0.05 K/W\", to = \"2 K/W\" } }\n";

const ROWS: &str = "t [s],ring [degC]\n60,31.8\n300,48.9\n600,62.4\n1200,76.1\n2400,84.2\n";

fn folder() -> Folder {
    let folder = Folder::with("body.toml", BODY);
    folder.write("r.csv", ROWS);
    folder
}

fn fitted() -> Folder {
    let folder = folder();
    folder.run(&["fit", "network", "body.toml", "-o", "res"]).exits(0).says("posterior.json");
    folder
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// What `posterior.json` says, propagated by hand: T = T_room + P R at the end, settled (seven time
/// constants and more), `gradient^T Cov gradient` with R in its logarithm.
#[test]
fn a_run_propagates_the_covariance_of_a_fit() {
    let folder = fitted();
    let posterior: Value = serde_json::from_str(&folder.read("res/posterior.json")).unwrap();
    let value = |i: usize| number(&posterior["quantities"][i]["value"]);
    let (power, resistance) = (value(1), value(2));
    assert_eq!(posterior["of"], serde_json::json!(["T_room", "P", "ln R"]));
    let gradient = [1.0, resistance, power * resistance];
    let covariance = |i: usize, j: usize| number(&posterior["covariance"][i][j]);
    let variance: f64 = (0..3)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .map(|(i, j)| gradient[i] * covariance(i, j) * gradient[j])
        .sum();
    let alone: f64 = (0..3).map(|i| gradient[i] * covariance(i, i) * gradient[i]).sum();
    assert!(alone > 4.0 * variance, "correlations matter: {alone} {variance}");
    let run = |method: &'static str, samples: &'static str| -> Value {
        let mut words = vec!["run", "body.toml", "--posterior", "res/posterior.json"];
        words.extend(["--uncertainty", method, "--format", "json", "--no-files"]);
        if !samples.is_empty() {
            words.extend(["--samples", samples]);
        }
        folder.run(&words).exits(0).json()["uncertainty"].clone()
    };
    let lines = run("linear", "");
    let end = |found: &Value| number(&found["results"]["body.T"]["end"]["sd"]["value"]);
    let expected = variance.sqrt();
    assert!((end(&lines) / expected - 1.0).abs() < 1e-4, "{} {expected}", end(&lines));
    let tied = number(&lines["correlation"]["P"]["R"]);
    assert!((tied - number(&posterior["correlation"][1][2])).abs() < 1e-12);
    assert_eq!(lines["parameters"]["R"]["distribution"], "lognormal");
    let sampled = run("sobol", "1024");
    assert!((end(&sampled) / expected - 1.0).abs() < 0.03, "{} {expected}", end(&sampled));
    assert_eq!(sampled["results"]["body.T"]["end"]["ranking"][0]["total"], Value::Null);
}

#[test]
fn the_table_says_what_is_correlated_and_files_are_the_same_on_any_threads() {
    let folder = fitted();
    let words = |threads: &'static str, out: &'static str| {
        ["run", "body.toml", "--posterior", "res/posterior.json", "--uncertainty", "sobol"]
            .into_iter()
            .chain(["--samples", "64", "--threads", threads, "-o", out])
            .collect::<Vec<_>>()
    };
    let ran = folder.run(&words("1", "one")).exits(0);
    let ran = ran.prints("correlated").prints("lognormal: R").prints("indices are not defined");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    folder.run(&words("3", "three")).exits(0);
    for name in ["uncertainty.csv", "ranking.csv"] {
        assert_eq!(folder.read(&format!("one/{name}")), folder.read(&format!("three/{name}")));
    }
    let manifest: Value = serde_json::from_str(&folder.read("one/manifest.json")).unwrap();
    assert_eq!(manifest["inputs"][2]["name"], "res/posterior.json");
    assert!(number(&manifest["uncertainty"]["correlation"]["P"]["R"]) < -0.5, "{manifest}");
}

/// The netlist names the file itself; a fit does not read it.
#[test]
fn a_netlist_names_its_posterior() {
    let folder = fitted();
    let named = format!("{BODY}[uncertainty]\nposterior = \"res/posterior.json\"\n");
    folder.write("body.toml", &named);
    let by_name = folder.run(&["run", "body.toml", "--no-files", "--format", "csv"]).exits(0);
    folder.write("plain.toml", BODY);
    let words = ["run", "plain.toml", "--posterior", "res/posterior.json", "--no-files"];
    let by_option = folder.run(&[&words[..], &["--format", "csv"]].concat()).exits(0);
    assert_eq!(by_name.out, by_option.out);
    by_option.says("posterior::other_network");
    let first = folder.read("res/posterior.json");
    folder.run(&["fit", "network", "body.toml", "-o", "again"]).exits(0);
    assert_eq!(folder.read("again/posterior.json"), first);
}

/// What was the posterior of an earlier fit does not stay beside a fit that has none.
#[test]
fn a_fit_that_determines_too_little_leaves_no_posterior() {
    let folder = fitted();
    let open = BODY.replace("190 ± 15 W", "190 W").replace("25 ± 2 degC", "25 degC");
    let open =
        open.replace("sigma", "# sigma").replace("C = \"2 kJ/K\"", "C = \"G_fan * 2000 [s]\"");
    let open = open.replace("T_room = {}, P = {}", "P = {}, G_fan = {}");
    folder.write("body.toml", &open);
    folder.run(&["fit", "network", "body.toml", "-o", "res"]).exits(1);
    assert!(!folder.files().contains(&"res/posterior.json".to_owned()), "{:?}", folder.files());
    assert!(folder.files().contains(&"res/fit.json".to_owned()));
}

#[test]
fn sizes_and_comparisons_read_it() {
    let folder = fitted();
    let size = format!(
        "{BODY}[size.skin]\nmaximise = \"R\"\nvary = {{ R = {{ from = \"0.05 K/W\", to = \"2 K/W\" }} }}\n\
         require = [\"body.T <= 95 [degC]\"]\nprobability = \"95 %\"\n"
    );
    folder.write("body.toml", &size);
    let value = |more: &[&str]| {
        let ran = folder.run(&[&["size", "body.toml", "--format", "json"], more].concat()).exits(0);
        let json = ran.json();
        (number(&json["values"]["R"]["value"]), json.to_string())
    };
    let (own, _) = value(&[]);
    let (carried, json) = value(&["--posterior", "res/posterior.json"]);
    assert!((own - carried).abs() > 0.01, "{own} {carried} {json}");
    folder.write("plain.toml", BODY);
    folder.write(
        "other.toml",
        &BODY
            .replace("R = \"0.25 K/W\"", "R2 = \"0.25 K/W\"")
            .replace("R = \"R\"", "R = \"R2\"")
            .replace("R = { from", "R2 = { from"),
    );
    let compared = ["compare", "plain.toml", "other.toml", "--posterior", "res/posterior.json"];
    let ran = folder.run(&[&compared[..], &["--format", "json"]].concat());
    assert!(ran.out.contains("peak"), "{} {}", ran.out, ran.err);
}

#[test]
fn what_is_no_posterior_is_refused() {
    let folder = fitted();
    let run = |file: &str| folder.run(&["run", "body.toml", "--no-files", "--posterior", file]);
    run("res/fit.json").exits(2).says("posterior::format");
    run("no.json").exits(2).says("input::cannot_read");
    let foreign = common::GEARBOX.to_owned();
    folder.write("gearbox.toml", &foreign);
    let words = ["run", "gearbox.toml", "--no-files", "--posterior", "res/posterior.json"];
    folder.run(&words).exits(2).says("posterior::unknown_parameter");
    let words = ["compare", "gearbox.toml", "--posterior", "res/posterior.json"];
    folder.run(&words).exits(2).says("posterior::nothing");
}

/// Points of a loss over the speed, with standard errors.
const POINTS: &str = "omega [rpm],P [W],P_sd [W]\n1000,9.4,0.5\n1000,8.1,0.5\n2000,26.9,0.6\n\
    3000,55.6,0.8\n4000,86.5,1.0\n5000,128,1.4\n6000,172,1.8\n7000,224,2.2\n";

/// A body that loses what the law says at 7000 rpm, settled.
const DRIVEN: &str = "format = 1\n[param]\nalpha = \"1 mW/(rad/s)^(5/3)\"\nbeta = \"1 mW/(rad/s)\"\n\
    omega = \"7000 rpm\"\n[node]\nbody = { C = \"2 kJ/K\", T0 = \"25 degC\" }\n[boundary]\nroom = { T \
    = \"25 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"room\", R = \"0.3 K/W\" }\n[source]\n\
    heat = { into = \"body\", P = \"alpha * omega^(5/3) + beta * omega\" }\n[run]\nstop = \"6 h\"\n\
    output = { every = \"1 h\" }\n";

/// Values, standard errors and correlation are those of weighted least squares by NumPy (`inv(A^T A)`
/// times chi^2 over degrees of freedom), half widths those with SciPy's quantile of Student's t. The
/// interval of `beta` is that of HC2 with the 4.22 degrees of freedom of Bell and McCaffrey, which is
/// the wider one (NumPy with whole matrices); its standard error is what makes it with 6. The
/// standard deviation of the settled body is `R` times that of the power at 7000 rpm.
#[test]
fn a_law_is_carried_on_under_the_names_of_its_coefficients() {
    let folder = Folder::with("points.csv", POINTS);
    folder.write("driven.toml", DRIVEN);
    let law = ["fit", "law", "points.csv", "--law", "alpha * omega^(5/3) + beta * omega"];
    let written = [&law[..], &["--posterior", "law.json"]].concat();
    folder.run(&written).exits(0).says("law.json");
    let posterior: Value = serde_json::from_str(&folder.read("law.json")).unwrap();
    let near = |found: &Value, expected: f64| {
        let found = number(found);
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    };
    let of = |i: usize, key: &str| &posterior["quantities"][i][key];
    assert_eq!((of(0, "name"), of(1, "name")), (&"alpha".into(), &"beta".into()));
    near(of(0, "value"), 3.761_09e-3);
    near(of(0, "standard_error"), 7.423_912_05e-5);
    near(of(1, "standard_error"), 5.068_550_0e-3);
    near(of(1, "half_width_95"), 0.012_402_296);
    near(of(1, "degrees_of_freedom"), 6.0);
    near(&posterior["correlation"][0][1], -0.952_104_12);
    let omega = 7000.0 * std::f64::consts::PI / 30.0;
    let slopes = [0.3 * f64::powf(omega, 5.0 / 3.0), 0.3 * omega];
    let [a, b] = [slopes[0] * 7.423_912_05e-5, slopes[1] * 5.068_550_0e-3];
    let expected = (a * a + b * b - 2.0 * 0.952_104_12 * a * b).sqrt();
    let run = ["run", "driven.toml", "--posterior", "law.json", "--uncertainty", "linear"];
    let ran = folder.run(&[&run[..], &["--format", "json", "--no-files"]].concat()).exits(0);
    // six degrees of freedom are fewer than a normal distribution stands for
    let ran = ran.says("posterior::few_degrees").says("posterior::other_network");
    near(&ran.json()["uncertainty"]["results"]["body.T"]["end"]["sd"]["value"], expected);
    // names that the netlist does not have, no law, two laws, a folder
    let other = law.map(|word| if word.contains("alpha") { "gamma * omega^(5/3)" } else { word });
    folder.run(&[&other[..], &["--posterior", "gamma.json"]].concat()).exits(0);
    let run = run.map(|word| if word == "law.json" { "gamma.json" } else { word });
    folder.run(&run).exits(2).says("posterior::unknown");
    let two = [&written[..], &["--law", "a * omega"]].concat();
    folder.run(&two).exits(2).says("fit::law_posterior");
    let records = written.iter().map(|word| if *word == "points.csv" { "." } else { word });
    folder.run(&records.collect::<Vec<_>>()).exits(2).says("fit::law_posterior");
    let exact = "omega [rpm],P [W]\n1000,1\n2000,2\n";
    folder.write("points.csv", exact);
    // what an earlier law left there is not that of this one
    assert!(folder.path().join("law.json").exists());
    folder.run(&written).says("no posterior is written");
    assert!(!folder.path().join("law.json").exists());
}

/// P = C dT / t_RC and R = t_RC / C, so that the covariances with C are P/C and -R/C times its
/// variance whatever the record says, and P R = dT does not know C at all.
#[test]
fn a_step_is_carried_on_with_its_capacity() {
    let mut csv = "t [s],ring [degC]\n".to_owned();
    let rows =
        (0..301).map(|i| (5.0 * f64::from(i), f64::from(i * i * 7919 % 1000) / 1000.0 - 0.5));
    csv.extend(
        rows.map(|(t, noise)| format!("{t},{:.4}\n", 92.7 - 67.2 * f64::exp(-t / 810.0) + noise)),
    );
    let folder = Folder::with("step.csv", &csv);
    let words =
        ["fit", "step", "step.csv", "--capacity", "2659 J/K ± 5 %", "--posterior", "p.json"];
    let step = folder.run(&[&words[..], &["--format", "json"]].concat()).exits(0).json();
    let posterior: Value = serde_json::from_str(&folder.read("p.json")).unwrap();
    assert_eq!(posterior["of"], serde_json::json!(["P_disp", "R_eq", "C_eq"]));
    let covariance = |i: usize, j: usize| number(&posterior["covariance"][i][j]);
    let [p, r, c] = [0, 1, 2].map(|i| number(&posterior["quantities"][i]["value"]));
    let near = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    };
    let variance = (0.05 * 2659.0_f64).powi(2);
    near(covariance(2, 2), variance);
    near(covariance(0, 2), p / c * variance);
    near(covariance(1, 2), -r / c * variance);
    let rise = r * r * covariance(0, 0) + p * p * covariance(1, 1) + 2.0 * p * r * covariance(0, 1);
    let said = &step["columns"]["ring"]["dT"];
    assert!((rise.sqrt() / number(&said["standard_error"]) - 1.0).abs() < 1e-6, "{rise} {said}");
    folder.write(
        "body.toml",
        "format = 1\n[param]\nP_disp = \"1 W\"\nR_eq = \"1 K/W\"\nC_eq = \"1 kJ/K\"\n[node]\nbody = \
         { C = \"C_eq\", T0 = \"25.5 degC\" }\n[boundary]\nroom = { T = \"25.5 degC\" }\n[resistor]\n\
         skin = { from = \"body\", to = \"room\", R = \"R_eq\" }\n[source]\nheat = { into = \"body\", P = \
         \"P_disp\" }\n[run]\nstop = \"6 h\"\noutput = { every = \"1 h\" }\n",
    );
    let run = ["run", "body.toml", "--posterior", "p.json", "--uncertainty", "linear"];
    let json =
        folder.run(&[&run[..], &["--format", "json", "--no-files"]].concat()).exits(0).json();
    let end = number(&json["uncertainty"]["results"]["body.T"]["end"]["sd"]["value"]);
    assert!((end / rise.sqrt() - 1.0).abs() < 1e-3, "{end} {rise}");
    // a second column that says the same
    let twice = |line: &str| match line.rsplit_once(',') {
        Some((rest, last)) if !last.contains('[') => format!("{rest},{last},{last}\n"),
        _ => format!("{line},steel [degC]\n"),
    };
    folder.write("step.csv", &csv.lines().map(twice).collect::<String>());
    folder.run(&words).exits(2).says("fit::step_posterior");
}
