//! `lptn steady`

mod args;
mod periodic;

pub(crate) use args::SteadyArgs;

use std::collections::HashSet;

use lptn_netlist::{Diagnostic, RunSettings};
use lptn_network::{BoundaryId, ConductorId, GridValue, HeatOf, Item, JointId, LimitId, Network, NodeId};
use lptn_report::{
    Align, Column, JsonWriter, TextTable, WIDTH, decimals, fixed, labelled, plain, prefix, shortened,
    significant, write_csv,
};
use lptn_solve::{Balance, Selection, SteadyError, SteadyState, Table};
use lptn_study::Scalar;
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::console::Console;
use crate::doubts::{adiabatic, inputs_vary, others};
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input};
use crate::limits::{self, Judged, Judgement};
use crate::options::Format;
use crate::words::{MOST_NODES, counts, difference, with_hidden};
use crate::{balance, diagnostics, select, sense};

pub(crate) fn steady(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    if args.cycle.periodic {
        return periodic::periodic(args, console);
    }
    let input = Input::load(&args.source)?;
    let netlist = &input.netlist;
    let selection = select::of_option(netlist, &args.shown.select)?;
    let unit = input::temperature_unit(args.shown.scale.temperature_unit.as_deref(), netlist)?;
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
        let hidden = select::hidden(netlist).filter(|_| args.shown.select.is_empty());
        hidden.iter().for_each(|hidden| console.note(hidden));
        console.warn(&netlist.files, &view.doubts());
    }
    console.warn(&netlist.files, &sense::of_steady(netlist, &steady));
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
    let one = |(id, margin): (LimitId, f64)| {
        let limit = &network.limits()[id.index()];
        match network.changing_inputs_of(&[&limit.of, &limit.value]).is_empty() {
            true => Judged::of_steady(id, margin),
            false => Judged::open(id),
        }
    };
    Ok(network.limit_ids().zip(margins).map(one).collect())
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
    let mut problem = told(error);
    let map = &input.netlist.source_map;
    let place = match error {
        SteadyError::NoBoundary { nodes, .. } => {
            nodes.first().and_then(|&node| map.name(lptn_network::Item::Node(node)))
        }
        SteadyError::Unsolved(unsolved) if unsolved.input().is_none() => input.node_place(unsolved.node()),
        SteadyError::BelowAbsoluteZero { name, .. } => input.node_place(name),
        error => error.input().and_then(|input| map.get(input.item, input.field)),
    };
    if let Some(place) = place {
        problem = problem.at(place.clone(), "");
    }
    Failure::at(exit, input.netlist.files.clone(), problem)
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

/// A temperature or heat flow with its value. Names are made for those that are shown.
#[derive(Clone, Copy)]
struct Row {
    of: Of,
    value: f64,
}

#[derive(Clone, Copy)]
enum Of {
    Node(NodeId),
    Boundary(BoundaryId),
    Grid(GridValue),
    Heat(HeatOf),
}

impl Row {
    /// The name of its column.
    fn column(self, network: &Network) -> String {
        match self.of {
            Of::Node(id) => format!("{}.T", network.name_of(Item::Node(id))),
            Of::Boundary(id) => format!("{}.T", network.name_of(Item::Boundary(id))),
            Of::Grid(value) => value.name(network),
            Of::Heat(heat) => heat.name(network),
        }
    }

    /// Its name; `T`, `Q` and `P` go without saying.
    fn label(self, network: &Network) -> String {
        match self.of {
            Of::Node(id) => network.name_of(Item::Node(id)).into_owned(),
            Of::Boundary(id) => network.name_of(Item::Boundary(id)).into_owned(),
            Of::Heat(heat) => network.name_of(heat.item()).into_owned(),
            Of::Grid(GridValue::Mean(_) | GridValue::Min(_) | GridValue::Max(_)) => self.column(network),
            Of::Grid(_) => self.column(network).trim_end_matches(".T").to_owned(),
        }
    }

