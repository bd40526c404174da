//! `lptn fit step`

mod args;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::fit::step::FitStepQuestion;

pub(crate) use args::StepArgs;

use crate::console::Console;
use crate::files;
use crate::verbs::fit::posterior;

pub(crate) fn step(args: &StepArgs, console: &Console) -> Result<Exit, Failure> {
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
        command: files::arguments(),
    };
    let answer = question.ask(&args.record, console)?;
    console.page(&answer, args.printed.format)?;
    console.report(answer.files(), &answer.problems);
    if let (Some(file), Some(posterior)) = (&args.posterior, answer.posterior()) {
        posterior::write(&posterior, file, console)?;
    }
    Ok(answer.exit())
}
