//! `[resistor]`: paths given by their resistance or conductance.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Hints, KindDeclaration, Law,
    LawDeclaration,
};

/// `[resistor]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Resistor: KindDeclaration = KindDeclaration {
    section: "resistor",
    sentence: "A path that is given by its resistance or conductance.",
    selector: None,
    example: "{ from = \"a\", to = \"b\", R = \"0.3 K/W\" }",
    elsewhere: &[
        ("Rth", "the resistance is `R`"),
        ("R_th", "the resistance is `R`"),
        ("resistance", "the resistance is `R`"),
        ("k", "a conductivity with a shape belongs in [conduction]"),
        ("h", "a heat transfer coefficient with an area belongs in [convection]"),
        ("area", "a heat transfer coefficient with an area belongs in [convection]"),
    ],
    later: &[],
    surface: None,
};

/// A thermal resistance.
#[derive(Debug)]
pub(crate) struct Resistance;

impl Law for Resistance {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "resistance",
        sentence: "The heat flow is the difference of the temperatures over a resistance.",
        equation: "Q = (T_from - T_to) / R",
        kinds: &[Kind::Resistor, Kind::Convection],
        named: false,
        fields: &[FieldDeclaration {
            hints: Hints::RESISTS,
            ..FieldDeclaration::new(
                "R",
                Type::of(Dimension::RESISTANCE),
                "thermal resistance",
                "\"0.3 K/W\"",
            )
        }],
        carries: Carries::Conductance,
        reads_ends: false,
        form: Form::Reciprocal,
        ordered: &[],
        area: &[],
        extent: Extent::Multiplied("R"),
        validity: "By definition.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 3.6",
        idle: &[],
        confidence: Confidence::High,
        groups: &[],
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        S::from_f64(1.0) / values[0]
    }
}

/// A thermal conductance.
#[derive(Debug)]
pub(crate) struct Conductance;

impl Law for Conductance {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "conductance",
        sentence: "The heat flow is a conductance times the difference of the temperatures.",
        equation: "Q = G (T_from - T_to)",
        kinds: &[Kind::Resistor],
        fields: &[FieldDeclaration {
            hints: Hints::CONDUCTS,
            ..FieldDeclaration::new(
                "G",
                Type::of(Dimension::CONDUCTANCE),
                "thermal conductance",
                "\"3 W/K\"",
            )
        }],
        form: Form::Product,
        extent: Extent::Divided(&["G"]),
        ..Resistance::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}
