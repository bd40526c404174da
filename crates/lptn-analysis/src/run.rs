//! Runs, and cycles that are settled.

use lptn_assembly::ThermalSystem;
use lptn_network::{End, Network, NodeId, OutputTimes, RunSettings, Time};
use lptn_solve::{
    ControlState, Drawn, Periodic, PeriodicError, Proceed, Progress, RecordedNodes, RunStatus,
    Selection, Solution, State, SteadyState, Summary, Transient, TransientError, Unsolved,
    Verification, Watch, Window,
};

use crate::error::{CycleError, RunError};
use crate::trust::Trust;
use crate::trusted::Trusted;

/// Called after every step of a run, with its progress; it may interrupt.
pub type Observer<'a> = dyn FnMut(Progress) -> Proceed + 'a;

/// A run or a cycle: its times, and the results that it gives in addition to limits, ranges of
/// validity and the energy balance.
#[derive(Clone, Debug)]
pub struct RunAnalysis(Transient);

impl RunAnalysis {
    /// The run that `settings` describe, with the temperatures of all nodes in its rows.
    pub fn of(network: &Network, settings: &RunSettings) -> Self {
        Self(Transient::of(network, settings))
    }

    /// A run from 0 to `stop` with the default rows and tolerance.
    pub fn until(stop: Time) -> Self {
        Self(Transient::until(stop))
    }

    /// Start in s.
    pub fn start(&self) -> f64 {
        self.0.start
    }

    /// Stop in s.
    pub fn stop(&self) -> f64 {
        self.0.stop
    }

    /// Tolerance in K.
    pub fn tolerance(&self) -> f64 {
        self.0.tolerance
    }

    /// The time of each row in s.
    ///
    /// # Errors
    /// [`RunError::Failed`] if the settings contradict themselves.
    pub fn rows(&self) -> Result<Vec<f64>, RunError> {
        Ok(self.0.rows().map_err(|error| Box::new(TransientError::Settings(error)))?)
    }

    /// Begins and ends at these times in s.
    #[must_use]
    pub fn lasting(self, start: f64, stop: f64) -> Self {
        Self(Transient { start, stop, ..self.0 })
    }

    /// With this tolerance in K.
    #[must_use]
    pub fn within(self, tolerance: f64) -> Self {
        Self(Transient { tolerance, ..self.0 })
    }

    /// With a row every `interval`.
    #[must_use]
    pub fn every(self, interval: Time) -> Self {
        Self(Transient { output: OutputTimes::Every(interval.0), ..self.0 })
    }

    /// With a row at each of these times in s, in addition to the start and the stop.
    #[must_use]
    pub fn at(self, times: Vec<f64>) -> Self {
        Self(Transient { output: OutputTimes::At(times), ..self.0 })
    }

    /// Keeps the temperatures of these nodes in the rows.
    #[must_use]
    pub fn keeping(self, record: RecordedNodes) -> Self {
        Self(Transient { record, ..self.0 })
    }

    /// Without results other than those that every answer has.
    #[must_use]
    pub fn bare(self) -> Self {
        let record = RecordedNodes::Nodes(Vec::new());
        let (watch, windows) = (Vec::new(), Vec::new());
        let transient = Transient { record, watch, windows, balance: None, drawn: None, ..self.0 };
        Self(Transient { hottest_only: false, ..transient })
    }

    /// Looks for the extremes of these nodes.
    #[must_use]
    pub fn watching(self, nodes: impl IntoIterator<Item = NodeId>) -> Self {
        let watch = nodes.into_iter().map(|node| Watch { node, level: None }).collect();
        Self(Transient { watch, ..self.0 })
    }

    /// Looks for the extremes of these nodes, and for when they come near their steady state, if
    /// there is one: see [`Summary`].
    ///
    /// # Errors
    /// [`Unsolved`] if a value cannot be evaluated at the start.
    pub fn towards(
        self,
        (system, nodes): (&ThermalSystem, &[NodeId]),
        steady: Option<&SteadyState>,
    ) -> Result<Self, Unsolved> {
        let watch = Summary::watches(system, self.0.start, nodes, steady)?;
        Ok(Self(Transient { watch, ..self.0 }))
    }

