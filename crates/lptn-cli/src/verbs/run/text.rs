//! The table of a run, its heat and its notes.

use std::borrow::Cow;

use lptn_network::list_of_names;
use lptn_report::{
    Align, Column, Flow, TextTable, WIDTH, balance, decimals, duration, fixed, labelled, significant,
    sparkline,
};
use lptn_solve::{End, NodeSummary, Solution, SteadyError, Summary, Unbounded, first_there};

use super::job::NoSteady;
use super::view::View;
use super::{events, uncertainty, windows};
use crate::console::Console;
use crate::words::{MOST_NODES, counts};

/// Characters of a curve.
const CURVE: usize = 16;

/// A node that varies by less than this, in K, is drawn as flat.
const FLAT: f64 = 1e-3;

/// The result of a run for reading; ends with a line break.
pub(crate) fn summary(view: &View<'_>, console: &Console) -> String {
    let mut nodes = Summary::new(view.solution, view.steady.ok()).nodes;
    nodes.iter_mut().for_each(|node| include_rows(view, node));
    let network = view.solution.network();
    let mut lines = vec![console.title(view.title), counts(network)];
    lines.extend(view.origin.iter().flat_map(|origin| labelled("", &words(origin), WIDTH)));
    lines.push(String::new());
    let temperatures = table(view, &nodes);
    if !temperatures.is_empty() {
        lines.extend(temperatures);
        lines.push(String::new());
    }
    if !view.limits.is_empty() {
        lines.extend(crate::limits::lines(network, view.limits, view.unit));
        lines.push(String::new());
    }
    let uncertain = view.uncertainty.map(|found| uncertainty::text::lines(network, found, view.unit));
    lines.extend(uncertain.into_iter().flatten());
    lines.extend(events::lines(view.solution, (view.settings.start, reached(view))));
    lines.extend(columns(view));
    lines.extend(windows::lines(view.solution.windows(), view.unit));
    for note in notes(view, &nodes) {
        lines.extend(labelled("note: ", &words(&note), WIDTH));
    }
    if lines.last().is_some_and(|line| !line.is_empty()) {
        lines.push(String::new());
    }
    // where a run breaks off, the integrals and the state are not those of one time
    if !matches!(view.solution.end(), End::Failed(_)) {
        lines.extend(heat(view));
        if let Some(balance) = view.solution.balance() {
            lines.push(String::new());
            let times = Some((view.settings.start, reached(view)));
            lines.extend(crate::balance::lines(network, balance, times));
        }
    }
    let label = format!("{:1$}", "lumping:", over(reached(view) - view.settings.start).len() + 2);
    lines.extend(crate::lumping::lines(network, view.lumping, (&label, console.verbose)));
    if console.verbose {
        lines.extend(solver(view));
    }
    lines.join("\n") + "\n"
}

/// Takes in the rows, since a network without state is not watched between them; and a peak that the tolerance
/// cannot tell from the start or from the end is there.
fn include_rows(view: &View<'_>, node: &mut NodeSummary) {
    let values = view.solution.temperature(node.node).unwrap_or_default();
    node.end = values.last().copied().filter(|_| view.solution.end() == End::Reached).unwrap_or(node.end);
    for (&time, &value) in view.solution.times().iter().zip(&values) {
        if value > node.peak.0 {
            node.peak = (value, time);
        }
    }
    let ends = [(node.start, view.settings.start), (node.end, reached(view))];
    node.peak.1 = first_there(node.peak, ends, 10.0 * view.settings.tolerance);
}

fn words(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}

/// The time up to which there are rows: the stop, unless the run ended early.
fn reached(view: &View<'_>) -> f64 {
    match view.solution.end() {
        End::Reached => view.settings.stop,
        End::Interrupted(time) | End::Failed(time) => time,
    }
}

