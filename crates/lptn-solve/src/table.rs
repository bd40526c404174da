//! The one table type that writers take: named columns with units.

use lptn_network::Network;
use lptn_units::Unit;

use crate::certify::farthest;
use crate::quantity::{Quantity, Shown};
use crate::selection::Selection;
use crate::solution::Solution;

/// A column: a name such as `steel.T`, a unit such as `degC`, and one value a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name.
    pub name: String,
    /// The unit of the values.
    pub unit: String,
    /// The values.
    pub values: Vec<f64>,
}

impl Column {
    /// The column's header in a CSV file: name and unit in brackets, `-` for a plain number.
    pub fn header(&self) -> String {
        Self::heading(&self.name, &self.unit)
    }

    /// The header of a column of this name and unit.
    pub fn heading(name: &str, unit: &str) -> String {
        format!("{name} [{}]", if unit == "1" { "-" } else { unit })
    }
}

/// A column of words, such as the file that a row belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelColumn {
    /// The name.
    pub name: String,
    /// One text a row.
    pub cells: Vec<String>,
}

/// Columns of equal length with unique names; those of words come before those of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    labels: Vec<LabelColumn>,
    columns: Vec<Column>,
}

/// A table under construction, with one row for each item of a list. A column receives a function
/// of one item, and so is as long as all others.
#[derive(Debug)]
pub struct TableOf<'a, T> {
    items: &'a [T],
    table: Table,
}

impl<'a, T> TableOf<'a, T> {
    /// A column of words.
    pub fn label(&mut self, name: impl Into<String>, cell: impl FnMut(&'a T) -> String) {
        self.table
            .labels
            .push(LabelColumn { name: name.into(), cells: self.items.iter().map(cell).collect() });
    }

    /// A column of numbers.
    pub fn column(
        &mut self,
        name: impl Into<String>,
        unit: impl Into<String>,
        value: impl FnMut(&'a T) -> f64,
    ) {
        let values = self.items.iter().map(value).collect();
        self.table.columns.push(Column { name: name.into(), unit: unit.into(), values });
    }

    /// The table.
    pub fn done(self) -> Table {
        self.table
    }
}

impl Table {
    /// A table with one row for each of `items`.
    pub fn of<T>(items: &[T]) -> TableOf<'_, T> {
        TableOf { items, table: Self { labels: Vec::new(), columns: Vec::new() } }
    }

    /// A table of these columns of numbers.
    pub(crate) fn of_columns(columns: Vec<Column>) -> Self {
        Self { labels: Vec::new(), columns }
    }

    /// The columns of words.
    pub fn labels(&self) -> &[LabelColumn] {
        &self.labels
    }

    /// The columns of numbers.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        let numbers = self.columns.first().map(|column| column.values.len());
        numbers.or_else(|| self.labels.first().map(|label| label.cells.len())).unwrap_or(0)
    }

