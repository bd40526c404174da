//! Margins of requirements: in steady state, or at every moment of a run or of a settled cycle, in
//! every load case.

use std::sync::atomic::{AtomicUsize, Ordering};

use lptn_analysis::{Analysis, Found, RunAnalysis, Trust, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_netlist::{Netlist, Requirement};
use lptn_network::{Limit, Network, NodeId, ParameterId, RunSettings, Value};
use lptn_solve::{
    OutOfRange, Proceed, Progress, ProvenMargin, RecordedNodes, Selection, Solution, SteadyState,
    Uncertified,
};
use lptn_units::EvalError;

use crate::size::aim::Aim;
use crate::size::error::{SizeError, TrialError};
use crate::size::load_case::LoadCase;
use crate::uncertainty::Inputs;
use crate::uncertainty::joint::NodesRead;

/// The finest tolerance in K of runs that are judged, unless the run itself needs a finer one. Ten
/// times this is 1e-8 of a rise of 1 K.
const FINE: f64 = 1e-9;

/// The accuracy with which a design is judged; steady states are always refined to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Care {
    /// To the tolerance of the run.
    Look,
    /// As accurate as a run can be.
    Proof,
    /// The same, with proven bounds.
    Certified,
    /// A run with this tolerance in K; for a steady state one that follows the network from its
    /// start.
    Within(f64),
}

impl Care {
    /// The tolerance in K of a run whose settings have this one.
    fn tolerance(self, own: f64) -> f64 {
        match self {
            Self::Look => own,
            Self::Proof | Self::Certified => own.min(FINE),
            Self::Within(tolerance) => tolerance.max(own),
        }
    }

    /// The tolerance in K of the run to the steady state, if there is one.
    fn within(self) -> Option<f64> {
        if let Self::Within(tolerance) = self { Some(tolerance) } else { None }
    }
}

/// The error of a run in tolerances.
const ERROR: f64 = 10.0;

/// The settings of a run, or of a cycle, for the parameters of a network; a sentence if there are
/// none.
pub type RunOf<'a> = dyn Fn(&Network) -> Result<RunSettings, String> + Sync + 'a;

/// An observer of runs, which may interrupt them.
pub type Watcher<'a> = dyn Fn(Progress) -> Proceed + Sync + 'a;

/// The results in which requirements are judged.
#[derive(Clone, Copy)]
pub enum Moments<'a> {
    /// In steady state, with inputs as they are at this time in s.
    Steady(f64),
    /// At every moment of the run.
    Run(&'a RunOf<'a>),
    /// At every moment of the periodic steady state that lasts from start to stop.
    Periodic(&'a RunOf<'a>),
}

/// The probability of being kept that is required, by the `±` of parameters.
#[derive(Clone, Copy, Debug)]
pub struct Doubt<'a> {
    /// The probability, more than 0.5 and less than 1.
    pub probability: f64,
    /// The parameters that are not certain; `None` if all are.
    pub inputs: Option<&'a Inputs>,
}

/// The requirements, with their network and moments.
#[derive(Clone, Copy)]
pub struct Demand<'a> {
    /// The network with every parameter at its own value.
    pub network: &'a Network,
    /// The netlist it was read from, which knows the gears that mesh.
    pub netlist: &'a Netlist,
    /// The cases in each of which everything has to be kept; the network as it is if there is none.
    pub cases: &'a [LoadCase],
    /// The requirements.
    pub requirements: &'a [Requirement],
    /// The moments at which they have to be kept.
    pub moments: Moments<'a>,
    /// The required probability of each requirement in each case; `None` if `±` does not count.
    pub doubt: Option<Doubt<'a>>,
    /// The observer of the runs.
    pub watcher: &'a Watcher<'a>,
}

impl std::fmt::Debug for Demand<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (cases, requirements) = (self.cases, self.requirements);
        f.debug_struct("Demand")
            .field("cases", &cases)
            .field("requirements", &requirements)
            .finish()
    }
}

