//! The verbs in the order in which the help lists them: those that most work needs, then by purpose.

use std::fmt::Write as _;

use clap::Command;

/// Headings with their verbs. Verbs that the help does not list are hidden.
pub(crate) const GROUPS: &[(&str, &[&str])] = &[
    ("Start here", &["new", "check", "run", "steady", "compare", "size", "plot"]),
    ("Simulate", &["gear", "impedance", "modes", "verify"]),
    ("Decide", &["rank", "sweep"]),
    ("Reduce", &["reduce"]),
    ("Measure", &["plan", "fit", "infer"]),
    ("Show", &["report", "graph"]),
    ("Look up", &["explain", "units", "materials", "schema", "help"]),
    ("Set up", &["setup"]),
];

/// Columns before the description of a verb.
const INDENT: usize = 15;

/// The verbs of a command under their headings, in lines of at most `width` columns.
pub(crate) fn listed(command: &Command, width: usize) -> String {
    let mut text = String::new();
    for (heading, verbs) in GROUPS {
        let found = verbs.iter().filter_map(|verb| command.find_subcommand(verb));
        let listed: Vec<&Command> = found.collect();
        let _ = writeln!(text, "{heading}:");
        for verb in listed {
            let about = verb.get_about().map(ToString::to_string).unwrap_or_default();
            let lines = wrapped(&about, width.saturating_sub(INDENT).max(20));
            for (i, line) in lines.iter().enumerate() {
                let name = if i == 0 { verb.get_name() } else { "" };
                let _ = writeln!(text, "  {name:<width$}{line}", width = INDENT - 2);
            }
        }
        text.push('\n');
    }
    text
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= width {
            *line = format!("{line} {word}");
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_verb_is_in_one_group() {
        let mut command = <crate::args::Args as clap::CommandFactory>::command();
        command.build();
        let shown = command.get_subcommands().filter(|verb| !verb.is_hide_set());
        let shown: BTreeSet<&str> = shown.map(Command::get_name).collect();
        let listed = || GROUPS.iter().flat_map(|(_, verbs)| verbs.iter().copied());
        assert_eq!(listed().collect::<BTreeSet<_>>(), shown);
        assert_eq!(listed().count(), shown.len(), "a verb is listed twice");
        assert_eq!(GROUPS[0].1.len(), 7, "those that a newcomer reads first");
    }

    #[test]
    fn lines_keep_to_the_width() {
        let command = <crate::args::Args as clap::CommandFactory>::command();
        for width in [60, 80, 100] {
            let text = listed(&command, width);
            assert!(text.lines().all(|line| line.chars().count() <= width), "{text}");
        }
        assert_eq!(wrapped("a bb ccc dddd", 4), ["a bb", "ccc", "dddd"]);
    }
}
