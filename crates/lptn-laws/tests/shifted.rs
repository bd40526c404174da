//! Gears with profile shift against printed reports and computations of their own.

use std::f64::consts::PI;

use lptn_laws::{Flanks, GearPair, Profile};
use lptn_units::{Dual, Scalar};

fn omega(rpm: f64) -> f64 {
    rpm * PI / 30.0
}

/// Teeth, module and width in mm, helix angle in degrees, shifts.
fn pair(teeth: [f64; 2], [module, width]: [f64; 2], helix: f64, shifts: [f64; 2]) -> GearPair<f64> {
    GearPair {
        teeth,
        internal: false,
        module: module * 1e-3,
        width: width * 1e-3,
        pressure: 20f64.to_radians(),
        helix: helix.to_radians(),
        profile: Profile { shifts, ..Profile::standard() },
    }
}

/// A report of GEARpie: name, teeth, module in mm, helix angle in degrees, width in mm, shifts.
type Report = (&'static str, [f64; 2], f64, f64, f64, [f64; 2]);
/// Printed there: tip radii, centre distance, T1T2, AC and AE in mm, eps_alpha, eps_beta, H_V.
type Printed = ([f64; 2], [f64; 4], [f64; 3]);

const C: [f64; 2] = [0.1817, 0.1715];
const FZG: Printed = ([41.318, 59.272], [91.5, 34.93, 9.68, 19.43], [1.46, 0.0, 0.1986]);
const SHORTER: Printed = ([41.228, 59.182], [91.5, 34.93, 9.50, 19.10], [1.44, 0.0, 0.1950]);
const EQUAL: Printed = ([32.0, 32.0], [60.0, 20.52, 4.88, 9.76], [1.65, 0.0, 0.1494]);

/// The ten files of REPORT in GEARpie (C. Fernandes, FEUP; github.com/cfernandesFEUP/GEARpie,
/// cb30c91). H501, H701 and H951 are printed with shorter tips, k = x1 + x2 - (a - a0)/m. The module
/// of H951 is 1.75 mm, printed as 1.8.
#[rustfmt::skip]
const REPORTS: [(Report, Printed); 10] = [
    (("C14", [16.0, 24.0], 4.5, 0.0, 14.0, C), FZG),
    (("C40", [16.0, 24.0], 4.5, 0.0, 40.0, C), FZG),
    (("H501", [20.0, 30.0], 3.5, 15.0, 23.0, [0.1809, 0.0891]),
        ([40.336, 58.132], [91.5, 34.45, 7.48, 15.55], [1.46, 0.54, 0.1639])),
    (("H701", [28.0, 42.0], 2.5, 15.0, 17.0, [0.2290, 0.1489]),
        ([39.276, 57.193], [91.5, 34.45, 5.49, 11.53], [1.52, 0.56, 0.1225])),
    (("H951", [38.0, 57.0], 1.75, 15.0, 21.2418, [1.6915, 2.0003]),
        ([38.115, 55.867], [91.5, 43.44, 1.98, 4.98], [0.93, 1.0, 0.0739])),
    (("MAO", [30.0, 30.0], 2.0, 0.0, 15.0, [0.0, 0.0]), EQUAL),
    (("NEW", [30.0, 30.0], 2.0, 0.0, 15.0, [0.0, 0.0]), EQUAL),
    (("REP", [16.0, 24.0], 4.5, 0.0, 14.0, C), SHORTER),
    (("REP2", [16.0, 24.0], 4.5, 0.0, 14.0, C), SHORTER),
    (("S30", [30.0, 30.0], 2.0, 0.0, 15.0, [0.0, 0.0]), EQUAL),
];

/// Checks the printed numbers to half of their last digit.
fn check(name: &str, found: GearPair<f64>, (tips, lengths, ratios): Printed) {
    let at = found.engagement();
    let step = PI * found.module * 1e3 * found.pressure.cos()
        / (1.0 - (found.helix.sin() * found.pressure.cos()).powi(2)).sqrt();
    let [e1, e2] = at.contact;
    let between = 1e3 * at.distance * at.angle.sin();
    let ac = e2 * step;
    let near = |found: f64, printed: f64, last: f64| {
        assert!((found - printed).abs() <= 0.51 * last, "{name}: {found}, printed {printed}");
    };
    near(1e3 * at.distance, lengths[0], 0.1);
    near(between, lengths[1], 0.01);
    near(ac, lengths[2], 0.01);
    near((e1 + e2) * step, lengths[3], 0.01);
    near(e1 + e2, ratios[0], 0.01);
    near(at.overlap, ratios[1], 0.01);
    near(found.loss_factor(), ratios[2], 1e-4);
    for (found, printed) in at.tip.into_iter().zip(tips) {
        near(1e3 * found, printed, 0.001);
    }
}

#[test]
fn ten_test_gears_are_as_gearpie_prints_them() {
    for ((name, teeth, module, helix, width, shifts), printed) in REPORTS {
        let of = pair(teeth, [module, width], helix, shifts);
        let reference = 0.5 * module / of.helix.cos() * (teeth[0] + teeth[1]);
        let usual = 1.0 + shifts[0];
        // the shortening that the printed tip circle has
        let tip = 0.5 * module / of.helix.cos() * teeth[0] + module * usual;
        let shortening = ((tip - printed.0[0]) / module * 1e3).round() * 1e-3;
        let keeps = shifts[0] + shifts[1] - (printed.1[0] - reference) / module;
        assert!(shortening.abs() < 1e-9 || (shortening - keeps).abs() < 6e-4, "{name}");
        let shortening = if shortening == 0.0 { 0.0 } else { keeps };
        let profile = Profile { shortening, ..of.profile };
        check(name, GearPair { profile, ..of }, printed);
        // the printed centre distance and tip circles alone give the same
        let addenda = [0, 1]
            .map(|i| Some((printed.0[i] - 0.5 * module / of.helix.cos() * teeth[i]) / module));
        let distance = Some(1e-3 * printed.1[0]);
        let alone = Profile { addenda, distance, ..Profile::standard() };
        check(name, GearPair { profile: alone, ..of }, printed);
    }
}

/// C14 as printed: 200 N m at 1500 rpm, 15.12 mm^2/s, 0.878 g/cm^3, Ra 0.4 and 0.31 um, X_L 0.85 (0.846):
/// mu after Schlenk 0.0449. The product with H_V 0.1986 and the input power is 280 W.
#[test]
fn the_friction_of_shifted_gears_is_that_at_the_working_pitch_point() {
    let c14 = pair([16.0, 24.0], [4.5, 14.0], 0.0, C);
    let oil = [15.12e-6, 878.0, 0.846];
    let friction = c14.friction(omega(1500.0), 200.0, oil, 0.355e-6);
    assert!((friction - 0.0449).abs() < 5e-5, "{friction}");
    let power = c14.power(omega(1500.0), 200.0, oil, 0.355e-6);
    assert!((power - 280.0).abs() < 0.05, "{power}");
    // H501: 100 N m at 1000 rpm, 32.67 mPa s, Ra 0.6 um, X_L 0.846; GEARpie takes the radius of
    // curvature of the transverse section, cos beta_b of that normal to the flanks
    let h501 = pair([20.0, 30.0], [3.5, 23.0], 15.0, [0.1809, 0.0891]);
    let friction = h501.friction(omega(1000.0), 100.0, [32.67e-6, 1000.0, 0.846], 0.6e-6);
    let cos_base = (1.0 - (15f64.to_radians().sin() * 20f64.to_radians().cos()).powi(2)).sqrt();
    let friction = friction / cos_base.powf(0.2);
    assert!((friction - 0.0420).abs() < 5e-5, "{friction}");
}

/// Load times sliding speed over one pitch, with equal shares of two pairs, is the power that H_V
/// stands for.
#[test]
fn the_loss_factor_is_the_integral_of_sliding_over_the_path() {
    let gears = pair([25.0, 37.0], [4.0, 20.0], 0.0, [0.35, 0.25]);
    // radii from the circles alone: the centre distance by bisection of the involute function
    let (alpha, z) = (20f64.to_radians(), [25.0, 37.0]);
    let wanted = alpha.tan() - alpha + 2.0 * alpha.tan() * 0.6 / 62.0;
    let (mut low, mut high) = (0.1_f64, 1.0_f64);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if middle.tan() - middle < wanted { low = middle } else { high = middle }
    }
    let base = z.map(|z| 2.0 * z * alpha.cos());
    let tips = [50.0 + 4.0 * 1.35, 74.0 + 4.0 * 1.25];
    let along = |i: usize| f64::sqrt(tips[i] * tips[i] - base[i] * base[i]);
    let (pitch, step) = (base[0] * low.tan(), PI * 4.0 * alpha.cos());
    let between = (base[0] + base[1]) * low.tan();
    let (start, end) = (between - along(1), along(0));
    let count = 400_000;
    let h = (end - start) / f64::from(count);
    let work: f64 = (0..count)
        .map(|i| {
            let at = start + (f64::from(i) + 0.5) * h;
            let alone = at > end - step && at < start + step;
            h * (at - pitch).abs() * if alone { 1.0 } else { 0.5 }
        })
        .sum();
    let expected = work / step * (1.0 + 25.0 / 37.0) / base[0];
    assert!((gears.loss_factor() / expected - 1.0).abs() < 1e-6, "{expected}");
}

