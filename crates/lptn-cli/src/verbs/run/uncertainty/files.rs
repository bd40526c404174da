//! Uncertain results as files and as JSON.

use lptn_network::{Item, Network};
use lptn_solve::Table;
use lptn_study::SiValue;
use lptn_study::uncertainty::{
    Answer, AnswerOf, Contribution, Discrepancy, Estimate, Lost, Uncertainty, UncertaintyMethod,
};
use lptn_units::{Dimension, Unit};
use serde_json::{Map, Value, json};

use super::Study;
use crate::words::difference;

/// The rows of `uncertainty.csv`: the time, then for each node its temperature as in `result.csv`,
/// one standard deviation and the band of 95 %.
pub(crate) fn bands(network: &Network, found: &Uncertainty, unit: &Unit) -> Table {
    let rows: Vec<usize> = (0..found.times.len()).collect();
    let mut table = Table::of(&rows);
    let mut add = |name: String, unit: &str, value: &dyn Fn(usize) -> Option<f64>| {
        table.column(name, unit, |&row| value(row).unwrap_or(f64::NAN));
    };
    add("time".into(), "s", &|row| found.times.get(row).copied());
    for bands in &found.bands {
        let name = |ending: &str| format!("{}.T{ending}", network.name_of(Item::Node(bands.node)));
        let shown =
            |values: &[f64], row: usize| values.get(row).map(|kelvin| unit.from_si(*kelvin));
        add(name(""), &unit.text, &|row| shown(&bands.value, row));
        let deviation = |row: usize| bands.deviation.get(row).map(|kelvin| kelvin / unit.scale);
        add(name(".sd"), difference(unit), &deviation);
        add(name(".low"), &unit.text, &|row| shown(&bands.low, row));
        if let Some(median) = &bands.median {
            add(name(".median"), &unit.text, &|row| shown(median, row));
        }
        add(name(".high"), &unit.text, &|row| shown(&bands.high, row));
    }
    table.done()
}

/// The rows of `ranking.csv`: for each result every parameter, the one that matters most first.
/// Effects are for one standard deviation, in the SI unit of the result.
pub(crate) fn ranking(network: &Network, found: &Uncertainty) -> Table {
    let rows: Vec<(&Answer, &Contribution)> = found
        .answers
        .iter()
        .flat_map(|answer| answer.ranking.iter().map(move |part| (answer, part)))
        .collect();
    let mut table = Table::of(&rows);
    table.label("result", |(answer, _)| answer.of.name(network));
    table.label("unit", |(answer, _)| unit_of(network, answer.of));
    table.label("parameter", |(_, part)| parameter(network, found, part.input));
    table.column("effect", "SI", |(_, part)| part.effect);
    let mut column = |name: &str, value: &dyn Fn(&Contribution) -> Option<f64>| {
        table.column(name, "1", |(_, part)| value(part).unwrap_or(f64::NAN));
    };
    column("share", &|part| Some(part.share.value));
    if matches!(found.method, UncertaintyMethod::Sobol { .. }) {
        column("share_error", &|part| part.share.error);
        column("total", &|part| part.total.map(|total| total.value));
        column("total_error", &|part| part.total?.error);
    }
    table.done()
}

/// The name of an uncertain parameter.
pub(crate) fn parameter(network: &Network, found: &Uncertainty, input: usize) -> String {
    network.name_of(Item::Parameter(found.inputs[input].parameter)).into_owned()
}

/// The SI unit of a difference of two values of an answer.
pub(crate) fn unit_of(network: &Network, of: AnswerOf) -> String {
    let dimension = match of {
        AnswerOf::End(_) | AnswerOf::Max(_) => Dimension::TEMPERATURE,
        AnswerOf::Margin(id) => network.limits()[id.index()].ty.dimension,
    };
    dimension.si_unit()
}

/// What was done: method, samples, seed, runs without a result.
pub(crate) fn method(found: &Uncertainty) -> Map<String, Value> {
    let mut members = Map::new();
    let count = |n: usize| json!({ "value": n, "unit": "1" });
    match &found.method {
        UncertaintyMethod::Linear { differences } => {
            members.insert("method".into(), json!("linear"));
            members.insert("exact".into(), json!(differences.is_none()));
        }
        UncertaintyMethod::Sobol { samples, seed, runs, lost } => {
            members.insert("method".into(), json!("sobol"));
            members.insert("samples".into(), count(*samples));
            members.insert("seed".into(), json!(seed));
            members.insert("runs".into(), count(*runs));
            members.insert("lost".into(), lost.iter().map(one_lost).collect());
        }
    }
    members
}

fn one_lost(lost: &Lost) -> Value {
    let how = if lost.refused { "refused" } else { "failed" };
    json!({
        "count": { "value": lost.count, "unit": "1" },
        "how": how,
        "code": lost.code,
        "message": lost.message,
    })
}

