//! Doubts in the error of a run and in its energy balance.

use lptn_netlist::Diagnostic;
use lptn_network::{Network, list_of_names};
use lptn_report::{duration, significant};
use lptn_solve::{Solution, Unbounded, Undecided};

/// Doubts in the numbers of a run: its error, unless that is proven, and its balance.
pub fn doubts(solution: &Solution, proven: bool) -> Vec<Diagnostic> {
    let warning = |code, text: Option<String>| text.map(|text| Diagnostic::warning(code, text));
    let why = solution.why_unbounded().filter(|_| !proven);
    let bound = unbounded(solution.network(), why.as_ref());
    bound.into_iter().chain(warning("run::weak_ledger", weak_ledger(solution))).collect()
}

/// A doubt in the error of a run that its tolerance does not bound.
pub fn unbounded(network: &Network, why: Option<&Unbounded>) -> Option<Diagnostic> {
    Some(Diagnostic::warning("run::error_not_bounded", not_bounded(network, why)?))
}

/// Errors that add up, as a sentence.
pub fn not_bounded(network: &Network, why: Option<&Unbounded>) -> Option<String> {
    let why = match why? {
        Unbounded::NoBoundary(nodes) => {
            let names: Vec<String> =
                nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
            format!("no path leads to a boundary from {}", list_of_names(&names))
        }
        Unbounded::LongMemory { steps } => format!(
            "the network remembers about {} steps of inputs that keep changing; compare with a \
             smaller --tolerance",
            significant(*steps, 1)
        ),
        Unbounded::Grows { factor } => grows(network, *factor),
        Unbounded::Unresolved { at } => format!(
            "a step at {} s passes a bend over temperature that could not be resolved; compare \
             with a smaller --tolerance",
            significant(*at, 6)
        ),
        Unbounded::Switch(undecided) => return Some(at_its_threshold(network, undecided)),
        Unbounded::Switches { count } => {
            format!(
                "each of {count} switches shifts the times of the next ones; compare with a \
                 smaller --tolerance"
            )
        }
    };
    Some(format!("error not bounded by the tolerance: it adds up, because {why}"))
}

/// Errors that grow, with the reasons that the network can have.
fn grows(network: &Network, factor: f64) -> String {
    let adds = network.states().iter().any(|state| !state.balanced);
    let state = if adds { "a state adds errors up, or " } else { "" };
    format!(
        "errors grow by up to a factor of {}, as {state}heat rises faster with temperature than it \
         is removed; compare with a smaller --tolerance",
        significant(factor, 1)
    )
}

/// A switch that the error of the run decides, as a sentence.
fn at_its_threshold(network: &Network, undecided: &Undecided) -> String {
    let Undecided { kind, from, to, switches, error } = undecided;
    let name = kind.name(network);
    let late = duration(to - from, 2);
    let [from, to] = [from, to].map(|time| duration(*time, 4));
    match switches {
        true => format!(
            "`{name}` switches at {to} with an error of up to {late}, as it approaches its \
             threshold slowly: temperatures may err by {} K; compare with a smaller --tolerance",
            significant(*error, 1)
        ),
        false => format!(
            "not determined whether `{name}` switches: from {from} to {to} it is at its \
             threshold, within the error of the run"
        ),
    }
}

/// Message if the bound of the energy balance is too wide to prove anything.
pub fn weak_ledger(solution: &Solution) -> Option<String> {
    const PROOF: f64 = 1e-2;
    let ledger = solution.ledger();
    let weak = ledger.turned_over > 0.0 && ledger.bound > PROOF;
    weak.then(|| {
        let tolerance = significant(solution.tolerance(), 2);
        format!(
            "too little heat is exchanged to check the energy balance at a tolerance of \
             {tolerance} K"
        )
    })
}