    fn words(self, network: &Network) -> String {
        let name = |end: lptn_network::End| network.name_of(end.into());
        let ends = |id: lptn_network::ConductorId| {
            let conductor = &network.conductors()[id.index()];
            (name(conductor.from), name(conductor.to))
        };
        match self.of {
            Of::Node(id) if network.nodes()[id.index()].massless => "junction".into(),
            Of::Node(_) => "node".into(),
            Of::Boundary(_) => "boundary".into(),
            Of::Grid(GridValue::Mean(_)) => "mean of the grid".into(),
            Of::Grid(GridValue::Min(_)) => "coldest cell".into(),
            Of::Grid(GridValue::Max(_)) => "hottest cell".into(),
            Of::Grid(_) => "mean of the face".into(),
            Of::Heat(HeatOf::Joint(id)) => {
                let joint = &network.joints()[id.index()];
                let [from, to] = [joint.from, joint.to].map(|terminal| network.terminal_name(terminal));
                format!("{from} -> {to}")
            }
            Of::Heat(HeatOf::Conductor(id)) => {
                let (from, to) = ends(id);
                format!("{from} -> {to}")
            }
            Of::Heat(HeatOf::ReceivedFrom(id)) => format!("stream to {}", ends(id).0),
            Of::Heat(HeatOf::ReceivedTo(id)) => format!("stream to {}", ends(id).1),
            Of::Heat(HeatOf::Source(id)) => {
                let into = network.sources()[id.index()].into.iter();
                let mut into: Vec<String> = into.map(|(node, _)| network.place_name(*node)).collect();
                into.dedup();
                format!("source into {}", into.join(", "))
            }
            Of::Heat(HeatOf::Boundary(_)) if self.value > 0.0 => "boundary gives".into(),
            Of::Heat(HeatOf::Boundary(_)) => "boundary takes".into(),
        }
    }
}

