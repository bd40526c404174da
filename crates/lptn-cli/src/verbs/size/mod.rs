//! `lptn size`

mod args;
mod changing;
mod cooling;
mod text;
mod write;

pub(crate) use args::SizeArgs;

use lptn_netlist::{Diagnostic, Requirement, SizeStudy};
use lptn_network::ParameterId;
use lptn_report::{JsonWriter, write_csv};
use lptn_solve::{SteadyError, Table};
use lptn_study::{Scalar, SizeError, SizeTask, Sizing, Verdict};
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::console::Console;
use crate::diagnostics;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::options::{Format, Source};

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
    match args.printed.format {
        Format::Table => console.print(&text::text(&answer, console)).map(drop)?,
        Format::Csv => console.write(|out| write_csv(&answer.table(), out))?,
        Format::Json => console.write(|out| answer.json(out))?,
    }
    if !answer.sizing.feasible() {
        if args.printed.format != Format::Table {
            console.message(&text::verdict(&answer));
        }
        return Ok(Exit::No);
    }
    if args.write {
        write::write(&answer, file, console)?;
    }
    Ok(Exit::Done)
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

    /// One row: the value in its unit, the margin of every requirement in SI units.
    fn table(&self) -> Table {
        let mut table = Table::of(&[()]);
        let value = self.unit.from_si(self.sizing.trial.value);
        table.column(&self.study.parameter, &self.unit.text, |()| value);
        table.column("feasible", "-", |()| if self.sizing.feasible() { 1.0 } else { 0.0 });
        for (r, &margin) in self.study.requirements.iter().zip(&self.sizing.trial.margins) {
            table.column(&r.text, r.ty.dimension.si_unit(), |()| margin);
        }
        table.done()
    }

    fn json(&self, out: impl std::io::Write) -> std::io::Result<()> {
        let (netlist, sizing) = (&self.input.netlist, &self.sizing);
        let ty = netlist.network.parameters()[self.parameter.index()].ty;
        let si = if ty.absolute { "K".to_owned() } else { ty.dimension.si_unit() };
        let mut values = Map::new();
        values.insert(self.study.parameter.clone(), Scalar::new(sizing.trial.value, &si).json());
        let requirement = |(r, &margin): (&Requirement, &f64)| json!({ "requirement": r.text, "margin": Scalar::new(margin, &r.ty.dimension.si_unit()).json() });
        let requirements: Value =
            self.study.requirements.iter().zip(&sizing.trial.margins).map(requirement).collect();
        let scalar = |value: Option<f64>, unit: &str| value.map(|value| Scalar::new(value, unit).json());
        let mut json = JsonWriter::new(out);
        json.member("format", &json!(1))?;
        json.member("network", &json!(self.input.text.stem))?;
        json.member("warnings", &diagnostics::list(&netlist.files, &netlist.warnings))?;
        json.member("values", &Value::Object(values))?;
        json.member("margin", &Scalar::new(sizing.margin(), &self.closest_unit()).json())?;
        json.member("binding", &json!(self.binding().map(|requirement| &requirement.text)))?;
        json.member("feasible", &json!(sizing.feasible()))?;
        json.member("requirements", &requirements)?;
        json.member("sensitivity", &json!(scalar(sizing.sensitivity, &self.closest_unit())))?;
        json.member("breaks_again", &json!(scalar(sizing.breaks_again, &si)))?;
        json.member("first_guess", &json!(scalar(sizing.first_guess, &si)))?;
        json.finish().map(drop)
    }
}
