//! Temperatures over time.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{IntegrateError, Integrator, LinearSolver, Options, Statistics};
use lptn_network::{NodeId, Time};

use crate::error::{SettingsError, StopReason, TransientError};
use crate::heat::Heat;
use crate::ledger::Ledger;
use crate::recorder::Recorder;
use crate::solution::{End, Solution};
use crate::stateless;
use crate::times::{OutputTimes, Segment, segments};
use crate::watch::Watch;

/// Which nodes a solution keeps.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// Every node: heat flows can be had from the solution.
    All,
    /// These nodes only, to save memory.
    Nodes(Vec<NodeId>),
}

/// The settings of a run.
#[derive(Clone, Debug)]
pub struct Transient {
    /// Start in s; `t` in expressions begins here.
    pub start: f64,
    /// Stop in s.
    pub stop: f64,
    /// When a row is written.
    pub output: OutputTimes,
    /// Tolerance in K. For networks whose nodes all lead to a boundary the error stays below ten times this,
    /// from 1e-3 to 1e-5 K (measured in the tests).
    pub tolerance: f64,
    /// What is kept.
    pub record: Record,
    /// Nodes to look at between the rows too.
    pub watch: Vec<Watch>,
    /// The linear solver; chosen by size unless said.
    pub linear_solver: LinearSolver,
}

/// Where a run stands.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Start of the run in s.
    pub start: f64,
    /// Time reached in s.
    pub time: f64,
    /// Stop of the run in s.
    pub stop: f64,
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// It does.
    Continue,
    /// It ends here; what was computed is kept.
    Interrupt,
}

impl Transient {
    /// A run from 0 to `stop` with 300 intervals between its rows and a tolerance of 1e-5 K.
    pub fn until(stop: Time) -> Self {
        Self {
            start: 0.0,
            stop: stop.0,
            output: OutputTimes::Every(stop.0 / 300.0),
            tolerance: 1e-5,
            record: Record::All,
            watch: Vec::new(),
            linear_solver: LinearSolver::Auto,
        }
    }

    /// Writes a row every `interval`.
    #[must_use]
    pub fn every(mut self, interval: Time) -> Self {
        self.output = OutputTimes::Every(interval.0);
        self
    }

    /// Writes a row at each of these times in s.
    #[must_use]
    pub fn at(mut self, times: &[f64]) -> Self {
        self.output = OutputTimes::At(times.to_vec());
        self
    }

    /// Sets the tolerance in K.
    #[must_use]
    pub fn tolerance(mut self, kelvin: f64) -> Self {
        self.tolerance = kelvin;
        self
    }

    /// Keeps only these nodes.
    #[must_use]
    pub fn record(mut self, nodes: &[NodeId]) -> Self {
        self.record = Record::Nodes(nodes.to_vec());
        self
    }

    /// Runs to the stop.
    ///
    /// # Errors
    /// [`TransientError`]; a run that breaks off hands over what it computed.
    pub fn solve(&self, system: &ThermalSystem) -> Result<Solution, TransientError> {
        self.solve_observed(system, &mut |_| Control::Continue)
    }

    /// Runs to the stop and calls `observer` after every step of the integrator; it may interrupt the run.
    ///
    /// # Errors
    /// As [`Transient::solve`].
    pub fn solve_observed(
        &self,
        system: &ThermalSystem,
        observer: &mut dyn FnMut(Progress) -> Control,
    ) -> Result<Solution, TransientError> {
        self.check().map_err(TransientError::Settings)?;
        let rows = self.output.rows(self.start, self.stop).map_err(TransientError::Settings)?;
        let network = system.network();
        let breakpoints = network.breakpoints(self.start, self.stop).map_err(TransientError::Input)?;
        let segments = segments(self.start, self.stop, &breakpoints);
        let recorder = Recorder::new(system, rows, self);
        if system.states().is_empty() {
            return stateless::solve(recorder, &segments);
        }
        Run::new(system, recorder, &segments, self)?.through(&segments, observer)
    }

