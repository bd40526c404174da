//! The command `lptn`.
//!
//! Each verb is a folder of `verbs`. Results go to stdout, everything else to stderr. Every
//! failure is a [`lptn_netlist::Diagnostic`] with a stable code, in the style of rustc, and ends
//! with one of the codes of [`Exit`]. A fault of the program itself is one of them too: see
//! `panic_net`.
//!
//! The program and the Python package, which contains it, call [`run`].

mod args;
mod arguments;
mod command;
mod completion;
mod console;
mod core_of_live;
mod diagnostics;
mod drawing;
mod files;
mod input;
mod interrupt;
mod listening;
mod operating_point;
mod options;
mod panic_net;
mod phases;
mod progress;
mod refusal;
mod reporting;
mod usage;
mod verbs;
mod verdict;
mod written;

use std::ffi::OsString;

use args::Args;
use console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use verbs::Verb;

/// Bytes of freed memory that glibc keeps instead of returning them to the system.
/// Freeing a block of this size sets that limit. A page that a run requests again costs as much as
/// a thousand operations.
const KEPT: usize = 4 << 20;

/// Runs a command line, whose first word is the name of the program, and gives the exit code. A
/// program calls it once.
pub fn run(words: Vec<OsString>) -> u8 {
    arguments::are(words);
    drop(std::hint::black_box(Vec::<u8>::with_capacity(KEPT)));
    completion::answer_shell(<Args as clap::CommandFactory>::command);
    let args = match command::parsed() {
        Ok(args) => args,
        Err(error) => return command::refuse(&error) as u8,
    };
    let named = args.always.global.report.clone();
    let file = named.as_ref().and_then(Option::as_ref);
    let report = args.verb.as_ref().and_then(|verb| verb.report(file)).or(named.clone());
    let console = Console::new(&args.always.global, report);
    let outcome = panic_net::caught(|| dispatch(&args, &console));
    let refused = |failure: Failure| {
        console.report(&failure.files, &failure.diagnostics);
        console.offer_explanation(&failure.diagnostics);
        failure.exit
    };
    let known = outcome.is_ok();
    let mut exit = outcome.unwrap_or_else(refused);
    let verb = args.verb.as_ref().map_or("", Verb::name);
    match console.write_report(verb, known) {
        Err(failure) => exit = refused(failure),
        Ok(()) if known => {
            console.say_times();
            console.say_next();
        }
        Ok(()) => {}
    }
    console.answer_failure(exit);
    exit as u8
}

fn dispatch(args: &Args, console: &Console) -> Result<Exit, Failure> {
    if args.always.version {
        return console.print(&version());
    }
    match &args.verb {
        None => {
            console.message(&command::help());
            Ok(Exit::Input)
        }
        Some(verb) if names_two_files(verb, args) => {
            let option = verb.names_its_file().unwrap_or_default();
            let message = format!("-o and {option} name two files, and one is written");
            Err(Failure::refused("input::two_files", message, format!("leave -o or {option} out")))
        }
        Some(verb) if console.plot.is_some() && !verb.is_drawn() => {
            Err(drawing::nothing(verbs::DRAWN))
        }
        Some(verb) if console.reports() && !verb.is_reported() => Err(reporting::nothing()),
        Some(verb) => match verb.run(console)? {
            exit if exit != Exit::Interrupted && console.owes_a_picture() => {
                Err(drawing::nothing(verbs::DRAWN))
            }
            exit => Ok(exit),
        },
    }
}

/// True if the only file of a verb is named by its own option and by one of all verbs.
fn names_two_files(verb: &Verb, args: &Args) -> bool {
    let global = &args.always.global;
    match verb.names_its_file() {
        Some("--report") => matches!(&global.report, Some(Some(_))),
        Some(_) => global.plot.is_some(),
        None => false,
    }
}

fn version() -> String {
    let sundials = lptn_study::Sundials::linked();
    let linkage = match sundials.linkage {
        // the program may contain it
        "system" => "library of the system that built it",
        _ => "copy inside the program",
    };
    format!("lptn {}\nSUNDIALS {}, {linkage}\n", env!("CARGO_PKG_VERSION"), sundials.version)
}
