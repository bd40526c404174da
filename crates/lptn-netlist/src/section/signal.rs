//! `[signal]`: time histories.

use lptn_data::{Diagnostic, PlacedNumbers};
use lptn_network::{AfterEnd, Course, Field, Item, Join};
use lptn_units::{
    Dimension, Interpolation, Outside, Table1, Type, Unit, format_number, parse_quantity,
};

use crate::csv_form::{DATES, DECIMAL, START, UNITS};
use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, Takes, key, shaped, text, words, words_of};
use crate::names::ValueKind;
use crate::parameters::Pending;
use crate::place::{Place, Wanted};
use crate::points::Axis;
use crate::raw::RawKind;
use crate::section::table::{COLUMN, CSV};
use crate::work::{Elaboration, stand_in};

pub(crate) const SIGNAL: SectionDeclaration = SectionDeclaration {
    name: ValueKind::Signal.section(),
    sentence: "A value that changes with the time of the run: points, or an expression in `t`.",
    role: Role::Value,
    keys: &[
        shaped(
            "t",
            "list of times or numbers",
            Takes::list(&Takes::Like),
            "times, rising",
            "[\"0 s\", \"60 s\"]",
        ),
        shaped(
            "v",
            "list of quantities or numbers",
            Takes::list(&Takes::Like),
            "values",
            "[\"0 rpm\", \"5000 rpm\"]",
        ),
        text("t_unit", "unit", "the unit of plain numbers in `t`", "\"s\""),
        text("v_unit", "unit", "the unit of plain numbers in `v`", "\"rpm\""),
        CSV,
        text("time", "name of a column", "with `csv`: the times", "\"t\""),
        COLUMN,
        DECIMAL,
        DATES,
        START,
        UNITS,
        words("interp", &words_of(&JOINS), "the interpolation between points", "\"linear\"")
            .or("`\"linear\"`"),
        words("after_end", &words_of(&AFTER), "the values after the last point", "\"hold\"")
            .or("`\"error\"`"),
        key("period", "s", "with `\"repeat\"`: the time from one start to the next", "\"60 s\"")
            .or("as long as the points"),
    ],
    either: &[&["t", "csv"], &["v", "csv"]],
    example: "{ t = [\"0 s\", \"60 s\"], v = [\"0 rpm\", \"5000 rpm\"] }",
    elsewhere: &[
        ("outside", "after its last point a signal has `after_end = \"hold\"` or `\"repeat\"`"),
        ("x", "the times of a signal are `t`"),
        ("y", "the values of a signal are `v`"),
    ],
    ..SectionDeclaration::NEW
};

const TIME: Type = Type::of(Dimension::TIME);

const JOINS: [(&str, Join); 3] =
    [("linear", Join::Linear), ("previous", Join::Previous), ("pchip", Join::Pchip)];

/// The continuation after the last point, by its word; the key `period` is separate.
#[derive(Clone, Copy, PartialEq)]
enum After {
    Error,
    Hold,
    Repeat,
}

const AFTER: [(&str, After); 3] =
    [("error", After::Error), ("hold", After::Hold), ("repeat", After::Repeat)];

impl<'a> Elaboration<'a> {
    /// Gives all signals to the builder, each after those it uses.
    pub(crate) fn signals(&mut self) {
        for pending in self.in_order(ValueKind::Signal, "netlist::signal_cycle") {
            self.signal(pending);
        }
    }

    fn signal(&mut self, mut pending: Pending<'a>) {
        let entry = pending.entry;
        let id = if let RawKind::Table(_) = entry.value.kind {
            let fields = Fields::of(&SIGNAL, pending.owner, entry, &mut self.problems);
            let course = fields.as_ref().and_then(|fields| self.course(fields, None));
            course.map(|(ty, unit, course)| {
                let id = self.builder.signal(&entry.key, ty, course);
                unit.into_iter().for_each(|unit| self.builder.show_signal_in(id, unit));
                let item = Item::Signal(id);
                if let Some(raw) = fields.as_ref().and_then(|fields| fields.get("period")) {
                    self.map.value(item, Field::Period, raw);
                }
                item
            })
        } else {
            let place = Place { owner: &pending.owner, key: "", raw: &entry.value };
            let wanted = Wanted { ty: self.type_of(&entry.key), ..Wanted::signal() };
            let given = pending.text.take().and_then(|text| self.resolve(place, text, wanted));
            given.map(|given| {
                Item::Signal(self.builder.signal_expression(&entry.key, given.input()))
            })
        };
        let item = id.unwrap_or_else(|| {
            self.names.fail(&entry.key);
            // the name is checked even if the value is wrong
            Item::Signal(self.builder.signal_expression(&entry.key, stand_in(Type::SCALAR)))
        });
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map.value(item, Field::Value, &entry.value);
    }

