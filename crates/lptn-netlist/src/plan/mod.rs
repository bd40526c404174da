//! `[plan.NAME]`: parameters that a measurement must determine, and its possible sensors and runs.

mod check;
mod declaration;
mod read;
mod write;

use lptn_data::{Diagnostic, Span};
use lptn_network::{Network, ParameterId, Parameters, Value};
use lptn_units::EvalError;

use crate::fit::Observed;
use crate::format::SectionDeclaration;
use crate::raw::RawEntry;
use crate::setting::Setting;
use crate::study::{PathFrom, Study};
use crate::toml_text::TomlFields;
use crate::work::Elaboration;

use declaration::PLAN;

/// Most combinations of the lists of one run.
pub(crate) const MOST_RUNS: usize = 200;

/// One `[plan.NAME]`, as it is written; [`PlanStudy::numbers`] has its numbers.
#[derive(Clone, Debug)]
pub struct PlanStudy {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The parameters to be determined, in file order; at least one.
    pub known: Vec<Target>,
    /// The names of further unknown parameters, with their places.
    pub varied: Vec<(String, Span)>,
    /// Possible places of sensors, in file order; at least one.
    pub places: Vec<PlanPlace>,
    /// The runs that could be measured, in file order.
    pub runs: Vec<PlanRun>,
    /// Names of runs that are measured in any case.
    pub done: Vec<String>,
    /// Names of the fits whose records exist already.
    pub given: Vec<String>,
    pub(crate) every: Setting,
    pub(crate) duration: Option<Setting>,
    pub(crate) run_cost: Option<Setting>,
    pub(crate) hour_cost: Option<Setting>,
    pub(crate) budget: Option<Setting>,
}

/// A parameter to be determined.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The required error in percent of its value, if it is written so.
    pub(crate) percent: Option<f64>,
    /// The required error in its unit otherwise.
    pub(crate) absolute: Option<Value>,
}

/// A place where a sensor could be.
#[derive(Clone, Debug)]
pub struct PlanPlace {
    /// Its name as column, the measured result, and the instrument.
    pub observed: Observed,
    pub(crate) noise: Setting,
    /// Standard deviation and time of a drift.
    pub(crate) drift: Option<(Setting, Setting)>,
    pub(crate) cost: Option<Setting>,
}

/// A run that could be measured.
#[derive(Clone, Debug)]
pub struct PlanRun {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The parameters that it sets, with one value or several.
    pub(crate) set: Vec<(String, Vec<(Value, String)>)>,
    pub(crate) duration: Option<Setting>,
    pub(crate) cost: Option<Setting>,
}

impl PlanRun {
    /// True if it has separate values for a parameter.
    pub fn sets(&self, parameter: &str) -> bool {
        self.set.iter().any(|(name, _)| name == parameter)
    }
}

/// The numbers of a [`PlanStudy`] for the parameters of a network, in SI units.
#[derive(Clone, Debug)]
pub struct PlanNumbers {
    /// The parameters to be determined, with the required standard error of each.
    pub known: Vec<(ParameterId, KnownTo)>,
    /// Further unknown parameters; none of those above.
    pub varied: Vec<ParameterId>,
    /// For each of [`PlanStudy::places`].
    pub places: Vec<PlaceNumbers>,
    /// The runs, lists of values written out.
    pub runs: Vec<RunNumbers>,
    /// The time between two samples in s.
    pub every: f64,
    /// Cost of an hour.
    pub hour: f64,
    /// The limit of the total cost; infinite without a limit.
    pub budget: f64,
}

/// The required standard error of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KnownTo {
    /// This part of its value.
    Part(f64),
    /// This number, in its SI unit.
    Error(f64),
}

impl KnownTo {
    /// In SI units, for this value.
    pub fn of(self, value: f64) -> f64 {
        match self {
            Self::Part(part) => part * value.abs(),
            Self::Error(error) => error,
        }
    }
}

/// The numbers of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceNumbers {
    /// Standard deviation of one sample in K, without the drift.
    pub noise: f64,
    /// Standard deviation of the drift in K; 0 without one.
    pub drift: f64,
    /// The time in s after which 1/e of the drift is left.
    pub drift_time: f64,
    /// Cost of a sensor there.
    pub cost: f64,
}

/// One run that could be measured.
#[derive(Clone, Debug)]
pub struct RunNumbers {
    /// Its name; with its own values if it is one of several.
    pub name: String,
    /// Its place among [`PlanStudy::runs`]; none for the network as it is.
    pub of: Option<usize>,
    /// True if it is measured in any case.
    pub done: bool,
    /// Everything that was set, and the values of the run.
    pub parameters: Parameters,
    /// Its longest duration in s.
    pub duration: f64,
    /// Its cost in addition to that of its time.
    pub cost: f64,
}

