//! The command `lptn`.
//!
//! Verbs are one module each. Results go to stdout, everything else to stderr; every failure is a
//! [`lptn_netlist::Diagnostic`] with a stable code, shown the way rustc shows its own, and ends with one of the
//! codes of [`exit`]. A fault of the program itself is one of them too: see [`panic_net`].

mod args;
mod balance;
mod check;
mod choice;
mod command;
mod compare;
mod compare_text;
mod completions;
mod console;
mod conversions;
mod cycle_args;
mod diagnostics;
mod events;
mod exit;
mod failure;
mod files;
mod fit;
mod gaps;
mod input;
mod interrupt;
mod limits;
mod lumping;
mod materials;
mod modes;
mod new;
mod next;
mod outcome;
mod panic_net;
mod periodic;
mod periodic_text;
mod progress;
mod reduce;
mod reduce_json;
mod reduce_text;
mod run;
mod select;
mod sense;
mod size;
mod size_changing;
mod size_cooling;
mod size_text;
mod size_write;
mod state;
mod steady;
mod steady_doubts;
mod summary;
mod summary_text;
mod uncertainty;
mod uncertainty_args;
mod uncertainty_files;
mod uncertainty_text;
mod units;
mod verify;
mod window_text;
mod written;

use std::process::ExitCode;

use clap::Parser as _;

use args::{Args, Verb};
use console::Console;
use exit::Exit;
use failure::Failure;

fn main() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => return ExitCode::from(command::refuse(&error) as u8),
    };
    let console = Console::new(&args.global);
    let outcome = panic_net::caught(|| dispatch(&args, &console));
    let exit = outcome.unwrap_or_else(|failure| {
        console.report(&failure.files, &failure.diagnostics);
        failure.exit
    });
    ExitCode::from(exit as u8)
}

fn dispatch(args: &Args, console: &Console) -> Result<Exit, Failure> {
    if args.version {
        return console.print(&version());
    }
    match &args.verb {
        None => {
            console.message(&command::help());
            Ok(Exit::Input)
        }
        Some(Verb::Run(args)) => run::run(args, console),
        Some(Verb::Check(args)) => check::check(args, console),
        Some(Verb::Steady(args)) => steady::steady(args, console),
        Some(Verb::Modes(args)) => modes::modes(args, console),
        Some(Verb::Verify(args)) => verify::verify(args, console),
        Some(Verb::Compare(args)) => compare::compare(args, console),
        Some(Verb::Size(args)) => size::size(args, console),
        Some(Verb::Fit(args)) => fit::fit(args, console),
        Some(Verb::Reduce(args)) => reduce::reduce(args, console),
        Some(Verb::New(args)) => new::new(args, console),
        Some(Verb::Units(args)) => units::units(args, console),
        Some(Verb::Materials(args)) => materials::materials(args, console),
        Some(Verb::Completions(args)) => completions::completions(args, console),
    }
}

fn version() -> String {
    let sundials = lptn_study::Sundials::linked();
    let linkage = match sundials.linkage {
        "system" => "shared library of the system",
        _ => "copy inside the program",
    };
    format!("lptn {}\nSUNDIALS {}, {linkage}\n", env!("CARGO_PKG_VERSION"), sundials.version)
}
