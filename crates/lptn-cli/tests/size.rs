//! `lptn size`, with and without a netlist.

use crate::common;

use common::Folder;

const COOLING: [&str; 7] =
    ["size", "--power", "223 W", "--limit", "110 degC", "--ambient", "35 degC"];

/// T = 20 degC + P/G.
const FAN: &str = "\
# a block
format = 1

[param]
P = \"100 W\"   # heat
G = '3 W/K'   # the fan, # of course

[node]
block = { T0 = \"20 degC\", C = \"1 kJ/K\" }

[boundary]
air = { T = \"20 degC\" }

[resistor]
skin = { from = \"block\", to = \"air\", G = \"G\" }

[source]
loss = { into = \"block\", P = \"P\" }

[size.fan]
minimise = \"G\"
vary = { G = { from = \"0.1 W/K\", to = \"50 W/K\" } }
require = [\"block.T <= 75 [degC]\"]
";

#[track_caller]
fn near(value: &serde_json::Value, expected: f64, unit: &str, relative: f64) {
    let found = value["value"].as_f64().unwrap_or_else(|| panic!("{value}"));
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
    assert_eq!(value["unit"], unit);
}

#[test]
fn a_cooling_follows_from_power_and_temperatures() {
    let folder = Folder::empty();
    let json = folder.run(&[&COOLING[..], &["--format", "json"]].concat()).exits(0).json();
    near(&json["values"]["R_max"], 75.0 / 223.0, "K/W", 1e-9);
    near(&json["values"]["hA"], 223.0 / 75.0, "W/K", 1e-9);
    assert_eq!(json["feasible"], true);
    // P / (cp rise) with cp of air as in Cengel, table A-15: 1007 J/(kg K) at 25 and at 35 degC
    near(&json["values"]["air_flow"], 223.0 / (1007.0 * 10.0), "kg/s", 2e-3);
    // ideal gas of 287.05 J/(kg K) at 35 degC and 101325 Pa: 1.1455 kg/m^3; Cengel, table A-15, has
    // 1.145
    near(&json["values"]["air_volume_flow"], 223.0 / (1007.0 * 10.0) / 1.1455, "m^3/s", 2e-3);
    // unused engine oil near 60 degC, Incropera table A.5: 2035 J/(kg K) at 330 K; a gear oil is
    // like it
    near(&json["values"]["oil_flow"], 223.0 / (2035.0 * 10.0), "kg/s", 0.02);
    let twice = folder
        .run(&[&COOLING[..], &["--rise", "20 K", "--format", "json"]].concat())
        .exits(0)
        .json();
    let ratio = |name: &str| {
        json["values"][name]["value"].as_f64().unwrap()
            / twice["values"][name]["value"].as_f64().unwrap()
    };
    assert!((ratio("air_flow") - 2.0).abs() < 2e-3 && (ratio("oil_flow") - 2.0).abs() < 0.05);
    folder.run(&COOLING).exits(0).prints("R_max = 0.33632 K/W").prints("h A = 2.9733 W/K");
}

#[test]
fn a_limit_below_the_surroundings_is_infeasible_and_says_by_how_much() {
    let folder = Folder::empty();
    let with = |limit: &str| {
        ["size", "--power", "223 W", "--limit", limit, "--ambient", "35 degC"].map(str::to_owned)
    };
    let run = |limit: &str, more: &[&str]| {
        let arguments = with(limit);
        let arguments: Vec<&str> =
            arguments.iter().map(String::as_str).chain(more.iter().copied()).collect();
        folder.run(&arguments).exits(1)
    };
    let ran = run("20 degC", &[]);
    assert!(
        ran.out.lines().last().unwrap().starts_with("infeasible: the limit is 15 K below"),
        "{}",
        ran.out
    );
    run("35 degC", &[]).prints("infeasible");
    let json = run("-5 degC", &["--format", "json"]).json();
    assert_eq!(
        (&json["feasible"], &json["values"]["R_max"]["value"]),
        (&false.into(), &serde_json::Value::Null)
    );
    near(&json["margin"], -40.0, "K", 1e-12);
}

#[test]
fn a_coolant_does_not_leave_warmer_than_the_limit() {
    let folder = Folder::empty();
    let json = folder
        .run(&[&COOLING[..], &["--rise", "76 K", "--format", "json"]].concat())
        .exits(0)
        .json();
    assert_eq!(json["values"]["air_flow"]["value"], serde_json::Value::Null);
    folder
        .run(&[&COOLING[..], &["--rise", "76 K"]].concat())
        .exits(0)
        .prints("would leave warmer than the limit");
}

#[test]
fn wrong_questions_end_with_2() {
    let folder = Folder::with("fan.toml", FAN);
    folder.run(&["size"]).exits(2);
    folder.run(&COOLING[..5]).exits(2).says("--ambient");
    folder.run(&["size", "fan.toml", "--power", "1 W"]).exits(2);
    folder.run(&["size", "--power", "-1 W", "--limit", "80 degC", "--ambient", "20 degC"]).exits(2);
    folder
        .run(&["size", "--power", "0 W", "--limit", "80 degC", "--ambient", "20 degC"])
        .exits(2)
        .says("size::power");
    folder
        .run(&["size", "--power", "1 K", "--limit", "80 degC", "--ambient", "20 degC"])
        .exits(2)
        .says("units::");
    folder
        .run(&["size", "fan.toml", "fna"])
        .exits(2)
        .says("size::no_study")
        .says("did you mean `fan`?");
    folder.run(&["size", "missing.toml"]).exits(2).says("cannot read");
    let none = FAN.split("[size").next().unwrap();
    Folder::with("fan.toml", none).run(&["size", "fan.toml"]).exits(2).says("has no [size.NAME]");
    // the help names a parameter and a node of the file, and can be pasted
    let ran = Folder::with("fan.toml", none).run(&["size", "fan.toml"]).exits(2);
    let pasted: Vec<&str> = ran.err.lines().skip_while(|l| !l.contains("[size.best]")).collect();
    let pasted = pasted.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n");
    let whole = format!("{none}\n{pasted}\n");
    Folder::with("fan.toml", &whole).run(&["check", "fan.toml"]).exits(0);
    let second =
        FAN.to_owned() + &FAN[FAN.find("[size").unwrap()..].replace("size.fan", "size.other");
    let folder = Folder::with("fan.toml", &second);
    folder.run(&["size", "fan.toml"]).exits(2).says("name one of `fan`, `other`");
    folder.run(&["size", "fan.toml", "other"]).exits(0);
}

#[test]
fn a_parameter_is_sized_in_the_unit_of_the_file() {
    let folder = Folder::with("fan.toml", FAN);
    let ran = folder
        .run(&["size", "fan.toml"])
        .exits(0)
        .prints("binds")
        .prints("0.55 K of margin for 1 % more G");
    assert_eq!(ran.out.lines().last(), Some("G = 1.81819 W/K keeps every requirement"));
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80));
    let json = folder.run(&["size", "fan.toml", "--format", "json"]).exits(0).json();
    near(&json["values"]["G"], 100.0 / 55.0, "W/K", 1e-9);
    near(&json["sensitivity"], 0.55, "K", 1e-6);
    assert_eq!(
        (&json["binding"], &json["feasible"]),
        (&"block.T <= 75 [degC]".into(), &true.into())
    );
    assert_eq!(folder.read("fan.toml"), FAN);
    let json =
        folder.run(&["size", "fan.toml", "--set", "P=50 W", "--format", "json"]).exits(0).json();
    near(&json["values"]["G"], 50.0 / 55.0, "W/K", 1e-9);
}

#[test]
fn infeasible_ends_with_1_and_writes_nothing() {
    let folder = Folder::with("fan.toml", &FAN.replace("50 W/K", "1 W/K"));
    let before = folder.read("fan.toml");
    let ran = folder.run(&["size", "fan.toml", "--write"]).exits(1);
    let last = "infeasible: at best, with G = 1 W/K, the largest of the range, `block.T <= 75";
    assert!(ran.out.contains(last) && ran.out.contains("broken by 45 K"), "{}", ran.out);
    assert_eq!(folder.read("fan.toml"), before);
    let json = folder.run(&["size", "fan.toml", "--format", "json"]).exits(1).json();
    assert_eq!(json["feasible"], false);
    near(&json["margin"], -45.0, "K", 1e-6);
}

#[test]
fn what_is_written_keeps_the_requirement_and_every_other_byte() {
    let folder = Folder::with("fan.toml", FAN);
    folder.run(&["size", "fan.toml", "--write"]).exits(0).says("wrote  fan.toml: G = 1.81819 W/K");
    assert_eq!(folder.read("fan.toml"), FAN.replace("'3 W/K'", "'1.81819 W/K'"));
    assert_eq!(folder.files(), ["fan.toml"]);
    // rounded to the side that keeps it: 1.81818 W/K would give 75.0001 degC
    let json = folder.run(&["steady", "fan.toml", "--format", "json"]).exits(0).json();
    let celsius = json["values"]["block.T"]["value"].as_f64().unwrap();
    assert!(celsius <= 75.0 && celsius > 74.999, "{celsius}");
}

#[test]
fn deviations_units_and_bare_numbers_survive_the_writing() {
    let folder = Folder::with("fan.toml", &FAN.replace("'3 W/K'", "\"3000 ± 100 mW/K\""));
    folder.run(&["size", "fan.toml", "--write"]).exits(0);
    assert!(folder.read("fan.toml").contains("G = \"1818.19 ± 100 mW/K\"   # the fan"));
    let bare = FAN.replace("'3 W/K'", "3.0").replace("G = \"G\"", "G = \"G * 1 [W/K]\"");
    let bare = bare.replace("\"0.1 W/K\"", "0.1").replace("\"50 W/K\"", "50");
    let folder = Folder::with("fan.toml", &bare);
    folder.run(&["size", "fan.toml", "--write"]).exits(0);
    assert_eq!(folder.read("fan.toml"), bare.replace("3.0", "1.81819"));
}

#[test]
fn what_is_no_number_cannot_be_written() {
    let folder = Folder::with("fan.toml", &FAN.replace("'3 W/K'", "\"P / 20 [K]\""));
    folder.run(&["size", "fan.toml"]).exits(0).prints("G = 1.81819 W/K");
    folder.run(&["size", "fan.toml", "--write"]).exits(2).says("size::write");
    folder.run_with(&["size", "-", "--write"], FAN).exits(2).says("stdin");
    folder.run_with(&["size", "-"], FAN).exits(0);
    folder.run(&["size", "fan.toml", "--write", "--set", "P=1 W"]).exits(2);
}

#[test]
fn a_number_of_an_included_file_is_not_written() {
    let folder = Folder::with("own.toml", "format = 1\n[param]\nG = \"3 W/K\"\n");
    folder.write(
        "fan.toml",
        &FAN.replace("format = 1", "format = 1\ninclude = [\"own.toml\"]")
            .replace("G = '3 W/K'", "#"),
    );
    folder.run(&["size", "fan.toml"]).exits(0).prints("G = 1.81819 W/K");
    folder.run(&["size", "fan.toml", "--write"]).exits(2).says("is in an included file");
    // what is written beside an include is proven with it
    folder.write(
        "own.toml",
        "format = 1\n[material]\nmade_up = { cp = \"500 J/(kg K)\", source = \"test\" }\n",
    );
    let with_material = FAN.replace("format = 1", "format = 1\ninclude = [\"own.toml\"]");
    folder.write(
        "fan.toml",
        &with_material.replace("C = \"1 kJ/K\"", "material = \"made_up\", mass = \"2 kg\""),
    );
    folder.run(&["size", "fan.toml", "--write"]).exits(0).says("wrote  fan.toml");
}

/// The lump is at 25 + 100 W / G, so that it keeps 50 degC from 4 W/K on.
#[test]
fn less_of_a_maximum_is_not_always_better() {
    let text = "format = 1\n[param]\nG = '5 W/K'\n[node]\nlump = { C = '1 kJ/K', T0 = '25 \
                degC' }\n[boundary]\nair = { T = '25 degC' }\n[resistor]\nskin = { from = \
                'lump', to = 'air', G = 'G' }\n[source]\nheat = { into = 'lump', P = '100 W' \
                }\n[size.s]\nmaximise = 'G'\nvary = { G = { from = '1 W/K', to = '20 W/K' } \
                }\nrequire = ['lump.T <= 50 [degC]']\n";
    let folder = Folder::with("x.toml", text);
    folder.run(&["size", "x.toml"]).exits(0).prints("less is not always better: below G = 4 W/K");
}

/// A given value of the sized parameter has no effect, and every form of the answer says so.
#[test]
fn a_given_value_that_is_sized_is_a_warning() {
    let folder = Folder::with("fan.toml", FAN);
    folder.run(&["size", "fan.toml", "--set", "G=3W/K"]).says("size::replaced");
    let json = folder.json("size fan.toml --set G=3W/K").json();
    assert_eq!(json["warnings"][0]["code"], "size::replaced");
    let other = folder.run(&["size", "fan.toml", "--set", "P=90W"]);
    assert!(!other.err.contains("size::replaced"), "{}", other.err);
}
