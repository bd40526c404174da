//! Progress of a long run, on a terminal.

use std::fmt::Display;
use std::io::{IsTerminal as _, Write as _};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use lptn_report::duration;
use lptn_solve::Progress;

/// A run shorter than this needs no progress.
const PATIENCE: Duration = Duration::from_secs(1);

const EVERY: Duration = Duration::from_millis(100);

/// Letters that are written over.
const WIDTH: usize = 60;

/// One line of stderr that is written over and over.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    wanted: bool,
    due: Instant,
    shown: bool,
}

impl ProgressLine {
    pub(crate) fn new(quiet: bool) -> Self {
        let wanted = !quiet && std::io::stderr().is_terminal();
        Self { wanted, due: Instant::now() + PATIENCE, shown: false }
    }

    /// Shows how far a run is.
    pub(crate) fn update(&mut self, progress: Progress) {
        self.show(|| run(progress));
    }

    /// The same, of one of several runs.
    pub(crate) fn update_of(&mut self, which: &dyn Display, progress: Progress) {
        self.show(|| format!("{which}: {}", run(progress)));
    }

    /// Shows how many of several things are done, how fast they come, and the remaining time.
    /// `before` of them existed when it began, at `begun`.
    pub(crate) fn update_count(
        &mut self,
        (done, of, noun): (u64, u64, &str),
        (before, begun): (u64, Instant),
    ) {
        self.show(|| {
            let rate = (done - before) as f64 / begun.elapsed().as_secs_f64().max(1e-3);
            let left = duration((of - done) as f64 / rate.max(1e-9), 2);
            let share = 100.0 * done as f64 / of.max(1) as f64;
            format!("{share:5.1} %  {done} of {of} {noun}, {rate:.0} a second, {left} left")
        });
    }

    /// Shows how many of several things are done.
    pub(crate) fn update_parts(&mut self, done: usize, all: usize, noun: &str) {
        let share = 100.0 * done as f64 / all.max(1) as f64;
        self.show(|| format!("{share:5.1} %  {done} of {all} {noun}"));
    }

    fn show(&mut self, text: impl FnOnce() -> String) {
        if !self.wanted || Instant::now() < self.due {
            return;
        }
        self.due = Instant::now() + EVERY;
        self.shown = true;
        self.overwrite(&format!("{:<WIDTH$}", text()));
    }

    /// Clears the line for the next output.
    pub(crate) fn clear(&mut self) {
        if self.shown {
            self.overwrite(&" ".repeat(WIDTH));
            self.shown = false;
        }
    }

    fn overwrite(&self, text: &str) {
        let mut stderr = std::io::stderr();
        drop(write!(stderr, "\r{text}\r").and_then(|()| stderr.flush()));
    }
}

fn run(progress: Progress) -> String {
    let Progress { time, stop, .. } = progress;
    format!("{:5.1} %  {} of {}", 100.0 * share(progress), duration(time, 3), duration(stop, 3))
}

fn share(Progress { start, time, stop }: Progress) -> f64 {
    (time - start) / (stop - start)
}

/// Progress of several simultaneous runs.
#[derive(Debug)]
pub(crate) struct ProgressOfAll {
    /// The line, and the part of each run that is done.
    state: Mutex<(ProgressLine, Vec<f64>)>,
    wanted: bool,
    /// The noun for them, in the plural.
    noun: &'static str,
}

impl ProgressOfAll {
    pub(crate) fn new(quiet: bool, runs: usize, noun: &'static str) -> Self {
        let line = ProgressLine::new(quiet);
        let wanted = line.wanted;
        Self { state: Mutex::new((line, vec![0.0; runs])), wanted, noun }
    }

    /// Takes the progress of one run. It never waits for another one: the next step says more.
    pub(crate) fn update(&self, run: usize, progress: Progress) {
        if !self.wanted {
            return;
        }
        let Ok(mut state) = self.state.try_lock() else { return };
        let (line, parts) = &mut *state;
        parts[run] = share(progress);
        line.show(|| how_far(parts, self.noun));
    }

    /// One run is over, however it ended.
    pub(crate) fn finished(&self, run: usize) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let (line, parts) = &mut *state;
        parts[run] = 1.0;
        line.show(|| how_far(parts, self.noun));
    }

    /// Clears the line for the next output.
    pub(crate) fn clear(&self) {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).0.clear();
    }
}

fn how_far(parts: &[f64], noun: &str) -> String {
    let done = parts.iter().filter(|part| **part >= 1.0).count();
    let all: f64 = parts.iter().sum::<f64>() / parts.len() as f64;
    format!("{:5.1} %  {done} of {} {noun}", 100.0 * all, parts.len())
}
