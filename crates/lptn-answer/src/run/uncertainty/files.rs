//! Uncertain results as files and as JSON.

use lptn_network::{Item, Network};
use lptn_solve::Table;
use lptn_study::SiValue;
use lptn_study::uncertainty::{
    Answer, AnswerOf, Contribution, Discrepancy, Estimate, Lost, Uncertainty, UncertaintyMethod,
};
use lptn_units::{Dimension, Type, Unit};
use serde_json::{Map, Value, json};

use super::Study;
use crate::scale;
use crate::words::difference;

/// The rows of `uncertainty.csv`: the time, and for each node its temperature as in `result.csv`,
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
    table.label("unit", |(answer, _)| type_of(network, answer.of).dimension.si_unit());
    table.label("parameter", |(_, part)| parameter(network, found, part.input));
    table.column("effect", "SI", |(_, part)| part.effect);
    let mut column = |name: &str, value: &dyn Fn(&Contribution) -> Option<f64>| {
        table.column(name, "1", |(_, part)| value(part).unwrap_or(f64::NAN));
    };
    column("share", &|part| Some(part.share.value));
    if matches!(found.method, UncertaintyMethod::Sobol { .. }) {
        column("share_error", &|part| part.share.error);
    }
    if matches!(found.method, UncertaintyMethod::Sobol { .. }) && !found.inputs.are_correlated() {
        column("total", &|part| part.total.map(|total| total.value));
        column("total_error", &|part| part.total?.error);
    }
    table.done()
}

/// The name of an uncertain parameter.
pub(super) fn parameter(network: &Network, found: &Uncertainty, input: usize) -> String {
    network.name_of(Item::Parameter(found.inputs[input].parameter)).into_owned()
}

/// The unit of a difference of two values of an answer, with temperatures in `unit`.
pub(super) fn unit_of((network, unit): (&Network, &Unit), of: AnswerOf) -> Unit {
    unit.shown(Type::of(type_of(network, of).dimension))
}

fn type_of(network: &Network, of: AnswerOf) -> Type {
    match of {
        AnswerOf::End(_) | AnswerOf::Max(_) => Type::ABSOLUTE_TEMPERATURE,
        AnswerOf::Margin(id) => network.limits()[id.index()].margin_type(),
    }
}

/// Method, samples, seed, and runs without a result.
fn method(found: &Uncertainty) -> Map<String, Value> {
    let mut members = Map::new();
    let count = |n: usize| json!({ "value": n, "unit": "1" });
    match &found.method {
        UncertaintyMethod::Linear { differences, .. } => {
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

/// Method, and the uncertain parameters with their correlation.
pub(crate) fn given((network, unit): (&Network, &Unit), found: &Uncertainty) -> Map<String, Value> {
    let mut members = method(found);
    members.insert("parameters".into(), parameters((network, unit), found));
    if found.inputs.are_correlated() {
        members.insert("correlation".into(), correlation(network, found));
    }
    members
}

/// The parameters with `±` by name, in SI units but for temperatures.
fn parameters((network, unit): (&Network, &Unit), found: &Uncertainty) -> Value {
    let one = |(i, input): (usize, &lptn_study::uncertainty::Uncertain)| {
        let ty = network.parameters()[input.parameter.index()].ty;
        let sd = scale::scalar(input.deviation(), Type::of(ty.dimension), unit);
        let member = json!({
            "value": scale::scalar(input.value, ty, unit),
            "sd": sd,
            "distribution": input.spread.distribution.word(),
        });
        (parameter(network, found, i), member)
    };
    Value::Object(found.inputs.iter().enumerate().map(one).collect())
}

/// The correlations of each parameter with every other.
fn correlation(network: &Network, found: &Uncertainty) -> Value {
    let all = 0..found.inputs.len();
    let between = |i: usize, j: usize| json!(found.inputs.correlations().between(i, j));
    let row = |i: usize| -> Map<String, Value> {
        all.clone().map(|j| (parameter(network, found, j), between(i, j))).collect()
    };
    let rows = all.clone().map(|i| (parameter(network, found, i), Value::Object(row(i))));
    Value::Object(rows.collect())
}

/// The member `uncertainty` of the results: method, parameters, and results by the name
/// of the column or limit.
pub(crate) fn json(network: &Network, study: &Study, unit: &Unit) -> Value {
    let found = &study.found;
    let mut members = given((network, unit), found);
    let mut results = Map::new();
    for answer in &found.answers {
        let (name, part) = place(network, answer.of);
        let entry = results.entry(name).or_insert_with(|| json!({}));
        if let Value::Object(entry) = entry {
            entry.insert(part.into(), of_answer((network, unit), found, answer));
        }
    }
    members.insert("results".into(), Value::Object(results));
    if let Some(Ok(differ)) = &study.linear {
        let differ = differ.iter().map(|one| differs(network, one, unit)).collect();
        members.insert("not_linear".into(), differ);
    }
    members.insert("bands".into(), rows(network, found, unit));
    Value::Object(members)
}

/// A band that straight lines give wrongly.
fn differs(network: &Network, one: &Discrepancy, unit: &Unit) -> Value {
    let scalar = |value: f64| scale::scalar(value, type_of(network, one.of), unit);
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

fn of_answer((network, unit): (&Network, &Unit), found: &Uncertainty, answer: &Answer) -> Value {
    let ty = type_of(network, answer.of);
    let difference = Type::of(ty.dimension);
    let value = |of: Estimate| estimate(of, ty, unit);
    let number = |of: Estimate| estimate(of, Type::of(Dimension::NONE), unit);
    let mut member = Map::new();
    member.insert("value".into(), scale::scalar(answer.value, ty, unit));
    member.insert("sd".into(), estimate(answer.deviation, difference, unit));
    member.insert("low".into(), value(answer.low));
    if let Some(median) = answer.median {
        member.insert("median".into(), value(median));
    }
    member.insert("high".into(), value(answer.high));
    if matches!(answer.of, AnswerOf::Margin(_)) {
        member.insert("probability_broken".into(), number(answer.below_zero));
    }
    let part = |part: &Contribution| {
        let mut ranked = Map::new();
        ranked.insert("parameter".into(), json!(parameter(network, found, part.input)));
        ranked.insert("effect".into(), scale::scalar(part.effect, difference, unit));
        ranked.insert("share".into(), number(part.share));
        ranked.extend(part.total.map(|total| ("total".to_owned(), number(total))));
        Value::Object(ranked)
    };
    member.insert("ranking".into(), answer.ranking.iter().map(part).collect());
    Value::Object(member)
}

fn estimate(of: Estimate, ty: Type, unit: &Unit) -> Value {
    let mut scalar = scale::scalar(of.value, ty, unit);
    if let (Some(error), Value::Object(scalar)) = (of.error, &mut scalar) {
        let error = scale::in_unit(error, Type::of(ty.dimension), unit).0;
        scalar.insert("standard_error".into(), json!(error));
    }
    scalar
}

/// The bands at every row: `columns` with name and unit, and `rows` of plain numbers.
fn rows(network: &Network, found: &Uncertainty, unit: &Unit) -> Value {
    let table = bands(network, found, unit);
    let columns: Vec<Value> =
        table.columns().iter().map(|c| json!({ "name": c.name, "unit": c.unit })).collect();
    let rows: Vec<Vec<f64>> = (0..table.rows()).map(|row| table.row(row).collect()).collect();
    json!({ "columns": columns, "rows": rows })
}
