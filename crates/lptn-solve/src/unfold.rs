//! From the integrator's variables to temperatures.
//!
//! The variable of a node with a constant capacity is its temperature. If the capacity depends on
//! temperature, the variable is the heat content H over the capacity at the start, `y = T0 + H /
//! C0` in K, so that heat is never lost to the approximation of a changing capacity. Algebraic
//! unknowns are solved for.

use std::cell::RefCell;
use std::rc::Rc;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Enthalpy, Field, InputError, InputProblem, Item};

use crate::between::SHORT;
use crate::newton::Newton;
use crate::newton_error::NewtonError;
use crate::pipe::{Pipes, Shared};

/// Temperatures of all unknowns of a system, from the integrator's variables.
pub(crate) struct Unfold<'a> {
    system: &'a ThermalSystem,
    /// The states whose variable is their heat content.
    contents: Vec<Stored<'a>>,
    algebraic: Option<Newton<'a>>,
    /// Temperature of every unknown in K. Algebraic ones begin at the last solution.
    temperatures: Vec<f64>,
    /// Derivative of the temperature of every unknown by its variable.
    slopes: Vec<f64>,
    /// True if the algebraic unknowns may jump to another solution at the next evaluation, because
    /// their inputs have.
    leaps: bool,
    /// The pipes of a run, whose temperatures come from their content.
    pipes: Option<Shared>,
}

/// A state whose variable is its heat content.
struct Stored<'a> {
    state: usize,
    curve: &'a Enthalpy,
    /// Its temperature at the start in K.
    start: f64,
    /// The panel of the curve at the last call.
    panel: usize,
    /// Its variable at the last call, in K.
    carried: Option<f64>,
    /// Its temperature then in K, and the slope of that over the variable.
    here: (f64, f64),
}

impl Stored<'_> {
    /// Temperature in K and its slope over the variable in K, for a capacity in J/K at the start;
    /// `None` outside the curve.
    fn at(&mut self, carried: f64, capacity: f64) -> Option<(f64, f64)> {
        if self.carried != Some(carried) {
            let heat = capacity * (carried - self.start);
            let content = self.curve.temperature_near(heat, &mut self.panel)?;
            self.here = (content.temperature, (capacity / content.capacity).max(LEAST_SLOPE));
            self.carried = Some(carried);
        }
        Some(self.here)
    }
}

/// Least slope of a temperature over its variable: melting at one temperature.
const LEAST_SLOPE: f64 = 1e-12;

impl<'a> Unfold<'a> {
    pub(crate) fn new(system: &'a ThermalSystem) -> Result<Self, NewtonError> {
        let network = system.network();
        let states = system.states();
        let contents = states.iter().enumerate().filter_map(|(state, &id)| {
            let (curve, start) = (network.enthalpy(id)?, network.initial(id));
            Some(Stored { state, curve, start, panel: 0, carried: None, here: (start, 1.0) })
        });
        let count = system.unknowns().len();
        let mut algebraic = match states.len() {
            n if n == count => None,
            n => Some(Newton::new(system, (n..count).collect())?),
        };
        algebraic.iter_mut().for_each(|newton| newton.guarded = !system.is_monotone());
        let mut temperatures = system.initial();
        let mean = guess(system);
        // if a solution is the only one, it is found as well from the start of the others
        let guarded = algebraic.as_ref().is_some_and(|newton| newton.guarded);
        let begins = |id: &lptn_network::NodeId| {
            let stood = network.nodes()[id.index()].stood.is_some();
            network.begins(*id).filter(|_| guarded || !stood)
        };
        temperatures
            .extend(system.unknowns()[states.len()..].iter().map(|id| begins(id).unwrap_or(mean)));
        let contents = contents.collect();
        Ok(Self {
            system,
            contents,
            algebraic,
            temperatures,
            slopes: vec![1.0; count],
            leaps: true,
            pipes: None,
        })
    }

    /// The same at the start of the network: pipes have the content of their start.
    pub(crate) fn at_start(system: &'a ThermalSystem) -> Result<Self, NewtonError> {
        let mut unfold = Self::new(system)?;
        if let Some(pipes) = Pipes::of(system, &[], 0.0) {
            unfold.read_pipes(&Rc::new(RefCell::new(pipes)))?;
        }
        Ok(unfold)
    }

    /// Takes the temperatures of pipes from their content.
    pub(crate) fn read_pipes(&mut self, pipes: &Shared) -> Result<(), NewtonError> {
        let read: Vec<usize> = pipes.borrow().unknowns().collect();
        let (states, all) = (self.system.states().len(), self.system.unknowns().len());
        let solved: Vec<usize> = (states..all).filter(|unknown| !read.contains(unknown)).collect();
        let guarded = self.is_guarded();
        self.algebraic = None;
        if !solved.is_empty() {
            let mut newton = Newton::new(self.system, solved)?;
            newton.guarded = guarded;
            self.algebraic = Some(newton);
        }
        self.pipes = Some(Rc::clone(pipes));
        Ok(())
    }

    /// Takes the balances of pipes out of a Jacobian.
    pub(crate) fn clear_pipes(&self, values: &mut [f64]) {
        self.pipes.iter().for_each(|pipes| pipes.borrow().clear_rows(values));
    }

    /// True if there are pipes whose content is read.
    pub(crate) fn has_pipes(&self) -> bool {
        self.pipes.is_some()
    }

    /// True if a variable is not the temperature somewhere.
    pub(crate) fn carries_heat(&self) -> bool {
        !self.contents.is_empty()
    }

