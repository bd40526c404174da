//! Text in columns.

use std::collections::BTreeSet;

use unicode_width::UnicodeWidthStr;

/// Columns of a terminal that tables are made for.
pub const WIDTH: usize = 80;

const GAP: &str = "  ";

/// The least width to which names are shortened.
const LEAST_NAME: usize = 12;

/// On which side the texts of a column stand.
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
    /// Its texts, one a row.
    pub cells: Vec<String>,
    /// Their side.
    pub align: Align,
    /// Whether the column may be left out where the table is too wide.
    pub optional: bool,
    /// Whether its texts may be shortened in the middle where the table is too wide: never so for
    /// numbers.
    pub names: bool,
}

impl Column {
    /// A column that is always shown.
    pub fn new(title: impl Into<String>, align: Align, cells: Vec<String>) -> Self {
        Self { title: title.into(), cells, align, optional: false, names: false }
    }

    /// The same column, left out where the table is too wide.
    #[must_use]
    pub fn optional(mut self) -> Self {
        self.optional = true;
        self
    }

    /// The same column with texts that may be shortened in the middle, as those of the first column
    /// always may.
    #[must_use]
    pub fn names(mut self) -> Self {
        self.names = true;
        self
    }

    fn shorten(&mut self, room: usize) {
        self.title = shortened(&self.title, room);
        let short =
            |names: &[String]| names.iter().map(|name| shortened(name, room)).collect::<Vec<_>>();
        let kept = |names: &[String]| names.iter().collect::<BTreeSet<_>>().len();
        let shorter = short(&self.cells);
        // names that differ in their middle only would be one name
        let lost = kept(&shorter) < kept(&self.cells);
        self.cells = if lost { short(&differing(&self.cells)) } else { shorter };
    }

    fn width(&self) -> usize {
        self.cells.iter().chain([&self.title]).map(|text| text.width()).max().unwrap_or(0)
    }
}

/// A table for reading: plain text without lines, the first column of names.
#[derive(Clone, Debug, Default)]
pub struct TextTable {
    columns: Vec<Column>,
}

