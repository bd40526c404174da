//! Losses against published identities and values, and where they usually break.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::PI;

use lptn_laws::{
    Carries, Formula, GearPair, Profile, SkfBearing, bearing_no_load, gear_loss_factor, lip_seal,
    mesh_friction, shaft_seal, viscosity_at_100,
};
use lptn_units::{Dual, parse_quantity};

fn omega(rpm: f64) -> f64 {
    rpm * PI / 30.0
}

#[test]
fn a_bearing_without_load_is_the_power_that_iso_14179_prints() {
    for (rpm, nu, d_m) in [(1500.0, 60.0, 60.0), (7000.0, 12.0, 45.0), (300.0, 220.0, 110.0_f64)] {
        let found = bearing_no_load(d_m * 1e-3, 1.5, nu * 1e-6, omega(rpm));
        // in kW, with 9549 for 30000/pi
        let product: f64 = nu * rpm;
        let printed = 1e-10 * 1.5 * d_m.powi(3) * product.powf(2.0 / 3.0) * rpm / 9549.0;
        assert!((found / (1e3 * printed) - 1.0).abs() < 4e-5, "{found} and {printed} kW");
    }
}

#[test]
fn the_branches_of_a_bearing_meet() {
    // at nu n = 160^1.5, and not at the 2000 that is printed
    let at = |product: f64| bearing_no_load(0.06, 1.0, 1e-6, omega(product)) / product;
    let meet = 160f64.powf(1.5);
    assert!((at(meet * (1.0 + 1e-9)) / at(meet * (1.0 - 1e-9)) - 1.0).abs() < 1e-8);
    assert!((at(2000.0) / at(100.0) - 1.0).abs() < 1e-12);
    assert!((at(8.0 * meet) / at(meet) - 4.0).abs() < 1e-9);
}

#[test]
fn seals_of_50_mm_at_1000_rpm() {
    let speed = omega(1000.0);
    let seals = [
        (shaft_seal(0.05, speed), 19.2),
        (lip_seal(3.737e-3, 0.05, speed), 19.6),
        (lip_seal(2.429e-3, 0.05, speed), 12.7),
    ];
    for (found, printed) in seals {
        assert!((found - printed).abs() < 0.05, "{found} is not {printed}");
    }
    // the two standards agree at 50.9 mm
    let both = [shaft_seal(0.0509, speed), lip_seal(3.737e-3, 0.0509, speed)];
    assert!((both[0] / both[1] - 1.0).abs() < 1e-3);
}

#[test]
fn the_viscosity_index_is_that_of_the_standards_examples() {
    // ASTM D2270, 5.1.4 and 6.1.4
    for (nu_40, nu_100, index) in [(73.30, 8.86, 92.43), (22.83, 5.05, 156.37)] {
        let found = viscosity_at_100(nu_40, index).unwrap();
        assert!((found - nu_100).abs() < 1e-3, "{found}");
    }
    // an oil of the index 0 or 100 stands in the table: 7.00 mm^2/s has L = 78.00 and H = 48.57
    assert!((viscosity_at_100(78.0, 0.0).unwrap() - 7.0).abs() < 1e-9);
    assert!((viscosity_at_100(48.57, 100.0).unwrap() - 7.0).abs() < 1e-9);
    assert!((viscosity_at_100(4839.0, 0.0).unwrap() - 69.5).abs() < 1e-9);
    for (nu_40, index) in [(220.0, 1e5), (220.0, -1e5), (1.0, 95.0), (f64::NAN, 95.0)] {
        assert_eq!(viscosity_at_100(nu_40, index), None);
    }
}

#[test]
fn a_ring_loses_less_than_a_wheel_by_its_factor() {
    let factor = |internal| gear_loss_factor([20.0, 60.0], internal, 1.0, [0.8, 0.9]);
    assert!((factor(true) / factor(false) - 0.5).abs() < 1e-15);
    // the least of 1 - e1 - e2 + e1^2 + e2^2 is 1/2
    let least = gear_loss_factor([20.0, 60.0], false, 1.0, [0.5, 0.5]);
    assert!((least - PI * 4.0 / 60.0 * 0.5).abs() < 1e-15);
}

