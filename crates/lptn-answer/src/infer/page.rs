//! An inference as a page.

use std::io;

use lptn_fit::infer::{InferredColumn, InferredCourse, InferredJump, InferredSensor, Known};
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Text, TextTable, decimals, duration, fixed, significant,
};
use lptn_solve::Table;
use serde_json::{Value, json};

use super::InferAnswer;
use crate::messages;
use crate::words::{count, difference, symbol};

/// Moments that are shown, at most.
const MOMENTS: usize = 13;

/// Characters of a line, those of the times, and those of an end of a band with its gap.
const LINE: usize = 80;
const TIME: usize = 9;
const END: usize = 8;

/// A random walk is reported by its change in this time in s.
const MINUTE: f64 = 60.0;

impl Page for InferAnswer {
    fn text(&self) -> Text {
        let mut text = Text::titled(self.input.title());
        let names: Vec<&str> = self.task.estimated.iter().map(|s| s.name.as_str()).collect();
        let readings = self.found.columns.iter().map(|column| column.readings).sum();
        text.line(format!(
            "infer {}: {} over {} from {} of {}",
            self.study.name,
            names.join(", "),
            duration(self.length(), 3),
            count(readings, "value"),
            count(self.found.columns.len(), "column"),
        ));
        text.section().table(self.moments());
        if !self.found.jumps.is_empty() {
            text.section().table(self.jumps());
        }
        text.section().table(self.means());
        self.instruments(&mut text);
        text.conclude(11, self.notes(), &self.verdict());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.table().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        self.report()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let netlist = &self.input.netlist;
        let warnings = [netlist.warnings.as_slice(), &self.doubts].concat();
        json.member("format", &1)?;
        json.member("network", &self.input.text.stem)?;
        json.member("study", &self.study.name)?;
        json.member("warnings", &messages::list(&netlist.files, &warnings))?;
        json.member("signals", &self.signals_json())?;
        json.member("jumps", &self.jumps_json())?;
        json.member("sensors", &self.sensors_json())?;
        json.member("parameters", &self.parameters_json())?;
        json.member("columns", &self.columns_json())?;
        json.member("log_likelihood", &self.found.log_likelihood)?;
        json.member("rounds", &self.found.rounds)?;
        json.member("determined", &self.is_whole())?;
        json.member("verdict", &self.verdict())?;
        let table = self.table();
        let names: Vec<Value> =
            table.columns().iter().map(|c| json!({ "name": c.name, "unit": c.unit })).collect();
        let rows: Vec<Vec<f64>> = (0..table.rows()).map(|row| table.row(row).collect()).collect();
        json.member("moments", &json!({ "columns": names, "rows": rows }))
    }

    fn no(&self) -> Option<String> {
        (!self.is_whole()).then(|| self.verdict())
    }
}

/// A value and its error, to two digits of the error.
fn with_error(value: f64, error: f64) -> (String, String) {
    if error > 0.0 && error.is_finite() {
        let digits = decimals(error, 2, 0);
        return (fixed(value, digits), fixed(error, digits));
    }
    (significant(value, 6), String::new())
}

/// A number with as many decimals as an error has.
pub(super) fn to_error(value: f64, error: &str) -> String {
    let digits = error.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    if error.is_empty() { significant(value, 6) } else { fixed(value, digits) }
}

impl InferAnswer {
    /// Adds instruments, parameters and columns.
    pub(super) fn instruments(&self, text: &mut Text) {
        if !self.found.sensors.is_empty() {
            text.section().table(self.sensors());
        }
        if !self.found.parameters.is_empty() {
            text.section().table(self.parameters());
        }
        text.section().table(self.columns());
    }

    fn length(&self) -> f64 {
        let times = &self.found.times;
        times.last().copied().unwrap_or(0.0) - times.first().copied().unwrap_or(0.0)
    }

    pub(super) fn is_whole(&self) -> bool {
        self.found.courses.iter().all(InferredCourse::is_determined)
    }

