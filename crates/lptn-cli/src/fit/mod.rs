//! `lptn fit`: what records of measured temperatures tell. Each of its verbs is a module.

mod args;
mod doubts;
mod estimate;
mod law;
mod model;
mod network;
mod network_interrupted;
mod network_json;
mod network_text;
mod network_words;
mod network_write;
mod request;
mod step;
mod step_data;
mod step_text;

pub(crate) use args::FitArgs;

use args::FitVerb;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;

pub(crate) fn fit(args: &FitArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.verb {
        FitVerb::Step(args) => step::step(args, console),
        FitVerb::Network(args) => network::network(args, console),
        FitVerb::Law(args) => law::law(args, console),
    }
}
