//! The record of the inputs and results of a run.

use lptn_solve::{RunStatus, Solution};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::record::{LedgerRecord, SiValue, StatisticsRecord};

/// Everything that a run was made from, and its results.
#[derive(Clone, Debug, Serialize)]
pub struct Manifest {
    /// Version of this format.
    pub format: u32,
    /// Version of lptn.
    pub lptn: String,
    /// The integrator's library.
    pub sundials: Sundials,
    /// The command line without the name of the program.
    pub arguments: Vec<String>,
    /// Every file that was read.
    pub inputs: Vec<FileHash>,
    /// The parameters as they were resolved, in the order of the netlist.
    pub parameters: Map<String, Value>,
    /// Start of the run.
    pub start: SiValue,
    /// The stop it was given.
    pub stop: SiValue,
    /// The tolerance of its temperatures in K.
    pub tolerance: SiValue,
    /// The integrator that computed it, by its word in `[run]`; `null` without capacities.
    pub integrator: Option<&'static str>,
    /// The end of the run.
    pub end: RunEnd,
    /// Counters of the integrator.
    pub statistics: StatisticsRecord,
    /// The energy balance; `null` for a run that broke off.
    pub ledger: LedgerRecord,
    /// The result for every limit, in the order of the netlist: `of`, `below` or `above`, `worst`
    /// (the value with the least `margin`), `worst_at`, `broken_at`, `severity`, `kept`. Up to the
    /// time in `end`.
    pub limits: Map<String, Value>,
    /// The elements whose law has constants that were not read in its source; only if there are
    /// some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unverified_constants: Option<Vec<String>>,
    /// Laws outside the ranges in which they are known: path, law, group, range, the value furthest
    /// outside and when, the stretches; only if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub out_of_range: Option<Vec<Value>>,
    /// The method of the uncertainty of the results: method, seed, samples, parameters with their
    /// standard deviations; only if it was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Value>,
    /// Every file that was written, except this one.
    pub results: Vec<FileHash>,
    /// Data that change from run to run; nothing else does.
    pub environment: Environment,
}

/// A SUNDIALS library.
#[derive(Clone, Debug, Serialize)]
pub struct Sundials {
    /// The version that was linked.
    pub version: String,
    /// `system`, `bundled`, or `none` without CVODES.
    pub linkage: &'static str,
}

impl Sundials {
    /// The one this program runs with; without CVODES the version is empty.
    #[cfg(not(feature = "cvodes"))]
    pub fn linked() -> Self {
        Self { version: String::new(), linkage: "none" }
    }

    /// The one this program runs with.
    #[cfg(feature = "cvodes")]
    pub fn linked() -> Self {
        let linked = lptn_solve::linked();
        let linkage = match linked.linkage {
            lptn_solve::Linkage::System => "system",
            lptn_solve::Linkage::Bundled => "bundled",
        };
        Self { version: linked.version, linkage }
    }
}

/// A file and the hash of its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FileHash {
    /// Its name as it was given.
    pub name: String,
    /// SHA-256 in hexadecimal.
    pub sha256: String,
}

/// A parameter as it was resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRecord {
    /// Its name.
    pub name: String,
    /// Its value in SI; an absolute temperature in K.
    pub value: f64,
    /// The SI unit.
    pub unit: String,
    /// The text it was set to on the command line; `None` if the netlist's own value applies.
    pub set: Option<String>,
}

impl ParameterRecord {
    /// The member of [`Manifest::parameters`].
    pub fn member(&self) -> (String, Value) {
        let mut value = json!({ "value": self.value, "unit": self.unit });
        if let (Some(text), Some(object)) = (&self.set, value.as_object_mut()) {
            object.insert("set".to_owned(), json!(text));
        }
        (self.name.clone(), value)
    }
}

/// The end of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunEnd {
    /// `reached`, `interrupted` or `failed`.
    pub status: &'static str,
    /// The time up to which there are rows and heat.
    pub time: SiValue,
    /// Why it ended early, as it was printed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
}

impl RunEnd {
    /// The end of `solution`, which was to run until `stop`, in s.
    pub fn of(solution: &Solution, stop: f64, message: Option<String>) -> Self {
        let (status, time) = match solution.end() {
            RunStatus::Reached => ("reached", stop),
            RunStatus::Interrupted(time) => ("interrupted", time),
            RunStatus::Failed(time) => ("failed", time),
        };
        Self { status, time: SiValue::new(time, "s"), message }
    }
}

/// Data that change from run to run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Environment {
    /// When it was written, in UTC.
    pub written: String,
    /// The name of the machine; empty if it has none.
    pub host: String,
    /// The duration of the run.
    pub wall_time: SiValue,
    /// The durations of the parts of the command that were done by then, each a value with its
    /// unit; only for a run.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub phases: Map<String, Value>,
}

/// Nothing known.
impl Default for Environment {
    fn default() -> Self {
        Self {
            written: String::new(),
            host: String::new(),
            wall_time: SiValue::new(0.0, "s"),
            phases: Map::new(),
        }
    }
}

impl Manifest {
    /// The file's text, with a line break at its end.
    ///
    /// # Errors
    /// None that can be caused by values: every one of them can be written.
    pub fn text(&self) -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}
