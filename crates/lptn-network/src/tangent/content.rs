//! Change of the heat content of a node with a parameter, at a fixed temperature.
//!
//! `H(T) = integral of C from T0 to T`, so that `dH = integral of dC - C(T0) dT0`. For a constant
//! capacity this is `dC (T - T0) - C dT0`; if a varying one is scaled as a whole by a size, it is
//! `H dln(size) - C(T0) dT0`.

use lptn_units::Scalar;

use super::influence::{Influence, melting};
use super::reads::each;
use super::refusal::NoTangents;
use super::{Pass, Tangents};
use crate::enthalpy::Enthalpy;
use crate::evaluation::{PASS, Slope};
use crate::gauss::GAUSS;
use crate::id::NodeId;
use crate::network::Network;
use crate::slot;
use crate::value::Value;

/// The derivatives of one node in a pass.
#[derive(Clone, Debug)]
pub(super) struct Content {
    node: NodeId,
    /// `dT0` in K.
    initial: [f64; PASS],
    change: Change,
}

/// Change of the capacity of a node.
#[derive(Clone, Debug)]
enum Change {
    /// `dC` of a constant one in J/K.
    Constant([f64; PASS]),
    /// `dln(size)` of one that is scaled as a whole.
    Scaled([f64; PASS]),
    /// The parts of one whose parts change separately: integrated.
    Parts(Vec<Value>),
}

/// The values that the heat content of each node follows from.
pub(super) struct Bodies<'a> {
    network: &'a Network,
    influence: &'a Influence<'a>,
    capacitors: Vec<Vec<&'a Value>>,
}

impl<'a> Bodies<'a> {
    pub(super) fn new(network: &'a Network, influence: &'a Influence<'a>) -> Self {
        let mut capacitors: Vec<Vec<&Value>> = vec![Vec::new(); network.nodes().len()];
        for part in network.capacitors() {
            capacitors[part.node.index()].push(&part.capacity);
        }
        Self { network, influence, capacitors }
    }

    /// The change of the heat content of a node in a pass.
    pub(super) fn content(&self, id: NodeId, pass: &mut Pass) -> Result<Content, NoTangents> {
        let node = &self.network.nodes()[id.index()];
        let values: Vec<&Value> =
            node.capacity.iter().chain(self.capacitors[id.index()].iter().copied()).collect();
        let start = node.initial.as_ref().filter(|_| !node.massless);
        if node.molten > 0.0 && start.is_some_and(|start| self.influence.value(start)) {
            return Err(NoTangents::Melting { node: id });
        }
        Content::new(self.network, id, &values, (self.influence, pass))
    }
}

