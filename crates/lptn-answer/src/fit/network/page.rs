//! A fit of a network as a page.

use std::io;

use lptn_fit::least_squares::Side;
use lptn_fit::network::{ColumnMisfit, Combination, FittedParameter, Profile, Unseparated};
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Text, TextTable, decimals, differing, fixed, significant,
};
use lptn_solve::Gradient;
use lptn_solve::Table;
use lptn_study::SiValue;
use serde_json::{Map, Value, json};

use super::units::common;
use super::words::{combination, estimated, state, type_of, verdict};
use super::{FitNetworkAnswer, shared_noise};
use crate::messages;
use crate::words::{count, symbol, unverified};

impl FitNetworkAnswer {
    /// The values of parameters and of sensors.
    pub(super) fn values(&self, text: &mut Text) {
        let (parameters, of_sensors) = self.estimated();
        text.section().table(values(self, &parameters));
        if !of_sensors.is_empty() {
            text.section().table(sensors(self, &of_sensors));
        }
    }

    /// The misfits and the correlations.
    pub(super) fn details(&self, text: &mut Text) {
        text.section().table(misfits(self));
        if let Some(table) = correlations(self) {
            text.section().table(table);
        }
    }
}

impl Page for FitNetworkAnswer {
    fn text(&self) -> Text {
        let fit = &self.fit;
        let mut text = Text::titled(self.input.title());
        text.line(format!(
            "fit {}: {} to {} of {}",
            self.study.name,
            estimated(self),
            count(fit.samples(), "value"),
            count(self.task.runs.len(), "record")
        ));
        self.values(&mut text);
        self.details(&mut text);
        text.conclude(13, notes(self), &verdict(self));
        text
    }

    /// One row for each parameter, in its unit.
    fn rows(&self) -> Rows<'_> {
        let all: Vec<usize> = (0..self.fit.parameters.len()).collect();
        let parameter = |i: usize| &self.fit.parameters[i];
        let error = |i: usize| {
            parameter(i).standard_error.map_or(f64::NAN, |se| self.shown_difference(i, se))
        };
        let mut table = Table::of(&all);
        table.label("parameter", |&i| self.name(i).to_owned());
        table.label("unit", |&i| self.units[i].text.clone());
        table.label("state", |&i| state(self, i).to_owned());
        table.column("value", "unit", |&i| self.shown(i, parameter(i).value));
        table.column("standard_error", "unit", |&i| error(i));
        let half = |i: usize| {
            parameter(i).half_width.map_or(f64::NAN, |half| self.shown_difference(i, half))
        };
        table.column("half_width_95", "unit", |&i| half(i));
        let end = |i: usize, side: usize| {
            let end = interval(parameter(i)).and_then(|ends| ends[side]);
            end.map_or(f64::NAN, |si| self.shown(i, si))
        };
        table.column("low_95", "unit", |&i| end(i, 0));
        table.column("high_95", "unit", |&i| end(i, 1));
        table.column("start", "unit", |&i| self.shown(i, parameter(i).start));
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        self.report()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (netlist, fit) = (&self.input.netlist, &self.fit);
        let warnings = [netlist.warnings.as_slice(), &self.doubts].concat();
        let all = 0..fit.parameters.len();
        let (parameters, of_sensors) = self.estimated();
        let values = |of: &[usize]| -> Map<String, Value> {
            of.iter().map(|&i| (self.name(i).to_owned(), parameter(self, i))).collect()
        };
        let row = |i: usize| -> Map<String, Value> {
            all.clone().map(|j| (self.name(j).to_owned(), json!(fit.correlation(i, j)))).collect()
        };
        let correlation: Map<String, Value> =
            all.clone().map(|i| (self.name(i).to_owned(), Value::Object(row(i)))).collect();
        let known = fit.identifiability.as_ref();
        let starts = fit.starts;
        json.member("format", &1)?;
        json.member("network", &self.input.text.stem)?;
        json.member("study", &self.study.name)?;
        json.member("warnings", &messages::list(&netlist.files, &warnings))?;
        json.member("parameters", &values(&parameters))?;
        if !of_sensors.is_empty() {
            json.member("sensors", &values(&of_sensors))?;
        }
        json.member("rms", &SiValue::new(fit.rms, &common(&self.task)))?;
        json.member("samples", &fit.samples())?;
        json.member("columns", &columns(self))?;
        json.member("shared_noise", &shared_noise::json(self))?;
        json.member("correlation", &correlation)?;
        json.member("identifiable", &self.is_whole())?;
        json.member("rank", &known.map(|known| known.rank))?;
        json.member("singular_values", &known.map(|known| &known.singular_values))?;
        json.member("unidentified", &unidentified(self))?;
        json.member("verdict", &verdict(self))?;
        json.member(
            "starts",
            &json!({
                "tried": starts.tried,
                "same": starts.same,
                "other": starts.other,
                "failed": starts.failed,
            }),
        )?;
        json.member(
            "gradient",
            if fit.gradient == Gradient::Exact { "exact" } else { "differences" },
        )
    }

    fn no(&self) -> Option<String> {
        (!self.is_whole()).then(|| verdict(self))
    }
}

