//! Keys that say how a CSV file is written, next to the key that names it.
//!
//! A table or signal has them among its own keys. Wherever else a netlist names a file (`[import]`,
//! catalogues, sweeps, records) it is a string, or a table of the file with these keys: [`FILE`].
//! `dates` and `start` are only for files with times.

use lptn_data::{CsvOptions, DATE_ORDERS, DECIMALS, DateOrder, Decimal, Diagnostic};
use lptn_units::Unit;

use crate::fields::Owner;
use crate::format::{KeyDeclaration, SectionDeclaration, Takes, shaped, text, words, words_of};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::toml_text::{TomlFields, key as toml_key, string};

pub(crate) const DECIMAL: KeyDeclaration =
    words("decimal", &words_of(&DECIMALS), "with `csv`: the decimal sign of the file", "\",\"")
        .or("as its numbers show");

pub(crate) const DATES: KeyDeclaration = words(
    "dates",
    &words_of(&DATE_ORDERS),
    "with `csv`: the order of dates such as 01/02/2026",
    "\"day first\"",
)
.or("as the column shows");

pub(crate) const START: KeyDeclaration = text(
    "start",
    "date and clock time",
    "with `csv`: the date and clock time that is 0 s",
    "\"2026-05-03 09:00:00\"",
)
.or("those of the first row");

pub(crate) const UNITS: KeyDeclaration = shaped(
    "units",
    "table of columns",
    Takes::Each(&Takes::Text),
    "with `csv`: the units of columns whose header does not give them",
    "{ ring = \"degC\" }",
);

/// Reason why a file of plain rows has no `dates` or `start`.
const NO_TIMES: &str = "rows here have no dates or clock times: remove it";

/// A file without times, with statements about its form: `{ csv = "parts.csv", decimal = "," }`.
pub(crate) const FILE: SectionDeclaration = SectionDeclaration {
    name: "file",
    keys: &[text("csv", "file", "the file", "\"parts.csv\"").needed(), DECIMAL, UNITS],
    example: "{ csv = \"parts.csv\", decimal = \",\" }",
    elsewhere: &[
        (DATES.name, NO_TIMES),
        (START.name, NO_TIMES),
        ("separator", SEPARATOR),
        ("delimiter", SEPARATOR),
        ("encoding", "lptn finds the encoding: remove it"),
        ("file", "the name of the file is `csv`"),
        ("unit", "the units of columns are `units = { C = \"J/K\" }`"),
    ],
    ..SectionDeclaration::NEW
};

/// The sign between columns is never stated.
const SEPARATOR: &str = "the rows show the sign between columns: remove it";

/// The name of a file, alone or with its form.
pub(crate) const FORMED: Takes = Takes::Either(&[Takes::Text, Takes::Table(&FILE)]);

/// One such file, or a list of them.
pub(crate) const FORMED_FILES: Takes =
    Takes::Either(&[Takes::Text, Takes::Table(&FILE), Takes::list(&FORMED)]);

/// The names of these keys.
pub(crate) const KEYS: [&str; 4] = [DECIMAL.name, DATES.name, START.name, UNITS.name];

/// The statements of a table about its file, and the entries that are wrong.
pub(crate) fn options(table: &RawTable) -> (CsvOptions, Vec<Wrong<'_>>) {
    let (mut options, mut wrong) = (CsvOptions::default(), Vec::new());
    for entry in table.entries.iter().filter(|entry| KEYS.contains(&entry.key.as_str())) {
        if !take(&mut options, entry, &mut wrong) {
            wrong.push(Wrong { key: declaration(&entry.key), value: &entry.value });
        }
    }
    (options, wrong)
}

fn declaration(key: &str) -> &'static KeyDeclaration {
    let all: [&'static KeyDeclaration; 4] = [&DECIMAL, &DATES, &START, &UNITS];
    all.into_iter().find(|declared| declared.name == key).unwrap_or(&UNITS)
}

/// A value that a key cannot have.
pub(crate) struct Wrong<'a> {
    key: &'static KeyDeclaration,
    value: &'a RawValue,
}

impl Wrong<'_> {
    /// The error in the keys of `owner`.
    pub(crate) fn told(&self, owner: &Owner<'_>) -> Diagnostic {
        let (name, example) = (self.key.name, self.key.example);
        let wanted = match name {
            "units" => "a table of units".to_owned(),
            "start" => "a date and clock time".to_owned(),
            _ => format!("one of {}", self.key.takes()),
        };
        let message = format!("{} must be {wanted}", owner.field(name));
        let help = format!("write it like this: `{name} = {example}`");
        Diagnostic::wrong("netlist::csv_form", message, &self.value.span, help)
    }
}

/// Takes the value of an entry; false if it is wrong.
fn take<'a>(options: &mut CsvOptions, entry: &'a RawEntry, wrong: &mut Vec<Wrong<'a>>) -> bool {
    match (entry.key.as_str(), &entry.value.kind) {
        ("decimal", RawKind::String { text, .. }) => {
            options.decimal = word(&DECIMALS, text);
            options.decimal.is_some()
        }
        ("dates", RawKind::String { text, .. }) => {
            options.dates = word(&DATE_ORDERS, text);
            options.dates.is_some()
        }
        ("start", RawKind::String { text, .. }) => {
            options.start = Some(text.clone());
            true
        }
        ("units", RawKind::Table(units)) => {
            for unit in &units.entries {
                match &unit.value.kind {
                    RawKind::String { text, .. } if text == "-" || Unit::parse(text).is_ok() => {
                        options.units.push((unit.key.clone(), text.clone()));
                    }
                    _ => wrong.push(Wrong { key: &UNITS, value: &unit.value }),
                }
            }
            true
        }
        _ => false,
    }
}

fn word<T: Copy>(words: &[(&str, T)], text: &str) -> Option<T> {
    words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value)
}

/// A file as it is read: its name, or a table if its form is stated.
pub(crate) fn written(csv: &str, options: &CsvOptions) -> String {
    written_with(csv, options, ("", Vec::new()))
}

/// The same with the entries of one more key.
pub(crate) fn written_with(
    csv: &str,
    options: &CsvOptions,
    (key, entries): (&str, Vec<String>),
) -> String {
    let csv = string(csv);
    if entries.is_empty() && *options == CsvOptions::default() {
        return csv;
    }
    let mut fields = TomlFields::default();
    fields.put("csv", &csv);
    fields.table(key, entries.into_iter());
    put(options, &mut fields);
    fields.inline()
}

/// Writes the statements as they are read.
fn put(options: &CsvOptions, fields: &mut TomlFields) {
    let of_decimal = |decimal: Decimal| DECIMALS.iter().find(|(_, other)| *other == decimal);
    let of_dates = |dates: DateOrder| DATE_ORDERS.iter().find(|(_, other)| *other == dates);
    fields.maybe("decimal", options.decimal.and_then(of_decimal).map(|(word, _)| string(word)));
    fields.maybe("dates", options.dates.and_then(of_dates).map(|(word, _)| string(word)));
    fields.maybe("start", options.start.as_deref().map(string));
    let units = options.units.iter();
    fields
        .table("units", units.map(|(name, unit)| format!("{} = {}", toml_key(name), string(unit))));
}
