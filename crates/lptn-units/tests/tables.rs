//! Tables by themselves: values, slopes and integrals.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Interpolation, LookupTable, Outside, Table1, Table2, TableError};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

fn table(x: &[f64], y: &[f64], interpolation: Interpolation, outside: Outside) -> Table1 {
    Table1::new(x.to_vec(), y.to_vec(), interpolation, outside).unwrap()
}

fn linear(x: &[f64], y: &[f64], outside: Outside) -> Table1 {
    table(x, y, Interpolation::Linear, outside)
}

fn assert_near(found: f64, expected: f64, scale: f64, what: &str) {
    assert!((found - expected).abs() <= scale, "{what}: {found} instead of {expected}");
}

/// Knots, values, slopes at the knots, `(x, value, slope)`, `(from, to, integral)`.
type Reference<'a> = (&'a [f64], &'a [f64], &'a [f64], [(f64, f64, f64); 5], (f64, f64, f64));

/// `scipy.interpolate.PchipInterpolator(x, y)` of SciPy 1.17.1, its `derivative()` and
/// `integrate(from, to)`, as printed but for the last digits where these are rounding. The first
/// has a flat piece and an uneven grid; the third has an end slope that is limited to three
/// secants.
const SCIPY: [Reference<'_>; 5] = [
    (
        &[0.0, 1.0, 2.5, 3.0, 5.0, 8.0],
        &[1.0, 2.0, 2.2, 5.0, 5.0, 0.5],
        &[1.3466666666666667, 0.24793388429752083, 0.30967741935483895, 0.0, 0.0, -2.4],
        [
            (0.4, 1.5221183471074382, 1.1990611570247933),
            (2.4, 2.1720182074903485, 0.2512515181136883),
            (3.6, 5.0, 0.0),
            (6.16, 4.1621397333333325, -1.35488),
            (7.6, 1.4397333333333338, -2.288),
        ],
        (1.04, 7.28, 23.94952261396874),
    ),
    (
        &[0.0, 1.0, 3.0],
        &[0.0, 5.0, 4.0],
        &[6.833333333333333, 0.0, -1.5],
        [
            (0.15, 1.0443125, 7.019583333333333),
            (0.9, 4.9215, 1.538333333333334),
            (1.35, 4.994640625, -0.0459375),
            (2.31, 4.718988625, -0.6435375),
            (2.85, 4.208546875, -1.2834375),
        ],
        (0.39, 2.73, 10.911799860381945),
    ),
    (
        &[0.0, 1.0, 3.0],
        &[0.0, 1.0, -9.0],
        &[3.0, 0.0, -9.0],
        [
            (0.15, 0.385875, 2.1675),
            (0.9, 0.999, 0.03),
            (1.35, 0.64321875, -2.008125),
            (2.31, -3.58627725, -6.572925),
            (2.85, -7.68459375, -8.533125),
        ],
        (0.39, 2.73, -2.3124909518749996),
    ),
    (
        &[0.0, 2.0],
        &[1.0, 5.0],
        &[2.0, 2.0],
        [(0.1, 1.2, 2.0), (0.6, 2.2, 2.0), (0.9, 2.8, 2.0), (1.54, 4.08, 2.0), (1.9, 4.8, 2.0)],
        (0.26, 1.82, 4.8048),
    ),
    (
        &[273.15, 293.15, 373.15, 473.15],
        &[380.0, 390.0, 410.0, 445.0],
        &[0.55, 0.35714285714285715, 0.2898773006134969, 0.40555555555555556],
        [
            (283.15, 385.4821428571429, 0.5232142857142856),
            (333.15, 400.6726555652936, 0.21324496056091147),
            (363.15, 407.3118769171779, 0.2500445059158633),
            (427.15, 427.4678139877301, 0.3557469938650306),
            (463.15, 440.99588957055215, 0.3952208588957055),
        ],
        (299.15, 455.15, 64397.96594935043),
    ),
];

#[test]
fn pchip_is_that_of_scipy() {
    for (x, y, slopes, points, (from, to, area)) in SCIPY {
        let found = table(x, y, Interpolation::Pchip, Outside::Error);
        for ((&x, &y), &slope) in x.iter().zip(y).zip(slopes) {
            let (value, found) = found.value_and_slope(x).unwrap();
            assert_eq!(value.to_bits(), y.to_bits(), "at the knot {x}");
            assert_near(found, slope, 1e-14 * (1.0 + slope.abs()), "slope at a knot");
        }
        for (x, value, slope) in points {
            let (found, found_slope) = found.value_and_slope(x).unwrap();
            assert_near(found, value, 1e-14 * (1.0 + value.abs()), "value");
            assert_near(found_slope, slope, 2e-13 * (1.0 + slope.abs()), "slope");
        }
        assert_near(
            found.integral(from, to).unwrap(),
            area,
            1e-14 * (1.0 + area.abs()),
            "integral",
        );
    }
}

