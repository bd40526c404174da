//! Response of a node to heat or a boundary temperature: after a step, to pulses, by frequency.

mod chain;
mod chain_page;
mod curve;
mod figure;
mod lists;
mod netlist;
mod page;
mod posed;

pub use chain::Chain;

use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files};
use lptn_network::{Item, Network, NodeId};
use lptn_reduce::{ReduceError, port};
use lptn_solve::{Complex, Drive, Linearised, ResponseError, Snapshot, StepAnswer, Tried};
use posed::Posed;

use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::{Input, quoted};
use crate::listener::Listener;
use crate::operating_point::{self, OperatingPoint};

/// Asks for the response of a node to heat or to the temperature of a boundary.
#[derive(Clone, Debug, Default)]
pub struct ImpedanceQuestion {
    /// The input: the name of a node or source for heat, of a boundary for its temperature.
    /// The question needs it.
    pub port: Option<String>,
    /// The node that responds; `None` for the port, or for the node that it heats.
    pub to: Option<String>,
    /// Input and form of the response.
    pub form: Form,
    /// The state at which a nonlinear network is linearised, `steady` or a time of its run.
    /// `None` for a network that is linear.
    pub at: Option<String>,
    /// True if a netlist of the answer is to be written.
    /// A form that has none is then refused before anything is computed.
    pub writes: bool,
}

/// Input and form of a response.
#[derive(Clone, Debug)]
pub enum Form {
    /// To a step, at times after it.
    Step {
        /// The times: `1ms,1s`; `None` for three a decade.
        times: Option<String>,
        /// The shares of their period that pulses take: `0.5,0.1`; `None` for no pulses.
        shares: Option<String>,
    },
    /// To a swing, at frequencies in rad/s or Hz; `None` for three a decade.
    Swing(Option<String>),
    /// To a step, as elements.
    Chain {
        /// Number of terms; `None` for as many as matter.
        count: Option<usize>,
        /// True for a ladder of capacities and resistances, false for a sum of exponentials.
        ladder: bool,
    },
}

impl Default for Form {
    fn default() -> Self {
        Self::Step { times: None, shares: None }
    }
}

/// An answer and how it is shown.
#[derive(Debug)]
pub struct ImpedanceAnswer {
    input: Arc<Input>,
    question: ImpedanceQuestion,
    /// Name of the input.
    name: String,
    /// Name of the node that responds.
    to: String,
    drive: Drive,
    /// The answer of the node.
    pub found: Found,
    /// The shares of their periods that pulses take.
    shares: Vec<f64>,
    /// The state near which the network is taken for a linear one.
    point: Option<OperatingPoint>,
    tried: Option<Tried>,
}

impl ImpedanceQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A port or node that does not exist, and a question that does not fit the netlist.
    /// A network that is not linear or has no answer.
    pub fn ask(
        &self,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<ImpedanceAnswer, Failure> {
        let network = &input.netlist.network;
        let name = self.port.as_deref().ok_or_else(|| no_port(&input))?;
        let drive = drive(network, name).map_err(|error| unknown(&input, &error))?;
        let to = self.to(&input, (drive, name))?;
        let shares = self.form.shares()?;
        if !(shares.is_empty() || is_at(network, drive, to)) {
            return Err(pulses_elsewhere());
        }
        if self.writes && !matches!(self.form, Form::Chain { .. }) {
            return Err(nothing_to_write());
        }
        let system = input.assemble()?;
        let point = self.at.as_deref().map(|text| OperatingPoint::find(text, &input, listener));
        let point = point.transpose()?;
        let state = point.as_ref().map(|point| &point.state);
        let found = self.found((&input, &system, state), (drive, to), &shares);
        let (found, tried) = match &point {
            Some(point) => point.passed(found, (&input, listener))?,
            None => found?,
        };
        let (question, name) = (self.clone(), name.to_owned());
        let to = network.nodes()[to.index()].name.clone();
        Ok(ImpedanceAnswer { input, question, name, to, drive, found, shares, point, tried })
    }

    /// The response of the node, and the check of the linear network.
    fn found(
        &self,
        (input, system, state): (&Input, &ThermalSystem, Option<&Snapshot>),
        (drive, to): (Drive, NodeId),
        shares: &[f64],
    ) -> Result<(Found, Option<Tried>), Failure> {
        let failed = |error: &ResponseError| failed(input, error);
        let mut linear = Linearised::of(system, state).map_err(|error| failed(&error.into()))?;
        let step = StepAnswer::new(&linear, drive);
        let even = vec![1.0; input.netlist.network.nodes().len()];
        let tried = linear.tried_along(step.as_ref().map_or(&even, |step| &step.settled));
        let tried = tried.map_err(|error| failed(&error.into()))?;
        let posed = Posed { question: self, input, linear: &linear, drive, to };
        Ok((posed.answer(step, shares)?, tried))
    }

    /// The node that responds: the named one, else the port itself or the node that a source heats.
    fn to(&self, input: &Input, (drive, name): (Drive, &str)) -> Result<NodeId, Failure> {
        let network = &input.netlist.network;
        if let Some(name) = &self.to {
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
            let message = format!("no node that responds to `{name}` is named");
            let help = "name it: --to NODE";
            Failure::refused("impedance::no_node", message, help)
        })
    }
}

