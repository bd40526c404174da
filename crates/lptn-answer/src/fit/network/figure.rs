//! Pictures of `lptn fit network`: the residuals of all columns, and every record with the fitted
//! network.
//!
//! A page of many records has to be read and sent: their panels are low, and of many values a share
//! is drawn, those with the largest residuals among them.

use lptn_fit::network::{ColumnMisfit, MeasuredColumn, MeasuredRun};
use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{MOST_CURVES, TEMPERATURE, significant, without_folders};
use lptn_units::Type;

use super::FitNetworkAnswer;
use super::units::Shown;
use crate::fit::figure::differences;

/// Most records that are drawn.
const MOST_RECORDS: usize = 12;

/// More records than this are small pictures next to each other.
const FEW: usize = 2;

/// Height of the panels of small pictures: of values and of residuals.
const SMALL: [f64; 2] = [0.55, 0.3];

/// Rows of all records together that are drawn, and the fewest and the most of one.
const ROWS: [usize; 3] = [1000, 100, 1000];

/// Rows of each column that are drawn because their residuals are the largest.
const LARGEST: usize = 8;

impl FitNetworkAnswer {
    /// The residuals of several records, then a figure for each record.
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let runs = self.task.runs.iter().enumerate().take(MOST_RECORDS);
        let mut figures: Vec<Figure> = runs.map(|(i, run)| self.picture(i, run)).collect();
        let left_out = self.task.runs.len() - figures.len();
        if let (Some(first), 1..) = (figures.first_mut(), left_out) {
            let all = self.task.runs.len();
            first.note += &format!("\nthe first {MOST_RECORDS} of {all} records are drawn");
        }
        if self.task.runs.len() > 1 {
            figures.insert(0, self.missed());
        }
        figures
    }

    /// Mean and root mean square of the residuals of every column of every record.
    fn missed(&self) -> Figure {
        let all: Vec<&ColumnMisfit> = self.fit.columns.iter().collect();
        let mut panels = Vec::new();
        for ty in kinds(all.iter().map(|misfit| self.column(misfit).ty)) {
            let of: Vec<&ColumnMisfit> =
                all.iter().filter(|misfit| self.column(misfit).ty == ty).copied().collect();
            let shown = Shown::of(ty, &self.input.netlist.temperature_unit);
            let name = |misfit: &&ColumnMisfit| {
                format!("{} ({})", self.column(misfit).name, self.record_names()[misfit.run])
            };
            let names = of.iter().map(name).collect();
            let x = Axis::linear("measured \u{2212} fitted", &*shown.of_differences);
            let mut panel = Panel::new(x, Axis::names("", names));
            let at = |i: usize, si: f64| (si / shown.unit.scale, i as f64);
            let rows = || of.iter().enumerate();
            let spread = rows().map(|(i, m)| (at(i, -m.rms).0, at(i, m.rms).0)).collect();
            let rms = Curve::line("\u{b1} rms", rows().map(|(i, m)| at(i, m.rms)).collect());
            panel.curves.push(rms.within(spread).looks(Look::Bars));
            // a mean is that of model less record
            let means = rows().map(|(i, m)| at(i, -m.mean)).collect();
            panel.curves.push(Curve::line("mean", means).looks(Look::Dots));
            let one = |sign: f64| {
                let all = rows().filter_map(move |(i, m)| Some((i, sign * m.sigma?)));
                all.map(|(i, si)| at(i, si)).collect::<Vec<_>>()
            };
            let sigma = [one(-1.0), one(1.0)].concat();
            if !sigma.is_empty() {
                panel.curves.push(Curve::line("\u{b1} sigma", sigma).looks(Look::Dots));
            }
            panels.push(panel);
        }
        let note = "a mean far from zero, or an rms far above sigma, is of the network or of a sensor, \
                    and not of noise";
        Figure { title: "Residuals".to_owned(), note: note.to_owned(), panels }
    }

    /// The names of the records without the folders that all have in common.
    fn record_names(&self) -> Vec<String> {
        without_folders(&self.task.runs.iter().map(|run| run.name.clone()).collect::<Vec<_>>())
    }

    /// Two panels for each measured type: values and residuals.
    fn picture(&self, i: usize, run: &MeasuredRun) -> Figure {
        let all: Vec<&ColumnMisfit> = self.fit.columns.iter().filter(|m| m.run == i).collect();
        let chosen = worst(&all);
        let small = self.task.runs.len() > FEW;
        let rows = self.drawn_rows(run, &chosen);
        let mut notes = Vec::new();
        // the first of many records has the notes that all share
        if !small || i == 0 {
            notes.extend(self.common_notes((rows.len(), run.times.len()), &chosen));
        }
        let mut panels = Vec::new();
        for ty in kinds(chosen.iter().map(|misfit| self.column(misfit).ty)) {
            let shown = Shown::of(ty, &self.input.netlist.temperature_unit);
            let mut panel = Panel::new(Axis::time(), axis(&shown));
            let mut missed = differences("measured \u{2212} fitted", &shown.of_differences);
            if small {
                [panel.share, missed.share] = SMALL;
                [panel.small, missed.small] = [true; 2];
            }
            let mut bands: Vec<f64> = Vec::new();
            let of = |misfit: &ColumnMisfit| self.column(misfit);
            for (place, misfit) in chosen.iter().enumerate().filter(|(_, m)| of(m).ty == ty) {
                let (times, of) = (run.times.as_slice(), of(misfit));
                let drawn = Drawn { times, of, rows: &rows, small, shown: &shown, place };
                panel.curves.extend(drawn.curves(misfit));
                // columns with the same accuracy share a band
                if let Some(sigma) = misfit.sigma.filter(|sigma| !bands.contains(sigma)) {
                    missed.curves.push(drawn.band(sigma));
                    bands.push(sigma);
                }
                missed.curves.push(drawn.residuals(misfit));
                notes.push(drawn.note(misfit));
            }
            panels.extend([panel, missed]);
        }
        if chosen.len() < all.len() {
            let (shown, all) = (chosen.len(), all.len());
            notes.push(format!("the {shown} of {all} columns with the largest misfit are drawn"));
        }
        let note = notes.join(if small { "; " } else { "\n" });
        let title = if small { self.record_names().swap_remove(i) } else { run.name.clone() };
        Figure { title, note, panels }
    }

    /// The meaning of dots, lines and bands, and the share of the rows that is drawn.
    fn common_notes(&self, (shown, all): (usize, usize), drawn: &[&ColumnMisfit]) -> Vec<String> {
        let name = &self.study.name;
        let mut notes = vec![format!("dots measured, lines with the values of fit {name}")];
        if shown < all {
            notes.push(format!(
                "{shown} of {all} rows are drawn, those with the largest residuals among them"
            ));
        }
        if drawn.iter().any(|misfit| misfit.sigma.is_some()) {
            notes.push("bands: 0 \u{b1} 2 sigma".into());
        }
        notes
    }

    /// The rows of a record that are drawn: evenly spaced ones, and those of the largest residuals.
    fn drawn_rows(&self, run: &MeasuredRun, columns: &[&ColumnMisfit]) -> Vec<usize> {
        let [all, least, most] = ROWS;
        let wanted = (all / self.task.runs.len().max(1)).clamp(least, most);
        let step = run.times.len().div_ceil(wanted).max(1);
        let mut rows: Vec<usize> = (0..run.times.len()).step_by(step).collect();
        rows.extend(run.times.len().checked_sub(1));
        for misfit in columns.iter().filter(|_| step > 1) {
            let values = &self.column(misfit).values;
            let missed = |row: usize| (values[row] - misfit.modelled[row]).abs();
            let mut order: Vec<usize> =
                (0..values.len()).filter(|&row| missed(row).is_finite()).collect();
            order.sort_by(|&a, &b| missed(b).total_cmp(&missed(a)));
            rows.extend(order.into_iter().take(LARGEST));
        }
        rows.sort_unstable();
        rows.dedup();
        rows
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
    /// The rows that are drawn.
    rows: &'a [usize],
    small: bool,
    shown: &'a Shown,
    place: usize,
}

impl Drawn<'_> {
    fn curve(&self, value: impl Fn(usize) -> f64) -> Curve {
        let points = self.rows.iter().map(|&row| (self.times[row], value(row))).collect();
        Curve::line(&self.of.name, points).as_place(self.place)
    }

    /// The computed and the measured values at the times of the record.
    fn curves(&self, misfit: &ColumnMisfit) -> [Curve; 2] {
        let shown = |si: f64| self.shown.unit.from_si(si);
        let measured = self.curve(|row| shown(self.of.values[row])).looks(Look::Dots);
        // small pictures name a measured curve by the computed one of its ink
        let name = if self.small { String::new() } else { measured.name.clone() };
        [self.curve(|row| shown(misfit.modelled[row])), Curve { name, ..measured }]
    }

    fn residuals(&self, misfit: &ColumnMisfit) -> Curve {
        let missed = |row: usize| self.of.values[row] - misfit.modelled[row];
        self.curve(|row| missed(row) / self.shown.unit.scale).looks(Look::Dots)
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
