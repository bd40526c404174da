//! `lptn plot`

mod args;
mod view;

pub(crate) use args::PlotArgs;

use crate::console::Console;
use crate::drawing::Drawing;
use lptn_answer::answer::Answer as _;
use lptn_answer::belief::Belief;
use lptn_answer::cycle::CycleQuestion;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::input::quoted;
use lptn_answer::plot::{Columns, Source, is_netlist, is_record, overlay};
use lptn_answer::select;
use lptn_netlist::RunTime;
use lptn_plot::Figure;
use lptn_report::Format;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::input::Load as _;
use crate::options::{Scale, Shown, TimeScale};
use crate::verbs::run::{self, RunArgs};
use crate::verdict;

pub(crate) fn plot(args: &PlotArgs, console: &Console) -> Result<Exit, Failure> {
    if !args.sources.iter().any(|path| is_netlist(path)) {
        nothing_to_run(args)?;
    }
    let mut exit = Exit::Done;
    let mut sources = Vec::new();
    for opened in opened(args)? {
        let (source, ended) = source(opened, args, console)?;
        sources.push(source);
        exit = if exit == Exit::Done { ended } else { exit };
    }
    let here = Drawing::Terminal;
    let drawing = args.output.as_ref().or(console.plot.as_ref()).unwrap_or(&here);
    let apart = args.view.columns.is_some() && sources.len() > 1;
    let figures = if apart { facets(sources) } else { vec![overlay(sources)] };
    let figures: Result<Vec<Figure>, Failure> =
        figures.into_iter().map(|figure| args.view.of(figure)).collect();
    console.draw_on(&args.view.canvas(), &figures?, drawing)?;
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
        ("--case", args.case.is_some()),
        ("--periodic", args.periodic),
        (RunTime::Stop.option(), times.stop.is_some()),
        (RunTime::Every.option(), times.every.is_some()),
    ];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    let message = format!("{option} changes a run, and no netlist is among the files");
    Err(Failure::refused("plot::no_netlist", message, "name the netlist instead of its results"))
}

/// A figure for each source, under its name.
fn facets(sources: Vec<Source>) -> Vec<Figure> {
    let titled = |source: Source| {
        let title = source.name.clone();
        Figure { title, ..overlay(vec![source]) }
    };
    sources.into_iter().map(titled).collect()
}

/// One of the files, before anything runs.
struct Opened<'a> {
    path: &'a Path,
    /// The netlist, if it is one.
    input: Option<Input>,
    /// The patterns of `--select` for this file.
    select: Vec<String>,
}

/// Opens all files. A pattern that matches in one of them need not match in the others, but
/// something of each has to be drawn.
fn opened(args: &PlotArgs) -> Result<Vec<Opened<'_>>, Failure> {
    let open = |path: &PathBuf| is_netlist(path).then(|| load(path, args)).transpose();
    let inputs: Vec<Option<Input>> = args.sources.iter().map(open).collect::<Result<_, _>>()?;
    let all = || args.select.clone();
    let paths = args.sources.iter().map(PathBuf::as_path);
    if args.select.is_empty() || is_alone(args) {
        let each = |(path, input)| Opened { path, input, select: all() };
        return Ok(paths.zip(inputs).map(each).collect());
    }
    let columns = columns(args, all())?;
    let matching = |(path, input): (&Path, &Option<Input>)| match input {
        Some(input) => Ok(select::matching(&input.netlist, &args.select)),
        None => columns.matching(path),
    };
    let found = paths.clone().zip(&inputs).map(matching);
    let found: Vec<Vec<bool>> = found.collect::<Result<_, Failure>>()?;
    let nowhere = |i: usize| !found.iter().any(|matches| matches[i]);
    let own = |matches: &Vec<bool>| {
        let kept = (0..matches.len()).filter(|&i| matches[i] || nowhere(i));
        let kept: Vec<String> = kept.map(|i| args.select[i].clone()).collect();
        if kept.is_empty() { all() } else { kept }
    };
    let each = |((path, input), matches)| Opened { path, input, select: own(matches) };
    Ok(paths.zip(inputs).zip(&found).map(each).collect())
}

fn load(path: &Path, args: &PlotArgs) -> Result<Input, Failure> {
    Input::load_run(&asked(path, args), &args.times, &Belief::Named)
}

/// A netlist with the values that the command line gives.
fn asked(path: &Path, args: &PlotArgs) -> crate::options::Source {
    crate::options::Source { set: args.set.clone(), case: args.case.clone(), file: path.into() }
}

fn columns(args: &PlotArgs, select: Vec<String>) -> Result<Columns, Failure> {
    let temperature_unit = args.scale.temperature_unit.clone();
    Ok(Columns { select, temperature_unit, families: false, csv: args.form.options()? })
}

/// Reads a record or results, or runs a netlist, which has an exit code.
fn source(
    Opened { path, input, select }: Opened<'_>,
    args: &PlotArgs,
    console: &Console,
) -> Result<(Source, Exit), Failure> {
    if let Some(input) = input {
        return of_netlist(path, (args, select, input), console);
    }
    let families = is_alone(args) && !console.verbose;
    let columns = Columns { families, ..columns(args, select)? };
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

fn of_netlist(
    path: &Path,
    (args, select, input): (&PlotArgs, Vec<String>, Input),
    console: &Console,
) -> Result<(Source, Exit), Failure> {
    let alone = is_alone(args);
    if args.periodic {
        return of_cycle(path, (args, select, input), console);
    }
    let view = args.view.view()?;
    let scale = Scale { temperature_unit: args.scale.temperature_unit.clone() };
    let args = RunArgs {
        source: asked(path, args),
        times: args.times.clone(),
        shown: Shown { format: Format::Csv, select, scale },
        time_scale: TimeScale::default(),
        balance: None,
        tolerance: None,
        output: None,
        at: Vec::new(),
        live: false,
        no_files: true,
        uncertainty: run::uncertainty::UncertaintyArgs::default(),
        certify: false,
        picture: true,
        view,
    };
    let (answer, _) = run::answer(&args, input, console)?;
    run::messages::beside(&answer, None, console);
    let exit = run::messages::conclude(&answer, false, console);
    Ok((Source::of_run(path, &answer, alone), exit))
}

/// One cycle of a netlist in periodic steady state.
fn of_cycle(
    path: &Path,
    (args, select, input): (&PlotArgs, Vec<String>, Input),
    console: &Console,
) -> Result<(Source, Exit), Failure> {
    let question = CycleQuestion {
        period: args.period.clone(),
        tolerance: None,
        select,
        temperature_unit: args.scale.temperature_unit.clone(),
        balance: None,
        format: Format::Csv,
        report: false,
        detail: console.detail,
        certify: false,
    };
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let answer = question.ask(Arc::new(input), &console.listening())?;
    console.warn(answer.run.files(), &answer.beside());
    let limits = answer.run.limits();
    let exit = verdict::conclude(&answer.run.judgement(&limits), console);
    Ok((Source::of_run(path, &answer.run, is_alone(args)), exit))
}
