//! Unrealistic values: nearly always a unit that is a thousand times too large or too small, or one
//! of another scale. The results of parameters, expressions and tables are checked, not their text.
//!
//! Warnings that depend on parameters are found from the network (`Netlist::judge`), again after
//! every `--set`. Only warnings that follow from the text alone are kept.

use lptn_data::Diagnostic;
use lptn_network::{
    ConductorFlow, ConductorId, End, Field, Item, Naming, Network, Substance, Value, ZERO_CELSIUS,
    slot,
};
use lptn_units::format_six as short;

use crate::source_map::SourceMap;

/// Most pairs of conductors that are named.
const MOST_PAIRS: usize = 5;

/// Least ratio of conductances that meet in a node for a warning.
const DECADES: f64 = 1e9;

/// Below this value in W/K almost nothing flows: a path without one of its parts has some uW/K.
/// Such weak conductances need a smaller ratio for a warning.
const WEAK: f64 = 1e-6;
const DECADES_OF_WEAK: f64 = 1e6;

/// True if the ratio of two conductances is so large that one of them is probably wrong.
fn far_apart(least: f64, most: f64) -> bool {
    most >= DECADES * least || (least < WEAK && most >= DECADES_OF_WEAK * least)
}

/// Temperature in K at which a property is evaluated if no node has a start.
const ROOM: f64 = 298.15;

/// A property, with the range that covers solids from foams to metals with a factor to spare, in SI
/// units.
struct Range {
    key: &'static str,
    unit: &'static str,
    /// A unit a thousand times larger, as it is usually written.
    larger: &'static str,
    from: f64,
    to: f64,
    solids: &'static str,
}

/// The limits are those of real solids near room temperature, with a factor to spare: uranium 116
/// and lithium 3582 J/(kg K), osmium 22587 kg/m^3 (CRC Handbook of Chemistry and Physics, as the
/// package mendeleev 1 has it); silica aerogels 3 kg/m^3 and about 0.015 W/(m K); natural diamond
/// of type IIa 24 to 25 W/(cm K) (Proc. SPIE 2428 (1995) 610).
const RANGES: [Range; 3] = [
    Range {
        key: "cp",
        unit: "J/(kg K)",
        larger: "J/(g K)",
        from: 50.0,
        to: 10_000.0,
        solids: "100 to 4000 J/(kg K)",
    },
    Range {
        key: "density",
        unit: "kg/m^3",
        larger: "g/cm^3",
        from: 1.0,
        to: 30_000.0,
        solids: "3 to 22600 kg/m^3",
    },
    Range {
        key: "k",
        unit: "W/(m K)",
        larger: "W/(mm K)",
        from: 0.005,
        to: 5000.0,
        solids: "0.01 to 2500 W/(m K)",
    },
];

/// A warning for each property of a material or grid of the file that no solid has at the
/// temperatures from which nodes start.
pub(crate) fn materials(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let starts = || network.thermal_nodes().map(|id| network.initial(id)).filter(|t| t.is_finite());
    let least = starts().fold(f64::INFINITY, f64::min);
    let temperatures = match least.is_finite() {
        true => [least, starts().fold(least, f64::max)],
        false => [ROOM; 2],
    };
    let check = |property: &Property<'_>| implausible((network, map), property, temperatures);
    properties(network).iter().filter_map(check).collect()
}

/// A property: its item, its field, and its value.
type Property<'a> = (Item, Field, &'a Value);

fn properties(network: &Network) -> Vec<Property<'_>> {
    let mut all: Vec<Property<'_>> = Vec::new();
    for (id, material) in network.material_ids().zip(network.materials()) {
        let item = Item::Material(id);
        all.extend(material.cp.iter().map(|value| (item, Field::SpecificHeat, value)));
        all.extend(material.density.iter().map(|value| (item, Field::Density, value)));
        all.extend(material.k.iter().map(|value| (item, Field::Conductivity, value)));
        all.extend(material.k_axis.iter().map(|value| (item, Field::AxialConductivity, value)));
    }
    for (id, grid) in network.grid_ids().zip(network.grids()) {
        let item = Item::Grid(id);
        if let Substance::Properties { density, cp } = &grid.substance {
            all.extend([(item, Field::SpecificHeat, cp), (item, Field::Density, density)]);
            all.push((item, Field::Conductivity, &grid.conductivity[0]));
        }
    }
    all
}

