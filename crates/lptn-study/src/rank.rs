//! Ranking of the values of a network by their effect on one temperature: which to change first.

use lptn_analysis::{RunAnalysis, RunError};
use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{Field, InputError, Item, Network, NodeId, ParameterId, RunSettings, Value};
use lptn_solve::{
    Adjoint, AdjointError, Feedback, Gradient, Influence, Modes, ParameterSlopes, Proceed,
    Progress, RecordedNodes, SensitiveError, SteadyError, SteadyState, TransientError, can_move,
    on_both_sides, own_side,
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
    /// There is no node.
    NoNode = "rank::no_node", "the network has no node whose temperature could respond",
        help "add a [node]";
}
}

impl From<RunError> for RankError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Failed(error) => Self::Run(error),
            RunError::Interrupted { .. } => Self::Sensitive(SensitiveError::Interrupted),
        }
    }
}

/// The effects of values on one temperature.
#[derive(Debug)]
pub struct Ranking {
    /// The node whose temperature it is.
    pub node: NodeId,
    /// The temperature in K: that of the steady state, or the highest of a run.
    pub temperature: f64,
    /// When it is highest in a run, in s.
    pub at: Option<f64>,
    /// Effects of parameters, the largest first; those without effect have 0.
    pub parameters: Vec<Influence>,
    /// Values of parameters and elements that are 0, so that no share of them is a change, in the
    /// order of the network. Their `change` is the slope of the temperature in K per SI unit, and
    /// elements without a slope are left out.
    pub zeros: Vec<Influence>,
    /// Why parameters are not ranked, if the network has no derivatives by them.
    pub not_ranked: Option<String>,
    /// Parameters that can be neither a little larger nor a little smaller, such as numbers of
    /// teeth, and why; they are not ranked.
    pub fixed: Vec<(ParameterId, ChangeError)>,
    /// Effects of values of elements and boundaries, the largest first; of steady states only.
    pub elements: Vec<Influence>,
    /// The share of the heat of sources that comes back as more heat, if any does.
    pub feedback: Option<Feedback>,
    /// If heat comes back, the rate of the slowest mode in 1/s, negative if it grows: minus the
    /// largest eigenvalue of the network near its steady state.
    pub slowest: Option<f64>,
    /// Why the sensitivities are differences of runs, if they are.
    pub differences: Option<String>,
}

impl Ranking {
    /// Ranking for a steady state with the inputs at `time` in s, for `node` or the hottest one.
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
        let temperatures = network.thermal_nodes().map(|id| (id, state.temperatures[id.index()]));
        let node = node.or_else(|| hottest(temperatures).map(|(id, _)| id));
        let node = node.ok_or(RankError::NoNode)?;
        let adjoint = Adjoint::of(system, state, node)?;
        let (ids, fixed) = free(network);
        let (slopes, not_ranked) = match adjoint.by_parameters(&ids) {
            Ok(slopes) => (slopes, None),
            Err(ParameterSlopes::Input(error)) => return Err(error.into()),
            Err(ParameterSlopes::None(why)) => (Vec::new(), Some(why.to_string())),
        };
        let known = ids.iter().copied().zip(slopes);
        let temperature = state.temperatures[node.index()];
        let feedback = Feedback::of(system, state);
        let slowest = feedback.as_ref().and_then(|_| Modes::of(system, Some(state), 1).ok());
        let slowest = slowest.and_then(|modes| Some(modes.modes().first()?.rate));
        let (parameters, mut zeros) = of_parameters(network, known, temperature);
        let (of_zero, elements): (Vec<_>, Vec<_>) =
            adjoint.influences()?.into_iter().partition(Influence::is_zero);
        zeros
            .extend(of_zero.into_iter().filter(|zero| zero.change.is_finite() && has_effect(zero)));
        Ok(Self {
            node,
            temperature,
            at: None,
            parameters,
            zeros,
            not_ranked,
            fixed,
            elements: sorted(elements, temperature),
            feedback,
            slowest,
            differences: None,
        })
    }

    /// Ranking for the highest temperature of `node`, or of the hottest one, in a run, by forward
    /// sensitivities to parameters. A highest temperature changes as the temperature does at its
    /// time, on its own side if something jumps there; `observer` is called after every step and
    /// may interrupt.
    ///
    /// # Errors
    /// [`RankError`]
    pub fn of_run(
        system: &ThermalSystem,
        (settings, node): (&RunSettings, Option<NodeId>),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Self, RankError> {
        let network = system.network();
        let run = RunAnalysis::of(network, settings).bare();
        let Highest { node, temperature, at } = highest(system, (&run, node), observer)?;
        let ends = (settings.start, settings.stop);
        let run = run.at(with(ends, at)).keeping(RecordedNodes::Nodes(vec![node])).watching([node]);
        let (ids, fixed) = free(network);
        let run = run.with_slopes((network, &ids), observer)?;
        let rows = run.solution.temperature(node).unwrap_or_default();
        let place = own_side((run.solution.times(), |row| rows[row]), (at, temperature), ends);
        let slope = |id: ParameterId| {
            let of_runs = run.peak(id, node);
            let at_peak = || run.sensitivity(id, node).and_then(|row| row.get(place).copied());
            of_runs.or_else(at_peak).unwrap_or(f64::NAN)
        };
        let known = ids.iter().map(|&id| (id, slope(id)));
        let (parameters, zeros) = of_parameters(network, known, temperature);
        let differences = match &run.gradient {
            Gradient::Exact => None,
            Gradient::Differences(why) => Some(why.to_string()),
        };
        Ok(Self {
            node,
            temperature,
            at: Some(at),
            parameters,
            zeros,
            not_ranked: None,
            fixed,
            elements: Vec::new(),
            feedback: None,
            slowest: None,
            differences,
        })
    }
}

