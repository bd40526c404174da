//! The uncertainty of a run: bands and a ranking.

pub(super) mod figure;
pub(super) mod files;
mod inputs;
pub(super) mod text;

pub(crate) use text::bends;

use std::sync::atomic::{AtomicUsize, Ordering};

use lptn_analysis::RunAnalysis;
use lptn_netlist::{Diagnostic, Netlist, RunSettings};
use lptn_solve::{Selection, available_threads};
use lptn_study::uncertainty::{
    Discrepancy, Sobol, Uncertainty, UncertaintyError, UncertaintyTask, discrepancies, uncertain,
};

use super::observed::shown;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::parameter;

/// Method that carries the `±` of parameters to the results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By the slopes of the results.
    Linear,
    /// By runs at the points of a Sobol sequence.
    Sobol,
}

/// The uncertainty that is requested.
#[derive(Clone, Debug)]
pub struct UncertaintyQuestion {
    /// The method.
    pub method: Method,
    /// Base points of Sobol's method; `None` for 512.
    pub samples: Option<u32>,
    /// Seed of Sobol's method; `None` for 1.
    pub seed: Option<u32>,
    /// Threads; `None` for all. The result is the same for any number.
    pub threads: Option<usize>,
}

/// Default base points: enough for a standard error of a few percent of a band's width.
const SAMPLES: u32 = 512;

const SEED: u32 = 1;

/// Width of a band, in tolerances of the run, below which it is that of the solver.
const WIDTHS: f64 = 100.0;

/// False in live pages: the core in them is without this code, which would be a part of its size.
pub(super) const IS_BUILT: bool = !cfg!(target_family = "wasm");

/// Refuses a question that cannot be answered, before anything is run.
pub(super) fn check(asked: Option<&UncertaintyQuestion>, input: &Input) -> Result<(), Failure> {
    if asked.is_none() {
        return Ok(());
    }
    if !IS_BUILT {
        let help = "use `lptn run --uncertainty`";
        return Err(Failure::refused("run::settings", "a live page has no uncertainty", help));
    }
    let inputs = uncertain(&input.netlist.network, &input.netlist.overrides());
    inputs.map(drop).map_err(|error| refused(&error, input))
}

/// A failure. Help for parameters without `±` shows one of them with it; a `±` elsewhere is shown.
fn refused(error: &UncertaintyError, input: &Input) -> Failure {
    let mut failure = input.failure(error, None);
    if !matches!(error, UncertaintyError::NoDeviation) {
        return failure;
    }
    let line = parameter::deviation(&input.netlist);
    let help = line.map(|l| format!("give a parameter its standard deviation: `{l}` in [param]"));
    let spans = input.netlist.source_map.deviations_elsewhere(&input.netlist.files);
    let complete = |problem: Diagnostic| {
        let shown = problem.help(help.clone());
        spans.iter().fold(shown, |shown, span| {
            shown.also(span.clone(), "not in [param]: it is not counted")
        })
    };
    failure.diagnostics = failure.diagnostics.into_iter().map(complete).collect();
    failure
}

/// Values with `±` that are not parameters, and so are taken as certain.
pub(super) fn elsewhere(netlist: &Netlist) -> Vec<Diagnostic> {
    let spans = netlist.source_map.deviations_elsewhere(&netlist.files);
    let warning = |span| {
        Diagnostic::warning(
            "uncertainty::no_parameter",
            "only parameters are varied: this `±` is not counted",
        )
        .at(span, "")
        .help("give the value a name in [param], and write the name here")
    };
    spans.into_iter().map(warning).collect()
}

/// The uncertainty of a run.
#[derive(Debug)]
pub struct Study {
    /// Bands of temperatures and margins, and the ranking of parameters.
    pub found: Uncertainty,
    /// Differences of the linear bands from sampled ones, or the reason why there are none.
    pub linear: Option<Result<Vec<Discrepancy>, String>>,
}

impl UncertaintyQuestion {
    /// The uncertainty of a run.
    pub(super) fn study(
        &self,
        (input, settings, selection): (&Input, &RunSettings, &Selection),
        listener: &dyn Listener,
    ) -> Result<Study, Failure> {
        let netlist = &input.netlist;
        let network = &netlist.network;
        let mut nodes: Vec<_> = selection.nodes().collect();
        if nodes.is_empty() {
            nodes = shown(network, None, None);
            nodes.sort_unstable();
        }
        let (parameters, run) = (netlist.overrides(), RunAnalysis::of(network, settings));
        let task = UncertaintyTask { network, parameters, run, nodes };
        let outcome = match self.method {
            Method::Linear => task.linear().map(|found| Study { found, linear: None }),
            Method::Sobol => self.sobol(&task, listener).map(|found| {
                let least = WIDTHS * task.run.tolerance();
                let differ = |linear: Uncertainty| discrepancies(&linear, &found, least);
                let linear = task.linear().map(differ).map_err(|error| error.to_string());
                Study { found, linear: Some(linear) }
            }),
        };
        outcome.map_err(|error| refused(&error, input))
    }

    fn sobol(
        &self,
        task: &UncertaintyTask<'_>,
        listener: &dyn Listener,
    ) -> Result<Uncertainty, UncertaintyError> {
        let samples = self.samples.unwrap_or(SAMPLES);
        let all = samples.next_power_of_two() as usize;
        let done = AtomicUsize::new(0);
        task.sobol(&Sobol {
            samples: samples as usize,
            seed: self.seed.unwrap_or(SEED),
            threads: self.threads.unwrap_or_else(available_threads),
            control: &|| listener.proceed(),
            finished: &|| {
                listener.counted(1 + done.fetch_add(1, Ordering::Relaxed), all, "samples");
            },
        })
    }
}
