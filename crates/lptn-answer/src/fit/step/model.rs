//! Bias of the method for a network that is known.

use std::path::Path;

use lptn_analysis::RunAnalysis;
use lptn_fit::step::{ModelBias, StepError};
use lptn_netlist::Diagnostic;
use lptn_network::Time;
use lptn_units::Problem as _;

use super::FitStepQuestion;
use super::request::Request;
use crate::belief::Belief;
use crate::failure::{Failure, told};
use crate::input::Input;

/// The bias of the method, and of which network.
#[derive(Debug)]
pub(super) struct Model {
    pub(super) file: String,
    pub(super) stem: String,
    pub(super) port: String,
    pub(super) bias: ModelBias,
}

impl Model {
    /// The same fit on the network's own answer at the times of the record.
    /// `None` if no network is named.
    pub(super) fn read(
        question: &FitStepQuestion,
        request: &Request,
    ) -> Result<Option<Self>, Failure> {
        let (Some(file), Some(port)) = (&question.model, &question.port) else { return Ok(None) };
        let begin = request.begin.ok_or_else(unknown_begin)?;
        Self::of(file, port, (begin, &request.record.time)).map(Some)
    }

    fn of(file: &Path, port: &str, (begin, times): (f64, &[f64])) -> Result<Self, Failure> {
        let input = Input::open(file, &Belief::Named, (None, &[]))?;
        let network = &input.netlist.network;
        let explain = |error: StepError| failed(&input, port, &error);
        let node =
            lptn_reduce::port(network, port).map_err(|error| explain(StepError::Model(error)))?;
        let system = input.assemble()?;
        let length = times.last().map_or(0.0, |last| last - begin);
        let run = match &input.netlist.run {
            Some(run) => RunAnalysis::of(network, run),
            None => RunAnalysis::until(Time(length)),
        };
        let bias = ModelBias::new(&system, node, &run, (begin, times)).map_err(explain)?;
        let (file, stem) = (input.text.name.clone(), input.text.stem.clone());
        Ok(Self { file, stem, port: port.to_owned(), bias })
    }
}

fn unknown_begin() -> Failure {
    let message =
        "the run of the model begins with the record, but a row before --from cannot be read";
    let help = "leave --from out: the error then names the first such row";
    Failure::refused("fit::no_begin", message, help)
}

fn failed(input: &Input, port: &str, error: &StepError) -> Failure {
    let problem = told(error).at(input.node_place(port), "the port");
    let message = format!("the model {}: {error}", input.text.name);
    input.refused(error.class().into(), Diagnostic { message, ..problem })
}
