//! The parameter, the temperature and the requirement of a study to paste.

use std::cell::Cell;

use lptn_analysis::{LimitResult, RunAnalysis};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Bound, Item, Limit, LimitId, Network, NodeId, ParameterId, Value, ZERO_CELSIUS, is_name,
};
use lptn_report::significant;
use lptn_solve::{Influence, Proceed};
use lptn_study::{Ranking, has_effect};
use lptn_units::{Dimension, Type, Unit};

use crate::input::Input;
use crate::parameter::with_unit;

/// Nodes of the largest network that is solved for an example.
const MOST_NODES: usize = 10_000;

/// Steps of the longest run that is made for an example.
const MOST_STEPS: usize = 20_000;

/// Factors from a value to the ends of its range. A quantity that costs something has the first,
/// others are more likely to leave the range of a law; the next are for values without a state.
const FACTORS: [[f64; 2]; 4] = [[0.1, 10.0], [0.5, 2.0], [0.8, 1.25], [0.95, 1.05]];

/// The range of a temperature to both sides in K.
const AROUND: f64 = 20.0;

/// The direction in which a parameter costs less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// The least value is best.
    Least,
    /// The largest value is best.
    Most,
}

/// The subject of a study of a file.
#[derive(Debug)]
pub(super) struct Subject {
    /// Lines that the file needs before the study.
    pub(super) before: String,
    /// The parameter.
    pub(super) name: String,
    /// The range of the parameter.
    pub(super) ends: [String; 2],
    /// The direction that costs less.
    pub(super) way: Way,
    /// The error to which a measurement should determine it.
    pub(super) known_to: &'static str,
    /// The node whose temperature responds.
    pub(super) node: String,
    /// A comparison of results.
    pub(super) requirement: String,
    /// True if inputs change with time, so that the results are those of the run.
    pub(super) over_run: bool,
}

/// A parameter that may be varied.
#[derive(Clone, Copy)]
struct Choice {
    id: ParameterId,
    /// The larger, the less sense a study makes.
    order: usize,
    way: Way,
}

impl Subject {
    pub(super) fn of(input: &Input) -> Self {
        let network = &input.netlist.network;
        let known = Known::of(input);
        let over_run = known.as_ref().map_or(varies(input), |known| known.over_run);
        let ranking = known.as_ref().and_then(|known| known.ranking.as_ref());
        let node = match known.as_ref().map(|known| known.node).or(network.thermal_nodes().next()) {
            Some(id) => network.nodes()[id.index()].name.as_str(),
            None => network.boundaries().first().map_or("steel", |first| first.name.as_str()),
        };
        let requirement = known.as_ref().map(|known| known.requirement(input));
        let requirement = requirement.unwrap_or_else(|| unsolved(network, node));
        let subject = Self {
            before: String::new(),
            name: "p".to_owned(),
            ends: ["1 W/K", "10 W/K"].map(str::to_owned),
            way: Way::Least,
            known_to: "5 %",
            node: node.to_owned(),
            requirement,
            over_run,
        };
        match choice(network, ranking) {
            Some(choice) => subject.with(choice, input),
            None if network.parameters().is_empty() => Self {
                before: "[param]\np = \"2 W/K\"    # and use it in an element: G = \"p\"\n\n"
                    .into(),
                ..subject
            },
            None => subject,
        }
    }

    fn with(self, choice: Choice, input: &Input) -> Self {
        let network = &input.netlist.network;
        let parameter = &network.parameters()[choice.id.index()];
        let (value, unit) = (network.parameter_value(choice.id), input.unit_of(choice.id));
        let shown = |value: f64| with_unit(&unit, value);
        let absolute = parameter.ty.absolute;
        // a share, such as an emissivity, stays one
        let most = if parameter.ty.is_scalar() && value <= 1.0 { 1.0 } else { f64::INFINITY };
        let scaled = |[low, high]: [f64; 2]| [value * low, (value * high).min(most)];
        let mut all = FACTORS.iter().skip(usize::from(choice.order > 0)).map(|of| scaled(*of));
        let states = |ends: &[f64; 2]| {
            self.over_run || ends.iter().all(|end| has_state(input, choice.id, *end))
        };
        let ends = match absolute {
            true => [value - AROUND, value + AROUND],
            false => all.clone().find(states).or_else(|| all.next_back()).unwrap_or([value; 2]),
        };
        let known_to = if absolute { "0.5 K" } else { "5 %" };
        let name = parameter.name.clone();
        Self { name, ends: ends.map(shown), way: choice.way, known_to, ..self }
    }
}

