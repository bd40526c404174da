//! `lptn reduce`

mod args;
mod figure;
mod keep;
mod keep_page;
mod loads;
mod near;
mod notes;
mod page;
mod verdict;

pub(crate) use args::ReduceArgs;

use std::path::Path;

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Derived, Diagnostic};
use lptn_reduce::{
    Allowed, Bias, Definition, Deviation, FitError, Judge, Nodes, Pair, ReduceError, Reduction,
    ReductionOptions, port,
};
use lptn_report::{Format, plain, significant};
use lptn_solve::ResponseError;
use lptn_units::{Dimension, Problem as _, Type, Unit};

use args::ReduceFormat;
use loads::{Asked, Loads};
use near::Near;

use crate::console::Console;
use crate::input::Load as _;
use crate::{files, written};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::{self, Input, quoted};
use lptn_answer::operating_point::place;
use lptn_answer::words::count;

pub(crate) fn reduce(args: &ReduceArgs, console: &Console) -> Result<Exit, Failure> {
    if let Some(names) = &args.keep {
        return keep::keep(args, console, names);
    }
    if args.recover.is_some() {
        return Err(keep::recovers_nothing());
    }
    let input = Input::load(&args.source)?;
    let name = args.port.as_deref().ok_or_else(|| no_port(&input))?;
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    let limit = Limit::parse("--max-error", &args.max_error)?;
    near::allowed(args, &limit)?;
    let window = args.window.as_deref().map(window).transpose()?;
    let run = input.netlist.run.clone();
    if run.is_none()
        && let Some(option) = about_the_run(args, &limit)
    {
        return Err(no_run(&input, option));
    }
    let system = input.assemble()?;
    let explain = |error: ReduceError| failed(&input, name, &error);
    let port = port(&input.netlist.network, name).map_err(explain)?;
    let run = run.as_ref().map(|run| RunAnalysis::of(&input.netlist.network, run));
    let wanted = about_the_run(args, &limit).is_some();
    let run_compared = run.clone().filter(|_| wanted || !system.network().has_events());
    let options =
        ReductionOptions { run: run_compared, window, judge: args.judge, allowed: limit.allowed };
    let near = Near::find(args, &input, console)?;
    let options = match &near {
        Some(_) => ReductionOptions { run: None, ..options },
        None => options,
    };
    let (reduction, near) = match near {
        Some(near) => near.reduce((&system, port), &options).map_err(explain)?,
        None => (Reduction::new(&system, port, &options).map_err(explain)?, None),
    };
    let asked = Asked { args, system: &system, run: options.run.as_ref(), allowed: limit.allowed };
    let loads = Loads::new(&asked, &reduction, &explain)?;
    let bias = match &run {
        Some(run) if args.bias => Some(Bias::new(&system, port, run).map_err(explain)?),
        _ => None,
    };
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let view = View {
        input: &input,
        args,
        port: name,
        system: &system,
        reduction,
        loads,
        bias,
        near,
        unit,
        limit,
    };
    view.show(console)?;
    Ok(view.conclude(console))
}

/// A reduction and how it is shown.
pub(crate) struct View<'a> {
    pub(crate) input: &'a Input,
    pub(crate) args: &'a ReduceArgs,
    /// The node that the network is seen from.
    pub(crate) port: &'a str,
    pub(crate) system: &'a ThermalSystem,
    pub(crate) reduction: Reduction,
    /// What is known of every load.
    pub(crate) loads: Loads,
    pub(crate) bias: Option<Result<Bias, FitError>>,
    /// The state near which it stands for the network.
    pub(crate) near: Option<Near>,
    pub(crate) unit: Unit,
    pub(crate) limit: Limit,
}

