//! Films of spheres, discs, jets and gaps, against printed examples, the library ht, sums of local
//! values and numbers by hand.

use lptn_laws::{
    nusselt_disc, nusselt_gap_from_below, nusselt_gap_vertical, nusselt_jet,
    nusselt_sphere_at_rest, nusselt_sphere_in_flow,
};

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} is not {expected}");
}

/// Incropera, 6th edition, example 7.6: a copper sphere of 10 mm in air at 10 m/s, Re = 6510, Pr =
/// 0.708, mu/mu_s = 181.6/197.8: 47.4. Without the factor of the viscosities the bracket is 2.2 %
/// larger.
#[test]
fn sphere_of_copper_in_air() {
    let found = nusselt_sphere_in_flow(6510.0, 0.708);
    near(2.0 + (found - 2.0) * (181.6_f64 / 197.8).powf(0.25), 47.4, 0.005);
}

/// A sphere at rest without buoyancy conducts to infinity: Nu = 2, the closed form.
#[test]
fn sphere_at_rest_conducts() {
    near(nusselt_sphere_at_rest(0.0, 0.7), 2.0, 1e-15);
    // the library ht (Caleb Bell): Nu_sphere_Churchill(.7, 1E7) = 25.670869440317578, with Churchill's
    // factor (1 + 7.44e-8 Ra / (1 + (0.469/Pr)^(9/16))^(16/9))^(1/12), which Incropera leaves out
    let weight = (1.0 + (0.469_f64 / 0.7).powf(9.0 / 16.0)).powf(16.0 / 9.0);
    let factor = (1.0 + 7.44e-8 * 7e6 / weight).powf(1.0 / 12.0);
    let found = nusselt_sphere_at_rest(0.7 * 1e7, 0.7);
    near(2.0 + (found - 2.0) * factor, 25.670_869_440_317_578, 1e-12);
}

/// The sum of the local values at 200 000 midpoints of the radius, at Re = 1e5, 2.2e5 and 1e6. It
/// checks the integral, not the constants. Far from the transition the means of Cobb and Saunders,
/// 0.36 Re^(1/2) and 0.015 Re^0.8, are within 6 %.
#[test]
fn mean_of_a_disc_is_that_of_its_local_values() {
    let local = |re: f64| match re {
        re if re < 1.95e5 => 0.340 * re.sqrt(),
        re if re < 2.5e5 => 1e-19 * re.powi(4),
        re => 0.0188 * re.powf(0.8),
    };
    for re in [1e5_f64, 2.2e5, 1e6] {
        // midpoints over r/R: Nu_mean = 2 times the integral of Nu(r) over r/R
        let n = 200_000;
        let mean: f64 = (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|x| 2.0 * local(re * x * x) / f64::from(n))
            .sum();
        near(nusselt_disc(re), mean, 1e-4);
    }
    near(nusselt_disc(1e5), 0.36 * 1e5_f64.sqrt(), 0.06);
    near(nusselt_disc(2e6), 0.015 * 2e6_f64.powf(0.8), 0.06);
}

/// By hand from the printed equations at D = 10 mm, H = 50 mm, r = 40 mm, Re = 20 000, Pr = 0.7:
/// a = 0.125, G = 0.25 * 0.725 / (1 - 0.2 * 0.125) = 0.185897.
#[test]
fn jet_of_martin() {
    let flow = 2.0 * (20_000.0_f64 * (1.0 + 0.005 * 20_000.0_f64.powf(0.55))).sqrt();
    near(
        nusselt_jet(20_000.0, 0.7, 5.0, 0.25),
        0.185_897_435_897_436 * flow * 0.7_f64.powf(0.42),
        1e-12,
    );
}

/// A layer is stable below Ra = 1708.
#[test]
fn gap_from_below() {
    near(nusselt_gap_from_below(1708.0), 1.0, 1e-15);
    near(nusselt_gap_from_below(100.0), 1.0, 1e-15);
    // by hand: 1 + 1.44 (1 - 0.01708) + (17.1527)^(1/3) - 1
    // the library ht has the later form of Hollands (1984), 3.960976 for air at Ra = 1e5
    near(nusselt_gap_from_below(1e5), 3.960_976, 0.01);
    near(nusselt_gap_from_below(1e5), 1.44 * (1.0 - 0.017_08) + (1e5_f64 / 5830.0).cbrt(), 1e-12);
}

/// A still gap conducts; at Ra = 1e6 and a = 20 the third formula is 5.2 by hand, the first 6.05.
#[test]
fn gap_between_walls() {
    near(nusselt_gap_vertical(10.0, 20.0), 1.0, 1e-6);
    near(nusselt_gap_vertical(1e6, 20.0), 6.05, 1e-12);
    near(nusselt_gap_vertical(1e4, 10.0), 0.242 * 1e3_f64.powf(0.272), 1e-12);
}
