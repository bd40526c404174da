//! Films on spheres, inclined plates, rotating discs and below jets.
//!
//! All properties are those at the film temperature, the mean of surface and fluid.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::convection::{AREA, Film};
use crate::declare::{
    Confidence, Extent, FieldDeclaration, Form, Group, Law, LawDeclaration, Range,
};
use crate::fluid::{EXPANSION, Fluid, length, of_fluid, prandtl, reynolds};
use crate::forced_convection::SPEED;
use crate::free_convection::{VerticalPlate, nusselt_vertical_plate, rayleigh, rayleigh_within};

/// Mean Nusselt number of a sphere in a fluid at rest, over its diameter.
///
/// Nu = 2 + 0.589 Ra^(1/4) / (1 + (0.469/Pr)^(9/16))^(4/9)
///
/// * `ra`: Rayleigh number of the diameter, at least 0, at most 1e11
/// * `pr`: Prandtl number, 0.7 and above
///
/// Source: S. W. Churchill, in Heat Exchanger Design Handbook (1983), section 2.5.7; Incropera et
/// al., 6th edition, equation 9.35. The library polykin has the same constants and range.
pub fn nusselt_sphere_at_rest<S: Scalar>(ra: S, pr: S) -> S {
    let one = S::from_f64(1.0);
    let weight = (one + (S::from_f64(0.469) / pr).powf(9.0 / 16.0)).powf(4.0 / 9.0);
    S::from_f64(2.0) + S::from_f64(0.589) * ra.powf(0.25) / weight
}

/// Mean Nusselt number of a sphere in a flow, over its diameter.
///
/// Nu = 2 + (0.4 Re^(1/2) + 0.06 Re^(2/3)) Pr^0.4
///
/// * `re`: Reynolds number of the diameter, 3.5 to 7.6e4
/// * `pr`: Prandtl number, 0.71 to 380
///
/// The source takes the properties of the free stream and a factor (mu/mu_surface)^(1/4), from 1 to
/// 3.2, which is 1 here. Source: S. Whitaker, AIChE Journal 18 (1972) 361; Incropera et al., 6th
/// edition, equation 7.56. The library polykin has the same constants and ranges.
pub fn nusselt_sphere_in_flow<S: Scalar>(re: S, pr: S) -> S {
    let wake = S::from_f64(0.4) * re.sqrt() + S::from_f64(0.06) * re.powf(2.0 / 3.0);
    S::from_f64(2.0) + wake * pr.powf(0.4)
}

/// Reynolds numbers at which the flow on a free disc stops being laminar and becomes turbulent.
const DISC: [f64; 2] = [1.95e5, 2.5e5];

/// Mean Nusselt number of a disc that rotates in air at rest, over its radius.
///
/// The mean over the area of the local values Nu = 0.340 Re^(1/2) for laminar flow, 1e-19 Re^4
/// between Re = 1.95e5 and 2.5e5, and 0.0188 Re^0.8 beyond, where Re = w r^2 / nu:
/// Nu_mean = Re^(-1/2) times the integral of Nu Re^(-1/2) from 0 to Re
///
/// * `re`: Reynolds number w R^2 / nu of the outer radius, at least 0
///
/// Source: C. O. Popiel and L. Boguslawski, Int. J. Heat Mass Transfer 18 (1975) 170; not read in
/// the primary source. The mean agrees within 6 % with 0.36 Re^(1/2) and 0.015 Re^0.8 of E. C. Cobb
/// and O. A. Saunders, Proc. R. Soc. A 236 (1956) 343, far from the transition.
pub fn nusselt_disc<S: Scalar>(re: S) -> S {
    let [first, last] = DISC.map(S::from_f64);
    let c = S::from_f64;
    let laminar = c(0.340) * re.min(first);
    let between = re.max(first).min(last);
    let transition = c(1e-19 / 4.5) * (between.powf(4.5) - first.powf(4.5));
    let turbulent = c(0.0188 / 1.3) * (re.max(last).powf(1.3) - last.powf(1.3));
    // at rest the quotient has no value; the smallest speed gives the same limit
    (laminar + transition + turbulent) / re.max(c(1e-30)).sqrt()
}

