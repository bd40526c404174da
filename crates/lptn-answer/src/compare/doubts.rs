//! Uncertainty of a comparison: effect of the `±` of parameters on peaks, margins and their order.

use lptn_netlist::Diagnostic;
use lptn_report::{Align, Column, decimals, fixed, significant};
use lptn_study::{Candidate, CompareRow, Scatter};
use lptn_units::{Type, Unit};

use super::margins::limits;
use crate::input::Input;
use crate::run::uncertainty::bends;
use crate::scale;
use crate::words::{difference, spaced};

/// Cell of a value that is not known or does not exist.
const NOTHING: &str = "-";

/// Computes the uncertainty of a candidate's results; returns a warning if that is impossible.
pub(super) fn look(input: &Input, found: &mut Candidate, file: &str) -> Option<Diagnostic> {
    let warning = |code, why: &str| {
        let message = format!("{file}: the uncertainty of the results is not known: {why}");
        Some(Diagnostic::warning(code, message))
    };
    let netlist = &input.netlist;
    let (Some(run), Some(hottest)) = (&netlist.run, &found.hottest) else {
        return warning("uncertainty::no_run", "it is computed over a [run]");
    };
    let parameters = netlist.overrides();
    match Scatter::of_run(&netlist.network, (&parameters, run), hottest) {
        Ok(scatter) => {
            let bent = scatter.as_ref().map_or(&[][..], |scatter| &scatter.bent);
            let rough = bends((&netlist.network, &netlist.temperature_unit), bent).map(|text| {
                Diagnostic::warning("uncertainty::not_linear", format!("{file}: {text}"))
            });
            found.scatter = scatter;
            rough
        }
        Err(error) => warning(error.code(), &error.to_string()),
    }
}

/// Columns of uncertainty, none if nothing is uncertain.
/// Deviations of peak and margins, probability of a broken limit, peak over that of the first.
pub(super) fn columns(
    (rows, fold): (&[CompareRow], bool),
    names: &[String],
    unit: &Unit,
) -> Vec<Column> {
    let Some(first) = rows.iter().position(|row| row.scatter().is_some()) else {
        return Vec::new();
    };
    let column = |title: String, cell: &dyn Fn(&CompareRow) -> Option<String>| {
        let cells = rows.iter().map(|row| cell(row).unwrap_or_else(|| NOTHING.to_owned()));
        Column::new(title, Align::Right, cells.collect())
    };
    let number = |si: f64, ty: Type| {
        let (value, unit) = scale::in_unit(si, Type::of(ty.dimension), unit);
        format!("{}{}", significant(value, 2), spaced(&unit))
    };
    let peak = |row: &CompareRow| Some(number(row.scatter()?.peak, Type::ABSOLUTE_TEMPERATURE));
    let mut columns = vec![column("peak".into(), &peak)];
    for judged in limits(rows, fold) {
        let (name, limit) = (judged.worst_name(), CompareRow::limit);
        let sd = |row: &CompareRow| {
            let worst = judged.worst(row, &limit)?;
            Some(number(row.scatter_of(&worst.name)?.0, worst.ty))
        };
        columns.push(column(name.clone(), &sd));
        let broken =
            |row: &CompareRow| Some(percent(row.scatter_of(&judged.worst(row, &limit)?.name)?.1));
        columns.push(column(format!("P({name} broken)"), &broken));
    }
    if rows.iter().filter(|row| row.scatter().is_some()).count() > 1 {
        let than = rows[first].scatter();
        let above = |row: &CompareRow| Some(row.scatter()?.above(than?));
        let shown = |row: &CompareRow| {
            let above = above(row).filter(|_| !std::ptr::eq(row, &rows[first]))?;
            let [by, error] = [above.by, above.deviation].map(|kelvin| kelvin / unit.scale);
            let digits = decimals(error, 2, 0);
            Some(format!("{} ± {} {}", fixed(by, digits), fixed(error, digits), difference(unit)))
        };
        columns.push(column(format!("above {}", names[first]), &shown));
        let sure = |row: &CompareRow| {
            let above = above(row).filter(|_| !std::ptr::eq(row, &rows[first]))?;
            Some(percent(above.probability))
        };
        columns.push(column("P(above)".into(), &sure));
    }
    columns
}

fn percent(share: f64) -> String {
    if share < 5e-4 {
        return "< 0.1 %".to_owned();
    }
    if share > 1.0 - 5e-4 {
        return "> 99.9 %".to_owned();
    }
    format!("{} %", fixed(100.0 * share, if (0.1..=0.9).contains(&share) { 0 } else { 1 }))
}
