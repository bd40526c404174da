//! A sweep as a picture: reports over the parameter, or one report over another.

use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_plot::{Figure, printed};
use lptn_report::significant;
use lptn_study::standing::NONE;

use super::asked::Column;
use super::page::SweepAnswer;
use super::row::Row;
use super::tally::MOST_POINTS;
use crate::words::spaced;

/// Most candidates of a figure that have a tooltip each.
const MOST_TIPS: usize = 2000;

/// Most lines, most lines of the front and most scales of candidates over their values.
const MOST_LINES: usize = 300;
const MOST_OF_FRONT: usize = 12;
const MOST_SCALES: usize = 10;

/// Digits of the ends of a scale.
const END_DIGITS: usize = 3;

/// Inks of candidates that keep their limits, of those that break one, and of the front.
const INKS: [usize; 3] = [0, 1, 2];

/// Digits of a value in a tooltip.
const DIGITS: usize = 5;

/// Names of candidates by their limits of severity error.
const KEEPS: &str = "keeps its limits";
const BREAKS: &str = "breaks a limit";

/// A range that spans more than this is shown by its logarithms.
const WIDE: f64 = 10.0;

impl SweepAnswer {
    /// One parameter: every report over it, a panel for each unit.
    /// Several: every report over the first one as dots, so that the Pareto front is visible.
    pub(super) fn figure(&self) -> Figure {
        let rows: Vec<&Row> =
            self.tally.points.iter().filter(|row| row.failed.is_empty()).collect();
        let panels = match (self.axes(), self.reports()) {
            _ if self.tally.front.places().is_some() => self.over_the_other(&rows),
            ([_], _) => self.over_the_axis(&rows),
            (_, [_, _, ..]) => self.over_the_first(&rows),
            _ => self.over_the_axis(&rows),
        };
        let title = format!("{}: sweep {}", self.asked.input.title(), self.asked.study().name);
        let note = match self.tally.rows > MOST_POINTS {
            true => format!("{} of {} candidates are shown", rows.len(), self.tally.rows),
            false => String::new(),
        };
        Figure { title, note, panels }
    }

    fn over_the_axis(&self, rows: &[&Row]) -> Vec<Panel> {
        let look = if self.axes().len() == 1 { Look::Line } else { Look::Dots };
        let across = self.axis(rows, 0);
        let mut panels: Vec<Panel> = Vec::new();
        for (place, report) in (self.axes().len()..).zip(self.reports()) {
            let tips = self.tips(&sorted(rows, 0)).filter(|_| look == Look::Dots);
            let curve = Curve::line(&report.name, points(rows, (0, place))).looks(look);
            let curve = curve.tipped(tips.unwrap_or_default());
            let upwards = Axis::linear("", &report.unit.text);
            match panels.iter_mut().find(|panel| panel.y == upwards) {
                Some(panel) => panel.curves.push(curve),
                None => {
                    let mut panel = Panel::new(across.clone(), upwards);
                    panel.curves.push(curve);
                    panels.push(panel);
                }
            }
        }
        panels
    }

    fn over_the_first(&self, rows: &[&Row]) -> Vec<Panel> {
        let first = self.axes().len();
        let across = self.axis(rows, first);
        let others = (first + 1..).zip(&self.reports()[1..]);
        let panel = |(place, report): (usize, &Column)| {
            let mut panel =
                Panel::new(across.clone(), Axis::linear(&report.name, &report.unit.text));
            panel.curves.extend(self.dots(rows, (first, place)));
            panel
        };
        others.map(panel).collect()
    }

    /// One report of a front over the other, and the front.
    fn over_the_other(&self, rows: &[&Row]) -> Vec<Panel> {
        let front: Vec<&Row> = self.tally.front.rows().iter().collect();
        let [_, _, ink] = INKS;
        let [x, y] = self.tally.front.places().unwrap_or_default();
        let upwards = &self.asked.columns[y];
        let upwards = Axis::linear(&upwards.name, &upwards.unit.text);
        let mut panel = Panel::new(self.axis(rows, x), upwards);
        panel.curves.extend(self.dots(rows, (x, y)));
        panel.curves.push(Curve::line("front", points(&front, (x, y))).as_place(ink));
        vec![panel]
    }

