//! Work without Python's lock, which Ctrl-C ends.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use lptn::{Diagnostic, Files, Listener, Proceed, Progress, Which, problems_as_json};
use pyo3::prelude::*;
use serde_json::Value;

use crate::trouble::Trouble;

/// Time between two looks at the signals of Python.
const LOOK: Duration = Duration::from_millis(20);

/// Stack of a thread that computes, in bytes: as large as that of a program.
const STACK: usize = 8 << 20;

/// Progress of the work: done, all, and the noun for them.
type Reached = (f64, f64, &'static str);

/// Doubts that were known early, Ctrl-C, and progress.
#[derive(Debug, Default)]
pub(crate) struct Hearing {
    stop: AtomicBool,
    doubts: Mutex<Vec<Value>>,
    reached: Mutex<Option<Reached>>,
    /// Called with the progress, if there is one.
    told: Option<Py<PyAny>>,
}

impl Listener for Hearing {
    fn warn(&self, files: &Files, doubts: &[Diagnostic]) {
        let Value::Array(new) = problems_as_json(files, doubts) else { return };
        self.doubts.lock().unwrap_or_else(PoisonError::into_inner).extend(new);
    }

    fn progress(&self, Progress { start, time, stop }: Progress) -> Proceed {
        if self.told.is_some() {
            self.come((time - start, stop - start, "s"));
        }
        self.proceed()
    }

    fn progress_of(&self, which: Which, _: Progress) -> Proceed {
        let (done, all) = (which.number as f64, which.all as f64);
        self.come((done, all, which.noun));
        self.proceed()
    }

    fn counted(&self, done: usize, all: usize, noun: &'static str) {
        self.come((done as f64, all as f64, noun));
    }

    fn rate(&self, (done, all, noun): (u64, u64, &'static str), _: u64) {
        self.come((done as f64, all as f64, noun));
    }

    fn proceed(&self) -> Proceed {
        if self.stop.load(Ordering::Relaxed) { Proceed::Interrupt } else { Proceed::Continue }
    }
}

impl Hearing {
    /// One that calls a function with the progress.
    pub(crate) fn telling(told: Option<Py<PyAny>>) -> Self {
        Self { told, ..Self::default() }
    }

    /// The doubts, as JSON.
    pub(crate) fn doubts(&self) -> String {
        let doubts = self.doubts.lock().unwrap_or_else(PoisonError::into_inner);
        Value::Array(doubts.clone()).to_string()
    }

    fn come(&self, reached: Reached) {
        *self.reached.lock().unwrap_or_else(PoisonError::into_inner) = Some(reached);
    }

    /// Looks for signals, and reports the progress.
    fn look(&self, py: Python<'_>) -> PyResult<()> {
        py.check_signals()?;
        let reached = *self.reached.lock().unwrap_or_else(PoisonError::into_inner);
        match (&self.told, reached) {
            (Some(told), Some(reached)) => told.call1(py, reached).map(drop),
            _ => Ok(()),
        }
    }

    /// Computes in a thread; this one looks for signals.
    pub(crate) fn watch<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Trouble> + Send,
    ) -> Result<T, Trouble> {
        py.detach(|| {
            thread::scope(|scope| {
                let (done, wait) = channel::<()>();
                let worker = thread::Builder::new().stack_size(STACK);
                let worker = worker.spawn_scoped(scope, move || {
                    let _done = done;
                    caught(work)
                });
                let worker = worker.map_err(|error| Trouble::fault(&error.to_string()))?;
                let mut signal = None;
                while wait.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                    if let Err(error) = Python::attach(|py| self.look(py)) {
                        self.stop.store(true, Ordering::Relaxed);
                        signal.get_or_insert(error);
                    }
                }
                let outcome = worker.join().unwrap_or_else(|_| Err(Trouble::fault("a thread")));
                if signal.is_none() {
                    signal = Python::attach(|py| self.look(py)).err();
                }
                signal.map_or(outcome, |error| Err(error.into()))
            })
        })
    }
}

/// Computes in this thread, for work that is over soon.
pub(crate) fn soon<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Trouble> + Send,
) -> Result<T, Trouble> {
    py.detach(|| caught(work))
}

fn caught<T>(work: impl FnOnce() -> Result<T, Trouble>) -> Result<T, Trouble> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or(panic.downcast_ref::<&str>().copied());
        Err(Trouble::fault(text.unwrap_or("no reason is given")))
    })
}
