//! A written netlist is read again before it is passed on.
//!
//! `prove` reads the text at its final place and compares names, and values at several times.

use std::collections::BTreeMap;
use std::path::Path;

use lptn_network::{ConductorFlow, Item, Network};

use crate::netlist::{Netlist, parse_file};

lptn_units::errors! {
/// A netlist that was written is read as another network: a mistake of this program.
#[derive(Clone, Debug)]
pub enum WrittenError {
    /// It is not read; the first reason.
    Rejected { reason: String } = "netlist::written",
        format!("the netlist to be written would not be read: {reason}");
    /// It is read as another network; `what` names the difference, such as "node `steel`".
    Differs { what: String } = "netlist::written",
        format!("the netlist to be written would be read as another network: {what} differs");
}
}

/// Allowed relative difference between two numbers of one text: rounding of a unit.
const ROUNDING: f64 = 1e-12;

/// Reads a netlist that was written for a network as if from `place`, and compares names, and
/// numbers at several times from `start` to `stop` in s.
///
/// # Errors
/// [`WrittenError`] with the first difference.
pub fn prove(
    text: &str,
    place: &Path,
    network: &Network,
    (start, stop): (f64, f64),
) -> Result<Netlist, WrittenError> {
    let again = parse_file(place, text.as_bytes()).map_err(|rejected| {
        let reason =
            rejected.diagnostics.first().map(|problem| problem.message.clone()).unwrap_or_default();
        WrittenError::Rejected { reason }
    })?;
    // times that no grid of points of a signal meets
    let times: Vec<f64> =
        [0.0, 0.071, 0.293, 0.517, 0.839, 1.0].map(|x| start + x * (stop - start)).to_vec();
    let (found, wanted) = (Facts::of(&again.network, &times), Facts::of(network, &times));
    match found.difference(&wanted) {
        None => Ok(again),
        Some(what) => Err(WrittenError::Differs { what }),
    }
}

/// The numbers of each item of a network, by kind and name.
struct Facts(BTreeMap<String, Vec<f64>>);

impl Facts {
    fn of(network: &Network, times: &[f64]) -> Self {
        let mut facts = Self(BTreeMap::new());
        facts.constants(network);
        facts.names(network);
        let temperatures = temperatures(network);
        for &time in times {
            facts.at(network, time, &temperatures);
        }
        facts
    }

    fn add(&mut self, kind: &str, name: &str, number: f64) {
        self.0.entry(format!("{kind} `{name}`")).or_default().push(number);
    }

    fn constants(&mut self, network: &Network) {
        for (id, parameter) in network.parameter_ids().zip(network.parameters()) {
            self.add("parameter", &parameter.name, network.parameter_value(id));
        }
        for (id, node) in network.node_ids().zip(network.nodes()) {
            self.add("node", &node.name, network.capacity(id));
            self.add("node", &node.name, network.initial(id));
        }
        for (name, symbol) in network.tables() {
            let knots =
                (0..symbol.table.dimension()).flat_map(|argument| symbol.table.knots(argument));
            knots.for_each(|knot| self.add("table", name, *knot));
        }
    }

    /// Items that have only a name and a text.
    fn names(&mut self, network: &Network) {
        let controls = network.controls().iter().map(|control| ("control", control.name.as_str()));
        let limits = network.limits().iter().map(|limit| ("limit", limit.name.as_str()));
        let capacitors =
            network.capacitors().iter().map(|capacitor| ("capacitor", capacitor.name.as_str()));
        for (kind, name) in controls.chain(limits).chain(capacitors) {
            self.add(kind, name, 0.0);
        }
    }

    /// Values that change with time; a value that is undefined is NaN in both networks.
    fn at(&mut self, network: &Network, time: f64, temperatures: &[f64]) {
        let mut scope = network.evaluation();
        scope.set_time(time, time);
        for (id, signal) in network.signal_ids().zip(network.signals()) {
            self.add("signal", &signal.name, scope.signal(id));
        }
        for boundary in network.boundaries() {
            self.add(
                "boundary",
                &boundary.name,
                boundary.temperature.at(&mut scope).unwrap_or(f64::NAN),
            );
        }
        for id in network.source_ids() {
            let heat = network.source_heat(id, &mut scope, temperatures).unwrap_or(f64::NAN);
            self.add("source", &network.name_of(Item::Source(id)), heat);
        }
        for id in network.conductor_ids() {
            let name = network.name_of(Item::Conductor(id));
            match network.flow(id) {
                ConductorFlow::Conductance(number)
                | ConductorFlow::Radiation(number)
                | ConductorFlow::Stream(number) => {
                    self.add("path", &name, number);
                }
                ConductorFlow::Variable => {
                    let heats =
                        network.exchange(id, &mut scope, temperatures).unwrap_or([f64::NAN; 2]);
                    heats.into_iter().for_each(|heat| self.add("path", &name, heat));
                }
            }
        }
    }

    fn difference(&self, wanted: &Self) -> Option<String> {
        let near = |a: f64, b: f64| {
            a.to_bits() == b.to_bits()
                || (a.is_nan() && b.is_nan())
                || (a - b).abs() <= ROUNDING * a.abs().max(b.abs())
        };
        let same =
            |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| near(*a, *b));
        let missing = self.0.keys().find(|name| !wanted.0.contains_key(*name));
        let differs =
            || wanted.0.iter().find(|(name, b)| self.0.get(*name).is_none_or(|a| !same(a, b)));
        missing.or_else(|| differs().map(|(name, _)| name)).cloned()
    }
}

/// A temperature for every vertex that follows from its name, whatever the order: 280 K to 340 K.
fn temperatures(network: &Network) -> Vec<f64> {
    let of = |name: &str| {
        280.0
            + f64::from(name.bytes().fold(7_u32, |sum, b| (31 * sum + u32::from(b)) % 6007)) / 100.0
    };
    let nodes = network.nodes().iter().map(|node| of(&node.name));
    nodes.chain(network.boundaries().iter().map(|boundary| of(&boundary.name))).collect()
}
