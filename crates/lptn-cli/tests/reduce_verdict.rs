//! The verdict of `lptn reduce`, and the error over every load.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use serde_json::Value;

fn number(json: &Value, path: &[&str]) -> f64 {
    let value = path.iter().fold(json, |json, key| &json[*key]);
    value["value"].as_f64().unwrap_or_else(|| panic!("no number at {path:?} in\n{json:#}"))
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// Two nodes whose run is a twelfth of their slowest time constant: the pair is that of the network,
/// and the first line says how wrong it is.
const SHORT: &str = r#"format = 1
[node]
s = { C = "1235 J/K", T0 = "25 degC" }
a = { C = "1424 J/K", T0 = "25 degC" }
[boundary]
air = { T = "25 degC" }
[resistor]
i = { from = "s", to = "a", R = "0.1 K/W" }
o = { from = "a", to = "air", R = "0.3 K/W" }
[source]
p = { into = "s", P = "100 W" }
[run]
stop = "70 s"
"#;

/// A pair that is right in a short run only was recommended without a word.
#[test]
fn regression_the_recommended_pair_does_not_follow_a_short_run() {
    let folder = Folder::with("short.toml", SHORT);
    folder.write("long.toml", &SHORT.replace("70 s", "5 h"));
    let reduce = |file, more: &[&str]| {
        let begin = ["reduce", file, "--port", "s", "--format", "json"];
        folder.run(&[&begin[..], more].concat())
    };
    let [short, long] = ["short.toml", "long.toml"].map(|file| reduce(file, &[]));
    let (short, long) = (short.exits(1).json(), long.exits(0).json());
    assert_eq!(short["verdict"]["collapses"], false);
    assert_eq!(long["verdict"]["collapses"], true);
    assert_eq!(short["recommended"], long["recommended"]);
    assert_eq!(short["C_eq"], long["C_eq"]);
    let warning = "the run of 70 s is shorter than tau_1, 14.33 min";
    assert!(short["notes"][0].as_str().unwrap().starts_with(warning), "{short:#}");
    let by_run = reduce("short.toml", &["--for", "run"]).json();
    assert!(number(&by_run, &["C_eq", "least_squares"]) < 0.9 * number(&long, &["C_eq", "sum"]));
    assert_eq!(by_run["recommended_by"], "run");
    let ran = folder.run(&["reduce", "short.toml", "--port", "s"]).exits(1);
    let first = ran.out.lines().next().unwrap_or_default();
    assert!(first.starts_with("does not collapse: one node is "), "{first}");
    ran.prints("is then too cold by at most").prints(&format!("warning: {warning}"));
}

/// A constant stream was refused as not linear; 0.1 K/W + 1 / (15 W/K) is exact.
#[test]
fn regression_a_cooled_machine_has_its_resistance() {
    let cooled = SHORT
        .replace("o = { from = \"a\", to = \"air\", R = \"0.3 K/W\" }", "")
        .replace(
            "[source]",
            "[advection]\nin = { from = \"air\", to = \"a\", mcp = \"15 W/K\" }\n\
            out = { from = \"a\", to = \"air\", mcp = \"15 W/K\" }\n[source]",
        )
        .replace("70 s", "1 h");
    let folder = Folder::with("cooled.toml", &cooled);
    let json = folder.run(&["reduce", "cooled.toml", "--port", "s", "--format", "json"]).json();
    near(number(&json, &["R_eq"]), 1.0 / 6.0, 1e-13);
    near(number(&json, &["boundary_weights", "air"]), 1.0, 1e-13);
    // a stream that goes on from node to node
    let on = cooled.replace(
        "[advection]",
        "[advection]\nby = { from = \"air\", to = \"s\", mcp = \"2 W/K\" }\n\
         on = { from = \"s\", to = \"a\", mcp = \"2 W/K\" }",
    );
    folder.write("on.toml", &on);
    let ran = folder.run(&["reduce", "on.toml", "--port", "s", "--max-error", "60%"]).exits(0);
    ran.prints("streams go on from node to node").prints("R_eq  ");
    let json = folder
        .run(&["reduce", "on.toml", "--port", "s", "--max-error", "60%", "--format", "json"])
        .exits(0)
        .json();
    // a is at 12/27 of s, which gives 2 W/K away and 10 W/K over the difference
    near(number(&json, &["R_eq"]), 9.0 / 68.0, 1e-13);
    assert!(json["tau_1"].is_null() && json["C_eq"]["least_squares"].is_null());
}

/// Two nodes are what there is: no load tells them from the network.
#[test]
fn as_few_nodes_are_taken_as_keep_a_limit_over_every_load() {
    let folder = Folder::with("long.toml", &SHORT.replace("70 s", "5 h"));
    let reduce =
        |more: &[&str]| folder.run(&[&["reduce", "long.toml", "--port", "s"], more].concat());
    let ran = reduce(&["--error", "0.1K", "--power", "200W", "--write", "two.toml"]).exits(0);
    let ran = ran.says("wrote  two.toml: 2 nodes that replace long.toml");
    assert!(ran.out.starts_with("2 nodes keep 0.1K over every load up to 200 W (exactly)\n"));
    let text = folder.read("two.toml");
    for part in ["n2 = { C = \"14", "R_2 = { from = \"s\", to = \"n2\"", "R_end = { from = \"n2\""]
    {
        assert!(text.contains(part), "{text}");
    }
    folder.run(&["check", "two.toml"]).exits(0);
    let one = reduce(&["--error", "90%", "--format", "json"]).exits(0).json();
    assert_eq!(one["any_load"]["chosen"]["any_load"]["nodes"], 1);
    // the largest heat of the file
    near(number(&one, &["any_load", "power"]), 100.0, 1e-15);
    let none = reduce(&["--error", "0 K"]).exits(2);
    none.says("--error");
    reduce(&["--power", "0 W", "--error", "1 K"]).exits(2).says("reduce::power");
    reduce(&["--nodes", "0"]).exits(2);
    reduce(&["--nodes", "7"]).exits(0).prints("collapses to 2 nodes, exactly");
}

/// The load that is printed, run through the network and through the one node: at its end they are
/// apart by what was promised.
#[test]
fn the_load_with_the_largest_error_shows_it() {
    let net = SHORT.replace("70 s", "5 h");
    let folder = Folder::with("net.toml", &net);
    let arguments = ["reduce", "net.toml", "--port", "s", "--definition", "first_moment"];
    let more = ["--worst", "worst.csv", "--write", "one.toml", "--format", "json"];
    let ran = folder.run(&[&arguments[..], &more].concat()).exits(0);
    let json = ran.says("in a netlist: worst = { csv = \"worst.csv\"").json();
    let promised = number(&json, &["any_load", "chosen", "any_load", "error"]);
    let end = number(&json, &["any_load", "chosen", "end"]);
    let signal = "[signal]\nworst = { csv = \"worst.csv\", time = \"t\", value = \"P\", interp = \
        \"previous\", after_end = \"hold\" }\n[run]";
    let at_end = |name: &str, text: &str, source: &str| {
        let run = format!("stop = \"{end} s\"");
        let text = text.replace(source, "P = \"worst\"").replace("[run]", signal);
        let text = format!(
            "{}[run]\n{run}\ntolerance = \"1e-7 K\"\n",
            text.split("[run]").next().unwrap()
        );
        folder.write(name, &text);
        let json = folder.run(&["run", name, "--no-files", "--format", "json"]).exits(0).json();
        let columns = json["columns"].as_array().unwrap();
        let place = columns.iter().position(|column| column["name"] == "s.T").unwrap();
        json["rows"].as_array().unwrap().last().unwrap()[place].as_f64().unwrap()
    };
    let whole = at_end("whole.toml", &net, "P = \"100 W\"");
    let one = at_end("again.toml", &folder.read("one.toml"), "P = \"100 W\"");
    near(whole - one, promised, 1e-3);
    // a file that is there is not written over
    folder
        .run(&[&arguments[..], &["--worst", "worst.csv"]].concat())
        .exits(2)
        .says("reduce::exists");
}
