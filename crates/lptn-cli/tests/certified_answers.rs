//! `size --certify` and limits of `steady --certify`: proven margins against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use serde_json::Value;

use crate::common::Folder;

/// 40 W over G: 20 degC + 40 W / G, at most 40 degC if G is at least 2 W/K. Over time with a time
/// constant of 100 J/K / G: at 60 s `20 degC + 40 W / G (1 - exp(-0.6 G / (W/K)))`.
const BODY: &str = r#"format = 1
[param]
G = "3 W/K"
[node]
body = { C = "100 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "G" }
[source]
heat = { into = "body", P = "40 W" }
[limit]
hot = { of = "body.T", below = "33.34 degC" }
near = { of = "body.T", below = "33.33333333 degC" }
[size.skin]
minimise = "G"
vary = { G = { from = "0.5 W/K", to = "20 W/K" } }
require = ["body.T <= 40 [degC]", "skin.Q <= 50 [W]"]
[run]
stop = "60 s"
"#;

fn number(of: &Value) -> f64 {
    of["value"].as_f64().unwrap()
}

/// The margins of the answer with their bounds.
fn margins(found: &Value) -> Vec<(f64, f64, bool)> {
    let one = |of: &Value| {
        (number(&of["margin"]), number(&of["margin_bound"]), of["is_proven"].as_bool().unwrap())
    };
    found["proven"]["margins"].as_array().unwrap().iter().map(one).collect()
}

/// The value that keeps everything with proof in W/K: that of the answer, or the one instead.
fn proven_value(found: &Value) -> f64 {
    match found["proven"]["instead"].as_str() {
        None => number(&found["values"]["G"]),
        Some(text) => {
            let text = text.strip_prefix("G = ").unwrap().strip_suffix(" W/K").unwrap();
            text.parse().unwrap()
        }
    }
}

#[test]
fn a_sized_steady_state_has_proven_margins() {
    let folder = Folder::with("net.toml", BODY);
    let found = folder.json("size net.toml --certify").json();
    let value = number(&found["values"]["G"]);
    let right = [20.0 - 40.0 / value, 10.0];
    let all = margins(&found);
    for ((margin, bound, _), right) in all.iter().zip(right) {
        assert!((margin - right).abs() <= *bound && *bound < 1e-6, "{margin} {right} {bound}");
    }
    assert!(all[1].2, "{found}");
    // the margin is zero, to a bound
    let instead = proven_value(&found);
    assert!((2.0..2.0001).contains(&instead), "{instead}");
    let codes: Vec<&str> =
        found["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect();
    assert_eq!(codes.contains(&"size::undecided"), !all[0].2, "{found}");
}

/// `G` with `40 W / G (1 - exp(-0.6 G)) = 20 K`, by bisection.
fn over_the_run() -> f64 {
    let rise = |g: f64| -40.0 / g * (-0.6 * g).exp_m1();
    let (mut low, mut high) = (0.5_f64, 2.0_f64);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if rise(middle) > 20.0 { low = middle } else { high = middle }
    }
    high
}

#[test]
fn a_sized_run_has_proven_margins() {
    let text = BODY.replace("\"skin.Q <= 50 [W]\"]", "\"skin.Q <= 50 [W]\"]\nover = \"run\"");
    let folder = Folder::with("net.toml", &text);
    let found = folder.json("size net.toml --certify").json();
    let value = number(&found["values"]["G"]);
    let rise = -40.0 / value * (-0.6 * value).exp_m1();
    let right = [20.0 - rise, 50.0 - value * rise];
    for ((margin, bound, _), right) in margins(&found).into_iter().zip(right) {
        assert!(
            (margin - right).abs() <= bound + 1e-13 && bound < 1e-6,
            "{margin} {right} {bound}"
        );
    }
    let (exact, instead) = (over_the_run(), proven_value(&found));
    assert!(instead >= exact && instead < exact * (1.0 + 1e-5), "{instead} {exact}");
}

#[test]
fn a_table_says_what_is_proven() {
    let folder = Folder::with("net.toml", BODY);
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = words(folder.run(&["size", "net.toml", "--certify"]).out);
    assert!(text.contains("proven error") && text.contains("kept (proven)"), "{text}");
    let plain = words(folder.run(&["size", "net.toml"]).out);
    assert!(!plain.contains("proven"), "{plain}");
}

#[test]
fn a_written_value_is_proven() {
    let folder = Folder::with("net.toml", BODY);
    folder.run(&["size", "net.toml", "--certify", "--write"]);
    let found = folder.json("steady net.toml --certify").json();
    let value = found["values"]["body.T"]["value"].as_f64().unwrap();
    let error = number(&found["proven"]["body"]);
    assert!(value + error <= 40.0, "{value} {error}");
}

#[test]
fn an_estimate_is_not_proven() {
    let text = BODY
        .replace("P = \"40 W\"", "P = \"P\"")
        .replace("[param]\n", "[param]\nP = \"40 ± 2 W\"\n")
        .replace("minimise = \"G\"", "minimise = \"G\"\nprobability = \"95 %\"");
    let folder = Folder::with("net.toml", &text);
    let found = folder.json("size net.toml --certify").json();
    let codes = found["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str());
    assert!(codes.into_iter().any(|code| code == "size::no_bound"), "{found}");
    let first = &found["proven"]["margins"][0];
    assert!(first["margin_bound"].is_null() && first["is_proven"].is_null(), "{found}");
}

/// 33.3333333333.. degC: the second limit is broken by 3.3e-9 K.
#[test]
fn limits_of_a_steady_state_are_proven() {
    let folder = Folder::with("net.toml", BODY);
    let found = folder.json("steady net.toml --certify").json();
    let rise = 40.0 / 3.0;
    for (name, bound) in [("hot", 33.34), ("near", 33.333_333_33)] {
        let limit = &found["limits"][name];
        let (margin, error) = (number(&limit["margin"]), number(&limit["margin_bound"]));
        let right = bound - 20.0 - rise;
        assert!((margin - right).abs() <= error + 1e-13 && error < 1e-9, "{limit} {right}");
        assert_eq!(limit["is_proven"], true, "{limit}");
    }
}
