//! Several nodes with paths between them, instead of a network.

use std::path::Path;
use std::sync::Arc;

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Derived, Diagnostic, Files};
use lptn_network::{NodeId, list_of};
use lptn_reduce::{
    Allowed, Deviation, Kept, KeptErrors, KeptReference, NortonEquivalent, Projected, ReduceError,
    port,
};
use lptn_report::{plain, significant};
use lptn_solve::largest_of_inputs;
use lptn_units::Unit;

use super::limit::Limit;
use super::loads;
use super::refused::failed;
use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::written;

/// Most nodes that are tried by default.
const MOST: usize = 20;

/// Asks for some nodes, with paths between them, instead of a network.
#[derive(Clone, Debug)]
pub struct KeepQuestion {
    /// The nodes to keep, at least one; a name counts once.
    pub keep: Vec<String>,
    /// Number of nodes that replace the network; `None` for the fewest that keep the limit.
    pub nodes: Option<usize>,
    /// The largest error of the run that is allowed: `0.5K`, `2%`.
    pub max_error: String,
    /// The largest error over every load that is allowed instead.
    pub error: Option<String>,
    /// The largest power of these loads, `250W`; `None` for the largest that a node sees.
    pub power: Option<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
}

/// The kept nodes, their errors and how they are shown.
#[derive(Debug)]
pub struct KeptAnswer {
    pub(super) input: Arc<Input>,
    pub(super) question: KeepQuestion,
    system: ThermalSystem,
    /// Names of the requested nodes, each once.
    pub names: Vec<String>,
    /// The reduced network.
    pub kept: Kept,
    /// Its errors at the requested nodes.
    pub errors: KeptErrors,
    /// The same number of modes instead of the nodes.
    pub projected: Projected,
    /// The largest power of the loads in W.
    pub power: f64,
    /// The largest error that is allowed, over the run or over every load.
    pub limit: Limit,
    /// The unit of temperatures.
    pub unit: Unit,
}

impl KeepQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A node that does not exist, a question that does not fit the netlist, and a network that
    /// cannot be reduced.
    pub fn ask(&self, input: Arc<Input>) -> Result<KeptAnswer, Failure> {
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), &input.netlist)?;
        let (option, text) = match &self.error {
            Some(text) => ("--error", text),
            None => ("--max-error", &self.max_error),
        };
        let limit = Limit::parse(option, text)?;
        let names = self.names();
        self.check(names.len())?;
        let network = &input.netlist.network;
        let mut nodes: Vec<NodeId> = Vec::with_capacity(names.len());
        for name in &names {
            nodes.push(port(network, name).map_err(|error| failed(&input, name, &error))?);
        }
        let system = input.assemble()?;
        let explain = |error: ReduceError| failed(&input, &names[0], &error);
        let run = input.netlist.run.as_ref().map(|run| RunAnalysis::of(network, run));
        let run = run.filter(|_| !network.has_events());
        let power = match &self.power {
            Some(text) => loads::power(text)?,
            None => largest(&system, &nodes, run.as_ref()).map_err(explain)?,
        };
        let compared = (run.as_ref(), limit.allowed);
        let found = self.found((&system, power), &nodes, compared).map_err(explain)?;
        let (kept, errors, projected) = found;
        let question = self.clone();
        Ok(KeptAnswer {
            input,
            question,
            system,
            names,
            kept,
            errors,
            projected,
            power,
            limit,
            unit,
        })
    }

    /// The names of the nodes to keep, each once.
    fn names(&self) -> Vec<String> {
        let mut seen: Vec<String> = Vec::new();
        for name in &self.keep {
            if !seen.contains(name) {
                seen.push(name.clone());
            }
        }
        seen
    }

    /// Refuses fewer nodes than are to be kept.
    fn check(&self, named: usize) -> Result<(), Failure> {
        let wrong = |message: String, help: &str| Failure::refused("reduce::nodes", message, help);
        match self.nodes {
            _ if named == 0 => {
                let help = "write for example --keep steel,housing";
                Err(wrong("--keep names no node".into(), help))
            }
            Some(count) if count < named => Err(wrong(
                format!("--keep names {named} nodes, and --nodes {count} is less"),
                "leave --nodes out, or keep fewer nodes",
            )),
            _ => Ok(()),
        }
    }

    /// The wanted number of nodes, or the least that keeps the limit, or the last that was tried.
    fn found(
        &self,
        (system, power): (&ThermalSystem, f64),
        nodes: &[NodeId],
        compared: (Option<&RunAnalysis>, Allowed),
    ) -> Result<(Kept, KeptErrors, Projected), ReduceError> {
        let mut next = self.nodes.unwrap_or(nodes.len());
        let reference = KeptReference::new(system, nodes, compared)?;
        loop {
            let (kept, errors) = Kept::new(system, &reference, next)?;
            let all = kept.count() < next;
            let holds = within(&errors, compared.1, (self.error.is_some(), power));
            if self.nodes.is_some() || holds || all || next >= MOST {
                let projected = Projected::new(system, &reference, kept.count())?;
                return Ok((kept, errors, projected));
            }
            next += 1;
        }
    }
}

/// The largest heat that any of these nodes sees over the run, or at the start.
fn largest(
    system: &ThermalSystem,
    nodes: &[NodeId],
    run: Option<&RunAnalysis>,
) -> Result<f64, ReduceError> {
    let mut most = 0.0_f64;
    for &node in nodes {
        let norton = NortonEquivalent::new(system, node)?;
        let span = run.map_or((0.0, 0.0), |run| (run.start(), run.stop()));
        let heat = largest_of_inputs(system, span, &|system, work| {
            norton.heat(system.source_powers(work))
        });
        most = most.max(heat.map_err(ReduceError::Input)?);
    }
    Ok(if most > 0.0 { most } else { 1.0 })
}

