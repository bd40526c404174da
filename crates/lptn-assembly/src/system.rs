//! The sparse system `C dT/dt = q(t, T)` of a network.

use std::sync::Arc;

use lptn_network::{ConductorId, InputError, Network, NodeId};

use crate::bodies::Bodies;
use crate::element::{Element, JacobianForm, Known, slot};
use crate::eliminate::{Elimination, Link, TooMany};
use crate::error::AssemblyError;
use crate::links::{constant_links, sorted};
use crate::outer::Outer;
use crate::pattern::JacobianPattern;
use crate::radiation::Radiation;
use crate::scaled::Scaled;
use crate::together::Together;
use crate::workspace::Workspace;

/// A network as a system of ordinary differential equations in its nodes with capacity, and of
/// balances without storage in its massless nodes that cannot be eliminated.
///
/// The unknowns are the nodes with capacity (the states), then those massless nodes (the algebraic
/// ones), each in the network's order. `flow` and `jacobian` read the same links and elements, and
/// the heat of a link leaves one end and enters the other as one number with two signs. Copies
/// share their memory.
#[derive(Clone, Debug)]
pub struct ThermalSystem {
    pub(crate) network: Network,
    /// Node of each unknown.
    pub(crate) unknowns: Arc<Vec<NodeId>>,
    /// Number of unknowns that are states.
    pub(crate) states: usize,
    /// Capacity of each state in J/K at its start, then zeros.
    pub(crate) mass: Arc<Vec<f64>>,
    /// Constant conductances between unknowns, by their numbers, with their two slots in the
    /// Jacobian.
    pub(crate) links: Arc<Vec<Link>>,
    pub(crate) link_slots: Arc<Vec<[u32; 2]>>,
    /// Those from an unknown (`a`) to a vertex that is a boundary (`b`).
    pub(crate) ties: Arc<Vec<Link>>,
    /// Those between two boundaries, by vertex: they affect the energy balance, but no unknown.
    pub(crate) bridges: Arc<Vec<Link>>,
    pub(crate) radiation: Arc<Vec<Radiation>>,
    /// Everything else.
    pub(crate) elements: Arc<Vec<Element>>,
    /// Bodies whose paths are evaluated together, and the positions of the other elements.
    pub(crate) bodies: Arc<Bodies>,
    pub(crate) outer: Arc<Outer>,
    /// Elements that are evaluated together.
    pub(crate) together: Arc<Together>,
    pub(crate) streams: Arc<Vec<ConductorId>>,
    /// Nodes whose capacity follows states.
    pub(crate) scaled: Arc<Vec<Scaled>>,
    /// True if every element has a symmetric form.
    pub(crate) symmetric: bool,
    pub(crate) elimination: Arc<Elimination>,
    pub(crate) pattern: JacobianPattern,
}

