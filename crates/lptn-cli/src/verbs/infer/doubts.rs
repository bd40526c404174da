//! What is to be said about an inference beside its bands.

use lptn_fit::infer::{InferredColumn, Start};
use lptn_netlist::{Diagnostic, Observed};
use lptn_report::{duration, significant};

use super::Answer;

/// A surprise of so many standard deviations is not chance.
const FAR: f64 = 5.0;

/// Readings that scatter so many times as far as was expected.
const WIDE: f64 = 1.3;

pub(super) fn of(answer: &Answer<'_>) -> Vec<Diagnostic> {
    let observed = &answer.study.reads.observed;
    let columns = || answer.found.columns.iter().zip(observed);
    let mut doubts: Vec<Diagnostic> = Vec::new();
    let starts = columns()
        .filter(|(column, _)| answer.task.start == Start::Known && column.first.abs() > FAR);
    doubts.extend(starts.map(|(column, observed)| start(answer, column, observed)));
    let drift = |column: &InferredColumn| {
        column.drift.map_or(0.0, |drift| (drift.value / drift.deviation).abs())
    };
    let most = columns().max_by(|a, b| drift(a.0).total_cmp(&drift(b.0)));
    let drifted = most.filter(|(column, _)| drift(column) > FAR);
    doubts.extend(drifted.and_then(|(column, observed)| drifts(answer, column, observed)));
    let odd = columns().filter(|(column, _)| {
        let chance = (column.readings as f64).sqrt();
        column.rms > WIDE || (column.neighbours * chance).abs() > FAR && column.neighbours > 0.2
    });
    doubts.extend(odd.map(|(column, observed)| surprised(column, observed)));
    doubts
}

fn start(answer: &Answer<'_>, column: &InferredColumn, observed: &Observed) -> Diagnostic {
    let message = format!(
        "column `{}` begins {} standard deviations from where the network does",
        observed.column,
        significant(column.first.abs(), 2)
    );
    let at = Diagnostic::warning("infer::start", message).at(observed.span.clone(), "");
    let first = answer.found.times.first().copied().unwrap_or(0.0);
    at.help(format!(
        "the network stands at `T0` at {}: write `initial = \"free\"` if that is not known, or \
         `initial = \"record\"` if it is known of all nodes that are not measured",
        duration(first, 3)
    ))
}

fn drifts(answer: &Answer<'_>, column: &InferredColumn, observed: &Observed) -> Option<Diagnostic> {
    let drift = column.drift?;
    let length = answer.found.times.last()? - answer.found.times.first()?;
    let message = format!(
        "column `{}` reads as if its instrument drifted by {} ± {} K over {}",
        observed.column,
        significant(drift.value, 3),
        significant(drift.deviation, 2),
        duration(length, 3)
    );
    let at = Diagnostic::warning("infer::drift", message).at(observed.span.clone(), "");
    Some(at.help(
        "the other columns and the network contradict it: look at the instrument, or at what the \
         network lacks near it",
    ))
}

fn surprised(column: &InferredColumn, observed: &Observed) -> Diagnostic {
    let message = format!(
        "column `{}`: readings are {} times as far from what was expected as they should be, and \
         neighbours correlate by {}",
        observed.column,
        significant(column.rms, 3),
        significant(column.neighbours, 2)
    );
    let at = Diagnostic::warning("infer::surprised", message).at(observed.span.clone(), "");
    at.help(
        "the bands are too narrow: `sigma` is larger than is said, what is sought changes faster than \
         `change` says, or the network lacks something",
    )
}
