//! What came of `lptn fit step`, for programs.

use lptn_fit::step::{Estimated, Off, Parted, Power, TwoExponentials};
use lptn_report::Json;
use lptn_solve::Table;
use lptn_study::Scalar;
use serde_json::{Map, Value, json};

use super::model::Model;
use super::request::Reference;
use super::{Answer, Column};
use crate::diagnostics;

/// One row for each column that has a fit.
pub(crate) fn table(answer: &Answer<'_>) -> Table {
    let unit = &answer.request.unit;
    let mut table = Table::of(&answer.columns);
    table.label("column", |column| column.column.name.clone());
    let mut put =
        |name: &str, unit: &str, value: &dyn Fn(&Column<'_>) -> f64| table.column(name, unit, value);
    put("T_i", &unit.text, &|c| unit.from_si(c.fit.initial.value));
    put("T_i_error", "K", &|c| c.fit.initial.standard_error);
    put("T_f", &unit.text, &|c| unit.from_si(c.fit.settled.value));
    put("T_f_error", "K", &|c| c.fit.settled.standard_error);
    put("t_RC", "s", &|c| c.fit.tau.value);
    put("t_RC_error", "s", &|c| c.fit.tau.standard_error);
    put("rms", "K", &|c| c.fit.rms);
    put("time_constants", "1", &|c| c.fit.time_constants());
    let mut parted = |name: &str, unit: &str, pick: fn(&Power) -> &Parted| {
        put(name, unit, &|c| pick(&c.power).value);
        put(&format!("{name}_random"), unit, &|c| pick(&c.power).random);
        put(&format!("{name}_systematic"), unit, &|c| pick(&c.power).systematic);
    };
    parted("dT", "K", |power| &power.rise);
    if answer.request.capacity.is_some() {
        parted("R_eq", "K/W", |power| &power.resistance);
        parted("P_disp", "W", |power| &power.power);
    }
    table.done()
}

pub(crate) fn json(answer: &Answer<'_>, json: &mut Json<'_>) -> std::io::Result<()> {
    let request = answer.request;
    let mut columns: Map<String, Value> = answer
        .columns
        .iter()
        .map(|c| (c.column.name.clone(), column(c, request.capacity.is_some())))
        .collect();
    for (name, code) in &answer.without {
        columns.insert((*name).to_owned(), json!({ "error": code }));
    }
    let time = |row: Option<&f64>| scalar(row.copied().unwrap_or(f64::NAN), "s");
    let reference = match &request.reference {
        Reference::Initial => "initial",
        Reference::Column(index) => request.record.columns[*index].name.as_str(),
        Reference::Value(_) => "value",
    };
    let capacity = request
        .capacity
        .as_ref()
        .map(|c| json!({ "value": c.value, "unit": "J/K", "standard_error": c.deviation }));
    let network = answer.model.as_ref().map(|model| &model.stem);
    json.member("format", &1)?;
    json.member("network", &network)?;
    json.member("record", &request.name)?;
    json.member("warnings", &diagnostics::list(&request.files, &answer.warnings))?;
    json.member("from", &time(request.record.time.first()))?;
    json.member("to", &time(request.record.time.last()))?;
    json.member("reference", reference)?;
    json.member("capacity", &capacity)?;
    json.member("sensor", &request.sensor.map(|class| scalar(class, "K")))?;
    json.member("columns", &columns)?;
    json.member("model", &answer.model.as_ref().map(model))
}

fn scalar(value: f64, unit: &str) -> Scalar {
    Scalar::new(value, unit)
}

fn estimated(number: &Estimated, unit: &str) -> Value {
    let (low, high) = number.interval();
    json!({
        "value": number.value,
        "unit": unit,
        "standard_error": number.standard_error,
        "naive_standard_error": number.naive,
        "interval_95": [low, high],
    })
}

fn parted(number: &Parted, unit: &str) -> Value {
    json!({
        "value": number.value,
        "unit": unit,
        "standard_error": number.random,
        "systematic_error": number.systematic,
        "interval_95": [number.value - number.half_width, number.value + number.half_width],
    })
}

fn column(column: &Column<'_>, with_capacity: bool) -> Value {
    let (fit, power) = (&column.fit, &column.power);
    let mut value = json!({
        "T_i": estimated(&fit.initial, "K"),
        "T_f": estimated(&fit.settled, "K"),
        "t_RC": estimated(&fit.tau, "s"),
        "rms": scalar(fit.rms, "K"),
        "samples": fit.samples,
        "gaps": fit.gaps,
        "effective_samples": fit.noise.effective,
        "resolution": fit.resolution.map(|step| scalar(step, "K")),
        "time_constants": fit.time_constants(),
        "extrapolated": fit.extrapolates().then(|| scalar(fit.beyond, "K")),
        "second_exponential": fit.second.offer.as_ref().map(two),
        "reference": {
            "value": power.reference_temperature,
            "unit": "K",
            "standard_error": power.reference_error,
            "drift": scalar(power.drift, "K"),
        },
        "dT": parted(&power.rise, "K"),
    });
    if with_capacity {
        value["R_eq"] = parted(&power.resistance, "K/W");
        value["P_disp"] = parted(&power.power, "W");
    }
    value
}

fn two(two: &TwoExponentials) -> Value {
    json!({
        "T_f": estimated(&two.settled, "K"),
        "amplitudes": two.amplitudes.iter().map(|a| estimated(a, "K")).collect::<Vec<_>>(),
        "time_constants": two.taus.iter().map(|tau| estimated(tau, "s")).collect::<Vec<_>>(),
        "rms": scalar(two.rms, "K"),
    })
}

fn model(model: &Model) -> Value {
    let off = |off: &Off, unit: &str| {
        json!({
            "network": scalar(off.real, unit),
            "fitted": scalar(off.fitted, unit),
            "bias": scalar(off.bias(), unit),
        })
    };
    let bias = &model.bias;
    json!({
        "port": model.port,
        "T_i": off(&bias.initial, "K"),
        "T_f": off(&bias.settled, "K"),
        "t_RC": off(&bias.tau, "s"),
        "P": off(&bias.power, "W"),
        "C_sum": scalar(bias.capacity, "J/K"),
        "R_eq": scalar(bias.resistance, "K/W"),
        "rms": scalar(bias.rms, "K"),
    })
}
