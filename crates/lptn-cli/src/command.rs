//! The parser as clap builds it.

use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ArgMatches, Args as _, Command, CommandFactory as _, FromArgMatches as _};
use lptn_netlist::{Diagnostic, Files};
use lptn_units::suggest;

use crate::args::{Always, Args};
use crate::arguments;
use crate::console::Console;
use crate::drawing::terminal_width;
use crate::options::{Color, Global, TEMPLATE};
use crate::usage::{self, verb_words};
use crate::verbs::{Verb, groups};
use lptn_answer::exit::Exit;
use lptn_answer::input::quoted;

/// Widest help in columns: longer lines are hard to read, however wide the terminal is.
const WIDEST_HELP: usize = 100;

/// The parser, with help as wide as the terminal.
/// Its help lists the verbs by purpose instead of clap's list of all.
pub(crate) fn command() -> clap::Command {
    let width = terminal_width().min(WIDEST_HELP);
    let mut command = Args::command().term_width(width);
    command.build(); // adds `help`
    let command = command.mut_subcommand("help", |verb| verb.about("Print the help of a command"));
    let verbs = groups::listed(&command, width);
    let template = TEMPLATE.replace("{all-args}", &format!("{verbs}{{all-args}}"));
    let command = command.help_template(template).mut_subcommands(|verb| verb.hide(true));
    command.override_usage("lptn [OPTIONS] [COMMAND]")
}

/// Parses the command line.
pub(crate) fn parsed() -> Result<Args, clap::Error> {
    match of_first_word() {
        Some(matches) => Args::from_arg_matches(&matches),
        None => Args::from_arg_matches(&command().try_get_matches_from(arguments::all())?),
    }
}

/// The same by a parser of one verb: building all takes as long as a small run.
/// `None` if the first word is not a verb, if something is wrong, or if help is requested.
fn of_first_word() -> Option<ArgMatches> {
    let verb = arguments::all().get(1)?.to_str()?;
    let parser = Always::augment_args(Command::new("lptn"));
    parser.subcommand(Verb::parser(verb)?).try_get_matches_from(arguments::all()).ok()
}

/// Prints why a command line cannot be understood, or the help that it asks for.
pub(crate) fn refuse(error: &clap::Error) -> Exit {
    let verb = match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(verb)) if error.kind() == ErrorKind::InvalidSubcommand => {
            Some(verb)
        }
        _ => None,
    };
    let problem = usage::explained(error).or_else(|| {
        verb.map(|verb| {
            let other = || near_verb(verb).or_else(|| path_as_verb(verb));
            file_as_verb(verb).or_else(other).unwrap_or_else(|| no_verb(verb))
        })
    });
    let global =
        Global { quiet: false, verbose: false, color: Color::Auto, plot: None, report: None };
    let console = Console::new(&global, None);
    let problem = match problem {
        Some(problem) => problem,
        None if !error.use_stderr() => error.exit(),
        None => usage::wrong_usage(&error.render().to_string()),
    };
    console.report(&Files::new(), &[problem]);
    console.answer_failure(Exit::Input);
    Exit::Input
}

/// The name of a file instead of a verb.
fn file_as_verb(word: &str) -> Option<Diagnostic> {
    let ending = Path::new(word).extension()?.to_str()?.to_lowercase();
    let within = verb_words().into_iter().next().filter(|verb| verb == "fit");
    let (is, verb) = match ending.as_str() {
        "toml" if within.is_some() => ("netlist", "fit network"),
        "toml" => ("netlist", "run"),
        "csv" => ("CSV file", "fit step"),
        _ => return None,
    };
    Some(verb_is_due(word, is, verb))
}

/// An existing path instead of a verb.
fn path_as_verb(word: &str) -> Option<Diagnostic> {
    let found = std::fs::metadata(word).ok()?;
    let (is, verb) = if found.is_dir() { ("folder", "report") } else { ("file", "run") };
    Some(verb_is_due(word, is, verb))
}

fn verb_is_due(word: &str, is: &str, verb: &str) -> Diagnostic {
    let message = format!("{word} is a {is}, and a command is needed before it");
    let list = if verb.starts_with("fit network") { "lptn fit --help" } else { "lptn help" };
    let help = format!("`lptn {verb} {}`, or another command: `{list}` lists them", quoted(word));
    Diagnostic::error("input::no_verb", message).help(help)
}

/// A word that is not a verb.
fn no_verb(word: &str) -> Diagnostic {
    let problem = Diagnostic::error("input::no_verb", format!("there is no command `{word}`"));
    let inner = verb_words().into_iter().next().map_or(String::new(), |verb| format!(" {verb}"));
    problem.help(format!("`lptn{inner} --help` lists the commands"))
}

/// A word that is nearly a verb.
fn near_verb(word: &str) -> Option<Diagnostic> {
    let command = Args::command();
    let near = suggest(word, command.get_subcommands().map(clap::Command::get_name))?;
    let problem = Diagnostic::error("input::no_verb", format!("there is no command `{word}`"));
    let help =
        if arguments::words().first().is_some_and(|word| word == "help") { "help " } else { "" };
    Some(problem.help(format!("did you mean `lptn {help}{near}`?")))
}

/// The help of the program.
pub(crate) fn help() -> String {
    command().render_help().to_string()
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_parser_is_sound() {
        crate::args::Args::command().debug_assert();
    }
}
