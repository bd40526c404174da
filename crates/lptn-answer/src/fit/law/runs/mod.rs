//! From a folder of records to a law.

mod doubts;
mod figure;
mod folder;
mod lines;
mod tables;

use std::io;
use std::path::{Path, PathBuf};

use lptn_fit::law::{
    ColumnFits, LawFit, LawStudy, Run, RunFit, RunReference, RunsError, RunsSettings, RunsStudy,
};
use lptn_fit::step::{Capacity, LONG_ENOUGH, Sensor};
use lptn_netlist::{Diagnostic, Files};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, fixed, significant};
use lptn_solve::available_threads;
use lptn_study::FileHash;
use lptn_units::{Dimension, Type, parse_quantity};

use folder::Folder;

use super::points::Data;
use super::shown::with_error;
use super::{FitLawAnswer, FitLawQuestion};
use crate::about;
use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::gathered::Gathered;
use crate::input::{quantity, wrong_unit};
use crate::listener::Listener;

/// A fit of the records of a folder that can be computed.
#[derive(Debug)]
pub struct FitOfRuns {
    question: FitLawQuestion,
    folder: PathBuf,
    capacity: Capacity,
}

/// Exponentials of all records, and the law that the power of the first column follows.
#[derive(Debug)]
pub struct FitRunsAnswer {
    /// The exponentials, and lines through rises and time constants.
    pub study: RunsStudy,
    /// Laws and consistency of the first column.
    pub answer: FitLawAnswer,
    /// Every file that was read.
    pub inputs: Vec<FileHash>,
}

impl Answer for FitRunsAnswer {
    fn files(&self) -> &Files {
        self.answer.files()
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.answer.doubts()
    }

    fn exit(&self) -> Exit {
        self.answer.exit()
    }
}

impl FitOfRuns {
    pub(super) fn new(
        question: &FitLawQuestion,
        folder: &Path,
        capacity: Option<Capacity>,
    ) -> Result<Self, Failure> {
        let capacity = capacity.ok_or_else(no_capacity)?;
        Ok(Self { question: question.clone(), folder: folder.to_owned(), capacity })
    }

    /// Reads the folder and computes.
    ///
    /// # Errors
    /// Problems of a record, of its speed, or of the question.
    pub fn compute(self, listener: &dyn Listener) -> Result<FitRunsAnswer, Failure> {
        let Self { question, folder: path, capacity } = self;
        let folder = folder::read(&path, (&question.csv, &question.files))?;
        let mut doubts = Gathered::default();
        for (files, warnings) in &folder.warnings {
            listener.warn(files, warnings);
            doubts.add(files, warnings);
        }
        let settings = settings(&question, &folder.runs, capacity)?;
        let study = study(&folder, (settings, &question), (&mut doubts, listener))?;
        let (files, warnings) = (Files::new(), doubts::of(&study));
        listener.warn(&files, &warnings);
        doubts.add(&files, &warnings);
        FitRunsAnswer::new(&path, &question, (study, folder, doubts))
    }
}

/// Fits the columns. One without an exponential, such as a bed that hardly warms, is left out.
/// That gives a warning; a column that was named, or the first one, is not left out.
fn study(
    folder: &Folder,
    (mut settings, question): (RunsSettings, &FitLawQuestion),
    (doubts, listener): (&mut Gathered, &dyn Listener),
) -> Result<RunsStudy, Failure> {
    loop {
        match RunsStudy::new(&folder.runs, settings.clone()) {
            Ok(study) => return Ok(study),
            Err(RunsError::Step { run, column, error })
                if question.columns.is_empty() && settings.columns.first() != Some(&column) =>
            {
                let message = format!("column `{column}` is left out: {run}: {error}");
                let help = "name the columns that are to be fitted: --column ring_gear";
                let warning = Diagnostic::warning("fit::law_column_left_out", message).help(help);
                let (files, warnings) = (Files::new(), [warning]);
                listener.warn(&files, &warnings);
                doubts.add(&files, &warnings);
                settings.columns.retain(|other| *other != column);
            }
            // a record that has no exponential is not a failure of the numbers
            Err(error) => return Err(Failure::of(&error)),
        }
    }
}

