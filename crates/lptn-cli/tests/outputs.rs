//! Command line: reports, windows and balances of one node.

use crate::common;

use common::{Folder, GEARBOX, csv};

/// The gearbox with more in its `[run]`.
fn gearbox(more: &str) -> Folder {
    Folder::with("g.toml", &GEARBOX.replace("[run]\n", &format!("[run]\n{more}\n")))
}

const REPORT: &str = "report = { rise = \"steel.T - air.T\", share = \"internal.Q / P_7000\" }";
const WINDOW: &str = "window = { climb = { from = \"10 min\", to = \"20 min\" } }";

#[test]
fn a_report_is_a_column_everywhere() {
    let folder = gearbox(REPORT);
    let ran = folder.run(&["run", "g.toml", "--format", "csv", "--no-files"]).exits(0);
    let (headers, rows) = csv(&ran.out);
    let at = |name: &str| headers.iter().position(|header| header == name).unwrap();
    let (rise, share) = (at("rise [K]"), at("share [-]"));
    for row in &rows {
        assert!((row[rise] - (row[at("steel.T [degC]")] - row[at("air.T [degC]")])).abs() < 1e-9);
        assert!((row[share] - row[at("internal.Q [W]")] / 220.6).abs() < 1e-12);
    }
    folder.run(&["run", "g.toml", "--no-files"]).exits(0).prints("rise [K]").prints("share [-]");
    let json =
        folder.run(&["run", "g.toml", "--format", "json", "--no-files", "--select", "rise"]).json();
    assert_eq!(json["columns"][1], serde_json::json!({ "name": "rise", "unit": "K" }));
    let steady = folder.run(&["steady", "g.toml", "--format", "json"]).exits(0).json();
    // 67.2 K over the ambient: the paper
    assert!((steady["values"]["rise"]["value"].as_f64().unwrap() - 67.2).abs() < 1e-9);
    assert!((steady["values"]["share"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn a_window_stands_in_the_table_in_json_and_in_a_file() {
    let folder = gearbox(&format!("{REPORT}\n{WINDOW}"));
    let ran = folder.run(&["run", "g.toml"]).exits(0).prints("climb: 10 min to 20 min");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let files = ["events.csv", "manifest.json", "result.csv", "state.json", "windows.csv"];
    assert_eq!(folder.files()[1..], files.map(|name| format!("out/g/{name}")));
    let file = folder.read("out/g/windows.csv");
    assert!(
        file.starts_with("window,column,unit,from [s],to [s],mean,min,min_at [s],max,max_at [s]\n")
    );
    assert!(file.contains("\nclimb,rise,K,600,1200,"), "{file}");
    let json = folder.run(&["run", "g.toml", "--format", "json", "--no-files"]).json();
    let steel = &json["windows"]["climb"]["columns"]["steel.T"];
    let (mean, min) =
        (steel["mean"]["value"].as_f64().unwrap(), steel["min"]["value"].as_f64().unwrap());
    assert!(min < mean && mean < steel["max"]["value"].as_f64().unwrap());
    assert_eq!(
        (steel["min_at"]["value"].as_f64(), steel["mean"]["unit"].as_str()),
        (Some(600.0), Some("degC"))
    );
    // a later run without windows leaves no old file behind
    folder.write("g.toml", GEARBOX);
    folder.run(&["run", "g.toml"]).exits(0);
    assert_eq!(folder.files()[1..], files.map(|name| format!("out/g/{name}"))[..4]);
}

#[test]
fn the_balance_of_a_node_closes() {
    let folder = gearbox("");
    let ran = folder.run(&["run", "g.toml", "--no-files", "--balance", "steel"]).exits(0);
    let ran = ran.prints("heat into steel").prints("to aluminium").prints("= stored");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let json = folder
        .run(&["run", "g.toml", "--no-files", "--balance", "steel", "--format", "json"])
        .json();
    let balance = &json["balance"];
    let value = |of: &serde_json::Value| of["value"].as_f64().unwrap();
    assert_eq!(balance["terms"][0]["name"], "P_disp");
    assert_eq!(balance["terms"][1]["other"], "aluminium");
    // 220.6 W for 25 min
    assert!((value(&balance["terms"][0]["heat"]) - 330_900.0).abs() < 1e-3);
    assert!((value(&balance["heat"]) - value(&balance["stored"])).abs() < 1e-3);
    let steady =
        folder.run(&["steady", "g.toml", "--balance", "bed", "--format", "json"]).exits(0).json();
    let bed = value(&steady["values"]["bed.Q"]);
    assert!((value(&steady["balance"]["power"]) + bed).abs() < 1e-9);
    folder
        .run(&["steady", "g.toml", "--balance", "aluminium"])
        .exits(0)
        .prints("heat into aluminium");
}

/// A heater whose power falls with temperature, and a thermostat whose fan carries heat away.
const FALLING: &str = r#"
format = 1
[default]
T0 = "25 degC"
[node]
n1 = { C = "120 J/K" }
n2 = { C = "900 J/K" }
[boundary]
amb = { T = "25 degC" }
[resistor]
inner = { from = "n1", to = "n2", G = "3 W/K" }
outer = { from = "n2", to = "amb", G = "1.5 W/K" }
[source]
heater = { into = "n1", P = "90 [W] * (1 - 0.004 [1/K] * (T - 25 [degC]))" }
[run]
stop = "20 min"
output = { every = "5 s" }
"#;

/// The columns of the table decide no heat of a balance: the power of the heater at the end is that
/// of the temperature at the end, 90 W (1 - 0.004 (T - 25 degC)).
#[test]
fn columns_decide_nothing_of_a_balance() {
    let fan = "[control]\nfan = { sense = \"n2\", on_above = \"40 degC\", off_below = \"39 degC\" }\n\
               [source.blown]\ninto = \"n2\"\nP = \"-30 [W] * fan\"\n[run]";
    for text in [FALLING.to_owned(), FALLING.replace("[run]", fan)] {
        let folder = Folder::with("f.toml", &text);
        let run = |more: &[&str]| {
            let words = ["run", "f.toml", "--no-files", "--balance", "n1", "--format", "json"];
            folder.run(&[&words, more].concat()).exits(0).json()
        };
        let (all, one) = (run(&[]), run(&["--select", "n2.T"]));
        assert_eq!(all["balance"], one["balance"]);
        let terms = one["balance"]["terms"].as_array().unwrap();
        let power = terms.iter().find(|term| term["name"] == "heater").unwrap();
        let power = power["power"]["value"].as_f64().unwrap();
        let columns = all["columns"].as_array().unwrap();
        let place = columns.iter().position(|column| column["name"] == "n1.T").unwrap();
        let last = all["rows"].as_array().unwrap().last().unwrap()[place].as_f64().unwrap();
        assert!((power - 90.0 * (1.0 - 0.004 * (last - 25.0))).abs() < 1e-6, "{power} at {last}");
    }
}

/// A table that ends just below the peak of a node is left, whatever is printed. The limit is what
/// looks there.
#[test]
fn columns_decide_nothing_of_a_law_that_is_left() {
    let text = FALLING
        .replace("G = \"1.5 W/K\"", "G = \"gg(T_from)\"")
        .replace("P = \"90 [W] * (1 - 0.004 [1/K] * (T - 25 [degC]))\"", "P = \"300 [W] * s\"")
        .replace("stop = \"20 min\"", "stop = \"400 s\"")
        .replace("every = \"5 s\"", "every = \"0.5 s\"")
        .replace("120 J/K", "60 J/K")
        + "[signal]\ns = { t = [\"0 s\", \"100 s\", \"101 s\", \"2000 s\"], \
           v = [\"1\", \"1\", \"0\", \"0\"] }\n\
           [limit]\nm = { of = \"n2.T\", below = \"150 degC\" }\n[table.gg]\nx = [\"0 degC\", \"END degC\"]\n\
           y = [\"1.5 W/K\", \"1.9 W/K\"]\n";
    // the peak by the margin of the limit, with a table that is not left
    let wide = text.replace("END", "60");
    let wide =
        Folder::with("g.toml", &wide).run(&["run", "g.toml", "--no-files", "--format", "json"]);
    let peak = 150.0 - wide.exits(0).json()["limits"]["m"]["margin"]["value"].as_f64().unwrap();
    for below in [1e-3, 1e-4, 3e-5] {
        // a table that ends elsewhere is another one: of the same slope
        let slope = 0.4 / 60.0;
        let end = peak - below;
        let text = text.replace("1.9 W/K", &format!("{} W/K", 1.5 + slope * end));
        let folder = Folder::with("g.toml", &text.replace("END", &end.to_string()));
        for more in [&[][..], &["--select", "n2.T"], &["--select", "n1.T"]] {
            folder.run(&[&["run", "g.toml", "--no-files"], more].concat()).exits(3);
        }
    }
}

#[test]
fn a_balance_of_nothing_is_refused_with_the_name_that_is_near() {
    let folder = gearbox("");
    let run = |name: &str| folder.run(&["run", "g.toml", "--no-files", "--balance", name]).exits(2);
    run("stel").says("balance::unknown_node").says("did you mean `steel`?");
    run("internal").says("a path between `steel` and `aluminium`");
    run("P_disp").says("a source into `steel`");
    folder
        .run(&["steady", "g.toml", "--balance", "steel", "--format", "csv"])
        .exits(2)
        .says("balance::csv");
}

#[test]
fn a_limit_may_be_on_a_heat_flow() {
    let text =
        format!("{GEARBOX}\n[limit]\nbed_heat = {{ of = \"mill_bed.Q\", below = \"100 W\" }}\n");
    let folder = Folder::with("g.toml", &text);
    folder.run(&["run", "g.toml", "--no-files"]).exits(1).says("mill_bed.Q below 100 W");
    folder.run(&["steady", "g.toml"]).exits(1).says("by 54.42 W");
}
