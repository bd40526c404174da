//! Reports that are numbers over time: a table, JSON, and rows of CSV.

use lptn_network::{Network, Report};
use lptn_report::{Shortest, Text, TextTable, rounded_up, significant};
use lptn_solve::{ReportSeen, WindowSeen};
use lptn_units::{Type, Unit};
use serde_json::{Map, Value, json};

use crate::scale;
use crate::words::{spaced, symbol};

/// Digits of a number.
const DIGITS: usize = 5;

fn report<'a>(network: &'a Network, seen: &ReportSeen) -> &'a Report {
    &network.reports()[seen.report.index()]
}

/// A number with its unit; `-` for none.
pub(crate) fn number((si, ty): (f64, lptn_units::Type), unit: &Unit) -> String {
    let (value, unit) = scale::in_unit(si, ty, unit);
    match value.is_finite() {
        true => format!("{}{}", significant(value, DIGITS), spaced(&unit)),
        false => "-".into(),
    }
}

/// The proven bound on the error of a number with its unit; `-` for none.
fn bound(network: &Network, seen: &ReportSeen, unit: &Unit) -> String {
    let Some((value, unit)) = bound_in_unit(network, seen, unit) else { return "-".into() };
    format!("{}{}", rounded_up(value), spaced(&unit))
}

fn bound_in_unit(network: &Network, seen: &ReportSeen, unit: &Unit) -> Option<(f64, String)> {
    let difference = Type { absolute: false, ..report(network, seen).ty };
    Some(scale::in_unit(seen.bound?, difference, unit))
}

/// A section with a line for each number; `over` is the heading of the values. Nothing without
/// numbers.
pub(crate) fn section(
    text: &mut Text,
    (network, seen): (&Network, &[ReportSeen]),
    (over, unit): (&str, &Unit),
) {
    if seen.is_empty() {
        return;
    }
    let table = TextTable::of(seen)
        .left("report", |seen| report(network, seen).name.as_str())
        .left("", |seen| report(network, seen).text.as_str())
        .names()
        .right(over, |seen| number((seen.value, report(network, seen).ty), unit));
    let bounded = seen.iter().any(|seen| seen.bound.is_some());
    let table = match bounded {
        true => table.right("proven error", |seen| bound(network, seen, unit)),
        false => table,
    };
    text.section().table(table);
}

/// Members by the name of the report: `{ of, value, unit }`, `null` for none, and its proven
/// `bound`, if there is one; `None` without numbers.
pub(crate) fn members(network: &Network, seen: &[ReportSeen], shown: &Unit) -> Option<Value> {
    let one = |seen: &ReportSeen| {
        let report = report(network, seen);
        let (value, unit) = scale::in_unit(seen.value, report.ty, shown);
        let mut member = json!({ "of": report.text, "value": value, "unit": unit });
        if let Some((bound, unit)) = bound_in_unit(network, seen, shown) {
            member["bound"] = json!({ "value": bound, "unit": unit });
        }
        (report.name.clone(), member)
    };
    (!seen.is_empty()).then(|| Value::Object(seen.iter().map(one).collect::<Map<_, _>>()))
}

/// The rows of `reports.csv`: those of the run from one time in s to another, without a name, then
/// those of its windows. `None` without numbers.
pub(crate) fn rows(
    (network, seen): (&Network, &[ReportSeen]),
    (span, windows): ((f64, f64), &[WindowSeen]),
    unit: &Unit,
) -> Option<Vec<Vec<String>>> {
    let heading = ["report", "of", "window", "from [s]", "to [s]", "value", "unit"];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    let bounded = seen.iter().any(|seen| seen.bound.is_some());
    rows[0].extend(bounded.then(|| "bound".to_owned()));
    let mut text = Shortest::new();
    let windows = windows.iter().map(|w| (w.name.as_str(), (w.from, w.to), w.reports.as_slice()));
    for (window, (from, to), seen) in [("", span, seen)].into_iter().chain(windows) {
        for seen in seen {
            let report = report(network, seen);
            let bound = bound_in_unit(network, seen, unit);
            let (value, unit) = scale::in_unit(seen.value, report.ty, unit);
            let mut row = vec![report.name.clone(), report.text.clone(), window.to_owned()];
            row.extend([from, to, value].map(|number| text.text(number).to_owned()));
            row.push(symbol(&unit).to_owned());
            let bound = bound.map(|(bound, _)| text.text(bound).to_owned());
            row.extend(bounded.then(|| bound.unwrap_or_default()));
            rows.push(row);
        }
    }
    (!seen.is_empty()).then_some(rows)
}
