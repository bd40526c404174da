//! `lptn reduce`

mod args;
mod figure;
mod page;

pub(crate) use args::ReduceArgs;

use std::path::Path;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Derived, Diagnostic};
use lptn_reduce::{
    Bias, Definition, FitError, Pair, ReduceError, Reduction, ReductionOptions, port,
};
use lptn_report::{Format, plain, significant};
use lptn_solve::Transient;
use lptn_units::{Dimension, Problem as _, Type, Unit};

use args::ReduceFormat;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input, quoted};
use crate::{files, written};

pub(crate) fn reduce(args: &ReduceArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let name = args.port.as_deref().ok_or_else(|| no_port(&input))?;
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    let limit = args.max_error.as_deref().map(Limit::parse).transpose()?;
    let window = args.window.as_deref().map(window).transpose()?;
    let run = input.netlist.run.clone();
    if run.is_none() && (limit.is_some() || args.bias) {
        return Err(no_run(&input, if limit.is_some() { "--max-error" } else { "--bias" }));
    }
    let system = input.assemble()?;
    let explain = |error: ReduceError| failed(&input, name, &error);
    let port = port(&input.netlist.network, name).map_err(explain)?;
    let run = run.as_ref().map(|run| lptn_solve::Transient::of(&input.netlist.network, run));
    let reduction =
        Reduction::new(&system, port, &options(&system, run.as_ref(), (window, limit.is_some())));
    let reduction = reduction.map_err(explain)?;
    let bias = match &run {
        Some(run) if args.bias => Some(Bias::new(&system, port, run).map_err(explain)?),
        _ => None,
    };
    let definition = args.definition;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let view = View {
        input: &input,
        args,
        port: name,
        system: &system,
        reduction,
        bias,
        unit,
        limit,
        definition,
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
    pub(crate) bias: Option<Result<Bias, FitError>>,
    pub(crate) unit: Unit,
    pub(crate) limit: Option<Limit>,
    /// The definition that was asked for.
    pub(crate) definition: Option<Definition>,
}

impl View<'_> {
    /// The pair that is judged and written: the one asked for, else the recommended one.
    pub(crate) fn pair(&self) -> Option<&Pair> {
        let dynamics = self.reduction.dynamics.as_ref()?;
        Some(dynamics.pair(self.definition.unwrap_or(dynamics.recommended.definition)))
    }

    fn show(&self, console: &Console) -> Result<(), Failure> {
        if let Some(path) = &self.args.write {
            files::write_new(path, &self.netlist(Some(path))?, "reduce::exists")?;
        }
        match self.args.format {
            ReduceFormat::Of(format) => console.show(self, format).map(drop)?,
            ReduceFormat::Toml => console.print(&self.netlist(None)?).map(drop)?,
        }
        if self.args.format == ReduceFormat::Of(Format::Csv) {
            self.notes().iter().for_each(|note| console.note(&format!("note: {note}")));
        }
        if let Some(path) = &self.args.write {
            let name = &self.input.text.name;
            console.note(&format!("wrote  {}: one node that stands for {name}", path.display()));
            if self.input.netlist.run.is_some() {
                console.next(&format!("lptn run {}", quoted(&path.display().to_string())));
            }
        } else if let (ReduceFormat::Of(Format::Table), Some(file), false) =
            (self.args.format, self.input.typed(), self.system.network().has_events())
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
        let pair = self.pair();
        let network = self.reduction.network(self.system, start, pair);
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
        if let Some(pair) = self.pair() {
            let error = match pair.run {
                Some(run) => {
                    format!("; over the run it errs by {} K at most", significant(run.kelvin, 2))
                }
                None => String::new(),
            };
            text += &format!("# C_eq by {}{error}.\n", pair.definition.key());
        }
        text
    }

    fn conclude(&self, console: &Console) -> Exit {
        let (Some(limit), Some(pair)) = (&self.limit, self.pair()) else { return Exit::Done };
        let Some(run) = pair.run else { return Exit::Done };
        if run.within(limit.kelvin, limit.relative) {
            return Exit::Done;
        }
        let share =
            run.relative.map(|r| format!(" ({} %)", significant(100.0 * r, 3))).unwrap_or_default();
        console.message(&format!(
            "too large: with C_eq by {} the error reaches {} K{share}, and {} is allowed",
            pair.definition.key(),
            significant(run.kelvin, 3),
            limit.text
        ));
        Exit::No
    }
}

/// The largest error allowed.
pub(crate) struct Limit {
    pub(crate) kelvin: Option<f64>,
    pub(crate) relative: Option<f64>,
    text: String,
}

impl Limit {
    /// `0.5K` or `2%`.
    fn parse(text: &str) -> Result<Self, Failure> {
        let share = text.trim().ends_with('%');
        let wanted = if share { Dimension::NONE } else { Dimension::TEMPERATURE };
        let what = (wanted, "reduce::max_error", "0.5K or 2%");
        let quantity = input::positive("--max-error", text, what)?;
        let [kelvin, relative] =
            if share { [None, Some(quantity.value)] } else { [Some(quantity.value), None] };
        Ok(Self { kelvin, relative, text: text.trim().to_owned() })
    }
}

fn window(text: &str) -> Result<f64, Failure> {
    input::quantity("--window", text, Type::of(Dimension::TIME)).map(|quantity| quantity.value)
}

/// One node cannot follow a network that switches over its run: the run is left out, but where it
/// is asked for.
fn options(
    system: &ThermalSystem,
    run: Option<&Transient>,
    (window, wanted): (Option<f64>, bool),
) -> ReductionOptions {
    if wanted || !system.network().has_events() {
        return ReductionOptions { run: run.cloned(), window };
    }
    ReductionOptions { run: None, window: window.or(run.map(|run| run.stop - run.start)) }
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
    let place = match error {
        ReduceError::BoundaryPort { .. } => {
            network.item(port).ok().and_then(|item| input.netlist.source_map.name(item))
        }
        ReduceError::NoGround { names } => names.first().and_then(|name| input.node_place(name)),
        ReduceError::Input(error) => input.place_of(error),
        _ => None,
    };
    let example = network
        .nodes()
        .first()
        .filter(|_| matches!(error, ReduceError::UnknownPort(_)) && error.help().is_none());
    let help = example.map(|node| format!("name a node, for example `{}`", node.name));
    input.refused(error.class().into(), told(error).at(place, "").help(help))
}