    /// Every moment: signals with the ends of their bands, temperatures with their deviations.
    pub fn table(&self) -> Table {
        let rows: Vec<usize> = (0..self.found.times.len()).collect();
        let mut table = Table::of(&rows);
        table.column("time", "s", |&k| self.found.times[k]);
        for (j, estimated) in self.task.estimated.iter().enumerate() {
            let (band, unit) = (&self.found.courses[j].band, &self.units[j].text);
            let name = |ending: &str| format!("{}{ending}", estimated.name);
            table.column(name(""), unit, |&k| self.shown(j, band[k].value));
            table.column(name(".low"), unit, |&k| self.shown(j, band[k].ends.0));
            table.column(name(".high"), unit, |&k| self.shown(j, band[k].ends.1));
        }
        let unit = &self.input.netlist.temperature_unit;
        for (id, known) in &self.found.nodes {
            let name = &self.input.netlist.network.nodes()[id.index()].name;
            table.column(format!("{name}.T"), &unit.text, |&k| unit.from_si(known[k].value));
            let deviation = |&k: &usize| known[k].deviation / unit.scale;
            table.column(format!("{name}.T.sd"), difference(unit), deviation);
        }
        table.done()
    }

    /// Moments at even distances.
    pub(super) fn moments(&self) -> TextTable {
        let last = self.found.times.len() - 1;
        let most = MOMENTS.min(last + 1) - 1;
        let chosen: Vec<usize> = (0..=most).map(|i| i * last / most).collect();
        let mut table =
            TextTable::of(&chosen).right("time", |&k| duration(self.found.times[k], 3)).names();
        for (j, estimated) in self.task.estimated.iter().enumerate() {
            let band = &self.found.courses[j].band;
            let half = |k: usize| 0.5 * (band[k].ends.1 - band[k].ends.0).abs();
            let widest = chosen.iter().map(|&k| self.shown_difference(j, half(k)));
            let digits = decimals(widest.fold(f64::INFINITY, f64::min), 2, 0);
            let shown = move |si: f64| fixed(self.shown(j, si), digits);
            let unit = symbol(&self.units[j].text);
            table = table
                .right(format!("{} [{unit}]", estimated.name), move |&k| shown(band[k].value))
                .right("from", move |&k| shown(band[k].ends.0))
                .right("to", move |&k| shown(band[k].ends.1));
        }
        let unit = &self.input.netlist.temperature_unit;
        let head = |name: &str, unit: &str| format!("{name} [{}]", symbol(unit));
        let courses = self.task.estimated.iter().zip(&self.units);
        let heads = courses.map(|(estimated, unit)| head(&estimated.name, &unit.text));
        let mut width = TIME + heads.map(|head| head.chars().count() + 2 + 2 * END).sum::<usize>();
        for (id, known) in &self.found.nodes {
            let head = head(&self.input.netlist.network.nodes()[id.index()].name, &unit.text);
            width += head.chars().count() + 2;
            if width > LINE {
                break;
            }
            table = table.right(head, move |&k: &usize| fixed(unit.from_si(known[k].value), 2));
        }
        table.into()
    }

    /// Times and sizes of the jumps of signals.
    pub(super) fn jumps(&self) -> TextTable {
        let by = |jump: &InferredJump| {
            let (value, error) = match self.task.estimated[jump.course].positive {
                true => with_error(100.0 * jump.by.value, 100.0 * jump.by.deviation),
                false => {
                    let shown = |si: f64| self.shown_difference(jump.course, si);
                    with_error(shown(jump.by.value), shown(jump.by.deviation))
                }
            };
            format!("{value} ± {error}")
        };
        let unit = |jump: &InferredJump| match self.task.estimated[jump.course].positive {
            true => "%",
            false => self.difference_unit(jump.course),
        };
        TextTable::of(&self.found.jumps)
            .left("jump of", |jump| &*self.task.estimated[jump.course].name)
            .names()
            .right("between", |jump| duration(jump.between.0, 4))
            .right("and", |jump| duration(jump.between.1, 4))
            .right("by", by)
            .left("unit", unit)
            .into()
    }

