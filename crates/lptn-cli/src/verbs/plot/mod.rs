//! `lptn plot`

mod args;
mod overlay;
pub(crate) mod source;

pub(crate) use args::PlotArgs;

use crate::console::Console;
use crate::drawing::Drawing;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::quoted;
use lptn_netlist::{Diagnostic, RunTime};
use overlay::overlay;
use source::Source;

pub(crate) fn plot(args: &PlotArgs, console: &Console) -> Result<Exit, Failure> {
    if !args.sources.iter().any(|path| source::is_netlist(path)) {
        nothing_to_run(args)?;
    }
    let mut exit = Exit::Done;
    let mut sources = Vec::new();
    for path in &args.sources {
        let (source, ended) = Source::of(path, args, console)?;
        sources.push(source);
        exit = if exit == Exit::Done { ended } else { exit };
    }
    let here = Drawing::Terminal;
    let drawing = args.output.as_ref().or(console.plot.as_ref()).unwrap_or(&here);
    console.draw(&[overlay(sources)], drawing)?;
    if let [path] = args.sources.as_slice() {
        let name = quoted(&path.display().to_string());
        match (source::is_netlist(path), path.is_dir()) {
            (true, _) => console.next(&format!("lptn run {name} --report")),
            (_, true) => console.next(&format!("lptn report {name}")),
            _ => {}
        }
    }
    Ok(exit)
}

/// Refuses what only a run could do.
fn nothing_to_run(args: &PlotArgs) -> Result<(), Failure> {
    let times = &args.times;
    let given = [
        ("--set", !args.set.is_empty()),
        (RunTime::Stop.option(), times.stop.is_some()),
        (RunTime::Every.option(), times.every.is_some()),
    ];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    let message = format!("{option} changes a run, and no netlist is among the files");
    let problem = Diagnostic::error("plot::no_netlist", message);
    Err(Failure::new(Exit::Input, problem.help("name the netlist instead of its results")))
}
