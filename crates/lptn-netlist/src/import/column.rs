//! The columns of an imported file, and errors of its cells.

use lptn_data::{CsvColumn, CsvRows, Diagnostic, MOST_PROBLEMS};
use lptn_laws::Formula;
use lptn_network::{End, Input};
use lptn_units::{Dimension, Quantity, Type};

use crate::fields::Fields;
use crate::import::Contents;
use crate::place::Place;
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The file of this kind, if one is named; its header has no unknown columns.
    pub(crate) fn rows(
        &mut self,
        import: Option<&Fields<'a>>,
        contents: &Contents,
    ) -> Option<CsvRows<'a>> {
        let fields = import?;
        fields.get(contents.key)?;
        let rows = self.opened(fields, contents);
        if rows.is_none() {
            self.lost();
        }
        rows
    }

    fn opened(&mut self, fields: &Fields<'a>, contents: &Contents) -> Option<CsvRows<'a>> {
        let (_, raw) = self.word(fields, contents.key)?;
        let asked = Place { owner: &fields.owner, key: contents.key, raw }.asked();
        let csv: &'a crate::csv_files::CsvFiles = self.csv;
        let text = csv.text(raw)?.map_err(Diagnostic::clone);
        let rows = self.kept(text.and_then(|text| CsvRows::open(text, asked, contents.example)))?;
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

    /// The conductances or the resistances: one of the two.
    pub(crate) fn law_column(&mut self, rows: &CsvRows<'_>) -> Option<(CsvColumn, Formula)> {
        let (conductance, resistance) =
            (self.optional_column(rows, "G"), self.optional_column(rows, "R"));
        match (conductance, resistance) {
            (Some(g), Some(r)) => {
                self.report(two_laws(rows, g, r));
                None
            }
            (None, Some(_)) => {
                let column = self.number_column(rows, "R", Type::of(Dimension::RESISTANCE))?;
                Some((column, Formula::Resistance))
            }
            (Some(_), None) => {
                let column = self.number_column(rows, "G", Type::of(Dimension::CONDUCTANCE))?;
                Some((column, Formula::Conductance))
            }
            (None, None) => {
                let help = "add a column `G [W/K]` or a column `R [K/W]`";
                self.kept(rows.required("G").map_err(|problem| problem.help(help)));
                None
            }
        }
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

fn two_laws(rows: &CsvRows<'_>, conductance: usize, resistance: usize) -> Diagnostic {
    let message = format!("{} have a column `G` and a column `R`", rows.asked.words);
    let problem = Diagnostic::error("netlist::two_laws", message)
        .at(rows.header(resistance), "`R` here")
        .also(rows.header(conductance), "`G` here");
    rows.asked.also(problem).help("keep one of them")
}
