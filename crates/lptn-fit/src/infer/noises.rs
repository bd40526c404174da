//! Noise of each column if it is not given: the one that makes the record most likely.
//!
//! A thermocouple that follows the air of a hall, or an amplifier that filters, reads two
//! neighbours too high together. If such noise is taken for white, the time history walks: 2 s of
//! it made a constant power of 223 W wander by 50 W.
//!
//! The slow part of the noise of a column is an additional state. It comes after the states that
//! the network moves, so that none of their transitions grows. It is searched together with the
//! random walks, from several starts in which both differ. A walk that is strong enough absorbs
//! slow noise, looks white, and is a point from which no small step leads away.
//!
//! Noise slower than a tenth of the record is not searched. It bends like the time history and
//! hardly moves it. Its strength and time are not mixed over as those of walks are, because
//! thousands of readings determine them.

use crate::infer::guess::with;
use crate::infer::search::Open;
use crate::infer::strength::{Noise, Strength};
use crate::infer::task::Drift;
use crate::simplex;

/// Gain in log-likelihood that a slow part must have.
const WORTH: f64 = 4.0;

/// A slow part is kept at once if its gain is this many times `WORTH`.
const FAR: f64 = 10.0;

/// The first time that is tried, in distances of rows, and the factor to the next.
const SHORTEST: f64 = 1.5;
const LONGER: f64 = 4.0;

/// The longest time, as a part of the record: slower noise bends like the time history.
const LONGEST: f64 = 0.1;

/// Shares of the variance that are tried.
const PARTS: [f64; 2] = [0.5, 0.95];

/// The share is searched as its log-odds, up to this limit.
const SURE: f64 = 9.0;

/// Distance of the first corners of the search.
const APART: f64 = 0.5;

/// Unknowns of the noise of a column: logarithms and log-odds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unsaid {
    /// Its white part.
    White,
    /// Share of its slow part, and how slow it is.
    Drift,
    /// The whole of it, and those of its slow part.
    All,
}

impl Unsaid {
    /// The unknowns as numbers of order 1.
    fn numbers(self, noise: &Noise) -> Vec<f64> {
        let part = (noise.drift / noise.whole()).powi(2);
        let odds = (part / (1.0 - part)).ln().clamp(-SURE, SURE);
        match self {
            Self::White => vec![noise.white.ln()],
            Self::Drift => vec![odds, noise.time.ln()],
            Self::All => vec![odds, noise.time.ln(), noise.whole().ln()],
        }
    }

    fn noise(self, own: &Noise, numbers: &[f64], times: (f64, f64)) -> Noise {
        if self == Self::White {
            return Noise { white: numbers[0].exp(), ..*own };
        }
        let part = 1.0 / (1.0 + (-numbers[0].clamp(-SURE, SURE)).exp());
        let whole = numbers.get(2).map_or_else(|| own.whole(), |x| x.exp());
        Noise::split(whole, part, numbers[1].exp().clamp(times.0, times.1))
    }
}

impl Open<'_> {
    fn likely(&self, strength: &Strength) -> f64 {
        self.model.log_likelihood(strength)
    }

    /// Unknowns of the noise of a column that has a slow part or has none.
    fn unsaid(&self, column: usize, noise: &Noise) -> Option<Unsaid> {
        let sigma = self.task.run.columns[column].sigma.is_some();
        let slow = noise.drift > 0.0 && self.task.drift == Drift::Open;
        match (sigma, slow) {
            (true, false) => None,
            (false, false) => Some(Unsaid::White),
            (true, true) => Some(Unsaid::Drift),
            (false, true) => Some(Unsaid::All),
        }
    }

    /// Finds the most likely noise of one column after the other.
    pub(crate) fn noised(&self, found: Strength) -> Strength {
        self.with_noises(found, |_| true)
    }

    /// Finds the most likely noise of those that are white.
    pub(crate) fn whitened(&self, found: Strength) -> Strength {
        self.with_noises(found, |unsaid| unsaid == Unsaid::White)
    }

    fn with_noises(&self, mut found: Strength, those: impl Fn(Unsaid) -> bool) -> Strength {
        for column in 0..found.noises.len() {
            let own = found.noises[column];
            let unsaid = self.unsaid(column, &own).filter(|unsaid| those(*unsaid));
            let Some(unsaid) = unsaid else { continue };
            let there = |numbers: &[f64]| {
                let mut there = found.clone();
                there.noises[column] = unsaid.noise(&own, numbers, self.times());
                there
            };
            let lack = |numbers: &[f64]| -self.likely(&there(numbers));
            let best = simplex::minimum(lack, &unsaid.numbers(&own), APART);
            found = there(&best);
        }
        found
    }

    /// The shortest and longest time of a slow part.
    fn times(&self) -> (f64, f64) {
        let length = self.model.length();
        let rows = (self.model.times.len() - 1) as f64;
        (0.1 * length / rows, LONGEST * length)
    }

    /// Adds a slow part to the noise of each column if it makes the record more likely; the walks
    /// are then weaker.
    pub(crate) fn drifted(&self, white: Strength) -> Strength {
        if self.task.drift != Drift::Open || self.model.states.drifts.is_empty() {
            return white;
        }
        let (_, longest) = self.times();
        let shortest = SHORTEST * self.model.length() / (self.model.times.len() - 1) as f64;
        let times = std::iter::successors(Some(shortest), |time| Some(LONGER * time));
        let starts = times.take_while(|time| *time <= longest);
        let starts = starts.flat_map(|time| PARTS.map(|part| self.slow((part, time))));
        let best = starts.map(|start| self.roughly(&start)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, best)) = best else { return white };
        let found = self.needed_drifts(self.in_turns(best));
        let count = found.noises.iter().filter(|noise| noise.drift > 0.0).count();
        let worth = self.likely(&found) - WORTH * count as f64;
        if worth > self.likely(&white) { found } else { white }
    }

    /// The guess in which the noise of every column that may have one has this slow part.
    fn slow(&self, drift: (f64, f64)) -> Strength {
        let mut start = Strength::guess(self.task, self.model);
        for &column in &self.model.states.drifts {
            start.noises[column] = with(self.task, column, drift);
        }
        start
    }

    /// Removes the slow parts that are not worth it in addition to the others.
    pub(crate) fn needed_drifts(&self, mut found: Strength) -> Strength {
        for column in 0..found.noises.len() {
            if found.noises[column].drift <= 0.0 || self.task.drift != Drift::Open {
                continue;
            }
            let mut white = found.clone();
            white.noises[column] = with(self.task, column, (0.0, 1.0));
            let (white, likely) = (self.whitened(white), self.likely(&found));
            if self.likely(&white) < likely - FAR * WORTH {
                continue;
            }
            let white = self.in_turns(white);
            if self.likely(&white) > likely - WORTH {
                found = white;
            }
        }
        found
    }
}
