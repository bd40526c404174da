//! Initial temperatures of nodes from a state.

use foldhash::HashSet;
use lptn_data::{Diagnostic, Span};
use lptn_network::{End, Field, Input, Item, Network, NodeId, Temperature};
use lptn_units::{Quantity, Type, suggest};

use super::{ANYWHERE, InitialState};
use crate::elaborate::Elaborated;
use crate::raw::RawEntry;
use crate::run::RunPlan;
use crate::section::NODE;
use crate::state::StateEnd;
use crate::work::Elaboration;

impl<'a> Elaboration<'a> {
    /// The temperature of a node in the state that the run starts from; `None` without such a
    /// state.
    pub(crate) fn start_of(
        &mut self,
        entry: &RawEntry,
        massless: bool,
    ) -> Option<(Input, Option<Span>)> {
        let file = self.state?;
        let kelvin =
            |value| Quantity { value, deviation: None, ty: Type::ABSOLUTE_TEMPERATURE }.into();
        if let Some((value, place)) = file.temperatures.get(&entry.key) {
            return Some((kelvin(value), Some(place.clone())));
        }
        if file.usable && file.problems.is_empty() && !massless {
            let message = format!("the state has no temperature of node `{}`", entry.key);
            let problem = Diagnostic::error("netlist::state_missing_node", message)
                .at(entry.key_span.clone(), "")
                .also(file.state.place.clone(), "the state is read here");
            self.report(problem.help("a state belongs to the network that it was computed with"));
        }
        Some((kelvin(ANYWHERE), None))
    }

    /// Sets the molten share of a node from the state that the run starts from.
    pub(crate) fn molten(&mut self, name: &str, id: NodeId) {
        let share = self.state.and_then(|file| file.melted.get(name));
        if let Some((share, _)) = share.filter(|(share, _)| (0.0..=1.0).contains(share)) {
            self.builder.molten(id, share);
        }
    }

    /// Sets the nodes of grids and imports, which are not in `[node]`: temperatures of the state
    /// replace those of the file. Sets all massless nodes, too.
    pub(crate) fn start_the_others(&mut self) {
        let Some(file) = self.state.filter(|file| file.usable && file.problems.is_empty()) else {
            return;
        };
        let written: HashSet<&str> =
            self.elements(NODE.name).iter().map(|entry| entry.key.as_str()).collect();
        let names: Vec<String> = self.builder.end_names(true).map(str::to_owned).collect();
        let mut missing = Vec::new();
        for (id, name) in self.builder.node_ids().zip(names) {
            let massless = self.builder.is_massless(id);
            if (written.contains(name.as_str()) && !massless) || self.builder.is_state(id) {
                continue;
            }
            match file.temperatures.get(&name) {
                Some((value, _)) => {
                    self.builder.start_at(id, Temperature(value));
                    self.molten(&name, id);
                }
                None if massless => {}
                None => missing.push(name),
            }
        }
        if let Some(first) = missing.first() {
            let more = if missing.len() > 1 {
                format!(" and of {} more", missing.len() - 1)
            } else {
                String::new()
            };
            let message = format!("the state has no temperature of node `{first}`{more}");
            let problem = Diagnostic::error("netlist::state_missing_node", message);
            let problem = problem.at(file.state.place.clone(), "the state is read here");
            self.report(problem.help("a state belongs to the network that it was computed with"));
        }
    }

    /// Reports the errors of the state that the run starts from, and its names that are not in the
    /// network.
    pub(crate) fn check_state(&mut self) {
        let Some(file) = self.state else { return };
        self.problems.extend(file.problems.iter().cloned());
        let node = |name: &str| matches!(self.builder.end(name), Some(End::Node(_)));
        let lists = [&file.temperatures, &file.melted].into_iter().flat_map(|numbers| &numbers.all);
        let mut unknown = Vec::new();
        for (name, _, place) in lists.filter(|(name, ..)| !node(name)) {
            let nodes = self.elements(NODE.name).iter().map(|entry| entry.key.as_str());
            let missing = nodes.filter(|name| file.temperatures.get(name).is_none());
            unknown.push(file.unknown(("node", name, place), suggest(name, missing)));
        }
        self.problems.extend(unknown);
        self.check_states(file);
        self.check_controls(file);
    }

    /// Notes the place of `T0` of a node that the state replaces.
    pub(crate) fn place_in_state(&mut self, id: NodeId, place: Option<Span>) {
        if let Some(place) = place {
            self.map.insert(Item::Node(id), Field::Initial, place);
        }
    }
}

impl InitialState {
    /// The state of a netlist whose temperatures at the start it replaces.
    pub(crate) fn replacing(self, done: &Elaborated) -> Self {
        Self { without_effect: done.without_effect.clone(), ..self }
    }

    /// Doubt about a parameter that was set without an effect.
    pub(crate) fn idle(&self, name: &str, place: &Span) -> Option<Diagnostic> {
        let is_idle = self.without_effect.iter().any(|other| other == name);
        is_idle.then(|| without_effect("`--set`", name, place))
    }
}

/// Doubt about a value of a parameter that only temperatures use which the state replaces.
pub(crate) fn without_effect(words: &str, name: &str, place: &Span) -> Diagnostic {
    let message = format!(
        "{words} gives `{name}` a value that has no effect: only `T0` reads it, and the run starts \
         from a state"
    );
    let help = "leave `initial` of [run] out to start from `T0`";
    Diagnostic::doubt("netlist::initial_replaces", message, place, help)
}

/// Warnings about the start of a run.
pub(crate) fn warnings(
    state: &InitialState,
    plan: Option<&RunPlan>,
    network: &Network,
) -> Vec<Diagnostic> {
    let Some(plan) = plan else { return Vec::new() };
    let Ok(run) = plan.settings(network) else { return Vec::new() };
    let written = plan.start_place();
    let apart = (run.start - state.time).abs() > 1e-9 * run.start.abs().max(state.time.abs());
    let at = |problem: Diagnostic| problem.at(state.place.clone(), "");
    let mut warnings = Vec::new();
    if apart && (written.is_some() || network.has_time_dependent_inputs()) {
        let message =
            format!("the run starts at {} s, from a state at {} s", run.start, state.time);
        let warning = at(Diagnostic::warning("netlist::initial_time", message));
        let warning = match written {
            Some(place) => warning.also(place.clone(), "`t` begins here"),
            None => warning.note("`t` begins at 0 s, and the inputs depend on it"),
        };
        warnings.push(
            warning.help(format!("to continue from its end write `start = \"{} s\"`", state.time)),
        );
    }
    if state.end != StateEnd::Reached && (apart || written.is_none()) {
        let message = format!(
            "the state is of a run that {} at {} s, before its stop",
            ended(state.end),
            state.time
        );
        warnings.push(
            at(Diagnostic::warning("netlist::initial_unfinished", message))
                .help(format!("to finish that run write `start = \"{} s\"`", state.time)),
        );
    }
    warnings
}

fn ended(end: StateEnd) -> &'static str {
    match end {
        StateEnd::Reached => "ended",
        StateEnd::Interrupted => "was interrupted",
        StateEnd::Failed => "failed",
    }
}
