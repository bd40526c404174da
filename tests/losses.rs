//! Losses in a network: thinning oil against its closed form, books, and what results say of
//! unverified constants.

use lptn::prelude::*;

/// b in 1/K, R in K/W, and the rise at 7000 rpm in K.
const THINNING: f64 = 0.017;
const RESISTANCE: f64 = 0.42;
const RISE: f64 = 58.8;

/// A bearing whose oil thins by exp(-b dT), with f0 such that it comes to the rise at 7000 rpm.
fn thinning(rpm: f64) -> String {
    let omega = 7000.0 * std::f64::consts::PI / 30.0;
    let heat = RISE / RESISTANCE;
    let cold = 1e-10 * (100.0 * 7000.0_f64).powf(2.0 / 3.0) * 60f64.powi(3) * omega;
    let f0 = heat / (cold * (-2.0 / 3.0 * THINNING * RISE).exp());
    format!(
        "format = 1\n[param]\nomega = \"{rpm} rpm\"\n[node]\nbox = {{ C = \"1 kJ/K\", T0 = \"20 \
         degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"box\", \
         to = \"air\", R = \"{RESISTANCE} K/W\" }}\n[bearing]\nspin = {{ into = \"box\", speed = \
         \"omega\", d_m = \"60 mm\", f0 = {f0}, nu = \"100 [mm^2/s] * exp(-{THINNING} [1/K] * (T - 20 \
         [degC]))\", model = \"no_load\" }}\n"
    )
}

fn steady(text: &str) -> (Network, SteadyState) {
    let network = lptn::parse("losses.toml", text).expect("a netlist").network;
    let system = ThermalSystem::assemble(&network).expect("it assembles");
    let steady = SteadyState::solve(&system, 0.0).expect("a steady state");
    (network, steady)
}

fn heat(rpm: f64) -> f64 {
    steady(&thinning(rpm)).1.source_heat[0]
}

#[test]
fn thinning_oil_bends_the_exponent_as_its_closed_form_says() {
    assert!((heat(7000.0) * RESISTANCE - RISE).abs() < 1e-6);
    for (rpm, rounded) in [(1000.0, 1.59), (3000.0, 1.34), (7000.0, 1.00)] {
        let exponent = (heat(rpm * 1.001) / heat(rpm / 1.001)).ln() / (2.0 * 1.001_f64.ln());
        let rise = RESISTANCE * heat(rpm);
        let closed = 5.0 / 3.0 / (1.0 + 2.0 / 3.0 * THINNING * rise);
        assert!((exponent - closed).abs() < 1e-5, "{rpm} rpm: {exponent} is not {closed}");
        assert!((exponent - rounded).abs() < 5e-3, "{rpm} rpm: {exponent} is not {rounded}");
    }
}

/// The recipe of `docs/losses.md`.
fn recipe() -> String {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/netlists/gear_unit.toml");
    std::fs::read_to_string(file).expect("a netlist")
}

#[test]
fn what_the_shaft_loses_is_what_the_nodes_receive() {
    let (network, steady) = steady(&recipe());
    let lost: f64 = steady.source_heat.iter().sum();
    assert!((lost + steady.boundary_heat.iter().sum::<f64>()).abs() < 1e-9 * lost);
    // and over a run, with every loss on
    let system = ThermalSystem::assemble(&network).expect("it assembles");
    let run = Transient::until(Time(7200.0)).solve(&system).expect("it runs");
    assert!(run.ledger().closes(), "{:?}", run.ledger());
    let found: Vec<_> =
        network.unverified().into_iter().map(|item| network.name_of(item)).collect();
    assert_eq!(found, ["web"]);
}

#[test]
fn losses_are_the_same_in_both_directions_and_nothing_at_rest() {
    let at = |speed: &str| {
        let text = recipe().replace("omega = \"3000 rpm\"", &format!("omega = \"{speed}\""));
        let network = lptn::parse("losses.toml", &text).expect("a netlist").network;
        let mut scope = network.evaluation();
        let temperatures = vec![330.0; network.nodes().len() + network.boundaries().len()];
        let of = |id| network.source_heat(id, &mut scope, &temperatures);
        network.source_ids().map(of).collect::<Result<Vec<f64>, _>>().expect("heats")
    };
    assert_eq!(at("3000 rpm"), at("-3000 rpm"));
    assert!(at("3000 rpm").iter().all(|heat| *heat > 0.0));
    assert!(at("0 rpm").iter().all(|heat| heat.abs() < 1e-300));
}

#[test]
fn lubricants_of_the_library_have_the_viscosities_of_their_grades() {
    // ISO 3448 at 40 degC, and ASTM D2270 with the index 95 at 100 degC
    for (grade, hot) in [("32", 5.2895), ("100", 11.0657), ("220", 18.7501), ("460", 30.3500)] {
        let text = format!(
            "format = 1\n[param]\ncold = \"iso_vg_{grade}.nu(40 [degC]) / 1 [mm^2/s]\"\nhot = \
             \"iso_vg_{grade}.nu(100 [degC]) / 1 [mm^2/s]\"\nheavy = \"iso_vg_{grade}.density(15 \
             [degC]) / 1 [kg/m^3]\"\n[node]\nbox = {{ C = \"1 kJ/K\", T0 = \"20 degC\" \
             }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"box\", to = \
             \"air\", R = \"0 [K/W] * (cold + hot + heavy) + 1 [K/W]\" }}\n"
        );
        let network = lptn::parse("oils.toml", &text).expect("a netlist").network;
        let value = |name: &str| network.parameter_value(network.parameter(name).expect("it is"));
        let nominal: f64 = grade.parse().expect("a number");
        assert!((value("cold") / nominal - 1.0).abs() < 1e-12, "{grade}: {}", value("cold"));
        assert!((value("hot") - hot).abs() < 1e-4, "{grade}: {}", value("hot"));
        assert!((value("heavy") - 902.0).abs() < 1e-9);
    }
}
