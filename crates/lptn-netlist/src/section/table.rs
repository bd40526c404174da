//! `[table]`, and properties that are tabulated over temperature.

use std::sync::Arc;

use lptn_data::{Diagnostic, PlacedNumbers};
use lptn_network::{Field, Input, Item, slot};
use lptn_units::{
    Expression, Interpolation, LookupTable, Outside, Scope, Symbol, Table1, Table2, TableError,
    TableSymbol, Type, Unit,
};

use crate::csv_files::{LAYOUT, LAYOUTS};
use crate::csv_form::{DECIMAL, UNITS};
use crate::fields::Fields;
use crate::format::{
    FILES, KeyDeclaration, Role, SectionDeclaration, Takes, shaped, text, words, words_of,
};
use crate::names::ValueKind;
use crate::points::Axis;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::work::Elaboration;

/// The keys that a table and a signal share.
pub(super) const CSV: KeyDeclaration = text(
    "csv",
    "file",
    "instead of the lists: a CSV file, and the names of its columns",
    "\"cycle.csv\"",
);
/// The points of a table: a list, or the name of a column.
const POINTS: Takes = Takes::Either(&[Takes::list(&Takes::Like), Takes::Text]);
pub(super) const COLUMN: KeyDeclaration =
    text("value", "name of a column", "with `csv`: the values", "\"speed\"");

/// A table of `[table]`, and a property over temperature.
pub(crate) const TABLE: SectionDeclaration = SectionDeclaration {
    name: ValueKind::Table.section(),
    sentence: "A function of one or two numbers, which expressions call by its name.",
    role: Role::Value,
    keys: &[
        shaped(
            "x",
            "list",
            POINTS,
            "arguments, rising; a column of `csv`",
            "[\"0 rpm\", \"5000 rpm\"]",
        )
        .needed(),
        shaped("y", "list", POINTS, "values; of `csv`: a second argument", "[\"0 W\", \"80 W\"]"),
        text("x_unit", "unit", "the unit of plain numbers in `x`", "\"rpm\""),
        text("y_unit", "unit", "the unit of plain numbers in `y`", "\"W\""),
        shaped(
            "csv",
            "file, or a list of files",
            FILES,
            "instead of the lists: a CSV file, and the names of its columns; of several files one \
             curve each, and its number, from 1, is the first argument",
            "\"cycle.csv\"",
        ),
        COLUMN,
        DECIMAL,
        UNITS,
        words(
            LAYOUT,
            &words_of(&LAYOUTS),
            "of `csv`: named columns, or a matrix with `x` in its first column, `y` in its first \
             row; `x`, `y` and `value` are then headings with units, `speed [rpm]`",
            "\"matrix\"",
        )
        .or("`\"columns\"`"),
        words(
            "interp",
            &words_of(&INTERPOLATIONS),
            "the interpolation between \
            points",
            "\"linear\"",
        )
        .or("`\"linear\"`"),
        words(
            "outside",
            &words_of(&OUTSIDE),
            "outside its points: an error, or the value at the nearer end",
            "\"hold\"",
        )
        .or("`\"error\"`"),
    ],
    either: &[&["y", "value"]],
    example: "{ x = [\"0 rpm\", \"5000 rpm\"], y = [\"0 W\", \"80 W\"] }",
    elsewhere: &[
        ("after_end", "outside its points a table has `outside = \"hold\"`"),
        ("t", "values over time are a [signal]; the arguments of a table are `x`"),
    ],
    ..SectionDeclaration::NEW
};

pub(super) const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("pchip", Interpolation::Pchip)];

pub(super) const OUTSIDE: [(&str, Outside); 2] =
    [("error", Outside::Error), ("hold", Outside::Hold)];

impl<'a> Elaboration<'a> {
    /// Gives all tables to the builder; they contain only numbers, so everything else may use them.
    pub(crate) fn tables(&mut self) {
        for entry in self.elements(TABLE.name) {
            match self.table(entry) {
                Some(symbol) => {
                    let two = matches!(*symbol.table, LookupTable::Two(_));
                    let id = self.builder.table(&entry.key, symbol);
                    self.map.insert(Item::Table(id), Field::Name, entry.key_span.clone());
                    if let (true, RawKind::Table(line)) = (two, &entry.value.kind) {
                        self.map.set_csv_map(id, line.clone());
                    }
                }
                None => self.names.fail(&entry.key),
            }
        }
    }