    /// The type of a signal, the unit of its values, and its time history, from points; of a type
    /// that may be known.
    pub(crate) fn course(
        &mut self,
        fields: &Fields<'a>,
        ty: Option<Type>,
    ) -> Option<(Type, Option<Unit>, Course)> {
        let join = self.choice(fields, "interp", &JOINS);
        let after = self.choice(fields, "after_end", &AFTER);
        let period = self.period(fields, after);
        let time = Axis { list: "t", unit: "t_unit", column: "time", ty: Some(TIME) };
        let value = Axis { list: "v", unit: "v_unit", column: "value", ty };
        let [times, values] = self.curve(fields, [time, value])?;
        let interpolation = match join? {
            Join::Pchip => Interpolation::Pchip,
            Join::Linear | Join::Previous => Interpolation::Linear,
        };
        let points = match Table1::new(
            times.numbers.clone(),
            values.numbers.clone(),
            interpolation,
            Outside::Hold,
        ) {
            Ok(points) => points,
            Err(error) => {
                self.report_points(fields, (&times, &values), ("the times", &error));
                return None;
            }
        };
        let span = points.knots().last()? - points.knots().first()?;
        let after = match after? {
            After::Error => AfterEnd::Error,
            After::Hold => AfterEnd::Hold,
            After::Repeat => {
                let period = period?;
                if let Some(problem) =
                    period.is_none().then(|| open_round(fields, &times, &values)).flatten()
                {
                    self.report(problem);
                    return None;
                }
                AfterEnd::Repeat(period.unwrap_or(span))
            }
        };
        let course = match join? {
            Join::Previous => Course::Steps { times: times.numbers, values: values.numbers, after },
            Join::Linear | Join::Pchip => Course::Curve { points, after },
        };
        Some((values.ty, values.unit, course))
    }

    /// The period, if one is written; `None` if it is wrong.
    fn period(&mut self, fields: &Fields<'a>, after: Option<After>) -> Option<Option<f64>> {
        let Some(raw) = fields.get("period") else { return Some(None) };
        if after.is_some_and(|after| after != After::Repeat) {
            self.refuse_keys(fields, &["period"], "has no effect without `after_end = \"repeat\"`");
            return None;
        }
        let place = Place { owner: &fields.owner, key: "period", raw };
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
                text.as_str()
            }
            _ => {
                self.report(fields.wrong_shape("period", raw, "a quantity"));
                return None;
            }
        };
        match parse_quantity(text, Some(TIME)) {
            Ok(quantity) => Some(Some(quantity.value)),
            Err(error) => {
                self.report(place.unit_error(&error));
                None
            }
        }
    }
}

/// Points at equal distances that do not end as they begin: hourly rows of a day end at 23 h and
/// repeat after 24 h, and a round that was closed by its last row ends at 24 h.
fn open_round(
    fields: &Fields<'_>,
    times: &PlacedNumbers,
    values: &PlacedNumbers,
) -> Option<Diagnostic> {
    let (first, last) = (*values.numbers.first()?, *values.numbers.last()?);
    let size = values.numbers.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
    let step = usual_step(&times.numbers)?;
    if (first - last).abs() <= 1e-9 * size {
        return None;
    }
    let span = times.numbers.last()? - times.numbers.first()?;
    let (scale, unit) = match &times.unit {
        Some(unit) => (unit.scale, unit.text.as_str()),
        None => (1.0, "s"),
    };
    let shown = |time: f64| {
        let rounded = format!("{:.11e}", time / scale).parse().unwrap_or(time / scale);
        format!("{} {unit}", format_number(rounded))
    };
    let message = format!(
        "{} repeats and does not end as it begins: does the last point end the cycle, or does it \
         last as long as the others?",
        fields.owner.words()
    );
    let diagnostic = Diagnostic::error("netlist::open_round", message);
    let diagnostic = diagnostic.at(values.place(values.numbers.len() - 1), "the last value");
    let diagnostic = diagnostic.also(values.place(0), "the first value");
    Some(diagnostic.also(fields.place.clone(), "repeats").help(format!(
        "write `period = \"{}\"` if the last value lasts as long as the others, or `period = \
         \"{}\"` if the next cycle begins at the last point",
        shown(span + step),
        shown(span)
    )))
}

/// The usual distance of two points, if nine of ten distances, and the last one, are equal to it.
fn usual_step(times: &[f64]) -> Option<f64> {
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let median = *sorted.get(sorted.len() / 2)?;
    let usual = |step: &&f64| (**step - median).abs() <= 1e-6 * median;
    let count = steps.iter().filter(usual).count();
    let even = steps.len() >= 2 && 10 * count >= 9 * steps.len();
    (even && steps.last().as_ref().is_some_and(usual)).then_some(median)
}