impl Content {
    fn new(
        network: &Network,
        node: NodeId,
        values: &[&Value],
        (influence, pass): (&Influence<'_>, &mut Pass),
    ) -> Result<Self, NoTangents> {
        let none = Value::Constant(0.0);
        let start = network.nodes()[node.index()].initial.as_ref().unwrap_or(&none);
        let initial = sum(&[start], pass).derivatives;
        let melts = melts(network, node);
        let change = match (network.enthalpy(node).is_some(), size_of(values, influence)) {
            (false, _) => Change::Constant(sum(values, pass).derivatives),
            (true, Some(size)) if !melts || latent_scales(network, node, (&size, influence)) => {
                Change::Scaled(logarithmic(&size, pass))
            }
            (true, _) if !melts => {
                Change::Parts(values.iter().map(|&value| value.clone()).collect())
            }
            (true, _) => return Err(NoTangents::Melting { node }),
        };
        Ok(Self { node, initial, change })
    }

    pub(super) fn node(&self) -> NodeId {
        self.node
    }

    /// `dH` in J, at a temperature in K. Changes the slot of the node's own temperature.
    fn at(
        &self,
        network: &Network,
        (slots, stack): (&mut [Slope], &mut Vec<Slope>),
        temperature: f64,
    ) -> [f64; PASS] {
        let start = network.initial(self.node);
        let first = network.capacity(self.node);
        let mut change = match &self.change {
            Change::Constant(slopes) => slopes.map(|slope| slope * (temperature - start)),
            Change::Scaled(slopes) => {
                let heat = network.enthalpy(self.node).and_then(|curve| curve.heat(temperature));
                slopes.map(|slope| slope * heat.unwrap_or(f64::NAN))
            }
            Change::Parts(values) => match network.enthalpy(self.node) {
                Some(curve) => integral(values, curve, (start, temperature), (slots, stack)),
                None => [f64::NAN; PASS],
            },
        };
        change.iter_mut().zip(&self.initial).for_each(|(dh, dt)| *dh -= first * dt);
        change
    }
}

/// The factors of the only part that all of a capacity is proportional to and that alone changes
/// with the parameters: its size. `None` if something else changes too.
fn size_of(values: &[&Value], influence: &Influence<'_>) -> Option<Vec<Value>> {
    let [value] = values else {
        return values.iter().all(|value| !influence.value(value)).then(Vec::new);
    };
    let factors: Vec<Value> = match value {
        Value::Product(factors) => factors.to_vec(),
        one => vec![(*one).clone()],
    };
    let reads_own = |factor: &Value| factor.slots().contains(&slot::OWN);
    let changing: Vec<Value> =
        factors.into_iter().filter(|factor| influence.value(factor)).collect();
    changing.iter().all(|factor| !reads_own(factor)).then_some(changing)
}

fn melts(network: &Network, node: NodeId) -> bool {
    network.nodes()[node.index()].molten > 0.0 || melting(network, node).next().is_some()
}

/// True if latent heat is proportional to these factors of a capacity too, and else does not
/// change.
fn latent_scales(
    network: &Network,
    node: NodeId,
    (size, influence): (&[Value], &Influence<'_>),
) -> bool {
    melting(network, node).all(|(lump, melting)| {
        let density = network.materials()[lump.material.index()].density.as_ref();
        let amount = [Some(lump.size.field().1), density];
        let fixed = [&melting.solidus, &melting.liquidus, &melting.heat];
        let scales =
            |factor: &Value| amount.into_iter().flatten().any(|value| value.is_same(factor));
        !fixed.into_iter().any(|value| influence.value(value)) && size.iter().all(scales)
    })
}

fn sum(values: &[&Value], pass: &mut Pass) -> Slope {
    sum_on(values, (&pass.slots, &mut pass.stack))
}

fn sum_on(values: &[&Value], (slots, stack): (&[Slope], &mut Vec<Slope>)) -> Slope {
    let zero = Slope::constant(0.0);
    values
        .iter()
        .fold(zero, |sum, value| sum + value.on(slots, stack).unwrap_or(Slope::constant(f64::NAN)))
}

fn logarithmic(factors: &[Value], pass: &mut Pass) -> [f64; PASS] {
    let one = Slope::constant(1.0);
    let product = factors.iter().fold(one, |product, factor| product * sum(&[factor], pass));
    product.derivatives.map(|slope| slope / product.value())
}

/// The integral of the derivatives of the sum of `values` over a stretch of temperature, panel by
/// panel of the curve that was found to be smooth on each.
fn integral(
    values: &[Value],
    curve: &Enthalpy,
    (from, to): (f64, f64),
    (slots, stack): (&mut [Slope], &mut Vec<Slope>),
) -> [f64; PASS] {
    let values: Vec<&Value> = values.iter().collect();
    let mut stops = curve.stops(from.min(to), from.max(to));
    stops.insert(0, from.min(to));
    stops.push(from.max(to));
    let mut total = [0.0; PASS];
    for pair in stops.windows(2) {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        for (x, weight) in GAUSS {
            slots[slot::OWN as usize] = Slope::constant(middle + half * x);
            let slope = sum_on(&values, (slots, stack));
            let weight = half * weight * (to - from).signum();
            total.iter_mut().zip(slope.derivatives).for_each(|(sum, d)| *sum += weight * d);
        }
    }
    total
}

impl Tangents {
    /// Writes the change of the capacity of every node in J/K per SI unit of each variable: one block
    /// a variable, one value a node. It is 0 for a capacity over temperature; see
    /// [`Tangents::enthalpy_that_changes`].
    pub fn capacities(&self, network: &Network, out: &mut [f64]) {
        let nodes = network.nodes().len();
        out.fill(0.0);
        for (content, lanes) in self.passes.iter().flat_map(|pass| &pass.reads.contents) {
            let Content { node, change: Change::Constant(slopes), .. } = content else { continue };
            each(lanes, slopes).for_each(|(k, slope)| out[k * nodes + node.index()] = slope);
        }
    }

    /// Writes the changes of the heat content of every node over that at its start in J per SI unit
    /// of each parameter, at these temperatures of all nodes in K: blocks of as many values as
    /// there are nodes.
    pub fn contents(&mut self, network: &Network, temperatures: &[f64], out: &mut [f64]) {
        let nodes = network.nodes().len();
        out.fill(0.0);
        self.each_content(network, temperatures, &mut |node, variable, change| {
            out[variable * nodes + node] = change;
        });
    }

    /// Adds the change of the sum of those heat contents, each times a weight for its node, per SI
    /// unit of each variable.
    pub fn add_contents_against(
        &mut self,
        (network, temperatures): (&Network, &[f64]),
        weights: &[f64],
        out: &mut [f64],
    ) {
        self.each_content(network, temperatures, &mut |node, variable, change| {
            out[variable] += weights[node] * change;
        });
    }

    /// Calls `take` with a node, the position of a variable, and the change of the node's heat
    /// content with it.
    fn each_content(
        &mut self,
        network: &Network,
        temperatures: &[f64],
        take: &mut dyn FnMut(usize, usize, f64),
    ) {
        for Pass { slots, stack, reads, .. } in &mut self.passes {
            for (content, lanes) in &reads.contents {
                let node = content.node.index();
                let change = content.at(network, (slots, stack), temperatures[node]);
                each(lanes, &change).for_each(|(variable, slope)| take(node, variable, slope));
            }
        }
    }
}