impl ThermalSystem {
    /// Assembles a network: structure, links, elements and pattern, once.
    ///
    /// # Errors
    /// [`AssemblyError`] if a massless node has too many neighbours to be eliminated.
    pub fn assemble(network: &Network) -> Result<Self, AssemblyError> {
        let eliminated = network.linear_massless();
        let (elimination, kept) = Elimination::new(constant_links(network), &eliminated)
            .map_err(|e| too_many(network, &e))?;
        let massless = |id: &NodeId| network.nodes()[id.index()].massless;
        let mut unknowns: Vec<NodeId> = network.node_ids().filter(|id| !massless(id)).collect();
        let states = unknowns.len();
        unknowns.extend(network.node_ids().filter(|id| massless(id) && !eliminated[id.index()]));
        let mut number = vec![u32::MAX; network.nodes().len() + network.boundaries().len()];
        (0..).zip(&unknowns).for_each(|(unknown, id)| number[id.index()] = unknown);
        let (links, ties, bridges) = sorted(kept, &number);
        let mut radiation = Radiation::all_of(network);
        let mut elements = Element::all_of(network);
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(links.len());
        pairs.extend(links.iter().map(|link| (link.a, link.b)));
        pairs.extend(radiation.iter().filter_map(|r| r.pair(&number)));
        elements.iter().for_each(|element| pairs.extend(element.pairs(&number)));
        pairs.extend(Scaled::pairs(network, &number));
        let pattern = JacobianPattern::new(unknowns.len(), pairs);
        radiation.iter_mut().for_each(|r| r.place(&number, &pattern));
        elements.iter_mut().for_each(|element| element.place(&number, &pattern));
        let place = |row, column| slot(&pattern, row, column);
        let link_slots = links.iter().map(|l| [place(l.a, l.b), place(l.b, l.a)]).collect();
        let scaled = Scaled::all_of(network, &number, &pattern);
        let even = |element: &Element| element.is_symmetric(network);
        let symmetric = scaled.is_empty() && elements.iter().all(even);
        let mass = unknowns.iter().map(|&id| network.capacity(id)).collect();
        let stream = |id: &ConductorId| network.conductors()[id.index()].law.is_stream();
        let streams = network.conductor_ids().filter(stream).collect();
        let outer = Outer::of(network.nodes().len(), &radiation, &elements);
        let bodies = Bodies::of(network, &elements, 0..elements.len());
        let together = Together::of(network, (&elements, &outer), bodies.others());
        Ok(Self {
            network: network.clone(),
            unknowns: Arc::new(unknowns),
            states,
            mass: Arc::new(mass),
            links: Arc::new(links),
            link_slots: Arc::new(link_slots),
            ties: Arc::new(ties),
            bridges: Arc::new(bridges),
            outer: Arc::new(outer),
            together: Arc::new(together),
            radiation: Arc::new(radiation),
            bodies: Arc::new(bodies),
            elements: Arc::new(elements),
            streams: Arc::new(streams),
            scaled: Arc::new(scaled),
            symmetric,
            elimination: Arc::new(elimination),
            pattern,
        })
    }

    /// The network it was assembled from.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// The node of each state.
    pub fn states(&self) -> &[NodeId] {
        &self.unknowns[..self.states]
    }

    /// The node of each algebraic unknown.
    pub fn algebraic(&self) -> &[NodeId] {
        &self.unknowns[self.states..]
    }

    /// The node of each unknown: states, then algebraic ones.
    pub fn unknowns(&self) -> &[NodeId] {
        &self.unknowns
    }

    /// Heat capacity of each state at its start in J/K.
    pub fn capacity(&self) -> &[f64] {
        &self.mass[..self.states]
    }

    /// Heat capacity of each unknown at its start in J/K: zero for the algebraic ones.
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Temperature of each state at the start in K.
    pub fn initial(&self) -> Vec<f64> {
        self.states().iter().map(|&id| self.network.initial(id)).collect()
    }

    /// True if the flow is linear in the unknowns with constant coefficients, and symmetric.
    pub fn is_linear(&self) -> bool {
        self.elements.is_empty() && self.radiation.is_empty() && self.scaled.is_empty()
    }

    /// True if the temperatures rise in proportion to the heat: constant streams may be among the
    /// paths, which only make it lack symmetry.
    pub fn is_proportional(&self) -> bool {
        self.radiation.is_empty()
            && self.scaled.is_empty()
            && self.elements.iter().all(Element::is_constant_stream)
    }

    /// True if the Jacobian has a symmetric form that Newton's method may use.
    pub fn is_symmetric(&self) -> bool {
        self.symmetric
    }

    /// The pattern of [`ThermalSystem::jacobian`].
    pub fn pattern(&self) -> &JacobianPattern {
        &self.pattern
    }

    pub(crate) fn elimination(&self) -> &Elimination {
        &self.elimination
    }

    /// A workspace for this system.
    pub fn workspace(&self) -> Workspace {
        Workspace::new(&self.network)
    }

