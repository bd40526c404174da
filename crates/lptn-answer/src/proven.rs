//! Proven bounds on the errors of a run.

use lptn_analysis::LimitResult;
use lptn_netlist::Diagnostic;
use lptn_network::{Item, Network, NodeId, list_of};
use lptn_report::rounded_up as up;
use lptn_solve::{NodeSummary, Selection, Solution, Uncertified};
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::scale;

/// True if there are bounds.
pub(crate) fn is(solution: &Solution) -> bool {
    solution.certificate().is_some_and(Result::is_ok)
}

/// The bound of a node over the run, and of its peak; empty if there is none.
pub(crate) fn cell((solution, unit): (&Solution, &Unit), node: &NodeSummary) -> String {
    let peak = solution.peak_bound(node.node, node.peak.0).unwrap_or(0.0);
    let bound = solution.largest_bound(node.node);
    bound.map_or_else(String::new, |bound| up(bound.max(peak) / unit.scale))
}

/// The largest bounds of all nodes and of all heats as a sentence; `None` if there are none.
pub(crate) fn claim(solution: &Solution) -> Option<String> {
    let bounds = solution.recorded().iter().filter_map(|id| solution.largest_bound(*id));
    let most = bounds.max_by(f64::total_cmp).filter(|_| is(solution))?;
    let heat = energies(solution).into_iter().filter_map(|(_, bound)| bound);
    let heat = heat.max_by(f64::total_cmp).map_or_else(String::new, |bound| {
        format!(", and the heat of each source and boundary over the run within {} J", up(bound))
    });
    let of = format!("every temperature is within {} K of the exact solution", up(most));
    Some(format!("proven: {of}{heat}"))
}

/// Each source and boundary with the bound in J on its heat over the run, if there is one.
fn energies(solution: &Solution) -> Vec<(String, Option<f64>)> {
    let network = solution.network();
    let sources = network
        .heat_sources()
        .map(|id| (network.name_of(Item::Source(id)).into_owned(), solution.source_bound(id)));
    let boundaries = network
        .boundary_ids()
        .map(|id| (network.boundaries()[id.index()].name.clone(), solution.boundary_bound(id)));
    sources.chain(boundaries).collect()
}

/// The bounds of the heat of sources and boundaries over the run, in J.
pub(crate) fn heat_members(solution: &Solution) -> Option<Value> {
    is(solution).then_some(())?;
    let of = |(name, bound): (String, Option<f64>)| {
        (name, bound.map_or(Value::Null, |bound| json!({ "value": bound, "unit": "J" })))
    };
    Some(Value::Object(energies(solution).into_iter().map(of).collect()))
}

/// The doubt that a bound was asked for and not found.
pub(crate) fn unproven(solution: &Solution) -> Option<Diagnostic> {
    Some(doubt(solution.certificate()?.as_ref().err()?))
}

/// The same for a reason.
pub(crate) fn doubt(reason: &Uncertified) -> Diagnostic {
    let text = format!("the errors are not proven: {reason}");
    Diagnostic::warning(reason.code(), text).help(reason.help())
}

/// The meaning of the bounds of a steady state.
pub(crate) fn of_steady(bounds: &[f64]) -> String {
    let most = up(bounds.iter().copied().fold(0.0, f64::max));
    format!(
        "proven error: a steady state of the network is within {most} K of every temperature, and \
         no other one is"
    )
}

/// The bounds of a steady state, as differences of temperatures in `unit`.
pub(crate) fn steady_members(network: &Network, bounds: &[f64], unit: &Unit) -> Value {
    let named = network.nodes().iter().zip(bounds);
    let errors: Map<String, Value> = named
        .map(|(node, bound)| (node.name.clone(), scale::of_difference(*bound, unit)))
        .collect();
    Value::Object(errors)
}

