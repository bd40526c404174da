//! `lptn reduce --keep a,b`: several nodes with what stands between them.

use std::fmt::Write as _;
use std::path::Path;

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Derived, Diagnostic};
use lptn_network::{NodeId, list_of};
use lptn_reduce::{
    Allowed, Kept, KeptErrors, KeptReference, NortonEquivalent, Projected, ReduceError, port,
};
use lptn_report::{Format, plain, significant};
use lptn_solve::largest_of_inputs;
use lptn_units::Unit;

use super::args::{ReduceArgs, ReduceFormat};
use super::{Limit, failed, loads};
use crate::console::Console;
use crate::input::Load as _;
use crate::{files, written};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input, quoted};

/// Most nodes that are tried where nobody says how many.
const MOST: usize = 20;

/// What is kept, and how it is shown.
pub(super) struct KeptView<'a> {
    pub(super) input: &'a Input,
    pub(super) args: &'a ReduceArgs,
    pub(super) system: &'a ThermalSystem,
    /// Names of the nodes asked for.
    pub(super) names: Vec<String>,
    pub(super) kept: Kept,
    pub(super) errors: KeptErrors,
    /// As many modes in place of the nodes.
    pub(super) projected: Projected,
    /// The largest power of the loads in W.
    pub(super) power: f64,
    /// What has to be kept, over the run or over every load.
    pub(super) limit: Limit,
    pub(super) unit: Unit,
}

pub(super) fn keep(args: &ReduceArgs, console: &Console, names: &str) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    let (option, text) = match &args.error {
        Some(text) => ("--error", text),
        None => ("--max-error", &args.max_error),
    };
    let limit = Limit::parse(option, text)?;
    let names = listed(names);
    let count = counted(args, names.len())?;
    let network = &input.netlist.network;
    let mut nodes: Vec<NodeId> = Vec::with_capacity(names.len());
    for name in &names {
        nodes.push(port(network, name).map_err(|error| failed(&input, name, &error))?);
    }
    let system = input.assemble()?;
    let explain = |error: ReduceError| failed(&input, &names[0], &error);
    let run = input.netlist.run.as_ref().map(|run| RunAnalysis::of(network, run));
    let run = run.filter(|_| !network.has_events());
    let power = match &args.power {
        Some(text) => loads::power(text)?,
        None => largest(&system, &nodes, run.as_ref()).map_err(explain)?,
    };
    let question = Question { args, system: &system, run: run.as_ref(), limit: &limit, power };
    let (kept, errors, projected) = question.answer(&nodes, count).map_err(explain)?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let view = KeptView {
        input: &input,
        args,
        system: &system,
        names,
        kept,
        errors,
        projected,
        power,
        limit,
        unit,
    };
    view.show(console)?;
    Ok(view.conclude(console))
}

/// `a,b` or `bar[1,1,1],b`: a comma within brackets is part of a name. Each once.
fn listed(text: &str) -> Vec<String> {
    let mut names = vec![String::new()];
    let mut depth = 0_i32;
    for c in text.chars() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        match names.last_mut() {
            Some(name) if c != ',' || depth > 0 => name.push(c),
            _ => names.push(String::new()),
        }
    }
    let mut seen: Vec<String> = Vec::new();
    for name in names.iter().map(|name| name.trim()).filter(|name| !name.is_empty()) {
        if !seen.iter().any(|other| other == name) {
            seen.push(name.to_owned());
        }
    }
    seen
}

/// That a recovery was asked for without nodes to recover from.
pub(super) fn recovers_nothing() -> Failure {
    let problem = Diagnostic::error("reduce::nodes", "--recover follows from nodes that are kept");
    Failure::new(
        Exit::Input,
        problem.help("write for example --keep steel,housing --recover all.csv"),
    )
}

/// How many nodes are asked for.
fn counted(args: &ReduceArgs, named: usize) -> Result<Option<usize>, Failure> {
    let wrong = |message: String, help: &str| {
        Failure::new(Exit::Input, Diagnostic::error("reduce::nodes", message).help(help))
    };
    if named == 0 {
        return Err(wrong("--keep names no node".into(), "write for example --keep steel,housing"));
    }
    match args.nodes {
        Some(count) if count < named => Err(wrong(
            format!("--keep names {named} nodes, and --nodes {count} is less"),
            "leave --nodes out, or keep fewer nodes",
        )),
        count => Ok(count),
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

struct Question<'a> {
    args: &'a ReduceArgs,
    system: &'a ThermalSystem,
    run: Option<&'a RunAnalysis>,
    limit: &'a Limit,
    power: f64,
}

impl Question<'_> {
    /// So many nodes, or the smallest number that keeps the limit, or the last that was tried.
    fn answer(
        &self,
        nodes: &[NodeId],
        count: Option<usize>,
    ) -> Result<(Kept, KeptErrors, Projected), ReduceError> {
        let mut next = count.unwrap_or(nodes.len());
        let reference = KeptReference::new(self.system, nodes, (self.run, self.limit.allowed))?;
        loop {
            let (kept, errors) = Kept::new(self.system, &reference, next)?;
            let all = kept.count() < next;
            let holds =
                within(&errors, self.limit.allowed, (self.args.error.is_some(), self.power));
            if count.is_some() || holds != Some(false) || all || next >= MOST {
                let projected = Projected::new(self.system, &reference, kept.count())?;
                return Ok((kept, errors, projected));
            }
            next += 1;
        }
    }
}

