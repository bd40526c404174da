//! `lptn plan`

mod args;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::plan::PlanQuestion;

pub(crate) use args::PlanArgs;

use crate::console::Console;
use crate::input::Load as _;
use crate::options::Source;

pub(crate) fn plan(args: &PlanArgs, console: &Console) -> Result<Exit, Failure> {
    let source = Source { set: args.set.clone(), ..Source::of(args.file.clone()) };
    let input = Arc::new(Input::load(&source)?);
    let question = PlanQuestion { study: args.name.clone() };
    let ask = || question.ask(input, &console.listening());
    let answer = console.phases.timed("plan", ask)?;
    console.answer(&answer, args.printed.format)
}