impl Form {
    fn shares(&self) -> Result<Vec<f64>, Failure> {
        match self {
            Self::Step { shares: Some(text), .. } => lists::shares(text),
            _ => Ok(Vec::new()),
        }
    }
}

impl Answer for ImpedanceAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), self.doubts_of_state()].concat()
    }
}

impl ImpedanceAnswer {
    /// Note that times or frequencies are sorted, or listed without repetitions.
    pub fn reordered(&self) -> Option<String> {
        lists::reordered(&self.question.form)
    }

    /// Doubts in the state near which it is.
    fn doubts_of_state(&self) -> &[Diagnostic] {
        self.point.as_ref().map_or(&[], |point| &point.doubts)
    }
}

/// The answer of a node to 1 W of heat or 1 K of a boundary.
#[derive(Debug)]
pub enum Found {
    /// After a step.
    Step {
        /// The rise in the end in K.
        settled: f64,
        /// The rise at times.
        rows: Vec<Stepped>,
    },
    /// To a swing.
    Swing(Vec<Swung>),
    /// A chain of elements.
    Chain(Chain),
}

/// The answer at a time after a step.
#[derive(Clone, Debug)]
pub struct Stepped {
    /// The time after the step in s.
    pub time: f64,
    /// The rise in K.
    pub rise: f64,
    /// The highest rise of settled pulses of this length in K, one value a share.
    pub pulses: Vec<f64>,
}

/// The answer to a swing.
#[derive(Clone, Copy, Debug)]
pub struct Swung {
    /// The angular frequency in rad/s.
    pub omega: f64,
    /// Amplitude in K and phase against the swing.
    pub answer: Complex,
}

fn drive(network: &Network, name: &str) -> Result<Drive, ReduceError> {
    match network.item(name) {
        Ok(Item::Boundary(id)) => Ok(Drive::Boundary(id)),
        Ok(Item::Source(id)) => Ok(Drive::Source(id)),
        _ => port(network, name).map(Drive::Node),
    }
}

/// True if a node is the heated one.
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
    let message = format!("{}: no port is named", input.text.name);
    let file = input.typed().unwrap_or_else(|| "-".into());
    let help = format!(
        "name a node, source or boundary: `lptn impedance {file} --port {}`",
        quoted(likely)
    );
    Failure::refused("impedance::no_port", message, help)
}

fn pulses_elsewhere() -> Failure {
    let message = "pulses are computed only at the node that is heated: elsewhere the highest rise \
        comes later";
    let help = "leave --to or --duty out, or let `lptn steady --periodic` find the periodic steady \
        state";
    Failure::refused("impedance::pulses_elsewhere", message, help)
}

fn nothing_to_write() -> Failure {
    let message = "--write writes an R-tau table or a ladder, but neither is requested";
    let help = "add --foster or --cauer";
    Failure::refused("impedance::nothing_to_write", message, help)
}

fn unknown(input: &Input, error: &ReduceError) -> Failure {
    input.failure(error, None)
}

fn failed(input: &Input, error: &ResponseError) -> Failure {
    let place = match error {
        ResponseError::NoGround { names } => names.first().and_then(|name| input.node_place(name)),
        ResponseError::Input(error) => input.place_of(error),
        ResponseError::Linearised(error) => operating_point::place(input, error),
        _ => None,
    };
    input.failure(error, place)
}
