//! The growth of errors of single states, against exponentials.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::balance::Books;
use crate::scripted::bodies;

/// Follows bodies of 100 J/K (0: massless) with 2 W/K to air each.
fn with<T>(
    (network, joined): (&[(f64, &str)], Option<&str>),
    then: impl FnOnce(&mut Errors, &mut Heat<'_>) -> T,
) -> T {
    let system = ThermalSystem::assemble(&bodies(network, joined)).unwrap();
    let mut heat = Heat::new(&system, 0.0, Books::new(system.network(), None))
        .unwrap_or_else(|_| panic!("no heat"));
    let states = system.capacity().len();
    heat.look(0.0, &vec![300.0; states]).unwrap();
    let mut errors = Errors::of(&heat);
    errors.step(&mut heat);
    then(&mut errors, &mut heat)
}

/// Goes on by `length` in s.
fn goes(errors: &mut Errors, heat: &mut Heat<'_>, length: f64, changed: bool) {
    errors.goes_on([&[300.0; 3], &[300.0; 3]], (length, [true, changed]));
    errors.step(heat);
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * expected.abs(), "{found} for {expected}");
}

/// A heat that rises by 3 W/K where 2 W/K are lost: errors grow by `e^(t / 100 s)`, and one whose
/// heat rises by 1 W/K dies as `e^(-t / 100 s)`, but counts from where it is smallest.
#[test]
fn an_error_grows_at_the_rate_of_its_own() {
    with((&[(100.0, "3 [W/K] * (T - absolute(300 [K]))")], None), |errors, heat| {
        assert!(errors.grows);
        near(errors.most(), 1.0);
        goes(errors, heat, 30.0, false);
        near(errors.most(), 0.3_f64.exp());
        goes(errors, heat, 20.0, false);
        near(errors.most(), 0.5_f64.exp());
    });
    with((&[(100.0, "1 [W/K] * (T - absolute(300 [K]))")], None), |errors, heat| {
        goes(errors, heat, 30.0, false);
        near(errors.most(), 1.0);
        assert!(!errors.grows);
    });
}

/// The rate changes linearly between evaluations; after a kink it is that of the last step.
#[test]
fn a_rate_is_the_mean_of_both_ends() {
    // the slope is 2 (T - 300) - 2 W/K
    let network: &[_] = &[(100.0, "1 [W/K^2] * (T - absolute(300 [K]))^2")];
    with((network, None), |errors, heat| {
        heat.look(0.0, &[303.0]).unwrap();
        goes(errors, heat, 50.0, false);
        near(errors.most(), (0.5 * 50.0 * (-0.02 + 0.04_f64)).exp());
        heat.look(0.0, &[300.0]).unwrap();
        errors.goes_on([&[300.0; 2], &[300.0; 2]], (5.0, [true, false]));
        errors.goes_on([&[300.0; 2], &[300.0; 2]], (7.0, [true, true]));
        errors.step(heat);
        let now = (0.5_f64 + 0.5 * 7.0 * 0.02).exp();
        near(errors.most(), now);
        near(errors.now[0], now);
        goes(errors, heat, 1e3, false);
        near(errors.now[0], 1.0);
        near(errors.most(), now);
        assert!(!errors.grows);
    });
}

/// A massless node with 2 W/K to air and a heat that rises by 1.5 W/K, joined by 3 W/K: it follows by
/// 3 / (2 + 3 - 1.5) of the state's error, and gives back 3 W/K of that.
#[test]
fn a_massless_node_magnifies_errors_and_gives_heat_back() {
    let network: &[_] = &[(100.0, "1 [W]"), (0.0, "1.5 [W/K] * (T - absolute(300 [K]))")];
    with((network, Some("3 [W/K]")), |errors, heat| {
        near(errors.most(), 1.0);
        assert!(!errors.grows);
        goes(errors, heat, 10.0, false);
        near(errors.most(), 1.0);
        near(errors.rates[0], (-2.0 - 3.0 + 9.0 / 3.5) / 100.0);
    });
    // by 3 / 0.5, and grows by (18 - 5) W/K
    let network: &[_] = &[(100.0, "1 [W]"), (0.0, "4.5 [W/K] * (T - absolute(300 [K]))")];
    with((network, Some("3 [W/K]")), |errors, heat| {
        near(errors.most(), 6.0);
        assert!(errors.grows);
        goes(errors, heat, 10.0, false);
        near(errors.most(), 6.0 * 1.3_f64.exp());
        // beyond a hundredfold it is about to jump: not reported
        goes(errors, heat, 20.0, false);
        near(errors.most(), 3.9_f64.exp());
    });
}

