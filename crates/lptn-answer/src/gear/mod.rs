//! Gears: speeds, torques, and the loss of each part.

mod figure;
mod map;
mod page;
mod tables;

use std::sync::Arc;

use lptn_netlist::{Diagnostic, Files, Gearbox};
use lptn_network::Item;
use lptn_solve::OutOfRange;
use lptn_study::{GearError, GearPoint, GearState, GearTask};
use lptn_units::{Dimension, Problem as _, Type, Unit};

use crate::answer::Answer;
use crate::example;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input};
use crate::ranges;
use crate::studies::Studies;

/// Most points of a question: no one reads more.
const MOST_POINTS: usize = 1000;

/// Default speeds at which gears are evaluated, as shares of their own speed.
const FIFTHS: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

const GEARBOXES: Studies = Studies {
    section: "gearbox",
    codes: ["gear::no_gearbox", "gear::which_gearbox"],
    question: "gears are described in a gearbox",
    example: example::gearbox,
};

/// The question for speeds, torques and losses of gears. Quantities are text with their units.
#[derive(Clone, Debug, Default)]
pub struct GearQuestion {
    /// The gearbox, with those that it drives; `None` for the only one.
    pub gearbox: Option<String>,
    /// Speeds of the input, `3000rpm`; none for fifths of its speed.
    pub speeds: Vec<String>,
    /// Torques on the input, `10 N m`; none for its own.
    pub torques: Vec<String>,
    /// Temperatures at which all nodes are fixed, `40degC`; none for the steady state.
    pub temperatures: Vec<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
}

/// Speeds, torques and losses of gears, and how they are shown.
#[derive(Debug)]
pub struct GearAnswer {
    input: Arc<Input>,
    /// The first gearbox by its position in the netlist.
    first: usize,
    /// Every load and state of the oil.
    pub blocks: Vec<Block>,
    /// The unit of temperatures.
    pub unit: Unit,
}

impl GearQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A gearbox that does not exist, a text that is not a quantity, and too many points.
    /// Gears or temperatures that cannot be computed.
    pub fn ask(&self, input: Arc<Input>) -> Result<GearAnswer, Failure> {
        let first = first(&input, self.gearbox.as_deref())?;
        let task = task(&input, first);
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), &input.netlist)?;
        let blocks = self.blocks(&input, &task)?;
        Ok(GearAnswer { input, first, blocks, unit })
    }

    fn blocks(&self, input: &Input, task: &GearTask<'_>) -> Result<Vec<Block>, Failure> {
        let list = |option: &str, texts: &[String], ty: Type| -> Result<Vec<f64>, Failure> {
            let one = |text: &String| Ok(input::quantity(option, text.trim(), ty)?.value);
            texts.iter().map(one).collect()
        };
        let mut speeds = list("--speed", &self.speeds, Type::of(Dimension::ANGULAR_VELOCITY))?;
        let torques = list("--torque", &self.torques, Type::of(Dimension::TORQUE))?;
        let held = list("--temperature", &self.temperatures, Type::ABSOLUTE_TEMPERATURE)?;
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
            return Err(Failure::refused(
                "gear::too_many_points",
                message,
                "name fewer speeds, torques or temperatures",
            ));
        }
        let loads = torques.iter().flat_map(|load| held.iter().map(move |held| (*load, *held)));
        let block = |(load, temperature): (Option<f64>, Option<f64>)| {
            let state = |speed: &f64| {
                let point = GearPoint { speed: Some(*speed), torque: load, temperature };
                let state = task.at(point).map_err(|error| failed((input, task), &error))?;
                Ok((*speed, state))
            };
            let states: Result<Vec<_>, Failure> = speeds.iter().map(state).collect();
            Ok(Block { temperature, states: states? })
        };
        loads.map(block).collect()
    }
}

/// The gearbox of this name, or the only one that no other drives, by its position.
fn first(input: &Input, name: Option<&str>) -> Result<usize, Failure> {
    let all: Vec<(usize, &Gearbox)> = input.netlist.gearboxes().iter().enumerate().collect();
    let heads: Vec<(usize, &Gearbox)> =
        all.iter().copied().filter(|(_, gearbox)| gearbox.driver.is_none()).collect();
    let of = if name.is_some() { &all } else { &heads };
    GEARBOXES.find(input, (of, |(_, gearbox)| &gearbox.name), name).map(|(at, _)| *at)
}

/// The question to the library, of a gearbox and those that it drives.
fn task(input: &Input, first: usize) -> GearTask<'_> {
    let gearboxes = input.netlist.gearboxes();
    GearTask {
        network: &input.netlist.network,
        stages: GearTask::train(gearboxes, &gearboxes[first]),
        time: input.netlist.run.as_ref().map_or(0.0, |run| run.start),
    }
}

/// One load and state of the oil over speeds.
#[derive(Debug)]
pub struct Block {
    /// The temperature of all nodes in K, if it is fixed.
    pub temperature: Option<f64>,
    /// Speeds of the input in rad/s with the state of the gears.
    pub states: Vec<(f64, GearState)>,
}

fn at_rest(input: &Input, task: &GearTask<'_>) -> Failure {
    let first = task.stages[0];
    let message = format!("gearbox `{}` stands still at {} s", first.name, task.time);
    let problem = Diagnostic::error("gear::at_rest", message).at(Some(first.span.clone()), "");
    input.refused(Exit::Input, problem.help("give the speeds: `--speed 1000rpm,3000rpm`"))
}

fn failed((input, task): (&Input, &GearTask<'_>), error: &GearError) -> Failure {
    let first = task.stages[0];
    input.refused(error.class().into(), told(error).at(Some(first.span.clone()), ""))
}

impl Answer for GearAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts_of_ranges()].concat()
    }
}

impl GearAnswer {
    fn task(&self) -> GearTask<'_> {
        task(&self.input, self.first)
    }

    /// Doubts in formulas that are outside their ranges.
    pub fn doubts_of_ranges(&self) -> Vec<Diagnostic> {
        ranges::warnings(&self.input.netlist, &self.outside(), false)
    }

    fn states(&self) -> impl Iterator<Item = (&Block, f64, &GearState)> {
        self.blocks.iter().flat_map(|b| b.states.iter().map(move |(speed, s)| (b, *speed, s)))
    }

    /// Values that were outside their range at any point, part by part.
    fn outside(&self) -> Vec<OutOfRange> {
        let Some((_, _, first)) = self.states().next() else { return Vec::new() };
        let time = self.task().time;
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
