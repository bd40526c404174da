//! Limits over a run: the least margin, and when a limit is first broken.
//!
//! A limit may be any expression of temperatures, so it is looked at in rows: first in [`ROWS`] equal steps and on
//! both sides of every jump of the inputs, then once more in [`FINE`] steps around the least margin and where the
//! margin changes its sign. The rows do not change the steps of the integrator, so both runs are the same run.

use lptn_assembly::ThermalSystem;
use lptn_netlist::RunSettings;
use lptn_network::{Evaluation, InputError, Network, NodeId, Severity, slot};
use lptn_solve::{OutputTimes, Solution, SteadyState, Transient};
use lptn_units::{Dimension, Type};

use crate::compare::candidate::CompareError;

/// Steps of the first look.
const ROWS: usize = 600;

/// Steps of the second look at each of the two or three intervals that matter.
const FINE: usize = 200;

/// How far before a jump it is looked at, as a share of the run.
const BEFORE: f64 = 1e-9;

/// What became of a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitResult {
    /// Its name.
    pub name: String,
    /// Type of the margin; a difference for temperatures.
    pub ty: Type,
    /// What it means if it is broken.
    pub severity: Severity,
    /// The least margin, in SI units: positive while the limit is kept.
    pub margin: f64,
    /// Time from the start of the run in s at which it is first broken; `None` if it is kept, or was looked at in
    /// steady state only.
    pub breaks_after: Option<f64>,
}

impl LimitResult {
    /// Whether it is broken.
    pub fn broken(&self) -> bool {
        self.margin < 0.0
    }

    /// Whether its margin is a temperature difference.
    pub fn is_temperature(&self) -> bool {
        self.ty == Type::of(Dimension::TEMPERATURE)
    }
}

/// A margin over time: ascending times in s, margins in SI units.
type Curve = Vec<(f64, f64)>;

/// The nodes that limits read, ascending.
pub(crate) fn nodes(network: &Network) -> Vec<NodeId> {
    let first = slot::PARAMETERS as usize + network.parameters().len();
    let slots = network.limits().iter().flat_map(|limit| limit.of.slots());
    let mut read: Vec<usize> = slots.filter_map(|slot| (slot as usize).checked_sub(first)).collect();
    read.sort_unstable();
    read.dedup();
    network.node_ids().filter(|id| read.binary_search(&id.index()).is_ok()).collect()
}

/// The rows of the first look.
pub(crate) fn rows(network: &Network, run: &RunSettings) -> Result<Vec<f64>, InputError> {
    let (start, stop) = (run.start, run.stop);
    if network.limits().is_empty() {
        return Ok(vec![start, stop]);
    }
    let mut rows = even((start, stop), ROWS);
    for jump in network.breakpoints(start, stop)? {
        rows.extend([jump - BEFORE * (stop - start), jump]);
    }
    Ok(ascending(rows))
}

fn even((from, to): (f64, f64), steps: usize) -> Vec<f64> {
    (0..=steps)
        .map(|i| if i == steps { to } else { from + (to - from) * (i as f64 / steps as f64) })
        .collect()
}

fn ascending(mut times: Vec<f64>) -> Vec<f64> {
    times.sort_unstable_by(f64::total_cmp);
    times.dedup();
    times
}

/// The limits in steady state, with inputs as they are at time 0.
pub(crate) fn in_steady_state(
    network: &Network,
    steady: &SteadyState,
) -> Result<Vec<LimitResult>, InputError> {
    let mut scope = network.evaluation();
    scope.set_temperatures(&steady.temperatures, &steady.boundary_temperatures);
    let ids = network.limit_ids().zip(network.limits());
    ids.map(|(id, limit)| {
        let margin = network.limit_margin(id, &mut scope)?;
        let (name, ty) = (limit.name.clone(), limit.margin_type());
        Ok(LimitResult { name, ty, severity: limit.severity, margin, breaks_after: None })
    })
    .collect()
}

/// The limits over a run whose first look is `solution`.
pub(crate) fn over_time(
    system: &ThermalSystem,
    transient: &Transient,
    solution: &Solution,
) -> Result<Vec<LimitResult>, CompareError> {
    let network = system.network();
    if network.limits().is_empty() {
        return Ok(Vec::new());
    }
    let coarse = curves(solution).map_err(CompareError::Input)?;
    let fine =
        Transient { output: OutputTimes::At(fine_rows(&coarse)), watch: Vec::new(), ..transient.clone() };
    let solution = fine.solve(system).map_err(|error| CompareError::Run(Box::new(error)))?;
    let fine = curves(&solution).map_err(CompareError::Input)?;
    let results = network.limits().iter().zip(&fine).map(|(limit, curve)| LimitResult {
        name: limit.name.clone(),
        ty: limit.margin_type(),
        severity: limit.severity,
        margin: curve.iter().map(|point| point.1).fold(f64::INFINITY, f64::min),
        breaks_after: first_broken(curve).map(|time| time - transient.start),
    });
    Ok(results.collect())
}

/// The margin of every limit at every row.
fn curves(solution: &Solution) -> Result<Vec<Curve>, InputError> {
    let network = solution.network();
    let mut scope = network.evaluation();
    let boundaries: Vec<Vec<f64>> =
        network.boundary_ids().map(|id| solution.boundary_temperature(id)).collect();
    // nodes that were not recorded are not read
    let mut nodes = vec![f64::NAN; network.nodes().len()];
    let mut curves = vec![Curve::with_capacity(solution.times().len()); network.limits().len()];
    for (row, &time) in solution.times().iter().enumerate() {
        for (id, &temperature) in solution.recorded().iter().zip(solution.row(row)) {
            nodes[id.index()] = temperature;
        }
        let at_row: Vec<f64> = boundaries.iter().map(|column| column[row]).collect();
        scope.set_time(time, time);
        scope.set_temperatures(&nodes, &at_row);
        margins(network, &mut scope, time, &mut curves)?;
    }
    Ok(curves)
}

fn margins(
    network: &Network,
    scope: &mut Evaluation,
    time: f64,
    curves: &mut [Curve],
) -> Result<(), InputError> {
    for (id, curve) in network.limit_ids().zip(curves) {
        curve.push((time, network.limit_margin(id, scope)?));
    }
    Ok(())
}

/// The rows of the second look: those of the first, and fine ones where something happens.
fn fine_rows(curves: &[Curve]) -> Vec<f64> {
    let mut rows: Vec<f64> = curves.first().into_iter().flatten().map(|point| point.0).collect();
    for curve in curves {
        let last = curve.len() - 1;
        let least = (0..=last).min_by(|&a, &b| curve[a].1.total_cmp(&curve[b].1)).unwrap_or(0);
        let broken = curve.iter().position(|point| point.1 < 0.0);
        let mut intervals = vec![(least.saturating_sub(1), least), (least, (least + 1).min(last))];
        intervals.extend(broken.map(|at| (at.saturating_sub(1), at)));
        for (a, b) in intervals.into_iter().filter(|(a, b)| a < b) {
            rows.extend(even((curve[a].0, curve[b].0), FINE));
        }
    }
    ascending(rows)
}

/// When a margin first becomes negative, by linear interpolation between rows.
fn first_broken(curve: &Curve) -> Option<f64> {
    let at = curve.iter().position(|point| point.1 < 0.0)?;
    let (time, after) = curve[at];
    let Some(&(earlier, before)) = at.checked_sub(1).and_then(|i| curve.get(i)) else { return Some(time) };
    Some(earlier + (time - earlier) * (before / (before - after)))
}
