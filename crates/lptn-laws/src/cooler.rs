//! `[cooler]`: heat exchangers between two streams, by their effectiveness.
//!
//! Each end is a place where a stream is well mixed. If a stream comes from it, its temperature is
//! that of the inlet, and q = e C_min (T_from - T_to) as printed. If `from` is after the cooler,
//! its temperature is that of the outlet, T_in - q / C_from, and the same heat is q = G / (1 - G /
//! C_from) (T_from - T_to) with G = e C_min.
//!
//! A cooler is a path between places, not between pipes. Its ends are inlets, because effectiveness
//! is published for inlets. If a flow continues to another node, that node is the outlet. The same
//! heat follows from the outlet as a positive conductance, so that no third temperature is needed.
//! Both ends cannot be outlets: in counterflow the conductance may be negative.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Group, Hints, KindDeclaration, Law,
    LawDeclaration, ResultDeclaration,
};
use crate::exchanger::{
    effectiveness_counterflow, effectiveness_crossflow, effectiveness_one_stream,
    effectiveness_parallel, effectiveness_shell,
};

/// `[cooler]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Cooler: KindDeclaration = KindDeclaration {
    section: "cooler",
    sentence: "A heat exchanger between two streams.",
    selector: Some("form"),
    example: "{ from = \"sump\", to = \"water\", form = \"counterflow\", UA = \"150 W/K\", mcp = \
        [\"90 W/K\", \"400 W/K\"] }",
    elsewhere: &[
        ("flow", "the flows are given by their capacity rates, `mcp`: mass flow times cp"),
        ("fluid", "the flows are given by their capacity rates, `mcp`: mass flow times cp"),
        ("h", "the size is `UA`, coefficient times area: `UA = \"300 [W/(m^2 K)] * 0.5 [m^2]\"`"),
        ("area", "the size is `UA`, coefficient times area"),
        ("NTU", "NTU follows from `UA` and `mcp`"),
        ("effectiveness", "it follows from `form`, `UA` and `mcp`"),
        ("correlation", "the arrangement of the streams is `form`"),
    ],
    later: &[],
    surface: None,
};

/// The largest number of transfer units: a cooler with more works like one with this number.
const MOST_UNITS: f64 = 500.0;

/// A capacity rate in W/K that counts as no flow.
const NO_FLOW: f64 = 1e-200;

/// The smallest distance of the outlet from the other inlet, as a share of the inlet's distance.
const NEAREST: f64 = 1e-12;

struct Duty<S> {
    /// Number of transfer units.
    units: S,
    effectiveness: S,
    /// The smaller capacity rate in W/K, and that of the stream of `from`.
    least: S,
    from: S,
}

/// The effectiveness of a form for N and C_r.
type Effectiveness<S> = fn(S, S) -> S;

impl<S: Scalar> Duty<S> {
    /// From UA and one or two capacity rates; `forms` are that of the cooler and that with one of
    /// the streams reversed.
    fn of(values: &[S], forms: [Effectiveness<S>; 2]) -> Self {
        let (size, none) = (values[0], S::from_f64(NO_FLOW));
        let from = values[1].abs();
        let (least, ratio) = match values.get(2).map(|to| to.abs()) {
            Some(to) => (from.min(to), from.min(to) / from.max(to).max(none)),
            None => (from, S::from_f64(0.0)),
        };
        let units = size / least.max(size / S::from_f64(MOST_UNITS)).max(none);
        let turned = values[1..].iter().filter(|rate| rate.value() < 0.0).count() % 2;
        Self { units, effectiveness: forms[turned](units, ratio), least, from }
    }

    /// G = e C_min in W/K, between the inlets.
    fn between_inlets(&self) -> S {
        self.effectiveness * self.least
    }

    /// The conductance in W/K between the outlet of `from` and the inlet of `to`.
    fn behind(&self) -> S {
        let share = self.effectiveness * (self.least / self.from.max(S::from_f64(NO_FLOW)));
        self.between_inlets() / (S::from_f64(1.0) - share).max(S::from_f64(NEAREST))
    }
}

/// Results of coolers: effectiveness, NTU, and temperatures at the streams' other ends.
fn told(values: &[f64], duty: &Duty<f64>, ends: [f64; 2], outlet: bool) -> Vec<f64> {
    let conductance = if outlet { duty.behind() } else { duty.between_inlets() };
    let heat = conductance * (ends[0] - ends[1]);
    // a fluid at rest has the same temperature at both ends
    let change = |rate: f64| if rate == 0.0 { 0.0 } else { heat / rate.abs() };
    let other = ends[0] + if outlet { change(values[1]) } else { -change(values[1]) };
    let to = values.get(2).map(|rate| ends[1] + change(*rate));
    [duty.effectiveness, duty.units, other].into_iter().chain(to).collect()
}

const fn result(key: &'static str, ty: Type, meaning: &'static str) -> ResultDeclaration {
    ResultDeclaration { key, ty, meaning, missing: "" }
}

const EFFECTIVENESS: ResultDeclaration =
    result("effectiveness", Type::SCALAR, "heat flow over the largest possible one");
const UNITS: ResultDeclaration =
    result("NTU", Type::SCALAR, "number of transfer units, UA over the smaller `mcp`");
const FROM_OUT: ResultDeclaration =
    result("T_out_from", Type::ABSOLUTE_TEMPERATURE, "outlet temperature of the stream of `from`");
const FROM_IN: ResultDeclaration = result(
    "T_in_from",
    Type::ABSOLUTE_TEMPERATURE,
    "inlet temperature of the stream of `from`, if `from` is its outlet",
);
const TO_OUT: ResultDeclaration =
    result("T_out_to", Type::ABSOLUTE_TEMPERATURE, "outlet temperature of the stream of `to`");

