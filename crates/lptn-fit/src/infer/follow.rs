//! Rows as they come: what is known at each from all rows before it and itself.
//!
//! Nothing is kept but the state at the last row, so a record may go on forever. Each row is linear
//! near what was known at the one before it (extended Kalman filter).

use lptn_solve::Proceed;
use lptn_units::statistics::NORMAL_95;

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
    /// In s, behind the row before.
    pub time: f64,
    /// A value in K for each column; NaN where nothing was measured.
    pub values: Vec<f64>,
    /// A value in SI units for each signal that follows a column of the record.
    pub signals: Vec<f64>,
}

/// What is known at a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// In s.
    pub time: f64,
    /// Each course.
    pub courses: Vec<Band>,
    /// Temperature of each node in K.
    pub nodes: Vec<Known>,
    /// By how many standard deviations each column surprised; NaN where nothing was measured.
    pub surprises: Vec<f64>,
}

/// Follows a record row by row.
#[derive(Debug)]
pub struct Follower<'a> {
    /// What is sought, without rows.
    task: InferTask<'a>,
    waiting: Vec<Row>,
    now: Option<Now>,
}

/// What is known at the last row.
#[derive(Debug)]
struct Now {
    last: Row,
    /// Values at the last row, and what the network itself says.
    reference: Reference,
    own: Reference,
    begins: Begins,
    sizes: Vec<f64>,
    /// How the states stand to the reference.
    state: Gaussian,
}

impl<'a> Follower<'a> {
    /// With the strengths that the task says.
    ///
    /// # Errors
    /// [`InferError`] where it leaves open how much a course changes, or the noise of a column.
    pub fn new(task: InferTask<'a>) -> Result<Self, InferError> {
        checked(&task)?;
        if let Some(sought) = task.sought.iter().find(|sought| sought.intensity.is_none()) {
            return Err(InferError::Smoothness { signal: sought.name.clone() });
        }
        if let Some(sought) = task.sought.iter().find(|sought| sought.jumps) {
            return Err(InferError::Jumps { signal: sought.name.clone() });
        }
        if let Some(column) = task.run.columns.iter().find(|column| column.sigma.is_none()) {
            return Err(InferError::Noise { column: column.name.clone() });
        }
        Ok(Self { task, waiting: Vec::new(), now: None })
    }

    /// Takes a row in. Rows wait until there are two moments, and are answered together then.
    ///
    /// # Errors
    /// [`InferError`] where the network has no run or rates there.
    pub fn row(&mut self, row: Row) -> Result<Vec<Followed>, InferError> {
        let Some(now) = self.now.take() else { return self.begin(row) };
        let times = vec![now.last.time, row.time];
        let task = self.of_rows(&times, &[&now.last, &row]);
        let moments = Moments { times, before: 0 };
        let reference = now.reference.twice();
        let at = (&reference, &now.own);
        let model =
            Model::new(&task, (&moments, &now.begins), at, (&now.sizes, &|_| Proceed::Continue))?;
        let mut filter = Filter::new(now.state);
        let followed = step(&task, (&model, &reference), (&mut filter, 1), row.time);
        let (reference, state) = carried(&task, (&model, &reference), (&filter, &now.begins, 1));
        let Now { own, begins, sizes, .. } = now;
        self.now = Some(Now { last: row, reference, own, begins, sizes, state });
        Ok(vec![followed])
    }

    /// The first moments.
    fn begin(&mut self, row: Row) -> Result<Vec<Followed>, InferError> {
        self.waiting.push(row);
        let rows: Vec<&Row> = self.waiting.iter().collect();
        let times: Vec<f64> = rows.iter().map(|row| row.time).collect();
        let task = self.of_rows(&times, &rows);
        let moments = match Moments::of(&task) {
            Err(InferError::Short) => return Ok(Vec::new()),
            moments => moments?,
        };
        let (own, begins) = begun(&task, &moments)?;
        let observer = |_: lptn_solve::Progress| Proceed::Continue;
        let model = Model::new(&task, (&moments, &begins), (&own, &own), (&[], &observer))?;
        let mut filter = Filter::new(model.begin(&noises(&task)));
        let last = moments.times.len() - 1;
        let each = moments.times.iter().enumerate();
        let answers = each.map(|(k, time)| step(&task, (&model, &own), (&mut filter, k), *time));
        let answers: Vec<Followed> = answers.skip(moments.before).collect();
        let (reference, state) = carried(&task, (&model, &own), (&filter, &begins, last));
        let sizes = model.sizes;
        let Some(row) = self.waiting.pop() else { return Ok(answers) };
        self.now = Some(Now { last: row, reference, own, begins, sizes, state });
        Ok(answers)
    }

