//! `lptn steady`

mod args;
mod cycle;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::select;
use lptn_answer::steady::{SteadyAnswer, SteadyQuestion};
use lptn_report::Format;

pub(crate) use args::SteadyArgs;

use crate::console::Console;
use crate::input::Load as _;
use crate::verdict;

pub(crate) fn steady(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    if args.cycle.periodic {
        return cycle::cycle(args, console);
    }
    let question = SteadyQuestion {
        select: args.shown.select.clone(),
        temperature_unit: args.shown.scale.temperature_unit.clone(),
        balance: args.balance.clone(),
        format: args.shown.format,
        detail: console.detail,
        certify: args.certify,
    };
    let input = console.phases.timed("read", || Input::load(&args.source))?;
    let answer = question.ask(Arc::new(input), &console.listening())?;
    let netlist = &answer.input.netlist;
    console.warn(&netlist.files, &netlist.warnings);
    console.page(&answer, args.shown.format)?;
    beside(&answer, args.shown.format, console);
    Ok(verdict::conclude(&answer.judgement(), console))
}

/// Prints notes and warnings next to the result.
fn beside(answer: &SteadyAnswer, format: Format, console: &Console) {
    let netlist = &answer.input.netlist;
    if format == Format::Table {
        if let (Some(file), Some(_)) = (answer.input.typed(), &netlist.run) {
            console.next(&format!("lptn run {file}"));
        }
    } else {
        let hidden = select::hidden(netlist).filter(|_| answer.all);
        hidden.iter().for_each(|hidden| console.note(hidden));
        console.warn(&netlist.files, &answer.noted());
    }
    console.warn(&netlist.files, &answer.beside());
}
