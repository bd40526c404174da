//! The console as a listener: doubts to stderr, progress on a line, Ctrl-C ends runs.

use std::fmt::Display;
use std::sync::{Mutex, PoisonError};

use lptn_answer::listener::Listener;
use lptn_netlist::{Diagnostic, Files};
use lptn_solve::{Proceed, Progress};

use crate::console::Console;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;

/// A console that listens for Ctrl-C until it is dropped.
#[derive(Debug)]
pub(crate) struct Listening<'a> {
    console: &'a Console,
    interrupt: Interrupt,
    line: Mutex<ProgressLine>,
}

impl Console {
    /// Begins to listen.
    pub(crate) fn listening(&self) -> Listening<'_> {
        let line = Mutex::new(ProgressLine::new(self.quiet));
        Listening { console: self, interrupt: Interrupt::listen(), line }
    }
}

impl Listening<'_> {
    fn line(&self) -> std::sync::MutexGuard<'_, ProgressLine> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Listener for Listening<'_> {
    fn warn(&self, files: &Files, doubts: &[Diagnostic]) {
        self.line().clear();
        self.console.warn_early(files, doubts);
    }

    fn note(&self, text: &str) {
        self.line().clear();
        self.console.note(text);
    }

    fn progress(&self, progress: Progress) -> Proceed {
        self.line().update(progress);
        self.interrupt.control()
    }

    fn stage(&self, stage: &dyn Display, progress: Progress) -> Proceed {
        // no run waits for the line: the next step says more
        if let Ok(mut line) = self.line.try_lock() {
            line.update_of(stage, progress);
        }
        self.interrupt.control()
    }
}

impl Drop for Listening<'_> {
    fn drop(&mut self) {
        self.line().clear();
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

    fn progress(&self, _: Progress) -> Proceed {
        Proceed::Continue
    }
}