fn table(view: &View<'_>, nodes: &[NodeSummary]) -> Vec<String> {
    if nodes.is_empty() {
        return Vec::new();
    }
    let unit = view.unit;
    let temperatures = nodes.iter().flat_map(|n| [Some(n.start), Some(n.end), Some(n.peak.0), n.steady]);
    let (low, high) = range(temperatures.flatten());
    // what the tolerance cannot tell from rest takes no decimals
    let span = Some(high - low).filter(|span| *span > 10.0 * view.settings.tolerance).unwrap_or(0.0);
    let digits = decimals(span / unit.scale, 3, 1);
    let number = |kelvin: f64| fixed(unit.from_si(kelvin), digits);
    let column = |title: &str, text: &dyn Fn(&NodeSummary) -> String| {
        Column::new(title, Align::Right, nodes.iter().map(text).collect())
    };
    let network = view.solution.network();
    let end = duration(reached(view), 4);
    let names = nodes.iter().map(|n| network.nodes()[n.node.index()].name.clone()).collect();
    let curves = nodes.iter().map(|n| curve(view, n)).collect();
    let curve_title = format!("{} to {end}", start_of_curve(view.settings.start));
    let table = TextTable::new(vec![
        Column::new(format!("T [{}]", unit.text), Align::Left, names),
        column("start", &|n| number(n.start)),
        column(&end, &|n| number(n.end)),
        column("peak", &|n| number(n.peak.0)),
        column("at", &|n| duration(n.peak.1, 3)).optional(),
        column("steady", &|n| n.steady.map_or("-".into(), number)),
        column("95 % after", &|n| time_to_95(view, n)),
        Column::new(curve_title, Align::Left, curves).optional(),
    ]);
    table.lines(WIDTH)
}

/// What is no temperature of a node: every report, the values of grids, and the other columns that were asked for by
/// name.
fn columns(view: &View<'_>) -> Vec<String> {
    let network = view.solution.network();
    let is_report = |name: &str| network.reports().iter().any(|report| report.name == name);
    let is_node = |name: &str| name.strip_suffix(".T").is_some_and(|name| network.node(name).is_ok());
    let of_grids: Vec<String> = network.grid_values().map(|value| value.name(network)).collect();
    let is_of_grid = |name: &str| of_grids.iter().any(|value| value == name);
    let wanted = |name: &str| is_report(name) || is_of_grid(name) || (view.chosen && !is_node(name));
    let all = view.table.columns().get(1..).unwrap_or_default();
    let shown: Vec<_> = all.iter().filter(|column| wanted(&column.name)).take(MOST_NODES).collect();
    if shown.is_empty() {
        return Vec::new();
    }
    type Of<'a> = &'a lptn_solve::Column;
    let cells = |text: &dyn Fn(Of<'_>) -> String| shown.iter().map(|c| text(c)).collect::<Vec<_>>();
    let number = |column: Of<'_>, value: Option<&f64>| {
        let (low, high) = range(column.values.iter().copied());
        let digits = decimals(low.abs().max(high.abs()), 4, 1);
        value.map_or("-".into(), |&value| fixed(value, digits))
    };
    let curve = |c: Of<'_>| sparkline(view.solution.times(), &c.values, CURVE, 0.0);
    let mut lines = TextTable::new(vec![
        Column::new("column", Align::Left, cells(&|c| c.header())),
        Column::new("start", Align::Right, cells(&|c| number(c, c.values.first()))),
        Column::new(duration(reached(view), 4), Align::Right, cells(&|c| number(c, c.values.last()))),
        Column::new("", Align::Left, cells(&curve)).optional(),
    ])
    .lines(WIDTH);
    lines.push(String::new());
    lines
}

fn start_of_curve(start: f64) -> String {
    if start == 0.0 { "0".into() } else { duration(start, 4) }
}

fn curve(view: &View<'_>, node: &NodeSummary) -> String {
    let values = view.solution.temperature(node.node).unwrap_or_default();
    sparkline(view.solution.times(), &values, CURVE, FLAT)
}

