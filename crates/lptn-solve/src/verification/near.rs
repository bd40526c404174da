//! A network near one of its states, against the exact solution of the linear network that
//! represents it there.
//!
//! The full network, less the heat that it stores at the state anyway, is compared with modes for
//! disturbances of three sizes. The check is that the difference falls with the size, not that it
//! is small.

use lptn_assembly::ThermalSystem;
use lptn_integrate::Options;
use lptn_integrate::dense::Complex;

use super::disturbed::Disturbed;
use super::error::NearError;
use super::{LEAST_TOLERANCE, allowed_error};
use crate::error::TransientError;
use crate::exact::Difference;
use crate::linearised::{Linearised, SIZES, Tried, falls};
use crate::modes::{Shapes, shapes};
use crate::snapshot::Snapshot;

/// The size of a disturbance over the tolerance of its runs.
const TOLERANCE: f64 = 1e6;

/// Moments that are compared, in equal ratios over four decades.
const MOMENTS: usize = 61;

/// Time constants of the slowest mode that a comparison lasts.
const LONG: f64 = 5.0;

/// Start of a disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DisturbanceShape {
    /// Every node with capacity is warmer by the same temperature.
    Even,
    /// Nodes with capacity are warmer and colder in turn, in the order of the file.
    InTurn,
}

/// Runs from a disturbed state, to both sides, and the linear network.
#[derive(Clone, Debug)]
pub struct Disturbance {
    /// The shape of its start.
    pub shape: DisturbanceShape,
    /// Its size in K.
    pub size: f64,
    /// Largest difference of the full network from the linear one; times in s from the disturbance
    /// on.
    pub difference: Difference,
    /// Allowed error of the runs themselves, in K: [`allowed_error`].
    pub allowed: f64,
}

impl Disturbance {
    /// The difference over the size.
    pub fn share(&self) -> f64 {
        self.difference.largest / self.size
    }
}

/// Comparison of the linear network near a state with the full one.
#[derive(Clone, Debug)]
pub struct NearState {
    /// Compared time in s: five time constants of the slowest mode, or until one that grows has
    /// grown by `e`.
    pub span: f64,
    /// Number of modes.
    pub modes: usize,
    /// Results of both shapes, the largest disturbance first.
    pub disturbances: Vec<Disturbance>,
    /// The missed heat of a disturbance along the slowest mode; `None` if the network is linear
    /// itself.
    pub tried: Option<Tried>,
}

impl NearState {
    /// Disturbs `state`, follows the full network with inputs and switches fixed as they are there
    /// and without the heat that it already stores there, and compares every node with `C dx/dt = J
    /// x`, solved by its modes.
    ///
    /// # Errors
    /// [`NearError`]; more than 2000 nodes with capacity are refused.
    pub fn of(system: &ThermalSystem, state: &Snapshot) -> Result<Self, NearError> {
        let mut linear = Linearised::near(system, state)?;
        let shapes = shapes(&linear)?;
        let moments = moments(&shapes.rates);
        let coldest = state.temperatures.iter().fold(f64::INFINITY, |least: f64, t| least.min(*t));
        let mut disturbances = Vec::new();
        let ways = match system.states().len() {
            0 => &[][..],
            1 => &[DisturbanceShape::Even],
            _ => &[DisturbanceShape::Even, DisturbanceShape::InTurn],
        };
        for &shape in ways {
            for size in SIZES {
                // less if the network is colder than twice the largest
                let size = size.min(0.5 * coldest * size / SIZES[0]);
                let beside = Beside { system, state, shapes: &shapes, moments: &moments };
                disturbances.push(beside.disturb(shape, size)?);
            }
        }
        let slowest = shapes.slowest();
        let tried = match slowest.is_empty() {
            true => None,
            false => linear.tried_along(&slowest)?,
        };
        let span = moments.last().copied().unwrap_or(0.0);
        Ok(Self { span, modes: shapes.rates.len(), disturbances, tried })
    }

    /// True if every node is within the error of runs, as that of a linear network is.
    pub fn is_linear(&self) -> bool {
        self.disturbances.iter().all(|d| d.difference.largest <= d.allowed)
    }

