//! Text in columns.

use std::collections::BTreeSet;

use unicode_width::UnicodeWidthStr;

use crate::colour::Look;
use crate::names::{differing, shortened};
use crate::standing::Standing;

const GAP: &str = "  ";

/// Least width to which names are shortened, in columns.
const LEAST_NAME: usize = 12;

/// Alignment of the texts of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// One column of a [`TextTable`].
#[derive(Clone, Debug)]
pub struct Column {
    /// Its heading.
    pub title: String,
    /// Its texts, one per row.
    pub cells: Vec<String>,
    /// Their alignment.
    pub align: Align,
    /// True if the column may be left out when the table is too wide.
    pub optional: bool,
    /// True if the column may be left out when even short names do not make the table fit.
    pub spare: bool,
    /// True if its texts may be shortened in the middle when the table is too wide.
    /// Never set for numbers.
    pub names: bool,
    /// Standing of each text, one per row; empty if the texts are not verdicts.
    pub standing: Vec<Standing>,
    /// The place whose ink each text has, one per row: that of the curve of the same thing. Empty
    /// if the texts are not curves.
    pub curves: Vec<Option<usize>>,
}

impl Column {
    /// A column that is always shown.
    pub fn new(title: impl Into<String>, align: Align, cells: Vec<String>) -> Self {
        let (title, standing, curves) = (title.into(), Vec::new(), Vec::new());
        Self { title, cells, align, optional: false, spare: false, names: false, standing, curves }
    }

    /// The same column, left out when the table is too wide.
    #[must_use]
    pub fn optional(mut self) -> Self {
        self.optional = true;
        self
    }

    /// The same column with texts that may be shortened in the middle.
    /// Those of the first column always may.
    #[must_use]
    pub fn names(mut self) -> Self {
        self.names = true;
        self
    }

    pub(crate) fn shorten(&mut self, room: usize) {
        self.title = shortened(&self.title, room);
        let short =
            |names: &[String]| names.iter().map(|name| shortened(name, room)).collect::<Vec<_>>();
        let kept = |names: &[String]| names.iter().collect::<BTreeSet<_>>().len();
        let shorter = short(&self.cells);
        // names that differ only in their middle would become the same
        let lost = kept(&shorter) < kept(&self.cells);
        self.cells = if lost { short(&differing(&self.cells)) } else { shorter };
    }

    fn width(&self) -> usize {
        self.cells.iter().chain([&self.title]).map(|text| text.width()).max().unwrap_or(0)
    }
}

/// A table for reading: plain text without lines. The first column contains names.
#[derive(Clone, Debug, Default)]
pub struct TextTable {
    columns: Vec<Column>,
}

/// A table that is being built, with one row for each item of a list.
#[derive(Clone, Debug)]
pub struct TextTableOf<'a, T> {
    items: &'a [T],
    columns: Vec<Column>,
}

impl<'a, T> TextTableOf<'a, T> {
    /// Adds a column of words.
    #[must_use]
    pub fn left<S: Into<String>>(
        self,
        title: impl Into<String>,
        cell: impl FnMut(&'a T) -> S,
    ) -> Self {
        self.with(title, Align::Left, cell)
    }

    /// Adds a column of numbers.
    #[must_use]
    pub fn right<S: Into<String>>(
        self,
        title: impl Into<String>,
        cell: impl FnMut(&'a T) -> S,
    ) -> Self {
        self.with(title, Align::Right, cell)
    }

    fn with<S: Into<String>>(
        mut self,
        title: impl Into<String>,
        align: Align,
        mut cell: impl FnMut(&'a T) -> S,
    ) -> Self {
        let cells = self.items.iter().map(|item| cell(item).into()).collect();
        self.columns.push(Column::new(title, align, cells));
        self
    }

    /// Lets the last column be left out when the table is too wide.
    #[must_use]
    pub fn optional(mut self) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.optional = true;
        }
        self
    }

    /// Lets the last column be left out when even short names do not make the table fit.
    #[must_use]
    pub fn spare(mut self) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.spare = true;
        }
        self
    }

    /// Gives the standing of each text of the last column.
    #[must_use]
    pub fn judged(mut self, standing: impl FnMut(&'a T) -> Standing) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.standing = self.items.iter().map(standing).collect();
        }
        self
    }

    /// Gives the place of the curve whose ink each text of the last column has.
    #[must_use]
    pub fn inked(mut self, place: impl FnMut(&'a T) -> Option<usize>) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.curves = self.items.iter().map(place).collect();
        }
        self
    }

    /// Lets the texts of the last column be shortened in the middle.
    #[must_use]
    pub fn names(mut self) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.names = true;
        }
        self
    }
}

