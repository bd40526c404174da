//! Estimates for rows as they come: each from this row and all rows before it.
//!
//! Only the state at the last row is kept, so a record may go on without end. Each row is linear
//! near the estimate of the row before (extended Kalman filter).

use lptn_solve::Proceed;
use lptn_units::statistics::NORMAL_95;

use crate::infer::carried::carried;
use crate::infer::error::InferError;
use crate::infer::inferred::{Band, Known};
use crate::infer::model::{Model, coordinates};
use crate::infer::prior::Begins;
use crate::infer::reference::{Moments, Reference};
use crate::infer::rounds::{begun, checked};
use crate::infer::strength::{Noise, Strength};
use crate::infer::task::{Drift, InferTask, Start};
use crate::kalman::{Filter, Gaussian};
use crate::network::{MeasuredColumn, RecordedSignal};

/// One row of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time in s, after that of the row before.
    pub time: f64,
    /// A value in K for each column; NaN if nothing was measured.
    pub values: Vec<f64>,
    /// A value in SI units for each signal that follows a column of the record. If it is NaN, the
    /// signal keeps the value before.
    pub signals: Vec<f64>,
}

/// A surprise above this number of standard deviations is not chance.
const BEYOND: f64 = 10.0;

/// Number of readings of a column in a row that may be left out. The next is believed: a jump.
const IN_A_ROW: usize = 3;

/// A reading far from its prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unexpected {
    /// Index of its column.
    pub column: usize,
    /// Value in K.
    pub value: f64,
    /// Surprise in standard deviations.
    pub surprise: f64,
    /// Number of such readings of its column in a row, including this one.
    pub in_a_row: usize,
    /// True if it was left out.
    pub left_out: bool,
}

/// Estimates at a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// Time in s.
    pub time: f64,
    /// Band of each time history.
    pub courses: Vec<Band>,
    /// Temperature of each node in K.
    pub nodes: Vec<Known>,
    /// Surprise of each column in standard deviations; NaN if nothing was measured.
    pub surprises: Vec<f64>,
    /// The readings with a surprise above 10 standard deviations.
    pub unexpected: Vec<Unexpected>,
}

/// Follows a record row by row.
#[derive(Debug)]
pub struct Follower {
    /// The task, without rows.
    task: InferTask,
    /// True if unexpected readings are left out.
    drops: bool,
    waiting: Vec<Row>,
    now: Option<Now>,
    /// Number of unexpected readings of each column that came last, in a row.
    in_a_row: Vec<usize>,
}

/// Estimates at the last row.
#[derive(Debug)]
struct Now {
    last: Row,
    /// Values at the last row, and those of the network itself.
    reference: Reference,
    own: Reference,
    begins: Begins,
    sizes: Vec<f64>,
    /// The states relative to the reference.
    state: Gaussian,
}

impl Follower {
    /// A follower with the strengths given in the task.
    ///
    /// # Errors
    /// [`InferError`] if the task leaves open how much a time history changes, or the noise of a
    /// column.
    pub fn new(task: InferTask) -> Result<Self, InferError> {
        checked(&task)?;
        if let Some(estimated) =
            task.estimated.iter().find(|estimated| estimated.intensity.is_none())
        {
            return Err(InferError::Smoothness { signal: estimated.name.clone() });
        }
        if let Some(estimated) = task.estimated.iter().find(|estimated| estimated.jumps) {
            return Err(InferError::Jumps { signal: estimated.name.clone() });
        }
        if let Some(column) = task.run.columns.iter().find(|column| column.sigma.is_none()) {
            return Err(InferError::Noise { column: column.name.clone() });
        }
        let in_a_row = vec![0; task.run.columns.len()];
        Ok(Self { task, drops: false, waiting: Vec::new(), now: None, in_a_row })
    }

    /// Leaves out up to three readings of a column in a row, each with a surprise above 10 standard
    /// deviations. The fourth is believed. In the first rows, which are answered together, nothing
    /// is left out: nothing is known of the time history before them.
    pub fn dropping(self) -> Self {
        Self { drops: true, ..self }
    }

