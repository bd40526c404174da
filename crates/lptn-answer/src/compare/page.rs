//! A comparison as a page.

use std::io;
use std::path::Path;

use lptn_plot::Figure;
use lptn_report::{
    Align, Column, Json, Page, Report, Rows, Standing, Text, TextTable, WIDTH, decimals, duration,
    fixed, plain, prefix, significant, stacked,
};
use lptn_solve::Table;
use lptn_study::{Candidate, CandidateReport, CompareRow, HeatOut, HeatOver, compare_table};
use lptn_units::Unit;
use serde_json::Value;

use super::margins::{NOTHING, broken, margins, settled_margins};
use super::{CompareAnswer, doubts};
use crate::about;
use crate::answer::Answer as _;
use crate::exit::Exit;
use crate::words::count;
use crate::{families, messages, over_time, scale};

impl CompareAnswer {
    /// The answer in a sentence.
    pub fn sentence(&self) -> String {
        sentence(self)
    }

    /// The tables of its text.
    fn tables(&self, text: &mut Text) {
        let rows = &self.rows;
        text.section().table(overview(self));
        let sections = [
            ("margin to", margins((rows, self.fold), &CompareRow::limit, &self.unit)),
            ("settled margin to", settled_margins((rows, self.fold), &self.unit)),
            ("report", numbers(rows, &self.unit)),
            ("standard deviation", doubts::columns((rows, self.fold), &names(rows), &self.unit)),
            (heat_over(rows), heat(rows, self.fold)),
            ("heat by path", shares((rows, self.fold), CompareRow::path_names(rows))),
        ];
        for (title, columns) in sections.into_iter().filter(|(_, columns)| !columns.is_empty()) {
            for table in tables(title, rows, columns) {
                text.section().table(table);
            }
        }
    }
}

impl Page for CompareAnswer {
    fn text(&self) -> Text {
        let rows = &self.rows;
        let of = only_file(rows).map_or(String::new(), |file| format!(" of {}", plain(file)));
        let mut text = Text::titled(format!("{}{of}", count(rows.len(), "candidate")));
        if let Some(verdict) = self.verdict() {
            text.sentence("", &verdict);
        }
        self.tables(&mut text);
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.candidates().into()
    }

    fn figures(&self) -> Vec<Figure> {
        [Some(self.figure()), self.curves(), self.heat_bars()].into_iter().flatten().collect()
    }

    fn more(&self) -> Report {
        let (answer, mut results) = (self.side_by_side(), Text::new());
        self.tables(&mut results);
        Report { answer, results: Some(results), ..about::of_command(&[], &self.command) }
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let errors = self.failures.iter().flat_map(|failure| {
            let list = failure.diagnostics.iter();
            list.map(|diagnostic| messages::json(&failure.files, diagnostic)).collect::<Vec<_>>()
        });
        json.member("format", &1)?;
        json.member("network", &())?;
        json.member("warnings", &messages::list(self.files(), &self.doubts()))?;
        let errors: Value = errors.collect();
        match self.exit() {
            Exit::Done | Exit::No => json.member("errors", &errors)?,
            exit => messages::failed(json, exit, &errors)?,
        }
        json.optional("verdict", self.verdict())?;
        json.table(&self.candidates())
    }
}

impl CompareAnswer {
    fn candidates(&self) -> Table {
        scale::table(compare_table(&self.rows, &self.unit), &self.unit)
    }
}

/// The file of which all candidates are variants.
fn only_file(rows: &[CompareRow]) -> Option<&str> {
    let file =
        |row: &'_ CompareRow| row.file.strip_suffix(')')?.split_once(" (").map(|(f, _)| f.len());
    let length = file(rows.first()?)?;
    let first = &rows[0].file[..length + 2];
    rows.iter().all(|row| row.file.starts_with(first)).then(|| &rows[0].file[..length])
}

/// Names of the candidates. Variants of one file have their labels, other files their stems.
/// If two stems are equal, the whole file name is used.
pub(super) fn names(rows: &[CompareRow]) -> Vec<String> {
    if let Some(file) = only_file(rows) {
        let label = |row: &CompareRow| plain(&row.file[file.len() + 2..row.file.len() - 1]);
        return rows.iter().map(label).collect();
    }
    let stem = |row: &CompareRow| {
        let stem = Path::new(&row.file).file_stem();
        plain(&stem.map_or_else(|| row.file.clone().into(), |stem| stem.to_string_lossy()))
    };
    let stems: Vec<String> = rows.iter().map(stem).collect();
    let twice = |stem: &String| stems.iter().filter(|other| *other == stem).count() > 1;
    rows.iter()
        .zip(&stems)
        .map(|(row, s)| if twice(s) { plain(&row.file) } else { s.clone() })
        .collect()
}

