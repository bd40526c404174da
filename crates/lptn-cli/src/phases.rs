//! Durations of the parts of a command.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use lptn_report::{WIDTH, duration, labelled};

/// Wall times of the parts in s, by their names, in the order in which they were done first.
#[derive(Debug, Default)]
pub(crate) struct Phases(Mutex<Vec<(&'static str, f64)>>);

impl Phases {
    /// Does a part, and counts its time.
    pub(crate) fn timed<T>(&self, name: &'static str, part: impl FnOnce() -> T) -> T {
        let begun = Instant::now();
        let done = part();
        self.add(name, begun.elapsed().as_secs_f64());
        done
    }

    /// Counts the time of a part, in s.
    pub(crate) fn add(&self, name: &'static str, took: f64) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match known.iter_mut().find(|(other, _)| *other == name) {
            Some((_, sum)) => *sum += took,
            None => known.push((name, took)),
        }
    }

    /// The times up to now, in s.
    pub(crate) fn seconds(&self) -> Vec<(&'static str, f64)> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
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