/// A sun, planets and a ring without backlash: x_r = -x_s - 2 x_p gives both meshes one distance,
/// because inv a_w is the same.
#[test]
fn planets_are_as_far_from_sun_and_ring() {
    for [sun, planet] in [[0.3, 0.2], [-0.1, 0.4], [0.25, -0.25]] {
        let inner = pair([18.0, 42.0], [3.0, 12.0], 10.0, [sun, planet]);
        let ring = GearPair {
            internal: true,
            ..pair([42.0, 102.0], [3.0, 12.0], 10.0, [planet, -sun - 2.0 * planet])
        };
        let [a, b] = [inner, ring].map(|mesh| mesh.engagement().distance);
        assert!((a / b - 1.0).abs() < 1e-12, "{a}, {b}");
    }
}

/// Blok's formula in NumPy, written from radii of tips and base circles, at 200 001 points of the
/// path; the working pressure angle by bisection. H_V and tip contact ratios are from there too.
#[test]
fn flash_temperatures_of_shifted_gears_are_those_of_an_independent_computation() {
    let fast = ([25.0, 37.0], [4.0, 20.0], [0.35, 0.25], 3000.0, 300.0, [25e-6, 800.0, 0.4e-6]);
    let ring = ([20.0, 60.0], [3.0, 30.0], [0.3, -0.5], 1500.0, 50.0, [60e-6, 860.0, 0.5e-6]);
    let steel = Flanks { modulus: 206e9, poisson: 0.3, conductivity: 48.7, capacity: 3.8e6 };
    for ((teeth, size, shifts, rpm, torque, oil), helix, internal, [distance, flash, factor]) in [
        (
            fast,
            0.0,
            false,
            [126.254_274_513_344_81, 22.380_083_470_787_59, 0.137_692_209_514_151_87],
        ),
        (
            fast,
            12.0,
            false,
            [129.032_514_881_382_55, 22.112_948_597_589_366, 0.135_696_737_633_781_48],
        ),
        (
            ring,
            0.0,
            true,
            [60.579_550_777_967_924, 2.573_124_086_431_962_4, 0.077_082_996_964_458_83],
        ),
        (
            ring,
            15.0,
            true,
            [62.697_978_279_289_8, 3.886_710_413_293_340_8, 0.073_754_220_747_525_4],
        ),
    ] {
        let gears = GearPair { internal, ..pair(teeth, size, helix, shifts) };
        let [nu, density, roughness] = oil;
        let friction = gears.friction(omega(rpm), torque, [nu, density, 1.0], roughness);
        let found = [
            1e3 * gears.engagement().distance,
            gears.flash(omega(rpm), torque, friction, &steel),
            gears.loss_factor(),
        ];
        for (found, expected) in found.into_iter().zip([distance, flash, factor]) {
            // lptn evaluates 64 points of each stretch
            assert!((found / expected - 1.0).abs() < 1e-5, "{found}, not {expected}");
        }
    }
}