/// A body whose capacity falls from 100 J/K at 300 K to 50 J/K at 350 K, where it stores 3750 J
/// more: an error of its heat is twice as many kelvin there.
#[test]
fn an_error_of_the_heat_is_larger_in_kelvin_where_the_capacity_has_fallen() {
    let text = "format = 1\n[table]\nfactor = { x = [200, 300, 400], x_unit = \"K\", y = [1, 1, 0.0001], outside = \
                \"hold\" }\n[node]\nbody = { C = \"100 [J/K] * factor(T - absolute(0 [K]))\", T0 = \"absolute(300 [K])\" }\n[boundary]\nair \
                = { T = \"absolute(300 [K])\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", R = \"0.5 K/W\" \
                }\n[run]\nstop = \"1 s\"\n";
    let netlist = lptn_netlist::parse("falls.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let mut heat = Heat::new(&system, 0.0, Books::new(system.network(), None))
        .unwrap_or_else(|_| panic!("no heat"));
    heat.look(0.0, &[300.0]).unwrap();
    let mut errors = Errors::of(&heat);
    errors.step(&mut heat);
    let found = heat.look(0.0, &[337.5]).unwrap()[0];
    assert!((found - 350.0).abs() < 0.01, "{found}");
    goes(&mut errors, &mut heat, 10.0, false);
    let near =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-3, "{found}");
    let grown = 2.0 * (0.5 * 10.0 * (-0.02 - 0.04_f64)).exp();
    near(errors.most(), grown);
    near(errors.rates[0], -0.04);
    // back again the error of the heat has only died
    heat.look(0.0, &[300.0]).unwrap();
    goes(&mut errors, &mut heat, 10.0, false);
    near(errors.now[0], 1.0);
    near(errors.most(), grown);
}

/// Every fourth step is evaluated if something turns, else every sixteenth. Each step is if errors
/// grow, a kink was passed, or, if something turns, a temperature becomes faster by a fiftieth.
#[test]
fn a_step_is_looked_at_if_something_asks_for_it() {
    let asks = |ways: &[f64], turns: bool, changed: bool| -> Vec<bool> {
        with((&[(100.0, "1 [W]")], None), |errors, _| {
            let mut now = 300.0;
            let step = |way: &f64| {
                let before = now;
                now += way;
                errors.goes_on([&[before, 300.0], &[now, 300.0]], (2.0, [turns, changed]))
            };
            ways.iter().map(step).collect()
        })
    };
    let even = [1.0; 16];
    assert_eq!(asks(&even[..5], true, false), [false, false, false, true, true]);
    assert_eq!(asks(&even, false, false), [vec![false; 15], vec![true]].concat());
    assert_eq!(asks(&even[..2], false, true), [true, true]);
    assert_eq!(asks(&[1.0, 1.01, 1.05], true, false), [false, false, true]);
    assert_eq!(asks(&[-1.0, -1.01, -1.05], true, false), [false, false, true]);
    assert_eq!(asks(&[1.0, 0.5, 0.4], true, false), [false; 3]);
    assert_eq!(asks(&[1.0, 1.01, 2.0], false, false), [false; 3]);
    with((&[(100.0, "3 [W/K] * (T - absolute(300 [K]))")], None), |errors, heat| {
        assert!(errors.goes_on([&[300.0; 2], &[300.0; 2]], (2.0, [false; 2])));
        errors.step(heat);
        assert!((errors.elapsed, errors.unseen) == (0.0, 0));
    });
}

/// True if an error of a state may grow at its own rate, or be magnified.
fn may_grow(text: &str) -> bool {
    let netlist = lptn_netlist::parse("grows.toml", text).unwrap_or_else(|r| panic!("{r}"));
    Errors::may_grow(&ThermalSystem::assemble(&netlist.network).unwrap())
}

