//! `lptn steady --periodic`

use std::sync::Arc;

use lptn_answer::cycle::CycleQuestion;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;

use super::SteadyArgs;
use crate::console::Console;
use crate::files::Folder;
use crate::files::names::{MANIFEST, REPORTS, RESULT, WINDOWS};
use crate::input::Load as _;
use crate::verbs::run;
use crate::verdict;

pub(super) fn cycle(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    let question = CycleQuestion {
        period: args.cycle.period.clone(),
        tolerance: args.cycle.tolerance.clone(),
        select: args.shown.select.clone(),
        temperature_unit: args.shown.scale.temperature_unit.clone(),
        balance: args.balance.clone(),
        format: args.shown.format,
        report: console.reports(),
        detail: console.detail,
        certify: args.certify,
    };
    let input = Arc::new(console.phases.timed("read", || Input::load(&args.source))?);
    let task = question.of(Arc::clone(&input))?;
    let system = console.phases.timed("assemble", || input.assemble())?;
    let folder = args.cycle.output.clone().map(Folder::prepare).transpose()?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let answer = task.answer(&system, &console.listening())?;
    if let Some(folder) = &folder {
        run::write(&answer.run, folder, console)?;
        console.results_in(folder.path());
    }
    console.page(&answer, args.shown.format)?;
    console.warn(&input.netlist.files, &answer.beside());
    if let Some(folder) = &folder {
        let path = folder.path().join(RESULT);
        let reports = match answer.run.solution.reports_over_time() {
            [] => String::new(),
            _ => format!(", {REPORTS}"),
        };
        console.note(&format!("wrote  {}, {WINDOWS}{reports}, {MANIFEST}", path.display()));
    }
    let limits = answer.run.limits();
    Ok(verdict::conclude(&answer.run.judgement(&limits), console))
}
