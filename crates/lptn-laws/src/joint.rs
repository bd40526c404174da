//! Solids that touch at the peaks of their roughness: the conductance of a joint under pressure.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Group, Hints, Law, LawDeclaration,
};

/// Below this p/H the law is continued by the straight line through 0, so that its slope is finite
/// if two bodies only just touch. It is a thousandth of the smallest known pressure.
const LEAST: f64 = 1e-9;

/// Contact conductance of a joint: h = 1.25 ks (m / sigma) (p / H)^0.95 + h_gap, in W/(m^2 K), with
/// ks = 2 k1 k2 / (k1 + k2).
///
/// * `k`: conductivities of the two bodies in W/(m K), above 0
/// * `surface`: mean absolute slope m of the asperities, roughness sigma in m (rms; both of the two
///   surfaces together, the root of the sum of squares), microhardness H of the softer one in Pa;
///   above 0
/// * `pressure`: p in Pa, at least 0
/// * `gap`: conductance of the medium in the gaps, in W/(m^2 K), at least 0; of a gas kg / (Y + M)
///
/// Surfaces are rough, conforming and pressed together for the first time, so that asperities flow.
/// Below p/H = 1e-9 the power is replaced by the straight line to 0.
///
/// Source: M. G. Cooper, B. B. Mikic, M. M. Yovanovich, Thermal contact conductance, International
/// Journal of Heat and Mass Transfer 12 (1969) 279-300; the correlation: M. M. Yovanovich, Thermal
/// contact correlations, Progress in Astronautics and Aeronautics 83 (1982) 83-95; printed in
/// Mechanical Engineers' Handbook, volume 4, Cooling Electronic Equipment, equation 8a.
pub fn contact_conductance<S: Scalar>(k: [S; 2], surface: [S; 3], pressure: S, gap: S) -> S {
    let [slope, roughness, hardness] = surface;
    let harmonic = S::from_f64(2.0) * k[0] * k[1] / (k[0] + k[1]);
    let relative = pressure / hardness;
    let touching = if relative.value() > LEAST {
        relative.powf(0.95)
    } else {
        relative * S::from_f64(LEAST.powf(-0.05))
    };
    S::from_f64(1.25) * harmonic * slope / roughness * touching + gap
}

/// The conductivities of the two bodies, one after the other.
pub(crate) const CONDUCTIVITY: FieldDeclaration = FieldDeclaration {
    hints: Hints::PROPERTY,
    ..FieldDeclaration::new(
        "k",
        Type::of(Dimension::CONDUCTIVITY),
        "conductivity of each body",
        "\"50 W/(m K)\"",
    )
};

pub(crate) const SLOPE: FieldDeclaration = FieldDeclaration::given(
    "slope",
    "mean absolute slope of the asperities, of both surfaces together",
    "0.15",
);

pub(crate) const ROUGHNESS: FieldDeclaration = FieldDeclaration::measure(
    "roughness",
    Type::of(Dimension::LENGTH),
    "rms roughness of both surfaces together",
    "\"1 um\"",
);

pub(crate) const HARDNESS: FieldDeclaration = FieldDeclaration {
    hints: Hints::PROPERTY,
    ..FieldDeclaration::new(
        "hardness",
        Type::of(Dimension::PRESSURE),
        "microhardness of the softer body",
        "\"2.5 GPa\"",
    )
};

pub(crate) const GAP: FieldDeclaration = FieldDeclaration::new(
    "h_gap",
    Type::of(Dimension::FILM_COEFFICIENT),
    "conductance of the filling of the gaps: of a gas, its k over its thickness",
    "\"2500 W/(m^2 K)\"",
)
.from_zero()
.or(0.0);

/// The pressure relative to the hardness.
pub(crate) const RELATIVE_PRESSURE: Group =
    Group { name: "p/H", meaning: "pressure over microhardness", from: 1e-6, to: 2.3e-2 };

/// A joint under pressure.
#[derive(Debug)]
pub(crate) struct Joint;

impl Law for Joint {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "joint",
        sentence: "Two rough surfaces that are pressed together.",
        equation: "Q = (1.25 ks (m / sigma) (p / H)^0.95 + h_gap) A (T_from - T_to), ks = 2 k1 k2 \
            / (k1 + k2)",
        kinds: &[Kind::Contact],
        named: false,
        fields: &[
            FieldDeclaration {
                hints: Hints::CONDUCTS,
                ..FieldDeclaration::new(
                    "pressure",
                    Type::of(Dimension::PRESSURE),
                    "nominal pressure on the joint",
                    "\"2 MPa\"",
                )
            }
            .from_zero(),
            CONDUCTIVITY,
            CONDUCTIVITY,
            SLOPE,
            ROUGHNESS,
            HARDNESS,
            FieldDeclaration {
                hints: Hints::CONDUCTS,
                ..FieldDeclaration::new(
                    "area",
                    Type::of(Dimension::AREA),
                    "area of the surface",
                    "\"0.2 m^2\"",
                )
            },
            GAP,
        ],
        carries: Carries::Conductance,
        reads_ends: false,
        form: Form::Other,
        ordered: &[],
        area: &["area"],
        extent: Extent::Divided(&["area"]),
        validity: "Conforming rough surfaces under their first load, whose asperities flow. The \
            range of p/H was not read in the source.",
        groups: &[RELATIVE_PRESSURE],
        source: "M. G. Cooper, B. B. Mikic, M. M. Yovanovich, Int. J. Heat Mass Transfer 12 (1969) \
            279-300; M. M. Yovanovich, Thermal contact correlations (1982)",
        idle: &[],
        confidence: Confidence::High,
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let [pressure, k1, k2, slope, roughness, hardness, area, gap] =
            std::array::from_fn(|i| values[i]);
        contact_conductance([k1, k2], [slope, roughness, hardness], pressure, gap) * area
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![(values[0] > 0.0).then(|| values[0] / values[5])]
    }
}
