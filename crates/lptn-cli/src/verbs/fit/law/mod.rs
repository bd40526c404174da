//! `lptn fit law`

mod args;
mod output;

use std::path::{Path, PathBuf};
use std::time::Instant;

use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::law::{FitLawAnswer, FitLawQuestion, StatedLawsQuestion};
use lptn_answer::memory_files::MemoryFiles;
use lptn_report::{Format, WIDTH, duration, labelled, words};

pub(crate) use args::LawArgs;

use crate::arguments;
use crate::console::Console;
use crate::files::{self, Folder};
use crate::verbs::fit::posterior;

pub(crate) fn law(args: &LawArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.points {
        None => stated(args, console),
        Some(path) if path.is_dir() => runs(path, args, console),
        Some(path) => points(path, args, console),
    }
}

fn stated(args: &LawArgs, console: &Console) -> Result<Exit, Failure> {
    let laws = &args.laws;
    let text = |law: &Option<String>| law.clone().unwrap_or_default();
    let question = StatedLawsQuestion {
        rise: text(&laws.rise_law),
        time_constant: text(&laws.time_constant_law),
        power: text(&laws.power_law),
        over: text(&laws.over),
        capacity: args.capacity.clone(),
    };
    console.answer(&question.ask()?, args.format)
}

fn points(path: &Path, args: &LawArgs, console: &Console) -> Result<Exit, Failure> {
    let answer = question(args)?.ask(path, console)?;
    console.page(&answer, args.format)?;
    if let Some(file) = &args.posterior {
        write_posterior(&answer, file, console)?;
    }
    Ok(conclude(&answer, args.format, console))
}

fn runs(path: &Path, args: &LawArgs, console: &Console) -> Result<Exit, Failure> {
    let begun = Instant::now();
    let fit = question(args)?.begin(path)?;
    let place = (!args.no_files).then(|| Folder::prepare(target(path, args))).transpose()?;
    let found = fit.compute(console)?;
    let wall_time = begun.elapsed().as_secs_f64();
    if let Some(place) = &place {
        output::write(&found, place, wall_time)?;
    }
    console.page(&found, args.format)?;
    if let Some(place) = &place {
        let (took, names) = (duration(wall_time, 2), output::NAMES.join(", "));
        let text = format!("{}/: {names} (in {took})", place.path().display());
        console.note(&labelled("wrote  ", &words(&text), WIDTH).join("\n"));
    }
    Ok(conclude(&found.answer, args.format, console))
}

fn question(args: &LawArgs) -> Result<FitLawQuestion, Failure> {
    Ok(FitLawQuestion {
        speed: args.speed.clone(),
        power: args.power.clone(),
        rise: args.rise.clone(),
        time_constant: args.time_constant.clone(),
        laws: args.law.clone(),
        starts: args.start.clone(),
        unweighted: args.unweighted,
        capacity: args.capacity.clone(),
        posterior: args.posterior.is_some(),
        columns: args.records.column.clone(),
        reference: Some(args.records.reference.clone()),
        sensor: args.records.sensor.clone(),
        csv: args.csv.options()?,
        files: MemoryFiles::default(),
        command: arguments::words(),
    })
}

/// Folder for the results of a folder of records.
fn target(path: &Path, args: &LawArgs) -> PathBuf {
    let whole = path.canonicalize();
    let name = whole.as_deref().unwrap_or(path).file_name();
    let usual = || PathBuf::from("out").join(name.unwrap_or_else(|| "records".as_ref()));
    args.output.clone().unwrap_or_else(usual)
}

fn conclude(answer: &FitLawAnswer, format: Format, console: &Console) -> Exit {
    if let Some(failed) = answer.not_fitted() {
        console.message(&failed);
        return Exit::Failed;
    }
    console.conclude(answer, format)
}

fn write_posterior(answer: &FitLawAnswer, file: &Path, console: &Console) -> Result<(), Failure> {
    if let Some(posterior) = answer.posterior() {
        return posterior::write(&posterior, file, console);
    }
    let why = "no posterior is written: the errors of the coefficients are not known";
    // an existing file would be taken for the posterior of this law
    match files::take_away(file)? {
        true => console.message(&format!("{why}; {} is taken away", file.display())),
        false => console.message(why),
    }
    Ok(())
}
