//! Foster and Cauer: one into the other against mpmath, closed forms and each other.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use lptn_network::{Cauer, Foster, LadderError};

/// Relative differences of both columns, at most.
fn apart(found: &[(f64, f64)], expected: &[(f64, f64)]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let pairs = found.iter().zip(expected);
    let each = pairs.flat_map(|(f, e)| [(f.0 / e.0 - 1.0).abs(), (f.1 / e.1 - 1.0).abs()]);
    each.fold(0.0, |most, x| if x <= most { most } else { x })
}

fn near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() <= part * expected.abs(), "{found:e}, not {expected:e}");
}

fn geometric(count: usize, first: f64, ratio: f64) -> Vec<f64> {
    std::iter::successors(Some(first), |tau| Some(tau * ratio)).take(count).collect()
}

/// The chains of `tools/ladder.py`, bit by bit.
fn chains() -> [(&'static str, Foster); 4] {
    let steps = (0..100).map(|k| 1.0 + 0.01 * f64::from(k)).collect();
    [
        ("decades_8", geometric(200, 1e-4, 1.0969858)),
        ("decades_16", geometric(200, 1e-8, 1.2033777)),
        ("close_steps", steps),
        ("close_ratio", geometric(100, 1.0, 1.02)),
    ]
    .map(|(name, taus): (_, Vec<f64>)| {
        let resistance = |k: usize| f64::from(u32::try_from(1 + 7 * k % 11).unwrap()) / 8.0;
        let terms = taus.into_iter().enumerate().map(|(k, tau)| (resistance(k), tau));
        (name, Foster::new(0.0, &terms.collect::<Vec<_>>()).unwrap())
    })
}

/// The rungs of a case of `tools/ladder.py`: long division with 2200 digits.
fn reference(case: &str) -> Vec<(f64, f64)> {
    let rows = include_str!("ladder.csv").lines().filter_map(|line| line.strip_prefix(case));
    let number = |text: Option<&str>| text.unwrap().parse::<f64>().unwrap();
    rows.map(|row| {
        let mut cells = row.split(',').skip(1);
        (number(cells.next()), number(cells.next()))
    })
    .collect()
}

#[test]
fn a_ladder_has_the_elements_of_exact_arithmetic() {
    for (name, foster) in chains() {
        let found = foster.cauer().unwrap();
        assert!(found.rungs.iter().all(|rung| rung.0 > 0.0 && rung.1 > 0.0), "{name}");
        let error = apart(&found.rungs, &reference(name));
        assert!(error < 1e-13, "{name}: {error:e}");
    }
}

/// The way back alone: from elements that mpmath rounded.
#[test]
fn a_chain_has_the_terms_that_exact_elements_came_from() {
    for (name, foster) in chains() {
        let found = Cauer::new(reference(name), 0.0).unwrap().foster().unwrap();
        let error = apart(&found.terms, &foster.terms);
        assert!(error < 2e-13, "{name}: {error:e}");
    }
}

#[test]
fn there_and_back_is_where_one_was() {
    for (name, foster) in chains() {
        let ladder = foster.cauer().unwrap();
        let back = ladder.foster().unwrap();
        let error = apart(&back.terms, &foster.terms);
        assert!(error < 2e-13, "{name}: {error:e}");
        let error = apart(&back.cauer().unwrap().rungs, &ladder.rungs);
        assert!(error < 2e-13, "{name}: {error:e}");
    }
}

/// Each by its own formula: neither the continued fraction nor the contour knows the poles.
#[test]
fn chain_and_ladder_are_one_impedance() {
    for (name, foster) in chains() {
        let ladder = foster.cauer().unwrap();
        near(ladder.resistance(), foster.resistance(), 1e-13);
        for tenth in -120..100 {
            let x = 10_f64.powf(f64::from(tenth) / 10.0);
            let (a, b) = (ladder.impedance(x), foster.impedance(x));
            assert!((a - b).norm() <= 1e-13 * b.norm(), "{name}: {a} and {b} at {x:e} rad/s");
            near(ladder.step(x), foster.step(x), 1e-12);
        }
    }
}

/// n rungs of 1 J/K and 1 K/W: rates `4 sin^2 a`, weights `4/(2n+1) cos^2 a`,
/// `a = (2k-1) pi/(4n+2)`. Where 3 divides 2n+1 a rate is 1, and pivots of the factorisation
/// vanish.
#[test]
fn equal_rungs_are_a_closed_form() {
    for n in [1_u32, 2, 3, 4, 7, 10, 13, 40] {
        let rungs = vec![(1.0, 1.0); usize::try_from(n).unwrap()];
        let found = Cauer::new(rungs.clone(), 0.0).unwrap().foster().unwrap();
        let term = |k: u32| {
            let a = f64::from(2 * k - 1) * PI / f64::from(4 * n + 2);
            let rate = 4.0 * a.sin().powi(2);
            (4.0 / f64::from(2 * n + 1) * a.cos().powi(2) / rate, 1.0 / rate)
        };
        let expected: Vec<(f64, f64)> = (1..=n).rev().map(term).collect();
        let error = apart(&found.terms, &expected);
        assert!(error < 1e-13, "{n} rungs: {error:e}");
        assert!(apart(&found.cauer().unwrap().rungs, &rungs) < 1e-13, "{n} rungs");
    }
}

/// Rungs of 2 J/K, 0.5 K/W and 8 J/K, 1.5 K/W behind 0.25 K/W, by mpmath: the continued fraction
/// and its inverse Laplace transform in 40 digits, the roots of `12 s^2 + 16 s + 1`.
#[test]
fn two_rungs_behind_a_resistance() {
    let ladder = Cauer::new(vec![(2.0, 0.5), (8.0, 1.5)], 0.25).unwrap();
    let chain = ladder.foster().unwrap();
    near(chain.terms[0].1, 0.788_897_449_072_021_4, 1e-15);
    near(chain.terms[1].1, 15.211_102_550_927_98, 1e-15);
    let slow = |omega: f64| [ladder.impedance(omega), chain.impedance(omega)];
    for z in slow(0.1) {
        near(z.re, 0.25 + 0.815_738_963_531_669_9, 1e-15);
        near(z.im, -0.801_343_570_057_581_6, 1e-15);
    }
    for z in slow(2.0) {
        near(z.re, 0.25 + 0.089_699_969_068_976_18, 1e-15);
        near(z.im, -0.194_246_829_570_058_8, 1e-15);
    }
    for (time, rise) in [
        (0.01, 0.004_975_103_837_640_019),
        (1.0, 0.328_051_722_587_498_4),
        (20.0, 1.545_294_516_222_39),
    ] {
        near(ladder.step(time), 0.25 + rise, 1e-13);
        near(chain.step(time), 0.25 + rise, 1e-14);
    }
    for (before, at) in [(ladder.step(-1.0), ladder.step(0.0)), (chain.step(-1.0), chain.step(0.0))]
    {
        assert_eq!((before.to_bits(), at.to_bits()), (0, 0.25_f64.to_bits()));
    }
    near(ladder.resistance(), 2.25, 1e-15);
    near(chain.resistance(), 2.25, 1e-15);
    near(chain.cauer().unwrap().direct, 0.25, 0.0);
    assert!(apart(&chain.cauer().unwrap().rungs, &ladder.rungs) < 1e-15);
}

/// One term: at `1/tau` the amplitude is that of the steady state over the root of two and lags by
/// 45 degrees; long before `tau` the rise is `t/C`.
#[test]
fn one_term_is_one_rung() {
    let chain = Foster::new(0.0, &[(0.5, 20.0)]).unwrap();
    let ladder = chain.cauer().unwrap();
    assert!(apart(&ladder.rungs, &[(40.0, 0.5)]) < 1e-15);
    assert!(apart(&ladder.foster().unwrap().terms, &chain.terms) < 1e-15);
    for z in [chain.impedance(0.05), ladder.impedance(0.05)] {
        near(z.norm(), 0.5 * FRAC_1_SQRT_2, 1e-15);
        near(z.arg(), -PI / 4.0, 1e-15);
    }
    near(chain.step(1e-20), 1e-20 / 40.0, 1e-15);
    near(ladder.step(1e-20), 1e-20 / 40.0, 1e-13);
    // far above every number's root: no overflow
    near(chain.impedance(1e200).im, -1.0 / (40.0 * 1e200), 1e-15);
}

/// R-tau table of an IGBT module (T. Schütze, Thermal equivalent circuit models, Infineon AN2008-03
/// (2008), page 4: sum 8.51 K/kW). The note prints a curve but no values of it: those here are
/// its formula in 40 digits, the ladder long division, both by mpmath.
#[test]
fn a_published_table_has_its_curve_and_ladder() {
    let table = [(1.56e-3, 0.0068), (4.25e-3, 0.0642), (1.26e-3, 0.3209), (1.44e-3, 2.0212)];
    let chain = Foster::new(0.0, &table).unwrap();
    let ladder = chain.cauer().unwrap();
    near(chain.resistance(), 8.51e-3, 1e-15);
    let curve = [
        (1e-4, 2.985_192_741_627_183e-5),
        (1e-3, 2.836_597_019_488_196e-4),
        (0.01, 1.860_305_591_783_28e-3),
        (0.1, 5.321_671_193_851_467e-3),
        (1.0, 7.576_154_727_170_172e-3),
        (10.0, 8.499_774_930_640_9e-3),
    ];
    for (time, rise) in curve {
        near(chain.step(time), rise, 1e-14);
        near(ladder.step(time), rise, 1e-13);
    }
    let rungs = [
        (3.330_557_352_151_412, 2.591_953_204_273_97e-3),
        (14.148_100_399_046_97, 3.820_997_929_384_445e-3),
        (308.969_448_225_003_4, 1.187_922_959_199_063e-3),
        (1_818.344_183_769_279, 9.091_259_071_425_215e-4),
    ];
    assert!(apart(&ladder.rungs, &rungs) < 1e-14, "{:?}", ladder.rungs);
    let z = ladder.impedance(10.0);
    near(z.re, 4.677_428_804_539_462e-3, 1e-14);
    near(z.im, -2.466_694_751_544_714e-3, 1e-14);
}

#[test]
fn rows_come_in_any_order_and_equal_time_constants_are_one() {
    let chain = Foster::new(0.1, &[(1.0, 5.0), (2.0, 0.5), (0.25, 5.0), (4.0, 50.0)]).unwrap();
    assert_eq!(chain.terms, [(2.0, 0.5), (1.25, 5.0), (4.0, 50.0)]);
    assert_eq!(chain.cauer().unwrap().rungs.len(), 3);
}

/// Any table: positive elements, and back again. The generator is that of Knuth's MMIX.
#[test]
fn random_tables_come_back() {
    let mut state = 17_u64;
    let mut random = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).unwrap()) / f64::from(u32::MAX)
    };
    for round in 0..300 {
        let terms: Vec<(f64, f64)> = (0..2 + round % 29)
            .map(|_| (10_f64.powf(6.0 * random() - 3.0), 10_f64.powf(10.0 * random() - 6.0)))
            .collect();
        let chain = Foster::new(0.0, &terms).unwrap();
        let ladder = chain.cauer().unwrap();
        let apart = apart(&ladder.foster().unwrap().terms, &chain.terms);
        assert!(apart < 1e-10, "{apart:e}: {terms:?}");
    }
}

