//! Fins on a surface.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::convection::Film;
use crate::declare::{Extent, FieldDeclaration, Form, Hints, Law, LawDeclaration, Substance};
use crate::fluid::length;

/// Below this a series replaces tanh(x)/x.
const SMALL: f64 = 1e-2;

/// Efficiency of a straight fin with an insulated tip: tanh(mL)/(mL), 1 for a fin that conducts
/// perfectly.
///
/// * `ml`: m L, at least 0, with m = sqrt(2 h / (k t)) of a fin of thickness t, and its length L
///   from root to tip
///
/// To include heat through the tip, increase L by t/2. Source: Incropera et al., Fundamentals of
/// Heat and Mass Transfer, 6th edition, equations 3.86 to 3.89.
///
/// ```
/// assert!((lptn_laws::fin_efficiency(1.0) - 0.761_594_155_955_765).abs() < 1e-15);
/// assert_eq!(lptn_laws::fin_efficiency(0.0), 1.0);
/// ```
pub fn fin_efficiency<S: Scalar>(ml: S) -> S {
    if ml.value() < SMALL {
        let square = ml * ml;
        let [one, a, b, c] = [1.0, -1.0 / 3.0, 2.0 / 15.0, -17.0 / 315.0].map(S::from_f64);
        return one + square * (a + square * (b + square * c));
    }
    ml.tanh() / ml
}

/// Conductance of a surface with straight fins, in W/K: G = h (A + eta A_fins).
///
/// * `h`: film coefficient in W/(m^2 K), at least 0, the same everywhere
/// * `bare`, `fins`: areas in m^2 of the base between the fins, and of all fins
/// * `ml`: m L, as in [`fin_efficiency`]
///
/// Source: Incropera et al., 6th edition, equation 3.101.
pub fn finned<S: Scalar>(h: S, [bare, fins]: [S; 2], ml: S) -> S {
    h * (bare + fin_efficiency(ml) * fins)
}

/// A surface with straight fins.
#[derive(Debug)]
pub(crate) struct StraightFins;

const fn area(key: &'static str, meaning: &'static str, example: &'static str) -> FieldDeclaration {
    FieldDeclaration {
        hints: Hints::MEASURE,
        ..FieldDeclaration::new(key, Type::of(Dimension::AREA), meaning, example)
    }
}

/// Conductivity of the fins.
pub(crate) const K_FIN: FieldDeclaration = FieldDeclaration {
    hints: Hints::PROPERTY,
    property: Some(Substance::Material),
    ..FieldDeclaration::new(
        "k_fin",
        Type::of(Dimension::CONDUCTIVITY),
        "thermal conductivity of the fins",
        "\"167 W/(m K)\"",
    )
};

impl Law for StraightFins {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "straight_fins",
        sentence: "A surface with straight fins, all with one heat transfer coefficient.",
        equation: "Q = h (A + eta A_fins) (T_from - T_to), eta = tanh(mL)/(mL), m = sqrt(2 h / (k \
            t)), L and t of a fin",
        kinds: &[Kind::Convection],
        named: true,
        fields: &[
            FieldDeclaration {
                hints: Hints::CONDUCTS,
                ..FieldDeclaration::new(
                    "h",
                    Type::of(Dimension::FILM_COEFFICIENT),
                    "heat transfer coefficient",
                    "\"10 W/(m^2 K)\"",
                )
            },
            area("bare_area", "area of the base between the fins", "\"0.01 m^2\""),
            area("fin_area", "area of all fins, both sides", "\"0.2 m^2\""),
            length("fin_length", "length of a fin from root to tip", "\"30 mm\""),
            length("fin_thickness", "thickness of a fin", "\"1.5 mm\""),
            K_FIN,
        ],
        form: Form::Other,
        extent: Extent::Divided(&["bare_area", "fin_area"]),
        area: &[],
        validity: "Thin fins with insulated tips; for heat through the tips `fin_length` is longer \
            by half a thickness. `from` is the base: k is taken at the mean of the ends.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations \
            3.86 to 3.89 and 3.101",
        ..Film::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let (h, length, thickness, k) = (values[0], values[3], values[4], values[5]);
        let ml = (S::from_f64(2.0) * h / (k * thickness)).sqrt() * length;
        finned(h, [values[1], values[2]], ml)
    }
}
