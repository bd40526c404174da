//! `lptn fit network`
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use std::fmt::Write as _;

use common::Folder;

/// `T = 25.5 degC + rise (1 - exp(-t / tau))`, every 30 s for 25 min.
fn record(rise: f64, tau: f64) -> String {
    let mut text = "t [s],ring [degC]\n".to_owned();
    for k in 0..=50 {
        let t = 30.0 * f64::from(k);
        writeln!(text, "{t},{:.9}", 25.5 + rise * (1.0 - f64::exp(-t / tau))).unwrap();
    }
    text
}

fn netlist(param: &str, fit: &str) -> String {
    format!(
        "format = 1\n\n[param]\n{param}\n\n[node]\nbody = {{ C = \"C\", T0 = \"25.5 degC\" \
         }}\n\n[boundary]\n\
         air = {{ T = \"25.5 degC\" }}\n\n[resistor]\nskin = {{ from = \"body\", to = \"air\", R \
         = \"R\" }}\n\n\
         [source]\nheat = {{ into = \"body\", P = \"P\" }}\n\n[fit.heating]\ndata \
         = \"record.csv\"\n\
         column = {{ ring = \"body.T\" }}\n{fit}\n"
    )
}

/// A rise of 67.2 K with a time constant of 810 s.
fn folder(param: &str, fit: &str) -> Folder {
    let folder = Folder::with("body.toml", &netlist(param, fit));
    folder.write("record.csv", &record(67.2, 810.0));
    folder
}

const OWN: &str = "P = \"200 W\"\nR = \"0.3 K/W\"\nC = \"2600 J/K\"";

#[track_caller]
fn near(found: &serde_json::Value, expected: f64, relative: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:?} is not {expected:?}");
}

/// Analytic: the record holds `P R` and `R C` and no more.
#[test]
fn what_a_record_cannot_tell_is_said_in_words() {
    let folder = folder(OWN, "vary = [\"P\", \"R\", \"C\"]");
    let run = folder.run(&["fit", "network", "body.toml"]).exits(1);
    let text = run.out.replace('\n', " ");
    let told = "only P R and R C are determined (here 67.2 K and 810 s); fix one, for example give \
        C a prior with `±`";
    assert!(text.contains(told), "{text}");
    assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
    let json = folder.run(&["fit", "network", "body.toml", "--format", "json"]).exits(1).json();
    assert_eq!(
        (&json["identifiable"], &json["rank"]),
        (&serde_json::json!(false), &serde_json::json!(2))
    );
    let determined = &json["unidentified"][0]["determined"];
    assert_eq!(determined[0]["combination"], "P R");
    near(&determined[0]["value"]["value"], 67.2, 1e-6);
    assert_eq!(determined[1]["value"]["unit"], "s");
    near(&determined[1]["value"]["value"], 810.0, 1e-6);
    assert!(json["parameters"]["P"]["standard_error"].is_null());
    // nothing is written that is not known
    let before = folder.read("body.toml");
    folder.run(&["fit", "network", "body.toml", "--write"]).exits(1);
    assert_eq!(folder.read("body.toml"), before);
}

