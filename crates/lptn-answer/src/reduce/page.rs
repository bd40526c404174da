//! A reduction as a page.

use std::borrow::Cow;
use std::io;

use lptn_plot::Figure;
use lptn_reduce::{Bias, Deviation, Dynamics, FitError, Judge, LeastSquaresWindow, Pair};
use lptn_report::{
    Json, Page, Report, Rows, Text, TextTable, decimals, duration, fixed, significant,
};
use lptn_study::SiValue;
use lptn_units::Unit;
use serde_json::{Value, json};

use super::ReduceAnswer;
use crate::about::{self, Known};
use crate::scale;

impl Page for ReduceAnswer {
    fn text(&self) -> Text {
        let mut text = self.judgement();
        text.append(self.input.begun());
        text.section().table(self.equivalent());
        if let Some(dynamics) = &self.reduction.dynamics {
            text.section().table(pairs(dynamics));
            let label = self.pair().and_then(|pair| dynamics.collapses(pair)) == Some(false);
            let label = if label { "nearest: " } else { "use " };
            if !self.fails() {
                text.section().sentence(label, &self.advice(dynamics));
            }
            text.append(self.loads_text());
        }
        match &self.bias {
            Some(Ok(bias)) => text.section().table(self.bias(bias)),
            Some(Err(error)) => text.section().sentence("one exponential: ", &error.to_string()),
            None => &mut text,
        };
        text.section().notes(self.notes());
        text
    }

    fn rows(&self) -> Rows<'_> {
        scale::table(self.reduction.table(), &self.unit).into()
    }

    fn no(&self) -> Option<String> {
        self.fails().then(|| self.verdict())
    }

    fn figures(&self) -> Vec<Figure> {
        self.reduction.dynamics.iter().filter_map(|dynamics| self.figure(dynamics)).collect()
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let netlist = &self.input.netlist;
        let (norton, inputs) = (&self.reduction.norton, &self.reduction.inputs);
        let boundaries = netlist.network.boundaries().iter().map(|b| Cow::from(&b.name));
        let sources = netlist.network.sources().iter().map(|s| s.name());
        self.input.head(json, self.doubts_of_state())?;
        json.member("port", &self.port)?;
        json.optional("at", self.near.as_ref().map(super::near::Near::json))?;
        json.member("verdict", &self.verdict_json())?;
        json.member("R_eq", &scalar(norton.resistance, "K/W"))?;
        json.member("T_ref", &scale::temperature(inputs.reference, &self.unit))?;
        json.member("Q_N", &scalar(inputs.heat, "W"))?;
        json.member("boundary_weights", &named(boundaries, &norton.boundary_weights))?;
        json.member("source_weights", &named(sources, &norton.source_weights))?;
        dynamics((self.reduction.dynamics.as_ref(), &self.unit), json)?;
        json.member("any_load", &self.loads_json())?;
        json.optional("bias", self.bias.as_ref().map(|bias| of_bias(bias, &self.unit)))?;
        let short = self.reduction.dynamics.as_ref().and_then(|dynamics| self.short(dynamics));
        let notes: Vec<String> = short.into_iter().chain(self.notes()).collect();
        json.member("notes", &notes)
    }
}

impl ReduceAnswer {
    /// Table of the equivalent that the port sees in steady state.
    fn equivalent(&self) -> TextTable {
        let network = &self.input.netlist.network;
        let (norton, inputs) = (&self.reduction.norton, &self.reduction.inputs);
        let boundaries = network.boundaries().iter().map(|b| Cow::from(&b.name));
        let sources = network.sources().iter().map(|s| s.name());
        let unit = &self.unit;
        let mut rows = vec![
            [
                "R_eq".to_owned(),
                format!("{} K/W", significant(norton.resistance, 5)),
                String::new(),
            ],
            [
                "T_ref".to_owned(),
                format!("{} {}", fixed(unit.from_si(inputs.reference), 2), unit.text),
                weights(boundaries, &norton.boundary_weights),
            ],
            [
                "Q_N".to_owned(),
                format!("{} W", significant(inputs.heat, 5)),
                weights(sources, &norton.source_weights),
            ],
        ];
        if let Some(step) = self.reduction.dynamics.as_ref().and_then(|d| d.step.as_ref()) {
            let slowest = step.slowest();
            let share = significant(100.0 * slowest.resistance / norton.resistance, 4);
            let what = format!("slowest time constant, {share} % of R_eq");
            rows.push(["tau_1".to_owned(), duration(slowest.tau, 5), what]);
        }
        TextTable::of(&rows)
            .left(format!("seen from {}", self.port), |row| &row[0])
            .left("", |row| &row[1])
            .left("q = Q_N - (T - T_ref) / R_eq", |row| &row[2])
            .optional()
            .into()
    }