/// Mean Nusselt number of a disc below one round jet, over the diameter D of the nozzle.
///
/// Nu = G 2 Re^(1/2) (1 + 0.005 Re^0.55)^(1/2) Pr^0.42,
/// G = 2 a (1 - 2.2 a) / (1 + 0.2 (H/D - 6) a), a = D / (2 r)
///
/// * `re`: Reynolds number of the nozzle, 2000 to 4e5
/// * `pr`: Prandtl number
/// * `distance`: H/D of nozzle and plate, 2 to 12
/// * `nozzle`: D/r of nozzle and disc; the area ratio a^2 is from 0.004 to 0.04
///
/// Source: H. Martin, Advances in Heat Transfer 13 (1977) 1; Incropera et al., 6th edition,
/// equations 7.75 and 7.76. The manual of Altair Flow Simulator prints them, too.
pub fn nusselt_jet<S: Scalar>(re: S, pr: S, distance: S, nozzle: S) -> S {
    let c = S::from_f64;
    let a = nozzle / c(2.0);
    let shape = c(2.0) * a * (c(1.0) - c(2.2) * a) / (c(1.0) + c(0.2) * (distance - c(6.0)) * a);
    let flow = c(2.0) * (re * (c(1.0) + c(0.005) * re.powf(0.55))).sqrt();
    shape * flow * pr.powf(0.42)
}

/// The common part of films with a flow.
const BLOWN: LawDeclaration = LawDeclaration {
    kinds: &[Kind::Convection],
    named: true,
    form: Form::Other,
    extent: Extent::Divided(&["area"]),
    ..Film::DECLARATION
};

/// A sphere in a fluid at rest.
#[derive(Debug)]
pub(crate) struct SphereAtRest;

impl Law for SphereAtRest {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "sphere_at_rest",
        sentence: "The surface of a sphere in a fluid at rest.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = 2 + 0.589 Ra^(1/4) / (1 + \
            (0.469/Pr)^(9/16))^(4/9)",
        fields: of_fluid![
            EXPANSION,
            length("diameter", "diameter of the sphere", "\"50 mm\""),
            AREA,
        ],
        validity: "One temperature over the sphere.",
        groups: &[rayleigh_within("Rayleigh number", 0.0, 1e11), prandtl(0.7, f64::INFINITY)],
        source: "Churchill, Heat Exchanger Design Handbook (1983), section 2.5.7; Incropera et \
            al., 6th edition, equation 9.35",
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        let ra = rayleigh(fluid, values[4], from - to, values[5]);
        fluid.film(nusselt_sphere_at_rest(ra, fluid.prandtl()), values[5], values[6])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let ra = VerticalPlate::groups(values, ends)[0];
        vec![ra, Some(Fluid::of(values).prandtl())]
    }
}

/// A sphere in a flow.
#[derive(Debug)]
pub(crate) struct SphereInFlow;

impl Law for SphereInFlow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "sphere_in_flow",
        sentence: "The surface of a sphere in a flow.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = 2 + (0.4 Re^(1/2) + 0.06 Re^(2/3)) \
            Pr^0.4",
        fields: of_fluid![SPEED, length("diameter", "diameter of the sphere", "\"50 mm\""), AREA,],
        validity: "A wide and even flow. The source takes the properties of the free stream and a \
            factor (mu/mu_surface)^(1/4), which is 1 here; its Pr begins at about 0.71.",
        groups: &[reynolds(3.5, 7.6e4), prandtl(0.7, 380.0)],
        source: "Whitaker, AIChE J. 18 (1972) 361; Incropera et al., 6th edition, equation 7.56",
        ..BLOWN
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        let re = fluid.reynolds(values[4], values[5]);
        fluid.film(nusselt_sphere_in_flow(re, fluid.prandtl()), values[5], values[6])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let fluid = Fluid::of(values);
        vec![Some(fluid.reynolds(values[4], values[5])), Some(fluid.prandtl())]
    }
}

/// A disc that rotates.
#[derive(Debug)]
pub(crate) struct Disc;

impl Law for Disc {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "rotating_disc",
        sentence: "One side of a disc that rotates in air at rest.",
        equation: "Q = Nu k / radius A (T_from - T_to), Nu = Re^(-1/2) times the integral over Re \
            of 0.340 up to 1.95e5, 1e-19 Re^3.5 to 2.5e5 and 0.0188 Re^0.3 beyond",
        fields: of_fluid![
            crate::rotation::ROTATION,
            length("radius", "outer radius of the disc", "\"120 mm\""),
            AREA,
        ],
        validity: "Air; one temperature over the disc, and no housing near it. Natural convection \
            is left out.",
        groups: &[
            Group { name: "Re", meaning: "Reynolds number w R^2 / nu", from: 0.0, to: 2e6 },
            prandtl(0.65, 0.75),
        ],
        source: "Popiel and Boguslawski, Int. J. Heat Mass Transfer 18 (1975) 170",
        confidence: Confidence::Medium,
        ..BLOWN
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        let re = fluid.reynolds(values[4] * values[5], values[5]);
        fluid.film(nusselt_disc(re), values[5], values[6])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let fluid = Fluid::of(values);
        let re = fluid.reynolds(values[4] * values[5], values[5]);
        vec![Some(re), Some(fluid.prandtl())]
    }
}