    fn table(&mut self, entry: &'a RawEntry) -> Option<TableSymbol> {
        let fields = self.fields(&TABLE, entry)?;
        let is_matrix = self.choice(&fields, LAYOUT, &LAYOUTS)?;
        if is_matrix {
            return self.matrix(&fields);
        }
        let several = |raw: &RawValue| matches!(raw.kind, RawKind::Array(_));
        if fields.get("csv").is_some_and(several) {
            return self.curves_of_files(&fields);
        }
        let map = fields.get("csv").is_some() && fields.get("y").is_some();
        if map { self.map_of_two(&fields) } else { self.tabulated(&fields, (None, None)) }
    }

    /// A table of one argument.
    fn tabulated(
        &mut self,
        fields: &Fields<'a>,
        ty: (Option<Type>, Option<Type>),
    ) -> Option<TableSymbol> {
        let interpolation = self.choice(fields, "interp", &INTERPOLATIONS);
        let outside = self.choice(fields, "outside", &OUTSIDE);
        let x = Axis { list: "x", unit: "x_unit", column: "x", ty: ty.0 };
        let y = Axis { list: "y", unit: "y_unit", column: "value", ty: ty.1 };
        let [x, y] = self.curve(fields, [x, y])?;
        let (numbers, values) = (x.numbers.clone(), y.numbers.clone());
        match Table1::new(numbers, values, interpolation?, outside?) {
            Ok(table) => {
                let table = Arc::new(LookupTable::One(table));
                Some(TableSymbol { table, arguments: vec![x.ty], ty: y.ty, units: units([&x, &y]) })
            }
            Err(error) => {
                self.report_points(fields, (&x, &y), ("the arguments", &error));
                None
            }
        }
    }

    /// A table of two arguments: one row of a CSV file for each point of the grid, in any order.
    fn map_of_two(&mut self, fields: &Fields<'a>) -> Option<TableSymbol> {
        self.refuse_keys(
            fields,
            &["x_unit", "y_unit"],
            "is for lists, but the points come from a CSV file",
        );
        let outside = self.straight(fields);
        let file = self.csv_file(fields);
        let names = ["x", "y", "value"].map(|key| self.column_name(fields, key));
        let file = file?;
        let columns =
            ["x", "y", "value"].map(|key| Axis { list: key, unit: "", column: key, ty: None });
        let mut columns = columns
            .into_iter()
            .zip(names)
            .map(|(axis, name)| self.column(fields, &file, axis, name))
            .collect::<Vec<_>>()
            .into_iter();
        let (x, y, value) = (columns.next()??, columns.next()??, columns.next()??);
        if value.numbers.is_empty() {
            self.report_points(fields, (&x, &value), ("the arguments", &TableError::TooShort));
            return None;
        }
        let [xs, ys] = [&x, &y].map(|axis| knots(&axis.numbers));
        let grid = Grid { fields, file_header: file.header(), axes: [&x, &y], knots: [&xs, &ys] };
        let values = self.kept(grid.fill(&value))?;
        match Table2::new(xs, ys, values, outside?) {
            Ok(table) => {
                let table = Arc::new(LookupTable::Two(table));
                let units = units([&x, &y, &value]);
                Some(TableSymbol { table, arguments: vec![x.ty, y.ty], ty: value.ty, units })
            }
            Err(error) => {
                self.report_points(fields, (&x, &value), ("the arguments", &error));
                None
            }
        }
    }

    /// A property that is tabulated over the temperature.
    pub(crate) fn property_table(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        ty: Type,
    ) -> Option<Input> {
        let symbol = self.property_symbol(fields, key, ty)?;
        of_temperature(key, symbol, ty)
    }

    /// The table of such a property.
    pub(super) fn property_symbol(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        ty: Type,
    ) -> Option<TableSymbol> {
        let entry = fields.entry(key)?;
        let inner = self.inner(&TABLE, fields.owner.inside(key), entry)?;
        let types = (Some(Type::ABSOLUTE_TEMPERATURE), Some(ty));
        let symbol = self.tabulated(&inner, types)?;
        if let LookupTable::One(table) = &*symbol.table
            && let Some(value) = table.values().iter().find(|value| **value <= 0.0)
        {
            let message = format!(
                "{} must be more than zero, got {value} {}",
                inner.owner.words(),
                ty.usual_unit()
            );
            let help = "check the sign, or leave the point out";
            self.refuse("network::not_positive", message, &entry.value.span, help);
            return None;
        }
        Some(symbol)
    }
}