    /// The recommended pair, and the reason.
    fn advice(&self, dynamics: &Dynamics) -> String {
        let pair = dynamics.best();
        let why = match (dynamics.recommended.by, pair.run, pair.step, dynamics.rise) {
            (Some(Judge::Run), Some(run), _, Some(rise)) => format!(
                "the smallest error over this run, {} K of a rise of {} K",
                significant(run.kelvin, 3),
                significant(rise, 3)
            ),
            (Some(Judge::Step), _, Some(step), _) => format!(
                "the smallest error for a step, {} % of the rise",
                significant(100.0 * step.relative.unwrap_or(f64::NAN), 3)
            ),
            _ => "right in the mean over every load".to_owned(),
        };
        format!(
            "R_eq {} K/W with C_eq {} J/K ({}): {why}",
            significant(self.reduction.norton.resistance, 5),
            significant(pair.capacity, 5),
            dynamics.recommended.definition.key()
        )
    }

    fn bias(&self, bias: &Bias) -> TextTable {
        let unit = &self.unit;
        let temperature = |kelvin: f64| format!("{} {}", fixed(unit.from_si(kelvin), 2), unit.text);
        let heat = match bias.relative() {
            Some(relative) => format!("{} %", signed(100.0 * relative)),
            None => "no heat was put in".to_owned(),
        };
        let varies = self.input.netlist.network.has_time_dependent_inputs();
        let mean = if varies { "as a mean; " } else { "" };
        let resistance = format!("R_eq = t_RC / C_eq = {} K/W", significant(bias.resistance, 4));
        let rows = [
            ("T_i", temperature(bias.fit.initial), "at the start".to_owned()),
            ("T_f", temperature(bias.fit.settled), "in the end".to_owned()),
            ("t_RC", duration(bias.fit.tau, 5), resistance),
            (
                "P",
                format!("{} W", significant(bias.inferred, 5)),
                "(T_f - T_i) C_eq / t_RC, with C_eq by sum".to_owned(),
            ),
            (
                "put in",
                format!("{} W", significant(bias.heat, 5)),
                format!("{mean}bias of the method: {heat}"),
            ),
        ];
        let heading = format!(
            "{} points over {}, misfit {} K rms",
            bias.points,
            duration(bias.length, 4),
            significant(bias.fit.rms, 3)
        );
        TextTable::of(&rows)
            .left("one exponential", |row| row.0)
            .left("", |row| &row.1)
            .left(heading, |row| &row.2)
            .into()
    }
}

