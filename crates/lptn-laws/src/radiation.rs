//! Radiation between grey, diffuse surfaces.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Hints, KindDeclaration, Law,
    LawDeclaration, Range, SurfaceKind,
};

/// `[radiation]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Radiation: KindDeclaration = KindDeclaration {
    section: "radiation",
    sentence: "Two grey, diffuse surfaces that see each other.",
    selector: None,
    example: "{ from = \"a\", to = \"walls\", emissivity = 0.8, area = \"0.2 m^2\" }",
    elsewhere: &[
        ("epsilon", "the emissivity is `emissivity`"),
        ("F", "the view factor is `view_factor`"),
        ("A", "the area is `area`"),
        ("h", "a heat transfer coefficient with an area belongs in [convection]"),
    ],
    later: &[],
    surface: Some(SurfaceKind::Seen),
};

const AREA: Type = Type::of(Dimension::AREA);

const EMISSIVITY: FieldDeclaration = FieldDeclaration {
    range: Range::Fraction,
    ..FieldDeclaration::new("emissivity", Type::SCALAR, "emissivity", "0.8")
};

const SEEN: FieldDeclaration = FieldDeclaration {
    hints: Hints::CONDUCTS,
    ..FieldDeclaration::new(
        "area",
        AREA,
        "area that emissivity and view factor refer to",
        "\"0.2 m^2\"",
    )
};

const VIEW_FACTOR: FieldDeclaration = FieldDeclaration {
    range: Range::Fraction,
    default: Some(1.0),
    ..FieldDeclaration::new(
        "view_factor",
        Type::SCALAR,
        "view factor from the area to the other surface",
        "0.9",
    )
};

/// An exchange area.
#[derive(Debug)]
pub(crate) struct ExchangeArea;

impl Law for ExchangeArea {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "exchange_area",
        sentence: "Two surfaces with a known exchange area: area, view factor and emissivities in \
            one.",
        equation: "Q = sigma Gr (T_from^4 - T_to^4)",
        kinds: &[Kind::Radiation],
        named: false,
        fields: &[FieldDeclaration {
            hints: Hints::CONDUCTS,
            ..FieldDeclaration::new("Gr", AREA, "exchange area", "\"0.16 m^2\"")
        }],
        carries: Carries::Radiation,
        reads_ends: false,
        form: Form::Product,
        ordered: &[],
        area: &[],
        extent: Extent::Divided(&["Gr"]),
        validity: "Nothing absorbs between the surfaces.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equations 1.8 and 1.9",
        idle: &[("view_factor", "has no effect: `Gr` includes it")],
        confidence: Confidence::High,
        groups: &[],
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}

/// Two surfaces with an effective emissivity.
#[derive(Debug)]
pub(crate) struct GreySurfaces;

impl Law for GreySurfaces {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "grey_surfaces",
        sentence: "Two surfaces with an effective emissivity of the pair, an area and a view \
            factor.",
        equation: "Q = sigma e A F (T_from^4 - T_to^4)",
        fields: &[EMISSIVITY, SEEN, VIEW_FACTOR],
        area: &["area", "view_factor"],
        idle: &[],
        extent: Extent::Divided(&["area"]),
        validity: "Exact for e = 1 (black surfaces) and for F = 1 (an enclosure of two); else \
            reflected radiation is assumed to leave.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equations 13.17 and 13.18",
        ..ExchangeArea::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        radiation_exchange_area(values[0], values[1], values[2])
    }
}

/// Two parallel plates.
#[derive(Debug)]
pub(crate) struct ParallelPlates;

impl Law for ParallelPlates {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "parallel_plates",
        sentence: "Two parallel plates that face each other, with the emissivity of each.",
        equation: "Q = sigma A F (T_from^4 - T_to^4) / (1/e1 + 1/e2 - 1)",
        fields: &[EMISSIVITY, EMISSIVITY, SEEN, VIEW_FACTOR],
        form: Form::Other,
        validity: "The gap is small against the plates.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 13.19 (table 13.3)",
        ..GreySurfaces::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let emissivity = effective_emissivity_parallel_plates(values[0], values[1]);
        radiation_exchange_area(emissivity, values[2], values[3])
    }
}

/// The Stefan-Boltzmann constant in W/(m^2 K^4).
///
/// Exact since the SI of 2019: 2 pi^5 k^4 / (15 h^3 c^2). CODATA 2018 and 2022 print
/// 5.670374419...e-8. The printed digits are kept here, as in other programs; the next would change
/// it by 3e-11.
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Conductance of radiation: G = sigma gr (Ta^2 + Tb^2) (Ta + Tb), in W/K.
///
/// * `gr`: exchange area in m^2, at least 0 ([`radiation_exchange_area`])
/// * `t_from`, `t_to`: absolute temperatures in K, at least 0
///
/// The heat is q = G (T_from - T_to) = sigma gr (T_from^4 - T_to^4), positive from `from` to `to`.
/// This form avoids cancellation at close temperatures, and at dT = 0 the derivative is 4 sigma gr
/// T^3.
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations 1.8 and
/// 1.9.
pub fn radiation_conductance<S: Scalar>(gr: S, t_from: S, t_to: S) -> S {
    S::from_f64(STEFAN_BOLTZMANN) * gr * (t_from * t_from + t_to * t_to) * (t_from + t_to)
}

/// Exchange area of two surfaces: Gr = e A F, in m^2.
///
/// * `emissivity`: effective emissivity of the pair, 0 to 1
///   ([`effective_emissivity_parallel_plates`]; the emissivity of a small body in a large room)
/// * `area`: A of the surface that `view_factor` and `emissivity` refer to, in m^2, above 0
/// * `view_factor`: F from that area to the other surface, 0 to 1. It is 1 if the effective
///   emissivity already includes the geometry
///
/// With e = 1 the exchange of black surfaces; with F = 1 that of a two-surface enclosure; with both
/// below 1 an approximation, as the reflected part is taken to leave. Source: Incropera et al.,
/// Fundamentals of Heat and Mass Transfer, 6th edition, equations 13.17 (black) and 13.18
/// (enclosure).
pub fn radiation_exchange_area<S: Scalar>(emissivity: S, area: S, view_factor: S) -> S {
    emissivity * area * view_factor
}

/// Effective emissivity of two large parallel plates: e = 1 / (1/e1 + 1/e2 - 1).
///
/// * `e1`, `e2`: emissivities, 0 to 1, one of them above 0
///
/// Evaluated as e1 e2 / (e2 + e1 (1 - e2)), which also takes a perfect mirror. The gap is small
/// against the plates. Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th
/// edition, equation 13.19 (table 13.3).
///
/// ```
/// assert!((lptn_laws::effective_emissivity_parallel_plates(0.5, 0.5) - 1.0 / 3.0).abs() < 1e-15);
/// ```
pub fn effective_emissivity_parallel_plates<S: Scalar>(e1: S, e2: S) -> S {
    e1 * e2 / (e2 + e1 * (S::from_f64(1.0) - e2))
}
