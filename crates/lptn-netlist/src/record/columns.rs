//! Which columns of a record are meant, and in which units they are.

use lptn_units::{Dimension, Type, Unit, suggest};

use crate::csv_form::other_brackets;
use crate::csv_head::{Head, Header, number};
use crate::diagnostic::Diagnostic;
use crate::points::fit;
use crate::record::{RecordName, RecordQuery};
use crate::vocabulary::list;

const TIME: Type = Type::of(Dimension::TIME);

/// A column that is read: its position in the rows, and its unit.
pub(crate) struct Chosen {
    pub(crate) index: usize,
    pub(crate) unit: Unit,
}

/// The column of the times, and the others.
pub(crate) fn choose(
    head: &Head,
    first: Option<&csv::StringRecord>,
    query: &RecordQuery,
) -> Result<(Chosen, Vec<Chosen>), Vec<Diagnostic>> {
    let mut problems = Vec::new();
    let time = kept(time(head, query.time.as_ref()), &mut problems);
    let position = time.as_ref().map(|time| time.index);
    let chosen: Vec<Option<Chosen>> = match query.columns.as_slice() {
        [] => all(head, first, position).map(|index| kept(of_any(head, index), &mut problems)).collect(),
        names => names.iter().map(|name| kept(named(head, name), &mut problems)).collect(),
    };
    let chosen: Option<Vec<Chosen>> = chosen.into_iter().collect();
    match (time, chosen) {
        (Some(time), Some(chosen)) if problems.is_empty() => Ok((time, chosen)),
        _ => Err(problems),
    }
}

fn kept<T>(result: Result<T, Diagnostic>, problems: &mut Vec<Diagnostic>) -> Option<T> {
    result.map_err(|problem| problems.push(problem)).ok()
}

/// The columns that are read where none is named: those of numbers. Words under a header without unit are remarks.
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

fn time(head: &Head, asked: Option<&RecordName>) -> Result<Chosen, Diagnostic> {
    if let Some(asked) = asked {
        return named(head, &RecordName { ty: Some(TIME), ..asked.clone() });
    }
    let is_time = |header: &Header| {
        let unit = header.unit.as_deref().and_then(|unit| Unit::parse(unit).ok());
        unit.is_some_and(|unit| unit.ty == TIME)
    };
    let by_name = |header: &Header| ["t", "time"].iter().any(|name| header.name.eq_ignore_ascii_case(name));
    let columns = &head.columns;
    let index = columns.iter().position(is_time).or_else(|| columns.iter().position(by_name));
    match index {
        Some(index) => unit(head, (index, Some(TIME)), None).map(|unit| Chosen { index, unit }),
        None => Err(no_time(head)),
    }
}

/// A column that is asked for by name.
fn named(head: &Head, asked: &RecordName) -> Result<Chosen, Diagnostic> {
    let mut found = (0..head.columns.len()).filter(|&i| head.columns[i].name == asked.name);
    let index = match (found.next(), found.next()) {
        (Some(first), Some(second)) => Err(also(two_columns(head, first, second), asked)),
        (Some(index), None) => Ok(index),
        (None, _) => Err(no_column(head, asked)),
    }?;
    let unit = unit(head, (index, asked.ty), Some(asked))?;
    Ok(Chosen { index, unit })
}

/// One of all columns.
pub(crate) fn of_any(head: &Head, index: usize) -> Result<Chosen, Diagnostic> {
    let name = &head.columns[index].name;
    match head.columns[..index].iter().position(|header| header.name == *name) {
        Some(first) => Err(two_columns(head, first, index)),
        None => unit(head, (index, None), None).map(|unit| Chosen { index, unit }),
    }
}

