//! One node, or a few, instead of a network, and their errors.

mod figure;
mod keep;
mod keep_page;
mod limit;
mod loads;
mod near;
mod notes;
mod page;
mod refused;
mod verdict;

pub use keep::{KeepQuestion, KeptAnswer};
pub use limit::Limit;
pub use loads::Loads;
pub use refused::not_near_a_state;

use std::path::Path;
use std::sync::Arc;

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Derived, Diagnostic, Files};
use lptn_network::NodeId;
use lptn_reduce::{
    Bias, Definition, Deviation, FitError, Judge, Nodes, Pair, ReduceError, Reduction,
    ReductionOptions, port,
};
use lptn_report::{plain, significant};
use lptn_units::{Dimension, Type, Unit};

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::words::count;
use crate::written;
use near::Near;
use refused::{failed, no_port, no_run};

/// Asks for one node, or a few, instead of a network that is seen from one of its nodes.
#[derive(Clone, Debug)]
pub struct ReduceQuestion {
    /// The node that the network is seen from. The question needs it.
    pub port: Option<String>,
    /// The largest error of the run or of a step that is allowed: `0.5K`, `2%`.
    pub max_error: String,
    /// The largest error over every load that is allowed, `0.1K` or `1%`: as few nodes as keep it.
    pub error: Option<String>,
    /// The largest power of these loads, `250W`; `None` for the largest that the port sees.
    pub power: Option<String>,
    /// Number of nodes; `None` for one, or for the fewest that keep `error`.
    pub nodes: Option<usize>,
    /// The error by which a definition of `C_eq` is recommended.
    pub judge: Judge,
    /// The definition of `C_eq` to use; `None` for the recommended one.
    pub definition: Option<Definition>,
    /// True if one exponential is fitted to the run, to give the heat that it implies.
    pub bias: bool,
    /// The time over which `least_squares` fits, `20s`.
    /// `None` for five of the slowest time constants.
    pub window: Option<String>,
    /// The state at which a nonlinear network is reduced, `steady` or a time of its run.
    /// `None` for the whole network.
    pub at: Option<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
}

impl Default for ReduceQuestion {
    fn default() -> Self {
        Self {
            port: None,
            max_error: "5%".to_owned(),
            error: None,
            power: None,
            nodes: None,
            judge: Judge::default(),
            definition: None,
            bias: false,
            window: None,
            at: None,
            temperature_unit: None,
        }
    }
}

/// A reduction, its verdict and how it is shown.
#[derive(Debug)]
pub struct ReduceAnswer {
    input: Arc<Input>,
    question: ReduceQuestion,
    /// The node that the network is seen from.
    port: String,
    system: ThermalSystem,
    /// The network as one node, with the errors of every definition.
    pub reduction: Reduction,
    /// Errors over every load, and the nodes that are judged and written.
    pub loads: Loads,
    /// The heat that one exponential through the run implies, if it was requested.
    pub bias: Option<Result<Bias, FitError>>,
    /// The state near which the reduction is valid.
    near: Option<Near>,
    /// The unit of temperatures.
    pub unit: Unit,
    /// The largest error of the run or of a step that is allowed.
    pub limit: Limit,
}

