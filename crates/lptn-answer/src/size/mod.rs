//! The values of parameters, the parts or the cooling that keep a limit.

mod changing;
mod choice;
mod cooling;
mod figure;
mod kept;
mod moments;
mod page;
mod proof;
mod proof_notes;
mod prove;
mod several;
mod single;
mod write;

pub use cooling::{CoolingAnswer, CoolingQuestion};
pub use write::Written;

use std::sync::Arc;

use kept::Kept;
use lptn_netlist::{Diagnostic, Files, SizeStudy};
use lptn_network::ParameterId;
use lptn_report::{Page, PageOf};
use lptn_solve::available_threads;
use lptn_study::{Aim, Demand, SiValue, SizeError};
use lptn_units::Problem as _;
use moments::demanded;
use serde_json::{Map, Value, json};

use crate::answer::Answer;
use crate::example;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::Input;
use crate::listener::Listener;
use crate::studies::{self, Studies};

/// Asks for values of parameters, or for parts, that keep the requirements of a `[size.NAME]`.
#[derive(Clone, Debug, Default)]
pub struct SizeQuestion {
    /// Name of the `[size.NAME]`; `None` for the only one.
    pub name: Option<String>,
    /// Number of threads; `None` for all of the machine. The answer is the same.
    pub threads: Option<usize>,
    /// True if the values are to be written into the netlist.
    /// Values that cannot be written are then refused in advance.
    pub writes: bool,
    /// True if the margins of the answer are bounded with proof.
    pub certify: bool,
}

/// The values or parts that keep the requirements, or come closest.
#[derive(Debug)]
pub struct SizeAnswer(Found);

#[derive(Debug)]
enum Found {
    Single(single::Sized),
    Several(several::Sized),
    Choice(choice::Chosen),
}

impl SizeQuestion {
    /// Asks a netlist. The listener hears its doubts in advance.
    ///
    /// # Errors
    /// A study that does not exist, a question that does not fit the netlist, and a network that
    /// cannot be solved.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<SizeAnswer, Failure> {
        let sizes = &input.netlist.studies.sizes;
        let study = STUDIES.find(&input, (sizes, |study| &study.name), self.name.as_deref())?;
        if self.writes {
            for name in changed(study) {
                write::possible(&input, parameter(&input, study, name)?)?;
            }
        }
        let (study, section) = (study.clone(), format!("size.{}", study.name));
        let names = study.varied.iter().map(|one| one.name.as_str());
        let input = studies::with_replaced(input, ("size::replaced", &section), names);
        listener.warn(&input.netlist.files, &input.netlist.warnings);
        moments::check_period(&input, &study)?;
        let kept = Kept::of(&input.netlist, &study);
        let asked = Asked { input, study, kept };
        let threads = self.threads.unwrap_or_else(available_threads);
        let mut answer = SizeAnswer(match asked.study.single() {
            Some(_) => Found::Single(single::size(asked, listener)?),
            None if asked.study.catalogues.is_empty() => {
                Found::Several(several::size(asked, threads, listener)?)
            }
            None => Found::Choice(choice::choose(asked, threads, listener)?),
        });
        if self.certify {
            answer.prove(listener)?;
        }
        Ok(answer)
    }
}

/// The question with its netlist.
#[derive(Debug)]
struct Asked {
    input: Arc<Input>,
    study: SizeStudy,
    kept: Kept,
}