/// The unit of a column; `K` alone is a point on the scale: a sensor measures no difference.
fn unit(
    head: &Head,
    (index, wanted): (usize, Option<Type>),
    asked: Option<&RecordName>,
) -> Result<Unit, Diagnostic> {
    let header = &head.columns[index];
    let at = |problem: Diagnostic| {
        let problem = problem.at(header.place.clone(), "");
        asked.map_or_else(|| problem.clone(), |asked| also(problem.clone(), asked))
    };
    let Some(text) = header.unit.as_deref() else { return Err(at(no_unit(header, wanted))) };
    let text = if text == "-" { "1" } else { text };
    let unit = Unit::parse(text).map_err(|error| {
        let problem =
            Diagnostic::error(error.code(), format!("the unit of column `{}`: {error}", header.name));
        at(match error.help() {
            Some(help) => problem.help(help),
            None => problem,
        })
    })?;
    let kelvin = unit.ty == Type::of(Dimension::TEMPERATURE);
    let unit =
        if kelvin && wanted.is_none() { Unit { ty: Type::ABSOLUTE_TEMPERATURE, ..unit } } else { unit };
    fit(unit, wanted).map_err(|(wanted, found)| {
        let (wanted_words, found) = (wanted.with_article(), found.with_article());
        let message = format!("column `{}` is {found}, but {wanted_words} is due", header.name);
        let help = format!(
            "name another column, or correct the unit in the header, for example `{} [{}]`",
            header.name,
            wanted.usual_unit()
        );
        at(Diagnostic::error("record::unit", message)).help(help)
    })
}

fn also(problem: Diagnostic, asked: &RecordName) -> Diagnostic {
    match &asked.span {
        Some(span) => problem.also(span.clone(), "read here"),
        None => problem,
    }
}

fn no_unit(header: &Header, wanted: Option<Type>) -> Diagnostic {
    let name = &header.name;
    let problem = Diagnostic::error("record::no_unit", format!("column `{name}` has no unit"));
    if let Some((bare, unit)) = other_brackets(name) {
        return problem.help(format!("write its unit in square brackets: `{bare} [{unit}]`"));
    }
    let unit = wanted.unwrap_or(Type::ABSOLUTE_TEMPERATURE).usual_unit();
    let help = format!("give it in the header: `{name} [{unit}]`");
    problem.help(if wanted.is_some() { help } else { format!("{help}; a plain number is `{name} [-]`") })
}

fn no_column(head: &Head, asked: &RecordName) -> Diagnostic {
    let message = format!("there is no column `{}`", asked.name);
    let problem = Diagnostic::error("record::no_column", message);
    let problem = match &asked.span {
        Some(span) => problem.at(span.clone(), "").also(head.place.clone(), "the columns"),
        None => problem.at(head.place.clone(), "the columns"),
    };
    let names = || head.columns.iter().map(|header| header.name.as_str());
    let with_unit = head.columns.iter().find(|header| header.written == asked.name);
    let bracketed = names().find(|name| other_brackets(name).is_some_and(|(bare, _)| bare == asked.name));
    if let Some(header) = with_unit {
        return problem.help(format!("name it without the unit: `{}`", header.name));
    }
    if let Some((bare, unit)) = bracketed.and_then(other_brackets) {
        return problem.help(format!("write its unit in square brackets: `{bare} [{unit}]`"));
    }
    match suggest(&asked.name, names()) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem.help(format!("its columns are {}", list(&names().take(12).collect::<Vec<_>>()))),
    }
}

fn two_columns(head: &Head, first: usize, second: usize) -> Diagnostic {
    let name = &head.columns[first].name;
    Diagnostic::error("record::two_columns", format!("two columns are named `{name}`"))
        .at(head.columns[second].place.clone(), "named again")
        .also(head.columns[first].place.clone(), "first named here")
        .help(format!("rename one of them, for example `{name}_2`"))
}

fn no_time(head: &Head) -> Diagnostic {
    let problem = Diagnostic::error("record::no_time", "no column holds the times")
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
            "the first line that is no comment names the columns: `t [s],ring [degC]`; \
             put `#` before the lines above it",
        ),
        None => {
            problem.help("add a column of times, `t [s]`, or correct the unit of the one that holds them")
        }
    }
}
