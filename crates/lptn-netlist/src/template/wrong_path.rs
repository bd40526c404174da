//! Paths that lead to no instance: an index too many, too few or too large.

use super::structure::Structure;
use lptn_data::{Diagnostic, Span};

/// The error in the indices of a path.
#[derive(Debug)]
pub(crate) struct WrongPath {
    /// The error, after "names `planet[9].gear`, but".
    pub(crate) why: String,
    /// The correction.
    pub(crate) help: String,
    /// The place that makes the instances.
    pub(crate) made: Span,
}

impl Structure {
    /// The error of a path, if an index of an instance is wrong.
    pub(crate) fn wrong_path(&self, path: &str) -> Option<WrongPath> {
        let mut before = String::new();
        for part in path.split('.') {
            let (name, index) = match part.split_once('[') {
                Some((name, rest)) => (name, Some(rest.strip_suffix(']').unwrap_or(rest))),
                None => (part, None),
            };
            let full = format!("{before}{name}");
            if let Some(used) = self.uses.get(&full) {
                let tail = path.get(before.len() + part.len()..).unwrap_or_default();
                let wrong = |why: String, help: String| {
                    Some(WrongPath { why, help, made: used.span.clone() })
                };
                match (used.count, index) {
                    (Some(count), Some("*")) => {
                        let help = format!(
                            "name one, {}; all of them may be in `of` of a limit, in `into` of a \
                             source, at the ends of a path and in `select`",
                            range((&full, tail), count)
                        );
                        return wrong("a pattern cannot be used here".to_owned(), help);
                    }
                    (Some(count), None) => {
                        let why = format!("`{full}` has {}", instances(count));
                        return wrong(why, format!("say which: {}", range((&full, tail), count)));
                    }
                    (None, Some(_)) => {
                        let why = format!("`{full}` has no index: its use has no `count`");
                        return wrong(why, format!("write `{full}{tail}`"));
                    }
                    (Some(count), Some(index))
                        if !index.parse::<usize>().is_ok_and(|i| (1..=count).contains(&i)) =>
                    {
                        let why = format!("`{full}` has {}", instances(count));
                        return wrong(why, format!("write {}", range((&full, tail), count)));
                    }
                    _ => {}
                }
            }
            before = format!("{before}{part}.");
        }
        None
    }
}

/// Error for a wrong path, which `words` names at `place`.
pub(crate) fn wrong_path((words, path): (&str, &str), place: Span, wrong: WrongPath) -> Diagnostic {
    let message = format!("{words} names `{path}`, but {}", wrong.why);
    let problem = Diagnostic::error("netlist::no_instance", message).at(place, "");
    problem.also(wrong.made, "made here").help(wrong.help)
}

fn instances(count: usize) -> String {
    if count == 1 { "1 instance".to_owned() } else { format!("{count} instances") }
}

fn range((name, tail): (&str, &str), count: usize) -> String {
    match count {
        1 => format!("`{name}[1]{tail}`"),
        _ => format!("`{name}[1]{tail}` to `{name}[{count}]{tail}`"),
    }
}
