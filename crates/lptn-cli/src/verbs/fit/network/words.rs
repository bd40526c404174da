//! What a fit of a network says in words.

use lptn_fit::least_squares::Side;
use lptn_fit::network::{ColumnMisfit, Combination, CombinationKind, FAR, Hint, Unseparated};
use lptn_netlist::Diagnostic;
use lptn_report::significant;
use lptn_units::{Rational, Type, Unit};

use super::Answer;
use crate::words::count as number;

/// Digits of a value that nothing says the accuracy of.
const DIGITS: usize = 5;

/// What became of a parameter, in a word.
pub(crate) fn state(answer: &Answer<'_>, i: usize) -> &'static str {
    let known = answer.fit.identifiability.as_ref();
    match answer.fit.parameters[i].on_bound {
        _ if known.is_some_and(|known| known.unfelt.contains(&i)) => "not felt",
        _ if known.is_some_and(|known| !known.determines(i)) => "not determined",
        Some(Side::Lower) => "on its least value",
        Some(Side::Upper) => "on its greatest value",
        None => "free",
    }
}

/// Parameters on bounds and other doubts, each at its place.
pub(crate) fn doubts(answer: &Answer<'_>) -> Vec<Diagnostic> {
    let mut doubts = Vec::new();
    for (i, parameter) in answer.fit.parameters.iter().enumerate() {
        let determined =
            answer.fit.identifiability.as_ref().is_some_and(|known| known.determines(i));
        let (Some(side), true) = (parameter.on_bound, determined) else { continue };
        let end = if side == Side::Lower { "least" } else { "greatest" };
        let message = format!(
            "`{}` sits on the {end} value of its range: it has no standard error, and those of the \
             others hold only if this value is right",
            answer.name(i)
        );
        let place = answer.place(i).clone();
        let doubt = Diagnostic::warning("fit::on_bound", message).at(place, "");
        doubts.push(doubt.help("make the range wider, unless the parameter cannot be beyond it"));
    }
    let priors = answer.unknowns.iter().any(|unknown| unknown.prior.is_some());
    let unweighted =
        answer.task.runs.iter().flat_map(|run| &run.columns).any(|column| column.sigma.is_none());
    if priors && unweighted {
        let message = "without `sigma` a value of a record counts as known to 1 K beside what `±` \
            says of a parameter";
        let doubt = Diagnostic::warning("fit::no_sigma", message).at(answer.study.span.clone(), "");
        doubts
            .push(doubt.help("write how far one value scatters, for example `sigma = \"0.2 K\"`"));
    }
    doubts.extend((0..answer.fit.parameters.len()).filter_map(|i| off_prior(answer, i)));
    doubts.extend(misfits(answer));
    doubts
}

/// A value that contradicts what is known of it beforehand, which is its own value.
fn off_prior(answer: &Answer<'_>, i: usize) -> Option<Diagnostic> {
    let (fitted, prior) = (&answer.fit.parameters[i], answer.unknowns[i].prior?);
    let off = (fitted.value - fitted.start).abs() / prior;
    let shown = |si: f64| significant(answer.shown(i, si), DIGITS);
    let message = format!(
        "`{}` is fitted as {} {}, {} standard deviations from the {} known beforehand",
        answer.name(i),
        shown(fitted.value),
        answer.units[i].text,
        significant(off, 2),
        shown(fitted.start)
    );
    let doubt = Diagnostic::warning("fit::prior", message).at(answer.place(i).clone(), "");
    (off > FAR).then(|| {
        doubt.help(
            "the record and what `±` says of it contradict each other: one of them is wrong, or \
             the model",
        )
    })
}

/// The columns that the model misses by far more than their values scatter: each once, with the
/// record in which it is worst.
fn misfits(answer: &Answer<'_>) -> Vec<Diagnostic> {
    let name = |column: &ColumnMisfit| &answer.task.runs[column.run].columns[column.column].name;
    let off = |column: &ColumnMisfit| column.sigma.map_or(0.0, |sigma| column.rms / sigma);
    let mut found: Vec<(&ColumnMisfit, usize)> = Vec::new();
    for column in answer.fit.columns.iter().filter(|column| off(column) > FAR) {
        match found.iter_mut().find(|(other, _)| name(other) == name(column)) {
            Some((worst, count)) => {
                *count += 1;
                *worst = if off(column) > off(worst) { column } else { *worst };
            }
            None => found.push((column, 1)),
        }
    }
    let doubts =
        found.into_iter().map(|(worst, count)| misfit(answer, worst, (name(worst), count)));
    doubts.collect()
}

fn misfit(answer: &Answer<'_>, worst: &ColumnMisfit, (name, count): (&str, usize)) -> Diagnostic {
    let record = &answer.task.runs[worst.run].name;
    let (rms, sigma) = (significant(worst.rms, 3), significant(worst.sigma.unwrap_or(f64::NAN), 3));
    let message = match count {
        1 => format!(
            "the model does not describe column `{name}` of {record}: it misses it by {rms} K rms, \
             where `sigma` is {sigma} K"
        ),
        _ => format!(
            "the model does not describe column `{name}` in {count} records: it misses it by more \
             than {FAR} times `sigma`, most in {record}, by {rms} K rms, where `sigma` is {sigma} \
             K"
        ),
    };
    let doubt = Diagnostic::warning("fit::misfit", message).at(answer.study.span.clone(), "");
    doubt.help(match worst.hint {
        Some(Hint::Offset(kelvin)) => format!(
            "a constant would explain it: does the sensor have an offset of {} K? A `[sensor]` \
             with `offset = \"0 ± {} K\"`, named by the column, lets the fit find it",
            significant(kelvin, 2),
            significant(kelvin.abs().ceil(), 6)
        ),
        Some(Hint::Lag(seconds)) => format!(
            "a delay would explain it: does the sensor have a lag of {0} s? A `[sensor]` \
             with `lag = \"{0} s\"`, named by the column, follows as slowly",
            significant(seconds, 2)
        ),
        None => {
            "look for what the network leaves out, or for a `sigma` that is too small".to_owned()
        }
    })
}

/// "`P`, `R` and `C`".
pub(crate) fn listed(answer: &Answer<'_>, of: &[usize]) -> String {
    let names: Vec<String> = of.iter().map(|&i| format!("`{}`", answer.name(i))).collect();
    joined(&names)
}

fn joined(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [only] => only.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// "P R", "P / C", "2 G1 + G2".
pub(crate) fn combination(answer: &Answer<'_>, combination: &Combination) -> String {
    let name = |i: usize| answer.name(i).to_owned();
    match combination.kind {
        CombinationKind::Product => {
            let power =
                |(i, c): (usize, i32)| if c == 1 { name(i) } else { format!("{}^{c}", name(i)) };
            let side = |sign: i32| -> Vec<String> {
                let terms = combination.terms.iter().filter(|(_, c)| c.signum() == sign);
                terms.map(|&(i, c)| power((i, c.abs()))).collect()
            };
            let (above, below) = (side(1).join(" "), side(-1));
            match below.len() {
                0 => above,
                1 => format!("{above} / {}", below[0]),
                _ => format!("{above} / ({})", below.join(" ")),
            }
        }
        CombinationKind::Sum => {
            let mut text = String::new();
            for &(i, c) in &combination.terms {
                let sign = match (text.is_empty(), c < 0) {
                    (true, _) => "",
                    (false, true) => " - ",
                    (false, false) => " + ",
                };
                let factor = if c.abs() == 1 { String::new() } else { format!("{} ", c.abs()) };
                text += &format!("{sign}{factor}{}", name(i));
            }
            text
        }
    }
}

/// The type of a combination; `None` if its exponents cannot be held.
pub(crate) fn type_of(answer: &Answer<'_>, combination: &Combination) -> Option<Type> {
    let own = |i: usize| answer.unknowns[i].ty;
    if combination.kind == CombinationKind::Sum {
        return combination.terms.first().map(|&(i, _)| own(i));
    }
    let mut dimension = Type::SCALAR.dimension;
    for &(i, c) in &combination.terms {
        let factor = own(i).dimension.checked_pow(Rational::integer(c))?;
        dimension = dimension.checked_mul(factor)?;
    }
    Some(Type::of(dimension))
}

/// "67.2 K".
pub(crate) fn value_of(answer: &Answer<'_>, combination: &Combination) -> String {
    let Some(ty) = type_of(answer, combination) else {
        return significant(combination.value, DIGITS);
    };
    let unit = match combination.kind {
        CombinationKind::Sum => combination.terms.first().map(|&(i, _)| answer.units[i].clone()),
        CombinationKind::Product => Unit::parse(&ty.usual_unit()).ok(),
    };
    match unit {
        Some(unit) if unit.text != "1" => {
            format!("{} {}", significant(unit.from_si(combination.value), DIGITS), unit.text)
        }
        _ => significant(combination.value, DIGITS),
    }
}

/// What is determined of parameters that cannot be told apart, and what would help.
pub(crate) fn unseparated(answer: &Answer<'_>, group: &Unseparated) -> String {
    let example = group.parameters.last().map_or("", |&i| answer.name(i));
    let fix = match group.missing {
        1 => format!("fix one, for example give {example} a prior with `±`"),
        n => format!("fix {n} of them, for example give {example} a prior with `±`"),
    };
    match &group.determined {
        Some(determined) if !determined.is_empty() => {
            let texts: Vec<String> = determined.iter().map(|c| combination(answer, c)).collect();
            let values: Vec<String> = determined.iter().map(|c| value_of(answer, c)).collect();
            let verb = if texts.len() == 1 { "is" } else { "are" };
            format!("only {} {verb} determined (here {}); {fix}", joined(&texts), joined(&values))
        }
        Some(_) => format!("nothing of {} is determined; {fix}", listed(answer, &group.parameters)),
        None => {
            let change = |direction: &Vec<f64>| {
                let parts = group.parameters.iter().zip(direction).filter(|(_, d)| d.abs() > 0.0);
                let largest = relative(answer, group, direction);
                let part = |(&i, d): (&usize, &f64)| percent(answer, i, d / largest);
                parts.map(part).collect::<Vec<_>>()
            };
            let changes: Vec<String> =
                group.directions.iter().map(|d| joined(&change(d))).collect();
            format!(
                "{} cannot be told apart: {} together leave every column as it is; {fix}",
                listed(answer, &group.parameters),
                changes.join(", or ")
            )
        }
    }
}

/// What counts as the size of an unknown beside a change of it, in SI units: the zero of a
/// temperature or of an offset says nothing.
fn size(answer: &Answer<'_>, i: usize) -> f64 {
    const KELVIN: f64 = 100.0;
    let value = answer.fit.parameters[i].value.abs();
    if answer.unknowns[i].is_shift() { KELVIN } else { value.max(f64::MIN_POSITIVE) }
}

/// The largest relative change of a direction, so that divided by it the largest is 1 %.
fn relative(answer: &Answer<'_>, group: &Unseparated, direction: &[f64]) -> f64 {
    let all = group.parameters.iter().zip(direction).map(|(&i, d)| d.abs() / size(answer, i));
    100.0 * all.fold(0.0, f64::max)
}

/// "R +1 %", "tc1.offset -0.5 K".
fn percent(answer: &Answer<'_>, i: usize, change: f64) -> String {
    let sign = if change < 0.0 { "" } else { "+" };
    if answer.unknowns[i].is_shift() {
        return format!("{} {sign}{} K", answer.name(i), significant(change, 3));
    }
    let part = significant(100.0 * change / size(answer, i), 3);
    format!("{} {sign}{part} %", answer.name(i))
}

/// The last line: what the fit determined.
pub(crate) fn verdict(answer: &Answer<'_>) -> String {
    let Some(known) = &answer.fit.identifiability else {
        return "what the records determine cannot be told: derivatives are not finite".to_owned();
    };
    let mut parts = Vec::new();
    if !known.unfelt.is_empty() {
        parts.push(format!("no column depends on {}", listed(answer, &known.unfelt)));
    }
    parts.extend(known.unseparated.iter().map(|group| unseparated(answer, group)));
    if !parts.is_empty() {
        return format!("not determined: {}", parts.join("; "));
    }
    let count = answer.fit.parameters.len();
    let by = if answer.unknowns.iter().any(|unknown| unknown.prior.is_some()) {
        "the records and what is known beforehand (±)"
    } else {
        "the records"
    };
    let text = match answer.fit.parameters.iter().filter(|p| p.on_bound.is_some()).count() {
        0 if count == 1 => format!("{by} determine the parameter"),
        0 => format!("{by} determine the {}", sought(answer)),
        on => format!("{} of {count} parameters determined, {on} on a bound", count - on),
    };
    text + unchecked(answer)
}

/// "6 parameters and 3 values of sensors".
pub(crate) fn sought(answer: &Answer<'_>) -> String {
    let (parameters, of_sensors) = answer.sought();
    let parameters = number(parameters.len(), "parameter");
    match of_sensors.len() {
        0 => parameters,
        1 => format!("{parameters} and 1 value of a sensor"),
        n => format!("{parameters} and {n} values of sensors"),
    }
}

/// What there is to say of errors where the records have no value beyond those that the parameters
/// take up.
fn unchecked(answer: &Answer<'_>) -> &'static str {
    match (answer.fit.left_over, &answer.fit.covariance) {
        (0, Some(_)) => {
            "; no values are left over to tell errors from, so they are those of `sigma`"
        }
        (0, None) => "; no values are left over to tell errors from",
        _ => "",
    }
}