/// A body with a capacity and a conductance to air, and further sections.
fn body(capacity: &str, conductance: &str, sections: &str) -> String {
    format!(
        "format = 1\n[table]\nfactor = {{ x = [200, 300, 400], x_unit = \"K\", y = [1, 1, 0.5], \
         outside = \"hold\" }}\n[node]\nbody \
         = {{ C = \"{capacity}\", T0 = \"absolute(300 [K])\" }}\n{sections}[boundary]\nair = {{ \
         T = \"absolute(300 [K])\" \
         }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", G = \"{conductance}\" \
         }}\n[run]\nstop = \"1 s\"\n"
    )
}

/// Each by itself excludes that nothing grows: a heat that rises with its own temperature, a
/// massless node that is solved for, a state that is a heat content.
#[test]
fn errors_may_grow_where_the_form_of_the_network_does_not_exclude_it() {
    assert!(!may_grow(&body("1 J/K", "2 W/K", "")));
    let own = "[source]\nq = { into = \"body\", P = \"3 [W/K] * (T - absolute(300 [K]))\" }\n";
    assert!(may_grow(&body("1 J/K", "2 W/K", own)));
    let falls = "1 [J/K] * factor(T - absolute(0 [K]))";
    assert!(may_grow(&body(falls, "2 W/K", "")));
    assert!(may_grow(&body(falls, "2 W/K", own)));
}

/// A massless node with 2 W/K to air and 2.5 W/K from its own heat, joined by 1 W/K: it follows by
/// 1 / (2 + 1 - 2.5) = 2 of the state's error, which dies at 2 + 1 - 2 W/K.
#[test]
fn what_is_magnified_asks_for_looks_though_it_dies() {
    let network: &[_] = &[(100.0, "1 [W]"), (0.0, "2.5 [W/K] * (T - absolute(300 [K]))")];
    with((network, Some("1 [W/K]")), |errors, heat| {
        near(errors.most(), 2.0);
        near(errors.rates[0], -0.01);
        assert!(errors.grows);
        goes(errors, heat, 10.0, false);
        near(errors.most(), 2.0);
    });
    // an error that neither grows nor dies asks for none
    let network: &[_] = &[(100.0, "2 [W/K] * (T - absolute(300 [K]))")];
    with((network, None), |errors, _| assert!(errors.rates[0] == 0.0 && !errors.grows));
}

/// The speed of a temperature counts, and not its change: here steps of many lengths at 0.5 K/s.
#[test]
fn a_longer_step_at_the_same_speed_is_not_faster() {
    with((&[(100.0, "1 [W]")], None), |errors, _| {
        let mut now = 300.0;
        let asked = [2.0, 4.0, 8.0].map(|length| {
            let before = now;
            now += 0.5 * length;
            errors.goes_on([&[before, 300.0], &[now, 300.0]], (length, [true, false]))
        });
        assert_eq!(asked, [false; 3]);
        let shorter = errors.goes_on([&[now, 300.0], &[now + 0.9, 300.0]], (1.0, [true, false]));
        assert!(shorter, "0.9 K/s");
    });
    with((&[(100.0, "1 [W]")], None), |errors, _| {
        errors.goes_on([&[300.0; 2], &[301.0, 300.0]], (4.0, [true, false]));
        assert!(errors.goes_on([&[301.0, 300.0], &[301.6, 300.0]], (2.0, [true, false])));
    });
}

/// Steps without an evaluation are one: of 5 and 7 s at -0.02 and 0.04 1/s.
#[test]
fn steps_that_were_not_looked_at_are_taken_together() {
    let network: &[_] = &[(100.0, "1 [W/K^2] * (T - absolute(300 [K]))^2")];
    with((network, None), |errors, heat| {
        for length in [5.0, 7.0] {
            errors.goes_on([&[300.0; 2], &[300.0; 2]], (length, [true, false]));
        }
        heat.look(0.0, &[303.0]).unwrap();
        errors.step(heat);
        near(errors.most(), (0.5 * 12.0 * (-0.02 + 0.04_f64)).exp());
    });
}
