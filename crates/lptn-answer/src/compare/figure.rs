//! A comparison as a picture: hottest temperatures of the candidates, and margins to their limits.

use std::path::PathBuf;
use std::sync::Arc;

use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_plot::{Figure, thinned};
use lptn_report::{Format, MOST_CURVES};
use lptn_study::{Candidate, CandidateLimit, CompareRow, HeatOver};

use super::margins::limits;
use super::{CompareAnswer, page};
use crate::input::Input;
use crate::listener::Nobody;
use crate::plot::{Source, overlay};
use crate::run::{RunQuestion, View};
use crate::words::{count, difference};

/// Most candidates whose curves are over each other.
const MOST: usize = 8;

/// Stretches of a curve that is drawn.
const PIXELS: usize = 800;

/// The share that a receiver of heat has in a candidate.
type Share<'a> = Box<dyn Fn(&CompareRow) -> Option<f64> + 'a>;

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
        let mut margins = Panel::new(Axis::linear("margin", difference(unit)), candidates());
        for judged in limits(&self.rows, self.fold) {
            let name = &judged.name;
            let margin = |limit: &CandidateLimit| {
                (limit.is_temperature() && !limit.is_open()).then_some(limit.margin / unit.scale)
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

    /// The hottest node of each of the first candidates over its run, over each other, with limits:
    /// as `lptn plot` draws their runs. `None` if fewer than two were run.
    pub(super) fn curves(&self) -> Option<Figure> {
        let names = page::names(&self.rows);
        let rows = self.rows.iter().zip(&self.inputs).zip(names);
        let ran = rows.filter_map(|((row, input), name)| {
            let candidate = row.candidate().filter(|c| c.heat.over == HeatOver::Run)?;
            Some((candidate.hottest.clone()?, Arc::clone(input.as_ref()?), name))
        });
        let sources: Vec<Source> = ran.take(MOST).filter_map(|of| self.source(of)).collect();
        if sources.len() < 2 {
            return None;
        }
        let mut figure = overlay(sources);
        let note = match self.rows.len() > MOST {
            true => format!("hottest node of the first {MOST} candidates"),
            false => "hottest node of each candidate".to_owned(),
        };
        figure.title = "Hottest node over time".to_owned();
        figure.note = note;
        Some(figure)
    }

    fn source(&self, (node, input, name): (String, Arc<Input>, String)) -> Option<Source> {
        let question = RunQuestion {
            select: vec![format!("{node}.T")],
            temperature_unit: Some(self.unit.text.clone()),
            format: Format::Csv,
            picture: true,
            view: View::of_page(),
            ..RunQuestion::default()
        };
        let path = PathBuf::from(&input.text.name);
        let answer = question.ask(input, &Nobody).ok()?;
        let mut source = Source { name, ..Source::of_run(&path, &answer, false) };
        source.figure.note = String::new();
        for panel in &mut source.figure.panels {
            // switches of several designs would cover each other
            panel.moments.clear();
            panel.curves.iter_mut().for_each(|curve| curve.points = thinned(&curve.points, PIXELS));
        }
        Some(source)
    }

    /// The shares of the heat by its receivers, by paths if a boundary has several, as bars.
    pub(super) fn heat_bars(&self) -> Option<Figure> {
        let names = page::names(&self.rows);
        let percent = Axis::linear("share of the heat", "%");
        let mut panel = Panel::new(percent, Axis::names("", names));
        let mut ends = vec![0.0; self.rows.len()];
        for (receiver, share) in self.receivers() {
            let (mut points, mut spread) = (Vec::new(), Vec::new());
            for (i, row) in self.rows.iter().enumerate() {
                let Some(share) = share(row).filter(|share| *share > 0.0) else { continue };
                let from = ends[i];
                ends[i] += 100.0 * share;
                points.push((ends[i], i as f64));
                spread.push((from, ends[i]));
            }
            let bars = Curve::line(receiver, points).within(spread).looks(Look::Bars);
            panel.curves.extend(Some(bars).filter(|bars| !bars.points.is_empty()));
        }
        let title = format!("Shares of the {}", page::heat_over(&self.rows));
        let whole = !panel.curves.is_empty() && panel.curves.len() <= MOST_CURVES;
        whole.then(|| Figure { title, note: String::new(), panels: vec![panel] })
    }

    /// The receivers of heat with their shares.
    fn receivers(&self) -> Vec<(String, Share<'_>)> {
        let mut found: Vec<(String, Share<'_>)> =
            vec![("stored".to_owned(), Box::new(|row: &CompareRow| row.candidate()?.heat.stored))];
        for boundary in CompareRow::boundary_names(&self.rows) {
            for part in self.parts(boundary) {
                let name = part.clone();
                found.push((part, Box::new(move |row: &CompareRow| row.share(&name))));
            }
        }
        found
    }

    /// The paths to a boundary that has several, else the boundary.
    fn parts(&self, boundary: &str) -> Vec<String> {
        let listed = CompareRow::path_names(&self.rows);
        let mut parts: Vec<String> = Vec::new();
        let all = self.rows.iter().filter_map(CompareRow::candidate).flat_map(|c| &c.heat.paths);
        for path in all.filter(|path| path.to == boundary && listed.contains(&&*path.name)) {
            if !parts.contains(&path.name) {
                parts.push(path.name.clone());
            }
        }
        if parts.is_empty() { vec![boundary.to_owned()] } else { parts }
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
