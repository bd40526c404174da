//! Streams and the nodes they pass.

use crate::id::{ConductorId, End, Item, NodeId};
use crate::input_error::InputError;
use crate::law::{At, ConductorFlow};
use crate::network::Network;
use crate::network::flow::place;
use crate::parts::state_capacity::StateCapacity;

/// Temperature at which capacity rates are compared, in K.
const REFERENCE: f64 = 298.15;

/// Difference of the ends at which a capacity rate is found, in K: below it a fluid is constant.
const STEP: f64 = 0.01;

/// The share of a capacity rate by which the specific heat of a fluid may vary between the streams
/// into a node.
const FLUID_VARIES: f64 = 0.1;

/// Total capacity rates in W/K of the streams into a node and out of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passing {
    /// The node that the streams pass.
    pub node: NodeId,
    /// The rate that flows in.
    pub inflow: f64,
    /// The rate that flows out.
    pub outflow: f64,
    /// The rate by which the capacity of the node grows.
    pub growth: f64,
}

impl Passing {
    /// True if inflow and outflow are equal except for rounding, or the node grows by their
    /// difference.
    pub fn is_balanced(&self) -> bool {
        (self.inflow - self.outflow - self.growth).abs() <= 1e-6 * self.inflow.max(self.outflow)
    }
}

/// A path whose `from` is the outlet of a stream, and the capacity rate that flows in there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlet {
    /// The path.
    pub path: ConductorId,
    /// Capacity rate of its stream in W/K.
    pub rate: f64,
    /// Capacity rate of the streams into `from`; 0 for a boundary, which keeps its temperature.
    pub inflow: f64,
}

impl Outlet {
    /// True if they are one stream, whose specific heat may differ somewhat between temperatures.
    pub fn is_one_stream(&self) -> bool {
        (self.rate - self.inflow).abs() <= FLUID_VARIES * self.rate.max(self.inflow)
    }
}

impl Network {
    /// The paths whose `from` is the outlet of a stream, as [`Network::passing_streams`].
    ///
    /// # Errors
    /// [`InputError`] if a flow has no value.
    pub fn outlets(&self, time: f64) -> Result<Vec<Outlet>, InputError> {
        let found = self.conductor_ids().zip(self.conductors()).filter_map(|(path, conductor)| {
            let formula = conductor.law.formula();
            Some((path, conductor, formula.position(formula.outlet()?)?))
        });
        let found: Vec<_> = found.collect();
        if found.is_empty() {
            return Ok(Vec::new()); // streams of large networks take time to look at
        }
        let passing = self.passing_streams(time)?;
        let mut scope = self.evaluation();
        scope.set_time(time, time);
        let mut outlets = Vec::new();
        for (path, conductor, position) in found {
            let rate = {
                let (slots, stack) = scope.plain();
                place(slots, &self.parts.dependence(path), &|_| REFERENCE);
                At::new((slots, stack)).get(&conductor.law, position)
            };
            let rate = rate.map_err(|failed| self.failed(Item::Conductor(path), failed, &scope))?;
            let at = passing.iter().find(|passing| End::Node(passing.node) == conductor.from);
            outlets.push(Outlet { path, rate, inflow: at.map_or(0.0, |passing| passing.inflow) });
        }
        Ok(outlets)
    }

    /// The streams that pass each node, at `time` in s and with everything at 25 degC, so that one
    /// flow of one fluid has one capacity rate. Nodes that flows of a flow network pass are left
    /// out: their pressures are not known yet, see [`Network::unbalanced_flows`].
    ///
    /// # Errors
    /// [`InputError`] if a flow has no value.
    pub fn passing_streams(&self, time: f64) -> Result<Vec<Passing>, InputError> {
        let mut temperatures = vec![REFERENCE; self.nodes().len() + self.boundaries().len()];
        for state in self.states().iter().filter(|state| !state.balanced) {
            temperatures[state.node.index()] = self.initial(state.node);
        }
        let mut scope = self.evaluation();
        scope.set_time(time, time);
        let mut passing = self.passing(&mut scope, &temperatures)?;
        let solved = self.nodes_of_flows();
        passing.retain(|p| !solved.contains(&p.node));
        Ok(passing)
    }

