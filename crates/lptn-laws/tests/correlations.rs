//! Reference: correlations against values of textbooks and of the Python package ht 1.2.0 (Caleb
//! Bell, MIT licence), computed for the arguments given here; what happens at equal temperatures, at
//! rest and where a flow turns.

use lptn_laws::{
    Fluid, Formula, along, combined, gearbox_wall, gearbox_wall_blown, nusselt_annulus,
    nusselt_cross_flow, nusselt_cross_flow_hilpert, nusselt_duct, nusselt_flat_plate,
    nusselt_flat_plate_from, nusselt_horizontal_cylinder, nusselt_plate_driven,
    nusselt_plate_layered, nusselt_shaft, nusselt_square, nusselt_square_on_edge,
    nusselt_vertical_plate, rayleigh,
};
use lptn_units::Dual;

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// ht: Nu_vertical_plate_Churchill(0.69, 2.63e9), Nu_horizontal_cylinder_Churchill_Chu(0.69,
/// 2.63e9), Nu_horizontal_plate_McAdams(5.54, 3.21e8), the same with buoyancy=False, and (0.7, 1e5).
#[test]
fn natural_convection_is_that_of_ht() {
    near(nusselt_vertical_plate(0.69 * 2.63e9, 0.69), 147.161_852_237_706_03, 1e-13);
    near(nusselt_horizontal_cylinder(0.69 * 2.63e9, 0.69), 139.134_939_700_735_97, 1e-13);
    near(nusselt_plate_driven(5.54 * 3.21e8), 181.731_212_743_844_57, 1e-13);
    near(nusselt_plate_layered(5.54 * 3.21e8), 55.445_647_993_628_29, 1e-13);
    near(nusselt_plate_driven(0.7e5), 8.783_513_433_168_045, 1e-13);
}

/// ht: Nu_cylinder_Churchill_Bernstein(6071, 0.7), turbulent_Gnielinski(1e5, 1.2, fd) and (1e4, 5,
/// fd) with fd = (0.79 ln Re - 1.64)^-2.
#[test]
fn forced_convection_is_that_of_ht() {
    near(nusselt_cross_flow(6071.0, 0.7), 40.637_085_941_249_74, 1e-13);
    near(nusselt_duct(1e5, 1.2), 247.885_995_520_330_45, 1e-13);
    near(nusselt_duct(1e4, 5.0), 69.912_471_513_836_55, 1e-13);
}

/// Incropera et al., 6th edition, example 9.2: a glass door of 0.71 m, 232 and 23 degC: Ra = 1.813e9,
/// Nu = 147, h = 7.0 W/(m^2 K).
#[test]
fn glass_door() {
    // air of 400 K
    let (k, nu, alpha, pr) = (33.8e-3, 26.4e-6, 38.3e-6, 0.69);
    let density = 0.8711;
    let fluid = Fluid {
        conductivity: k,
        density,
        specific_heat: k / (density * alpha),
        viscosity: density * nu,
    };
    near(fluid.prandtl(), pr, 2e-3);
    let ra = rayleigh(fluid, 0.0025, 232.0 - 23.0, 0.71);
    near(ra, 1.813e9, 1e-3);
    let nusselt = nusselt_vertical_plate(ra, pr);
    near(nusselt, 147.0, 2e-3);
    near(fluid.film(nusselt, 0.71, 1.0), 7.0, 5e-3);
}

/// Incropera et al., 6th edition, example 7.4: a cylinder of 12.7 mm in air of 10 m/s: Re = 6071, by
/// Hilpert Nu = 37.3 to 37.5 (the printed h of 88 W/(m^2 K) with k = 0.030), by Churchill and
/// Bernstein 40.6.
#[test]
fn cylinder_in_a_wind_tunnel() {
    near(nusselt_cross_flow_hilpert(6071.0, 0.70) * 0.030 / 0.0127, 88.0, 0.015);
    near(nusselt_cross_flow(6071.0, 0.70), 40.6, 1e-3);
}