impl ReduceQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A node that does not exist, a question that does not fit the netlist, and a network that
    /// cannot be reduced.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<ReduceAnswer, Failure> {
        let name = self.port.as_deref().ok_or_else(|| no_port(&input))?;
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), &input.netlist)?;
        let limit = Limit::parse("--max-error", &self.max_error)?;
        if let (Some(option), Some(_)) = (self.about_the_run(&limit).last(), &self.at) {
            return Err(not_near_a_state(option));
        }
        let window = self.window.as_deref().map(window).transpose()?;
        let about_the_run = self.about_the_run(&limit).next();
        if let (Some(option), None) = (about_the_run, &input.netlist.run) {
            return Err(no_run(&input, option));
        }
        let system = input.assemble()?;
        let explain = |error: ReduceError| failed(&input, name, &error);
        let port = port(&input.netlist.network, name).map_err(explain)?;
        let run = input.netlist.run.as_ref();
        let run = run.map(|run| RunAnalysis::of(&input.netlist.network, run));
        let compared = about_the_run.is_some() || !system.network().has_events();
        let compared = run.clone().filter(|_| compared && self.at.is_none());
        let (judge, allowed) = (self.judge, limit.allowed);
        let options = ReductionOptions { run: compared, window, judge, allowed };
        let near = self.at.as_deref().map(|text| Near::find(text, &input, listener));
        let mut near = near.transpose()?;
        let found = self.found(&input, (&system, port), (&mut near, &options));
        let (reduction, loads) = match &near {
            Some(near) => near.passed(found, (&input, listener))?,
            None => found?,
        };
        let bias = self.fitted(&system, (port, run.as_ref())).map_err(explain)?;
        let (question, port) = (self.clone(), name.to_owned());
        Ok(ReduceAnswer {
            input,
            question,
            port,
            system,
            reduction,
            loads,
            bias,
            near,
            unit,
            limit,
        })
    }

    /// The reduction, and its errors over every load.
    fn found(
        &self,
        input: &Input,
        (system, port): (&ThermalSystem, NodeId),
        (near, options): (&mut Option<Near>, &ReductionOptions),
    ) -> Result<(Reduction, Loads), Failure> {
        let name = &input.netlist.network.nodes()[port.index()].name;
        let explain = |error: ReduceError| failed(input, name, &error);
        let reduction = match near {
            Some(near) => near.reduce((system, port), options),
            None => Reduction::new(system, port, options),
        };
        let reduction = reduction.map_err(explain)?;
        let compared = (options.run.as_ref(), options.allowed);
        let loads = Loads::new((self, system), compared, &reduction, &explain)?;
        Ok((reduction, loads))
    }

    /// The options that ask for the run.
    fn about_the_run(&self, limit: &Limit) -> impl Iterator<Item = &'static str> + use<> {
        let options = [
            (limit.is_in_kelvin(), "--max-error in K"),
            (self.judge == Judge::Run, "--for run"),
            (self.bias, "--bias"),
        ];
        options.into_iter().filter(|(asks, _)| *asks).map(|(_, option)| option)
    }

    /// One exponential through the run, if that is requested.
    fn fitted(
        &self,
        system: &ThermalSystem,
        (port, run): (NodeId, Option<&RunAnalysis>),
    ) -> Result<Option<Result<Bias, FitError>>, ReduceError> {
        let run = run.filter(|_| self.bias);
        run.map(|run| Bias::new(system, port, run)).transpose()
    }
}

fn window(text: &str) -> Result<f64, Failure> {
    input::quantity("--window", text, Type::of(Dimension::TIME)).map(|quantity| quantity.value)
}

impl Answer for ReduceAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), self.doubts_of_state()].concat()
    }

    fn exit(&self) -> Exit {
        if self.too_large().is_some() { Exit::No } else { Exit::Done }
    }
}

impl ReduceAnswer {
    /// The node that the network is seen from.
    pub fn port(&self) -> &str {
        &self.port
    }

    /// The pair that is judged and written: the requested one, else the recommended one.
    pub fn pair(&self) -> Option<&Pair> {
        let dynamics = self.reduction.dynamics.as_ref()?;
        let asked = self.loads.nodes.as_ref().and_then(|nodes| nodes.definition);
        let asked = asked.or(self.question.definition).and_then(|d| dynamics.pair(d));
        Some(asked.unwrap_or(dynamics.best()))
    }

