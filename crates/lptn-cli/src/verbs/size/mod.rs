//! `lptn size`

mod args;
mod changing;
mod cooling;
mod text;
mod write;

pub(crate) use args::SizeArgs;

use std::io;

use lptn_netlist::{Diagnostic, Requirement, SizeStudy};
use lptn_network::ParameterId;
use lptn_report::{Json, Page, Rows, Text};
use lptn_solve::{SteadyError, Table};
use lptn_study::{Scalar, SizeError, SizeTask, Sizing, Verdict};
use lptn_units::Unit;
use serde_json::json;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::options::Source;

pub(crate) fn size(args: &SizeArgs, console: &Console) -> Result<Exit, Failure> {
    let Some(file) = &args.file else { return cooling::cooling(args, console) };
    let input = Input::load(&Source { file: file.clone(), set: args.set.clone() })?;
    let study = study(&input, args.name.as_deref())?;
    let parameter = parameter(&input, study)?;
    let unit = input.unit_of(parameter);
    if args.write {
        write::possible(&input, parameter)?;
    }
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let sizing = solve(&input, study, parameter).map_err(|error| failed(&input, study, &unit, &error))?;
    let answer = Answer { input: &input, study, parameter, unit, sizing };
    let exit = console.show(&answer, args.printed.format)?;
    if args.write && exit == Exit::Done {
        write::write(&answer, file, console)?;
    }
    Ok(exit)
}

/// The study of this name, or the only one.
fn study<'a>(input: &'a Input, name: Option<&str>) -> Result<&'a SizeStudy, Failure> {
    let sizes = &input.netlist.sizes;
    let known = || sizes.iter().map(|study| study.name.as_str());
    let list = || known().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let file = &input.text.name;
    let problem = match (name, sizes.as_slice()) {
        (None, [only]) => return Ok(only),
        (None, []) => Diagnostic::error("size::no_study", format!("{file} has no [size.NAME]: what is to be sized?"))
            .help(
                "add for example:\n\n[size.fan]\nminimise = \"p\"\nvary = { p = { from = \"1 W/K\", to = \"10 W/K\" } }\n\
                 require = [\"steel.T <= 80 [degC]\"]",
            ),
        (None, _) => Diagnostic::error("size::which_study", format!("{file} has several [size.NAME]"))
            .help(format!("name one of {}", list())),
        (Some(name), _) => match sizes.iter().find(|study| study.name == name) {
            Some(study) => return Ok(study),
            None => {
                let problem =
                    Diagnostic::error("size::no_study", format!("{file} has no [size.{name}]"));
                match lptn_units::suggest(name, known()) {
                    Some(near) => problem.help(format!("did you mean `{near}`?")),
                    None if sizes.is_empty() => problem,
                    None => problem.help(format!("name one of {}", list())),
                }
            }
        },
    };
    Err(Failure::new(Exit::Input, problem))
}

fn parameter(input: &Input, study: &SizeStudy) -> Result<ParameterId, Failure> {
    input.netlist.network.parameter(&study.parameter).map_err(|_| {
        let message = format!("there is no parameter `{}`", study.parameter);
        let problem = Diagnostic::error("netlist::unknown_parameter", message);
        Failure::at(Exit::Input, input.netlist.files.clone(), problem.at(study.span.clone(), ""))
    })
}

fn solve(input: &Input, study: &SizeStudy, parameter: ParameterId) -> Result<Sizing, SizeError> {
    let network = &input.netlist.network;
    let range = study.range(network).unwrap_or((f64::NAN, f64::NAN));
    let task = SizeTask {
        network,
        parameters: input.netlist.overrides(),
        parameter,
        range,
        goal: study.goal,
        requirements: &study.requirements,
        time: input.netlist.run.as_ref().map_or(0.0, |run| run.start),
    };
    lptn_study::size(&task)
}

