//! Readings of the instruments of one record in its run.
//!
//! A column that is not a sum of temperatures is an expression of results (`Measurand`). It is read
//! row by row from the run, with the evaluator of reports (`Solution::result`). Its derivative is a
//! difference in each row along the sensitivities of all temperatures
//! (`SensitiveRun::result_slope`). Nothing is integrated there, so it keeps eight digits and covers
//! every law, stream and zero-capacity node.

use lptn_analysis::RunAnalysis;
use lptn_network::{NodeId, ParameterId};
use lptn_solve::{Gradient, SensitiveRun};

use crate::network::lag::{Followed, follow, refined};
use crate::network::recorded::Held;
use crate::network::task::{Measurand, MeasuredColumn, MeasuredRun, NetworkFitTask};
use crate::network::unknown::{Unknown, UnknownOf};

/// The rows of a record that count, and those of its run.
pub(crate) struct Rows {
    /// Indices of the rows of the record.
    pub(crate) chosen: Vec<usize>,
    /// The times of the run's rows in s: the start first.
    times: Vec<f64>,
    /// Indices of the record's rows among them.
    places: Vec<usize>,
}

impl Rows {
    /// At most `most` rows of a record. If an instrument follows slowly, its run has more.
    pub(crate) fn new(task: &NetworkFitTask, run: &MeasuredRun, most: usize) -> Self {
        let chosen = chosen(run.times.len(), most);
        let mut times: Vec<f64> = chosen.iter().map(|&row| run.times[row]).collect();
        if times.first().is_some_and(|first| *first > run.settings.start()) {
            times.insert(0, run.settings.start());
        }
        let lags = run.columns.iter().filter_map(|column| Some(task.sensors[column.sensor?].lag));
        let least = lags.map(|lag| lag.value).filter(|lag| *lag > 0.0).fold(f64::NAN, f64::min);
        if !least.is_nan() {
            times = refined(&times, least);
        }
        let mut places = Vec::with_capacity(chosen.len());
        for &row in &chosen {
            let from = places.last().map_or(0, |place| place + 1);
            let ahead = times[from..].iter().position(|time| *time >= run.times[row]);
            places.push(from + ahead.unwrap_or(0));
        }
        Self { chosen, times, places }
    }

    /// The run that has these rows.
    pub(crate) fn settings(&self, run: &MeasuredRun, tolerance: f64) -> RunAnalysis {
        let (start, stop) = (run.settings.start(), self.times.last().copied());
        let stop = stop.unwrap_or(start);
        let between = self.times.iter().copied().filter(|&time| time > start && time < stop);
        let settings = run.settings.clone().lasting(start, stop).within(tolerance);
        settings.at(between.collect()).keeping(run.kept())
    }
}

/// At most `most` of `count` rows, at equal intervals, both ends included.
fn chosen(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| k * (count - 1) / (most - 1)).collect()
}

/// The residuals of one record, and their derivatives one unknown after the other.
pub(crate) struct Measure {
    pub(crate) modelled: Vec<f64>,
    pub(crate) residuals: Vec<f64>,
    pub(crate) jacobian: Vec<f64>,
    pub(crate) gradient: Gradient,
}

/// One record with the values of the unknowns.
pub(crate) struct Reader<'a> {
    pub(crate) task: &'a NetworkFitTask,
    /// Index of the record.
    pub(crate) run: usize,
    pub(crate) rows: &'a Rows,
    pub(crate) unknowns: &'a [Unknown],
    pub(crate) values: &'a [f64],
    /// Additional runs if values of instruments change the run itself.
    pub(crate) beside: &'a [Beside],
}

/// Runs with less and with more of an unknown.
pub(crate) struct Beside {
    /// Index of the unknown.
    pub(crate) unknown: usize,
    pub(crate) runs: [SensitiveRun; 2],
    /// Difference of the unknown between the two.
    pub(crate) distance: f64,
}

