//! That what may be off is not taken as exact without a word.

use crate::common;

use common::Folder;

/// A body, and its record of a rise of 60 K with 600 s, by the closed form with a scatter of 0.1 K.
fn folder(param: &str, fit: &str) -> Folder {
    let netlist = format!(
        "format = 1\n[param]\n{param}\n[node]\nbody = {{ C = \"C\", T0 = \"20 degC\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"air\", R = \"R\" }}\n\
         [source]\nheat = {{ into = \"body\", P = \"P\" }}\n{fit}\n"
    );
    let folder = Folder::with("body.toml", &netlist);
    let row = |k: u32| {
        let (t, odd) = (10.0 * f64::from(k), f64::from(k % 2));
        format!("{t},{:.6}\n", 19.9 + 0.2 * odd - 60.0 * f64::exp_m1(-t / 600.0))
    };
    let rows: String = (0..180).map(row).collect();
    folder.write("r.csv", &format!("t [s],ring [degC]\n{rows}"));
    folder
}

const FIT: &str = "[fit.a]\ndata = \"r.csv\"\ncolumn.ring = \"body.T\"\nsigma = \"0.1 K\"\n";

const UNSURE: &str = "R = \"0.3 K/W\"\nC = \"2 kJ/K\"\nP = \"200 ± 10 W\"";

/// `P = "200 ± 10 W"` that is not varied counted as exact without a word. The record tells P R, so a P
/// that is off by 5 % moves R by 5 % of 0.3 K/W.
#[test]
fn a_fit_says_what_it_takes_as_exact() {
    let says = |vary: &str, line: &str| {
        let ran =
            folder(UNSURE, &format!("{FIT}vary = {vary}")).run(&["fit", "network", "body.toml"]);
        ran.exits(0).says("fit::taken_as_exact").says("`P` (± 10 W)").says(line)
    };
    says("[\"R\", \"C\"]", "`vary = [\"R\", \"C\", \"P\"]`").says("moves `R` by 0.015 K/W");
    says("{ R = { from = \"0.1 K/W\" }, C = {} }", "add `P = {}` to `vary`");
    let compared = folder(
        UNSURE,
        &format!("{FIT}vary = [\"R\", \"C\"]\n{}vary = [\"R\"]", FIT.replace("fit.a", "fit.b")),
    );
    compared.run(&["fit", "compare", "body.toml"]).says("a: fit `a` does not vary `P` (± 10 W)");
    let silent = |param: &str, vary: &str| {
        let ran =
            folder(param, &format!("{FIT}vary = {vary}")).run(&["fit", "network", "body.toml"]);
        assert!(!ran.err.contains("taken_as_exact"), "{}", ran.err);
    };
    silent(UNSURE, "[\"R\", \"C\", \"P\"]");
    silent(&UNSURE.replace("± 10 W", "± 0 W"), "[\"R\", \"C\"]");
    // a thousandth of a standard error matters to nobody
    silent(&UNSURE.replace("± 10 W", "± 0.0001 W"), "[\"R\", \"C\"]");
}

/// The same of a plan: C, which is not in `vary`, has a `±` of 10 % that P then has too.
#[test]
fn a_plan_says_what_it_takes_as_exact() {
    let param = "R = \"0.3 K/W\"\nC = \"2 kJ/K ± 10 %\"\nP = \"200 W\"";
    let plan = |vary: &str| {
        format!(
            "[plan.power]\nknow = {{ P = \"5 %\" }}\nvary = {vary}\nplace = {{ ring = {{ of = \
             \"body.T\", noise = \"0.1 K\" }} }}\nevery = \"1 s\"\nduration = \"30 min\""
        )
    };
    let ran = folder(param, &plan("[\"R\"]")).run(&["plan", "body.toml"]).exits(0);
    let ran = ran.says("plan::taken_as_exact").says("`C` (± 0.2 kJ/K)");
    ran.says("moves `P` by 20 W, 2 times").says("`vary = [\"R\", \"C\"]`");
    let ran = folder(param, &plan("[\"R\", \"C\"]")).run(&["plan", "body.toml"]).exits(1);
    assert!(!ran.err.contains("taken_as_exact"), "{}", ran.err);
}

/// A fit held R at 0.3 K/W where runs, sizes and comparisons of the same netlist have 0.5 K/W.
#[test]
fn a_fit_beside_a_posterior_says_what_it_holds() {
    let param = "R = \"0.3 K/W\"\nC = \"2 kJ/K\"\nP = \"200 W\"";
    let quantity = "{\"name\": \"R\", \"of\": \"parameter\", \"value\": 0.5, \"unit\": \"K/W\", \
        \"standard_error\": 0.05, \"distribution\": \"normal\"}";
    let posterior = format!(
        "{{\"format\": 1, \"kind\": \"posterior\", \"network\": \"body\", \"fit\": \"x\", \
         \"quantities\": [{quantity}], \"covariance\": [[0.0025]]}}"
    );
    let ran = |vary: &str| {
        let study = "[uncertainty]\nposterior = \"p.json\"\n".to_owned() + FIT;
        let folder = folder(param, &format!("{study}vary = {vary}"));
        folder.write("p.json", &posterior);
        folder.run(&["fit", "network", "body.toml"]).exits(0)
    };
    let held = ran("[\"C\", \"P\"]");
    held.says("fit::other_posterior").says("`R` at 0.3, while the posterior has 0.5 K/W");
    let varied = ran("[\"R\", \"C\"]");
    assert!(!varied.err.contains("other_posterior"), "{}", varied.err);
}

/// `--set "P=200 ± 1 W"` of a fit left the `±` of the file: P was known to 10 W. The record tells P R,
/// and what is known of P beforehand is all that tells P.
#[test]
fn a_fit_counts_what_is_set() {
    let folder = folder(UNSURE, &format!("{FIT}vary = [\"R\", \"C\", \"P\"]"));
    for (set, expected) in
        [("P=200 ± 1 W", 1.0), ("P=200 W ± 2 % (lognormal)", 4.0), ("R=0.3 K/W", 10.0)]
    {
        let words = ["fit", "network", "body.toml", "--format", "json", "--set", set];
        let json = folder.run(&words).exits(0).json();
        let found = json["parameters"]["P"]["standard_error"].as_f64().expect("a number");
        assert!((found / expected - 1.0).abs() < 0.01, "{set}: {found}");
    }
}
