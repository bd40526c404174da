//! A settled cycle as a page.

use std::io;

use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, RowColumn, Rows, Shortest, Text, TextTable, decimals, duration, fixed,
    prefix, rounded_up, significant,
};
use lptn_solve::{ColumnSeen, CycleMethod};
use lptn_study::{SiValue, StatisticsRecord};
use lptn_units::Dimension;

use super::CycleAnswer;
use crate::balance;
use crate::run::page::heat_over;
use crate::words::{count, difference, largest, some_of, symbol};
use crate::{families, limits, over_time, proven};

/// A column with its first value, in SI.
type Row<'a> = (&'a ColumnSeen, f64);

impl Page for CycleAnswer {
    fn text(&self) -> Text {
        let (task, solution) = (&self.run.task, &self.found.solution);
        let network = solution.network();
        let mut text = task.input.begun();
        let seen = self.cycle().map_or(&[][..], |cycle| &cycle.columns);
        let rows: Vec<Row<'_>> = seen.iter().zip(self.starts()).collect();
        let (temperatures, rest): (Vec<Row<'_>>, Vec<Row<'_>>) =
            rows.into_iter().partition(|(c, _)| c.ty.absolute);
        let (flows, others): (Vec<Row<'_>>, Vec<Row<'_>>) = rest
            .into_iter()
            .partition(|(c, _)| c.ty.dimension == Dimension::POWER && c.name.contains('.'));
        temperature_section(&mut text, self, temperatures);
        flow_section(&mut text, flows, self.run.folds());
        other_section(&mut text, self, others);
        self.run.over_time(&mut text, "over the cycle");
        let limits = self.run.limits();
        limits::section(&mut text, &self.run.judgement(&limits));
        if let Some(of) = solution.balance() {
            let times = Some((task.settings.start, task.settings.stop));
            balance::section(&mut text, network, (of, times));
        }
        found_section(&mut text, self);
        heat_over(text.section(), (solution, self.run.folds()), (self.period(), task.clock));
        text
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.run.figure()]
    }

    /// Name, unit, value at the start, mean, extremes with their times, and swing of each column.
    fn rows(&self) -> Rows<'_> {
        let unit = &self.run.task.unit;
        let numbers = |(seen, start): (&ColumnSeen, f64)| {
            let [mean, min, max] = [seen.mean, seen.min.0, seen.max.0].map(|x| seen.shown(x, unit));
            [start, mean, min, max, max - min, seen.min.1, seen.max.1]
        };
        let seen = self.cycle().map_or(&[][..], |cycle| &cycle.columns);
        let rows: Vec<[f64; 7]> = seen.iter().zip(self.starts()).map(numbers).collect();
        let words = |name, word: &dyn Fn(&ColumnSeen) -> String| {
            RowColumn::words(name, seen.iter().map(word).collect::<Vec<String>>())
        };
        // a column with values of several units has none
        let values = |name, place: usize| {
            let mut text = Shortest::new();
            let cells = rows.iter().map(|row| text.text(row[place]).to_owned());
            RowColumn::words(name, cells.collect::<Vec<String>>())
        };
        let times = |name, place: usize| {
            RowColumn::numbers(name, "s", rows.iter().map(|row| row[place]).collect::<Vec<f64>>())
        };
        Rows::Columns(vec![
            words("name", &|seen| seen.name.clone()),
            words("unit", &|seen| symbol(&seen.unit(unit)).to_owned()),
            values("start", 0),
            values("mean", 1),
            values("min", 2),
            times("min_at", 5),
            values("max", 3),
            times("max_at", 6),
            values("swing", 4),
        ])
    }

    fn more(&self) -> Report {
        self.run.report(false)
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (solution, settings) = (&self.found.solution, &self.run.task.settings);
        self.run.task.input.head(json, &self.beside())?;
        json.member("start", &SiValue::new(settings.start, "s"))?;
        json.member("period", &SiValue::new(self.period(), "s"))?;
        json.member("columns", &self.members())?;
        json.member("search", &self.search())?;
        json.member("ledger", &self.run.ledger())?;
        let (network, unit) = (solution.network(), &self.run.task.unit);
        json.optional("proven", proven::members(solution, &self.run.task.unit))?;
        json.optional("proven_heat", proven::heat_members(solution))?;
        json.optional("limits", limits::members(network, &self.run.limits(), unit))?;
        let reports = over_time::members(network, solution.reports_over_time(), unit);
        json.optional("reports", reports)?;
        json.optional("out_of_range", self.run.out_of_range())?;
        json.optional("balance", solution.balance().map(|of| balance::json(network, of)))?;
        json.member("statistics", &StatisticsRecord::new(solution))
    }
}

/// The name of a column without the end `.T`.
fn named((column, _): &Row<'_>) -> (String, u8) {
    (column.name.strip_suffix(".T").unwrap_or(&column.name).to_owned(), 0)
}

