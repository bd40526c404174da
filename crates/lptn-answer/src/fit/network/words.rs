//! Sentences of a fit of a network.

use lptn_fit::least_squares::{Side, Stop};
use lptn_fit::network::{
    ColumnMisfit, Combination, FAR, FittedParameter, Hint, NetworkFit, NetworkFitTask,
};
use lptn_netlist::Diagnostic;
use lptn_network::is_name;
use lptn_report::significant;
use lptn_units::Type;

use super::FitNetworkAnswer;
use super::units::common;
use crate::taken;
use crate::words::count as number;

/// Digits of a value of unknown accuracy.
const DIGITS: usize = 5;

/// State of a parameter in a word.
pub(super) fn state(answer: &FitNetworkAnswer, i: usize) -> &'static str {
    let known = answer.fit.identifiability.as_ref();
    match answer.fit.parameters[i].on_bound {
        _ if known.is_some_and(|known| known.unfelt.contains(&i)) => "not felt",
        _ if known.is_some_and(|known| !known.determines(i)) => "not determined",
        Some(Side::Lower) => "on its least value",
        Some(Side::Upper) => "on its greatest value",
        None => "free",
    }
}

/// Help for a search that did not converge.
pub(super) fn unfound(task: &NetworkFitTask, (stop, fit): (Stop, &NetworkFit)) -> String {
    let part = |fitted: &FittedParameter| (fitted.value / fitted.start).abs();
    let ends = task.unknowns().into_iter().zip(fit.parameters.iter().map(part));
    match ends.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((unknown, part))
            if stop == Stop::Edge && part < 1e-2 && unknown.sensor().is_some() =>
        {
            format!(
                "the records fit best with `{}` at zero: fix it, or leave it out of its sensor",
                unknown.name
            )
        }
        Some((unknown, part)) if stop == Stop::Edge && part < 1e-2 => format!(
            "the records fit best with `{}` at zero or below: give it a least value with `from`, \
             or fix it",
            unknown.name
        ),
        _ => {
            "give the parameters start values nearer to the expected ones, and bounds with `from` \
              and `to`"
                .to_owned()
        }
    }
}

