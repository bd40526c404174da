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
    let problem = page_without_sign(error)
        .or_else(|| no_such_option(error))
        .or_else(|| word_too_many(error))
        .or_else(|| {
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
        None => wrong_usage(&error.render().to_string()),
    };
    console.report(&Files::new(), &[problem]);
    console.answer_failure(Exit::Input);
    Exit::Input
}

/// The parser's message on a command line as a diagnostic.
fn wrong_usage(text: &str) -> Diagnostic {
    let mut parts = text.trim_end().split("\n\n").map(|part| {
        let lines: Vec<&str> = part.lines().map(str::trim).collect();
        lines.join(" ")
    });
    let first = parts.next().unwrap_or_default();
    let problem = Diagnostic::error("input::usage", first.trim_start_matches("error: "));
    let problem = parts.filter(|part| !part.starts_with("For more")).fold(
        problem,
        |problem, part| match part.strip_prefix("tip: ") {
            Some(tip) => problem.help(tip),
            None => problem.note(part),
        },
    );
    problem.help(lists_options())
}

/// `--report page.html`, of which only `--report` is understood.
fn page_without_sign(error: &clap::Error) -> Option<Diagnostic> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else { return None };
    let is_page = Path::new(word).extension().is_some_and(|ending| ending == "html");
    let message = format!("{word} is a separate word: the file of a report is joined with =");
    let problem = Diagnostic::error("input::report_file", message);
    is_page.then(|| problem.help(format!("write --report={}", quoted(word))))
}

/// An unknown option. The parser's own suggestion is not used: it takes distant words for near.
fn no_such_option(error: &clap::Error) -> Option<Diagnostic> {
    let Some(ContextValue::String(option)) = error.get(ContextKind::InvalidArg) else {
        return None;
    };
    if error.kind() != ErrorKind::UnknownArgument || !option.starts_with('-') {
        return None;
    }
    let message = format!("`{}` has no option `{option}`", command_line());
    let problem = Diagnostic::error("input::no_option", message);
    let help = lists_options();
    Some(problem.help(match (verbs_with(option).as_slice(), near_option(option)) {
        ([], Some(near)) => format!("did you mean `{near}`? {help}"),
        ([], None) => help,
        (verbs, _) => format!("{help}; {option} belongs to {}", verbs.join(", ")),
    }))
}

/// `lptn` with the verb of the command line.
fn command_line() -> String {
    let words = std::iter::once("lptn".to_owned()).chain(verb_words());
    words.collect::<Vec<_>>().join(" ")
}

fn lists_options() -> String {
    format!("`{} --help` lists its options", command_line())
}

/// The option of the verb that is nearly this one.
fn near_option(option: &str) -> Option<String> {
    let mut command = Args::command();
    let everywhere: Vec<String> = longs(&command).collect();
    for word in verb_words() {
        command = command.find_subcommand(&word)?.clone();
    }
    let own: Vec<String> = longs(&command).chain(everywhere).collect();
    suggest(option, own.iter().map(String::as_str)).map(str::to_owned)
}

/// The options of a verb, `--stop`.
fn longs(command: &Command) -> impl Iterator<Item = String> {
    let shown = command.get_arguments().filter(|argument| !argument.is_hide_set());
    shown.filter_map(|argument| Some(format!("--{}", argument.get_long()?)))
}

/// The verb of the command line, and the one inside it: `fit`, `network`.
fn verb_words() -> Vec<String> {
    let mut command = Args::command();
    let mut words = Vec::new();
    for word in arguments::words() {
        let Some(inner) = command.find_subcommand(&word).cloned() else { continue };
        words.push(word);
        command = inner;
    }
    words
}

/// The verbs that have this option.
fn verbs_with(option: &str) -> Vec<String> {
    let has = |command: &Command| longs(command).any(|long| long == option);
    let root = Args::command();
    let mut found = Vec::new();
    for verb in root.get_subcommands() {
        let name = verb.get_name();
        if has(verb) {
            found.push(format!("`lptn {name}`"));
        }
        for inner in verb.get_subcommands().filter(|inner| has(inner)) {
            found.push(format!("`lptn {name} {}`", inner.get_name()));
        }
    }
    found
}

/// A word too many: a value without its `=`, a quantity without quotes, a second netlist.
fn word_too_many(error: &clap::Error) -> Option<Diagnostic> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else { return None };
    let words = arguments::words();
    if error.kind() != ErrorKind::UnknownArgument || word.starts_with('-') {
        return None;
    }
    let problem = |message: String, help: String| {
        Some(Diagnostic::error("input::word_too_many", message).help(help))
    };
    let set = words.windows(3).find(|three| three[0] == "--set" && !three[1].contains('='));
    if let Some([_, name, value]) = set {
        let message = format!("`--set {name}` has no value");
        return problem(message, format!("write --set {}", quoted(&format!("{name}={value}"))));
    }
    let rest = words.get(1..).unwrap_or_default();
    match words.first().map(String::as_str)? {
        "units" => problem(
            format!("a quantity is one word, but `{word}` is another"),
            format!("write lptn units \"{}\"", rest.join(" ")),
        ),
        verb if is_netlist(word) => {
            let files: Vec<String> =
                rest.iter().filter(|word| is_netlist(word)).map(|word| quoted(word)).collect();
            problem(
                format!("`lptn {verb}` takes one netlist, but {word} is another"),
                format!("`lptn compare {}` compares them", files.join(" ")),
            )
        }
        _ => None,
    }
}

fn is_netlist(word: &str) -> bool {
    Path::new(word).extension().is_some_and(|ending| ending == "toml")
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
