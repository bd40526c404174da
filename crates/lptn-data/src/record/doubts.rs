//! Doubtful values of a column.

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::record::outliers::{self, told};
use crate::record::{Record, RecordColumn, Saturation};
use lptn_units::format_short as short;

const ZERO_CELSIUS: f64 = 273.15;

/// Most temperatures of a record are below this, in K: tungsten melts at 3695 K.
const HOTTEST: f64 = 3700.0;

/// Nitrogen boils at 77.4 K.
const COLDEST: f64 = 77.0;

/// The fewest rows, and the smallest share of the record, for which an extreme value has to last.
const LEAST_RUN: usize = 8;
const LEAST_SHARE: f64 = 0.01;

/// A range of fewer steps of the instrument than this does not show an end.
const FEWEST_STEPS: f64 = 12.0;

/// The value at which a column seems to be at its end, unless `outliers` are rows of it, and the
/// warnings about its values.
pub(crate) fn of(
    record: &Record,
    column: &RecordColumn,
    (outliers, text): (&[usize], &str),
) -> (Option<Saturation>, Vec<Diagnostic>) {
    let rows: Vec<usize> =
        (0..column.values.len()).filter(|&i| !column.values[i].is_nan()).collect();
    let line = |row: usize| record.line_in(text, row);
    let mut warnings = Vec::new();
    let value = |i: usize| column.values[rows[i]];
    let constant = (1..rows.len()).all(|i| value(i).total_cmp(&value(0)).is_eq());
    if constant && rows.len() > 1 {
        warnings.push(unchanging(column));
        return (None, warnings);
    }
    warnings.extend(jump(column, &rows, &line));
    warnings.extend(implausible(column));
    let saturation = saturation(record, column, &rows)
        .filter(|found| outliers.binary_search(&found.first).is_err());
    warnings.extend(saturation.map(|found| saturated(record, column, (found, &line))));
    (saturation, warnings)
}

/// The rows of outliers.
pub(crate) fn outliers(record: &Record, column: &RecordColumn) -> Vec<usize> {
    let rows: Vec<usize> =
        (0..record.time.len()).filter(|&row| !column.values[row].is_nan()).collect();
    let values: Vec<f64> = rows.iter().map(|&row| column.values[row]).collect();
    let places = outliers::outliers(&values, column.unit.ty.absolute);
    places.into_iter().map(|place| rows[place]).collect()
}

/// The warning about outliers.
pub(crate) fn outlying(
    record: &Record,
    column: usize,
    (rows, dropped): (&[usize], bool),
    text: &str,
) -> Option<Diagnostic> {
    let (first, column) = (*rows.first()?, &record.columns[column]);
    let at = format!(" at {} s", short(record.time[first]));
    let value = |row: usize| shown(column, column.values[row]);
    let said = told((rows, record.time.len()), &at, value)?;
    let done = match (dropped, rows.len()) {
        (false, _) => "",
        (true, 1) => ": it is left out",
        (true, _) => ": they are left out",
    };
    let message = format!("column `{}` {said}{done}", column.name);
    let warning = Diagnostic::warning("record::outlier", message)
        .at(record.line_in(text, first), if rows.len() == 1 { "" } else { "the first" });
    let help = "a broken wire, a channel that is stuck, or a digit lost? a fit leaves such values \
        out with `outliers = \"drop\"` in [fit] or [infer], or `--drop-outliers` of lptn fit step";
    Some(if dropped { warning } else { warning.help(help) })
}

/// A value of the column in its own unit.
fn shown(column: &RecordColumn, si: f64) -> String {
    let unit = if column.unit.text == "1" { "" } else { &column.unit.text };
    format!("{} {unit}", short(column.unit.from_si(si))).trim().to_owned()
}

/// The gaps of all columns; those that are gaps in the same rows are one warning.
pub(crate) fn gaps(record: &Record, text: &str) -> Vec<Diagnostic> {
    let mut alike: Vec<(Vec<usize>, Vec<&str>)> = Vec::new();
    for column in &record.columns {
        let rows = (0..column.values.len()).filter(|&row| column.values[row].is_nan());
        let rows: Vec<usize> = rows.collect();
        match alike.iter_mut().find(|(known, _)| *known == rows) {
            _ if rows.is_empty() => {}
            Some((_, names)) => names.push(&column.name),
            None => alike.push((rows, vec![&column.name])),
        }
    }
    let all = record.time.len();
    alike
        .iter()
        .map(|(rows, names)| gap((rows, all), names, &|row| record.line_in(text, row)))
        .collect()
}