#[test]
fn friction_of_a_mesh_is_bounded_at_rest_and_else_as_printed() {
    let at = |speed: f64| mesh_friction([50.0, speed, 8.0], 50.0, 0.5, 1.0);
    let printed =
        0.048 * (50.0 / (3.0 * 8.0_f64)).powf(0.2) * 50f64.powf(-0.05) * 0.5_f64.powf(0.25);
    assert!((at(3.0) - printed).abs() < 1e-15);
    assert!((at(0.0) - 0.2).abs() < 1e-15 && (at(1e-9) - 0.2).abs() < 1e-15);
    // it comes to the bound without a jump
    let rest = printed / (1.0_f64 / 3.0).powf(0.2);
    let meets = (rest / 0.2).powi(5);
    assert!((at(meets * 1.000_001) - 0.2).abs() < 1e-6);
}

/// Spur gears of 20 degrees without shift have the contact ratio of the tables.
#[test]
fn the_loss_of_a_mesh_grows_with_torque_as_it_is_printed() {
    let pair = GearPair {
        teeth: [20.0, 60.0],
        internal: false,
        module: 3e-3,
        width: 0.03,
        pressure: 20f64.to_radians(),
        helix: 0.0,
        profile: Profile::standard(),
    };
    let power = |torque: f64, rpm: f64| pair.power(omega(rpm), torque, [60e-6, 860.0, 1.0], 5e-7);
    assert!((power(100.0, 1500.0) / power(50.0, 1500.0) - 2f64.powf(1.2)).abs() < 1e-12);
    assert!((power(50.0, 3000.0) / power(50.0, 1500.0) - 2f64.powf(0.8)).abs() < 1e-12);
}

/// Reports that GEARpie (C. Fernandes, FEUP) prints: teeth, AC and AE of the path of contact and base
/// pitches in mm, and H_V after Ohlendorf, of the gears C40, H501 and H701.
#[test]
fn factors_of_gear_loss_are_those_that_gearpie_prints() {
    for (teeth, [ac, ae], [normal, transverse], printed) in [
        ([16.0, 24.0], [9.68, 19.43], [13.285, 13.285], 0.1986),
        ([20.0, 30.0], [7.48, 15.55], [10.332, 10.652], 0.1639),
        ([28.0, 42.0], [5.49, 11.53], [7.380, 7.609], 0.1225),
    ] {
        let contact = [(ae - ac) / transverse, ac / transverse];
        let found = gear_loss_factor(teeth, false, normal / transverse, contact);
        assert!((found - printed).abs() < 1e-4, "{found} is not {printed}");
    }
}

/// Gear C40: F_bt 6370.7 N over 40 mm, base radii 33.829 and pitch radii 36.600 and 54.900 mm, v_t
/// 6.90 m/s, 49.85 mPa s, Ra 0.4 and 0.31 um, X_L 0.65.
#[test]
fn the_friction_of_a_mesh_is_that_which_gearpie_prints() {
    let sine = (1.0 - (33.829_f64 / 36.6).powi(2)).sqrt();
    let radius = sine / (1.0 / 36.6 + 1.0 / 54.9);
    let at = [6370.7 / 40.0, 2.0 * 6.90 * sine, radius];
    let found = mesh_friction(at, 49.85, 0.355, 0.65);
    assert!((found - 0.0256).abs() < 5e-5, "{found}");
}

/// Gear S30: two of 30 teeth and 2 mm without shift: its H_V from the teeth alone is 0.1494.
#[test]
fn the_loss_of_a_pair_is_its_friction_times_the_factor_that_gearpie_prints() {
    let angle = 20f64.to_radians();
    let pair = GearPair {
        teeth: [30.0, 30.0],
        internal: false,
        module: 2e-3,
        width: 0.01,
        pressure: angle,
        helix: 0.0,
        profile: Profile::standard(),
    };
    let found = pair.power(omega(1000.0), 10.0, [60e-6, 860.0, 1.0], 5e-7);
    let load = 10.0 / (0.03 * angle.cos()) / 10.0;
    let at = [load, 2.0 * omega(1000.0) * 0.03 * angle.sin(), 15.0 * angle.sin()];
    let friction = mesh_friction(at, 60.0 * 0.86, 0.5, 1.0);
    let factor = found / (omega(1000.0) * 10.0 * friction);
    assert!((factor - 0.1494).abs() < 5e-5, "{factor}");
}

