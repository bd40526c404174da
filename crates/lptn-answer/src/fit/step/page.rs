//! The exponentials of a record as a page.

use std::io;

use lptn_fit::step::{Estimated, FittedValue, Parted, Power, TwoExponentials};
use lptn_plot::Figure;
use lptn_report::{
    Align, Column as TextColumn, Json, Look, Page, Report, Rows, Text, TextTable, WIDTH, plain,
    shortened, significant, stacked,
};
use lptn_solve::Table;
use lptn_study::SiValue;
use lptn_units::{Dimension, Type, Unit};
use serde_json::{Map, Value, json};

use super::estimate::{to_error, with_error};
use super::model::Model;
use super::request::{Reference, Request};
use super::{FitStepAnswer, StepColumn};
use crate::messages;
use crate::scale;
use crate::words::difference;

const TEMPERATURE: Type = Type::ABSOLUTE_TEMPERATURE;
const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);

impl Page for FitStepAnswer {
    fn text(&self) -> Text {
        let record = &self.request.record;
        let (from, to) = (record.time.first().copied(), record.time.last().copied());
        let [from, to] = [from, to].map(|time| significant(time.unwrap_or(f64::NAN), 6));
        let name = shortened(&plain(&self.request.name), LONGEST_NAME);
        let mut text =
            Text::titled(format!("{name}: {} rows from {from} s to {to} s", record.time.len()));
        text.line(LAW);
        fits(self, text.section());
        intervals(self, text.section());
        rises(self, text.section());
        bias(self, text.section());
        text
    }

    /// One row for each column that has a fit.
    fn rows(&self) -> Rows<'_> {
        let unit = &self.request.unit;
        let mut table = Table::of(&self.columns);
        table.label("column", |column| column.column.name.clone());
        let mut put = |name: &str, unit: &str, value: &dyn Fn(&StepColumn) -> f64| {
            table.column(name, unit, value)
        };
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
        if self.request.capacity.is_some() {
            parted("R_eq", "K/W", |power| &power.resistance);
            parted("P_disp", "W", |power| &power.power);
        }
        scale::table(table.done(), unit).into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        self.report()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let request = &self.request;
        let mut columns: Map<String, Value> =
            self.columns.iter().map(|c| (c.column.name.clone(), column(c, request))).collect();
        for (name, code) in &self.without {
            columns.insert(name.clone(), json!({ "error": code }));
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
            .map(|c| json!({ "value": c.value, "unit": "J/K", "standard_error": c.deviation.map(|d| d.sigma(c.value)) }));
        let network = self.model.as_ref().map(|model| &model.stem);
        let all = [self.doubts.as_slice(), &self.problems].concat();
        json.member("format", &1)?;
        json.member("network", &network)?;
        json.member("record", &request.name)?;
        json.member("warnings", &messages::list(&request.files, &all))?;
        json.member("from", &time(request.record.time.first()))?;
        json.member("to", &time(request.record.time.last()))?;
        json.member("reference", reference)?;
        json.member("capacity", &capacity)?;
        let sensor = request.sensor.map(|class| scale::of_difference(class, &request.unit));
        json.member("sensor", &sensor)?;
        json.member("columns", &columns)?;
        json.member("model", &self.model.as_ref().map(|of| model(of, &request.unit)))?;
        if self.problems.is_empty() {
            return Ok(());
        }
        messages::failed(json, self.exit, &messages::list(&request.files, &self.problems))
    }
}

/// The law that is fitted.
pub(super) const LAW: &str = "T(t) = T_f + (T_i - T_f) exp(-t / t_RC), t from the first row";

/// Longest name of a file in a sentence.
const LONGEST_NAME: usize = 40;

/// A heading and its cell for each column of the record.
type Cells<'c> = (String, &'c dyn Fn(&StepColumn) -> String);