/// Incropera et al., 6th edition, example 7.1: air of 10 m/s and 300 degC along 0.5 m: Re = 9597, Pr
/// = 0.687, Nu = 57.4.
#[test]
fn cooling_plate() {
    near(nusselt_flat_plate(9597.0, 0.687), 57.4, 1e-3);
}

/// Incropera et al., 6th edition, example 7.2: strips of 50 mm along air of 60 m/s, the plate at 230,
/// the air at 25 degC: the first, fifth and sixth lose 1370, 1050 and 1440 W per metre. The book
/// rounds h to two digits before it subtracts.
#[test]
fn strips_on_a_plate() {
    let heat = |strip: f64| {
        let re = |edge: f64| 60.0 * 0.05 * edge / 26.41e-6;
        let nu = nusselt_flat_plate_from([re(strip - 1.0), re(strip)], 0.690);
        nu * 0.0338 * 205.0
    };
    near(heat(1.0), 1370.0, 1e-3);
    near(heat(5.0), 1050.0, 0.04);
    near(heat(6.0), 1440.0, 0.01);
}

/// By hand from the printed equations at Re = 20 000, Pr = 0.7: 0.158 * 689.73 * 0.88790 and
/// 0.304 * 344.83 * 0.88790.
#[test]
fn square_bars() {
    near(nusselt_square(2e4, 0.7), 96.7616, 1e-5);
    near(nusselt_square_on_edge(2e4, 0.7), 93.0781, 1e-5);
}

/// The printed ends of the rows of Hilpert's table: the largest power is within 1.5 % of the row on
/// either side.
#[test]
fn powers_of_hilpert_go_over_into_each_other() {
    let rows: [(f64, f64, f64, f64); 5] = [
        (0.4, 4.0, 0.989, 0.330),
        (4.0, 40.0, 0.911, 0.385),
        (40.0, 4e3, 0.683, 0.466),
        (4e3, 4e4, 0.193, 0.618),
        (4e4, 4e5, 0.027, 0.805),
    ];
    for (from, to, factor, exponent) in rows {
        for i in 0..=20 {
            let re = from * (to / from).powf(f64::from(i) / 20.0);
            near(nusselt_cross_flow_hilpert(re, 1.0), factor * re.powf(exponent), 0.016);
        }
        let middle = (from * to).sqrt();
        near(nusselt_cross_flow_hilpert(middle, 1.0), factor * middle.powf(exponent), 1e-15);
    }
}

/// Nothing jumps: neither where a plate turns turbulent nor a duct, nor where one power follows
/// another.
#[test]
fn no_correlation_jumps() {
    let ratio = 1.0 + 1e-9;
    let laws: [fn(f64) -> f64; 7] = [
        |re| nusselt_flat_plate(re, 0.7),
        |re| nusselt_duct(re, 5.0),
        |re| nusselt_cross_flow(re, 0.7),
        |re| nusselt_cross_flow_hilpert(re, 0.7),
        nusselt_plate_driven,
        nusselt_annulus,
        |re| nusselt_shaft(re, 0.0, 1e5, 0.7),
    ];
    for law in laws {
        let mut x = 1.0;
        while x < 1e7 {
            near(law(x * ratio), law(x), 1e-7);
            assert!(law(x * ratio) >= law(x));
            x *= 1.001;
        }
    }
    near(nusselt_duct(2300.0, 5.0), 3.66, 1e-15);
    near(nusselt_duct(0.0, 5.0), 3.66, 1e-15);
}

/// Becker and Kaye: the printed limits of Ta are where the powers meet, as far as they are known.
#[test]
fn a_gap_conducts_until_vortices_form() {
    near(nusselt_annulus(0.0), 2.0, 0.0);
    near(nusselt_annulus(1700.0), 0.128 * 1700f64.powf(0.367), 0.02);
    near(nusselt_annulus(5e3), 0.128 * 5e3f64.powf(0.367), 1e-15);
    near(0.128 * 1e4f64.powf(0.367), 0.409 * 1e4f64.powf(0.241), 3e-3);
    near(nusselt_annulus(1e6), 0.409 * 1e6f64.powf(0.241), 1e-15);
}