impl PlanStudy {
    /// The numbers for the parameters of `network`; `set` contains the values that were set in it,
    /// see [`Netlist::overrides`](crate::Netlist::overrides).
    ///
    /// # Errors
    /// The error of the evaluation of a value.
    pub fn numbers(&self, network: &Network, set: &Parameters) -> Result<PlanNumbers, EvalError> {
        let mut scope = network.evaluation();
        let mut at = |value: &Value| value.at(&mut scope);
        let hour = self.hour_cost.as_ref().map_or(Ok(0.0), |cost| at(&cost.value))?;
        let budget = self.budget.as_ref().map_or(Ok(f64::INFINITY), |most| at(&most.value))?;
        let id = |name: &str| network.parameter(name).ok();
        let mut known = Vec::new();
        for target in &self.known {
            let Some(id) = id(&target.name) else { continue };
            let error = target.absolute.as_ref().map_or(Ok(f64::NAN), &mut at)?;
            known.push(match target.percent {
                Some(percent) => (id, KnownTo::Part(percent / 100.0)),
                None => (id, KnownTo::Error(error)),
            });
        }
        let varied = self.varied.iter().filter_map(|(name, _)| id(name)).collect();
        let places = self.places.iter().map(|place| place.numbers(network));
        let (places, every) = (places.collect::<Result<_, _>>()?, at(&self.every.value)?);
        let runs = self.run_numbers(network, set)?;
        Ok(PlanNumbers { known, varied, places, runs, every, hour, budget })
    }

    /// Every run with one value for each parameter that it sets.
    fn run_numbers(
        &self,
        network: &Network,
        set: &Parameters,
    ) -> Result<Vec<RunNumbers>, EvalError> {
        let mut scope = network.evaluation();
        let mut at = |setting: &Option<Setting>, otherwise: f64| {
            setting.as_ref().map_or(Ok(otherwise), |setting| setting.value.at(&mut scope))
        };
        let (duration, cost) = (at(&self.duration, f64::NAN)?, at(&self.run_cost, 0.0)?);
        if self.runs.is_empty() {
            let (name, parameters) = ("run".to_owned(), set.clone());
            return Ok(vec![RunNumbers {
                name,
                of: None,
                done: false,
                parameters,
                duration,
                cost,
            }]);
        }
        let mut all = Vec::new();
        for (of, run) in self.runs.iter().enumerate() {
            let (duration, cost) = (at(&run.duration, duration)?, at(&run.cost, cost)?);
            let done = self.done.contains(&run.name);
            for (name, parameters) in run.combinations(network, set)? {
                let of = Some(of);
                all.push(RunNumbers { name, of, done, parameters, duration, cost });
            }
        }
        Ok(all)
    }
}

impl PlanPlace {
    fn numbers(&self, network: &Network) -> Result<PlaceNumbers, EvalError> {
        let mut scope = network.evaluation();
        let mut at = |setting: &Setting| setting.value.at(&mut scope);
        let (drift, drift_time) = match &self.drift {
            Some((drift, time)) => (at(drift)?, at(time)?),
            None => (0.0, 0.0),
        };
        let cost = self.cost.as_ref().map_or(Ok(0.0), &mut at)?;
        Ok(PlaceNumbers { noise: at(&self.noise)?, drift, drift_time, cost })
    }
}

impl PlanRun {
    /// Name and parameters of each combination of its values; the last list runs fastest.
    fn combinations(
        &self,
        network: &Network,
        set: &Parameters,
    ) -> Result<Vec<(String, Parameters)>, EvalError> {
        let mut scope = network.evaluation();
        let mut all = vec![(Vec::new(), set.clone())];
        for (name, values) in &self.set {
            let Ok(id) = network.parameter(name) else { continue };
            let mut next = Vec::new();
            for (words, parameters) in &all {
                for (value, text) in values {
                    let (mut words, mut own) = (words.clone(), parameters.clone());
                    own.set(id, value.at(&mut scope)?);
                    if values.len() > 1 {
                        words.push(text.clone());
                    }
                    next.push((words, own));
                }
            }
            all = next;
        }
        let named = |(words, parameters): (Vec<String>, Parameters)| match words.is_empty() {
            true => (self.name.clone(), parameters),
            false => (format!("{} ({})", self.name, words.join(", ")), parameters),
        };
        Ok(all.into_iter().map(named).collect())
    }
}

impl Study for PlanStudy {
    const SECTION: &'static SectionDeclaration = &PLAN;

    const UNNAMED: Option<[&'static str; 4]> =
        Some(["netlist::plan_without_name", "a plan", "below [plan]", "next"]);

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.plan(entry)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        self.problems(network)
    }

    fn fields(&self, network: &Network, _: &PathFrom<'_>) -> TomlFields {
        self.written_fields(network)
    }
}
