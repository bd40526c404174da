//! A network that is stepped from outside.

use std::collections::BTreeMap;

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Network, NodeId, ParameterId, RunSettings, SignalId, Temperature, Time, UnknownName, Variable,
};
use lptn_solve::{
    ControlState, EventIndicator, Proceed, RateSlopes, Rates, Snapshot, Solution, State,
    StateRates, Transient, boundary_temperatures,
};
use serde::{Deserialize, Serialize};

use crate::run::RunAnalysis;
use crate::simulation_error::SimulationError;
use crate::trusted::Trusted;

/// A network with its state at a time. Its client steps it, and sets parameters and signals between
/// the steps: a controller, a cosimulation.
///
/// It owns its data and can be sent to another thread. Each step is a separate run: its error stays
/// below ten tolerances if that of runs does, and its energy balance is checked.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// The network without the client's values.
    network: Network,
    parameters: BTreeMap<String, (ParameterId, f64)>,
    signals: BTreeMap<String, (SignalId, f64)>,
    system: ThermalSystem,
    run: RunAnalysis,
    time: f64,
    state: State,
    controls: Vec<ControlState>,
    temperatures: Vec<f64>,
}

/// The state of a simulation, to be kept and restored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedSimulation {
    /// Time in s.
    pub time: f64,
    /// The integrated value of every state in K: see [`State::carried`].
    pub carried: Vec<f64>,
    /// Temperatures in K of massless nodes of several solutions; may be empty.
    pub stood: Vec<f64>,
    /// The state of every control.
    pub controls: Vec<SavedControl>,
    /// Parameters and signals that were set, in SI units.
    pub inputs: BTreeMap<String, f64>,
}

/// The state of a control.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedControl {
    /// True if it is on.
    pub on: bool,
    /// Time of its last switch in s; `None` if it never switched.
    pub since: Option<f64>,
}

impl Simulation {
    /// At the start of a run, with its tolerance and integrator.
    ///
    /// # Errors
    /// [`SimulationError`] if the network cannot be assembled, or has no temperatures there.
    pub fn new(network: &Network, settings: &RunSettings) -> Result<Self, SimulationError> {
        let system = ThermalSystem::assemble(network)?;
        let state = State::initial(&system);
        let simulation = Self {
            temperatures: Vec::new(),
            controls: Transient::of(network, settings).controls,
            run: RunAnalysis::of(network, settings).bare(),
            parameters: BTreeMap::new(),
            signals: BTreeMap::new(),
            network: network.clone(),
            time: settings.start,
            system,
            state,
        };
        let temperatures = simulation.rates()?.nodes;
        Ok(Self { temperatures, ..simulation })
    }

    /// The network with the client's values.
    pub fn network(&self) -> &Network {
        self.system.network()
    }

    /// The time that was reached, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The temperature of a node, or of a boundary just after the present time.
    ///
    /// # Errors
    /// [`SimulationError::Unknown`]; [`SimulationError::Rates`] if the boundary has no value.
    pub fn temperature(&self, name: &str) -> Result<Temperature, SimulationError> {
        let boundaries = self.network().boundaries();
        if let Some(place) = boundaries.iter().position(|boundary| boundary.name == name) {
            let all = boundary_temperatures(&self.system, self.time, &self.controls)?;
            return Ok(Temperature(all[place]));
        }
        let id = self.network().node(name)?;
        Ok(Temperature(self.temperatures[id.index()]))
    }

