//! What lptn says to each expected value of a case.

use std::cell::OnceCell;

use lptn::prelude::*;
use lptn_analysis::RunAnalysis;
use lptn_fit::network::NetworkFit;
use lptn_network::{BoundaryId, ConductorId, End, NodeId};
use lptn_reduce::{Bias, ExponentialFit, NortonEquivalent, fit_exponential, transfer_resistance};
use lptn_solve::{Complex, Drive, FrequencyResponse, Linearised, Mode, Modes, Uncertified};

use super::calibration;
use super::case::Case;
use super::expected::{Direction, Expected, Fit, Frequency, Moment, Quantity, Side};
use super::gate;
use super::mean::Means;
use super::network::Model;
use super::size;

/// Why there is no answer.
#[derive(Clone, Debug)]
pub struct Trouble(pub String);

impl<E: std::fmt::Display> From<E> for Trouble {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

/// A case at work. What several values need is computed once.
pub struct Laboratory<'a> {
    pub case: &'a Case,
    pub json: &'a serde_json::Value,
    model: Model,
    steady: OnceCell<Result<SteadyState, Trouble>>,
    run: OnceCell<Result<Solution, Trouble>>,
    steady_bounds: OnceCell<Result<Result<Vec<f64>, Uncertified>, Trouble>>,
    means: OnceCell<Means>,
    fit: OnceCell<Result<NetworkFit, Trouble>>,
}

impl<'a> Laboratory<'a> {
    pub fn new(case: &'a Case, json: &'a serde_json::Value) -> Result<Self, Trouble> {
        Ok(Self::of(case, json, Model::new(case)?))
    }

    /// The case at work on a network from elsewhere.
    pub fn of(case: &'a Case, json: &'a serde_json::Value, model: Model) -> Self {
        let (steady, run, means) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        let (fit, steady_bounds) = (OnceCell::new(), OnceCell::new());
        Self { case, json, model, steady, run, steady_bounds, means, fit }
    }

    pub fn system(&self) -> &ThermalSystem {
        &self.model.system
    }

    /// The value that lptn finds.
    pub fn answer(&self, expected: &Expected) -> Result<f64, Trouble> {
        match &expected.quantity {
            Quantity::T { node, minus, combine, t, side } => {
                let terms = terms(node.as_deref(), minus.as_deref(), combine.as_ref())?;
                self.temperature(&terms, (*t, *side), expected)
            }
            Quantity::EdgeHeat { edge, t, side } => self.edge_heat(edge, (*t, *side)),
            Quantity::BoundaryHeat { node, t, side } => self.boundary_heat(node, (*t, *side)),
            Quantity::MeanTemperature { .. } | Quantity::MeanBoundaryHeat { .. } => {
                self.means.get_or_init(|| Means::new(self.case)).answer(self, expected)
            }
            Quantity::Crossing { node, level, t_end, after, direction } => {
                let end = t_end.unwrap_or(0.0).max(self.end());
                self.crossing(node, level + self.case.zero(), (*after, end), *direction)
            }
            Quantity::TimeConstant { index, skip_zero } => Ok(self.mode(*index, *skip_zero)?.tau()),
            Quantity::ModeRatio { index, node, over } => {
                let shape = self.mode(*index, false)?.shape;
                Ok(shape[self.node(node)?.index()] / shape[self.node(over)?.index()])
            }
            Quantity::PortResistance { node } => self.resistance(node, node),
            Quantity::TransferResistance { node, source_node } => {
                self.resistance(source_node, node)
            }
            Quantity::TotalCapacity {} => {
                let network = self.system().network();
                Ok(network.node_ids().map(|id| network.capacity(id)).sum())
            }
            Quantity::FitInitial(fit) => Ok(self.fit(fit)?.initial - self.case.zero()),
            Quantity::FitSettled(fit) => Ok(self.fit(fit)?.settled - self.case.zero()),
            Quantity::FitTau(fit) => Ok(self.fit(fit)?.tau),
            Quantity::FitRms(fit) => Ok(self.fit(fit)?.rms),
            Quantity::Size { .. } => size::answer(self, &expected.quantity),
            Quantity::FrequencyGain(frequency) => Ok(self.swing(frequency)?.norm()),
            Quantity::FrequencyPhase(frequency) => Ok(self.swing(frequency)?.arg()),
            Quantity::GateFirstSwitch { .. }
            | Quantity::GateOnTime { .. }
            | Quantity::GatePeriod { .. } => gate::answer(self.whole_run()?, &expected.quantity),
            Quantity::Calibrated { param } => {
                calibration::value(self.case, self.calibrated()?, param)
            }
            Quantity::CalibrationRms {} => Ok(self.calibrated()?.rms),
        }
    }

