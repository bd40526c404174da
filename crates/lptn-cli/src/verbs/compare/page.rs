//! What `lptn compare` shows.

use std::io;
use std::path::Path;

use lptn_network::LimitSeverity;
use lptn_plot::Figure;
use lptn_report::{
    Align, Column, Json, Page, Report, Rows, Standing, Text, TextTable, WIDTH, decimals, duration,
    fixed, plain, significant, stacked,
};
use lptn_study::{Candidate, CompareRow, LimitResult, compare_table};
use serde_json::Value;

use super::Comparison;
use crate::about;
use crate::diagnostics;
use crate::exit::Exit;
use crate::scale;
use crate::words::{count, spaced};

/// What is not known or does not exist.
const NOTHING: &str = "-";

impl Page for Comparison {
    fn text(&self) -> Text {
        let rows = &self.rows;
        let mut text = Text::titled(count(rows.len(), "candidate"));
        text.section().table(overview(self));
        for (title, columns) in [("margin to", margins(rows)), ("heat out", heat(rows))] {
            for table in tables(title, rows, columns) {
                text.section().table(table);
            }
        }
        text
    }

    fn rows(&self) -> Rows<'_> {
        compare_table(&self.rows, &self.unit).into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        about::of_command(&[])
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let warnings = self.warnings.iter().flat_map(|(files, list)| {
            list.iter().map(|diagnostic| diagnostics::json(files, diagnostic)).collect::<Vec<_>>()
        });
        let errors = self.failures.iter().flat_map(|failure| {
            let list = failure.diagnostics.iter();
            list.map(|diagnostic| diagnostics::json(&failure.files, diagnostic)).collect::<Vec<_>>()
        });
        json.member("format", &1)?;
        json.member("network", &())?;
        json.member("warnings", &warnings.collect::<Vec<_>>())?;
        let errors: Value = errors.collect();
        match self.exit() {
            Exit::Done | Exit::No => json.member("errors", &errors)?,
            exit => diagnostics::failed(json, exit, &errors)?,
        }
        json.table(&scale::table(&compare_table(&self.rows, &self.unit), &self.unit))
    }
}

/// The names of the candidates: their files without folder and ending, unless two would be the
/// same.
pub(super) fn names(rows: &[CompareRow]) -> Vec<String> {
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

fn overview(comparison: &Comparison) -> TextTable {
    let (rows, unit) = (&comparison.rows, &comparison.unit);
    let candidates = rows.iter().filter_map(CompareRow::candidate);
    let shown = |c: &Candidate| [c.peak.map(|peak| peak.temperature), c.steady];
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
        .optional()
        .right("steady", cell(|c| c.steady.map(number)))
        .right("95 % after", cell(|c| c.time_to_95.map(|time| duration(time, 3))))
        .right("C [J/K]", cell(|c| Some(significant(c.capacity, 4))))
        .optional();
    if rows.iter().filter_map(CompareRow::candidate).any(|candidate| candidate.mass.is_some()) {
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

/// What a text says of a candidate that was evaluated.
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

/// A column for each limit: its margin, and when it breaks.
fn margins(rows: &[CompareRow]) -> Vec<Column> {
    let column = |name: &&str| {
        let cell = |row: &CompareRow| row.limit(name).map_or_else(|| NOTHING.to_owned(), margin);
        Column::new(*name, Align::Right, rows.iter().map(cell).collect())
    };
    CompareRow::limit_names(rows).iter().map(column).collect()
}

fn margin(limit: &LimitResult) -> String {
    if limit.is_open() {
        return NOTHING.into();
    }
    let unit = spaced(&limit.ty.dimension.si_unit());
    let number = if limit.is_temperature() {
        fixed(limit.margin, decimals(limit.margin, 3, 1).min(4))
    } else {
        significant(limit.margin, 3)
    };
    match limit.broken_at {
        Some(time) => format!("{number}{unit} from {}", duration(time, 3)),
        None => format!("{number}{unit}"),
    }
}

/// A column for each boundary: its share of the heat that boundaries take at the end.
fn heat(rows: &[CompareRow]) -> Vec<Column> {
    let column = |name: &&str| {
        let share = |row: &CompareRow| {
            row.share(name).map(|share| format!("{} %", fixed(100.0 * share, 1)))
        };
        let cells =
            rows.iter().map(|row| share(row).unwrap_or_else(|| NOTHING.to_owned())).collect();
        Column::new(*name, Align::Right, cells)
    };
    CompareRow::boundary_names(rows).iter().map(column).collect()
}

/// As many tables as it takes to show every column within the width; a row with nothing in it is
/// left out.
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

/// One sentence: what was not finished, else what could not be read, else what failed, else which
/// limits are broken.
pub(crate) fn answer(comparison: &Comparison) -> String {
    let names = names(&comparison.rows);
    let of = |wanted: Exit| {
        let ends = names.iter().zip(&comparison.ends).filter(|(_, end)| **end == wanted);
        ends.map(|(name, _)| name.clone()).collect::<Vec<_>>().join(", ")
    };
    match comparison.exit() {
        Exit::Interrupted => format!("interrupted: not finished: {}", of(Exit::Interrupted)),
        Exit::Input => format!("not read: {}", of(Exit::Input)),
        Exit::Failed => format!("failed: {}", of(Exit::Failed)),
        Exit::No => format!("limit broken: {}", broken(&comparison.rows, &names)),
        _ if comparison
            .rows
            .iter()
            .all(|row| row.candidate().is_some_and(|c| c.limits.is_empty())) =>
        {
            "no candidate has a [limit]".into()
        }
        _ if comparison.rows.iter().any(|row| row.status() == "not judged") => {
            "limits are not judged where inputs change with time and there is no [run]".into()
        }
        _ if comparison.rows.len() == 1 => "the candidate keeps its limits".into(),
        _ => "all candidates keep their limits".into(),
    }
}

/// "bare breaks steel_hot and skin, fan breaks skin".
fn broken(rows: &[CompareRow], names: &[String]) -> String {
    let of_row = |(row, name): (&CompareRow, &String)| {
        let limits = row.candidate()?.limits.iter();
        let counts =
            limits.filter(|limit| limit.broken() && limit.severity == LimitSeverity::Error);
        let limits: Vec<&str> = counts.map(|limit| limit.name.as_str()).collect();
        (!limits.is_empty()).then(|| format!("{name} breaks {}", limits.join(" and ")))
    };
    rows.iter().zip(names).filter_map(of_row).collect::<Vec<_>>().join(", ")
}
