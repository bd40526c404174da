//! A run as a page: the table of a run, its heat and its notes, and its object.

use std::borrow::Cow;
use std::io;

use lptn_graph::series;
use lptn_network::End;
use lptn_plot::Figure;
use lptn_report::{
    Clock, Flow, Json, Page, Report, Rows, Text, TextTable, decimals, fixed, rounded_up,
    significant, sparkline,
};
use lptn_solve::{
    Column, Method, NodeSummary, RunStatus, Solution, SteadyError, Summary, first_there,
};
use lptn_study::{RunEnd, StatisticsRecord};

use super::answer::RunAnswer;
use super::task::NoSteady;
use super::{events, state, uncertainty, windows};
use crate::balance;
use crate::bound::{not_bounded, weak_ledger};
use crate::families::Row;
use crate::lumping::Detail;
use crate::messages;
use crate::steady::others;
use crate::words::{MOST_NODES, difference, symbol};
use crate::{families, limits, lumping, over_time, proven};

/// Characters of a curve.
const CURVE: usize = 16;

/// A node that varies by less than this, in K, is drawn as flat.
const FLAT: f64 = 1e-3;

impl Page for RunAnswer {
    fn text(&self) -> Text {
        let mut nodes = Summary::new(&self.solution, self.steady.as_ref().ok()).nodes;
        nodes.iter_mut().for_each(|node| include_rows(self, node));
        let (network, span) = (self.solution.network(), (self.task.settings.start, reached(self)));
        let mut text = self.task.input.begun();
        if let Some(origin) = state::origin(&self.task.input) {
            text.sentence("", &origin);
        }
        if !nodes.is_empty() {
            text.section().table(temperatures(self, &nodes));
        }
        limits::section(&mut text, &self.judgement(&self.limits()));
        if let Some(study) = self.uncertainty() {
            let of = (network, self.folds());
            uncertainty::text::sections(&mut text, of, (study, &self.task.unit));
        }
        events::section(&mut text, (&self.solution, self.folds()), span, self.task.clock);
        columns(self, &mut text);
        let length = self.task.clock.text(span.1 - span.0, 4);
        self.over_time(&mut text, &format!("over {length}"));
        let shown = (&self.task.unit, self.task.clock);
        windows::sections(&mut text, (&self.solution, self.folds()), shown);
        let uncertain = |study| uncertainty::text::notes(network, study, &self.task.unit);
        text.section().notes(self.uncertainty().into_iter().flat_map(uncertain));
        text.notes(notes(self, &nodes)).section();
        // if a run breaks off, the integrals and the state are not those of one time
        if !matches!(self.solution.end(), RunStatus::Failed(_)) {
            let over = (span.1 - span.0, self.task.clock);
            heat_over(&mut text, (&self.solution, self.folds()), over);
            if let Some(of) = self.solution.balance() {
                balance::section(&mut text, network, (of, Some(span)));
            }
        }
        let width = over(span.1 - span.0, self.task.clock).len() + 2;
        let label = |word: &str| format!("{word:width$}");
        lumping::lines(&mut text, network, (&self.lumping, &label("lumping:"), self.task.detail));
        text.labelled(&label("solver:"), solver(self));
        text
    }

