//! Values of the file's own parameters, to paste.

use lptn_netlist::Netlist;
use lptn_network::is_name;
use lptn_report::significant;
use lptn_units::Unit;

/// A value with its unit, as short as it can be.
pub(crate) fn with_unit(unit: &Unit, value: f64) -> String {
    let number = significant(unit.from_si(value), 3);
    if unit.text == "1" { number } else { format!("{number} {}", unit.text) }
}

/// The value of a parameter in a load case.
pub(crate) fn set(netlist: &Netlist) -> Option<String> {
    let (name, value, unit) = first(netlist)?;
    Some(format!("{name} = \"{}\"", with_unit(&unit, value)))
}

/// A parameter with a standard deviation.
pub(crate) fn deviation(netlist: &Netlist) -> Option<String> {
    let (name, value, unit) = first(netlist)?;
    let error = if unit.ty.absolute { "1 K" } else { "10 %" };
    Some(format!("{name} = \"{} ± {error}\"", with_unit(&unit, value)))
}

/// The first parameter that is a number with a unit.
fn first(netlist: &Netlist) -> Option<(&str, f64, Unit)> {
    let network = &netlist.network;
    network.parameter_ids().find_map(|id| {
        let name = network.parameters()[id.index()].name.as_str();
        let unit = netlist.written_number(id).filter(|_| is_name(name))?.unit;
        Some((name, network.parameter_value(id), unit))
    })
}
