//! `lptn fit law FOLDER`: from records to a law.

mod figure;
mod folder;
mod lines;
mod output;

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lptn_fit::law::{
    ColumnFits, LawFit, Run, RunFit, RunReference, RunsError, RunsSettings, RunsStudy,
};
use lptn_fit::step::{Capacity, LONG_ENOUGH, Sensor};
use lptn_netlist::{Diagnostic, Files};
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Text, TextTable, WIDTH, duration, fixed, labelled, significant, words,
};
use lptn_solve::available_threads;
use lptn_study::FileHash;
use lptn_units::{Dimension, Type, parse_quantity};

use folder::Folder;

use super::args::LawArgs;
use super::points::Data;
use super::shown::with_error;
use super::{Answer, laws_to_fit};
use crate::console::Console;
use crate::files;
use lptn_answer::about;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{quantity, wrong_unit};

/// What is shown of a folder.
pub(crate) struct Runs {
    pub(crate) study: RunsStudy,
    /// Laws and consistency of the first column.
    pub(crate) answer: Answer,
    pub(crate) inputs: Vec<FileHash>,
    pub(crate) wall_time: f64,
}

pub(crate) fn runs(
    path: &Path,
    args: &LawArgs,
    capacity: Option<Capacity>,
    console: &Console,
) -> Result<Exit, Failure> {
    let begun = Instant::now();
    let capacity = capacity.ok_or_else(no_capacity)?;
    let place = (!args.no_files).then(|| files::Folder::prepare(target(path, args))).transpose()?;
    let folder = folder::read(path)?;
    folder.warnings.iter().for_each(|(files, warnings)| console.warn(files, warnings));
    let study = study(&folder, settings(args, &folder.runs, capacity)?, (args, console))?;
    let found = Runs::new(path, args, (study, folder), begun)?;
    if let Some(place) = &place {
        output::write(&found, place)?;
    }
    console.page(&found, args.format)?;
    if let Some(place) = &place {
        let took = duration(found.wall_time, 2);
        let names = output::NAMES.join(", ");
        let text = format!("{}/: {names} (in {took})", place.path().display());
        console.note(&labelled("wrote  ", &words(&text), WIDTH).join("\n"));
    }
    Ok(found.answer.conclude(args.format, console))
}

/// Fits the columns. One that nobody asked for by name and that has no exponential, such as a bed
/// that hardly warms, is left out with a warning.
fn study(
    folder: &Folder,
    mut settings: RunsSettings,
    (args, console): (&LawArgs, &Console),
) -> Result<RunsStudy, Failure> {
    loop {
        match RunsStudy::new(&folder.runs, settings.clone()) {
            Ok(study) => return Ok(study),
            Err(RunsError::Step { run, column, error })
                if args.records.column.is_empty() && settings.columns.first() != Some(&column) =>
            {
                let message = format!("column `{column}` is left out: {run}: {error}");
                let help = "name the columns that are to be fitted: --column ring_gear";
                let warning = Diagnostic::warning("fit::law_column_left_out", message).help(help);
                console.warn(&Files::new(), &[warning]);
                settings.columns.retain(|other| *other != column);
            }
            // a record that has no exponential is not a failure of the numbers
            Err(error) => return Err(Failure::of(&error)),
        }
    }
}

fn target(path: &Path, args: &LawArgs) -> PathBuf {
    let whole = path.canonicalize();
    let name = whole.as_deref().unwrap_or(path).file_name();
    let usual = || PathBuf::from("out").join(name.unwrap_or_else(|| "records".as_ref()));
    args.output.clone().unwrap_or_else(usual)
}

fn no_capacity() -> Failure {
    let problem =
        Diagnostic::error("fit::law_capacity", "a power needs the heat capacity, P = C dT / t_RC");
    Failure::new(Exit::Input, problem.help("write for example --capacity \"2659 J/K ± 5 %\""))
}

fn settings(args: &LawArgs, runs: &[Run], capacity: Capacity) -> Result<RunsSettings, Failure> {
    let known: Vec<&str> = runs
        .first()
        .map_or(Vec::new(), |run| run.columns.iter().map(|(name, _)| name.as_str()).collect());
    let reference = reference(&args.records.reference, &known)?;
    let is_reference =
        |name: &str| matches!(&reference, RunReference::Column(column) if column == name);
    let columns: Vec<String> = match args.records.column.as_slice() {
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
    let class = match &args.records.sensor {
        None => 0.0,
        Some(text) => quantity("--sensor", text, Type::of(Dimension::TEMPERATURE))?.value.abs(),
    };
    Ok(RunsSettings {
        columns,
        capacity,
        reference,
        sensor: Sensor { class, gain: 0.0 },
        unweighted: args.unweighted,
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

impl Runs {
    fn new(
        path: &Path,
        args: &LawArgs,
        (study, folder): (RunsStudy, Folder),
        begun: Instant,
    ) -> Result<Self, Failure> {
        let column = study.columns.first().map_or("", |column| column.column.as_str());
        let data = Data {
            name: path.display().to_string(),
            files: Files::new(),
            warnings: Vec::new(),
            points: study.laws.points.clone(),
            unit: folder.unit,
            power_name: format!("P_disp from {column}"),
            rise: None,
            time_constant: None,
            errors: None,
        };
        let laws = if args.law.is_empty() {
            study.laws.clone()
        } else {
            let laws = laws_to_fit(args, &data)?;
            lptn_fit::law::LawStudy::new(data.points.clone(), laws)
        };
        let consistency = study.consistency.clone();
        let answer = Answer { data, study: laws, consistency };
        let wall_time = begun.elapsed().as_secs_f64();
        Ok(Self { study, answer, inputs: folder.inputs, wall_time })
    }

    fn first(&self) -> &[RunFit] {
        self.study.columns.first().map_or(&[], |column| &column.fits)
    }

    /// What dT is counted from.
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

    /// What a reader should know of the fits.
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
            let note = format!(
                "{asked} of {} runs ask for a second exponential: lptn fit step",
                all.len()
            );
            text.sentence("shape  ", &note);
        }
        text.sentence(
            "error  ",
            "± are standard errors of the noise alone; what one exponential makes wrong of a \
             network is in none of them",
        );
    }

    /// Random and systematic error of the best law's coefficients, apart.
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

    pub(crate) fn best(&self) -> Option<(&LawFit, &lptn_fit::law::Fitted)> {
        let best = self.answer.study.best()?;
        Some((best, best.fitted()?))
    }

    pub(crate) fn columns(&self) -> &[ColumnFits] {
        &self.study.columns
    }
}

impl Page for Runs {
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
        output::power(self).into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        about::of_command(&self.inputs, &crate::files::arguments())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        output::json(self, json)
    }
}
