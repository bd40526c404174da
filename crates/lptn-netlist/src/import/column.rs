//! The columns of an imported file, and what is wrong with its cells.

use lptn_laws::Formula;
use lptn_network::{End, Input};
use lptn_units::{Dimension, Quantity, Type, Unit, suggest};

use crate::csv_form;
use crate::csv_head::{Wrong, number};
use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::Fields;
use crate::import::Contents;
use crate::import::sheet::Sheet;
use crate::limits::MOST_PROBLEMS;
use crate::value::Place;

/// A column of numbers.
pub(crate) struct Column {
    pub(crate) index: usize,
    unit: Unit,
}

impl<'a> Elaboration<'a> {
    /// The file of this kind, if one is named; its header has no unknown columns.
    pub(crate) fn sheet<'s>(
        &mut self,
        import: Option<&'s Fields<'a>>,
        contents: &Contents,
    ) -> Option<Sheet<'s>>
    where
        'a: 's,
    {
        let fields = import?;
        let raw = fields.get(contents.key)?;
        let place = Place { owner: &fields.owner, key: contents.key, raw };
        let sheet = self.opened(fields, place, contents);
        if sheet.is_none() {
            self.lost();
        }
        sheet
    }

    fn opened<'s>(&mut self, fields: &Fields<'a>, place: Place<'s>, contents: &Contents) -> Option<Sheet<'s>>
    where
        'a: 's,
    {
        fields.text(contents.key, fields.get(contents.key)?, &mut self.problems)?;
        let csv: &'a crate::csv_file::CsvFiles = self.csv;
        let text = match csv.text(place.raw)? {
            Ok(text) => text,
            Err(problem) => {
                self.report(problem.clone());
                return None;
            }
        };
        let Some(sheet) = Sheet::open(text, place) else {
            self.report(text.empty(place.raw, contents.example));
            return None;
        };
        if let Some(problem) =
            csv_form::check(&sheet.head, (&text.name, &text.text), (csv_form::NETLIST, contents.example))
        {
            self.report(problem.also(place.raw.span.clone(), "read here"));
            return None;
        }
        let unknown: Vec<Diagnostic> = sheet.unknown_columns(contents.columns).collect();
        let known = unknown.is_empty();
        self.problems.extend(unknown);
        known.then_some(sheet)
    }

    /// A column that has to be there.
    pub(crate) fn required_column(&mut self, sheet: &Sheet<'_>, name: &str) -> Option<usize> {
        self.kept(sheet.head.find(name, sheet.ask))
    }

    /// A column that may be there.
    pub(crate) fn optional_column(&mut self, sheet: &Sheet<'_>, name: &str) -> Option<usize> {
        self.kept(sheet.head.optional(name, sheet.ask)).flatten()
    }

    /// A column of numbers that has to be there.
    pub(crate) fn number_column(&mut self, sheet: &Sheet<'_>, name: &str, ty: Type) -> Option<Column> {
        let index = self.required_column(sheet, name)?;
        let unit = self.kept(sheet.head.unit(index, Some(ty), sheet.ask))?;
        Some(Column { index, unit })
    }

    /// The conductances or the resistances: one of the two.
    pub(crate) fn law_column(&mut self, sheet: &Sheet<'_>) -> Option<(Column, Formula)> {
        let (conductance, resistance) = (self.optional_column(sheet, "G"), self.optional_column(sheet, "R"));
        match (conductance, resistance) {
            (Some(g), Some(r)) => {
                self.report(sheet.two_laws(g, r));
                None
            }
            (None, Some(_)) => {
                let column = self.number_column(sheet, "R", Type::of(Dimension::RESISTANCE))?;
                Some((column, Formula::Resistance))
            }
            (Some(_), None) => {
                let column = self.number_column(sheet, "G", Type::of(Dimension::CONDUCTANCE))?;
                Some((column, Formula::Conductance))
            }
            (None, None) => {
                let problem = sheet.head.no_column("G", sheet.ask);
                self.report(problem.help("add a column `G [W/K]` or a column `R [K/W]`"));
                None
            }
        }
    }

    fn kept<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|problem| self.report(problem)).ok()
    }

    /// The number in a cell; a stand-in if it is wrong.
    pub(crate) fn number(&mut self, sheet: &mut Sheet<'_>, column: &Column) -> Input {
        let Column { index, ref unit } = *column;
        if !sheet.sound {
            return stand_in(unit.ty); // what stands in which column cannot be told
        }
        let wrong = match number(sheet.cell(index)) {
            Ok(number) => {
                let value = unit.to_si(number);
                if !unit.ty.absolute || value >= 0.0 {
                    return Quantity { value, deviation: None, ty: unit.ty }.into();
                }
                None
            }
            Err(wrong) => Some(wrong),
        };
        self.refuse(sheet, |sheet| sheet.no_number(index, wrong));
        stand_in(unit.ty)
    }

    /// The node or boundary that a cell names.
    pub(crate) fn end_of(&mut self, sheet: &mut Sheet<'_>, (key, index): (&str, usize)) -> Option<End> {
        let name = sheet.cell(index);
        if let Some(end) = self.builder.end(name) {
            return Some(end);
        }
        if !sheet.sound {
            return None;
        }
        if !name.is_empty() && self.names.is_hidden(name) {
            return None; // what hides it has been reported
        }
        if sheet.problems >= MOST_PROBLEMS || name.is_empty() {
            self.refuse(sheet, |sheet| sheet.no_name(index));
            return None;
        }
        let name = name.to_owned();
        let problem = self.unknown_end((&format!("column `{key}`"), key), (&name, &sheet.place(index)));
        let asked = sheet.ask.raw.span.clone();
        self.refuse(sheet, |_| problem.also(asked, "read here"));
        None
    }

    /// Whether a row has a name; one without is left out.
    pub(crate) fn is_named(&mut self, sheet: &mut Sheet<'_>, index: usize) -> bool {
        let named = !sheet.cell(index).is_empty();
        if !named && sheet.sound {
            self.refuse(sheet, |sheet| sheet.no_name(index));
        }
        if !named {
            sheet.skip();
        }
        named
    }

    /// Goes to the next row, if there is one. A row that has more or fewer cells than the header is reported: something
    /// in it is not where it seems to be.
    pub(crate) fn next_row(&mut self, sheet: &mut Sheet<'_>) -> bool {
        if !sheet.next() {
            return false;
        }
        let (cells, columns) = (sheet.cells(), sheet.head.columns.len());
        let extra = (columns..cells).any(|index| !sheet.cell(index).is_empty());
        sheet.sound = cells >= columns && !extra;
        if !sheet.sound {
            self.refuse(sheet, |sheet| {
                let extra = sheet.head.extra(&sheet.row(), &sheet.ask.raw.span);
                extra.unwrap_or_else(|| sheet.short())
            });
        }
        true
    }

    /// Reports a problem of a row, up to so many of a file.
    fn refuse(&mut self, sheet: &mut Sheet<'_>, problem: impl FnOnce(&Sheet<'_>) -> Diagnostic) {
        sheet.problems += 1;
        if sheet.problems > MOST_PROBLEMS {
            self.dropped += 1;
        } else {
            let problem = problem(sheet);
            self.report(problem);
        }
    }
}

