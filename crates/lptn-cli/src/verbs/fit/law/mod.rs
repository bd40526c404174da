//! `lptn fit law`

mod args;
mod figure;
mod laws;
mod page;
mod points;
mod posterior;
mod runs;
mod shown;

pub(crate) use args::LawArgs;

use lptn_fit::law::{
    Consistency, LawError, LawFit, LawStudy, LossLaw, Measured, Outcome, Start, WrittenLaw,
};
use lptn_fit::step::Capacity;
use lptn_netlist::{Diagnostic, Files, Span};
use lptn_report::Format;
use lptn_units::{Dimension, parse_quantity};

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, told};
use lptn_answer::input::{positive, wrong_unit};
use points::Data;

pub(crate) fn law(args: &LawArgs, console: &Console) -> Result<Exit, Failure> {
    let capacity = capacity(args.capacity.as_deref())?;
    let Some(path) = &args.points else { return laws::laws(args, capacity, console) };
    posterior::possible(args, path)?;
    if path.is_dir() {
        return runs::runs(path, args, capacity, console);
    }
    let data = points::read(path, args)?;
    console.warn(&data.files, &data.warnings);
    let study = LawStudy::new(data.points.clone(), laws_to_fit(args, &data)?);
    let consistency = consistency(&data, capacity)?;
    let answer = Answer { data, study, consistency };
    console.page(&answer, args.format)?;
    posterior::write(args, (path, &answer.study), console)?;
    Ok(answer.conclude(args.format, console))
}

/// Everything that is shown.
pub(crate) struct Answer {
    pub(crate) data: Data,
    pub(crate) study: LawStudy,
    pub(crate) consistency: Option<Consistency>,
}

impl Answer {
    pub(crate) fn conclude(&self, format: Format, console: &Console) -> Exit {
        if let Some((law, remark)) = self.not_fitted() {
            console.message(&format!("failed: `{law}`: {remark}"));
            return Exit::Failed;
        }
        console.conclude(self, format)
    }

    /// A law of the user that has no coefficients although there are points enough, and why.
    fn not_fitted(&self) -> Option<(String, String)> {
        let written = |c: &&LawFit| matches!(c.law, LossLaw::Written(_)) && c.fitted().is_none();
        let failed = |c: &&LawFit| !matches!(c.outcome, Outcome::TooFew { .. });
        let found = self.study.candidates.iter().find(|c| written(c) && failed(c))?;
        Some((found.law.to_string(), found.remark().unwrap_or_default()))
    }
}

/// The standard laws, and those of the command line.
fn laws_to_fit(args: &LawArgs, data: &Data) -> Result<Vec<LossLaw>, Failure> {
    let starts: Result<Vec<Start>, Failure> = args.start.iter().map(|text| start(text)).collect();
    let starts = starts?;
    let mut laws = LossLaw::standard();
    let mut known: Vec<String> = Vec::new();
    for text in &args.law {
        let law = WrittenLaw::new(text, &data.points, &starts)
            .map_err(|error| wrong_law("--law", text, &error))?;
        known.extend(law.coefficients().iter().map(|(name, _)| name.clone()));
        laws.push(LossLaw::Written(Box::new(law)));
    }
    match starts.iter().find(|(name, _)| !known.contains(name)) {
        Some((name, _)) => {
            let error = LawError::Start { name: name.clone() };
            let near = lptn_units::suggest(name, known.iter().map(String::as_str));
            let near = near.map(|near| format!("did you mean `{near}`?"));
            Err(Failure::new(Exit::Input, told(&error).help(near)))
        }
        None => Ok(laws),
    }
}

/// `a = 20 mW/rpm`.
fn start(text: &str) -> Result<Start, Failure> {
    let Some((name, value)) = text.split_once('=') else {
        let problem =
            Diagnostic::error("fit::law_start", format!("`{text}` gives no name a value"));
        return Err(Failure::new(
            Exit::Input,
            problem.help("write for example --start \"a = 20 mW/rpm\""),
        ));
    };
    let quantity = parse_quantity(value.trim(), None);
    let quantity = quantity.map_err(|error| wrong_unit("--start", value.trim(), &error))?;
    Ok((name.trim().to_owned(), quantity))
}

fn capacity(text: Option<&str>) -> Result<Option<Capacity>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let what = (Dimension::CAPACITY, "fit::law_capacity", "\"2659 J/K ± 5 %\"");
    let found = positive("--capacity", text, what)?;
    Ok(Some(Capacity { value: found.value, deviation: found.sigma() }))
}

fn consistency(data: &Data, capacity: Option<Capacity>) -> Result<Option<Consistency>, Failure> {
    let (Some(rise), Some(time_constant)) = (&data.rise, &data.time_constant) else {
        return Ok(None);
    };
    let (speed, power) = (data.points.speed(), data.points.power());
    let errors = data.errors.as_ref().map(|errors| errors.each_ref().map(Vec::as_slice));
    let measured = Measured { speed, rise, time_constant, power, errors };
    let found = Consistency::of_points(&measured, capacity);
    match found {
        Ok(found) => Ok(Some(found)),
        // five points and two speeds are needed for this question only
        Err(LawError::TooFew { .. } | LawError::Range) => Ok(None),
        Err(error) => Err(Failure::of(&error)),
    }
}

/// A mistake in a law of the command line, shown in its text.
fn wrong_law(option: &str, text: &str, error: &LawError) -> Failure {
    let mut files = Files::new();
    let file = files.add(option, text);
    let problem =
        |found: &lptn_units::UnitError| told(found).at(Span::new(file, found.span.clone()), "");
    match error {
        LawError::Units { errors, .. } => {
            Failure { exit: Exit::Input, diagnostics: errors.iter().map(problem).collect(), files }
        }
        error => Failure::of(error),
    }
}
