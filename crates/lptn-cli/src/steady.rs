//! `lptn steady`

use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::{ConductorKind, list_of_names};
use lptn_report::{
    Align, Column, JsonWriter, TextTable, WIDTH, decimals, fixed, labelled, plain, prefix, shortened,
    significant, write_csv,
};
use lptn_solve::{Balance, Selection, SteadyError, SteadyState, Table};
use lptn_study::Scalar;
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::args::{Format, SteadyArgs};
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::limits::{self, Judged, Judgement};
use crate::summary::{MOST_NODES, counts};
use crate::{balance, diagnostics, select};

pub(crate) fn steady(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let netlist = &input.netlist;
    let selection = select::of_option(netlist, &args.shown.select)?;
    let unit = input::temperature_unit(args.shown.temperature_unit.as_deref(), netlist)?;
    let balance = balance::end(netlist, args.balance.as_deref(), args.shown.format)?;
    let system = input.assemble()?;
    let start = netlist.run.as_ref().map_or(0.0, |run: &RunSettings| run.start);
    let steady = SteadyState::solve(&system, start).map_err(|error| failed(&input, &error))?;
    console.warn(&netlist.files, &netlist.warnings);
    let limits = limits(&input, &steady, start)?;
    let table = table(&input, &steady, &selection, &unit)?;
    let balance = balance.map(|of| steady.balance(&netlist.network, of));
    let view = View {
        input: &input,
        steady: &steady,
        selection: &selection,
        table: &table,
        unit: &unit,
        limits: &limits,
        balance: balance.as_ref(),
    };
    match args.shown.format {
        Format::Table => console.print(&view.text(args, console)).map(drop)?,
        Format::Csv => {
            console.write(|out| write_csv(&table, out))?;
        }
        Format::Json => console.write(|out| view.json(out))?,
    }
    if args.shown.format == Format::Table {
        view.messages(console);
    } else {
        console.warn(&netlist.files, &view.doubts());
    }
    Ok(limits::conclude(&Judgement { netlist, unit: &unit, limits: &limits }, console))
}

fn table(input: &Input, steady: &SteadyState, selection: &Selection, unit: &Unit) -> Result<Table, Failure> {
    let table = Table::of_steady(&input.netlist.network, steady, selection, unit);
    table.map_err(|error| failed(input, &SteadyError::Input(error)))
}

fn limits(input: &Input, steady: &SteadyState, time: f64) -> Result<Vec<Judged>, Failure> {
    let network = &input.netlist.network;
    let margins = steady.limit_margins(network, time);
    let margins = margins.map_err(|error| failed(input, &SteadyError::Input(error)))?;
    Ok(network.limit_ids().zip(margins).map(|(limit, margin)| Judged::of_steady(limit, margin)).collect())
}

/// That a network cycles is an answer. One without a path to a boundary has no steady state whatever its numbers: the question does not fit the
/// input, so the exit code is that of a wrong input. Numbers that cannot be solved with are a failure of numbers.
fn failed(input: &Input, error: &SteadyError) -> Failure {
    let exit = match error {
        SteadyError::Cycles { .. } => Exit::No,
        SteadyError::NoBoundary { .. } | SteadyError::Input(_) => Exit::Input,
        SteadyError::Unsolved(_)
        | SteadyError::Factorization(_)
        | SteadyError::Unbalanced { .. }
        | SteadyError::BelowAbsoluteZero { .. } => Exit::Failed,
    };
    let mut problem = Diagnostic::error(error.code(), error.to_string());
    if let Some(help) = error.help() {
        problem = problem.help(help);
    }
    let map = &input.netlist.source_map;
    let place = match error {
        SteadyError::NoBoundary { nodes, .. } => {
            nodes.first().and_then(|&node| map.name(lptn_network::Item::Node(node)))
        }
        SteadyError::Unsolved(unsolved) if unsolved.input().is_none() => input.node_place(&unsolved.node),
        SteadyError::BelowAbsoluteZero { name, .. } => input.node_place(name),
        error => error.input().and_then(|input| map.get(input.item, input.field)),
    };
    if let Some(place) = place {
        problem = problem.at(place.clone(), "");
    }
    Failure::at(exit, input.netlist.files.clone(), problem)
}

const VARY: &str = "the inputs change with time; they are taken at the start of the run";

/// What the table says in a note.
pub(crate) fn doubt(netlist: &lptn_netlist::Netlist) -> Option<Diagnostic> {
    let vary = netlist.network.has_time_dependent_inputs();
    vary.then(|| Diagnostic::warning("steady::inputs_vary", VARY))
}

/// Nodes that keep their energy have a steady state that depends on their start.
fn adiabatic(network: &lptn_network::Network, steady: &SteadyState) -> Option<Diagnostic> {
    let name = |id: &lptn_network::NodeId| network.nodes()[id.index()].name.clone();
    let names: Vec<String> = steady.adiabatic.iter().map(name).collect();
    let message = format!(
        "no path leads to a boundary from {}: the energy at the start decides where they come to rest",
        list_of_names(&names)
    );
    (!names.is_empty()).then(|| Diagnostic::warning("steady::energy", message))
}

