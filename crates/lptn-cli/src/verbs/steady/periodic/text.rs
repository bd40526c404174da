//! The table of a periodic state.

use lptn_report::{Text, TextTable, decimals, duration, fixed, prefix, significant};
use lptn_solve::{ColumnSeen, Method};
use lptn_units::Dimension;

use super::View;
use crate::verbs::run::page::heat_over;
use crate::words::{MOST_NODES, count, difference, some_of, symbol};
use crate::{balance, limits};

/// A column with its first value, in SI.
type Row<'a> = (&'a ColumnSeen, f64);

pub(crate) fn text(view: &View<'_>) -> Text {
    let (job, solution) = (&view.outcome.job, &view.found.solution);
    let network = solution.network();
    let mut text = job.input.begun();
    let seen = view.cycle().map_or(&[][..], |cycle| &cycle.columns);
    let rows: Vec<Row<'_>> = seen.iter().zip(view.starts()).collect();
    let (temperatures, rest): (Vec<Row<'_>>, Vec<Row<'_>>) =
        rows.into_iter().partition(|(c, _)| c.ty.absolute);
    let (flows, others): (Vec<Row<'_>>, Vec<Row<'_>>) =
        rest.into_iter().partition(|(c, _)| c.ty.dimension == Dimension::POWER && c.name.contains('.'));
    temperature_section(&mut text, view, temperatures);
    flow_section(&mut text, flows);
    other_section(&mut text, view, &others);
    limits::section(&mut text, network, &view.outcome.limits(), &job.unit);
    if let Some(of) = solution.balance() {
        let times = Some((job.settings.start, job.settings.stop));
        balance::section(&mut text, network, (of, times));
    }
    found_section(&mut text, view);
    heat_over(text.section(), solution, view.period());
    text
}

fn temperature_section(text: &mut Text, view: &View<'_>, mut rows: Vec<Row<'_>>) {
    let unit = &view.outcome.job.unit;
    let all = rows.len();
    if all > MOST_NODES {
        rows.sort_by(|a, b| b.0.max.0.total_cmp(&a.0.max.0));
        rows.truncate(MOST_NODES);
    }
    let swing = |c: &ColumnSeen| c.max.0 - c.min.0;
    let span = rows.iter().map(|(c, _)| swing(c)).fold(0.0, f64::max);
    let digits = decimals(span / unit.scale, 3, 1);
    // what the tolerance cannot tell from rest is none
    let clear = |swing: f64| if swing > 10.0 * view.outcome.job.settings.tolerance { swing } else { 0.0 };
    let kelvin = |value: f64| fixed(unit.from_si(value), digits);
    let table = TextTable::of(&rows)
        .left(format!("T [{}]", unit.text), |(c, _)| c.name.strip_suffix(".T").unwrap_or(&c.name))
        .right("start", |(_, start)| fixed(*start, digits))
        .right("mean", |(c, _)| kelvin(c.mean))
        .right("min", |(c, _)| kelvin(c.min.0))
        .right("max", |(c, _)| kelvin(c.max.0))
        .right("at", |(c, _)| at(c))
        .optional()
        .right(format!("swing [{}]", difference(unit)), |(c, _)| {
            significant(clear(swing(c)) / unit.scale, 3)
        });
    some_of(text, table, (all, "the hottest first; --select 'NAME.T' shows others"));
}

/// When the largest value is there; nothing for a constant.
fn at(column: &ColumnSeen) -> String {
    if column.max.0 > column.min.0 { duration(column.max.1, 3) } else { "-".into() }
}

fn flow_section(text: &mut Text, mut rows: Vec<Row<'_>>) {
    let all = rows.len();
    if all > MOST_NODES {
        rows.sort_by(|a, b| b.0.mean.abs().total_cmp(&a.0.mean.abs()));
        rows.truncate(MOST_NODES);
    }
    let largest = rows.iter().map(|(c, _)| c.mean.abs()).fold(0.0, f64::max);
    let (scale, letter) = prefix(largest);
    let digits = decimals(largest / scale, 4, 0);
    let watt = |value: f64| fixed(value / scale, digits);
    let table = TextTable::of(&rows)
        .left(format!("heat flow [{letter}W]"), |(c, _)| c.name.as_str())
        .right("mean", |(c, _)| watt(c.mean))
        .right("min", |(c, _)| watt(c.min.0))
        .right("max", |(c, _)| watt(c.max.0));
    some_of(text, table, (all, "the largest first; --select 'NAME.Q' shows others"));
}

/// Signals and reports.
fn other_section(text: &mut Text, view: &View<'_>, rows: &[Row<'_>]) {
    let unit = &view.outcome.job.unit;
    let number = |c: &ColumnSeen, value: f64| significant(c.shown(value, unit), 5);
    let table = TextTable::of(rows)
        .left("column", |(c, _)| format!("{} [{}]", c.name, symbol(&c.unit(unit))))
        .right("mean", |(c, _)| number(c, c.mean))
        .right("min", |(c, _)| number(c, c.min.0))
        .right("max", |(c, _)| number(c, c.max.0));
    some_of(text, table, (rows.len(), ""));
}

/// How the cycle was found, and how far it is to be believed.
fn found_section(text: &mut Text, view: &View<'_>) {
    let found = view.found;
    let kelvin = |value: f64| format!("{} K", significant(value, 2));
    let how = match found.method {
        Method::Modes => "in closed form, mode by mode;",
        Method::Shooting => "by shooting;",
        Method::Stateless => "without a search, as nothing is stored;",
    };
    let mut pieces = vec![how.to_owned(), format!("{} integrated,", count(found.cycles, "cycle"))];
    pieces.push(format!("{} steps", found.steps));
    let cycle =
        format!("{}, from {} on", duration(view.period(), 6), duration(view.outcome.job.settings.start, 4));
    text.section().line(format!("cycle:   {cycle}"));
    text.labelled("found:   ", pieces);
    let bound = if found.error.is_finite() {
        format!("at most about {}", kelvin(found.error))
    } else {
        "not known".into()
    };
    let ends = vec![
        format!("end and start differ by {},", kelvin(found.residual)),
        format!("error of taking it for settled {bound}"),
    ];
    text.labelled("settled: ", ends);
    if let (Some(tau), Some(rho)) = (view.slowest(), found.multiplier) {
        let about = if found.method == Method::Modes { "" } else { "about " };
        text.line(format!(
            "memory:  {about}{} % of a disturbance outlasts a cycle, time constant {}",
            significant(100.0 * rho, 3),
            duration(tau, 3)
        ));
    }
}