/// Gear-Calculation (C. Fernandes, FEUP), run for a bearing of 30 x 90 mm with K_Z 5.1: phi_bl, and
/// phi_ish phi_rs (nu n)^0.6; and the drag of one of 40 x 90 mm in N mm.
#[test]
fn the_factors_of_the_skf_model_are_those_of_another_program() {
    let of = |rolling: f64, boundary: f64| SkfBearing {
        bore: 0.03,
        outer: 0.09,
        radial: 1.0,
        axial: 0.0,
        static_rating: 1e4,
        rolling: [rolling * 60f64.powf(-1.96), 1.7],
        sliding: [60f64.powf(0.26), 4.25],
        starvation: [5.1, 3e-8],
        friction: [boundary, 0.0],
        drag: 0.0,
        seals: 0.0,
    };
    for (rpm, nu, mixed, rolled) in [
        (1800.0, 60.18, 2.645_715_378_805_045_6e-8, 904.582_067_411_625_4),
        (300.0, 220.0, 1.633_868_103_050_455e-4, 730.222_403_860_368_7),
        (7000.0, 12.0, 4.924_690_273_104_475e-6, 740.810_119_445_571_1),
    ] {
        for (bearing, printed) in [(of(0.0, 1.0), mixed), (of(1.0, 0.0), rolled)] {
            let moment = 1e3 * bearing.power(nu * 1e-6, omega(rpm)) / omega(rpm);
            assert!((moment / printed - 1.0).abs() < 1e-9, "{moment} is not {printed}");
        }
    }
    let bath = SkfBearing { bore: 0.04, starvation: [3.1, 3e-8], drag: 1.49e-4, ..of(0.0, 0.0) };
    let moment = 1e3 * bath.power(1e-5, omega(1800.0)) / omega(1800.0);
    assert!((moment / 4.514_743_731_127_5 - 1.0).abs() < 1e-12, "{moment}");
}

/// Deep groove balls of series 160, in grease with mu_EHL 0.1, by the statements of a third program,
/// which takes the same catalogue: moments in N m with and without an axial load.
#[test]
fn the_moment_of_a_deep_groove_ball_bearing_is_that_of_another_program() {
    for ([bore, outer], nu, rating, rpm, [radial, axial], moment) in [
        ([30.0, 62.0], 60.0, 11_200.0, 3000.0, [1000.0, 200.0], 0.089_132_346_750_208_19),
        ([30.0, 62.0], 60.0, 11_200.0, 3000.0, [1000.0, 0.0], 0.051_064_550_073_682_32),
        ([60.0, 130.0], 20.0, 52_000.0, 500.0, [4000.0, 1500.0], 0.424_710_802_817_120_9),
    ] {
        let bearing = SkfBearing {
            bore: bore * 1e-3,
            outer: outer * 1e-3,
            radial,
            axial,
            static_rating: rating,
            rolling: [4.3e-7, 1.7],
            sliding: [4.63e-3, 4.25],
            starvation: [3.1, 6e-8],
            friction: [0.12, 0.1],
            drag: 0.0,
            seals: 0.0,
        };
        let found = bearing.power(nu * 1e-6, omega(rpm)) / omega(rpm);
        assert!((found / moment - 1.0).abs() < 1e-9, "{found} is not {moment}");
    }
}

/// What may be 0, or turn round, during a run.
const CHANGING: [&str; 7] = ["speed", "torque", "load", "F_r", "F_a", "nu", "dip"];

#[test]
fn losses_are_finite_and_not_negative_at_rest_reversed_and_without_load() {
    let losses = Formula::ALL
        .iter()
        .filter(|law| law.declaration().carries == Carries::Heat && **law != Formula::Given);
    for law in losses {
        let fields = law.declaration().fields;
        let usual: Vec<f64> = fields
            .iter()
            .map(|f| parse_quantity(f.example.trim_matches('"'), Some(f.ty)).unwrap().value)
            .collect();
        let changing: Vec<usize> =
            (0..fields.len()).filter(|&i| CHANGING.contains(&fields[i].key)).collect();
        // every set of them at 0, and every set turned round
        for set in 0..1_usize << changing.len() {
            for factor in [0.0, -1.0, 1e-12] {
                let mut values = usual.clone();
                for (k, &i) in changing.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1) {
                    let signed = ["speed", "torque"].contains(&fields[i].key);
                    values[i] *= if factor < 0.0 && !signed { 1.0 } else { factor };
                    debug_assert!(k < changing.len());
                }
                let duals: Vec<Dual<{ Formula::MOST_FIELDS }>> =
                    values.iter().enumerate().map(|(i, x)| Dual::variable(*x, i)).collect();
                let heat = law.value(&duals, [Dual::constant(300.0); 2]);
                assert!(heat.derivatives.iter().all(|d| d.is_finite()), "{law:?} at {values:?}");
                assert!(heat.value >= 0.0 && heat.value.is_finite(), "{law:?} at {values:?}");
                if values[0].abs() < 1e-300 {
                    assert!(heat.value.abs() < 1e-300, "{law:?} loses at rest: {}", heat.value);
                }
            }
        }
    }
}
