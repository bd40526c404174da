//! What the method gets wrong of a network that is known.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;
use lptn_reduce::{ExponentialFit, FitError, NortonEquivalent, ReduceError, fit_exponential};
use lptn_solve::{Proceed, RecordedNodes};

use super::error::StepError;

/// A number of the network, and what the fit makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedValue {
    /// As it is.
    pub real: f64,
    /// As one exponential has it.
    pub fitted: f64,
}

impl FittedValue {
    /// What the fit adds: to be subtracted from a measured value.
    pub fn bias(&self) -> f64 {
        self.fitted - self.real
    }
}

/// The same fit on a network's own answer, without noise, at the record's times: what one
/// exponential gets wrong because the network has several nodes. It stands apart from the standard
/// errors, which know nothing of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelBias {
    /// `T_i`: the port at the first time that is fitted, in K; as fitted for a port without
    /// capacity at the start, which has no start of its own.
    pub initial: FittedValue,
    /// `T_f`: the port in steady state with the inputs of the start, in K.
    pub settled: FittedValue,
    /// `t_RC`: `C_sum R_eq` of the network at the port, in s.
    pub tau: FittedValue,
    /// `P`: the heat that the port feels, in W, against `C_sum (T_f - T_i) / t_RC`; where the
    /// record is cut, with the port's temperature at the start of the run for `T_i`: that of the
    /// cut gives no heat.
    pub power: FittedValue,
    /// `C_sum` in J/K: the sum of the capacities that heat from the port reaches.
    pub capacity: f64,
    /// `R_eq` of the network at the port, in K/W.
    pub resistance: f64,
    /// Root of the mean square of what one exponential misses of the network's answer, in K.
    pub rms: f64,
    /// The network's own answer: times of the record in s, and the port in K.
    pub answer: Vec<(f64, f64)>,
}

/// What the port does.
struct PortFit {
    /// At the start of the run, in K.
    start: f64,
    /// The exponential through the times that are fitted, from the first of them.
    fit: ExponentialFit,
    /// The port at the first of them, in K.
    first: f64,
    /// Whether that is after the start.
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
        // a run has a row at its start, whether or not it is among those that are asked for
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
