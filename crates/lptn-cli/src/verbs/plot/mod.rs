//! `lptn plot`

mod args;

pub(crate) use args::PlotArgs;

use crate::console::Console;
use crate::drawing::Drawing;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::input::quoted;
use lptn_answer::plot::{Columns, Source, is_netlist, is_record, overlay};
use lptn_netlist::RunTime;
use lptn_report::Format;
use std::path::Path;

use crate::input::Load as _;
use crate::options::{Scale, Shown, TimeScale};
use crate::verbs::run::{self, RunArgs};

pub(crate) fn plot(args: &PlotArgs, console: &Console) -> Result<Exit, Failure> {
    if !args.sources.iter().any(|path| is_netlist(path)) {
        nothing_to_run(args)?;
    }
    let mut exit = Exit::Done;
    let mut sources = Vec::new();
    for path in &args.sources {
        let (source, ended) = source(path, args, console)?;
        sources.push(source);
        exit = if exit == Exit::Done { ended } else { exit };
    }
    let here = Drawing::Terminal;
    let drawing = args.output.as_ref().or(console.plot.as_ref()).unwrap_or(&here);
    console.draw(&[overlay(sources)], drawing)?;
    if let [path] = args.sources.as_slice() {
        let name = quoted(&path.display().to_string());
        match (is_netlist(path), path.is_dir()) {
            (true, _) => console.next(&format!("lptn run {name} --report")),
            (_, true) => console.next(&format!("lptn report {name}")),
            _ => {}
        }
    }
    Ok(exit)
}

/// Refuses options that only a run could use.
fn nothing_to_run(args: &PlotArgs) -> Result<(), Failure> {
    let times = &args.times;
    let given = [
        ("--set", !args.set.is_empty()),
        (RunTime::Stop.option(), times.stop.is_some()),
        (RunTime::Every.option(), times.every.is_some()),
    ];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    let message = format!("{option} changes a run, and no netlist is among the files");
    Err(Failure::refused("plot::no_netlist", message, "name the netlist instead of its results"))
}

/// Reads a record or results, or runs a netlist, which has an exit code.
fn source(path: &Path, args: &PlotArgs, console: &Console) -> Result<(Source, Exit), Failure> {
    if is_netlist(path) {
        return of_netlist(path, args, console);
    }
    let columns = Columns {
        select: args.select.clone(),
        temperature_unit: args.scale.temperature_unit.clone(),
        families: is_alone(args) && !console.verbose,
        csv: args.form.options()?,
    };
    let source = match is_record(path) {
        true => Source::of_record(path, &columns)?,
        false => Source::of_folder(path, &columns)?,
    };
    console.warn(&source.doubts.0, &source.doubts.1);
    Ok((source, Exit::Done))
}

/// True if nothing else is drawn over a file.
fn is_alone(args: &PlotArgs) -> bool {
    args.sources.len() == 1
}

fn of_netlist(path: &Path, args: &PlotArgs, console: &Console) -> Result<(Source, Exit), Failure> {
    let alone = is_alone(args);
    let source =
        crate::options::Source { set: args.set.clone(), ..crate::options::Source::of(path.into()) };
    let scale = Scale { temperature_unit: args.scale.temperature_unit.clone() };
    let args = RunArgs {
        source,
        times: args.times.clone(),
        shown: Shown { format: Format::Csv, select: args.select.clone(), scale },
        time_scale: TimeScale::default(),
        balance: None,
        tolerance: None,
        output: None,
        at: Vec::new(),
        no_files: true,
        uncertainty: run::uncertainty::UncertaintyArgs::default(),
    };
    let mut input = Input::load(&args.source)?;
    input.set_run_times(&args.times)?;
    let (answer, _) = run::answer(&args, input, console)?;
    run::messages::beside(&answer, None, console);
    let exit = run::messages::conclude(&answer, false, console);
    Ok((Source::of_run(path, &answer, alone), exit))
}