/// Rises in K and heats in W below this are what rounding left over: no unit and no decimals are chosen to show them.
const NOISE: f64 = 1e-9;

/// A steady state and how it is shown.
struct View<'a> {
    input: &'a Input,
    steady: &'a SteadyState,
    selection: &'a Selection,
    /// What is selected, in the unit that is shown.
    table: &'a Table,
    unit: &'a Unit,
    limits: &'a [Judged],
    balance: Option<&'a Balance>,
}

/// A name with a number of its quantity.
struct Row {
    name: String,
    quantity: &'static str,
    value: f64,
    words: String,
}

impl View<'_> {
    fn text(&self, args: &SteadyArgs, console: &Console) -> String {
        let network = &self.input.netlist.network;
        let title = network.title().map_or(self.input.text.stem.clone(), plain);
        let mut lines = vec![console.title(&title), counts(network)];
        let patterns = &args.shown.select;
        let kept = self.table;
        let keep = |row: &Row| {
            patterns.is_empty()
                || kept.columns().iter().any(|c| c.name == format!("{}.{}", row.name, row.quantity))
        };
        let (nodes, flows) = (self.temperatures(), self.flows());
        let blocks = [
            self.node_lines(nodes.into_iter().filter(keep).collect()),
            self.flow_lines(flows.into_iter().filter(keep).collect()),
            self.other_lines(),
            limits::lines(network, self.limits, self.unit),
            self.balance.map_or(Vec::new(), |of| balance::lines(network, of, None)),
        ];
        for block in blocks.into_iter().filter(|block| !block.is_empty()) {
            lines.push(String::new());
            lines.extend(block);
        }
        for doubt in self.doubts() {
            lines.push(String::new());
            let words: Vec<String> = doubt.message.split(' ').map(str::to_owned).collect();
            lines.extend(labelled("note: ", &words, WIDTH));
        }
        lines.join("\n") + "\n"
    }

    fn temperatures(&self) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let node = |(node, &value): (&lptn_network::Node, &f64)| {
            let words = if node.massless { "junction" } else { "node" };
            Row { name: node.name.clone(), quantity: "T", value, words: words.into() }
        };
        let boundary = |(boundary, &value): (&lptn_network::Boundary, &f64)| Row {
            name: boundary.name.clone(),
            quantity: "T",
            value,
            words: "boundary".into(),
        };
        let nodes = network.nodes().iter().zip(&self.steady.temperatures).map(node);
        nodes
            .chain(network.boundaries().iter().zip(&self.steady.boundary_temperatures).map(boundary))
            .collect()
    }

    fn flows(&self) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let name = |end: lptn_network::End| network.name_of(end.into());
        let conductors =
            network.conductors().iter().zip(&self.steady.received).flat_map(|(c, &[back, on])| {
                let row = |quantity, value, words| Row { name: c.name.clone(), quantity, value, words };
                if c.kind != ConductorKind::Advection {
                    return vec![row("Q", on, format!("{} -> {}", name(c.from), name(c.to)))];
                }
                vec![
                    row("Q_from", back, format!("stream to {}", name(c.from))),
                    row("Q_to", on, format!("stream to {}", name(c.to))),
                ]
            });
        let sources = network.sources().iter().zip(&self.steady.source_heat).map(|(s, &value)| {
            let into: Vec<&str> = s.into.iter().map(|(id, _)| name((*id).into())).collect();
            let words = format!("source into {}", into.join(", "));
            Row { name: s.name.clone(), quantity: "P", value, words }
        });
        let boundaries = network.boundaries().iter().zip(&self.steady.boundary_heat).map(|(b, &value)| {
            let words = if value > 0.0 { "boundary gives" } else { "boundary takes" };
            Row { name: b.name.clone(), quantity: "Q", value, words: words.into() }
        });
        sources.chain(conductors).chain(boundaries).collect()
    }

    /// Temperatures with their rise over the coldest boundary, hottest first where there are many.
    fn node_lines(&self, mut rows: Vec<Row>) -> Vec<String> {
        let all = rows.len();
        if all > MOST_NODES {
            rows.sort_by(|a, b| b.value.total_cmp(&a.value));
        }
        let coldest = coldest(&self.input.netlist.network, self.steady);
        let rises = rows.iter().map(|r| (r.value - coldest.1).abs());
        let largest = rises.filter(|rise| *rise > NOISE).fold(0.0, f64::max);
        let digits = decimals(largest / self.unit.scale, 3, 1);
        rows.truncate(MOST_NODES);
        let texts = |text: &dyn Fn(&Row) -> String| rows.iter().map(text).collect::<Vec<_>>();
        let over = format!("over {} [{}]", shortened(&coldest.0, 24), difference(self.unit));
        let table = TextTable::new(vec![
            Column::new("temperature", Align::Left, texts(&|r| r.name.clone())),
            Column::new(
                format!("T [{}]", self.unit.text),
                Align::Right,
                texts(&|r| fixed(self.unit.from_si(r.value), digits)),
            ),
            Column::new(
                over,
                Align::Right,
                texts(&|r| fixed((r.value - coldest.1) / self.unit.scale, digits)),
            ),
            Column::new("", Align::Left, texts(&|r| r.words.clone())).optional(),
        ]);
        with_hidden(
            table.lines(WIDTH),
            (all, rows.len()),
            "the hottest first; --select 'NAME.T' shows others",
        )
    }

    fn flow_lines(&self, mut rows: Vec<Row>) -> Vec<String> {
        let all = rows.len();
        if all > MOST_NODES {
            rows.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
        }
        let largest = rows.iter().map(|r| r.value.abs()).filter(|heat| *heat > NOISE).fold(0.0, f64::max);
        let (scale, letter) = prefix(largest);
        let digits = decimals(largest / scale, 4, 0);
        rows.truncate(MOST_NODES);
        let texts = |text: &dyn Fn(&Row) -> String| rows.iter().map(text).collect::<Vec<_>>();
        let table = TextTable::new(vec![
            Column::new("heat flow", Align::Left, texts(&|r| r.name.clone())),
            Column::new(format!("Q [{letter}W]"), Align::Right, texts(&|r| fixed(r.value / scale, digits))),
            Column::new("", Align::Left, texts(&|r| r.words.clone())).optional(),
        ]);
        with_hidden(
            table.lines(WIDTH),
            (all, rows.len()),
            "the largest first; --select 'NAME.Q' shows others",
        )
    }

    /// Signals and reports.
    fn other_lines(&self) -> Vec<String> {
        let shown: Vec<_> = self.table.columns().iter().filter(|c| !c.name.contains('.')).collect();
        if shown.is_empty() {
            return Vec::new();
        }
        let names = shown.iter().map(|c| c.header()).collect();
        let values = shown.iter().map(|c| significant(c.values[0], 5)).collect();
        let columns = vec![Column::new("column", Align::Left, names), Column::new("", Align::Right, values)];
        TextTable::new(columns).lines(WIDTH)
    }

    fn json(&self, out: impl std::io::Write) -> std::io::Result<()> {
        let netlist = &self.input.netlist;
        let kelvin = Unit { text: "K".into(), scale: 1.0, offset: 0.0, ty: self.unit.ty };
        let table = Table::of_steady(&netlist.network, self.steady, self.selection, &kelvin);
        let table = table.map_err(std::io::Error::other)?;
        let value = |c: &lptn_solve::Column| (c.name.clone(), Scalar::new(c.values[0], &c.unit).json());
        let values: Map<String, Value> = table.columns().iter().map(value).collect();
        let mut json = JsonWriter::new(out);
        json.member("format", &json!(1))?;
        json.member("network", &json!(self.input.text.stem))?;
        let warnings: Vec<Diagnostic> = netlist.warnings.iter().cloned().chain(self.doubts()).collect();
        json.member("warnings", &diagnostics::list(&netlist.files, &warnings))?;
        json.member("values", &Value::Object(values))?;
        if !self.limits.is_empty() {
            let limits = limits::members(&netlist.network, self.limits);
            json.member("limits", &Value::Object(limits))?;
        }
        if let Some(of) = self.balance {
            json.member("balance", &balance::json(&netlist.network, of))?;
        }
        json.finish().map(drop)
    }

    /// What to know before this is believed.
    fn doubts(&self) -> Vec<Diagnostic> {
        let netlist = &self.input.netlist;
        doubt(netlist).into_iter().chain(adiabatic(&netlist.network, self.steady)).collect()
    }

    fn messages(&self, console: &Console) {
        if let (Some(file), Some(_)) = (self.input.typed(), &self.input.netlist.run) {
            console.note(&format!("next   lptn run {file}"));
        }
    }
}

fn with_hidden(mut lines: Vec<String>, (all, shown): (usize, usize), how: &str) -> Vec<String> {
    if all == 0 {
        return Vec::new();
    }
    if shown < all {
        lines.push(format!("{shown} of {all} are shown, {how}"));
    }
    lines
}

/// The boundary that rises are measured against; without one the coldest node.
fn coldest(network: &lptn_network::Network, steady: &SteadyState) -> (String, f64) {
    let boundaries = network.boundaries().iter().zip(&steady.boundary_temperatures);
    let boundaries = boundaries.map(|(boundary, &t)| (boundary.name.clone(), t));
    let nodes = network.nodes().iter().zip(&steady.temperatures).map(|(node, &t)| (node.name.clone(), t));
    let coldest = |a: &(String, f64), b: &(String, f64)| a.1.total_cmp(&b.1);
    boundaries.min_by(coldest).or_else(|| nodes.min_by(coldest)).unwrap_or_default()
}

/// The unit of a difference between two temperatures in `unit`.
fn difference(unit: &Unit) -> &'static str {
    if (unit.scale - 1.0).abs() < 1e-12 { "K" } else { "degR" }
}