fn time_to_95(view: &View<'_>, node: &NodeSummary) -> String {
    match (node.time_to_95, node.reached()) {
        (Some(time), _) => duration(time, 3),
        (None, Some(_)) => format!("> {}", duration(reached(view) - view.settings.start, 3)),
        (None, None) => "-".into(),
    }
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// What the table cannot say.
fn notes(view: &View<'_>, nodes: &[NodeSummary]) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    let network = view.solution.network();
    if nodes.len() < network.nodes().len() && nodes.len() == MOST_NODES {
        let which = if view.steady.is_ok() { "those that get hottest" } else { "the first ones" };
        let all = network.nodes().len();
        notes.push(format!(
            "{} of {all} nodes are shown, {which}; --select 'NAME.T' shows others",
            nodes.len()
        ));
    }
    notes.extend(short_record(nodes));
    match view.steady {
        Err(NoSteady::Inputs) => notes.push("steady is `-`: the inputs change with time".into()),
        Ok(steady) => {
            notes.extend(crate::doubts::others(network, steady, view.unit).map(|found| found.message))
        }
        Err(NoSteady::Network(SteadyError::NoBoundary { .. })) => {}
        Err(NoSteady::Network(error)) => notes.push(format!("steady is `-`: {error}")),
    }
    let reached = view.solution.end() == End::Reached;
    let switched = view.solution.statistics().switched_to_lu.filter(|_| reached);
    notes.extend(switched.map(|time| {
        format!(
            "from {} s on the Newton matrix is unsymmetric: the symmetric one did not converge",
            significant(time, 4)
        )
    }));
    notes.extend(not_bounded(view.solution));
    notes.extend(weak_ledger(view.solution));
    notes
}

/// The record ends before some node has come near its steady state.
fn short_record(nodes: &[NodeSummary]) -> Option<String> {
    let short = nodes.iter().filter(|n| n.time_to_95.is_none()).filter_map(NodeSummary::reached);
    let (least, most) = range(short);
    if least > most {
        return None;
    }
    let (least, most) = (fixed(100.0 * least, 0), fixed(100.0 * most, 0));
    let share = if least == most { format!("{least} %") } else { format!("{least} to {most} %") };
    let rises = nodes.iter().all(|n| n.steady.is_some_and(|steady| steady >= n.start));
    let way = if rises { "rise" } else { "way" };
    Some(format!("record ends at {share} of the {way} to steady"))
}

/// Errors that add up.
pub(crate) fn not_bounded(solution: &Solution) -> Option<String> {
    let network = solution.network();
    let why = match solution.why_unbounded()? {
        Unbounded::NoBoundary(nodes) => {
            let names: Vec<String> =
                nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
            format!("no path leads to a boundary from {}", list_of_names(&names))
        }
        Unbounded::LongMemory { steps } => format!(
            "the network remembers about {} steps of inputs that keep changing; compare with a smaller --tolerance",
            significant(steps, 1)
        ),
        Unbounded::Switches { count } => {
            format!(
                "each of {count} switches shifts the times of the next ones; compare with a smaller --tolerance"
            )
        }
    };
    Some(format!("error not bounded by the tolerance: it adds up, because {why}"))
}

/// A bound so wide that the books would close on nonsense too.
pub(crate) fn weak_ledger(solution: &Solution) -> Option<String> {
    const PROOF: f64 = 1e-2;
    let ledger = solution.ledger();
    let weak = ledger.turned_over > 0.0 && ledger.bound > PROOF;
    weak.then(|| {
        let tolerance = significant(solution.tolerance(), 2);
        format!(
            "so little heat is turned over that at a tolerance of {tolerance} K the balance proves nothing"
        )
    })
}

/// The label of the heat, with which those below it line up.
fn over(length: f64) -> String {
    format!("heat over {}:", duration(length, 4))
}

fn heat(view: &View<'_>) -> Vec<String> {
    heat_over(view.solution, reached(view) - view.settings.start)
}

/// The heat of a run of this length in s, and how far the books close.
pub(crate) fn heat_over(solution: &Solution, length: f64) -> Vec<String> {
    let (network, ledger) = (solution.network(), solution.ledger());
    let sources = network.sources().iter().map(|s| s.name()).zip(&ledger.sources);
    let boundaries = network.boundaries().iter().map(|b| Cow::from(&b.name)).zip(&ledger.boundaries);
    let flow = |(name, &heat): (Cow<'_, str>, &f64)| Flow { name: name.into_owned(), heat };
    let mut flows: Vec<Flow> = sources.chain(boundaries).map(flow).collect();
    // one stream hands on what another brings: only all of them together say something
    flows.push(Flow { name: "streams".into(), heat: ledger.streams.iter().sum() });
    let pieces = balance(&flows, ledger.stored.iter().sum(), ledger.turned_over);
    let over = over(length);
    let width = over.len() + 2;
    let mut lines = labelled(&format!("{over:width$}"), &pieces, WIDTH);
    let balance = match ledger.relative_residual() {
        Some(residual) => {
            let (residual, bound) = (significant(residual.abs(), 2), significant(ledger.bound, 2));
            format!("closes to {residual} of the heat turned over (allowed: {bound})")
        }
        None => format!("residual {} J; no heat was turned over", significant(ledger.residual(), 2)),
    };
    lines.extend(labelled(&format!("{:width$}", "balance:"), &words(&balance), WIDTH));
    lines
}

fn solver(view: &View<'_>) -> Vec<String> {
    let statistics = view.solution.statistics();
    let repeated = statistics.error_test_failures + statistics.newton_failures;
    let pieces = [
        format!("tolerance {} K,", significant(view.settings.tolerance, 3)),
        format!("{} steps,", statistics.steps),
        format!("{repeated} repeated,"),
        format!("{} Newton iterations,", statistics.newton_iterations),
        format!("{} factorisations", statistics.factorizations),
    ];
    labelled("solver: ", &pieces, WIDTH)
}