/// The results of one design.
#[derive(Clone, Debug, Default)]
pub struct Judged {
    /// The margin of each requirement, in SI units, positive while it is kept: those of the first
    /// load case, then those of the next. If a probability is required, the margin that is left
    /// with that probability.
    pub margins: Vec<f64>,
    /// One standard deviation of each, in SI units, to first order in those of the parameters;
    /// empty if no probability is required.
    pub deviations: Vec<f64>,
    /// The error of the first order in each, in SI units: the shift of its mean to second order.
    pub left_out: Vec<f64>,
    /// The time of each least margin in s; `None` in steady state.
    pub worst_at: Vec<Option<f64>>,
    /// The temperature in K at the end, and the highest one, of each node that a requirement reads,
    /// if a probability is required.
    pub(super) reached: Vec<f64>,
    /// The laws that are outside the ranges in which they are known.
    pub out_of_range: Vec<OutOfRange>,
    /// The objective in SI units if it reads results; the worst of several load cases.
    pub objective: Option<f64>,
    /// Proven bounds on each margin, if they were asked for; `None` for one without.
    pub proven: Vec<Option<ProvenMargin>>,
    /// The reason of the first load case without proven bounds.
    pub unproven: Option<Uncertified>,
    /// Error of its temperatures in K, or in SI units that of a margin that changes faster than
    /// steps are evaluated; 0 in steady state, which is refined to rounding.
    pub error: f64,
}

impl Judged {
    /// True if everything is kept.
    pub fn keeps(&self) -> bool {
        self.margins.iter().all(|margin| *margin >= 0.0)
    }
}

/// Judges designs: networks that differ by parameters. Nothing is parsed, the structure is shared.
pub(crate) struct Judge<'a> {
    pub(super) demand: Demand<'a>,
    /// The objective, if it reads results.
    aim: Option<Aim<'a>>,
    pub(super) base: Network,
    /// The nodes that the requirements read, if a probability is required.
    pub(super) read: NodesRead,
    count: AtomicUsize,
}

impl<'a> Judge<'a> {
    /// # Errors
    /// [`SizeError`] if there is no requirement, or one that cannot be judged in steady state.
    pub(crate) fn new(demand: Demand<'a>) -> Result<Self, SizeError> {
        Self::seeking(demand, None)
    }

    /// The same; the objective is read from each steady state.
    pub(crate) fn seeking(demand: Demand<'a>, aim: Option<Aim<'a>>) -> Result<Self, SizeError> {
        if demand.requirements.is_empty() {
            return Err(SizeError::NoRequirement);
        }
        if demand.doubt.is_some_and(|doubt| doubt.inputs.is_none()) {
            return Err(SizeError::NoDeviation);
        }
        let limits = demand.requirements.iter().map(Requirement::limit);
        let base = match demand.moments {
            Moments::Steady(_) => {
                let required = demand.requirements.iter().flat_map(Requirement::sides);
                let required: Vec<_> = required.chain(aim.map(|aim| aim.value)).collect();
                let with_signals = demand.cases.iter().filter(|case| !case.signals.is_empty());
                let of_cases =
                    with_signals.filter_map(|case| case.network(demand.network, &[]).ok());
                for network in [demand.network.clone()].into_iter().chain(of_cases) {
                    let changing = network.changing_inputs_of(&required);
                    if !changing.is_empty() {
                        return Err(SizeError::Changing(changing));
                    }
                }
                demand.network.clone()
            }
            _ => demand.network.clone(),
        };
        // limits are evaluated between rows and steps
        let limits: Vec<Limit> = limits.collect();
        let read = NodesRead::of(&base, if demand.doubt.is_some() { &limits } else { &[] });
        let base = base.requiring(limits);
        Ok(Self { demand, aim, base, read, count: AtomicUsize::new(0) })
    }

