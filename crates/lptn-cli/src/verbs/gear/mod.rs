//! `lptn gear`

mod args;
mod figure;
mod page;
mod tables;

pub(crate) use args::GearArgs;

use lptn_netlist::{Diagnostic, Gearbox};
use lptn_network::Item;
use lptn_solve::OutOfRange;
use lptn_study::{GearError, GearPoint, GearState, GearTask};
use lptn_units::{Dimension, Problem as _, Type, Unit};

use crate::console::Console;
use crate::input::Load as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::{self, Input, Studies};
use lptn_answer::ranges;

/// More points than anybody reads are a mistake.
const MOST_POINTS: usize = 1000;

/// The speeds at which gears are looked at unless said: fifths of the one that they have.
const FIFTHS: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

const GEARBOXES: Studies = Studies {
    section: "gearbox",
    codes: ["gear::no_gearbox", "gear::which_gearbox"],
    question: "which gears turn?",
    example: "[gearbox.stage]\nteeth = { sun = 18, planet = 42, ring = 102 }\nplanets = 3\nspeed = \
              \"7000 rpm\"\ninto = \"steel\"",
};

pub(crate) fn gear(args: &GearArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let first = first(&input, args.gearbox.as_deref())?;
    let task = GearTask {
        network: &input.netlist.network,
        stages: GearTask::train(input.netlist.gearboxes(), first),
        time: input.netlist.run.as_ref().map_or(0.0, |run| run.start),
    };
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    let blocks = blocks(args, (&input, &task))?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let view = View { input: &input, task: &task, blocks, unit };
    let exit = console.show(&view, args.printed.format)?;
    console.warn(&input.netlist.files, &ranges::warnings(&input.netlist, &view.outside(), false));
    Ok(exit)
}

/// The gearbox of this name, or the only one that no other drives.
fn first<'a>(input: &'a Input, name: Option<&str>) -> Result<&'a Gearbox, Failure> {
    let all: Vec<&Gearbox> = input.netlist.gearboxes().iter().collect();
    let heads: Vec<&Gearbox> = all.iter().copied().filter(|g| g.driver.is_none()).collect();
    let of = if name.is_some() { &all } else { &heads };
    GEARBOXES.find(input, (of, |gearbox: &&Gearbox| &gearbox.name), name).copied()
}

/// One load and state of the oil over speeds.
struct Block {
    /// The temperature of all nodes in K, where it is held.
    temperature: Option<f64>,
    /// The speeds of the input in rad/s, and what the gears do there.
    states: Vec<(f64, GearState)>,
}

fn blocks(args: &GearArgs, of: (&Input, &GearTask<'_>)) -> Result<Vec<Block>, Failure> {
    let (input, task) = of;
    let list = |option: &str, texts: &[String], ty: Type| -> Result<Vec<f64>, Failure> {
        let one = |text: &String| Ok(input::quantity(option, text.trim(), ty)?.value);
        texts.iter().map(one).collect()
    };
    let mut speeds = list("--speed", &args.speed, Type::of(Dimension::ANGULAR_VELOCITY))?;
    let torques = list("--torque", &args.torque, Type::of(Dimension::TORQUE))?;
    let held = list("--temperature", &args.temperature, Type::ABSOLUTE_TEMPERATURE)?;
    let own = task.speed();
    if speeds.is_empty() {
        if own == 0.0 {
            return Err(at_rest(input, task));
        }
        speeds.extend(FIFTHS.map(|part| part * own));
    }
    let torques =
        if torques.is_empty() { vec![None] } else { torques.into_iter().map(Some).collect() };
    let held = if held.is_empty() { vec![None] } else { held.into_iter().map(Some).collect() };
    if speeds.len() * torques.len() * held.len() > MOST_POINTS {
        let message = format!("these are more than {MOST_POINTS} points");
        let problem = Diagnostic::error("gear::too_many_points", message);
        return Err(Failure::new(
            Exit::Input,
            problem.help("name fewer speeds, torques or temperatures"),
        ));
    }
    let loads = torques.iter().flat_map(|load| held.iter().map(move |held| (*load, *held)));
    let block = |(load, temperature): (Option<f64>, Option<f64>)| {
        let state = |speed: &f64| {
            let point = GearPoint { speed: Some(*speed), torque: load, temperature };
            let state = task.at(point).map_err(|error| failed(of, &error))?;
            Ok((*speed, state))
        };
        let states: Result<Vec<_>, Failure> = speeds.iter().map(state).collect();
        Ok(Block { temperature, states: states? })
    };
    loads.map(block).collect()
}

fn at_rest(input: &Input, task: &GearTask<'_>) -> Failure {
    let first = task.stages[0];
    let message = format!("gearbox `{}` stands still at {} s", first.name, task.time);
    let problem = Diagnostic::error("gear::at_rest", message).at(Some(first.span.clone()), "");
    input.refused(Exit::Input, problem.help("say at which speeds: `--speed 1000rpm,3000rpm`"))
}

fn failed((input, task): (&Input, &GearTask<'_>), error: &GearError) -> Failure {
    let first = task.stages[0];
    input.refused(error.class().into(), told(error).at(Some(first.span.clone()), ""))
}

/// What the gears do, to be shown.
struct View<'a> {
    input: &'a Input,
    task: &'a GearTask<'a>,
    blocks: Vec<Block>,
    /// The scale of temperatures.
    unit: Unit,
}

impl View<'_> {
    fn states(&self) -> impl Iterator<Item = (&Block, f64, &GearState)> {
        self.blocks.iter().flat_map(|b| b.states.iter().map(move |(speed, s)| (b, *speed, s)))
    }

    /// What was outside its range at any point, part by part.
    fn outside(&self) -> Vec<OutOfRange> {
        let Some((_, _, first)) = self.states().next() else { return Vec::new() };
        let time = self.task.time;
        let mut found = Vec::new();
        for (at, part) in first.losses.iter().enumerate() {
            let item = Item::Source(part.source);
            let all = self.states().flat_map(|(_, _, state)| &state.losses[at].outside);
            let mut all: Vec<OutOfRange> = all
                .map(|&(group, value)| OutOfRange {
                    item,
                    group,
                    value,
                    at: time,
                    from: time,
                    to: time,
                })
                .collect();
            all.sort_by_key(|of| of.group.name);
            found.extend(all);
        }
        found
    }
}
