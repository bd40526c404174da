//! Possible but unlikely values: nearly always a wrong prefix or scale. Results are checked, not
//! text, as in [`plausible`](crate::plausible).

use lptn_data::Diagnostic;
use lptn_network::{
    ConductorFlow, ConductorId, ConductorKind, End, Field, Item, Naming, Network, NodeId, Value,
    ZERO_CELSIUS,
};
use lptn_units::{format_number, format_six as short};

use crate::source_map::SourceMap;

/// Most warnings of a kind.
const MOST: usize = 5;

/// Every warning about an unlikely value.
pub(crate) fn values(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let mut all = scales(network, map);
    all.extend(laws(network, map));
    all.extend(capacities(network, map));
    all.extend(time_constants(network, map));
    all
}

/// True for a room temperature in kelvin: 293, 298.15. In degrees Celsius it would be an unusual
/// temperature of a furnace.
fn is_room_in_kelvin(number: f64) -> bool {
    const WHOLE: [f64; 8] = [273.0, 283.0, 288.0, 293.0, 295.0, 296.0, 298.0, 303.0];
    let near = |other: f64| (number - other).abs() < 1e-6;
    let fraction = number.fract();
    let with_zero = (270.0..330.0).contains(&number) && (fraction - 0.15).abs() < 1e-6;
    with_zero || WHOLE.into_iter().any(near)
}

/// Boundaries and starts of nodes.
fn scales(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let constant = |value: &Value| match value {
        Value::Constant(kelvin) => Some(*kelvin),
        _ => None,
    };
    let boundaries = network.boundary_ids().zip(network.boundaries()).filter_map(|(id, one)| {
        Some((Item::Boundary(id), Field::Temperature, constant(&one.temperature)?))
    });
    let starts = network.thermal_nodes().filter_map(|id| {
        let node = &network.nodes()[id.index()];
        Some((Item::Node(id), Field::Initial, constant(node.initial.as_ref()?)?))
    });
    let odd = boundaries.chain(starts).filter_map(|(item, field, kelvin)| {
        let number = ((kelvin - ZERO_CELSIUS) * 1e9).round() / 1e9;
        // a place in an imported file takes longer than all else
        let place = is_room_in_kelvin(number).then(|| map.get(item, field))??;
        let number = format_number(number);
        let message = format!("{} `{}` is at {number} degC", map.kind(item), network.name_of(item));
        let warning = Diagnostic::warning("netlist::kelvin_as_celsius", message);
        Some(warning.at(place, "").help(format!("did you mean \"{number} K\"?")))
    });
    odd.take(MOST).collect()
}

/// The key of a law, the largest usual value, and the reason.
struct Most {
    key: &'static str,
    most: f64,
    unit: &'static str,
    /// The same number in a unit a thousandth as large.
    smaller: &'static str,
    why: &'static str,
}

/// VDI Heat Atlas, section A2: forced convection of liquids up to 10 kW/(m^2 K); boiling and
/// condensation beyond it. No plate of a machine or wall of a house is thicker than 3 m.
const MOST_USUAL: [Most; 2] = [
    Most {
        key: "h",
        most: 1e4,
        unit: "W/(m^2 K)",
        smaller: "W/(m^2 K)",
        why: "only boiling or condensation has more than 10 kW/(m^2 K)",
    },
    Most { key: "thickness", most: 3.0, unit: "m", smaller: "mm", why: "no wall is that thick" },
];

fn laws(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
        for (field, value) in conductor.law.parts() {
            // solder and grease conduct better than any film
            let film = conductor.kind == ConductorKind::Convection;
            let is = |usual: &&Most| usual.key == field.key() && (film || usual.key != "h");
            let Some(usual) = MOST_USUAL.iter().find(is) else {
                continue;
            };
            let Value::Constant(value) = value else { continue };
            let item = Item::Conductor(id);
            let unusual = (*value > usual.most).then(|| map.get(item, field));
            let Some(place) = unusual.flatten() else { continue };
            let whole = network.whole(item).unwrap_or(item);
            let message = format!(
                "`{}` of {} `{}` is {} {}",
                usual.key,
                map.kind(item),
                network.name_of(whole),
                short(*value),
                usual.unit
            );
            // a thousandth: W for kW, mm for m
            let meant = if usual.unit == usual.smaller { value / 1e3 } else { *value };
            let warning = Diagnostic::warning("netlist::implausible_value", message);
            found.push(warning.at(place, usual.why).help(format!(
                "did you mean {} {}?",
                short(meant),
                usual.smaller
            )));
            if found.len() == MOST {
                return found;
            }
        }
    }
    found
}

/// Capacities of nodes, constant and more than zero.
fn masses(network: &Network) -> Vec<(NodeId, f64)> {
    let constant =
        network.thermal_nodes().filter_map(|id| match network.nodes()[id.index()].capacity {
            Some(Value::Constant(capacity)) if capacity > 0.0 => Some((id, capacity)),
            _ => None,
        });
    constant.collect()
}

/// Warns about one node with a thousandth of the capacity of the others: J instead of kJ.
fn capacities(network: &Network, map: &SourceMap) -> Option<Diagnostic> {
    let masses = masses(network);
    let &(id, least) = masses.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let others = || masses.iter().filter(|(other, _)| *other != id).map(|(_, capacity)| *capacity);
    let lowest = others().fold(f64::INFINITY, f64::min);
    let highest = others().fold(0.0, f64::max);
    let alike = highest <= 10.0 * lowest && others().count() >= 2;
    let fits = (lowest / 3.0..=3.0 * highest).contains(&(1e3 * least)) && lowest > 100.0 * least;
    let item = Item::Node(id);
    let place = (alike && fits).then(|| map.get(item, Field::Capacity))??;
    let message = format!(
        "the capacity of node `{}` is {} J/K, but other nodes have {} to {} J/K",
        network.name_of(item),
        short(least),
        short(lowest),
        short(highest)
    );
    let warning = Diagnostic::warning("netlist::implausible_value", message);
    Some(warning.at(place, "").help(format!("did you mean {} kJ/K?", short(least))))
}

/// Usual time constants of bodies in s: from a nanosecond to thirty years.
const TIMES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// Nodes with time constants outside this range.
fn time_constants(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let mut coupled = vec![(0.0, None); network.nodes().len()];
    for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
        let conductance = match network.flow(id) {
            ConductorFlow::Conductance(conductance) => conductance,
            // its value is unknown here
            _ => f64::NAN,
        };
        for end in [conductor.from, conductor.to] {
            let End::Node(node) = end else { continue };
            let (sum, strongest): &mut (f64, Option<(f64, ConductorId)>) =
                &mut coupled[node.index()];
            *sum += conductance;
            if strongest.is_none_or(|(most, _)| conductance > most) {
                *strongest = Some((conductance, id));
            }
        }
    }
    let odd = masses(network).into_iter().filter_map(|(node, capacity)| {
        let (sum, strongest) = coupled[node.index()];
        let time = capacity / sum;
        let (_, path) = strongest.filter(|_| time.is_finite() && !TIMES.contains(&time))?;
        let (node, path) = (Item::Node(node), Item::Conductor(path));
        let message = format!(
            "node `{}` has a time constant of {} s: {} J/K over {} W/K",
            network.name_of(node),
            short(time),
            short(capacity),
            short(sum)
        );
        let warning = Diagnostic::warning("network::time_constant", message);
        let warning = warning.at(map.name(node)?, "its capacity");
        let warning = warning.also(map.name(path)?, "its strongest path");
        Some(warning.help("check the prefixes of the units: m is a thousandth, M a million"))
    });
    odd.take(MOST).collect()
}
