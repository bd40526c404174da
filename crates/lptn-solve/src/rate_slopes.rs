//! Derivatives of the rates of the states: the Jacobian, directional and adjoint derivatives.
//!
//! The rates are `dy/dt = q(T(y), p) / C0`, with the state `y` in K and its slope `dT/dy`, which is 1
//! for a constant capacity. Their derivative by states is `J_ij = (dq_i/dT_j) (dT/dy)_j / C0_i` in
//! 1/s. That by an input `p` at constant states is `(dq_i/dp - (q_i / C0_i) dC0_i/dp) / C0_i`. The
//! derivatives of the heats are the exact Jacobian of the assembly and the tangents of the network.
//!
//! A simulator that integrates the states needs the Jacobian of the states alone, so massless nodes
//! are eliminated. Assembly eliminates those with constant conductances, `algebraic.rs` the others.

use lptn_assembly::ThermalSystem;
use lptn_network::{NoTangents, NodeId, Variable};

use crate::algebraic::{Algebraic, Column};
use crate::newton_error::NewtonError;
use crate::rates::{Rates, StateRates, input};
use crate::unsolved::Unsolved;

lptn_units::errors! {
/// Why rates have no derivatives.
#[derive(Clone, Debug)]
pub enum RateSlopesError {
    /// The rates have no value.
    Unsolved => Unsolved;
    /// The melting of a node, or the specific heat of a fluid, depends on a parameter.
    Tangents => NoTangents;
    /// A parameter changes the enthalpy of this node, whose state it is.
    Melts { node: String } = "simulation::melts",
        format!("the enthalpy of `{node}` is its state, and a parameter would change it"),
        help "leave the parameter out of the direction";
}
}

lptn_units::errors! {
/// Why there is no derivative along a direction, or against one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionError {
    /// The number of its values is not that of the states, inputs or nodes.
    Length { of: DirectionPart, given: usize, needed: usize } = "simulation::direction",
        format!("a direction of {needed} {} has {given} numbers", of.word()),
        help "take the order of the Jacobian for states, that of the network for nodes";
    /// One of its values is not finite.
    NotFinite { of: DirectionPart, position: usize } = "simulation::direction",
        format!("number {position} of the {} of a direction is not finite", of.word());
}
}

/// A part of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectionPart {
    /// One number for each state.
    States,
    /// One for each parameter or signal.
    Inputs,
    /// One for each node.
    Nodes,
}

impl DirectionPart {
    fn word(self) -> &'static str {
        match self {
            Self::States => "states",
            Self::Inputs => "inputs",
            Self::Nodes => "nodes",
        }
    }
}

/// A direction in the states and inputs of a network, or derivatives by them.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// One number for each state; in K if it is a direction.
    pub states: Vec<f64>,
    /// One for each parameter or signal, in the order in which they were asked for; in their SI units
    /// if it is a direction.
    pub inputs: Vec<f64>,
}

/// The derivatives of the rates by the states, in 1/s: entries of a sparse matrix, column by column,
/// the rows of each ascending. Missing entries are 0 at every state. Massless nodes are eliminated,
/// so that rows and columns are the states of [`crate::StateRates`].
#[derive(Clone, Debug, PartialEq)]
pub struct RateJacobian {
    /// The node of each state, of rows and of columns.
    pub states: Vec<NodeId>,
    /// The position of the state of which each entry differentiates the rate.
    pub rows: Vec<usize>,
    /// The position of the state by which each entry differentiates.
    pub columns: Vec<usize>,
    /// The derivatives in 1/s.
    pub values: Vec<f64>,
}

/// The derivatives by one input at constant states.
#[derive(Clone, Debug)]
struct Block {
    /// Derivative of the rate of each state in K/s per SI unit.
    rates: Vec<f64>,
    /// Derivative of the temperature of each node in K per SI unit; 0 for those with capacity.
    nodes: Vec<f64>,
}

