//! Signals over time: what they are between, at, before and after their points, and where a run has
//! to stop for them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{all_near, cooled, near, power, time};
use lptn_network::{AfterEnd, Course, InputProblem, Item, Network, NetworkBuilder, SignalId};
use lptn_units::{Degree, Dimension, Interpolation, Outside, Table1, Type};

const POWER: Type = Type::of(Dimension::POWER);

fn curve(times: &[f64], values: &[f64], interpolation: Interpolation, after: AfterEnd) -> Course {
    let points =
        Table1::new(times.to_vec(), values.to_vec(), interpolation, Outside::Error).unwrap();
    Course::Curve { points, after }
}

fn steps(times: &[f64], values: &[f64], after: AfterEnd) -> Course {
    Course::Steps { times: times.to_vec(), values: values.to_vec(), after }
}

/// A network whose source `p` is the signal `s`.
fn network(course: Course) -> (Network, SignalId) {
    let (mut b, a, _) = cooled();
    let id = b.signal("s", POWER, course);
    let p = time(&b, "s");
    b.source("p", a, p);
    (b.build().unwrap(), id)
}

/// The heat of `p` at a time; comparisons and steps as they stand at `segment`.
fn value(network: &Network, at: f64, segment: f64) -> Result<f64, InputProblem> {
    let mut scope = network.evaluation();
    scope.set_time(at, segment);
    let mut out = [f64::NAN];
    network.source_powers(&mut scope, &mut out).map_err(|error| {
        assert!(matches!(error.item, Item::Signal(_)) && error.name == "s", "{error}");
        error.problem
    })?;
    Ok(out[0])
}

fn seen(network: &Network, times: &[f64]) -> Vec<f64> {
    times.iter().map(|t| value(network, *t, *t).unwrap()).collect()
}

#[test]
fn straight_lines() {
    let (network, id) =
        network(curve(&[1.0, 3.0, 7.0], &[10.0, 20.0, 0.0], Interpolation::Linear, AfterEnd::Hold));
    all_near(
        &seen(&network, &[1.0, 2.0, 3.0, 4.0, 7.0, 9.0, 1e6]),
        &[10.0, 15.0, 20.0, 15.0, 0.0, 0.0, 0.0],
    );
    let before = value(&network, 0.5, 0.5).unwrap_err();
    assert!(
        matches!(before, InputProblem::BeforeSignal { time, first } if (time, first) == (0.5, 1.0))
    );
    assert!(value(&network, 1.0 - 1e-10, 1.0).is_ok(), "rounding does not carry it past its end");
    all_near(&network.breakpoints(0.0 + 1.0, 10.0).unwrap(), &[3.0, 7.0]);
    all_near(&network.breakpoints(3.5, 7.0).unwrap(), &[]);
    let mut scope = network.evaluation();
    scope.set_time(4.0, 4.0);
    near(scope.signal(id), 15.0);
    assert_eq!(network.signals()[id.index()].course.span(), (1.0, 7.0));
    assert!(network.has_time_dependent_inputs());
    assert_eq!(network.curves().len(), 0);
}

/// Rounding may carry a time past an end: by 1e-9 of the length of the signal, or by 1e-12 of its
/// times where these are large, and no further.
#[test]
fn a_time_may_be_past_an_end_by_rounding_only() {
    for (first, last, margin) in
        [(0.0, 1000.0, 1e-6), (1e6, 1e6 + 1.0, 1e-6), (-1e6, -1e6 + 1.0, 1e-6), (-2e6, 8.0, 2e-3)]
    {
        let (network, _) =
            network(curve(&[first, last], &[10.0, 20.0], Interpolation::Linear, AfterEnd::Error));
        let at = |time: f64| value(&network, time, time);
        near(at(first - 0.5 * margin).unwrap(), 10.0);
        near(at(last + 0.5 * margin).unwrap(), 20.0);
        assert!(
            matches!(at(first - 2.0 * margin), Err(InputProblem::BeforeSignal { .. })),
            "{first} {last}"
        );
        assert!(
            matches!(at(last + 2.0 * margin), Err(InputProblem::AfterSignal { .. })),
            "{first} {last}"
        );
    }
}

#[test]
fn the_end_of_a_signal_that_says_no_more_is_an_error() {
    let (network, _) =
        network(curve(&[1.0, 3.0], &[10.0, 20.0], Interpolation::Linear, AfterEnd::Error));
    near(value(&network, 3.0, 3.0).unwrap(), 20.0);
    near(value(&network, 3.0 + 1e-10, 3.0).unwrap(), 20.0);
    let after = value(&network, 3.5, 3.5).unwrap_err();
    assert!(
        matches!(after, InputProblem::AfterSignal { time, last } if (time, last) == (3.5, 3.0))
    );
}