impl Sheet<'_> {
    fn unknown_columns(&self, known: &'static [&'static str]) -> impl Iterator<Item = Diagnostic> {
        let unknown = self.head.columns.iter().filter(|column| !known.contains(&column.name.as_str()));
        unknown.map(|column| {
            let message = format!("{} have no column `{}`", self.ask.words(), column.name);
            let problem = Diagnostic::error("netlist::csv_unknown_column", message)
                .at(column.place.clone(), "unknown column")
                .also(self.ask.raw.span.clone(), "read here");
            match suggest(&column.name, known.iter().copied()) {
                Some(near) => problem.help(format!("did you mean `{near}`?")),
                None => problem.help(format!("the columns are {}", crate::vocabulary::list(known))),
            }
        })
    }

    fn two_laws(&self, conductance: usize, resistance: usize) -> Diagnostic {
        let message = format!("{} have a column `G` and a column `R`", self.ask.words());
        let place = |index: usize| self.head.columns[index].place.clone();
        Diagnostic::error("netlist::two_laws", message)
            .at(place(resistance), "`R` here")
            .also(place(conductance), "`G` here")
            .also(self.ask.raw.span.clone(), "read here")
            .help("keep one of them")
    }

    /// A cell without a usable number; without a reason it is a temperature below absolute zero.
    fn no_number(&self, index: usize, wrong: Option<Wrong>) -> Diagnostic {
        let row = self.row();
        let Some(wrong) = wrong else { return self.head.cold(&row, index, self.ask) };
        let problem = self.head.no_number(&row, index, (wrong, self.ask));
        match wrong {
            Wrong::Missing => problem.help("fill it in, or remove the row"),
            Wrong::NotFinite => problem.help("write a number, or remove the row"),
            Wrong::Text => problem,
        }
    }

    fn no_name(&self, index: usize) -> Diagnostic {
        let message = format!("column `{}` has no name in this row", self.head.columns[index].name);
        self.in_row(Diagnostic::error("netlist::csv_missing_value", message), index)
            .help("fill it in, or remove the row")
    }

    fn short(&self) -> Diagnostic {
        let (cells, columns) = (self.cells(), self.head.columns.len());
        let message = format!("this row has {cells} values, the header names {columns} columns");
        self.in_row(Diagnostic::error("netlist::csv_short_row", message), columns)
            .also(self.head.place.clone(), "the header")
            .help("what is left out is an empty cell between commas: `n1,,20`")
    }

    fn in_row(&self, problem: Diagnostic, index: usize) -> Diagnostic {
        problem.at(self.place(index), "").also(self.ask.raw.span.clone(), "read here")
    }
}