/// True if inputs change with time or something switches, and there is a run.
fn varies(input: &Input) -> bool {
    let network = &input.netlist.network;
    input.netlist.run.is_some() && (network.has_events() || !network.changing_inputs().is_empty())
}

/// True if the network has a steady state with this value of a parameter.
fn has_state(input: &Input, id: ParameterId, value: f64) -> bool {
    let mut parameters = input.netlist.overrides();
    parameters.set(id, value);
    let start = input.netlist.run.as_ref().map_or(0.0, |run| run.start);
    let network = input.netlist.network.with(&parameters).ok();
    let system = network.and_then(|network| ThermalSystem::assemble(&network).ok());
    system.is_some_and(|system| lptn_analysis::steady(&system, start).is_ok())
}

/// A requirement for a temperature that is not known.
fn unsolved(network: &Network, node: &str) -> String {
    let hottest = network
        .boundaries()
        .iter()
        .filter_map(|boundary| boundary.temperature.at(&mut network.evaluation()).ok());
    let limit = rounded(hottest.fold(ZERO_CELSIUS + 75.0, f64::max));
    format!("{node}.T <= {limit} [degC]")
}

/// The next round temperature in degC above one in K.
fn rounded(temperature: f64) -> f64 {
    5.0 * ((temperature - ZERO_CELSIUS) / 5.0 + 0.1).ceil()
}

/// The parameter whose study makes most sense: among the same kind the first of the file.
fn choice(network: &Network, ranking: Option<&Ranking>) -> Option<Choice> {
    let of = |id: ParameterId| {
        let parameter = &network.parameters()[id.index()];
        let value = network.parameter_value(id);
        let suits = is_name(&parameter.name) && (value > 0.0 || parameter.ty.absolute);
        let fixed = ranking.is_some_and(|ranking| ranking.fixed.iter().any(|(own, _)| *own == id));
        let (order, usual_way) = usual(parameter.ty);
        let influence = ranking.and_then(|ranking| effect_of(ranking, id));
        let idle = ranking.is_some() && influence.is_none();
        let warms = influence.map(|influence| influence.change > 0.0);
        let way = warms.map_or(usual_way, |warms| if warms { Way::Most } else { Way::Least });
        // a conductance that warms is not one of cooling
        let order = if way == usual_way { order } else { order.max(1) };
        // without a steady state less is known
        let order = order + usize::from(ranking.is_none());
        let derived = !matches!(parameter.value, Value::Constant(_));
        // one that follows from others, and one without effect, only if there is nothing else
        let order = order + 10 * usize::from(derived) + 100 * usize::from(idle);
        (suits && !fixed).then_some(Choice { id, order, way })
    };
    network.parameter_ids().filter_map(of).min_by_key(|choice| choice.order)
}

fn effect_of(ranking: &Ranking, id: ParameterId) -> Option<&Influence> {
    let of = |influence: &&Influence| influence.of == Item::Parameter(id) && has_effect(influence);
    ranking.parameters.iter().find(of)
}

/// The place of a type among parameters to size, and the direction that costs less.
fn usual(ty: Type) -> (usize, Way) {
    const LESS: [Dimension; 5] = [
        Dimension::CONDUCTANCE,
        Dimension::FILM_COEFFICIENT,
        Dimension::MASS_FLOW,
        Dimension::VOLUME_FLOW,
        Dimension::AREA,
    ];
    const MORE: [Dimension; 2] = [Dimension::RESISTANCE, Dimension::AREA_RESISTANCE];
    const LOADS: [Dimension; 3] =
        [Dimension::POWER, Dimension::HEAT_FLUX, Dimension::POWER_DENSITY];
    match ty.dimension {
        _ if ty.absolute => (4, Way::Most),
        own if LESS.contains(&own) => (0, Way::Least),
        own if MORE.contains(&own) => (0, Way::Most),
        own if LOADS.contains(&own) => (2, Way::Most),
        own if own.is_none() => (3, Way::Least),
        _ => (1, Way::Least),
    }
}