    /// Reads the inputs at `time` \[s\], comparisons of `t` as they are at `segment` \[s\].
    ///
    /// # Errors
    /// [`InputError`] naming the source or boundary whose value cannot be evaluated.
    pub fn read_inputs(
        &self,
        work: &mut Workspace,
        time: f64,
        segment: f64,
    ) -> Result<(), InputError> {
        if !work.read(&self.network, time, segment)? {
            return Ok(());
        }
        work.heat.fill(0.0);
        for ((source, power), id) in
            self.network.sources().iter().zip(&work.power).zip(self.network.source_ids())
        {
            if self.network.source_variables(id).is_empty() {
                source
                    .into
                    .iter()
                    .for_each(|(node, share)| work.heat[node.index()] += share * power);
            }
        }
        self.elimination.distribute(&mut work.heat);
        Ok(())
    }

    /// Reads the inputs exactly, even if they are taken for straight lines
    /// ([`Workspace::draw_line`]). They are valid until the next read.
    ///
    /// # Errors
    /// As [`ThermalSystem::read_inputs`].
    pub fn read_exactly(
        &self,
        work: &mut Workspace,
        time: f64,
        segment: f64,
    ) -> Result<(), InputError> {
        work.off_line(|work| self.read_inputs(work, time, segment))
    }

    /// Takes these heats into the nodes in W and these temperatures of the boundaries in K instead
    /// of the network's own inputs, until those are read again: for the response to a heat that no
    /// source puts in.
    pub fn apply(&self, work: &mut Workspace, heat: &[f64], boundaries: &[f64]) {
        work.forget();
        work.heat.fill(0.0);
        work.heat[..heat.len()].copy_from_slice(heat);
        self.elimination.distribute(&mut work.heat);
        work.temperature[self.network.nodes().len()..].copy_from_slice(boundaries);
    }

    /// Writes the heat flow into each unknown in W, from the inputs last read and the temperatures
    /// `y` of the unknowns in K. That of a node whose capacity follows states is the one that would
    /// change a node with the capacity of the start as fast.
    ///
    /// # Errors
    /// [`InputError`] naming the element whose heat cannot be evaluated; never for a linear system.
    pub fn flow(
        &self,
        work: &mut Workspace,
        y: &[f64],
        flow: &mut [f64],
    ) -> Result<(), InputError> {
        self.heat_flow(work, y, flow)?;
        self.scaled.iter().try_for_each(|one| one.scale_flow(&self.network, work, flow))
    }

    /// The heat flow into each unknown in W.
    pub(crate) fn heat_flow(
        &self,
        work: &mut Workspace,
        y: &[f64],
        flow: &mut [f64],
    ) -> Result<(), InputError> {
        self.linear_flow(work, y, flow);
        if !self.is_linear() {
            self.evaluate_elements(work, y)?;
            flow.iter_mut()
                .zip(self.unknowns.iter())
                .for_each(|(q, id)| *q += work.element_heat[id.index()]);
        }
        Ok(())
    }

    /// The part of [`ThermalSystem::flow`] that inputs and constant conductances make up: all of it
    /// for a linear system.
    pub fn linear_flow(&self, work: &Workspace, y: &[f64], flow: &mut [f64]) {
        for (q, id) in flow.iter_mut().zip(self.unknowns.iter()) {
            *q = work.heat[id.index()];
        }
        self.links.iter().for_each(|link| link.add_heat(y, flow));
        for tie in self.ties.iter() {
            flow[tie.a as usize] += tie.g * (work.temperature[tie.b as usize] - y[tie.a as usize]);
        }
    }

    pub(crate) fn evaluate_elements(
        &self,
        work: &mut Workspace,
        y: &[f64],
    ) -> Result<(), InputError> {
        self.put(work, y);
        work.element_heat.fill(0.0);
        self.radiation.iter().for_each(|r| r.add_heat(&work.temperature, &mut work.element_heat));
        self.bodies.add_heat((&self.network, &self.elements), work)?;
        self.together.evaluate(work, self.elements.len(), false);
        self.bodies.others().try_for_each(|i| self.add_known(work, i))
    }

    /// Takes the temperatures of the unknowns.
    pub(crate) fn put(&self, work: &mut Workspace, y: &[f64]) {
        y.iter().zip(self.unknowns.iter()).for_each(|(t, id)| work.temperature[id.index()] = *t);
    }