/// The highest temperature of a run.
struct Highest {
    node: NodeId,
    /// In K.
    temperature: f64,
    /// In s.
    at: f64,
}

/// The highest temperature of `node` or of the hottest one.
fn highest(
    system: &ThermalSystem,
    (run, node): (&RunAnalysis, Option<NodeId>),
    observer: &dyn Fn(Progress) -> Proceed,
) -> Result<Highest, RankError> {
    let nodes = node.map_or_else(|| system.network().thermal_nodes().collect(), |id| vec![id]);
    let run = run.clone().at(Vec::new()).watching(nodes.iter().copied()).for_the_hottest();
    let seen = run.solve(system, &mut |progress| observer(progress))?;
    let peaks = nodes.iter().zip(seen.watched().iter().map(|watched| watched.peak));
    let peak = hottest(peaks.map(|(&node, (temperature, at))| ((node, at), temperature)));
    let ((node, at), temperature) = peak.ok_or(RankError::NoNode)?;
    Ok(Highest { node, temperature, at })
}

/// The effects of parameters by their slopes, sorted, and then those whose value is 0.
fn of_parameters(
    network: &Network,
    slopes: impl Iterator<Item = (ParameterId, f64)>,
    temperature: f64,
) -> (Vec<Influence>, Vec<Influence>) {
    let all = slopes.map(|(id, slope)| of_parameter(network, id, slope));
    let (zeros, others): (Vec<_>, Vec<_>) = all.partition(Influence::is_zero);
    let zeros = zeros.into_iter().filter(|zero| !zero.change.is_nan()).collect();
    (all_sorted(others, temperature), zeros)
}

fn of_parameter(network: &Network, id: ParameterId, slope: f64) -> Influence {
    let ty = network.parameters()[id.index()].ty;
    let value = network.parameter_value(id);
    let mut of = Influence {
        of: Item::Parameter(id),
        field: Field::Value,
        value,
        change: slope,
        ty,
        absolute: ty.absolute,
    };
    if !of.absolute && !of.is_zero() {
        of.change *= value;
    }
    of
}

/// The ends of a run with both sides of a time of it; one that is next to an end is the end.
fn with((start, stop): (f64, f64), at: f64) -> Vec<f64> {
    let same = SAME * (stop - start);
    let inside = Some(at).filter(|at| at - start > same && stop - at > same);
    let both = on_both_sides(inside.into_iter(), (start, stop));
    [start].into_iter().chain(both).chain([stop]).collect()
}

/// The parameters that are numbers and may be a little larger or smaller, for the others follow
/// from them; and those that may not.
fn free(network: &Network) -> (Vec<ParameterId>, Vec<(ParameterId, ChangeError)>) {
    let is_number =
        |id: &ParameterId| matches!(network.parameters()[id.index()].value, Value::Constant(_));
    let (mut free, mut fixed) = (Vec::new(), Vec::new());
    for id in network.parameter_ids().filter(is_number) {
        match can_move(network, id) {
            Ok(()) => free.push(id),
            Err(why) => fixed.push((id, why)),
        }
    }
    (free, fixed)
}

/// Influences above rounding, the largest first; equal ones stay in their order.
fn sorted(influences: Vec<Influence>, temperature: f64) -> Vec<Influence> {
    let mut all = all_sorted(influences, temperature);
    all.retain(has_effect);
    all
}

/// The same with those that are rounding, as 0.
fn all_sorted(mut influences: Vec<Influence>, temperature: f64) -> Vec<Influence> {
    for influence in &mut influences {
        if effect(influence).abs() <= ROUNDING * temperature {
            influence.change = 0.0;
        }
    }
    influences.retain(|influence| !influence.change.is_nan());
    influences.sort_by(|a, b| effect(b).abs().total_cmp(&effect(a).abs()));
    influences
}

/// True if a value changes the temperature.
pub fn has_effect(influence: &Influence) -> bool {
    influence.change.abs() > 0.0
}

/// Change of the temperature in K if a value is 10 % larger, or a temperature 1 K higher; of a value
/// that is not 0.
pub fn effect(influence: &Influence) -> f64 {
    influence.change * if influence.absolute { 1.0 } else { 0.1 }
}