/// Digits of a value without a standard error.
const DIGITS: usize = 6;

/// A value and its standard error with two digits of the error.
fn with_error(value: f64, error: Option<f64>) -> (String, String) {
    match error {
        Some(error) if error > 0.0 && error.is_finite() => {
            let digits = decimals(error, 2, 0);
            let size = value.abs().log10().floor();
            if (1e-3..1e6).contains(&value.abs()) && digits <= 9 {
                return (fixed(value, digits), fixed(error, digits));
            }
            let digits = (size - error.log10().floor()).max(0.0);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "below 700"
            )]
            let digits = 2 + digits.min(15.0) as usize;
            (significant(value, digits), significant(error, 2))
        }
        _ => (significant(value, DIGITS), String::new()),
    }
}

fn cells(answer: &FitNetworkAnswer, i: usize) -> (String, String) {
    let parameter = &answer.fit.parameters[i];
    let error = parameter.standard_error.map(|error| answer.shown_difference(i, error));
    with_error(answer.shown(i, parameter.value), error)
}

/// Half the width of the 95 % interval; the interval itself if it is not symmetric.
fn half_width(answer: &FitNetworkAnswer, i: usize) -> String {
    if let Some(profile) = answer.fit.parameters[i].profile {
        return one_sided(answer, i, profile);
    }
    let half = answer.fit.parameters[i].half_width;
    half.map_or_else(String::new, |half| significant(answer.shown_difference(i, half), 2))
}

/// "below 900", "above 3", "2.1 to 9".
fn one_sided(answer: &FitNetworkAnswer, i: usize, profile: Profile) -> String {
    let shown = |si: f64| significant(answer.shown(i, si), 3);
    match (profile.low, profile.high) {
        (Some(low), Some(high)) => format!("{} to {}", shown(low), shown(high)),
        (None, Some(high)) => format!("below {}", shown(high)),
        (Some(low), None) => format!("above {}", shown(low)),
        (None, None) => "open".to_owned(),
    }
}

/// State of a parameter, unless it is `free`.
fn remark(answer: &FitNetworkAnswer, i: usize) -> &'static str {
    Some(state(answer, i)).filter(|state| *state != "free").unwrap_or_default()
}

pub(in crate::fit) fn values(answer: &FitNetworkAnswer, all: &[usize]) -> TextTable {
    let bound = |i: usize, si: f64| match si.is_finite() {
        true => significant(answer.shown(i, si), 4),
        false => String::new(),
    };
    TextTable::of(all)
        .left("parameter", |&i| answer.name(i))
        .names()
        .right("value", |&i| cells(answer, i).0)
        .right("std. error", |&i| cells(answer, i).1)
        .right("95 % ±", |&i| half_width(answer, i))
        .left("unit", |&i| symbol(&answer.units[i].text))
        .right("start", |&i| significant(answer.shown(i, answer.fit.parameters[i].start), 4))
        .right("from", |&i| bound(i, answer.unknowns[i].bounds.0))
        .optional()
        .right("to", |&i| bound(i, answer.unknowns[i].bounds.1))
        .optional()
        .left("", |&i| remark(answer, i))
        .into()
}

