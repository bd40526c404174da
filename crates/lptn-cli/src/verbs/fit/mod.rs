//! `lptn fit`: estimates from measured records. Each of its verbs is a module.

mod args;
mod compare;
mod law;
mod network;
mod posterior;
mod step;

pub(crate) use args::FitArgs;

use args::FitVerb;

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

pub(crate) fn fit(args: &FitArgs, console: &Console) -> Result<Exit, Failure> {
    match &args.verb {
        FitVerb::Step(args) => step::step(args, console),
        FitVerb::Network(args) => network::network(args, console),
        FitVerb::Law(args) => law::law(args, console),
        FitVerb::Compare(args) => compare::compare(args, console),
    }
}