    fn rows(&self) -> Rows<'_> {
        match self.uncertainty() {
            Some(study) => self.bands(study).into(),
            None => Rows::Table(self.shown_table()),
        }
    }

    fn figures(&self) -> Vec<Figure> {
        let tornado = |study: &uncertainty::Study| {
            uncertainty::figure::tornado((self.solution.network(), &self.task.unit), &study.found)
        };
        self.uncertainty().and_then(tornado).into_iter().chain(self.figure().apart()).collect()
    }

    fn more(&self) -> Report {
        self.report(true)
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (network, unit) = (self.solution.network(), &self.task.unit);
        self.task.input.head(json, &[self.bounds(), self.found()].concat())?;
        json.table(&self.shown_table())?;
        json.member("events", &events::json(&self.solution))?;
        json.member("ledger", &self.ledger())?;
        json.optional("proven", proven::members(&self.solution, unit))?;
        json.optional("proven_heat", proven::heat_members(&self.solution))?;
        let uncertain = |study| uncertainty::files::json(network, study, unit);
        let windowed = !self.task.settings.windows.is_empty();
        json.optional("limits", limits::members(network, &self.limits(), unit))?;
        json.optional("out_of_range", self.out_of_range())?;
        json.optional("uncertainty", self.uncertainty().map(uncertain))?;
        let reports = over_time::members(network, self.solution.reports_over_time(), unit);
        json.optional("reports", reports)?;
        let windows = || windows::members(&self.solution, unit);
        json.optional("windows", windowed.then(windows))?;
        json.optional("balance", self.solution.balance().map(|of| balance::json(network, of)))?;
        json.member("lumping", &lumping::json(network, &self.lumping))?;
        json.member("statistics", &StatisticsRecord::new(&self.solution))?;
        let end = |message| RunEnd::of(&self.solution, self.task.settings.stop, Some(message));
        json.optional("end", self.ended_early().map(end))?;
        let Some(failure) = self.failed() else { return Ok(()) };
        let errors = messages::list(&failure.files, &failure.diagnostics);
        messages::failed(json, failure.exit, &errors)
    }
}

/// Includes the rows, since a network without state is not watched between them.
/// A peak within 10 tolerances of the start or the end is taken to be there.
fn include_rows(of: &RunAnswer, node: &mut NodeSummary) {
    let values = of.solution.temperature(node.node).unwrap_or_default();
    node.end = values
        .last()
        .copied()
        .filter(|_| of.solution.end() == RunStatus::Reached)
        .unwrap_or(node.end);
    for (&time, &value) in of.solution.times().iter().zip(&values) {
        if value > node.peak.0 {
            node.peak = (value, time);
        }
    }
    let ends = [(node.start, of.task.settings.start), (node.end, reached(of))];
    node.peak.1 = first_there(node.peak, ends, 10.0 * of.task.settings.tolerance);
}

/// The time up to which there are rows: the stop, unless the run ended early.
fn reached(of: &RunAnswer) -> f64 {
    match of.solution.end() {
        RunStatus::Reached => of.task.settings.stop,
        RunStatus::Interrupted(time) | RunStatus::Failed(time) => time,
    }
}

fn temperatures(of: &RunAnswer, nodes: &[NodeSummary]) -> TextTable {
    let (unit, settings) = (&of.task.unit, &of.task.settings);
    let temperatures =
        nodes.iter().flat_map(|n| [Some(n.start), Some(n.end), Some(n.peak.0), n.steady]);
    let (low, high) = range(temperatures.flatten());
    // a span of up to 10 tolerances takes no decimals
    let span = Some(high - low).filter(|span| *span > 10.0 * settings.tolerance).unwrap_or(0.0);
    let digits = decimals(span / unit.scale, 3, 1);
    let number = |kelvin: f64| fixed(unit.from_si(kelvin), digits);
    let network = of.solution.network();
    let clock = of.task.clock;
    let end = clock.text(reached(of), 4);
    let name = |n: &NodeSummary| (network.nodes()[n.node.index()].name.clone(), 0);
    let rows = families::folded(nodes.to_vec(), of.folds(), name, |n| n.peak.0);
    let table = TextTable::of(&rows).left(format!("T [{}]", unit.text), |row| row.name.as_str());
    let table = families::members(table, &rows, "hottest")
        .right("start", |row| number(row.item.start))
        .right(end.as_str(), |row| number(row.item.end))
        .right("peak", |row| row.range(|node| node.peak.0, number))
        .right("at", |row| clock.text(row.item.peak.1, 3))
        .optional();
    let table = match proven::is(&of.solution) {
        true => table.right(format!("proven error [{}]", difference(unit)), |row| {
            proven::cell((&of.solution, unit), &row.item)
        }),
        false => table,
    };
    table
        .right("steady", |row| row.item.steady.map_or("-".into(), number))
        .right("95 % after", |row| time_to_95(of, &row.item))
        .left(format!("{} to {end}", start_of_curve(settings.start, clock)), |row| {
            curve(of, &row.item)
        })
        .inked(|row| series(network, End::Node(row.item.node)).filter(|_| row.others.is_empty()))
        .optional()
        .into()
}

