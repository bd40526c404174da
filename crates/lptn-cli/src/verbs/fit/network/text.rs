//! What came of a fit of a network, for reading.

use lptn_fit::network::ColumnMisfit;
use lptn_report::{Text, TextTable, decimals, differing, fixed, significant};
use lptn_solve::Gradient;

use super::Answer;
use super::words::{state, verdict};
use crate::words::{count, symbol};

/// Digits of a value without a standard error.
const DIGITS: usize = 6;

pub(crate) fn text(answer: &Answer<'_>) -> Text {
    let fit = &answer.fit;
    let mut text = Text::titled(answer.input.title());
    text.line(format!(
        "fit {}: {} to {} of {}",
        answer.study.name,
        count(fit.parameters.len(), "parameter"),
        count(fit.samples(), "value"),
        count(answer.task.runs.len(), "record")
    ));
    text.section().table(parameters(answer));
    text.section().table(columns(answer));
    if let Some(table) = correlations(answer) {
        text.section().table(table);
    }
    text.section();
    for (label, note) in notes(answer) {
        text.sentence(&format!("{label:13}"), &note);
    }
    text.section().sentence("", &verdict(answer));
    text
}

/// A value with as many digits as its standard error has a use for: two of the error's own.
fn with_error(value: f64, error: Option<f64>) -> (String, String) {
    match error {
        Some(error) if error > 0.0 && error.is_finite() => {
            let digits = decimals(error, 2, 0);
            let size = value.abs().log10().floor();
            if (1e-3..1e6).contains(&value.abs()) && digits <= 9 {
                return (fixed(value, digits), fixed(error, digits));
            }
            let digits = (size - error.log10().floor()).max(0.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 700")]
            let digits = 2 + digits.min(15.0) as usize;
            (significant(value, digits), significant(error, 2))
        }
        _ => (significant(value, DIGITS), String::new()),
    }
}

fn parameters(answer: &Answer<'_>) -> TextTable {
    let all: Vec<usize> = (0..answer.fit.parameters.len()).collect();
    let cells = |i: usize| {
        let parameter = &answer.fit.parameters[i];
        let error = parameter.standard_error.map(|error| answer.shown_difference(i, error));
        with_error(answer.shown(i, parameter.value), error)
    };
    let bound = |i: usize, si: f64| match si.is_finite() {
        true => significant(answer.shown(i, si), 4),
        false => String::new(),
    };
    TextTable::of(&all)
        .left("parameter", |&i| answer.name(i))
        .names()
        .right("value", |&i| cells(i).0)
        .right("std. error", |&i| cells(i).1)
        .left("unit", |&i| symbol(&answer.units[i].text))
        .right("start", |&i| significant(answer.shown(i, answer.fit.parameters[i].start), 4))
        .right("from", |&i| bound(i, answer.task.parameters[i].bounds.0))
        .optional()
        .right("to", |&i| bound(i, answer.task.parameters[i].bounds.1))
        .optional()
        .left("", |&i| Some(state(answer, i)).filter(|state| *state != "free").unwrap_or_default())
        .into()
}

fn columns(answer: &Answer<'_>) -> TextTable {
    let several = answer.task.runs.len() > 1;
    let records: Vec<String> = answer.task.runs.iter().map(|run| run.name.clone()).collect();
    let records = differing(&records);
    let name = |misfit: &ColumnMisfit| {
        let name = &answer.task.runs[misfit.run].columns[misfit.column].name;
        if several { format!("{name} ({})", records[misfit.run]) } else { name.clone() }
    };
    TextTable::of(&answer.fit.columns)
        .left("column", name)
        .names()
        .right("misfit rms [K]", |misfit| significant(misfit.rms, 3))
        .right("mean [K]", |misfit| significant(misfit.mean, 2))
        .right("sigma [K]", |m| m.sigma.map_or("-".to_owned(), |sigma| significant(sigma, 3)))
        .right("values", |misfit| misfit.samples.to_string())
        .right("independent", |misfit| significant(misfit.effective.round(), 6))
        .into()
}

/// Parameters that are shown with their correlations, at most: more do not fit a line.
const MOST: usize = 7;

fn correlations(answer: &Answer<'_>) -> Option<TextTable> {
    let known: Vec<usize> =
        (0..answer.fit.parameters.len()).filter(|&i| answer.fit.correlation(i, i).is_some()).collect();
    if known.len() < 2 || known.len() > MOST {
        return None;
    }
    let cell = |i: usize, j: usize| match answer.fit.correlation(i, j) {
        Some(correlation) if j < i => fixed(correlation, 3),
        _ => String::new(),
    };
    let mut table = TextTable::of(&known[1..]).left("correlation", |&i| answer.name(i)).names();
    for &j in &known[..known.len() - 1] {
        table = table.right(answer.name(j), |&i| cell(i, j));
    }
    Some(table.into())
}

fn notes(answer: &Answer<'_>) -> Vec<(&'static str, String)> {
    let fit = &answer.fit;
    let mut notes =
        vec![("misfit", format!("{} K rms over all {} values", significant(fit.rms, 4), fit.samples()))];
    let starts = fit.starts;
    if starts.tried > 1 {
        let mut text = format!("{} of {} searches found this minimum", starts.same, starts.tried);
        if starts.other > 0 {
            text += &format!(", {} a worse one", starts.other);
        }
        if starts.failed > 0 {
            text += &format!(", {} none", starts.failed);
        }
        notes.push(("starts", text));
    }
    let how = match fit.gradient {
        Gradient::Exact => "exact sensitivities".to_owned(),
        Gradient::Differences(why) => {
            format!("differences of runs, for {}", why.describe(answer.task.network))
        }
    };
    notes.push(("gradient", format!("{how}; all records were run {} times", fit.evaluations)));
    if let Some(known) = &fit.identifiability {
        let values: Vec<String> = known.singular_values.iter().map(|value| significant(*value, 3)).collect();
        notes.push((
            "determined",
            format!("{} of {}; singular values {}", known.rank, fit.parameters.len(), values.join(", ")),
        ));
    }
    notes
}
