//! Picture of `lptn fit step`: every column with its exponential over time, and the residuals.

use lptn_fit::step::{Estimated, StepFit};
use lptn_netlist::RecordColumn;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_plot::{Figure, printed};
use lptn_report::{MOST_CURVES, TEMPERATURE, significant};
use lptn_units::Unit;

use super::estimate::with_error;
use super::{FitStepAnswer, StepColumn};
use crate::fit::figure::{differences, dots, sparse_note};
use crate::words::difference;

/// Points of a curve that is drawn.
const POINTS: u32 = 240;

/// Largest distance of T_f from the end of the record that is drawn, in heights of the record.
const FAR: f64 = 1.5;

impl FitStepAnswer {
    /// The record over time, the exponentials through it, and their residuals.
    pub(super) fn figure(&self) -> Figure {
        let unit = &self.request.unit;
        let mut panel = Panel::new(Axis::time(), Axis::linear(TEMPERATURE, &*unit.text));
        let mut missed = differences("measured \u{2212} fit", difference(unit));
        let mut notes = Vec::new();
        for (place, column) in self.columns.iter().take(MOST_CURVES).enumerate() {
            let drawn = Drawn { answer: self, column, place };
            panel.curves.extend(drawn.curves());
            missed.curves.extend(drawn.residuals());
            notes.push(drawn.note());
        }
        let place = self.columns.len().min(MOST_CURVES);
        notes.extend(left_out(self.columns.len() - place));
        notes.extend(self.bare(&mut panel, place));
        if let Some(model) = &self.model {
            let points = model.bias.answer.iter().map(|&(t, kelvin)| (t, unit.from_si(kelvin)));
            let name = format!("{} of {}", model.port, model.stem);
            let curve = Curve::line(name, points.collect()).looks(Look::Dashed);
            panel.curves.push(curve.as_place(place + self.without.len()));
            notes.push(format!("{} as {} computes it is dashed too", model.port, model.file));
        }
        let thin = sparse_note(self.request.record.time.len());
        notes.extend(Some(thin.to_owned()).filter(|note| !note.is_empty()));
        let panels = vec![panel, missed];
        Figure { title: self.request.name.clone(), note: notes.join("\n"), panels }
    }

    /// Draws the columns without a fit from a place on, and says so.
    fn bare(&self, panel: &mut Panel, place: usize) -> Vec<String> {
        let record = &self.request.record;
        let mut notes = Vec::new();
        for (i, (name, code)) in self.without.iter().take(MOST_CURVES - place).enumerate() {
            let columns = record.columns.iter().filter(|column| column.name == *name);
            let dots = columns.map(|column| measured(self, column).as_place(place + i));
            panel.curves.extend(dots);
            notes.push(format!("{name}: no fit ({code})"));
        }
        notes.extend(left_out(self.without.len() - notes.len()));
        notes
    }
}

fn left_out(count: usize) -> Option<String> {
    (count > 0).then(|| format!("{count} more columns are not drawn; --column chooses"))
}

/// A column of the record as dots.
fn measured(answer: &FitStepAnswer, column: &RecordColumn) -> Curve {
    let unit = &answer.request.unit;
    let rows = answer.request.record.time.iter().zip(&column.values);
    let points: Vec<_> = rows.map(|(&time, &kelvin)| (time, unit.from_si(kelvin))).collect();
    dots(&column.name, &points)
}

/// A column of the record with its ink.
struct Drawn<'a> {
    answer: &'a FitStepAnswer,
    column: &'a StepColumn,
    place: usize,
}

