//! Reports that have no value somewhere in a run.

use lptn_netlist::{Diagnostic, Netlist};
use lptn_network::{Field, Item};
use lptn_report::significant;
use lptn_solve::Table;

/// A warning for each report whose expression has no value in some row.
/// It gives the first such time.
pub fn gaps(netlist: &Netlist, table: &Table) -> Vec<Diagnostic> {
    let network = &netlist.network;
    let times = table.columns().first().map_or(&[][..], |time| &time.values);
    let gap = |(report, id): (&lptn_network::Report, _)| {
        let column = table.columns().iter().find(|column| column.name == report.name)?;
        let time = times.get(column.values.iter().position(|value| !value.is_finite())?)?;
        let message =
            format!("report `{}` has no value at {} s", report.name, significant(*time, 6));
        let warning = Diagnostic::warning("run::report_without_value", message).help(
            "keep divisors and the arguments of `sqrt` and `ln` away from 0: `max(x, 1e-9)` with \
             its unit",
        );
        let map = &netlist.source_map;
        let place = map.get(Item::Report(id), Field::Value).or_else(|| map.name(Item::Report(id)));
        Some(warning.at(place, "nothing here"))
    };
    network.reports().iter().zip(network.report_ids()).filter_map(gap).collect()
}