/// Adds a table with a row for each column of the record.
/// It becomes several below each other if it would be too wide.
fn table(answer: &FitStepAnswer, text: &mut Text, cells: &[Cells<'_>]) {
    let column = |title: &str, align, cell: &dyn Fn(&StepColumn) -> String| {
        TextColumn::new(title, align, answer.columns.iter().map(cell).collect())
    };
    let names = column("column", Align::Left, &|column| plain(&column.column.name));
    let columns = cells.iter().map(|(title, cell)| column(title, Align::Right, cell)).collect();
    let fits = |table: &TextTable| {
        table.clone().lines(Look::PLAIN).iter().all(|line| line.chars().count() <= WIDTH)
    };
    for table in stacked(&names, columns, fits) {
        text.table(table);
    }
}

pub(super) fn fits(answer: &FitStepAnswer, text: &mut Text) {
    let unit = &answer.request.unit;
    let temperature =
        |t: &Estimated| with_error(unit.from_si(t.value), t.standard_error / unit.scale);
    table(
        answer,
        text,
        &[
            (format!("T_i [{}]", unit.text), &|c| temperature(&c.fit.initial)),
            (format!("T_f [{}]", unit.text), &|c| temperature(&c.fit.settled)),
            ("t_RC [s]".to_owned(), &|c| with_error(c.fit.tau.value, c.fit.tau.standard_error)),
            (format!("rms [{}]", difference(unit)), &|c| significant(c.fit.rms / unit.scale, 3)),
            ("length/t_RC".to_owned(), &|c| significant(c.fit.time_constants(), 3)),
        ],
    );
}

/// Adds the intervals of the numbers.
pub(super) fn intervals(answer: &FitStepAnswer, text: &mut Text) {
    let unit = &answer.request.unit;
    let range = |t: &Estimated, of: &dyn Fn(f64) -> f64| {
        let (low, high) = t.interval();
        format!(
            "{} .. {}",
            to_error(of(low), t.standard_error),
            to_error(of(high), t.standard_error)
        )
    };
    let celsius = |si: f64| unit.from_si(si);
    table(
        answer,
        text,
        &[
            (format!("95 %: T_i [{}]", unit.text), &|c| range(&c.fit.initial, &celsius)),
            (format!("T_f [{}]", unit.text), &|c| range(&c.fit.settled, &celsius)),
            ("t_RC [s]".to_owned(), &|c| range(&c.fit.tau, &|s| s)),
            ("n_eff/n".to_owned(), &|c| format!("{:.0}/{}", c.fit.noise.effective, c.fit.samples)),
        ],
    );
    text.line("± is one standard error; n samples count as n_eff independent ones");
}

/// Adds dT and, with a capacity, the numbers that follow from it.
pub(super) fn rises(answer: &FitStepAnswer, text: &mut Text) {
    text.sentence("", &reference(answer));
    if let Some(capacity) = &answer.request.capacity {
        let capacity = with_error(capacity.value, capacity.sigma());
        text.sentence(
            "",
            &format!("R_eq = t_RC / C and P_disp = dT / R_eq with C = {capacity} J/K"),
        );
    }
    // one row for each number with separate errors
    let unit = &answer.request.unit;
    let rise = format!("dT [{}]", difference(unit));
    let mut rows: Vec<(String, &str, &Parted, f64)> = Vec::new();
    for column in &answer.columns {
        let power = &column.power;
        rows.push((plain(&column.column.name), &rise, &power.rise, unit.scale));
        if answer.request.capacity.is_some() {
            rows.push((String::new(), "R_eq [K/W]", &power.resistance, 1.0));
            rows.push((String::new(), "P_disp [W]", &power.power, 1.0));
        }
    }
    text.table(
        TextTable::of(&rows)
            .left("column", |row| row.0.as_str())
            .left("", |row| row.1)
            .right("", |row| to_error(row.2.value / row.3, least(row.2) / row.3))
            .right("± random", |row| error(row.2.random / row.3))
            .right("± systematic", |row| error(row.2.systematic / row.3)),
    );
}

/// The smaller error of those that exist, which gives the number of digits.
pub(super) fn least(part: &Parted) -> f64 {
    if part.systematic > 0.0 { part.random.min(part.systematic) } else { part.random }
}

pub(super) fn error(error: f64) -> String {
    to_error(error, error)
}

/// Text on the zero of dT.
fn reference(answer: &FitStepAnswer) -> String {
    let request = &answer.request;
    let shown = |kelvin: f64, error: f64| {
        let unit = &request.unit;
        format!("{} {}", with_error(unit.from_si(kelvin), error / unit.scale), unit.text)
    };
    let first = answer.columns.first().map(|column| &column.power);
    let of = match (&request.reference, first) {
        (Reference::Column(_), Some(power)) => {
            let mean = shown(power.reference_temperature, power.reference_error);
            format!("the mean of `{}`, {mean}", plain(&power.reference))
        }
        (Reference::Value(kelvin), _) => shown(*kelvin, 0.0),
        _ => "T_i of the same column".to_owned(),
    };
    let class = match request.sensor {
        Some(class) => format!("sensors to ± {} K", significant(class, 3)),
        None => "sensors taken as exact (--sensor)".to_owned(),
    };
    format!("dT = T_f less {of} (--reference); {class}")
}

/// Adds the bias of the method itself.
pub(super) fn bias(answer: &FitStepAnswer, text: &mut Text) {
    let Some(model) = &answer.model else {
        text.sentence(
            "",
            "no ± includes the bias of the method: a body of several parts does not follow a \
             single exponential; --model FILE --port NODE states it",
        );
        return;
    };
    let (unit, bias) = (&answer.request.unit, &model.bias);
    let signed =
        |value: f64| format!("{}{}", if value > 0.0 { "+" } else { "" }, significant(value, 3));
    // T_i, T_f, t_RC and P: how each is shown
    let row = |name, pick: fn(&FittedValue) -> f64| {
        let temperature = |off: &FittedValue| significant(unit.from_si(pick(off)), 6);
        let number = |off: &FittedValue| significant(pick(off), 5);
        let [initial, settled] = [&bias.initial, &bias.settled].map(temperature);
        let [tau, power] = [&bias.tau, &bias.power].map(number);
        (name, [initial, settled, tau, power])
    };
    let off = [
        bias.initial.bias() / unit.scale,
        bias.settled.bias() / unit.scale,
        bias.tau.bias(),
        bias.power.bias(),
    ];
    let rows = [
        row("the network", |off| off.real),
        row("one exponential", |off| off.fitted),
        ("bias", off.map(signed)),
    ];
    text.sentence(
        "",
        &format!(
            "bias of the method on {} at `{}`, in no ± and not subtracted:",
            shortened(&plain(&model.file), LONGEST_NAME),
            plain(&model.port)
        ),
    );
    text.table(
        TextTable::of(&rows)
            .left("", |row| row.0)
            .right(format!("T_i [{}]", unit.text), |row| &row.1[0])
            .right(format!("T_f [{}]", unit.text), |row| &row.1[1])
            .right("t_RC [s]", |row| &row.1[2])
            .right("P [W]", |row| &row.1[3]),
    );
}

fn scalar(value: f64, unit: &str) -> SiValue {
    SiValue::new(value, unit)
}

/// Type of a number, and the unit of temperatures.
type Of<'a> = (Type, &'a Unit);

