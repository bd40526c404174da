//! Flash temperatures of gears against computations of their own.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_laws::{Flanks, GearPair, Profile};

const STEEL: Flanks<f64> =
    Flanks { modulus: 206e9, poisson: 0.3, conductivity: 48.7, capacity: 3.8e6 };

/// Teeth, module and width in mm, helix angle in degrees, whether in a ring.
fn pair(teeth: [f64; 2], [module, width]: [f64; 2], helix: f64, internal: bool) -> GearPair<f64> {
    GearPair {
        teeth,
        internal,
        module: module * 1e-3,
        width: width * 1e-3,
        pressure: 20f64.to_radians(),
        helix: helix.to_radians(),
        profile: Profile { addenda: [None, internal.then_some(0.7)], ..Profile::standard() },
    }
}

fn omega(rpm: f64) -> f64 {
    rpm * std::f64::consts::PI / 30.0
}

fn flash(pair: &GearPair<f64>, rpm: f64, torque: f64, oil: [f64; 3], roughness: f64) -> f64 {
    let friction = pair.friction(omega(rpm), torque, oil, roughness);
    pair.flash(omega(rpm), torque, friction, &STEEL)
}

/// Blok's formula in NumPy, written from the radii of the tips, at 200 001 points of the path.
#[test]
fn the_highest_flash_temperature_is_that_of_an_independent_computation() {
    let fast = ([25.0, 37.0], 3000.0, 300.0, [25e-6, 800.0, 1.0], 0.4e-6);
    let slow = ([20.0, 60.0], 1500.0, 50.0, [60e-6, 860.0, 1.0], 0.5e-6);
    for ((teeth, rpm, torque, oil, roughness), size, helix, ring, expected) in [
        (fast, [4.0, 20.0], 0.0, false, 34.016_353_273_842_846),
        (fast, [4.0, 20.0], 12.0, false, 32.769_435_158_368_07),
        (fast, [4.0, 40.0], 25.0, false, 23.293_858_678_171_83),
        (slow, [3.0, 30.0], 0.0, false, 7.752_081_668_926_867),
        (slow, [3.0, 30.0], 0.0, true, 2.754_162_959_827_426),
    ] {
        let found = flash(&pair(teeth, size, helix, ring), rpm, torque, oil, roughness);
        assert!((found - expected).abs() < 1e-6 * expected, "{found}, not {expected}");
    }
}

/// ISO/TR 13989-1, equation 5, with its X_M = 50 for steel of 206 GPa, as an implementation of it
/// prints it: 2.52 mu (X w)^0.75 sqrt(n/60) abs(sqrt(rho1) - sqrt(rho2/u)) / rho^0.25, in N/mm and mm.
/// Its constants agree with Blok's to one in a hundred.
#[test]
fn it_agrees_with_the_constants_of_the_technical_report() {
    let (mu, w, [rho1, rho2], u, n) = (0.05, 250.0_f64, [6.0_f64, 24.0_f64], 1.5, 2000.0_f64);
    let rho = rho1 * rho2 / (rho1 + rho2);
    let report =
        2.52 * mu * w.powf(0.75) * (n / 60.0).sqrt() * (rho1.sqrt() - (rho2 / u).sqrt()).abs()
            / rho.powf(0.25);
    let speeds = [rho1, rho2 / u].map(|radius| omega(n) * radius * 1e-3);
    let found = STEEL.flash(mu, w * 1e3, rho * 1e-3, speeds);
    assert!((found / report - 1.0).abs() < 0.011, "{found}, {report}");
}

/// The hottest point of a band that is heated as Hertz presses it, on a half-space that runs past it
/// fast: T(x) = 1 / (B sqrt(pi v)) of the integral of q(s) / sqrt(x - s); both bodies alike.
#[test]
fn the_factor_of_1_11_follows_from_the_moving_band() {
    let rise = |x: f64| {
        let (count, to) = (20_000, (1.0 + x).sqrt());
        let h = to / f64::from(count);
        // s = x - r^2 takes the root away
        let at = |i: i32| (1.0 - (x - ((f64::from(i) + 0.5) * h).powi(2)).powi(2)).max(0.0).sqrt();
        2.0 * h * (0..count).map(at).sum::<f64>()
    };
    let most = (0..1000).map(|i| rise(f64::from(i) * 1e-3)).fold(0.0, f64::max);
    // q0 = 4 / pi of the mean Q / (2 b), over the whole width 2 b
    let pi = std::f64::consts::PI;
    let factor = 2f64.sqrt() * 4.0 / pi / 2.0 / pi.sqrt() * most;
    assert!((factor - 1.11).abs() < 0.002, "{factor}");
}

#[test]
fn at_rest_without_load_and_reversed_it_is_finite() {
    let pair = pair([25.0, 37.0], [4.0, 20.0], 0.0, false);
    let at = |rpm, torque| flash(&pair, rpm, torque, [25e-6, 800.0, 1.0], 0.4e-6);
    for rise in [at(0.0, 300.0), at(3000.0, 0.0), at(0.0, 0.0)] {
        assert!(rise == 0.0, "{rise}");
    }
    let ahead = at(3000.0, 300.0);
    for (rpm, torque) in [(-3000.0, 300.0), (3000.0, -300.0), (-3000.0, -300.0)] {
        assert_eq!(at(rpm, torque).to_bits(), ahead.to_bits());
    }
    // mu is held at 0.2 near rest, so that it goes with the square root of the speed
    assert!((at(4e-9, 300.0) / at(1e-9, 300.0) - 2.0).abs() < 1e-9);
}

/// 8 teeth with a rack's addendum: the path of contact would begin below the base circle.
#[test]
fn where_no_involute_is_there_is_no_flash_temperature() {
    let undercut = pair([8.0, 60.0], [3.0, 30.0], 0.0, false);
    assert!(undercut.flash(omega(1500.0), 50.0, 0.05, &STEEL).is_nan());
}