    /// Looks for the highest temperature of all watched nodes only: the peak of a node that is
    /// never the hottest may be missed.
    #[must_use]
    pub fn for_the_hottest(self) -> Self {
        Self(Transient { hottest_only: true, ..self.0 })
    }

    /// Takes means and extremes over these windows.
    #[must_use]
    pub fn over(self, windows: Vec<Window>) -> Self {
        Self(Transient { windows, ..self.0 })
    }

    /// Reads the columns of a picture between the rows too.
    #[must_use]
    pub fn drawing(self, drawn: Drawn) -> Self {
        Self(Transient { drawn: Some(drawn), ..self.0 })
    }

    /// Bounds the error of each temperature with proof, and that of these columns: see
    /// [`Solution::certificate`].
    #[must_use]
    pub fn certified(self, columns: Selection) -> Self {
        Self(Transient { certify: true, certified: Some(columns), ..self.0 })
    }

    /// Keeps the states at every time: see [`Solution::margin_gradient`].
    #[must_use]
    pub fn with_trajectory(self) -> Self {
        Self(Transient { trajectory: true, ..self.0 })
    }

    /// Keeps the heat balance of a node or boundary.
    #[must_use]
    pub fn balancing(self, balance: Option<End>) -> Self {
        Self(Transient { balance, ..self.0 })
    }

    pub(crate) fn transient(&self) -> &Transient {
        &self.0
    }

    /// Runs a network to the stop.
    ///
    /// # Errors
    /// [`RunError`]; [`RunError::into_part`] has the part that was computed of a run that did not
    /// reach its stop.
    pub fn solve(
        &self,
        system: &ThermalSystem,
        observer: &mut Observer<'_>,
    ) -> Result<Trusted<Solution>, RunError> {
        answered(self.0.solve_observed(system, observer))
    }

    /// Runs a network from a state at the start, with its controls in their states there.
    ///
    /// # Errors
    /// As [`RunAnalysis::solve`].
    pub fn solve_from(
        &self,
        (system, state): (&ThermalSystem, &State),
        controls: &[ControlState],
        observer: &mut Observer<'_>,
    ) -> Result<Trusted<Solution>, RunError> {
        let run = Transient { controls: controls.to_vec(), ..self.0.clone() };
        answered(run.solve_from(system, state, observer))
    }

    /// Searches the cycle from the start to the stop to which a network settles.
    ///
    /// # Errors
    /// [`CycleError`]; a cycle whose energy balance does not close is a run that failed.
    pub fn cycle(
        &self,
        system: &ThermalSystem,
        observer: &mut Observer<'_>,
    ) -> Result<Trusted<Periodic>, CycleError> {
        let mut reached = self.0.start;
        let found = Periodic::find_observed(system, &self.0, &mut |progress| {
            reached = progress.time;
            observer(progress)
        });
        match found {
            Ok(result) => {
                let trust = Trust { grows: result.grows(), ..Trust::of_run(&result.solution) };
                Ok(Trusted { trust, result })
            }
            Err(PeriodicError::Interrupted { .. }) => {
                Err(RunError::Interrupted { time: reached, part: None }.into())
            }
            Err(PeriodicError::Cycle(open @ TransientError::Open { .. })) => {
                Err(RunError::Failed(Box::new(open)).into())
            }
            Err(error) => Err(CycleError::Missing(Box::new(error))),
        }
    }

    /// Compares a run with others of smaller tolerance and with a solution in closed form, if
    /// there is one; `observer` gets the tolerance too. `None` if it interrupts.
    ///
    /// # Errors
    /// [`RunError::Failed`].
    pub fn verify(
        &self,
        system: &ThermalSystem,
        observer: &mut dyn FnMut(f64, Progress) -> Proceed,
    ) -> Result<Option<Verification>, RunError> {
        Ok(Verification::observed(system, &self.0, observer).map_err(Box::new)?)
    }
}

fn answered(found: Result<Solution, TransientError>) -> Result<Trusted<Solution>, RunError> {
    let result = found.map_err(Box::new)?;
    if let RunStatus::Interrupted(time) = result.end() {
        return Err(RunError::Interrupted { time, part: Some(Box::new(result)) });
    }
    Ok(Trusted { trust: Trust::of_run(&result), result })
}
