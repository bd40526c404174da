//! The common part of the laws of losses: heat of friction at a speed, which is the same for both
//! directions of rotation and 0 at rest.
//!
//! The published formulas take speeds in rpm, lengths in mm and viscosities in mm^2/s; their
//! constants are as printed.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Group, Hints, Law, LawDeclaration,
    Substance,
};

/// The speed of a shaft.
pub(crate) const SPEED: FieldDeclaration = FieldDeclaration::new(
    "speed",
    Type::of(Dimension::ANGULAR_VELOCITY),
    "speed of rotation, of either direction",
    "\"1500 rpm\"",
)
.signed();

/// The viscosity of the oil, or of the base oil of a grease.
pub(crate) const VISCOSITY: FieldDeclaration = FieldDeclaration {
    hints: Hints::GIVEN,
    property: Some(Substance::Lubricant),
    ..FieldDeclaration::new(
        "nu",
        Type::of(Dimension::KINEMATIC_VISCOSITY),
        "kinematic viscosity of the lubricant at its temperature; of the base oil of a grease",
        "\"60 mm^2/s\"",
    )
};

/// The lower end of the curves of lubricants: below it ASTM D341 is an extrapolation. It changes no
/// faster than temperatures do.
pub const THIN_OIL: Group = Group {
    name: "nu",
    meaning: "viscosity of the lubricant in mm^2/s",
    from: 2.0,
    to: f64::INFINITY,
};

/// The viscosity in mm^2/s of the values of a law; `None` at rest, when nothing is lost.
pub(crate) fn viscosity<L: Law>(values: &[f64]) -> Option<f64> {
    let of = |key| L::DECLARATION.fields.iter().position(|field| field.key == key);
    let (nu, speed) = (values[of(VISCOSITY.key)?], values[of(SPEED.key)?]);
    (speed.abs() > 0.0).then_some(mm2_per_s(nu))
}

/// A length of a part.
pub(crate) const fn length(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::measure(key, Type::of(Dimension::LENGTH), meaning, example)
}

/// The common part of the laws.
pub(crate) const LOSS: LawDeclaration = LawDeclaration {
    name: "",
    sentence: "",
    equation: "",
    kinds: &[],
    named: true,
    fields: &[],
    carries: Carries::Heat,
    reads_ends: false,
    form: Form::Other,
    ordered: &[],
    area: &[],
    extent: Extent::Whole,
    validity: "",
    groups: &[],
    source: "",
    idle: &[],
    confidence: Confidence::High,
};

/// A speed in rpm without its sign, from rad/s.
pub(crate) fn rpm<S: Scalar>(speed: S) -> S {
    speed.abs() * S::from_f64(30.0 / PI)
}

/// A length in mm, from m.
pub(crate) fn mm<S: Scalar>(length: S) -> S {
    length * S::from_f64(1e3)
}

/// A viscosity in mm^2/s, from m^2/s.
pub(crate) fn mm2_per_s<S: Scalar>(viscosity: S) -> S {
    viscosity * S::from_f64(1e6)
}
