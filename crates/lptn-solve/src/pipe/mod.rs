//! Pipes with plug flow in a run: the fluid that leaves is the one that entered earlier.
//!
//! The temperature of the node of a pipe is read from the recorded content, not from the balance of
//! the node. Steps are at most as long as the fluid stays in the pipe, so that no step needs its own
//! result. A jump of temperature that leaves the pipe ends a step, and so does a flow that reverses.

mod content;

use std::cell::RefCell;
use std::rc::Rc;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::Pattern;
use lptn_network::{End, NodeId, Pipe};

use crate::newton_error::NewtonError;
pub(crate) use content::{Content, Entering, Leaving};

/// Temperatures that differ by more than this share of the tolerance are a jump.
const JUMP: f64 = 0.01;

/// The longest step as a share of the time that the fluid stays.
const SHARE: f64 = 0.9;

/// The pipes of a run; the integrator and the recorder read the same ones.
pub(crate) type Shared = Rc<RefCell<Pipes>>;

/// The pipes of a run with their content.
#[derive(Clone, Debug)]
pub(crate) struct Pipes {
    filled: Vec<Filled>,
    /// Difference of temperature in K that is a jump.
    apart: f64,
}

/// A pipe with its content.
#[derive(Clone, Debug)]
pub(crate) struct Filled {
    pub(crate) pipe: Pipe,
    /// Its number among the unknowns, and that of the state that counts the fluid.
    unknown: usize,
    pub(crate) state: usize,
    /// The vertices that the fluid comes from: `from`, and `to` if it is reversed.
    before: [usize; 2],
    /// In K of the node of the state.
    pub(crate) content: Content,
    /// Heat of the content at the start in J.
    at_start: f64,
    /// The other slots of its row in the Jacobian, and its diagonal.
    row: Vec<usize>,
    diagonal: usize,
}

impl Pipes {
    /// The pipes of a system with their content at the start of the network, or with this one;
    /// `None` without pipes.
    pub(crate) fn of(system: &ThermalSystem, contents: &[Content], tolerance: f64) -> Option<Self> {
        let network = system.network();
        let all = network.pipes().iter().enumerate();
        let filled = all.map(|(i, pipe)| Filled::new(system, *pipe, contents.get(i)));
        let filled: Vec<Filled> = filled.collect::<Option<_>>()?;
        (!filled.is_empty()).then_some(Self { filled, apart: JUMP * tolerance })
    }

    pub(crate) fn filled(&self) -> &[Filled] {
        &self.filled
    }

    /// The unknowns whose temperature is that of the fluid that leaves.
    pub(crate) fn unknowns(&self) -> impl Iterator<Item = usize> {
        self.filled.iter().map(|pipe| pipe.unknown)
    }

    /// Writes the temperatures of the fluid that leaves in K, from the integrator's variables.
    pub(crate) fn place(
        &self,
        system: &ThermalSystem,
        work: &mut Workspace,
        (carried, temperatures): (&[f64], &mut [f64]),
    ) -> Result<(), NewtonError> {
        for pipe in &self.filled {
            let flow = system.source_heat(work, pipe.pipe.flow, temperatures);
            let reversed = flow.map_err(NewtonError::Input)? < 0.0;
            let leaving = pipe.content.leaving(carried[pipe.state], reversed);
            let unknown = pipe.unknown;
            temperatures[unknown] = leaving.ok_or(NewtonError::NotEntered { unknown })?;
        }
        Ok(())
    }

    /// Takes the balances of the pipes out of a Jacobian: their temperatures follow from no other
    /// ones of the same moment.
    pub(crate) fn clear_rows(&self, values: &mut [f64]) {
        for pipe in &self.filled {
            pipe.row.iter().for_each(|&slot| values[slot] = 0.0);
            values[pipe.diagonal] = -1.0;
        }
    }

