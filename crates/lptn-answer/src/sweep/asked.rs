//! The question of a sweep: its study, its columns, and the settings that determine its rows.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn_netlist::{Diagnostic, SweepStudy};
use lptn_network::Item;
use lptn_report::write_rows;
use lptn_solve::PeriodicError;
use lptn_study::sweep::{Cases, SweepError, SweepTask};
use lptn_study::{FileHash, SiValue};
use lptn_units::{Problem as _, Unit};
use serde_json::{Value, json};

use super::lines::{Lines, read_row};
use super::row::RowShape;
use super::shard::Shard;
use super::tally::Tally;
use crate::about;
use crate::example;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input};
use crate::studies::{self, Studies};

const STUDIES: Studies = Studies {
    section: "sweep",
    codes: ["sweep::no_study", "sweep::which_study"],
    question: "a sweep needs parameters and reports",
    example: example::sweep,
};

/// The name of a column with a least margin.
const MARGIN: &str = "limit_margin";

/// The columns of words about limits.
pub(super) const JUDGED: [&str; 2] = ["limits", "worst_limit"];

/// A column of numbers: its name and the unit of its cells.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The unit of its cells.
    pub unit: Unit,
}

impl Column {
    /// `name [unit]`.
    pub fn header(&self) -> String {
        lptn_solve::Column::heading(&self.name, self.unit_text())
    }

    /// The unit in a word: `1` for plain numbers.
    pub(super) fn unit_text(&self) -> &str {
        if self.unit.text.is_empty() { "1" } else { &self.unit.text }
    }
}

/// A sweep of a netlist.
#[derive(Clone, Debug, Default)]
pub struct SweepQuestion {
    /// The name of the study; `None` for the only one.
    pub name: Option<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
    /// The part that is solved; `None` for all.
    pub shard: Option<Shard>,
}

/// A sweep that is ready to start.
#[derive(Debug)]
pub struct SweepAsked {
    /// The netlist.
    pub input: Arc<Input>,
    pub(super) task: SweepTask,
    /// The axes, then the reports, then the least margin of the limits of each unit.
    pub columns: Vec<Column>,
    /// The part that is solved.
    pub shard: Option<Shard>,
    /// The cases that are solved, counted from 0.
    pub range: Range<u64>,
    /// True if a column counts laws outside their ranges.
    pub ranged: bool,
}

impl SweepAsked {
    /// The candidates, each solved alone; it has their gradients too.
    pub fn task(&self) -> &SweepTask {
        &self.task
    }
}

/// The study of this name, or the only one.
///
/// # Errors
/// No such study, or several if no name is given.
pub fn study<'a>(input: &'a Input, name: Option<&str>) -> Result<&'a SweepStudy, Failure> {
    let sweeps = &input.netlist.studies.sweeps;
    STUDIES.find(input, (sweeps, |study| &study.name), name)
}

/// The usual folder for its files.
pub fn folder(input: &Input, study: &SweepStudy) -> PathBuf {
    PathBuf::from("out").join(&input.text.stem).join(&study.name)
}

impl SweepQuestion {
    /// Checks the question for a netlist.
    ///
    /// # Errors
    /// A study that does not exist or cannot be swept, and a unit that is not one of temperatures.
    pub fn of(&self, input: Arc<Input>) -> Result<SweepAsked, Failure> {
        let netlist = &input.netlist;
        let study = study(&input, self.name.as_deref())?;
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), netlist)?;
        let plan = study.plan(&netlist.network).map_err(|diagnostics| Failure {
            exit: Exit::Input,
            files: netlist.files.clone(),
            diagnostics,
        })?;
        let cases = Cases::new(plan);
        let range = self.shard.map_or(0..cases.count(), |shard| shard.range(cases.count()));
        let axes = cases.parameters().map(|id| Column {
            name: netlist.network.parameters()[id.index()].name.clone(),
            unit: input.unit_of(id),
        });
        let reports = study
            .reports
            .iter()
            .map(|report| Column { name: report.name.clone(), unit: unit.shown(report.ty) });
        let mut columns: Vec<Column> = axes.chain(reports).collect();
        let task = SweepTask::new(netlist.clone(), study.clone(), cases);
        let task = task.map_err(|error| refused(&input, study, &error))?;
        let margins = task.limits().types().iter();
        columns.extend(margins.map(|ty| Column { name: MARGIN.to_owned(), unit: unit.shown(*ty) }));
        let ranged = !netlist.network.ranged().is_empty();
        let (section, axes) = (format!("sweep.{}", study.name), task.cases().parameters().len());
        let names = columns.iter().take(axes).map(|axis| axis.name.as_str());
        let input = studies::with_replaced(input, ("sweep::replaced", &section), names);
        Ok(SweepAsked { task, columns, shard: self.shard, range, ranged, input })
    }
}

impl SweepAsked {
    /// The study.
    pub fn study(&self) -> &SweepStudy {
        self.task.study()
    }

    /// The number of axes.
    pub fn axes(&self) -> usize {
        self.task.cases().parameters().len()
    }

