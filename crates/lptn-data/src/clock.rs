//! Times from dates and clock times: seconds from the first row, or from a moment that is given.
//!
//! Nothing is guessed. A date whose order no row shows is refused unless every row has the same
//! date. A clock without a date may pass midnight: it falls by more than half a day. A smaller
//! fall, as at the end of daylight-saving time, is a time that goes back.

use lptn_units::{Dimension, Type, Unit};

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::head::{CsvColumn, Head, Wrong, number, row};
use crate::moment::{DAY, Date, DateOrder, Moment, SECOND};
use crate::options::CsvOptions;
use crate::spelling;
use crate::text::CsvText;

/// The columns of dates and clock times of a file.
pub(crate) struct Clock {
    /// The columns whose cells are one moment, the asked one first.
    parts: Vec<usize>,
    /// A column of milliseconds in addition.
    milliseconds: Option<usize>,
    order: DateOrder,
    /// The first row, whose form all others have.
    first: Moment,
    unit: Unit,
    zero: Option<i64>,
    last: Option<i64>,
    /// The time between the last two rows.
    step: Option<i64>,
    /// True if it seems that the clock was set forward just before the last row.
    forward: bool,
    days: i64,
}

const HOUR: i64 = 3600 * SECOND;

impl Clock {
    /// The clock in a column; `None` if its first cell is not a date or clock time, or if the
    /// column has a unit of time.
    ///
    /// # Errors
    /// If the order of its dates cannot be found, or `start` has another form.
    pub(crate) fn of(
        (head, text): (&Head, &CsvText),
        (index, first): (usize, &csv::StringRecord),
        options: &CsvOptions,
    ) -> Result<Option<Self>, Diagnostic> {
        let cell = |index: usize| first.get(index).unwrap_or_default().trim();
        let header = &head.columns[index];
        let unit = header.unit.as_deref().filter(|_| !header.below);
        let timed = unit.and_then(|unit| spelling::unit(unit).ok());
        let Some(moment) = Moment::of(cell(index)).filter(|_| timed.is_none()) else {
            return Ok(None);
        };
        let mut clock = Self {
            parts: vec![index],
            milliseconds: None,
            order: DateOrder::DayFirst,
            first: moment,
            unit: Unit { text: "s".to_owned(), scale: 1.0, offset: 0.0, ty: TIME },
            zero: None,
            last: None,
            step: None,
            forward: false,
            days: 0,
        };
        if let Some((at, whole)) = partner(head, first, (index, moment))? {
            clock.parts.push(at);
            clock.first = whole;
        }
        if let Some(problem) = short(&clock, (head, index), cell(index)) {
            return Err(problem);
        }
        let behind = clock.parts.iter().max().map_or(0, |last| last + 1);
        let is_part = |header: &crate::head::Header| header.name == "ms";
        clock.milliseconds = head.columns.get(behind).filter(|h| is_part(h)).map(|_| behind);
        clock.order = order((head, text), &clock.parts, options)?;
        clock.zero = clock.start((head, text), first, options)?;
        Ok(Some(clock))
    }

    /// The error of statements about dates, if the times are numbers.
    pub(crate) fn unused(head: &Head, time: usize, options: &CsvOptions) -> Option<Diagnostic> {
        let key = match (&options.start, options.dates) {
            (Some(_), _) => "start",
            (None, Some(_)) => "dates",
            (None, None) => return None,
        };
        let header = &head.columns[time];
        let message =
            format!("`{key}` is about dates and clock times: column `{}` has none", header.name);
        Some(
            Diagnostic::error(head.codes().start, message)
                .at(header.place.clone(), "the times")
                .help(format!("remove `{key}`, or name a column of dates or clock times")),
        )
    }

    /// The column, whose unit is the second.
    pub(crate) fn column(&self) -> CsvColumn {
        CsvColumn { index: self.parts[0], unit: self.unit.clone() }
    }

    /// True for a column that is a part of the times.
    pub(crate) fn takes(&self, column: usize) -> bool {
        self.parts.contains(&column) || self.milliseconds == Some(column)
    }

    /// The moment that is 0 s as the file or `start` has it.
    pub(crate) fn zero_words(&self, first: &csv::StringRecord, options: &CsvOptions) -> String {
        let mut parts = self.parts.clone();
        parts.sort_unstable();
        let cells: Vec<&str> =
            parts.iter().map(|&part| first.get(part).unwrap_or_default().trim()).collect();
        options.start.clone().unwrap_or_else(|| cells.join(" "))
    }

