//! Kinks along given time histories.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_integrate::Integrator;

use super::*;
use crate::scripted::{Scripted, bodies};

/// Capacity in J/K.
const C: f64 = 1000.0;

/// Slope in W/K on either side of a kink at 310 K.
const K: f64 = 5.0;

const KINK: &str = "5 [W/K] * abs(T - absolute(310 [K]))";

/// A body whose temperature rises by 1 K/s from 300 K at 0 s, in a step to 20 s; a kink is at a
/// time.
fn bend(at: f64, (tolerance, fresh): (f64, bool)) -> Option<Bend> {
    on_the_way(at, tolerance, |corners, integrator, step, ends| {
        corners.bend(integrator, step, ([&ends[0], &ends[1]], fresh))
    })
}

fn on_the_way<T>(
    at: f64,
    tolerance: f64,
    then: impl FnOnce(&mut Corners, &mut Scripted<'_>, &Step, [Vec<f64>; 2]) -> T,
) -> T {
    let network = bodies(&[(C, KINK), (C, "1 [W]")], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let course = move |time: f64| vec![310.0 + time - at, 300.0];
    let mut integrator = Scripted::new(&system, 0.0, course);
    let mut corners = Corners::of(&system, tolerance);
    assert!(!corners.are_none());
    let look = |integrator: &mut Scripted<'_>| {
        let (time, state) = (integrator.time(), integrator.state().to_vec());
        integrator.system_mut().look(time, &state).unwrap().to_vec()
    };
    let first = look(&mut integrator);
    corners.begin(integrator.system_mut());
    let step = integrator.goes_to(20.0);
    let last = look(&mut integrator);
    then(&mut corners, &mut integrator, &step, [first, last])
}

/// Half of the fourth difference of `5 |T - 310 K|`, 20 s long, over the heat that the body stores.
/// A body that loses more when it is warmer also gives heat off in that time. The state that was
/// read last is that at 15 s.
fn disturbance(at: f64) -> [f64; 3] {
    let heat = |k: f64| K * ((k - 1.0) * 5.0 - at).abs();
    let loses = if at < 15.0 { 0.0 } else { 20.0 * (2.0 + K) };
    [0.0, 1.0, 2.0].map(|k| {
        let [a, b, c, d, e] = [0.0, 1.0, 2.0, 3.0, 4.0].map(|j| heat(k + j));
        0.5 * (a - 4.0 * b + 6.0 * c - 4.0 * d + e).abs() * 20.0 / (C + loses)
    })
}

#[test]
fn a_kink_disturbs_by_its_fourth_differences() {
    for at in [3.0, 9.0, 10.0, 16.0, 19.0] {
        let found = on_the_way(at, 1e-3, |corners, integrator, step, ends| {
            integrator.looks.clear();
            let samples = samples(integrator, step, [&ends[0], &ends[1]]).unwrap();
            assert_eq!(integrator.looks, [5.0, 10.0, 15.0]);
            for ((_, found), time) in samples.iter().zip([-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0]) {
                assert!((found[0] - 310.0 - time + at).abs() < 1e-9, "{time}: {found:?}");
                assert!((found[1] - 300.0).abs() < 1e-9 && (found[2] - 300.0).abs() < 1e-9);
            }
            assert_eq!(samples.each_ref().map(|sample| sample.0), [0., 0., 5., 10., 15., 20., 20.]);
            corners.disturbance(integrator, step, (&samples, &[0])).unwrap()
        });
        for (found, expected) in found.iter().zip(disturbance(at)) {
            assert!((found - expected).abs() < 1e-9, "{at}: {found} for {expected}");
        }
    }
    // below the allowed disturbance, the heat given off is not weighed
    let found = on_the_way(16.0, 1e3, |corners, integrator, step, ends| {
        let samples = samples(integrator, step, [&ends[0], &ends[1]]).unwrap();
        corners.disturbance(integrator, step, (&samples, &[0])).unwrap()
    });
    let expected = disturbance(16.0).map(|d| d * (C + 140.0) / C);
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
}

/// Five points of a polynomial of degree 4 extrapolate it by a quarter beyond both ends.
#[test]
fn a_course_is_followed_a_quarter_of_a_step_beyond_its_ends() {
    let network = bodies(&[(C, KINK)], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let quartic = |t: f64| vec![300.0 + t - 0.3 * t * t + 0.02 * t.powi(3) - 1e-3 * t.powi(4)];
    let mut integrator = Scripted::new(&system, 2.0, quartic);
    let step = integrator.goes_to(10.0);
    let ends = [2.0, 10.0].map(|time| [quartic(time)[0], 300.0]);
    let found = samples(&mut integrator, &step, [&ends[0], &ends[1]]).unwrap();
    for ((time, found), at) in found.iter().zip([0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0]) {
        assert!((found[0] - quartic(at)[0]).abs() < 1e-9, "{at}: {found:?}");
        assert!((*time - at.clamp(2.0, 10.0)).abs() < 1e-12);
    }
    integrator.from = 5.0;
    assert!(samples(&mut integrator, &step, [&ends[0], &ends[1]]).is_none());
}

/// A kink that disturbs by much is met; one that a shorter step allows is not; one right at the
/// start of a step that goes on halves it.
#[test]
fn a_step_ends_at_a_kink_or_is_short_enough_to_bear_it() {
    let worst = disturbance(9.0)[..2].iter().fold(0.0, |most: f64, d| most.max(*d));
    // allowed in a step shorter by the root
    for share in [0.2, 0.5, 0.9] {
        let tolerance = 4.0 * worst * share * share;
        let found = bend(9.0, (tolerance, false));
        let Some(Bend::In { kink, longest }) = found else { panic!("{found:?}") };
        assert!(kink.is_infinite() && (longest - 0.9 * share * 20.0).abs() < 1e-9, "{longest}");
    }
    for share in [0.1, 0.01] {
        let found = bend(9.0, (4.0 * worst * share * share, false));
        let Some(Bend::In { kink, longest }) = found else { panic!("{found:?}") };
        assert!((kink - 9.0).abs() < 1e-9 && kink >= 9.0 && longest.is_infinite(), "{kink}");
    }
    assert_eq!(bend(9.0, (4.0 * worst * 1.001, false)), None);
    let at_start = bend(0.3, (1e-6, false));
    assert_eq!(at_start, Some(Bend::In { kink: f64::INFINITY, longest: 10.0 }));
    let found = bend(0.5, (1e-6, false));
    assert!(matches!(found, Some(Bend::In { kink, .. }) if (kink - 0.5).abs() < 1e-9), "{found:?}");
    // if the integrator has restarted nothing before counts, and a step ends at the kink
    let found = bend(0.3, (1e-6, true));
    assert!(matches!(found, Some(Bend::In { kink, .. }) if (kink - 0.3).abs() < 1e-9), "{found:?}");
}

/// A kink that disturbs only before a step or after it.
#[test]
fn a_kink_beside_a_step_counts_unless_the_integrator_begins_there() {
    // at the end: the samples within are straight
    let [before, within, behind] = disturbance(19.999);
    assert!(within < 1e-3 && before < 1e-3 && behind > 0.1, "{before} {within} {behind}");
    assert_eq!(bend(19.999, (0.02, false)), Some(Bend::Behind));
    assert_eq!(bend(19.999, (4.0 * behind * 0.999, false)), Some(Bend::Behind));
    assert_eq!(bend(19.999, (4.0 * behind * 1.001, false)), None);
    // at the start
    let [before, within, _] = disturbance(0.001);
    assert!(within < 1e-3 && before > 0.1, "{before} {within}");
    assert_eq!(bend(0.001, (0.02, true)), None);
    let halved = Some(Bend::In { kink: f64::INFINITY, longest: 10.0 });
    assert_eq!(bend(0.001, (0.02, false)), halved);
}

#[test]
fn nothing_bends_where_the_piece_is_the_same() {
    assert_eq!(bend(-3.0, (1e-9, false)), None);
    assert_eq!(bend(25.0, (1e-9, false)), None);
    on_the_way(9.0, 1e-6, |corners, integrator, step, ends| {
        let no_length = Step { from: step.to, ..*step };
        assert_eq!(corners.bend(integrator, &no_length, ([&ends[0], &ends[1]], false)), None);
        assert!(corners.has_changed());
        corners.accept();
        assert!(!corners.has_changed());
    });
}

/// Forty halvings of 20 s.
#[test]
fn a_kink_is_found_by_halvings() {
    on_the_way(7.3, 1e-6, |corners, integrator, step, _| {
        integrator.looks.clear();
        let kink = corners.first_kink(integrator, step, &[0]);
        assert!(kink >= 7.3 && kink - 7.3 < 1e-10, "{kink}");
        assert_eq!(integrator.looks.len(), BISECTIONS);
        // if a step cannot be read it is its end
        integrator.from = 15.0;
        assert_eq!(corners.first_kink(integrator, step, &[0]).to_bits(), 20.0_f64.to_bits());
    });
}

/// Only the elements that bend; a massless node is as light as the lightest body.
#[test]
fn capacities_are_those_of_the_bodies() {
    let heats = [(30.0, "1 [W]"), (0.0, KINK), (20.0, KINK)];
    let system = ThermalSystem::assemble(&bodies(&heats, Some("1 [W/K]"))).unwrap();
    let corners = Corners::of(&system, 1e-3);
    assert_eq!(corners.capacity, [30.0, 20.0, 20.0, f64::INFINITY]);
    assert_eq!((corners.elements.len(), corners.are_none()), (2, false));
    let system = ThermalSystem::assemble(&bodies(&heats[..1], None)).unwrap();
    assert!(Corners::of(&system, 1e-3).are_none());
}

/// The time history of `bend`, begun at another time: a kink is judged in the same way.
fn bend_from(start: f64, at: f64, (tolerance, fresh): (f64, bool)) -> Option<Bend> {
    let network = bodies(&[(C, KINK), (C, "1 [W]")], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let course = move |time: f64| vec![310.0 + time - start - at, 300.0];
    let mut integrator = Scripted::new(&system, start, course);
    let mut corners = Corners::of(&system, tolerance);
    let first = [310.0 - at, 300.0, 300.0];
    let state = integrator.state().to_vec();
    integrator.system_mut().look(start, &state).unwrap();
    corners.begin(integrator.system_mut());
    let step = integrator.goes_to(start + 20.0);
    let last = [330.0 - at, 300.0, 300.0];
    let state = integrator.state().to_vec();
    integrator.system_mut().look(start + 20.0, &state).unwrap();
    corners.bend(&mut integrator, &step, ([&first, &last], fresh))
}

#[test]
fn a_kink_is_judged_alike_whenever_the_step_begins() {
    for (at, tolerance, fresh) in [
        (9.0, 1e-6, false),
        (9.0, 0.3, false),
        (0.3, 1e-6, false),
        (0.3, 1e-6, true),
        (9.0, 9.0, true),
    ] {
        let expected = bend_from(0.0, at, (tolerance, fresh));
        for start in [64.0, -1024.0] {
            let found = bend_from(start, at, (tolerance, fresh));
            match (found, expected) {
                (Some(Bend::In { kink, longest }), Some(Bend::In { kink: k, longest: l })) => {
                    assert!(kink == k || (kink - start - k).abs() < 1e-9, "{kink} {k}");
                    assert!(longest == l || (longest - l).abs() < 1e-9, "{longest} {l}");
                }
                (found, expected) => assert_eq!(found, expected, "{start} {at}"),
            }
        }
    }
    let met = bend_from(64.0, 9.0, (1e-6, false));
    assert!(matches!(met, Some(Bend::In { kink, .. }) if (kink - 73.0).abs() < 1e-9), "{met:?}");
    let halved = Some(Bend::In { kink: f64::INFINITY, longest: 10.0 });
    assert_eq!(bend_from(64.0, 0.3, (1e-6, false)), halved);
}

/// A disturbance of more than a quarter of the tolerance is weighed by the heat given off.
#[test]
fn a_disturbance_beyond_a_quarter_of_the_tolerance_is_weighed_by_the_heat_given_off() {
    let weighed = disturbance(16.0);
    let bare = weighed.map(|d| d * (C + 140.0) / C);
    let most = bare.iter().fold(0.0, |most: f64, d| most.max(*d));
    for (share, expected) in [(0.99, weighed), (1.01, bare)] {
        let found = on_the_way(16.0, 4.0 * most * share, |corners, integrator, step, ends| {
            let samples = samples(integrator, step, [&ends[0], &ends[1]]).unwrap();
            corners.disturbance(integrator, step, (&samples, &[0])).unwrap()
        });
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{share}: {found:?} for {expected:?}");
    }
}

/// Eight doubles are halved three times: there is no time between two that are neighbours.
#[test]
fn a_kink_is_found_down_to_neighbouring_times() {
    let network = bodies(&[(C, KINK)], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let (start, double) = (1024.0, 1024.0 * f64::EPSILON);
    let course = move |time: f64| vec![310.0 + 1e9 * (time - start - 4.5 * double)];
    let mut integrator = Scripted::new(&system, start, course);
    let state = integrator.state().to_vec();
    integrator.system_mut().look(start, &state).unwrap();
    let mut corners = Corners::of(&system, 1e-6);
    corners.begin(integrator.system_mut());
    let step = integrator.goes_to(start + 8.0 * double);
    integrator.looks.clear();
    assert_eq!(corners.first_kink(&mut integrator, &step, &[0]), start + 5.0 * double);
    assert_eq!(integrator.looks, [4.0, 6.0, 5.0].map(|k| start + k * double));
}
