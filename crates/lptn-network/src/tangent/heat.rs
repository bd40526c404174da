//! Changes of the heat flows of a network with a parameter, at fixed temperatures of the nodes.

use std::ops::Range;

use lptn_units::Scalar;

use super::reads::{Lanes, each, free};
use super::{Known, Pass, Tangents};
use crate::evaluation::{Evaluation, Slope};
use crate::id::{ConductorId, Field, Item};
use crate::input_error::InputError;
use crate::law::{At, ConductorFlow, Received};
use crate::network::Network;
use crate::network::flow::{name, place};
use crate::parts::signal::Course;
use crate::slot;

impl Tangents {
    /// Writes the changes of the heat that every vertex (nodes, then boundaries) receives in W per
    /// SI unit of each parameter, at the state of `scope` and these temperatures of all vertices in
    /// K. Nodes are fixed, and boundaries change with the parameter. Blocks of as many values as
    /// there are vertices.
    ///
    /// # Errors
    /// [`InputError`] for a value that has no finite derivative here.
    pub fn heat(
        &mut self,
        network: &Network,
        scope: &Evaluation,
        temperatures: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        out.fill(0.0);
        let vertices = temperatures.len();
        let add = &mut |vertex: usize, variable: usize, slope: f64| {
            out[variable * vertices + vertex] += slope;
        };
        self.each_heat(network, (scope, temperatures), add)
    }

    /// Adds the change of the sum of those heats, each times a weight for its vertex, per SI unit of
    /// each variable: the work grows with the elements that depend on a variable, not with their
    /// number times that of the variables.
    ///
    /// # Errors
    /// As [`Tangents::heat`].
    pub fn add_heat_against(
        &mut self,
        network: &Network,
        (scope, temperatures): (&Evaluation, &[f64]),
        weights: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let add = &mut |vertex: usize, variable: usize, slope: f64| {
            out[variable] += weights[vertex] * slope;
        };
        self.each_heat(network, (scope, temperatures), add)
    }

    /// Keeps the changes of all heats at this state, and the derivatives by temperatures that the same
    /// evaluations give.
    ///
    /// # Errors
    /// As [`Tangents::heat`].
    pub fn keep_heats(
        &mut self,
        network: &Network,
        scope: &Evaluation,
        temperatures: &[f64],
    ) -> Result<(), InputError> {
        let mut kept = std::mem::take(&mut self.kept);
        kept.clear();
        let add = &mut |vertex: usize, variable: usize, slope: f64| {
            kept.push((vertex, variable, slope));
        };
        let done = self.each_heat(network, (scope, temperatures), add);
        self.kept = kept;
        done
    }

    /// The same as [`Tangents::add_heat_against`] for the heats that are kept.
    pub fn add_kept_against(&self, weights: &[f64], out: &mut [f64]) {
        for (vertex, variable, slope) in &self.kept {
            out[*variable] += weights[*vertex] * slope;
        }
    }

    /// True if heats that are kept have derivatives by temperatures too.
    pub fn shares_slopes(&self) -> bool {
        !self.slopes.is_empty()
    }

    /// Derivatives in W/K of the heats that the ends of a conductor receive, by each of
    /// [`Network::conductor_variables`], for the heats that are kept; `None` if they were not taken.
    pub fn kept_slopes(&self, id: ConductorId) -> Option<&[Received]> {
        let range = self.shared.get(&id)?;
        self.slopes.get(range.clone())
    }

    /// Calls `add` with a vertex, the position of a variable and the change of a heat that the vertex
    /// receives, for every heat that changes with the variable.
    fn each_heat(
        &mut self,
        network: &Network,
        at: (&Evaluation, &[f64]),
        add: &mut Add<'_>,
    ) -> Result<(), InputError> {
        for pass in &mut self.passes {
            pass.read_inputs(network, at)?;
            pass.each_conductor(network, at, (add, &mut self.slopes))?;
            pass.each_source(network, at, add)?;
        }
        Ok(())
    }
}

/// The places of dual numbers that no variable takes, for the temperatures that a conductor reads.
#[derive(Clone, Debug)]
pub(super) struct Seeds {
    /// The first of as many places of [`Tangents::kept_slopes`] as there are temperatures.
    first: usize,
    places: Vec<usize>,
}

impl Seeds {
    /// `None` if there are too few places, or if the derivatives by temperatures have another form.
    pub(super) fn of(network: &Network, (id, lanes): (ConductorId, &Lanes)) -> Option<Self> {
        let count = network.parts.dependence(id).vertices.len();
        let plain = network.flow(id) == ConductorFlow::Variable && network.along(id).is_none();
        let places: Vec<usize> = free(lanes).take(count).collect();
        (plain && count > 0 && places.len() == count).then_some(Self { first: 0, places })
    }

    /// Gives them places after these slopes.
    pub(super) fn enter(&mut self, slopes: &mut Vec<Received>) -> Range<usize> {
        self.first = slopes.len();
        slopes.resize(self.first + self.places.len(), [0.0; 2]);
        self.first..slopes.len()
    }

    fn seed(&self, position: usize, temperature: &mut Slope) {
        if let Some(place) = self.places.get(position) {
            temperature.derivatives[*place] = 1.0;
        }
    }

    fn keep(&self, [from, to]: &[Slope; 2], slopes: &mut [Received]) {
        for (slope, place) in slopes[self.first..].iter_mut().zip(&self.places) {
            *slope = [from.derivatives[*place], to.derivatives[*place]];
        }
    }
}

/// Takes the position of a vertex, that of a variable, and the change of a heat.
type Add<'a> = dyn FnMut(usize, usize, f64) + 'a;

