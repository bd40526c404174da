//! An inference as a picture: each estimated time history with its band,
//! and measured next to computed temperatures.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{MOST_CURVES, TEMPERATURE};

use super::InferAnswer;
use crate::fit::figure::{differences, dots, sparse, sparse_note};

/// Standard deviations that nearly all readings stay within.
const TWO: f64 = 2.0;

impl InferAnswer {
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let rows = self.drawn_rows();
        let courses = 0..self.task.estimated.len();
        let mut panels: Vec<Panel> = courses.map(|j| self.course(j, &rows)).collect();
        panels.extend([self.temperatures(&rows), self.surprises()]);
        let title = self.input.title();
        let mut note = format!(
            "bands of 95 %; dots measured ({}); surprise: readings less their predictions from all \
             readings before, in standard deviations",
            self.study.reads.records[0].csv
        );
        let thin = sparse_note(self.found.times.len());
        note += &if thin.is_empty() { String::new() } else { format!("\n{thin}") };
        vec![Figure { title, note, panels }]
    }

    /// The rows of lines and bands that are drawn, those next to a jump among them.
    fn drawn_rows(&self) -> Vec<usize> {
        let times = &self.found.times;
        let courses = self.found.courses.iter();
        let courses = courses.map(|course| course.band.iter().map(|band| band.value).collect());
        let nodes = self.found.nodes.iter().take(MOST_CURVES);
        let nodes = nodes.map(|(_, known)| known.iter().map(|known| known.value).collect());
        let mut drawn: Vec<f64> = Vec::new();
        for values in courses.chain(nodes).collect::<Vec<Vec<f64>>>() {
            let points: Vec<(f64, f64)> = times.iter().copied().zip(values).collect();
            drawn.extend(sparse(&points).iter().map(|point| point.0));
        }
        drawn.extend(self.found.jumps.iter().flat_map(|jump| <[f64; 2]>::from(jump.between)));
        drawn.sort_by(f64::total_cmp);
        let is_drawn = |row: &usize| drawn.binary_search_by(|t| t.total_cmp(&times[*row])).is_ok();
        (0..times.len()).filter(is_drawn).collect()
    }

    fn course(&self, j: usize, rows: &[usize]) -> Panel {
        let (name, unit) = (&self.task.estimated[j].name, &self.units[j]);
        let mut panel = Panel::new(Axis::time(), Axis::linear(name, &*unit.text));
        let band = &self.found.courses[j].band;
        let band = || rows.iter().map(|&row| (self.found.times[row], &band[row]));
        let points = band().map(|(time, band)| (time, self.shown(j, band.value)));
        let ends = band().map(|(_, b)| (self.shown(j, b.ends.0), self.shown(j, b.ends.1)));
        panel.curves.push(Curve::line(name, points.collect()).within(ends.collect()));
        panel
    }

    fn temperatures(&self, rows: &[usize]) -> Panel {
        let unit = &self.input.netlist.temperature_unit;
        let mut panel = Panel::new(Axis::time(), Axis::linear(TEMPERATURE, &*unit.text));
        let network = &self.input.netlist.network;
        for (place, (id, known)) in self.found.nodes.iter().enumerate().take(MOST_CURVES) {
            let name = &network.nodes()[id.index()].name;
            let known = || rows.iter().map(|&row| (self.found.times[row], &known[row]));
            let points = known().map(|(time, known)| (time, unit.from_si(known.value)));
            let half = lptn_units::statistics::NORMAL_95;
            let ends = known().map(|(_, known)| {
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
            let curve = dots(&column.name, &points.collect::<Vec<_>>());
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
            let curve = dots(name, &points.collect::<Vec<_>>());
            panel.curves.push(curve.as_place(self.place(i)));
        }
        panel
    }
}
