//! `lptn verify`

mod args;

pub(crate) use args::VerifyArgs;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::verify::VerifyQuestion;

use crate::console::Console;
use crate::input::Load as _;

pub(crate) fn verify(args: &VerifyArgs, console: &Console) -> Result<Exit, Failure> {
    let question = VerifyQuestion { tolerance: args.tolerance.clone(), at: args.at.at.clone() };
    let input = Arc::new(Input::load(&args.source)?);
    // doubts are printed before anything is compared
    let Some(answer) = question.ask(Arc::clone(&input), &console.listening())? else {
        console.message("interrupted: nothing is verified");
        return Ok(Exit::Interrupted);
    };
    let exit = console.show(&answer, args.printed.format)?;
    if let (false, Some(file)) = (answer.is_independent(), input.typed()) {
        console.next(&format!("lptn verify {file} --at steady"));
    }
    Ok(exit)
}