/// Meaning of the bounds, the verdicts that they prove, and the results that have none.
pub(crate) fn notes(solution: &Solution, selection: &Selection) -> Vec<String> {
    let meaning = "proven error: each temperature of the run is at most this far from the exact \
        solution of the network, at every time";
    let windows = solution.windows().iter().map(|window| format!("the window {}", window.name));
    notes_of(solution, meaning, without(solution, selection).into_iter().chain(windows).collect())
}

/// The same for a periodic steady state; the reason is among its doubts.
pub(crate) fn notes_of_cycle(solution: &Solution, selection: &Selection) -> Vec<String> {
    if unproven(solution).is_some() {
        return Vec::new();
    }
    let meaning = "proven error: a periodic steady state of the network exists, and each \
        temperature is at most this far from it, at every time";
    let mut notes = notes_of(solution, meaning, without(solution, selection));
    notes.extend(is(solution).then(|| {
        "means and extremes of heat flows, reports and signals have no proven error".to_owned()
    }));
    notes
}

fn notes_of(solution: &Solution, meaning: &str, without: Vec<String>) -> Vec<String> {
    if let Some(unproven) = unproven(solution) {
        return vec![unproven.message];
    }
    if !is(solution) {
        return Vec::new();
    }
    let mut notes = vec![meaning.to_owned()];
    notes.extend(heat_note(solution));
    let limits: Vec<LimitResult> = solution.limits().iter().map(LimitResult::of_run).collect();
    notes.extend(verdicts(solution.network(), &limits));
    notes.extend(
        (!without.is_empty())
            .then(|| format!("without a proven error: {}", list_of(&without, "results"))),
    );
    notes
}

fn heat_note(solution: &Solution) -> Option<String> {
    let bounds = energies(solution).into_iter().filter_map(|(name, bound)| Some((name, bound?)));
    let (name, most) = bounds.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let most = up(most);
    Some(format!("proven error of the heat over the run: at most {most} J, that of `{name}`"))
}

/// The limits whose verdicts are proven, and those that the bounds do not decide.
pub(crate) fn verdicts(network: &Network, all: &[LimitResult]) -> Vec<String> {
    let names = |wanted: Option<bool>| -> Option<String> {
        let these = all.iter().filter(|found| !found.is_open() && found.is_proven() == wanted);
        let name = |found: &LimitResult| network.limits()[found.limit.index()].name.clone();
        let names: Vec<String> = these.map(name).collect();
        (!names.is_empty()).then(|| list_of(&names, "limits"))
    };
    let proven = names(Some(true))
        .map(|names| format!("proven verdicts: {names}: the exact solution has the same"));
    let open = names(Some(false)).map(|names| {
        format!("the proven errors do not decide {names}: choose a smaller --tolerance")
    });
    let none = names(None).map(|names| {
        format!("not proven: the verdicts of {names}, whose quantities have no proven error")
    });
    proven.into_iter().chain(open).chain(none).collect()
}

/// The columns, numbers over time and heats without a bound.
fn without(solution: &Solution, selection: &Selection) -> Vec<String> {
    let reports = &solution.network().reports();
    let numbers = solution.reports_over_time().iter().filter(|seen| seen.bound.is_none());
    let numbers = numbers.map(|seen| reports[seen.report.index()].name.clone());
    let heats = energies(solution).into_iter().filter(|(_, bound)| bound.is_none());
    let heats = heats.map(|(name, _)| format!("the heat of {name} over the run"));
    solution.without_bounds(selection).into_iter().chain(numbers).chain(heats).collect()
}

/// The bounds of all recorded nodes over the run, as differences of temperatures in `unit`.
pub(crate) fn members(solution: &Solution, unit: &Unit) -> Option<Value> {
    is(solution).then_some(())?;
    let network = solution.network();
    let bound = |id: &NodeId| {
        let bound = solution.largest_bound(*id)?;
        Some((network.nodes()[id.index()].name.clone(), scale::of_difference(bound, unit)))
    };
    let errors: Map<String, Value> = solution.recorded().iter().filter_map(bound).collect();
    Some(Value::Object(errors))
}
