//! Materials: capacities from masses and volumes, by hand.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, library, parse};
use lptn_network::{Field, Item, NodeId};

fn good(text: &str) -> Netlist {
    let text = format!(
        "format = 1\n[default]\nT0 = \"25 degC\"\n[boundary]\nair = {{ T = \"25 degC\" }}\n\
         [resistor]\nr = {{ from = \"a\", to = \"air\", R = \"1 K/W\" }}\n{text}"
    );
    parse("net.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn a(netlist: &Netlist) -> NodeId {
    netlist.network.node("a").unwrap()
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} is not {expected}");
}

#[test]
fn a_mass_of_the_library_has_its_capacity() {
    let netlist = good("[node]\na = { material = \"aluminium_6061\", mass = \"1.5 kg\" }\n");
    close(netlist.network.capacity(a(&netlist)), 1.5 * 896.0);
    close(netlist.network.mass(a(&netlist)).unwrap(), 1.5);
    assert!(netlist.warnings.is_empty());
    let material = &netlist.network.materials()[0];
    assert!(material.source.as_ref().unwrap().contains("MatWeb, 6061-T6"));
}

#[test]
fn a_volume_takes_the_density_too() {
    let netlist = good(
        "[material]\nown = { density = \"2 g/cm^3\", cp = \"0.5 J/(g K)\", source = \"test\" }\n\
         [node]\na = { material = \"own\", volume = \"300 cm^3\" }\n",
    );
    close(netlist.network.capacity(a(&netlist)), 300e-6 * 2000.0 * 500.0);
    close(netlist.network.mass(a(&netlist)).unwrap(), 0.6);
}

#[test]
fn parts_add_and_the_mass_is_known_only_if_all_are() {
    let parts = "[node]\na = {}\n[capacitor]\ng = { node = \"a\", material = \"steel_8620\", mass \
        = \"2 kg\" }\n\
                 h = { node = \"a\", material = \"steel_4340\", volume = \"100 cm^3\" }\n";
    let netlist = good(parts);
    close(netlist.network.capacity(a(&netlist)), 2.0 * 475.0 + 1e-4 * 7850.0 * 477.0);
    close(netlist.network.mass(a(&netlist)).unwrap(), 2.0 + 0.785);
    let netlist = good(&format!("{parts}i = {{ node = \"a\", C = \"10 J/K\" }}\n"));
    close(netlist.network.capacity(a(&netlist)), 2.0 * 475.0 + 1e-4 * 7850.0 * 477.0 + 10.0);
    assert_eq!(netlist.network.mass(a(&netlist)), None);
}

#[test]
fn a_material_of_the_file_hides_one_of_the_library_and_parameters_reach_both() {
    let mut netlist = good(
        "[param]\nm = \"2 kg\"\nc = \"400 J/(kg K)\"\n[material]\nsteel_8620 = { cp = \"c + 10 \
         [J/(kg K)]\" }\n\
         [node]\na = { material = \"steel_8620\", mass = \"m / 2\" }\n",
    );
    close(netlist.network.capacity(a(&netlist)), 410.0);
    netlist.set(&["m=6kg".into(), "c=90 J/(kg K)".into()]).unwrap();
    close(netlist.network.capacity(a(&netlist)), 300.0);
    let rejected = netlist.set(&["m=-6kg".into(), "c=-500 J/(kg K)".into()]).unwrap_err();
    let codes: Vec<&str> = rejected.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["network::not_positive", "network::not_positive"]);
    assert!(rejected.to_string().contains("`mass` of node `a`"), "{rejected}");
    assert!(rejected.to_string().contains("`cp` of material `steel_8620`"), "{rejected}");
}

#[test]
fn places_are_known() {
    let netlist = good("[node]\na = { material = \"copper\", mass = \"1.5 kg\" }\n");
    let item = Item::Node(a(&netlist));
    let at = |field| netlist.files.at(&netlist.source_map.get(item, field).unwrap());
    assert_eq!((at(Field::Mass), at(Field::Material)), ("\"1.5 kg\"", "\"copper\""));
}

/// The paper prints c = 0.475 J/(kg K).
#[test]
fn a_property_a_thousand_times_off_is_a_warning_with_the_unit_that_was_meant() {
    let warnings = |text: &str| {
        let text = format!(
            "[material]\nm = {{ {text} }}\n[node]\na = {{ material = \"m\", mass = \"1 kg\" }}\n"
        );
        good(&text).warnings
    };
    let helps = |text: &str| warnings(text)[0].help.clone().unwrap();
    assert_eq!(helps("cp = \"0.475 J/(kg K)\""), "did you mean 0.475 J/(g K)?");
    assert_eq!(helps("cp = \"475 J/(g K)\""), "did you mean 475 J/(kg K)?");
    assert_eq!(
        helps("cp = \"475 J/(kg K)\", density = \"7850 g/cm^3\""),
        "did you mean 7850 kg/m^3?"
    );
    assert_eq!(
        helps("cp = \"475 J/(kg K)\", density = \"0.9 kg/m^3\""),
        "did you mean 0.9 g/cm^3?"
    );
    assert_eq!(helps("cp = \"475 J/(kg K)\", k = \"46600 W/(m K)\""), "did you mean 46.6 W/(m K)?");
    assert!(
        warnings("cp = \"475 J/(kg K)\", density = \"7.85 g/cm^3\", k = \"0.03 W/(m K)\"")
            .is_empty()
    );
    assert_eq!(warnings("cp = \"475 J/(g K)\"")[0].code, "netlist::implausible_property");
}

#[test]
fn a_material_that_nothing_uses_is_a_warning() {
    let netlist =
        good("[material]\nm = { cp = \"475 J/(kg K)\" }\n[node]\na = { C = \"1 J/K\" }\n");
    assert_eq!(netlist.warnings[0].code, "netlist::unused_material");
}

#[test]
fn every_solid_of_the_library_can_be_used() {
    for record in library::materials() {
        let text =
            format!("[node]\na = {{ material = \"{}\", volume = \"1 m^3\" }}\n", record.name);
        let netlist = good(&text);
        close(netlist.network.capacity(a(&netlist)), record.density.unwrap() * record.cp.unwrap());
        assert!(netlist.warnings.is_empty());
    }
}
