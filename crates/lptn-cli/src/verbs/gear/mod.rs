//! `lptn gear`

mod args;

pub(crate) use args::GearArgs;

use std::sync::Arc;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::gear::GearQuestion;
use lptn_answer::input::Input;

use crate::console::Console;
use crate::input::Load as _;

pub(crate) fn gear(args: &GearArgs, console: &Console) -> Result<Exit, Failure> {
    let question = GearQuestion {
        gearbox: args.gearbox.clone(),
        speeds: args.speed.clone(),
        torques: args.torque.clone(),
        temperatures: args.temperature.clone(),
        temperature_unit: args.scale.temperature_unit.clone(),
    };
    let input = Arc::new(Input::load(&args.source)?);
    let answer = question.ask(Arc::clone(&input))?;
    console.warn(answer.files(), &input.netlist.warnings);
    let exit = console.show(&answer, args.printed.format)?;
    console.warn(answer.files(), &answer.doubts_of_ranges());
    Ok(exit)
}
