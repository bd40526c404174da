//! `index`: the number of an instance, in values of its template and of its use.
//! Reference: the same elements written by hand, each with its own number.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, parse};

use crate::support;
use support::{same, seen};

const HEAD: &str =
    "format = 1\n[default]\nT0 = \"25 degC\"\n[boundary]\nair = { T = \"25 degC\" }\n";

const ROW: &str = r#"
[template.cell]
param = { P = { unit = "W" }, R = "0.5 [K/W] * index", even = "2 ^ index" }
port = ["base"]
[template.cell.node]
body = { C = "10 [J/K] + 1 [J/K] * index", T0 = "20 [degC] + 2 [K] * index" }
[template.cell.resistor]
out = { from = "body", to = "base", R = "R" }
[template.cell.source]
loss = { into = "body", P = "P * even" }
[template.cell.limit]
warm = { of = "body.T - base.T", below = "30 [K] + 1 [K] * index" }

[use.cell]
template = "cell"
count = 3
connect = { base = "air" }
set = { P = ["7 W", "2 [W] * (1 + 0.1 * index)", "index * 1 [W]"] }

[resistor]
side = { from = "cell[*-1].body", to = "cell[*].body", G = "0.1 [W/K] * index" }

[limit]
hot = { of = "cell[*].body.T - 1 [K] * index", below = "45 [degC] - 1 [K] * index" }
"#;

const BY_HAND: &str = r#"
[param]
"cell[1].P" = "7 W"
"cell[1].R" = "0.5 K/W"
"cell[1].even" = 2
"cell[2].P" = "2.4 W"
"cell[2].R" = "1 K/W"
"cell[2].even" = 4
"cell[3].P" = "3 W"
"cell[3].R" = "1.5 K/W"
"cell[3].even" = 8
[node]
"cell[1].body" = { C = "11 J/K", T0 = "22 degC" }
"cell[2].body" = { C = "12 J/K", T0 = "24 degC" }
"cell[3].body" = { C = "13 J/K", T0 = "26 degC" }
[resistor]
"side[2]" = { from = "cell[1].body", to = "cell[2].body", G = "0.2 W/K" }
"side[3]" = { from = "cell[2].body", to = "cell[3].body", G = "0.3 W/K" }
"cell[1].out" = { from = "cell[1].body", to = "air", R = "0.5 K/W" }
"cell[2].out" = { from = "cell[2].body", to = "air", R = "1 K/W" }
"cell[3].out" = { from = "cell[3].body", to = "air", R = "1.5 K/W" }
[source]
"cell[1].loss" = { into = "cell[1].body", P = "14 W" }
"cell[2].loss" = { into = "cell[2].body", P = "9.6 W" }
"cell[3].loss" = { into = "cell[3].body", P = "24 W" }
[limit]
"hot[1]" = { of = "cell[1].body.T - 1 [K] * 1", below = "44 degC" }
"hot[2]" = { of = "cell[2].body.T - 1 [K] * 2", below = "43 degC" }
"hot[3]" = { of = "cell[3].body.T - 1 [K] * 3", below = "42 degC" }
"cell[1].warm" = { of = "cell[1].body.T - air.T", below = "31 K" }
"cell[2].warm" = { of = "cell[2].body.T - air.T", below = "32 K" }
"cell[3].warm" = { of = "cell[3].body.T - air.T", below = "33 K" }
"#;

fn good(text: &str) -> Netlist {
    parse("net.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn values(netlist: &Netlist, names: &[&str]) -> Vec<f64> {
    let network = &netlist.network;
    names.iter().map(|name| network.parameter_value(network.parameter(name).unwrap())).collect()
}

#[test]
fn values_follow_the_number_of_their_instance() {
    let [with, by_hand] = [ROW, BY_HAND].map(|text| good(&format!("{HEAD}{text}")));
    same(&seen(&with.network), &seen(&by_hand.network), 1e-14);
    // an expansion has the numbers
    let flat = with.expanded();
    assert!(flat.contains("\"cell[2].P\" = \"2.4 W\""), "{flat}");
    assert!(!flat.contains("index"), "{flat}");
    same(&seen(&good(&flat).network), &seen(&by_hand.network), 1e-14);
}

const PACK: &str = r#"
[template.cell]
param = { P = { unit = "W" }, place = "index" }
port = ["base"]
[template.cell.node]
body = { C = "10 J/K" }
[template.cell.resistor]
out = { from = "body", to = "base", R = "1 K/W" }
[template.cell.source]
loss = { into = "body", P = "P" }

[template.module]
param = { number = "index" }
port = ["base"]
[template.module.use.cell]
template = "cell"
count = 3
connect = { base = "base" }
set = { P = "1 [W] * (10 * number + index)" }
[template.module.limit]
rise = { of = "max(cell[*].body.T - base.T, 1 [K] * index)", below = "30 K" }

[use.module]
template = "module"
count = 2
connect = { base = "air" }
"#;

/// The innermost use with a `count` gives the number; a parameter passes an outer one on.
#[test]
fn instances_inside_instances_have_their_own_numbers() {
    let pack = good(&format!("{HEAD}{PACK}"));
    let names = ["module[1].cell[1].P", "module[1].cell[3].P", "module[2].cell[2].P"];
    assert_eq!(values(&pack, &names), [11.0, 13.0, 22.0]);
    assert_eq!(values(&pack, &["module[2].number", "module[2].cell[3].place"]), [2.0, 3.0]);
    // in an expansion, families have names and numbers of the whole
    let flat = pack.expanded();
    let members = [1, 2, 3].map(|k| format!("module[2].cell[{k}].body.T - air.T")).join(", ");
    assert!(flat.contains(&format!("\"max({members}, 1 [K] * 2)\"")), "{flat}");
    assert_eq!(values(&good(&flat), &names), [11.0, 13.0, 22.0]);
}

#[test]
fn a_parameter_of_the_template_hides_the_number() {
    let own = PACK.replace("place = \"index\"", "index = 7, place = \"index\"").replace(
        "P = \"1 [W] * (10 * number + index)\"",
        "P = \"1 [W] * index\", index = [5, 6, 7]",
    );
    let pack = good(&format!("{HEAD}{own}"));
    let names = ["module[2].cell[2].place", "module[2].cell[2].P"];
    assert_eq!(values(&pack, &names), [6.0, 2.0]);
}

#[test]
fn a_mistake_in_a_value_of_the_number_is_reported_once() {
    let set = "[\"7 W\", \"2 [W] * (1 + 0.1 * index)\", \"index * 1 [W]\"]";
    let wrong = ROW.replace(set, "\"index * 2 [K]\"");
    let rejected = parse("net.toml", &format!("{HEAD}{wrong}")).unwrap_err();
    let text = rejected.to_string();
    assert_eq!(text.matches("error[").count(), 1, "{text}");
    assert!(text.contains("in `cell[1]` and 2 more, used here"), "{text}");
}
