//! Picture of several exponentials: the record and the curve over logarithmic time, the residuals,
//! and the spectrum of time constants.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::significant;

use super::FitTermsAnswer;

/// Points of the curve.
const POINTS: u32 = 240;

impl FitTermsAnswer {
    pub(super) fn figure(&self) -> Figure {
        let unit = &self.column.unit;
        let axis = || Axis::log("time after the step", "s");
        let (times, values) = (&self.record.time, &self.column.values);
        let rows = || {
            let rows = times.iter().zip(values).map(|(time, value)| (time - self.step, *value));
            rows.filter(|(time, value)| *time > 0.0 && value.is_finite())
        };
        let name = &self.column.name;
        let mut panel = Panel::new(axis(), Axis::linear(&**name, &*unit.text));
        let fitted = format!("{} exponentials", self.sum.terms.len());
        let curve = self.curve().map(|(time, value)| (time, unit.from_si(value))).collect();
        panel.curves.push(Curve::line(fitted, curve));
        let dots = rows().map(|(time, value)| (time, unit.from_si(value))).collect();
        panel.curves.push(Curve::line(name, dots).looks(Look::Dots));
        let mut missed = Panel::new(axis(), Axis::linear("measured \u{2212} fit", &*unit.text));
        let residuals =
            rows().map(|(time, value)| (time, (value - self.sum.at(time)) / unit.scale));
        missed.curves.push(Curve::line(name, residuals.collect()).looks(Look::Dots).as_place(1));
        let (factor, of) = self.factor();
        let mut spectrum = Panel::new(Axis::log("time constant", "s"), Axis::linear(factor, of));
        let stems = self.rows_of_terms().iter().map(|row| (row.1.value, row.0.value)).collect();
        spectrum.curves.push(Curve::line(factor, stems).looks(Look::Stems));
        let rms = self.sum.chosen().map_or(f64::NAN, |tried| tried.rms / unit.scale);
        let note = format!("rms {} {}", significant(rms, 3), unit.text);
        Figure { title: self.name.clone(), note, panels: vec![panel, missed, spectrum] }
    }

    /// The curve at equal ratios of the time.
    fn curve(&self) -> impl Iterator<Item = (f64, f64)> {
        let after = || self.record.time.iter().map(|time| time - self.step).filter(|t| *t > 0.0);
        let (first, last) = (after().next().unwrap_or(1.0), after().next_back().unwrap_or(1.0));
        let at = move |i: u32| first * (last / first).powf(f64::from(i) / f64::from(POINTS));
        (0..=POINTS).map(at).map(|time| (time, self.sum.at(time)))
    }
}