/// A table under way, with one row for each item of a list.
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

    /// Lets the last column be left out where the table is too wide.
    #[must_use]
    pub fn optional(mut self) -> Self {
        if let Some(last) = self.columns.last_mut() {
            last.optional = true;
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

    /// A table of columns with equally many cells.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }

    /// The lines of the table, the heading first, unless no column has one. Where they would be
    /// longer than `width`, optional columns are left out from the right, and then long names
    /// shortened in the middle, the longest first.
    pub fn lines(mut self, width: usize) -> Vec<String> {
        while self.width() > width {
            let Some(last) = self.columns.iter().rposition(|column| column.optional) else { break };
            self.columns.remove(last);
        }
        self.shorten_names(width);
        let headed = self.columns.iter().any(|column| !column.title.is_empty());
        let heading = headed.then(|| self.line(|column| &column.title));
        heading
            .into_iter()
            .chain((0..self.rows()).map(|row| self.line(|column| &column.cells[row])))
            .collect()
    }

    fn shorten_names(&mut self, width: usize) {
        if let Some(first) = self.columns.first_mut() {
            first.names = true;
        }
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

    /// Letters that a line of the table takes where nothing is left out or shortened.
    pub fn width(&self) -> usize {
        let gaps = GAP.len() * self.columns.len().saturating_sub(1);
        self.columns.iter().map(Column::width).sum::<usize>() + gaps
    }

    fn line<'a>(&'a self, text: impl Fn(&'a Column) -> &'a String) -> String {
        let cells: Vec<String> =
            self.columns.iter().map(|c| padded(text(c), c.width(), c.align)).collect();
        cells.join(GAP).trim_end().to_owned()
    }
}

/// As many tables as it takes to show every column, each behind the first one and with as many as
/// still fit.
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

fn padded(text: &str, width: usize, align: Align) -> String {
    let blanks = " ".repeat(width.saturating_sub(text.width()));
    match align {
        Align::Left => format!("{text}{blanks}"),
        Align::Right => format!("{blanks}{text}"),
    }
}

/// A name of at most `room` letters, `planetary_..ring_17`: the ends of names tell them apart.
pub fn shortened(name: &str, room: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if name.width() <= room {
        return name.to_owned();
    }
    let keep = room.saturating_sub(2);
    let (head, tail) = (keep / 2, keep - keep / 2);
    let start: String = letters[..head.min(letters.len())].iter().collect();
    let end: String = letters[letters.len() - tail.min(letters.len())..].iter().collect();
    format!("{start}..{end}")
}

/// The part of each name in which the names differ, from one border of words to another: `1000rpm`
/// and `7000rpm` of `runs/1000rpm.csv` and `runs/7000rpm.csv`. The names themselves where a part
/// would be empty, or all are the same.
pub fn differing(names: &[String]) -> Vec<String> {
    let Some(first) = names.first() else { return Vec::new() };
    let is_border = |c: char| !c.is_alphanumeric();
    let same = |length: usize, end: bool| {
        names.iter().all(|name| match end {
            false => name.get(..length) == first.get(..length),
            true => {
                name.len() >= length
                    && name.get(name.len() - length..) == first.get(first.len() - length..)
            }
        })
    };
    let borders = || first.char_indices().filter(|(_, c)| is_border(*c));
    let head =
        borders().map(|(at, c)| at + c.len_utf8()).filter(|&length| same(length, false)).max();
    let tail = borders().map(|(at, _)| first.len() - at).filter(|&length| same(length, true)).max();
    let (head, tail) = (head.unwrap_or(0), tail.unwrap_or(0));
    let part = |name: &String| Some(name.get(head..name.len().checked_sub(tail)?)?.to_owned());
    let parts: Option<Vec<String>> =
        names.iter().map(|name| part(name).filter(|p| !p.is_empty())).collect();
    parts.unwrap_or_else(|| names.to_vec())
}

/// Pieces of a sentence behind a label, wrapped between pieces where they would be longer than
/// `width`; further lines stand under the first piece.
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

/// A text on one line without control characters, so that no file can steer the terminal.
pub fn plain(text: &str) -> String {
    let one_line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    one_line.chars().filter(|c| !c.is_control()).collect()
}

#[cfg(test)]
mod tests {
    use super::{Align, Column, TextTable, differing, labelled, plain, stacked};

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
    fn names_are_told_apart_by_the_part_that_differs() {
        let names = |all: &[&str]| all.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let records = names(&["runs/1000rpm_a.csv", "runs/7000rpm_a.csv"]);
        assert_eq!(differing(&records), ["1000rpm", "7000rpm"]);
        for alone in [names(&["a.csv"]), names(&["a.csv", "a.csv"]), names(&["ab", "abc"])] {
            assert_eq!(differing(&alone), alone);
        }
        let middle = names(&[
            "records_of_spring/1000rpm_run/logger_7_of_8.csv",
            "records_of_spring/2000rpm_run/logger_7_of_8.csv",
        ]);
        let mut column = Column::new("record", Align::Left, middle).names();
        column.shorten(20);
        assert_eq!(column.cells, ["1000rpm", "2000rpm"]);
    }

    #[test]
    fn numbers_stand_on_the_right_and_lines_end_with_text() {
        assert_eq!(
            table(&["steel", "al"]).lines(80),
            ["node      T  curve", "steel  92.7  ▁▂▃", "al     92.7  ▁▂▃"]
        );
    }

    #[test]
    fn wide_letters_take_two_columns() {
        assert_eq!(table(&["漢字", "µ"]).lines(80)[1..], ["漢字  92.7  ▁▂▃", "µ     92.7  ▁▂▃"]);
    }

    #[test]
    fn what_is_too_wide_loses_optional_columns_and_then_letters() {
        let long = "first_stage_planet_carrier_bearing_outer_ring";
        let lines = table(&[long]).lines(53);
        assert_eq!(lines[1], format!("{long}  92.7"));
        let lines = table(&[long, "al"]).lines(30);
        assert_eq!(lines[1], "first_stage.._outer_ring  92.7");
        assert!(lines.iter().all(|line| line.chars().count() <= 30), "{lines:?}");
    }

    #[test]
    fn columns_that_do_not_fit_stand_in_a_further_table() {
        let column = |title: &str| Column::new(title, Align::Right, texts(&["92.7"]));
        let first = Column::new("node", Align::Left, texts(&["steel"]));
        let columns = vec![column("start"), column("peak"), column("end")];
        let tables = stacked(&first, columns, |table| table.width() <= 18);
        let lines: Vec<Vec<String>> = tables.into_iter().map(|table| table.lines(80)).collect();
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

    #[test]
    fn titles_cannot_steer_the_terminal() {
        assert_eq!(plain("a\u{1b}[31mred\n\tb"), "a[31mred b");
    }
}
