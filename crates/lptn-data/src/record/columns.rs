//! The choice of the columns of a record.

use lptn_units::{Dimension, Type, Unit};

use crate::clock::{Clock, TIME};
use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::head::{Asked, CsvColumn, Head, Header, number};
use crate::hints::other_brackets;
use crate::moment::Moment;
use crate::record::{Extent, RecordName, RecordQuery};
use crate::spelling;
use crate::text::CsvText;

/// The columns of a record.
pub(crate) struct Choice {
    pub(crate) time: CsvColumn,
    /// The clock, if the times are dates or clock times.
    pub(crate) clock: Option<Clock>,
    pub(crate) columns: Vec<CsvColumn>,
    /// The names of columns without a unit, which are left out of a logger's file.
    pub(crate) skipped: Vec<String>,
}

/// The column of the times, and the others.
pub(crate) fn choose(
    (head, text): (&Head, &CsvText),
    first: Option<&csv::StringRecord>,
    (query, extent): (&RecordQuery, Extent),
) -> Result<Choice, Vec<Diagnostic>> {
    let nothing = csv::StringRecord::new();
    let cells = first.filter(|_| extent == Extent::Whole).unwrap_or(&nothing);
    let mut time = time((head, text), cells, query);
    // a column of times with a wrong unit is reported once
    let position = match &time {
        Ok((time, _)) => Some(time.index),
        Err(_) => wrong_time(head, query),
    };
    if let Ok((column, None)) = &time
        && let Some(problem) = Clock::unused(head, column.index, &query.csv)
    {
        time = Err(problem);
    }
    let clock = time.as_ref().ok().and_then(|(_, clock)| clock.as_ref());
    let logged = clock.is_some() || head.dialect != Dialect::PLAIN;
    let (mut skipped, mut wanted) = (Vec::new(), Vec::new());
    for index in all(head, first, position) {
        match logged && unusable(&head.columns[index]) {
            _ if clock.is_some_and(|clock| clock.takes(index)) => {}
            // the numbers of rows, as Excel and pandas write them
            _ if clock.is_some() && head.columns[index].written.is_empty() => {}
            true => skipped.push(head.columns[index].name.clone()),
            false => wanted.push(index),
        }
    }
    let chosen = match query.columns.as_slice() {
        [] => each(wanted.into_iter().map(|index| of_any(head, index, query.of_run))),
        names => each(names.iter().map(|name| named(head, name))),
    };
    skipped.retain(|_| query.columns.is_empty());
    match (time, chosen) {
        (Ok((time, clock)), Ok(columns)) => Ok(Choice { time, clock, columns, skipped }),
        (time, chosen) => {
            Err(time.err().into_iter().chain(chosen.err().into_iter().flatten()).collect())
        }
    }
}

/// True for a column without a unit that lptn knows.
fn unusable(header: &Header) -> bool {
    header.unit.as_deref().is_none_or(|unit| !spelling::is_unit(unit))
}