    /// Derivatives of the temperatures of all unknowns by their variables.
    pub(crate) fn slopes(&self) -> &[f64] {
        &self.slopes
    }

    /// The temperatures last unfolded.
    pub(crate) fn last(&self) -> &[f64] {
        &self.temperatures
    }

    /// Temperatures of all unknowns in K, with the inputs as they were last read.
    pub(crate) fn temperatures(
        &mut self,
        work: &mut Workspace,
        carried: &[f64],
    ) -> Result<&[f64], NewtonError> {
        self.temperatures[..carried.len()].copy_from_slice(carried);
        let capacities = self.system.capacity();
        for stored in &mut self.contents {
            let state = stored.state;
            let Some(here) = stored.at(carried[state], capacities[state]) else {
                return Err(NewtonError::Input(outside(self.system, state, stored.curve)));
            };
            (self.temperatures[state], self.slopes[state]) = here;
        }
        if let Some(pipes) = &self.pipes {
            let at = (carried, &mut self.temperatures[..]);
            pipes.borrow().place(self.system, work, at)?;
        }
        if let Some(newton) = &mut self.algebraic {
            match std::mem::take(&mut self.leaps) && newton.guarded {
                true => newton.leap(work, &mut self.temperatures)?,
                false => newton.follow(work, &mut self.temperatures)?,
            }
        }
        Ok(&self.temperatures)
    }

    /// True if algebraic unknowns may have several solutions, so that the choice of one matters.
    pub(crate) fn is_guarded(&self) -> bool {
        self.algebraic.as_ref().is_some_and(|newton| newton.guarded)
    }

    /// Lets the algebraic unknowns jump at the next evaluation: inputs or positions have.
    pub(crate) fn may_leap(&mut self) {
        self.leaps = true;
    }

    /// Temperatures of the algebraic unknowns in K, as last unfolded.
    pub(crate) fn algebraic(&self) -> &[f64] {
        &self.temperatures[self.system.states().len()..]
    }

    /// Begins a run at these temperatures in K of the algebraic unknowns, which may have ended.
    pub(crate) fn stand_at(&mut self, algebraic: &[f64]) {
        self.seed(algebraic);
        self.may_leap();
    }

    /// Begins the next evaluation at these temperatures of the algebraic unknowns, in K.
    pub(crate) fn seed(&mut self, algebraic: &[f64]) {
        let states = self.system.states().len();
        self.temperatures[states..].copy_from_slice(algebraic);
        self.leaps = false;
    }

    /// The same, but if the unknowns may jump they still may.
    pub(crate) fn begin(&mut self, algebraic: impl Iterator<Item = f64>) {
        let states = self.system.states().len();
        self.temperatures[states..].iter_mut().zip(algebraic).for_each(|(t, at)| *t = at);
    }

    /// See [`Newton::matrix`].
    pub(crate) fn matrix(&self) -> &[f64] {
        self.algebraic.as_ref().map_or(&[], Newton::matrix)
    }

    /// See [`Newton::lean_on`].
    pub(crate) fn lean_on(&mut self, matrix: &[f64]) {
        self.algebraic.iter_mut().for_each(|newton| newton.lean_on(matrix));
    }

    /// See [`Newton::lean_on_itself`].
    pub(crate) fn lean_on_itself(&mut self) {
        self.algebraic.iter_mut().for_each(Newton::lean_on_itself);
    }

    /// See [`Newton::lean`].
    pub(crate) fn lean(&mut self) {
        self.algebraic.iter_mut().for_each(Newton::lean);
    }

    /// True if the algebraic unknowns differ from these temperatures in K by more than rounding.
    pub(crate) fn is_apart(&self, from: &[f64]) -> bool {
        self.algebraic().iter().zip(from).any(|(a, b)| (a - b).abs() > SHORT)
    }

    /// Refuses the solution last found if it is not on one branch with these temperatures of the
    /// algebraic unknowns.
    pub(crate) fn stays(&mut self, work: &mut Workspace, from: &[f64]) -> Result<(), NewtonError> {
        let Some(newton) = &mut self.algebraic else { return Ok(()) };
        let mut start = self.temperatures.clone();
        start[self.system.states().len()..].copy_from_slice(from);
        newton.stays(work, &start, &self.temperatures)
    }
}

/// A first guess for algebraic unknowns in K: the mean of the starts of all states, or of the
/// boundaries.
fn guess(system: &ThermalSystem) -> f64 {
    let initial = system.initial();
    let mean = initial.iter().sum::<f64>() / initial.len() as f64;
    if mean.is_finite() { mean } else { lptn_network::ZERO_CELSIUS + 25.0 }
}

/// The variable in K of one of the states at a temperature in K.
pub(crate) fn carried(
    system: &ThermalSystem,
    state: usize,
    temperature: f64,
) -> Result<f64, InputError> {
    let network = system.network();
    let id = system.states()[state];
    let Some(curve) = network.enthalpy(id) else { return Ok(temperature) };
    let heat = curve.heat(temperature).ok_or_else(|| outside(system, state, curve))?;
    Ok(network.initial(id) + heat / system.capacity()[state])
}

pub(crate) fn outside(system: &ThermalSystem, state: usize, curve: &Enthalpy) -> InputError {
    let id = system.states()[state];
    let name = system.network().nodes()[id.index()].name.clone();
    let problem = InputProblem::OutsideCapacity { range: curve.range() };
    InputError { item: Item::Node(id), field: Field::Capacity, name, problem }
}

#[cfg(test)]
mod tests;