fn gap((rows, all): (&[usize], usize), names: &[&str], line: &dyn Fn(usize) -> Span) -> Diagnostic {
    let count = rows.len();
    let which = if count == 1 { "gap, which is" } else { "gaps, which are" };
    let message = match names {
        [name] => format!("column `{name}` has {count} {which} left out of its {all} rows"),
        names => format!(
            "{} columns have {count} {which} left out of their {all} rows: {}",
            names.len(),
            several(names)
        ),
    };
    let label = if count == 1 { "here" } else { "the first" };
    Diagnostic::warning("record::gaps", message).at(line(rows[0]), label)
}

/// Number of names that are written out.
const NAMED: usize = 4;

fn several(names: &[&str]) -> String {
    let written = names.iter().take(NAMED).map(|name| format!("`{name}`")).collect::<Vec<_>>();
    match names.len().checked_sub(NAMED).filter(|more| *more > 0) {
        Some(more) => format!("{} and {more} more", written.join(", ")),
        None => written.join(", "),
    }
}

fn unchanging(column: &RecordColumn) -> Diagnostic {
    let value = column.values.iter().copied().find(|value| !value.is_nan()).unwrap_or(f64::NAN);
    let message = format!(
        "column `{}` does not change: it is {} throughout",
        column.name,
        shown(column, value)
    );
    Diagnostic::warning("record::constant", message).at(column.span.clone(), "")
}