#[test]
fn straight_lines_by_hand() {
    let x = [1.0, 2.0, 4.0];
    let table = linear(&x, &[10.0, 20.0, 0.0], Outside::Error);
    for (x, expected) in [
        (1.0, (10.0, 10.0)),
        (1.5, (15.0, 10.0)),
        (2.0, (20.0, -10.0)), // the slope to the right of a knot
        (3.0, (10.0, -10.0)),
        (4.0, (0.0, -10.0)), // to the left of the last
    ] {
        assert_eq!(table.value_and_slope(x), Some(expected), "at {x}");
    }
    assert_eq!(table.integral(1.0, 4.0), Some(15.0 + 20.0));
    assert_eq!(table.integral(3.0, 1.5), Some(-(17.5 * 0.5 + 15.0)));
    assert_eq!((table.knots(), table.values()), (&x[..], &[10.0, 20.0, 0.0][..]));
    assert_eq!((table.interpolation(), table.outside()), (Interpolation::Linear, Outside::Error));
}

#[test]
fn outside_is_nothing_or_the_value_at_the_end() {
    for interpolation in [Interpolation::Linear, Interpolation::Pchip] {
        let bare = table(&[0.0, 1.0], &[3.0, 5.0], interpolation, Outside::Error);
        for x in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
            assert_eq!(bare.value_and_slope(x), None, "at {x}");
            assert_eq!(bare.integral(0.5, x), None, "to {x}");
        }
        let held = table(&[0.0, 1.0], &[3.0, 5.0], interpolation, Outside::Hold);
        assert_eq!(held.value_and_slope(-9.0), Some((3.0, 0.0)));
        assert_eq!(held.value_and_slope(9.0), Some((5.0, 0.0)));
        assert_eq!(held.value_and_slope(1.0), Some((5.0, 2.0)));
        assert_eq!(held.value_and_slope(f64::NAN), None);
        for (from, to, area) in [(-2.0, 3.0, 6.0 + 4.0 + 10.0), (-2.0, -1.0, 3.0), (2.0, 4.0, 10.0)]
        {
            assert_eq!(held.integral(from, to), Some(area));
            assert_eq!(held.integral(to, from), Some(-area));
        }
        assert_eq!(held.integral(0.0, f64::INFINITY), None);
    }
}

/// The end of a table reached by another sum than the one that was written: an argument one
/// rounding further on is at the end, a small step is not.
#[test]
fn rounding_does_not_lead_outside() {
    let speed = 7000.0 * (std::f64::consts::TAU / 60.0);
    let table = linear(&[0.0, speed], &[0.0, 220.0], Outside::Error);
    let (value, slope) = table.value_and_slope(speed.next_up()).unwrap();
    assert_near(value, 220.0, 1e-12, "at the end");
    assert_near(slope, 220.0 / speed, 1e-15, "slope");
    assert!(table.integral(0.0, speed.next_up()).is_some());
    assert_eq!(table.value_and_slope(speed * (1.0 + 1e-12)), None);
    assert_eq!(table.value_and_slope(-1e-9), None);
}

/// A body that warms by a millionth of a kelvin in a table that begins far below: the energy is not
/// lost in the difference of two large integrals.
#[test]
fn the_integral_over_a_short_way_keeps_its_digits() {
    let capacity = linear(&[200.0, 300.0, 1000.0], &[1e5, 2e5, 4e5], Outside::Error);
    let (from, to) = (299.999_999_75, 299.999_999_875);
    let mean = 1e5 + 1e3 * (0.5 * (from + to) - 200.0);
    assert_near(capacity.integral(from, to).unwrap() / (mean * (to - from)), 1.0, 1e-14, "ratio");
}

#[test]
fn two_arguments_by_hand() {
    let (x, y) = ([0.0, 1.0, 3.0], [0.0, 2.0]);
    // z = 5 + x + 2 y + 3 x y in the first cell, 7 at the last x
    let z = [5.0, 9.0, 6.0, 16.0, 7.0, 7.0];
    let map = |outside| Table2::new(x.to_vec(), y.to_vec(), z.to_vec(), outside).unwrap();
    let bare = map(Outside::Error);
    for (at, value, slopes) in [
        ((0.5, 1.0), 5.0 + 0.5 + 2.0 + 1.5, [4.0, 3.5]),
        ((0.0, 2.0), 9.0, [7.0, 2.0]),
        ((1.0, 0.0), 6.0, [0.5, 5.0]), // the cell above the knot
        ((3.0, 2.0), 7.0, [-4.5, 0.0]),
    ] {
        assert_eq!(bare.value_and_slopes(at.0, at.1), Some((value, slopes)), "at {at:?}");
    }
    for (x, y) in [(-0.1, 1.0), (0.5, 2.1), (f64::NAN, 1.0), (0.5, f64::INFINITY)] {
        assert_eq!(bare.value_and_slopes(x, y), None);
    }
    let held = map(Outside::Hold);
    assert_eq!(held.value_and_slopes(-1.0, 1.0), Some((7.0, [0.0, 2.0])));
    assert_eq!(held.value_and_slopes(0.5, 9.0), Some((12.5, [7.0, 0.0])));
    assert_eq!(held.value_and_slopes(9.0, -9.0), Some((7.0, [0.0, 0.0])));
    let table = LookupTable::Two(held);
    assert_eq!((table.knots(0), table.knots(1), table.knots(2)), (&x[..], &y[..], &[][..]));
    assert_eq!((table.dimension(), table.outside()), (2, Outside::Hold));
}

