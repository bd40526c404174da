//! The law of the conductors of a file, chosen by the columns that its fields need.

use lptn_data::{CsvColumn, CsvRows, Diagnostic};
use lptn_laws::Formula;
use lptn_network::Field;
use lptn_units::Type;

use crate::work::Elaboration;

/// The laws; the first field of each selects it.
const LAWS: [Formula; 4] =
    [Formula::Conductance, Formula::Resistance, Formula::ExchangeArea, Formula::Film];

/// Keys of the fields of a law, with their types.
fn needed(law: Formula) -> impl Iterator<Item = (&'static str, Type)> {
    law.declaration().fields.iter().map(|field| (field.key, field.ty))
}

/// The column of each field.
pub(super) fn fields(
    law: Formula,
    columns: &[CsvColumn],
) -> impl Iterator<Item = (Field, Option<usize>)> {
    let keys = needed(law).zip(columns);
    keys.map(|((key, _), column)| (Field::of_law(key).unwrap_or(Field::Value), Some(column.index)))
}

impl Elaboration<'_> {
    /// The law of a file of conductors, and a column for each of its fields.
    pub(crate) fn law_columns(&mut self, rows: &CsvRows<'_>) -> Option<(Formula, Vec<CsvColumn>)> {
        let selects = |law: &Formula| needed(*law).any(|(key, _)| rows.has(key));
        let mut given = LAWS.into_iter().filter(selects);
        let Some(law) = given.next() else {
            let help = "add a column `G [W/K]`, `R [K/W]` or `Gr [m^2]`, or two columns, \
                `h [W/(m^2 K)]` and `area [m^2]`";
            self.kept(rows.required("G").map_err(|problem| problem.help(help)));
            return None;
        };
        if let Some(other) = given.next() {
            let problem = two_laws(rows, law, other);
            self.report(problem);
            return None;
        }
        let columns: Vec<_> =
            needed(law).map(|(key, ty)| self.kept(field_column(rows, (key, ty)))).collect();
        Some((law, columns.into_iter().collect::<Option<_>>()?))
    }
}

fn field_column(rows: &CsvRows<'_>, (key, ty): (&str, Type)) -> Result<CsvColumn, Diagnostic> {
    rows.numbers(key, ty).map_err(|problem| match rows.has(key) {
        true => problem,
        false => problem.help(format!("add a column `{key} [{}]`", ty.usual_unit())),
    })
}

/// The error of a file whose columns belong to two laws.
fn two_laws(rows: &CsvRows<'_>, law: Formula, other: Formula) -> Diagnostic {
    let key = |law| needed(law).map(|(key, _)| key).find(|key| rows.has(key)).unwrap_or_default();
    let [first, second] = [law, other].map(key);
    let words = &rows.asked.words;
    let message = format!("{words} have a column `{first}` and a column `{second}`");
    let place = |key| rows.optional(key).ok().flatten().map(|index| rows.header(index));
    let problem = Diagnostic::error("netlist::two_laws", message)
        .at(place(second), format!("`{second}` here"))
        .also(place(first), format!("`{first}` here"));
    rows.asked.also(problem).help(
        "keep one of them; another law needs its own file: `conductors = [\"lines.csv\", \
         \"radiation.csv\"]`",
    )
}