#[test]
fn steps_hold_the_value_of_the_point_before_where_the_segment_lies() {
    let (network, _) = network(steps(&[0.0, 2.0, 5.0], &[1.0, 4.0, 2.0], AfterEnd::Hold));
    all_near(&seen(&network, &[0.0, 1.9, 2.0, 4.9, 5.0, 50.0]), &[1.0, 1.0, 4.0, 4.0, 2.0, 2.0]);
    near(value(&network, 2.0, 1.0).unwrap(), 1.0);
    near(value(&network, 2.0, 3.0).unwrap(), 4.0);
    all_near(&network.breakpoints(0.0, 4.0).unwrap(), &[2.0]);
}

#[test]
fn a_monotone_cubic_has_no_breakpoints_inside_and_is_curved() {
    let (network, _) = network(curve(
        &[0.0, 1.0, 2.0, 4.0],
        &[0.0, 1.0, 1.0, 3.0],
        Interpolation::Pchip,
        AfterEnd::Hold,
    ));
    // flat between 1 s and 2 s, and slope 0 there: 3 x^2 - 2 x^3 of each interval with slope 0 at
    // one end
    near(value(&network, 1.5, 1.5).unwrap(), 1.0);
    assert_eq!(network.curves().len(), 1);
    all_near(&network.breakpoints(0.0, 10.0).unwrap(), &[4.0]);
}

#[test]
fn repeated_signals_begin_anew() {
    let (network, _) = network(curve(
        &[1.0, 3.0, 5.0],
        &[0.0, 2.0, 1.0],
        Interpolation::Linear,
        AfterEnd::Repeat(6.0),
    ));
    // 5 s to 7 s: the last value is held until it begins anew
    all_near(
        &seen(&network, &[2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]),
        &[1.0, 1.5, 1.0, 1.0, 1.5, 1.0, 1.0],
    );
    near(value(&network, 7.0, 6.5).unwrap(), 1.0);
    near(value(&network, 7.0, 7.5).unwrap(), 0.0);
    all_near(&network.breakpoints(1.0, 15.0).unwrap(), &[3.0, 5.0, 7.0, 9.0, 11.0, 13.0]);
    all_near(&network.breakpoints(8.0, 12.0).unwrap(), &[9.0, 11.0]);
    assert_eq!(network.repeat_period(), Ok(Some(6.0)));
    let error = network.breakpoints(1.0, 1e8).unwrap_err();
    assert!(
        matches!(error.problem, InputProblem::TooManyPoints(n) if n > 4.9e7 && n < 5.1e7),
        "{error}"
    );
}

#[test]
fn signals_of_expressions_read_those_before_them() {
    let (mut b, a, _) = cooled();
    let first = b.signal("s", POWER, steps(&[0.0, 4.0], &[1.0, 3.0], AfterEnd::Error));
    let twice = time(&b, "2 * s + 1 [W/s] * t");
    let second = b.signal_expression("twice", twice);
    let p = time(&b, "twice");
    b.source("p", a, p);
    let network = b.build().unwrap();
    assert_eq!(network.signal_slot(second), network.signal_slot(first) + 2);
    let mut scope = network.evaluation();
    scope.set_time(3.0, 3.0);
    near(scope.signal(second), 5.0);
    let span = network.signals()[second.index()].course.span();
    assert_eq!(span, (f64::NEG_INFINITY, f64::INFINITY));
    let error = value(&network, 20.0, 20.0).unwrap_err();
    assert!(matches!(error, InputProblem::AfterSignal { .. }));
    all_near(&network.breakpoints(0.0, 4.0).unwrap(), &[]);
}

/// Times at which comparisons, kinks and tables of time change.
#[test]
fn breakpoints_of_expressions() {
    let of = |text: &str, add: fn(&mut NetworkBuilder)| {
        let (mut b, a, _) = cooled();
        add(&mut b);
        let p = time(&b, text);
        b.source("p", a, p);
        b.build().unwrap().breakpoints(0.0, 100.0).unwrap()
    };
    let none = |_: &mut NetworkBuilder| {};
    all_near(&of("if(t < 30 [s], 1 [W], 2 [W])", none), &[30.0]);
    all_near(
        &of("if(3 * t - 20 [s] > t, 1 [W], if(t > 60 [s], 2 [W], 3 [W]))", none),
        &[10.0, 60.0],
    );
    all_near(&of("abs(t - 25 [s]) * 1 [W/s]", none), &[25.0]);
    all_near(&of("min(t, 40 [s]) * 1 [W/s] + max(2 * t, 20 [s]) * 1 [W/s]", none), &[10.0, 40.0]);
    all_near(&of("5 [W] * sin(t / 1 [s])", none), &[]);
    all_near(&of("if(t < 100 [s], 1 [W], 2 [W])", none), &[]);
    all_near(&of("if(t < 0 [s], 1 [W], 2 [W])", none), &[]);
    let table: fn(&mut NetworkBuilder) = |b| {
        let table = Table1::new(
            vec![-10.0, 5.0, 300.0],
            vec![1.0, 2.0, 0.0],
            Interpolation::Linear,
            Outside::Error,
        );
        let table = lptn_units::LookupTable::One(table.unwrap()).into();
        let arguments = vec![Type::of(Dimension::TIME)];
        b.table(
            "of_time",
            lptn_units::TableSymbol { table, arguments, ty: POWER, units: Vec::new() },
        );
    };
    all_near(&of("of_time(2 * t)", table), &[2.5]);
    // 40 W + 20 W sin(2 pi t / 60 s) > 50 W from t = 5 s to 25 s, in every period
    let wave: fn(&mut NetworkBuilder) = |b| {
        let wave = time(b, "40 [W] + 20 [W] * sin(2 * pi * t / 60 [s])");
        b.signal_expression("wave", wave);
    };
    let (mut b, a, _) = cooled();
    wave(&mut b);
    let p = time(&b, "max(wave, 50 [W])");
    b.source("p", a, p);
    let found = b.build().unwrap().breakpoints(0.0, 100.0).unwrap();
    assert_eq!(found.len(), 4, "{found:?}");
    found
        .iter()
        .zip([5.0, 25.0, 65.0, 85.0])
        .for_each(|(f, e)| assert!((f - e).abs() < 1e-6, "{found:?}"));
}

