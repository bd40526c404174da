//! The search for a start that a cycle leads back to.

use lptn_assembly::ThermalSystem;
use lptn_network::ConductorFlow;

use super::cycle::Cycles;
use super::error::PeriodicError;
use super::memory;
use super::secants::{Secants, Shot};
use crate::error::TransientError;
use crate::solution::Solution;

/// The search begins with this tolerance in K.
const COARSEST: f64 = 1e-3;

/// It goes on with this part of it …
const FINER: f64 = 1e-2;

/// … unless the requested tolerance is within this of the next one. A network that hardly forgets
/// anything in a cycle adds up the integrator's errors over very many: then the search goes on
/// beyond that tolerance, …
const NEAR: f64 = 20.0;

/// … but not below this in K: near 300 K the last digit is 6e-14 K.
const FINEST: f64 = 1e-11;

/// Cycles of one search.
const MOST_CYCLES: usize = 300;

/// The error of a cycle in tolerances.
const ERROR: f64 = 10.0;

/// Cycles without a residual smaller by half, after which it counts as the integrator's error.
const PATIENCE: usize = 2;

/// No next cycle begins further from the end of the last one than this times the sum of later
/// cycles, …
const REACH: f64 = 2.0;

/// … less by this factor after each step that led nowhere, …
const SHORTER: f64 = 0.25;

/// … until so little is left that the last cycle is accepted as it is.
const LEAST_REACH: f64 = 0.02;

/// A cycle whose residual is this many times that of the best one has led nowhere, …
const ASTRAY: f64 = 3.0;

/// … and so has every one after this number without progress.
const MOST_IDLE: usize = 8;

/// Cycles that begin at the end of the last one, after one with a larger residual: fast parts
/// settle by themselves.
const RELAXED: usize = 2;

/// The assumed largest part of a disturbance that a cycle leaves over, as long as it is not known,
/// …
const UNKNOWN: f64 = 0.9;

/// … and if cycles seem to forget nothing.
const SLOWEST: f64 = 1.0 - 1e-7;

/// The last digits of a temperature of some 300 K, in K.
const ROUNDING: f64 = 2e-13;

/// A disturbance in K that shows the part that a cycle leaves of it.
const PROBE: f64 = 1.0;

/// Result of a search.
pub(super) struct Found {
    pub(super) shot: Shot,
    pub(super) solution: Solution,
    pub(super) multiplier: Option<f64>,
    pub(super) error: f64,
}

/// Accelerated cycles, coarse ones first.
pub(super) struct Search<'a, 'b> {
    cycles: &'a mut Cycles<'b>,
    secants: Secants,
    tolerance: f64,
    /// The best cycle at the present tolerance.
    best: Option<Shot>,
    /// Cycles at the present tolerance since the residual last shrank by half.
    idle: usize,
    /// The last that was known.
    multiplier: Option<f64>,
    /// The multiplier from the network's own balances; 0 as long as it is not computed.
    frozen: f64,
    /// The cycle integrated last.
    last: Option<Shot>,
    /// The same, if it was not the best.
    astray: Option<Shot>,
    /// Number of these in a row.
    strayed: usize,
    reach: f64,
}

/// The start of the next cycle.
struct Next {
    start: Vec<f64>,
    /// No difference between cycles had a part in it.
    blind: bool,
}

/// The next action after a cycle.
enum Verdict {
    Settled,
    GoOn,
    /// The switches differ from those of the cycle before.
    Switches,
}

impl<'a, 'b> Search<'a, 'b> {
    pub(super) fn new(cycles: &'a mut Cycles<'b>, tolerance: f64) -> Self {
        let bends = !linear(cycles.system);
        let secants = Secants::new(cycles.system.capacity(), bends);
        Self {
            cycles,
            secants,
            tolerance,
            best: None,
            idle: 0,
            multiplier: None,
            frozen: 0.0,
            last: None,
            astray: None,
            strayed: 0,
            reach: REACH,
        }
    }

    pub(super) fn find(mut self, mut start: Vec<f64>) -> Result<Found, PeriodicError> {
        let mut level = first(self.tolerance);
        loop {
            start = self.settle(start, level)?;
            self.remember();
            if level <= self.tolerance && (self.is_good() || level * FINER < FINEST) {
                return self.record(start, level);
            }
            level = finer(level, self.tolerance);
        }
    }

