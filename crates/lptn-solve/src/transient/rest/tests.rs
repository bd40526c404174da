//! Steady states of networks, and that they are not followed further than that.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::*;
use crate::scripted::bodies;

/// The temperatures in which a network rests, if it does.
fn rests(heats: &[(f64, &str)]) -> Option<Vec<f64>> {
    let system = ThermalSystem::assemble(&bodies(heats, None)).unwrap();
    match rest(&system, 0.0, ROUGH) {
        Way::Rests(rest) => Some(rest.temperatures),
        _ => None,
    }
}

/// A body with 2 W/K to air that 20 W heat, less by 0.1 W/K^2: `20 - 2 x - 0.1 x^2 = 0` at `x =
/// sqrt(300) - 10`. It is left as soon as a correction by Newton's method is less than a thousandth
/// of a kelvin.
#[test]
fn a_network_is_followed_until_it_is_a_thousandth_of_a_kelvin_from_rest() {
    let heat = "20 [W] - 0.1 [W/K^2] * (T - absolute(300 [K]))^2";
    let off = rests(&[(100.0, heat)]).unwrap()[0] - 290.0 - 300_f64.sqrt();
    assert!(off.abs() <= 1e-3 && off.abs() > 1e-9, "{off:e}");
}

/// From there it moves on, though slowly: an unstable state is not a rest.
#[test]
fn what_moves_away_slowly_does_not_rest_where_it_is() {
    // grows from 0.01 K by 1 W/K up to a balance with 0.1 W/K^2, at 10 K
    let heat =
        "0.01 [W] + 3 [W/K] * (T - absolute(300 [K])) - 0.1 [W/K^2] * (T - absolute(300 [K]))^2";
    let found = rests(&[(100.0, heat)]).unwrap()[0];
    let exact = 5.0 + 25.1_f64.sqrt();
    assert!((found - 300.0 - exact).abs() < 1e-2, "{found} {exact}");
}

#[test]
fn what_runs_away_does_not_rest() {
    let heat = "1 [W] + 3 [W/K] * (T - absolute(300 [K]))";
    assert!(rests(&[(100.0, heat)]).is_none());
}

/// Near 305 K two steady states have met and gone: 1e-8 W are left over there, by which the body
/// creeps through in some months. It rests at 320 K.
#[test]
fn what_creeps_past_the_end_of_two_states_does_not_rest_there() {
    let rise = "(T - absolute(300 [K])) / 1 [K]";
    let heat =
        format!("2 [W] * {rise} + (0.1 [W] * ({rise} - 5)^2 + 1e-8 [W]) * (1 - {rise} / 20)");
    let found = rests(&[(100.0, &heat)]).unwrap()[0];
    assert!((found - 320.0).abs() < 1e-2, "{found}");
}