/// Parameters on bounds and other doubts, each at its place.
pub(crate) fn doubts(answer: &FitNetworkAnswer) -> Vec<Diagnostic> {
    let mut doubts = Vec::new();
    for (i, parameter) in answer.fit.parameters.iter().enumerate() {
        let determined =
            answer.fit.identifiability.as_ref().is_some_and(|known| known.determines(i));
        let (Some(side), true) = (parameter.on_bound, determined) else { continue };
        if answer.unknowns[i].sensor().is_some() {
            doubts.push(no_lag(answer, i));
            continue;
        }
        let end = if side == Side::Lower { "least" } else { "greatest" };
        let message = format!(
            "`{}` is at the {end} value of its range: it has no standard error, and those of the \
             others are valid only if this value is right",
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
        let message = format!(
            "without `sigma` a value of a record counts as known to 1 {}, next to the `±` of a \
             parameter",
            common(&answer.task)
        );
        let doubt = Diagnostic::warning("fit::no_sigma", message).at(answer.study.span.clone(), "");
        doubts.push(doubt.help("write the scatter of one value, for example `sigma = \"0.2 K\"`"));
    }
    doubts.extend((0..answer.fit.parameters.len()).filter_map(|i| off_prior(answer, i)));
    let (of, found) = ((&*answer.input, &answer.study), (&answer.task, &answer.fit));
    doubts.extend(taken::of_fit(of, found, &answer.named()));
    let of = (&answer.study, &answer.task, &answer.fit);
    doubts.extend(taken::beside_posterior(&answer.input, of, &answer.named()));
    doubts.extend(late_starts(answer));
    doubts.extend(misfits(answer));
    doubts.extend(drifting(answer));
    doubts.extend(differing(answer));
    doubts
}

/// Doubts about nodes that begin at a reading of a later time, the first one that their column has.
fn late_starts(answer: &FitNetworkAnswer) -> impl Iterator<Item = Diagnostic> {
    let runs = answer.task.runs.iter();
    let starts = runs.flat_map(|run| run.late_starts().map(move |start| (run, start)));
    starts.map(|(run, start)| {
        let [begin, read_at] = [run.settings.start(), start.read_at].map(|t| significant(t, 6));
        let message = format!(
            "{}: `{}` begins at {begin} s with a reading of {read_at} s, the first of its column",
            run.name,
            answer.task.network.place_name(start.node)
        );
        let help = format!(
            "take the rows before {read_at} s out of the record, whose run begins with its first \
             row; or give the node its `T0`, without `initial`"
        );
        let doubt = Diagnostic::warning("fit::late_reading", message);
        doubt.at(answer.study.span.clone(), "").help(help)
    })
}

/// Doubt that an instrument has a lag: the records show none.
fn no_lag(answer: &FitNetworkAnswer, i: usize) -> Diagnostic {
    let name = answer.name(i);
    let message = format!(
        "the records show no lag: `{name}` becomes 0 s without a standard error, and those of the \
         others are valid only if that is right"
    );
    let doubt = Diagnostic::warning("fit::on_bound", message).at(answer.place(i).clone(), "");
    doubt.help("leave `lag` out of the sensor, or give its value from a separate test")
}

/// Wider intervals, in standard errors to each side, are reported: many values have two.
const WIDE: f64 = 2.5;

/// Doubt if drift as slow as the record makes an interval much wider.
fn drifting(answer: &FitNetworkAnswer) -> Option<Diagnostic> {
    let name = |column: &ColumnMisfit| &answer.task.runs[column.run].columns[column.column].name;
    let drifting = answer.fit.columns.iter().filter(|column| column.slow_drift);
    let names: Vec<String> = drifting.map(|column| format!("`{}`", name(column))).collect();
    let wide = |i: usize| {
        let fitted = &answer.fit.parameters[i];
        Some((i, fitted.half_width? / fitted.standard_error?))
    };
    let ratios = (0..answer.fit.parameters.len()).filter_map(wide);
    let (widest, ratio) = ratios.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let message = format!(
        "{} {}: the data cannot exclude a drift as slow as the record; the 95 % intervals include \
         it, and that of {} is ± {} standard errors",
        if names.len() == 1 { "column" } else { "columns" },
        names.join(", "),
        answer.name(widest),
        significant(ratio, 2)
    );
    let doubt = Diagnostic::warning("fit::slow_drift", message).at(answer.study.span.clone(), "");
    let doubt = doubt.help(
        "one or two records cannot separate such a drift from the response: add a sensor at a \
         constant temperature, or measure three records or more",
    );
    (!names.is_empty() && ratio > WIDE).then_some(doubt)
}

/// Doubt if a parameter that is constant in the network differs from record to record.
fn differing(answer: &FitNetworkAnswer) -> Option<Diagnostic> {
    let between = |i: usize| Some((i, answer.fit.parameters[i].between.filter(|b| b.differ)?));
    let all: Vec<_> = (0..answer.fit.parameters.len()).filter_map(between).collect();
    let (widest, most) = all.iter().max_by(|a, b| a.1.ratio.total_cmp(&b.1.ratio))?;
    let names: Vec<String> = all.iter().map(|(i, _)| format!("`{}`", answer.name(*i))).collect();
    let (ratio, name) = (significant(most.ratio, 2), answer.name(*widest));
    let message = match all.len() {
        1 => format!(
            "the records give values of `{name}` that differ {ratio} times as far as their noise \
             explains: its error follows from their scatter"
        ),
        _ => format!(
            "the records give values of {} that differ farther than their noise explains, those of \
             `{name}` {ratio} times as far: their errors follow from their scatter",
            names.join(", ")
        ),
    };
    let doubt = Diagnostic::warning("fit::records_differ", message);
    Some(doubt.at(answer.study.span.clone(), "").help(
        "something that the network keeps fixed changes from run to run, such as mounting, oil, a \
         start or a law of the speed: fit the records one by one to find it, and use `lptn fit \
         compare` to find the network that predicts a held-out record best",
    ))
}

/// Doubt if a value contradicts its prior, which is its start value.
fn off_prior(answer: &FitNetworkAnswer, i: usize) -> Option<Diagnostic> {
    let (fitted, prior) = (&answer.fit.parameters[i], answer.unknowns[i].prior?);
    let off = (fitted.value - fitted.start).abs() / prior;
    let shown = |si: f64| significant(answer.shown(i, si), DIGITS);
    let message = format!(
        "`{}` is fitted as {} {}, {} standard deviations from its prior {}",
        answer.name(i),
        shown(fitted.value),
        answer.units[i].text,
        significant(off, 2),
        shown(fitted.start)
    );
    let doubt = Diagnostic::warning("fit::prior", message).at(answer.place(i).clone(), "");
    (off > FAR).then(|| {
        doubt.help(
            "the record and the `±` contradict each other: one of them is wrong, or the model is",
        )
    })
}

/// The columns that the model misses by far more than their values scatter.
/// Each is named once, with the record in which it is worst.
fn misfits(answer: &FitNetworkAnswer) -> Vec<Diagnostic> {
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

fn misfit(
    answer: &FitNetworkAnswer,
    worst: &ColumnMisfit,
    (name, count): (&str, usize),
) -> Diagnostic {
    let record = &answer.task.runs[worst.run].name;
    let unit = answer.unit_of(worst);
    let [rms, sigma] = [worst.rms, worst.sigma.unwrap_or(f64::NAN)]
        .map(|value| format!("{} {unit}", significant(value, 3)));
    let message = match count {
        1 => format!(
            "the model does not describe column `{name}` of {record}: the misfit is {rms} rms, but \
             `sigma` is {sigma}"
        ),
        _ => format!(
            "the model does not describe column `{name}` in {count} records: the misfit is more \
             than {FAR} times `sigma`, most in {record}, {rms} rms, but `sigma` is {sigma}"
        ),
    };
    let doubt = Diagnostic::warning("fit::misfit", message).at(answer.study.span.clone(), "");
    doubt.help(match worst.hint {
        Some(Hint::Offset(offset)) => format!(
            "a constant would explain it: does the sensor have an offset of {} {unit}? The fit finds \
             it if {}",
            significant(offset, 2),
            instrument(
                (answer, name),
                &format!("offset = \"0 ± {} {unit}\"", significant(offset.abs().ceil(), 6))
            )
        ),
        Some(Hint::Lag(seconds)) => format!(
            "a delay would explain it: does the sensor have a lag of {0} s? The model follows as \
             slowly if {1}",
            significant(seconds, 2),
            instrument((answer, name), &format!("lag = \"{} s\"", significant(seconds, 2)))
        ),
        None => {
            "look for an effect that the network leaves out, or for a `sigma` that is too \
             small".to_owned()
        }
    })
}

/// The lines of a sensor of this column with this error, to paste.
fn instrument((answer, name): (&FitNetworkAnswer, &str), line: &str) -> String {
    let observed = answer.study.observed.iter().find(|observed| observed.column == name);
    if let Some(sensor) = observed.and_then(|observed| observed.sensor.as_ref()) {
        return format!("its sensor has the line `{line}`:\n\n[sensor.{sensor}]\n{line}");
    }
    let (key, sensor) =
        if is_name(name) { (name.to_owned(), name) } else { (format!("{name:?}"), "probe") };
    let of = observed.map_or("..", |observed| observed.text.as_str());
    format!(
        "the column names a sensor, `column = {{ {key} = {{ of = \"{of}\", sensor = \"{sensor}\" }} \
         }}`:\n\n[sensor.{sensor}]\n{line}"
    )
}

/// "P R", "P / C", "2 G1 + G2".
pub(super) fn combination(answer: &FitNetworkAnswer, combination: &Combination) -> String {
    answer.named().combination(combination)
}

/// The type of a combination; `None` if its exponents cannot be represented.
pub(super) fn type_of(answer: &FitNetworkAnswer, combination: &Combination) -> Option<Type> {
    answer.named().type_of(combination)
}

/// The last line: which parameters the fit determined.
pub(crate) fn verdict(answer: &FitNetworkAnswer) -> String {
    let Some(known) = &answer.fit.identifiability else {
        return "it is not known which parameters the records determine: derivatives are not \
            finite"
            .to_owned();
    };
    let mut parts = Vec::new();
    if !known.unfelt.is_empty() {
        parts.push(format!("no column depends on {}", answer.named().listed(&known.unfelt)));
    }
    parts.extend(known.unseparated.iter().map(|group| answer.named().unseparated(group)));
    if !parts.is_empty() {
        return format!("not determined: {}", parts.join("; "));
    }
    let count = answer.fit.parameters.len();
    let by = if answer.unknowns.iter().any(|unknown| unknown.prior.is_some()) {
        "the records and the priors (±)"
    } else {
        "the records"
    };
    let text = match answer.fit.parameters.iter().filter(|p| p.on_bound.is_some()).count() {
        0 if count == 1 => format!("{by} determine the parameter"),
        0 => format!("{by} determine the {}", estimated(answer)),
        on => format!("{} of {count} parameters determined, {on} on a bound", count - on),
    };
    text + unchecked(answer)
}

/// "6 parameters and 3 values of sensors".
pub(super) fn estimated(answer: &FitNetworkAnswer) -> String {
    let (parameters, of_sensors) = answer.estimated();
    let parameters = number(parameters.len(), "parameter");
    match of_sensors.len() {
        0 => parameters,
        1 => format!("{parameters} and 1 value of a sensor"),
        n => format!("{parameters} and {n} values of sensors"),
    }
}

/// Text on errors if the records have no values left to estimate them from.
fn unchecked(answer: &FitNetworkAnswer) -> &'static str {
    match (answer.fit.left_over, &answer.fit.covariance) {
        (0, Some(_)) => "; no values are left to estimate errors from, so they follow from `sigma`",
        (0, None) => "; no values are left to estimate errors from",
        _ => "",
    }
}
