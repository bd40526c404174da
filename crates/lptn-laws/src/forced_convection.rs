//! Forced convection across cylinders, along plates and in ducts.
//!
//! All properties are those at the film temperature, the mean of surface and fluid. A flow may come
//! from either side: its magnitude counts.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::convection::{AREA, Film};
use crate::declare::{Extent, FieldDeclaration, Form, Group, Law, LawDeclaration, Range};
use crate::fluid::{Fluid, length, of_fluid, prandtl, reynolds};

/// Mean Nusselt number of a long cylinder in cross flow, over its diameter.
///
/// Nu = 0.3 + 0.62 Re^(1/2) Pr^(1/3) / (1 + (0.4/Pr)^(2/3))^(1/4) (1 + (Re/282000)^(5/8))^(4/5)
///
/// * `re`: Reynolds number of the diameter, at least 0, at most 1e7; Re Pr above 0.2
/// * `pr`: Prandtl number, above 0
///
/// Source: S. W. Churchill and M. Bernstein, Journal of Heat Transfer 99 (1977) 300; Incropera et
/// al., 6th edition, equation 7.54.
///
/// ```
/// // the library fluids/ht (Caleb Bell) prints 40.637086
/// assert!((lptn_laws::nusselt_cross_flow(6071.0, 0.7) - 40.637_086).abs() < 5e-6);
/// ```
pub fn nusselt_cross_flow<S: Scalar>(re: S, pr: S) -> S {
    let [one, small] = [1.0, 0.3].map(S::from_f64);
    let weight = (one + (S::from_f64(0.4) / pr).powf(2.0 / 3.0)).powf(0.25);
    let late = (one + (re / S::from_f64(282_000.0)).powf(5.0 / 8.0)).powf(4.0 / 5.0);
    small + S::from_f64(0.62) * re.sqrt() * pr.powf(1.0 / 3.0) / weight * late
}

/// Factors and exponents of Hilpert, for rising Re.
const HILPERT: [(f64, f64); 5] =
    [(0.989, 0.330), (0.911, 0.385), (0.683, 0.466), (0.193, 0.618), (0.027, 0.805)];

/// Mean Nusselt number of a long cylinder in cross flow, over its diameter, by powers.
///
/// Nu = C Re^m Pr^(1/3) with C and m of the table below
///
/// * `re`: Reynolds number of the diameter, 0.4 to 4e5
/// * `pr`: Prandtl number, 0.7 and above
///
/// | Re | C | m |
/// |---|---|---|
/// | 0.4 to 4 | 0.989 | 0.330 |
/// | to 40 | 0.911 | 0.385 |
/// | to 4000 | 0.683 | 0.466 |
/// | to 40 000 | 0.193 | 0.618 |
/// | to 400 000 | 0.027 | 0.805 |
///
/// At the ends of the rows Nu would jump by up to 1.5 %. Here the largest of the five applies, so
/// that neighbours meet (Re = 4.5, 35, 4080, 37 000). Source: R. Hilpert, Forschung auf dem Gebiete
/// des Ingenieurwesens 4 (1933) 215; Incropera et al., 6th edition, equation 7.52 and table 7.2.
pub fn nusselt_cross_flow_hilpert<S: Scalar>(re: S, pr: S) -> S {
    let powers = HILPERT.map(|(factor, exponent)| S::from_f64(factor) * re.powf(exponent));
    powers.into_iter().fold(S::from_f64(0.0), S::max) * pr.powf(1.0 / 3.0)
}

/// Mean Nusselt number of a flat plate along a flow, over its length.
///
/// Nu = 0.664 Re^(1/2) Pr^(1/3) for laminar flow, (0.037 Re^(4/5) - 871) Pr^(1/3) if it turns
/// turbulent on the way, whichever is larger: from Re = 5e5 on the second
///
/// * `re`: Reynolds number of the length, at least 0, at most 1e8
/// * `pr`: Prandtl number, 0.6 to 60
///
/// Source: Incropera et al., 6th edition, equations 7.30 and 7.38.
pub fn nusselt_flat_plate<S: Scalar>(re: S, pr: S) -> S {
    let laminar = S::from_f64(0.664) * re.sqrt();
    let mixed = S::from_f64(0.037) * re.powf(0.8) - S::from_f64(871.0);
    laminar.max(mixed) * pr.powf(1.0 / 3.0)
}

