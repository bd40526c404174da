//! Draws a figure with characters: dots of Braille, eight to a character.

use std::iter::repeat_n;

use crate::chart::{across, apart, far, in_lines, is_far, upward};
use crate::figure::{Curve, Figure, Look, Panel, Scale};
use crate::ink::SERIES;
use crate::ticks::Ruler;

/// Rows of an ordinary panel.
const ROWS: f64 = 16.0;

/// Largest width of the names of curves, in characters.
const NAMES: usize = 24;

/// Signs of single points, which distinguish curves without colours.
const MARKS: [char; SERIES] = ['●', '■', '▲', '◆', '○', '□', '△', '◇'];

/// Colours of the curves in the order of [`crate::Ink::Series`], by their numbers in a terminal.
const COLOURS: [u8; SERIES] = [34, 33, 36, 35, 95, 32, 37, 31];

/// A figure in characters, `columns` wide, with colours if it is `styled`.
pub fn write(figure: &Figure, columns: usize, styled: bool) -> String {
    let mut out = String::new();
    let bold = |text: &str| if styled { format!("\u{1b}[1m{text}\u{1b}[0m") } else { text.into() };
    let fits = |line: &str| line.chars().count() <= columns;
    for line in in_lines(&figure.title, fits) {
        out += &format!("{}\n", bold(&plain(&line)));
    }
    for line in figure.note.lines().flat_map(|line| in_lines(line, fits)) {
        out += &format!("{}\n", plain(&line));
    }
    let left = figure.panels.iter().map(|panel| numbers(&ruler(panel))).max().unwrap_or(0);
    let right = figure.panels.iter().map(names).max().unwrap_or(0).min(NAMES).min(columns / 3);
    for panel in &figure.panels {
        out += &format!(
            "\n{}",
            Canvas::new(figure, panel, (left, right, columns)).text(panel, styled)
        );
    }
    out
}

/// A text without control characters, which a terminal would obey.
fn plain(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).collect()
}

/// A character of the drawing: dots or a sign, and the place of its curve.
#[derive(Clone, Copy, Default)]
struct Cell {
    dots: u8,
    sign: Option<char>,
    place: Option<usize>,
}

fn rows(panel: &Panel) -> usize {
    match &panel.y.scale {
        Scale::Names(names) => names.len().max(1),
        _ => (ROWS * panel.share).round().max(5.0) as usize,
    }
}

fn ruler(panel: &Panel) -> Ruler {
    Ruler::new(&panel.y, upward(panel), rows(panel) as f64 / 3.0, false)
}

/// Width of the numbers of an axis.
fn numbers(ruler: &Ruler) -> usize {
    ruler.ticks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0)
}

/// Width of the names of a panel's curves.
fn names(panel: &Panel) -> usize {
    let length = |curve: &Curve| {
        let marked = matches!(curve.look, Look::Dots | Look::Bars);
        curve.name.chars().count() + if marked { 2 } else { 0 }
    };
    panel.curves.iter().map(length).max().unwrap_or(0)
}

struct Canvas {
    x: Ruler,
    y: Ruler,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
    /// Width of the numbers to the left.
    left: usize,
    right: usize,
    downward: bool,
}

/// Bits of the dots of a Braille character by row and column, added to U+2800.
const DOTS: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

impl Canvas {
    fn new(figure: &Figure, panel: &Panel, (left, right, columns): (usize, usize, usize)) -> Self {
        let (rows, y) = (rows(panel), ruler(panel));
        let columns = columns.saturating_sub(left + right + 4).max(10);
        let sharing = figure.panels.iter().filter(|other| other.x == panel.x);
        let x = Ruler::new(&panel.x, across(sharing), columns as f64 / 12.0, false);
        let cells = vec![Cell::default(); rows * columns];
        let downward = matches!(panel.y.scale, Scale::Names(_));
        let mut canvas = Self { x, y, columns, rows, cells, left, right, downward };
        canvas.draw(panel);
        canvas
    }

    fn draw(&mut self, panel: &Panel) {
        for moment in &panel.moments {
            let column = self.column(moment.at);
            (0..self.rows).for_each(|row| self.sign((row, column), '┊'));
        }
        for limit in &panel.limits {
            let place = self.y.place(limit.value);
            if (0.0..=1.0).contains(&place) {
                let row = self.row(limit.value);
                let name = format!("╌╌ {} ", plain(&limit.name));
                // a number that is cut would read as another one
                let fits = name.chars().count() <= self.columns;
                let name = if fits { name } else { String::new() };
                let signs = name.chars().chain(repeat_n('╌', self.columns)).take(self.columns);
                signs.enumerate().for_each(|(i, sign)| self.sign((row, i), sign));
            }
        }
        let shown = |(_, curve): &(usize, &Curve)| !is_far(panel, curve);
        for (place, curve) in panel.curves.iter().enumerate().filter(shown) {
            self.curve(panel, curve, curve.place.unwrap_or(place));
        }
    }

