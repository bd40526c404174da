//! The console as a listener: doubts to stderr, progress on a line, Ctrl-C ends runs.

use std::sync::{Mutex, OnceLock, PoisonError};

use lptn_answer::listener::Listener;
use lptn_netlist::{Diagnostic, Files};
use lptn_solve::{Proceed, Progress};

use crate::console::Console;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;

/// A console that listens for Ctrl-C from the first progress on: before that nothing asks it, and
/// Ctrl-C ends the program.
#[derive(Debug)]
pub(crate) struct Listening<'a> {
    console: &'a Console,
    interrupt: OnceLock<Interrupt>,
    line: Mutex<ProgressLine>,
}

impl Console {
    /// Begins to listen.
    pub(crate) fn listening(&self) -> Listening<'_> {
        let line = Mutex::new(ProgressLine::new(self.quiet));
        Listening { console: self, interrupt: OnceLock::new(), line }
    }
}

impl Listening<'_> {
    fn line(&self) -> std::sync::MutexGuard<'_, ProgressLine> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows how far it is, unless another thread does, and says whether to go on.
    fn shown(&self, update: impl FnOnce(&mut ProgressLine)) -> Proceed {
        if let Ok(mut line) = self.line.try_lock() {
            update(&mut line);
        }
        self.interrupt.get_or_init(Interrupt::listen).control()
    }
}

impl Listener for Listening<'_> {
    fn warn(&self, files: &Files, doubts: &[Diagnostic]) {
        self.line().clear();
        self.console.warn(files, doubts);
    }

    fn note(&self, text: &str) {
        self.line().clear();
        self.console.note(text);
    }

    fn progress(&self, progress: Progress) -> Proceed {
        self.shown(|line| line.update(progress))
    }

    fn progress_of(&self, run: &str, progress: Progress) -> Proceed {
        self.shown(|line| line.update_of(run, progress))
    }
}

impl Drop for Listening<'_> {
    fn drop(&mut self) {
        self.line().clear();
    }
}