    /// Takes the slowest part of the network from the best state, at two moments of the cycle.
    fn remember(&mut self) {
        let Some(best) = &self.best else { return };
        // it has no memory there, and no balance
        if self.cycles.is_at_bound(&best.end) {
            return;
        }
        let (start, period) = self.cycles.span();
        let times = [start, start + 0.5 * period];
        let slowest = times
            .into_iter()
            .filter_map(|time| memory::slowest(self.cycles.system, time, &best.end));
        self.frozen = slowest.map(|tau| (-period / tau).exp()).fold(self.frozen, f64::max);
        self.multiplier = self.multiplier.map(|rho| rho.max(self.frozen));
    }

    /// True if the best cycle is good enough.
    fn is_good(&self) -> bool {
        let best = self.best.as_ref().map_or(f64::INFINITY, Shot::residual);
        amplified(best, self.multiplier) <= ERROR * self.tolerance
    }

    /// Runs cycles at one tolerance until they settle; returns the best start of the next one.
    fn settle(&mut self, mut start: Vec<f64>, level: f64) -> Result<Vec<f64>, PeriodicError> {
        (self.best, self.idle) = (None, 0);
        (self.astray, self.strayed, self.reach) = (None, 0, REACH);
        loop {
            self.check_count()?;
            let shot = self.shoot(start, level)?;
            let verdict = self.take(shot);
            if let Verdict::Settled = verdict {
                self.astray = None;
            }
            let next = self.next()?;
            match verdict {
                Verdict::Settled => return Ok(next.start),
                Verdict::GoOn if next.blind && self.idle > 0 => {
                    start = next.start.iter().map(|y| y + PROBE).collect();
                    // it is expected to have a larger residual
                    self.strayed = RELAXED;
                }
                Verdict::GoOn => start = next.start,
                Verdict::Switches => {
                    start = self.best.as_ref().map_or(next.start, |shot| shot.end.clone())
                }
            }
        }
    }

    /// Integrates the last cycle with all requested results; if it is not the last, others follow.
    fn record(mut self, mut start: Vec<f64>, level: f64) -> Result<Found, PeriodicError> {
        loop {
            self.check_count()?;
            let (shot, solution) = self.cycles.record(start, level)?;
            let verdict = self.take(shot.clone());
            if matches!(verdict, Verdict::Settled) && shot.residual() <= ERROR * level {
                let error = amplified(shot.residual(), self.multiplier);
                return Ok(Found { shot, solution, multiplier: self.multiplier, error });
            }
            let next = match (verdict, &self.best) {
                (Verdict::Switches, Some(shot)) => shot.end.clone(),
                _ => self.next()?.start,
            };
            start = self.settle(next, level)?;
        }
    }

    fn check_count(&self) -> Result<(), PeriodicError> {
        if self.cycles.count < MOST_CYCLES {
            return Ok(());
        }
        if !self.cycles.repeats {
            return Err(PeriodicError::Switches { cycles: self.cycles.count });
        }
        Err(self.not_found())
    }

    /// The error of a search that ends: the unknown that the last cycle changed most.
    fn not_found(&self) -> PeriodicError {
        let (system, cycles) = (self.cycles.system, self.cycles.count);
        let changes = self.last.iter().flat_map(|shot| shot.start.iter().zip(&shot.end));
        let most = changes.map(|(start, end)| end - start).enumerate();
        let most = most.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let (place, change) = most.unwrap_or((0, f64::NAN));
        let node = system.states()[place];
        let (change, unit) = match system.network().state_at(node) {
            Some(state) => (state.value(change), state.ty.dimension.si_unit()),
            None => (change, "K".to_owned()),
        };
        let name = system.network().nodes()[node.index()].name.clone();
        PeriodicError::NotFound { cycles, name, change, unit }
    }

    /// Integrates a cycle. If it begins at a state that no cycle reached, it may not be solvable:
    /// then it begins at the end of the best one.
    fn shoot(&mut self, start: Vec<f64>, level: f64) -> Result<Shot, PeriodicError> {
        match (self.cycles.shoot(start, level), &self.best) {
            (Err(PeriodicError::Cycle(TransientError::Stopped { .. })), Some(best)) => {
                let end = best.end.clone();
                self.cycles.shoot(end, level)
            }
            (outcome, _) => outcome,
        }
    }

