//! The points of a sheet, and the roles of its columns.

use std::path::Path;

use lptn_fit::law::{LawError, Points, Variable};
use lptn_netlist::{DataSheet, Diagnostic, Files, RecordColumn, read_sheet, revolutions_option};
use lptn_units::{Dimension, Type, suggest};

use super::FitLawQuestion;
use super::shown::SpeedUnit;
use crate::exit::Exit;
use crate::failure::{Failure, told};

/// Points as they were read.
#[derive(Debug)]
pub(super) struct Data {
    pub(super) name: String,
    pub(super) files: Files,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) points: Points,
    pub(super) unit: SpeedUnit,
    pub(super) power_name: String,
    /// Rises in K and time constants in s, if the file has both.
    pub(super) rise: Option<Vec<f64>>,
    pub(super) time_constant: Option<Vec<f64>>,
    /// Standard errors of rise, time constant and power, if the file has all of them.
    pub(super) errors: Option<[Vec<f64>; 3]>,
}

/// The option that reads a frequency as the speed that is wanted, as an alternative.
fn revolutions(column: &RecordColumn, wanted: Dimension) -> String {
    let option = revolutions_option(&column.name, &column.unit);
    let option = option.filter(|_| wanted == Dimension::ANGULAR_VELOCITY);
    option.map_or(String::new(), |option| format!(", or read it as revolutions by `{option}`"))
}

/// A sheet, for looking up its columns.
struct Lookup<'a> {
    sheet: &'a DataSheet,
    files: &'a Files,
}

/// The endings of names of standard errors.
const ERRORS: [&str; 7] = ["_sd", " ±", "_error", "±", "_std", "_sigma", "_err"];

fn is_error(name: &str) -> bool {
    ERRORS.iter().any(|ending| name.ends_with(ending))
}

/// True if a column has this dimension.
/// A difference of temperatures may be in K, which a record takes as absolute.
fn holds(column: &RecordColumn, wanted: Dimension) -> bool {
    let ty = column.unit.ty;
    let difference = wanted == Dimension::TEMPERATURE && ty.absolute && column.unit.offset == 0.0;
    ty == Type::of(wanted) || difference
}

impl<'a> Lookup<'a> {
    fn refused(&self, problem: Diagnostic) -> Failure {
        Failure::at(Exit::Input, self.files.clone(), problem)
    }

    fn of(&self, wanted: Dimension) -> Vec<&'a RecordColumn> {
        self.sheet
            .columns
            .iter()
            .filter(|column| holds(column, wanted) && !is_error(&column.name))
            .collect()
    }

    /// The column that an option names.
    fn named(&self, name: &str, wanted: Dimension) -> Result<&'a RecordColumn, Failure> {
        let Some(column) = self.sheet.column(name) else {
            let message = format!("there is no column `{name}`");
            let problem = Diagnostic::error("record::no_column", message);
            let problem = problem.at(self.sheet.header.clone(), "the columns");
            let names = self.sheet.columns.iter().map(|column| column.name.as_str());
            let near = suggest(name, names).map(|near| format!("did you mean `{near}`?"));
            return Err(self.refused(problem.help(near)));
        };
        if holds(column, wanted) {
            return Ok(column);
        }
        let (own, due) = (column.unit.ty.with_article(), Type::of(wanted).with_article());
        let message = format!("column `{name}` is {own}, but {due} is needed");
        let problem = Diagnostic::error("record::unit", message).at(column.span.clone(), "");
        let option = revolutions(column, wanted);
        Err(self.refused(problem.help(format!("name another column{option}"))))
    }

    /// The column that an option names, or the only one of this dimension.
    fn needed(
        &self,
        (option, name): (&str, Option<&str>),
        what: &str,
        wanted: Dimension,
    ) -> Result<&'a RecordColumn, Failure> {
        if let Some(name) = name {
            return self.named(name, wanted);
        }
        let unit = if wanted == Dimension::POWER { "P [W]" } else { "omega [rpm]" };
        match self.of(wanted).as_slice() {
            [only] => Ok(only),
            [] => {
                let message = format!("no column contains {what}");
                let problem = Diagnostic::error("fit::law_column", message);
                let problem = problem.at(self.sheet.header.clone(), "no unit here fits");
                let turns = self.of(Dimension::FREQUENCY).into_iter().next();
                let option = turns.map_or(String::new(), |column| revolutions(column, wanted));
                let help = format!("give it a header like `{unit}`{option}");
                Err(self.refused(problem.help(help)))
            }
            [first, second, ..] => {
                let message =
                    format!("several columns contain {what}: `{}`, `{}`", first.name, second.name);
                let problem = Diagnostic::error("fit::law_column", message);
                let problem = problem.at(second.span.clone(), "").also(first.span.clone(), "");
                Err(self
                    .refused(problem.help(format!("name one of them: {option} {}", first.name))))
            }
        }
    }

    /// The column that an option names, or the only one, if there is one.
    fn optional(
        &self,
        name: Option<&str>,
        wanted: Dimension,
    ) -> Result<Option<&'a RecordColumn>, Failure> {
        match (name, self.of(wanted).as_slice()) {
            (Some(name), _) => self.named(name, wanted).map(Some),
            (None, [only]) => Ok(Some(only)),
            _ => Ok(None),
        }
    }

    /// The standard errors of a column.
    ///
    /// # Errors
    /// Standard errors in another kind of unit, such as percent.
    fn errors(&self, column: &RecordColumn) -> Result<Option<&'a RecordColumn>, Failure> {
        let named = |ending: &&str| self.sheet.column(&format!("{}{ending}", column.name));
        let Some(found) = ERRORS.iter().find_map(named) else { return Ok(None) };
        if found.unit.ty == column.unit.ty {
            return Ok(Some(found));
        }
        let (own, name, unit) = (&found.name, &column.name, &column.unit.text);
        let message = format!("column `{own}` is in {}, but `{name}` in {unit}", found.unit.text);
        let problem = Diagnostic::error("record::unit", message).at(found.span.clone(), "");
        let help = format!("give the standard errors of `{name}` in {unit}, or use --unweighted");
        Err(self.refused(problem.help(help)))
    }
}

