//! A comparison as a picture: hottest temperatures of the candidates, and margins to their limits.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_study::{Candidate, CandidateLimit, CompareRow, HeatOver};

use super::margins::limits;
use super::{CompareAnswer, page};
use crate::words::count;

impl CompareAnswer {
    /// A line for each candidate, in the order of the table.
    pub(super) fn figure(&self) -> Figure {
        let names = page::names(&self.rows);
        let candidates = || Axis::names("", names.clone());
        let unit = &self.unit;
        let mut hot = Panel::new(Axis::linear("temperature", &unit.text), candidates());
        let kelvin = |of: &dyn Fn(&Candidate) -> Option<f64>| {
            self.points(&|row| row.candidate().and_then(of).map(|kelvin| unit.from_si(kelvin)))
        };
        let peaks = kelvin(&|candidate| candidate.peak.map(|peak| peak.temperature));
        // without a run the peak is that of the cycle
        let beside = |c: &Candidate| page::settled(c).filter(|_| c.heat.over == HeatOver::Run);
        let steady = kelvin(&|candidate| candidate.steady);
        let named = [("peak", peaks), ("steady", steady), ("settled", kelvin(&beside))];
        hot.curves = named.into_iter().filter_map(|(name, points)| dots(name, points)).collect();
        let mut margins = Panel::new(Axis::linear("margin", "K"), candidates());
        for judged in limits(&self.rows, self.fold) {
            let name = &judged.name;
            let margin = |limit: &CandidateLimit| {
                (limit.is_temperature() && !limit.is_open()).then_some(limit.margin)
            };
            let points = self.points(&|row| judged.worst(row, &CompareRow::limit).and_then(margin));
            margins.curves.extend(dots(name, points));
            let settled = self.points(&|row| {
                let of_run = row.candidate()?.heat.over == HeatOver::Run;
                let worst = judged.worst(row, &CompareRow::settled_limit);
                worst.filter(|_| of_run).and_then(margin)
            });
            margins.curves.extend(dots(&format!("{name}, settled"), settled));
        }
        margins.moments.push(Moment { name: "limit".into(), at: 0.0 });
        let panels = [hot, margins].into_iter().filter(|panel| !panel.curves.is_empty());
        let title = count(self.rows.len(), "candidate");
        Figure { title, note: String::new(), panels: panels.collect() }
    }

    /// The value of each row that has one, at its line.
    fn points(&self, value: &dyn Fn(&CompareRow) -> Option<f64>) -> Vec<(f64, f64)> {
        let lines = (0..).map(f64::from).zip(&self.rows);
        lines.filter_map(|(line, row)| Some((value(row)?, line))).collect()
    }
}

fn dots(name: &str, points: Vec<(f64, f64)>) -> Option<Curve> {
    (!points.is_empty()).then(|| Curve::line(name, points).looks(Look::Dots))
}
