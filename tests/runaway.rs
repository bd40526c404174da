//! Two steady states or none: heat that grows exponentially with temperature, against its closed
//! form.
//!
//! P = P0 exp(b (T - T0)) through R: with theta = b (T - T0) the balance is theta exp(-theta) =
//! b R P0 (N. N. Semenov 1928; D. A. Frank-Kamenetskii). It has two solutions, -W(-b R P0) on the
//! two branches of Lambert's function, where e b R P0 < 1, and none where e b R P0 > 1; the lower
//! is stable, and from theta = ln(1 / (b R P0)) on heat grows faster than it is carried off. The
//! numbers are from mpmath 1.3 with 25 digits.

use lptn::prelude::*;
use lptn_solve::{Others, SteadyError, StopReason, TransientError};

/// T0 = 20 degC, b = 0.02 /K and R = 0.8 K/W, so that e b R P0 = 1 at 22.99246507 W. `parts` is the
/// rest of the network between `core` and `air`.
fn netlist(power: f64, start: f64, parts: &str) -> String {
    format!(
        "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n[node]\ncore = {{ C = \"100 J/K\", T0 \
         = \"{start} degC\" }}\n[source]\nleak = {{ into = \"core\", P = \"{power} [W] * exp(0.02 \
         [1/K] * (T - 20 [degC]))\" }}\n{parts}"
    )
}

const ONE: &str = "[resistor]\nskin = { from = \"core\", to = \"air\", R = \"0.8 K/W\" }\n";

/// The same resistance in two parts with a node between them.
const TWO: &str = "[node.shell]\nC = \"50 J/K\"\nT0 = \"20 degC\"\n[resistor]\ninner = { from = \
    \"core\", to = \"shell\", R = \"0.3 K/W\" }\nouter = { from = \"shell\", to = \"air\", R = \"0.5 \
    K/W\" }\n";

fn system(text: &str) -> ThermalSystem {
    let network = lptn::parse("runaway.toml", text).expect("a netlist").network;
    ThermalSystem::assemble(&network).expect("it assembles")
}

fn solve(power: f64, start: f64, parts: &str) -> Result<SteadyState, SteadyError> {
    SteadyState::solve(&system(&netlist(power, start, parts)), 0.0)
}

fn near(found: f64, celsius: f64, what: &str) {
    assert!((found - 273.15 - celsius).abs() < 1e-6, "{what}: {} degC", found - 273.15);
}

#[test]
fn below_the_critical_heat_both_states_are_told() {
    for (power, lower, upper) in [
        (5.0, 24.364_886_043_079, 214.105_329_242_342),
        (20.0, 48.024_474_153_922_8, 101.242_472_308_13),
        (22.0, 56.579_626_449_718_5, 86.359_100_162_091_3),
        (22.9, 65.644_626_487_866_8, 74.623_992_537_655_5),
    ] {
        for parts in [ONE, TWO] {
            let steady = solve(power, 20.0, parts).expect("a steady state");
            near(steady.temperatures[0], lower, "the lower");
            let Others::Unstable(other) = &steady.others else { panic!("{:?}", steady.others) };
            near(other[0], upper, "the upper");
        }
    }
}

#[test]
fn above_it_there_is_none_and_the_source_is_named() {
    for (power, critical) in
        [(23.0, 69.983_617_040_660_3), (24.0, 67.855_636_319_720_5), (40.0, 42.314_355_131_421)]
    {
        for parts in [ONE, TWO] {
            let Err(SteadyError::Runaway { node, source, from, rests: None }) =
                solve(power, 20.0, parts)
            else {
                panic!("{power} W has a steady state")
            };
            assert_eq!((node.as_str(), source.as_str()), ("core", "leak"));
            near(from, critical, "from where it runs away");
        }
    }
}

