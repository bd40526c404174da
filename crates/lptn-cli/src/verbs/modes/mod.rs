//! `lptn modes`

mod args;

pub(crate) use args::ModesArgs;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::modes::ModesQuestion;

use crate::console::Console;
use crate::input::Load as _;

pub(crate) fn modes(args: &ModesArgs, console: &Console) -> Result<Exit, Failure> {
    let count = args.count.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
    let question = ModesQuestion { count, at: args.at.at.clone() };
    let input = Arc::new(Input::load(&args.source)?);
    let answer = question.ask(Arc::clone(&input), &console.listening())?;
    let exit = console.answer(&answer, args.printed.format)?;
    if let (Some(file), Some(node)) = (input.typed(), answer.slowest()) {
        console.next(&format!("lptn reduce {file} --port {}", quoted(node)));
    }
    Ok(exit)
}
