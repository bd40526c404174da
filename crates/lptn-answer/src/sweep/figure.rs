//! A sweep as a picture: reports over the parameter, or one report over another.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};

use super::asked::Column;
use super::page::SweepAnswer;
use super::row::Row;
use super::tally::MOST_POINTS;

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
            let curve = Curve::line(&report.name, points(rows, (0, place))).looks(look);
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
            let dots = Curve::line("candidates", points(rows, (first, place)));
            panel.curves.push(dots.looks(Look::Dots));
            panel
        };
        others.map(panel).collect()
    }

    /// One report of a front over the other, and the front.
    fn over_the_other(&self, rows: &[&Row]) -> Vec<Panel> {
        let front: Vec<&Row> = self.tally.front.rows().iter().collect();
        let [x, y] = self.tally.front.places().unwrap_or_default();
        let upwards = &self.asked.columns[y];
        let upwards = Axis::linear(&upwards.name, &upwards.unit.text);
        let mut panel = Panel::new(self.axis(rows, x), upwards);
        panel.curves.push(Curve::line("candidates", points(rows, (x, y))).looks(Look::Dots));
        panel.curves.push(Curve::line("front", points(&front, (x, y))).looks(Look::Line));
        vec![panel]
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
    let mut points: Vec<(f64, f64)> =
        rows.iter().map(|row| (row.numbers[x], row.numbers[y])).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}
