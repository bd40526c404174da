//! Integrals, which no rate reads: steady or not.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_solve::{SteadyError, SteadyState};

use crate::own_states::{near, network};

/// The heat lost so far: 10 W for ever with the heater; without it 100 J/K x 10 K less what is left,
/// which the way decides. The rest of the network is solved without it.
#[test]
fn an_integral_that_nothing_reads_is_never_steady() {
    let text = |power: &str| {
        format!(
            "format = 1\n[node]\na = {{ C = \"100 J/K\", T0 = \"30 degC\" }}\n[boundary]\nair = {{ T = \
             \"20 degC\" }}\n[resistor]\nr = {{ from = \"a\", to = \"air\", R = \"1 K/W\" }}\n[source]\n\
             h = {{ into = \"a\", P = \"{power}\" }}\n[state]\ne = {{ rate = \"1 [W/K] * (a.T - \
             air.T)\", start = \"0 J\", size = \"1 J\" }}\n"
        )
    };
    let error = |power: &str| {
        let system = ThermalSystem::assemble(&network(&text(power))).unwrap();
        SteadyState::solve(&system, 0.0).unwrap_err()
    };
    match error("10 W") {
        SteadyError::Drifts { name, rate, unit } => {
            assert_eq!((name.as_str(), unit.as_str()), ("e", "J"));
            near(rate, 10.0, 1e-8);
        }
        other => panic!("{other}"),
    }
    let error = error("0 W").to_string();
    assert!(error.contains("the way to the steady state"), "{error}");
}
