//! `Network::with`: other parameters without parsing, the same network as if they had been written.

use crate::support;

use lptn::prelude::*;
use support::{networks, shipped};

#[test]
fn another_speed_gives_the_power_law_of_that_speed() {
    let (netlist, _) = shipped("gearbox_speed.toml");
    let mut parameters = netlist.network.overrides();
    parameters.set_text("omega", "5000 rpm").unwrap();
    let network = netlist.network.with(&parameters).unwrap();
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    // validation case "gearbox_speed_sweep": closed form at 5000 rpm
    assert!((steady.source_heat[0] - 127.194_771_612_259_76).abs() < 1e-9);
    assert!((steady.temperatures[0] - 298.65 - 38.746_808_952_963_67).abs() < 1e-9);
}

#[test]
fn with_equals_writing_the_value_into_the_file() {
    let text = std::fs::read_to_string(networks().join("gearbox.toml")).unwrap();
    let written = lptn::parse("written", &text.replace("220.6 [W] / 65.5 [K]", "3 W/K")).unwrap();
    let (netlist, _) = shipped("gearbox.toml");
    let mut parameters = netlist.network.overrides();
    parameters.set_text("G_out", "3 W/K").unwrap();
    let changed = netlist.network.with(&parameters).unwrap();
    for id in changed.conductor_ids() {
        let conductance = |network: &Network| network.conductance(id).unwrap();
        let (a, b) = (conductance(&changed), conductance(&written.network));
        assert_eq!(a.to_bits(), b.to_bits());
    }
}

#[test]
fn a_value_that_breaks_an_element_is_refused_by_name() {
    let (netlist, _) = shipped("gearbox.toml");
    let mut parameters = netlist.network.overrides();
    parameters.set_text("G_out", "-1 W/K").unwrap();
    let errors = netlist.network.with(&parameters).unwrap_err();
    let codes: Vec<&str> = errors.0.iter().map(|e| e.code()).collect();
    assert_eq!(codes, ["network::not_positive"; 2]);
    assert!(errors.to_string().contains("`G` of path `mill_bed`"), "{errors}");
}

#[test]
fn a_wrong_unit_and_an_unknown_name_are_refused() {
    let (netlist, _) = shipped("gearbox_speed.toml");
    let mut parameters = netlist.network.overrides();
    let hertz = parameters.set_text("omega", "50 Hz").unwrap_err();
    assert!(hertz.to_string().contains("omega"), "{hertz}");
    let unknown = parameters.set_text("omga", "1 rpm").unwrap_err();
    assert!(unknown.to_string().contains("did you mean `omega`?"), "{unknown}");
}
