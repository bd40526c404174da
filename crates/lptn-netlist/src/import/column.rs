//! The columns of an imported file, and errors of its cells.

use lptn_data::{CsvColumn, CsvRows, Diagnostic, MOST_PROBLEMS, Span};
use lptn_network::{End, Input};
use lptn_units::{Quantity, Type};

use crate::csv_form::FILE;
use crate::fields::Fields;
use crate::import::Contents;
use crate::place::Place;
use crate::raw::RawValue;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The files of this kind; their headers have no unknown columns.
    pub(crate) fn files(
        &mut self,
        import: Option<&Fields<'a>>,
        contents: &Contents,
    ) -> Vec<CsvRows<'a>> {
        let Some((fields, raw)) =
            import.and_then(|fields| Some((fields, fields.get(contents.key)?)))
        else {
            return Vec::new();
        };
        let files = raw.items();
        if files.is_empty() {
            self.report(fields.wrong_shape(contents.key, raw, "a CSV file, or a list of them"));
        }
        for (n, file) in files.iter().enumerate() {
            let Some((text, _)) = file.file() else { continue };
            let first = files[..n].iter().find(|first| first.file().is_some_and(|f| f.0 == text));
            if let Some(first) = first {
                self.report(twice(text, [&first.span, &file.span]));
            }
        }
        let opened: Vec<_> =
            files.iter().filter_map(|file| self.opened(fields, contents, file)).collect();
        if opened.len() < files.len() {
            self.lost();
        }
        opened
    }

    fn opened(
        &mut self,
        fields: &Fields<'a>,
        contents: &Contents,
        raw: &'a RawValue,
    ) -> Option<CsvRows<'a>> {
        let file = self.formed_file(fields, (contents.key, &FILE), raw)?;
        let asked = Place { owner: &fields.owner, key: contents.key, raw: file.raw }.asked();
        let csv: &'a crate::csv_files::CsvFiles = self.csv;
        let text = self.kept(csv.text(file.raw)?.map_err(Diagnostic::clone))?;
        let rows = CsvRows::open(text, (asked, &file.options), contents.example);
        let rows = self.kept(rows.map_err(|problem| file.explained(problem)))?;
        self.problems.extend(rows.note());
        let unknown = rows.unknown_columns(contents.columns);
        let known = unknown.is_empty();
        self.problems.extend(unknown);
        known.then_some(rows)
    }

    /// A required column.
    pub(crate) fn required_column(&mut self, rows: &CsvRows<'_>, name: &str) -> Option<usize> {
        self.kept(rows.required(name))
    }

    /// An optional column.
    pub(crate) fn optional_column(&mut self, rows: &CsvRows<'_>, name: &str) -> Option<usize> {
        self.kept(rows.optional(name)).flatten()
    }

    /// A required column of numbers.
    pub(crate) fn number_column(
        &mut self,
        rows: &CsvRows<'_>,
        name: &str,
        ty: Type,
    ) -> Option<CsvColumn> {
        self.kept(rows.numbers(name, ty))
    }

    /// The number in a cell; a stand-in if it is wrong.
    pub(crate) fn number(&mut self, rows: &mut CsvRows<'_>, column: &CsvColumn) -> Input {
        let ty = column.unit.ty;
        if !rows.sound {
            return stand_in(ty); // the columns of the cells are uncertain
        }
        match rows.number(column) {
            Ok(value) => Quantity { value, deviation: None, ty }.into(),
            Err(wrong) => {
                self.refuse_row(rows, |rows| rows.no_number(column.index, wrong));
                stand_in(ty)
            }
        }
    }

    /// The numbers in several cells of a row.
    pub(crate) fn numbers(&mut self, rows: &mut CsvRows<'_>, columns: &[CsvColumn]) -> Vec<Input> {
        columns.iter().map(|column| self.number(rows, column)).collect()
    }

    /// The node or boundary that a cell names.
    pub(crate) fn end_of(
        &mut self,
        rows: &mut CsvRows<'_>,
        (key, index): (&str, usize),
    ) -> Option<End> {
        let name = rows.cell(index);
        if let Some(end) = self.builder.end(name) {
            return Some(end);
        }
        if !rows.sound {
            return None;
        }
        if !name.is_empty() && self.names.is_hidden(name) {
            return None; // what hides it has been reported
        }
        if rows.problems >= MOST_PROBLEMS || name.is_empty() {
            self.refuse_row(rows, |rows| rows.no_name(index));
            return None;
        }
        let name = name.to_owned();
        let problem =
            self.unknown_end((&format!("column `{key}`"), key), (&name, &rows.place(index)));
        self.refuse_row(rows, |rows| rows.asked.also(problem));
        None
    }

    /// True if a row has a name; one without is left out.
    pub(crate) fn is_named(&mut self, rows: &mut CsvRows<'_>, index: usize) -> bool {
        let named = !rows.cell(index).is_empty();
        if !named && rows.sound {
            self.refuse_row(rows, |rows| rows.no_name(index));
        }
        if !named {
            rows.skip();
        }
        named
    }

    /// Goes to the next row, if there is one. A row with more or fewer cells than the header is
    /// reported, because its cells may be in the wrong columns.
    pub(crate) fn next_row(&mut self, rows: &mut CsvRows<'_>) -> bool {
        let there = rows.step();
        if there && !rows.sound {
            self.refuse_row(rows, CsvRows::wrong_length);
        }
        there
    }

    /// Reports a problem of a row, up to [`MOST_PROBLEMS`] of a file.
    fn refuse_row<'s>(
        &mut self,
        rows: &mut CsvRows<'s>,
        problem: impl FnOnce(&CsvRows<'s>) -> Diagnostic,
    ) {
        rows.problems += 1;
        if rows.problems > MOST_PROBLEMS {
            self.dropped += 1;
        } else {
            let problem = problem(rows);
            self.report(problem);
        }
    }
}

fn twice(file: &str, [first, again]: [&Span; 2]) -> Diagnostic {
    let message = format!("{file} is named twice: its rows would count twice");
    Diagnostic::error("netlist::import_twice", message)
        .at(again.clone(), "again")
        .also(first.clone(), "first here")
        .help("name each file once")
}
