//! An integrator with a given time history: searches inside steps are tested without integration
//! errors.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::{IntegrateError, Integrator, LinearSolverKind, Statistics, Step};
use lptn_network::{
    Conductance, Context, HeatCapacity, Network, NetworkBuilder, Path, Temperature,
};

use crate::balance::Books;
use crate::heat::Heat;

/// Follows a time history, and records the times at which it is read.
pub(crate) struct Scripted<'a> {
    heat: Heat<'a>,
    course: Box<dyn Fn(f64) -> Vec<f64> + 'a>,
    time: f64,
    state: Vec<f64>,
    /// The times at which it was read.
    pub(crate) looks: Vec<f64>,
    pub(crate) directions: Vec<i32>,
    /// No time before this can be read.
    pub(crate) from: f64,
}

impl<'a> Scripted<'a> {
    pub(crate) fn new(
        system: &'a ThermalSystem,
        time: f64,
        course: impl Fn(f64) -> Vec<f64> + 'a,
    ) -> Self {
        let heat = Heat::new(system, 0.0, Books::new(system.network(), None));
        let (state, from) = (course(time), f64::NEG_INFINITY);
        let heat = heat.unwrap_or_else(|_| panic!("no heat"));
        let (course, looks, directions) = (Box::new(course), Vec::new(), Vec::new());
        Self { heat, course, time, state, looks, directions, from }
    }

    /// Takes a step to a time.
    pub(crate) fn goes_to(&mut self, to: f64) -> Step {
        let from = std::mem::replace(&mut self.time, to);
        self.state = (self.course)(to);
        Step { from, to, at_stop: false, roots: false }
    }
}

impl<'a> Integrator<Heat<'a>> for Scripted<'a> {
    fn time(&self) -> f64 {
        self.time
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn system(&self) -> &Heat<'a> {
        &self.heat
    }

    fn system_mut(&mut self) -> &mut Heat<'a> {
        &mut self.heat
    }

    fn set_stop(&mut self, _: f64) {}

    fn set_longest_step(&mut self, _: f64) {}

    fn step(&mut self) -> Result<Step, IntegrateError> {
        Ok(self.goes_to(self.time))
    }

    fn interpolate(&mut self, time: f64, y: &mut [f64]) -> Result<(), IntegrateError> {
        if time < self.from {
            return Err(IntegrateError::OutsideLastStep { time, from: self.from, to: self.time });
        }
        self.looks.push(time);
        y.copy_from_slice(&(self.course)(time));
        Ok(())
    }

    fn restart(&mut self, _: Option<&[f64]>) -> Result<(), IntegrateError> {
        Ok(())
    }

    fn rewind(&mut self, time: f64) -> Result<(), IntegrateError> {
        self.goes_to(time);
        Ok(())
    }

    fn root_directions(&self) -> &[i32] {
        &self.directions
    }

    fn quadratures(&mut self) -> Result<&[f64], IntegrateError> {
        Ok(&[])
    }

    fn sensitivities(&mut self) -> Result<&[f64], IntegrateError> {
        Ok(&[])
    }

    fn set_sensitivities(&mut self, _: &[f64]) -> Result<(), IntegrateError> {
        Ok(())
    }

    fn interpolate_sensitivities(&mut self, _: f64, _: &mut [f64]) -> Result<(), IntegrateError> {
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics::default()
    }

    fn linear_solver(&self) -> LinearSolverKind {
        LinearSolverKind::DenseLu
    }
}

/// A workspace at 0 s.
pub(crate) fn workspace(system: &ThermalSystem) -> Workspace {
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    work
}

/// Bodies `n0`, `n1`, … of these capacities in J/K (0: massless) at 300 K, each with 2 W/K to air at
/// 300 K and its heat in W; the first two are joined by a conductance if one is given.
pub(crate) fn bodies(bodies: &[(f64, &str)], joined: Option<&str>) -> Network {
    let start = Temperature(300.0);
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", start);
    let nodes: Vec<_> = (bodies.iter().enumerate())
        .map(|(i, (capacity, _))| match *capacity > 0.0 {
            true => b.node(&format!("n{i}"), HeatCapacity(*capacity), start),
            false => b.massless(&format!("n{i}")),
        })
        .collect();
    for (i, (&node, (_, heat))) in nodes.iter().zip(bodies).enumerate() {
        b.resistor(&format!("r{i}"), node, air, Conductance(2.0));
        let heat = b.expression_in(Context::Source, heat, None).unwrap();
        b.source(&format!("q{i}"), node, heat);
    }
    if let Some(joined) = joined {
        let joined = Path::conductance(b.expression_in(Context::Link, joined, None).unwrap());
        b.resistor("joined", nodes[0], nodes[1], joined);
    }
    b.build().unwrap()
}
