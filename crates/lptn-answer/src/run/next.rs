//! A command to try next, made from the netlist.

use lptn_netlist::Netlist;
use lptn_network::{Network, ParameterId, Value};
use lptn_report::significant;
use lptn_units::{Dimension, Type};

use crate::input::{Input, quoted};

/// The command to try after `lptn run`: the balance of the node that gets too hot.
/// Otherwise the same run with a fifth more heat or five degrees warmer, else the steady state.
pub(super) fn after_run(input: &Input, has_steady: bool, hot: Option<&str>) -> Option<String> {
    let file = input.typed()?;
    if let Some(node) = hot.filter(|_| has_steady) {
        return Some(format!("lptn steady {file} --balance {}", quoted(node)));
    }
    match what_if(&input.netlist) {
        Some(set) => Some(format!("lptn run {file} --set {set}")),
        None => has_steady.then(|| format!("lptn steady {file}")),
    }
}

/// A `NAME=VALUE` that the netlist accepts.
fn what_if(netlist: &Netlist) -> Option<String> {
    let network = &netlist.network;
    let changed = |wanted: Type, change: fn(f64) -> (f64, &'static str)| {
        let id = network.parameter_ids().find(|&id| is_constant(network, id, wanted))?;
        let (value, unit) = change(network.parameter_value(id));
        let set = format!(
            "{}=\"{} {unit}\"",
            network.parameters()[id.index()].name,
            significant(value, 3)
        );
        let plain = set.replace('"', "");
        netlist.clone().set(&[plain]).is_ok().then_some(set)
    };
    changed(Type::of(Dimension::POWER), |heat| (1.2 * heat, "W"))
        .or_else(|| changed(Type::ABSOLUTE_TEMPERATURE, |kelvin| (kelvin - 273.15 + 5.0, "degC")))
}

/// True if a parameter is a constant of this type that can be changed separately.
/// A heat from which conductances are also made would change the network with it.
fn is_constant(network: &Network, id: ParameterId, wanted: Type) -> bool {
    let parameter = &network.parameters()[id.index()];
    parameter.ty == wanted
        && matches!(parameter.value, Value::Constant(_))
        && !limits(network, id)
        && (wanted.absolute || (network.parameter_value(id) > 0.0 && !shapes(network, id)))
}

/// True if a limit depends on a parameter: another limit does not make another network.
fn limits(network: &Network, id: ParameterId) -> bool {
    let own = network.parameter_slot(id);
    network.limits().iter().any(|limit| limit.value.slots().contains(&own))
}

/// True if other parameters or conductors depend on a parameter.
fn shapes(network: &Network, id: ParameterId) -> bool {
    let own = network.parameter_slot(id);
    let uses = |value: &Value| value.slots().contains(&own);
    let parameters = network.parameters().iter().map(|p| &p.value);
    let conductors = network.conductors().iter().flat_map(|c| c.law.values());
    parameters.chain(conductors).any(uses)
}
