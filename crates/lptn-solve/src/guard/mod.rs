//! Laws that depend on temperature are checked after each step and before the next.
//!
//! The integrator sees a law at the ends of its steps. A peak of a table over temperature that has
//! passed by the end of a step was never evaluated, and a kink inside a step leaves an error that
//! the integrator underestimates. So, as with inputs that curve over time (`curved.rs`),
//!
//! - no step carries the variables of an expression past a point where it turns (`turns.rs`),
//!   and
//! - if the heat bends within a step by more than the tolerance allows, the run goes back to the
//!   start of the step, ends a step at the kink and restarts there (`corners.rs`).
//!
//! Networks without tables, kinks and functions that turn have no guard.
//!
//! After a step, the pieces of tables, kinks and laws of each element are compared; `Traced`
//! numbers carry them. The law itself is evaluated, not its indicator functions, so that kinks in
//! Rust and in expressions are found alike. Before a step, enclosures determine where an expression
//! of temperatures turns. The run goes back only if fourth differences of the heat show a bend
//! beyond a quarter of the tolerance.

mod corners;
mod errors;
mod turns;

use lptn_assembly::ThermalSystem;
use lptn_integrate::{Integrator, OdeSystem, Step};

use crate::heat::Heat;
use corners::Corners;
use errors::Errors;
use turns::Turns;

/// An integrator on the way.
pub(crate) type Stepping<'a> = dyn Integrator<Heat<'a>> + 'a;

/// Most steps that are taken back before the time moves on.
const ATTEMPTS: usize = 40;

/// Steps are not limited to less than this share of the time.
const ROUNDING: f64 = 512.0 * f64::EPSILON;

/// Growth of a limited step from one to the next.
const GROWTH: f64 = 1.5;

/// The part of a step over which the rates at its end are taken, if something turns within `NEAR`
/// steps.
const END: f64 = 0.05;
const NEAR: f64 = 4.0;

/// A guard of laws that depend on temperature.
pub(crate) struct Guard {
    corners: Corners,
    turns: Turns,
    errors: Option<Errors>,
    /// True if the error of a state may grow by itself.
    grow: bool,
    /// Temperatures of all vertices at the start of the next step in K, and their rates in K/s.
    now: Vec<f64>,
    rates: Vec<f64>,
    /// Latest end of the next step in s, because a kink is there.
    kink: f64,
    /// Longest next step in s.
    longest: f64,
    /// True if the integrator has restarted there.
    fresh: bool,
    /// Length of the last step in s; 0 if there is none.
    last: f64,
    attempts: usize,
    /// The first time in s at which a step was accepted that should have been taken back.
    unresolved: Option<f64>,
}

/// Verdict on a step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Verdict {
    /// It is accepted.
    Stands,
    /// It is accepted, and the integrator has to restart at its end.
    BeginsAnew,
    /// It has to be taken back.
    Back,
}

impl Guard {
    /// `None` if nothing in the network needs it. `tolerance` is that of the integrator in K.
    pub(crate) fn of(system: &ThermalSystem, tolerance: f64) -> Option<Self> {
        let (corners, turns) = (Corners::of(system, tolerance), Turns::of(system));
        let needed = !(corners.are_none() && turns.are_none());
        let vertices = system.network().nodes().len() + system.network().boundaries().len();
        needed.then(|| Self {
            corners,
            turns,
            errors: None,
            grow: Errors::may_grow(system),
            now: vec![f64::NAN; vertices],
            rates: vec![0.0; vertices],
            kink: f64::INFINITY,
            longest: f64::INFINITY,
            fresh: true,
            last: 0.0,
            attempts: 0,
            unresolved: None,
        })
    }

    /// Evaluates the state in which the integrator starts or restarts.
    pub(crate) fn begin(&mut self, integrator: &mut Stepping<'_>) {
        let (time, state) = (integrator.time(), integrator.state().to_vec());
        self.fresh = true;
        self.last = 0.0;
        if self.kink <= time {
            self.kink = f64::INFINITY;
        }
        let heat = integrator.system_mut();
        self.rates.fill(0.0);
        if !self.turns.are_none() {
            heat.rates(time, &state, &mut self.rates);
        }
        if let Some(temperatures) = heat.look(time, &state) {
            self.now.copy_from_slice(temperatures);
            self.corners.begin(heat);
            // for a single state its speed suffices
            if self.grow && heat.pattern().size() > 1 {
                self.errors.get_or_insert_with(|| Errors::of(heat)).step(heat);
            }
        }
    }

