//! The console as a listener: doubts to stderr, progress on a line, Ctrl-C ends runs.

use std::fmt::Display;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Instant;

use lptn_answer::listener::{Listener, Which};
use lptn_netlist::{Diagnostic, Files};
use lptn_solve::{Proceed, Progress};

use crate::console::Console;
use crate::interrupt::Interrupt;
use crate::progress::{ProgressLine, ProgressOfAll};

/// A console that listens for Ctrl-C once something begins that may be interrupted.
/// Before that Ctrl-C ends the program.
#[derive(Debug)]
pub(crate) struct Listening<'a> {
    console: &'a Console,
    interrupt: OnceLock<Interrupt>,
    line: Mutex<ProgressLine>,
    /// Progress of several runs, once one of them reports.
    several: OnceLock<ProgressOfAll>,
    begun: Instant,
}

impl Console {
    /// Begins to listen.
    pub(crate) fn listening(&self) -> Listening<'_> {
        let line = Mutex::new(ProgressLine::new(self.quiet));
        let begun = Instant::now();
        let (interrupt, several) = (OnceLock::new(), OnceLock::new());
        Listening { console: self, interrupt, line, several, begun }
    }
}

impl Listening<'_> {
    fn line(&self) -> std::sync::MutexGuard<'_, ProgressLine> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn several(&self, Which { all, noun, .. }: Which) -> &ProgressOfAll {
        self.several.get_or_init(|| ProgressOfAll::new(self.console.quiet, all, noun))
    }

    /// Shows the progress, unless another thread does, and returns whether to continue.
    fn shown(&self, update: impl FnOnce(&mut ProgressLine)) -> Proceed {
        if let Ok(mut line) = self.line.try_lock() {
            update(&mut line);
        }
        self.proceed()
    }
}

impl Listener for Listening<'_> {
    fn warn(&self, files: &Files, doubts: &[Diagnostic]) {
        // doubts come in advance if a long answer begins
        let _ = self.proceed();
        self.line().clear();
        self.console.warn_early(files, doubts);
    }

    fn note(&self, text: &str) {
        self.line().clear();
        self.console.note(text);
    }

    fn begin(&self) {
        self.interrupt.get_or_init(Interrupt::listen);
    }

    fn proceed(&self) -> Proceed {
        self.interrupt.get_or_init(Interrupt::listen).control()
    }

    fn progress(&self, progress: Progress) -> Proceed {
        self.shown(|line| line.update(progress))
    }

    fn progress_of(&self, which: Which, progress: Progress) -> Proceed {
        self.several(which).update(which.number, progress);
        self.proceed()
    }

    fn finished(&self, which: Which) {
        self.several(which).finished(which.number);
    }

    fn counted(&self, done: usize, all: usize, noun: &'static str) {
        self.line().update_parts(done, all, noun);
    }

    fn rate(&self, count: (u64, u64, &'static str), before: u64) {
        self.line().update_count(count, (before, self.begun));
    }

    fn took(&self, part: &'static str, seconds: f64) {
        self.console.phases.add(part, seconds);
    }

    fn stage(&self, stage: &dyn Display, progress: Progress) -> Proceed {
        self.shown(|line| line.update_of(stage, progress))
    }
}

/// Without a line of progress, and Ctrl-C ends the program.
impl Listener for Console {
    fn warn(&self, files: &Files, doubts: &[Diagnostic]) {
        self.warn(files, doubts);
    }

    fn note(&self, text: &str) {
        self.note(text);
    }
}

impl Drop for Listening<'_> {
    fn drop(&mut self) {
        self.line().clear();
        self.several.get().iter().for_each(|several| several.clear());
    }
}
