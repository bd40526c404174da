//! The heats and heat contents that change with each variable, and the variables of each pass.
//!
//! Variables that change nothing in common share a place of the dual numbers (A. R. Curtis, M. J. D.
//! Powell and J. K. Reid, IMA J. Appl. Math. 13 (1974) 117): a thousand conductances are one pass.

use std::collections::{BTreeMap, BTreeSet};

use super::Variable;
use crate::End;
use crate::evaluation::PASS;
use crate::id::{BoundaryId, ConductorId, GridId, NodeId, ParameterId, SignalId, SourceId};
use crate::network::Network;
use crate::parts::shape::Shape;
use crate::parts::signal::Course;
use crate::value::{Lump, Value};

/// For each place of a dual number the position of the variable there, or [`NONE`].
pub(super) type Lanes = [u32; PASS];

/// A place without a variable.
const NONE: u32 = u32::MAX;

/// Something that may change with a variable at fixed temperatures of the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Read {
    Conductor(ConductorId),
    Source(SourceId),
    Boundary(BoundaryId),
    /// A signal that is an expression.
    Signal(SignalId),
    /// The heat content of a node.
    Content(NodeId),
    Grid(GridId),
}

/// A variable of a pass, and its place in the dual numbers.
pub(super) type Place = (Variable, usize);

/// The variables of each pass, and all that changes with them.
pub(super) fn passes(
    network: &Network,
    variables: &[Variable],
    given: &[bool],
) -> Vec<(Vec<Place>, BTreeMap<Read, Lanes>)> {
    if variables.is_empty() {
        return Vec::new();
    }
    let readers = Readers::new(network);
    let mut occupied: Vec<BTreeSet<Read>> = Vec::new();
    let mut passes: Vec<(Vec<Place>, BTreeMap<Read, Lanes>)> = Vec::new();
    for (position, variable) in variables.iter().enumerate() {
        let reads = readers.of(network, *variable, (variables, given));
        let free = |taken: &BTreeSet<Read>| reads.iter().all(|read| !taken.contains(read));
        let colour = occupied.iter().position(free).unwrap_or(occupied.len());
        if colour == occupied.len() {
            occupied.push(BTreeSet::new());
        }
        if colour / PASS == passes.len() {
            passes.push((Vec::new(), BTreeMap::new()));
        }
        occupied[colour].extend(&reads);
        let (places, lanes) = &mut passes[colour / PASS];
        places.push((*variable, colour % PASS));
        for read in reads {
            let number = u32::try_from(position).unwrap_or(NONE);
            lanes.entry(read).or_insert([NONE; PASS])[colour % PASS] = number;
        }
    }
    passes
}

/// The variable of each place of a dual number, and its derivative.
pub(super) fn each(lanes: &Lanes, slopes: &[f64; PASS]) -> impl Iterator<Item = (usize, f64)> {
    let all = lanes.iter().zip(slopes).filter(|(lane, _)| **lane != NONE);
    all.map(|(lane, slope)| (*lane as usize, *slope))
}

/// The places of a dual number without a variable.
pub(super) fn free(lanes: &Lanes) -> impl Iterator<Item = usize> + '_ {
    (0..PASS).filter(|place| lanes[*place] == NONE)
}

/// A follower of a slot.
#[derive(Clone, Copy)]
enum Reader {
    /// A parameter that is an expression.
    Parameter(ParameterId),
    Read(Read),
}

/// For each slot its followers.
struct Readers(Vec<Vec<Reader>>);

impl Readers {
    fn new(network: &Network) -> Self {
        let mut readers = Self(vec![Vec::new(); network.parts.layout.len()]);
        for (id, parameter) in network.parameter_ids().zip(network.parameters()) {
            readers.add(Reader::Parameter(id), &parameter.value);
        }
        for (id, signal) in network.signal_ids().zip(network.signals()) {
            if let Course::Expression(value) = &signal.course {
                readers.add(Reader::Read(Read::Signal(id)), value);
            }
        }
        for (id, boundary) in network.boundary_ids().zip(network.boundaries()) {
            readers.add(Reader::Read(Read::Boundary(id)), &boundary.temperature);
        }
        for (id, source) in network.source_ids().zip(network.sources()) {
            let read = Reader::Read(Read::Source(id));
            source.law.values().iter().for_each(|value| readers.add(read, value));
        }
        readers.add_conductors(network);
        readers.add_contents(network);
        readers.add_grids(network);
        readers
    }

