//! CSV files that tables and signals read: what stands in which column, and where.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn_units::Type;

use crate::csv_form;
use crate::csv_head::{Head, Row, number, reader, row};
use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Files, Span};
use crate::include::{Loader, reason};
use crate::limits::MOST_PROBLEMS;
use crate::near_file;
use crate::points::{Places, Points};
use crate::raw::{RawKind, RawNetlist, RawTable, RawValue};
use crate::value::Place;
use crate::vocabulary::IMPORT;

/// The sections in which `csv` names a file of numbers.
const READERS: [&str; 4] = ["table", "signal", "material", "fluid"];

/// A header as it could be.
const EXAMPLE: &str = "t [s],speed [rpm]";

/// The key that names the file.
const CSV: &str = "csv";

/// The CSV files of a netlist, by the place that names each.
#[derive(Debug, Default)]
pub(crate) struct CsvFiles {
    files: HashMap<Span, Result<Arc<CsvFile>, Diagnostic>>,
    /// Those of `[import]`, which are too long to be held as cells, and of `[fit]`, which are read by column.
    texts: HashMap<Span, Result<CsvText, Diagnostic>>,
}

/// The text of a CSV file.
#[derive(Clone, Debug)]
pub(crate) struct CsvText {
    pub(crate) file: FileId,
    pub(crate) name: String,
    pub(crate) text: Arc<str>,
}

impl CsvText {
    /// That there is no header, which could be like `example`.
    pub(crate) fn empty(&self, value: &RawValue, example: &str) -> Diagnostic {
        Diagnostic::error("netlist::csv_empty", format!("{} has no header", self.name))
            .at(Span::new(self.file, 0..0), "the header belongs here")
            .also(value.span.clone(), "read here")
            .help(format!("begin it with the names of the columns and their units: `{example}`"))
    }
}

/// One CSV file: a header, and rows of cells. The rows stand in the text alone and are read again for every column: held as
/// cells they would take twenty times the memory of the file.
#[derive(Debug)]
pub(crate) struct CsvFile {
    head: Head,
    text: Arc<str>,
}

/// So many rows of a column are looked at for what is wrong with them; of millions the rest are like those.
const MOST_WRONG: usize = 20 * MOST_PROBLEMS;

impl CsvFiles {
    /// Reads every file that the netlist names, through the loader that reads what it includes.
    pub(crate) fn read(files: &mut Files, raw: &RawNetlist, mut loader: Option<&mut Loader<'_>>) -> Self {
        let mut named = Vec::new();
        for entry in raw.top.entries.iter().filter(|entry| READERS.contains(&entry.key.as_str())) {
            if let RawKind::Table(table) = &entry.value.kind {
                table.entries.iter().for_each(|element| find(&element.value, &mut named));
            }
        }
        let (mut read, mut done) = (Self::default(), HashMap::new());
        for (text, value) in named {
            let path = path(files, text, value);
            let result = match done.get(&path) {
                Some(file) => Ok(Arc::clone(file)),
                None => load(files, &path, value, loader.as_deref_mut()),
            };
            if let Ok(file) = &result {
                done.insert(path, Arc::clone(file));
            }
            read.files.insert(value.span.clone(), result);
        }
        for (text, value) in imported(raw).chain(crate::fit::files(raw)) {
            let result = load_text(files, &path(files, text, value), value, loader.as_deref_mut());
            read.texts.insert(value.span.clone(), result);
        }
        read
    }

    /// The text of the file of `[import]` or `[fit]` that a value names, as for [`CsvFiles::get`].
    pub(crate) fn text(&self, value: &RawValue) -> Option<Result<&CsvText, &Diagnostic>> {
        self.texts.get(&value.span).map(Result::as_ref)
    }

    /// The file that a value names; `None` if none was read for it, because the netlist is broken elsewhere.
    pub(crate) fn get(&self, value: &RawValue) -> Option<Result<Arc<CsvFile>, Diagnostic>> {
        self.files.get(&value.span).cloned()
    }
}

/// The values of every `csv` below this one.
fn find<'a>(value: &'a RawValue, named: &mut Vec<(&'a str, &'a RawValue)>) {
    let RawKind::Table(RawTable { entries, .. }) = &value.kind else { return };
    for entry in entries {
        match &entry.value.kind {
            RawKind::String { text, .. } if entry.key == CSV => named.push((text, &entry.value)),
            _ => find(&entry.value, named),
        }
    }
}

/// The files that `[import]` names.
fn imported(raw: &RawNetlist) -> impl Iterator<Item = (&str, &RawValue)> {
    let entries = crate::names::section(raw, IMPORT.name).into_iter().flat_map(|table| &table.entries);
    entries.filter_map(|entry| match &entry.value.kind {
        RawKind::String { text, .. } => Some((text.as_str(), &entry.value)),
        _ => None,
    })
}

/// The path of a file, which is relative to the file that names it.
fn path(files: &Files, text: &str, value: &RawValue) -> PathBuf {
    Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new("")).join(text)
}