    /// How a node answers a heat or a boundary that swings.
    fn swing(&self, of: &Frequency) -> Result<Complex, Trouble> {
        let drive = match (&of.input_source, &of.input_boundary) {
            (Some(node), None) => Drive::Node(self.node(node)?),
            (None, Some(boundary)) => Drive::Boundary(self.boundary(boundary)?),
            _ => return Err("one of input_source and input_boundary is wanted".to_owned().into()),
        };
        let node = self.node(&of.node)?;
        let linear = Linearised::of_proportional(self.system())?;
        Ok(FrequencyResponse::new(&linear, drive)?.at(of.omega)?[node.index()])
    }

    pub fn end_named(&self, id: &str) -> Result<End, Trouble> {
        self.model.ends.get(id).copied().ok_or_else(|| format!("there is no node `{id}`").into())
    }

    fn node(&self, id: &str) -> Result<NodeId, Trouble> {
        match self.end_named(id)? {
            End::Node(node) => Ok(node),
            End::Boundary(_) => Err(format!("`{id}` is a boundary").into()),
        }
    }

    pub fn boundary(&self, id: &str) -> Result<BoundaryId, Trouble> {
        match self.end_named(id)? {
            End::Boundary(boundary) => Ok(boundary),
            End::Node(_) => Err(format!("`{id}` is not a boundary").into()),
        }
    }

    fn edge(&self, id: &str) -> Result<ConductorId, Trouble> {
        self.model.edges.get(id).copied().ok_or_else(|| format!("there is no edge `{id}`").into())
    }

    /// The latest time that any value asks for, in s.
    fn end(&self) -> f64 {
        self.case
            .expected
            .iter()
            .map(Expected::latest)
            .fold(self.case.t_end.unwrap_or(0.0), f64::max)
    }

    fn calibrated(&self) -> Result<&NetworkFit, Trouble> {
        self.fit.get_or_init(|| calibration::fit(self.case)).as_ref().map_err(Trouble::clone)
    }

    pub fn steady(&self) -> Result<&SteadyState, Trouble> {
        let solve = || SteadyState::solve(self.system(), 0.0).map_err(Trouble::from);
        self.steady.get_or_init(solve).as_ref().map_err(Trouble::clone)
    }

    /// Proven errors of the steady state in K, or why there are none.
    pub fn steady_bounds(&self) -> Result<&Result<Vec<f64>, Uncertified>, Trouble> {
        let prove = || Ok(self.steady()?.proven_errors(self.system()));
        self.steady_bounds.get_or_init(prove).as_ref().map_err(Trouble::clone)
    }

    /// A run from 0 with a row at each of these times; it ends at the last of them.
    pub fn run_at(&self, times: Vec<f64>) -> Result<Solution, Trouble> {
        self.run_with(times, false)
    }

    fn run_with(&self, mut times: Vec<f64>, certify: bool) -> Result<Solution, Trouble> {
        times.retain(|t| *t > 0.0);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let Some(stop) = times.last() else { return Err("a run without length".into()) };
        let run = Transient::until(Time(*stop)).at(&times).tolerance(self.case.tolerance());
        Ok(Transient { certify, ..run }.solve(self.system())?)
    }