impl<T> From<TextTableOf<'_, T>> for TextTable {
    fn from(table: TextTableOf<'_, T>) -> Self {
        Self::new(table.columns)
    }
}

impl TextTable {
    /// Begins a table with one row for each of `items`.
    pub fn of<T>(items: &[T]) -> TextTableOf<'_, T> {
        TextTableOf { items, columns: Vec::new() }
    }

    /// A table of columns with the same number of cells.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }

    /// The lines of the table, the heading first if any column has one.
    /// If they are too wide, optional columns are left out from the right, then spare ones. Then
    /// long names are shortened in the middle, the longest first.
    pub fn lines(mut self, look: Look) -> Vec<String> {
        while self.width() > look.width {
            let Some(last) = self.columns.iter().rposition(|column| column.optional) else { break };
            self.columns.remove(last);
        }
        if let Some(first) = self.columns.first_mut() {
            first.names = true;
        }
        while self.least_width() > look.width {
            let Some(last) = self.columns.iter().rposition(|column| column.spare) else { break };
            self.columns.remove(last);
        }
        self.shorten_names(look.width);
        let headed = self.columns.iter().any(|column| !column.title.is_empty());
        let heading = headed.then(|| self.line(None, look));
        heading.into_iter().chain((0..self.rows()).map(|row| self.line(Some(row), look))).collect()
    }

    /// Width of a line in columns when every name is as short as it may be.
    fn least_width(&self) -> usize {
        let names = self.columns.iter().filter(|column| column.names);
        self.width() - names.map(|c| c.width().saturating_sub(LEAST_NAME)).sum::<usize>()
    }

    fn shorten_names(&mut self, width: usize) {
        let mut excess = self.width().saturating_sub(width);
        let names = || self.columns.iter().enumerate().filter(|(_, column)| column.names);
        let mut rooms: Vec<(usize, usize)> =
            names().map(|(i, column)| (i, column.width())).collect();
        while let Some((_, room)) = rooms.iter_mut().rev().max_by_key(|(_, room)| *room) {
            if excess == 0 || *room <= LEAST_NAME {
                break;
            }
            *room -= 1;
            excess -= 1;
        }
        rooms.into_iter().for_each(|(i, room)| self.columns[i].shorten(room));
    }

    /// Its columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.cells.len())
    }

    /// Width of a line in columns when nothing is left out or shortened.
    pub fn width(&self) -> usize {
        let gaps = GAP.len() * self.columns.len().saturating_sub(1);
        self.columns.iter().map(Column::width).sum::<usize>() + gaps
    }

    /// A row, or the heading for `None`. Colours do not count as width.
    fn line(&self, row: Option<usize>, look: Look) -> String {
        let mut line = String::new();
        let mut due = 0;
        for column in &self.columns {
            let text = row.map_or(&column.title, |row| &column.cells[row]);
            let blanks = column.width().saturating_sub(text.width());
            let (before, after) = match column.align {
                Align::Left => (0, blanks),
                Align::Right => (blanks, 0),
            };
            if !text.is_empty() {
                let standing = row.and_then(|row| column.standing.get(row));
                line += &" ".repeat(due + before);
                line += &standing.map_or(text.clone(), |of| look.standing(*of, text));
                due = 0;
            } else {
                due += before;
            }
            due += after + GAP.len();
        }
        line
    }
}

/// Tables that together show every column.
/// Each begins with `first` and takes as many columns as fit.
pub fn stacked(
    first: &Column,
    columns: Vec<Column>,
    fits: impl Fn(&TextTable) -> bool,
) -> Vec<TextTable> {
    let mut tables: Vec<TextTable> = Vec::new();
    for column in columns {
        let wider = tables.last().cloned().map(|mut table| {
            table.columns.push(column.clone());
            table
        });
        match (tables.last_mut(), wider.filter(&fits)) {
            (Some(last), Some(wider)) => *last = wider,
            _ => tables.push(TextTable::new(vec![first.clone(), column])),
        }
    }
    tables
}

