//! Warnings about an inference in addition to its bands.

use lptn_fit::infer::{Drift, InferredColumn, Start};
use lptn_netlist::{Diagnostic, Observed};
use lptn_report::{duration, significant};

use super::InferAnswer;

/// Surprise in standard deviations that is not chance.
const FAR: f64 = 5.0;

/// Scatter of readings that is reported, over the expected one.
const WIDE: f64 = 1.3;

/// Correlation of neighbours below which bands are too narrow by a tenth at most.
const ALIKE: f64 = 0.08;

pub(super) fn of(answer: &InferAnswer) -> Vec<Diagnostic> {
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
    let odd = columns().enumerate().filter(|(_, (column, _))| is_wide(column) || is_alike(column));
    doubts.extend(odd.map(|(i, (column, observed))| surprised((answer, i), column, observed)));
    doubts
}

fn start(answer: &InferAnswer, column: &InferredColumn, observed: &Observed) -> Diagnostic {
    let message = format!(
        "column `{}` begins {} standard deviations from the start of the network",
        observed.column,
        significant(column.first.abs(), 2)
    );
    let at = Diagnostic::warning("infer::start", message).at(observed.span.clone(), "");
    let first = answer.found.times.first().copied().unwrap_or(0.0);
    at.help(format!(
        "the network is at `T0` at {}: write `initial = \"free\"` if that is not known, or \
         `initial = \"record\"` if it is known of all nodes that are not measured",
        duration(first, 3)
    ))
}

fn drifts(
    answer: &InferAnswer,
    column: &InferredColumn,
    observed: &Observed,
) -> Option<Diagnostic> {
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
        "the other columns and the network contradict it: check the instrument, or the network \
         near it",
    ))
}

fn is_wide(column: &InferredColumn) -> bool {
    column.rms > WIDE
}

/// True if neighbours are correlated, and not by chance.
fn is_alike(column: &InferredColumn) -> bool {
    column.neighbours * (column.readings as f64).sqrt() > FAR && column.neighbours > ALIKE
}

fn surprised(
    (answer, i): (&InferAnswer, usize),
    column: &InferredColumn,
    observed: &Observed,
) -> Diagnostic {
    let message = format!(
        "column `{}`: readings are {} times as far from their predictions as they should be, and \
         neighbours correlate by {}",
        observed.column,
        significant(column.rms, 3),
        significant(column.neighbours, 2)
    );
    let task = &answer.task;
    let mut reasons: Vec<&str> = Vec::new();
    if is_wide(column) && task.run.columns[i].sigma.is_some() {
        reasons.push("`sigma` is larger than stated");
    }
    if is_alike(column) && matches!(task.drift, Drift::Known { .. }) {
        reasons.push("a slow part of the noise is larger than `drift`");
    }
    if task.estimated.iter().any(|estimated| estimated.intensity.is_some()) {
        reasons.push("an estimated signal changes faster than `change`");
    }
    let mut help = "the bands are too narrow: ".to_owned();
    reasons.iter().for_each(|reason| help += &format!("{reason}, "));
    help += if reasons.is_empty() { "the network " } else { "or the network " };
    help += "lacks something";
    Diagnostic::warning("infer::surprised", message).at(observed.span.clone(), "").help(help)
}
