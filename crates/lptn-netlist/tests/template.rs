//! Templates: every instance is what it would be if it were written by hand.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; exact numbers"
)]

use std::io;
use std::path::Path;

use lptn_netlist::{Netlist, Rejected, Severity, parse, parse_with};
use lptn_network::{Item, Network};

use crate::support;
use support::{same, seen};

const HEAD: &str = r#"
format = 1

[param]
R_fit = "0.25 K/W"

[default]
T0 = "25 degC"

[node]
carrier = { C = "500 J/K" }
ring = { C = "700 J/K" }

[boundary]
air = { T = "20 degC" }

[resistor]
out = { from = "ring", to = "air", R = "0.3 K/W" }
"#;

const PLANET: &str = r#"
[template.planet]
param = { m = "0.21 kg", R_pin = { unit = "K/W" }, P = "m * 100 [W/kg]" }
port = ["base", "rim"]

[template.planet.node]
gear = { material = "steel_8620", mass = "m" }
pin = { C = "30 J/K", T0 = "30 degC" }

[template.planet.resistor]
bearing = { from = "gear", to = "pin", R = "R_pin" }
press = { from = "pin", to = "base", R = "R_fit * (1 + abs(gear.T - base.T) / 100 [K])" }
mesh = { from = "gear", to = "rim", G = "2 W/K" }

[template.planet.source]
loss = { into = { gear = 0.75, pin = 0.25 }, P = "P" }

[template.planet.limit]
hot = { of = "gear.T - rim.T", below = "40 K" }
"#;