    /// The unit of a difference of values of a signal.
    fn difference_unit(&self, j: usize) -> &str {
        let unit = &self.units[j];
        if unit.ty.absolute { difference(unit) } else { symbol(&unit.text) }
    }

    /// Mean of each signal, and its value at the end.
    pub(super) fn means(&self) -> TextTable {
        let all: Vec<usize> = (0..self.task.estimated.len()).collect();
        let course = |j: usize| &self.found.courses[j];
        let pair = |(value, error): (String, String)| {
            if error.is_empty() { value } else { format!("{value} ± {error}") }
        };
        TextTable::of(&all)
            .left("signal", |&j| &*self.task.estimated[j].name)
            .names()
            .right("mean", |&j| {
                course(j).mean.map_or(String::new(), |mean| pair(self.shown_with_error(j, mean)))
            })
            .optional()
            .right("at the end", |&j| pair(self.shown_with_error(j, self.at_end(j))))
            .right("if constant", |&j| pair(self.shown_with_error(j, course(j).still.0)))
            .left("unit", |&j| symbol(&self.units[j].text))
            .into()
    }

    /// A value of a signal and its error in its unit.
    pub(super) fn shown_with_error(&self, j: usize, known: Known) -> (String, String) {
        with_error(self.shown(j, known.value), self.shown_difference(j, known.deviation))
    }

    /// The last value, with the standard deviation that belongs to the width of its band.
    pub(super) fn at_end(&self, j: usize) -> Known {
        let band = &self.found.courses[j].band;
        let last = band[band.len() - 1];
        let half = 0.5 * (last.ends.1 - last.ends.0);
        Known { value: last.value, deviation: half / lptn_units::statistics::NORMAL_95 }
    }

    pub(super) fn sensor_name(&self, sensor: &InferredSensor) -> String {
        self.instrument((sensor.sensor, sensor.gain))
    }

    /// The name of an offset or a gain: `house.offset`.
    pub(super) fn instrument(&self, (sensor, gain): (usize, bool)) -> String {
        let what = if gain { "gain" } else { "offset" };
        format!("{}.{what}", self.task.sensors[sensor].name)
    }

    fn sensors(&self) -> TextTable {
        let before = |s: &InferredSensor| {
            let known = s.before;
            format!("{} ± {}", significant(known.value, 4), significant(known.deviation, 3))
        };
        let now = |s: &InferredSensor| with_error(s.now.value, s.now.deviation);
        TextTable::of(&self.found.sensors)
            .left("sensor", |s| self.sensor_name(s))
            .names()
            .right("value", move |s| now(s).0)
            .right("std. error", move |s| now(s).1)
            .left("unit", |s| if s.gain { "" } else { "K" })
            .left("known before", before)
            .into()
    }

    /// The parameters with a `±`, with their values before and after.
    pub(super) fn uncertain(&self) -> Vec<(String, lptn_units::Unit, Known, Known)> {
        let network = &self.input.netlist.network;
        let all = self.task.uncertain.iter().zip(&self.found.parameters);
        all.map(|(own, now)| {
            let (id, value) = (own.parameter, network.parameter_value(own.parameter));
            let name = network.parameters()[id.index()].name.clone();
            let before = Known { value, deviation: own.unit(value) };
            (name, self.input.unit_of(id), before, *now)
        })
        .collect()
    }

    fn parameters(&self) -> TextTable {
        type Row = (String, lptn_units::Unit, Known, Known);
        let shown = |unit: &lptn_units::Unit, known: Known| {
            with_error(unit.from_si(known.value), known.deviation / unit.scale)
        };
        let before = move |(_, unit, before, _): &Row| {
            let (value, error) = shown(unit, *before);
            format!("{value} ± {error}")
        };
        let all = self.uncertain();
        TextTable::of(&all)
            .left("parameter", |(name, ..)| name.clone())
            .names()
            .right("value", move |(_, unit, _, now)| shown(unit, *now).0)
            .right("std. error", move |(_, unit, _, now)| shown(unit, *now).1)
            .left("unit", |(_, unit, ..)| symbol(&unit.text))
            .left("known before", before)
            .into()
    }

