//! Expected values: what is asked for, and how close an answer has to come.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Map, Value};

/// One expected value.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Map<String, Value>")]
pub struct Expected {
    pub quantity: Quantity,
    /// `quantity` as it is written.
    pub name: String,
    pub value: f64,
    tolerances: Tolerances,
}

#[derive(Clone, Copy, Debug, Deserialize)]
struct Tolerances {
    #[serde(default)]
    tol_abs: f64,
    #[serde(default)]
    tol_rel: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "quantity", deny_unknown_fields)]
pub enum Quantity {
    T {
        node: Option<String>,
        /// Taken from the temperature of `node`.
        minus: Option<String>,
        /// Nodes with the factors of a sum.
        combine: Option<BTreeMap<String, f64>>,
        t: Moment,
        #[serde(default)]
        side: Side,
    },
    #[serde(rename = "T_mean")]
    MeanTemperature { node: String, t0: f64, t1: f64 },
    #[serde(rename = "Q_edge")]
    EdgeHeat {
        edge: String,
        t: Moment,
        #[serde(default)]
        side: Side,
    },
    #[serde(rename = "Q_boundary")]
    BoundaryHeat {
        node: String,
        t: Moment,
        #[serde(default)]
        side: Side,
    },
    #[serde(rename = "Q_boundary_mean")]
    MeanBoundaryHeat { node: String, t0: f64, t1: f64 },
    #[serde(rename = "crossing_time")]
    Crossing {
        node: String,
        level: f64,
        t_end: Option<f64>,
        #[serde(default)]
        after: f64,
        #[serde(default)]
        direction: Direction,
    },
    #[serde(rename = "time_constant")]
    TimeConstant {
        index: usize,
        #[serde(default)]
        skip_zero: bool,
    },
    #[serde(rename = "mode_ratio")]
    ModeRatio { index: usize, node: String, over: String },
    #[serde(rename = "R_port")]
    PortResistance { node: String },
    #[serde(rename = "R_transfer")]
    TransferResistance { node: String, source_node: String },
    #[serde(rename = "C_total")]
    TotalCapacity {},
    #[serde(rename = "fit_Ti")]
    FitInitial(Fit),
    #[serde(rename = "fit_Tf")]
    FitSettled(Fit),
    #[serde(rename = "fit_tau")]
    FitTau(Fit),
    #[serde(rename = "fit_rms")]
    FitRms(Fit),
    #[serde(rename = "size")]
    Size {
        edge: Option<String>,
        source: Option<String>,
        field: String,
        node: String,
        limit: f64,
        lo: f64,
        hi: f64,
    },
    #[serde(rename = "freq_gain")]
    FrequencyGain(Frequency),
    #[serde(rename = "freq_phase")]
    FrequencyPhase(Frequency),
    #[serde(rename = "gate_first_switch")]
    GateFirstSwitch { t_end: Option<f64> },
    #[serde(rename = "gate_on_time")]
    GateOnTime { t_end: Option<f64> },
    #[serde(rename = "gate_period")]
    GatePeriod { t_end: Option<f64> },
    #[serde(rename = "calibrated")]
    Calibrated { param: String },
    #[serde(rename = "calibration_rms")]
    CalibrationRms {},
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    pub node: String,
    pub t0: f64,
    pub t1: f64,
    pub n: usize,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frequency {
    pub input_source: Option<String>,
    pub input_boundary: Option<String>,
    pub node: String,
    pub omega: f64,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Value")]
pub enum Moment {
    Steady,
    At(f64),
}

/// On which side of a jump a value is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    #[default]
    Left,
    Right,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    #[default]
    Rising,
    Falling,
}

impl TryFrom<Value> for Moment {
    type Error = String;

    fn try_from(value: Value) -> Result<Self, String> {
        match (value.as_f64(), value.as_str()) {
            (Some(time), _) => Ok(Self::At(time)),
            (_, Some("steady")) => Ok(Self::Steady),
            _ => Err(format!("`t` is {value}, neither seconds nor \"steady\"")),
        }
    }
}

/// Takes what every expected value has out of the way, so that the rest can be read strictly.
impl TryFrom<Map<String, Value>> for Expected {
    type Error = String;

    fn try_from(mut map: Map<String, Value>) -> Result<Self, String> {
        let name = map.get("quantity").and_then(Value::as_str).unwrap_or_default().to_owned();
        let said = format!("{}", Value::Object(map.clone()));
        let failed = |why: &str| format!("{why} in {said}");
        let value =
            map.remove("value").and_then(|v| v.as_f64()).ok_or_else(|| failed("no `value`"))?;
        for comment in ["provenance", "label"] {
            if map.remove(comment).is_some_and(|text| !text.is_string()) {
                return Err(failed(&format!("`{comment}` is not a text")));
            }
        }
        let common: Map<String, Value> =
            ["tol_abs", "tol_rel"].into_iter().filter_map(|key| map.remove_entry(key)).collect();
        if common.is_empty() {
            return Err(failed("no tolerance"));
        }
        let tolerances: Tolerances =
            serde_json::from_value(Value::Object(common)).map_err(|e| failed(&e.to_string()))?;
        let quantity =
            serde_json::from_value(Value::Object(map)).map_err(|e| failed(&e.to_string()))?;
        Ok(Self { quantity, name, value, tolerances })
    }
}

impl Expected {
    /// How far an answer may be from the value.
    pub fn allowed(&self) -> f64 {
        self.tolerances.tol_abs.max(self.tolerances.tol_rel * self.value.abs())
    }

    pub fn is_transient_temperature(&self) -> bool {
        matches!(self.quantity, Quantity::T { t: Moment::At(_), .. })
    }

    /// True for a value of a steady state.
    pub fn is_steady(&self) -> bool {
        matches!(
            self.quantity,
            Quantity::T { t: Moment::Steady, .. }
                | Quantity::EdgeHeat { t: Moment::Steady, .. }
                | Quantity::BoundaryHeat { t: Moment::Steady, .. }
        )
    }

    /// The latest time that is asked for, in s.
    pub fn latest(&self) -> f64 {
        match &self.quantity {
            Quantity::T { t: Moment::At(t), .. }
            | Quantity::EdgeHeat { t: Moment::At(t), .. }
            | Quantity::BoundaryHeat { t: Moment::At(t), .. } => *t,
            Quantity::MeanTemperature { t1, .. } | Quantity::MeanBoundaryHeat { t1, .. } => *t1,
            Quantity::Crossing { t_end, .. }
            | Quantity::GateFirstSwitch { t_end }
            | Quantity::GateOnTime { t_end }
            | Quantity::GatePeriod { t_end } => t_end.unwrap_or(0.0),
            Quantity::FitInitial(fit)
            | Quantity::FitSettled(fit)
            | Quantity::FitTau(fit)
            | Quantity::FitRms(fit) => fit.t1,
            _ => 0.0,
        }
    }
}