/// A centre distance that is larger than that of the shifts by 0.1 mm has the working pressure angle
/// of cos a_w = a0 cos a / a, and the shifts follow from it.
#[test]
fn a_centre_distance_decides_the_pressure_angle() {
    let c14 = pair([16.0, 24.0], [4.5, 14.0], 0.0, C);
    let distance = Some(91.6e-3);
    let wider = GearPair { profile: Profile { distance, ..c14.profile }, ..c14 }.engagement();
    let angle = (90.0 * 20f64.to_radians().cos() / 91.6).acos();
    assert!((wider.angle - angle).abs() < 1e-12 && (wider.distance - 91.6e-3).abs() < 1e-12);
    assert!((wider.free - 91.5e-3).abs() < 1e-6, "{}", wider.free);
    let involute = |angle: f64| angle.tan() - angle;
    let alpha = 20f64.to_radians();
    let sum = (involute(angle) - involute(alpha)) * 20.0 / alpha.tan();
    assert!((wider.sum - sum).abs() < 1e-12, "{}", wider.sum);
    // closer than the base circles allow, and shifts without an angle
    let distance = Some(84e-3);
    let close = GearPair { profile: Profile { distance, ..c14.profile }, ..c14 };
    assert!(close.engagement().distance.is_nan());
    assert!(pair([16.0, 24.0], [4.5, 14.0], 0.0, [-0.5, -0.5]).engagement().free.is_nan());
}