    /// The time of a row in s.
    ///
    /// # Errors
    /// If its cells are not a moment in the form of the first row.
    pub(crate) fn time<'c>(&mut self, cell: impl Fn(usize) -> &'c str) -> Result<f64, Wrong> {
        let mut moment = Moment::default();
        for &part in &self.parts {
            let cell = cell(part);
            if cell.is_empty() {
                return Err(Wrong::Missing);
            }
            moment = Moment::of(cell).and_then(|one| moment.with(one)).ok_or(Wrong::Moment)?;
        }
        let mut at = self.nanoseconds(moment).ok_or(Wrong::Moment)?;
        if let Some(column) = self.milliseconds {
            let more = number(cell(column), crate::numeral::Decimal::Point)?;
            at += (more * (SECOND / 1000) as f64).round() as i64;
        }
        if moment.date.is_none() {
            at += self.days * DAY;
            if self.last.is_some_and(|last| at < last && at + DAY - last < DAY / 2) {
                self.days += 1;
                at += DAY;
            }
        }
        let step = self.last.map(|last| at - last);
        self.forward = self.is_forward(moment, (at, step));
        (self.last, self.step) = (Some(at), step);
        let zero = *self.zero.get_or_insert(at);
        Ok((at - zero) as f64 / SECOND as f64)
    }

    /// True if daylight-saving time seems to begin before this row: on a Sunday an hour of the night
    /// is missing between rows that are at most an hour apart.
    fn is_forward(&self, moment: Moment, (at, step): (i64, Option<i64>)) -> bool {
        let Some((before, step)) = self.step.zip(step) else { return false };
        let missing = (step - before - HOUR).abs() <= SECOND && (1..=HOUR).contains(&before);
        let night = (0..3 * HOUR).contains(&(at - HOUR).rem_euclid(DAY));
        let sunday = moment.date.is_some_and(|date| date.may_change(self.order));
        missing && night && sunday && moment.offset.is_none()
    }

    /// The warning about the last row if the clock was set forward before it.
    pub(crate) fn change(&self, head: &Head, place: impl FnOnce() -> Span) -> Option<Diagnostic> {
        if !self.forward {
            return None;
        }
        let message = "a local clock seems to be set forward here, as at the start of \
            daylight-saving time: an hour is counted that did not pass";
        let help = "log in UTC, or write the offset after each time, `03:00:00+02:00`; if the \
            logger left out an hour, nothing is wrong";
        let warning = Diagnostic::warning(head.codes().clock_change, message);
        Some(warning.at(place(), "an hour more than between the rows above").help(help))
    }

    /// Nanoseconds from 1970, or from the first midnight of a clock without a date.
    fn nanoseconds(&self, moment: Moment) -> Option<i64> {
        let form = |m: &Moment| [m.date.is_some(), m.clock.is_some(), m.offset.is_some()];
        if form(&moment) != form(&self.first) {
            return None;
        }
        let day = moment.date.map_or(Some(0), |date| date.day(self.order))?;
        let ahead = moment.offset.unwrap_or(0) * 60 * SECOND;
        Some(day * DAY + moment.clock.unwrap_or(0) - ahead)
    }

    /// The nanoseconds that are 0 s by `start`.
    fn start(
        &self,
        (head, text): (&Head, &CsvText),
        first: &csv::StringRecord,
        options: &CsvOptions,
    ) -> Result<Option<i64>, Diagnostic> {
        let Some(start) = &options.start else { return Ok(None) };
        let moment = Moment::of(start).map(|moment| Moment {
            date: moment.date.or(self.first.date),
            offset: moment.offset.or(self.first.offset),
            ..moment
        });
        // the rows show their order by their form, and the start has another one
        let unknown = |m: &Moment| {
            let formed = self.first.date.is_some_and(|date| date.order.is_some());
            options.dates.is_none() && formed && m.date.is_some_and(|date| date.order.is_none())
        };
        let moment = moment.filter(|moment| !unknown(moment));
        let found = moment.and_then(|moment| self.nanoseconds(moment));
        found.map(Some).ok_or_else(|| {
            let place = row(first.clone(), &text.text).place(head.file(), self.parts[0]);
            let shown = self.zero_words(first, &CsvOptions::default());
            let message = format!("`start`, {start}, does not have the form of the first time");
            Diagnostic::error(head.codes().start, message)
                .at(place, "the first time")
                .help(format!("write it like this: `start = \"{shown}\"`"))
        })
    }
}

/// The other column of a moment: the one clock of a date, or the one date of the only clock.
fn partner(
    head: &Head,
    first: &csv::StringRecord,
    (index, moment): (usize, Moment),
) -> Result<Option<(usize, Moment)>, Diagnostic> {
    let bare = |at: &usize| *at != index && head.columns[*at].unit.is_none();
    let all = (0..head.columns.len()).filter(bare);
    let found = all.filter_map(|at| Some((at, Moment::of(first.get(at)?.trim())?)));
    let (dates, clocks): (Vec<_>, Vec<_>) = found
        .filter(|(_, other)| other.date.is_some() != other.clock.is_some())
        .partition(|(_, other)| other.date.is_some());
    let partners = match (moment.date.is_some(), moment.clock.is_some()) {
        (true, false) => clocks,
        // of several clocks one counts from a start, as `Elapsed` does
        (false, true) if clocks.is_empty() => dates,
        _ => return Ok(None),
    };
    match partners[..] {
        [(at, other)] => Ok(moment.with(other).map(|whole| (at, whole))),
        [(a, _), (b, _), ..] => Err(two_clocks(head, index, [a, b])),
        [] => Ok(None),
    }
}

