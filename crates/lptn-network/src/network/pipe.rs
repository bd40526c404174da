//! Pipes with plug flow of a network.

use lptn_laws::Carries;

use crate::id::{NodeId, StateId};
use crate::network::Network;
use crate::parts::pipe::{Pipe, PipePart};
use crate::slot;

impl Network {
    /// The pipes with plug flow, with their numbers.
    pub fn pipes(&self) -> &[Pipe] {
        &self.numbers.pipes
    }

    /// The same as they are written.
    pub fn pipe_parts(&self) -> &[PipePart] {
        &self.parts.pipes
    }

    /// The pipe of a node.
    pub fn pipe_at(&self, node: NodeId) -> Option<&Pipe> {
        self.pipes().iter().find(|pipe| pipe.node == node)
    }

    /// True for a state that counts the fluid that passed a pipe.
    pub fn counts_fluid(&self, state: StateId) -> bool {
        self.parts.pipes.iter().any(|pipe| pipe.passed == state)
    }

    /// The node of the state that counts the fluid of a pipe.
    pub fn counter_of(&self, pipe: &Pipe) -> NodeId {
        self.states()[pipe.passed.index()].node
    }

    /// Heat of the content of a pipe over its temperature in K, in J for one SI unit of the state
    /// that counts its fluid, from any one zero.
    pub fn heat_in_pipe(&self, pipe: &Pipe) -> impl Fn(f64) -> f64 + '_ {
        let law = &self.conductors()[pipe.streams[1].index()].law;
        let fluid = law.fluid().map(|id| (&self.fluids()[id.index()], id));
        let mut scope = self.evaluation();
        let mut density = 1.0;
        if let (Carries::VolumeFlow(measured), Some((fluid, _))) = (law.carries(), fluid) {
            let at = law.formula().position(measured).map(|place| &law.values()[place]);
            let at = at.and_then(|value| value.at(&mut scope).ok());
            scope.set(slot::OWN, at.unwrap_or(f64::NAN));
            let value = fluid.density.as_ref().and_then(|value| value.at(&mut scope).ok());
            density = value.unwrap_or(f64::NAN);
        }
        let curve = fluid.and_then(|(_, id)| self.numbers.fluids[id.index()].as_deref());
        let cp = match (fluid, curve) {
            (Some((fluid, _)), None) => fluid.cp.at(&mut scope).unwrap_or(f64::NAN),
            _ => 1.0,
        };
        move |temperature| match curve {
            None => density * cp * temperature,
            Some(curve) => density * curve.heat(temperature).unwrap_or(f64::NAN),
        }
    }
}
