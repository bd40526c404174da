//! Means and extremes over windows of a run: table, CSV and JSON.

use lptn_report::{Align, Column, Shortest, TextTable, WIDTH, decimals, duration, fixed};
use lptn_solve::{ColumnSeen, WindowSeen};
use lptn_study::Scalar;
use lptn_units::Unit;
use serde_json::{Map, Value, json};

use crate::words::{MOST_NODES, symbol};

/// A block for each window, with an empty line after each.
pub(crate) fn lines(windows: &[WindowSeen], unit: &Unit) -> Vec<String> {
    windows.iter().flat_map(|window| block(window, unit)).collect()
}

fn block(window: &WindowSeen, unit: &Unit) -> Vec<String> {
    let shown = &window.columns[..window.columns.len().min(MOST_NODES)];
    let cells = |text: &dyn Fn(&ColumnSeen) -> String| shown.iter().map(text).collect::<Vec<_>>();
    let number = |column: &ColumnSeen, value: f64| {
        let [low, high] = [column.min.0, column.max.0].map(|value| column.shown(value, unit));
        fixed(column.shown(value, unit), decimals(low.abs().max(high.abs()), 4, 1))
    };
    let title = format!("{}: {} to {}", window.name, duration(window.from, 4), duration(window.to, 4));
    let name = |c: &ColumnSeen| format!("{} [{}]", c.name, symbol(&c.unit(unit)));
    let table = TextTable::new(vec![
        Column::new(title, Align::Left, cells(&name)),
        Column::new("mean", Align::Right, cells(&|c| number(c, c.mean))),
        Column::new("min", Align::Right, cells(&|c| number(c, c.min.0))),
        Column::new("at", Align::Right, cells(&|c| duration(c.min.1, 4))).optional(),
        Column::new("max", Align::Right, cells(&|c| number(c, c.max.0))),
        Column::new("at", Align::Right, cells(&|c| duration(c.max.1, 4))).optional(),
    ]);
    let mut lines = table.lines(WIDTH);
    if shown.len() < window.columns.len() {
        lines.push(format!("{} of {} are shown, --select shows others", shown.len(), window.columns.len()));
    }
    lines.push(String::new());
    lines
}

/// The rows of `windows.csv`, temperatures in `unit`.
pub(crate) fn rows(windows: &[WindowSeen], unit: &Unit) -> Vec<Vec<String>> {
    let heading =
        ["window", "column", "unit", "from [s]", "to [s]", "mean", "min", "min_at [s]", "max", "max_at [s]"];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    let mut text = Shortest::new();
    for window in windows {
        for c in &window.columns {
            let in_unit = symbol(&c.unit(unit)).to_owned();
            let values = [c.mean, c.min.0, c.max.0].map(|value| c.shown(value, unit));
            let numbers = [window.from, window.to, values[0], values[1], c.min.1, values[2], c.max.1];
            let mut row = vec![window.name.clone(), c.name.clone(), in_unit];
            row.extend(numbers.map(|number| text.text(number).to_owned()));
            rows.push(row);
        }
    }
    rows
}

/// Members by the window's name: `{ from, to, columns: { NAME: { mean, min, min_at, max, max_at } } }`, in SI.
pub(crate) fn members(windows: &[WindowSeen]) -> Map<String, Value> {
    let time = |time: f64| Scalar::new(time, "s").json();
    let column = |c: &ColumnSeen| {
        let scalar = |value: f64| Scalar::new(value, &c.ty.dimension.si_unit()).json();
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
        let member = json!({ "from": time(window.from), "to": time(window.to), "columns": columns });
        (window.name.clone(), member)
    };
    windows.iter().map(one).collect()
}