/// Analytic: with C known, `R = 810 s / C` and `P = 67.2 K / R`; the relative error of C goes on to
/// both.
#[test]
fn a_prior_makes_all_known_and_write_keeps_the_rest_of_the_file() {
    let own = "P = \"200 W\"  # not split\nR = '0.3 K/W'\nC = \"2.6 kJ/K ± 5 %\"  # weighed";
    let folder = folder(own, "sigma = \"0.1 K\"\nvary = [\"P\", \"R\", \"C\"]");
    let json =
        folder.run(&["fit", "network", "body.toml", "heating", "--format", "json"]).exits(0).json();
    let parameter = |name: &str| &json["parameters"][name];
    near(&parameter("C")["value"], 2600.0, 1e-6);
    near(&parameter("R")["value"], 810.0 / 2600.0, 1e-6);
    near(&parameter("P")["value"], 67.2 * 2600.0 / 810.0, 1e-6);
    near(&parameter("C")["standard_error"], 130.0, 1e-3);
    near(&parameter("P")["standard_error"], 0.05 * 67.2 * 2600.0 / 810.0, 1e-3);
    assert_eq!((&parameter("P")["unit"], &parameter("C")["prior"]), (&"W".into(), &130.0.into()));
    near(&json["correlation"]["P"]["C"], 1.0, 1e-3);
    near(&json["correlation"]["R"]["C"], -1.0, 1e-3);
    assert_eq!(
        (&json["identifiable"], &json["gradient"], &json["samples"]),
        (&true.into(), &"exact".into(), &51.into())
    );
    assert!(json["rms"]["value"].as_f64().unwrap() < 1e-6 && json["rms"]["unit"] == "K");
    folder.run(&["fit", "network", "body.toml", "--write"]).exits(0);
    let text = folder.read("body.toml");
    let number = |from: &str, to: &str| {
        let behind = text.split(from).nth(1).unwrap_or_else(|| panic!("no {from} in {text}"));
        let number = behind.split(to).next().unwrap();
        assert!(number.len() <= 11, "{number}");
        serde_json::Value::from(number.parse::<f64>().unwrap())
    };
    near(&number("P = \"", " W\"  # not split\n"), 67.2 * 2600.0 / 810.0, 1e-7);
    near(&number("R = '", " K/W'\n"), 810.0 / 2600.0, 1e-7);
    near(&number("C = \"", " kJ/K ± 5 %\"  # weighed\n"), 2.6, 1e-7);
}

