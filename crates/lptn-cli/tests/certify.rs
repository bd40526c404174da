//! `--certify`: bounds in every form of an answer, and verdicts that they prove.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::{Folder, csv};

/// 100 J/K that gains 1 W/K more than it loses: 20 degC + (exp(t / 100 s) - 1) K.
const GROWS: &str = r#"format = 1
[node]
body = { C = "100 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "1 W/K" }
[source]
heat = { into = "body", P = "1 [W] + 2 [W/K] * (T - 20 [degC])" }
[limit]
hot = { of = "body.T", below = "167.5 degC" }
near = { of = "body.T", below = "167.4133 degC" }
[run]
stop = "500 s"
output = { every = "50 s" }
"#;

#[test]
fn every_row_is_within_its_bound() {
    let folder = Folder::with("grow.toml", GROWS);
    let words = ["run", "grow.toml", "--certify", "--format", "csv", "--no-files"];
    for tolerance in ["1e-3K", "1e-5K", "1e-7K"] {
        let ran = folder.run(&[&words[..], &["--tolerance", tolerance]].concat());
        let (headers, rows) = csv(&ran.out);
        let column = |name: &str| headers.iter().position(|header| header == name).unwrap();
        let (value, bound) = (column("body.T [degC]"), column("body.T.bound [K]"));
        for row in rows {
            let right = 20.0 + (row[0] / 100.0).exp_m1();
            assert!((row[value] - right).abs() <= row[bound] + 1e-12, "{tolerance}: {row:?}");
        }
    }
}

/// The end, 167.413159 degC, is 1.4e-4 K below the second limit. A run at 1e-3 K is farther from it
/// than that, and its corrected solution is not.
#[test]
fn verdicts_are_proven() {
    let folder = Folder::with("grow.toml", GROWS);
    let run = |tolerance: &str| {
        folder.run(&["run", "grow.toml", "--certify", "--no-files", "--tolerance", tolerance]).out
    };
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let (rough, fine) = (words(run("1e-3K")), words(run("1e-8K")));
    assert!(rough.contains("proven verdicts: `hot` and `near`"), "{rough}");
    assert!(fine.contains("proven verdicts: `hot` and `near`"), "{fine}");
    assert!(!rough.contains("error not bounded"), "{rough}");
}

#[test]
fn objects_have_the_bounds_or_the_reason() {
    let folder = Folder::with("grow.toml", GROWS);
    let found = folder.json("run grow.toml --certify --no-files").json();
    let error = found["proven"]["body"]["value"].as_f64().unwrap();
    assert!(error > 0.0 && error < 1e-3, "{error}");
    let plain = folder.json("run grow.toml --no-files").json();
    assert!(plain.get("proven").is_none());
    let power = "if(T < 30 [degC], 4 [W], 0 [W])";
    let compares = GROWS.replace("1 [W] + 2 [W/K] * (T - 20 [degC])", power);
    let folder = Folder::with("net.toml", &compares);
    let found = folder.json("run net.toml --certify --no-files").json();
    assert!(found.get("proven").is_none());
    let codes = found["warnings"].as_array().unwrap().iter().map(|w| w["code"].clone());
    assert!(codes.into_iter().any(|code| code == "certify::switches"), "{found}");
}

/// 4 W over 2 W/K: 22 degC.
#[test]
fn a_steady_state_is_proven() {
    let text = GROWS.replace("1 [W] + 2 [W/K] * (T - 20 [degC])", "4 W").replace("1 W/K", "2 W/K");
    let folder = Folder::with("net.toml", &text);
    let found = folder.json("steady net.toml --certify").json();
    let error = found["proven"]["body"]["value"].as_f64().unwrap();
    let value = found["values"]["body.T"]["value"].as_f64().unwrap();
    assert!((value - 22.0).abs() <= error && error < 1e-9, "{value} {error}");
}

/// 1000 J/K and 0.5 W/K with 100 W for 300 s of every 1000 s.
const REPEATS: &str = r#"format = 1
[signal]
duty = { t = ["0 s", "300 s"], v = [1, 0], interp = "previous", after_end = "repeat", period = "1000 s" }
[node]
body = { C = "1000 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "0.5 W/K" }
[source]
heat = { into = "body", P = "100 [W] * duty" }
[limit]
hot = { of = "body.T", below = "91.38 degC" }
near = { of = "body.T", below = "91.379 degC" }
[run]
stop = "1000 s"
"#;

/// `T = air + X exp(-t/tau)` from the end of the heat on, `X = 200 K (1 - exp(-300/2000)) /
/// (1 - exp(-1000/2000))`: at most 90.8045 degC.
#[test]
fn a_periodic_steady_state_is_proven() {
    let x = 200.0 * (1.0 - (-0.15_f64).exp()) / (1.0 - (-0.5_f64).exp());
    let (most, least) = (20.0 + x, 20.0 + x * (-0.35_f64).exp());
    let text = REPEATS.replace("91.38 ", &format!("{} ", most + 1e-4));
    let folder = Folder::with("net.toml", &text.replace("91.379 ", &format!("{} ", most - 1e-4)));
    let asked = "steady net.toml --periodic --certify";
    for tolerance in ["1e-3K", "1e-5K", "1e-7K"] {
        let found = folder.json(&format!("{asked} --tolerance {tolerance}")).json();
        let error = found["proven"]["body"]["value"].as_f64().unwrap();
        let of = |key: &str| found["columns"]["body.T"][key]["value"].as_f64().unwrap();
        for (key, right) in [("start", least), ("min", least), ("max", most)] {
            assert!((of(key) - right).abs() <= error + 1e-11, "{tolerance}: {key} {error}");
        }
        assert!(error < 1e-3, "{error}");
        for (name, right) in [("hot", 1e-4), ("near", -1e-4)] {
            let limit = &found["limits"][name];
            let margin = limit["margin"]["value"].as_f64().unwrap();
            let bound = limit["margin_bound"]["value"].as_f64().unwrap();
            assert!((margin - right).abs() <= bound + 1e-11, "{tolerance}: {name} {limit}");
        }
    }
    let text = folder.run(&asked.split(' ').collect::<Vec<_>>()).out;
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("proven verdicts: `hot` and `near`"), "{text}");
    assert!(text.contains("a periodic steady state of the network exists"), "{text}");
}

/// A thermostat: the reason is a warning, and the results are the same.
#[test]
fn a_cycle_without_proof_says_why() {
    let text = REPEATS.replace(
        "[source]\nheat = { into = \"body\", P = \"100 [W] * duty\" }",
        "[control]\nheater = { sense = \"body\", on_below = \"21 degC\", off_above = \"22 degC\" }\n\
         [source]\nheat = { into = \"body\", P = \"100 [W] * duty * heater\" }",
    );
    let folder = Folder::with("net.toml", &text);
    let ran =
        folder.run(&["steady", "net.toml", "--periodic", "--certify", "--tolerance", "1e-3K"]);
    if ran.out.is_empty() {
        return; // no cycle is found
    }
    assert!(ran.err.contains("certify::switches"), "{}", ran.err);
}

/// A monotone cubic through (0 s, 0 W), (50 s, 100 W) and (100 s, 0 W) is `a t + b t^2` with a = 4 W/s
/// and b = -0.04 W/s^2: its slopes at the points are 4, 0 and -4 W/s (the formulas of SciPy's
/// `PchipInterpolator`). A body of C = 100 J/K over G = 2 W/K, tau = 50 s, then is
/// `alpha (1 - exp(-t / tau)) + beta t + gamma t^2` above the air, with gamma = b / G,
/// beta = a / G - 2 tau gamma and alpha = -tau beta. The second signal repeats it.
#[test]
fn signals_of_cubics_are_proven() {
    let text = |points: &str| {
        format!(
            "format = 1\n[signal]\nP = {{ {points}, interp = \"pchip\" }}\n[node]\nbody = {{ C = \"100 J/K\", \
             T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \
             \"body\", to = \"air\", G = \"2 W/K\" }}\n[source]\nheat = {{ into = \"body\", P = \"P\" }}\n[limit]\n\
             hot = {{ of = \"body.T\", below = \"70 degC\" }}\n[run]\nstop = \"100 s\"\noutput = {{ every = \"5 \
             s\" }}\n"
        )
    };
    let exact = |t: f64| {
        let (tau, gamma) = (50.0, -0.02);
        let beta = 2.0 - 2.0 * tau * gamma;
        20.0 + tau * beta * (-t / tau).exp_m1() + beta * t + gamma * t * t
    };
    let points = "t = [\"0 s\", \"50 s\", \"100 s\"], v = [\"0 W\", \"100 W\", \"0 W\"]";
    for (points, period) in
        [(points.to_owned(), false), (format!("{points}, after_end = \"repeat\""), true)]
    {
        let text = text(&points).replace(
            "stop = \"100 s\"",
            if period { "stop = \"250 s\"" } else { "stop = \"100 s\"" },
        );
        let folder = Folder::with("cubic.toml", &text);
        let ran = folder.run(&["run", "cubic.toml", "--certify", "--format", "csv", "--no-files"]);
        assert!(!ran.err.contains("certify::"), "{}", ran.err);
        let (headers, rows) = csv(&ran.out);
        let column = |name: &str| headers.iter().position(|header| header == name).unwrap();
        let (value, bound) = (column("body.T [degC]"), column("body.T.bound [K]"));
        for row in rows {
            assert!(row[bound] < 1e-4, "{row:?}");
            let right = exact(row[0]);
            assert!(row[0] > 100.0 || (row[value] - right).abs() <= row[bound] + 1e-12, "{row:?}");
        }
    }
}

/// A list of limits says limits, and one of requirements and results likewise.
#[test]
fn a_long_list_names_its_kind() {
    let more: String = (0..6)
        .map(|k| format!("l{k} = {{ of = \"body.T\", below = \"{} degC\" }}\n", 200 + k))
        .collect();
    let text = GROWS.replace("[run]\n", &format!("{more}[run]\n"));
    let ran =
        Folder::with("grow.toml", &text).run(&["run", "grow.toml", "--certify", "--no-files"]);
    let words = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("proven verdicts: `hot`, `near` and 6 more limits"), "{words}");
}