    /// Writes the derivative of [`ThermalSystem::flow`] by the unknowns in W/K into the slots of
    /// the pattern.
    ///
    /// It is constant and symmetric for a linear system; otherwise symmetric if that form is
    /// requested.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn jacobian_at(
        &self,
        work: &mut Workspace,
        y: &[f64],
        form: JacobianForm,
        values: &mut [f64],
    ) -> Result<(), InputError> {
        self.jacobian_with((work, y), form, &|_| None, values)
    }

    /// The same with those derivatives of conductors that are `known`.
    pub(crate) fn jacobian_with(
        &self,
        (work, y): (&mut Workspace, &[f64]),
        form: JacobianForm,
        known: &Known<'_>,
        values: &mut [f64],
    ) -> Result<(), InputError> {
        self.jacobian(values);
        if !self.is_linear() {
            self.put(work, y);
            self.radiation.iter().for_each(|r| r.add_slopes(&work.temperature, form, values));
            self.bodies.add_slopes((&self.network, &self.elements), work, (form, values))?;
            for i in self.bodies.others() {
                self.elements[i].add_slopes_with((&self.network, work), form, known, values)?;
            }
        }
        if self.scaled.is_empty() {
            return Ok(());
        }
        let mut flow = vec![0.0; self.unknowns.len()];
        self.heat_flow(work, y, &mut flow)?;
        let slopes = |one: &Scaled| one.scale_slopes(&self.network, work, (&flow, &mut *values));
        self.scaled.iter().try_for_each(slopes)
    }

    /// The part of the Jacobian that constant conductances make up, in W/K: all of it for a linear
    /// system.
    pub fn jacobian(&self, values: &mut [f64]) {
        values.fill(0.0);
        (0..self.links.len()).for_each(|i| self.add_link_slopes(i, values));
        for tie in self.ties.iter() {
            values[self.pattern.diagonal_slot(tie.a as usize)] -= tie.g;
        }
    }

    /// Adds the derivatives of one link in W/K.
    pub(crate) fn add_link_slopes(&self, position: usize, values: &mut [f64]) {
        let (link, slots) = (self.links[position], self.link_slots[position]);
        slots.iter().for_each(|&slot| values[slot as usize] += link.g);
        values[self.pattern.diagonal_slot(link.a as usize)] -= link.g;
        values[self.pattern.diagonal_slot(link.b as usize)] -= link.g;
    }

    /// Fills the temperatures of all nodes from those of the unknowns, eliminated nodes recovered
    /// exactly.
    pub fn recover(&self, work: &mut Workspace, y: &[f64]) {
        self.put(work, y);
        if !self.elimination.is_empty() {
            self.elimination.recover(&work.heat, &mut work.temperature);
        }
    }

    /// Takes the temperatures of all nodes in K as they were recovered before.
    pub fn place(&self, work: &mut Workspace, nodes: &[f64]) {
        work.temperature[..nodes.len()].copy_from_slice(nodes);
    }

    /// Temperatures of all nodes in K, as last recovered.
    pub fn node_temperatures<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.temperature[..self.network.nodes().len()]
    }

    /// Temperatures of all boundaries in K, as last read.
    pub fn boundary_temperatures<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.temperature[self.network.nodes().len()..]
    }

    /// Heat of all sources in W, as last read.
    pub fn source_powers<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.power
    }

    /// The sum of all conductances that lead to a boundary, after the elimination, in W/K.
    pub fn boundary_conductance(&self) -> f64 {
        self.ties.iter().chain(self.bridges.iter()).map(|link| link.g).sum()
    }

    /// Temperatures of the unknowns in K among those of all nodes.
    pub fn unknown_temperatures(&self, nodes: &[f64], y: &mut [f64]) {
        y.iter_mut().zip(self.unknowns.iter()).for_each(|(t, id)| *t = nodes[id.index()]);
    }
}

fn too_many(network: &Network, error: &TooMany) -> AssemblyError {
    let ids: Vec<NodeId> = network.node_ids().collect();
    let node = ids[error.vertex as usize];
    let name = network.nodes()[node.index()].name.clone();
    AssemblyError::TooManyNeighbours { node, name, neighbours: error.neighbours }
}
