//! `lptn graph`

mod args;
mod output;
mod place;

pub(crate) use args::GraphArgs;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::graph::{Drawn, GraphQuestion, Kind};
use lptn_answer::input::Input;

use crate::console::Console;
use crate::input::Load as _;

pub(crate) fn graph(args: &GraphArgs, console: &Console) -> Result<Exit, Failure> {
    if console.plot.is_some() {
        return Err(Failure::refused(
            "graph::format",
            "--plot draws curves, not the network",
            "write -o FILE instead",
        ));
    }
    let only = args.only_a_picture();
    let (kind, place) = place::wanted(args.format, args.output.as_deref(), only)?;
    let question = args.question(kind);
    let input = Arc::new(Input::load(&args.source)?);
    // doubts are printed as they come up
    let answer = question.ask(Arc::clone(&input), &console.listening())?;
    answer.note.iter().for_each(|note| console.note(note));
    output::put(&answer.bytes, (&place, &answer.name), &input, console)?;
    let plain = !question.shows_state() && !question.is_of_grid();
    if let (true, Some(file)) = (plain, input.typed()) {
        console.next(&format!("lptn graph {file} --steady"));
    } else if let (true, Some(file)) = (question.shows_state(), input.typed()) {
        console.next(&format!("lptn run {file} --report"));
    }
    Ok(Exit::Done)
}

impl GraphArgs {
    fn question(&self, kind: Kind) -> GraphQuestion {
        GraphQuestion {
            kind,
            state: match &self.at {
                Some(time) => Drawn::At(time.clone()),
                None if self.steady => Drawn::Steady,
                None => Drawn::Usual,
            },
            sankey: self.sankey,
            group: (self.group || self.no_group).then_some(self.group),
            slice: self.field.slice.clone(),
            grid: self.field.grid.clone(),
            temperature_unit: self.scale.temperature_unit.clone(),
        }
    }
}