pub(super) fn read(path: &Path, question: &FitLawQuestion) -> Result<Data, Failure> {
    let bytes = question.files.bytes(path)?;
    let (sheet, files) = read_sheet(path, &bytes, &question.csv)?;
    let lookup = Lookup { sheet: &sheet, files: &files };
    let speed = lookup.needed(
        ("--speed", question.speed.as_deref()),
        "the speed",
        Dimension::ANGULAR_VELOCITY,
    )?;
    let power =
        lookup.needed(("--power", question.power.as_deref()), "the power", Dimension::POWER)?;
    let sigma = if question.unweighted { None } else { lookup.errors(power)? };
    let rise = lookup.optional(question.rise.as_deref(), Dimension::TEMPERATURE)?;
    let time_constant = lookup.optional(question.time_constant.as_deref(), Dimension::TIME)?;
    let both = rise.zip(time_constant);
    let sigmas = match (both, sigma) {
        (Some((rise, time)), Some(sigma)) => {
            let errors = (lookup.errors(rise)?, lookup.errors(time)?);
            errors.0.zip(errors.1).map(|(rise, time)| [rise, time, sigma])
        }
        _ => None,
    };
    let mut used = vec![Some(speed), Some(power), sigma, both.map(|b| b.0), both.map(|b| b.1)];
    used.extend(sigmas.iter().flatten().map(|column| Some(*column)));
    let complete = |row: &usize| used.iter().flatten().all(|column| !column.values[*row].is_nan());
    let rows: Vec<usize> = (0..sheet.rows.len()).filter(complete).collect();
    let kept =
        |column: &RecordColumn| rows.iter().map(|&row| column.values[row]).collect::<Vec<f64>>();
    let others = sheet
        .columns
        .iter()
        .filter(|c| c.gaps == 0 && c.name != speed.name && c.name != power.name);
    let variable =
        |c: &RecordColumn| Variable { name: c.name.clone(), ty: c.unit.ty, values: kept(c) };
    let points = Points::new(kept(speed), kept(power), sigma.map(kept))
        .and_then(|points| points.with_variables(&speed.name, others.map(variable).collect()))
        .map_err(|error| wrong_points(&error, &sheet, &files, &rows))?;
    let warnings = sheet.note.clone().into_iter().chain(left_out(&sheet, rows.len())).collect();
    Ok(Data {
        name: path.display().to_string(),
        warnings,
        points,
        unit: SpeedUnit(speed.unit.clone()),
        power_name: power.name.clone(),
        rise: both.map(|b| kept(b.0)),
        time_constant: both.map(|b| kept(b.1)),
        errors: sigmas.map(|sigmas| sigmas.map(kept)),
        files,
    })
}

fn left_out(sheet: &DataSheet, kept: usize) -> Option<Diagnostic> {
    let gaps = sheet.rows.len() - kept;
    let message = format!("{gaps} of {} rows have gaps and are left out", sheet.rows.len());
    (gaps > 0).then(|| Diagnostic::warning("fit::law_gaps", message).at(sheet.header.clone(), ""))
}

fn wrong_points(error: &LawError, sheet: &DataSheet, files: &Files, rows: &[usize]) -> Failure {
    let point = match error {
        LawError::Speed { point, .. }
        | LawError::Power { point }
        | LawError::Deviation { point, .. } => {
            rows.get(*point).and_then(|&row| sheet.rows.get(row)).cloned()
        }
        _ => None,
    };
    let problem = told(error).at(point.unwrap_or_else(|| sheet.header.clone()), "");
    Failure::at(Exit::Input, files.clone(), problem)
}
