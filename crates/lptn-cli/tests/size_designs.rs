//! `lptn size` with several parameters and with catalogues.

use crate::common;

use common::Folder;

/// T = 20 degC + 30 W (R + 1 / g).
const PARTS: &str = "format = 1
[param]
R = \"1 K/W\"       # of the sink
g = \"1 W/K\"
price_sink = 0
price_fan = 0
[node]
chip = { C = \"600 J/K\", T0 = \"20 degC\" }
sink = { C = \"60 J/K\", T0 = \"20 degC\" }
[boundary]
air = { T = \"20 degC\" }
[resistor]
pad = { from = \"chip\", to = \"sink\", R = \"R\" }
fan = { from = \"sink\", to = \"air\", G = \"g\" }
[source]
heat = { into = \"chip\", P = \"30 W\" }
[size.parts]
minimise = \"price_sink + price_fan\"
catalogue = [\"sinks.csv\", \"fans.csv\"]
require = [\"chip.T <= 60 [degC]\"]
";

fn folder(netlist: &str) -> Folder {
    let folder = Folder::with("a.toml", netlist);
    folder.write("sinks.csv", "part,R [K/W],price_sink [-]\ns1,0.9,4\ns2,0.6,6\ns3,0.45,9\n");
    folder.write(
        "fans.csv",
        "part,g [mW/K],price_fan [-],note\nf0,100,0,none\nf1,900,3,small\n\
                              f2,2500,5,large\n",
    );
    folder
}

/// s1 with f2 is 20 + 39 K for 9, s2 with f1 is 20 + 51.3 K for 9, s2 with f2 is 20 + 30 K for 11.
#[test]
fn the_cheapest_parts_are_named_with_what_fails_and_what_comes_next() {
    let folder = folder(PARTS);
    let ran = folder.run(&["size", "a.toml"]).exits(0);
    assert!(!ran.err.contains("unused"), "{}", ran.err);
    ran.prints("s1 with f2 keeps every requirement, price_sink + price_fan = 9");
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["feasible"], true);
    assert!((json["values"]["g"]["value"].as_f64().unwrap_or(0.0) - 2.5).abs() < 1e-12);
    assert!((json["margin"]["value"].as_f64().unwrap_or(0.0) - 1.0).abs() < 1e-9);
    let choices = json["choices"].as_array().map_or(0, Vec::len);
    assert_eq!((choices, &json["count"]), (9, &9.into()));
    let csv = folder.run(&["size", "a.toml", "--format", "csv"]).exits(0);
    assert!(csv.out.starts_with("sinks.csv,fans.csv,price_sink + price_fan [-],R [K/W]"));
    assert_eq!(csv.out.lines().count(), 10);
    folder.run(&["size", "a.toml", "--plot", "a.svg"]).exits(0);
    assert!(folder.read("a.svg").contains("the answer"));
}

#[test]
fn what_no_part_keeps_ends_with_1_and_says_by_how_much() {
    let folder = folder(&PARTS.replace("<= 60", "<= 40"));
    // s3 with f2: 20 + 25.5 K
    folder
        .run(&["size", "a.toml"])
        .exits(1)
        .prints("infeasible: none of 9 choices keeps every requirement")
        .prints("s3 with f2");
    let before = folder.read("a.toml");
    folder.run(&["size", "a.toml", "--write"]).exits(1);
    assert_eq!(folder.read("a.toml"), before);
}

/// Straight lines between the points of each curve, held outside: at 0.3, 1.2 and 2.5 m/s the first has
/// 2.4, 1.78 and 1.2 K/W, the second, in mK/W, 1.7, 1.28 and 0.9; 30 W on them, 35 K to lose.
#[test]
fn a_part_has_a_curve_from_a_file() {
    let curves = "format = 1\n[param]\nsink = 1\nv = '2 m/s'\nprice_sink = 0\nprice_fan = 0\n\
        [table]\nR_sink = { csv = ['a.csv', 'b.csv'], x = 'v', value = 'R', outside = 'hold' }\n\
        [node]\nchip = { C = '60 J/K', T0 = '35 degC' }\n[boundary]\nair = { T = '35 degC' }\n\
        [resistor]\nfins = { from = 'chip', to = 'air', R = 'R_sink(sink, v)' }\n[source]\n\
        heat = { into = 'chip', P = '30 W' }\n[size.parts]\nminimise = 'price_sink + price_fan'\n\
        catalogue = ['sinks.csv', 'fans.csv']\nrequire = ['chip.T <= 70 [degC]']\n";
    let folder = Folder::with("a.toml", curves);
    folder.write("a.csv", "v [m/s],R [K/W]\n0.5,2.4\n1,1.9\n2,1.3\n4,0.9\n");
    folder.write("b.csv", "v [m/s],R [mK/W]\n0.5,1700\n1.5,1100\n3,800\n");
    folder.write("sinks.csv", "part,sink [-],price_sink [-]\na,1,4.20\nb,2,5.90\n");
    folder.write("fans.csv", "part,v [m/s],price_fan [-]\nf0,0.3,0\nf1,1.2,3.10\nf2,2.5,4.80\n");
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    let resistance = |parts: &serde_json::Value| match (parts[0].as_str(), parts[1].as_str()) {
        (Some("a"), Some("f0")) => 2.4,
        (Some("a"), Some("f1")) => 1.78,
        (Some("a"), _) => 1.2,
        (_, Some("f0")) => 1.7,
        (_, Some("f1")) => 1.28,
        _ => 0.9,
    };
    let choices = json["choices"].as_array().map_or(&[][..], Vec::as_slice);
    assert_eq!(choices.len(), 6);
    for choice in choices {
        let margin = choice["requirements"][0]["margin"]["value"].as_f64().unwrap_or(f64::NAN);
        assert!((margin - (35.0 - 30.0 * resistance(&choice["parts"]))).abs() < 1e-9, "{choice}");
    }
    // what is written out flat is the same network
    let flat = folder.run(&["check", "a.toml", "--expand"]).exits(0).out;
    folder.write("flat.toml", &flat);
    let again = folder.run(&["size", "flat.toml", "--format", "json"]).exits(0).json();
    assert_eq!(again["choices"], json["choices"]);
}

/// A loss that grows by 0.5 W/K runs away where R + 1 / g is more than 2 K/W: with f0 and with s1 and f1.
/// s2 with f2, 1 K/W, comes to 20 + 30 / (1 - 0.5) degC.
#[test]
fn parts_without_an_answer_are_listed_with_their_codes() {
    let grows = PARTS.replace("P = \"30 W\"", "P = \"30 [W] + 0.5 [W/K] * (T - 20 [degC])\"");
    assert_ne!(grows, PARTS);
    let folder = folder(&grows.replace("<= 60", "<= 100"));
    let ran = folder.run(&["size", "a.toml"]).exits(0);
    let ran = ran.prints("steady::runaway").prints("that could not be judged");
    let answer = ran.out.lines().find(|line| line.contains("the answer")).unwrap_or_default();
    assert!(answer.starts_with("s2 with f2 ") && answer.contains(" 20 K"), "{}", ran.out);
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    let first = &json["choices"][0];
    assert_eq!((&first["failed"], &first["feasible"]), (&"steady::runaway".into(), &false.into()));
    let csv = folder.run(&["size", "a.toml", "--format", "csv"]).exits(0);
    assert!(csv.out.lines().next().is_some_and(|head| head.contains("failed")), "{}", csv.out);
}

#[test]
fn the_parts_are_written_with_their_own_numbers() {
    let folder = folder(PARTS);
    folder.run(&["size", "a.toml", "--write"]).exits(0);
    let text = folder.read("a.toml");
    assert!(text.contains("R = \"0.9 K/W\"       # of the sink"), "{text}");
    assert!(text.contains("g = \"2.5 W/K\"") && text.contains("price_fan = 5"), "{text}");
}

/// A part that no network can have is an error that names its values.
#[test]
fn a_part_that_cannot_be_is_refused() {
    let folder = folder(PARTS);
    folder.write("sinks.csv", "part,R [K/W],price_sink [-]\ns1,-0.9,4\n");
    folder.run(&["size", "a.toml"]).exits(2).says("size::network").says("R = -0.9 K/W");
}

#[test]
fn several_parameters_are_sized_and_written() {
    let text = PARTS.replace(
        "minimise = \"price_sink + price_fan\"\ncatalogue = [\"sinks.csv\", \"fans.csv\"]",
        "minimise = \"g * 1 [K/W] + 4 [K/W] / R\"\nvary = { R = { from = \"0.1 K/W\", to = \"2 K/W\" }, \
         g = { from = \"0.5 W/K\", to = \"50 W/K\" } }",
    );
    let folder = folder(&text);
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    // R + 1/g = 4/3; g + 4 / (4/3 - 1/g) is least at g = 9/4: there 9/4 + 4 / (8/9) = 6.75
    let value = |of: &serde_json::Value| of["value"].as_f64().unwrap_or(0.0);
    assert!((value(&json["objective"]["value"]) - 6.75).abs() < 1e-7, "{json}");
    assert!((value(&json["values"]["g"]) - 2.25).abs() < 1e-4, "{json}");
    assert_eq!(json["requirements"][0]["binds"], true);
    folder.run(&["size", "a.toml", "--write"]).exits(0).says("2 parameters");
    let limited =
        folder.read("a.toml") + "[limit]\nhot = { of = \"chip.T\", below = \"60 degC\" }\n";
    folder.write("b.toml", &limited);
    folder.run(&["steady", "b.toml"]).exits(0);
    folder.run(&["size", "a.toml", "--plot", "a.svg"]).exits(0);
}

/// A planetary stage of 18/42/102 teeth: neither a sun of 19 nor one of 20 meshes with the others.
const STAGE: &str = "format = 1
[param]
z_sun = 18
[node]
gears = { C = \"500 J/K\", T0 = \"20 degC\" }
[boundary]
air = { T = \"20 degC\" }
[resistor]
skin = { from = \"gears\", to = \"air\", R = \"0.3 K/W\" }
[gearbox.stage]
teeth = { sun = \"z_sun\", planet = 42, ring = 102 }
planets = 3
held = \"ring\"
speed = \"3000 rpm\"
into = \"gears\"
seal = { lip = { on = \"sun\", model = \"shaft\", d = \"20 mm\" } }
[size.s]
maximise = \"z_sun\"
catalogue = \"suns.csv\"
require = [\"gears.T <= 90 [degC]\"]
";

/// It answered with the sun of 20 teeth, which `run --set` and `sweep` refuse.
#[test]
fn gears_that_do_not_mesh_are_not_the_answer() {
    let folder = Folder::with("stage.toml", STAGE);
    folder.write("suns.csv", "part,z_sun\ns18,18\ns19,19\ns20,20\n");
    folder.run(&["steady", "stage.toml", "--set", "z_sun=20"]).exits(2).says("netlist::gear_mesh");
    let json = folder.run(&["size", "stage.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["values"]["z_sun"]["value"], 18.0);
    let csv = folder.run(&["size", "stage.toml", "--format", "csv"]).exits(0);
    assert_eq!(csv.out.matches("netlist::gear_mesh").count(), 2, "{}", csv.out);
    folder.write("suns.csv", "part,z_sun\ns19,19\ns20,20\n");
    folder.run(&["size", "stage.toml"]).exits(2).says("netlist::gear_mesh");
}
