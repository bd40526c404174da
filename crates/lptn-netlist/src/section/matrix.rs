//! `layout = "matrix"` of a table: a CSV file with one argument down its first column and the other
//! along its first row. The file has no header, so the netlist has the units: `x = "speed [rpm]"`.

use std::sync::Arc;

use lptn_data::{CsvMatrix, Diagnostic, PlacedNumbers};
use lptn_units::{LookupTable, Table2, TableError, TableSymbol, Unit};

use crate::csv_form;
use crate::fields::Fields;
use crate::place::Place;
use crate::raw::RawKind;
use crate::section::table::units;
use crate::work::Elaboration;

impl<'a> Elaboration<'a> {
    /// A table of two arguments from a matrix.
    pub(super) fn matrix(&mut self, fields: &Fields<'a>) -> Option<TableSymbol> {
        let why = "is for lists, but the points come from a CSV file";
        self.refuse_keys(fields, &["x_unit", "y_unit"], why);
        let why = "is for columns: the headings of a matrix have the units";
        self.refuse_keys(fields, &["units"], why);
        let outside = self.straight(fields);
        let examples = [("x", "speed [rpm]"), ("y", "torque [N m]"), ("value", "loss [W]")];
        let headings = examples.map(|example| self.heading(fields, example));
        let raw = self.require(fields, "csv")?;
        if !matches!(raw.kind, RawKind::String { .. }) {
            self.report(fields.wrong_shape("csv", raw, "one CSV file"));
            return None;
        }
        let text = self.csv.text(raw)?.map_err(Clone::clone);
        let text = self.kept(text)?.clone();
        let [x, y, value] = headings;
        let place = Place { owner: &fields.owner, key: "csv", raw };
        let (options, wrong) = csv_form::options(fields.table());
        self.problems.extend(wrong.iter().map(|wrong| wrong.told(&fields.owner)));
        let read = CsvMatrix::read(&text, [x?, y?, value?], (&options, &place.asked()));
        let CsvMatrix { down, along, values } =
            read.map_err(|problems| self.problems.extend(problems)).ok()?;
        let axes = [(&down, "the first column"), (&along, "the first row")];
        for (axis, words) in axes {
            if let Some(error) = unusable(axis) {
                self.report_points(fields, (axis, axis), (words, &error));
                return None;
            }
        }
        let (xs, ys) = (down.numbers.clone(), along.numbers.clone());
        let table = Table2::new(xs, ys, values.numbers.clone(), outside?).ok()?;
        let (table, units) = (Arc::new(LookupTable::Two(table)), units([&down, &along, &values]));
        Some(TableSymbol { table, arguments: vec![down.ty, along.ty], ty: values.ty, units })
    }

    /// The unit of a heading, `speed [rpm]`. A file of plain numbers needs one, so that 1000 is never
    /// read in SI units by mistake.
    fn heading(&mut self, fields: &Fields<'a>, (key, example): (&str, &str)) -> Option<Unit> {
        if fields.get(key).is_none() && fields.complete {
            let message = format!("{} has no `{key}`", fields.owner.words());
            let help = format!("add a heading with its unit: `{key} = \"{example}\"`");
            self.report(fields.missing(key, message).help(help));
            return None;
        }
        let (text, raw) = self.column_name(fields, key)?;
        let words = fields.owner.field(key);
        let unit = text.trim().strip_suffix(']').and_then(|text| text.rsplit_once('['));
        let Some((_, unit)) = unit else {
            let message = format!("{words} has no unit, and the matrix has none either");
            let help = format!(
                "write it like this: `{key} = \"{example}\"`; a plain number is `{} [-]`",
                text.trim()
            );
            self.refuse("netlist::csv_unit", message, &raw.span, help);
            return None;
        };
        match Unit::parse(if unit.trim() == "-" { "1" } else { unit.trim() }) {
            Ok(unit) => Some(unit),
            Err(error) => {
                let problem = Diagnostic::error(error.code(), format!("{words}: {error}"));
                self.report(problem.at(raw.span.clone(), "").help(error.help()));
                None
            }
        }
    }
}

/// The reason why the arguments of a row or column make no table.
fn unusable(axis: &PlacedNumbers) -> Option<TableError> {
    let falls = axis.numbers.windows(2).position(|two| two[1] <= two[0]);
    let short = (axis.numbers.len() < 2).then_some(TableError::TooShort);
    falls.map(|before| TableError::NotIncreasing { index: before + 1 }).or(short)
}