fn load(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<Arc<CsvFile>, Diagnostic> {
    let text = load_text(files, path, value, loader)?;
    let parsed = parse(text.file, Arc::clone(&text.text)).ok_or_else(|| text.empty(value, EXAMPLE))?;
    let form = csv_form::check(&parsed.head, (&text.name, &text.text), (csv_form::NETLIST, EXAMPLE));
    let form = form.map(|problem| problem.also(value.span.clone(), "read here"));
    match form.or_else(|| parsed.too_long(value)) {
        Some(problem) => Err(problem),
        None => Ok(Arc::new(parsed)),
    }
}

fn load_text(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<CsvText, Diagnostic> {
    let refused = |code, message: String, help: &str| {
        Err(Diagnostic::error(code, message).at(value.span.clone(), "").help(help))
    };
    let name = path.display();
    let Some(loader) = loader else {
        let message = "this netlist is not read from a file, so it cannot read a CSV file";
        return refused(
            "netlist::csv_without_folder",
            message.into(),
            "save it, and give the name of the file",
        );
    };
    let bytes = match loader(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::FileTooLarge => {
            let help = "leave out rows between which nothing changes, or split the file by its columns";
            return refused("netlist::csv_too_long", format!("cannot read {name}: {error}"), help);
        }
        Err(error) => {
            let message = format!("cannot read {name}: {}", reason(&error));
            return refused("netlist::csv_not_found", message, &near_file::help(value, path, &error));
        }
    };
    let name = name.to_string();
    let read = csv_form::text_of(files, &name, &bytes);
    let (file, text) = read.map_err(|problem| problem.also(value.span.clone(), "read here"))?;
    Ok(CsvText { file, name, text })
}

/// The header, before the rows.
fn parse(file: FileId, text: Arc<str>) -> Option<CsvFile> {
    let cells = reader(&text).records().find_map(Result::ok)?;
    let head = Head::new(file, &row(cells, &text));
    Some(CsvFile { head, text })
}

impl CsvFile {
    /// Visits the cells of the rows in their order, until the visitor has found what it looked for.
    fn visit<T>(&self, mut visit: impl FnMut(&csv::StringRecord) -> Option<T>) -> Option<T> {
        let (mut reader, mut cells) = (reader(&self.text), csv::StringRecord::new());
        let mut is_head = true;
        loop {
            match reader.read_record(&mut cells) {
                Ok(false) => return None,
                Ok(true) if !std::mem::take(&mut is_head) => {
                    if let Some(found) = visit(&cells) {
                        return Some(found);
                    }
                }
                _ => {}
            }
        }
    }

    /// The record as a row with its place.
    fn row(&self, cells: &csv::StringRecord) -> Row {
        row(cells.clone(), &self.text)
    }

    /// The place of a cell, or of its line; rows are counted from 0.
    pub(crate) fn place(&self, index: usize, column: usize) -> Option<Span> {
        let mut left = index;
        self.visit(|cells| match left.checked_sub(1) {
            None => Some(self.row(cells).place(self.head.file(), column)),
            Some(fewer) => {
                left = fewer;
                None
            }
        })
    }

    /// The first row with a value behind the last column.
    fn too_long(&self, value: &RawValue) -> Option<Diagnostic> {
        let columns = self.head.columns.len();
        self.visit(|cells| {
            let longer = cells.len() > columns;
            longer.then(|| self.head.extra(&self.row(cells), &value.span)).flatten()
        })
    }

    /// The numbers of the column that `ask` names, in SI units; of type `wanted` where that is known.
    pub(crate) fn column(
        self: &Arc<Self>,
        name: &str,
        wanted: Option<Type>,
        ask: Place<'_>,
    ) -> Result<Points, Vec<Diagnostic>> {
        let head = &self.head;
        let index = head.find(name, ask).map_err(|problem| vec![problem])?;
        let unit = head.unit(index, wanted, ask).map_err(|problem| vec![problem])?;
        let mut numbers = Vec::with_capacity(self.text.bytes().filter(|&byte| byte == b'\n').count());
        let mut problems = Vec::new();
        self.visit(|cells| {
            match number(cells.get(index).unwrap_or_default().trim()) {
                Ok(number) if unit.ty.absolute && unit.to_si(number) < 0.0 => {
                    problems.push(head.cold(&self.row(cells), index, ask));
                }
                Ok(number) => numbers.push(unit.to_si(number)),
                Err(wrong) => problems.push(head.no_number(&self.row(cells), index, (wrong, ask))),
            }
            (problems.len() >= MOST_WRONG).then_some(())
        });
        let (whole, places) = (head.columns[index].place.clone(), Places::Column(Arc::clone(self), index));
        let points = Points { numbers, ty: unit.ty, places, whole, unit: Some(unit) };
        if problems.is_empty() { Ok(points) } else { Err(problems) }
    }

    /// The place of the header.
    pub(crate) fn header(&self) -> &Span {
        &self.head.place
    }
}

#[cfg(test)]
mod tests {
    use super::{Files, parse};

    #[test]
    fn cells_are_found_where_they_stand() {
        let text =
            "\u{feff}# cycle\r\n\r\nt [s], speed [rpm]\r\n\r\n0, 10\r\n# more\r\n 1 ,20\r\n\"2\",30\n3,40";
        let mut files = Files::new();
        let id = files.add("a.csv", text);
        let file = parse(id, text.into()).unwrap();
        assert_eq!(files.line_column(&file.head.place), (3, 1));
        assert_eq!(files.at(&file.head.columns[1].place), "speed [rpm]");
        let places: Vec<_> = (0..).map_while(|row| file.place(row, 1)).collect();
        let rows: Vec<(usize, &str)> =
            places.iter().map(|place| (files.line_column(place).0, files.at(place))).collect();
        let expected = [(5, "10"), (7, "20"), (8, "\"2\",30"), (9, "40")];
        assert_eq!(rows, expected);
    }
}