    fn take(&mut self, shot: Shot) -> Verdict {
        let residual = shot.residual();
        self.last = Some(shot.clone());
        let best = self.best.as_ref().map_or(f64::INFINITY, Shot::residual);
        self.idle = if residual < 0.5 * best { 0 } else { self.idle + 1 };
        let noise = ERROR * shot.noise;
        if !self.cycles.repeats {
            // another cycle than before: its differences say nothing about this one
            self.secants.forget();
            (self.best, self.multiplier, self.idle) = (Some(shot), None, 0);
            return Verdict::Switches;
        }
        self.secants.push(shot.clone());
        let (size, least) =
            (self.secants.size(&shot), self.best.as_ref().map(|best| self.secants.size(best)));
        if least.is_none_or(|least| size < least) {
            (self.best, self.astray, self.strayed) = (Some(shot), None, 0);
            self.reach = REACH.min(self.reach / SHORTER);
        } else if least.is_some_and(|least| size > ASTRAY * least) || self.idle > MOST_IDLE {
            self.astray = Some(shot);
        }
        self.multiplier =
            self.secants.multiplier().or(self.multiplier).map(|rho| rho.max(self.frozen));
        let settled = amplified(residual, self.multiplier) <= noise;
        let stuck =
            self.multiplier.is_some() && residual.min(best) <= noise && self.idle >= PATIENCE;
        if (settled || stuck) && self.cycles.same_times { Verdict::Settled } else { Verdict::GoOn }
    }

    /// The start of the next cycle: after the best one, unless the last one may become better by
    /// itself.
    fn next(&mut self) -> Result<Next, PeriodicError> {
        if let Some(last) = self.astray.take() {
            self.strayed += 1;
            if self.strayed <= RELAXED {
                return Ok(Next { start: last.end, blind: false });
            }
            self.strayed = 0;
            self.reach *= SHORTER;
            if self.reach < LEAST_REACH {
                (self.best, self.reach) = (Some(last), REACH);
            }
        }
        let best = self.best.as_ref().ok_or_else(|| self.not_found())?;
        let rho = self.multiplier.unwrap_or(UNKNOWN).min(SLOWEST);
        let next = self.secants.next(best, self.reach * best.residual() / (1.0 - rho));
        if let (Some(start), Some(last)) = (&next, &self.last)
            && self.cycles.leaves_bounds(start)
        {
            // the slopes of the map are others beyond the bound: one cycle as it comes
            return Ok(Next { start: last.end.clone(), blind: false });
        }
        let blind = next.is_none();
        Ok(Next { start: next.unwrap_or_else(|| best.end.clone()), blind })
    }
}

/// True if a cycle maps its start to its end by a matrix and an offset, streams of constant
/// capacity included.
fn linear(system: &ThermalSystem) -> bool {
    let network = system.network();
    let paths = network.conductor_ids().all(|id| {
        matches!(network.flow(id), ConductorFlow::Conductance(_) | ConductorFlow::Stream(_))
    });
    let sources = network.source_ids().all(|id| network.source_variables(id).is_empty());
    !network.has_events() && paths && sources && network.first_varying_capacity().is_none()
}

/// Sum of a residual and the rounding of a temperature if all of it decays as slowly as the slowest
/// part; infinite if that is not known or does not decay.
fn amplified(residual: f64, multiplier: Option<f64>) -> f64 {
    match multiplier {
        Some(rho) if rho < 1.0 => (residual + ROUNDING) / (1.0 - rho),
        _ => f64::INFINITY,
    }
}

/// The tolerance that a search begins with.
fn first(tolerance: f64) -> f64 {
    if COARSEST > NEAR * tolerance { COARSEST } else { tolerance }
}

/// The tolerance after another.
fn finer(level: f64, tolerance: f64) -> f64 {
    let next = level * FINER;
    if level > tolerance && next <= NEAR * tolerance { tolerance } else { next }
}

#[cfg(test)]
mod tests {
    use super::{finer, first};

    #[test]
    fn the_tolerances_meet_the_one_asked_for() {
        for tolerance in [1e-2, 1e-3, 1e-5, 1e-7, 1e-8, 3e-9] {
            let mut level = first(tolerance);
            while level > tolerance {
                level = finer(level, tolerance);
            }
            assert!((level - tolerance).abs() <= 0.0, "{tolerance}");
        }
        assert!((finer(1e-5, 1e-5) - 1e-7).abs() < 1e-20);
    }
}