impl Reader<'_> {
    /// Compares the run with the record.
    pub(crate) fn measure(&self, found: &SensitiveRun) -> Measure {
        let run = &self.task.runs[self.run];
        let (modelled, residuals, jacobian) = (Vec::new(), Vec::new(), Vec::new());
        let mut measure = Measure { modelled, residuals, jacobian, gradient: found.gradient };
        // one column after the other, each with all unknowns
        let mut slopes: Vec<Vec<f64>> = vec![Vec::new(); self.unknowns.len()];
        for column in &run.columns {
            let held = self.held(column);
            let ideal = exposed(column, found);
            let zero = column.zero();
            let followed = self.followed(ideal.iter().map(|x| x - zero).collect(), held);
            let read = |y: &f64| zero + held.gain * y + held.offset;
            let model: Vec<f64> = self.picked(&followed.course).iter().map(read).collect();
            let rows = self.rows.chosen.iter().zip(&model);
            let rows = rows.filter(|(row, _)| !column.values[**row].is_nan());
            let missed = rows.map(|(&row, model)| (model - column.values[row]) / column.weight());
            measure.residuals.extend(missed);
            measure.modelled.extend_from_slice(&model);
            for (i, all) in slopes.iter_mut().enumerate() {
                let mut slope = self.slope((&self.unknowns[i], column), (held, &followed), found);
                if let Some(beside) = self.beside.iter().find(|beside| beside.unknown == i) {
                    let run = self.picked(&self.followed(beside.slopes(column), held).course);
                    slope.iter_mut().zip(run).for_each(|(own, run)| *own += held.gain * run);
                }
                let kept = self.rows.chosen.iter().zip(slope);
                let kept = kept.filter(|(row, _)| !column.values[**row].is_nan());
                all.extend(kept.map(|(_, slope)| slope / column.weight()));
            }
        }
        measure.jacobian = slopes.concat();
        measure
    }

    /// Derivative of the reading in the rows of the record by one unknown.
    fn slope(
        &self,
        (unknown, column): (&Unknown, &MeasuredColumn),
        (held, followed): (Held, &Followed),
        found: &SensitiveRun,
    ) -> Vec<f64> {
        let own = |sensor: usize| column.sensor == Some(sensor);
        let scaled = |values: &[f64], factor: f64| -> Vec<f64> {
            self.picked(values).iter().map(|value| factor * value).collect()
        };
        match unknown.of {
            UnknownOf::Parameter(id) => {
                scaled(&self.followed(slopes(column, id, found), held).course, held.gain)
            }
            UnknownOf::Offset { sensor, run }
                if own(sensor) && run.is_none_or(|run| run == self.run) =>
            {
                vec![1.0; self.rows.chosen.len()]
            }
            UnknownOf::Gain { sensor } if own(sensor) => scaled(&followed.course, 1.0),
            UnknownOf::Lag { sensor } if own(sensor) => scaled(&followed.by_lag, held.gain),
            _ => vec![0.0; self.rows.chosen.len()],
        }
    }

    fn held(&self, column: &MeasuredColumn) -> Held {
        self.task.held((column.sensor, self.run), (self.unknowns, self.values))
    }

    fn followed(&self, course: Vec<f64>, held: Held) -> Followed {
        // an unknown lag may become 0, and has a derivative there
        let has_lag = |unknown: &Unknown| matches!(unknown.of, UnknownOf::Lag { .. });
        match held.lag > 0.0 || self.unknowns.iter().any(has_lag) {
            true => follow(&self.rows.times, &course, held.lag),
            false => Followed { course, by_lag: Vec::new() },
        }
    }

    /// Values in the rows of the record.
    fn picked(&self, values: &[f64]) -> Vec<f64> {
        let at = |&place: &usize| values.get(place).copied().unwrap_or(f64::NAN);
        self.rows.places.iter().map(at).collect()
    }
}

impl Beside {
    /// Derivative of the quantity at a column's instrument by the unknown.
    fn slopes(&self, column: &MeasuredColumn) -> Vec<f64> {
        let [below, above] = self.runs.each_ref().map(|run| exposed(column, run));
        below.iter().zip(above).map(|(below, above)| (above - below) / self.distance).collect()
    }
}

/// Quantity at a column's instrument.
fn exposed(column: &MeasuredColumn, found: &SensitiveRun) -> Vec<f64> {
    match &column.of {
        Measurand::Temperatures(of) => combined(of, |node| found.solution.temperature(node)),
        Measurand::Result(value) => found.solution.result(value),
    }
}

/// Its derivative by a parameter.
fn slopes(column: &MeasuredColumn, id: ParameterId, found: &SensitiveRun) -> Vec<f64> {
    match &column.of {
        Measurand::Temperatures(of) => combined(of, |node| found.sensitivity(id, node)),
        Measurand::Result(value) => found.result_slope(id, value).unwrap_or_default(),
    }
}

/// The rows of a sum of temperatures, or of its derivative.
fn combined(of: &[(NodeId, f64)], of_node: impl Fn(NodeId) -> Option<Vec<f64>>) -> Vec<f64> {
    let mut sum: Vec<f64> = Vec::new();
    for &(node, factor) in of {
        let values = of_node(node).unwrap_or_default();
        sum.resize(values.len(), 0.0);
        sum.iter_mut().zip(&values).for_each(|(sum, value)| *sum += factor * value);
    }
    sum
}