    /// Takes a row in. Rows wait until there are two moments and a reading after the first. They
    /// are then answered together. Values that were not measured are left out.
    ///
    /// # Errors
    /// [`InferError`] if the network has no run or rates there, and [`InferError::Record`] for a
    /// row before the start of the run.
    pub fn row(&mut self, mut row: Row) -> Result<Vec<Followed>, InferError> {
        let before = self.now.as_ref().map(|now| &now.last).or(self.waiting.last());
        if let Some(before) = before {
            let held = row.signals.iter_mut().zip(&before.signals);
            held.filter(|(own, _)| own.is_nan()).for_each(|(own, before)| *own = *before);
        }
        let Some(now) = &self.now else { return self.begin(row) };
        let (mut taken, mut left) = (row.clone(), vec![f64::NAN; row.values.len()]);
        let (mut followed, now) = loop {
            let (followed, next) = self.go_on(now, &taken)?;
            let Some(column) = self.to_leave_out(&followed) else { break (followed, next) };
            left[column] = followed.surprises[column];
            taken.values[column] = f64::NAN;
        };
        self.now = Some(now);
        self.note(&row, &mut followed, &left);
        Ok(vec![followed])
    }

    /// Ends the record.
    ///
    /// # Errors
    /// [`InferError::Short`] if rows were taken in and none could be answered.
    pub fn end(self) -> Result<(), InferError> {
        if self.now.is_some() || self.waiting.is_empty() { Ok(()) } else { Err(InferError::Short) }
    }

    /// Steps from the last row to the next.
    fn go_on(&self, now: &Now, row: &Row) -> Result<(Followed, Now), InferError> {
        let times = vec![now.last.time, row.time];
        let task = self.of_rows(&times, &[&now.last, row]);
        let moments = Moments { times, before: 0 };
        let reference = now.reference.twice();
        let at = (&reference, &now.own);
        let model =
            Model::new(&task, (&moments, &now.begins), at, (&now.sizes, &|_| Proceed::Continue))?;
        let mut filter = Filter::new(now.state.clone());
        let followed = step(&task, (&model, &reference), (&mut filter, 1), row.time);
        let (reference, state) = carried(&task, (&model, &reference), (&filter, &now.begins, 1));
        let (own, begins, sizes) = (now.own.clone(), now.begins.clone(), now.sizes.clone());
        Ok((followed, Now { last: row.clone(), reference, own, begins, sizes, state }))
    }

    /// The first column with a reading to be left out.
    fn to_leave_out(&self, followed: &Followed) -> Option<usize> {
        let beyond = |i: &usize| followed.surprises[*i].abs() > BEYOND;
        let mut columns = (0..self.in_a_row.len()).filter(|i| self.in_a_row[*i] < IN_A_ROW);
        columns.find(beyond).filter(|_| self.drops)
    }

    /// Counts unexpected readings; `left` contains the surprises of those that were left out.
    fn note(&mut self, row: &Row, followed: &mut Followed, left: &[f64]) {
        for (column, count) in self.in_a_row.iter_mut().enumerate() {
            let left_out = !left[column].is_nan();
            if left_out {
                followed.surprises[column] = left[column];
            }
            let (value, surprise) = (row.values[column], followed.surprises[column]);
            if surprise.abs() > BEYOND {
                *count += 1;
                let told = Unexpected { column, value, surprise, in_a_row: *count, left_out };
                followed.unexpected.push(told);
            } else if !surprise.is_nan() {
                *count = 0;
            }
        }
    }

    /// Takes in one of the first rows.
    fn begin(&mut self, row: Row) -> Result<Vec<Followed>, InferError> {
        self.waiting.push(row);
        let Some((mut answers, now)) = self.first(&self.waiting)? else { return Ok(Vec::new()) };
        self.now = Some(now);
        let left = vec![f64::NAN; self.in_a_row.len()];
        for (row, followed) in std::mem::take(&mut self.waiting).iter().zip(&mut answers) {
            self.note(row, followed, &left);
        }
        Ok(answers)
    }