/// A disc below a jet.
#[derive(Debug)]
pub(crate) struct Jet;

impl Jet {
    /// Re of the nozzle, H/D and D/r.
    fn numbers<S: Scalar>(values: &[S]) -> [S; 3] {
        let (nozzle, distance, radius) = (values[5], values[6], values[7]);
        [Fluid::of(values).reynolds(values[4], nozzle), distance / nozzle, nozzle / radius]
    }
}

impl Law for Jet {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "impinging_jet",
        sentence: "A disc below one round nozzle, whose jet strikes it at right angles.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = G 2 (Re (1 + 0.005 Re^0.55))^(1/2) \
            Pr^0.42, G = 2 a (1 - 2.2 a) / (1 + 0.2 (H/D - 6) a), a = D/(2 r)",
        fields: of_fluid![
            FieldDeclaration { example: "\"30 m/s\"", ..SPEED },
            length("diameter", "diameter of the nozzle, D", "\"10 mm\""),
            length("distance", "distance of nozzle and plate, H", "\"50 mm\""),
            length("radius", "radius of the disc around the jet, r", "\"40 mm\""),
            AREA,
        ],
        validity: "A gas jet in the same gas; the mean over the disc of radius r, whose area is \
            pi r^2.",
        groups: &[
            reynolds(2e3, 4e5),
            Group { name: "H/D", meaning: "distance over diameter", from: 2.0, to: 12.0 },
            Group { name: "Ar", meaning: "area ratio (D/(2 r))^2", from: 0.004, to: 0.04 },
        ],
        source: "Martin, Advances in Heat Transfer 13 (1977) 1; Incropera et al., 6th edition, \
            equations 7.75 and 7.76",
        ..BLOWN
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        let [re, distance, nozzle] = Self::numbers(values);
        let nusselt = nusselt_jet(re, fluid.prandtl(), distance, nozzle);
        fluid.film(nusselt, values[5], values[8])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let [re, distance, nozzle] = Self::numbers(values);
        vec![Some(re), Some(distance), Some(nozzle * nozzle / 4.0)]
    }
}

/// The angle of an inclined plate.
const TILT: FieldDeclaration = FieldDeclaration {
    range: Range::Degrees(-60, 60),
    ..FieldDeclaration::new(
        "tilt",
        Type::of(Dimension::ANGLE),
        "angle from the vertical; above 0 if the surface of `from` faces up, below 0 if down",
        "\"-30 deg\"",
    )
};

/// An inclined plate.
#[derive(Debug)]
pub(crate) struct InclinedPlate;

impl InclinedPlate {
    fn rayleigh<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> S {
        let along = values[5].cos();
        rayleigh(Fluid::of(values), values[4] * along, from - to, values[6])
    }
}

impl Law for InclinedPlate {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "inclined_plate",
        sentence: "One side of an inclined plate in a fluid at rest: the lower side of a warm \
            plate, or the upper side of a cold one.",
        equation: "Q = Nu k / length A (T_from - T_to), Nu of a vertical plate with g cos(tilt) \
            instead of g",
        fields: of_fluid![
            EXPANSION,
            TILT,
            length("length", "length of the plate along its slope", "\"25 cm\""),
            AREA,
        ],
        validity: "The side along which the fluid clings. From the other side it detaches, and \
            carries more heat than this law says.",
        groups: &[
            rayleigh_within("Rayleigh number with g cos(tilt)", 0.0, 1e12),
            Group {
                name: "tilt",
                meaning: "angle in deg of a side from which the fluid detaches",
                from: 0.0,
                to: 0.1,
            },
        ],
        source: "Churchill and Chu, Int. J. Heat Mass Transfer 18 (1975) 1323; Incropera et al., \
            6th edition, section 9.6.2 with equation 9.26",
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        let nusselt = nusselt_vertical_plate(Self::rayleigh(values, ends), fluid.prandtl());
        fluid.film(nusselt, values[6], values[7])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let drives = (ends[0] - ends[1]) * values[5] > 0.0;
        let detached = drives.then(|| values[5].to_degrees().abs());
        vec![Some(Self::rayleigh(values, ends)), detached]
    }
}