    /// The disturbance whose differences do not shrink as they must if heat flows have slopes: ten
    /// times less of the size for a tenth of it, at least five times, or within the error of runs.
    pub fn failing(&self) -> Option<&Disturbance> {
        let of_shape = self.disturbances.chunks(SIZES.len());
        let small = of_shape.filter_map(|sizes| Some((sizes.get(1)?, sizes.get(2)?)));
        let mut failing = small.filter(|(medium, small)| {
            let falls = falls(medium.share(), small.share());
            let within = small.difference.largest <= small.allowed;
            !(falls || within)
        });
        failing.next().map(|(_, small)| small)
    }
}

/// Times from the disturbance on in s.
fn moments(rates: &[Complex]) -> Vec<f64> {
    let grows = rates.iter().map(|rate| -rate.re).fold(0.0, f64::max);
    let lasts = |rate: &&Complex| rate.re > 0.0;
    let slowest = rates.iter().filter(lasts).map(|rate| rate.re).fold(f64::INFINITY, f64::min);
    let span = match grows {
        grows if grows > 0.0 => grows.recip(),
        _ if slowest.is_finite() => LONG / slowest,
        _ => 1.0,
    };
    let decades = |k: usize| 4.0 * (k as f64 / (MOMENTS - 1) as f64 - 1.0);
    (0..MOMENTS).map(|k| span * 10f64.powf(decades(k))).collect()
}

/// A state, and the response of the linear network at some times after a disturbance of it.
struct Beside<'a> {
    system: &'a ThermalSystem,
    state: &'a Snapshot,
    shapes: &'a Shapes,
    moments: &'a [f64],
}

impl Beside<'_> {
    fn disturb(&self, shape: DisturbanceShape, size: f64) -> Result<Disturbance, NearError> {
        let states = self.system.states().len();
        let sign =
            |i: usize| if shape == DisturbanceShape::InTurn && i % 2 == 1 { -1.0 } else { 1.0 };
        let start: Vec<f64> = (0..states).map(|i| size * sign(i)).collect();
        let linear = self.linear(&start);
        let tolerance = (size / TOLERANCE).max(LEAST_TOLERANCE);
        let nodes = self.state.temperatures.len();
        let mut difference = Difference::unseen(self.system.states()[0], 0.0, nodes);
        for side in [1.0, -1.0] {
            let start: Vec<f64> = start.iter().map(|x| side * x).collect();
            let run = self.run(&start, tolerance)?;
            for ((run, linear), &time) in run.iter().zip(&linear).zip(self.moments) {
                let nodes = self.system.network().node_ids().zip(run.iter().zip(linear));
                nodes.for_each(|(id, (full, linear))| {
                    difference.see((id.index(), id), time, (full - side * linear).abs());
                });
            }
        }
        Ok(Disturbance { shape, size, difference, allowed: allowed_error(tolerance) })
    }

    /// Rises of all nodes over the state in K, moment by moment.
    fn linear(&self, start: &[f64]) -> Vec<Vec<f64>> {
        let Shapes { rates, right, left } = self.shapes;
        let amplitude =
            |of: &Vec<Complex>| -> Complex { of.iter().zip(start).map(|(y, x)| y * x).sum() };
        let amplitudes: Vec<Complex> = left.iter().map(amplitude).collect();
        let at = |&time: &f64| {
            let mut row = vec![0.0; self.state.temperatures.len()];
            for ((rate, shape), amplitude) in rates.iter().zip(right).zip(&amplitudes) {
                let now = amplitude * (-rate * time).exp();
                row.iter_mut().zip(shape).for_each(|(row, x)| *row += (now * x).re);
            }
            row
        };
        self.moments.iter().map(at).collect()
    }

    /// The same of the full network.
    fn run(&self, start: &[f64], tolerance: f64) -> Result<Vec<Vec<f64>>, NearError> {
        let (disturbed, mut state) = Disturbed::new(self.system, self.state, start)?;
        let options = Options { tolerance, ..Options::default() };
        let mut integrator =
            crate::stepper::cvodes(disturbed, (0.0, &state), &options).map_err(NearError::Run)?;
        let mut rows = Vec::new();
        integrator.set_stop(self.moments.last().copied().unwrap_or(0.0));
        while rows.len() < self.moments.len() {
            let failed = |error| NearError::Run(TransientError::Integrator(error));
            let step = integrator.step().map_err(failed)?;
            while self.moments.get(rows.len()).is_some_and(|time| *time <= step.to) {
                let time = self.moments[rows.len()];
                integrator.interpolate(time, &mut state).map_err(failed)?;
                rows.push(integrator.system_mut().rises(&state)?);
            }
        }
        Ok(rows)
    }
}