    /// Number of networks that were solved.
    pub(crate) fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    /// Judges the design with these values of parameters, in SI units, in every load case.
    pub(crate) fn judge(
        &self,
        design: &[(ParameterId, f64)],
        care: Care,
    ) -> Result<Judged, SizeError> {
        let as_it_is = [LoadCase::default()];
        let cases = if self.demand.cases.is_empty() { &as_it_is } else { self.demand.cases };
        let mut all = Judged::default();
        for case in cases {
            let failed = |error| SizeError::trial(design, &case.name, error);
            let mut one = self.in_case((design, case), care).map_err(failed)?;
            if let Some(doubt) = self.demand.doubt {
                self.doubt(&mut one, (design, case), (doubt, care)).map_err(failed)?;
            }
            all.margins.extend(one.margins);
            all.deviations.extend(one.deviations);
            all.left_out.extend(one.left_out);
            all.worst_at.extend(one.worst_at);
            all.proven.extend(one.proven);
            all.unproven = all.unproven.or(one.unproven);
            all.out_of_range.extend(one.out_of_range);
            all.error = all.error.max(one.error);
            all.objective = match (all.objective, one.objective, self.aim) {
                (Some(a), Some(b), Some(aim)) => Some(aim.worse(a, b)),
                (a, b, _) => a.or(b),
            };
        }
        Ok(all)
    }

    /// The network as it is with the values of a design, without a load case.
    pub(crate) fn network(&self, design: &[(ParameterId, f64)]) -> Result<Network, SizeError> {
        let mut parameters = self.demand.network.given();
        design.iter().for_each(|(id, value)| parameters.set(*id, *value));
        let network = self.demand.network.with(&parameters);
        network.map_err(|errors| SizeError::trial(design, "", TrialError::Network(errors)))
    }

    /// A value of the design that follows from parameters, in SI units; of the network as it is,
    /// without a load case.
    pub(crate) fn value(
        &self,
        design: &[(ParameterId, f64)],
        value: &Value,
    ) -> Result<f64, SizeError> {
        let network = self.network(design)?;
        let failed = |error| SizeError::trial(design, "", error);
        let found = finite(value.at(&mut network.evaluation()));
        found.map_err(|error| failed(TrialError::Objective(error)))
    }

    /// The temperatures of the nodes in K in steady state in each load case.
    pub(crate) fn states(
        &self,
        design: &[(ParameterId, f64)],
        time: f64,
    ) -> Result<Vec<Vec<f64>>, TrialError> {
        let state = |case: &LoadCase| {
            let network = case.network(&self.base, design).map_err(TrialError::Network)?;
            let system = ThermalSystem::assemble(&network)?;
            let steady = lptn_analysis::steady(&system, time).map_err(TrialError::Steady)?;
            Ok(steady.result.state.temperatures)
        };
        match self.demand.cases {
            [] => Ok(vec![state(&LoadCase::default())?]),
            cases => cases.iter().map(state).collect(),
        }
    }

    pub(super) fn in_case(
        &self,
        (design, case): (&[(ParameterId, f64)], &LoadCase),
        care: Care,
    ) -> Result<Judged, TrialError> {
        let network = case.network(&self.base, design).map_err(TrialError::Network)?;
        self.demand.netlist.meshes(&network).map_err(TrialError::Gears)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.asked(&network, care)
    }

    /// The results of one network, over the moments of the demand.
    fn asked(&self, network: &Network, care: Care) -> Result<Judged, TrialError> {
        let analysis = self.analysis(network, care)?;
        let system = ThermalSystem::assemble(network)?;
        let observer = &mut |progress| (self.demand.watcher)(progress);
        match analysis.ask(&system, observer)? {
            Found::Steady(answer) => {
                let proofs = (care == Care::Certified).then(|| self.proofs(&system, &answer));
                let (proven, unproven) = proofs.unwrap_or_default();
                let judged = self.in_steady_state(network, answer)?;
                Ok(Judged { proven, unproven, ..judged })
            }
            Found::Run(answer) => self.over_time((&answer, &answer.trust), 0.0),
            Found::Cycle(answer) => self.over_time((&answer.solution, &answer.trust), answer.error),
        }
    }

