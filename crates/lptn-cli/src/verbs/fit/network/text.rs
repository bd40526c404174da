//! What came of a fit of a network, for reading.

use lptn_report::{Align, Column, TextTable, WIDTH, differing, labelled, plain, significant};
use lptn_study::Gradient;

use super::Answer;
use super::words::{state, verdict};
use crate::console::Console;

/// Digits of a value without a standard error.
const DIGITS: usize = 6;

pub(crate) fn text(answer: &Answer<'_>, console: &Console) -> String {
    let network = answer.task.network;
    let title = network.title().map_or(answer.input.text.stem.clone(), plain);
    let fit = &answer.fit;
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let head = format!(
        "fit {}: {} to {} of {}",
        answer.study.name,
        count(fit.parameters.len(), "parameter"),
        count(fit.samples(), "value"),
        count(answer.task.runs.len(), "record")
    );
    let mut lines = vec![console.title(&title), head, String::new()];
    lines.extend(parameters(answer));
    lines.push(String::new());
    lines.extend(columns(answer));
    lines.extend(correlations(answer));
    lines.push(String::new());
    for (label, note) in notes(answer) {
        lines.extend(labelled(&format!("{label:13}"), &words(&note), WIDTH));
    }
    lines.push(String::new());
    lines.extend(labelled("", &words(&verdict(answer)), WIDTH));
    lines.join("\n") + "\n"
}

fn words(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}

/// A value with as many digits as its standard error has a use for: two of the error's own.
fn with_error(value: f64, error: Option<f64>) -> [String; 2] {
    match error {
        Some(error) if error > 0.0 && error.is_finite() => {
            let decimals = lptn_report::decimals(error, 2, 0);
            let size = value.abs().log10().floor();
            if (1e-3..1e6).contains(&value.abs()) && decimals <= 9 {
                return [lptn_report::fixed(value, decimals), lptn_report::fixed(error, decimals)];
            }
            let digits = (size - error.log10().floor()).max(0.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 700")]
            let digits = 2 + digits.min(15.0) as usize;
            [significant(value, digits), significant(error, 2)]
        }
        _ => [significant(value, DIGITS), String::new()],
    }
}

fn parameters(answer: &Answer<'_>) -> Vec<String> {
    let all = || 0..answer.fit.parameters.len();
    let cells = |i: usize| {
        let parameter = &answer.fit.parameters[i];
        let error = parameter.standard_error.map(|error| answer.shown_difference(i, error));
        with_error(answer.shown(i, parameter.value), error)
    };
    let bound = |i: usize, si: f64| {
        if si.is_finite() { significant(answer.shown(i, si), 4) } else { String::new() }
    };
    let column = |title: &str, cell: &dyn Fn(usize) -> String| {
        Column::new(title, Align::Right, all().map(cell).collect())
    };
    let unit = |i: usize| match answer.units[i].text.as_str() {
        "1" => "-".to_owned(),
        text => text.to_owned(),
    };
    let state = |i: usize| match state(answer, i) {
        "free" => String::new(),
        state => state.to_owned(),
    };
    let table = TextTable::new(vec![
        Column::new("parameter", Align::Left, all().map(|i| answer.name(i).to_owned()).collect()).names(),
        column("value", &|i| cells(i)[0].clone()),
        column("std. error", &|i| cells(i)[1].clone()),
        Column::new("unit", Align::Left, all().map(unit).collect()),
        column("start", &|i| significant(answer.shown(i, answer.fit.parameters[i].start), 4)),
        column("from", &|i| bound(i, answer.task.parameters[i].bounds.0)).optional(),
        column("to", &|i| bound(i, answer.task.parameters[i].bounds.1)).optional(),
        Column::new("", Align::Left, all().map(state).collect()),
    ]);
    table.lines(WIDTH)
}

fn columns(answer: &Answer<'_>) -> Vec<String> {
    let misfits = &answer.fit.columns;
    let column = |title: &str, cell: &dyn Fn(usize) -> String| {
        Column::new(title, Align::Right, (0..misfits.len()).map(cell).collect())
    };
    let several = answer.task.runs.len() > 1;
    let records: Vec<String> = answer.task.runs.iter().map(|run| run.name.clone()).collect();
    let records = differing(&records);
    let name = |i: usize| {
        let run = &answer.task.runs[misfits[i].run];
        let name = &run.columns[misfits[i].column].name;
        if several { format!("{name} ({})", records[misfits[i].run]) } else { name.clone() }
    };
    let sigma = |i: usize| misfits[i].sigma.map_or("-".to_owned(), |sigma| significant(sigma, 3));
    let table = TextTable::new(vec![
        Column::new("column", Align::Left, (0..misfits.len()).map(name).collect()).names(),
        column("misfit rms [K]", &|i| significant(misfits[i].rms, 3)),
        column("mean [K]", &|i| significant(misfits[i].mean, 2)),
        column("sigma [K]", &sigma),
        column("values", &|i| misfits[i].samples.to_string()),
        column("independent", &|i| significant(misfits[i].effective.round(), 6)),
    ]);
    table.lines(WIDTH)
}

/// Parameters that are shown with their correlations, at most: more do not fit a line.
const MOST: usize = 7;

fn correlations(answer: &Answer<'_>) -> Vec<String> {
    let known: Vec<usize> =
        (0..answer.fit.parameters.len()).filter(|&i| answer.fit.correlation(i, i).is_some()).collect();
    if known.len() < 2 || known.len() > MOST {
        return Vec::new();
    }
    let cell = |i: usize, j: usize| match answer.fit.correlation(i, j) {
        Some(correlation) if j < i => lptn_report::fixed(correlation, 3),
        _ => String::new(),
    };
    let rows = &known[1..];
    let names = rows.iter().map(|&i| answer.name(i).to_owned()).collect();
    let mut columns = vec![Column::new("correlation", Align::Left, names).names()];
    for &j in &known[..known.len() - 1] {
        let cells = rows.iter().map(|&i| cell(i, j)).collect();
        columns.push(Column::new(answer.name(j), Align::Right, cells));
    }
    let mut lines = vec![String::new()];
    lines.extend(TextTable::new(columns).lines(WIDTH));
    lines
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
