//! `[convection]`: films.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Hints, KindDeclaration, Law,
    LawDeclaration, SurfaceKind,
};

/// `[convection]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Convection: KindDeclaration = KindDeclaration {
    section: "convection",
    sentence: "A wetted surface.",
    selector: Some("correlation"),
    example: "{ from = \"a\", to = \"air\", h = \"10 W/(m^2 K)\", area = \"0.2 m^2\" }",
    elsewhere: &[
        (
            "G",
            "a convection takes `R`, or `h` and `area`; a path given by `G` belongs in [resistor]",
        ),
        ("A", "the area is `area`"),
        ("alpha", "the heat transfer coefficient is `h`"),
        ("htc", "the heat transfer coefficient is `h`"),
        ("L", "the characteristic length of a correlation is `length`, `height` or `diameter`"),
        ("u", "the velocity is `speed`"),
        ("velocity", "the velocity is `speed`"),
        ("beta", "the expansion coefficient is `expansion`"),
        ("nu", "a correlation takes the dynamic `viscosity`, nu times density"),
        ("mu", "the dynamic viscosity is `viscosity`"),
        ("Pr", "Pr follows from `viscosity`, `cp` and `k`"),
    ],
    later: &[],
    surface: Some(SurfaceKind::Wetted),
};

/// The area of a surface.
pub(crate) const AREA: FieldDeclaration = FieldDeclaration {
    hints: Hints::CONDUCTS,
    ..FieldDeclaration::new("area", Type::of(Dimension::AREA), "area of the surface", "\"0.2 m^2\"")
};

/// A film or a contact.
#[derive(Debug)]
pub(crate) struct Film;

impl Law for Film {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "film",
        sentence: "The heat flow is a heat transfer coefficient times an area times the difference \
            of the temperatures.",
        equation: "Q = h A (T_from - T_to)",
        kinds: &[Kind::Convection, Kind::Contact],
        named: false,
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
            AREA,
        ],
        carries: Carries::Conductance,
        reads_ends: false,
        form: Form::Product,
        ordered: &[],
        area: &["area"],
        extent: Extent::Divided(&["area"]),
        validity: "By definition of h, which is that of the whole area.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equations 1.3a, 3.9 and 3.20",
        idle: &[],
        confidence: Confidence::High,
        groups: &[],
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        film(values[0], values[1])
    }
}

/// Conductance of a film between a surface and a fluid: G = h A, in W/K (Newton's law of cooling).
///
/// * `h`: film coefficient in W/(m^2 K), at least 0
/// * `area`: A of the wetted surface in m^2, above 0
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations 1.3a
/// and 3.9.
pub fn film<S: Scalar>(h: S, area: S) -> S {
    h * area
}