fn good(text: &str) -> Netlist {
    parse("net.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn names(network: &Network) -> Vec<&str> {
    network.nodes().iter().map(|node| node.name.as_str()).collect()
}

/// Reference: what the two instances are, written by hand.
#[test]
fn instances_are_what_they_would_be_by_hand() {
    let with = format!(
        "{HEAD}{PLANET}{}",
        r#"
[use.planet]
template = "planet"
count = 2
connect = { base = "carrier", rim = "ring" }
set = { R_pin = ["0.1 K/W", "R_fit / 2"] }
"#
    );
    let flat = format!(
        "{HEAD}{}",
        r#"
[param.flat]
"#
    );
    let flat = flat.replace("\n[param.flat]\n", "").replace(
        "R_fit = \"0.25 K/W\"\n",
        r#"R_fit = "0.25 K/W"
"planet[1].m" = "0.21 kg"
"planet[1].R_pin" = "0.1 K/W"
"planet[1].P" = "21 W"
"planet[2].m" = "0.21 kg"
"planet[2].R_pin" = "0.125 K/W"
"planet[2].P" = "21 W"
"#,
    );
    let flat = flat.replace(
        "ring = { C = \"700 J/K\" }\n",
        r#"ring = { C = "700 J/K" }
"planet[1].gear" = { C = "99.75 J/K" } # 0.21 kg of steel_8620, 475 J/(kg K)
"planet[1].pin" = { C = "30 J/K", T0 = "30 degC" }
"planet[2].gear" = { C = "99.75 J/K" }
"planet[2].pin" = { C = "30 J/K", T0 = "30 degC" }
"#,
    );
    let flat = flat.replace(
        "R = \"0.3 K/W\" }\n",
        r#"R = "0.3 K/W" }
"planet[1].bearing" = { from = "planet[1].gear", to = "planet[1].pin", R = "0.1 K/W" }
"planet[1].press" = { from = "planet[1].pin", to = "carrier", R = "R_fit * (1 + abs(planet[1].gear.T - carrier.T) / 100 [K])" }
"planet[1].mesh" = { from = "planet[1].gear", to = "ring", G = "2 W/K" }
"planet[2].bearing" = { from = "planet[2].gear", to = "planet[2].pin", R = "0.125 K/W" }
"planet[2].press" = { from = "planet[2].pin", to = "carrier", R = "R_fit * (1 + abs(planet[2].gear.T - carrier.T) / 100 [K])" }
"planet[2].mesh" = { from = "planet[2].gear", to = "ring", G = "2 W/K" }

[source]
"planet[1].loss" = { into = { "planet[1].gear" = 0.75, "planet[1].pin" = 0.25 }, P = "planet[1].P" }
"planet[2].loss" = { into = { "planet[2].gear" = 0.75, "planet[2].pin" = 0.25 }, P = "planet[2].P" }

[limit]
"planet[1].hot" = { of = "planet[1].gear.T - ring.T", below = "40 K" }
"planet[2].hot" = { of = "planet[2].gear.T - ring.T", below = "40 K" }
"#,
    );
    let (with, flat) = (good(&with), good(&flat));
    assert_eq!(
        names(&with.network),
        ["carrier", "ring", "planet[1].gear", "planet[1].pin", "planet[2].gear", "planet[2].pin"]
    );
    same(&seen(&with.network), &seen(&flat.network), 1e-14);
}

#[test]
fn without_count_there_is_no_index_and_defaults_hold() {
    let text = format!(
        "{HEAD}{PLANET}{}",
        r#"
[use.moon]
template = "planet"
connect = { base = "carrier", rim = "air" }
set = { R_pin = "2 * R_fit", m = "0.4 kg" }
"#
    );
    let netlist = good(&text);
    let value = |name: &str| {
        let id = netlist.network.parameter(name).unwrap();
        netlist.network.parameter_value(id)
    };
    assert_eq!((value("moon.m"), value("moon.R_pin"), value("moon.P")), (0.4, 0.5, 40.0));
    let Item::Conductor(mesh) = netlist.network.item("moon.mesh").unwrap() else {
        panic!("a conductor")
    };
    let to = netlist.network.conductors()[mesh.index()].to;
    assert_eq!(netlist.network.name_of(to.into()), "air");
    assert_eq!(netlist.network.limits()[0].text, "moon.gear.T - air.T");
}

/// Ports of the part around, and parts of other instances, are ends like any other.
#[test]
fn parts_hold_parts_and_connect_across() {
    let text = format!(
        "{HEAD}{}",
        r#"
[template.pin]
param = { C_pin = "30 J/K" }
port = ["base", "next"]

[template.pin.node]
body = { C = "C_pin" }

[template.pin.resistor]
fit = { from = "body", to = "base", R = "1 K/W" }
link = { from = "body", to = "next", R = "3 K/W" }

[template.planet]
param = { C_gear = "80 J/K" }
port = ["carrier"]

[template.planet.node]
gear = { C = "C_gear" }

[template.planet.use.pin]
template = "pin"
count = 2
connect = { base = ["gear", "pin[1].body"], next = "carrier" }
set = { C_pin = "C_gear / 4" }

[use.planet]
template = "planet"
count = 2
connect = { carrier = ["carrier", "planet[1].pin[2].body"] }
set = { C_gear = ["80 J/K", "100 J/K"] }
"#
    );
    let network = good(&text).network;
    assert_eq!(
        names(&network)[2..],
        [
            "planet[1].gear",
            "planet[1].pin[1].body",
            "planet[1].pin[2].body",
            "planet[2].gear",
            "planet[2].pin[1].body",
            "planet[2].pin[2].body"
        ]
    );
    let name = |end: lptn_network::End| network.name_of(end.into()).into_owned();
    let ends: Vec<(String, String)> =
        network.conductors()[1..].iter().map(|c| (name(c.from), name(c.to))).collect();
    let ends: Vec<_> = ends.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    let expected = [
        ("planet[1].pin[1].body", "planet[1].gear"),
        ("planet[1].pin[1].body", "carrier"),
        ("planet[1].pin[2].body", "planet[1].pin[1].body"),
        ("planet[1].pin[2].body", "carrier"),
        ("planet[2].pin[1].body", "planet[2].gear"),
        ("planet[2].pin[1].body", "planet[1].pin[2].body"),
        ("planet[2].pin[2].body", "planet[2].pin[1].body"),
        ("planet[2].pin[2].body", "planet[1].pin[2].body"),
    ];
    assert_eq!(ends, expected);
    let capacity = |name: &str| network.capacity(network.node(name).unwrap());
    assert_eq!(
        (capacity("planet[1].pin[2].body"), capacity("planet[2].pin[1].body")),
        (20.0, 25.0)
    );
}

/// A limit of all is a limit of each; the heat of a source into all is shared equally.
#[test]
fn patterns_stand_for_every_instance() {
    let text = format!(
        "{HEAD}{PLANET}{}",
        r#"
[use.planet]
template = "planet"
count = 3
connect = { base = "carrier", rim = "ring" }
set = { R_pin = "0.1 K/W" }

[limit]
warm = { of = "planet[*].gear.T - planet[*].pin.T", below = "20 K", severity = "warning" }

[source]
splash = { into = "planet[*].gear", P = "30 W" }
mixed = { into = { "planet[*].pin" = 0.6, ring = 0.4 }, P = "30 W" }
"#
    );
    let network = good(&text).network;
    let limits: Vec<(&str, &str)> =
        network.limits().iter().map(|limit| (limit.name.as_str(), limit.text.as_str())).collect();
    assert_eq!(limits[1], ("warm[2]", "planet[2].gear.T - planet[2].pin.T"));
    assert_eq!(limits.len(), 6);
    let shares = |source: usize| {
        let into = &network.sources()[source].into;
        into.iter()
            .map(|(node, share)| (network.nodes()[node.index()].name.as_str(), *share))
            .collect::<Vec<_>>()
    };
    let third = 1.0 / 3.0;
    assert_eq!(
        shares(0),
        [("planet[1].gear", third), ("planet[2].gear", third), ("planet[3].gear", third)]
    );
    let fifth = 0.6 / 3.0;
    assert_eq!(
        shares(1),
        [
            ("planet[1].pin", fifth),
            ("planet[2].pin", fifth),
            ("planet[3].pin", fifth),
            ("ring", 0.4)
        ]
    );
}

#[test]
fn signals_and_tables_of_a_template_are_its_own() {
    let text = format!(
        "{HEAD}{}",
        r#"
[template.motor]
param = { gain = 2 }
port = ["case"]

[template.motor.signal]
speed = { t = ["0 s", "60 s"], v = ["0 rpm", "3000 rpm"], after_end = "hold" }
P_loss = "gain * loss(speed)"

[template.motor.table]
loss = { x = ["0 rpm", "3000 rpm"], y = ["0 W", "50 W"] }

[template.motor.source]
heat = { into = "case", P = "P_loss" }

[use.motor]
template = "motor"
count = 2
connect = { case = ["carrier", "ring"] }
set = { gain = [1, 3] }
"#
    );
    let network = good(&text).network;
    let mut scope = network.evaluation();
    scope.set_time(30.0, 30.0);
    let mut powers = [0.0; 2];
    network.source_powers(&mut scope, &mut powers).unwrap();
    assert_eq!(powers, [25.0, 75.0]);
}

#[test]
fn parameters_of_one_instance_can_be_set() {
    let text = format!(
        "{HEAD}{PLANET}{}",
        r#"
[use.planet]
template = "planet"
count = 2
connect = { base = "carrier", rim = "ring" }
set = { R_pin = "0.1 K/W" }
"#
    );
    let mut netlist = good(&text);
    netlist.set(&["planet[2].m=0.42kg".to_owned()]).unwrap();
    let value =
        |name: &str| netlist.network.parameter_value(netlist.network.parameter(name).unwrap());
    assert_eq!((value("planet[1].P"), value("planet[2].P")), (21.0, 42.0));
    let wrong = netlist.clone().set(&["planet[2].m=3K".to_owned()]).unwrap_err();
    assert_eq!(wrong.diagnostics[0].code, "units::dimension");
    let unknown = netlist.clone().set(&["planet[7].m=1kg".to_owned()]).unwrap_err();
    assert_eq!(unknown.diagnostics[0].code, "netlist::no_instance");
    let broken = netlist.set(&["planet[2].R_pin=-1K/W".to_owned()]).unwrap_err();
    assert!(broken.to_string().contains("in `planet[2]`, used here"), "{broken}");
}

fn with_file(text: &str, part: &str) -> Result<Netlist, Rejected> {
    parse_with("net.toml", text, &mut |path: &Path| match path.to_str() {
        Some("part.toml") => Ok(part.as_bytes().to_vec()),
        _ => Err(io::Error::from(io::ErrorKind::NotFound)),
    })
}

#[test]
fn templates_may_come_from_a_file_that_is_included() {
    let part = format!("format = 1\n{PLANET}\n[template.spare.node]\na = {{ C = \"1 J/K\" }}\n");
    let text = HEAD.replace("format = 1\n", "format = 1\ninclude = [\"part.toml\"]\n")
        + r#"
[use.planet]
template = "planet"
connect = { base = "carrier", rim = "ring" }
set = { R_pin = "0.1 K/W" }
"#;
    let netlist = with_file(&text, &part).unwrap();
    assert_eq!(names(&netlist.network)[2], "planet.gear");
    assert!(netlist.warnings.is_empty(), "a file of templates is there to be chosen from");
    // a mistake in the template is shown there, and where it is used
    let broken = part.replace("2 W/K", "2 K/W");
    let rejected = with_file(&text, &broken).unwrap_err();
    let labels = &rejected.diagnostics[0].labels;
    assert_eq!(rejected.files.name(labels[0].span.file), "part.toml");
    assert_eq!(rejected.files.name(labels[1].span.file), "net.toml");
}

#[test]
fn a_template_that_nothing_uses_is_a_warning() {
    let netlist = good(&format!("{HEAD}{PLANET}"));
    let codes: Vec<&str> = netlist.warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(
        codes,
        ["netlist::unused_parameter", "network::no_boundary", "netlist::unused_template"]
    );
    assert!(netlist.warnings.iter().all(|warning| warning.severity == Severity::Warning));
}

/// The same mistake in a hundred instances is one message.
#[test]
fn a_mistake_in_a_template_is_reported_once() {
    let text = format!(
        "{HEAD}{}{}",
        PLANET.replace("R = \"R_pin\"", "R = \"R_pin + 1\""),
        r#"
[use.planet]
template = "planet"
count = 100
connect = { base = "carrier", rim = "ring" }
set = { R_pin = "0.1 K/W" }
"#
    );
    let rejected = parse("net.toml", &text).unwrap_err();
    assert_eq!(rejected.diagnostics.len(), 1, "{rejected}");
    assert!(rejected.to_string().contains("in `planet[1]` and 99 more, used here"), "{rejected}");
}

#[test]
fn templates_inside_each_other_have_a_limit() {
    let mut text = HEAD.to_owned();
    for n in 0..40 {
        text += &format!("\n[template.a{n}]\n[template.a{n}.use.x]\ntemplate = \"a{}\"\n", n + 1);
    }
    text += "\n[template.a40.node]\nb = { C = \"1 J/K\" }\n\n[use.x]\ntemplate = \"a0\"\n";
    let rejected = parse("net.toml", &text).unwrap_err();
    let codes: Vec<&str> = rejected.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["netlist::template_depth"], "{rejected}");
}