fn overview(comparison: &CompareAnswer) -> TextTable {
    let (rows, unit) = (&comparison.rows, &comparison.unit);
    let candidates = rows.iter().filter_map(CompareRow::candidate);
    let shown = |c: &Candidate| [c.peak.map(|peak| peak.temperature), c.steady, settled(c)];
    let temperatures: Vec<f64> = candidates.flat_map(shown).flatten().collect();
    let low = temperatures.iter().copied().fold(f64::INFINITY, f64::min);
    let high = temperatures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // finer than that is the error of the runs
    let digits = decimals((high - low) / unit.scale, 3, 1).min(4);
    let number = |kelvin: f64| fixed(unit.from_si(kelvin), digits);
    let (mut names, mut ends) = (names(rows).into_iter(), comparison.ends.iter());
    let mut table = TextTable::of(rows)
        .left(format!("T [{}]", unit.text), |_| names.next().unwrap_or_default())
        .left("hottest", cell(|c| c.hottest.clone()))
        .names()
        .right("peak", cell(|c| c.peak.map(|peak| number(peak.temperature))))
        .right("at", cell(|c| c.peak?.at.map(|time| duration(time, 3))))
        .optional();
    let any =
        |what: &dyn Fn(&Candidate) -> bool| rows.iter().filter_map(CompareRow::candidate).any(what);
    let cycles = any(&|candidate| settled(candidate).is_some());
    // inputs that repeat themselves have a settled cycle, and no steady state
    if !cycles || any(&|candidate| candidate.steady.is_some()) {
        table = table
            .right("steady", cell(|c| c.steady.map(number)))
            .right("95 % after", cell(|c| c.time_to_95.map(|time| duration(time, 3))));
    }
    if any(&|candidate| settled(candidate).is_some() && candidate.heat.over == HeatOver::Run) {
        let other = |c: &Candidate| {
            let node = c.settled.as_ref()?.as_ref().ok()?.hottest.clone()?;
            (c.hottest.as_ref() != Some(&node)).then(|| format!(" ({node})"))
        };
        let text = |c: &Candidate| {
            Some(format!("{}{}", number(settled(c)?), other(c).unwrap_or_default()))
        };
        table = table.right("settled", cell(text));
    }
    table = table.right("C [J/K]", cell(|c| Some(significant(c.capacity, 4)))).optional();
    if any(&|candidate| candidate.mass.is_some()) {
        table = table.right("m [kg]", cell(|c| c.mass.map(|mass| significant(mass, 4)))).optional();
    }
    table
        .left("limits", |row| verdict(row, ends.next().copied().unwrap_or(Exit::Done)))
        .judged(|row| match row.status() {
            "kept" => Standing::Holds,
            "none" | "warning" | "not judged" => Standing::Open,
            _ => Standing::Fails,
        })
        .into()
}

/// The peak of its settled cycle in K.
pub(super) fn settled(candidate: &Candidate) -> Option<f64> {
    Some(candidate.settled.as_ref()?.as_ref().ok()?.peak?.temperature)
}

/// Text of a candidate that was evaluated, else [`NOTHING`].
fn cell<'a>(text: impl Fn(&'a Candidate) -> Option<String>) -> impl Fn(&'a CompareRow) -> String {
    move |row| row.candidate().and_then(&text).unwrap_or_else(|| NOTHING.into())
}

fn verdict(row: &CompareRow, end: Exit) -> &str {
    match (end, row.status()) {
        (Exit::Input, _) => "not read",
        (Exit::Failed, _) => "failed",
        (Exit::Interrupted, _) => "not finished",
        (_, status) => status,
    }
}

/// A column for each report that is a number over time.
fn numbers(rows: &[CompareRow], unit: &Unit) -> Vec<Column> {
    let column = |name: &&str| {
        let number = |report: &CandidateReport| over_time::number((report.value, report.ty), unit);
        let cell = |row: &CompareRow| row.report(name).map_or_else(|| NOTHING.to_owned(), number);
        Column::new(*name, Align::Right, rows.iter().map(cell).collect())
    };
    CompareRow::report_names(rows).iter().map(column).collect()
}