const SIZE: FieldDeclaration = FieldDeclaration {
    hints: Hints::CONDUCTS,
    ..FieldDeclaration::new(
        "UA",
        Type::of(Dimension::CONDUCTANCE),
        "overall coefficient times area",
        "\"150 W/K\"",
    )
};

/// The streams of `from` and `to`.
const RATES: FieldDeclaration = FieldDeclaration::new(
    "mcp",
    Type::of(Dimension::CONDUCTANCE),
    "capacity rates of the streams of `from` and `to`",
    "\"90 W/K\"",
)
.signed();

/// The one stream.
const RATE: FieldDeclaration =
    FieldDeclaration { meaning: "capacity rate of the stream of `from`", ..RATES };

/// The same if `from` is an outlet: a reversed stream would make it an inlet.
const fn forward(rate: FieldDeclaration) -> FieldDeclaration {
    FieldDeclaration { meaning: "the same if `from` is an outlet", ..rate.from_zero() }
}

/// The common part of the coolers.
const COOLER: LawDeclaration = LawDeclaration {
    name: "",
    sentence: "",
    equation: "",
    kinds: &[Kind::Cooler],
    named: true,
    fields: &[SIZE, RATES, RATES],
    carries: Carries::Conductance,
    reads_ends: false,
    form: Form::Other,
    ordered: &[],
    area: &[],
    extent: Extent::Whole,
    validity: "",
    groups: &[],
    source: "Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, table 11.3",
    idle: &[],
    confidence: Confidence::High,
};

/// At the outlet of a larger cooler the temperature differs from that of the other stream by
/// rounding only and does not determine the heat.
const TOLD_BY_OUTLET: Group = Group {
    name: "NTU",
    meaning: "number of transfer units up to which an outlet determines the heat",
    from: 0.0,
    to: 20.0,
};

/// The two laws of a form: between the inlets, and from the outlet of `from`.
macro_rules! cooler {
    ($law:ident, $outlet:ident, $name:literal, $what:literal, $equation:literal,
     [$form:ident, $turned:ident], [$($rate:ident),*], [$($to:ident)?]) => {
        #[doc = $what]
        #[derive(Debug)]
        pub(crate) struct $law;

        #[doc = concat!($what, " `from` is the outlet of its stream.")]
        #[derive(Debug)]
        pub(crate) struct $outlet;

        impl Law for $law {
            const DECLARATION: LawDeclaration = LawDeclaration {
                name: $name,
                sentence: $what,
                equation: concat!("Q = e C_min (T_from - T_to), ", $equation),
                fields: &[SIZE, $($rate),*],
                validity: "Each end has the temperature at which its stream enters.",
                ..COOLER
            };
            const RESULTS: &'static [ResultDeclaration] =
                &[EFFECTIVENESS, UNITS, FROM_OUT, $($to)?];

            fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
                Duty::of(values, [$form, $turned]).between_inlets()
            }

            fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
                told(values, &Duty::of(values, [$form, $turned]), ends, false)
            }
        }

        impl Law for $outlet {
            const DECLARATION: LawDeclaration = LawDeclaration {
                name: concat!($name, "_from_is_outlet"),
                equation: concat!("Q = G / (1 - G / C_from) (T_from - T_to), G = e C_min, ",
                    $equation),
                fields: &[SIZE, $(forward($rate)),*],
                validity: "`from` has the temperature at which its stream leaves, `to` that at \
                    which the other enters.",
                groups: &[TOLD_BY_OUTLET],
                ..<$law>::DECLARATION
            };
            const OUTLET: Option<&'static str> = Some(RATES.key);
            const RESULTS: &'static [ResultDeclaration] =
                &[EFFECTIVENESS, UNITS, FROM_IN, $($to)?];

            fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
                Duty::of(values, [$form, $turned]).behind()
            }

            fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
                vec![(values[1] > 0.0).then(|| Duty::of(values, [$form, $turned]).units)]
            }

            fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
                told(values, &Duty::of(values, [$form, $turned]), ends, true)
            }
        }
    };
}

cooler!(
    Counterflow,
    CounterflowOutlet,
    "counterflow",
    "Two streams in opposite directions.",
    "e = (1 - E) / (1 - C_r E), E = exp(-NTU (1 - C_r))",
    [effectiveness_counterflow, effectiveness_parallel],
    [RATES, RATES],
    [TO_OUT]
);
cooler!(
    Parallel,
    ParallelOutlet,
    "parallel",
    "Two streams in the same direction.",
    "e = (1 - exp(-NTU (1 + C_r))) / (1 + C_r)",
    [effectiveness_parallel, effectiveness_counterflow],
    [RATES, RATES],
    [TO_OUT]
);
cooler!(
    Crossflow,
    CrossflowOutlet,
    "crossflow_unmixed",
    "Two streams that cross, neither of them mixed.",
    "e by the exact series of J. L. Mason (1954)",
    [effectiveness_crossflow, effectiveness_crossflow],
    [RATES, RATES],
    [TO_OUT]
);
cooler!(
    Shell,
    ShellOutlet,
    "shell_and_tube",
    "A shell with one pass around tubes with two or more passes.",
    "e = 2 / (1 + C_r + s (1 + exp(-NTU s)) / (1 - exp(-NTU s))), s = sqrt(1 + C_r^2)",
    [effectiveness_shell, effectiveness_shell],
    [RATES, RATES],
    [TO_OUT]
);
cooler!(
    OneStream,
    OneStreamOutlet,
    "one_stream",
    "One stream past something of one temperature, that of `to`.",
    "e = 1 - exp(-NTU), C_min = C_from",
    [effectiveness_one_stream, effectiveness_one_stream],
    [RATE],
    []
);
