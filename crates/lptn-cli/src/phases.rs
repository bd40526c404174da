//! How long the parts of a command took.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use lptn_report::{WIDTH, duration, labelled};

/// Wall times of the parts by their names, in the order in which they were done first.
#[derive(Debug, Default)]
pub(crate) struct Phases(Mutex<Vec<(&'static str, Duration)>>);

impl Phases {
    /// Does a part, and counts its time.
    pub(crate) fn timed<T>(&self, name: &'static str, part: impl FnOnce() -> T) -> T {
        let begun = Instant::now();
        let done = part();
        let took = begun.elapsed();
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match known.iter_mut().find(|(other, _)| *other == name) {
            Some((_, sum)) => *sum += took,
            None => known.push((name, took)),
        }
        done
    }

    /// What is known so far, in s.
    pub(crate) fn seconds(&self) -> Vec<(&'static str, f64)> {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.iter().map(|(name, took)| (*name, took.as_secs_f64())).collect()
    }

    /// The same as a message.
    pub(crate) fn text(&self) -> String {
        let mut pieces: Vec<String> = self
            .seconds()
            .iter()
            .map(|(name, seconds)| format!("{name} {},", duration(*seconds, 2)))
            .collect();
        if let Some(last) = pieces.last_mut() {
            last.pop();
        }
        labelled("time   ", &pieces, WIDTH).join("\n")
    }
}
