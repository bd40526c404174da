//! Means and extremes over windows of a run: table, CSV and JSON.

use lptn_report::{Clock, Shortest, Text, TextTable, decimals, fixed};
use lptn_solve::{ColumnSeen, Solution, WindowSeen};
use lptn_study::SiValue;
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::words::{MOST_NODES, symbol};
use crate::{over_time, scale};

/// A section for each window.
pub(super) fn sections(text: &mut Text, solution: &Solution, units: (&Unit, Clock)) {
    for window in solution.windows() {
        section(text, window, units);
        let numbers = (solution.network(), window.reports.as_slice());
        over_time::section(text, numbers, (&format!("over {}", window.name), units.0));
    }
}

fn section(text: &mut Text, window: &WindowSeen, (unit, clock): (&Unit, Clock)) {
    let shown = &window.columns[..window.columns.len().min(MOST_NODES)];
    let number = |column: &ColumnSeen, value: f64| {
        let [low, high] = [column.min.0, column.max.0].map(|value| column.shown(value, unit));
        fixed(column.shown(value, unit), decimals(low.abs().max(high.abs()), 4, 1))
    };
    let title =
        format!("{}: {} to {}", window.name, clock.text(window.from, 4), clock.text(window.to, 4));
    let table = TextTable::of(shown)
        .left(title, |c| format!("{} [{}]", c.name, symbol(&c.unit(unit))))
        .right("mean", |c| number(c, c.mean))
        .right("min", |c| number(c, c.min.0))
        .right("at", |c| clock.text(c.min.1, 4))
        .optional()
        .right("max", |c| number(c, c.max.0))
        .right("at", |c| clock.text(c.max.1, 4))
        .optional();
    text.section().table(table);
    if shown.len() < window.columns.len() {
        let all = window.columns.len();
        text.line(format!("{} of {all} are shown, --select shows others", shown.len()));
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