/// At rest a shaft is a cylinder in still air: within the scatter of such laws.
#[test]
fn a_shaft_at_rest_is_nearly_a_cylinder() {
    for ra in [1e5, 1e6, 1e7] {
        near(nusselt_shaft(0.0, 0.0, ra, 0.7), nusselt_horizontal_cylinder(ra, 0.7), 0.35);
    }
}

/// Of two films the larger counts, and twice the same is larger by 2^(1/3).
#[test]
fn a_wind_helps_and_does_not_replace() {
    near(combined(5.0, 5.0), 5.0 * 2f64.cbrt(), 1e-14);
    near(combined(50.0, 5.0), 50.0, 4e-4);
    let wall = |speed: f64| {
        let values = [&AIR[..], &[speed, 0.5, 0.1, 0.2]].concat();
        Formula::WallInWind.value(&values, [330.0, 300.0])
    };
    near(wall(0.0), conductance(Formula::VerticalPlate, 30.0), 1e-13);
    assert!(wall(0.5) > wall(0.0) && wall(-0.5).to_bits() == wall(0.5).to_bits());
}

/// Up a warm wall a flow helps, down a cold one too; against the natural one it takes away, and the
/// larger counts. Nothing jumps where the flow or the difference turns, or where both are alike.
#[test]
fn a_flow_along_a_wall_helps_or_hinders() {
    near(along(5.0, 5.0, false), 5.0 * 2f64.cbrt(), 2e-5);
    near(along(50.0, 5.0, true), 50.0, 4e-4);
    near(along(0.0, 5.0, true), along(0.0, 5.0, false), 1e-15);
    let wall = |speed: f64, difference: f64| {
        let values = [&AIR[..], &[speed, 0.1, 0.2]].concat();
        Formula::WallInVerticalFlow.value(&values, [300.0 + difference, 300.0])
    };
    let still = conductance(Formula::VerticalPlate, 30.0);
    near(wall(0.0, 30.0), still, 2e-5);
    assert!(wall(0.3, 30.0) > still && wall(-0.1, 30.0) < still);
    assert_eq!(wall(0.3, 30.0).to_bits(), wall(-0.3, -30.0).to_bits());
    near(wall(1e-9, 30.0), wall(-1e-9, 30.0), 1e-12);
    let heat = |difference: f64| wall(1.0, difference) * difference;
    assert!((heat(1e-9) - heat(-1e-9)).abs() < 1e-8);
    for i in 0..200 {
        let of = |i: i32| wall(-0.01 * f64::from(i), 30.0);
        assert!(of(i) > 0.1 * still && (of(i + 1) - of(i)).abs() < 0.2 * still, "{i}");
    }
}

/// The rules for gearboxes know the colder end by themselves, and go over from still air to a flow.
#[test]
fn a_gearbox_is_cooled_the_same_whichever_end_is_named_first() {
    near(gearbox_wall(0.3, 353.15, 293.15), gearbox_wall(0.3, 293.15, 353.15), 1e-15);
    near(gearbox_wall(1.0, 400.0, 200.0), 18.0, 1e-10);
    near(gearbox_wall_blown(3e4, 2.5 * 16e8, 0.5), 0.0086 * 5e4_f64.powf(0.64) / 0.5, 1e-14);
}

const AIR: [f64; 5] = [0.0262, 1.184, 1006.0, 18.4e-6, 0.003_36];

/// The laws of natural convection with a length and an area behind the properties of air.
const FREE: [Formula; 4] =
    [Formula::VerticalPlate, Formula::HorizontalCylinder, Formula::UpperSide, Formula::LowerSide];

fn conductance(law: Formula, difference: f64) -> f64 {
    law.value(&[&AIR[..], &[0.1, 0.2]].concat(), [300.0 + difference, 300.0])
}