fn sensors(answer: &FitNetworkAnswer, all: &[usize]) -> TextTable {
    let before = |i: usize| {
        let unknown = &answer.unknowns[i];
        let own = significant(answer.shown(i, unknown.own), 4);
        match unknown.prior {
            Some(prior) => format!("{own} ± {}", significant(answer.shown_difference(i, prior), 3)),
            None => "nothing".to_owned(),
        }
    };
    TextTable::of(all)
        .left("sensor", |&i| answer.name(i))
        .names()
        .right("value", |&i| cells(answer, i).0)
        .right("std. error", |&i| cells(answer, i).1)
        .right("95 % ±", |&i| half_width(answer, i))
        .left("unit", |&i| symbol(&answer.units[i].text))
        .left("known before", |&i| before(i))
        .left("", |&i| remark(answer, i))
        .into()
}

/// The name of a column, with its record if there are several.
fn column_name(answer: &FitNetworkAnswer, misfit: &ColumnMisfit) -> String {
    let name = &answer.task.runs[misfit.run].columns[misfit.column].name;
    let records: Vec<String> = answer.task.runs.iter().map(|run| run.name.clone()).collect();
    match records.len() > 1 {
        true => format!("{name} ({})", differing(&records)[misfit.run]),
        false => name.clone(),
    }
}

fn misfits(answer: &FitNetworkAnswer) -> TextTable {
    // columns in different units name them one by one
    let unit = answer.task.unit().map(|ty| format!(" [{}]", symbol(&ty.dimension.si_unit())));
    let unit = unit.unwrap_or_default();
    let mut table = TextTable::of(&answer.fit.columns)
        .left("column", |misfit| column_name(answer, misfit))
        .names()
        .right(format!("misfit rms{unit}"), |misfit| significant(misfit.rms, 3))
        .right(format!("mean{unit}"), |misfit| significant(misfit.mean, 2))
        .right(format!("sigma{unit}"), |m| {
            m.sigma.map_or("-".to_owned(), |sigma| significant(sigma, 3))
        });
    if unit.is_empty() {
        table = table.left("unit", |misfit| answer.unit_of(misfit));
    }
    table
        .right("values", |misfit| misfit.samples.to_string())
        .right("independent", |misfit| significant(misfit.effective.round(), 6))
        .into()
}

/// Parameters that are shown with their correlations, at most: more do not fit a line.
const MOST: usize = 7;

fn correlations(answer: &FitNetworkAnswer) -> Option<TextTable> {
    let mut known: Vec<usize> = (0..answer.fit.parameters.len())
        .filter(|&i| answer.fit.correlation(i, i).is_some())
        .collect();
    if known.len() > MOST {
        // those of the network alone may fit
        known.retain(|&i| answer.unknowns[i].parameter().is_some());
    }
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

pub(super) fn notes(answer: &FitNetworkAnswer) -> Vec<(&'static str, String)> {
    let fit = &answer.fit;
    let unit = answer.task.unit().map(|ty| ty.dimension.si_unit());
    let unit = unit.unwrap_or_else(|| "sigma".to_owned());
    let mut notes = vec![(
        "misfit",
        format!("{} {unit} rms over all {} values", significant(fit.rms, 4), fit.samples()),
    )];
    notes.extend(unverified(&answer.input.netlist.network).map(|unsure| ("note", unsure)));
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
            format!("differences of runs, for {}", why.describe(&answer.task.network))
        }
    };
    notes.push(("gradient", format!("{how}; all records were run {} times", fit.evaluations)));
    notes.extend(shared_noise::text(answer).map(|said| ("shared noise", said)));
    if let Some(known) = &fit.identifiability {
        let values: Vec<String> =
            known.singular_values.iter().map(|value| significant(*value, 3)).collect();
        notes.push((
            "determined",
            format!(
                "{} of {}; singular values {}",
                known.rank,
                fit.parameters.len(),
                values.join(", ")
            ),
        ));
    }
    notes
}

