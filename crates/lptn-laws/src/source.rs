//! `[source]`: heat that is given.
//!
//! A source is a law too. A kind whose laws carry `Heat` has `into` instead of ends; `[source]` is
//! the kind whose law is a given heat. Losses that read the temperature of their oil therefore use
//! the same dual numbers, checks and expansion as paths. The power that the shaft loses is the heat
//! that the nodes receive.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, KindDeclaration, Law, LawDeclaration,
    Range,
};

/// `[source]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Source: KindDeclaration = KindDeclaration {
    section: "source",
    sentence: "Heat that goes into a node, into several, or into a grid.",
    selector: None,
    example: "{ into = \"a\", P = \"100 W\" }",
    elsewhere: &[
        ("in", "the node that is heated is `into`"),
        ("Q", "the heat is `P`"),
        ("node", "the node that is heated is `into`"),
        ("to", "the node that is heated is `into`"),
    ],
    later: &[],
    surface: None,
};

/// Heat that is known.
#[derive(Debug)]
pub(crate) struct Given;

impl Law for Given {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "given",
        sentence: "Heat that is known, as a number or an expression.",
        equation: "Q = P, in shares that sum to 1",
        kinds: &[Kind::Source],
        named: false,
        fields: &[FieldDeclaration {
            range: Range::Finite,
            ..FieldDeclaration::new(
                "P",
                Type::of(Dimension::POWER),
                "heat flow, may depend on time, signals, controls and temperatures",
                "\"100 W\"",
            )
        }],
        carries: Carries::Heat,
        reads_ends: false,
        form: Form::Product,
        ordered: &[],
        area: &[],
        extent: Extent::Divided(&["P"]),
        validity: "By definition.",
        groups: &[],
        source: "Definition of a heat flow",
        idle: &[],
        confidence: Confidence::High,
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}