    /// The time in s at which the next edge leaves if the flow stays, and the longest step in s.
    /// `rates` are those of the states in K/s.
    pub(crate) fn horizon(&self, (time, state): (f64, &[f64]), rates: &[f64]) -> [f64; 2] {
        let mut found = [f64::INFINITY; 2];
        for pipe in &self.filled {
            let (rate, passed) = (rates[pipe.state], state[pipe.state]);
            found[1] = found[1].min(SHARE * pipe.content.size() / rate.abs());
            let edge = pipe.content.next_edge(rate < 0.0).filter(|_| rate.abs() > 0.0);
            if let Some(edge) = edge {
                found[0] = found[0].min(time + (edge.passed - passed) / rate);
            }
        }
        found
    }

    /// Takes in the fluid that entered in a step, one entry for each pipe; `fresh` is true if
    /// temperatures may bend where the step began.
    pub(crate) fn enter(&mut self, entering: Vec<Entering>, fresh: bool) {
        for (pipe, fluid) in self.filled.iter_mut().zip(entering) {
            pipe.content.enter(fluid, (self.apart, fresh));
        }
    }

    /// The heat that each pipe has stored since the start in J.
    pub(crate) fn stored<'a>(
        &'a self,
        system: &'a ThermalSystem,
    ) -> impl Iterator<Item = f64> + 'a {
        self.filled.iter().map(|pipe| pipe.heat(system) - pipe.at_start)
    }

    /// The content of each pipe.
    pub(crate) fn contents(&self) -> Vec<Content> {
        self.filled.iter().map(|pipe| pipe.content.clone()).collect()
    }
}

impl Filled {
    fn new(system: &ThermalSystem, pipe: Pipe, content: Option<&Content>) -> Option<Self> {
        let network = system.network();
        let counter = &network.states()[pipe.passed.index()];
        let place = |node: NodeId| system.unknowns().iter().position(|id| *id == node);
        let (unknown, state) = (place(pipe.node)?, place(counter.node)?);
        let start = || {
            let size = counter.kelvin(pipe.content);
            Content::new(size, network.initial(counter.node), pipe.start)
        };
        let [into, out] = pipe.streams.map(|id| &network.conductors()[id.index()]);
        let vertex = |end: End| network.vertex(end);
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let slots = (0..system.unknowns().len()).flat_map(|column| pattern.column(column));
        let in_row = slots.filter(|&slot| pattern.row_indices()[slot] == unknown);
        let diagonal = pattern.diagonal()[unknown];
        let mut filled = Self {
            pipe,
            unknown,
            state,
            before: [vertex(into.from), vertex(out.to)],
            content: content.cloned().unwrap_or_else(start),
            at_start: 0.0,
            row: in_row.filter(|&slot| slot != diagonal).collect(),
            diagonal,
        };
        filled.at_start = filled.heat(system);
        Some(filled)
    }

    /// The temperature in K of the fluid before the pipe, from those of all vertices.
    pub(crate) fn entering(&self, vertices: &[f64], reversed: bool) -> f64 {
        vertices[self.before[usize::from(reversed)]]
    }

    /// Heat of the content in J over that of a fluid at 0 of its enthalpy.
    fn heat(&self, system: &ThermalSystem) -> f64 {
        let network = system.network();
        let scale = network.states()[self.pipe.passed.index()].value(1.0);
        let heat = network.heat_in_pipe(&self.pipe);
        scale * self.content.integral(&heat)
    }
}

/// The temperatures of all vertices in K at a state that was placed.
pub(crate) fn vertices(system: &ThermalSystem, work: &Workspace) -> Vec<f64> {
    let nodes = system.node_temperatures(work).iter();
    nodes.chain(system.boundary_temperatures(work)).copied().collect()
}

/// The first node of a pipe with plug flow, for analyses that do not know its content.
pub(crate) fn first(system: &ThermalSystem) -> Option<String> {
    let network = system.network();
    let pipe = network.pipes().first()?;
    Some(network.nodes()[pipe.node.index()].name.clone())
}
