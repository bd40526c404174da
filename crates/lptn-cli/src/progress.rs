//! How far a long run is, on a terminal.

use std::io::{IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

use lptn_report::duration;
use lptn_solve::Progress;

/// A run shorter than this needs no progress.
const PATIENCE: Duration = Duration::from_secs(1);

const EVERY: Duration = Duration::from_millis(100);

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

    pub(crate) fn update(&mut self, progress: Progress) {
        if !self.wanted || Instant::now() < self.due {
            return;
        }
        self.due = Instant::now() + EVERY;
        self.shown = true;
        let Progress { start, time, stop } = progress;
        let share = 100.0 * (time - start) / (stop - start);
        let text = format!("{share:5.1} %  {} of {}", duration(time, 3), duration(stop, 3));
        self.overwrite(&format!("{text:<40}"));
    }

    /// Leaves the line empty for what comes next.
    pub(crate) fn clear(&mut self) {
        if self.shown {
            self.overwrite(&" ".repeat(40));
            self.shown = false;
        }
    }

    fn overwrite(&self, text: &str) {
        let mut stderr = std::io::stderr();
        drop(write!(stderr, "\r{text}\r").and_then(|()| stderr.flush()));
    }
}