/// The derivatives of [`Rates`] at one time and state, with the positions of controls and comparisons
/// there. It owns its numbers and is `Send`.
#[derive(Clone, Debug)]
pub struct RateSlopes {
    system: ThermalSystem,
    jacobian: RateJacobian,
    /// `dT/dy` of each state in K/K.
    slopes: Vec<f64>,
    /// The response of massless nodes that are solved for to the temperature of each state.
    follow: Vec<Column>,
    inputs: Vec<Block>,
}

impl StateRates<'_> {
    /// The derivatives of [`StateRates::at`] by the states and by these parameters and signals, none
    /// of which occurs twice. A signal counts as a constant with its present value. A parameter
    /// changes no state, even if it is a capacity or a temperature at the start.
    ///
    /// # Errors
    /// [`RateSlopesError`]
    pub fn slopes(
        &mut self,
        (time, states): (f64, &[f64]),
        variables: &[Variable],
    ) -> Result<RateSlopes, RateSlopesError> {
        self.place(time, states)?;
        let system = self.system;
        let unsolved = |error| Unsolved::new(system, error);
        let slopes = self.unfold.slopes()[..system.states().len()].to_vec();
        let algebraic = Algebraic::at(system, &mut self.work, self.unfold.last());
        let mut algebraic = algebraic.map_err(unsolved)?;
        let follow = algebraic.follow().map_err(unsolved)?;
        let mut jacobian = RateJacobian {
            states: system.states().to_vec(),
            rows: vec![],
            columns: vec![],
            values: vec![],
        };
        for (column, entries) in algebraic.reduced(&follow).into_iter().enumerate() {
            for (row, value) in entries {
                jacobian.rows.push(row);
                jacobian.columns.push(column);
                jacobian.values.push(value * slopes[column] / system.capacity()[row]);
            }
        }
        let inputs = self.inputs(variables, &mut algebraic)?;
        Ok(RateSlopes { system: system.clone(), jacobian, slopes, follow, inputs })
    }

    fn inputs(
        &mut self,
        variables: &[Variable],
        algebraic: &mut Algebraic<'_>,
    ) -> Result<Vec<Block>, RateSlopesError> {
        let network = self.system.network();
        let mut tangents = network.tangents_at_a_moment(variables)?;
        if let Some(id) = tangents.enthalpy_that_changes(network) {
            let node = network.nodes()[id.index()].name.clone();
            return Err(RateSlopesError::Melts { node });
        }
        let flow = self.flow()?;
        let (nodes, vertices) =
            (network.nodes().len(), network.nodes().len() + network.boundaries().len());
        let mut heat = vec![0.0; vertices * variables.len()];
        self.system.tangent_heat(&mut tangents, &self.work, &mut heat).map_err(input)?;
        let mut capacities = vec![0.0; nodes * variables.len()];
        tangents.capacities(network, &mut capacities);
        let changes = heat.chunks(vertices.max(1)).zip(capacities.chunks(nodes.max(1)));
        let blocks = changes.map(|changes| Block::new(self.system, (changes, &flow), algebraic));
        let blocks = blocks.collect::<Result<_, NewtonError>>();
        blocks.map_err(|error| Unsolved::new(self.system, error).into())
    }
}

impl Block {
    /// From the changes at constant temperatures of the heat into every vertex in W and of the
    /// capacity of every node in J/K, and from the heat into each state in W.
    fn new(
        system: &ThermalSystem,
        ((heat, capacities), flow): ((&[f64], &[f64]), &[f64]),
        algebraic: &mut Algebraic<'_>,
    ) -> Result<Self, NewtonError> {
        let (unknowns, received) = algebraic.respond(heat)?;
        let states = system.states().iter().zip(system.capacity());
        let rates =
            states.zip(received.iter().zip(flow)).map(|((id, capacity), (change, flow))| {
                (change - flow / capacity * capacities[id.index()]) / capacity
            });
        let rates = rates.collect();
        let mut nodes = vec![0.0; heat.len()];
        system.recover_tangent(heat, &unknowns, &mut nodes);
        nodes.truncate(capacities.len());
        Ok(Self { rates, nodes })
    }
}

impl RateSlopes {
    /// The derivatives of the rates by the states.
    pub fn jacobian(&self) -> &RateJacobian {
        &self.jacobian
    }

