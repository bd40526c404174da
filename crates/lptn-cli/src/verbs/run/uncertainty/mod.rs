//! `lptn run --uncertainty`: bands and a ranking beside the run.

pub(crate) mod args;
pub(crate) mod files;
mod inputs;
pub(crate) mod text;

use args::{Method, UncertaintyArgs};
use lptn_analysis::RunAnalysis;
use lptn_netlist::{Diagnostic, Netlist};
use lptn_solve::available_threads;
use lptn_study::uncertainty::{
    Discrepancy, Sobol, Uncertainty, UncertaintyError, UncertaintyTask, discrepancies, uncertain,
};

use super::job::Job;
use crate::console::Console;
use crate::interrupt::Interrupt;
use crate::progress::ProgressOfAll;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::run::shown;

/// Base points unless said: enough for a standard error of a few percent of a band's width.
const SAMPLES: u32 = 512;

const SEED: u32 = 1;

/// A band of less than so many tolerances of the run is that of the solver.
const WIDTHS: f64 = 100.0;

/// Refuses before anything is run what cannot be answered.
pub(crate) fn check(args: &UncertaintyArgs, input: &Input) -> Result<(), Failure> {
    if args.uncertainty.is_none() {
        return Ok(());
    }
    let inputs = uncertain(&input.netlist.network, &input.netlist.overrides());
    inputs.map(drop).map_err(|error| input.failure(&error, None))
}

/// Values with `±` that are not parameters, and so are taken as certain.
pub(crate) fn elsewhere(netlist: &Netlist) -> Vec<Diagnostic> {
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

/// What was found.
#[derive(Debug)]
pub(crate) struct Study {
    pub(crate) found: Uncertainty,
    /// Where the linear bands differ from sampled ones, or why there are none.
    pub(crate) linear: Option<Result<Vec<Discrepancy>, String>>,
}

/// The uncertainty that is asked for, `None` if none is.
pub(crate) fn study(
    args: &UncertaintyArgs,
    job: &Job<'_>,
    console: &Console,
) -> Option<Result<Study, Failure>> {
    let method = args.uncertainty?;
    let netlist = &job.input.netlist;
    let network = &netlist.network;
    let mut nodes: Vec<_> = job.selection.nodes().collect();
    if nodes.is_empty() {
        nodes = shown(network, None, None);
        nodes.sort_unstable();
    }
    let (parameters, run) = (netlist.overrides(), RunAnalysis::of(network, &job.settings));
    let task = UncertaintyTask { network, parameters, run, nodes };
    let outcome = match method {
        Method::Linear => task.linear().map(|found| Study { found, linear: None }),
        Method::Sobol => sobol(args, &task, console).map(|found| {
            let least = WIDTHS * task.run.tolerance();
            let differ = |linear: Uncertainty| discrepancies(&linear, &found, least);
            let linear = task.linear().map(differ).map_err(|error| error.to_string());
            Study { found, linear: Some(linear) }
        }),
    };
    Some(outcome.map_err(|error| job.input.failure(&error, None)))
}

fn sobol(
    args: &UncertaintyArgs,
    task: &UncertaintyTask<'_>,
    console: &Console,
) -> Result<Uncertainty, UncertaintyError> {
    let interrupt = Interrupt::listen();
    let samples = args.samples.unwrap_or(SAMPLES);
    let progress =
        ProgressOfAll::new(console.quiet, samples.next_power_of_two() as usize, "samples");
    let done = std::sync::atomic::AtomicUsize::new(0);
    let outcome = task.sobol(&Sobol {
        samples: samples as usize,
        seed: args.seed.unwrap_or(SEED),
        threads: args.threads.unwrap_or_else(available_threads),
        control: &|| interrupt.control(),
        finished: &|| progress.finished(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed)),
    });
    progress.clear();
    outcome
}