/// What the smooth |dT| does: 1.7e-7 of the film at 1 K, 1.7e-5 at 0.1 K, and a film that is small
/// and finite at 0, with a finite slope on either side.
#[test]
fn a_film_is_smooth_where_the_temperatures_are_equal() {
    for law in FREE {
        let sharp = |difference: f64, power: f64| {
            conductance(law, 100.0) * (difference / 100.0_f64).powf(power)
        };
        let ratio = conductance(law, 0.1) / conductance(law, 1.0);
        assert!(ratio > 0.1_f64.powf(1.0 / 3.0) && ratio < 1.0, "{law:?} {ratio}");
        if law == Formula::LowerSide {
            near(conductance(law, 1.0), sharp(1.0, 0.25), 1.3e-7);
            near(conductance(law, 0.1), sharp(0.1, 0.25), 1.3e-5);
        }
        let values: Vec<Dual<1>> =
            AIR.iter().chain(&[0.1, 0.2]).map(|x| Dual::constant(*x)).collect();
        for difference in [0.0, 1e-12, -1e-12, 1e-3, -1e-3] {
            let ends = [Dual::variable(300.0 + difference, 0), Dual::constant(300.0)];
            let found = law.value(&values, ends);
            assert!(found.value > 0.0 && found.value < conductance(law, 1.0), "{law:?} {found:?}");
            let heat = found * (ends[0] - ends[1]);
            assert!(heat.derivatives[0] > 0.0, "{law:?}: heat rises with the difference");
            assert!(found.derivatives[0].abs() < 1e3 * found.value, "{law:?} {found:?}");
        }
    }
}

/// A warm plate is cooled the better on its upper side, a cold one on its lower side.
#[test]
fn a_plate_knows_which_side_is_warm() {
    for difference in [30.0, -30.0] {
        let [upper, lower] =
            [Formula::UpperSide, Formula::LowerSide].map(|law| conductance(law, difference));
        assert_eq!(upper > lower, difference > 0.0);
        let [driven, layered] = if difference > 0.0 { [upper, lower] } else { [lower, upper] };
        near(driven / layered, 2.0, 1e-12); // 0.54 and 0.27, Ra near 3e6
    }
}

#[test]
fn a_flow_may_turn() {
    let of = |law: Formula, speed: f64| {
        law.value(&[&AIR[..4], &[speed, 0.05, 0.2, 0.0]].concat(), [310.0, 300.0])
    };
    for law in [Formula::CrossFlow, Formula::CrossFlowHilpert, Formula::FlatPlate, Formula::Duct] {
        assert_eq!(of(law, 3.0).to_bits(), of(law, -3.0).to_bits());
        let mut values: Vec<Dual<1>> = AIR[..4].iter().map(|x| Dual::constant(*x)).collect();
        values.push(Dual::variable(0.0, 0));
        values.extend([0.05, 0.2, 0.0].map(Dual::constant));
        let found = law.value(&values, [310.0, 300.0].map(Dual::constant));
        assert!(found.value.is_finite() && found.derivatives[0].is_finite(), "{law:?} {found:?}");
    }
}

/// Each law gives a value for each of its groups, and its example is inside.
#[test]
fn every_law_gives_its_groups() {
    for law in Formula::ALL {
        let declared = law.declaration();
        let values: Vec<f64> = declared
            .fields
            .iter()
            .map(|field| {
                let text = field.example.trim_matches('"');
                lptn_units::parse_quantity(text, Some(field.ty)).map_or(f64::NAN, |q| q.value)
            })
            .collect();
        let found = law.groups(&values, [353.15, 303.15]);
        assert_eq!(found.len(), declared.groups.len(), "{law:?}");
        for (group, value) in declared.groups.iter().zip(found) {
            let inside = value.is_none_or(|value| group.contains(value));
            assert!(inside, "{law:?}: {} = {value:?}", group.name);
            assert!(!group.contains(f64::NAN) && group.from < group.to);
        }
    }
}