impl View<'_> {
    /// The pair that is judged and written: the one asked for, else the recommended one.
    pub(crate) fn pair(&self) -> Option<&Pair> {
        let dynamics = self.reduction.dynamics.as_ref()?;
        let asked = self.loads.nodes.as_ref().and_then(|nodes| nodes.definition);
        let asked = asked.or(self.args.definition).and_then(|d| dynamics.pair(d));
        Some(asked.unwrap_or(dynamics.best()))
    }

    /// The error that is judged, and whether it is within the limit.
    pub(crate) fn judged(&self) -> Option<(Judge, Deviation, Option<bool>)> {
        let dynamics = self.reduction.dynamics.as_ref()?;
        if let Some((judge, error)) = self.loads.error {
            let in_kelvin = matches!(self.limit.allowed, Allowed::Kelvin(_));
            let can = judge == Judge::Run || !in_kelvin;
            return Some((judge, error, can.then(|| error.within(self.limit.allowed))));
        }
        let pair = self.pair()?;
        let (judge, error) = dynamics.judged(pair)?;
        Some((judge, error, dynamics.collapses(pair)))
    }

    fn show(&self, console: &Console) -> Result<(), Failure> {
        if let (Some(path), Some(text)) = (&self.args.worst, self.loads.csv()) {
            files::write_new(path, &text, "reduce::exists")?;
            console.note(&self.load_help(path));
        }
        if let Some(path) = &self.args.write {
            files::write_new(path, &self.netlist(Some(path))?, "reduce::exists")?;
        }
        match self.args.format {
            ReduceFormat::Of(format) => console.show(self, format).map(drop)?,
            ReduceFormat::Toml => console.print(&self.netlist(None)?).map(drop)?,
        }
        if self.args.format == ReduceFormat::Of(Format::Csv) {
            let short = self.reduction.dynamics.as_ref().and_then(|dynamics| self.short(dynamics));
            short.iter().for_each(|short| console.note(&format!("warning: {short}")));
            self.notes().iter().for_each(|note| console.note(&format!("note: {note}")));
        }
        if let Some(path) = &self.args.write {
            let name = &self.input.text.name;
            let nodes = match self.loads.nodes.as_ref().map_or(1, Nodes::count) {
                1 => "one node that replaces".to_owned(),
                many => format!("{many} nodes that replace"),
            };
            console.note(&format!("wrote  {}: {nodes} {name}", path.display()));
            if self.input.netlist.run.is_some() {
                console.next(&format!("lptn run {}", quoted(&path.display().to_string())));
            }
        } else if let (ReduceFormat::Of(Format::Table), Some(file), false, None) =
            (self.args.format, self.input.typed(), self.system.network().has_events(), &self.near)
        {
            let port = quoted(self.port);
            console.next(&format!("lptn reduce {file} --port {port} --write {port}.toml"));
        }
        Ok(())
    }

    /// The one-node network as a netlist that runs where it is going to stand, or beside the whole
    /// one.
    fn netlist(&self, place: Option<&Path>) -> Result<String, Failure> {
        let run = self.input.netlist.run.as_ref();
        let start = run.map_or(0.0, |run| run.start);
        let network = match &self.loads.nodes {
            Some(nodes) => self.reduction.network_of(self.system, start, nodes),
            None => self.reduction.network(self.system, start, self.pair()),
        };
        let network = network.map_err(|error| failed(self.input, self.port, &error))?;
        let title = format!("{}, seen from {}", self.input.title(), self.port);
        let folder = place.map(|place| place.parent().unwrap_or(Path::new("")));
        let made = Derived { network: &network, title: &title, run, folder };
        let text = self.comment() + &self.input.netlist.derived(&made);
        written::proven(text, place.unwrap_or(Path::new(&self.input.text.name)), &network, run)
    }

    fn comment(&self) -> String {
        let from = plain(&self.input.text.name);
        let mut text = format!("# What `{}` of {from} sees, by `lptn reduce`.\n", self.port);
        if self.reduction.dynamics.is_some() {
            text += &format!("# Verdict: {}.\n", self.verdict());
        }
        if let Some(definition) = self.definition() {
            text += &format!("# C_eq by {}.\n", definition.key());
        }
        text
    }

    fn conclude(&self, console: &Console) -> Exit {
        if let Some(kept) = self.loads.kept() {
            return if kept { Exit::Done } else { self.refuse(console, &self.verdict()) };
        }
        let Some((judge, error, Some(false))) = self.judged() else { return Exit::Done };
        let share = error.relative.map(|r| format!("{} %", significant(100.0 * r, 3)));
        let kelvin = (judge == Judge::Run).then(|| format!("{} K", significant(error.kelvin, 3)));
        let size = match (kelvin, share) {
            (Some(kelvin), Some(share)) => format!("{kelvin} ({share})"),
            (kelvin, share) => kelvin.or(share).unwrap_or_default(),
        };
        let with = match (self.definition(), &self.loads.nodes) {
            (Some(definition), _) => format!("C_eq by {}", definition.key()),
            (None, nodes) => count(nodes.as_ref().map_or(1, Nodes::count), "node"),
        };
        let limit = &self.limit.text;
        let text = format!("with {with} the error reaches {size}, and {limit} is allowed");
        self.refuse(console, &text)
    }

    fn refuse(&self, console: &Console, text: &str) -> Exit {
        console.message(&format!("too large: {text}"));
        Exit::No
    }

    /// The definition of C_eq of what is judged, if it is one node.
    pub(crate) fn definition(&self) -> Option<Definition> {
        match &self.loads.nodes {
            Some(nodes) => nodes.definition,
            None => self.pair().map(|pair| pair.definition),
        }
    }
}

