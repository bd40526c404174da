//! CSV files that tables and signals read: what stands in which column, and where.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use lptn_units::{Type, Unit, suggest};

use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Files, Span};
use crate::include::{Loader, reason};
use crate::points::{Points, fit};
use crate::raw::{RawKind, RawNetlist, RawTable, RawValue};
use crate::value::Place;

/// The sections in which `csv` names a file of numbers.
const READERS: [&str; 4] = ["table", "signal", "material", "fluid"];

/// The key that names the file.
const CSV: &str = "csv";

/// The CSV files of a netlist, by the place that names each.
#[derive(Debug, Default)]
pub(crate) struct CsvFiles {
    files: HashMap<Span, Result<Arc<CsvFile>, Diagnostic>>,
}

/// One CSV file: a header, and rows of cells.
#[derive(Debug)]
pub(crate) struct CsvFile {
    file: FileId,
    headers: Vec<Header>,
    header_place: Span,
    rows: Vec<Row>,
}

/// The head of a column, `name [unit]`.
#[derive(Debug)]
struct Header {
    written: String,
    name: String,
    unit: Option<String>,
    place: Span,
}

#[derive(Debug)]
struct Row {
    cells: csv::StringRecord,
    /// The bytes of the line.
    place: std::ops::Range<usize>,
    /// Whether the line holds no quotes, so that the place of each cell can be counted.
    plain: bool,
}

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
            let from = Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new("")).to_owned();
            let path = from.join(text);
            let result = match done.get(&path) {
                Some(file) => Ok(Arc::clone(file)),
                None => load(files, &path, value, loader.as_deref_mut()),
            };
            if let Ok(file) = &result {
                done.insert(path, Arc::clone(file));
            }
            read.files.insert(value.span.clone(), result);
        }
        read
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

fn load(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<Arc<CsvFile>, Diagnostic> {
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
        Err(error) => {
            let message = format!("cannot read {name}: {}", reason(&error));
            return refused(
                "netlist::csv_not_found",
                message,
                "paths are relative to the file that names it",
            );
        }
    };
    let Some(text) = std::str::from_utf8(&bytes).ok().filter(|text| !text.contains('\0')) else {
        let message = format!("{name} is not a text file in UTF-8");
        return refused("netlist::not_text", message, "choose `CSV UTF-8` where your program saves it");
    };
    let file = files.add(name.to_string(), text);
    let parsed = parse(file, text).ok_or_else(|| {
        Diagnostic::error("netlist::csv_empty", format!("{name} has no header"))
            .at(Span::new(file, 0..0), "the header belongs here")
            .also(value.span.clone(), "read here")
            .help("begin it with the names of the columns and their units: `t [s],speed [rpm]`")
    })?;
    match parsed.too_long(value) {
        Some(problem) => Err(problem),
        None => Ok(Arc::new(parsed)),
    }
}

/// The header and the rows; lines that are empty or begin with `#` are left out.
fn parse(file: FileId, text: &str) -> Option<CsvFile> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let mut rows = reader.records().filter_map(Result::ok).map(|cells| row(cells, text));
    let head = rows.next()?;
    let headers = (0..head.cells.len()).map(|i| head.header(file, i)).collect();
    let header_place = Span::new(file, head.place.clone());
    Some(CsvFile { file, headers, header_place, rows: rows.collect() })
}

fn row(cells: csv::StringRecord, text: &str) -> Row {
    let start = cells.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0));
    let mut start = start.min(text.len());
    if start == 0 && text.starts_with('\u{feff}') {
        start = '\u{feff}'.len_utf8(); // the reader leaves out a mark at the beginning, and only there
    }
    // the reader notes where it looked for a record, not where it found one
    let ends = ['\r', '\n'];
    let mut rest = text.get(start..).unwrap_or_default();
    while rest.starts_with(ends) || rest.starts_with('#') {
        start += rest.find(ends).map_or(rest.len(), |end| end + 1);
        rest = text.get(start..).unwrap_or_default();
    }
    let line = rest.split(ends).next().unwrap_or_default();
    let plain = !line.contains('"');
    Row { cells, place: start..start + line.len(), plain }
}

impl Row {
    fn cell(&self, index: usize) -> &str {
        self.cells.get(index).unwrap_or_default().trim()
    }

    /// The place of a cell, or of the line where it cannot be told.
    fn place(&self, file: FileId, index: usize) -> Span {
        let cell = self.cells.get(index).filter(|cell| self.plain && !cell.trim().is_empty());
        let Some(cell) = cell else { return Span::new(file, self.place.clone()) };
        let before: usize = self.cells.iter().take(index).map(|cell| cell.len() + 1).sum();
        let start = self.place.start + before + (cell.len() - cell.trim_start().len());
        Span::new(file, start..start + cell.trim().len())
    }