/// `0.7 bed + 0.3 air`, the largest first.
fn weights<'a>(names: impl Iterator<Item = Cow<'a, str>>, weights: &[f64]) -> String {
    const SHOWN: usize = 3;
    let mut all: Vec<(Cow<'_, str>, f64)> =
        names.zip(weights.iter().copied()).filter(|(_, w)| *w > 0.0).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut terms: Vec<String> =
        all.iter().take(SHOWN).map(|(name, w)| format!("{} {name}", significant(*w, 4))).collect();
    if all.len() > SHOWN {
        terms.push(format!("{} more", all.len() - SHOWN));
    }
    terms.join(" + ")
}

fn signed(value: f64) -> String {
    let text = significant(value, 3);
    if value > 0.0 { format!("+{text}") } else { text }
}

/// With its sign, also if it is positive.
fn plus(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    if value > 0.0 { format!("+{text}") } else { text }
}

/// The capacities with their errors.
fn pairs(dynamics: &Dynamics) -> TextTable {
    let list = &dynamics.pairs;
    let largest = |values: &dyn Fn(&Pair) -> f64| list.iter().map(values).fold(0.0, f64::max);
    let digits = decimals(largest(&|p| p.capacity), 5, 0);
    let percent = |deviation: Option<Deviation>| {
        let relative = deviation.and_then(|d| d.relative);
        let sign = deviation.map_or(1.0, |d| 1_f64.copysign(d.signed));
        relative.map_or_else(|| "-".to_owned(), |r| plus(100.0 * r * sign, 3))
    };
    let table = TextTable::of(list)
        .left("error with C_eq by", |p| p.definition.key())
        .right("[J/K]", |p| fixed(p.capacity, digits))
        .right("step [%]", |p| percent(p.step))
        .left("at", |p| p.step.map_or(String::new(), |step| duration(step.time, 3)));
    if dynamics.rise.is_none() {
        return table.into();
    }
    let kelvin = |p: &Pair| p.run.map_or(0.0, |run| run.signed);
    // below a mK it is the runs' own tolerance that shows
    let digits = decimals(largest(&|p| kelvin(p).abs()).max(1e-3), 3, 2);
    table
        .right("run [K]", |p| plus(kelvin(p), digits))
        .right("[%]", |p| percent(p.run))
        .left("at", |p| p.run.map_or(String::new(), |r| duration(r.time, 3)))
        .into()
}

fn dynamics((dynamics, unit): (Option<&Dynamics>, &Unit), json: &mut Json<'_>) -> io::Result<()> {
    let Some(dynamics) = dynamics else {
        return ["C_eq", "errors", "recommended"]
            .into_iter()
            .try_for_each(|name| json.member(name, &Value::Null));
    };
    let by_name = |value: &dyn Fn(&lptn_reduce::Pair) -> Value| -> Value {
        dynamics.pairs.iter().map(|pair| (pair.definition.key().to_owned(), value(pair))).collect()
    };
    json.member("C_eq", &by_name(&|pair| json!(scalar(pair.capacity, "J/K"))))?;
    let errors = |pair: &lptn_reduce::Pair| {
        let run = pair.run.as_ref().map(|run| error_json(run, unit));
        let step = pair.step.as_ref().map(|step| error_json(step, unit));
        json!({ "step": step, "run": run })
    };
    json.member("errors", &by_name(&errors))?;
    json.member("recommended", dynamics.recommended.definition.key())?;
    json.member("recommended_by", &dynamics.recommended.by.map(Judge::key))?;
    let slowest = dynamics.step.as_ref().map(|step| scalar(step.slowest().tau, "s"));
    json.member("tau_1", &slowest)?;
    json.member("window", &dynamics.window.map(window))?;
    let kelvin = |value: f64| scale::of_difference(value, unit);
    json.member("rise", &dynamics.rise.map(kelvin))?;
    json.member("tolerance", &dynamics.tolerance.map(kelvin))
}

fn window(window: LeastSquaresWindow) -> Value {
    let of = match window {
        LeastSquaresWindow::Given(_) => "given",
        LeastSquaresWindow::Run(_) => "run",
        LeastSquaresWindow::TimeConstants(_) => "five time constants",
    };
    json!({ "value": window.length(), "unit": "s", "from": of })
}

pub(super) fn error_json(deviation: &Deviation, unit: &Unit) -> Value {
    json!({
        "max": scale::of_difference(deviation.kelvin, unit),
        "relative": deviation.relative.map(|relative| scalar(relative, "1")),
        "time": scalar(deviation.time, "s"),
        "signed": scale::of_difference(deviation.signed, unit),
        "good_from": deviation.good_from.map(|time| scalar(time, "s")),
    })
}

fn of_bias(bias: &Result<Bias, FitError>, unit: &Unit) -> Value {
    match bias {
        Err(error) => json!({ "code": error.code(), "message": error.to_string() }),
        Ok(bias) => json!({
            "T_i": scale::temperature(bias.fit.initial, unit),
            "T_f": scale::temperature(bias.fit.settled, unit),
            "t_RC": scalar(bias.fit.tau, "s"),
            "rms": scale::of_difference(bias.fit.rms, unit),
            "points": json!({ "value": bias.points, "unit": "1" }),
            "C_eq": scalar(bias.capacity, "J/K"),
            "R_eq": scalar(bias.resistance, "K/W"),
            "P_inferred": scalar(bias.inferred, "W"),
            "P_true": scalar(bias.heat, "W"),
            "relative": bias.relative().map(|relative| scalar(relative, "1")),
        }),
    }
}

fn scalar(value: f64, unit: &str) -> SiValue {
    SiValue::new(value, unit)
}

fn named<'a>(names: impl Iterator<Item = Cow<'a, str>>, values: &[f64]) -> Value {
    names.zip(values).map(|(name, &value)| (name.into_owned(), json!(scalar(value, "1")))).collect()
}