/// The largest error allowed.
pub(crate) struct Limit {
    pub(crate) allowed: Allowed,
    pub(crate) text: String,
}

impl Limit {
    /// `0.5K` or `2%`.
    fn parse(option: &str, text: &str) -> Result<Self, Failure> {
        let share = text.trim().ends_with('%');
        let wanted = if share { Dimension::NONE } else { Dimension::TEMPERATURE };
        let what = (wanted, "reduce::max_error", "0.5K or 2%");
        let value = input::positive(option, text, what)?.value;
        let allowed = if share { Allowed::Share(value) } else { Allowed::Kelvin(value) };
        Ok(Self { allowed, text: text.trim().to_owned() })
    }
}

/// The option that asks for the run, if there is one.
fn about_the_run(args: &ReduceArgs, limit: &Limit) -> Option<&'static str> {
    let options = [
        (matches!(limit.allowed, Allowed::Kelvin(_)), "--max-error in K"),
        (args.judge == Judge::Run, "--for run"),
        (args.bias, "--bias"),
    ];
    options.into_iter().find(|(asks, _)| *asks).map(|(_, option)| option)
}

fn window(text: &str) -> Result<f64, Failure> {
    input::quantity("--window", text, Type::of(Dimension::TIME)).map(|quantity| quantity.value)
}

/// The run of the file.
fn no_run(input: &Input, option: &str) -> Failure {
    let message = format!("{} has no [run], which {option} is about", input.text.name);
    let problem = Diagnostic::error("run::no_run", message)
        .help("add these lines, or leave the option out:\n\n[run]\nstop = \"25 min\"");
    Failure::new(Exit::Input, problem)
}

/// So many nodes are named where none was.
const MOST_NAMES: usize = 8;

/// That nobody said from which node the network is seen: the first that a source heats is the
/// likely one.
fn no_port(input: &Input) -> Failure {
    let network = &input.netlist.network;
    let heated = network.sources().first().and_then(|source| source.into.first());
    let likely = heated.map_or("NODE", |(node, _)| &network.nodes()[node.index()].name);
    let names: Vec<String> =
        network.nodes().iter().take(MOST_NAMES).map(|node| node.name.clone()).collect();
    let more = if network.nodes().len() > MOST_NAMES { ", .." } else { "" };
    let message = format!("{} is seen from which node?", input.text.name);
    let file = input.typed().unwrap_or_else(|| "-".into());
    let help = format!(
        "write `lptn reduce {file} --port {}`; its nodes are {}{more}",
        quoted(likely),
        names.join(", ")
    );
    Failure::new(Exit::Input, Diagnostic::error("reduce::no_port", message).help(help))
}

/// What is wrong, with its place in the file or on the command line.
fn failed(input: &Input, port: &str, error: &ReduceError) -> Failure {
    let network = &input.netlist.network;
    let at = match error {
        ReduceError::BoundaryPort { .. } => {
            network.item(port).ok().and_then(|item| input.netlist.source_map.name(item))
        }
        ReduceError::NoGround { names } => names.first().and_then(|name| input.node_place(name)),
        ReduceError::Input(error) => input.place_of(error),
        ReduceError::Response(ResponseError::Linearised(error)) => place(input, error),
        _ => None,
    };
    let example = network
        .nodes()
        .first()
        .filter(|_| matches!(error, ReduceError::UnknownPort(_)) && error.help().is_none());
    let help = example.map(|node| format!("name a node, for example `{}`", node.name));
    input.refused(error.class().into(), told(error).at(at, "").help(help))
}