    /// A dot for each candidate, with its values as tooltip. Those that break a limit are a curve
    /// of their own.
    fn dots(&self, rows: &[&Row], (x, y): (usize, usize)) -> Vec<Curve> {
        let (kept, broken): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.keeps());
        let name = if broken.is_empty() { "candidates" } else { KEEPS };
        let [keeps, breaks, _] = INKS;
        let curves = [(name, keeps, kept), (BREAKS, breaks, broken)].into_iter();
        let curves = curves.filter(|(_, _, rows)| !rows.is_empty());
        let dots = |(name, ink, rows): (&str, usize, Vec<&Row>)| {
            let tips = self.tips(&sorted(&rows, x)).unwrap_or_default();
            let dots = Curve::line(name, points(&rows, (x, y))).looks(Look::Dots);
            dots.as_place(ink).tipped(tips)
        };
        curves.map(dots).collect()
    }

    /// The values of each candidate; `None` if there are too many.
    fn tips(&self, rows: &[&Row]) -> Option<Vec<String>> {
        (rows.len() <= MOST_TIPS).then(|| rows.iter().map(|row| self.said(row)).collect())
    }

    /// "case 3: h_fan 40 W/(m^2 K), T_max 62.96 degC; limits kept".
    fn said(&self, row: &Row) -> String {
        let value = |(column, number): (&Column, &f64)| {
            let number = significant(*number, DIGITS);
            format!("{} {number}{}", column.name, spaced(&column.unit.text))
        };
        let values: Vec<String> = self.asked.columns.iter().zip(&row.numbers).map(value).collect();
        let limits = match row.limits.as_str() {
            "" | NONE => String::new(),
            word => format!("; limits {word}"),
        };
        format!("case {}: {}{limits}", row.case + 1, values.join(", "))
    }

    /// Every candidate as a line over its axes and reports, each scaled to its range. Those that
    /// keep their limits, and the front, are drawn last. `None` for one axis.
    pub(super) fn parallel(&self) -> Option<Figure> {
        let rows: Vec<&Row> =
            self.tally.points.iter().filter(|row| row.failed.is_empty()).collect();
        let columns = (self.axes().len() + self.reports().len()).min(MOST_SCALES);
        if self.axes().len() < 2 || rows.len() < 2 {
            return None;
        }
        let stride = rows.len().div_ceil(MOST_LINES);
        let shown: Vec<&Row> = rows.iter().step_by(stride).copied().collect();
        let front = self.tally.front.some(MOST_OF_FRONT);
        let range = |place: usize| {
            let values = rows.iter().chain(&front).map(|row| row.numbers[place]);
            let values = values.filter(|x| x.is_finite());
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let ranges: Vec<(f64, f64)> = (0..columns).map(range).collect();
        let mut panel = Panel::new(self.scales(&ranges), Axis::linear("place in the range", ""));
        let scales = (0..columns).map(|i| Moment { name: String::new(), at: i as f64 });
        panel.moments.extend(scales);
        let (kept, broken): (Vec<&Row>, Vec<&Row>) = shown.iter().partition(|row| row.keeps());
        let name = if broken.is_empty() { "candidates" } else { KEEPS };
        let [keeps, breaks, best] = INKS;
        for (name, ink, rows) in
            [(BREAKS, breaks, broken), (name, keeps, kept), ("front", best, front)]
        {
            let line = |row: &&Row| {
                Curve::line(name, along(row, &ranges)).as_place(ink).tipped(vec![self.said(row)])
            };
            panel.curves.extend(rows.iter().map(line));
        }
        let note = self.left_out(shown.len());
        Some(Figure { title: "Candidates over their values".to_owned(), note, panels: vec![panel] })
    }

    /// Names of the first columns, each with the ends of its range.
    fn scales(&self, ranges: &[(f64, f64)]) -> Axis {
        let name = |(column, (low, high)): (&Column, &(f64, f64))| {
            let [low, high] = [low, high].map(|end| significant(*end, END_DIGITS));
            let unit = printed(&column.unit.text);
            let unit = if unit.is_empty() { unit } else { format!(" [{unit}]") };
            format!("{}{unit}\n{low} \u{2026} {high}", column.name)
        };
        Axis::names("", self.asked.columns.iter().zip(ranges).map(name).collect())
    }

    /// The numbers of candidates that are drawn, if those are not all.
    fn left_out(&self, shown: usize) -> String {
        let front = self.tally.front.rows().len();
        let of_front = self.tally.front.some(MOST_OF_FRONT).len();
        let mut notes = Vec::new();
        if (shown as u64) < self.tally.rows {
            notes.push(format!("{shown} of {} candidates are shown", self.tally.rows));
        }
        if of_front < front {
            notes.push(format!("{of_front} of {front} of the front"));
        }
        notes.join(", ")
    }

    fn axis(&self, rows: &[&Row], place: usize) -> Axis {
        let column = &self.asked.columns[place];
        let values = rows.iter().map(|row| row.numbers[place]);
        let (low, high) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        match low > 0.0 && high / low > WIDE && !column.unit.ty.absolute {
            true => Axis::log(&column.name, &column.unit.text),
            false => Axis::linear(&column.name, &column.unit.text),
        }
    }
}

fn points(rows: &[&Row], (x, y): (usize, usize)) -> Vec<(f64, f64)> {
    sorted(rows, x).iter().map(|row| (row.numbers[x], row.numbers[y])).collect()
}

/// The values of a row, each as its place in its range from 0 to 1.
fn along(row: &Row, ranges: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let place = |(i, (&(low, high), value)): (usize, (&(f64, f64), &f64))| {
        (i as f64, if high > low { (value - low) / (high - low) } else { 0.5 })
    };
    ranges.iter().zip(&row.numbers).enumerate().map(place).collect()
}

/// Rows by the value at a place.
fn sorted<'a>(rows: &[&'a Row], x: usize) -> Vec<&'a Row> {
    let mut rows = rows.to_vec();
    rows.sort_by(|a, b| a.numbers[x].total_cmp(&b.numbers[x]));
    rows
}
