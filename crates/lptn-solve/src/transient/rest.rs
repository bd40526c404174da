//! Steady state that a network reaches from its start while its inputs are fixed.
//!
//! Newton's method finds one of several steady states, not the one that the network reaches. The
//! integrator follows the network with its capacities, folds and switches; its steps grow as it
//! settles, so that this costs little more than the way itself.

use lptn_assembly::ThermalSystem;
use lptn_network::{OutputTimes, Positions};

use crate::newton::{Newton, largest};
use crate::readings::Readings;
use crate::recorder::Recorder;
use crate::selection::RecordedNodes;
use crate::settings::Transient;
use crate::standing::{self, is_counter};
use crate::state::State;
use crate::times::{Segment, just_after};
use crate::transient::{Care, Effort, Run};

/// Tolerance in K of a first attempt: it decides which way the network goes, not its exact rest.
pub(crate) const ROUGH: f64 = 1e-4;

/// The same if there are several ways.
pub(crate) const FINE: f64 = 1e-8;

/// Longer than any network takes, in s.
const FOR_EVER: f64 = 1e12;

/// The most steps.
const STEPS: usize = 20_000;

/// The most switches: a network with more does not come to rest.
const SWITCHES: usize = 100;

/// A step that moves no node by more than this, in K, may be one of the last.
const SLOW: f64 = 0.1;

/// At this distance from a stable state, in K, a network goes there.
const NEAR: f64 = 1e-3;

/// Largest distance between the last temperatures of the network and its rest, in K.
pub(crate) const MOVED: f64 = 0.01;

/// Steps between two checks for rest.
const EVERY: usize = 4;

/// No more of it: see [`Care::Way`].
const EFFORT: Effort = Effort { care: Care::Way, grows: 1.0 };

/// Temperatures and positions of a network.
pub(crate) struct Rest {
    /// Temperatures of all unknowns in K.
    pub(crate) temperatures: Vec<f64>,
    /// Controls that are on and comparisons that are true.
    pub(crate) positions: Positions,
}

/// End of following a network.
pub(crate) enum Way {
    /// It rests.
    Rests(Rest),
    /// It moves on and could not be followed further than this.
    Left(Rest),
    /// It cannot be followed, or does not settle.
    Lost,
}

/// Follows a network from its start with its inputs as they are at `time` in s, to a tolerance in K.
pub(crate) fn rest(system: &ThermalSystem, time: f64, tolerance: f64) -> Way {
    // a usual change of a state is 8 times as many K as one with a balance, or of a temperature
    let rates = system.network().states().iter().any(|state| !state.balanced);
    let tolerance = if rates { tolerance / 8.0 } else { tolerance };
    followed(system, time, tolerance).unwrap_or(Way::Lost)
}

fn followed(system: &ThermalSystem, time: f64, tolerance: f64) -> Option<Way> {
    let (segment, mut run) = Run::held(system, time, tolerance)?;
    run.begin(segment, true).ok()?;
    let mut before = run.unknowns()?;
    for step in 1..=STEPS {
        let stepped = run.step(segment).is_ok();
        if run.switching.as_ref().is_some_and(|switching| switching.events.len() > SWITCHES) {
            return None;
        }
        let Some(now) = run.unknowns().filter(|_| stepped) else {
            return Some(Way::Left(run.at(before)));
        };
        let moved = now.iter().zip(&before).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        before = now;
        let over = run.integrator.time() >= segment.to;
        let rests = match over {
            true => moved <= NEAR,
            false => step % EVERY == 0 && moved <= SLOW && run.rests(system, &before)?,
        };
        if rests {
            return Some(Way::Rests(run.at(before)));
        }
        if over {
            return Some(Way::Left(run.at(before)));
        }
    }
    None
}

impl<'a> Run<'a> {
    /// A run that writes nothing and has the inputs of one time without end, with its one segment.
    fn held(system: &'a ThermalSystem, time: f64, tolerance: f64) -> Option<(Segment, Self)> {
        let segment = Segment { from: time, to: time + FOR_EVER };
        let settings = Transient {
            start: segment.from,
            stop: segment.to,
            output: OutputTimes::At(vec![segment.to]),
            tolerance,
            record: RecordedNodes::Nodes(Vec::new()),
            ..Transient::until(lptn_network::Time(segment.to))
        };
        let mut recorder =
            Recorder::new(system, (settings.rows().ok()?, Readings::none(segment)), &settings)
                .ok()?;
        recorder.idle = true;
        let mut run =
            Self::new(recorder, (&[segment], None), (&settings, EFFORT), &State::initial(system))
                .ok()?;
        run.integrator.system_mut().held = Some((time, just_after(time)));
        Some((segment, run))
    }

    fn at(self, temperatures: Vec<f64>) -> Rest {
        let positions = self.switching.map(|switching| switching.positions);
        Rest { temperatures, positions: positions.unwrap_or_default() }
    }

    /// Temperatures of all unknowns in K.
    pub(super) fn unknowns(&mut self) -> Option<Vec<f64>> {
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        self.integrator
            .system_mut()
            .temperatures(time, &state)
            .ok()
            .map(|(temperatures, _)| temperatures.to_vec())
            .map(|temperatures| self.without_counters(temperatures))
    }

    /// The same with the states that count fluid at their start: they go on without end.
    fn without_counters(&self, mut temperatures: Vec<f64>) -> Vec<f64> {
        let system = self.recorder.system();
        for unknown in (0..system.states().len()).filter(|i| is_counter(system, *i)) {
            temperatures[unknown] = system.network().initial(system.unknowns()[unknown]);
        }
        temperatures
    }

    /// True if it is so near to a stable state that it goes there.
    fn rests(&mut self, system: &ThermalSystem, temperatures: &[f64]) -> Option<bool> {
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let (_, work) = self.integrator.system_mut().temperatures(time, &state).ok()?;
        let Ok(free) = standing::free(system, work, temperatures) else { return Some(false) };
        let mut newton = Newton::new(system, free).ok()?;
        let near = newton
            .factorize(work, temperatures, 0.0)
            .and_then(|()| newton.correction(work, temperatures))
            .is_ok_and(|correction| largest(&correction) <= NEAR);
        if !near || !matches!(newton.unstable(work, temperatures), Ok(None)) {
            return Some(false);
        }
        // near the end of two steady states that meet a network all but rests, and goes on
        let mut found = temperatures.to_vec();
        let solved = newton.damped(work, &mut found).is_ok();
        let there = solved && newton.moved(temperatures, &found) <= MOVED;
        Some(there && matches!(newton.unstable(work, &found), Ok(None)))
    }
}

#[cfg(test)]
mod tests;