    /// The error that is judged, and whether it is within the limit.
    /// That is `None` for the error of a step, which a limit in K does not judge.
    pub fn judged(&self) -> Option<(Judge, Deviation, Option<bool>)> {
        let dynamics = self.reduction.dynamics.as_ref()?;
        if let Some((judge, error)) = self.loads.error {
            let can = judge == Judge::Run || !self.limit.is_in_kelvin();
            return Some((judge, error, can.then(|| error.within(self.limit.allowed))));
        }
        let pair = self.pair()?;
        let (judge, error) = dynamics.judged(pair)?;
        Some((judge, error, dynamics.collapses(pair)))
    }

    /// The network of the nodes as a netlist at `place`, or in the folder of the whole network.
    /// It was read again and compared.
    ///
    /// # Errors
    /// A network that cannot be written, and one near a state.
    pub fn netlist(&self, place: Option<&Path>) -> Result<String, Failure> {
        if self.near.is_some() {
            return Err(not_near_a_state("a netlist"));
        }
        let run = self.input.netlist.run.as_ref();
        let start = run.map_or(0.0, |run| run.start);
        let network = match &self.loads.nodes {
            Some(nodes) => self.reduction.network_of(&self.system, start, nodes),
            None => self.reduction.network(&self.system, start, self.pair()),
        };
        let network = network.map_err(|error| failed(&self.input, &self.port, &error))?;
        let title = format!("{}, seen from {}", self.input.title(), self.port);
        let folder = place.map(|place| place.parent().unwrap_or(Path::new("")));
        let made = Derived { network: &network, title: &title, run, folder };
        let text = self.comment() + &self.input.netlist.derived(&made);
        written::proven(text, place.unwrap_or(Path::new(&self.input.text.name)), &network, run)
    }

    fn comment(&self) -> String {
        let from = plain(&self.input.text.name);
        let mut text = format!(
            "# The network that `{}` of {from} sees, by `lptn \
            reduce`.\n",
            self.port
        );
        if self.reduction.dynamics.is_some() {
            text += &format!("# Verdict: {}.\n", self.verdict());
        }
        if let Some(definition) = self.definition() {
            text += &format!("# C_eq by {}.\n", definition.key());
        }
        text
    }

    /// Message if the error is larger than allowed; `None` if it is not, or if nothing is judged.
    /// "too large: with C_eq by sum the error reaches 1.2 K (8 %), and 5% is allowed".
    pub fn too_large(&self) -> Option<String> {
        if self.fails() {
            return Some(self.verdict());
        }
        if let Some(kept) = self.loads.kept() {
            return (!kept).then(|| format!("too large: {}", self.verdict()));
        }
        let Some((judge, error, Some(false))) = self.judged() else { return None };
        let share = error.relative.map(|r| format!("{} %", significant(100.0 * r, 3)));
        let kelvin = (judge == Judge::Run).then(|| format!("{} K", significant(error.kelvin, 3)));
        let size = match (kelvin, share) {
            (Some(kelvin), Some(share)) => format!("{kelvin} ({share})"),
            (kelvin, share) => kelvin.or(share).unwrap_or_default(),
        };
        let with = match self.definition() {
            Some(definition) => format!("C_eq by {}", definition.key()),
            None => count(self.count(), "node"),
        };
        let limit = &self.limit.text;
        Some(format!("too large: with {with} the error reaches {size}, and {limit} is allowed"))
    }

    /// Number of nodes that are judged and written.
    pub fn count(&self) -> usize {
        self.loads.nodes.as_ref().map_or(1, Nodes::count)
    }

    /// The definition of the `C_eq` that is judged; `None` for several nodes, or no capacity.
    pub fn definition(&self) -> Option<Definition> {
        match &self.loads.nodes {
            Some(nodes) => nodes.definition,
            None => self.pair().map(|pair| pair.definition),
        }
    }

    /// True if the reduction is valid near a state only.
    pub fn is_near_a_state(&self) -> bool {
        self.near.is_some()
    }

    fn doubts_of_state(&self) -> &[Diagnostic] {
        self.near.as_ref().map_or(&[], Near::doubts)
    }
}