    fn header(&self, file: FileId, index: usize) -> Header {
        let written = self.cell(index).to_owned();
        let split = written.strip_suffix(']').and_then(|text| text.rsplit_once('['));
        let (name, unit) = match split {
            Some((name, unit)) => (name.trim().to_owned(), Some(unit.trim().to_owned())),
            None => (written.clone(), None),
        };
        Header { written, name, unit, place: self.place(file, index) }
    }
}

impl CsvFile {
    /// The first row with a value behind the last column: with a decimal comma every number falls into two.
    fn too_long(&self, value: &RawValue) -> Option<Diagnostic> {
        let columns = self.headers.len();
        let extra = |row: &Row| (columns..row.cells.len()).find(|&i| !row.cell(i).is_empty());
        let (row, index) = self.rows.iter().find_map(|row| Some((row, extra(row)?)))?;
        let message = format!("this row has {} values, the header names {columns} columns", row.cells.len());
        let problem = Diagnostic::error("netlist::csv_extra_value", message)
            .at(row.place(self.file, index), "belongs to no column")
            .also(self.header_place.clone(), "the header")
            .also(value.span.clone(), "read here")
            .help("write decimal points, not commas: `0.5`, and name every column in the header");
        Some(problem)
    }

    /// The numbers of the column that `ask` names, in SI units; of type `wanted` where that is known.
    pub(crate) fn column(
        &self,
        name: &str,
        wanted: Option<Type>,
        ask: Place<'_>,
    ) -> Result<Points, Vec<Diagnostic>> {
        let found: Vec<usize> = (0..self.headers.len()).filter(|&i| self.headers[i].name == name).collect();
        let index = match found.as_slice() {
            [] => return Err(vec![self.no_column(name, ask)]),
            [index] => *index,
            [first, second, ..] => return Err(vec![self.two_columns(name, (*first, *second), ask)]),
        };
        let unit = self.unit(index, wanted, ask).map_err(|problem| vec![problem])?;
        let mut points = Points::new(unit.ty, self.headers[index].place.clone());
        let mut problems = Vec::new();
        for row in &self.rows {
            match number(row.cell(index)) {
                Ok(number) if unit.ty.absolute && unit.to_si(number) < 0.0 => {
                    problems.push(self.cold(row, index, ask));
                }
                Ok(number) => points.push(unit.to_si(number), row.place(self.file, index)),
                Err(wrong) => problems.push(self.no_number(row, index, (wrong, ask))),
            }
        }
        if problems.is_empty() { Ok(points) } else { Err(problems) }
    }

    /// The place of the header.
    pub(crate) fn header(&self) -> &Span {
        &self.header_place
    }

    fn unit(&self, index: usize, wanted: Option<Type>, ask: Place<'_>) -> Result<Unit, Diagnostic> {
        let header = &self.headers[index];
        let text = header.unit.as_deref().filter(|unit| *unit != "-").unwrap_or("1");
        let at = |problem: Diagnostic| {
            problem.at(header.place.clone(), "").also(ask.raw.span.clone(), "read here")
        };
        let unit = Unit::parse(text).map_err(|error| {
            let message = format!("the unit of column `{}`: {error}", header.name);
            let problem = at(Diagnostic::error(error.code(), message));
            match error.help() {
                Some(help) => problem.help(help),
                None => problem,
            }
        })?;
        fit(unit, wanted).map_err(|(wanted, found)| {
            let (is, help) = match header.unit {
                None => ("has no unit".to_owned(), "give the column its unit in the header"),
                Some(_) => (
                    format!("is {}", found.with_article()),
                    "name another column, or correct the unit in the header",
                ),
            };
            let message = format!(
                "{} must be {}, but column `{}` {is}",
                ask.words(),
                wanted.with_article(),
                header.name
            );
            let example = format!("`{} [{}]`", header.name, wanted.usual_unit());
            at(Diagnostic::error("netlist::csv_unit", message)).help(format!("{help}, for example {example}"))
        })
    }