impl Drawn<'_> {
    fn fit(&self) -> &StepFit {
        &self.column.fit
    }

    fn unit(&self) -> &Unit {
        &self.answer.request.unit
    }

    fn name(&self) -> &str {
        &self.column.column.name
    }

    /// First and last time of the record.
    fn ends(&self) -> (f64, f64) {
        let times = &self.answer.request.record.time;
        (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0))
    }

    /// A curve of temperatures in K over the time from the first row.
    fn curve(&self, name: &str, of: impl Fn(f64) -> f64) -> Curve {
        let (first, last) = self.ends();
        let at = |i: u32| (last - first) * f64::from(i) / f64::from(POINTS);
        let point = |i: u32| (first + at(i), of(at(i)));
        Curve::line(name, (0..=POINTS).map(point).collect()).as_place(self.place)
    }

    /// The exponential, a second one if it is offered, T_f, and the measured values.
    fn curves(&self) -> Vec<Curve> {
        let (fit, unit) = (self.fit(), self.unit());
        let mut curves = vec![self.curve(self.name(), |t| unit.from_si(fit.at(t)))];
        if let Some(two) = &fit.second.offer {
            let name = format!("{}, two exponentials", self.name());
            curves.push(self.curve(&name, |t| unit.from_si(two.at(t))).looks(Look::Dashed));
        }
        if self.is_near() {
            let (first, last) = self.ends();
            let (low, high) = fit.settled.interval();
            let [settled, low, high] = [fit.settled.value, low, high].map(|t| unit.from_si(t));
            let name = format!("T_f of {}", self.name());
            let level = Curve::line(name, vec![(first, settled), (last, settled)]);
            let end = Curve::line("", vec![(last, settled)]).within(vec![(low, high)]);
            curves.push(level.looks(Look::Dashed).as_place(self.place));
            curves.push(end.looks(Look::Dots).as_place(self.place));
        }
        curves.push(measured(self.answer, &self.column.column).as_place(self.place));
        curves
    }

    /// True if T_f can be shown without making the record flat.
    fn is_near(&self) -> bool {
        let fit = self.fit();
        fit.beyond.abs() <= FAR * (fit.at(fit.length) - fit.initial.value).abs()
    }

    /// The residuals of the exponential, and the difference of a second one to it.
    fn residuals(&self) -> Vec<Curve> {
        let (first, _) = self.ends();
        let fit = self.fit();
        let step = self.unit().scale;
        let rows = self.answer.request.record.time.iter().zip(&self.column.column.values);
        let missed = rows.map(|(&time, &kelvin)| (time, (kelvin - fit.at(time - first)) / step));
        let dots = dots(self.name(), &missed.collect::<Vec<_>>());
        let mut curves = Vec::new();
        if let Some(two) = &fit.second.offer {
            let name = format!("{}, two exponentials", self.name());
            let curve = self.curve(&name, |t| (two.at(t) - fit.at(t)) / step);
            curves.push(curve.looks(Look::Dashed));
        }
        curves.push(dots.as_place(self.place));
        curves
    }

    /// Its numbers in a line.
    fn note(&self) -> String {
        let (fit, unit) = (self.fit(), self.unit());
        let temperature =
            |t: &Estimated| with_error(unit.from_si(t.value), t.standard_error / unit.scale);
        let range = |t: &Estimated, shown: &dyn Fn(f64) -> f64| {
            let [low, high] = <[f64; 2]>::from(t.interval()).map(|end| significant(shown(end), 4));
            format!("{low} .. {high}")
        };
        let mut note = format!(
            "{}: T_i {}, T_f {} {degrees}, t_RC {} s; 95 %: T_f {} {degrees}, t_RC {} s",
            self.name(),
            temperature(&fit.initial),
            temperature(&fit.settled),
            with_error(fit.tau.value, fit.tau.standard_error),
            range(&fit.settled, &|kelvin| unit.from_si(kelvin)),
            range(&fit.tau, &|seconds| seconds),
            degrees = printed(&unit.text),
        );
        if fit.extrapolates() {
            let beyond = significant(fit.beyond.abs() / unit.scale, 3);
            let drawn = if self.is_near() { "" } else { " and not drawn" };
            note += &format!("; T_f is extrapolated by {beyond} {}{drawn}", difference(unit));
        }
        note
    }
}
