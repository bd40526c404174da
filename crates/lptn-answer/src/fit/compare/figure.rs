//! Pictures of `lptn fit compare`: residuals of each candidate in a held-out record,
//! and the errors of all held-out records.

use lptn_fit::choice::{Held, Judged};
use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_report::{MOST_CURVES, shortened};

use super::FitCompareAnswer;
use super::words::unseen;
use crate::words::count;

/// Columns that are drawn, at most.
const MOST_COLUMNS: usize = 3;

/// Letters of a name next to its dots.
const NAME: usize = 24;

impl FitCompareAnswer {
    pub(super) fn picture(&self) -> Figure {
        let order: Vec<usize> = self.order().into_iter().take(MOST_CURVES).collect();
        let record = self.drawn();
        let runs = self.choice.contenders.first().map_or(&[][..], |one| &one.task.runs);
        let columns = runs.get(record).map_or(0, |run| run.columns.len()).min(MOST_COLUMNS);
        let mut panels: Vec<Panel> =
            (0..columns).map(|column| self.missed(&order, (record, column))).collect();
        panels.push(self.of_each(&order));
        let name = runs.get(record).map_or("", |run| run.name.as_str());
        let note = format!("{}\ncurves: {name}", unseen(self));
        Figure { title: count(self.candidates.len(), "candidate"), note, panels }
    }

    /// The record in which the held-out errors of the candidates differ most.
    fn drawn(&self) -> usize {
        let of = |i: usize, part: usize| self.judged(i).unseen[part].over_sigma;
        let parts = self.judged(self.choice.best).unseen.len();
        let spread = |part: &usize| {
            let all = (0..self.candidates.len()).map(|i| of(i, *part));
            let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
            high / low
        };
        (0..parts).rev().max_by(|a, b| spread(a).total_cmp(&spread(b))).unwrap_or(0)
    }

    /// Measured minus predicted values of one column of one record.
    fn missed(&self, order: &[usize], (record, column): (usize, usize)) -> Panel {
        let run = &self.judged(self.choice.best).task.runs[record];
        let name = format!("{}: measured \u{2212} predicted", run.columns[column].name);
        let mut panel = Panel::new(
            Axis::time(),
            Axis::linear(name, run.columns[column].ty.dimension.si_unit()),
        );
        for (place, &i) in order.iter().enumerate() {
            let points = missed(self.judged(i), (record, column));
            panel.curves.push(Curve::line(self.name(i), points).as_place(place));
        }
        let ends = [run.times.first(), run.times.last()].into_iter().flatten();
        let zero = ends.map(|time| (*time, 0.0)).collect();
        panel.curves.push(Curve::line("", zero).looks(Look::Dashed).as_place(order.len()));
        if let Held::LastThird { from } = self.choice.held {
            panel.moments.push(Moment { name: "held out".into(), at: from });
        }
        panel
    }

    /// A line for each candidate, with a dot for each record.
    fn of_each(&self, order: &[usize]) -> Panel {
        let names = order.iter().map(|&i| shortened(self.name(i), NAME)).collect();
        let mut panel = Panel::new(
            Axis::linear("held-out misfit rms", self.unit()),
            Axis::names("candidate", names),
        );
        for (place, &i) in order.iter().enumerate() {
            let all = self.judged(i).unseen.iter().map(|part| (part.rms, place as f64));
            let curve = Curve::line("", all.collect());
            panel.curves.push(curve.looks(Look::Dots).as_place(place));
        }
        panel
    }
}

fn missed(judged: &Judged, (record, column): (usize, usize)) -> Vec<(f64, f64)> {
    let run = &judged.task.runs[record];
    let part = judged.unseen.iter().find(|part| part.run == record);
    let Some(modelled) = part.and_then(|part| part.modelled.get(column)) else { return Vec::new() };
    let both = run.columns[column].values.iter().zip(modelled);
    let rows = run.times.iter().zip(both);
    rows.map(|(time, (value, modelled))| (*time, value - modelled)).collect()
}
