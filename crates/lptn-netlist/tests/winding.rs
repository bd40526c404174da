//! Materials of layers and wires: numbers by hand and by NumPy, in every direction.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, parse};
use lptn_network::{ConductorFlow, Field, Item};

/// Two walls; each path has 1 m^2 and 1 m, so its conductance is the conductivity.
fn read(text: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nfill = 0.45\nk_resin = \"0.2 W/(m K)\"\n\
         [node]\na = {{ C = \"1 J/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
         [material]\n\
         conductor = {{ density = \"8933 kg/m^3\", cp = \"385 J/(kg K)\", k = \"401 W/(m K)\" }}\n\
         coat = {{ density = \"1350 kg/m^3\", cp = \"1090 J/(kg K)\", k = \"0.26 W/(m K)\" }}\n\
         resin = {{ density = \"1200 kg/m^3\", cp = \"1500 J/(kg K)\", k = \"k_resin\" }}\n{text}"
    );
    parse("winding.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn paths(material: &str, directions: [&str; 2]) -> String {
    let path = |(name, direction): (&str, &str)| {
        format!(
            "{name} = {{ from = \"a\", to = \"air\", material = \"{material}\", direction = \
             \"{direction}\", shape = \"slab\", area = \"1 m^2\", thickness = \"1 m\" }}\n"
        )
    };
    format!("[conduction]\n{}{}", path(("even", directions[0])), path(("axial", directions[1])))
}

fn conductances(netlist: &Netlist) -> [f64; 2] {
    let network = &netlist.network;
    ["even", "axial"].map(|name| {
        let Item::Conductor(id) = network.item(name).unwrap() else { panic!("{name}") };
        match network.flow(id) {
            ConductorFlow::Conductance(conductance) => conductance,
            other => panic!("{other:?}"),
        }
    })
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} is not {expected}");
}

const BARE: &str =
    "slot = { winding = { fill = \"fill\", wire = \"conductor\", resin = \"resin\" } }\n";
const COATED: &str = "slot = { winding = { fill = \"fill\", wire = \"conductor\", enamel = \"coat\", \
    enamel_fill = 0.07, resin = \"resin\" } }\n";
const WIRES: [&str; 2] = ["across_wires", "along_wires"];

/// NumPy: `kr ((1 + f) kw + (1 - f) kr) / ((1 - f) kw + (1 + f) kr)` with kw = 401, kr = 0.2 and
/// f = 0.45 or 0.3; along the wires the parallel mean.
#[test]
fn bare_wires_conduct_as_the_bound_of_hashin_and_shtrikman() {
    let mut netlist = read(&format!("{BARE}{}", paths("slot", WIRES)));
    let [across, along] = conductances(&netlist);
    near(across, 0.526_679_949_284_549_9);
    near(along, 180.56);
    netlist.set(&["fill=0.3".into()]).unwrap();
    let [across, along] = conductances(&netlist);
    near(across, 0.371_184_510_250_569_53);
    near(along, 0.3 * 401.0 + 0.7 * 0.2);
}

/// NumPy: the bound twice, first of the core in its enamel, 0.45 of 0.52, then of both in resin.
#[test]
fn enamel_is_a_coat_of_each_wire() {
    let netlist = read(&format!("{COATED}{}", paths("slot", WIRES)));
    let [across, along] = conductances(&netlist);
    near(across, 0.547_441_928_259_396_1);
    near(along, 180.5642);
}

/// An enamel of resin is resin.
#[test]
fn a_coat_of_resin_is_bare() {
    let coat = COATED.replace("\"coat\"", "\"resin\"");
    let netlist = read(&format!("{coat}{}", paths("slot", WIRES)));
    let bare = read(&format!("{BARE}{}", paths("slot", WIRES)));
    let [found, expected] = [netlist, bare].map(|netlist| conductances(&netlist));
    near(found[0], expected[0]);
    near(found[1], expected[1]);
}

/// A square array of perfect conductors that fill half of the plane conducts 3.0797 times as well
/// as what is between them (Rayleigh, Phil. Mag. 34 (1892) 481). The bound is 2.6 % below it, as
/// the page says.
#[test]
fn the_bound_is_below_wires_in_a_square_order() {
    let text = format!("{BARE}{}", paths("slot", WIRES)).replace("\"conductor\"", "\"perfect\"");
    let perfect =
        "perfect = { density = \"1 kg/m^3\", cp = \"100 J/(kg K)\", k = \"5e9 W/(m K)\" }\n";
    let mut netlist = read(&format!("{perfect}{text}"));
    netlist.set(&["fill=0.5".into()]).unwrap();
    let ratio = conductances(&netlist)[0] / 0.2 / 3.0797;
    assert!((0.973..0.975).contains(&ratio), "{ratio}");
}

/// Oak Ridge measured 0.5 to 1 W/(m K) across and more than 200 W/(m K) along wires that fill half
/// of a varnished specimen (J. Thermal Sci. Eng. Appl., "Anisotropic thermal response of packed
/// copper wire"). The numbers of the page are those of Python for H(H(401, 0.26, 0.5/0.57), 0.2,
/// 0.57), and of the parallel mean.
#[test]
fn varnished_copper_conducts_as_measured() {
    let mut netlist = read(&format!("{COATED}{}", paths("slot", WIRES)));
    netlist.set(&["fill=0.5".into()]).unwrap();
    let [across, along] = conductances(&netlist);
    assert!((0.5..1.0).contains(&across) && along > 200.0, "{across} {along}");
    near(across, 0.624_516_073_610_006_9);
    near(along, 0.5 * 401.0 + 0.07 * 0.26 + 0.43 * 0.2);
}

#[test]
fn heat_capacities_add_by_volume_and_mass() {
    let netlist = read(&format!(
        "{COATED}[capacitor]\nslot = {{ node = \"a\", material = \"slot\", volume = \"1 m^3\" }}\n\
         {}",
        paths("slot", WIRES)
    ));
    let node = netlist.network.node("a").unwrap();
    let heat = 0.45 * 8933.0 * 385.0 + 0.07 * 1350.0 * 1090.0 + 0.48 * 1200.0 * 1500.0;
    near(netlist.network.capacity(node), 1.0 + heat);
}

/// A k of the wire that depends on T reaches both directions. The mean of 401 - 0.07 (T - 20 degC)
/// from 20 to 120 degC is 397.5 W/(m K).
#[test]
fn a_part_may_depend_on_the_temperature() {
    let wire = "warm = { density = \"8933 kg/m^3\", cp = \"385 J/(kg K)\", k = \"401 [W/(m K)] - 0.07 \
        [W/(m K^2)] * (T - 20 [degC])\" }\n";
    let slot = BARE.replace("\"conductor\"", "\"warm\"");
    let netlist = read(&format!("{wire}{slot}{}", paths("slot", WIRES)));
    let network = &netlist.network;
    let Item::Conductor(id) = network.item("axial").unwrap() else { panic!() };
    let [_, heat] = network.exchange(id, &mut network.evaluation(), &[393.15, 293.15]).unwrap();
    assert!((heat / (100.0 * (0.45 * 397.5 + 0.55 * 0.2)) - 1.0).abs() < 1e-9, "{heat}");
}

#[test]
fn layers_conduct_in_their_plane_and_through_it() {
    let board = "board = { density = \"1900 kg/m^3\", cp = \"1100 J/(kg K)\", k = \"1.059 W/(m K)\", \
        k_through = \"0.343 W/(m K)\" }\n";
    let netlist = read(&format!("{board}{}", paths("board", ["in_plane", "through_plane"])));
    let [plane, through] = conductances(&netlist);
    near(plane, 1.059);
    near(through, 0.343);
}

/// Conductances of the middle of a block of 1 m^3 with two cells along each axis.
#[test]
fn a_grid_turns_its_material() {
    for (axis, expected) in [("x", 0), ("y", 1), ("z", 2)] {
        let netlist = read(&format!(
            "{BARE}[grid.block]\nsize = [\"1 m\", \"1 m\", \"1 m\"]\ncells = [2, 2, 2]\nmaterial = \
             \"slot\"\naxis = \"{axis}\"\nT0 = \"20 degC\"\n[resistor]\nr = {{ from = \
             \"block[1,1,1]\", to = \"a\", R = \"1 K/W\" }}\n[convection]\nf = {{ from = \"block.x0\", \
             to = \"air\", h = \"1 W/(m^2 K)\" }}\n"
        ));
        let network = &netlist.network;
        let grid = &network.grids()[0];
        for (along, k) in grid.conductivity.iter().enumerate() {
            let k = k.at(&mut network.evaluation()).unwrap();
            near(k, if along == expected { 180.56 } else { 0.526_679_949_284_549_9 });
        }
    }
}

#[test]
fn wires_that_do_not_fit_are_an_error_of_set() {
    let mut netlist = read(&format!("{COATED}{}", paths("slot", WIRES)));
    let rejected = netlist.set(&["fill=0.85".into()]).unwrap_err();
    assert_eq!(rejected.diagnostics[0].code, "network::overfilled", "{rejected}");
    assert!(rejected.to_string().contains("fill 0.92 of the volume"), "{rejected}");
    let rejected = netlist.set(&["fill=-0.1".into()]).unwrap_err();
    assert!(rejected.to_string().contains("`fill` of material `slot`"), "{rejected}");
}

#[test]
fn places_of_shares_are_known() {
    let netlist = read(&format!("{COATED}{}", paths("slot", WIRES)));
    let id = netlist
        .network
        .material_ids()
        .find(|id| netlist.network.materials()[id.index()].name == "slot");
    let item = Item::Material(id.unwrap());
    let at = |field| netlist.files.at(&netlist.source_map.get(item, field).unwrap());
    assert_eq!((at(Field::Fill), at(Field::EnamelFill)), ("\"fill\"", "0.07"));
}

#[test]
fn a_winding_is_the_same_when_it_is_written_and_read_again() {
    let board = "board = { density = \"1900 kg/m^3\", cp = \"1100 J/(kg K)\", k = \"2 * k_resin\", \
        k_through = \"k_resin\" }\n";
    for (text, material, words) in [
        (COATED, "slot", WIRES),
        (BARE, "slot", WIRES),
        (board, "board", ["in_plane", "through_plane"]),
    ] {
        let mut first = read(&format!("{text}{}", paths(material, words)));
        let written = first.expanded();
        let mut again = parse("again.toml", &written).unwrap_or_else(|e| panic!("{e}\n{written}"));
        assert_eq!(again.expanded(), written);
        assert!(words.iter().all(|word| written.contains(word)), "{written}");
        for set in ["k_resin=0.2 W/(m K)", "k_resin=0.9 W/(m K)"] {
            first.set(&[set.into()]).unwrap();
            again.set(&[set.into()]).unwrap();
            let [found, expected] = [&again, &first].map(conductances);
            assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
        }
    }
}