    fn columns(&self) -> TextTable {
        let all: Vec<(&str, &InferredColumn)> = self
            .task
            .run
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .zip(&self.found.columns)
            .collect();
        TextTable::of(&all)
            .left("column", |(name, _)| *name)
            .names()
            .right("sigma [K]", |(_, c)| significant(c.sigma, 3))
            .right("slow [K]", |(_, c)| c.slow.map_or(String::new(), |s| significant(s.0, 3)))
            .optional()
            .right("over", |(_, c)| c.slow.map_or(String::new(), |s| duration(s.1, 2)))
            .optional()
            .right("values", |(_, c)| c.readings.to_string())
            .right("surprise rms", |(_, c)| significant(c.rms, 3))
            .right("mean", |(_, c)| fixed(c.mean, 3))
            .right("neighbours", |(_, c)| fixed(c.neighbours, 3))
            .into()
    }

    pub(super) fn notes(&self) -> Vec<(&'static str, String)> {
        let mut notes: Vec<(&'static str, String)> = Vec::new();
        for (j, estimated) in self.task.estimated.iter().enumerate() {
            notes.push(("smoothness", self.smoothness(j)));
            if estimated.intensity.is_none() {
                notes.push(("changes", self.changes(j)));
            }
        }
        let rounds = count(self.found.rounds, "round");
        notes.push(("method", format!("Kalman smoother near a run of the network, {rounds}")));
        notes
    }

    /// Text on the drift of a signal.
    fn smoothness(&self, j: usize) -> String {
        let (estimated, course) = (&self.task.estimated[j], &self.found.courses[j]);
        let shown = |coordinate: f64| match estimated.positive {
            true => format!("{} %", significant(100.0 * coordinate, 3)),
            false => {
                let value = significant(self.shown_difference(j, coordinate), 3);
                format!("{value} {}", self.difference_unit(j))
            }
        };
        let walk = (course.intensity * MINUTE).sqrt();
        let bend = (course.slope_intensity * MINUTE.powi(3) / 3.0).sqrt();
        let mut parts = Vec::new();
        if course.intensity > 0.0 {
            parts.push(format!("drifts by {} in 1 min", shown(walk)));
        }
        if course.slope_intensity > 0.0 {
            parts.push(format!("bends by {} in 1 min", shown(bend)));
        }
        let how = if estimated.intensity.is_some() { "as given" } else { "most likely" };
        match parts.is_empty() {
            true => format!("{} is constant, {how}", estimated.name),
            false => format!("{} {} (1 sigma, {how})", estimated.name, parts.join(" and ")),
        }
    }

    /// Text that says if the record shows a change.
    pub(super) fn changes(&self, j: usize) -> String {
        /// Twice the logarithm of a ratio of likelihoods that chance exceeds in 5 of 100 records,
        /// if nothing changes: half of them are 0 (S. G. Self, K.-Y. Liang, J. Am. Stat. Assoc. 82
        /// (1987) 605).
        const CHANCE: f64 = 2.706;
        let name = &self.task.estimated[j].name;
        let ratio = 2.0 * (self.found.log_likelihood - self.found.courses[j].still.1);
        let ratio_text = significant(ratio.max(0.0), 3);
        match ratio > CHANCE {
            true => format!("{name} changes (likelihood ratio {ratio_text}, chance reaches 2.71)"),
            false => format!(
                "the record does not show that {name} changes (likelihood ratio {ratio_text} of \
                 2.71)"
            ),
        }
    }

    pub(super) fn verdict(&self) -> String {
        if !self.is_whole() {
            return self.lacking();
        }
        let text = self.task.estimated.iter().enumerate().map(|(j, estimated)| {
            let (value, error) = self.shown_with_error(j, self.at_end(j));
            let unit = symbol(&self.units[j].text);
            format!("{} = {value} ± {error} {unit} at the end", estimated.name)
        });
        text.collect::<Vec<_>>().join("; ")
    }
}
