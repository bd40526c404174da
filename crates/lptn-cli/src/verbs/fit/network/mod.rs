//! `lptn fit network`

mod args;
mod output;
mod write;

use std::sync::Arc;
use std::time::Instant;

use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::network::{FitNetworkEnd, FitNetworkQuestion, InterruptedFit};
use lptn_answer::input::{Input, quoted};
use lptn_report::Format;

pub(crate) use args::NetworkArgs;

use crate::console::Console;
use crate::files::Folder;
use crate::files::names::POSTERIOR;
use crate::input::Load as _;
use crate::options::Source;

pub(crate) fn network(args: &NetworkArgs, console: &Console) -> Result<Exit, Failure> {
    let source = Source { set: args.set.clone(), ..Source::of(args.file.clone()) };
    // a fit begins with the netlist's own values: those of another fit may count the same records
    let input = Arc::new(Input::load_from(&source, &Belief::None)?);
    let starts = args.starts.map(usize::from);
    let question = FitNetworkQuestion { study: args.name.clone(), starts };
    let listening = console.listening();
    let fit = question.begin(Arc::clone(&input), &listening)?;
    if args.write {
        write::possible(&input, &fit)?;
    }
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let end = fit.compute(&listening)?;
    drop(listening);
    let answer = match end {
        FitNetworkEnd::Found(answer) => answer,
        FitNetworkEnd::Interrupted(fit) => return interrupted(&fit, args, console),
    };
    let mut files = Vec::new();
    if let Some(folder) = &folder {
        files = output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.answer(&*answer, args.printed.format)?;
    let file = quoted(&args.file.display().to_string());
    if let Some(folder) = &folder {
        let path = folder.path().join(&files[0]);
        console.note(&format!("wrote  {}, {}", path.display(), files[1..].join(", ")));
        if files.iter().any(|file| file == POSTERIOR) && input.netlist.run.is_some() {
            let posterior = quoted(&folder.path().join(POSTERIOR).display().to_string());
            console.next(&format!("lptn run {file} --posterior {posterior} --uncertainty linear"));
        }
    }
    match (args.write, exit) {
        (true, Exit::Done) => {
            write::write(&answer, &args.file, console)?;
            console.next(&format!("lptn run {file}"));
        }
        (true, _) => console.message("nothing is written: not every parameter is determined"),
        _ => {}
    }
    Ok(exit)
}

/// Shows the best values up to now, and how to continue from them.
fn interrupted(
    fit: &InterruptedFit,
    args: &NetworkArgs,
    console: &Console,
) -> Result<Exit, Failure> {
    if let (Some(text), Format::Table) = (fit.text(), args.printed.format) {
        console.page(&text, Format::Table)?;
    }
    console.message(&fit.message());
    Ok(Exit::Interrupted)
}