/// The parameters with `±` by name, in SI units.
pub(crate) fn parameters(network: &Network, found: &Uncertainty) -> Value {
    let one = |(i, input): (usize, &lptn_study::uncertainty::Uncertain)| {
        let ty = network.parameters()[input.parameter.index()].ty;
        let unit = ty.dimension.si_unit();
        let value = SiValue::new(input.value, &unit);
        let member = json!({ "value": value, "sd": SiValue::new(input.deviation, &unit) });
        (parameter(network, found, i), member)
    };
    Value::Object(found.inputs.iter().enumerate().map(one).collect())
}

/// The member `uncertainty` of the results: method, parameters, and by the name of the column or
/// limit what was found.
pub(crate) fn json(network: &Network, study: &Study) -> Value {
    let found = &study.found;
    let mut members = method(found);
    members.insert("parameters".into(), parameters(network, found));
    let mut results = Map::new();
    for answer in &found.answers {
        let (name, part) = place(network, answer.of);
        let entry = results.entry(name).or_insert_with(|| json!({}));
        if let Value::Object(entry) = entry {
            entry.insert(part.into(), of_answer(network, found, answer));
        }
    }
    members.insert("results".into(), Value::Object(results));
    if let Some(Ok(differ)) = &study.linear {
        members
            .insert("not_linear".into(), differ.iter().map(|one| differs(network, one)).collect());
    }
    members.insert("bands".into(), rows(network, found));
    Value::Object(members)
}

/// A band that straight lines give wrongly, in SI units.
fn differs(network: &Network, one: &Discrepancy) -> Value {
    let unit = match one.of {
        AnswerOf::Margin(_) => unit_of(network, one.of),
        _ => "K".to_owned(),
    };
    let scalar = |value: f64| SiValue::new(value, &unit);
    let band = |(low, high): (f64, f64)| json!({ "low": scalar(low), "high": scalar(high) });
    let (name, part) = place(network, one.of);
    let time = one.time.map(|time| SiValue::new(time, "s"));
    let part = if one.time.is_some() { "row" } else { part };
    let (linear, sampled) = (band(one.linear), band(one.sampled));
    json!({ "of": name, "part": part, "time": time, "linear": linear, "sampled": sampled })
}

fn place(network: &Network, of: AnswerOf) -> (String, &'static str) {
    match of {
        AnswerOf::End(id) => (format!("{}.T", network.name_of(Item::Node(id))), "end"),
        AnswerOf::Max(id) => (format!("{}.T", network.name_of(Item::Node(id))), "max"),
        AnswerOf::Margin(id) => (network.name_of(Item::Limit(id)).into_owned(), "margin"),
    }
}

fn of_answer(network: &Network, found: &Uncertainty, answer: &Answer) -> Value {
    let unit = unit_of(network, answer.of);
    let mut member = Map::new();
    member.insert("value".into(), json!(SiValue::new(answer.value, &unit)));
    member.insert("sd".into(), estimate(answer.deviation, &unit));
    member.insert("low".into(), estimate(answer.low, &unit));
    if let Some(median) = answer.median {
        member.insert("median".into(), estimate(median, &unit));
    }
    member.insert("high".into(), estimate(answer.high, &unit));
    if matches!(answer.of, AnswerOf::Margin(_)) {
        member.insert("probability_broken".into(), estimate(answer.below_zero, "1"));
    }
    let part = |part: &Contribution| {
        let mut ranked = Map::new();
        ranked.insert("parameter".into(), json!(parameter(network, found, part.input)));
        ranked.insert("effect".into(), json!(SiValue::new(part.effect, &unit)));
        ranked.insert("share".into(), estimate(part.share, "1"));
        ranked.extend(part.total.map(|total| ("total".to_owned(), estimate(total, "1"))));
        Value::Object(ranked)
    };
    member.insert("ranking".into(), answer.ranking.iter().map(part).collect());
    Value::Object(member)
}

fn estimate(of: Estimate, unit: &str) -> Value {
    let mut scalar = SiValue::new(of.value, unit).json();
    if let (Some(error), Value::Object(scalar)) = (of.error, &mut scalar) {
        scalar.insert("standard_error".into(), json!(error));
    }
    scalar
}

/// The bands at every row in SI units: `columns` with name and unit, and `rows` of plain numbers.
fn rows(network: &Network, found: &Uncertainty) -> Value {
    let kelvin = Unit {
        text: "K".into(),
        scale: 1.0,
        offset: 0.0,
        ty: lptn_units::Type::ABSOLUTE_TEMPERATURE,
    };
    let table = bands(network, found, &kelvin);
    let columns: Vec<Value> =
        table.columns().iter().map(|c| json!({ "name": c.name, "unit": c.unit })).collect();
    let rows: Vec<Vec<f64>> = (0..table.rows()).map(|row| table.row(row).collect()).collect();
    json!({ "columns": columns, "rows": rows })
}
