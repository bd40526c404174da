//! Lines through rises and time constants over the speed, and how columns differ in them: as text,
//! as JSON and as a table.

use lptn_fit::law::{ColumnDifference, ColumnLines, Estimate, SIGNIFICANT};
use lptn_report::{Text, TextTable};
use lptn_solve::Table;
use lptn_units::Dimension;
use serde_json::{Map, Value, json};

use super::FitRunsAnswer;
use crate::fit::law::shown::{SpeedUnit, chance, with_error};

/// A quantity that has a line.
#[derive(Clone, Copy)]
enum Of {
    Rise,
    TimeConstant,
    TimeSlope,
}

impl Of {
    /// The names of the quantity in JSON and tables.
    fn name(self) -> &'static str {
        match self {
            Self::Rise => "dT",
            Self::TimeConstant => "t_RC",
            Self::TimeSlope => "t_RC_slope",
        }
    }

    fn si_unit(self) -> String {
        let per_speed = |of: Dimension| of.checked_div(Dimension::ANGULAR_VELOCITY);
        let of = match self {
            Self::Rise => per_speed(Dimension::TEMPERATURE),
            Self::TimeConstant => Some(Dimension::TIME),
            Self::TimeSlope => per_speed(Dimension::TIME),
        };
        of.unwrap_or(Dimension::NONE).si_unit()
    }

    /// Unit for the reader, and the divisor that converts SI to it.
    fn shown(self, speed: &SpeedUnit) -> (String, f64) {
        match self {
            Self::Rise => (speed.per("K"), speed.0.scale.recip()),
            Self::TimeConstant => ("min".to_owned(), 60.0),
            Self::TimeSlope => (speed.per("s"), speed.0.scale.recip()),
        }
    }

    /// The number with its 95 % interval.
    fn with_interval(self, found: Option<Estimate>, speed: &SpeedUnit) -> String {
        let (_, scale) = self.shown(speed);
        let number = |e: Estimate| with_error(e.value / scale, Some(e.half_width / scale));
        found.map_or("-".to_owned(), number)
    }
}

/// Adds the lines of all columns and their differences; nothing if there is no interval.
pub(super) fn put(found: &FitRunsAnswer, text: &mut Text) {
    let (study, speed) = (&found.study, &found.answer.data.unit);
    if study.lines.iter().all(|lines| lines.time_constant.is_none()) {
        return;
    }
    text.section().line("Lines through all runs, ± at 95 %");
    text.section().table(table(&study.lines, speed));
    for difference in &study.differences {
        text.sentence("differ ", &differ(difference, speed));
    }
    study.lines.iter().filter_map(refuted).for_each(|line| {
        text.sentence("line   ", &line);
    });
    let errors = "the scatter between runs, at least the noise of each; offsets of sensors move all \
                  runs alike and are not in it";
    text.sentence("error  ", errors);
}

fn table(lines: &[ColumnLines], speed: &SpeedUnit) -> TextTable {
    let head = |of: Of, name: &str| format!("{name} [{}]", of.shown(speed).0);
    let slope =
        |lines: &ColumnLines| lines.time_slope.map_or("-".to_owned(), |e| chance(e.probability));
    TextTable::of(lines)
        .left("column", |lines| lines.column.as_str())
        .right(head(Of::Rise, "dT / omega"), |lines| Of::Rise.with_interval(lines.rise, speed))
        .right(head(Of::TimeConstant, "t_RC"), |lines| {
            Of::TimeConstant.with_interval(lines.time_constant, speed)
        })
        .right(head(Of::TimeSlope, "its slope"), |lines| {
            Of::TimeSlope.with_interval(lines.time_slope, speed)
        })
        .left("by chance", slope)
        .into()
}

