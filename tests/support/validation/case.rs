//! `case.json` as a type: whatever the format does not know is an error.

use serde::Deserialize;
use serde_json::Value;

use super::expected::Expected;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    pub format: Format,
    pub id: String,
    pub title: String,
    pub kinds: Vec<String>,
    pub provenance: String,
    pub source: String,
    pub proves: String,
    pub license: Option<String>,
    pub notes: Option<String>,
    #[serde(default)]
    pub requires: Vec<Feature>,
    /// Advice to the checker of the set; lptn chooses its own method.
    pub solver_hint: Option<String>,
    /// Advice to solvers that might step over a kink of C(T), in s.
    pub max_step: Option<f64>,
    /// The run goes on at least until here, in s.
    pub t_end: Option<f64>,
    pub temperature_unit: TemperatureUnit,
    #[serde(rename = "celsius_zero_K", default = "celsius_zero")]
    pub celsius_zero: f64,
    pub nodes: Vec<Node>,
    pub edges: Vec<Edge>,
    pub sources: Vec<Source>,
    pub expected: Vec<Expected>,
    pub calibration: Option<Calibration>,
}

/// Error in K of the numbers of closed forms: those of series and of roots are the largest.
const CLOSED_FORM: f64 = 1e-9;

/// A formula with a larger allowance in K is that of another model, of a continuum.
const MODEL: f64 = 1e-3;

fn celsius_zero() -> f64 {
    lptn_network::ZERO_CELSIUS
}

impl Case {
    /// What has to be added to a temperature of the case to have it in K.
    pub fn zero(&self) -> f64 {
        match self.temperature_unit {
            TemperatureUnit::K => 0.0,
            TemperatureUnit::C => self.celsius_zero,
        }
    }

    /// A hundredth of the smallest tolerance of a transient temperature, at least 1e-9 K; 1e-7 K if
    /// there is none.
    pub fn tolerance(&self) -> f64 {
        let transient = self.expected.iter().filter(|e| e.is_transient_temperature());
        let least = transient.map(Expected::allowed).fold(f64::INFINITY, f64::min);
        if least.is_finite() { (least / 100.0).max(1e-9) } else { 1e-7 }
    }

    /// The error in K of an expected temperature: that of the source, and rounding if it follows from
    /// a formula. More is allowed for a formula only where cells approximate a continuum.
    pub fn own_error(&self, expected: &Expected) -> f64 {
        let exact =
            ["closed form", "exact solution"].iter().any(|of| self.provenance.starts_with(of));
        let allowed = expected.allowed();
        if exact && allowed <= MODEL { allowed.min(CLOSED_FORM) } else { allowed }
    }

    /// The functions of time that are tables.
    fn tables(&self) -> impl Iterator<Item = &Table> {
        let boundaries = self.nodes.iter().filter_map(|node| match node {
            Node::Boundary { temperature, .. } => Some(temperature),
            _ => None,
        });
        let streams = self.edges.iter().filter_map(|edge| match edge {
            Edge::Advection { mcp, .. } => Some(mcp),
            _ => None,
        });
        let heats = self.sources.iter().filter_map(|source| match source {
            Source::Heat { heat, .. } => Some(heat),
            Source::Resistor { .. } => None,
        });
        boundaries.chain(streams).chain(heats).filter_map(|of_time| match of_time {
            TimeFunction::Table(table) => Some(table),
            _ => None,
        })
    }