    /// The change of rates in K/s and of the temperatures of all nodes in K along a direction in
    /// states and inputs, per unit of the direction (fmi3GetDirectionalDerivative of FMI 3.0).
    ///
    /// With the rates themselves as the direction, the changes of temperatures are `dT/dt` of all
    /// nodes in K/s while inputs are constant.
    ///
    /// # Errors
    /// [`DirectionError`]
    pub fn along(&self, direction: &Direction) -> Result<Rates, DirectionError> {
        check(DirectionPart::States, &direction.states, self.slopes.len())?;
        check(DirectionPart::Inputs, &direction.inputs, self.inputs.len())?;
        let mut rates = vec![0.0; self.slopes.len()];
        for (value, row, column) in self.jacobian.entries() {
            rates[row] += value * direction.states[column];
        }
        let network = self.system.network();
        let vertices = network.nodes().len() + network.boundaries().len();
        let (mut unknowns, mut nodes) =
            (vec![0.0; self.system.unknowns().len()], vec![0.0; vertices]);
        for (state, moved) in direction.states.iter().enumerate() {
            let warmed = self.slopes[state] * moved;
            unknowns[state] = warmed;
            for (node, share) in &self.follow[state] {
                unknowns[self.slopes.len() + node] += share * warmed;
            }
        }
        self.system.recover_tangent(&vec![0.0; vertices], &unknowns, &mut nodes);
        nodes.truncate(network.nodes().len());
        for (block, by) in self.inputs.iter().zip(&direction.inputs) {
            add(&mut rates, (&block.rates, *by));
            add(&mut nodes, (&block.nodes, *by));
        }
        Ok(Rates { states: rates, nodes })
    }

    /// The derivatives, by each state and each input, of a sum of rates and temperatures of nodes with
    /// these weights. It is the transpose of [`RateSlopes::along`] (fmi3GetAdjointDerivative of FMI
    /// 3.0).
    ///
    /// # Errors
    /// [`DirectionError`]
    pub fn against(&self, weights: &Rates) -> Result<Direction, DirectionError> {
        let network = self.system.network();
        check(DirectionPart::States, &weights.states, self.slopes.len())?;
        check(DirectionPart::Nodes, &weights.nodes, network.nodes().len())?;
        let mut handed = weights.nodes.clone();
        handed.resize(network.nodes().len() + network.boundaries().len(), 0.0);
        self.system.hand_on(&mut handed);
        let unknowns: Vec<f64> =
            self.system.unknowns().iter().map(|id| handed[id.index()]).collect();
        let mut states = vec![0.0; self.slopes.len()];
        for (state, sum) in states.iter_mut().enumerate() {
            let followed = self.follow[state].iter();
            let followed = followed.map(|(node, share)| share * unknowns[self.slopes.len() + node]);
            *sum = self.slopes[state] * (unknowns[state] + followed.sum::<f64>());
        }
        for (value, row, column) in self.jacobian.entries() {
            states[column] += value * weights.states[row];
        }
        let of = |block: &Block| {
            product(&block.rates, &weights.states) + product(&block.nodes, &weights.nodes)
        };
        Ok(Direction { states, inputs: self.inputs.iter().map(of).collect() })
    }
}

impl RateJacobian {
    /// Value in 1/s, row and column of each entry.
    pub fn entries(&self) -> impl Iterator<Item = (f64, usize, usize)> {
        let places = self.rows.iter().zip(&self.columns);
        self.values.iter().zip(places).map(|(value, (row, column))| (*value, *row, *column))
    }
}

fn check(of: DirectionPart, given: &[f64], needed: usize) -> Result<(), DirectionError> {
    if given.len() != needed {
        return Err(DirectionError::Length { of, given: given.len(), needed });
    }
    match given.iter().position(|number| !number.is_finite()) {
        Some(position) => Err(DirectionError::NotFinite { of, position }),
        None => Ok(()),
    }
}

fn add(sum: &mut [f64], (values, by): (&[f64], f64)) {
    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += by * value);
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
