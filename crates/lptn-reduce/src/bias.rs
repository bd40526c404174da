//! The seed paper's method, applied to a network whose true heat is known.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;
use lptn_solve::{Proceed, RecordedNodes};

use crate::error::{FitError, ReduceError};
use crate::fit::{ExponentialFit, fit_exponential};
use crate::norton::NortonEquivalent;

/// The heat inferred from one exponential through the port's record, and the true heat.
///
/// The method (seed paper, equations 8 to 11): fit `T_i + (T_f - T_i)(1 - exp(-t / t_RC))` to the
/// record of one thermocouple, take `C_eq` as the sum of the capacities, and conclude
/// `R_eq = t_RC / C_eq` and `P = (T_f - T_i) / R_eq`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// The exponential; its temperatures are in K, its time 0 is the start of the run.
    pub fit: ExponentialFit,
    /// Number of points of the record.
    pub points: usize,
    /// Length of the record in s.
    pub length: f64,
    /// The sum of the capacities that heat from the port reaches, in J/K.
    pub capacity: f64,
    /// `t_RC / C_eq` in K/W.
    pub resistance: f64,
    /// `(T_f - T_i) C_eq / t_RC` in W.
    pub inferred: f64,
    /// Mean heat over the record of all sources that the port feels, in W.
    pub heat: f64,
}

impl Bias {
    /// Runs the network as `run` says, with a row at each of its rows, and fits the port's record.
    ///
    /// # Errors
    /// [`ReduceError`] if the run fails; inside, [`FitError`] if the record has no exponential.
    pub fn new(
        system: &ThermalSystem,
        port: NodeId,
        run: &RunAnalysis,
    ) -> Result<Result<Self, FitError>, ReduceError> {
        let norton = NortonEquivalent::new(system, port)?;
        let asked = run.clone().keeping(RecordedNodes::Nodes(vec![port]));
        let solution = asked.solve(system, &mut |_| Proceed::Continue)?;
        let times: Vec<f64> = solution.times().iter().map(|t| t - run.start()).collect();
        let temperatures = solution.temperature(port).unwrap_or_default();
        let capacity = norton.capacity_sum(system.network());
        let length = run.stop() - run.start();
        let felt =
            solution.ledger().sources.iter().zip(&norton.source_weights).filter(|(_, w)| **w > 0.0);
        let heat = felt.map(|(energy, _)| energy).sum::<f64>() / length;
        Ok(fit_exponential(&times, &temperatures).map(|fit| {
            let resistance = fit.tau / capacity;
            let inferred = (fit.settled - fit.initial) / resistance;
            Self { fit, points: times.len(), length, capacity, resistance, inferred, heat }
        }))
    }

    /// The inferred heat over the true one, less one; `None` if no heat was put in.
    pub fn relative(&self) -> Option<f64> {
        (self.heat.abs() > 0.0).then(|| self.inferred / self.heat - 1.0)
    }
}