#[test]
fn heat_in_two_sources_runs_away_as_one_does() {
    let half = netlist(20.0, 20.0, ONE).replace("20 [W]", "12 [W]");
    let other = "also = { into = \"core\", P = \"12 [W] * exp(0.02 [1/K] * (T - 20 [degC]))\" }\n";
    let text = half.replace("[resistor]", &format!("{other}[resistor]"));
    let found = SteadyState::solve(&system(&text), 0.0);
    let Err(SteadyError::Runaway { from, .. }) = found else { panic!("{found:?}") };
    near(from, 67.855_636_319_720_5, "from where they run away together");
}

/// Above the upper state a network runs away though it has a state to rest at.
#[test]
fn a_start_beyond_the_upper_state_runs_away() {
    for (start, runs) in [(100.0, false), (103.0, true), (200.0, true)] {
        match (solve(20.0, start, ONE), runs) {
            (Ok(steady), false) => near(steady.temperatures[0], 48.024_474_153_922_8, "rests"),
            (Err(SteadyError::Runaway { rests: Some(at), .. }), true) => {
                near(at, 48.024_474_153_922_8, "would rest");
            }
            (found, _) => panic!("{start} degC: {found:?}"),
        }
    }
}

#[test]
fn a_run_that_becomes_hotter_for_ever_says_so() {
    for (power, start) in [(24.0, 20.0), (40.0, 20.0), (20.0, 200.0), (400.0, 20.0)] {
        let run = Transient::until(Time(7200.0)).solve(&system(&netlist(power, start, ONE)));
        let Err(TransientError::Stopped {
            reason: StopReason::Runaway { node, source, .. }, ..
        }) = run
        else {
            panic!("{power} W from {start} degC does not run away: {run:?}")
        };
        assert_eq!((node.as_str(), source.as_str()), ("core", "leak"));
    }
}

/// Straight heat of more slope than the path: it grows without a step that fails.
#[test]
fn heat_that_grows_straight_has_no_steady_state_either() {
    let text = netlist(1.0, 21.0, ONE)
        .replace("exp(0.02 [1/K] * (T - 20 [degC]))", "(1 + 2 [1/K] * (T - 20 [degC]))");
    let found = SteadyState::solve(&system(&text), 0.0);
    assert!(matches!(found, Err(SteadyError::Runaway { .. })), "{found:?}");
    // 1 W/K where the path carries 1.25 W/K: (T - 20)/0.8 = 1 + (T - 20)
    let text = text.replace("2 [1/K]", "1 [1/K]");
    let steady = SteadyState::solve(&system(&text), 0.0).expect("a steady state");
    near(steady.temperatures[0], 24.0, "straight");
    assert_eq!(steady.others, Others::None);
}

/// A hump: the network may rest below it or above it, whichever the start.
#[test]
fn the_other_side_of_a_hump_is_found_from_either() {
    let hump = |start: f64| {
        netlist(1.0, start, ONE).replace(
            "1 [W] * exp(0.02 [1/K] * (T - 20 [degC]))",
            "100 [W] * 0.5 * (1 + tanh((T - 60 [degC]) / 2 [K]))",
        )
    };
    for (start, own, other) in [(20.0, 20.0, 100.0), (300.0, 100.0, 20.0)] {
        let steady = SteadyState::solve(&system(&hump(start)), 0.0).expect("a steady state");
        near(steady.temperatures[0], own, "its own");
        let Others::At(found) = &steady.others else { panic!("{:?}", steady.others) };
        near(found[0], other, "the other");
    }
}

/// If the form excludes a second state, lptn does not search for one.
#[test]
fn thinning_and_linear_networks_have_one() {
    let falling = netlist(40.0, 20.0, ONE).replace("exp(0.02", "exp(-0.02");
    let constant = netlist(40.0, 20.0, TWO).replace("exp(0.02", "exp(0.00");
    for text in [falling, constant] {
        let steady = SteadyState::solve(&system(&text), 0.0).expect("a steady state");
        assert_eq!(steady.others, Others::None);
    }
}
