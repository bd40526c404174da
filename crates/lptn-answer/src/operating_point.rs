//! An evaluated state of a network: the steady state, or a time of its run.

use lptn_analysis::RunAnalysis;
use lptn_netlist::{Diagnostic, RunSettings, Span};
use lptn_network::Network;
use lptn_report::{duration, significant};
use lptn_solve::{LinearisedError, RunStatus, Snapshot, Solution, SteadyState, Tried};
use lptn_study::SiValue;
use lptn_units::Unit;
use serde_json::{Value, json};

use crate::bound;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::refused::{no_run, steady_failed, time_of_run};
use crate::run::observed;
use crate::steady::{adiabatic, inputs_vary, others};

/// A state of a network and its name.
#[derive(Debug)]
pub struct OperatingPoint {
    /// Temperatures and heat flows.
    pub state: Snapshot,
    /// Doubts in it.
    pub doubts: Vec<Diagnostic>,
    name: String,
}

impl OperatingPoint {
    /// The state that a text names: `steady`, or a time of the run.
    ///
    /// # Errors
    /// A text that names neither, and a state that cannot be computed.
    pub fn find(text: &str, input: &Input, listener: &dyn Listener) -> Result<Self, Failure> {
        if text == "steady" {
            let unit = input::temperature_unit(None, &input.netlist)?;
            let (steady, doubts) = steady(input, &unit)?;
            return Ok(Self { state: steady.state, doubts, name: "the steady state".to_owned() });
        }
        let (state, doubts) = at(text, input, listener)?;
        let name = format!("the state at {}", duration(state.time, 6));
        Ok(Self { state, doubts, name })
    }

    /// "the steady state", "the state at 20 min".
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Passes on the result of a question about this state.
    /// If that is an error, the listener hears the doubts in the state.
    ///
    /// # Errors
    /// The error that is passed on.
    pub fn passed<T>(
        &self,
        found: Result<T, Failure>,
        (input, listener): (&Input, &dyn Listener),
    ) -> Result<T, Failure> {
        found.inspect_err(|_| listener.warn(&input.netlist.files, &self.doubts))
    }

    /// Notes on the linearised network and its error.
    /// `tried` is `None` if the network is linear itself.
    pub fn notes(&self, tried: Option<Tried>) -> Vec<String> {
        let Some(Tried { disturbance, heat, share, .. }) = tried else {
            return vec!["the network is linear: it is the same near every state".to_owned()];
        };
        let brought = match share {
            share if share < 1.0 => format!("{} % of", significant(100.0 * share, 2)),
            _ => "more than".to_owned(),
        };
        let first = format!(
            "linearised at {}: for ± {} K the heat flows are off by up to {} W, {brought} the heat \
             of the disturbance",
            self.name,
            significant(disturbance, 3),
            significant(heat, 2),
        );
        let none = tried.and_then(without_slopes).map(|missed| format!("heat flows {missed}"));
        [Some(first), none].into_iter().flatten().collect()
    }

    /// The same as an object of JSON.
    pub fn json(&self, tried: Option<Tried>) -> Value {
        let tried = tried.map(|tried| {
            json!({
                "disturbance": SiValue::new(tried.disturbance, "K"),
                "heat": SiValue::new(tried.heat, "W"),
                "share": SiValue::new(tried.share, "1"),
            })
        });
        let time = SiValue::new(self.state.time, "s");
        json!({ "time": time, "settled": self.state.settled, "tried": tried })
    }
}

/// "are not linear there, …", if no linear network describes a state. `reduce` and `verify` judge
/// a state by this.
pub fn without_slopes(tried: Tried) -> Option<String> {
    let missed = match tried.small {
        small if small < 1.0 => format!("{} % of", significant(100.0 * small, 2)),
        _ => "more than".to_owned(),
    };
    let size = significant(tried.disturbance / 100.0, 3);
    (!tried.has_slopes).then(|| {
        format!(
            "are not linear there: even for ± {size} K the linear network misses {missed} the heat \
             of the disturbance"
        )
    })
}

/// The place in the file that makes a network nonlinear.
pub fn place(input: &Input, error: &LinearisedError) -> Option<Span> {
    match error {
        LinearisedError::NotLinear { item, .. } => input.netlist.source_map.name(*item),
        LinearisedError::Input(error) => input.place_of(error),
        LinearisedError::Melts { name }
        | LinearisedError::Pipe { name }
        | LinearisedError::Mass { name } => input.node_place(name),
        LinearisedError::Sampled { .. } | LinearisedError::Singular => None,
    }
}

/// The steady state, and doubts in it.
///
/// # Errors
/// A network without a steady state.
pub fn steady(input: &Input, unit: &Unit) -> Result<(SteadyState, Vec<Diagnostic>), Failure> {
    let netlist = &input.netlist;
    let network: &Network = &netlist.network;
    let system = input.assemble()?;
    let start = netlist.run.as_ref().map_or(0.0, |run: &RunSettings| run.start);
    let steady =
        lptn_analysis::steady(&system, start).map_err(|error| steady_failed(input, &error))?;
    let vary = inputs_vary((netlist, input.typed().as_deref()), &steady, &[]);
    let doubts = [vary, adiabatic(network, &steady), others(network, &steady, unit)];
    let doubts: Vec<Diagnostic> = doubts.into_iter().flatten().collect();
    Ok((steady.result, doubts))
}

/// The row of the run at or before a time, and doubts in it.
///
/// # Errors
/// A text that is not a time of the run, a run that fails, and one that was interrupted.
pub fn at(
    text: &str,
    input: &Input,
    listener: &dyn Listener,
) -> Result<(Snapshot, Vec<Diagnostic>), Failure> {
    let settings = input.netlist.run.as_ref().ok_or_else(|| no_run(input))?;
    let time = time_of_run(text, settings)?;
    let system = input.assemble()?;
    let run = RunAnalysis::of(system.network(), settings);
    let (solution, broken) = observed(input, (&system, &run), listener)?;
    check(input, &solution, broken)?;
    let row = solution.row_at(time).unwrap_or(0);
    let found = solution.snapshot(row).ok_or_else(|| {
        let message = format!("the heat flows at {} cannot be computed again", duration(time, 6));
        Failure::new(Exit::Failed, Diagnostic::error("graph::no_state", message))
    })?;
    let (asked, shown) = (duration(time, 6), duration(found.time, 6));
    if asked != shown {
        listener.note(&format!("at     {shown}, the row before {asked}"));
    }
    Ok((found, bound::doubts(&solution, false)))
}

/// Refuses a run that did not reach its stop or whose energy balance does not close.
fn check(input: &Input, solution: &Solution, broken: Option<Diagnostic>) -> Result<(), Failure> {
    if let Some(problem) = broken {
        return Err(input.refused(Exit::Failed, problem));
    }
    if let RunStatus::Interrupted(time) = solution.end() {
        let message = format!("the run was interrupted at {}", duration(time, 4));
        let problem = Diagnostic::error("run::interrupted", message);
        return Err(Failure::new(Exit::Interrupted, problem));
    }
    solution.ledger().check().map_err(|open| input.refused(Exit::Failed, told(&open)))
}