    fn no_column(&self, name: &str, ask: Place<'_>) -> Diagnostic {
        let message = format!("{}: there is no column `{name}`", ask.words());
        let problem = Diagnostic::error("netlist::csv_column", message)
            .at(self.header_place.clone(), "the columns")
            .also(ask.raw.span.clone(), "read here");
        let names = || self.headers.iter().map(|header| header.name.as_str());
        if let [one] = self.headers.as_slice()
            && let Some(other) = [';', '\t'].into_iter().find(|c| one.written.contains(*c))
        {
            let other = if other == ';' { "`;`" } else { "tabs" };
            return problem.help(format!("the columns are separated by {other}: save the file with commas"));
        }
        let other_form = self.headers.iter().find(|header| {
            let rest = header.name.strip_prefix(name).map(str::trim_start);
            header.unit.is_none() && rest.is_some_and(|rest| rest.starts_with(['(', '/', ',', '{']))
        });
        match (other_form, suggest(name, names())) {
            (Some(header), _) => {
                let rest = header.name.get(name.len()..).unwrap_or_default();
                let unit = rest.trim().trim_matches(['(', ')', '/', ',', '{', '}', ' ']);
                problem.help(format!("write its unit in square brackets: `{name} [{unit}]`"))
            }
            (None, Some(near)) => problem.help(format!("did you mean `{near}`?")),
            (None, None) => {
                let names: Vec<&str> = names().take(12).collect();
                problem.help(format!("its columns are {}", crate::vocabulary::list(&names)))
            }
        }
    }

    fn two_columns(&self, name: &str, (first, second): (usize, usize), ask: Place<'_>) -> Diagnostic {
        Diagnostic::error(
            "netlist::csv_two_columns",
            format!("{}: two columns are named `{name}`", ask.words()),
        )
        .at(self.headers[second].place.clone(), "named again")
        .also(self.headers[first].place.clone(), "first named here")
        .also(ask.raw.span.clone(), "read here")
        .help(format!("rename one of them, for example `{name}_2`"))
    }

    fn no_number(&self, row: &Row, index: usize, (wrong, ask): (Wrong, Place<'_>)) -> Diagnostic {
        let (name, cell) = (&self.headers[index].name, row.cell(index));
        let (code, message, help) = match wrong {
            Wrong::Missing => (
                "netlist::csv_missing_value",
                format!("column `{name}` has no value in this row"),
                "fill it in, or leave the row out".to_owned(),
            ),
            Wrong::NotFinite => (
                "netlist::csv_not_finite",
                format!("column `{name}` holds `{cell}`, which is no finite number"),
                "leave the row out: what is not known is no point of a curve".to_owned(),
            ),
            Wrong::Text => (
                "netlist::csv_not_a_number",
                format!("column `{name}` holds `{cell}`, which is no number"),
                text_help(name, cell),
            ),
        };
        Diagnostic::error(code, message)
            .at(row.place(self.file, index), "")
            .also(ask.raw.span.clone(), "read here")
            .help(help)
    }

    fn cold(&self, row: &Row, index: usize, ask: Place<'_>) -> Diagnostic {
        let message = format!("column `{}` goes below absolute zero", self.headers[index].name);
        Diagnostic::error("units::below_absolute_zero", message)
            .at(row.place(self.file, index), "")
            .also(ask.raw.span.clone(), "read here")
            .help("0 K is -273.15 degC")
    }
}

/// Why a cell holds no number.
#[derive(Clone, Copy)]
enum Wrong {
    Missing,
    Text,
    NotFinite,
}

fn number(cell: &str) -> Result<f64, Wrong> {
    match cell.parse::<f64>() {
        _ if cell.is_empty() => Err(Wrong::Missing),
        Ok(number) if number.is_finite() => Ok(number + 0.0), // -0 is 0
        Ok(_) => Err(Wrong::NotFinite),
        Err(_) => Err(Wrong::Text),
    }
}

fn text_help(name: &str, cell: &str) -> String {
    let point = cell.replacen(',', ".", 1);
    if cell.contains(',') && point.parse::<f64>().is_ok() {
        return format!("write numbers with a point: `{point}`");
    }
    let number: String = cell.chars().take_while(|c| c.is_ascii_digit() || "+-.".contains(*c)).collect();
    let unit = cell.get(number.len()..).unwrap_or_default().trim();
    if !number.is_empty() && number.parse::<f64>().is_ok() && Unit::parse(unit).is_ok() {
        return format!("write the unit once, in the header: `{name} [{unit}]`");
    }
    "a cell holds one number; its unit stands in the header".to_owned()
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
        let file = parse(id, text).unwrap();
        assert_eq!(files.line_column(&file.header_place), (3, 1));
        assert_eq!(files.at(&file.headers[1].place), "speed [rpm]");
        let rows: Vec<(usize, &str)> = file
            .rows
            .iter()
            .map(|row| (files.line_column(&row.place(id, 1)).0, files.at(&row.place(id, 1))))
            .collect();
        let expected = [(5, "10"), (7, "20"), (8, "\"2\",30"), (9, "40")];
        assert_eq!(rows, expected);
    }
}
