//! Heat carried by a stream, one-way: the end it flows into receives it, the end it leaves is not
//! affected.
//!
//! At zero flow both ends take the side of a flow that begins `from` -> `to`, so that together they
//! have one derivative, that of mcp (T_from - T_to).

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, KindDeclaration, Law, LawDeclaration,
    Range,
};

/// `[advection]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Advection: KindDeclaration = KindDeclaration {
    section: "advection",
    sentence: "A stream that carries heat one way.",
    selector: None,
    example: "{ from = \"inlet\", to = \"a\", mcp = \"50 W/K\" }",
    elsewhere: &[
        ("G", "the capacity rate of a stream is `mcp`"),
        ("m", "the mass flow is `flow`, with its `fluid`"),
        (
            "cp",
            "the specific heat belongs to the [fluid]; or give `mcp`, mass flow times specific \
             heat",
        ),
    ],
    later: &[],
    surface: None,
};

/// A flow of either sign, positive from `from` to `to`.
const fn flow(
    key: &'static str,
    dimension: Dimension,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration {
        range: Range::Finite,
        ..FieldDeclaration::new(key, Type::of(dimension), meaning, example)
    }
}

/// A stream of a known capacity rate.
#[derive(Debug)]
pub(crate) struct CapacityRate;

impl Law for CapacityRate {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "capacity_rate",
        sentence: "A stream of a known capacity rate, mass flow times specific heat.",
        equation: "Q_to = mcp (T_from - T_to)",
        kinds: &[Kind::Advection],
        named: false,
        fields: &[flow("mcp", Dimension::CONDUCTANCE, "capacity rate of the stream", "\"50 W/K\"")],
        carries: Carries::CapacityRate,
        reads_ends: false,
        form: Form::Other,
        ordered: &[],
        area: &[],
        extent: Extent::Whole,
        validity: "The stream leaves each node at the temperature of that node.",
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 1.11e",
        idle: &[("flow_T", "belongs to a volume flow of a fluid")],
        confidence: Confidence::High,
        groups: &[],
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}

/// A mass flow of a fluid.
#[derive(Debug)]
pub(crate) struct MassFlow;

impl Law for MassFlow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "mass_flow",
        sentence: "A mass flow of a fluid.",
        equation: "Q_to = flow (h(T_from) - h(T_to))",
        fields: &[flow("flow", Dimension::MASS_FLOW, "mass flow of the fluid", "\"0.05 kg/s\"")],
        carries: Carries::MassFlow,
        idle: &[("flow_T", "has no effect: `flow` is a mass flow")],
        source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, \
            equation 1.11d",
        ..CapacityRate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}

/// A volume flow of a fluid.
#[derive(Debug)]
pub(crate) struct VolumeFlow;

impl Law for VolumeFlow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "volume_flow",
        sentence: "A volume flow of a fluid, with the temperature at which it is measured.",
        equation: "Q_to = flow rho(flow_T) (h(T_from) - h(T_to))",
        fields: &[
            flow("flow", Dimension::VOLUME_FLOW, "volume flow of the fluid", "\"3 L/min\""),
            FieldDeclaration {
                range: Range::Temperature,
                ..FieldDeclaration::new(
                    "flow_T",
                    Type::ABSOLUTE_TEMPERATURE,
                    "temperature at which the volume is measured",
                    "\"20 degC\"",
                )
            },
        ],
        carries: Carries::VolumeFlow("flow_T"),
        idle: &[],
        ..MassFlow::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        values[0]
    }
}

/// Heat that `to` receives from a stream: q = max(mcp, 0) (T_from - T_to), in W.
///
/// * `mcp`: heat capacity rate in W/K, of either sign; positive from `from` to `to`
/// * `t_from`, `t_to`: temperatures in K, or in any one unit with the size of a kelvin
///
/// Positive heats `to`. The stream leaves `to` at the temperature of `to` (a well-mixed cell).
/// Source: energy equation of a well-mixed open system with constant cp: Incropera et al.,
/// Fundamentals of Heat and Mass Transfer, 6th edition, equation 1.11e.
///
/// ```
/// use lptn_laws::{advection_from, advection_to};
///
/// assert_eq!(advection_to(20.0, 350.0, 300.0), 1000.0);
/// assert_eq!(advection_from(20.0, 350.0, 300.0), 0.0);
/// assert_eq!(advection_from(-20.0, 350.0, 300.0), -1000.0); // the stream cools `from` now
/// ```
pub fn advection_to<S: Scalar>(mcp: S, t_from: S, t_to: S) -> S {
    forward(mcp) * (t_from - t_to)
}

/// Heat that `from` receives from a stream that flows backwards: q = max(-mcp, 0) (T_to - T_from),
/// in W.
///
/// Symbols, range and source as in [`advection_to`]; positive heats `from`.
pub fn advection_from<S: Scalar>(mcp: S, t_from: S, t_to: S) -> S {
    backward(mcp) * (t_to - t_from)
}

/// Heat that `to` receives from a stream, by enthalpies: q = max(m, 0) (h_from - h_to), in W.
///
/// * `flow`: m, mass flow in kg/s, of either sign; positive from `from` to `to`
/// * `h_from`, `h_to`: specific enthalpies of the fluid in J/kg at the temperatures of the two
///   ends, from one zero
///
/// Positive heats `to`. For fluids whose cp depends on temperature this closes the balance of a
/// loop exactly, which mcp at any mean temperature does not. Source: steady-flow energy equation
/// without work, kinetic and potential energy: Incropera et al., Fundamentals of Heat and Mass
/// Transfer, 6th edition, equation 1.11d.
pub fn stream_to<S: Scalar>(flow: S, h_from: S, h_to: S) -> S {
    forward(flow) * (h_from - h_to)
}

/// Heat that `from` receives from a stream that flows backwards: q = max(-m, 0) (h_to - h_from), in
/// W.
///
/// Symbols, range and source as in [`stream_to`]; positive heats `from`.
pub fn stream_from<S: Scalar>(flow: S, h_from: S, h_to: S) -> S {
    backward(flow) * (h_to - h_from)
}

/// The part of a flow along `from` -> `to`; at zero with the derivative of the flow itself.
fn forward<S: Scalar>(flow: S) -> S {
    flow.max(S::from_f64(0.0))
}

/// The part of a flow against `from` -> `to`; at zero with derivative 0.
fn backward<S: Scalar>(flow: S) -> S {
    S::from_f64(0.0).max(-flow)
}
