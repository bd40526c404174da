//! `lptn impedance`

mod args;
mod chain;
mod chain_page;
mod curve;
mod figure;
mod lists;
mod netlist;
mod page;
mod question;

use args::Asked;
pub(crate) use args::ImpedanceArgs;
use chain::Chain;
use question::Question;

use lptn_netlist::Diagnostic;
use lptn_network::{Item, Network, NodeId};
use lptn_reduce::{ReduceError, port};
use lptn_solve::{Complex, Drive, Linearised, ResponseError, StepAnswer, Tried};

use crate::console::Console;
use crate::files;
use crate::input::Load as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::operating_point::OperatingPoint;

pub(crate) fn impedance(args: &ImpedanceArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let network = &input.netlist.network;
    let name = args.port.as_deref().ok_or_else(|| no_port(&input))?;
    let drive = drive(network, name).map_err(|error| unknown(&input, &error))?;
    let to = to(args, &input, (drive, name))?;
    let shares = args.duty.as_deref().map(lists::shares).transpose()?.unwrap_or_default();
    let same = is_at(network, drive, to);
    if !(same || shares.is_empty()) {
        return Err(pulses_elsewhere());
    }
    if args.write.is_some() && args.chain().is_none() {
        return Err(nothing_to_write());
    }
    let system = input.assemble()?;
    let point = args.at.find(&input, console)?;
    let failed = |error: &ResponseError| failed(&input, error);
    let state = point.as_ref().map(|point| &point.state);
    let mut linear = Linearised::of(&system, state).map_err(|error| failed(&error.into()))?;
    let step = StepAnswer::new(&linear, drive);
    let even = vec![1.0; network.nodes().len()];
    let tried = linear.tried_along(step.as_ref().map_or(&even, |step| &step.settled));
    let tried = tried.map_err(|error| failed(&error.into()))?;
    let question = Question { args, input: &input, linear: &linear, drive, to, shares: &shares };
    let answer = question.answer(step)?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let to = network.nodes()[to.index()].name.as_str();
    let view = View { input: &input, name, to, drive, answer, shares, point, tried };
    if let (Some(path), Answer::Chain(chain)) = (&args.write, &view.answer) {
        files::write_new(path, &view.netlist(chain), "impedance::exists")?;
    }
    lists::reordered(args).iter().for_each(|note| console.note(note));
    console.show(&view, args.printed.format)
}

/// An answer and how it is shown.
struct View<'a> {
    input: &'a Input,
    /// What is put in.
    name: &'a str,
    /// The node that answers.
    to: &'a str,
    drive: Drive,
    answer: Answer,
    /// The shares of their periods that pulses take.
    shares: Vec<f64>,
    /// The state near which the network is taken for a linear one.
    point: Option<OperatingPoint>,
    tried: Option<Tried>,
}

/// What a node does, per W or K.
enum Answer {
    /// After a step.
    Step { settled: f64, rows: Vec<Stepped> },
    /// To a swing.
    Swing(Vec<Swung>),
    /// As elements.
    Chain(Chain),
}

/// The answer at a time after a step.
struct Stepped {
    /// In s.
    time: f64,
    rise: f64,
    /// The highest rise of settled pulses of this length, one value a share.
    pulses: Vec<f64>,
}

/// The answer to a swing.
struct Swung {
    /// In rad/s.
    omega: f64,
    answer: Complex,
}

fn drive(network: &Network, name: &str) -> Result<Drive, ReduceError> {
    match network.item(name) {
        Ok(Item::Boundary(id)) => Ok(Drive::Boundary(id)),
        Ok(Item::Source(id)) => Ok(Drive::Source(id)),
        _ => port(network, name).map(Drive::Node),
    }
}

/// The node that answers: the one that is named, else the port itself, or what a source heats.
fn to(
    args: &ImpedanceArgs,
    input: &Input,
    (drive, name): (Drive, &str),
) -> Result<NodeId, Failure> {
    let network = &input.netlist.network;
    if let Some(name) = &args.to {
        return port(network, name).map_err(|error| unknown(input, &error));
    }
    let heated = |id: lptn_network::SourceId| match network.sources()[id.index()].into[..] {
        [(node, _)] => Some(node),
        _ => None,
    };
    let found = match drive {
        Drive::Node(node) => Some(node),
        Drive::Source(source) => heated(source),
        Drive::Boundary(_) => None,
    };
    found.ok_or_else(|| {
        let message = format!("which node answers `{name}`?");
        let help = "name it: --to NODE";
        Failure::new(Exit::Input, Diagnostic::error("impedance::no_node", message).help(help))
    })
}

/// Whether a node is what is heated.
fn is_at(network: &Network, drive: Drive, to: NodeId) -> bool {
    match drive {
        Drive::Node(node) => node == to,
        Drive::Source(source) => network.sources()[source.index()].into[..] == [(to, 1.0)],
        Drive::Boundary(_) => false,
    }
}

fn no_port(input: &Input) -> Failure {
    let network = &input.netlist.network;
    let heated = network.sources().first().and_then(|source| source.into.first());
    let likely = heated.map_or("NODE", |(node, _)| &network.nodes()[node.index()].name);
    let message = format!("where does the heat go into {}?", input.text.name);
    let file = input.typed().unwrap_or_else(|| "-".into());
    let help = format!(
        "name a node, source or boundary: `lptn impedance {file} --port {}`",
        quoted(likely)
    );
    Failure::new(Exit::Input, Diagnostic::error("impedance::no_port", message).help(help))
}

fn pulses_elsewhere() -> Failure {
    let message = "pulses are known where the heat goes in: elsewhere the highest rise comes later";
    let help = "leave --to or --duty out, or let `lptn steady --periodic` find the settled pulses";
    Failure::new(Exit::Input, Diagnostic::error("impedance::pulses_elsewhere", message).help(help))
}

fn nothing_to_write() -> Failure {
    let message = "--write writes an R-tau table or a ladder, and neither is asked for";
    let help = "add --foster or --cauer";
    Failure::new(Exit::Input, Diagnostic::error("impedance::nothing_to_write", message).help(help))
}

fn unknown(input: &Input, error: &ReduceError) -> Failure {
    input.failure(error, None)
}

fn failed(input: &Input, error: &ResponseError) -> Failure {
    let place = match error {
        ResponseError::NoGround { names } => names.first().and_then(|name| input.node_place(name)),
        ResponseError::Input(error) => input.place_of(error),
        ResponseError::Linearised(error) => lptn_answer::operating_point::place(input, error),
        _ => None,
    };
    input.failure(error, place)
}
