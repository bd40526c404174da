//! Command lines that the parser refuses: options and words that a verb does not have.

use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory as _};
use lptn_netlist::Diagnostic;
use lptn_units::{parse_quantity, suggest};

use crate::args::Args;
use crate::arguments;
use lptn_answer::input::quoted;

/// The parser's error on an option or a word as a diagnostic with a remedy; `None` for other errors.
pub(crate) fn explained(error: &clap::Error) -> Option<Diagnostic> {
    page_without_sign(error)
        .or_else(|| no_such_option(error))
        .or_else(|| word_too_many(error))
        .or_else(|| not_together(error))
        .or_else(|| not_given(error))
}

/// The parser's message on a command line as a diagnostic.
pub(crate) fn wrong_usage(text: &str) -> Diagnostic {
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
    let word = string_of(error, ContextKind::InvalidArg)?;
    let is_page = Path::new(word).extension().is_some_and(|ending| ending == "html");
    let message = format!("{word} is a separate word: the file of a report is joined with =");
    let problem = Diagnostic::error("input::report_file", message);
    is_page.then(|| problem.help(format!("write --report={}", quoted(word))))
}

/// An unknown option. The parser's own suggestion is not used: it takes distant words for near.
fn no_such_option(error: &clap::Error) -> Option<Diagnostic> {
    let option = string_of(error, ContextKind::InvalidArg)?;
    if error.kind() != ErrorKind::UnknownArgument || !option.starts_with('-') {
        return None;
    }
    let written = one_dash(option);
    let option = written.as_deref().unwrap_or(option);
    let message = format!("`{}` has no option `{option}`", command_line());
    let problem = Diagnostic::error("input::no_option", message);
    let help = lists_options();
    Some(problem.help(match (verbs_with(option).as_slice(), near_option(option)) {
        ([], Some(near)) => format!("did you mean `{near}`? {help}"),
        ([], None) => help,
        (verbs, _) => format!("{help}; {option} belongs to {}", verbs.join(", ")),
    }))
}

/// The word of which the parser names a letter only: `-set`, for `-s`.
fn one_dash(option: &str) -> Option<String> {
    let letter = option.strip_prefix('-').filter(|letter| letter.len() == 1)?;
    let own = own_options()?;
    let is = |word: &String| word.contains(letter) && own.contains(&format!("-{word}"));
    arguments::words().into_iter().find(is)
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
    let own = own_options()?;
    let twice = format!("-{option}");
    let near = || suggest(option, own.iter().map(String::as_str));
    own.iter().find(|own| **own == twice).map(String::as_str).or_else(near).map(str::to_owned)
}

/// The options of the verb of the command line, and those of all verbs.
fn own_options() -> Option<Vec<String>> {
    Some(longs(&verb_parser()?).chain(longs(&Args::command())).collect())
}

/// The parser of the verb of the command line.
fn verb_parser() -> Option<Command> {
    let start = Some(Args::command());
    let inner = |command: Option<Command>, word: String| command?.find_subcommand(&word).cloned();
    verb_words().into_iter().fold(start, inner)
}

/// The options of a verb, `--stop`.
fn longs(command: &Command) -> impl Iterator<Item = String> {
    let shown = command.get_arguments().filter(|argument| !argument.is_hide_set());
    shown.filter_map(|argument| Some(format!("--{}", argument.get_long()?)))
}

