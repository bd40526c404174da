//! Folds: the solution that a massless node follows ends, so that it jumps to another one.
//!
//! Heat refuses to leave the branch (`branch.rs`), so that the integrator gets to the fold in ever
//! shorter steps. At a distance too small to matter, the state is extrapolated a little further,
//! the node jumps there, and the run goes on from where it was.
//!
//! The first fold ends a run, which is repeated with a hundredth of the tolerance (`Care` in
//! `transient.rs`). Errors before a fold have one sign and are made before it is detected, and runs
//! without folds must not pay for it. A saved state contains the temperatures of massless nodes.
//! The search begins there if the form of the network does not show uniqueness.

use lptn_integrate::{IntegrateError, OdeSystem};

use crate::stop_reason::StopReason;
use crate::times::Segment;
use crate::transient::{Break, Care, Run};
use crate::unsolved::Unsolved;

/// Largest delay of a massless node at a fold: the share of the tolerance by which another node
/// moves in that time.
const LATE: f64 = 1e-2;

/// Distance of a state before a fold, as a share of that: the last digits of the balances are the
/// same there for every evaluation.
const MARGIN: f64 = 0.1;

/// The shortest distance to a fold that is extrapolated beyond, as a part of the longest.
const LEAST: f64 = 1e-3;

/// Attempts in a row that fail before a fold: steps, and jumps at the end of one.
const ATTEMPTS: usize = 40;

/// Halvings of a step in search of the fold in it.
const BISECTIONS: usize = 50;

/// Most doublings of the distance to a fold in search of the solution beyond it.
const DOUBLINGS: usize = 16;

impl Run<'_> {
    /// Remembers the temperatures of massless nodes of several solutions.
    pub(super) fn stand(&mut self) -> Result<(), Break> {
        if !self.integrator.system().is_guarded() {
            return Ok(());
        }
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let branch = self.integrator.system_mut().branch(time, &state).map_err(Break::Failed)?;
        self.recorder.set_branch(branch);
        self.stood = Some((time, state));
        Ok(())
    }

    /// A small stretch along the direction of a step.
    fn margin(&mut self, from: f64, to: f64) -> Result<Vec<f64>, Break> {
        let mut ahead = self.integrator.state().to_vec();
        let mut before = ahead.clone();
        self.integrator.interpolate(from, &mut before).map_err(|e| self.failed(e))?;
        self.integrator.interpolate(to, &mut ahead).map_err(|e| self.failed(e))?;
        ahead.iter_mut().zip(&before).for_each(|(to, from)| *to -= from);
        let most = ahead.iter().fold(f64::MIN_POSITIVE, |most, change| most.max(change.abs()));
        ahead.iter_mut().for_each(|change| *change *= MARGIN * LATE * self.tolerance / most);
        Ok(ahead)
    }

    /// The time in s that a step reaches, up to `to`, before a massless node is at the end of its
    /// branch. The last correction of a step may lie beyond it.
    pub(super) fn reaches(&mut self, from: f64, to: f64) -> Result<f64, Break> {
        if !self.integrator.system().is_guarded() {
            return Ok(to);
        }
        let mut state = self.integrator.state().to_vec();
        let branch = self.recorder.branch().to_vec();
        let ahead = self.margin(from, to)?;
        let mut stands = |run: &mut Self, time: f64| {
            let read = run.integrator.interpolate(time, &mut state);
            read.map_err(|e| run.failed(e))?;
            state.iter_mut().zip(&ahead).for_each(|(y, ahead)| *y += ahead);
            Ok(run.integrator.system_mut().comes_to((time, &state), &branch))
        };
        let Err(reason) = stands(self, to)? else {
            self.stuck = 0;
            self.recorder.set_branch_ahead(self.integrator.system().algebraic().to_vec());
            return Ok(to);
        };
        self.stuck += 1;
        if self.stuck > ATTEMPTS {
            return Err(Break::Failed(reason));
        }
        let (mut good, mut bad) = (from, to);
        for _ in 0..BISECTIONS {
            let middle = good + 0.5 * (bad - good);
            match stands(self, middle)? {
                Ok(()) => good = middle,
                Err(_) => bad = middle,
            }
        }
        drop(stands(self, good)?);
        let heat = self.integrator.system_mut();
        heat.failure = None;
        heat.fold = Some(bad);
        self.recorder.set_branch_ahead(heat.algebraic().to_vec());
        Ok(good)
    }

    /// The same; if a node does not stay, because it is at a fold, it jumps.
    pub(super) fn stand_or_leap(&mut self, segment: Segment) -> Result<(), Break> {
        let reason = match self.stand() {
            Ok(()) => return self.leap(segment).map(drop),
            Err(Break::Failed(reason)) => reason,
            Err(other) => return Err(other),
        };
        let at_fold = matches!(&reason, StopReason::Unsolved(Unsolved::Fold { .. }));
        if at_fold {
            let time = self.integrator.time();
            self.integrator.system_mut().fold = Some(time);
            if self.leap(segment)? {
                return Ok(());
            }
        }
        Err(Break::Failed(reason))
    }

    /// A step that failed before a fold jumps, or is tried again nearer to it.
    pub(super) fn leap_or_fail(
        &mut self,
        segment: Segment,
        error: IntegrateError,
    ) -> Result<(), Break> {
        let at_fold = self.integrator.system().fold.is_some();
        if !at_fold || self.stuck >= ATTEMPTS {
            return Err(self.failed(error));
        }
        if self.leap(segment)? {
            return Ok(());
        }
        self.stuck += 1;
        let heat = self.integrator.system_mut();
        heat.failure = None;
        heat.seed(self.recorder.branch());
        self.integrator.restart(None).map_err(|e| self.failed(e))
    }

    /// Lets a massless node jump that cannot go on a moment later; true if it did.
    pub(super) fn leap(&mut self, segment: Segment) -> Result<bool, Break> {
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let mass = self.integrator.system().capacities().to_vec();
        let heat = self.integrator.system_mut();
        let Some(fold) = heat.fold.take() else { return Ok(false) };
        if self.care == Care::Untried {
            return Err(Break::Fold);
        }
        if fold < time {
            return Ok(false);
        }
        // no other evaluation may affect the start of the search
        heat.seed(self.recorder.branch());
        let mut rates = vec![0.0; state.len()];
        if heat.flow(time, &state, &mut rates).is_ok() {
            rates.iter_mut().zip(&mass).for_each(|(rate, mass)| *rate /= mass);
        } else if let Some((before, stood)) =
            self.stood.as_ref().filter(|(before, _)| *before < time)
        {
            // by the last correction of the step it is beyond the fold already
            let course = state.iter().zip(stood).map(|(now, was)| (now - was) / (time - before));
            rates = course.collect();
        }
        let fastest = rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        let late = LATE * self.tolerance / fastest;
        // if nothing moves, nothing gets to a fold
        if !late.is_finite() || fold - time > late {
            return Ok(false);
        }
        let mut ahead = (fold - time).max(LEAST * late).max(4.0 * f64::EPSILON * time.abs());
        for _ in 0..DOUBLINGS {
            ahead *= 2.0;
            let beyond: Vec<f64> =
                state.iter().zip(&rates).map(|(y, rate)| y + ahead * rate).collect();
            if heat.leap((time + ahead, &beyond), (time, &state)) {
                heat.failure = None;
                self.stuck = 0;
                self.integrator.restart(None).map_err(|e| self.failed(e))?;
                self.enter(Segment { from: time, to: segment.to })?;
                return Ok(true);
            }
            heat.fold = None;
        }
        Ok(false)
    }
}
