//! `lptn infer`

mod args;
mod follow;
mod output;

use std::sync::Arc;
use std::time::Instant;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::infer::InferQuestion;
use lptn_answer::input::Input;

pub(crate) use args::InferArgs;

use crate::console::Console;
use crate::files::Folder;
use crate::input::Load as _;
use crate::options::Source;

pub(crate) fn infer(args: &InferArgs, console: &Console) -> Result<Exit, Failure> {
    if args.follow {
        follow::possible(args, console)?;
    }
    let source = Source { set: args.set.clone(), ..Source::of(args.file.clone()) };
    let input = Arc::new(Input::load(&source)?);
    let question = InferQuestion { study: args.name.clone() };
    if args.follow {
        return follow::follow(question.follow(input, console)?, console);
    }
    let listening = console.listening();
    let inference = question.begin(input, &listening)?;
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let answer = inference.compute(&listening)?;
    drop(listening);
    if let Some(folder) = &folder {
        output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.answer(&answer, args.printed.format)?;
    if let Some(folder) = &folder {
        let [first, others @ ..] = output::NAMES;
        let path = folder.path().join(first);
        console.note(&format!("wrote  {}, {}", path.display(), others.join(", ")));
    }
    Ok(exit)
}