    /// The numbers of one row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = f64> + '_ {
        self.columns.iter().map(move |column| column.values[row])
    }

    /// The time and the selected columns of a run, temperatures in `unit`. A column that was not
    /// recorded contains NaN: see [`Selection::record`].
    pub fn of_solution(solution: &Solution, selection: &Selection, unit: &Unit) -> Self {
        let network = solution.network();
        let time =
            Column { name: "time".into(), unit: "s".into(), values: solution.times().to_vec() };
        let (mut columns, mut missing) = (vec![time], Vec::new());
        for (at, &quantity) in (1..).zip(selection.quantities()) {
            let (mut column, shown) =
                (empty(quantity, network, unit), Shown::of(quantity, network));
            column.values.reserve_exact(solution.times().len());
            match solution.kept(quantity) {
                Some(values) => column.values.extend(values.map(|si| shown.value(si, unit))),
                None => missing.push((at, quantity, shown)),
            }
            columns.push(column);
        }
        if !missing.is_empty() {
            solution.replay(|row| {
                for (at, quantity, shown) in &missing {
                    columns[*at].values.push(shown.value(row.value(*quantity), unit));
                }
            });
        }
        Self::of_columns(columns)
    }

    /// The table of a run with further rows on both sides of its jumps, bends and switches, if
    /// they are known. `selection` is that of [`crate::Transient::drawn`].
    #[must_use]
    pub fn with_jumps(mut self, solution: &Solution, selection: &Selection, unit: &Unit) -> Self {
        let Some(sides) = solution.jumps.as_ref().filter(|sides| !sides.is_empty()) else {
            return self;
        };
        let network = solution.network();
        let shown: Vec<Shown> =
            selection.quantities().iter().map(|&of| Shown::of(of, network)).collect();
        let rows = self.columns[0].values.len();
        for (time, values) in sides {
            self.columns[0].values.push(*time);
            for ((column, value), shown) in self.columns[1..].iter_mut().zip(values).zip(&shown) {
                column.values.push(shown.value(*value, unit));
            }
            // bounds are known in the rows
            let bounds = self.columns[1..].iter_mut().skip(values.len());
            bounds.for_each(|column| column.values.push(f64::NAN));
        }
        let times = &self.columns[0].values;
        let mut order: Vec<usize> = (0..rows + sides.len()).collect();
        order.sort_by(|&a, &b| times[a].total_cmp(&times[b]));
        for column in &mut self.columns {
            column.values = order.iter().map(|&row| column.values[row]).collect();
        }
        self
    }

    /// The table of a run with the proven bounds on the errors of its columns after them; the same
    /// if there are none. `unit` is that of the temperatures, and bounds are differences.
    #[must_use]
    pub fn with_bounds(mut self, solution: &Solution, selection: &Selection, unit: &Unit) -> Self {
        let network = solution.network();
        let columns = self.columns.get(1..).unwrap_or_default();
        let bounds = selection.quantities().iter().zip(columns).filter_map(|(quantity, column)| {
            let shown = Shown::of(*quantity, network);
            let text = match shown.is_absolute() {
                true => unit.difference().to_owned(),
                false => column.unit.clone(),
            };
            let values = match quantity {
                Quantity::Node(node) => {
                    solution.bounds(*node)?.into_iter().map(|kelvin| kelvin / unit.scale).collect()
                }
                _ => {
                    let ranges = solution.proven_ranges(*quantity)?;
                    let ranges =
                        ranges.into_iter().map(|range| range.map(|si| shown.value(si, unit)));
                    let rows = ranges.zip(&column.values);
                    rows.map(|(range, value)| farthest(*value, range)).collect()
                }
            };
            let values: Vec<f64> = values;
            let known = !values.iter().all(|bound| bound.is_nan());
            known.then(|| Column { name: format!("{}.bound", column.name), unit: text, values })
        });
        let bounds: Vec<Column> = bounds.collect();
        self.columns.extend(bounds);
        self
    }

    /// The same with its first column, times in s, in a unit of `seconds`.
    #[must_use]
    pub fn with_times_in(mut self, unit: &str, seconds: f64) -> Self {
        if let Some(time) = self.columns.first_mut() {
            unit.clone_into(&mut time.unit);
            time.values.iter_mut().for_each(|value| *value /= seconds);
        }
        self
    }
}

fn empty(quantity: Quantity, network: &Network, temperature: &Unit) -> Column {
    let unit = Shown::of(quantity, network).unit(temperature);
    Column { name: quantity.name(network), unit, values: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::Table;

    /// A list of columns was cut to the shortest without a word; now every column has a value for
    /// every item.
    #[test]
    fn columns_are_as_long_as_the_list_they_are_of() {
        let mut table = Table::of(&[1.0, 2.0, 3.0]);
        table.column("square", "1", |x| x * x);
        table.label("name", |x| format!("n{x}"));
        let table = table.done();
        assert_eq!((table.rows(), table.columns()[0].values.as_slice()), (3, &[1.0, 4.0, 9.0][..]));
        assert_eq!(table.labels()[0].cells, ["n1", "n2", "n3"]);
        assert_eq!(Table::of::<f64>(&[]).done().rows(), 0);
    }
}
