//! The choice of the columns of a record.

use lptn_units::{Dimension, Type, Unit};

use crate::diagnostic::Diagnostic;
use crate::head::{Asked, CsvColumn, Head, Header, number};
use crate::record::{RecordName, RecordQuery};

const TIME: Type = Type::of(Dimension::TIME);

/// The column of the times, and the others.
pub(crate) fn choose(
    head: &Head,
    first: Option<&csv::StringRecord>,
    query: &RecordQuery,
) -> Result<(CsvColumn, Vec<CsvColumn>), Vec<Diagnostic>> {
    let time = time(head, query.time.as_ref());
    let position = time.as_ref().map(|time| time.index).ok();
    let chosen = match query.columns.as_slice() {
        [] => each(all(head, first, position).map(|index| of_any(head, index, query.of_run))),
        names => each(names.iter().map(|name| named(head, name))),
    };
    match (time, chosen) {
        (Ok(time), Ok(chosen)) => Ok((time, chosen)),
        (time, chosen) => {
            Err(time.err().into_iter().chain(chosen.err().into_iter().flatten()).collect())
        }
    }
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
        head.columns[index].unit.is_none() && number(cell).is_err()
    };
    (0..head.columns.len()).filter(move |&index| Some(index) != time && !words(index))
}

fn time(head: &Head, asked: Option<&RecordName>) -> Result<CsvColumn, Diagnostic> {
    if let Some(asked) = asked {
        return named(head, &RecordName { ty: Some(TIME), ..asked.clone() });
    }
    let is_time = |header: &Header| {
        let unit = header.unit.as_deref().and_then(|unit| Unit::parse(unit).ok());
        unit.is_some_and(|unit| unit.ty == TIME)
    };
    let by_name =
        |header: &Header| ["t", "time"].iter().any(|name| header.name.eq_ignore_ascii_case(name));
    let columns = &head.columns;
    let index = columns.iter().position(is_time).or_else(|| columns.iter().position(by_name));
    head.column(index.ok_or_else(|| no_time(head))?, Some(TIME), &Asked::default())
}

/// A column that is asked for by name.
fn named(head: &Head, asked: &RecordName) -> Result<CsvColumn, Diagnostic> {
    head.numbers(&asked.name, asked.ty, &Asked { words: String::new(), span: asked.span.clone() })
}

/// One of all columns; see [`RecordQuery::of_run`].
pub(crate) fn of_any(head: &Head, index: usize, of_run: bool) -> Result<CsvColumn, Diagnostic> {
    let (name, nobody) = (&head.columns[index].name, Asked::default());
    let difference = of_run && head.columns[index].unit.as_deref() == Some("K");
    let wanted = (difference && !name.ends_with(".T")).then_some(Type::of(Dimension::TEMPERATURE));
    match head.columns[..index].iter().position(|header| header.name == *name) {
        Some(first) => Err(head.two_columns(first, index, &nobody)),
        None => head.column(index, wanted, &nobody),
    }
}

fn no_time(head: &Head) -> Diagnostic {
    let problem = Diagnostic::error("record::no_time", "no column contains the times")
        .at(head.place.clone(), "no unit here is one of time");
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