/// A table over temperature, with its usual units.
pub(super) fn symbol(table: &Table1, ty: Type) -> TableSymbol {
    let units = [Unit::parse("K"), Unit::parse(&ty.usual_unit())];
    TableSymbol {
        table: Arc::new(LookupTable::One(table.clone())),
        arguments: vec![Type::ABSOLUTE_TEMPERATURE],
        ty,
        units: units.into_iter().flatten().collect(),
    }
}

/// A property that is a table over its own temperature; an error at run time names it by its key.
pub(super) fn of_temperature(key: &str, table: TableSymbol, ty: Type) -> Option<Input> {
    let scope = OfTemperature { name: key, table };
    let program = Expression::parse(&format!("{key}(T)")).ok()?.compile(&scope, Some(ty)).ok()?;
    Some(program.into())
}

/// The scope of a property that is a table over its own temperature.
struct OfTemperature<'k> {
    name: &'k str,
    table: TableSymbol,
}

impl Scope for OfTemperature<'_> {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let ty = Type::ABSOLUTE_TEMPERATURE;
        (name == "T").then_some(Symbol { slot: slot::OWN, ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["T".to_owned()]
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        (name == self.name).then(|| self.table.clone())
    }
}

/// The units in which all of them are given; none if one is unknown.
pub(super) fn units<const N: usize>(points: [&PlacedNumbers; N]) -> Vec<Unit> {
    let of = |points: &PlacedNumbers| match points.ty.is_scalar() && points.unit.is_none() {
        true => Unit::parse("1").ok(),
        false => points.unit.clone(),
    };
    points.into_iter().map(of).collect::<Option<_>>().unwrap_or_default()
}

/// The different numbers of a column, rising.
fn knots(numbers: &[f64]) -> Vec<f64> {
    let mut knots = numbers.to_vec();
    knots.sort_unstable_by(f64::total_cmp);
    knots.dedup_by(|a, b| a.total_cmp(b).is_eq());
    knots
}

/// A grid that the rows of a file have to fill.
struct Grid<'g> {
    fields: &'g Fields<'g>,
    file_header: &'g lptn_data::Span,
    axes: [&'g PlacedNumbers; 2],
    knots: [&'g [f64]; 2],
}

impl Grid<'_> {
    /// The value at every point of the grid, row by row.
    fn fill(&self, value: &PlacedNumbers) -> Result<Vec<f64>, Diagnostic> {
        let [xs, ys] = self.knots;
        let at = |axis: usize, row: usize| {
            let number = self.axes[axis].numbers[row];
            self.knots[axis].partition_point(|knot| knot.total_cmp(&number).is_lt())
        };
        let mut rows: Vec<((usize, usize), usize)> =
            (0..value.numbers.len()).map(|row| ((at(0, row), at(1, row)), row)).collect();
        rows.sort_unstable();
        if let Some(pair) = rows.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(self.repeated(pair[1].1, pair[0].1));
        }
        // in order and each once: the first that is out of place comes after one that is missing
        let point = |n: usize| (n / ys.len(), n % ys.len());
        let gap = rows.iter().enumerate().position(|(n, (found, _))| *found != point(n));
        let missing = gap.unwrap_or(rows.len());
        if point(missing).0 < xs.len() {
            return Err(self.incomplete(point(missing)));
        }
        Ok(rows.into_iter().map(|(_, row)| value.numbers[row]).collect())
    }

    fn repeated(&self, row: usize, first: usize) -> Diagnostic {
        let message = format!("{} has two rows for the same point", self.fields.owner.words());
        Diagnostic::error("netlist::grid_repeated", message)
            .at(self.axes[0].place(row), "again")
            .also(self.axes[0].place(first), "first here")
            .also(self.fields.place.clone(), "read here")
            .help("keep one of the two rows")
    }

    fn incomplete(&self, (x, y): (usize, usize)) -> Diagnostic {
        let [xs, ys] = self.knots;
        let message = format!(
            "{} needs a row for each of the {} pairs of its {} and {} arguments",
            self.fields.owner.words(),
            xs.len().saturating_mul(ys.len()),
            xs.len(),
            ys.len(),
        );
        let mut problem = Diagnostic::error("netlist::grid_incomplete", message)
            .at(self.file_header.clone(), "the columns")
            .help("add the row that is missing: every first argument with every second one");
        let parts = [(0, x, "this argument"), (1, y, "does not occur with this one")];
        for (axis, knot, text) in parts {
            let same = |number: &f64| number.total_cmp(&self.knots[axis][knot]).is_eq();
            if let Some(row) = self.axes[axis].numbers.iter().position(same) {
                problem = problem.also(self.axes[axis].place(row), text);
            }
        }
        problem.also(self.fields.place.clone(), "read here")
    }
}
