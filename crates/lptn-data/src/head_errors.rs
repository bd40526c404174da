//! Errors of the header of a CSV file, its rows and cells.

use lptn_units::{Dimension, Type, Unit, suggest};

use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::head::{Asked, Head, Header, Row, Wrong, quoted};
use crate::hints::{other_brackets, revolutions_option, text_help, unit_option};
use crate::numeral::Decimal;
use crate::words::nearest;

impl Head {
    /// The error of `C`, which loggers write for degC.
    pub(crate) fn coulomb(&self, header: &Header) -> Diagnostic {
        let name = &header.name;
        let message = format!("`C` is the unit of charge: is column `{name}` in degC?");
        Diagnostic::error(self.codes.unit, message).help(format!(
            "write `{name} [degC]` in the header, or `units = {{ {} = \"degC\" }}` next to `csv`{}",
            quoted(name),
            self.by_option(name, Type::ABSOLUTE_TEMPERATURE)
        ))
    }

    /// The error of a column without a unit in a record.
    pub(crate) fn no_unit(&self, header: &Header, wanted: Option<Type>) -> Diagnostic {
        let name = &header.name;
        if name.is_empty() {
            let time = Type::of(Dimension::TIME);
            return self.nameless(wanted.unwrap_or(time), &Asked::default());
        }
        let problem = Diagnostic::error("record::no_unit", format!("column `{name}` has no unit"));
        let option = unit_option(name, wanted.unwrap_or(Type::ABSOLUTE_TEMPERATURE));
        if let Some((bare, unit)) = other_brackets(name) {
            return problem.help(format!(
                "write its unit in square brackets: `{bare} [{unit}]` (a command: `{option}`)"
            ));
        }
        let unit = wanted.unwrap_or(Type::ABSOLUTE_TEMPERATURE).usual_unit();
        let help = format!("give it in the header: `{name} [{unit}]`");
        let key = quoted(name);
        problem.help(match wanted {
            _ if self.dialect != Dialect::PLAIN => {
                format!(
                    "{help}, or by `units = {{ {key} = \"{unit}\" }}` next to `csv` (a command: \
                     `{option}`)"
                )
            }
            Some(_) => format!("{help} (a command: `{option}`)"),
            None => format!("{help}; a plain number is `{name} [-]`"),
        })
    }

    pub(crate) fn other_unit(
        &self,
        header: &Header,
        (wanted, found): (Type, Type),
        ask: &Asked,
    ) -> Diagnostic {
        let (name, due) = (&header.name, wanted.with_article());
        if name.is_empty() {
            return self.nameless(wanted, ask);
        }
        let (is, help) = match header.unit {
            None => ("has no unit".to_owned(), "give the column its unit in the header"),
            Some(_) => (
                format!("is {}", found.with_article()),
                "name another column, or correct the unit in the header",
            ),
        };
        let message = match ask.words.as_str() {
            "" => format!("column `{name}` {is}, but {due} is needed"),
            words => format!("{words} must be {due}, but column `{name}` {is}"),
        };
        // a unit of another quantity is not a remedy
        let option = match &header.unit {
            None => self.by_option(name, wanted),
            Some(unit) => Unit::parse(unit)
                .ok()
                .and_then(|unit| revolutions_option(name, &unit))
                .filter(|_| self.codes.of_record && wanted == Type::of(Dimension::ANGULAR_VELOCITY))
                .map_or_else(String::new, |option| format!(" (a command: `{option}`)")),
        };
        let help = format!("{help}, for example `{name} [{}]`{option}", wanted.usual_unit());
        Diagnostic::error(self.codes.unit, message).help(help)
    }

    /// The option of a command that gives a column of a record its unit.
    fn by_option(&self, name: &str, wanted: Type) -> String {
        match self.codes.of_record {
            true => format!(" (a command: `{}`)", unit_option(name, wanted)),
            false => String::new(),
        }
    }

    /// The error of a column that is read and has no name.
    fn nameless(&self, wanted: Type, ask: &Asked) -> Diagnostic {
        let message = format!("{}a column has no name and no unit", ask.subject());
        let name = if wanted == Type::of(Dimension::TIME) { "t" } else { "name" };
        Diagnostic::error(self.codes.unit, message).help(format!(
            "write both above it in the header, `{name} [{}]`, and use this name",
            wanted.usual_unit()
        ))
    }

    /// The error that there is no such column.
    pub(crate) fn no_column(&self, name: &str, ask: &Asked) -> Diagnostic {
        let message = format!("{}there is no column `{name}`", ask.subject());
        let problem = Diagnostic::error(self.codes.no_column, message);
        let problem = match &ask.span {
            Some(span) if ask.words.is_empty() => {
                problem.at(span.clone(), "").also(self.place.clone(), "the columns")
            }
            _ => ask.also(problem.at(self.place.clone(), "the columns")),
        };
        if let Some(header) = self.columns.iter().find(|header| header.written == name) {
            return problem.help(format!("name it without the unit: `{}`", header.name));
        }
        let names = || self.columns.iter().map(|header| header.name.as_str());
        if let Some((bare, unit)) =
            names().filter_map(other_brackets).find(|(bare, _)| *bare == name)
        {
            return problem.help(format!("write its unit in square brackets: `{bare} [{unit}]`"));
        }
        let near = suggest(name, names());
        problem.help(nearest(name, near.into_iter().chain(names()).take(12), "its columns are"))
    }