/// Mean Nusselt number of a surface on a plate along a flow that is heated from its leading edge,
/// over the length of the surface: the heat of the plate up to its end less that up to its start.
///
/// Nu = N(Re_end) - N(Re_start) with N of [`nusselt_flat_plate`]
///
/// * `start`, `end`: Reynolds numbers of the distances from the leading edge, at most 1e8
/// * `pr`: Prandtl number, 0.6 to 60
///
/// It follows from the definition of the mean: the integral of the local coefficient. F. Kreith,
/// Principles of Heat Transfer, 3rd edition (1973), table 6-5, has the same integral.
pub fn nusselt_flat_plate_from<S: Scalar>([start, end]: [S; 2], pr: S) -> S {
    // the root has no slope at 0
    nusselt_flat_plate(end, pr) - nusselt_flat_plate(start.max(S::from_f64(1e-30)), pr)
}

/// Mean Nusselt number of a long square bar across a flow that meets a face, over its side.
///
/// Nu = 0.158 Re^0.66 Pr^(1/3)
///
/// * `re`: Reynolds number of the side, 5000 to 60 000
/// * `pr`: Prandtl number, 0.7 and above
///
/// Source: E. M. Sparrow, J. P. Abraham and J. C. K. Tong, Int. J. Heat Mass Transfer 47 (2004)
/// 5285, in the form of Incropera et al., 7th edition, table 7.3.
pub fn nusselt_square<S: Scalar>(re: S, pr: S) -> S {
    S::from_f64(0.158) * re.powf(0.66) * pr.powf(1.0 / 3.0)
}

/// Mean Nusselt number of a long square bar across a flow that meets an edge, over its diagonal.
///
/// Nu = 0.304 Re^0.59 Pr^(1/3)
///
/// * `re`: Reynolds number of the diagonal, 6000 to 60 000
/// * `pr`: Prandtl number, 0.7 and above
///
/// Source: as [`nusselt_square`].
pub fn nusselt_square_on_edge<S: Scalar>(re: S, pr: S) -> S {
    S::from_f64(0.304) * re.powf(0.59) * pr.powf(1.0 / 3.0)
}

/// Nu of a laminar flow in a round duct with a wall of one temperature.
const LAMINAR_DUCT: f64 = 3.66;

/// Reynolds numbers at which a flow in a duct stops being laminar and becomes turbulent.
const TRANSITION: [f64; 2] = [2300.0, 4000.0];

/// Nusselt number of the developed flow in a smooth duct, over its hydraulic diameter.
///
/// Nu = 3.66 up to Re = 2300; from Re = 4000 on
/// Nu = f/8 (Re - 1000) Pr / (1 + 12.7 sqrt(f/8) (Pr^(2/3) - 1)), f = (0.79 ln Re - 1.64)^-2;
/// between them in proportion to Re from 3.66 to the value at 4000
///
/// * `re`: Reynolds number of the hydraulic diameter, at least 0, at most 5e6
/// * `pr`: Prandtl number, 0.5 to 2000
///
/// Source: V. Gnielinski, International Chemical Engineering 16 (1976) 359, with the friction of
/// Petukhov; Incropera et al., 6th edition, equations 8.55, 8.21 and 8.62; between them V.
/// Gnielinski, International Journal of Heat and Mass Transfer 63 (2013) 134.
pub fn nusselt_duct<S: Scalar>(re: S, pr: S) -> S {
    let [laminar, one, first, last] =
        [LAMINAR_DUCT, 1.0, TRANSITION[0], TRANSITION[1]].map(S::from_f64);
    let turbulent = gnielinski(re.max(last), pr);
    let share = ((re - first) / (last - first)).max(S::from_f64(0.0)).min(one);
    laminar + share * (turbulent - laminar)
}