#[test]
fn a_parameter_on_a_bound_says_so() {
    let folder = folder(OWN, "vary = { R = { from = \"0.2 K/W\", to = \"0.305 K/W\" }, P = {} }");
    let run = folder.run(&["fit", "network", "body.toml"]).exits(0);
    assert!(run.out.contains("on its greatest value"), "{}", run.out);
    assert!(run.err.contains("fit::on_bound"), "{}", run.err);
    let json = folder.run(&["fit", "network", "body.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["parameters"]["R"]["on_bound"], "to");
    assert!(json["parameters"]["R"]["standard_error"].is_null());
    assert!(json["parameters"]["P"]["standard_error"].is_number());
    near(&json["parameters"]["R"]["value"], 0.305, 1e-15);
    assert_eq!(json["starts"]["tried"], 5);
}

/// Two paths side by side: only their sum is felt.
#[test]
fn of_two_conductances_side_by_side_the_sum_is_known() {
    let text = netlist(
        "G1 = \"1 W/K\"\nG2 = \"2 W/K\"\nC = \"2659 J/K\"\nP = \"220.6 W\"",
        "vary = [\"G1\", \"G2\"]",
    )
    .replace("R = \"R\" }", "G = \"G1\" }\nclamp = { from = \"body\", to = \"air\", G = \"G2\" }");
    let folder = Folder::with("body.toml", &text);
    folder.write("record.csv", &record(220.6 / 3.3, 2659.0 / 3.3));
    let run = folder.run(&["fit", "network", "body.toml"]).exits(1);
    assert!(run.out.contains("only G1 + G2 is determined (here 3.3 W/K); fix one"), "{}", run.out);
}

/// The mean of two nodes is a temperature that can be fitted; a heat flow is none.
#[test]
fn columns_measure_temperatures() {
    let text = netlist(OWN, "vary = [\"P\", \"R\"]")
        .replace("ring = \"body.T\"", "ring = \"mean(body.T, twin.T)\"");
    let text =
        text.replace("[boundary]", "twin = { C = \"1 J/K\", T0 = \"25.5 degC\" }\n\n[boundary]");
    let text = text.replace(
        "[source]",
        "link = { from = \"twin\", to = \"body\", R = \"1e-5 K/W\" }\n\n[source]",
    );
    let folder = Folder::with("body.toml", &text);
    folder.write("record.csv", &record(67.2, 810.0));
    let json = folder.run(&["fit", "network", "body.toml", "--format", "json"]).exits(0).json();
    // the twin adds 1 J/K
    near(&json["parameters"]["R"]["value"], 810.0 / 2601.0, 1e-5);
    // what the path carries is P as long as the body has no part in it: the records say 67.2 W
    let heat = netlist(OWN, "vary = [\"P\"]").replace("ring = \"body.T\"", "ring = \"skin.Q\"");
    folder.write("heat.toml", &heat.replace("C = \"2600 J/K\"", "C = \"2700 J/K\""));
    let heat = record(67.2, 810.0).replace("[degC]", "[W]");
    let lines = heat.lines().map(|line| match line.split_once(',') {
        Some((t, w)) if !w.contains('[') => {
            format!("{t},{:.9}\n", w.parse::<f64>().unwrap() - 25.5)
        }
        _ => format!("{line}\n"),
    });
    folder.write("record.csv", &lines.collect::<String>());
    let json = folder.run(&["fit", "network", "heat.toml", "--format", "json"]).exits(0).json();
    near(&json["parameters"]["P"]["value"], 67.2, 1e-6);
    assert_eq!(
        (&json["rms"]["unit"], &json["columns"][0]["rms"]["unit"]),
        (&"W".into(), &"W".into())
    );
    folder.run(&["fit", "network", "heat.toml", "-o", "out"]).exits(0).prints("misfit rms [W]");
    let csv = folder.read("out/residuals.csv");
    assert!(csv.starts_with("record,column,unit,time [s],measured [unit]"), "{csv}");
}

/// An offset in a column that starts at 0 was read as if it were not there, then estimated without
/// any effect. The offset is that of the record: all of it is 1.5 K too high.
#[test]
fn regression_a_parameter_in_a_column_does_not_vanish_when_it_is_zero() {
    let own = format!("{OWN}\no1 = \"0 K\"\nshare = 0.5");
    let folder = Folder::empty();
    let high = record(67.2, 810.0).replace(",25.500000000", ",27.000000000");
    let lines = high.lines().enumerate().map(|(i, line)| match line.split_once(',') {
        Some((t, v)) if i > 1 => format!("{t},{:.9}\n", v.parse::<f64>().unwrap() + 1.5),
        _ => format!("{line}\n"),
    });
    folder.write("record.csv", &lines.collect::<String>());
    let fit = |column: &str, vary: &str| {
        let text = netlist(&own, &format!("vary = [\"P\", \"R\", {vary}]"))
            .replace("\"body.T\"", &format!("\"{column}\""));
        folder.write("body.toml", &text);
        folder.run(&["fit", "network", "body.toml", "--format", "json"])
    };
    for column in ["body.T + o1", "if(body.T > 900 [degC], body.T + 5 [K], body.T + o1)"] {
        let json = fit(column, "\"o1\"").exits(0).json();
        near(&json["parameters"]["o1"]["value"], 1.5, 1e-6);
        near(&json["parameters"]["R"]["value"], 810.0 / 2600.0, 1e-6);
    }
    for [column, unfelt] in
        [["body.T + 0 * o1", "o1"], ["body.T + share * (body.T - body.T)", "share"]]
    {
        let json = fit(column, &format!("\"{unfelt}\"")).exits(1).json();
        let verdict = json["verdict"].as_str().unwrap();
        assert!(verdict.contains(&format!("no column depends on `{unfelt}`")), "{verdict}");
    }
    fit("25 [degC] + o1", "\"o1\"").exits(2).says("fit::observed");
}

/// The power leaps up where G passes 3.2 W/K, before the misfit has its minimum: there is none.
#[test]
fn a_search_that_finds_no_minimum_exits_3_and_prints_no_value() {
    let text = netlist(
        "G = \"3 W/K\"\nC = \"2659 J/K\"\nP = \"if(G < 3.2 [W/K], 220.6 [W], 2000 [W])\"",
        "vary = [\"G\"]",
    )
    .replace("R = \"R\" }", "G = \"G\" }");
    let folder = Folder::with("body.toml", &text);
    folder.write("record.csv", &record(220.6 / 3.3, 2659.0 / 3.3));
    let run = folder.run(&["fit", "network", "body.toml"]).exits(3);
    assert!(run.out.is_empty() && run.err.contains("fit::not_converged"), "{}", run.err);
}

/// Regression: two values give two parameters and no misfit, which is no reason for errors of 0.
#[test]
fn where_no_values_are_left_over_it_is_said() {
    let folder = folder(OWN, "sigma = \"0.1 K\"\nvary = [\"R\", \"C\"]");
    folder.write("record.csv", "t [s],ring [degC]\n300,46.2\n900,70.4\n");
    let said = |text: String| text.replace('\n', " ");
    let with = said(folder.run(&["fit", "network", "body.toml"]).exits(0).out);
    assert!(
        with.contains("no values are left to estimate errors from, so they follow from `sigma`"),
        "{with}"
    );
    folder.write("body.toml", &netlist(OWN, "vary = [\"R\", \"C\"]"));
    let without = said(folder.run(&["fit", "network", "body.toml"]).exits(0).out);
    assert!(
        without.trim_end().ends_with("no values are left to estimate errors from"),
        "{without}"
    );
}

/// Regression: a parameter that no column depends on was said to be as before, and priors took no
/// part in the verdict.
#[test]
fn a_verdict_claims_no_more_than_is_so() {
    let other = "idle = \"3 W\"\n".to_owned() + OWN;
    let text = netlist(&other, "vary = [\"R\", \"idle\"]")
        .replace("[boundary]", "other = { C = \"1 J/K\", T0 = \"25.5 degC\" }\n\n[boundary]")
        .replace("[source]", "wire = { from = \"other\", to = \"air\", R = \"1 K/W\" }\n\n[source]")
        .replace(
            "[fit.heating]",
            "elsewhere = { into = \"other\", P = \"idle\" }\n\n[fit.heating]",
        );
    let folder = folder(&other, "");
    folder.write("body.toml", &text);
    let text = folder.run(&["fit", "network", "body.toml"]).exits(1).out;
    assert!(text.contains("no column depends on `idle`") && !text.contains("as before"), "{text}");
    folder.write(
        "body.toml",
        &netlist(
            &OWN.replace("J/K\"", "J/K ± 5 %\""),
            "sigma = \"0.1 K\"\nvary = [\"P\", \"R\", \"C\"]",
        ),
    );
    let text = folder.run(&["fit", "network", "body.toml"]).exits(0).out;
    assert!(text.contains("the records and the priors (±) determine the 3 parameters"), "{text}");
}

/// Regression: a model that misses a record by many sigma, and a value far from its prior, passed
/// without a word.
#[test]
fn a_misfit_and_a_contradicted_prior_are_warned_of() {
    let folder = folder(OWN, "sigma = \"0.01 K\"\nvary = [\"R\"]");
    let err = folder.run(&["fit", "network", "body.toml"]).exits(0).err;
    assert!(err.contains("fit::misfit") && err.contains("`ring`"), "{err}");
    let own = OWN.replace("0.3 K/W", "0.2 K/W ± 1 %");
    folder.write("body.toml", &netlist(&own, "sigma = \"0.01 K\"\nvary = [\"R\", \"P\"]"));
    let err = folder.run(&["fit", "network", "body.toml"]).exits(0).err;
    assert!(
        err.contains("fit::prior") && err.contains("`R`") && err.contains("from its prior 0.2"),
        "{err}"
    );
}

/// Analytic: three equally good values of R 0.009 K/W apart have a mean with an error of 0.009 K/W
/// over the root of 3, two degrees of freedom, and 4.303 as the quantile of Student's t.
#[test]
fn records_that_differ_are_warned_of_and_counted() {
    let text = netlist(OWN, "vary = [\"R\", \"C\"]")
        .replace("\"record.csv\"", "[\"a.csv\", \"b.csv\", \"c.csv\"]");
    let folder = Folder::with("body.toml", &text);
    for (name, resistance) in [("a.csv", 0.291), ("b.csv", 0.3), ("c.csv", 0.309)] {
        folder.write(name, &record(200.0 * resistance, resistance * 2600.0));
    }
    let run = folder.json("fit network body.toml").exits(0);
    let json = run.json();
    let resistance = &json["parameters"]["R"];
    let error = 0.009 / f64::sqrt(3.0);
    near(&resistance["value"], 0.3, 1e-3);
    near(&resistance["standard_error"], error, 0.03);
    near(&resistance["interval_95"][1], 0.3 + 4.303 * error, 2e-3);
    assert_eq!(resistance["between_records"]["differ"], true);
    let told = &json["warnings"][0];
    assert_eq!(told["code"], "fit::records_differ");
    assert!(told["message"].as_str().unwrap().contains("`R`"), "{told}");
}

#[test]
fn what_is_wrong_with_the_question() {
    let folder = folder(OWN, "vary = [\"R\"]");
    let said = |args: &[&str], exit: i32| {
        folder.run(&[&["fit", "network"], args].concat()).exits(exit).err
    };
    assert!(said(&["body.toml", "heatin"], 2).contains("did you mean `heating`?"));
    folder.write("none.toml", netlist(OWN, "").split("[fit").next().unwrap());
    assert!(said(&["none.toml"], 2).contains("fit::no_study"));
    let late = netlist(OWN, "vary = [\"R\"]\n[run]\nstart = \"10 s\"\nstop = \"1 h\"");
    folder.write("late.toml", &late);
    let late = said(&["late.toml"], 2);
    assert!(late.contains("fit::record_times") && late.contains("set `start` in [run]"), "{late}");
    let written = netlist(
        "P = \"200 W\"\nR0 = \"0.3 K/W\"\nR = \"R0 * 1\"\nC = \"2600 J/K\"",
        "vary = [\"R\"]",
    );
    folder.write("expression.toml", &written);
    assert!(said(&["expression.toml", "--write"], 2).contains("fit::write"));
    let csv = folder.run(&["fit", "network", "body.toml", "--format", "csv"]).exits(0);
    assert!(csv.out.starts_with("parameter,unit,state,value [unit]"), "{}", csv.out);
}

/// The record holds the curve of the parameters that are fitted: nothing is left but rounding.
#[test]
fn residuals_are_written_beside_the_answer() {
    let folder = folder(OWN, "vary = [\"P\", \"C\"]");
    let asked = ["fit", "network", "body.toml", "-o", "found", "--format", "json"];
    let run = folder
        .run(&asked)
        .exits(0)
        .says("wrote  found/residuals.csv, fit.json, posterior.json, manifest.json");
    assert_eq!(folder.read("found/fit.json"), run.out);
    let text = folder.read("found/residuals.csv");
    let mut lines = text.lines();
    let heading = "record,column,time [s],measured [degC],computed [degC],residual [K]";
    assert_eq!(lines.next(), Some(heading));
    assert_eq!(lines.clone().count(), 51);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        assert_eq!((cells[0], cells[1]), ("record.csv", "ring"));
        assert!(
            (number(3) - number(4) - number(5)).abs() < 1e-9 && number(5).abs() < 1e-3,
            "{line}"
        );
    }
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("found/manifest.json")).unwrap();
    let inputs: Vec<&str> = manifest["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|i| i["name"].as_str().unwrap())
        .collect();
    assert_eq!(inputs, ["body.toml", "record.csv"]);
    assert_eq!(manifest["results"].as_array().unwrap().len(), 3);
}

/// The ends of an interval are value ± half width, for CSV as for JSON.
#[test]
fn csv_has_both_ends_of_every_interval() {
    let folder = folder(OWN, "sigma = \"0.1 K\"\nvary = [\"R\", \"C\"]");
    let csv = folder.run(&["fit", "network", "body.toml", "--format", "csv"]).exits(0).out;
    let cell = |line: &str, k: usize| line.split(',').nth(k).unwrap().parse::<f64>().unwrap();
    for line in csv.lines().skip(1) {
        let [value, half, low, high] = [3, 5, 6, 7].map(|k| cell(line, k));
        assert!((value - half - low).abs() <= 1e-9 * value && half > 0.0, "{line}");
        assert!((value + half - high).abs() <= 1e-9 * value, "{line}");
    }
}

/// An estimated room: JSON gives it in degC, as the text does, and its errors in K. With all else
/// known the record is that of a room of 25.5 degC.
#[test]
fn a_fitted_temperature_is_in_the_unit_of_the_text() {
    let param = "P = \"224 W\"\nR = \"0.3 K/W\"\nC = \"2700 J/K\"\nT_room = \"20 ± 8 degC\"";
    let folder = folder(param, "sigma = \"0.1 K\"\nvary = [\"T_room\"]");
    let text = netlist(param, "sigma = \"0.1 K\"\nvary = [\"T_room\"]");
    folder.write("body.toml", &text.replace("\"25.5 degC\"", "\"T_room\""));
    let run = folder.run(&["fit", "network", "body.toml"]).exits(0);
    assert!(run.out.lines().any(|line| line.starts_with("T_room") && line.contains("degC")));
    let json = folder.run(&["fit", "network", "body.toml", "--format", "json"]).exits(0).json();
    let room = &json["parameters"]["T_room"];
    assert_eq!(room["unit"], "degC");
    near(&room["value"], 25.5, 1e-4);
    near(&room["start"], 20.0, 1e-12);
    near(&room["prior"], 8.0, 1e-12);
    let error = room["standard_error"].as_f64().unwrap();
    assert!(error < 0.1, "{error} K");
    let [low, high] = [0, 1].map(|end| room["interval_95"][end].as_f64().unwrap());
    assert!(low <= 25.51 && 25.49 <= high && high - low < 1.0, "{low} to {high} degC");
    assert_eq!(json["shared_noise"], serde_json::json!([]));
}

/// A body of 2000 J/K, 100 W and 2 W/K rises by 50 (1 - exp(-t / 1000 s)) K; its sensor reads 2.5 K
/// more. The help of the misfit is pasted, and the fit finds them.
#[test]
fn the_sensor_of_a_misfit_can_be_pasted() {
    let text = "format = 1\n[param]\nG = '3 W/K'\n[node]\nbody = { C = '2 kJ/K', T0 = '22 degC' \
                }\n[boundary]\nair = { T = '22 degC' }\n[resistor]\nskin = { from = 'body', to = \
                'air', G = 'G' }\n[source]\nheat = { into = 'body', P = '100 W' }\n[run]\nstop = \
                '1 h'\n[fit.warm]\ndata = 'tc.csv'\ncolumn = { tc = 'body.T' }\nsigma = '0.1 \
                K'\nvary = ['G']\n";
    let folder = Folder::with("x.toml", text);
    let mut record = "t [s],tc [degC]\n".to_owned();
    for i in 0..300_i32 {
        let time = 12.0 * f64::from(i);
        let noise = if i % 2 == 0 { 0.05 } else { -0.05 };
        record += &format!("{time},{}\n", 74.5 - 50.0 * (-time / 1000.0).exp() + noise);
    }
    folder.write("tc.csv", &record);
    let ran = folder.run(&["fit", "network", "x.toml", "--no-files"]);
    let help = ran.err.split_once("does the sensor have an offset of 2.5 K?").unwrap().1.to_owned();
    let column = help.split('`').nth(1).unwrap().replace(['\n'], " ");
    let from = help.find("[sensor.tc]").unwrap();
    let sensor: Vec<&str> = help[from..].lines().take(2).map(str::trim).collect();
    let pasted = text.replace("column = { tc = 'body.T' }", &column);
    folder.write("y.toml", &format!("{pasted}{}\n", sensor.join("\n")));
    let ran = folder.run(&["fit", "network", "y.toml", "--no-files"]);
    assert!(!ran.err.contains("fit::misfit") && ran.out.contains("tc.offset  2."), "{}", ran.out);
}