    /// The times in `[from, to]` at which an input may bend or jump, ascending.
    pub fn breaks(&self, from: f64, to: f64) -> Vec<f64> {
        let mut breaks: Vec<f64> = self.tables().flat_map(|table| table.breaks(from, to)).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub enum Format {
    #[serde(rename = "lptn-validation-1")]
    One,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub enum TemperatureUnit {
    K,
    C,
}

/// What a case cannot be expressed without.
#[derive(Clone, Copy, Debug, Deserialize)]
pub enum Feature {
    #[serde(rename = "temperature-dependent capacitance")]
    CapacityOverTemperature,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub enum Node {
    Capacitance {
        id: String,
        #[serde(rename = "C")]
        capacity: f64,
        #[serde(rename = "T0")]
        initial: f64,
        #[serde(rename = "C_of_T")]
        over_temperature: Option<CapacityCurve>,
    },
    Boundary {
        id: String,
        #[serde(rename = "T")]
        temperature: TimeFunction,
    },
    Massless {
        id: String,
        /// Only a start value: lptn finds its own.
        #[serde(rename = "T_guess")]
        guess: Option<f64>,
    },
}

impl Node {
    pub fn id(&self) -> &str {
        match self {
            Self::Capacitance { id, .. }
            | Self::Boundary { id, .. }
            | Self::Massless { id, .. } => id,
        }
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum CapacityCurve {
    /// `1 + beta (T - Tref)`.
    Linear {
        beta: f64,
        #[serde(rename = "Tref")]
        reference: f64,
    },
    /// Straight lines, held outside.
    Table {
        #[serde(rename = "T")]
        temperatures: Vec<f64>,
        factor: Vec<f64>,
    },
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Edge {
    Conductance {
        id: String,
        a: String,
        b: String,
        #[serde(rename = "G")]
        conductance: f64,
    },
    Convection {
        id: String,
        a: String,
        b: String,
        h: f64,
        #[serde(rename = "A")]
        area: f64,
    },
    ConvectionPower {
        id: String,
        a: String,
        b: String,
        c: f64,
        n: f64,
    },
    #[serde(rename = "conductance_linear_T")]
    ConductanceLinear {
        id: String,
        a: String,
        b: String,
        #[serde(rename = "G0")]
        conductance: f64,
        beta: f64,
        #[serde(rename = "Tref")]
        reference: f64,
        at: At,
    },
    Radiation {
        id: String,
        a: String,
        b: String,
        #[serde(rename = "epsA")]
        exchange: f64,
        sigma: f64,
    },
    Advection {
        id: String,
        a: String,
        b: String,
        mcp: TimeFunction,
    },
}

impl Edge {
    pub fn id(&self) -> &str {
        match self {
            Self::Conductance { id, .. }
            | Self::Convection { id, .. }
            | Self::ConvectionPower { id, .. }
            | Self::ConductanceLinear { id, .. }
            | Self::Radiation { id, .. }
            | Self::Advection { id, .. } => id,
        }
    }
}

/// The temperature that a conductance depends on.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum At {
    Mean,
    A,
    B,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Source {
    Heat {
        id: String,
        node: String,
        #[serde(rename = "Q")]
        heat: TimeFunction,
        #[serde(rename = "T_coeff")]
        coefficient: Option<Coefficient>,
        gate: Option<Gate>,
    },
    Resistor {
        id: String,
        node: String,
        #[serde(rename = "V")]
        voltage: f64,
        #[serde(rename = "R")]
        resistance: f64,
        alpha: f64,
        #[serde(rename = "Tref")]
        reference: f64,
        gate: Option<Gate>,
    },
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coefficient {
    pub alpha: f64,
    #[serde(rename = "Tref")]
    pub reference: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gate {
    pub sensor: String,
    pub setpoint: TimeFunction,
    pub band: f64,
    pub initial_on: bool,
}

/// A number, a table or a sine over time.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Value")]
pub enum TimeFunction {
    Constant(f64),
    Table(Table),
    Sine(Sine),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    pub t: Vec<f64>,
    pub v: Vec<f64>,
    pub interp: Interpolation,
    pub period: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    Linear,
    Previous,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sine {
    pub mean: f64,
    pub amp: f64,
    pub omega: f64,
    #[serde(default)]
    pub phase: f64,
}

impl TryFrom<Value> for TimeFunction {
    type Error = serde_json::Error;

    fn try_from(value: Value) -> Result<Self, Self::Error> {
        #[derive(Deserialize)]
        #[serde(tag = "kind", rename_all = "lowercase")]
        enum Kind {
            Table(Table),
            Sine(Sine),
        }
        if let Some(constant) = value.as_f64() {
            return Ok(Self::Constant(constant));
        }
        Ok(match serde_json::from_value(value)? {
            Kind::Table(table) => Self::Table(table),
            Kind::Sine(sine) => Self::Sine(sine),
        })
    }
}

impl Table {
    fn breaks(&self, from: f64, to: f64) -> Vec<f64> {
        let first = self.period.map_or(0.0, |period| (from / period).floor());
        let turns = self.period.map_or(0.0, |period| (to / period).ceil() - first).max(0.0);
        let offsets = (0..=turns as usize).map(|k| (first + k as f64) * self.period.unwrap_or(0.0));
        let times = offsets.flat_map(|offset| self.t.iter().map(move |t| t + offset));
        times.filter(|t| *t >= from && *t <= to).collect()
    }
}

/// What `calibrated` and `calibration_rms` are about.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    pub data: String,
    pub time_column: String,
    pub observations: Vec<Observation>,
    pub objective: String,
    pub parameters: Vec<Calibrated>,
    pub note: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Observation {
    pub node: String,
    pub column: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibrated {
    pub name: String,
    pub initial: f64,
    pub targets: Vec<Target>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    pub list: String,
    pub id: String,
    pub field: String,
    pub table_scale: Option<bool>,
    pub scale: Option<f64>,
}