/// The state that an example is about: the steady state, or the highest temperatures of the run.
struct Known {
    node: NodeId,
    /// The highest temperature in K.
    temperature: f64,
    ranking: Option<Ranking>,
    limits: Vec<LimitResult>,
    /// True if the results are those of the run.
    over_run: bool,
}

impl Known {
    fn of(input: &Input) -> Option<Self> {
        let network = &input.netlist.network;
        if network.nodes().len() > MOST_NODES {
            return None;
        }
        let system = ThermalSystem::assemble(network).ok()?;
        let start = input.netlist.run.as_ref().map_or(0.0, |run| run.start);
        let steady = lptn_analysis::steady(&system, start).ok().map(|found| found.result);
        let over_run = varies(input) || (input.netlist.run.is_some() && steady.is_none());
        let ranking = steady.as_ref().and_then(|state| Ranking::steady(&system, state, None).ok());
        let of_steady = || {
            let ranking = ranking.as_ref()?;
            let limits = LimitResult::of_steady(network, steady.as_ref()?).unwrap_or_default();
            Some((ranking.node, ranking.temperature, limits))
        };
        let (node, temperature, limits) =
            if over_run { peak(&system, input)? } else { of_steady()? };
        // a change of the state at the start need not change the run
        let ranking =
            ranking.filter(|ranking| !over_run || ranking.parameters.iter().any(has_effect));
        Some(Self { node, temperature, ranking, limits, over_run })
    }

    /// A limit of the file that is kept now, so that the study has an answer; else the next round
    /// temperature above the highest one.
    fn requirement(&self, input: &Input) -> String {
        let network = &input.netlist.network;
        let kept = |result: &&LimitResult| result.margin >= 0.0;
        let of_file =
            self.limits.iter().filter(kept).find_map(|result| written(input, result.limit));
        let node = &network.nodes()[self.node.index()].name;
        let above = || format!("{node}.T <= {} [degC]", rounded(self.temperature));
        of_file.unwrap_or_else(above)
    }
}

/// The hottest node of the run, its highest temperature, and the limits there.
fn peak(system: &ThermalSystem, input: &Input) -> Option<(NodeId, f64, Vec<LimitResult>)> {
    let network = &input.netlist.network;
    let settings = input.netlist.run.as_ref()?;
    let nodes: Vec<NodeId> = network.thermal_nodes().collect();
    let run = RunAnalysis::of(network, settings).bare().watching(nodes.iter().copied());
    let steps = Cell::new(0);
    let solved = run.solve(system, &mut |_| {
        steps.set(steps.get() + 1);
        if steps.get() > MOST_STEPS { Proceed::Interrupt } else { Proceed::Continue }
    });
    let solution = solved.ok()?.result;
    let peaks = nodes.iter().zip(solution.watched()).map(|(node, watched)| (*node, watched.peak.0));
    let (node, temperature) = peaks.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let limits = solution.limits().iter().map(LimitResult::of_run).collect();
    Some((node, temperature, limits))
}

/// A limit as a comparison, if it compares one result of every moment with a number.
fn written(input: &Input, id: LimitId) -> Option<String> {
    let network = &input.netlist.network;
    let Limit { text, value, bound, ty, over_time, compares, .. } = &network.limits()[id.index()];
    if *compares || over_time.iter().any(Option::is_some) {
        return None;
    }
    let value = value.at(&mut network.evaluation()).ok()?;
    let unit = match ty.absolute {
        true => input.netlist.temperature_unit.clone(),
        false => Unit { text: ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty: *ty },
    };
    let sign = if *bound == Bound::Below { "<=" } else { ">=" };
    let number = significant(unit.from_si(value), 6);
    let literal = if ty.is_scalar() { number } else { format!("{number} [{}]", unit.text) };
    Some(format!("{text} {sign} {literal}"))
}