fn temperature_section(text: &mut Text, view: &CycleAnswer, rows: Vec<Row<'_>>) {
    let unit = &view.run.task.unit;
    let swing = |c: &ColumnSeen| c.max.0 - c.min.0;
    let span = rows.iter().map(|(c, _)| swing(c)).fold(0.0, f64::max);
    let digits = decimals(span / unit.scale, 3, 1);
    // a swing of up to 10 tolerances counts as zero
    let clear =
        |swing: f64| if swing > 10.0 * view.run.task.settings.tolerance { swing } else { 0.0 };
    let kelvin = |value: f64| fixed(unit.from_si(value), digits);
    let mut rows = families::folded(rows, view.run.folds(), named, |row| row.0.max.0);
    let all = largest(&mut rows, |row| row.item.0.max.0);
    let table = TextTable::of(&rows).left(format!("T [{}]", unit.text), |row| row.name.as_str());
    let table = families::members(table, &rows, "hottest")
        .right("start", |row| fixed(row.item.1, digits))
        .right("mean", |row| kelvin(row.item.0.mean))
        .right("min", |row| kelvin(row.item.0.min.0))
        .right("max", |row| row.range(|(c, _)| c.max.0, kelvin))
        .right("at", |row| at(row.item.0))
        .optional()
        .right(format!("swing [{}]", difference(unit)), |row| {
            significant(clear(swing(row.item.0)) / unit.scale, 3)
        });
    let bound = |row: &families::Row<Row<'_>>| {
        let all: Vec<f64> = row.all().filter_map(|(column, _)| view.bound(column)).collect();
        let most = all.into_iter().max_by(f64::total_cmp);
        most.map_or_else(String::new, |kelvin| rounded_up(kelvin / unit.scale))
    };
    let table = match proven::is(&view.found.solution) {
        true => table.right(format!("proven error [{}]", difference(unit)), bound),
        false => table,
    };
    some_of(text, table, (all, "the hottest first; --select 'NAME.T' shows others"));
}

/// Time of the largest value; `-` for a constant.
fn at(column: &ColumnSeen) -> String {
    if column.max.0 > column.min.0 { duration(column.max.1, 3) } else { "-".into() }
}

fn flow_section(text: &mut Text, rows: Vec<Row<'_>>, fold: bool) {
    let most = rows.iter().map(|(c, _)| c.mean.abs()).fold(0.0, f64::max);
    let (scale, letter) = prefix(most);
    let digits = decimals(most / scale, 4, 0);
    let watt = |value: f64| fixed(value / scale, digits);
    let mut rows = families::folded(rows, fold, named, |row| row.0.mean.abs());
    let all = largest(&mut rows, |row| row.item.0.mean.abs());
    let table =
        TextTable::of(&rows).left(format!("heat flow [{letter}W]"), |row| row.name.as_str());
    let table = families::members(table, &rows, "largest")
        .right("mean", |row| row.range(|(c, _)| c.mean, watt))
        .right("min", |row| watt(row.item.0.min.0))
        .right("max", |row| watt(row.item.0.max.0));
    some_of(text, table, (all, "the largest first; --select 'NAME.Q' shows others"));
}

/// Signals and reports.
fn other_section(text: &mut Text, view: &CycleAnswer, rows: Vec<Row<'_>>) {
    let unit = &view.run.task.unit;
    let number = |c: &ColumnSeen, value: f64| significant(c.shown(value, unit), 5);
    let rows = families::folded(rows, view.run.folds(), named, |(c, _)| c.max.0);
    let table = TextTable::of(&rows)
        .left("column", |row| format!("{} [{}]", row.name, symbol(&row.item.0.unit(unit))));
    let table = families::members(table, &rows, "highest")
        .right("mean", |row| number(row.item.0, row.item.0.mean))
        .right("min", |row| number(row.item.0, row.item.0.min.0))
        .right("max", |row| row.range(|(c, _)| c.max.0, |max| number(row.item.0, max)));
    some_of(text, table, (rows.len(), ""));
}

/// Method of the search, and the accuracy of the cycle.
fn found_section(text: &mut Text, view: &CycleAnswer) {
    let found = &view.found;
    let kelvin = |value: f64| format!("{} K", significant(value, 2));
    let how = match found.method {
        CycleMethod::Modes => "in closed form, mode by mode;",
        CycleMethod::Shooting => "by shooting;",
        CycleMethod::Stateless => "without a search, as no node stores heat;",
    };
    let mut pieces = vec![how.to_owned(), format!("{} integrated,", count(found.cycles, "cycle"))];
    pieces.push(format!("{} steps", found.steps));
    let cycle = format!(
        "{}, from {} on",
        duration(view.period(), 6),
        duration(view.run.task.settings.start, 4)
    );
    text.section().line(format!("cycle:   {cycle}"));
    text.labelled("found:   ", pieces);
    let bound = match (found.error, view.error()) {
        (start, whole) if whole.is_finite() => format!(
            "error of the start at most about {}, of the cycle {}",
            kelvin(start),
            kelvin(whole)
        ),
        _ => "error of the start not known".to_owned(),
    };
    let ends = vec![format!("end and start differ by {},", kelvin(found.residual)), bound];
    text.labelled("settled: ", ends);
    for note in proven::notes_of_cycle(&found.solution, &view.run.task.selection) {
        text.sentence("note:    ", &note);
    }
    if let (Some(tau), Some(rho)) = (view.slowest(), found.multiplier) {
        let about = if found.method == CycleMethod::Modes { "" } else { "about " };
        text.line(format!(
            "memory:  {about}{} % of a disturbance outlasts a cycle, time constant {}",
            significant(100.0 * rho, 3),
            duration(tau, 3)
        ));
    }
}