/// True if every requested node is within the limit, over the run or over every load.
/// A limit in K says nothing about loads that no one requested.
fn within(errors: &KeptErrors, allowed: Allowed, (every, power): (bool, f64)) -> bool {
    let loads = |(error, rise): &(f64, f64)| error * power <= allowed.of(rise * power);
    match &errors.run {
        Some(run) if !every => run.iter().all(|(error, _)| error.within(allowed)),
        _ => errors.loads.iter().all(loads),
    }
}

impl Answer for KeptAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.input.netlist.warnings.clone()
    }

    fn exit(&self) -> Exit {
        if self.holds() { Exit::Done } else { Exit::No }
    }
}

impl KeptAnswer {
    /// True if the limit is kept.
    pub fn holds(&self) -> bool {
        let every = (self.question.error.is_some(), self.power);
        within(&self.errors, self.limit.allowed, every)
    }

    /// True if the error of the run is judged, false if that over every load is.
    pub(super) fn judges_run(&self) -> bool {
        self.errors.run.is_some() && self.question.error.is_none()
    }

    /// "keeps `steel` and `housing` within 0.3 % (0.2 K) with 4 nodes".
    pub fn verdict(&self) -> String {
        let names = list_of(&self.names, "nodes");
        let count = crate::words::count(self.kept.count(), "node");
        let keep = if self.kept.count() == 1 { "keeps" } else { "keep" };
        let (share, kelvin, over) = match &self.errors.run {
            Some(run) if self.question.error.is_none() => {
                let worst =
                    |of: &dyn Fn(&(Deviation, f64)) -> f64| run.iter().map(of).fold(0.0, f64::max);
                let share = worst(&|(error, _)| error.relative.unwrap_or(0.0));
                (share, worst(&|(error, _)| error.kelvin), String::new())
            }
            _ => {
                let loads = &self.errors.loads;
                let share = |(error, rise): &(f64, f64)| error / rise;
                let share = loads.iter().map(share).fold(0.0, f64::max);
                let kelvin = loads.iter().map(|load| load.0 * self.power).fold(0.0, f64::max);
                (share, kelvin, format!(" over every load up to {} W", significant(self.power, 4)))
            }
        };
        if share < 1e-8 {
            return format!("{count} {keep} {names} exactly{over}");
        }
        let size = format!("{} % ({} K)", significant(100.0 * share, 2), significant(kelvin, 3));
        if self.holds() {
            format!("{count} {keep} {names} within {size}{over}")
        } else if self.kept.count() == 1 {
            format!("{count} does not keep {names}: it is {size} wrong{over}")
        } else {
            format!("{count} do not keep {names}: they are {size} wrong{over}")
        }
    }

    /// The reduced network as a netlist at `place`, or in the folder of the whole network.
    /// It was read again and compared.
    ///
    /// # Errors
    /// A network that cannot be written.
    pub fn netlist(&self, place: Option<&Path>) -> Result<String, Failure> {
        let run = self.input.netlist.run.as_ref();
        let network = self.kept.network(&self.system, run.map_or(0.0, |run| run.start));
        let network = network.map_err(|error| failed(&self.input, &self.names[0], &error))?;
        let kept = self.names.join(", ");
        let title = format!("{}, {kept} kept", self.input.title());
        let folder = place.map(|place| place.parent().unwrap_or(Path::new("")));
        let made = Derived { network: &network, title: &title, run, folder };
        let comment = format!(
            "# The network between {} of {}, by `lptn reduce`.\n# Verdict: {}.\n",
            plain(&kept),
            plain(&self.input.text.name),
            plain(&self.verdict())
        );
        let text = comment + &self.input.netlist.derived(&made);
        written::proven(text, place.unwrap_or(Path::new(&self.input.text.name)), &network, run)
    }

    /// Rows of CSV that give all temperatures by the kept ones.
    /// A row per node has the shares of kept nodes and boundaries, and the rise per source in K/W.
    ///
    /// # Errors
    /// Weights that cannot be computed.
    pub fn recovery(&self) -> Result<Vec<Vec<String>>, Failure> {
        let network = self.system.network();
        let recovery = self.kept.recovery(&self.system);
        let recovery = recovery.map_err(|error| failed(&self.input, &self.names[0], &error))?;
        let mut rows = vec![vec!["node".to_owned()]];
        let mut head = |name: &str, unit: &str| rows[0].push(format!("{name} [{unit}]"));
        for node in &self.kept.nodes {
            head(&network.nodes()[node.index()].name, "-");
        }
        network.boundaries().iter().for_each(|boundary| head(&boundary.name, "-"));
        network.sources().iter().for_each(|source| head(&source.name(), "K/W"));
        for (n, node) in network.nodes().iter().enumerate() {
            let all = [&self.kept.weights, &recovery.boundaries, &recovery.sources];
            // rounding alone is not a share
            let share = |value: f64| if value.abs() < 1e-15 { 0.0 } else { value };
            let shares = all.into_iter().flatten().map(|column| share(column[n]).to_string());
            rows.push([node.name.clone()].into_iter().chain(shares).collect());
        }
        Ok(rows)
    }

    /// Message if the error is larger than allowed:
    /// "too large: 2 nodes do not keep `a` and `b`: they are 8 % (1.2 K) wrong, and 5% is allowed".
    pub fn too_large(&self) -> Option<String> {
        let (verdict, limit) = (self.verdict(), &self.limit.text);
        (!self.holds()).then(|| format!("too large: {verdict}, and {limit} is allowed"))
    }

    /// The notes as lines by themselves, for CSV, which has no place for them.
    pub fn beside_rows(&self) -> Vec<String> {
        self.notes().iter().map(|note| format!("note: {note}")).collect()
    }
}