/// In SI units; a temperature is in the unit in which it is shown, as all of an object are.
pub(in crate::fit) fn parameter(answer: &FitNetworkAnswer, i: usize) -> Value {
    let (fitted, varied) = (&answer.fit.parameters[i], &answer.unknowns[i]);
    let shown = varied.ty.absolute;
    let unit = if shown { answer.units[i].text.clone() } else { varied.ty.dimension.si_unit() };
    let value = |si: f64| if shown { answer.shown(i, si) } else { si };
    let apart = |si: f64| if shown { answer.shown_difference(i, si) } else { si };
    let finite = |si: f64| si.is_finite().then(|| value(si));
    let side = fitted.on_bound.map(|side| if side == Side::Lower { "from" } else { "to" });
    json!({
        "value": value(fitted.value),
        "unit": unit,
        "standard_error": fitted.standard_error.map(apart),
        "interval_95": interval(fitted).map(|ends| ends.map(|end| end.map(value))),
        "degrees_of_freedom": fitted.degrees_of_freedom.filter(|degrees| degrees.is_finite()),
        "between_records": fitted.between.map(|between| json!({
            "ratio": between.ratio,
            "standard_error": apart(between.standard_error),
            "degrees_of_freedom": between.degrees_of_freedom,
            "differ": between.differ,
        })),
        "start": value(fitted.start),
        "from": finite(varied.bounds.0),
        "to": finite(varied.bounds.1),
        "prior": varied.prior.map(apart),
        "on_bound": side,
    })
}

/// The two ends in SI units; `null` for one that the records leave open.
fn interval(fitted: &FittedParameter) -> Option<[Option<f64>; 2]> {
    let even = fitted.half_width.map(|half| [fitted.value - half, fitted.value + half].map(Some));
    fitted.profile.map(|profile| [profile.low, profile.high]).or(even)
}

fn columns(answer: &FitNetworkAnswer) -> Value {
    let column = |misfit: &lptn_fit::network::ColumnMisfit| {
        let (run, unit) = (&answer.task.runs[misfit.run], answer.unit_of(misfit));
        json!({
            "record": run.name,
            "column": run.columns[misfit.column].name,
            "rms": SiValue::new(misfit.rms, &unit),
            "mean": SiValue::new(misfit.mean, &unit),
            "sigma": misfit.sigma.map(|sigma| SiValue::new(sigma, &unit)),
            "samples": misfit.samples,
            "effective_samples": misfit.effective,
            "slow_drift": misfit.slow_drift,
        })
    };
    answer.fit.columns.iter().map(column).collect()
}

/// Parameters that the records do not determine: first those that no column depends on,
/// then those that cannot be distinguished.
fn unidentified(answer: &FitNetworkAnswer) -> Value {
    let Some(known) = &answer.fit.identifiability else { return Value::Null };
    let unfelt = known
        .unfelt
        .iter()
        .map(|&i| json!({ "parameters": [answer.name(i)], "missing": 1, "determined": [] }));
    unfelt.chain(known.unseparated.iter().map(|group| unseparated(answer, group))).collect()
}

fn unseparated(answer: &FitNetworkAnswer, group: &Unseparated) -> Value {
    let names: Vec<&str> = group.parameters.iter().map(|&i| answer.name(i)).collect();
    let one = |c: &Combination| {
        let unit = type_of(answer, c).map_or_else(String::new, |ty| ty.dimension.si_unit());
        json!({ "combination": combination(answer, c), "value": SiValue::new(c.value, &unit) })
    };
    let determined: Option<Value> =
        group.determined.as_ref().map(|all| all.iter().map(one).collect());
    json!({ "parameters": names, "missing": group.missing, "determined": determined })
}