/// Nu of a turbulent flow in a smooth duct.
fn gnielinski<S: Scalar>(re: S, pr: S) -> S {
    let one = S::from_f64(1.0);
    let friction = (S::from_f64(0.79) * re.ln() - S::from_f64(1.64)).powi(-2);
    let eighth = friction / S::from_f64(8.0);
    let below = one + S::from_f64(12.7) * eighth.sqrt() * (pr.powf(2.0 / 3.0) - one);
    eighth * (re - S::from_f64(1000.0)) * pr / below
}

/// The velocity of a flow; its magnitude counts.
pub(crate) const SPEED: FieldDeclaration = FieldDeclaration {
    range: Range::Finite,
    ..FieldDeclaration::new(
        "speed",
        Type::of(Dimension::VELOCITY),
        "velocity of the flow, of either sign",
        "\"2 m/s\"",
    )
};

/// The fields of a correlation whose length has this key.
macro_rules! fields {
    ($key:literal, $meaning:literal, $example:literal) => {
        of_fluid![SPEED, length($key, $meaning, $example), AREA,]
    };
}

/// The fluid, Re and Pr, from fields as above.
fn state<S: Scalar>(values: &[S]) -> (Fluid<S>, S, S) {
    let fluid = Fluid::of(values);
    (fluid, fluid.reynolds(values[4], values[5]), fluid.prandtl())
}

/// The conductance by a correlation of Re and Pr.
fn conductance<S: Scalar>(values: &[S], nusselt: fn(S, S) -> S) -> S {
    let (fluid, re, pr) = state(values);
    fluid.film(nusselt(re, pr), values[5], values[6])
}

/// Re and Pr.
fn re_and_pr(values: &[f64]) -> Vec<Option<f64>> {
    let (_, re, pr) = state(values);
    vec![Some(re), Some(pr)]
}

/// The common part of these laws.
const BODY: LawDeclaration = LawDeclaration {
    kinds: &[Kind::Convection],
    named: true,
    form: Form::Other,
    extent: Extent::Divided(&["area"]),
    ..Film::DECLARATION
};

/// A cylinder across a flow, by Churchill and Bernstein.
#[derive(Debug)]
pub(crate) struct CrossFlow;

impl Law for CrossFlow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "cylinder_in_cross_flow",
        sentence: "The outer surface of a long cylinder across a flow.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = 0.3 + 0.62 Re^(1/2) Pr^(1/3) / (1 \
            + (0.4/Pr)^(2/3))^(1/4) (1 + (Re/282000)^(5/8))^(4/5)",
        fields: fields!("diameter", "outer diameter of the cylinder", "\"80 mm\""),
        validity: "Longer than wide, in a wide and even flow.",
        groups: &[
            Group { name: "Pe", meaning: "Peclet number Re Pr", from: 0.2, to: f64::INFINITY },
            reynolds(0.0, 1e7),
        ],
        source: "Churchill and Bernstein, J. Heat Transfer 99 (1977) 300; Incropera et al., 6th \
            edition, equation 7.54",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        conductance(values, nusselt_cross_flow)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let (_, re, pr) = state(values);
        vec![Some(re * pr), Some(re)]
    }
}

/// A cylinder across a flow, by Hilpert.
#[derive(Debug)]
pub(crate) struct CrossFlowHilpert;

impl Law for CrossFlowHilpert {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "cylinder_in_cross_flow_hilpert",
        sentence: "The outer surface of a long cylinder across a flow, by the powers of Hilpert.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = C Re^m Pr^(1/3), the largest of \
            (C, m) = (0.989, 0.330), (0.911, 0.385), (0.683, 0.466), (0.193, 0.618), (0.027, \
            0.805)",
        validity: "Longer than wide, in a wide and even flow. The source changes at Re = 4, 40, \
            4000 and 40 000, lptn at the crossings of neighbours, 4.5, 35, 4080 and 37 000.",
        groups: &[reynolds(0.4, 4e5), prandtl(0.7, f64::INFINITY)],
        source: "Hilpert, Forsch. Ing.-Wes. 4 (1933) 215; Incropera et al., 6th edition, equation \
            7.52",
        ..CrossFlow::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        conductance(values, nusselt_cross_flow_hilpert)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        re_and_pr(values)
    }
}

/// A plate along a flow.
#[derive(Debug)]
pub(crate) struct FlatPlate;

