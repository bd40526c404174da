//! `lptn size`

mod args;

pub(crate) use args::SizeArgs;

use std::path::Path;
use std::sync::Arc;

use lptn_answer::answer::Answer as _;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::size::{CoolingQuestion, SizeQuestion};
use lptn_report::Format;

use crate::arguments;
use crate::console::Console;
use crate::input::Load as _;
use crate::options::Source;
use crate::written::put;

pub(crate) fn size(args: &SizeArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.file {
        Some(file) => of_netlist(args, file, console),
        None => console.answer(&args.cooling().ask()?, args.printed.format),
    }
}

impl SizeArgs {
    fn cooling(&self) -> CoolingQuestion {
        let text = |text: &Option<String>| text.clone().unwrap_or_default();
        CoolingQuestion {
            power: text(&self.cooling.power),
            limit: text(&self.cooling.limit),
            ambient: text(&self.cooling.ambient),
            rise: self.cooling.rise.clone(),
            command: arguments::words(),
        }
    }
}

fn of_netlist(args: &SizeArgs, file: &Path, console: &Console) -> Result<Exit, Failure> {
    let question = SizeQuestion {
        name: args.name.clone(),
        threads: args.threads,
        writes: args.write,
        certify: args.certify,
    };
    let source = Source { set: args.set.clone(), ..Source::of(file.to_owned()) };
    let input = Input::load_from(&source, &Belief::of(args.posterior.as_deref()))?;
    let ask = || question.ask(Arc::new(input), &console.listening());
    let answer = console.phases.timed("size", ask)?;
    // the doubts of the netlist were printed before it was sized
    if args.printed.format != Format::Table {
        console.warn(answer.files(), &answer.beside());
    }
    console.show(&answer, args.printed.format)?;
    let typed = quoted(&file.display().to_string());
    if answer.exit() != Exit::Done {
        return Ok(answer.exit());
    }
    if args.write {
        if let Some(written) = answer.written()? {
            put(file, &written.text)?;
            console.note(&format!("wrote  {}: {}", file.display(), written.values));
        }
        console.next(&format!("lptn run {typed}"));
    } else if args.printed.format == Format::Table {
        let name = answer.one_of_several().map_or(String::new(), |name| format!(" {name}"));
        console.next(&format!("lptn size {typed}{name} --write"));
    }
    Ok(Exit::Done)
}