impl Pass {
    /// Takes the time and the signals of `scope`, and the temperatures of the boundaries.
    fn read_inputs(
        &mut self,
        network: &Network,
        (scope, temperatures): (&Evaluation, &[f64]),
    ) -> Result<(), InputError> {
        let Self { slots, stack, boundaries, signals, reads } = self;
        let layout = scope.layout();
        let mut copy = |slot: u32| slots[slot as usize] = Slope::constant(scope.slot(slot));
        [slot::TIME, slot::SEGMENT].into_iter().for_each(&mut copy);
        for id in network.signal_ids() {
            let now = layout.signal(id);
            [now, now + 1].into_iter().for_each(&mut copy);
        }
        network.control_ids().for_each(|id| copy(layout.control(id)));
        network.switch_ids().for_each(|id| copy(layout.switch(id)));
        for &(id, lane) in signals.iter() {
            let now = layout.signal(id);
            slots[now as usize] = Slope::variable(scope.slot(now), lane);
        }
        for &id in &reads.signals {
            if let Course::Expression(value) = &network.signals()[id.index()].course {
                let dual = value.on(slots, stack);
                slots[layout.signal(id) as usize] =
                    network.finite(dual, (Item::Signal(id), Field::Value), scope)?;
            }
        }
        let given = &temperatures[network.nodes().len()..];
        boundaries.iter_mut().zip(given).for_each(|(dual, t)| *dual = Slope::constant(*t));
        for &id in &reads.boundaries {
            let dual = network.boundaries()[id.index()].temperature.on(slots, stack);
            boundaries[id.index()] =
                network.finite(dual, (Item::Boundary(id), Field::Temperature), scope)?;
        }
        Ok(())
    }

    fn each_conductor(
        &mut self,
        network: &Network,
        (scope, temperatures): (&Evaluation, &[f64]),
        (add, slopes): (&mut Add<'_>, &mut [Received]),
    ) -> Result<(), InputError> {
        let Self { slots, stack, boundaries, reads, .. } = self;
        let nodes = network.nodes().len();
        let moves = |vertex: usize| {
            let boundary = vertex.checked_sub(nodes).map(|k| &boundaries[k]);
            boundary.is_some_and(|dual| dual.derivatives.iter().any(|d| d.abs() > 0.0))
        };
        for path in &reads.conductors {
            let ends = path.ends;
            if let Known::Conductance(conductance) = &path.law
                && !ends.into_iter().any(moves)
            {
                let difference = temperatures[ends[0]] - temperatures[ends[1]];
                for (k, slope) in each(&path.lanes, &conductance.derivatives) {
                    add(ends[0], k, -slope * difference);
                    add(ends[1], k, slope * difference);
                }
                continue;
            }
            let conductor = &network.conductors()[path.id.index()];
            let dual = |vertex: usize| of_vertex(vertex, network, boundaries, temperatures);
            let (from, to) = (dual(ends[0]), dual(ends[1]));
            let received = match path.law {
                Known::Conductance(conductance) => {
                    let heat = conductance * (from - to);
                    Ok([-heat, heat])
                }
                Known::Other(value) => {
                    [slots[slot::FROM as usize], slots[slot::TO as usize]] = [from, to];
                    network.received_of((&conductor.law, value), At::new((slots, stack)), from, to)
                }
                Known::No => {
                    let dependence = network.parts.dependence(path.id);
                    let seeded = |k: usize| {
                        let vertex = dependence.vertices.get(k);
                        let mut dual = dual(vertex.map_or_else(|| ends[k], |v| *v as usize));
                        path.seeds.iter().for_each(|seeds| seeds.seed(k, &mut dual));
                        dual
                    };
                    let ends = [seeded(0), seeded(1)];
                    place(slots, &dependence, &|k| ends.get(k).map_or_else(|| seeded(k), |t| *t));
                    let along = network.along(path.id);
                    let at = At { by_parameters: true, ..At::path((slots, stack), along) };
                    network.received(conductor, at, ends[0], ends[1])
                }
            };
            let received = received
                .map_err(|failed| network.failed(Item::Conductor(path.id), failed, scope))?;
            path.seeds.iter().for_each(|seeds| seeds.keep(&received, slopes));
            for (vertex, heat) in ends.into_iter().zip(received) {
                each(&path.lanes, &heat.derivatives).for_each(|(k, slope)| add(vertex, k, slope));
            }
        }
        Ok(())
    }

    fn each_source(
        &mut self,
        network: &Network,
        (scope, temperatures): (&Evaluation, &[f64]),
        add: &mut Add<'_>,
    ) -> Result<(), InputError> {
        let Self { slots, stack, boundaries, reads, .. } = self;
        for (id, lanes) in &reads.sources {
            let id = *id;
            let source = &network.sources()[id.index()];
            let dependence = &network.parts.source_dependence[id.index()];
            let dual = |vertex: usize| of_vertex(vertex, network, boundaries, temperatures);
            name(slots, dependence, &|k| dual(dependence.vertices[k] as usize));
            let power = At::new((slots, stack)).heat(&source.law);
            let power = power.map_err(|failed| network.failed(Item::Source(id), failed, scope))?;
            for &(node, share) in &source.into {
                let slopes = each(lanes, &power.derivatives);
                slopes.for_each(|(k, slope)| add(node.index(), k, share * slope));
            }
        }
        Ok(())
    }
}

/// The temperature of a vertex: that of a node is fixed.
fn of_vertex(
    vertex: usize,
    network: &Network,
    boundaries: &[Slope],
    temperatures: &[f64],
) -> Slope {
    match vertex.checked_sub(network.nodes().len()) {
        Some(boundary) => boundaries[boundary],
        None => Slope::from_f64(temperatures[vertex]),
    }
}