    /// Sets a parameter, or fixes a signal, at a value in SI units from now on. The temperatures
    /// stay as they are, also if a heat capacity changes.
    ///
    /// # Errors
    /// [`SimulationError`]; nothing is set then.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), SimulationError> {
        let (mut parameters, mut signals) = (self.parameters.clone(), self.signals.clone());
        match self.input(name)? {
            Variable::Parameter(id) => drop(parameters.insert(name.to_owned(), (id, value))),
            Variable::Signal(id) => drop(signals.insert(name.to_owned(), (id, value))),
        }
        self.change(parameters, signals)
    }

    fn input(&self, name: &str) -> Result<Variable, SimulationError> {
        let unknown = match self.network.parameter(name) {
            Ok(id) => return Ok(Variable::Parameter(id)),
            Err(unknown) => unknown,
        };
        let mut signals = self.network.signal_ids().zip(self.network.signals());
        if let Some((id, _)) = signals.find(|(_, signal)| signal.name == name) {
            return Ok(Variable::Signal(id));
        }
        match self.network.item(name) {
            Ok(_) => Err(SimulationError::NotAnInput(name.to_owned())),
            Err(_) => Err(unknown.into()),
        }
    }

    /// The present value of a state of `[state]` in SI units, an absolute temperature in K.
    ///
    /// # Errors
    /// [`SimulationError::Unknown`].
    pub fn state(&self, name: &str) -> Result<f64, SimulationError> {
        let network = self.network();
        match network.state(name) {
            Some(id) => Ok(network.state_value(id, &self.temperatures)),
            None => {
                let names = network.states().iter().map(|state| state.name.as_str());
                let suggestion = lptn_units::suggest(name, names).map(str::to_owned);
                Err(UnknownName { name: name.to_owned(), suggestion }.into())
            }
        }
    }

    /// Gives a signal its own time history again, or a parameter its own value.
    ///
    /// # Errors
    /// As [`Simulation::set`].
    pub fn release(&mut self, name: &str) -> Result<(), SimulationError> {
        self.input(name)?;
        let (mut parameters, mut signals) = (self.parameters.clone(), self.signals.clone());
        parameters.remove(name);
        signals.remove(name);
        self.change(parameters, signals)
    }

    fn change(
        &mut self,
        parameters: BTreeMap<String, (ParameterId, f64)>,
        signals: BTreeMap<String, (SignalId, f64)>,
    ) -> Result<(), SimulationError> {
        let mut given = self.network.given();
        parameters.values().for_each(|(id, value)| given.set(*id, *value));
        let held: Vec<(SignalId, f64)> = signals.values().copied().collect();
        let network = self.network.with(&given)?.held(&held)?;
        let system = ThermalSystem::assemble(&network)?;
        self.keeps_enthalpy(&system)?;
        (self.parameters, self.signals, self.system) = (parameters, signals, system);
        Ok(())
    }

    /// Checks that nodes that melt keep their heat content: it counts from that at the start.
    fn keeps_enthalpy(&self, system: &ThermalSystem) -> Result<(), SimulationError> {
        let (old, new) = (self.network(), system.network());
        let bits = |capacity: &f64| capacity.to_bits();
        for (i, id) in system.states().iter().enumerate() {
            let same = old.enthalpy(*id) == new.enthalpy(*id)
                && bits(&self.system.capacity()[i]) == bits(&system.capacity()[i]);
            if !same && (old.enthalpy(*id).is_some() || new.enthalpy(*id).is_some()) {
                let node = new.nodes()[id.index()].name.clone();
                return Err(SimulationError::Melts { node });
            }
        }
        Ok(())
    }

    /// Steps to a time in s, with a row at each of these times between, the present and the end.
    ///
    /// # Errors
    /// [`SimulationError::Run`]; the simulation stays where it was.
    pub fn advance(
        &mut self,
        to: Time,
        rows: &[f64],
    ) -> Result<Trusted<Solution>, SimulationError> {
        let run = self.run.clone().lasting(self.time, to.0).at(rows.to_vec());
        let run = run.keeping(lptn_solve::RecordedNodes::All);
        let begin = (&self.system, &self.state);
        let answer = run.solve_from(begin, &self.controls, &mut |_| Proceed::Continue)?;
        self.state = answer.last_state().clone();
        self.controls = answer.controls().to_vec();
        self.temperatures = answer.last().temperatures.clone();
        self.time = to.0;
        Ok(answer)
    }

    /// Rates of the states in K/s and temperatures of the nodes, just after the present time. The
    /// order is that of [`Simulation::states`] and of the network.
    ///
    /// Controls keep their positions. One that has to switch does so when the simulation steps.
    ///
    /// # Errors
    /// [`SimulationError::Rates`] if an input has no value.
    pub fn rates(&self) -> Result<Rates, SimulationError> {
        Ok(self.state_rates()?.at(self.time, self.state.carried())?)
    }

    /// Temperatures and heat flows just after the present time.
    ///
    /// # Errors
    /// As [`Simulation::rates`].
    pub fn snapshot(&self) -> Result<Snapshot, SimulationError> {
        Ok(self.state_rates()?.snapshot(self.time, self.state.carried())?)
    }

    /// The node of each state, in the order of the rates, the Jacobian and the saved states.
    ///
    /// A state is in K: the temperature of a node with a constant capacity. A node whose capacity
    /// depends on its temperature, such as one that melts, has its enthalpy as a state instead: its
    /// temperature at the start plus its heat over the capacity there. Nodes without capacity have
    /// no state.
    pub fn states(&self) -> &[NodeId] {
        self.system.states()
    }

    /// The present event indicators: a signed number for each control, each comparison of
    /// temperatures and each limit. It is zero at the event and continuous between two events. A
    /// comparison changes within a hundredth of the tolerance of its zero.
    ///
    /// Jumps of inputs at known times have no indicator.
    ///
    /// # Errors
    /// [`SimulationError::Rates`] if an input, a threshold or a limit has no value.
    pub fn event_indicators(&self) -> Result<Vec<EventIndicator>, SimulationError> {
        Ok(self.state_rates()?.indicators(self.time, self.state.carried())?)
    }

    /// The derivatives of [`Simulation::rates`] at the present time and state: the Jacobian in 1/s,
    /// directional and adjoint derivatives. They are exact, from the derivatives of every law.
    /// Controls and comparisons keep their positions, massless nodes are eliminated.
    ///
    /// The variables are the states, then these parameters and signals in this order. A derivative
    /// by an input describes a small [`Simulation::set`] of it: the states stay the same. A signal
    /// that was not set counts as a constant with its present value.
    ///
    /// # Errors
    /// [`SimulationError`] for a name that cannot be set or occurs twice, and for a parameter that
    /// changes the enthalpy of a node.
    pub fn slopes(&self, inputs: &[&str]) -> Result<RateSlopes, SimulationError> {
        let mut variables = Vec::with_capacity(inputs.len());
        for name in inputs {
            let variable = self.input(name)?;
            if variables.contains(&variable) {
                return Err(SimulationError::Twice { name: (*name).to_owned() });
            }
            variables.push(variable);
        }
        let at = (self.time, self.state.carried());
        Ok(self.state_rates()?.slopes(at, &variables)?)
    }

    fn state_rates(&self) -> Result<StateRates<'_>, SimulationError> {
        Ok(StateRates::new(&self.system)?.standing(&self.state, &self.controls))
    }

    /// The data that its future depends on in addition to the network.
    pub fn save(&self) -> SavedSimulation {
        let control = |control: &ControlState| SavedControl {
            on: control.on,
            since: Some(control.since).filter(|since| since.is_finite()),
        };
        let parameters = self.parameters.iter().map(|(name, (_, value))| (name.clone(), *value));
        let signals = self.signals.iter().map(|(name, (_, value))| (name.clone(), *value));
        SavedSimulation {
            time: self.time,
            carried: self.state.carried().to_vec(),
            stood: self.state.stood().to_vec(),
            controls: self.controls.iter().map(control).collect(),
            inputs: parameters.chain(signals).collect(),
        }
    }

    /// Goes to a state that a simulation of the same network saved.
    ///
    /// # Errors
    /// [`SimulationError`] if it is of another network; the simulation stays as it was.
    pub fn restore(&mut self, saved: &SavedSimulation) -> Result<(), SimulationError> {
        let mut next = self.clone();
        (next.parameters, next.signals) = (BTreeMap::new(), BTreeMap::new());
        for (name, value) in &saved.inputs {
            next.set(name, *value)?;
        }
        let controls = next.network().controls().len();
        let control = |saved: &SavedControl| ControlState {
            on: saved.on,
            since: saved.since.unwrap_or(f64::NEG_INFINITY),
        };
        let stands = saved.controls.is_empty() || saved.controls.len() == controls;
        next.state = State::restored(saved.carried.clone(), saved.stood.clone());
        if !next.state.fits(&next.system) || !stands {
            return Err(SimulationError::Foreign);
        }
        next.controls = saved.controls.iter().map(control).collect();
        next.time = saved.time;
        next.temperatures = next.rates()?.nodes;
        *self = next;
        Ok(())
    }
}