#[test]
fn courses_between_breakpoints() {
    let (mut b, a, _) = cooled();
    b.signal("line", POWER, curve(&[0.0, 9.0], &[0.0, 9.0], Interpolation::Linear, AfterEnd::Hold));
    b.signal("bend", POWER, curve(&[0.0, 9.0], &[0.0, 9.0], Interpolation::Pchip, AfterEnd::Hold));
    b.parameter("scale", lptn_network::HeatFlow(2.0));
    let texts = [
        ("scale", Degree::Constant),
        ("2 * line", Degree::Affine),
        ("2 * t * 1 [W/s]", Degree::Affine),
        ("line * t / 1 [s]", Degree::Nonlinear),
        ("bend", Degree::Nonlinear),
        ("t^2 * 1 [W/s^2]", Degree::Nonlinear),
    ];
    let values: Vec<_> = texts
        .iter()
        .enumerate()
        .map(|(i, (text, _))| {
            let p = power(&b, text);
            b.source(&format!("p{i}"), a, p)
        })
        .collect();
    let network = b.build().unwrap();
    for (id, (text, degree)) in values.iter().zip(texts) {
        assert_eq!(
            network.course(network.sources()[id.index()].power().unwrap()),
            degree,
            "{text}"
        );
    }
    assert_eq!(network.curves().len(), 3);
}

/// Where a comparison or a kink meets a curve: a monotone one may be compared, others may only bend
/// a value.
#[test]
fn comparisons_of_curves() {
    let (mut b, a, _) = cooled();
    // 16 W (3 u^2 - 2 u^3) over 0 s to 10 s, flat at both ends: 2.5 W at a quarter of the way, 13.5
    // W at three
    let rise = curve(
        &[-5.0, 0.0, 10.0, 15.0],
        &[0.0, 0.0, 16.0, 16.0],
        Interpolation::Pchip,
        AfterEnd::Hold,
    );
    b.signal("rise", POWER, rise);
    let p = time(&b, "if(rise > 2.5 [W], 1 [W], 2 [W])");
    b.source("p", a, p);
    let p = time(&b, "max(rise, 13.5 [W])");
    b.source("q", a, p);
    let found = b.build().unwrap().breakpoints(0.0, 12.0).unwrap();
    assert_eq!(found.len(), 2, "{found:?}");
    found.iter().zip([2.5, 7.5]).for_each(|(f, e)| assert!((f - e).abs() < 1e-8, "{found:?}"));
    let refused = |text: &str| {
        let (mut b, a, _) = cooled();
        let rise = curve(&[0.0, 10.0], &[0.0, 16.0], Interpolation::Pchip, AfterEnd::Hold);
        b.signal("rise", POWER, rise);
        let p = time(&b, text);
        b.source("p", a, p);
        common::codes(b) == ["network::comparison_not_linear"]
    };
    assert!(!refused("if(2 * rise > 5 [W], 1 [W], 2 [W])"));
    assert!(refused("if(rise * rise > 5 [W^2], 1 [W], 2 [W])"));
    assert!(refused("if(sin(t / 1 [s]) > 0.5, 1 [W], 2 [W])"));
}

#[test]
fn breakpoints_closer_than_rounding_are_one_and_none_lies_at_an_end() {
    let (mut b, a, _) = cooled();
    let course = steps(
        &[0.0, 10.0, 10.0 + 1e-12, 20.0, 30.0 - 1e-12, 30.0],
        &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        AfterEnd::Hold,
    );
    b.signal("s", POWER, course);
    let p = time(&b, "s + if(t < 10 [s], 1 [W], 2 [W])");
    b.source("p", a, p);
    let network = b.build().unwrap();
    all_near(&network.breakpoints(0.0, 30.0).unwrap(), &[10.0, 20.0]);
    all_near(&network.breakpoints(10.0, 25.0).unwrap(), &[20.0]);
    all_near(&network.breakpoints(1e-3, 20.0).unwrap(), &[10.0]);
}
