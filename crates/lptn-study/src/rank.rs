//! What to change first: by how much one temperature answers every value of a network.

use lptn_assembly::ThermalSystem;
use lptn_network::{Field, InputError, Item, Network, NodeId, OutputTimes, ParameterId, Value};
use lptn_solve::{
    Adjoint, AdjointError, Feedback, Gradient, Influence, LedgerError, Modes, ParameterSlopes,
    Proceed, Progress, RecordedNodes, RunStatus, SensitiveError, SteadyError, SteadyState,
    Transient, TransientError, Watch, sensitive_run_observed,
};

use crate::compare::hottest;

/// Changes below this part of a temperature (3e-7 K at room temperature) are rounding.
const ROUNDING: f64 = 1e-9;

/// Two times that are nearer than this part of the run are the same.
const SAME: f64 = 1e-9;

lptn_units::errors! {
/// Why values cannot be ranked.
#[derive(Debug)]
pub enum RankError {
    /// There is no steady state.
    Steady => SteadyError as lptn_units::Class::not_an_answer;
    /// The temperature has no slopes there.
    Adjoint => AdjointError;
    /// A value has no slope.
    Input => InputError;
    /// The run.
    Run => Box<TransientError>;
    /// The run with its sensitivities.
    Sensitive => SensitiveError;
    /// The books of one of them do not close.
    Ledger => LedgerError;
    /// There is no node.
    NoNode = "rank::no_node", "the network has no node whose temperature could answer",
        help "add a [node]";
}
}

/// How one temperature answers.
#[derive(Debug)]
pub struct Ranking {
    /// Whose temperature it is.
    pub node: NodeId,
    /// The temperature in K: that of the steady state, or the highest of a run.
    pub temperature: f64,
    /// When it is highest in a run, in s.
    pub at: Option<f64>,
    /// What parameters do, the most first.
    pub parameters: Vec<Influence>,
    /// Why parameters are not ranked, where the network has no derivatives by them.
    pub not_ranked: Option<String>,
    /// What values of elements and boundaries do, the most first; of steady states only.
    pub elements: Vec<Influence>,
    /// How much of the heat of sources comes back as more heat, if any does.
    pub feedback: Option<Feedback>,
    /// Where heat comes back, the rate of the slowest mode in 1/s, negative where it grows: the
    /// largest eigenvalue of the network near its steady state with its sign turned.
    pub slowest: Option<f64>,
    /// Why the sensitivities are differences of runs, if they are.
    pub differences: Option<String>,
}

impl Ranking {
    /// Of a steady state with the inputs at `time` in s, for `node` or the hottest one.
    ///
    /// # Errors
    /// [`RankError`]
    pub fn steady(
        system: &ThermalSystem,
        steady: &SteadyState,
        node: Option<NodeId>,
    ) -> Result<Self, RankError> {
        let network = system.network();
        let state = &steady.state;
        let temperatures = network.node_ids().zip(state.temperatures.iter().copied());
        let node = node.or_else(|| hottest(temperatures).map(|(id, _)| id));
        let node = node.ok_or(RankError::NoNode)?;
        let adjoint = Adjoint::of(system, state, node)?;
        let ids = free(network);
        let (slopes, not_ranked) = match adjoint.by_parameters(&ids) {
            Ok(slopes) => (slopes, None),
            Err(ParameterSlopes::Input(error)) => return Err(error.into()),
            Err(ParameterSlopes::None(why)) => (Vec::new(), Some(why.to_string())),
        };
        let known = slopes.iter().zip(&ids);
        let parameters = known.map(|(&slope, &id)| of_parameter(network, id, slope)).collect();
        let temperature = state.temperatures[node.index()];
        let feedback = Feedback::of(system, state);
        let slowest = feedback.as_ref().and_then(|_| Modes::of(system, Some(state), 1).ok());
        let slowest = slowest.and_then(|modes| Some(modes.modes().first()?.rate));
        Ok(Self {
            node,
            temperature,
            at: None,
            parameters: sorted(parameters, temperature),
            not_ranked,
            elements: sorted(adjoint.influences()?, temperature),
            feedback,
            slowest,
            differences: None,
        })
    }