fn no_capacity() -> Failure {
    Failure::refused(
        "fit::law_capacity",
        "a power needs the heat capacity, P = C dT / t_RC",
        "write for example --capacity \"2659 J/K ± 5 %\"",
    )
}

fn settings(
    question: &FitLawQuestion,
    runs: &[Run],
    capacity: Capacity,
) -> Result<RunsSettings, Failure> {
    let known: Vec<&str> = runs
        .first()
        .map_or(Vec::new(), |run| run.columns.iter().map(|(name, _)| name.as_str()).collect());
    let reference = reference(question.reference.as_deref().unwrap_or("initial"), &known)?;
    let is_reference =
        |name: &str| matches!(&reference, RunReference::Column(column) if column == name);
    let columns: Vec<String> = match question.columns.as_slice() {
        [] => {
            known.iter().filter(|name| !is_reference(name)).map(|name| (*name).to_owned()).collect()
        }
        names => names.to_vec(),
    };
    if let Some(name) = columns.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(no_column(name, &known));
    }
    if columns.is_empty() {
        let problem = Diagnostic::error(
            "fit::no_column",
            "the records have no column of temperatures to fit",
        );
        return Err(Failure::new(Exit::Input, problem));
    }
    let class = match &question.sensor {
        None => 0.0,
        Some(text) => quantity("--sensor", text, Type::of(Dimension::TEMPERATURE))?.value.abs(),
    };
    Ok(RunsSettings {
        columns,
        capacity,
        reference,
        sensor: Sensor { class, gain: 0.0 },
        unweighted: question.unweighted,
        laws: Vec::new(),
        threads: available_threads(),
    })
}

fn reference(text: &str, known: &[&str]) -> Result<RunReference, Failure> {
    if text == "initial" {
        return Ok(RunReference::Initial);
    }
    if known.contains(&text) {
        return Ok(RunReference::Column(text.to_owned()));
    }
    match parse_quantity(text, Some(Type::ABSOLUTE_TEMPERATURE)) {
        Ok(found) => Ok(RunReference::Value(found.value)),
        Err(error) if text.starts_with(|c: char| c.is_ascii_digit()) => {
            Err(wrong_unit("--reference", text, &error))
        }
        Err(_) => Err(no_column(text, known)),
    }
}

fn no_column(name: &str, known: &[&str]) -> Failure {
    let problem =
        Diagnostic::error("record::no_column", format!("the records have no column `{name}`"));
    let all = || format!("their temperatures are {}", known.join(", "));
    Failure::new(Exit::Input, problem.did_you_mean(name, known.iter().copied(), all))
}

impl FitRunsAnswer {
    fn new(
        path: &Path,
        question: &FitLawQuestion,
        (study, folder, doubts): (RunsStudy, Folder, Gathered),
    ) -> Result<Self, Failure> {
        let column = study.columns.first().map_or("", |column| column.column.as_str());
        let data = Data {
            name: path.display().to_string(),
            files: doubts.files,
            warnings: doubts.doubts,
            points: study.laws.points.clone(),
            unit: folder.unit,
            power_name: format!("P_disp from {column}"),
            rise: None,
            time_constant: None,
            errors: None,
        };
        let laws = if question.laws.is_empty() {
            study.laws.clone()
        } else {
            LawStudy::new(data.points.clone(), question.laws_to_fit(&data)?)
        };
        let consistency = study.consistency.clone();
        let command = question.command.clone();
        let answer = FitLawAnswer { data, study: laws, consistency, command };
        Ok(Self { study, answer, inputs: folder.inputs })
    }

    fn first(&self) -> &[RunFit] {
        self.study.columns.first().map_or(&[], |column| &column.fits)
    }

    /// Zero from which dT is counted.
    fn zero(&self) -> String {
        let settings = self.study.settings();
        let zero = match &settings.reference {
            RunReference::Initial => "T_i of the same column".to_owned(),
            RunReference::Column(name) => format!("the mean of {name} over each record"),
            RunReference::Value(kelvin) => format!("{} degC", significant(kelvin - 273.15, 5)),
        };
        let capacity = with_error(settings.capacity.value, Some(settings.capacity.deviation));
        format!("dT = T_f less {zero}; P = C dT / t_RC with C = {capacity} J/K")
    }