/// Every rung half of the one before: the port does not feel the last, by 10^-6000. What is left
/// out makes no difference.
#[test]
fn rungs_that_the_port_cannot_feel_have_no_term() {
    let rungs: Vec<(f64, f64)> = (0..200).map(|k| (0.5_f64.powi(k), 1.0)).collect();
    let ladder = Cauer::new(rungs, 0.0).unwrap();
    let chain = ladder.foster().unwrap();
    assert!((20..200).contains(&chain.terms.len()), "{}", chain.terms.len());
    near(chain.resistance(), 200.0, 1e-14);
    for exponent in -4..4 {
        let x = 10_f64.powi(exponent);
        near(chain.step(x), ladder.step(x), 1e-12);
        assert!(
            (chain.impedance(x) - ladder.impedance(x)).norm() < 1e-13 * chain.impedance(x).norm()
        );
    }
}

/// Time constants that agree in 8 digits keep what they are together.
#[test]
fn close_time_constants_are_told_apart_or_refused() {
    let pair = |gap: f64| Foster::new(0.0, &[(1.0, 0.1), (2.0, 1.0), (3.0, 1.0 + gap), (1.0, 7.0)]);
    let back = |gap: f64| pair(gap).unwrap().cauer().unwrap().foster();
    assert!(apart(&back(1e-3).unwrap().terms, &pair(1e-3).unwrap().terms) < 1e-11);
    assert!(apart(&back(1e-6).unwrap().terms, &pair(1e-6).unwrap().terms) < 1e-8);
    for gap in [1e-12, 1e-14, f64::EPSILON] {
        let refused = back(gap).unwrap_err();
        assert!(matches!(refused, LadderError::Close { error } if error > 1e-8), "{refused}");
        assert_eq!(refused.code(), "ladder::close");
        assert!(refused.to_string().starts_with("time constants of the ladder are too close"));
    }
}