/// Columns other than temperatures of nodes: reports, states, the values of grids, and columns
/// that were requested by name.
fn columns(of: &RunAnswer, text: &mut Text) {
    let network = of.solution.network();
    let is_report = |name: &str| network.reports().iter().any(|report| report.name == name);
    let is_node =
        |name: &str| name.strip_suffix(".T").is_some_and(|name| network.node(name).is_ok());
    let of_grids: Vec<String> = network.grid_values().map(|value| value.name(network)).collect();
    let is_of_grid = |name: &str| of_grids.iter().any(|value| value == name);
    let is_state = |name: &str| network.state(name).is_some();
    let is_bound = |name: &str| name.ends_with(".bound");
    let wanted = |name: &str| {
        is_report(name)
            || is_state(name)
            || is_of_grid(name)
            || (of.task.chosen && !is_node(name) && !is_bound(name))
    };
    let all = of.table.columns().get(1..).unwrap_or_default();
    let shown = all.iter().filter(|column| wanted(&column.name)).collect();
    type Of<'a> = &'a Column;
    let last = |column: &Of<'_>| column.values.last().copied().unwrap_or(f64::NAN);
    let named = |column: &Of<'_>| (column.name.clone(), 0);
    let mut rows: Vec<Row<Of<'_>>> = families::folded(shown, of.folds(), named, last);
    rows.truncate(MOST_NODES);
    if rows.is_empty() {
        return;
    }
    let number = |column: Of<'_>, value: f64| {
        let (low, high) = range(column.values.iter().copied());
        let digits = decimals(low.abs().max(high.abs()), 4, 1);
        if value.is_nan() { "-".into() } else { fixed(value, digits) }
    };
    let first = |column: &Of<'_>| column.values.first().copied().unwrap_or(f64::NAN);
    let table = TextTable::of(&rows)
        .left("column", |row| format!("{} [{}]", row.name, symbol(&row.item.unit)));
    let table = families::members(table, &rows, "largest")
        .right("start", |row| number(row.item, first(&row.item)))
        .right(of.task.clock.text(reached(of), 4), |row| {
            row.range(last, |value| number(row.item, value))
        })
        .left("", |row| sparkline(of.solution.times(), &row.item.values, CURVE, 0.0))
        .optional();
    let table = match proven::is(&of.solution) {
        true => table.right("proven error", |row| bound_of(all, row)),
        false => table,
    };
    text.section().table(table);
}

/// The largest bound of a column in the rows, that of all members of a family.
fn bound_of(all: &[Column], row: &Row<&Column>) -> String {
    let bound = |column: &&Column| {
        let values = &lptn_report::bound_of(column, all)?.values;
        values.iter().copied().max_by(f64::total_cmp).filter(|bound| !bound.is_nan())
    };
    let bounds: Option<Vec<f64>> = row.all().map(bound).collect();
    let most = bounds.and_then(|bounds| bounds.into_iter().max_by(f64::total_cmp));
    most.map_or_else(|| "-".to_owned(), rounded_up)
}

fn start_of_curve(start: f64, clock: Clock) -> String {
    if start == 0.0 { "0".into() } else { clock.text(start, 4) }
}

fn curve(of: &RunAnswer, node: &NodeSummary) -> String {
    let values = of.solution.temperature(node.node).unwrap_or_default();
    sparkline(of.solution.times(), &values, CURVE, FLAT)
}