fn implausible(
    (network, map): (&Network, &SourceMap),
    &(item, field, property): &Property<'_>,
    temperatures: [f64; 2],
) -> Option<Diagnostic> {
    // a material of the library has no place
    let place = map.get(item, field).or_else(|| map.name(item))?;
    let axial = field == Field::AxialConductivity;
    let kind = if axial { Field::Conductivity } else { field };
    let range = RANGES.iter().find(|range| range.key == kind.key())?;
    let mut scope = network.evaluation();
    let odd = |t: &f64| {
        let value = network.property_of(property, *t, &mut scope)?;
        (!(range.from..=range.to).contains(&value)).then_some((*t, value))
    };
    let (temperature, value) = temperatures.iter().find_map(odd)?;
    let at = match property.slots().contains(&slot::OWN) {
        true => format!(" at {} degC", short(temperature - ZERO_CELSIUS)),
        false => String::new(),
    };
    let message = format!(
        "`{}` of {} `{}` is {} {}{at}, which no solid has",
        field.key(),
        map.kind(item),
        network.name_of(item),
        short(value),
        range.unit
    );
    let warning = Diagnostic::warning("netlist::implausible_property", message)
        .at(place, format!("solids have {}", range.solids));
    let fits = |scale: f64| (range.from..=range.to).contains(&(value * scale));
    Some(if fits(1e3) {
        warning.help(format!("did you mean {} {}?", short(value), range.larger))
    } else if fits(1e-3) {
        warning.help(format!("did you mean {} {}?", short(value * 1e-3), range.unit))
    } else {
        warning.help("check the unit and the number of zeros")
    })
}

/// A constant conductance in W/K; `None` between cells that do not touch.
fn conductance_of(network: &Network, id: ConductorId) -> Option<f64> {
    match network.flow(id) {
        ConductorFlow::Conductance(conductance) => Some(conductance).filter(|value| *value > 0.0),
        _ => None,
    }
}

/// True if any two conductances are far apart; in most large networks none are.
fn are_apart(network: &Network) -> bool {
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for id in network.conductor_ids() {
        if let Some(conductance) = conductance_of(network, id) {
            (least, most) = (least.min(conductance), most.max(conductance));
        }
    }
    far_apart(least, most)
}

/// A warning for constant conductances that meet in a node and are far apart.
pub(crate) fn neighbours(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    if !are_apart(network) {
        return Vec::new();
    }
    let mut extremes: Vec<Option<[(f64, ConductorId); 2]>> = vec![None; network.nodes().len()];
    for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
        let Some(conductance) = conductance_of(network, id) else { continue };
        for end in [conductor.from, conductor.to] {
            let End::Node(node) = end else { continue };
            let this = (conductance, id);
            let [least, most] = extremes[node.index()].get_or_insert([this; 2]);
            *least = if this.0 < least.0 { this } else { *least };
            *most = if this.0 > most.0 { this } else { *most };
        }
    }
    let mut pairs: Vec<[(f64, ConductorId); 2]> =
        extremes.into_iter().flatten().filter(|[least, most]| far_apart(least.0, most.0)).collect();
    pairs.sort_by_key(|[least, most]| (least.1, most.1));
    pairs.dedup_by_key(|[least, most]| (least.1, most.1));
    let mut warnings: Vec<Diagnostic> =
        pairs.iter().take(MOST_PAIRS).map(|pair| apart((network, map), pair)).collect();
    if let Some(more) = pairs.len().checked_sub(MOST_PAIRS).filter(|more| *more > 0) {
        let message = format!("{more} more pairs of resistances that meet in a node are far apart");
        warnings.push(Diagnostic::warning("network::decades_apart", message));
    }
    warnings
}

fn apart(
    (network, map): (&Network, &SourceMap),
    &[(least, weak), (most, strong)]: &[(f64, ConductorId); 2],
) -> Diagnostic {
    let words = |id: ConductorId| {
        let item = Item::Conductor(id);
        format!("{} `{}`", map.kind(item), network.name_of(item))
    };
    let message = format!(
        "{}, {} K/W, and {}, {} K/W, meet in a node and are {:.0} decades apart",
        words(weak),
        short(1.0 / least),
        words(strong),
        short(1.0 / most),
        (most / least).log10()
    );
    let warning = Diagnostic::warning("network::decades_apart", message);
    let place = |id: ConductorId| map.name(Item::Conductor(id));
    let warning = warning.at(place(weak), "");
    let warning = warning.also(place(strong), "next to it");
    warning.help(
        "check the prefix of the unit: m is a thousandth, M a million; leave out paths that carry \
            no heat",
    )
}