    fn check(&self) -> Result<(), SettingsError> {
        let (start, stop) = (self.start, self.stop);
        if !(start.is_finite() && stop.is_finite() && start < stop) {
            return Err(SettingsError::Interval { start, stop });
        }
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            return Err(SettingsError::Tolerance(self.tolerance));
        }
        Ok(())
    }

    fn options(&self) -> Options {
        Options { tolerance: self.tolerance, linear_solver: self.linear_solver, ..Options::default() }
    }
}

/// What ends a run before its stop.
enum Break {
    Interrupted,
    Failed(StopReason),
}

/// A run under way.
struct Run<'a> {
    integrator: Integrator<Heat<'a>>,
    recorder: Recorder<'a>,
    initial: Vec<f64>,
    tolerance: f64,
}

impl<'a> Run<'a> {
    fn new(
        system: &'a ThermalSystem,
        recorder: Recorder<'a>,
        segments: &[Segment],
        settings: &Transient,
    ) -> Result<Self, TransientError> {
        let initial = system.initial();
        let heat = Heat::new(system, segments[0].inside());
        let integrator = Integrator::new(heat, settings.start, &initial, &settings.options())
            .map_err(TransientError::Integrator)?;
        Ok(Self { integrator, recorder, initial, tolerance: settings.tolerance })
    }

    fn through(
        mut self,
        segments: &[Segment],
        observer: &mut dyn FnMut(Progress) -> Control,
    ) -> Result<Solution, TransientError> {
        for (i, &segment) in segments.iter().enumerate() {
            let outcome = self.segment(segment, i == 0, observer);
            match outcome {
                Ok(()) => {}
                Err(Break::Interrupted) => {
                    let end = End::Interrupted(self.integrator.time());
                    return self.finish(end);
                }
                Err(Break::Failed(reason)) => {
                    let time = self.integrator.time();
                    let partial = Box::new(self.finish(End::Failed(time))?);
                    return Err(TransientError::Stopped { time, reason, partial });
                }
            }
        }
        self.finish(End::Reached)
    }

    /// Integrates one segment; a row at its start is written with the inputs after the jump.
    fn segment(
        &mut self,
        segment: Segment,
        first: bool,
        observer: &mut dyn FnMut(Progress) -> Control,
    ) -> Result<(), Break> {
        self.recorder.enter(segment);
        if !first {
            self.integrator.system_mut().segment = segment.inside();
            self.integrator.restart(None).map_err(|e| self.failed(e))?;
        }
        self.integrator.set_stop(segment.to);
        self.recorder.start(self.integrator.state()).map_err(Break::Failed)?;
        while self.integrator.time() < segment.to {
            let step = self.integrator.step().map_err(|e| self.failed(e))?;
            self.recorder.step(&mut self.integrator, step.from, step.to).map_err(Break::Failed)?;
            let (start, stop) = self.recorder.span();
            if observer(Progress { start, time: step.to, stop }) == Control::Interrupt {
                return Err(Break::Interrupted);
            }
        }
        Ok(())
    }

    /// The reason of a failure: what the system knows goes before what the integrator says.
    fn failed(&mut self, error: IntegrateError) -> Break {
        if let Some(input) = self.integrator.system_mut().failure.take() {
            return Break::Failed(StopReason::Input(input));
        }
        let node = error.component().map(|state| self.recorder.state_name(state));
        Break::Failed(StopReason::Integrator { error, node })
    }

    fn finish(mut self, end: End) -> Result<Solution, TransientError> {
        let system = self.recorder.system();
        let network = system.network();
        let mut stored = vec![0.0; network.nodes().len()];
        let changes = self.integrator.state().iter().zip(&self.initial).zip(system.capacity());
        for (((now, before), capacity), id) in changes.zip(system.states()) {
            stored[id.index()] = capacity * (now - before);
        }
        let statistics: Statistics = self.integrator.statistics();
        let integrals = self.integrator.quadratures().map_err(TransientError::Integrator)?;
        let ledger = Ledger::new(network, integrals, stored, self.tolerance);
        Ok(self.recorder.into_solution(ledger, statistics, end))
    }
}