impl Asked {
    /// Answers a question about the requirements.
    fn demand<T>(
        &self,
        listener: &dyn Listener,
        ask: impl FnOnce(Demand<'_>) -> Result<T, SizeError>,
    ) -> Result<T, Failure> {
        let watcher = |progress| listener.progress(progress);
        let answer = demanded((&self.input.netlist, &self.study), &watcher, ask);
        answer.map_err(|error| failed(&self.input, &self.study, &error))
    }

    /// Values in SI units as members of an object.
    fn values(&self, values: &[(ParameterId, f64)]) -> Map<String, Value> {
        let parameters = self.input.netlist.network.parameters();
        let member = |&(id, value): &(ParameterId, f64)| {
            let parameter = &parameters[id.index()];
            let value = SiValue::new(value, &parameter.ty.dimension.si_unit());
            (parameter.name.clone(), json!(value))
        };
        values.iter().map(member).collect()
    }
}

const STUDIES: Studies = Studies {
    section: "size",
    codes: ["size::no_study", "size::which_study"],
    question: "a sizing needs parameters or parts, and requirements",
    example: example::size,
};

fn parameter(input: &Input, study: &SizeStudy, name: &str) -> Result<ParameterId, Failure> {
    input.netlist.network.parameter(name).map_err(|_| {
        let message = format!("there is no parameter `{name}`");
        let problem = Diagnostic::error("netlist::unknown_parameter", message);
        input.refused(Exit::Input, problem.at(study.span.clone(), ""))
    })
}

/// The aim of a study.
fn aim(study: &SizeStudy) -> Aim<'_> {
    let objective = &study.objective;
    Aim { value: &objective.value, goal: study.goal, of_results: objective.of_results }
}

/// The parameters that a study changes, in the order in which designs have them.
fn changed(study: &SizeStudy) -> impl Iterator<Item = &String> {
    let set = study.catalogues.iter().flat_map(|one| &one.columns).map(|one| &one.name);
    study.varied.iter().map(|one| &one.name).chain(set)
}

fn failed(input: &Input, study: &SizeStudy, error: &SizeError) -> Failure {
    let problem = match error {
        SizeError::Changing(changing) => changing::explained(input, study, (error, changing)),
        _ => told(error).at(study.span.clone(), ""),
    };
    // the library does not know the units
    let message = match error {
        SizeError::Trial { values, case, error } => {
            let at = |(name, value): (&String, &f64)| {
                let id = input.netlist.network.parameter(name).ok()?;
                Some(page::quantity(name, *value, &input.unit_of(id)))
            };
            let with: Vec<String> = changed(study).zip(values).filter_map(at).collect();
            let case = if case.is_empty() { String::new() } else { format!(", case `{case}`") };
            format!("with {}{case}: {error}", with.join(", "))
        }
        _ => problem.message,
    };
    input.refused(error.class().into(), Diagnostic { message, ..problem })
}

impl SizeAnswer {
    fn asked(&self) -> &Asked {
        match &self.0 {
            Found::Single(found) => &found.asked,
            Found::Several(found) => &found.asked,
            Found::Choice(found) => &found.asked,
        }
    }

    /// The name of the study, if the netlist has several.
    pub fn one_of_several(&self) -> Option<&str> {
        let Asked { input, study, .. } = self.asked();
        (input.netlist.studies.sizes.len() > 1).then_some(study.name.as_str())
    }

    /// Doubts in the proof, which a table has as notes.
    pub fn beside(&self) -> Vec<Diagnostic> {
        self.asked().kept.doubts()
    }

    /// The netlist with the values in it, read again and solved: it keeps every requirement.
    /// `None` if no values do.
    ///
    /// # Errors
    /// A netlist that cannot be written, or that breaks a requirement with any number of digits.
    pub fn written(&self) -> Result<Option<Written>, Failure> {
        if self.no().is_some() {
            return Ok(None);
        }
        match &self.0 {
            Found::Single(found) => write::of_one(found).map(Some),
            Found::Several(found) => write::of_all(&found.asked, &found.values()).map(Some),
            Found::Choice(found) => {
                let values = found.best_values();
                values.map(|values| write::of_all(&found.asked, &values)).transpose()
            }
        }
    }
}

impl PageOf for SizeAnswer {
    fn page(&self) -> &dyn Page {
        match &self.0 {
            Found::Single(found) => found,
            Found::Several(found) => found,
            Found::Choice(found) => found,
        }
    }
}

impl Answer for SizeAnswer {
    fn files(&self) -> &Files {
        &self.asked().input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.asked().input.netlist.warnings.as_slice(), &self.beside()].concat()
    }
}
