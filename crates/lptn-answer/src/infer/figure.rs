//! An inference as a picture: each estimated time history with its band,
//! and measured next to computed temperatures.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{MOST_CURVES, TEMPERATURE};

use super::InferAnswer;
use crate::fit::figure::differences;

/// Standard deviations that nearly all readings stay within.
const TWO: f64 = 2.0;

impl InferAnswer {
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let mut panels: Vec<Panel> = (0..self.task.sought.len()).map(|j| self.course(j)).collect();
        panels.extend([self.temperatures(), self.surprises()]);
        let title = self.input.title();
        let note = format!(
            "bands of 95 %; dots measured ({}); surprise: readings less their predictions from all \
             readings before, in standard deviations",
            self.study.reads.records[0].csv
        );
        vec![Figure { title, note, panels }]
    }

    fn course(&self, j: usize) -> Panel {
        let (name, unit) = (&self.task.sought[j].name, &self.units[j]);
        let mut panel = Panel::new(Axis::time(), Axis::linear(name, &*unit.text));
        let band = &self.found.courses[j].band;
        let times = self.found.times.iter().copied();
        let points = times.zip(band.iter().map(|band| self.shown(j, band.value)));
        let ends = band.iter().map(|band| (self.shown(j, band.ends.0), self.shown(j, band.ends.1)));
        panel.curves.push(Curve::line(name, points.collect()).within(ends.collect()));
        panel
    }

    fn temperatures(&self) -> Panel {
        let unit = &self.input.netlist.temperature_unit;
        let mut panel = Panel::new(Axis::time(), Axis::linear(TEMPERATURE, &*unit.text));
        let network = &self.input.netlist.network;
        for (place, (id, known)) in self.found.nodes.iter().enumerate().take(MOST_CURVES) {
            let name = &network.nodes()[id.index()].name;
            let times = self.found.times.iter().copied();
            let points = times.zip(known.iter().map(|known| unit.from_si(known.value)));
            let half = lptn_units::statistics::NORMAL_95;
            let ends = known.iter().map(|known| {
                let (value, half) = (known.value, half * known.deviation);
                (unit.from_si(value - half), unit.from_si(value + half))
            });
            let curve = Curve::line(name, points.collect()).within(ends.collect());
            panel.curves.push(curve.as_place(place));
        }
        // a difference of two temperatures is left out
        let columns = self.task.run.columns.iter().enumerate().take(MOST_CURVES);
        for (i, column) in columns.filter(|(_, column)| column.ty.absolute) {
            let times = self.task.run.times.iter().copied();
            let points = times.zip(column.values.iter().map(|kelvin| unit.from_si(*kelvin)));
            let curve = Curve::line(&column.name, points.collect()).looks(Look::Dots);
            panel.curves.push(curve.as_place(self.place(i)));
        }
        panel
    }

    /// The place of a column: that of the node which it measured.
    fn place(&self, column: usize) -> usize {
        let of = self.task.run.columns[column].nodes().first().map(|(id, _)| *id);
        self.found.nodes.iter().position(|(id, _)| Some(*id) == of).unwrap_or(column)
    }

    /// Readings less their predictions, with a band of two standard deviations.
    fn surprises(&self) -> Panel {
        let mut panel = differences("surprise", "sigma");
        let times = &self.found.times;
        let ends: Vec<(f64, f64)> =
            [times.first(), times.last()].into_iter().flatten().map(|time| (*time, 0.0)).collect();
        let band = vec![(-TWO, TWO); ends.len()];
        panel.curves.push(Curve::line("", ends).within(band).looks(Look::Dashed).as_place(0));
        for (i, found) in self.found.columns.iter().enumerate().take(MOST_CURVES) {
            let points = found.surprises.iter().map(|(k, surprise)| (times[*k], *surprise));
            let name = &self.task.run.columns[i].name;
            let curve = Curve::line(name, points.collect()).looks(Look::Dots);
            panel.curves.push(curve.as_place(self.place(i)));
        }
        panel
    }
}