#[test]
fn numbers_that_are_no_table_are_refused() {
    let one = |x: &[f64], y: &[f64]| {
        Table1::new(x.to_vec(), y.to_vec(), Interpolation::Pchip, Outside::Error).unwrap_err()
    };
    let table = [
        (one(&[1.0], &[1.0]), TableError::TooShort, "units::table_too_short"),
        (one(&[1.0, 2.0], &[1.0, 2.0, 3.0]), TableError::LengthsDiffer, "units::table_lengths"),
        (
            one(&[1.0, 3.0, 2.0], &[0.0; 3]),
            TableError::NotIncreasing { index: 2 },
            "units::table_not_increasing",
        ),
        (
            one(&[1.0, 1.0], &[0.0; 2]),
            TableError::NotIncreasing { index: 1 },
            "units::table_not_increasing",
        ),
        (
            one(&[1.0, f64::NAN], &[0.0; 2]),
            TableError::NotFinite { index: 1 },
            "units::table_not_finite",
        ),
        (
            one(&[1.0, 2.0], &[f64::INFINITY; 2]),
            TableError::NotFinite { index: 0 },
            "units::table_not_finite",
        ),
    ];
    for (found, expected, code) in table {
        assert_eq!((found.code(), &found), (code, &expected));
        assert!(found.help().is_some());
    }
    let two = |x: &[f64], y: &[f64], z: &[f64]| {
        Table2::new(x.to_vec(), y.to_vec(), z.to_vec(), Outside::Error).unwrap_err()
    };
    assert_eq!(two(&[0.0, 1.0], &[0.0, 1.0], &[0.0; 3]), TableError::LengthsDiffer);
    assert_eq!(
        two(&[0.0, 1.0], &[0.0, 1.0], &[0.0, 0.0, 0.0, f64::NAN]),
        TableError::NotFinite { index: 3 }
    );
    let falling = two(&[0.0, 1.0], &[1.0, 0.0], &[0.0; 4]);
    assert_eq!(falling.code(), "units::table_not_increasing");
    assert_eq!(
        falling.to_string(),
        "second argument: arguments must rise: number 2 is not above the one before it"
    );
}

fn config() -> Config {
    Config {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_261_121),
        ..Config::default()
    }
}

/// Knots that rise by 0.1 to 3 and values between -10 and 10, some of them equal.
fn points() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    let value = prop_oneof![3 => -10.0..10.0, 1 => Just(2.0)];
    (-5.0..5.0, proptest::collection::vec((0.1..3.0, value), 2..9)).prop_map(|(start, points)| {
        let mut at = start;
        points
            .into_iter()
            .map(|(step, value): (f64, f64)| {
                at += step;
                (at, value)
            })
            .unzip()
    })
}

fn interpolation() -> impl Strategy<Value = Interpolation> {
    prop_oneof![Just(Interpolation::Linear), Just(Interpolation::Pchip)]
}

/// A number at a share of the way from a bit before the first knot to a bit after the last.
fn along(knots: &[f64], share: f64) -> f64 {
    let (first, last) = (knots[0] - 1.0, knots[knots.len() - 1] + 1.0);
    first + (last - first) * share
}

