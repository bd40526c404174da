//! The listener of a question while its answer is computed.

use std::fmt::Display;
#[cfg(not(target_family = "wasm"))]
use std::time::Instant;

use lptn_netlist::{Diagnostic, Files};
use lptn_solve::{Proceed, Progress};

/// Hears of progress, and may interrupt.
pub trait Listener: Sync {
    /// Doubts as soon as they are known: before a long computation, or if it then fails.
    /// The answer, if there is one, has them too. Their places are in `files`.
    fn warn(&self, _files: &Files, _doubts: &[Diagnostic]) {}

    /// Something worth knowing that is not a doubt.
    fn note(&self, _text: &str) {}

    /// Something begins that may be interrupted.
    fn begin(&self) {}

    /// Returns whether to continue. [`Proceed::Interrupt`] ends the work; finished parts are kept.
    fn proceed(&self) -> Proceed {
        Proceed::Continue
    }

    /// A run has come this far; returns whether to continue.
    fn progress(&self, _progress: Progress) -> Proceed {
        self.proceed()
    }

    /// One of several runs has come this far; returns whether to continue.
    fn progress_of(&self, _which: Which, _progress: Progress) -> Proceed {
        self.proceed()
    }

    /// One of several runs is over, however it ended.
    fn finished(&self, _which: Which) {}

    /// `done` of `all` things of this name, in the plural, are done.
    fn counted(&self, _done: usize, _all: usize, _noun: &'static str) {}

    /// `done` of `all` things of this name are done, `before` of them earlier than this command.
    fn rate(&self, _count: (u64, u64, &'static str), _before: u64) {}

    /// A part of the work took this long, in s.
    fn took(&self, _part: &'static str, _seconds: f64) {}

    /// One of several runs at the same time has come this far; `stage` names it.
    fn stage(&self, _stage: &dyn Display, progress: Progress) -> Proceed {
        self.progress(progress)
    }
}

/// One of several runs.
#[derive(Clone, Copy, Debug)]
pub struct Which {
    /// Its number, from 0.
    pub number: usize,
    /// The number of all of them.
    pub all: usize,
    /// The noun for them, in the plural.
    pub noun: &'static str,
}

/// Ignores everything: work goes to its end, and only answers have doubts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Listener for Nobody {}

/// Does a part of the work, and reports how long it took.
pub fn timed<T>(listener: &dyn Listener, part: &'static str, work: impl FnOnce() -> T) -> T {
    let begun = Stopwatch::start();
    let done = work();
    listener.took(part, begun.seconds());
    done
}

/// The time since a start. WebAssembly alone has no clock: there it is 0.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    #[cfg(not(target_family = "wasm"))]
    begun: Instant,
}

impl Stopwatch {
    /// Begins now.
    pub fn start() -> Self {
        Self {
            #[cfg(not(target_family = "wasm"))]
            begun: Instant::now(),
        }
    }

    /// The time since then in s.
    pub fn seconds(self) -> f64 {
        #[cfg(target_family = "wasm")]
        return 0.0;
        #[cfg(not(target_family = "wasm"))]
        self.begun.elapsed().as_secs_f64()
    }
}
