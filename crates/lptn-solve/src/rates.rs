//! Rates of the states of a network: its right-hand side, for users with their own integrator.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{InputError, Positions};

use crate::events::{ControlState, EventKind};
use crate::pipe;
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::times::just_after;
use crate::unfold::{Unfold, carried};
use crate::unsolved::Unsolved;

/// The most rounds in which comparisons make others change at one state.
const ROUNDS: usize = 64;

/// The rates of a system's states at any time and state.
///
/// A state is an integrator's variable: the temperature of a node in K or, if its capacity depends
/// on temperature, its start plus the heat it has taken up over its capacity at the start.
///
/// Controls keep their positions at every time and state, so that rates do not jump between two
/// events. The temperatures decide which comparisons are true.
pub struct StateRates<'a> {
    pub(crate) system: &'a ThermalSystem,
    pub(crate) work: Workspace,
    pub(crate) unfold: Unfold<'a>,
    /// The positions of controls; empty for those at the start of the network.
    pub(crate) controls: Vec<ControlState>,
}

/// Rates and temperatures at one moment, or their derivative along a direction.
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
        if let Some(node) = pipe::first(system) {
            return Err(Unsolved::Pipe { node });
        }
        if let Some(state) = system.network().first_sampled() {
            return Err(Unsolved::Sampled { state });
        }
        let unfold = Unfold::new(system).map_err(|error| Unsolved::new(system, error))?;
        Ok(Self { system, work: system.workspace(), unfold, controls: Vec::new() })
    }

    /// With these positions of controls, in the order of their ids. Massless nodes with several
    /// solutions have the one of `state`, if that fits the system.
    #[must_use]
    pub fn standing(mut self, state: &State, controls: &[ControlState]) -> Self {
        if !state.stood().is_empty() && state.fits(self.system) {
            self.unfold.stand_at(state.stood());
        }
        self.controls = controls.to_vec();
        self.work.set_positions(&positions(self.system, controls));
        self
    }

    /// The states at temperatures of all nodes in K.
    ///
    /// # Errors
    /// [`Unsolved`] for a temperature at which a capacity is not known.
    pub fn carried(&self, nodes: &[f64]) -> Result<Vec<f64>, Unsolved> {
        let states = self.system.states().iter().enumerate();
        let one = states.map(|(i, id)| carried(self.system, i, nodes[id.index()]));
        one.collect::<Result<_, _>>().map_err(input)
    }

    /// The rates at `time` in s, just after any jump there.
    ///
    /// # Errors
    /// [`Unsolved`] if an input or element has no value, or massless nodes no temperature.
    pub fn at(&mut self, time: f64, states: &[f64]) -> Result<Rates, Unsolved> {
        self.place(time, states)?;
        let flow = self.flow()?;
        let rates = flow.iter().zip(self.system.capacity()).map(|(heat, capacity)| heat / capacity);
        let nodes = self.system.node_temperatures(&self.work).to_vec();
        Ok(Rates { states: rates.collect(), nodes })
    }

    /// Temperatures and heat flows at `time` in s, just after any jump there.
    ///
    /// # Errors
    /// As [`StateRates::at`].
    pub fn snapshot(&mut self, time: f64, states: &[f64]) -> Result<Snapshot, Unsolved> {
        self.place(time, states)?;
        let (system, unknowns) = (self.system, self.unfold.last());
        let of = Snapshot::of_workspace(system, &mut self.work, unknowns, (time, false));
        of.map_err(input)
    }

    /// Heat into each unknown in W at the time and state that were placed last.
    pub(crate) fn flow(&mut self) -> Result<Vec<f64>, Unsolved> {
        let unknowns = self.unfold.last();
        let mut flow = vec![0.0; unknowns.len()];
        self.system.flow(&mut self.work, unknowns, &mut flow).map_err(input)?;
        Ok(flow)
    }

    /// Reads the inputs and recovers all nodes, with the comparisons that are true there.
    pub(crate) fn place(&mut self, time: f64, states: &[f64]) -> Result<(), Unsolved> {
        let mut changed = Vec::new();
        for _ in 0..ROUNDS {
            self.recover(time, states)?;
            let now = self.work.positions().switches.clone();
            let holds = self.comparisons().map_err(input)?;
            let differ =
                holds.iter().zip(&now).enumerate().filter(|(_, (holds, now))| holds != now);
            changed = differ.map(|(switch, _)| switch).collect();
            if changed.is_empty() {
                return Ok(());
            }
            let controls = self.work.positions().controls.clone();
            self.work.set_positions(&Positions { controls, switches: holds });
            self.unfold.may_leap();
        }
        let network = self.system.network();
        let kinds: Vec<EventKind> = network.switch_ids().map(EventKind::Comparison).collect();
        let names = changed.into_iter().map(|switch| kinds[switch].name(network));
        Err(Unsolved::Restless { names: names.collect() })
    }

    fn recover(&mut self, time: f64, states: &[f64]) -> Result<(), Unsolved> {
        let (system, work) = (self.system, &mut self.work);
        system.read_inputs(work, time, just_after(time)).map_err(input)?;
        let unknowns = self.unfold.temperatures(work, states);
        let unknowns = unknowns.map_err(|error| Unsolved::new(system, error))?;
        system.recover(work, unknowns);
        Ok(())
    }

    fn comparisons(&mut self) -> Result<Vec<bool>, InputError> {
        let (system, work) = (self.system, &mut self.work);
        let network = system.network();
        let one = |(id, switch): (_, &lptn_network::Switch)| {
            let (difference, _) = system.switch_difference(work, id)?;
            Ok(switch.holds(difference))
        };
        network.switch_ids().zip(network.switches()).map(one).collect()
    }
}

/// The positions of these controls, and of comparisons at the start.
fn positions(system: &ThermalSystem, controls: &[ControlState]) -> Positions {
    let mut positions = system.network().initial_positions();
    for (on, control) in positions.controls.iter_mut().zip(controls) {
        *on = control.on;
    }
    positions
}

/// Temperatures of all boundaries in K at a time in s, just after any jump there, with these
/// positions of controls.
///
/// # Errors
/// [`Unsolved`] if an input has no value.
pub fn boundary_temperatures(
    system: &ThermalSystem,
    time: f64,
    controls: &[ControlState],
) -> Result<Vec<f64>, Unsolved> {
    let mut work = system.workspace();
    work.set_positions(&positions(system, controls));
    system.read_inputs(&mut work, time, just_after(time)).map_err(input)?;
    Ok(system.boundary_temperatures(&work).to_vec())
}

pub(crate) fn input(error: InputError) -> Unsolved {
    Unsolved::Input(Box::new(error))
}
