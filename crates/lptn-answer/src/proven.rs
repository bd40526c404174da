//! Proven bounds on the errors of a run.

use lptn_analysis::LimitResult;
use lptn_netlist::Diagnostic;
use lptn_network::{Network, NodeId, list_of_names};
use lptn_report::significant;
use lptn_solve::{Solution, Uncertified};
use serde_json::{Map, Value, json};

/// Digits of a bound.
const DIGITS: usize = 2;

/// A bound with its last digit rounded up.
fn up(bound: f64) -> String {
    let mut text = significant(bound, DIGITS);
    if text.parse::<f64>().is_ok_and(|shown| shown < bound) {
        // half of the last digit, and as much as its rounding
        text = significant(bound * (1.0 + 0.051), DIGITS);
    }
    text
}

/// True if there are bounds.
pub(crate) fn is(solution: &Solution) -> bool {
    solution.certificate().is_some_and(Result::is_ok)
}

/// The bound of a node over the run; empty if there is none.
pub(crate) fn cell(solution: &Solution, node: NodeId) -> String {
    solution.largest_bound(node).map_or_else(String::new, up)
}

/// The largest bound of all nodes as a sentence; `None` if there are none.
pub(crate) fn claim(solution: &Solution) -> Option<String> {
    let bounds = solution.recorded().iter().filter_map(|id| solution.largest_bound(*id));
    let most = bounds.max_by(f64::total_cmp).filter(|_| is(solution))?;
    Some(format!("proven: every temperature is within {} K of the exact solution", up(most)))
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

/// The bounds of a steady state, in K.
pub(crate) fn steady_members(network: &Network, bounds: &[f64]) -> Value {
    let named = network.nodes().iter().zip(bounds);
    let errors: Map<String, Value> = named
        .map(|(node, bound)| (node.name.clone(), json!({ "value": bound, "unit": "K" })))
        .collect();
    Value::Object(errors)
}

/// Meaning of the bounds, and the verdicts that they prove.
pub(crate) fn notes(solution: &Solution) -> Vec<String> {
    if let Some(unproven) = unproven(solution) {
        return vec![unproven.message];
    }
    if !is(solution) {
        return Vec::new();
    }
    let network = solution.network();
    let meaning = "proven error: each temperature of the run is at most this far from the exact \
        solution of the network, at every time";
    let judged: Vec<(bool, String)> = solution
        .limits()
        .iter()
        .map(LimitResult::of_run)
        .filter_map(|found| Some((is_proven(solution, &found)?, name(network, &found))))
        .collect();
    let of = |wanted: bool| -> Vec<String> {
        let these = judged.iter().filter(|(proven, _)| *proven == wanted);
        these.map(|(_, name)| name.clone()).collect()
    };
    let proven = Some(of(true)).filter(|names| !names.is_empty());
    let open = Some(of(false)).filter(|names| !names.is_empty());
    let proven = proven.map(|names| {
        format!(
            "proven verdicts: {}, whose margins are larger than the errors",
            list_of_names(&names)
        )
    });
    let open = open.map(|names| {
        format!(
            "the proven errors do not decide {}: choose a smaller --tolerance",
            list_of_names(&names)
        )
    });
    [meaning.to_owned()].into_iter().chain(proven).chain(open).collect()
}

fn name(network: &Network, found: &LimitResult) -> String {
    network.limits()[found.limit.index()].name.clone()
}

/// True if the margin of a limit of one temperature is larger than its error; `None` for other
/// limits.
fn is_proven(solution: &Solution, found: &LimitResult) -> Option<bool> {
    let network = solution.network();
    let limit = &network.limits()[found.limit.index()];
    let node = network.node(limit.text.strip_suffix(".T")?).ok()?;
    let bound = solution.largest_bound(node)?;
    (!found.is_open()).then(|| found.margin.abs() > bound + found.open)
}

/// The bounds of all recorded nodes over the run, in K.
pub(crate) fn members(solution: &Solution) -> Option<Value> {
    is(solution).then_some(())?;
    let network = solution.network();
    let bound = |id: &NodeId| {
        let bound = solution.largest_bound(*id)?;
        Some((network.nodes()[id.index()].name.clone(), json!({ "value": bound, "unit": "K" })))
    };
    let errors: Map<String, Value> = solution.recorded().iter().filter_map(bound).collect();
    Some(Value::Object(errors))
}
