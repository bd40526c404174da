//! The largest error over every load.
//!
//! Both networks end at the same rise. The L1 norm of the error's impulse response is therefore the
//! variation of the step's error, and the worst load switches when that turns. The signs of the
//! terms bound the number of turns (`exponentials.rs`). Turns are counted, not sampled; the rest
//! that could be hidden is bounded and added.

use lptn_network::Foster;

use crate::exponentials::Exponentials;
use crate::step::StepResponse;

/// The largest error at a port for all powers into it between 0 and 1 W, from rest.
///
/// With the powers P(t) the error is the convolution of P with the impulse response e of the error.
/// For powers between 0 and `P_max` it is largest, at the time T, if P is `P_max` while `e(T - t)`
/// is positive and 0 else: `P_max` times the integral of e's positive part, and as much below zero
/// for the other half of the times. The two are equal, each half of the L1 norm of e, because the
/// whole integral of e is 0: both networks end at the same rise (S. Boyd, C. Barratt, Linear
/// Controller Design (1991), section 5.1.1, for powers between -1 and 1: the whole norm).
///
/// The integral over e is the step's error E, so the positive part is the sum of all rises of E,
/// and the load switches when E turns.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstCase {
    /// The error in K for each W of the largest power, reached by the load of [`WorstCase::load`].
    pub kelvin: f64,
    /// Upper bound of a further error in K/W, in turns of E too close to be found; 0 if there are
    /// none.
    pub missed: f64,
    /// Times at which the step's error turns, in s.
    pub turns: Vec<f64>,
    curve: Exponentials,
}

/// A stretch of a load: its start in s, and whether the power is on from there.
pub type Stretch = (f64, bool);

impl WorstCase {
    /// The largest error of a step of 1 W in K, with its sign: negative if the reduced network
    /// reads too cold.
    pub fn step(&self) -> f64 {
        let levels = [0.0].iter().chain(&self.turns).map(|&time| self.curve.value(time));
        levels.fold(0.0, |most: f64, level| if level.abs() > most.abs() { level } else { most })
    }

    /// Error of a few exponentials against a step response; the immediate rise is the same in both.
    pub(crate) fn new(step: &StepResponse, few: &Foster) -> Self {
        let network = step.terms.iter().map(|term| (term.resistance, term.tau));
        let model = few.terms.iter().map(|&(resistance, tau)| (-resistance, tau));
        let curve = Exponentials::new(network.chain(model));
        let found = curve.variation();
        Self { kelvin: found.rises, missed: found.missed, turns: found.turns, curve }
    }

    /// Upper bound of the error in K/W.
    pub fn most(&self) -> f64 {
        self.kelvin + self.missed
    }

    /// The load at whose end the reduced network reads too cold by [`WorstCase::kelvin`], to 1e-4
    /// of that, with its end in s. It is on while the one that reads too warm is off.
    pub fn load(&self) -> (Vec<Stretch>, f64) {
        let edges: Vec<f64> = [0.0].into_iter().chain(self.turns.iter().copied()).collect();
        // the age of the heat counts: on while E falls, from the oldest to now
        let levels: Vec<f64> = edges.iter().map(|&age| self.curve.value(age)).collect();
        let falls = |k: usize| levels.get(k + 1).copied().unwrap_or(0.0) < levels[k];
        let last = edges.len() - 1;
        let end = if falls(last) { self.settled(edges[last]) } else { edges[last] };
        let mut stretches: Vec<Stretch> = Vec::new();
        if end > edges[last] {
            stretches.push((0.0, falls(last)));
        }
        stretches.extend((0..last).rev().map(|k| (end - edges[k + 1], falls(k))));
        (stretches, end)
    }

    /// An age beyond which almost no error is left.
    fn settled(&self, from: f64) -> f64 {
        let mut age = 2.0 * from.max(f64::MIN_POSITIVE);
        while self.curve.value(age).abs() > 1e-5 * self.kelvin {
            age *= 1.2;
        }
        age
    }
}