    /// The run that has a row at every time at which a value is expected, with proven errors.
    pub fn whole_run(&self) -> Result<&Solution, Trouble> {
        let solve = || {
            let moments =
                self.case.expected.iter().filter_map(|expected| match expected.quantity {
                    Quantity::T { t: Moment::At(t), .. }
                    | Quantity::EdgeHeat { t: Moment::At(t), .. }
                    | Quantity::BoundaryHeat { t: Moment::At(t), .. } => Some(t),
                    _ => None,
                });
            self.run_with(moments.chain([self.end()]).collect(), true)
        };
        self.run.get_or_init(solve).as_ref().map_err(Trouble::clone)
    }

    /// Reads from the row at `t`. At a jump a row holds what is after it, but for the last row of a
    /// run, which holds what is before it.
    fn read<T>(
        &self,
        (t, side): (f64, Side),
        steady_over_jumps: bool,
        value: impl Fn(&Solution, usize) -> Option<T>,
    ) -> Result<T, Trouble> {
        let jumps = !steady_over_jumps && t > 0.0 && !self.case.breaks(t, t).is_empty();
        let value = |solution: &Solution| {
            let row =
                solution.times().iter().position(|time| time.to_bits() == (t + 0.0).to_bits());
            row.and_then(|row| value(solution, row))
                .ok_or_else(|| format!("no value at {t} s").into())
        };
        match side {
            Side::Left if jumps => value(&self.run_at(vec![t])?),
            // a run that goes on, so that the row is not its last
            Side::Right if jumps => value(&self.run_at(vec![t, t * (1.0 + 1e-6)])?),
            _ => value(self.whole_run()?),
        }
    }

    fn temperature(
        &self,
        terms: &[(&str, f64)],
        (moment, side): (Moment, Side),
        expected: &Expected,
    ) -> Result<f64, Trouble> {
        let mut sum = 0.0;
        for (id, factor) in terms {
            let end = self.end_named(id)?;
            let kelvin = match moment {
                Moment::Steady => self.steady_temperature(end, expected)?,
                Moment::At(t) => {
                    let steady = matches!(end, End::Node(node) if !self.is_massless(node));
                    self.read((t, side), steady, |solution, row| temperature(solution, end, row))?
                }
            };
            sum += factor * (kelvin - self.case.zero());
        }
        Ok(sum)
    }

    fn is_massless(&self, node: NodeId) -> bool {
        self.system().network().nodes()[node.index()].massless
    }

    fn steady_temperature(&self, end: End, expected: &Expected) -> Result<f64, Trouble> {
        let steady = self.steady()?;
        let node = match end {
            End::Boundary(boundary) => return Ok(steady.boundary_temperatures[boundary.index()]),
            End::Node(node) => node,
        };
        let temperature = steady.temperatures[node.index()];
        if self.system().network().first_nonlinear().is_none() {
            // a linear network has a second way to it: T_ref + R_eq Q_N with the node as port
            let port = NortonEquivalent::new(self.system(), node)?;
            let inputs = port.inputs(self.system(), 0.0)?;
            let seen = inputs.reference + port.resistance * inputs.heat;
            if (seen - temperature).abs() > expected.allowed() {
                return Err(
                    format!("the port gives {seen} K, the steady state {temperature} K").into()
                );
            }
        }
        Ok(temperature)
    }

    fn edge_heat(&self, edge: &str, (moment, side): (Moment, Side)) -> Result<f64, Trouble> {
        let id = self.edge(edge)?;
        match moment {
            Moment::Steady => Ok(self.steady()?.conductor_heat[id.index()]),
            Moment::At(t) => {
                self.read((t, side), false, |solution, row| Some(solution.conductor_heat(id)?[row]))
            }
        }
    }

    fn boundary_heat(&self, node: &str, (moment, side): (Moment, Side)) -> Result<f64, Trouble> {
        let id = self.boundary(node)?;
        match moment {
            Moment::Steady => Ok(self.steady()?.boundary_heat[id.index()]),
            Moment::At(t) => {
                self.read((t, side), false, |solution, row| Some(solution.boundary_heat(id)?[row]))
            }
        }
    }