    /// The shape of its rows.
    pub fn shape(&self) -> RowShape {
        let (judged, ranged) = (self.is_judged(), self.ranged);
        RowShape { columns: self.header().len(), judged, ranged }
    }

    /// True if candidates are judged by limits.
    pub(super) fn is_judged(&self) -> bool {
        !self.task.limits().is_empty()
    }

    /// The number of reports.
    pub(super) fn reports(&self) -> usize {
        self.study().reports.len()
    }

    /// The folder of the files: that of the part, if it is one.
    pub fn folder(&self, output: Option<PathBuf>) -> PathBuf {
        let whole = output.unwrap_or_else(|| folder(&self.input, self.study()));
        self.shard.map_or(whole.clone(), |shard| whole.join(shard.folder()))
    }

    /// Name and unit of every column in the order of the file; words have no unit.
    pub(super) fn declared(&self) -> Vec<(&str, Option<&str>)> {
        let numbers = self.columns.iter();
        let mut all = vec![("case", Some("1"))];
        all.extend(numbers.map(|column| (column.name.as_str(), Some(column.unit_text()))));
        if self.is_judged() {
            all.extend(JUDGED.map(|name| (name, None)));
        }
        all.extend(self.ranged.then_some(("outside", Some("1"))));
        all.push(("failed", None));
        all
    }

    /// The cells of the first line.
    pub fn header(&self) -> Vec<String> {
        let heading = |(name, unit): (&str, Option<&str>)| match unit {
            Some(unit) => lptn_solve::Column::heading(name, unit),
            None => name.to_owned(),
        };
        self.declared().into_iter().map(heading).collect()
    }

    /// The first line of the file, with its end.
    pub fn heading(&self) -> Vec<u8> {
        let mut line = Vec::new();
        // a vector takes everything
        drop(write_rows(&[self.header()], &mut line));
        line
    }

    /// An empty tally of its rows.
    pub fn tally(&self) -> Tally {
        let axes = self.axes();
        let (reports, front) = (self.reports(), self.study().front);
        Tally::new((axes, reports), front, self.range.end - self.range.start)
    }

    /// Takes in the rows of a file that is whole.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(&self, path: &Path, tally: &mut Tally) -> Result<(), Failure> {
        let mut lines = Lines::open(path)?;
        let shape = self.shape();
        lines.next_line()?;
        while let Some(line) = lines.next_line()? {
            read_row(&line, shape).iter().for_each(|row| tally.row(row));
        }
        Ok(())
    }

    /// Everything that determines a row: two sweeps that agree in it have the same rows.
    pub fn identity(&self) -> String {
        let hashes: Vec<String> =
            about::hashes(&self.input.netlist).into_iter().map(|file| file.sha256).collect();
        let network = &self.input.netlist.network;
        let values: Vec<String> = network
            .parameter_ids()
            .map(|id| format!("{:016x}", network.parameter_value(id).to_bits()))
            .collect();
        let all = json!({
            "lptn": env!("CARGO_PKG_VERSION"),
            "inputs": hashes,
            "parameters": values,
            "case": self.input.netlist.case(),
            "sweep": self.study().name,
            "header": self.header(),
        });
        lptn_study::sha256(all.to_string().as_bytes())
    }

    /// Every file that was read, with its hash.
    pub fn inputs(&self) -> Vec<FileHash> {
        about::hashes(&self.input.netlist)
    }

    /// Record of the sweep for the manifest.
    pub fn record(&self) -> Value {
        let (study, plan) = (self.study(), self.task.cases().plan());
        json!({
            "name": study.name,
            "method": study.method.word(),
            "over": study.over.word(),
            "seed": study.method.is_sampled().then_some(plan.seed),
            "period": plan.period.map(|period| SiValue::new(period, "s")),
            "cases": plan.cases,
            "first": self.range.start + 1,
            "last": self.range.end,
            "shard": self.shard.map(|shard| shard.to_string()),
            "ranged": self.ranged,
            "identity": self.identity(),
        })
    }
}

fn refused(input: &Input, study: &SweepStudy, error: &SweepError) -> Failure {
    let problem = told(error);
    let problem = match error {
        SweepError::Changing(changing) => {
            let map = &input.netlist.source_map;
            let places = changing.iter().filter_map(|change| match (change.signal, change.input) {
                (Some(signal), _) => map.name(Item::Signal(signal)),
                (None, Some((item, field))) => map.get(item, field).or_else(|| map.name(item)),
                (None, None) => None,
            });
            let first = Diagnostic {
                message: format!("sweep `{}`: {}", study.name, problem.message),
                ..problem
            }
            .at(study.span.clone(), "");
            places.fold(first, |problem, place| problem.also(place, "changes with time"))
        }
        SweepError::Periodic(PeriodicError::NotPeriodic(_)) => {
            problem.at(study.span.clone(), "").help(
                "let signals repeat with `after_end = \"repeat\"`, or give the time after which \
                   all inputs repeat: `period = \"10 min\"`",
            )
        }
        _ => problem.at(study.span.clone(), ""),
    };
    input.refused(error.class().into(), problem)
}
