//! Means and extremes over windows of a run: table, CSV and JSON.

use lptn_report::{Clock, Shortest, Text, TextTable, decimals, fixed};
use lptn_solve::{ColumnSeen, Solution, WindowSeen};
use lptn_study::SiValue;
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::families::{self, Row};
use crate::words::{MOST_NODES, symbol};
use crate::{over_time, scale};

/// A section for each window.
pub(super) fn sections(
    text: &mut Text,
    (solution, fold): (&Solution, bool),
    units: (&Unit, Clock),
) {
    for window in solution.windows() {
        section(text, (window, fold), units);
        let numbers = (solution.network(), window.reports.as_slice());
        over_time::section(text, numbers, (&format!("over {}", window.name), units.0));
    }
}

fn section(text: &mut Text, (window, fold): (&WindowSeen, bool), (unit, clock): (&Unit, Clock)) {
    let named = |c: &&ColumnSeen| (c.name.clone(), 0);
    let columns = window.columns.iter().collect();
    let mut rows: Vec<Row<&ColumnSeen>> = families::folded(columns, fold, named, |c| c.max.0);
    let all = rows.len();
    rows.truncate(MOST_NODES);
    let number = |column: &ColumnSeen, value: f64| {
        let [low, high] = [column.min.0, column.max.0].map(|value| column.shown(value, unit));
        fixed(column.shown(value, unit), decimals(low.abs().max(high.abs()), 4, 1))
    };
    let title =
        format!("{}: {} to {}", window.name, clock.text(window.from, 4), clock.text(window.to, 4));
    let table = TextTable::of(&rows)
        .left(title, |row| format!("{} [{}]", row.name, symbol(&row.item.unit(unit))));
    let table = families::members(table, &rows, "highest")
        .right("mean", |row| number(row.item, row.item.mean))
        .right("min", |row| number(row.item, row.item.min.0))
        .right("at", |row| clock.text(row.item.min.1, 4))
        .optional()
        .right("max", |row| row.range(|c| c.max.0, |max| number(row.item, max)))
        .right("at", |row| clock.text(row.item.max.1, 4))
        .optional();
    text.section().table(table);
    if rows.len() < all {
        text.line(format!("{} of {all} are shown, --select shows others", rows.len()));
    }
}

/// The rows of `windows.csv`, temperatures in `unit`.
pub(super) fn rows(windows: &[WindowSeen], unit: &Unit) -> Vec<Vec<String>> {
    let heading = [
        "window",
        "column",
        "unit",
        "from [s]",
        "to [s]",
        "mean",
        "min",
        "min_at [s]",
        "max",
        "max_at [s]",
    ];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    let mut text = Shortest::new();
    for window in windows {
        for c in &window.columns {
            let in_unit = symbol(&c.unit(unit)).to_owned();
            let values = [c.mean, c.min.0, c.max.0].map(|value| c.shown(value, unit));
            let numbers =
                [window.from, window.to, values[0], values[1], c.min.1, values[2], c.max.1];
            let mut row = vec![window.name.clone(), c.name.clone(), in_unit];
            row.extend(numbers.map(|number| text.text(number).to_owned()));
            rows.push(row);
        }
    }
    rows
}

/// Members by the window's name:
/// `{ from, to, columns: { NAME: { mean, min, min_at, max, max_at } } }`, with `reports` if there
/// are numbers over time; in SI but for temperatures, which are in `unit`.
pub(super) fn members(solution: &Solution, unit: &Unit) -> Map<String, Value> {
    let time = |time: f64| SiValue::new(time, "s");
    let column = |c: &ColumnSeen| {
        let scalar = |value: f64| scale::scalar(value, c.ty, unit);
        let member = json!({
            "mean": scalar(c.mean),
            "min": scalar(c.min.0),
            "min_at": time(c.min.1),
            "max": scalar(c.max.0),
            "max_at": time(c.max.1),
        });
        (c.name.clone(), member)
    };
    let one = |window: &WindowSeen| {
        let columns: Map<String, Value> = window.columns.iter().map(column).collect();
        let mut member =
            json!({ "from": time(window.from), "to": time(window.to), "columns": columns });
        if let Some(reports) = over_time::members(solution.network(), &window.reports, unit) {
            member["reports"] = reports;
        }
        (window.name.clone(), member)
    };
    solution.windows().iter().map(one).collect()
}