    /// Latest end of the next step in s.
    pub(crate) fn end_of_step(&mut self, integrator: &mut Stepping<'_>) -> f64 {
        let time = integrator.time();
        let mut longest = self.longest;
        if !self.turns.are_none() {
            let course = turns::Course { now: &self.now, rates: &self.rates, last: self.last };
            let scope = integrator.system_mut().scope();
            longest = longest.min(self.turns.longest(course, scope));
        }
        // the integrator treats a stop that is nearer than its own rounding as reached
        self.kink.min(time + longest).max(time + ROUNDING * time.abs())
    }

    /// True if something was so narrow that steps would have passed it whole.
    pub(crate) fn met_narrow(&self) -> bool {
        self.turns.were_narrow()
    }

    /// The largest growth of the error of a single state.
    pub(crate) fn grown(&self) -> f64 {
        self.errors.as_ref().map_or(1.0, Errors::most)
    }

    /// The time in s at which the guard first gave up on a step.
    pub(crate) fn unresolved(&self) -> Option<f64> {
        self.unresolved
    }

    /// Verdict on the step that was taken last.
    pub(crate) fn judge(&mut self, integrator: &mut Stepping<'_>, step: &Step) -> Verdict {
        let length = step.to - step.from;
        let state = integrator.state().to_vec();
        let Some(after) = integrator.system_mut().look(step.to, &state).map(<[f64]>::to_vec) else {
            return Verdict::Stands;
        };
        let patient = self.attempts < ATTEMPTS;
        let passed = self.turns.passed([&self.now, &after]);
        if let Some(share) = passed.filter(|_| patient) {
            self.longest = share * length;
            self.attempts += 1;
            return Verdict::Back;
        }
        let bend = self.corners.bend(integrator, step, ([&self.now, &after], self.fresh));
        if !patient && (passed.is_some() || matches!(bend, Some(corners::Bend::In { .. }))) {
            self.unresolved.get_or_insert(step.from);
        }
        let mut verdict = Verdict::Stands;
        match bend.filter(|_| patient) {
            Some(corners::Bend::In { kink, longest }) => {
                (self.kink, self.longest) = (self.kink.min(kink), longest.min(self.longest));
                self.attempts += 1;
                return Verdict::Back;
            }
            Some(corners::Bend::Behind) => verdict = Verdict::BeginsAnew,
            None => {}
        }
        if step.to >= self.kink {
            self.kink = f64::INFINITY;
            verdict = Verdict::BeginsAnew;
        }
        self.follow_errors(integrator, step, &after);
        self.goes_on(integrator, step, after);
        verdict
    }

    fn follow_errors(&mut self, integrator: &mut Stepping<'_>, step: &Step, after: &[f64]) {
        let Some(errors) = &mut self.errors else { return };
        let why = [!self.turns.are_none(), self.corners.has_changed()];
        let asks = errors.goes_on([&self.now, after], (step.to - step.from, why));
        let state = integrator.state().to_vec();
        let heat = integrator.system_mut();
        if asks && heat.look(step.to, &state).is_some() {
            errors.step(heat);
        }
    }

    fn goes_on(&mut self, integrator: &mut Stepping<'_>, step: &Step, after: Vec<f64>) {
        let length = step.to - step.from;
        if !self.turns.are_none() && length > 0.0 {
            self.take_rates([&self.now.clone(), &after], length);
            let course = turns::Course { now: &after, rates: &self.rates, last: length };
            let scope = integrator.system_mut().scope();
            if self.turns.longest(course, scope) < NEAR * length {
                self.take_rates_at_end(integrator, step, &after);
            }
        }
        self.now = after;
        self.corners.accept();
        (self.fresh, self.last) = (false, length);
        // steps that do not move the time are not a way through
        if length > 2.0 * ROUNDING * step.to.abs() {
            self.attempts = 0;
        }
        self.longest *= GROWTH;
    }

    fn take_rates(&mut self, [before, after]: [&[f64]; 2], way: f64) {
        let changes = after.iter().zip(before).map(|(after, before)| (after - before) / way);
        self.rates.iter_mut().zip(changes).for_each(|(rate, change)| *rate = change);
    }

    fn take_rates_at_end(&mut self, integrator: &mut Stepping<'_>, step: &Step, after: &[f64]) {
        let time = step.to - END * (step.to - step.from);
        let mut state = integrator.state().to_vec();
        if !(step.from..step.to).contains(&time)
            || integrator.interpolate(time, &mut state).is_err()
        {
            return;
        }
        let before = integrator.system_mut().look(time, &state).map(<[f64]>::to_vec);
        if let Some(before) = before {
            self.take_rates([&before, after], step.to - time);
        }
    }
}

#[cfg(test)]
mod tests;