    pub(crate) fn two_columns(&self, first: usize, second: usize, ask: &Asked) -> Diagnostic {
        let name = &self.columns[first].name;
        let message = format!("{}two columns are named `{name}`", ask.subject());
        let problem = Diagnostic::error(self.codes.two_columns, message)
            .at(self.columns[second].place.clone(), "named again")
            .also(self.columns[first].place.clone(), "first named here");
        ask.also(problem).help(format!("rename one of them, for example `{name}_2`"))
    }

    /// The error of a row with a value after the last column: a decimal comma splits every number
    /// in two.
    pub(crate) fn extra(&self, row: &Row, ask: &Asked) -> Option<Diagnostic> {
        let columns = self.columns.len();
        let index = (columns..row.cells.len()).find(|&i| !row.cell(i).is_empty())?;
        let message =
            format!("this row has {} values, the header names {columns} columns", row.cells.len());
        let problem = Diagnostic::error(self.codes.extra_value, message)
            .at(row.place(self.file, index), "belongs to no column")
            .also(self.place.clone(), "the header");
        Some(ask.also(problem).help(extra_help(row)))
    }

    /// The error of a row with fewer cells than the header; `example` has an empty cell.
    pub(crate) fn short(&self, row: &Row, (ask, example): (&Asked, &str)) -> Diagnostic {
        let (cells, columns) = (row.cells.len(), self.columns.len());
        let message = format!("this row has {cells} of {columns} values");
        let problem = Diagnostic::error(self.codes.short_row, message)
            .at(row.whole(self.file), "")
            .also(self.place.clone(), "the header");
        ask.also(problem)
            .help(format!("a missing value is an empty cell between commas: `{example}`"))
    }

    /// The error of a cell without a number.
    pub(crate) fn no_number(
        &self,
        row: &Row,
        (index, wrong): (usize, Wrong),
        ask: &Asked,
    ) -> Diagnostic {
        let (header, cell, codes) = (&self.columns[index], row.cell(index), self.codes);
        let (name, unit) = (&header.name, header.unit.as_deref().unwrap_or_default());
        let holds = |what: &str| format!("column `{name}` contains `{cell}`, which is {what}");
        let digits = cell.chars().any(|c| c.is_ascii_digit());
        let (code, message) = match wrong {
            Wrong::Missing => {
                (codes.missing_value, format!("column `{name}` has no value in this row"))
            }
            Wrong::NotFinite => (codes.not_finite, holds("not a finite number")),
            Wrong::Text => (codes.not_a_number, holds("not a number")),
            Wrong::Moment => (codes.not_a_number, holds("not a time in the form of the first row")),
            Wrong::Cold => (
                "units::below_absolute_zero",
                format!("column `{name}` goes below absolute zero: {cell} {unit}"),
            ),
        };
        let help = match wrong {
            Wrong::Missing => "fill it in, or leave the row out".to_owned(),
            Wrong::Cold if codes.of_record => {
                "0 K is -273.15 degC; leave the cell empty if the sensor had no contact".to_owned()
            }
            Wrong::Cold => "0 K is -273.15 degC".to_owned(),
            Wrong::Moment => "each row has its date and clock time, in one form".to_owned(),
            Wrong::Text
                if self.dialect.decimal == Decimal::Comma && cell.parse::<f64>().is_ok() =>
            {
                "other numbers of this file have a decimal comma: write this one with it, without \
                 signs between thousands"
                    .to_owned()
            }
            Wrong::Text if digits || !codes.of_record => text_help(name, cell),
            _ if codes.of_record => "leave the cell empty if nothing was measured".to_owned(),
            _ => "leave the row out: an unknown value is not a point of a curve".to_owned(),
        };
        ask.also(Diagnostic::error(code, message).at(row.place(self.file, index), "")).help(help)
    }
}

/// Help for a row with more values than the header has columns: a decimal comma makes every number
/// two.
fn extra_help(row: &Row) -> &'static str {
    let whole = |i: usize| {
        let cell = row.cell(i).trim_start_matches(['+', '-']);
        !cell.is_empty() && cell.chars().all(|c| c.is_ascii_digit())
    };
    let halves = (1..row.cells.len()).any(|i| whole(i - 1) && whole(i));
    match halves {
        true => "write decimal points, not commas: `25.5`; with a comma every number is two",
        false => "name every column in the header",
    }
}