    /// The task of some rows: where a row was answered before, only its signals count.
    fn of_rows(&self, times: &[f64], rows: &[&Row]) -> InferTask<'a> {
        let mut task = self.task.clone();
        task.run.times = times.to_vec();
        for (i, column) in task.run.columns.iter_mut().enumerate() {
            column.values = rows.iter().map(|row| row.values[i]).collect();
            if self.now.is_some() {
                column.values[0] = f64::NAN;
            }
        }
        let start = task.run.settings.start;
        let first = if task.start == Start::Known { start.min(times[0]) } else { times[0] };
        let signals = task.run.signals.iter_mut().enumerate();
        signals.for_each(|(i, signal)| course(signal, i, (first, rows)));
        task
    }
}

/// What was read in the rows; the value of the first before them.
fn course(signal: &mut RecordedSignal, place: usize, (first, rows): (f64, &[&Row])) {
    let rows = rows.iter().filter(|row| !row.signals[place].is_nan());
    (signal.times, signal.values) = rows.map(|row| (row.time, row.signals[place])).unzip();
    if signal.times.first().is_some_and(|time| *time > first) {
        signal.times.insert(0, first);
        signal.values.insert(0, signal.values[0]);
    }
}

/// The noise that is said.
fn noises(task: &InferTask<'_>) -> Vec<Noise> {
    let said = |column: &MeasuredColumn| match (column.sigma.unwrap_or(1.0), task.drift) {
        (white, Drift::Known { deviation, time }) => Noise { white, drift: deviation, time },
        (white, Drift::Open) => Noise::white(white),
    };
    task.run.columns.iter().map(said).collect()
}

/// Goes on to a moment and takes its readings in.
fn step(
    task: &InferTask<'_>,
    (model, reference): (&Model, &Reference),
    (filter, k): (&mut Filter, usize),
    time: f64,
) -> Followed {
    let walks = task.sought.iter().flat_map(|sought| [sought.intensity.unwrap_or(0.0), 0.0]);
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
        let back = |x: f64| if task.sought[j].positive { x.exp() } else { x };
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
    }
}

/// What is known of a moment as the reference of the next, and how the states stand to it.
fn carried(
    task: &InferTask<'_>,
    (model, reference): (&Model, &Reference),
    (filter, begins, k): (&Filter, &Begins, usize),
) -> (Reference, Gaussian) {
    let states = &model.states;
    let Gaussian { mean, mut covariance } = filter.state().clone();
    let nodes = &model.reference[k];
    let temperature = |i: usize| -> f64 {
        let moved = model.nodes[k][i].iter().map(|(place, weight)| weight * mean[*place]);
        nodes[i] + moved.sum::<f64>()
    };
    let courses = coordinates(task, reference, k).into_iter().zip(&task.sought).enumerate();
    let courses = courses.map(|(j, (own, sought))| {
        let there = own + mean[states.course(j)];
        vec![if sought.positive { there.exp() } else { there }]
    });
    let next = Reference {
        courses: courses.collect(),
        parameters: (reference.parameters.iter().enumerate())
            .map(|(i, own)| own + task.uncertain[i].1 * mean[states.parameter(i)])
            .collect(),
        initial: begins.bodies.iter().map(|id| (*id, temperature(id.index()))).collect(),
        reads: (reference.reads.iter().enumerate())
            .map(|(r, own)| own + mean[states.read(r)])
            .collect(),
    };
    let mut moved = vec![0.0; mean.len()];
    for (column, _) in &states.slow {
        let Some(place) = states.shown(*column) else { continue };
        let of = task.run.columns[*column].nodes().iter();
        let there: f64 = of.map(|(id, factor)| factor * temperature(id.index())).sum();
        moved[place] = model.shown[*column][k] + mean[place] - there;
    }
    let drifts = states.drifts.iter().filter_map(|column| states.drift(*column));
    drifts.for_each(|place| moved[place] = mean[place]);
    // a body begins anew as its temperature; integrals begin at 0
    let size = |i: usize| match i {
        i if i < states.bodies => {
            let own = &model.nodes[k][begins.bodies[i].index()];
            own.iter().find(|(place, _)| *place == i).map_or(1.0, |(_, slope)| *slope)
        }
        i if (0..states.sought).any(|j| states.area(j) == i) => 0.0,
        _ => 1.0,
    };
    let count = mean.len();
    for i in 0..count {
        for j in 0..count {
            covariance[i * count + j] *= size(i) * size(j);
        }
    }
    (next, Gaussian { mean: moved, covariance })
}