fn time_to_95(of: &RunAnswer, node: &NodeSummary) -> String {
    match (node.time_to_95, node.reached()) {
        (Some(time), _) => of.task.clock.text(time, 3),
        (None, Some(_)) => {
            format!("> {}", of.task.clock.text(reached(of) - of.task.settings.start, 3))
        }
        (None, None) => "-".into(),
    }
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// Notes on everything that the table leaves out.
fn notes(of: &RunAnswer, nodes: &[NodeSummary]) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    let network = of.solution.network();
    let all = network.nodes().len() - network.states().len();
    if nodes.len() < all && nodes.len() == MOST_NODES {
        let which = if of.steady.is_ok() { "those that get hottest" } else { "the first ones" };
        notes.push(format!(
            "{} of {all} nodes are shown, {which}; --select 'NAME.T' shows others",
            nodes.len()
        ));
    }
    notes.extend(short_record(nodes));
    match &of.steady {
        Err(NoSteady::NotShown) => {}
        Err(NoSteady::Inputs) => notes.push("steady is `-`: the inputs change with time".into()),
        Ok(steady) => {
            notes.extend(others(network, steady, &of.task.unit).map(|found| found.message))
        }
        Err(NoSteady::Network(SteadyError::NoBoundary { .. })) => {}
        Err(NoSteady::Network(error)) => notes.push(format!("steady is `-`: {error}")),
    }
    let reached = of.solution.end() == RunStatus::Reached;
    let switched = of.solution.statistics().switched_to_lu.filter(|_| reached);
    notes.extend(switched.map(|time| {
        format!(
            "from {} s on the Newton matrix is unsymmetric: the symmetric one did not converge",
            significant(time, 4)
        )
    }));
    notes.extend(proven::notes(&of.solution, &of.task.selection));
    let unbounded = of.solution.trust.unbounded.as_ref().filter(|_| !proven::is(&of.solution));
    notes.extend(not_bounded(of.solution.network(), unbounded));
    notes.extend(weak_ledger(&of.solution));
    notes
}

/// Note that the run ends before some node is near its steady state.
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

/// The label of the heat, with which those below it line up.
fn over(length: f64, clock: Clock) -> String {
    format!("heat over {}:", clock.text(length, 4))
}

/// The heat of a run of this length in s, and the residual of its energy balance.
pub(crate) fn heat_over(
    text: &mut Text,
    (solution, fold): (&Solution, bool),
    (length, clock): (f64, Clock),
) {
    let (network, ledger) = (solution.network(), solution.ledger());
    let heat = |id: lptn_network::SourceId| &ledger.sources[id.index()];
    let sources = network
        .heat_sources()
        .map(|id| (network.name_of(lptn_network::Item::Source(id)), heat(id)));
    let boundaries =
        network.boundaries().iter().map(|b| Cow::from(&b.name)).zip(&ledger.boundaries);
    let flow = |(name, &heat): (Cow<'_, str>, &f64)| Flow { name: name.into_owned(), heat };
    let mut flows = families::sums(sources.chain(boundaries).map(flow).collect(), fold);
    // streams pass heat to each other: only their sum is meaningful
    flows.push(Flow { name: "streams".into(), heat: ledger.streams.iter().sum() });
    for (of, &heat) in network.state_capacities().iter().zip(&ledger.masses) {
        flows.push(Flow {
            name: format!("mass of {}", network.name_of(lptn_network::Item::Node(of.node))),
            heat,
        });
    }
    let pieces = lptn_report::balance(&flows, ledger.stored.iter().sum(), ledger.turned_over);
    let over = over(length, clock);
    let width = over.len() + 2;
    text.labelled(&format!("{over:width$}"), pieces);
    let balance = match ledger.relative_residual() {
        Some(residual) => {
            let (residual, bound) = (significant(residual.abs(), 2), significant(ledger.bound, 2));
            format!("closes to {residual} of the heat exchanged (allowed: {bound})")
        }
        None => {
            format!("residual {} J; no heat was exchanged", significant(ledger.residual(), 2))
        }
    };
    text.sentence(&format!("{:width$}", "balance:"), &balance);
}

/// Method and tolerance of the solver, with `-v` its counters; none if nothing stores heat.
fn solver(of: &RunAnswer) -> Vec<String> {
    let method = match of.solution.method() {
        Some(Method::OneStep) => "one-step method",
        Some(Method::Esdirk) => "ESDIRK",
        Some(Method::Cvode) => "CVODE",
        None => return Vec::new(),
    };
    let tolerance = format!("tolerance {} K", significant(of.task.settings.tolerance, 3));
    let mut words = vec![method.to_owned(), tolerance];
    if of.task.detail == Detail::Verbose {
        let done = of.solution.statistics();
        let repeated = done.error_test_failures + done.newton_failures;
        let counts = [
            (done.steps, "steps"),
            (repeated, "repeated"),
            (done.factorizations, "factorisations"),
            (done.linear_solves, "solves"),
        ];
        words.extend(counts.map(|(count, of)| format!("{count} {of}")));
    }
    let last = words.len() - 1;
    words[..last].iter_mut().for_each(|word| word.push(','));
    words
}
