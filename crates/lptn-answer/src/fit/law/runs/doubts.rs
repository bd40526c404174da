//! Warnings about the exponentials of a folder: those of `lptn fit step` for one record, once for
//! each column.

use lptn_fit::law::{ColumnFits, RunFit, RunReference, RunsStudy};
use lptn_netlist::Diagnostic;
use lptn_report::significant;

/// Share of a rise by which the reference may change.
const STEADY: f64 = 0.05;

/// The warnings about all columns.
pub(super) fn of(study: &RunsStudy) -> Vec<Diagnostic> {
    let reference = match &study.settings().reference {
        RunReference::Column(name) => Some(name.as_str()),
        RunReference::Initial | RunReference::Value(_) => None,
    };
    let column = |column: &ColumnFits| {
        [late(study, column), reference.and_then(|name| drift(study, column, name))]
    };
    study.columns.iter().flat_map(column).flatten().collect()
}

/// The largest number of the runs that have one, with the name of its run and their count.
fn worst<'s>(
    study: &'s RunsStudy,
    column: &ColumnFits,
    number: impl Fn(&RunFit) -> Option<f64>,
) -> Option<(f64, &'s str, usize)> {
    let runs = study.runs.iter().zip(&column.fits);
    let found: Vec<_> =
        runs.filter_map(|(run, fit)| Some((number(fit)?, run.0.as_str()))).collect();
    let worst = found.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    Some((worst.0, worst.1, found.len()))
}

/// Warning that steps begin after their records.
fn late(study: &RunsStudy, column: &ColumnFits) -> Option<Diagnostic> {
    let (until, run, count) = worst(study, column, |fit| fit.fit.still_until)?;
    let message = format!(
        "column `{}` is constant at the start of {count} of {} records, most in {run}, until {} s, \
         but one exponential is not",
        column.column,
        study.runs.len(),
        significant(until, 6)
    );
    let help = "take the rows before the step out of each record: t_RC and dT are those of one \
        exponential from the first row on";
    Some(Diagnostic::warning("fit::late_start", message).help(help))
}

/// Warning that a reference changes, although its mean is used.
fn drift(study: &RunsStudy, column: &ColumnFits, reference: &str) -> Option<Diagnostic> {
    let changes = |fit: &RunFit| {
        let (drift, rise) = (fit.power.drift, fit.power.rise.value);
        (drift.abs() > STEADY * rise.abs()).then_some(drift)
    };
    let (by, run, count) = worst(study, column, changes)?;
    let message = format!(
        "the reference `{reference}` of column `{}` changes by more than 5 % of dT in {count} of \
         {} records, most in {run}, by {} K, and its mean is used",
        column.column,
        study.runs.len(),
        significant(by, 3)
    );
    let help = "a bed that warms is a node of the network: `lptn fit network` can fit it as one";
    Some(Diagnostic::warning("fit::drift", message).help(help))
}