    /// The analysis over these moments. Limits are evaluated between the rows of a run anyway.
    fn analysis(&self, network: &Network, care: Care) -> Result<Analysis, TrialError> {
        let run = |of: &RunOf<'_>| {
            let settings = of(network).map_err(TrialError::Settings)?;
            let tolerance = care.tolerance(settings.tolerance);
            let run = RunAnalysis::of(network, &settings).bare().at(vec![]).within(tolerance);
            let nodes = &self.read.nodes;
            let run = run.keeping(RecordedNodes::Nodes(nodes.clone())).watching(nodes.clone());
            Ok::<_, TrialError>(match care {
                Care::Certified => run.certified(Selection::of_reports(&[])),
                _ => run,
            })
        };
        Ok(match self.demand.moments {
            Moments::Steady(time) => Analysis::Steady { time, within: care.within() },
            Moments::Run(of) => Analysis::Run(run(of)?),
            Moments::Periodic(of) => Analysis::Cycle(run(of)?),
        })
    }

    fn in_steady_state(
        &self,
        network: &Network,
        answer: Trusted<SteadyState>,
    ) -> Result<Judged, TrialError> {
        let mut scope = answer.evaluation(network);
        let margin = |requirement: &Requirement| {
            let failed = |error| TrialError::Requirement { text: requirement.text.clone(), error };
            let margin = requirement.margin(&mut scope).map_err(|error| failed(Some(error)))?;
            if margin.is_finite() { Ok(margin) } else { Err(failed(None)) }
        };
        let requirements = self.demand.requirements;
        let margins = requirements.iter().map(margin).collect::<Result<_, _>>()?;
        let aim = self.aim.map(|aim| finite(aim.value.at(&mut scope))).transpose();
        let at = |node: &NodeId| [answer.state.temperatures[node.index()]; 2];
        Ok(Judged {
            margins,
            reached: self.read.nodes.iter().flat_map(at).collect(),
            worst_at: vec![None; requirements.len()],
            out_of_range: answer.trust.out_of_range,
            objective: aim.map_err(TrialError::Objective)?,
            ..Judged::default()
        })
    }

    /// Results for the requirements, whose limits are after those of the network; `more` is the
    /// error in K in addition to that of the run.
    fn over_time(
        &self,
        (solution, trust): (&Solution, &Trust),
        more: f64,
    ) -> Result<Judged, TrialError> {
        let own = solution.limits().len().saturating_sub(self.demand.requirements.len());
        let seen = &solution.limits()[own..];
        let error = ERROR * solution.tolerance() + more;
        let error = seen.iter().map(|seen| seen.open).fold(error, f64::max);
        let unknown = seen.iter().position(|seen| seen.margin.is_nan());
        if let Some(i) = unknown {
            let text = self.demand.requirements[i].text.clone();
            return Err(TrialError::Requirement { text, error: None });
        }
        let last = |node: NodeId| Some(*solution.temperature(node)?.last()?);
        let reached = solution
            .watched()
            .iter()
            .flat_map(|seen| [last(seen.watch.node).unwrap_or(f64::NAN), seen.peak.0]);
        Ok(Judged {
            reached: reached.collect(),
            margins: seen.iter().map(|seen| seen.margin).collect(),
            worst_at: seen.iter().map(|seen| Some(seen.worst_at)).collect(),
            out_of_range: trust.out_of_range.clone(),
            proven: solution
                .certificate()
                .map_or_else(Vec::new, |_| seen.iter().map(|seen| seen.proven).collect()),
            unproven: solution.certificate().and_then(|found| found.as_ref().err().cloned()),
            error,
            ..Judged::default()
        })
    }
}

/// A number, or why there is none.
fn finite(found: Result<f64, EvalError>) -> Result<f64, Option<EvalError>> {
    match found {
        Ok(found) if found.is_finite() => Ok(found),
        Ok(_) => Err(None),
        Err(error) => Err(Some(error)),
    }
}

/// The margins of every requirement in the network as it is.
///
/// # Errors
/// [`SizeError`] if it cannot be solved or a requirement has no value.
pub fn judge(demand: Demand<'_>) -> Result<Judged, SizeError> {
    Judge::new(demand)?.judge(&[], Care::Proof)
}
