//! Evaluation of the candidates of a comparison.

use lptn_assembly::ThermalSystem;
use lptn_netlist::Diagnostic;
use lptn_solve::{Proceed, in_parallel};
use lptn_study::{Candidate, CompareError};

use super::doubts;
use super::load::Loaded;
use crate::failure::Failure;
use crate::listener::{Listener, Which};

/// Reason why a candidate has no results; `NotRead` if reading it failed already.
pub(super) enum NoResult {
    NotRead,
    Failure(Failure),
}

/// Every candidate, after an interruption those that were finished by then.
pub(super) fn evaluate_all(
    loaded: &[Loaded],
    (periodic, threads): (bool, usize),
    listener: &dyn Listener,
) -> Vec<Result<Candidate, NoResult>> {
    let numbered: Vec<(usize, &Loaded)> = loaded.iter().enumerate().collect();
    let all = loaded.len();
    in_parallel(&numbered, threads, |&(number, loaded)| {
        let which = Which { number, all, noun: "candidates" };
        let outcome = evaluate((loaded, periodic), which, listener);
        listener.finished(which);
        outcome
    })
}

fn evaluate(
    (loaded, periodic): (&Loaded, bool),
    which: Which,
    listener: &dyn Listener,
) -> Result<Candidate, NoResult> {
    let input = loaded.input.as_ref().map_err(|_| NoResult::NotRead)?;
    let system: ThermalSystem = input.assemble().map_err(NoResult::Failure)?;
    let run = input.netlist.run.as_ref();
    let found = if listener.proceed() == Proceed::Interrupt {
        Err(CompareError::Interrupted(run.map_or(0.0, |run| run.start)))
    } else {
        let observer = &mut |progress| listener.progress_of(which, progress);
        match periodic {
            true => Candidate::settled_observed(&system, run, observer),
            false => Candidate::evaluate_observed(&system, run, observer),
        }
    };
    found.map_err(|error| {
        let place = error.input().and_then(|error| input.place_of(error));
        NoResult::Failure(input.failure(&error, place))
    })
}

/// Uncertainty of every candidate, as far as it can be computed.
pub(super) fn doubtful(
    loaded: &[Loaded],
    done: &mut [Result<Candidate, NoResult>],
    threads: usize,
) -> Vec<Diagnostic> {
    let pairs: Vec<(&Loaded, Option<Candidate>)> = loaded
        .iter()
        .zip(done.iter())
        .map(|(one, done)| (one, done.as_ref().ok().cloned()))
        .collect();
    let found = in_parallel(&pairs, threads, |(one, candidate)| {
        let (Ok(input), Some(mut candidate)) = (&one.input, candidate.clone()) else { return None };
        let warning = doubts::look(input, &mut candidate, &one.file);
        Some((candidate, warning))
    });
    let mut warnings = Vec::new();
    for (done, found) in done.iter_mut().zip(found) {
        if let Some((candidate, warning)) = found {
            *done = Ok(candidate);
            warnings.extend(warning);
        }
    }
    warnings
}
