//! `lptn impedance`

mod args;

pub(crate) use args::ImpedanceArgs;

use std::sync::Arc;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::impedance::ImpedanceQuestion;
use lptn_answer::input::Input;

use crate::console::Console;
use crate::files;
use crate::input::Load as _;

pub(crate) fn impedance(args: &ImpedanceArgs, console: &Console) -> Result<Exit, Failure> {
    let question = ImpedanceQuestion {
        port: args.port.clone(),
        to: args.to.clone(),
        form: args.form(),
        at: args.at.at.clone(),
        writes: args.write.is_some(),
    };
    let answer = question.ask(Arc::new(Input::load(&args.source)?), &console.listening())?;
    console.warn(answer.files(), &answer.doubts());
    if let (Some(path), Some(text)) = (&args.write, answer.netlist()) {
        files::write_new(path, &text, "impedance::exists")?;
    }
    answer.reordered().iter().for_each(|note| console.note(note));
    console.show(&answer, args.printed.format)
}