/// A label and pieces of a sentence, wrapped between pieces at `width` columns.
/// Further lines begin below the first piece.
pub fn labelled(label: &str, pieces: &[String], width: usize) -> Vec<String> {
    let indent = " ".repeat(label.width());
    let mut lines = vec![label.to_owned()];
    for (i, piece) in pieces.iter().enumerate() {
        let last = lines.last_mut().expect("there is always a line");
        let fits = last.width() + 1 + piece.width() <= width;
        if i == 0 {
            last.push_str(piece);
        } else if fits {
            *last += &format!(" {piece}");
        } else {
            lines.push(format!("{indent}{piece}"));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{Align, Column, TextTable, labelled, stacked};
    use crate::{Look, Standing};

    fn plain_of(width: usize) -> Look {
        Look { styled: false, width }
    }

    #[test]
    fn colours_count_for_no_width() {
        let of = |styled| {
            let table = TextTable::of(&[true, false]).left("", |_| "hot");
            let table = table.left("", |kept| if *kept { "kept" } else { "BROKEN" });
            let stands = |kept: &bool| if *kept { Standing::Holds } else { Standing::Fails };
            let table: TextTable = table.judged(stands).right("margin", |_| "1 K").into();
            table.lines(Look { styled, width: 80 })
        };
        let styled = of(true);
        assert_eq!(styled[1], "hot  \u{1b}[32mkept\u{1b}[0m       1 K");
        assert_eq!(styled[2], "hot  \u{1b}[1;31mBROKEN\u{1b}[0m     1 K");
        assert_eq!(of(false)[1..], ["hot  kept       1 K", "hot  BROKEN     1 K"]);
    }

    fn texts(cells: &[&str]) -> Vec<String> {
        cells.iter().map(|&c| c.to_owned()).collect()
    }

    fn table(names: &[&str]) -> TextTable {
        let numbers = vec!["92.7".to_owned(); names.len()];
        TextTable::new(vec![
            Column::new("node", Align::Left, texts(names)),
            Column::new("T", Align::Right, numbers.clone()),
            Column::new("curve", Align::Left, vec!["▁▂▃".to_owned(); names.len()]).optional(),
        ])
    }

    #[test]
    fn numbers_stand_on_the_right_and_lines_end_with_text() {
        assert_eq!(
            table(&["steel", "al"]).lines(plain_of(80)),
            ["node      T  curve", "steel  92.7  ▁▂▃", "al     92.7  ▁▂▃"]
        );
    }

    #[test]
    fn wide_letters_take_two_columns() {
        assert_eq!(
            table(&["漢字", "µ"]).lines(plain_of(80))[1..],
            ["漢字  92.7  ▁▂▃", "µ     92.7  ▁▂▃"]
        );
    }

    #[test]
    fn what_is_too_wide_loses_optional_columns_and_then_letters() {
        let long = "first_stage_planet_carrier_bearing_outer_ring";
        let lines = table(&[long]).lines(plain_of(53));
        assert_eq!(lines[1], format!("{long}  92.7"));
        let lines = table(&[long, "al"]).lines(plain_of(30));
        assert_eq!(lines[1], "first_stage.._outer_ring  92.7");
        assert!(lines.iter().all(|line| line.chars().count() <= 30), "{lines:?}");
    }

    #[test]
    fn columns_that_do_not_fit_stand_in_a_further_table() {
        let column = |title: &str| Column::new(title, Align::Right, texts(&["92.7"]));
        let first = Column::new("node", Align::Left, texts(&["steel"]));
        let columns = vec![column("start"), column("peak"), column("end")];
        let tables = stacked(&first, columns, |table| table.width() <= 18);
        let lines: Vec<Vec<String>> =
            tables.into_iter().map(|table| table.lines(plain_of(80))).collect();
        assert_eq!(lines[0], ["node   start  peak", "steel   92.7  92.7"]);
        assert_eq!(lines[1], ["node    end", "steel  92.7"]);
    }

    #[test]
    fn sentences_wrap_between_pieces() {
        let pieces = texts(&["in 1 kJ", "= stored 0.5", "+ air 0.5 kJ"]);
        assert_eq!(labelled("heat  ", &pieces, 80), ["heat  in 1 kJ = stored 0.5 + air 0.5 kJ"]);
        assert_eq!(
            labelled("heat  ", &pieces, 26),
            ["heat  in 1 kJ = stored 0.5", "      + air 0.5 kJ"]
        );
        assert_eq!(labelled("heat", &[], 26), ["heat"]);
    }
}
