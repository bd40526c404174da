//! Turns of expressions on a straight time history.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use super::*;
use crate::balance::Books;
use crate::heat::Heat;
use crate::scripted::bodies;

/// A bell of 2 K about 340 K: its top is found to some tenths of a kelvin.
const BELL: &str = "1 [W] * exp(-((T - absolute(340 [K])) / 2 [K])^2)";

/// A bell over two temperatures.
const BOTH: &str = "1 [W] * exp(-((T + (n1.T - absolute(300 [K])) - absolute(340 [K])) / 2 [K])^2)";

/// The turns of a network of two bodies of 100 J/K, with the inputs they read.
fn with<T>(heats: [&str; 2], then: impl FnOnce(&mut Turns, &Evaluation) -> T) -> T {
    let network = bodies(&heats.map(|heat| (100.0, heat)), None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut heat = Heat::new(&system, 0.0, Books::new(system.network(), None))
        .unwrap_or_else(|_| panic!("no heat"));
    heat.look(0.0, &[300.0, 300.0]).unwrap();
    then(&mut Turns::of(&system), heat.scope())
}

/// The longest next step in s if the first body goes on from a temperature in K at a rate in K/s.
fn longest(heat: &str, (from, rate): (f64, f64), last: f64) -> (f64, bool) {
    with([heat, "1 [W]"], |turns, scope| {
        let course = Course { now: &[from, 300.0, 300.0], rates: &[rate, 0.0, 0.0], last };
        let longest = turns.longest(course, scope);
        (longest, turns.were_narrow())
    })
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

#[test]
fn a_step_ends_where_something_turns() {
    for (from, rate) in [(300.0, 2.0), (330.0, 0.5), (380.0, -2.0), (350.0, -0.1)] {
        let (found, narrow) = longest(BELL, (from, rate), 0.0);
        near(found, (340.0 - from) / rate, 0.3 / rate.abs());
        assert!(!narrow);
    }
    // after it: to the end of the searched range, 0.3 of a temperature or 100 K away
    near(longest(BELL, (350.0, 2.0), 0.0).0, 52.5, 1e-9);
    near(longest(BELL, (330.0, -2.0), 0.0).0, 50.0, 1e-9);
    near(longest(BELL, (2000.0, 2.0), 0.0).0, 300.0, 1e-9);
    assert_eq!(longest(BELL, (300.0, 0.0), 0.0), (f64::INFINITY, false));
    assert_eq!(longest("1 [W]", (300.0, 1.0), 0.0), (f64::INFINITY, false));
}

/// A turn that a step as long as the last one would have passed whole, with both sides, is narrow.
#[test]
fn what_the_last_step_would_have_passed_whole_is_narrow() {
    let narrow = |last: f64| longest(BELL, (330.0, 2.0), last).1;
    assert_eq!([4.5, 5.5].map(narrow), [false, true]);
    let falling = |last: f64| longest(BELL, (350.0, -2.0), last).1;
    assert_eq!([4.5, 5.5].map(falling), [false, true]);
    // the end of the searched range is not a turn
    assert!(!longest(BELL, (350.0, 2.0), 1e3).1);
}

/// The search is repeated when a number comes near to the end of the searched range.
#[test]
fn turns_are_looked_for_around_a_temperature_once() {
    with([BELL, "1 [W]"], |turns, scope| {
        let network = turns.network.clone();
        let family = &mut turns.families[0];
        let mut after = |number: f64| {
            family.reach(&network, scope, number);
            (family.range, family.turns.len())
        };
        assert_eq!(after(300.0), ([200.0, 400.0], 1));
        assert_eq!(after(388.0), ([200.0, 400.0], 1));
        assert_eq!(after(211.0), ([200.0, 400.0], 1));
        assert_eq!(after(f64::NAN), ([200.0, 400.0], 1));
        assert_eq!(after(f64::INFINITY), ([200.0, 400.0], 1));
        assert_eq!(after(389.0).0.map(f64::round), [272.0, 506.0]);
        assert_eq!(after(280.0), ([180.0, 380.0], 1));
        assert_eq!(after(185.0), ([85.0, 285.0], 0));
        let [low, high] = after(-1000.0).0;
        near(low, -1300.0, 1e-9);
        near(high, -700.0, 1e-9);
    });
}

#[test]
fn the_next_turn_is_the_nearest_ahead() {
    with([BELL, "1 [W]"], |turns, _| {
        let family = &mut turns.families[0];
        family.range = [200.0, 400.0];
        family.turns = vec![[250.0, 251.0], [300.0, 302.0], [350.0, 353.0]];
        let up = |number: f64| family.next(number, true);
        assert_eq!(up(260.0), [300.0, 302.0]);
        assert_eq!(up(300.0), [350.0, 353.0]);
        assert_eq!(up(301.0), [350.0, 353.0]);
        assert_eq!(up(360.0), [400.0; 2]);
        let down = |number: f64| family.next(number, false);
        assert_eq!(down(310.0), [300.0, 302.0]);
        assert_eq!(down(302.0), [250.0, 251.0]);
        assert_eq!(down(301.0), [250.0, 251.0]);
        assert_eq!(down(240.0), [200.0; 2]);
    });
}

/// The share of a step after which a turn was reached that it went past whole.
#[test]
fn a_step_that_went_past_a_turn_is_told_the_share_before_it() {
    with([BELL, BELL], |turns, _| {
        for family in &mut turns.families {
            family.turns = vec![[310.0, 312.0], [350.0, 354.0]];
        }
        let passed = |from: f64, to: f64| turns.passed([&[from, 300.0, 0.0], &[to, 300.0, 0.0]]);
        assert_eq!(passed(301.0, 321.0), Some(0.5));
        assert_eq!(passed(301.0, 401.0), Some(0.1));
        assert_eq!(passed(321.0, 301.0), Some(0.5));
        assert_eq!(passed(362.0, 342.0), Some(0.5));
        // going down the first that comes is the warmer one
        assert_eq!(passed(402.0, 302.0), Some(0.5));
        for (from, to) in
            [(301.0, 311.0), (310.0, 320.0), (301.0, 312.0), (312.0, 340.0), (320.0, 345.0)]
        {
            assert_eq!(passed(from, to), None, "{from} {to}");
        }
        let both = turns.passed([&[301.0, 306.0, 0.0], &[321.0, 316.0, 0.0]]);
        assert_eq!(both, Some(0.5));
        let both = turns.passed([&[301.0, 309.0, 0.0], &[321.0, 329.0, 0.0]]);
        assert_eq!(both, Some(0.1));
    });
}

/// Readers of one separate number, of several, and of numbers that do not change.
#[test]
fn readers_are_told_apart() {
    let counts = |heats| {
        with(heats, |turns, _| {
            (turns.single.len(), turns.families.len(), turns.several.len(), turns.are_none())
        })
    };
    assert_eq!(counts(["1 [W]", "2 [W]"]), (0, 0, 0, true));
    assert_eq!(counts([BELL, "2 [W]"]), (1, 1, 0, false));
    assert_eq!(counts([BOTH, "2 [W]"]), (0, 0, 1, false));
    assert_eq!(counts([BOTH, BELL]).2, 1);
    let given = "1 [W] * exp(-((air.T - absolute(340 [K])) / 2 [K])^2)";
    assert_eq!(counts([given, "2 [W]"]), (0, 0, 0, true));
}

/// With several temperatures: twice the last step at most, and not past a turn ahead of it, to a
/// half more.
#[test]
fn a_turn_of_several_temperatures_is_looked_for_ahead() {
    let of = |now: [f64; 2], rates: [f64; 2], last: f64| {
        with([BOTH, "1 [W]"], |turns, scope| {
            let (now, rates) = ([now[0], now[1], 300.0], [rates[0], rates[1], 0.0]);
            let found = turns.longest(Course { now: &now, rates: &rates, last }, scope);
            (found, turns.were_narrow())
        })
    };
    // nothing near
    near(of([300.0, 300.0], [1.0, 1.0], 3.0).0, 6.0, 1e-9);
    near(of([300.0, 300.0], [1.0, -1.0], 3.0).0, 6.0, 1e-9);
    // 5 K in the first step
    near(of([300.0, 300.0], [0.5, -0.25], 0.0).0, 10.0, 1e-9);
    near(of([300.0, 300.0], [0.1, -0.25], 0.0).0, 20.0, 1e-9);
    // the bell is 40 K away in the sum, both rise by 1 K/s
    for (last, narrow) in [(11.0, false), (15.0, false), (19.0, false), (21.0, true)] {
        let (found, was) = of([300.0, 300.0], [1.0, 1.0], last);
        near(found, 20.0, 0.2);
        assert_eq!(was, narrow, "{last}");
    }
    // the search covers 27 s, and 18 s are the longest
    near(of([300.0, 300.0], [1.0, 1.0], 9.0).0, 18.0, 1e-9);
    near(of([301.0, 300.0], [1.0, 1.0], 6.0).0, 12.0, 1e-9);
    // a temperature that changes by less than 0.01 K passes nothing
    near(of([300.0, 300.0], [1e-4, 2e-4], 10.0).0, 50.0, 1e-9);
    near(of([300.0, 300.0], [1e-4, 2e-4], 40.0).0, 80.0, 1e-9);
    assert_eq!(of([300.0, 300.0], [0.0, 0.0], 10.0).0, f64::INFINITY);
    assert_eq!(of([300.0, 300.0], [0.0, 0.0], 0.0).0, f64::INFINITY);
    // and right at a turn a step still moves by that
    let (found, _) = of([320.0, 319.8], [1.0, 1.0], 5.0);
    assert!((0.01..0.3).contains(&found), "{found}");
}

/// A bell of 1 mK over the sum of both temperatures.
const NARROW_BOTH: &str =
    "1 [W] * exp(-((T + (n1.T - absolute(300 [K])) - absolute(340 [K])) / 0.01 [K])^2)";

/// A narrow turn of several temperatures is found to a thousandth of a kelvin, not to a share of
/// the way.
#[test]
fn a_narrow_turn_of_several_temperatures_is_found_where_it_is() {
    with([NARROW_BOTH, "1 [W]"], |turns, scope| {
        for rate in [1.0, 0.25, 4.0] {
            let rates = [rate, rate, 0.0];
            let course = Course { now: &[305.0, 305.0, 300.0], rates: &rates, last: 12.0 / rate };
            near(turns.longest(course, scope), 15.0 / rate, 5e-3 / rate);
        }
    });
}

/// A thousandth of a kelvin before a turn the fastest temperature moves by a hundredth of a kelvin.
#[test]
fn right_at_a_turn_a_step_moves_by_a_hundredth_of_a_kelvin() {
    with([NARROW_BOTH, "1 [W]"], |turns, scope| {
        for rate in [1.0, 4.0] {
            let rates = [rate, rate, 0.0];
            let course = Course { now: &[320.0, 319.999, 300.0], rates: &rates, last: 5.0 };
            near(turns.longest(course, scope), 0.01 / rate, 1e-12);
        }
    });
}

/// A bell of 5 mK is bracketed to far less than a share of the searched range.
#[test]
fn a_narrow_turn_of_one_temperature_is_bracketed_closely() {
    let bell = "1 [W] * exp(-((T - absolute(340 [K])) / 0.005 [K])^2)";
    with([bell, "1 [W]"], |turns, scope| {
        let network = turns.network.clone();
        for number in [300.0, 350.0] {
            let family = &mut turns.families[0];
            family.range = [f64::NAN; 2];
            family.reach(&network, scope, number);
            assert_eq!(family.turns.len(), 1);
            let [from, to] = family.turns[0];
            assert!(from <= 340.0 && to >= 340.0 && to - from < 0.05, "{from} {to}");
        }
    });
}
