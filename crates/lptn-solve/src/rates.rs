//! Rates of the states of a network: its right-hand side, for users with their own integrator.

use lptn_assembly::{ThermalSystem, Workspace};

use crate::times::just_after;
use crate::unfold::{Unfold, carried};
use crate::unsolved::Unsolved;

/// The rates of a system's states at any time and state.
///
/// A state is an integrator's variable: the temperature of a node in K or, if its capacity depends
/// on temperature, its start plus the heat it has taken up over its capacity at the start.
pub struct StateRates<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    unfold: Unfold<'a>,
}

/// Rates and temperatures of a state at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Rates {
    /// Rate of each state in K/s.
    pub states: Vec<f64>,
    /// Temperature of each node in K, those without capacity included.
    pub nodes: Vec<f64>,
}

impl<'a> StateRates<'a> {
    /// The rates of a system with the controls in their state at the start.
    ///
    /// # Errors
    /// [`Unsolved`] if the balances of massless nodes cannot be set up.
    pub fn new(system: &'a ThermalSystem) -> Result<Self, Unsolved> {
        let unfold = Unfold::new(system).map_err(|error| Unsolved::new(system, error))?;
        Ok(Self { system, work: system.workspace(), unfold })
    }

    /// The states at temperatures of all nodes in K.
    ///
    /// # Errors
    /// [`Unsolved`] for a temperature at which a capacity is not known.
    pub fn carried(&self, nodes: &[f64]) -> Result<Vec<f64>, Unsolved> {
        let states = self.system.states().iter().enumerate();
        let one = states.map(|(i, id)| carried(self.system, i, nodes[id.index()]));
        one.collect::<Result<_, _>>().map_err(|error| Unsolved::Input(Box::new(error)))
    }

    /// The rates at `time` in s, just after any jump there.
    ///
    /// # Errors
    /// [`Unsolved`] if an input or element has no value, or massless nodes no temperature.
    pub fn at(&mut self, time: f64, states: &[f64]) -> Result<Rates, Unsolved> {
        let (system, work) = (self.system, &mut self.work);
        let input = |error| Unsolved::Input(Box::new(error));
        system.read_inputs(work, time, just_after(time)).map_err(input)?;
        let unknowns = self.unfold.temperatures(work, states);
        let unknowns = unknowns.map_err(|error| Unsolved::new(system, error))?;
        let mut flow = vec![0.0; unknowns.len()];
        system.flow(work, unknowns, &mut flow).map_err(input)?;
        system.recover(work, unknowns);
        let rates = flow.iter().zip(system.capacity()).map(|(heat, capacity)| heat / capacity);
        Ok(Rates { states: rates.collect(), nodes: system.node_temperatures(work).to_vec() })
    }
}
