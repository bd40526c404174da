//! `lptn fit compare`

mod args;
mod output;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use lptn_answer::belief::Belief;
use lptn_answer::compare::{Loaded, Variant, load, of_sets, too_many, used};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::compare::{CandidateNetlist, FitCompareQuestion};
use lptn_answer::input::quoted;

pub(crate) use args::FitCompareArgs;

use crate::console::Console;
use crate::files::Folder;
use crate::verbs::compare::listed;

pub(crate) fn compare(args: &FitCompareArgs, console: &Console) -> Result<Exit, Failure> {
    let question = FitCompareQuestion {
        fits: args.fit.clone(),
        starts: args.starts.map(usize::from),
        threads: args.threads,
    };
    let listening = console.listening();
    let comparison = question.begin(&loaded(args)?, &listening)?;
    let folder = args.output.clone().map(Folder::prepare).transpose()?;
    let begun = Instant::now();
    let answer = comparison.compute(&listening)?;
    drop(listening);
    if let Some(folder) = &folder {
        output::write(&answer, folder, begun.elapsed().as_secs_f64())?;
        console.results_in(folder.path());
    }
    let exit = console.answer(&answer, args.printed.format)?;
    if let Some(folder) = &folder {
        let first = folder.path().join(output::NAMES[0]);
        console.note(&format!("wrote  {}, {}", first.display(), output::NAMES[1..].join(", ")));
    }
    let best = &answer.candidates[answer.choice.best];
    if let (Some(file), Exit::Done) = (best.input.typed(), exit) {
        console.next(&format!("lptn fit network {file} {}", quoted(&best.study.name)));
    }
    Ok(exit)
}

/// Every file with every variant of it, or the problems of the first that cannot be read.
/// A fit begins with the netlist's own values: those of another fit may count the same records.
fn loaded(args: &FitCompareArgs) -> Result<Vec<CandidateNetlist>, Failure> {
    let variants: Vec<Variant> = of_sets(&args.set).ok_or_else(|| too_many("--set"))?;
    let files = listed(&args.files)?;
    let jobs: Vec<(&PathBuf, &Variant)> =
        files.iter().flat_map(|file| variants.iter().map(move |one| (file, one))).collect();
    let all: Vec<_> = jobs.iter().map(|(file, one)| load(file, one, &Belief::None)).collect();
    used(&args.set, &all)?;
    let one = |(job, loaded): (&(&PathBuf, &Variant), Loaded)| {
        let (path, label) = (job.0.clone(), job.1.label().to_owned());
        Ok(CandidateNetlist { path, label, input: Arc::new(loaded.input?) })
    };
    jobs.iter().zip(all).map(one).collect()
}