/// All results, or all errors.
pub(crate) fn each<T>(
    results: impl Iterator<Item = Result<T, Diagnostic>>,
) -> Result<Vec<T>, Vec<Diagnostic>> {
    let (mut found, mut problems) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(one) => found.push(one),
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

/// The columns that are read by default: those of numbers. Words under a header without unit are
/// remarks.
pub(crate) fn all(
    head: &Head,
    first: Option<&csv::StringRecord>,
    time: Option<usize>,
) -> impl Iterator<Item = usize> {
    let words = move |index: usize| {
        let cell = first.and_then(|cells| cells.get(index)).unwrap_or_default().trim();
        head.columns[index].unit.is_none() && number(cell, head.dialect.decimal).is_err()
    };
    (0..head.columns.len()).filter(move |&index| Some(index) != time && !words(index))
}

fn time(
    (head, text): (&Head, &CsvText),
    first: &csv::StringRecord,
    query: &RecordQuery,
) -> Result<(CsvColumn, Option<Clock>), Diagnostic> {
    let nobody = Asked::default();
    if let Some(asked) = &query.time {
        let ask = Asked { words: String::new(), span: asked.span.clone() };
        let index = head.find(&asked.name, &ask)?;
        return Ok(match Clock::of((head, text), (index, first), &query.csv)? {
            Some(clock) => (clock.column(), Some(clock)),
            None => (named(head, &RecordName { ty: Some(TIME), ..asked.clone() })?, None),
        });
    }
    let columns = &head.columns;
    let is_time = |header: &Header| {
        let unit = header.unit.as_deref().and_then(|unit| spelling::unit(unit).ok());
        unit.is_some_and(|unit| unit.ty == TIME)
    };
    let of_unit = columns.iter().position(|header| is_time(header) && !header.below);
    let plain = |index: usize| ["t", "time"].iter().any(|name| columns[index].name == **name);
    if let (Some(numbers), Some(moments)) = (of_unit, moments(head, first))
        && !plain(numbers)
    {
        return Err(two_times(head, [numbers, moments]));
    }
    if of_unit.is_none()
        && let Some(index) = moments(head, first)
        && let Some(clock) = Clock::of((head, text), (index, first), &query.csv)?
    {
        return Ok((clock.column(), Some(clock)));
    }
    let index = of_unit
        .or_else(|| columns.iter().position(is_time))
        .or_else(|| by_name(columns))
        .ok_or_else(|| no_time(head))?;
    Ok((head.column(index, Some(TIME), &nobody)?, None))
}

/// The names of a column of times, without regard to case.
const NAMES: [&str; 6] = ["t", "time", "zeit", "temps", "tiempo", "tempo"];

/// The column that is named as times are, or whose name ends in a unit of time. A unit that it has
/// is a wrong one, so that a column without one comes first.
fn by_name(columns: &[Header]) -> Option<usize> {
    let is_named =
        |header: &Header| NAMES.iter().any(|name| header.name.eq_ignore_ascii_case(name));
    let is_bare = |header: &Header| header.unit.is_none() && header.name != "T";
    let ends_in_time = |header: &Header| {
        let unit = other_brackets(&header.name).and_then(|(_, unit)| Unit::parse(unit).ok());
        is_bare(header) && unit.is_some_and(|unit| unit.ty == TIME)
    };
    let of = |has: &dyn Fn(&Header) -> bool| columns.iter().position(has);
    of(&|header| is_bare(header) && is_named(header))
        .or_else(|| of(&ends_in_time))
        .or_else(|| of(&is_named))
}

/// The column of the times, if its unit is wrong.
fn wrong_time(head: &Head, query: &RecordQuery) -> Option<usize> {
    match &query.time {
        Some(asked) => head.columns.iter().position(|header| header.name == asked.name),
        None => by_name(&head.columns),
    }
}

/// The error of a column of numbers and one of dates that may both be the times.
fn two_times(head: &Head, columns: [usize; 2]) -> Diagnostic {
    let [a, b] = columns.map(|index| head.columns[index].name.as_str());
    let message = format!("`{a}` and `{b}` may both be the times");
    Diagnostic::error("record::no_time", message)
        .at(head.columns[columns[0]].place.clone(), "in a unit of time")
        .also(head.columns[columns[1]].place.clone(), "dates or clock times")
        .help(format!("name one: `time = \"{b}\"` (a command: `--time \"{b}\"`)"))
}

/// Words in the names of columns of times.
const TIMES: [&str; 6] = ["time", "zeit", "date", "datum", "stamp", "uhr"];

/// The column of dates or clock times: the first with such a name, else the first.
fn moments(head: &Head, first: &csv::StringRecord) -> Option<usize> {
    let cell = |index: &usize| first.get(*index).unwrap_or_default().trim();
    let all = || (0..head.columns.len()).filter(|index| Moment::of(cell(index)).is_some());
    let named = |index: &usize| {
        let name = head.columns[*index].name.to_lowercase();
        TIMES.iter().any(|word| name.contains(word))
    };
    all().find(named).or_else(|| all().next())
}

/// A column that is asked for by name.
fn named(head: &Head, asked: &RecordName) -> Result<CsvColumn, Diagnostic> {
    head.numbers(&asked.name, asked.ty, &Asked { words: String::new(), span: asked.span.clone() })
}

/// One of all columns; see [`RecordQuery::of_run`].
pub(crate) fn of_any(head: &Head, index: usize, of_run: bool) -> Result<CsvColumn, Diagnostic> {
    let (name, nobody) = (&head.columns[index].name, Asked::default());
    let difference = of_run && matches!(head.columns[index].unit.as_deref(), Some("K" | "degR"));
    let wanted = (difference && !name.ends_with(".T")).then_some(Type::of(Dimension::TEMPERATURE));
    match head.columns[..index].iter().position(|header| header.name == *name) {
        Some(first) => Err(head.two_columns(first, index, &nobody)),
        None => head.column(index, wanted, &nobody),
    }
}

fn no_time(head: &Head) -> Diagnostic {
    let problem = Diagnostic::error("record::no_time", "no column contains the times")
        .at(head.place.clone(), "no unit here is one of time");
    if head.columns.first().is_some_and(|first| first.written.is_empty()) {
        return problem.help(
            "the first column has no name: if it contains the times, write their name and unit in \
             the header, `t [s]`",
        );
    }
    let dated = head.columns.iter().find(|header| {
        let name = header.name.to_ascii_lowercase();
        ["date", "clock", "time"].iter().any(|word| name.contains(word))
    });
    match dated {
        Some(header) => problem.help(format!(
            "times are numbers counted from any moment, in one unit: `{} [s]`",
            header.name.split(['(', '/', '[']).next().unwrap_or_default().trim()
        )),
        None if head.columns.iter().all(|header| header.unit.is_none()) => problem.help(
            "the first line that is not a comment names the columns: `t [s],ring [degC]`; \
             put `#` before the lines above it",
        ),
        None => problem.help(
            "add a column of times, `t [s]`, or correct the unit of the column with the \
                times",
        ),
    }
}