    fn table(&self) -> TextTable {
        let unit = &self.answer.data.unit;
        let name = self.study.columns.first().map_or("", |column| column.column.as_str());
        let rows: Vec<_> = self.study.runs.iter().zip(self.first()).collect();
        let minutes = |f: &RunFit| {
            let tau = f.fit.tau;
            with_error(tau.value / 60.0, Some(tau.standard_error / 60.0))
        };
        TextTable::of(&rows)
            .left(name, |(run, _)| run.0.as_str())
            .right(unit.0.text.as_str(), |(run, _)| significant(unit.0.from_si(run.1), 5))
            .right("dT [K]", |(_, f)| with_error(f.power.rise.value, Some(f.power.rise.random)))
            .right("t_RC [min]", |(_, f)| minutes(f))
            .right("P [W]", |(_, f)| with_error(f.power.power.value, Some(f.power.power.random)))
            .into()
    }

    /// Notes on the fits.
    fn notes(&self, text: &mut Text) {
        for column in &self.study.columns {
            let (mean, scatter) = self.study.time_constant(column);
            let mean = with_error(mean / 60.0, Some(scatter / 60.0));
            let note =
                format!("{}: mean {mean} min (standard deviation of one run)", column.column);
            text.sentence("t_RC   ", &note);
        }
        let all = self.first();
        let short = all.iter().filter(|f| f.fit.extrapolates()).count();
        if short > 0 {
            let least = all.iter().map(|f| f.fit.time_constants()).fold(f64::INFINITY, f64::min);
            let beyond = all.iter().map(|f| f.fit.beyond.abs()).fold(0.0, f64::max);
            let note = format!(
                "{short} records are shorter than {LONG_ENOUGH} t_RC (the shortest: {}): T_f is \
                 extrapolated by up to {} K",
                fixed(least, 1),
                fixed(beyond, 1)
            );
            text.sentence("length ", &note);
        }
        let asked = all.iter().filter(|f| f.fit.second.offer.is_some()).count();
        if asked > 0 {
            let note =
                format!("{asked} of {} runs need a second exponential: lptn fit step", all.len());
            text.sentence("shape  ", &note);
        }
        text.sentence(
            "error  ",
            "± are standard errors of the noise alone, without the error of describing a network \
             by one exponential",
        );
    }

    /// Random and systematic errors of the best law's coefficients, separately.
    fn errors(&self, text: &mut Text) {
        let Some((best, fit)) = self.best() else { return };
        let Some(systematic) = self.study.systematic(best) else { return };
        let unit = &self.answer.data.unit;
        for (c, systematic) in fit.coefficients.iter().zip(systematic) {
            let (scale, unit) = unit.unit(c.value, c.dimension);
            let show = |value: f64| significant(value / scale, 2);
            let value = with_error(c.value / scale, c.standard_error.map(|error| error / scale));
            let errors = format!(
                "{} = {value} (random) ± {} (systematic: capacity {}, offset of the sensors {}) \
                 {unit}",
                c.name,
                show(systematic.total()),
                show(systematic.capacity),
                show(systematic.offset)
            );
            text.sentence("", errors.trim_end());
        }
        if self.study.settings().capacity.deviation == 0.0 {
            text.sentence(
                "",
                "C was given without ±: its error, which every power shares, is missing from these",
            );
        }
    }

    pub(super) fn best(&self) -> Option<(&LawFit, &lptn_fit::law::Fitted)> {
        let best = self.answer.study.best()?;
        Some((best, best.fitted()?))
    }

    pub(super) fn columns(&self) -> &[ColumnFits] {
        &self.study.columns
    }
}

impl Page for FitRunsAnswer {
    fn text(&self) -> Text {
        let count = self.study.runs.len();
        let mut text = Text::titled(format!("{count} records of {}", self.answer.data.name));
        text.sentence("", &self.zero());
        text.section().table(self.table());
        self.notes(text.section());
        lines::put(self, &mut text);
        text.append(self.answer.text());
        self.errors(text.section());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.powers().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        about::of_command(&self.inputs, &self.answer.command)
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        tables::json(self, json)
    }
}