/// Whether every node asked for is within the limit: over every load, or over the run where there
/// is one. A limit in K says nothing of loads that nobody asked about.
fn within(errors: &KeptErrors, allowed: Allowed, (every, power): (bool, f64)) -> Option<bool> {
    let loads = |(error, rise): &(f64, f64)| error * power <= allowed.of(rise * power);
    match &errors.run {
        Some(run) if !every => Some(run.iter().all(|(error, _)| error.within(allowed))),
        _ => Some(errors.loads.iter().all(loads)),
    }
}

impl KeptView<'_> {
    /// Whether the limit is kept.
    pub(super) fn holds(&self) -> bool {
        let every = (self.args.error.is_some(), self.power);
        within(&self.errors, self.limit.allowed, every) != Some(false)
    }

    /// "keeps `steel` and `housing` within 0.3 % (0.2 K) with 4 nodes".
    pub(super) fn verdict(&self) -> String {
        let names = list_of(&self.names, "nodes");
        let count = lptn_answer::words::count(self.kept.count(), "node");
        let keep = if self.kept.count() == 1 { "keeps" } else { "keep" };
        let (share, kelvin, over) = match &self.errors.run {
            Some(run) if self.args.error.is_none() => {
                let worst = |of: &dyn Fn(&(lptn_reduce::Deviation, f64)) -> f64| {
                    run.iter().map(of).fold(0.0, f64::max)
                };
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

    fn show(&self, console: &Console) -> Result<(), Failure> {
        if let Some(path) = &self.args.write {
            files::write_new(path, &self.netlist(Some(path))?, "reduce::exists")?;
        }
        if let Some(path) = &self.args.recover {
            files::write_new(path, &self.recovery()?, "reduce::exists")?;
        }
        match self.args.format {
            ReduceFormat::Of(format) => console.show(self, format).map(drop)?,
            ReduceFormat::Toml => console.print(&self.netlist(None)?).map(drop)?,
        }
        if self.args.format == ReduceFormat::Of(Format::Csv) {
            self.notes().iter().for_each(|note| console.note(&format!("note: {note}")));
        }
        if let Some(path) = &self.args.recover {
            console.note(&format!("wrote  {}: all temperatures from the kept", path.display()));
        }
        if let Some(path) = &self.args.write {
            let name = &self.input.text.name;
            console.note(&format!("wrote  {}: nodes that stand for {name}", path.display()));
            if self.input.netlist.run.is_some() {
                console.next(&format!("lptn run {}", quoted(&path.display().to_string())));
            }
        }
        Ok(())
    }

    fn netlist(&self, place: Option<&Path>) -> Result<String, Failure> {
        let run = self.input.netlist.run.as_ref();
        let network = self.kept.network(self.system, run.map_or(0.0, |run| run.start));
        let network = network.map_err(|error| failed(self.input, &self.names[0], &error))?;
        let kept = self.names.join(", ");
        let title = format!("{}, {kept} kept", self.input.title());
        let folder = place.map(|place| place.parent().unwrap_or(Path::new("")));
        let made = Derived { network: &network, title: &title, run, folder };
        let comment = format!(
            "# What stands between {} of {}, by `lptn reduce`.\n# Verdict: {}.\n",
            plain(&kept),
            plain(&self.input.text.name),
            plain(&self.verdict())
        );
        let text = comment + &self.input.netlist.derived(&made);
        written::proven(text, place.unwrap_or(Path::new(&self.input.text.name)), &network, run)
    }

    /// A row a node: shares of kept nodes and boundaries, and the rise for each source.
    fn recovery(&self) -> Result<String, Failure> {
        let network = self.system.network();
        let recovery = self.kept.recovery(self.system);
        let recovery = recovery.map_err(|error| failed(self.input, &self.names[0], &error))?;
        let mut text = "node".to_owned();
        let mut head = |name: &str, unit: &str| _ = write!(text, ",{} [{unit}]", cell(name));
        for node in &self.kept.nodes {
            head(&network.nodes()[node.index()].name, "-");
        }
        network.boundaries().iter().for_each(|boundary| head(&boundary.name, "-"));
        network.sources().iter().for_each(|source| head(&source.name(), "K/W"));
        text.push('\n');
        for (n, node) in network.nodes().iter().enumerate() {
            text += &cell(&node.name);
            let all = [&self.kept.weights, &recovery.boundaries, &recovery.sources];
            for column in all.into_iter().flatten() {
                // what rounding leaves is no share
                let value = if column[n].abs() < 1e-15 { 0.0 } else { column[n] };
                _ = write!(text, ",{value}");
            }
            text.push('\n');
        }
        Ok(text)
    }

    fn conclude(&self, console: &Console) -> Exit {
        if self.holds() {
            return Exit::Done;
        }
        console.message(&format!(
            "too large: {}, and {} is allowed",
            self.verdict(),
            self.limit.text
        ));
        Exit::No
    }
}

/// A name as a cell of a CSV file.
fn cell(name: &str) -> String {
    if name.contains([',', '"']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}
