//! Pictures of `lptn fit network`: every record with the fitted network, and the residuals.

use lptn_fit::network::{ColumnMisfit, MeasuredColumn, MeasuredRun};
use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{MOST_CURVES, TEMPERATURE, significant};
use lptn_units::Type;

use super::FitNetworkAnswer;
use super::units::Shown;
use crate::fit::figure::differences;

/// Most records that are drawn.
const MOST_RECORDS: usize = 12;

impl FitNetworkAnswer {
    /// A figure for each record.
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let runs = self.task.runs.iter().enumerate().take(MOST_RECORDS);
        let mut figures: Vec<Figure> = runs.map(|(i, run)| self.picture(i, run)).collect();
        let left_out = self.task.runs.len() - figures.len();
        if let (Some(first), 1..) = (figures.first_mut(), left_out) {
            let all = self.task.runs.len();
            first.note += &format!("\nthe first {MOST_RECORDS} of {all} records are drawn");
        }
        figures
    }

    /// Two panels for each measured type: values and residuals.
    fn picture(&self, i: usize, run: &MeasuredRun) -> Figure {
        let all: Vec<&ColumnMisfit> = self.fit.columns.iter().filter(|m| m.run == i).collect();
        let chosen = worst(&all);
        let mut notes =
            vec![format!("dots measured, lines with the values of fit {}", self.study.name)];
        let mut panels = Vec::new();
        let mut banded = false;
        for ty in kinds(chosen.iter().map(|misfit| self.column(misfit).ty)) {
            let shown = Shown::of(ty, &self.input.netlist.temperature_unit);
            let mut panel = Panel::new(Axis::time(), axis(&shown));
            let mut missed = differences("measured \u{2212} fitted", &shown.of_differences);
            let mut bands: Vec<f64> = Vec::new();
            let of = |misfit: &ColumnMisfit| self.column(misfit);
            for (place, misfit) in chosen.iter().enumerate().filter(|(_, m)| of(m).ty == ty) {
                let drawn = Drawn { times: &run.times, of: of(misfit), shown: &shown, place };
                panel.curves.extend(drawn.curves(misfit));
                // columns with the same accuracy share a band
                if let Some(sigma) = misfit.sigma.filter(|sigma| !bands.contains(sigma)) {
                    missed.curves.push(drawn.band(sigma));
                    bands.push(sigma);
                }
                missed.curves.push(drawn.residuals(misfit));
                notes.push(drawn.note(misfit));
            }
            banded |= !bands.is_empty();
            panels.extend([panel, missed]);
        }
        if banded {
            notes.push("bands: 0 \u{b1} 2 sigma".into());
        }
        if chosen.len() < all.len() {
            let (shown, all) = (chosen.len(), all.len());
            notes.push(format!("the {shown} of {all} columns with the largest misfit are drawn"));
        }
        Figure { title: run.name.clone(), note: notes.join("\n"), panels }
    }
}

/// Each type once, in the order in which they come.
fn kinds(all: impl Iterator<Item = Type>) -> Vec<Type> {
    let mut kinds = Vec::new();
    for ty in all {
        if !kinds.contains(&ty) {
            kinds.push(ty);
        }
    }
    kinds
}

/// The axis of measured values.
fn axis(shown: &Shown) -> Axis {
    let ty = shown.unit.ty;
    let name = if ty.absolute { Some(TEMPERATURE) } else { ty.dimension.quantity_name() };
    Axis::linear(name.unwrap_or("value"), &*shown.unit.text)
}

/// The columns with the largest misfits, in the order of the record.
fn worst<'a>(all: &[&'a ColumnMisfit]) -> Vec<&'a ColumnMisfit> {
    let mut chosen = all.to_vec();
    chosen.sort_by(|a, b| b.rms.total_cmp(&a.rms));
    chosen.truncate(MOST_CURVES);
    chosen.sort_by_key(|misfit| misfit.column);
    chosen
}

/// A column of a record with its ink.
struct Drawn<'a> {
    times: &'a [f64],
    of: &'a MeasuredColumn,
    shown: &'a Shown,
    place: usize,
}

impl Drawn<'_> {
    fn curve(&self, values: impl Iterator<Item = f64>) -> Curve {
        let points = self.times.iter().copied().zip(values).collect();
        Curve::line(&self.of.name, points).as_place(self.place)
    }

    /// The computed and the measured values at the times of the record.
    fn curves(&self, misfit: &ColumnMisfit) -> [Curve; 2] {
        let shown = |values: &[f64]| -> Vec<f64> {
            values.iter().map(|si| self.shown.unit.from_si(*si)).collect()
        };
        let [measured, modelled] = [&self.of.values, &misfit.modelled].map(|values| shown(values));
        [self.curve(modelled.into_iter()), self.curve(measured.into_iter()).looks(Look::Dots)]
    }

    fn residuals(&self, misfit: &ColumnMisfit) -> Curve {
        let both = self.of.values.iter().zip(&misfit.modelled);
        let missed = both.map(|(value, modelled)| (value - modelled) / self.shown.unit.scale);
        self.curve(missed).looks(Look::Dots)
    }

    /// The band around zero that the noise lets nearly all residuals stay in.
    fn band(&self, sigma: f64) -> Curve {
        let ends = [self.times.first(), self.times.last()].into_iter().flatten();
        let two = 2.0 * sigma / self.shown.unit.scale;
        let zero: Vec<(f64, f64)> = ends.map(|time| (*time, 0.0)).collect();
        let spread = vec![(-two, two); zero.len()];
        Curve::line("", zero).within(spread).looks(Look::Dashed).as_place(self.place)
    }

    fn note(&self, misfit: &ColumnMisfit) -> String {
        let shown = |si: f64| {
            let value = significant(si / self.shown.unit.scale, 3);
            format!("{value} {}", self.shown.of_differences)
        };
        let sigma = misfit.sigma.map_or(String::new(), |sigma| format!(", sigma {}", shown(sigma)));
        format!("{}: misfit {} rms{sigma}", self.of.name, shown(misfit.rms))
    }
}
