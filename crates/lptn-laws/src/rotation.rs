//! Convection from rotating shafts and across the gap around a rotor. The constants were not read in
//! the primary sources.
//!
//! All properties are those at the film temperature, the mean of the two ends.

use lptn_units::{Dimension, Scalar, Type};

use crate::convection::AREA;
use crate::declare::{Confidence, FieldDeclaration, Group, Law, LawDeclaration, Range};
use crate::fluid::{EXPANSION, Fluid, length, of_fluid, prandtl};
use crate::forced_convection::SPEED;
use crate::free_convection::{VerticalPlate, rayleigh};

/// Mean Nusselt number of a rotating horizontal shaft, over its diameter.
///
/// Nu = 0.11 ((0.5 Re_w^2 + Re^2 + Gr) Pr)^0.35
///
/// * `turning`: Re_w, Reynolds number of the diameter and the speed of the skin, at least 0
/// * `blown`: Re, Reynolds number of the diameter and a flow across it, at least 0
/// * `ra`: Rayleigh number Gr Pr of the diameter, at least 0
/// * `pr`: Prandtl number, near 0.7: air
///
/// Source: W. M. Kays and I. S. Bjorklund, Transactions of the ASME 80 (1958) 70, as Holman, Heat
/// Transfer, gives it; not read in the primary source.
pub fn nusselt_shaft<S: Scalar>(turning: S, blown: S, ra: S, pr: S) -> S {
    let half = S::from_f64(0.5);
    let sum = (half * turning * turning + blown * blown) * pr + ra;
    S::from_f64(0.11) * sum.powf(0.35)
}

/// Nusselt number of the gap between a rotor and a smooth housing, over twice the gap.
///
/// Nu = 2 below Ta = 1700, 0.128 Ta^0.367 to 1e4, 0.409 Ta^0.241 to 1e7
///
/// * `ta`: Taylor number w^2 r gap^3 / nu^2 with the mean radius r of the gap, at least 0
///
/// The second applies from 1790 on, where it reaches 2, so that nothing jumps. Source: K. M. Becker
/// and J. Kaye, Journal of Heat Transfer 84 (1962) 97; not read in the primary source, and reviews
/// differ in a factor of the Taylor number that is 1 for thin gaps.
pub fn nusselt_annulus<S: Scalar>(ta: S) -> S {
    let vortices = S::from_f64(0.128) * ta.powf(0.367);
    let late = S::from_f64(0.409) * ta.powf(0.241);
    vortices.min(late).max(S::from_f64(2.0))
}

pub(crate) const ROTATION: FieldDeclaration = FieldDeclaration {
    range: Range::Finite,
    ..FieldDeclaration::new(
        "rotation",
        Type::of(Dimension::ANGULAR_VELOCITY),
        "rotational speed, of either sign",
        "\"3000 rpm\"",
    )
};

/// A rotating shaft.
#[derive(Debug)]
pub(crate) struct Shaft;

impl Shaft {
    /// The fluid, Re_w, Re, Ra and Pr.
    fn state<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> (Fluid<S>, [S; 4]) {
        let fluid = Fluid::of(values);
        let &[expansion, rotation, diameter, _, speed] = &values[4..] else {
            return (fluid, [S::from_f64(f64::NAN); 4]);
        };
        let skin = S::from_f64(0.5) * rotation * diameter;
        let numbers = [
            fluid.reynolds(skin, diameter),
            fluid.reynolds(speed, diameter),
            rayleigh(fluid, expansion, from - to, diameter),
            fluid.prandtl(),
        ];
        (fluid, numbers)
    }
}

impl Law for Shaft {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "rotating_shaft",
        sentence: "The outer surface of a rotating horizontal shaft, at rest or in a flow across \
            it.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = 0.11 ((0.5 Re_w^2 + Re^2 + Gr) \
            Pr)^0.35",
        fields: of_fluid![
            EXPANSION,
            ROTATION,
            length("diameter", "diameter of the shaft", "\"40 mm\""),
            AREA,
            FieldDeclaration { default: Some(0.0), ..SPEED },
        ],
        validity: "Air; Re_w uses the speed of the surface.",
        groups: &[
            Group {
                name: "Re_w",
                meaning: "Reynolds number of the speed of the surface",
                from: 0.0,
                to: 4.3e5,
            },
            prandtl(0.65, 0.75),
        ],
        source: "Kays and Bjorklund, Trans. ASME 80 (1958) 70, as Holman, Heat Transfer, gives it",
        confidence: Confidence::Medium,
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let (fluid, [turning, blown, ra, pr]) = Self::state(values, ends);
        fluid.film(nusselt_shaft(turning, blown, ra, pr), values[6], values[7])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let (_, [turning, _, _, pr]) = Self::state(values, ends);
        vec![Some(turning), Some(pr)]
    }
}

/// The gap around a rotor.
#[derive(Debug)]
pub(crate) struct Annulus;

impl Annulus {
    fn taylor<S: Scalar>(values: &[S]) -> S {
        let fluid = Fluid::of(values);
        let (rotation, radius, gap) = (values[4], values[5], values[6]);
        let inertia = rotation * fluid.density / fluid.viscosity;
        inertia * inertia * radius * gap.powi(3)
    }
}

impl Law for Annulus {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "rotating_annulus",
        sentence: "The gap between a rotor and its housing, without a flow along it.",
        equation: "Q = Nu k / (2 gap) A (T_from - T_to), Nu = 2 below Ta = 1700, 0.128 Ta^0.367 to \
            1e4, 0.409 Ta^0.241 above",
        fields: of_fluid![
            ROTATION,
            length("radius", "mean radius of the gap", "\"40 mm\""),
            length("gap", "width of the gap", "\"1 mm\""),
            AREA,
        ],
        reads_ends: false,
        validity: "Smooth walls, a gap that is thin against the radius; the rotor is inside.",
        groups: &[Group {
            name: "Ta",
            meaning: "Taylor number w^2 r gap^3 / nu^2",
            from: 0.0,
            to: 1e7,
        }],
        source: "Becker and Kaye, J. Heat Transfer 84 (1962) 97",
        ..Shaft::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let fluid = Fluid::of(values);
        fluid.film(nusselt_annulus(Self::taylor(values)), S::from_f64(2.0) * values[6], values[7])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![Some(Self::taylor(values))]
    }
}
