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
        let expected = record.density.unwrap() * record.cp.unwrap();
        let capacity = netlist.network.capacity(a(&netlist));
        // a table over temperature is shown at 20 degC, and the node starts at 25 degC
        let rounded = if record.film.is_empty() { 1e-12 } else { 0.01 };
        assert!((capacity / expected - 1.0).abs() <= rounded, "{}: {capacity}", record.name);
        assert!(netlist.warnings.is_empty());
    }
}

/// Stainless steel 304 and copper of a residual resistance ratio of 100 between 4 and 300 K, as the
/// NIST database of cryogenic materials fits them.
const NIST: [(&str, &str, f64); 2] = [
    (
        "exp(ln(10) * (-1.4087 + 1.3982 * L + 0.2543 * L^2 - 0.6260 * L^3 + 0.2334 * L^4 + 0.4256 * \
         L^5 - 0.4658 * L^6 + 0.1650 * L^7 - 0.0199 * L^8))",
        "shape = \"rod\", diameter = \"10 mm\", length = \"0.2 m\"",
        1.190_209_491_848_93,
    ),
    (
        "exp(ln(10) * (2.2154 - 0.88068 * X^0.5 + 0.29505 * X - 0.04831 * X^1.5 + 0.003207 * X^2) / \
         (1 - 0.47461 * X^0.5 + 0.13871 * X - 0.02043 * X^1.5 + 0.001281 * X^2))",
        "shape = \"slab\", area = \"1 mm^2\", thickness = \"0.1 m\"",
        1.943_306_334_144_57,
    ),
];

/// The heat in W from 300 K to 4 K of a body with this conductivity.
fn cold(k: &str, shape: &str, ends: [f64; 2]) -> f64 {
    let text = format!(
        "[node]\na = {{ C = \"1 J/K\" }}\n[material.m]\nk = {k}\n[boundary.stage]\nT = \"4 K\"\n\
         [boundary.flange]\nT = \"300 K\"\n[conduction]\nbody = {{ from = \"flange\", to = \
         \"stage\", material = \"m\", {shape} }}\n"
    );
    let network = good(&text).network;
    let Ok(Item::Conductor(body)) = network.item("body") else { panic!("no body") };
    let temperatures = [298.15, 298.15, ends[1], ends[0]];
    let received = network.exchange(body, &mut network.evaluation(), &temperatures).unwrap();
    assert!((received[0] + received[1]).abs() < f64::MIN_POSITIVE);
    received[1]
}

/// The integrals by SciPy: k at the mean is 9.7 % too high and 36 % too low.
#[test]
fn cold_supports_conduct_as_their_integrals_say() {
    for (k, shape, heat) in NIST {
        let x = "(kelvin(T) / 1 [K])";
        let k = k.replace('L', &format!("(ln{x} / ln(10))")).replace('X', x);
        let found = cold(&format!("\"1 [W/(m K)] * {k}\""), shape, [300.0, 4.0]);
        assert!((found / heat - 1.0).abs() < 1e-11, "{found} is not {heat}");
        assert!(
            (cold(&format!("\"1 [W/(m K)] * {k}\""), shape, [4.0, 300.0]) + found).abs() == 0.0
        );
    }
}

/// Integrals of the table by SciPy 1.17 (`numpy.interp` and `PchipInterpolator`).
#[test]
fn tables_of_conductivity_are_integrated_in_closed_form() {
    for (interp, integrals) in [
        ("linear", [2996.15, 1_609.104_166_666_67, 23.921_917_808_219_2]),
        ("pchip", [3_072.691_219_105_55, 1_645.724_937_122_39, 24.002_511_125_130_1]),
    ] {
        let k = format!(
            "{{ x = [4, 20, 77, 150, 300], x_unit = \"K\", y = [0.3, 2, 7.9, 11.5, 15], y_unit = \
             \"W/(m K)\", interp = \"{interp}\" }}"
        );
        for (ends, integral) in
            [[300.0, 4.0], [200.0, 10.0], [80.0, 77.0]].into_iter().zip(integrals)
        {
            let found = cold(&k, "shape = \"slab\", area = \"1 m^2\", thickness = \"1 m\"", ends);
            assert!(
                (found / integral - 1.0).abs() < 1e-12,
                "{interp} {ends:?}: {found} {integral}"
            );
        }
    }
}

/// `T_mean` in `k` is the mean of the ends: exact as long as k is straight in it, and told otherwise
/// with the text that takes the integral.
#[test]
fn a_conductivity_that_curves_over_the_mean_is_told() {
    let body = |k: &str| {
        good(&format!(
            "[node]\na = {{ C = \"1 J/K\" }}\n[conduction]\nbody = {{ from = \"a\", to = \"air\", {k}, \
             shape = \"slab\", area = \"1 m^2\", thickness = \"1 m\" }}\n"
        ))
    };
    let straight = "k = \"2 [W/(m K)] * (1 + 0.01 [1/K] * (T_mean - 20 [degC]))\"";
    assert!(body(straight).warnings.is_empty());
    let curved = body("k = \"2 [W/(m K)] * exp((T_mean - 20 [degC]) / 50 [K])\"");
    let [warning] = curved.warnings.as_slice() else { panic!("{:?}", curved.warnings) };
    assert_eq!(warning.code, "netlist::mean_conductivity");
    let help = warning.help.as_ref().unwrap();
    let quoted: Vec<&str> = help.split('`').collect();
    let text = format!(
        "{}\n{}\n[node]\na = {{ C = \"1 J/K\" }}\n[conduction]\nbody = {{ from = \"a\", to = \"air\", {}, \
         shape = \"slab\", area = \"1 m^2\", thickness = \"1 m\" }}\n",
        quoted[1], quoted[3], quoted[5]
    );
    let mended = good(&text);
    assert!(mended.warnings.is_empty(), "{:?}", mended.warnings);
    let heat = |netlist: &Netlist| {
        let network = &netlist.network;
        let Ok(Item::Conductor(body)) = network.item("body") else { panic!("no body") };
        network.exchange(body, &mut network.evaluation(), &[393.15, 293.15]).unwrap()[1]
    };
    // 2 W/m * 50 K (e^2 - 1) over 100 K, and at the mean 200 e W
    close(heat(&mended), 100.0 * (2.0_f64.exp() - 1.0));
    close(heat(&curved), 200.0 * 1.0_f64.exp());
}