#[test]
fn elements_beyond_numbers_are_refused() {
    let taus = (0..300).map(|k| (1.0, 1.0 + 0.003 * f64::from(k)));
    let refused = Foster::new(0.0, &taus.collect::<Vec<_>>()).unwrap().cauer().unwrap_err();
    assert_eq!(refused, LadderError::Range { form: "Cauer ladder" });
    assert_eq!(refused.code(), "ladder::range");
    let refused = Cauer::new(vec![(1e200, 1e200)], 0.0).unwrap().foster().unwrap_err();
    assert_eq!(refused, LadderError::Range { form: "Foster chain" });
}

#[test]
fn what_is_no_chain_or_ladder_is_refused() {
    let empty = Foster::new(0.5, &[]).unwrap_err();
    assert_eq!(
        (empty.code(), &*empty.to_string()),
        ("ladder::empty", "the Foster chain has no terms")
    );
    let empty = Cauer::new(Vec::new(), 0.5).unwrap_err();
    assert_eq!(empty.to_string(), "the Cauer ladder has no rungs");
    for (value, says) in [(0.0, "0"), (-0.1, "-0.1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let end = format!("of row 2 must be positive and finite, got {says}");
        let texts = [
            ("resistance", Foster::new(0.0, &[(1.0, 1.0), (value, 2.0)]).unwrap_err()),
            ("time constant", Foster::new(0.0, &[(1.0, 1.0), (1.0, value)]).unwrap_err()),
            ("capacity", Cauer::new(vec![(1.0, 1.0), (value, 2.0)], 0.0).unwrap_err()),
            ("resistance", Cauer::new(vec![(1.0, 1.0), (1.0, value)], 0.0).unwrap_err()),
        ];
        for (what, error) in texts {
            assert_eq!(error.code(), "ladder::not_positive");
            assert_eq!(error.to_string(), format!("the {what} {end}"));
        }
    }
    for value in [-0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(Foster::new(value, &[(1.0, 1.0)]).unwrap_err().code(), "ladder::direct");
        assert_eq!(Cauer::new(vec![(1.0, 1.0)], value).unwrap_err().code(), "ladder::direct");
    }
}