/// Slopes of power along x1 and x2 against differences, also where the shifts sum to 0.
#[test]
fn power_has_slopes_along_shifts() {
    let power = |shifts: [f64; 2]| {
        let gears = pair([16.0, 24.0], [4.5, 14.0], 12.0, shifts);
        gears.power(omega(1500.0), 200.0, [15e-6, 878.0, 1.0], 4e-7)
    };
    for shifts in [[0.1817, 0.1715], [0.0, 0.0], [0.2, -0.2]] {
        for along in 0..2 {
            let h = 1e-6;
            let moved =
                |by: f64| power([0, 1].map(|i| shifts[i] + if i == along { by } else { 0.0 }));
            let expected = (moved(h) - moved(-h)) / (2.0 * h);
            let of = Dual::<1>::from_f64;
            let seed = |i: usize| {
                let variable = Dual::variable(shifts[i], 0);
                if i == along { variable } else { of(shifts[i]) }
            };
            let still = pair([16.0, 24.0], [4.5, 14.0], 12.0, shifts);
            let gears = GearPair {
                teeth: still.teeth.map(of),
                internal: false,
                module: of(still.module),
                width: of(still.width),
                pressure: of(still.pressure),
                helix: of(still.helix),
                profile: Profile { shifts: [seed(0), seed(1)], ..Profile::standard() },
            };
            let found =
                gears.power(of(omega(1500.0)), of(200.0), [15e-6, 878.0, 1.0].map(of), of(4e-7));
            let slope = found.derivatives[0];
            assert!((slope / expected - 1.0).abs() < 1e-5, "{slope}, not {expected}");
        }
    }
}

/// ISO 21771: s_a = d_a ((pi/2 + 2 x tan a) / z + inv a - inv a_a), in a ring with the other sign of the
/// involutes. Without shift a rack of one module leaves about 0.7 modules at the tips. 24 teeth with x = 2.5 are pointed.
#[test]
fn teeth_have_the_thickness_of_the_standard_at_their_tips() {
    let alpha = 20f64.to_radians();
    let involute = |angle: f64| angle.tan() - angle;
    let expected = |z: f64, x: f64, side: f64| {
        let tip = 0.5 * z + side * (1.0 + x);
        let angle = (0.5 * z * alpha.cos() / tip).acos();
        let turn = side * (involute(alpha) - involute(angle));
        2.0 * tip * ((0.5 * PI + 2.0 * x * alpha.tan()) / z + turn)
    };
    for (x1, x2) in [(0.0, 0.0), (0.1817, 0.1715), (-0.2, 2.5)] {
        let gears = pair([20.0, 60.0], [2.0, 10.0], 0.0, [x1, x2]);
        let [first, second] = gears.engagement().thickness.map(|length| length / 2e-3);
        assert!((first - expected(20.0, x1, 1.0)).abs() < 1e-9, "{first}");
        assert!((second - expected(60.0, x2, 1.0)).abs() < 1e-9, "{second}");
        let ring = GearPair { internal: true, ..pair([20.0, 60.0], [2.0, 10.0], 0.0, [x1, -0.1]) };
        let inner = ring.engagement().thickness[1] / 2e-3;
        assert!((inner - expected(60.0, -0.1, -1.0)).abs() < 1e-9, "{inner}");
    }
    let pointed = pair([16.0, 24.0], [4.5, 14.0], 0.0, [0.1817, 2.5]).engagement();
    assert!(pointed.thickness[1] < 0.0 && pointed.thickness[0] > 0.0);
}