    fn sign(&mut self, (row, column): (usize, usize), sign: char) {
        if let Some(cell) = self.cells.get_mut(row * self.columns + column) {
            cell.sign = Some(sign);
        }
    }

    /// The vertical position, from 0 at the top to 1 at the bottom.
    fn down(&self, value: f64) -> f64 {
        let place = self.y.place(value);
        if self.downward { place } else { 1.0 - place }
    }

    fn row(&self, value: f64) -> usize {
        (self.down(value) * self.rows as f64).clamp(0.0, self.rows as f64 - 1.0) as usize
    }

    fn column(&self, value: f64) -> usize {
        let last = self.columns as f64 - 1.0;
        (self.x.place(value) * self.columns as f64).clamp(0.0, last) as usize
    }

    fn curve(&mut self, panel: &Panel, curve: &Curve, place: usize) {
        if curve.look == Look::Bars {
            return self.bars(curve, place);
        }
        let mut last: Option<(f64, f64)> = None;
        for &(x, y) in &curve.points {
            if !panel.shows((x, y)) {
                last = None;
                continue;
            }
            let dot = (
                (self.x.place(x) * (2 * self.columns - 1) as f64).round(),
                // outliers are at the edge
                (self.down(y).clamp(0.0, 1.0) * (4 * self.rows - 1) as f64).round(),
            );
            let from = match curve.look {
                Look::Line | Look::Dashed => last.unwrap_or(dot),
                Look::Dots | Look::Bars => dot,
                Look::Stems => (dot.0, (4 * self.rows - 1) as f64),
            };
            if self.marked(curve) {
                self.mark((dot.0 as usize / 2, dot.1 as usize / 4), place);
            } else {
                self.line(from, dot, place);
            }
            last = Some(dot);
        }
    }

    /// Bars across, each in the row of its point.
    fn bars(&mut self, curve: &Curve, place: usize) {
        for (&(_, row), &(low, high)) in curve.points.iter().zip(&curve.spread) {
            let row = self.row(row);
            let end = (self.x.place(high) * self.columns as f64).round() as usize;
            let columns = self.column(low)..end.min(self.columns);
            columns.for_each(|column| self.mark((column, row), place));
        }
    }

    /// True if the points of a curve are few enough that each has a sign.
    fn marked(&self, curve: &Curve) -> bool {
        let few = curve.points.len() <= self.columns / 2;
        curve.look == Look::Bars || curve.look == Look::Dots && few
    }

    fn mark(&mut self, (column, row): (usize, usize), place: usize) {
        if let Some(cell) = self.cells.get_mut(row * self.columns + column) {
            *cell = Cell { dots: 0, sign: Some(MARKS[place % MARKS.len()]), place: Some(place) };
        }
    }

    fn line(&mut self, from: (f64, f64), to: (f64, f64), place: usize) {
        let steps = (to.0 - from.0).abs().max((to.1 - from.1).abs()).max(1.0);
        for i in 0..=steps as usize {
            let share = i as f64 / steps;
            let (x, y) = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            self.dot((x.round() as usize, y.round() as usize), place);
        }
    }

    fn dot(&mut self, (x, y): (usize, usize), place: usize) {
        let (column, row) = (x / 2, y / 4);
        if column < self.columns
            && let Some(cell) = self.cells.get_mut(row * self.columns + column)
        {
            cell.dots |= DOTS[y % 4][x % 2];
            cell.place = Some(place);
        }
    }

    fn text(&self, panel: &Panel, styled: bool) -> String {
        let mut out = match self.y.title.as_str() {
            "" => format!("{}\n", plain(&self.x.title)),
            title => format!("{} over {}\n", plain(title), plain(&self.x.title)),
        };
        let room = self.left + self.columns + self.right + 4;
        let lines = |text: &String| in_lines(text, |line| line.chars().count() <= room);
        for line in far(panel).iter().flat_map(lines) {
            out += &format!("{}\n", plain(&line));
        }
        let names = self.names(panel);
        for row in 0..self.rows {
            let cells = &self.cells[row * self.columns..(row + 1) * self.columns];
            let (number, tick) = self.number(row);
            let mut line = format!("{number:>0$} {tick}", self.left);
            cells.iter().for_each(|cell| push(&mut line, *cell, styled));
            if let Some((name, place)) =
                names.iter().find(|name| name.1 == row).map(|n| (&n.0, n.2))
            {
                let name = paint(name, place, styled);
                line += &format!(" {name}");
            }
            out += &format!("{}\n", line.trim_end());
        }
        out + &self.axis()
    }

