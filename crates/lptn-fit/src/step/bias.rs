//! Bias of the method for a known network.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;
use lptn_reduce::{ExponentialFit, FitError, NortonEquivalent, ReduceError, fit_exponential};
use lptn_solve::{Proceed, RecordedNodes};

use super::error::StepError;

/// A number of the network, and its value by the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedValue {
    /// True value.
    pub real: f64,
    /// Value of one exponential.
    pub fitted: f64,
}

impl FittedValue {
    /// Error of the fit: to be subtracted from a measured value.
    pub fn bias(&self) -> f64 {
        self.fitted - self.real
    }
}

/// The same fit on a network's own response, without noise, at the record's times: the errors of
/// one exponential because the network has several nodes. The standard errors do not include them.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelBias {
    /// `T_i`: the port at the first time that is fitted, in K. At the start of the run a port
    /// without capacity has no start temperature, so there the fitted value counts.
    pub initial: FittedValue,
    /// `T_f`: the port in steady state with the inputs of the start, in K.
    pub settled: FittedValue,
    /// `t_RC`: `C_sum R_eq` of the network at the port, in s.
    pub tau: FittedValue,
    /// `P`: the equivalent heat at the port, in W, against `C_sum (T_f - T_i) / t_RC`. If the
    /// record is cut, `T_i` is the port's temperature at the start of the run: that of the cut
    /// gives no heat.
    pub power: FittedValue,
    /// `C_sum` in J/K: the sum of the capacities that heat from the port reaches.
    pub capacity: f64,
    /// `R_eq` of the network at the port, in K/W.
    pub resistance: f64,
    /// Root mean square of the residuals of one exponential, in K.
    pub rms: f64,
    /// The network's own response: times of the record in s, and the port in K.
    pub answer: Vec<(f64, f64)>,
}

/// Response of the port.
struct PortFit {
    /// Temperature at the start of the run, in K.
    start: f64,
    /// The exponential through the times that are fitted, from the first of them.
    fit: ExponentialFit,
    /// The port at the first of them, in K.
    first: f64,
    /// True if that is after the start.
    cut: bool,
    /// Times of the record in s, and the port in K.
    answer: Vec<(f64, f64)>,
}

impl ModelBias {
    /// Runs the network from its own start, which is the time `begin` of the record, through the
    /// `times` of the record that are fitted (in s), with the other settings of `run`, and fits the
    /// port.
    ///
    /// # Errors
    /// [`StepError::Model`] if the network has no equivalent at the port or its run fails,
    /// [`StepError::Fit`] if its answer has no exponential.
    pub fn new(
        system: &ThermalSystem,
        port: NodeId,
        run: &RunAnalysis,
        (begin, times): (f64, &[f64]),
    ) -> Result<Self, StepError> {
        let norton = NortonEquivalent::new(system, port).map_err(StepError::Model)?;
        let port_fit = PortFit::new(system, port, run, (begin, times))?;
        let inputs = norton
            .inputs(system, run.start())
            .map_err(|e| StepError::Model(ReduceError::Input(e)))?;
        let fit = &port_fit.fit;
        let massless = system.network().nodes()[port.index()].massless;
        let first = if massless && !port_fit.cut { fit.initial } else { port_fit.first };
        let zero = if port_fit.cut { port_fit.start } else { fit.initial };
        let (capacity, resistance) = (norton.capacity_sum(system.network()), norton.resistance);
        Ok(Self {
            initial: FittedValue { real: first, fitted: fit.initial },
            settled: FittedValue {
                real: inputs.reference + inputs.heat * resistance,
                fitted: fit.settled,
            },
            tau: FittedValue { real: capacity * resistance, fitted: fit.tau },
            power: FittedValue {
                real: inputs.heat,
                fitted: capacity * (fit.settled - zero) / fit.tau,
            },
            capacity,
            resistance,
            rms: fit.rms,
            answer: port_fit.answer,
        })
    }
}

impl PortFit {
    fn new(
        system: &ThermalSystem,
        port: NodeId,
        run: &RunAnalysis,
        (begin, times): (f64, &[f64]),
    ) -> Result<Self, StepError> {
        let few = || StepError::Fit(FitError::TooFew { points: times.len() });
        let rows: Vec<f64> = times.iter().map(|t| t - begin + run.start()).collect();
        let (&first, &stop) = rows.first().zip(rows.last()).ok_or_else(few)?;
        let begun = begin - run.start();
        let run = run.clone().bare().lasting(run.start(), stop).at(rows);
        let run = run.keeping(RecordedNodes::Nodes(vec![port]));
        let solution = run
            .solve(system, &mut |_| Proceed::Continue)
            .map_err(|e| StepError::Model(ReduceError::Run(e)))?;
        let temperatures = solution.temperature(port).unwrap_or_default();
        // a run has a row at its start, also if none is asked for there
        let skipped = solution.times().partition_point(|&t| t < first);
        let times: Vec<f64> = solution.times()[skipped..].iter().map(|t| t - first).collect();
        let (&start, &at_first) =
            temperatures.first().zip(temperatures.get(skipped)).ok_or_else(few)?;
        let fit = fit_exponential(&times, &temperatures[skipped..]).map_err(StepError::Fit)?;
        let record = times.iter().map(|t| t + first + begun);
        let answer = record.zip(temperatures[skipped..].iter().copied()).collect();
        Ok(Self { start, fit, first: at_first, cut: skipped > 0, answer })
    }
}
