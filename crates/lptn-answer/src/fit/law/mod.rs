//! The law of the speed that a power follows, and whether rise, time constant and power agree.

mod figure;
mod laws;
mod page;
mod points;
mod runs;
mod shown;

use std::path::Path;

use lptn_fit::law::{
    Consistency, LawError, LawFit, LawStudy, LossLaw, Measured, Outcome, Start, WrittenLaw,
};
use lptn_fit::step::Capacity;
use lptn_netlist::{CsvOptions, Diagnostic, Files, Posterior, Span};
use lptn_units::{Dimension, parse_quantity};

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{positive, wrong_unit};
use crate::listener::Listener;
use crate::memory_files::MemoryFiles;
use points::Data;

pub use laws::{StatedLawsAnswer, StatedLawsQuestion};
pub use runs::{FitOfRuns, FitRunsAnswer};

/// Asks which law of the speed a power follows, by points of a sheet or by a folder of records.
#[derive(Clone, Debug, Default)]
pub struct FitLawQuestion {
    /// The column of the speed; `None` for the only rotation.
    pub speed: Option<String>,
    /// The column of the power; `None` for the only power.
    pub power: Option<String>,
    /// The column of the temperature rise; `None` for the only difference of temperatures.
    pub rise: Option<String>,
    /// The column of the time constant; `None` for the only time.
    pub time_constant: Option<String>,
    /// Laws to fit in addition to the standard ones; names that are not columns are coefficients.
    pub laws: Vec<String>,
    /// Values from which the search for coefficients begins: `a = 20 mW/rpm`.
    pub starts: Vec<String>,
    /// True if every point has the same weight, whatever its standard error.
    pub unweighted: bool,
    /// The heat capacity, `2659 J/K ± 5 %`; a folder of records needs it.
    pub capacity: Option<String>,
    /// True if the posterior is wanted, which exists for one law of points.
    pub posterior: bool,
    /// The columns of records to fit, the first gives the power; none for all temperatures.
    pub columns: Vec<String>,
    /// The zero of the rises of records: `initial`, a column, or a temperature; `None` for
    /// `initial`.
    pub reference: Option<String>,
    /// The class error of the thermocouples of records, `3 K`; `None` for exact ones.
    pub sensor: Option<String>,
    /// Statements about the form of the files, where their contents do not show it.
    pub csv: CsvOptions,
    /// Files that are not on the disk.
    pub files: MemoryFiles,
    /// The words of the command that asked, for reports; empty if a program asked.
    pub command: Vec<String>,
}

/// Laws of a power, best first, and whether rise, time constant and power agree.
#[derive(Debug)]
pub struct FitLawAnswer {
    data: Data,
    /// The laws.
    pub study: LawStudy,
    /// Consistency of rise, time constant and power; `None` if the points do not determine it.
    pub consistency: Option<Consistency>,
    command: Vec<String>,
}

impl Answer for FitLawAnswer {
    fn files(&self) -> &Files {
        &self.data.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.data.warnings.clone()
    }

    fn exit(&self) -> Exit {
        match (self.not_fitted().is_some(), self.consistency.as_ref()) {
            (true, _) => Exit::Failed,
            (false, Some(found)) if !found.agrees() => Exit::No,
            _ => Exit::Done,
        }
    }
}

impl FitLawQuestion {
    /// Asks a sheet of points.
    ///
    /// # Errors
    /// Problems of the question or of the sheet.
    pub fn ask(&self, points: &Path, listener: &dyn Listener) -> Result<FitLawAnswer, Failure> {
        let capacity = capacity(self.capacity.as_deref())?;
        self.has_posterior()?;
        let data = points::read(points, self)?;
        listener.warn(&data.files, &data.warnings);
        let study = LawStudy::new(data.points.clone(), self.laws_to_fit(&data)?);
        let consistency = consistency(&data, capacity)?;
        Ok(FitLawAnswer { data, study, consistency, command: self.command.clone() })
    }

    /// Asks a folder of records.
    ///
    /// # Errors
    /// Problems of the question or of a record.
    pub fn ask_records(
        &self,
        folder: &Path,
        listener: &dyn Listener,
    ) -> Result<FitRunsAnswer, Failure> {
        self.begin(folder)?.compute(listener)
    }

    /// Checks the question before a folder is read.
    ///
    /// # Errors
    /// A missing heat capacity, and a posterior.
    pub fn begin(&self, folder: &Path) -> Result<FitOfRuns, Failure> {
        let capacity = capacity(self.capacity.as_deref())?;
        if self.posterior {
            let message = "the powers of a folder of records share the error of one heat capacity, \
                which the coefficients do not include: a law has no posterior";
            let help = "fit the network to the records, `lptn fit network`: its posterior includes every \
                 error";
            return Err(no_posterior(message, help));
        }
        FitOfRuns::new(self, folder, capacity)
    }

    /// Refuses a posterior that cannot exist, before anything is computed.
    fn has_posterior(&self) -> Result<(), Failure> {
        if !self.posterior || self.laws.len() == 1 {
            return Ok(());
        }
        let help = "write one, --law 'alpha * omega^(5/3)', with the names that the parameters \
            have in the netlist";
        Err(no_posterior("--posterior writes the coefficients of one law", help))
    }

    /// The standard laws, and those that were requested.
    fn laws_to_fit(&self, data: &Data) -> Result<Vec<LossLaw>, Failure> {
        let starts: Result<Vec<Start>, Failure> =
            self.starts.iter().map(|text| start(text)).collect();
        let starts = starts?;
        let mut laws = LossLaw::standard();
        let mut known: Vec<String> = Vec::new();
        for text in &self.laws {
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
}

fn no_posterior(message: &str, help: &str) -> Failure {
    Failure::refused("fit::law_posterior", message, help)
}

impl FitLawAnswer {
    /// The coefficients of the requested law with their covariance, for further studies.
    /// `None` if their errors are not known.
    pub fn posterior(&self) -> Option<Posterior> {
        let own = |law: &&LawFit| matches!(law.law, LossLaw::Written(_));
        let law = self.study.candidates.iter().find(own)?;
        let stem = Path::new(&self.data.name).file_stem();
        let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
        law.posterior(&stem.unwrap_or_default(), &law.law.to_string())
    }

    /// The requested law without coefficients despite enough points, and the reason.
    pub fn not_fitted(&self) -> Option<String> {
        let written = |c: &&LawFit| matches!(c.law, LossLaw::Written(_)) && c.fitted().is_none();
        let failed = |c: &&LawFit| !matches!(c.outcome, Outcome::TooFew { .. });
        let found = self.study.candidates.iter().find(|c| written(c) && failed(c))?;
        let remark = found.remark().unwrap_or_default();
        Some(format!("failed: `{}`: {remark}", found.law))
    }
}

/// `a = 20 mW/rpm`.
fn start(text: &str) -> Result<Start, Failure> {
    let Some((name, value)) = text.split_once('=') else {
        return Err(Failure::refused(
            "fit::law_start",
            format!("`{text}` does not give a name a value"),
            "write for example --start \"a = 20 mW/rpm\"",
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