impl Law for FlatPlate {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "flat_plate",
        sentence: "A surface on a plate along a flow.",
        equation: "Q = Nu k / length A (T_from - T_to), Nu = N(start + length) - N(start), N = \
            max(0.664 Re^(1/2), 0.037 Re^(4/5) - 871) Pr^(1/3), Re of the distance from the \
            leading edge",
        fields: of_fluid![
            SPEED,
            length("length", "length of the surface along the flow", "\"0.3 m\""),
            AREA,
            START,
        ],
        validity: "One temperature from the leading edge to the end of the surface, no pressure \
            gradient; the flow turns turbulent at Re = 5e5.",
        groups: &[reynolds(0.0, 1e8), prandtl(0.6, 60.0)],
        source: "Incropera et al., 6th edition, equations 7.30 and 7.38; Kreith, 3rd edition, \
            table 6-5",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let (fluid, distances, pr) = on_plate(values);
        fluid.film(nusselt_flat_plate_from(distances, pr), values[5], values[6])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let (_, [_, end], pr) = on_plate(values);
        vec![Some(end), Some(pr)]
    }
}

/// The distance from the leading edge to a surface.
const START: FieldDeclaration = FieldDeclaration {
    range: Range::NotNegative,
    ..length("start", "distance from the leading edge to the surface", "\"0.1 m\"")
}
.or(0.0);

/// The fluid, Re at start and end of a surface, and Pr.
fn on_plate<S: Scalar>(values: &[S]) -> (Fluid<S>, [S; 2], S) {
    let fluid = Fluid::of(values);
    let [start, end] = [values[7], values[7] + values[5]].map(|x| fluid.reynolds(values[4], x));
    (fluid, [start, end], fluid.prandtl())
}

/// A square bar across a flow.
#[derive(Debug)]
pub(crate) struct Square;

impl Law for Square {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "square_in_cross_flow",
        sentence: "The outer surface of a long square bar across a flow that meets a face.",
        equation: "Q = Nu k / width A (T_from - T_to), Nu = 0.158 Re^0.66 Pr^(1/3)",
        fields: fields!("width", "side of the square", "\"40 mm\""),
        validity: "Longer than wide, in a wide and even flow. Measured in air.",
        groups: &[reynolds(5000.0, 6e4), prandtl(0.7, f64::INFINITY)],
        source: "Sparrow, Abraham and Tong, Int. J. Heat Mass Transfer 47 (2004) 5285; Incropera \
            et al., 7th edition, table 7.3",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        conductance(values, nusselt_square)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        re_and_pr(values)
    }
}

/// A square bar across a flow, on its edge.
#[derive(Debug)]
pub(crate) struct SquareOnEdge;

impl Law for SquareOnEdge {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "square_on_edge_in_cross_flow",
        sentence: "The outer surface of a long square bar across a flow that meets an edge.",
        equation: "Q = Nu k / width A (T_from - T_to), Nu = 0.304 Re^0.59 Pr^(1/3)",
        fields: fields!("width", "diagonal of the square", "\"55 mm\""),
        groups: &[reynolds(6000.0, 6e4), prandtl(0.7, f64::INFINITY)],
        ..Square::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        conductance(values, nusselt_square_on_edge)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        re_and_pr(values)
    }
}

/// The wall of a duct.
#[derive(Debug)]
pub(crate) struct Duct;

impl Law for Duct {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "duct",
        sentence: "The wall of a smooth duct with a developed flow in it.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = 3.66 up to Re = 2300, Gnielinski \
            with Petukhov's friction from 4000 on, in proportion to Re between",
        fields: fields!("diameter", "hydraulic diameter of the duct", "\"12 mm\""),
        validity: "Ten diameters after the inlet if turbulent, 0.05 Re Pr diameters if laminar; \
            not round if laminar: another Nu.",
        groups: &[reynolds(0.0, 5e6), prandtl(0.5, 2000.0)],
        source: "Gnielinski, Int. Chem. Eng. 16 (1976) 359, and Int. J. Heat Mass Transfer 63 \
            (2013) 134; Incropera et al., 6th edition, equations 8.21, 8.55 and 8.62",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        conductance(values, nusselt_duct)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        re_and_pr(values)
    }
}