fn failed(input: &Input, study: &SizeStudy, unit: &Unit, error: &SizeError) -> Failure {
    if let SizeError::Changing(changing) = error {
        let problem = changing::explained(input, study, (error, changing));
        return Failure::at(Exit::Input, input.netlist.files.clone(), problem);
    }
    let at = |value: f64| text::quantity(&study.parameter, value, unit);
    let (exit, message) = match error {
        SizeError::Network { value, errors } => {
            (Exit::Input, format!("there is no network with {}: {errors}", at(*value)))
        }
        SizeError::Steady { value, error } => {
            let input = matches!(
                error,
                SteadyError::NoBoundary { .. } | SteadyError::Input(_) | SteadyError::Cycles { .. }
            );
            let exit = if input { Exit::Input } else { Exit::Failed };
            (exit, format!("there is no steady state with {}: {error}", at(*value)))
        }
        error => (Exit::Input, error.to_string()),
    };
    let problem = Diagnostic::error(error.code(), message).at(study.span.clone(), "");
    let problem = match error {
        SizeError::Network { .. }
        | SizeError::Steady {
            error: SteadyError::BelowAbsoluteZero { .. } | SteadyError::Cycles { .. },
            ..
        } => problem.help("`vary` has to leave this value out: let its range begin or end elsewhere"),
        _ => problem,
    };
    Failure::at(exit, input.netlist.files.clone(), problem)
}

/// What came of sizing a parameter.
pub(crate) struct Answer<'a> {
    pub(crate) input: &'a Input,
    pub(crate) study: &'a SizeStudy,
    pub(crate) parameter: ParameterId,
    /// In which the parameter is shown.
    pub(crate) unit: Unit,
    pub(crate) sizing: Sizing,
}

impl Answer<'_> {
    /// The requirement that stops the parameter; `None` where the end of the range does.
    pub(crate) fn binding(&self) -> Option<&Requirement> {
        let closest = &self.study.requirements[self.sizing.closest];
        (self.sizing.verdict != Verdict::BestEnd).then_some(closest)
    }

    fn closest_unit(&self) -> String {
        self.study.requirements[self.sizing.closest].ty.dimension.si_unit()
    }
}

impl Page for Answer<'_> {
    fn text(&self) -> Text {
        text::text(self)
    }

    /// One row: the value in its unit, the margin of every requirement in SI units.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&[()]);
        let value = self.unit.from_si(self.sizing.trial.value);
        table.column(&self.study.parameter, &self.unit.text, |()| value);
        table.column("feasible", "-", |()| if self.sizing.feasible() { 1.0 } else { 0.0 });
        for (r, &margin) in self.study.requirements.iter().zip(&self.sizing.trial.margins) {
            table.column(&r.text, r.ty.dimension.si_unit(), |()| margin);
        }
        table.done().into()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (network, sizing) = (&self.input.netlist.network, &self.sizing);
        let si = network.parameters()[self.parameter.index()].ty.dimension.si_unit();
        let requirement = |(r, &margin): (&Requirement, &f64)| {
            let margin = Scalar::new(margin, &r.ty.dimension.si_unit());
            json!({ "requirement": r.text, "margin": margin })
        };
        let margins = self.study.requirements.iter().zip(&sizing.trial.margins);
        let scalar = |value: f64| Scalar::new(value, &si);
        let of_margin = |value: f64| Scalar::new(value, &self.closest_unit());
        self.input.head(json, &[])?;
        json.member("values", &json!({ (self.study.parameter.as_str()): scalar(sizing.trial.value) }))?;
        json.member("margin", &of_margin(sizing.margin()))?;
        json.member("binding", &self.binding().map(|requirement| &requirement.text))?;
        json.member("feasible", &sizing.feasible())?;
        json.member("requirements", &margins.map(requirement).collect::<Vec<_>>())?;
        json.member("sensitivity", &sizing.sensitivity.map(of_margin))?;
        json.member("breaks_again", &sizing.breaks_again.map(scalar))?;
        json.member("first_guess", &sizing.first_guess.map(scalar))
    }

    fn no(&self) -> Option<String> {
        (!self.sizing.feasible()).then(|| text::verdict(self))
    }
}