fn two_clocks(head: &Head, index: usize, [a, b]: [usize; 2]) -> Diagnostic {
    let name = |at: usize| head.columns[at].name.as_str();
    let message = format!(
        "`{}` and `{}` may both belong to `{}`: it is not known which is the time of day",
        name(a),
        name(b),
        name(index)
    );
    Diagnostic::error(head.codes().dates, message)
        .at(head.columns[index].place.clone(), "the dates")
        .help(format!(
            "name the column of the clock times as the times, such as `{}`; a clock may pass \
             midnight once between two rows",
            name(b)
        ))
}

/// The error of a clock of two numbers and no date.
fn short(clock: &Clock, (head, index): (&Head, usize), cell: &str) -> Option<Diagnostic> {
    let two = cell.matches(':').count() == 1 && !cell.contains(|c: char| c.is_alphabetic());
    if clock.first.date.is_some() || !two {
        return None;
    }
    let message = format!("`{cell}` may be hours and minutes, or minutes and seconds");
    Some(
        Diagnostic::error(head.codes().dates, message)
            .at(head.columns[index].place.clone(), "the times")
            .help("write all three, `00:05:00`, or a column of numbers with a unit of time"),
    )
}

/// The dates of a column: how many of them allow which order.
#[derive(Default)]
struct Dates {
    first: Option<(Date, Span)>,
    /// True if a date is not the first one.
    differ: bool,
    /// True if the first or the second number of a date cannot be a month.
    above: [bool; 2],
}

/// The order of the dates.
fn order(
    (head, text): (&Head, &CsvText),
    parts: &[usize],
    options: &CsvOptions,
) -> Result<DateOrder, Diagnostic> {
    let mut dates = Dates::default();
    let counts = options.start.as_deref().and_then(Moment::of).is_some_and(|s| s.date.is_some());
    for cells in head.reader(&text.text) {
        let date = parts.iter().find_map(|&part| {
            let date = Moment::of(cells.get(part).unwrap_or_default().trim())?.date?;
            Some((date, part))
        });
        let Some((date, part)) = date else { continue };
        let place = || row(cells.clone(), &text.text).place(head.file(), part);
        match (date.order, options.dates) {
            (Some(form), Some(given)) if form != given => return Err(otherwise(head, place())),
            (_, Some(given)) => return Ok(given),
            (Some(_), None) => return Ok(DateOrder::DayFirst), // its form shows it
            (None, None) => {}
        }
        let first = dates.first.get_or_insert_with(|| (date, place())).0;
        dates.differ |= date != first;
        let [a, b, _] = date.numbers;
        dates.above = [dates.above[0] || a > 12, dates.above[1] || b > 12];
        if dates.above[1] || (dates.above[0] && !date.short) {
            break;
        }
    }
    dates.order(counts).ok_or_else(|| dates.undecided(head))
}

/// The error of an order that the form of the dates contradicts.
fn otherwise(head: &Head, place: Span) -> Diagnostic {
    Diagnostic::error(head.codes().dates, "`dates` is not the order in which the dates are written")
        .at(place, "the first date")
        .help(
            "dates with points begin with the day, dates with four digits first with the year: \
             leave `dates` out, or write the dates in another form",
        )
}

impl Dates {
    /// The order; `counts` if a given start has a date, so that the day itself matters.
    fn order(&self, counts: bool) -> Option<DateOrder> {
        let Some((first, _)) = &self.first else { return Some(DateOrder::DayFirst) };
        match self.above {
            [false, true] => Some(DateOrder::MonthFirst),
            [true, false] if !first.short => Some(DateOrder::DayFirst),
            // the same day in every row: its order has no effect on differences
            [false, false] if !self.differ && !counts => Some(DateOrder::DayFirst),
            _ => None,
        }
    }

    fn undecided(&self, head: &Head) -> Diagnostic {
        let shown = self.first.as_ref().map_or([0; 3], |(date, _)| date.numbers);
        let short = self.first.as_ref().is_some_and(|(date, _)| date.short);
        let message = format!(
            "the dates may begin with the day{}, as {:02}/{:02}/{:02} does: no row shows which",
            if short { ", the month or the year" } else { " or the month" },
            shown[0],
            shown[1],
            shown[2]
        );
        Diagnostic::error(head.codes().dates, message)
            .at(self.first.as_ref().map(|(_, place)| place.clone()), "the first date")
            .help(match short {
                true => {
                    "write `dates = \"day first\"`, `dates = \"month first\"` or `dates = \"year \
                     first\"` next to `csv`; a command has `--dates`"
                }
                false => {
                    "write `dates = \"day first\"` or `dates = \"month first\"` next to `csv`; a \
                     command has `--dates`"
                }
            })
    }
}

/// The type of times.
pub(crate) const TIME: Type = Type::of(Dimension::TIME);