impl View<'_> {
    fn text(&self, args: &SteadyArgs, console: &Console) -> String {
        let network = &self.input.netlist.network;
        let title = network.title().map_or(self.input.text.stem.clone(), plain);
        let mut lines = vec![console.title(&title), counts(network)];
        let kept: HashSet<&str> = self.table.columns().iter().map(|column| column.name.as_str()).collect();
        let all = args.shown.select.is_empty();
        let keep = |row: &Row| all || kept.contains(row.column(network).as_str());
        // cells and their paths are shown where they are asked for
        let inside = !all && !network.grids().is_empty();
        let (nodes, flows) = (self.temperatures(inside), self.flows(inside));
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

    fn temperatures(&self, inside: bool) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let ids: Box<dyn Iterator<Item = NodeId>> =
            if inside { Box::new(network.node_ids()) } else { Box::new(network.outer_nodes()) };
        let nodes = ids.map(|id| Row { of: Of::Node(id), value: self.steady.temperatures[id.index()] });
        let idle = network.idle_grid_values().filter(|_| inside);
        let grids = network
            .grid_values()
            .chain(idle)
            .map(|of| Row { of: Of::Grid(of), value: network.grid_value(of, &self.steady.temperatures) });
        let boundaries = network.boundary_ids().zip(&self.steady.boundary_temperatures);
        let boundaries = boundaries.map(|(id, &value)| Row { of: Of::Boundary(id), value });
        nodes.chain(grids).chain(boundaries).collect()
    }

    /// The heat that the end of a path to a face receives.
    fn through(&self, id: JointId) -> f64 {
        let joint = &self.input.netlist.network.joints()[id.index()];
        joint.conductors().map(|id| self.steady.received[id.index()][1]).sum()
    }

    fn flows(&self, inside: bool) -> Vec<Row> {
        let network = &self.input.netlist.network;
        let row = |heat: HeatOf, value: f64| Row { of: Of::Heat(heat), value };
        let shown = |id: &ConductorId| inside || network.whole(Item::Conductor(*id)).is_none();
        let paths = network.conductor_ids().filter(shown).flat_map(|id| {
            let [back, on] = self.steady.received[id.index()];
            let heats = network.heats_of(id).into_iter();
            heats.map(move |heat| row(heat, if heat == HeatOf::ReceivedFrom(id) { back } else { on }))
        });
        let sources = network.source_ids().zip(&self.steady.source_heat);
        let boundaries = network.boundary_ids().zip(&self.steady.boundary_heat);
        let sources = sources.map(|(id, &value)| row(HeatOf::Source(id), value));
        let joints = network.shared_joints().map(|id| row(HeatOf::Joint(id), self.through(id)));
        let boundaries = boundaries.map(|(id, &value)| row(HeatOf::Boundary(id), value));
        sources.chain(paths).chain(joints).chain(boundaries).collect()
    }

    /// Temperatures with their rise over the coldest boundary, hottest first where there are many.
    fn node_lines(&self, mut rows: Vec<Row>) -> Vec<String> {
        let all = rows.len();
        if all > MOST_NODES {
            rows.sort_by(|a, b| b.value.total_cmp(&a.value));
        }
        let network = &self.input.netlist.network;
        let coldest = coldest(network, self.steady).unwrap_or_default();
        let rises = rows.iter().map(|r| (r.value - coldest.1).abs());
        let largest = rises.filter(|rise| *rise > NOISE).fold(0.0, f64::max);
        let digits = decimals(largest / self.unit.scale, 3, 1);
        rows.truncate(MOST_NODES);
        let texts = |text: &dyn Fn(&Row) -> String| rows.iter().map(text).collect::<Vec<_>>();
        let over = format!("over {} [{}]", shortened(&coldest.0, 24), difference(self.unit));
        let table = TextTable::new(vec![
            Column::new("temperature", Align::Left, texts(&|row| row.label(network))),
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
            Column::new("", Align::Left, texts(&|r| r.words(network))).optional(),
        ]);
        with_hidden(
            table.lines(WIDTH),
            (all, rows.len()),
            "the hottest first; --select 'NAME.T' shows others",
        )
    }

    fn flow_lines(&self, mut rows: Vec<Row>) -> Vec<String> {
        let network = &self.input.netlist.network;
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
            Column::new("heat flow", Align::Left, texts(&|row| row.label(network))),
            Column::new(format!("Q [{letter}W]"), Align::Right, texts(&|r| fixed(r.value / scale, digits))),
            Column::new("", Align::Left, texts(&|r| r.words(network))).optional(),
        ]);
        with_hidden(
            table.lines(WIDTH),
            (all, rows.len()),
            "the largest first; --select 'NAME.Q' shows others",
        )
    }

    /// Signals, controls and reports.
    fn other_lines(&self) -> Vec<String> {
        let network = &self.input.netlist.network;
        let of_item = |name: &str| name.rsplit_once('.').is_some_and(|(item, _)| network.item(item).is_ok());
        let shown: Vec<_> = self.table.columns().iter().filter(|c| !of_item(&c.name)).collect();
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
        let found = self.doubts().into_iter().chain(sense::of_steady(netlist, self.steady));
        let warnings: Vec<Diagnostic> = netlist.warnings.iter().cloned().chain(found).collect();
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
        let vary = inputs_vary(self.input, self.steady, self.limits);
        let adiabatic = adiabatic(&netlist.network, self.steady);
        let others = others(&netlist.network, self.steady, self.unit);
        vary.into_iter().chain(adiabatic).chain(others).collect()
    }

    fn messages(&self, console: &Console) {
        if let (Some(file), Some(_)) = (self.input.typed(), &self.input.netlist.run) {
            console.note(&format!("next   lptn run {file}"));
        }
    }
}

/// The boundary that rises are measured against; without one the coldest node.
fn coldest(network: &Network, steady: &SteadyState) -> Option<(String, f64)> {
    let coldest = |a: &(Item, f64), b: &(Item, f64)| a.1.total_cmp(&b.1);
    let boundaries =
        network.boundary_ids().map(Item::Boundary).zip(steady.boundary_temperatures.iter().copied());
    let nodes = network.node_ids().map(Item::Node).zip(steady.temperatures.iter().copied());
    let (item, temperature) = boundaries.min_by(coldest).or_else(|| nodes.min_by(coldest))?;
    Some((network.name_of(item).into_owned(), temperature))
}
