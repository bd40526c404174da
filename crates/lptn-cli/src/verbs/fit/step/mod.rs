//! `lptn fit step`

mod args;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::step::FitStepQuestion;
use lptn_answer::fit::terms::FitTermsQuestion;
use lptn_answer::memory_files::MemoryFiles;

pub(crate) use args::StepArgs;

use crate::arguments;
use crate::console::Console;
use crate::verbs::fit::posterior;

pub(crate) fn step(args: &StepArgs, console: &Console) -> Result<Exit, Failure> {
    if let Some(count) = &args.terms {
        return terms(args, count, console);
    }
    let question = FitStepQuestion {
        columns: args.column.clone(),
        time: args.time.clone(),
        from: args.from.clone(),
        to: args.to.clone(),
        drop_outliers: args.drop_outliers,
        csv: args.form.options()?,
        capacity: args.capacity.clone(),
        reference: Some(args.reference.clone()),
        sensor: args.sensor.clone(),
        model: args.model.clone(),
        port: args.port.clone(),
        posterior: args.posterior.is_some(),
        temperature_unit: args.scale.temperature_unit.clone(),
        files: MemoryFiles::default(),
        command: arguments::words(),
    };
    let answer = question.ask(&args.record, console)?;
    console.page(&answer, args.printed.format)?;
    console.report(answer.files(), &answer.problems);
    if let (Some(file), Some(posterior)) = (&args.posterior, answer.posterior()) {
        posterior::write(&posterior, file, console)?;
    }
    Ok(answer.exit())
}

/// Several exponentials through one column.
fn terms(args: &StepArgs, count: &str, console: &Console) -> Result<Exit, Failure> {
    let refused = |code, message: String, help: String| Failure::refused(code, message, help);
    if args.reference != "initial" || args.column.len() > 1 {
        return Err(refused(
            "fit::terms_option",
            "--terms fits one column, and has no --reference".to_owned(),
            "leave --reference out, and name one --column".to_owned(),
        ));
    }
    let number = match count {
        "auto" => None,
        count => Some(count.parse::<usize>().map_err(|_| {
            let message = format!("--terms is not a number of terms, got `{count}`");
            refused("fit::terms_count", message, "write --terms 4, or --terms auto".to_owned())
        })?),
    };
    let question = FitTermsQuestion {
        column: args.column.first().cloned(),
        time: args.time.clone(),
        from: args.from.clone(),
        to: args.to.clone(),
        drop_outliers: args.drop_outliers,
        csv: args.form.options()?,
        power: args.power.clone(),
        terms: number,
        files: MemoryFiles::default(),
        command: arguments::words(),
    };
    let answer = question.ask(&args.record, console)?;
    console.page(&answer, args.printed.format)?;
    Ok(answer.exit())
}