    /// Of the highest temperature of `node`, or of the hottest one, in a run: what parameters do to
    /// it, followed along with the temperatures (forward sensitivities). A highest temperature
    /// changes as the temperature does at its time; `observer` is called after every step and may
    /// interrupt.
    ///
    /// # Errors
    /// [`RankError`]
    pub fn of_run(
        system: &ThermalSystem,
        (settings, node): (&Transient, Option<NodeId>),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Self, RankError> {
        let network = system.network();
        let nodes: Vec<NodeId> = node.map_or_else(|| network.node_ids().collect(), |id| vec![id]);
        let watch: Vec<Watch> = nodes.iter().map(|&node| Watch { node, level: None }).collect();
        let ends = OutputTimes::At(vec![settings.start, settings.stop]);
        let run = Transient {
            output: ends,
            record: RecordedNodes::Nodes(Vec::new()),
            watch: watch.clone(),
            windows: Vec::new(),
            balance: None,
            ..settings.clone()
        };
        let seen = run.solve_observed(system, &mut |progress| observer(progress));
        let seen = seen.map_err(|error| RankError::Run(Box::new(error)))?;
        if let RunStatus::Interrupted(_) = seen.end() {
            return Err(RankError::Sensitive(SensitiveError::Interrupted));
        }
        seen.ledger().check()?;
        let peaks = nodes.iter().zip(seen.watched().iter().map(|watched| watched.peak));
        let peak = hottest(peaks.map(|(&node, (temperature, at))| ((node, at), temperature)));
        let ((node, at), temperature) = peak.ok_or(RankError::NoNode)?;
        let (times, place) = with((settings.start, settings.stop), at);
        let run = Transient {
            output: OutputTimes::At(times),
            record: RecordedNodes::Nodes(vec![node]),
            watch: vec![Watch { node, level: None }],
            ..run
        };
        let ids = free(network);
        let run = sensitive_run_observed(network, (&run, &ids), observer)?;
        run.solution.ledger().check()?;
        let slope = |id: ParameterId| {
            let of_runs = run.peak(id, node);
            let at_peak = || run.sensitivity(id, node).and_then(|row| row.get(place).copied());
            of_runs.or_else(at_peak).unwrap_or(f64::NAN)
        };
        let parameters = ids.iter().map(|&id| of_parameter(network, id, slope(id))).collect();
        let differences = match &run.gradient {
            Gradient::Exact => None,
            Gradient::Differences(why) => Some(why.to_string()),
        };
        let parameters = sorted(parameters, temperature);
        Ok(Self {
            node,
            temperature,
            at: Some(at),
            parameters,
            not_ranked: None,
            elements: Vec::new(),
            feedback: None,
            slowest: None,
            differences,
        })
    }
}

fn of_parameter(network: &Network, id: ParameterId, slope: f64) -> Influence {
    let ty = network.parameters()[id.index()].ty;
    let value = network.parameter_value(id);
    let change = slope * if ty.absolute { 1.0 } else { value };
    let absolute = ty.absolute;
    Influence { of: Item::Parameter(id), field: Field::Value, value, change, ty, absolute }
}

/// The ends of a run with a time of it, and the place of that among them; one that is next to an end
/// is the end.
fn with((start, stop): (f64, f64), at: f64) -> (Vec<f64>, usize) {
    let same = SAME * (stop - start);
    match at {
        at if at - start <= same => (vec![start, stop], 0),
        at if stop - at <= same => (vec![start, stop], 1),
        at => (vec![start, at, stop], 1),
    }
}

/// The parameters that are numbers: the others follow from them.
fn free(network: &Network) -> Vec<ParameterId> {
    let is_number =
        |id: &ParameterId| matches!(network.parameters()[id.index()].value, Value::Constant(_));
    network.parameter_ids().filter(is_number).collect()
}

/// What does something, the most first; those that do alike stay in their order.
fn sorted(mut influences: Vec<Influence>, temperature: f64) -> Vec<Influence> {
    influences.retain(|influence| effect(influence).abs() > ROUNDING * temperature);
    influences.sort_by(|a, b| effect(b).abs().total_cmp(&effect(a).abs()));
    influences
}

/// By how much the temperature changes in K, where a value is 10 % larger, or a temperature 1 K.
pub fn effect(influence: &Influence) -> f64 {
    influence.change * if influence.absolute { 1.0 } else { 0.1 }
}