fn estimated(number: &Estimated, (ty, unit): Of<'_>) -> Value {
    let at = |value: f64| scale::in_unit(value, ty, unit);
    let error = |value: f64| scale::in_unit(value, Type::of(ty.dimension), unit).0;
    let (low, high) = number.interval();
    let (value, unit) = at(number.value);
    json!({
        "value": value,
        "unit": unit,
        "standard_error": error(number.standard_error),
        "naive_standard_error": error(number.naive),
        "interval_95": [at(low).0, at(high).0],
    })
}

fn parted(number: &Parted, (ty, unit): Of<'_>) -> Value {
    let at = |value: f64| scale::in_unit(value, ty, unit).0;
    json!({
        "value": at(number.value),
        "unit": scale::in_unit(0.0, ty, unit).1,
        "standard_error": at(number.random),
        "systematic_error": at(number.systematic),
        "interval_95": [at(number.value - number.half_width), at(number.value + number.half_width)],
    })
}

fn column(column: &StepColumn, request: &Request) -> Value {
    let (fit, power, unit) = (&column.fit, &column.power, &request.unit);
    let reference = scale::in_unit(power.reference_temperature, TEMPERATURE, unit);
    let kelvin = |value: f64| scale::of_difference(value, unit);
    let mut value = json!({
        "T_i": estimated(&fit.initial, (TEMPERATURE, unit)),
        "T_f": estimated(&fit.settled, (TEMPERATURE, unit)),
        "t_RC": estimated(&fit.tau, (Type::of(Dimension::TIME), unit)),
        "rms": kelvin(fit.rms),
        "samples": fit.samples,
        "gaps": fit.gaps,
        "effective_samples": fit.noise.effective,
        "resolution": fit.resolution.map(kelvin),
        "slow_drift": fit.noise.drifts(),
        "time_constants": fit.time_constants(),
        "extrapolated": fit.extrapolates().then(|| kelvin(fit.beyond)),
        "second_exponential": fit.second.offer.as_ref().map(|of| two(of, unit)),
        "reference": {
            "value": reference.0,
            "unit": reference.1,
            "standard_error": scale::in_unit(power.reference_error, DIFFERENCE, unit).0,
            "drift": kelvin(power.drift),
        },
        "dT": parted(&power.rise, (DIFFERENCE, unit)),
    });
    if request.capacity.is_some() {
        value["R_eq"] = parted(&power.resistance, (Type::of(Dimension::RESISTANCE), unit));
        value["P_disp"] = parted(&power.power, (Type::of(Dimension::POWER), unit));
    }
    value
}

fn two(two: &TwoExponentials, unit: &Unit) -> Value {
    let list = |numbers: &[Estimated], ty: Type| {
        numbers.iter().map(|number| estimated(number, (ty, unit))).collect::<Vec<_>>()
    };
    json!({
        "T_f": estimated(&two.settled, (TEMPERATURE, unit)),
        "amplitudes": list(&two.amplitudes, DIFFERENCE),
        "time_constants": list(&two.taus, Type::of(Dimension::TIME)),
        "rms": scale::of_difference(two.rms, unit),
    })
}

fn model(model: &Model, unit: &Unit) -> Value {
    let off = |off: &FittedValue, ty: Type| {
        json!({
            "network": scale::scalar(off.real, ty, unit),
            "fitted": scale::scalar(off.fitted, ty, unit),
            "bias": scale::scalar(off.bias(), Type::of(ty.dimension), unit),
        })
    };
    let bias = &model.bias;
    json!({
        "port": model.port,
        "T_i": off(&bias.initial, TEMPERATURE),
        "T_f": off(&bias.settled, TEMPERATURE),
        "t_RC": off(&bias.tau, Type::of(Dimension::TIME)),
        "P": off(&bias.power, Type::of(Dimension::POWER)),
        "C_sum": scalar(bias.capacity, "J/K"),
        "R_eq": scalar(bias.resistance, "K/W"),
        "rms": scale::of_difference(bias.rms, unit),
    })
}