    fn number(&self, row: usize) -> (String, char) {
        let here = self.y.ticks.iter().find(|(value, _)| self.row(*value) == row);
        here.map_or((String::new(), '│'), |(_, text)| (plain(text), '┤'))
    }

    /// Names of curves with their rows and colours.
    fn names(&self, panel: &Panel) -> Vec<(String, usize, usize)> {
        let end = |(place, curve): (usize, &Curve)| {
            let last = curve.points.iter().rev().find(|point| panel.shows(**point))?;
            let place = curve.place.unwrap_or(place);
            let mark = if self.marked(curve) { MARKS[place % MARKS.len()] } else { ' ' };
            let name = format!("{mark} {}", plain(&curve.name)).trim_start().to_owned();
            let name: String = name.chars().take(self.right).collect();
            Some((name, self.row(last.1), place))
        };
        let is_named = |curve: &Curve| !curve.name.is_empty() && !is_far(panel, curve);
        let named = panel.curves.iter().enumerate().filter(|(_, curve)| is_named(curve));
        let mut names: Vec<_> = named.filter_map(end).collect();
        names.sort_by_key(|name| name.1);
        names.dedup_by(|a, b| a.0 == b.0 && a.2 == b.2);
        names.truncate(self.rows);
        let wanted: Vec<f64> = names.iter().map(|name| name.1 as f64).collect();
        let places = apart(&wanted, 1.0, (0.0, self.rows as f64 - 1.0));
        let mut next = 0;
        for (name, place) in names.iter_mut().zip(places) {
            name.1 = (place.round().max(0.0) as usize).max(next);
            next = name.1 + 1;
        }
        names
    }

    /// The horizontal axis with its numbers.
    fn axis(&self) -> String {
        let mut axis: Vec<char> = repeat_n('─', self.columns).collect();
        let mut numbers: Vec<char> = Vec::new();
        for (value, text) in &self.x.ticks {
            let column = self.column(*value);
            axis[column] = '┬';
            let begin = (column + 1).saturating_sub(text.chars().count().div_ceil(2));
            if begin > numbers.len() || numbers.is_empty() {
                numbers.resize(begin.max(numbers.len()), ' ');
                numbers.extend(plain(text).chars());
            }
        }
        let (axis, numbers): (String, String) =
            (axis.into_iter().collect(), numbers.into_iter().collect());
        let indent = " ".repeat(self.left + 1);
        format!("{indent}└{axis}\n{indent} {numbers}\n")
    }
}

fn push(line: &mut String, cell: Cell, styled: bool) {
    match cell.place {
        Some(place) if cell.dots > 0 => {
            let sign = char::from_u32(0x2800 + u32::from(cell.dots)).unwrap_or(' ');
            line.push_str(&paint(sign.encode_utf8(&mut [0; 4]), place, styled));
        }
        Some(place) => {
            let sign = cell.sign.unwrap_or(' ');
            line.push_str(&paint(sign.encode_utf8(&mut [0; 4]), place, styled));
        }
        None => line.push(cell.sign.unwrap_or(' ')),
    }
}

fn paint(text: &str, place: usize, styled: bool) -> String {
    if !styled {
        return text.into();
    }
    format!("\u{1b}[{}m{text}\u{1b}[0m", COLOURS[place % SERIES])
}

#[cfg(test)]
mod tests {
    use super::write;
    use crate::figure::{Axis, Curve, Figure, Level, Panel};

    #[test]
    fn a_straight_line_rises_to_its_name() {
        let mut panel = Panel::new(Axis::time(), Axis::linear("T", "degC"));
        panel.share = 0.4;
        panel.curves.push(Curve::line("steel", vec![(0.0, 20.0), (600.0, 80.0)]));
        panel.limits.push(Level { name: "most".into(), value: 50.0 });
        let title = "hot\u{1b}[31m".into();
        let figure = Figure { title, note: String::new(), panels: vec![panel] };
        let text = write(&figure, 40, false);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[..3], ["hot\u{FFFD}[31m", "", "T [°C] over time [min]"]);
        let ends = lines.iter().position(|line| line.ends_with(" steel")).expect("a name");
        let begins = lines.iter().position(|line| line.contains("┤⠤")).expect("a beginning");
        assert!(ends < begins, "{text}");
        assert_eq!(lines.iter().filter(|line| line.contains('╌')).count(), 1, "{text}");
        assert!(lines.iter().all(|line| line.chars().count() <= 40), "{text}");
    }
}