/// A jump like that of a change of unit.
fn jump(column: &RecordColumn, rows: &[usize], line: &dyn Fn(usize) -> Span) -> Option<Diagnostic> {
    if !column.unit.ty.absolute {
        return None;
    }
    let steps = || rows.windows(2).map(|pair| [column.values[pair[0]], column.values[pair[1]]]);
    let mut sizes: Vec<f64> = steps().map(|[a, b]| (b - a).abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let usual = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let large = |a: f64, b: f64| (b - a).abs() > 20.0_f64.max(20.0 * usual);
    // as the numbers are in the file
    let written = |si: f64| column.unit.from_si(si);
    let (at, (before, after)) = steps().enumerate().find_map(|(i, [a, b])| {
        let units = changed_unit(written(a), written(b)).filter(|_| large(a, b))?;
        Some((i, units))
    })?;
    let message = format!(
        "column `{}` jumps from {} to {}, as if its unit changed from {before} to {after}",
        column.name,
        shown(column, column.values[rows[at]]),
        shown(column, column.values[rows[at + 1]])
    );
    let warning = Diagnostic::warning("record::unit_changes", message)
        .at(line(rows[at + 1]), "after the jump")
        .also(line(rows[at]), "before it");
    Some(warning.help("convert one of the parts: a column has one unit, that of its header"))
}

/// The two units between which two neighbours are the same temperature, to a few kelvin.
fn changed_unit(a: f64, b: f64) -> Option<(&'static str, &'static str)> {
    let near = |x: f64, y: f64| (x - y).abs() < 3.0 + 0.02 * y.abs();
    let fahrenheit = |celsius: f64| 1.8 * celsius + 32.0;
    [
        (near(b, a + ZERO_CELSIUS), ("degC", "K")),
        (near(a, b + ZERO_CELSIUS), ("K", "degC")),
        (near(b, fahrenheit(a)), ("degC", "degF")),
        (near(a, fahrenheit(b)), ("degF", "degC")),
    ]
    .into_iter()
    .find_map(|(is, units)| is.then_some(units))
}

/// Kelvin that read like degrees Celsius, or the reverse; a column that is too hot for any body.
fn implausible(column: &RecordColumn) -> Option<Diagnostic> {
    if !column.unit.ty.absolute {
        return None;
    }
    let written = column
        .values
        .iter()
        .filter(|value| !value.is_nan())
        .map(|&value| column.unit.from_si(value));
    let (low, high) =
        written.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let unit = column.unit.text.as_str();
    let beyond = |what: &str| {
        let (low, high) = (short(low), short(high));
        let message =
            format!("column `{}` goes from {low} to {high} {unit}, which {what}", column.name);
        Diagnostic::warning("record::which_unit", message)
            .at(column.span.clone(), "")
            .help("correct the unit of the column, or its decimal signs")
    };
    let hot = column.values.iter().filter(|value| **value > HOTTEST).count();
    if 2 * hot > column.values.len() - column.gaps {
        return Some(beyond("is not plausible"));
    }
    // lower temperatures are written in K or degC
    if !matches!(unit, "K" | "degC" | "°C") && column.unit.to_si(high) < COLDEST {
        return Some(beyond("is colder than boiling nitrogen"));
    }
    let other = match unit {
        "K" if high < 150.0 => "degC",
        "degC" | "°C" if low > 260.0 && high < 500.0 && high - low < 120.0 => "K",
        _ => return None,
    };
    let message = format!(
        "column `{}` goes from {} to {} {unit}: is it in {other}?",
        column.name,
        short(low),
        short(high)
    );
    let warning = Diagnostic::warning("record::which_unit", message).at(column.span.clone(), "");
    Some(warning.help(format!("if so, write `{} [{other}]`", column.name)))
}

/// An extreme value that is reached steeply and then stays: a body that settles slows down first.
fn saturation(record: &Record, column: &RecordColumn, rows: &[usize]) -> Option<Saturation> {
    let values: Vec<f64> = rows.iter().map(|&row| column.values[row]).collect();
    let highest = values.iter().copied().max_by(f64::total_cmp)?;
    let lowest = values.iter().copied().min_by(f64::total_cmp)?;
    [highest, lowest].into_iter().find_map(|extreme| {
        let (first, last) = longest_run(&values, extreme)?;
        let length = last - first + 1;
        #[expect(clippy::cast_precision_loss, reason = "a share of the rows")]
        let share = length as f64 / values.len() as f64;
        if first == 0 || length < LEAST_RUN || share < LEAST_SHARE {
            return None;
        }
        let abrupt = is_abrupt(&values[..first], length, (extreme, highest - lowest));
        let held = Saturation { value: extreme, first: rows[first], last: rows[last] };
        (abrupt && record.time[held.last] > record.time[held.first]).then_some(held)
    })
}

/// The longest run of one value: its first and its last position.
fn longest_run(values: &[f64], value: f64) -> Option<(usize, usize)> {
    let mut best: Option<(usize, usize)> = None;
    let mut start = None;
    for (i, v) in values.iter().enumerate() {
        if v.total_cmp(&value).is_ne() {
            start = None;
            continue;
        }
        let from = *start.get_or_insert(i);
        if best.is_none_or(|(a, b)| i - from > b - a) {
            best = Some((from, i));
        }
    }
    best
}

/// True if the values reach a run without slowing down, and it lasts longer than rounding explains:
/// the last tenth of the range takes at most 1.5 times the rows of the tenth before it, and the run
/// more than 4 times the rows of one step between values. A body that settles, `exp(-t / tau)`,
/// takes longer and longer for the same distance. If its record ends before it slows down, its last
/// value lasts no longer than the steps before.
fn is_abrupt(before: &[f64], length: usize, (extreme, range): (f64, f64)) -> bool {
    let reached =
        |share: f64| before.iter().rposition(|value| (value - extreme).abs() > share * range);
    let (Some(last), Some(earlier)) = (reached(0.1), reached(0.2)) else { return false };
    let end = before.len() - 1 - last;
    let steps = before.iter().map(|value| (value - extreme).abs()).filter(|&step| step > 0.0);
    let step = steps.fold(range, f64::min);
    #[expect(clippy::cast_precision_loss, reason = "counts of rows")]
    let usual = (end as f64) * step / (0.1 * range);
    // with few rounding steps every slow extreme looks like a plateau
    if range < FEWEST_STEPS * step {
        return false;
    }
    #[expect(clippy::cast_precision_loss, reason = "counts of rows")]
    let held = length as f64;
    2 * end <= 3 * (last - earlier) && held > 4.0 * usual
}

/// The warning that a sensor seems to be at its end.
fn saturated(
    record: &Record,
    column: &RecordColumn,
    (found, line): (Saturation, &dyn Fn(usize) -> Span),
) -> Diagnostic {
    let [from, to] = [found.first, found.last].map(|row| short(record.time[row]));
    let message = format!(
        "column `{}` stays at {}, its most extreme value, from {from} s to {to} s: its sensor \
         seems to be at its end",
        column.name,
        shown(column, found.value)
    );
    Diagnostic::warning("record::saturated", message)
        .at(line(found.first), "the first row of the run")
        .help(format!(
            "leave out the rows after {from} s, or measure again with a range that is larger"
        ))
}