/// `ring_gear less housing: dT 0.0012 ± 0.0015 K/rpm (p = 0.42), t_RC …`.
fn differ(difference: &ColumnDifference, speed: &SpeedUnit) -> String {
    let part = |(of, found): (Of, Option<Estimate>)| {
        let (number, unit) = (of.with_interval(found, speed), of.shown(speed).0);
        found.map(|e| format!("{} {number} {unit} ({})", of.name(), chance(e.probability)))
    };
    let parts = [(Of::Rise, difference.rise), (Of::TimeConstant, difference.time_constant)];
    let parts: Vec<String> = parts.into_iter().filter_map(part).collect();
    format!("{} less {}: {}", difference.of, difference.less, parts.join(", "))
}

/// Sentence for a column whose line does not go through the origin.
fn refuted(lines: &ColumnLines) -> Option<String> {
    let (exponent, found) = lines.exponent.filter(|(_, found)| found.probability < SIGNIFICANT)?;
    let n = with_error(exponent.value, exponent.standard_error);
    let chance = chance(found.probability);
    Some(format!("dT of {}: its exponent is {n}, not 1 ({chance})", lines.column))
}

fn estimate(of: Of, found: Option<Estimate>, speed: &SpeedUnit) -> Value {
    let of = |e: Estimate| {
        json!({
            "value": e.value,
            "unit": of.si_unit(),
            "standard_error": e.standard_error,
            "half_width_95": e.half_width,
            "probability": e.probability,
            "shown": format!("{} {}", of.with_interval(found, speed), of.shown(speed).0),
        })
    };
    found.map_or(Value::Null, of)
}

/// All lines as JSON.
pub(super) fn json(found: &FitRunsAnswer) -> Value {
    let speed = &found.answer.data.unit;
    let column = |lines: &ColumnLines| {
        let exponent = lines.exponent.map(|(exponent, found)| {
            json!({
                "value": exponent.value,
                "unit": "1",
                "standard_error": exponent.standard_error,
                "probability": found.probability,
            })
        });
        let members = json!({
            "dT": estimate(Of::Rise, lines.rise, speed),
            "dT_exponent": exponent,
            "t_RC": estimate(Of::TimeConstant, lines.time_constant, speed),
            "t_RC_slope": estimate(Of::TimeSlope, lines.time_slope, speed),
        });
        (lines.column.clone(), members)
    };
    let difference = |d: &ColumnDifference| {
        json!({
            "of": d.of,
            "less": d.less,
            "dT": estimate(Of::Rise, d.rise, speed),
            "t_RC": estimate(Of::TimeConstant, d.time_constant, speed),
        })
    };
    let columns: Map<String, Value> = found.study.lines.iter().map(column).collect();
    let differences: Value = found.study.differences.iter().map(difference).collect();
    json!({ "columns": columns, "differences": differences })
}

/// A column, the column subtracted from it, a quantity, and its estimate.
type Row<'a> = (&'a str, &'a str, Of, Estimate);

/// One row per number.
pub(super) fn sheet(found: &FitRunsAnswer) -> Table {
    let mut rows: Vec<Row<'_>> = Vec::new();
    let mut put = |of, less, quantity, found: Option<Estimate>| {
        rows.extend(found.map(|found| (of, less, quantity, found)));
    };
    for lines in &found.study.lines {
        put(&lines.column, "", Of::Rise, lines.rise);
        put(&lines.column, "", Of::TimeConstant, lines.time_constant);
        put(&lines.column, "", Of::TimeSlope, lines.time_slope);
    }
    for difference in &found.study.differences {
        put(&difference.of, &difference.less, Of::Rise, difference.rise);
        put(&difference.of, &difference.less, Of::TimeConstant, difference.time_constant);
    }
    let mut table = Table::of(&rows);
    table.label("column", |row| row.0.to_owned());
    table.label("less", |row| row.1.to_owned());
    table.label("quantity", |row| row.2.name().to_owned());
    table.label("unit", |row| row.2.si_unit());
    table.column("value", "SI", |row| row.3.value);
    table.column("standard_error", "SI", |row| row.3.standard_error);
    table.column("half_width_95", "SI", |row| row.3.half_width);
    table.column("probability", "1", |row| row.3.probability);
    table.done()
}
