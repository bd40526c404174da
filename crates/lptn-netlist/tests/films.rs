//! Reference: properties over temperature that films take, against CoolProp between their points.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_laws::{Fluid, nusselt_vertical_plate, rayleigh};
use lptn_netlist::library::find;
use lptn_netlist::{Netlist, parse};

const PROPERTIES: [&str; 5] = ["density", "cp", "k", "viscosity", "expansion"];

/// `tests/films.csv`, written by `tools/properties.py`: CoolProp two fifths of the way from point to
/// point. Cold glycol and the expansion of cold water are the worst.
#[test]
fn tables_are_those_of_coolprop_between_their_points() {
    let text = include_str!("films.csv");
    let mut worst = 0.0_f64;
    for line in text.lines().skip(2) {
        let mut cells = line.split(',');
        let fluid = find(cells.next().unwrap()).unwrap();
        let t: f64 = cells.next().unwrap().parse().unwrap();
        for (key, cell) in PROPERTIES.iter().zip(cells) {
            let expected: f64 = cell.parse().unwrap();
            let (_, table) = fluid.film.iter().find(|(known, _)| known == key).unwrap();
            let (found, _) = table.value_and_slope(t).unwrap();
            let error = (found / expected - 1.0).abs();
            assert!(error < 5e-4, "{} of {} at {t} K: {found}, {expected}", key, fluid.name);
            worst = worst.max(error);
        }
    }
    assert!(worst > 1e-6, "something was compared");
}

/// A plate in air of the library, and in a fluid of the file whose k is a number in place of its
/// table.
const PLATES: &str = r#"
format = 1
[fluid.gas]
density = "1.1 kg/m^3"
cp = "1007 J/(kg K)"
k = "0.0277 W/(m K)"
viscosity = { x = ["0 degC", "100 degC"], y = ["17.2 uPa s", "21.7 uPa s"] }
expansion = "1 / kelvin(T)"
[node]
a = { T0 = "80 degC", C = "1 kJ/K" }
[boundary]
room = { T = "20 degC" }
[convection.air]
from = "a"
to = "room"
correlation = "vertical_plate"
fluid = "air"
height = "0.3 m"
area = "0.1 m^2"
[convection.gas]
from = "a"
to = "room"
correlation = "upper_side_of_from"
fluid = "gas"
k = "0.03 W/(m K)"
length = "40 mm"
area = "0.1 m^2"
"#;

fn heats(netlist: &Netlist, t: f64) -> Vec<f64> {
    let network = &netlist.network;
    let mut scope = network.evaluation();
    let ids = network.conductor_ids();
    ids.map(|id| network.exchange(id, &mut scope, &[t, 293.15]).unwrap()[1]).collect()
}

/// The film stands at 50 degC, where CoolProp has these.
#[test]
fn a_film_takes_the_properties_of_its_mean_temperature() {
    let netlist = parse("plates.toml", PLATES).unwrap();
    let air = Fluid {
        conductivity: 0.028_082_86,
        density: 1.092_484,
        specific_heat: 1007.431,
        viscosity: 19.635_25e-6,
    };
    let ra = rayleigh(air, 0.003_101_066, 60.0, 0.3);
    let heat = air.film(nusselt_vertical_plate(ra, air.prandtl()), 0.3, 0.1) * 60.0;
    let found = heats(&netlist, 353.15);
    assert!((found[0] / heat - 1.0).abs() < 1e-4, "{} is not {heat}", found[0]);
}

#[test]
fn a_film_is_the_same_when_it_is_written_and_read_again() {
    let first = parse("plates.toml", PLATES).unwrap();
    let written = first.expanded();
    assert!(
        written.contains("correlation = \"vertical_plate\", fluid = \"air\", height"),
        "{written}"
    );
    assert!(written.contains("k = \"0.03 W/(m K)\", "), "{written}");
    let again = parse("plates.toml", &written).unwrap_or_else(|e| panic!("{e}\n{written}"));
    assert_eq!(again.expanded(), written);
    for t in [280.0, 293.15, 330.0, 353.15] {
        assert_eq!(heats(&first, t), heats(&again, t));
    }
}

/// A table has no value outside its temperatures, and says which.
#[test]
fn a_film_outside_the_tables_of_its_fluid_is_refused() {
    let netlist = parse("plates.toml", PLATES).unwrap();
    let network = &netlist.network;
    let id = network.conductor_ids().next().unwrap();
    let error = network.exchange(id, &mut network.evaluation(), &[3000.0, 293.15]).unwrap_err();
    assert!(
        error.to_string().contains("1500 K") || error.to_string().contains("1226.85"),
        "{error}"
    );
}

/// Air that is measured at 20 degC, out of an oven at 100 degC and of a furnace at 1000 degC: the
/// density and the differences of enthalpy are those of CoolProp 8.0 for dry air at 101325 Pa. A
/// stream had its density and heat capacity at 25 degC, wherever it was measured.
#[test]
fn a_stream_carries_the_enthalpies_of_its_tables() {
    let text = "format = 1\n[node]\nbox = { C = \"1 kJ/K\", T0 = \"25 degC\" }\n[boundary]\n\
        hot = { T = \"100 degC\" }\n[advection]\nfeed = { from = \"hot\", to = \"box\", fluid = \"air\", \
        flow = \"100 m^3/h\", flow_T = \"20 degC\" }\n[convection]\nfilm = { from = \"box\", to = \"hot\", \
        correlation = \"vertical_plate\", fluid = \"air\", height = \"1 m\", area = \"1 m^2\" }\n";
    let network = parse("box.toml", text).unwrap().network;
    let flow = 100.0 / 3600.0 * 1.204_575_182_493_15;
    let feed = network.conductor_ids().find(|id| network.conductors()[id.index()].law.is_stream());
    for (node, hot, enthalpies) in
        [(298.15, 373.15, 75_628.495_456_444_2), (293.15, 1273.15, 1_071_098.274_276_19)]
    {
        let scope = &mut network.evaluation();
        let [left, entered] = network.exchange(feed.unwrap(), scope, &[node, hot]).unwrap();
        assert!(left.abs() < f64::MIN_POSITIVE, "{left}");
        let heat = flow * enthalpies;
        assert!((entered / heat - 1.0).abs() < 2e-5, "{entered} is not {heat}");
    }
    // the film has no density or heat capacity of its own
    let keys: Vec<&str> = network.fluids()[0].film.iter().map(|(field, _)| field.key()).collect();
    assert_eq!(keys, ["k", "viscosity", "expansion"]);
}