    /// Answers the first rows; `None` if more rows are needed.
    fn first(&self, rows: &[Row]) -> Result<Option<(Vec<Followed>, Now)>, InferError> {
        let Some(last) = rows.last() else { return Ok(None) };
        let all: Vec<&Row> = rows.iter().collect();
        let times: Vec<f64> = rows.iter().map(|row| row.time).collect();
        let task = self.of_rows(&times, &all);
        let moments = match Moments::of(&task) {
            Err(InferError::Short) => return Ok(None),
            moments => moments?,
        };
        let behind = &rows[1 - moments.before..];
        let read = |i: usize| behind.iter().any(|row| !row.values[i].is_nan());
        let columns = last.values.len();
        let followed = |i: usize| !last.signals[i].is_nan();
        if !(0..columns).any(read) || !(0..last.signals.len()).all(followed) {
            return Ok(None);
        }
        let (own, begins) = begun(&task, &moments)?;
        let model =
            Model::new(&task, (&moments, &begins), (&own, &own), (&[], &|_| Proceed::Continue));
        let model = match model {
            // the column that feels it may have gaps still
            Err(InferError::Unfelt { .. }) if !(0..columns).all(read) => return Ok(None),
            model => model?,
        };
        let mut filter = Filter::new(model.begin(&noises(&task)));
        let each = moments.times.iter().enumerate();
        let answers = each.map(|(k, time)| step(&task, (&model, &own), (&mut filter, k), *time));
        let answers: Vec<Followed> = answers.collect();
        let end = (&filter, &begins, answers.len() - 1);
        let (reference, state) = carried(&task, (&model, &own), end);
        let (last, sizes) = (last.clone(), model.sizes);
        let now = Now { last, reference, own, begins, sizes, state };
        Ok(Some((answers.into_iter().skip(moments.before).collect(), now)))
    }

    /// The task of some rows. If a row was answered before, only its signals count.
    fn of_rows(&self, times: &[f64], rows: &[&Row]) -> InferTask {
        let mut task = self.task.clone();
        task.run.times = times.to_vec();
        for (i, column) in task.run.columns.iter_mut().enumerate() {
            column.values = rows.iter().map(|row| row.values[i]).collect();
            if self.now.is_some() {
                column.values[0] = f64::NAN;
            }
        }
        let start = task.run.settings.start();
        let first = if task.start == Start::Known { start.min(times[0]) } else { times[0] };
        let signals = task.run.signals.iter_mut().enumerate();
        signals.for_each(|(i, signal)| course(signal, i, (first, rows)));
        task
    }
}

/// Sets a signal to the values of the rows, and to the first of them before.
fn course(signal: &mut RecordedSignal, place: usize, (first, rows): (f64, &[&Row])) {
    let rows = rows.iter().filter(|row| !row.signals[place].is_nan());
    (signal.times, signal.values) = rows.map(|row| (row.time, row.signals[place])).unzip();
    if signal.times.first().is_some_and(|time| *time > first) {
        signal.times.insert(0, first);
        signal.values.insert(0, signal.values[0]);
    }
}

/// The given noise of each column.
fn noises(task: &InferTask) -> Vec<Noise> {
    let said = |column: &MeasuredColumn| match (column.sigma.unwrap_or(1.0), task.drift) {
        (white, Drift::Known { deviation, time }) => Noise { white, drift: deviation, time },
        (white, Drift::Open) => Noise::white(white),
    };
    task.run.columns.iter().map(said).collect()
}

/// Advances a filter to a moment and takes its readings in.
fn step(
    task: &InferTask,
    (model, reference): (&Model, &Reference),
    (filter, k): (&mut Filter, usize),
    time: f64,
) -> Followed {
    let walks =
        task.estimated.iter().flat_map(|estimated| [estimated.intensity.unwrap_or(0.0), 0.0]);
    let strength =
        Strength { intensities: walks.collect(), noises: noises(task), jumps: Vec::new() };
    let mut surprises = vec![f64::NAN; strength.noises.len()];
    for (column, innovation) in model.advance(filter, k, &strength) {
        surprises[column] = innovation.residual / innovation.variance.sqrt();
    }
    let state = filter.state();
    let own = coordinates(task, reference, k);
    let band = |(j, own): (usize, &f64)| {
        let (moved, deviation) = state.of(&[(model.states.course(j), 1.0)]);
        let (value, half) = (own + moved, NORMAL_95 * deviation);
        let back = |x: f64| if task.estimated[j].positive { x.exp() } else { x };
        Band { value: back(value), ends: (back(value - half), back(value + half)) }
    };
    let node = |i: usize| {
        let (moved, deviation) = state.of(model.weights(k, i));
        Known { value: model.reference[k][i] + moved, deviation }
    };
    Followed {
        time,
        courses: own.iter().enumerate().map(band).collect(),
        nodes: (0..model.reference[k].len()).map(node).collect(),
        surprises,
        unexpected: Vec::new(),
    }
}
