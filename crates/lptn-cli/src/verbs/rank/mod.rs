//! `lptn rank`

mod args;

use std::sync::Arc;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::rank::RankQuestion;

pub(crate) use args::RankArgs;

use crate::console::Console;
use crate::input::Load as _;

pub(crate) fn rank(args: &RankArgs, console: &Console) -> Result<Exit, Failure> {
    let question = RankQuestion {
        node: args.of.clone(),
        over: args.over.into(),
        temperature_unit: args.scale.temperature_unit.clone(),
    };
    let answer = question.ask(Arc::new(Input::load(&args.source)?), &console.listening())?;
    console.answer(&answer, args.printed.format)
}