    /// The nodes that flows of a flow network pass, and whose inflow and outflow differ by more than
    /// a tenth: more than the specific heat of one fluid usually varies. `temperatures` are those of
    /// all nodes and boundaries in K, with the pressures; `scope` has the time and the controls.
    ///
    /// # Errors
    /// [`InputError`] if a flow has no value.
    pub fn unbalanced_flows(
        &self,
        scope: &mut crate::Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<Passing>, InputError> {
        let solved = self.nodes_of_flows();
        if solved.is_empty() {
            return Ok(Vec::new());
        }
        let mut passing = self.passing(scope, temperatures)?;
        let differ = |p: &Passing| {
            (p.inflow - p.outflow - p.growth).abs() > FLUID_VARIES * p.inflow.max(p.outflow)
        };
        passing.retain(|p| solved.contains(&p.node) && differ(p));
        Ok(passing)
    }

    /// True if pressures of a flow network are among the unknowns.
    pub fn has_flows(&self) -> bool {
        self.states().iter().any(|state| state.balanced)
    }

    /// The nodes at the ends of streams that read a pressure.
    fn nodes_of_flows(&self) -> Vec<NodeId> {
        if !self.has_flows() {
            return Vec::new(); // streams of large networks take time to look at
        }
        let balanced = self.states().iter().filter(|state| state.balanced);
        let pressures: Vec<usize> = balanced.map(|state| state.node.index()).collect();
        let reads = |id: &ConductorId| {
            let variables = self.conductor_variables(*id);
            variables.iter().any(|&vertex| pressures.contains(&(vertex as usize)))
        };
        let streams = self.conductor_ids().zip(self.conductors());
        let streams = streams.filter(|(id, of)| of.law.is_stream() && reads(id));
        let ends = streams.flat_map(|(_, of)| [of.from, of.to]);
        ends.filter_map(|end| if let End::Node(node) = end { Some(node) } else { None }).collect()
    }

    /// The streams that pass each node, at these temperatures of all nodes and boundaries in K.
    fn passing(
        &self,
        scope: &mut crate::Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<Passing>, InputError> {
        let none = |node| Passing { node, inflow: 0.0, outflow: 0.0, growth: 0.0 };
        let mut passing: Vec<Passing> = self.node_ids().map(none).collect();
        for of in self.state_capacities() {
            passing[of.node.index()].growth = self.growth(of, scope, temperatures)?;
        }
        for (id, conductor) in self.conductor_ids().zip(self.conductors()) {
            if !conductor.law.is_stream() {
                continue;
            }
            let rate = self.rate(id, scope, temperatures)?;
            let (up, down) = match rate < 0.0 {
                true => (conductor.to, conductor.from),
                false => (conductor.from, conductor.to),
            };
            if let End::Node(node) = up {
                passing[node.index()].outflow += rate.abs();
            }
            if let End::Node(node) = down {
                passing[node.index()].inflow += rate.abs();
            }
        }
        passing.retain(|p| p.inflow + p.outflow > 0.0);
        Ok(passing)
    }

    /// Growth of a capacity that follows states, in W/K.
    fn growth(
        &self,
        of: &StateCapacity,
        scope: &mut crate::Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        let mut slopes = Vec::new();
        self.capacity_slopes(of, scope, temperatures, &mut slopes)?;
        let mut growth = 0.0;
        for (node, slope) in of.states.iter().zip(slopes) {
            let source = self.state_at(*node).and_then(|state| state.source);
            let Some(source) = source else { continue };
            growth += slope * self.source_heat(source, scope, temperatures)?;
        }
        Ok(growth)
    }

    /// Capacity rate of a stream in W/K, positive from `from` to `to`: its heat per K between the
    /// ends. Its flow stays that of these temperatures, which it may depend on.
    fn rate(
        &self,
        id: ConductorId,
        scope: &mut crate::Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        if let ConductorFlow::Stream(rate) = self.flow(id) {
            return Ok(rate);
        }
        let (conductor, along) = (&self.conductors()[id.index()], self.along(id));
        let dependence = self.parts.dependence(id);
        let at = |k: usize| temperatures[dependence.vertices[k] as usize];
        let received = {
            let (slots, stack) = scope.plain();
            place(slots, &dependence, &at);
            self.received(conductor, At::path((slots, stack), along), at(0) + STEP, at(0))
        };
        let [from, to] =
            received.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))?;
        Ok((from + to) / STEP)
    }
}