    fn mode(&self, index: usize, skip_zero: bool) -> Result<Mode, Trouble> {
        let modes = Modes::solve(self.system().network())?;
        let mut kept = modes.modes().iter().filter(|mode| !skip_zero || mode.rate > 0.0);
        kept.nth(index).cloned().ok_or_else(|| format!("there is no mode {index}").into())
    }

    fn resistance(&self, from: &str, to: &str) -> Result<f64, Trouble> {
        Ok(transfer_resistance(self.system(), self.node(from)?, self.node(to)?)?)
    }

    /// The first crossing of a level in K between two times: the bracket among a few thousand rows,
    /// then again in it.
    fn crossing(
        &self,
        node: &str,
        level: f64,
        (mut from, mut to): (f64, f64),
        direction: Direction,
    ) -> Result<f64, Trouble> {
        const ROWS: usize = 2000;
        let end = self.end_named(node)?;
        for _ in 0..3 {
            let rows = (0..=ROWS).map(|i| from + (to - from) * i as f64 / ROWS as f64).collect();
            let solution = self.run_at(rows)?;
            let start = solution.times().partition_point(|t| *t < from);
            let seen: Vec<(f64, f64)> = (start..solution.times().len())
                .filter_map(|row| {
                    Some((solution.times()[row], temperature(&solution, end, row)? - level))
                })
                .collect();
            let crosses = |pair: &&[(f64, f64)]| match direction {
                Direction::Rising => pair[0].1 < 0.0 && pair[1].1 >= 0.0,
                Direction::Falling => pair[0].1 > 0.0 && pair[1].1 <= 0.0,
            };
            let Some(pair) = seen.windows(2).find(crosses) else {
                return Err(format!("`{node}` does not cross {level} K").into());
            };
            (from, to) = (pair[0].0, pair[1].0);
        }
        Ok(0.5 * (from + to))
    }

    fn fit(&self, fit: &Fit) -> Result<ExponentialFit, Trouble> {
        let node = self.node(&fit.node)?;
        let steps = fit.n.saturating_sub(1).max(1) as f64;
        if fit.t0 == 0.0 {
            let run = RunAnalysis::until(Time(fit.t1)).every(Time(fit.t1 / steps));
            let bias = Bias::new(self.system(), node, &run.within(self.case.tolerance()))??;
            let counted = bias.points == fit.n;
            return if counted {
                Ok(bias.fit)
            } else {
                Err(format!("{} points", bias.points).into())
            };
        }
        let times: Vec<f64> =
            (0..fit.n).map(|i| fit.t0 + (fit.t1 - fit.t0) * i as f64 / steps).collect();
        let solution = self.run_at(times.clone())?;
        let record = solution.temperature(node).ok_or("no record")?;
        Ok(fit_exponential(&times, &record[record.len() - fit.n..])?)
    }
}

/// Temperature of a node or boundary in one row in K.
pub fn temperature(solution: &Solution, end: End, row: usize) -> Option<f64> {
    match end {
        End::Node(node) => Some(solution.row(row)[solution.recorded().binary_search(&node).ok()?]),
        End::Boundary(boundary) => solution.boundary_temperature(boundary).get(row).copied(),
    }
}

type Combination = std::collections::BTreeMap<String, f64>;

/// A temperature, a difference of two or a sum with factors.
pub fn terms<'a>(
    node: Option<&'a str>,
    minus: Option<&'a str>,
    combine: Option<&'a Combination>,
) -> Result<Vec<(&'a str, f64)>, Trouble> {
    match (node, minus, combine) {
        (Some(node), None, None) => Ok(vec![(node, 1.0)]),
        (Some(node), Some(minus), None) => Ok(vec![(node, 1.0), (minus, -1.0)]),
        // `node` beside it is for the reader
        (_, None, Some(combine)) => {
            Ok(combine.iter().map(|(id, factor)| (id.as_str(), *factor)).collect())
        }
        _ => Err("which temperature?".into()),
    }
}