/// The integral of a piece by Simpson's rule in 64 parts, from knot to knot so that each piece is
/// smooth.
fn simpson(table: &Table1, from: f64, to: f64) -> f64 {
    let inner = table.knots().iter().copied().filter(|knot| from < *knot && *knot < to);
    let stops: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
    let value = |x: f64| table.value_and_slope(x).unwrap().0;
    let piece = |a: f64, b: f64| {
        let part = (b - a) / 64.0;
        let at = |i: u32| a + part * f64::from(i);
        (0..64)
            .map(|i| {
                (value(at(i)) + 4.0 * value(at(i) + 0.5 * part) + value(at(i + 1))) * part / 6.0
            })
            .sum()
    };
    stops.windows(2).map(|pair| -> f64 { piece(pair[0], pair[1]) }).sum()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn integrals_agree_with_simpson_and_add_up(
        (x, y) in points(), interpolation in interpolation(), shares in [0.0..1.0, 0.0..1.0, 0.0..1.0],
    ) {
        let table = table(&x, &y, interpolation, Outside::Hold);
        let mut stops = shares.map(|share: f64| along(&x, share));
        stops.sort_by(f64::total_cmp);
        let [a, b, c] = stops;
        let integral = |from, to| table.integral(from, to).unwrap();
        prop_assert!((integral(a, c) - simpson(&table, a, c)).abs() < 1e-11);
        prop_assert!((integral(a, b) + integral(b, c) - integral(a, c)).abs() < 1e-12 * (1.0 + 10.0 * (c - a)));
        prop_assert_eq!(integral(c, a).to_bits(), (-integral(a, c)).to_bits());
        prop_assert_eq!(integral(b, b).abs().to_bits(), 0);
    }

    #[test]
    fn the_slope_of_the_integral_is_the_value((x, y) in points(), interpolation in interpolation(), share in 0.0..1.0) {
        let table = table(&x, &y, interpolation, Outside::Hold);
        let (at, step) = (along(&x, share), 1e-4);
        prop_assume!(x.iter().all(|knot| (knot - at).abs() > step));
        let slope = table.integral(at - step, at + step).unwrap() / (2.0 * step);
        // the cubic's second derivative is below 1e5 here: h^2 / 6 f'' is below 2e-4 |f|
        prop_assert!((slope - table.value_and_slope(at).unwrap().0).abs() < 2e-4);
    }

    #[test]
    fn pieces_stay_between_their_ends_and_are_monotone((x, y) in points(), interpolation in interpolation()) {
        let table = table(&x, &y, interpolation, Outside::Error);
        for i in 1..x.len() {
            let (low, high) = (y[i - 1].min(y[i]), y[i - 1].max(y[i]));
            let rises = y[i] > y[i - 1];
            for part in 0..=40 {
                let at = x[i - 1] + (x[i] - x[i - 1]) * f64::from(part) / 40.0;
                let (value, slope) = table.value_and_slope(at.min(x[i])).unwrap();
                prop_assert!(low - 1e-13 <= value && value <= high + 1e-13, "{value} at {at}");
                let along = if rises { slope } else { -slope };
                // at a knot of straight lines the slope is that of the next piece
                prop_assert!(part == 40 || along > -1e-12, "slope {slope} at {at}");
            }
        }
    }

    #[test]
    fn slopes_of_maps_agree_with_differences(
        (x, _) in points(), (y, _) in points(), seed in proptest::collection::vec(-10.0..10.0, 64), shares in [0.0..1.0, 0.0..1.0],
    ) {
        let z: Vec<f64> = seed[..x.len() * y.len()].to_vec();
        let map = Table2::new(x.clone(), y.clone(), z, Outside::Hold).unwrap();
        let (a, b, step) = (along(&x, shares[0]), along(&y, shares[1]), 1e-4);
        prop_assume!(x.iter().all(|knot| (knot - a).abs() > step) && y.iter().all(|knot| (knot - b).abs() > step));
        let value = |a, b| map.value_and_slopes(a, b).unwrap().0;
        let (_, [in_a, in_b]) = map.value_and_slopes(a, b).unwrap();
        prop_assert!((in_a - (value(a + step, b) - value(a - step, b)) / (2.0 * step)).abs() < 1e-7 * (1.0 + in_a.abs()));
        prop_assert!((in_b - (value(a, b + step) - value(a, b - step)) / (2.0 * step)).abs() < 1e-7 * (1.0 + in_b.abs()));
    }
}

/// Straight lines by hand: `y = x^2` at whole numbers, held outside; the piece may be any number.
#[test]
fn a_piece_of_the_last_call_changes_no_value() {
    let squares = linear(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 4.0, 9.0], Outside::Hold);
    let expected = [(-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.5, 0.5, 1.0), (1.0, 1.0, 3.0)];
    let beyond = [(2.25, 5.25, 5.0), (3.0, 9.0, 5.0), (4.0, 9.0, 0.0), (1.5, 2.5, 3.0)];
    for stale in [0, 1, 2, 3, usize::MAX] {
        for (x, value, slope) in expected.into_iter().chain(beyond) {
            let mut piece = stale;
            let found = squares.value_and_slope_near(x, &mut piece);
            assert_eq!(found, Some((value, slope)), "{x} from piece {stale}");
            assert_eq!(squares.value_and_slope_near(x, &mut piece), found, "{x} again");
        }
        assert_eq!(squares.value_and_slope_near(f64::NAN, &mut { stale }), None);
    }
}
