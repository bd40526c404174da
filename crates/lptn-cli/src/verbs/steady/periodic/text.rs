//! The table of a periodic state.

use lptn_report::{
    Align, Column, TextTable, WIDTH, decimals, duration, fixed, labelled, plain, prefix, significant,
};
use lptn_solve::{ColumnSeen, Method};
use lptn_units::Dimension;

use super::View;
use crate::console::Console;
use crate::verbs::run::text::heat_over;
use crate::words::{MOST_NODES, count, counts, difference, symbol, with_hidden};

/// A column with its first value, in SI.
type Row<'a> = (&'a ColumnSeen, f64);

pub(crate) fn text(view: &View<'_>, console: &Console) -> String {
    let job = &view.outcome.job;
    let (netlist, solution) = (&job.input.netlist, &view.found.solution);
    let network = &netlist.network;
    let title = network.title().map_or(job.input.text.stem.clone(), plain);
    let mut lines = vec![console.title(&title), counts(network)];
    let starts = view.table.columns().iter().skip(1).map(|c| c.values.first().copied().unwrap_or(f64::NAN));
    let seen = view.cycle().map_or(&[][..], |cycle| &cycle.columns);
    let rows: Vec<Row<'_>> = seen.iter().zip(starts).collect();
    let (temperatures, rest): (Vec<Row<'_>>, Vec<Row<'_>>) =
        rows.into_iter().partition(|(c, _)| c.ty.absolute);
    let (flows, others): (Vec<Row<'_>>, Vec<Row<'_>>) =
        rest.into_iter().partition(|(c, _)| c.ty.dimension == Dimension::POWER && c.name.contains('.'));
    let balance = solution.balance().map_or(Vec::new(), |of| {
        crate::balance::lines(network, of, Some((job.settings.start, job.settings.stop)))
    });
    let blocks = [
        temperature_lines(view, temperatures),
        flow_lines(flows),
        other_lines(view, &others),
        crate::limits::lines(network, &view.outcome.limits(), &job.unit),
        balance,
        found_lines(view),
        heat_over(solution, view.period()),
    ];
    for block in blocks.into_iter().filter(|block| !block.is_empty()) {
        lines.push(String::new());
        lines.extend(block);
    }
    lines.join("\n") + "\n"
}

fn temperature_lines(view: &View<'_>, mut rows: Vec<Row<'_>>) -> Vec<String> {
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
    let cells = |text: &dyn Fn(&Row<'_>) -> String| rows.iter().map(text).collect::<Vec<_>>();
    let kelvin = |value: f64| fixed(unit.from_si(value), digits);
    let table = TextTable::new(vec![
        Column::new(format!("T [{}]", unit.text), Align::Left, cells(&|(c, _)| without_ending(&c.name))),
        Column::new("start", Align::Right, cells(&|(_, start)| fixed(*start, digits))),
        Column::new("mean", Align::Right, cells(&|(c, _)| kelvin(c.mean))),
        Column::new("min", Align::Right, cells(&|(c, _)| kelvin(c.min.0))),
        Column::new("max", Align::Right, cells(&|(c, _)| kelvin(c.max.0))),
        Column::new("at", Align::Right, cells(&|(c, _)| at(c))).optional(),
        Column::new(
            format!("swing [{}]", difference(unit)),
            Align::Right,
            cells(&|(c, _)| significant(clear(swing(c)) / unit.scale, 3)),
        ),
    ]);
    with_hidden(table.lines(WIDTH), (all, rows.len()), "the hottest first; --select 'NAME.T' shows others")
}

/// When the largest value is there; nothing for a constant.
fn at(column: &ColumnSeen) -> String {
    if column.max.0 > column.min.0 { duration(column.max.1, 3) } else { "-".into() }
}

fn without_ending(name: &str) -> String {
    name.strip_suffix(".T").unwrap_or(name).to_owned()
}

fn flow_lines(mut rows: Vec<Row<'_>>) -> Vec<String> {
    let all = rows.len();
    if all > MOST_NODES {
        rows.sort_by(|a, b| b.0.mean.abs().total_cmp(&a.0.mean.abs()));
        rows.truncate(MOST_NODES);
    }
    let largest = rows.iter().map(|(c, _)| c.mean.abs()).fold(0.0, f64::max);
    let (scale, letter) = prefix(largest);
    let digits = decimals(largest / scale, 4, 0);
    let cells = |text: &dyn Fn(&Row<'_>) -> String| rows.iter().map(text).collect::<Vec<_>>();
    let watt = |value: f64| fixed(value / scale, digits);
    let table = TextTable::new(vec![
        Column::new(format!("heat flow [{letter}W]"), Align::Left, cells(&|(c, _)| c.name.clone())),
        Column::new("mean", Align::Right, cells(&|(c, _)| watt(c.mean))),
        Column::new("min", Align::Right, cells(&|(c, _)| watt(c.min.0))),
        Column::new("max", Align::Right, cells(&|(c, _)| watt(c.max.0))),
    ]);
    with_hidden(table.lines(WIDTH), (all, rows.len()), "the largest first; --select 'NAME.Q' shows others")
}

/// Signals and reports.
fn other_lines(view: &View<'_>, rows: &[Row<'_>]) -> Vec<String> {
    if rows.is_empty() {
        return Vec::new();
    }
    let unit = &view.outcome.job.unit;
    let cells = |text: &dyn Fn(&ColumnSeen) -> String| rows.iter().map(|(c, _)| text(c)).collect::<Vec<_>>();
    let number = |c: &ColumnSeen, value: f64| significant(c.shown(value, unit), 5);
    TextTable::new(vec![
        Column::new("column", Align::Left, cells(&|c| format!("{} [{}]", c.name, symbol(&c.unit(unit))))),
        Column::new("mean", Align::Right, cells(&|c| number(c, c.mean))),
        Column::new("min", Align::Right, cells(&|c| number(c, c.min.0))),
        Column::new("max", Align::Right, cells(&|c| number(c, c.max.0))),
    ])
    .lines(WIDTH)
}

/// How the cycle was found, and how far it is to be believed.
fn found_lines(view: &View<'_>) -> Vec<String> {
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
    let mut lines = vec![format!("cycle:   {cycle}")];
    lines.extend(labelled("found:   ", &pieces, WIDTH));
    let bound = if found.error.is_finite() {
        format!("at most about {}", kelvin(found.error))
    } else {
        "not known".into()
    };
    let ends = [
        format!("end and start differ by {},", kelvin(found.residual)),
        format!("error of taking it for settled {bound}"),
    ];
    lines.extend(labelled("settled: ", &ends, WIDTH));
    if let (Some(tau), Some(rho)) = (view.slowest(), found.multiplier) {
        let about = if found.method == Method::Modes { "" } else { "about " };
        lines.push(format!(
            "memory:  {about}{} % of a disturbance outlasts a cycle, time constant {}",
            significant(100.0 * rho, 3),
            duration(tau, 3)
        ));
    }
    lines
}