/// Title of amounts of heat: over the run if any candidate has one, else over the cycle.
/// In steady state it is the heat flow out.
pub(super) fn heat_over(rows: &[CompareRow]) -> &'static str {
    let all = || rows.iter().filter_map(CompareRow::candidate).map(|c| c.heat.over);
    match (all().any(|over| over == HeatOver::Run), all().any(|over| over == HeatOver::Cycle)) {
        (true, _) => "heat over the run",
        (_, true) => "heat over the cycle",
        _ => "heat out",
    }
}

/// Columns: all heat that leaves or is stored, the stored part, and the share of each boundary.
fn heat(rows: &[CompareRow], fold: bool) -> Vec<Column> {
    let column = |title: &str, cell: &dyn Fn(&Candidate) -> Option<String>| {
        let cell = |row: &CompareRow| row.candidate().and_then(cell);
        let cells = rows.iter().map(|row| cell(row).unwrap_or_else(|| NOTHING.to_owned()));
        Column::new(title, Align::Right, cells.collect())
    };
    let all = |candidate: &Candidate| {
        let HeatOut { all, over, .. } = candidate.heat;
        let unit = if over == HeatOver::Steady { "W" } else { "J" };
        let (scale, letter) = prefix(all);
        let number = fixed(all / scale, decimals(all / scale, 4, 0));
        (all > 0.0).then(|| format!("{number} {letter}{unit}"))
    };
    let mut columns = vec![column("all", &all)];
    if rows.iter().filter_map(CompareRow::candidate).any(|c| c.heat.stored.is_some()) {
        columns.push(column("stored", &|candidate| candidate.heat.stored.map(percent)));
    }
    columns.extend(shares((rows, fold), CompareRow::boundary_names(rows)));
    columns
}

/// A column for each of these boundaries or paths: its share of all heat, of a large family the sum.
fn shares((rows, fold): (&[CompareRow], bool), names: Vec<&str>) -> Vec<Column> {
    let named = |name: &&str| ((*name).to_owned(), 0);
    let column = |of: families::Row<&str>| {
        let share = |row: &CompareRow| {
            let shares: Vec<f64> = of.all().filter_map(|name| row.share(name)).collect();
            (!shares.is_empty()).then(|| percent(shares.iter().sum()))
        };
        let cells =
            rows.iter().map(|row| share(row).unwrap_or_else(|| NOTHING.to_owned())).collect();
        Column::new(&of.name, Align::Right, cells)
    };
    families::folded(names, fold, named, |_| 0.0).into_iter().map(column).collect()
}

fn percent(share: f64) -> String {
    format!("{} %", fixed(100.0 * share, 1))
}

/// Tables that together show every column within the width, without empty rows.
fn tables(title: &str, rows: &[CompareRow], mut columns: Vec<Column>) -> Vec<TextTable> {
    let mut first = Column::new(title, Align::Left, names(rows));
    let kept: Vec<bool> = (0..rows.len())
        .map(|row| columns.iter().any(|column| column.cells[row] != NOTHING))
        .collect();
    for column in columns.iter_mut().chain([&mut first]) {
        let mut kept = kept.iter();
        column.cells.retain(|_| kept.next().is_some_and(|kept| *kept));
    }
    if first.cells.is_empty() {
        return Vec::new();
    }
    stacked(&first, columns, |table| table.width() <= WIDTH)
}

/// One sentence: unfinished candidates, else unread ones, else failed ones, else broken limits.
fn sentence(comparison: &CompareAnswer) -> String {
    let names = names(&comparison.rows);
    let of = |wanted: Exit| {
        let ends = names.iter().zip(&comparison.ends).filter(|(_, end)| **end == wanted);
        ends.map(|(name, _)| name.clone()).collect::<Vec<_>>().join(", ")
    };
    match comparison.exit() {
        Exit::Interrupted => format!("interrupted: not finished: {}", of(Exit::Interrupted)),
        Exit::Input => format!("not read: {}", of(Exit::Input)),
        Exit::Failed => format!("failed: {}", of(Exit::Failed)),
        Exit::No => {
            format!("limit broken: {}", { broken((&comparison.rows, comparison.fold), &names) })
        }
        _ if comparison
            .rows
            .iter()
            .all(|row| row.candidate().is_some_and(|c| c.limits.is_empty())) =>
        {
            "no candidate has a [limit]".into()
        }
        _ if comparison.rows.iter().any(|row| row.status() == "not judged") => {
            "limits are not judged if inputs change with time without a [run], or if gears carry \
             no load"
                .into()
        }
        _ if comparison.rows.len() == 1 => "the candidate keeps its limits".into(),
        _ => "all candidates keep their limits".into(),
    }
}
