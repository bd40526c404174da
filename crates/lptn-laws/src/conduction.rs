//! Steady conduction through simple shapes, in one dimension.
//!
//! Source of all four: F. P. Incropera, D. P. DeWitt, T. L. Bergman, A. S. Lavine, Fundamentals of
//! Heat and Mass Transfer, 6th edition (Wiley 2007), table 3.3 (one-dimensional, steady, without
//! generation).

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Hints, KindDeclaration, Law,
    LawDeclaration, Substance,
};

/// `[conduction]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Conduction: KindDeclaration = KindDeclaration {
    section: "conduction",
    sentence: "A body of simple shape that conducts between two of its faces.",
    selector: Some("shape"),
    example: "{ from = \"a\", to = \"b\", k = \"46.6 W/(m K)\", shape = \"slab\", area = \"0.2 \
        m^2\", thickness = \"5 mm\" }",
    elsewhere: &[
        ("lambda", "the thermal conductivity is `k`"),
        ("A", "the area is `area`"),
        ("L", "the length is `length`, the thickness of a slab `thickness`"),
        ("R", "a path given by `R` belongs in [resistor]"),
    ],
    later: &[],
    surface: None,
};

const CONDUCTIVITY: FieldDeclaration = FieldDeclaration {
    hints: Hints::PROPERTY,
    property: Some(Substance::Material),
    along: true,
    ..FieldDeclaration::new(
        "k",
        Type::of(Dimension::CONDUCTIVITY),
        "thermal conductivity",
        "\"46.6 W/(m K)\"",
    )
};

const AREA: FieldDeclaration = FieldDeclaration {
    hints: Hints::CONDUCTS,
    ..FieldDeclaration::new("area", Type::of(Dimension::AREA), "area of a face", "\"0.2 m^2\"")
};

const fn length(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::measure(key, Type::of(Dimension::LENGTH), meaning, example)
}

/// The common part of the shapes.
const BODY: LawDeclaration = LawDeclaration {
    name: "",
    sentence: "",
    equation: "",
    kinds: &[Kind::Conduction],
    named: true,
    fields: &[],
    carries: Carries::Conductance,
    reads_ends: false,
    form: Form::Other,
    ordered: &[],
    area: &[],
    // no measure of a ball or of a bar is proportional to its conductance
    extent: Extent::Divided(&["k"]),
    validity: "",
    source: "",
    idle: &[],
    confidence: Confidence::High,
    groups: &[],
};

/// Conductance of a plane layer: G = k A / L, in W/K.
///
/// * `k`: conductivity in W/(m K), above 0; if it depends on temperature, its mean over the layer
/// * `area`: A in m^2, normal to the heat, above 0
/// * `thickness`: L in m, along the heat, above 0
///
/// Exact for heat in one direction: edges are insulated or far away. Source: Incropera et al., 6th
/// edition, equation 3.6.
///
/// ```
/// // 10 cm of brick, 2 m^2
/// assert!((lptn_laws::slab(0.72, 2.0, 0.1) - 14.4).abs() < 1e-12);
/// ```
pub fn slab<S: Scalar>(k: S, area: S, thickness: S) -> S {
    k * area / thickness
}

/// Conductance of a hollow cylinder, radially: G = 2 pi k L / ln(r_out / r_in), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `r_in`, `r_out`: radii in m, 0 < r_in < r_out
/// * `length`: L in m, above 0
///
/// Exact for heat that flows radially only: ends are insulated or the cylinder is long. Source:
/// Incropera et al., 6th edition, equation 3.28.
pub fn cylinder<S: Scalar>(k: S, r_in: S, r_out: S, length: S) -> S {
    S::from_f64(2.0 * PI) * k * length / (r_out / r_in).ln()
}

/// Conductance of a hollow sphere, radially: G = 4 pi k / (1/r_in - 1/r_out), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `r_in`, `r_out`: radii in m, 0 < r_in < r_out
///
/// Evaluated as 4 pi k r_in r_out / (r_out - r_in), which does not cancel in thin shells. Source:
/// Incropera et al., 6th edition, equation 3.36.
pub fn sphere<S: Scalar>(k: S, r_in: S, r_out: S) -> S {
    S::from_f64(4.0 * PI) * k * r_in * r_out / (r_out - r_in)
}

/// Conductance of a round rod, along its axis: G = k pi d^2 / (4 L), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `diameter`: d in m, above 0
/// * `length`: L in m, above 0
///
/// A plane layer with the area of the cross-section; the skin is insulated. Source: Incropera et
/// al., 6th edition, equation 3.6.
pub fn rod<S: Scalar>(k: S, diameter: S, length: S) -> S {
    slab(k, S::from_f64(PI / 4.0) * diameter * diameter, length)
}

/// A plane layer, across it.
#[derive(Debug)]
pub(crate) struct Slab;

impl Law for Slab {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "slab",
        sentence: "A plane layer, across it.",
        equation: "Q = k A / L (T_from - T_to)",
        fields: &[CONDUCTIVITY, AREA, length("thickness", "distance of the faces", "\"5 mm\"")],
        area: &["area"],
        extent: Extent::Divided(&["area"]),
        validity: "Heat in one direction: edges are insulated or far away.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 3.6",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        slab(values[0], values[1], values[2])
    }
}

/// A hollow cylinder, from its inner to its outer surface.
#[derive(Debug)]
pub(crate) struct Cylinder;

impl Law for Cylinder {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "cylinder",
        sentence: "A hollow cylinder, from its inner to its outer surface.",
        equation: "Q = 2 pi k L / ln(r_out / r_in) (T_from - T_to)",
        fields: &[
            CONDUCTIVITY,
            length("r_in", "inner radius", "\"20 mm\""),
            length("r_out", "outer radius", "\"25 mm\""),
            length("length", "length", "\"0.3 m\""),
        ],
        ordered: &[["r_in", "r_out"]],
        extent: Extent::Divided(&["length"]),
        validity: "Heat that flows radially only: ends are insulated or the cylinder is long.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 3.28",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        cylinder(values[0], values[1], values[2], values[3])
    }
}

/// A hollow sphere, from its inner to its outer surface.
#[derive(Debug)]
pub(crate) struct Sphere;

impl Law for Sphere {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "sphere",
        sentence: "A hollow sphere, from its inner to its outer surface.",
        equation: "Q = 4 pi k / (1/r_in - 1/r_out) (T_from - T_to)",
        fields: &[
            CONDUCTIVITY,
            length("r_in", "inner radius", "\"20 mm\""),
            length("r_out", "outer radius", "\"25 mm\""),
        ],
        ordered: &[["r_in", "r_out"]],
        validity: "Heat that flows radially.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 3.36",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        sphere(values[0], values[1], values[2])
    }
}

/// A round bar, along its axis.
#[derive(Debug)]
pub(crate) struct Rod;

impl Law for Rod {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "rod",
        sentence: "A round bar, along its axis.",
        equation: "Q = k pi d^2 / (4 L) (T_from - T_to)",
        fields: &[
            CONDUCTIVITY,
            length("diameter", "diameter", "\"20 mm\""),
            length("length", "length", "\"0.3 m\""),
        ],
        validity: "The outer surface is insulated.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 3.6",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        rod(values[0], values[1], values[2])
    }
}