/// The verb of the command line, and the one inside it: `fit`, `network`.
pub(crate) fn verb_words() -> Vec<String> {
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

/// A word too many: a value without its `=`, a quantity without quotes, a second netlist, a port.
fn word_too_many(error: &clap::Error) -> Option<Diagnostic> {
    let word = string_of(error, ContextKind::InvalidArg)?;
    if error.kind() != ErrorKind::UnknownArgument || word.starts_with('-') {
        return None;
    }
    let words = arguments::words();
    let verb = words.first()?.as_str();
    let (message, help) = set_without_sign(&words)
        .or_else(|| (verb == "units").then(|| one_quantity(&words, word)))
        .or_else(|| quantity_of_two_words(&words, word))
        .or_else(|| is_netlist(word).then(|| second_netlist(&words, word)))
        .unwrap_or_else(|| no_place(word));
    Some(Diagnostic::error("input::word_too_many", message).help(help))
}

/// Message and help.
type Words = (String, String);

/// `--set G 2W/K`.
fn set_without_sign(words: &[String]) -> Option<Words> {
    let set = words.windows(3).find(|three| three[0] == "--set" && !three[1].contains('='));
    let [_, name, value] = set? else { return None };
    let fix = format!("write --set {}", quoted(&format!("{name}={value}")));
    Some((format!("`--set {name}` has no value"), fix))
}

/// `--stop 2 h`.
fn quantity_of_two_words(words: &[String], word: &str) -> Option<Words> {
    let at = words.windows(2).position(|two| two[1] == word && two[0].parse::<f64>().is_ok())?;
    let both = format!("{} {word}", words[at]);
    parse_quantity(&both, None).ok()?;
    let option = words[..at].last().filter(|word| word.starts_with("--"));
    let before = option.map_or(String::new(), |option| format!("{option} "));
    let message = format!("a quantity is one word, but `{word}` is another");
    Some((message, format!("write {before}\"{both}\"")))
}

/// `lptn units 3 m 2 s`.
fn one_quantity(words: &[String], word: &str) -> Words {
    let rest = words.get(1..).unwrap_or_default().join(" ");
    let message = format!("a quantity is one word, but `{word}` is another");
    (message, format!("write lptn units \"{rest}\""))
}

fn second_netlist(words: &[String], word: &str) -> Words {
    let verb = words.first().map_or("", String::as_str);
    let files: Vec<String> =
        words.iter().filter(|word| is_netlist(word)).map(|word| quoted(word)).collect();
    let message = format!("`lptn {verb}` takes one netlist, but {word} is another");
    (message, format!("`lptn compare {}` compares them", files.join(" ")))
}

/// A value of a parameter without `--set`, a port without `--port`, or any other word.
fn no_place(word: &str) -> Words {
    let message = format!("`{}` has no place for the word `{word}`", command_line());
    let has =
        |option: &str| verb_parser().is_some_and(|verb| longs(&verb).any(|own| own == option));
    let help = match word.contains('=') {
        true if has("--set") => format!("write --set {}", quoted(word)),
        false if has("--port") => format!("a port is named by --port {}", quoted(word)),
        _ => lists_options(),
    };
    (message, help)
}

/// Two options, or an option and a file, that exclude each other.
fn not_together(error: &clap::Error) -> Option<Diagnostic> {
    let first = name_of(string_of(error, ContextKind::InvalidArg)?);
    let other = match error.get(ContextKind::PriorArg)? {
        ContextValue::String(other) => name_of(other),
        ContextValue::Strings(others) => name_of(others.first()?),
        _ => return None,
    };
    if error.kind() != ErrorKind::ArgumentConflict || first == other {
        return None;
    }
    let (option, of) = if first.starts_with('-') { (first, other) } else { (other, first) };
    let (of, help) = match of {
        "FILE" if arguments::words().first().is_some_and(|verb| verb == "size") => {
            let help = "a netlist has its heats and limits itself, and [size.NAME] names the values to find";
            ("a netlist".to_owned(), help.to_owned())
        }
        "FILE" => ("a file".to_owned(), lists_options()),
        of => (format!("`{of}`"), lists_options()),
    };
    let message = format!("`{option}` cannot be used with {of}");
    Some(Diagnostic::error("input::usage", message).help(help))
}

/// Words or options that a command needs.
fn not_given(error: &clap::Error) -> Option<Diagnostic> {
    let ContextValue::Strings(missing) = error.get(ContextKind::InvalidArg)? else { return None };
    if error.kind() != ErrorKind::MissingRequiredArgument {
        return None;
    }
    let message = format!("`{}` needs {}", command_line(), missing.join(" "));
    Some(Diagnostic::error("input::usage", message).help(lists_options()))
}

/// The name of an option or word of a usage: `--limit` of `--limit <T>`, `FILE` of `[FILE]`.
fn name_of(usage: &str) -> &str {
    let name = usage.split_whitespace().next().unwrap_or(usage);
    name.trim_matches(['[', ']', '<', '>', '.'])
}

fn string_of(error: &clap::Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind)? {
        ContextValue::String(text) => Some(text),
        _ => None,
    }
}

fn is_netlist(word: &str) -> bool {
    Path::new(word).extension().is_some_and(|ending| ending == "toml")
}