    fn add_conductors(&mut self, network: &Network) {
        for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
            let read = Reader::Read(Read::Conductor(id));
            let fluid = conductor.law.fluid().map(|id| &network.fluids()[id.index()]);
            let properties =
                fluid.into_iter().flat_map(|fluid| fluid.density.iter().chain([&fluid.cp]));
            if !conductor.law.is_number() {
                conductor.law.values().iter().for_each(|value| self.add(read, value));
            }
            properties.for_each(|value| self.add(read, value));
            for end in [conductor.from, conductor.to] {
                if let End::Boundary(_) = end {
                    self.0[network.parts.layout.temperature(end) as usize].push(read);
                }
            }
        }
    }

    fn add_contents(&mut self, network: &Network) {
        for (id, node) in network.node_ids().zip(network.nodes()) {
            let read = Reader::Read(Read::Content(id));
            let initial = node.initial.as_ref().filter(|_| !node.massless);
            initial.into_iter().chain(&node.capacity).for_each(|value| self.add(read, value));
            node.lump.iter().for_each(|lump| self.add_melting(network, read, lump));
        }
        for part in network.capacitors() {
            let read = Reader::Read(Read::Content(part.node));
            self.add(read, &part.capacity);
            part.lump.iter().for_each(|lump| self.add_melting(network, read, lump));
        }
    }

    fn add_melting(&mut self, network: &Network, read: Reader, lump: &Lump) {
        let material = &network.materials()[lump.material.index()];
        if let Some(of) = &material.melting {
            let values = [&of.solidus, &of.liquidus, &of.heat, lump.size.field().1];
            let all = values.into_iter().chain(material.density.as_ref());
            all.for_each(|value| self.add(read, value));
        }
    }

    fn add_grids(&mut self, network: &Network) {
        for (id, grid) in network.grid_ids().zip(network.grids()) {
            if let Shape::Cylinder { r_in: Some(r_in), r_out, .. } = &grid.shape {
                let read = Reader::Read(Read::Grid(id));
                [r_in, r_out].into_iter().for_each(|radius| self.add(read, radius));
            }
        }
    }

    fn add(&mut self, reader: Reader, value: &Value) {
        value.slots().into_iter().for_each(|slot| self.0[slot as usize].push(reader));
    }

    /// All that changes with a variable. A parameter that is given, or a variable itself, does not follow
    /// from others.
    fn of(
        &self,
        network: &Network,
        variable: Variable,
        (all, given): (&[Variable], &[bool]),
    ) -> BTreeSet<Read> {
        let layout = &network.parts.layout;
        let mut slots = vec![match variable {
            Variable::Parameter(id) => layout.parameter(id),
            Variable::Signal(id) => layout.signal(id),
        }];
        let (mut seen, mut reads) = (BTreeSet::new(), BTreeSet::new());
        while let Some(slot) = slots.pop() {
            if !seen.insert(slot) {
                continue;
            }
            for reader in &self.0[slot as usize] {
                match *reader {
                    Reader::Parameter(id) if given[id.index()] => continue,
                    Reader::Parameter(id) => slots.push(layout.parameter(id)),
                    Reader::Read(Read::Signal(id)) if all.contains(&Variable::Signal(id)) => {
                        continue;
                    }
                    // comparisons read the second one
                    Reader::Read(Read::Signal(id)) => {
                        slots.extend([layout.signal(id), layout.signal(id) + 1]);
                    }
                    Reader::Read(Read::Boundary(id)) => {
                        slots.push(layout.temperature(End::Boundary(id)));
                    }
                    Reader::Read(_) => {}
                }
                if let Reader::Read(read) = *reader {
                    reads.insert(read);
                }
            }
        }
        reads
    }
}
