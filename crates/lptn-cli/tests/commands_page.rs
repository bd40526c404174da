//! `docs/commands.md` has the options of every command, as its help prints them.
//!
//! A section of the page begins with a heading ` ### lptn NAME ` and a paragraph, which people write.
//! The rest of it follows from `lptn help NAME`. Options that several commands share are in one table.
//! `LPTN_BLESS=1 cargo test -p lptn-cli --test all commands_page::` writes the page.

use std::path::{Path, PathBuf};
use std::process::Command;

/// An option that as many commands share is listed once.
const SHARED: usize = 2;

/// The heading of the table of shared options.
const MANY: &str = "## Options of many commands";

/// An argument or option of a command, and its effect.
#[derive(Clone, PartialEq)]
struct Entry {
    name: String,
    effect: String,
}

impl Entry {
    fn row(&self) -> String {
        format!("| `{}` | {} |", self.name, self.effect.replace('|', "\\|"))
    }

    /// The netlist with a study, or the name of one: the page says once what they are.
    fn is_study(&self) -> bool {
        let netlist = self.effect.starts_with("A netlist with a [");
        (netlist && !self.effect.contains("without")) || self.effect.starts_with("Which [")
    }

    /// `--output` of `-o, --output <DIR>`.
    fn long(&self) -> &str {
        let name = self.name.split(", ").last().unwrap_or(&self.name);
        name.split([' ', '[']).find(|word| !word.is_empty()).unwrap_or(name)
    }
}

/// The help of a command: how it is written, and its entries.
struct Help {
    usage: Vec<String>,
    entries: Vec<Entry>,
}

fn help(command: &str) -> Help {
    let mut lptn = Command::new(env!("CARGO_BIN_EXE_lptn"));
    let output = lptn.arg("help").args(command.split(' ')).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let text = text.split("\nEverywhere:").next().unwrap();
    let usage = text.lines().skip_while(|line| !line.starts_with("Usage: "));
    let usage = usage.take_while(|line| !line.is_empty());
    Help {
        usage: usage.map(|line| line.trim_start_matches("Usage:").trim().to_owned()).collect(),
        entries: entries(text.split("\nUsage: ").nth(1).unwrap()),
    }
}

/// The entries of all sections of a help.
fn entries(text: &str) -> Vec<Entry> {
    let mut found: Vec<Entry> = Vec::new();
    let (mut commands, mut open) = (false, false);
    for line in text.lines().skip(1) {
        let words = line.trim();
        let indent = line.len() - line.trim_start().len();
        if indent == 0 || words.is_empty() {
            commands = line.starts_with("Commands:") || (commands && words.is_empty());
            open = false;
        } else if indent <= 6 && (commands || words.starts_with(['-', '<', '['])) {
            let (name, effect) = words.split_once("  ").unwrap_or((words, ""));
            found.push(Entry { name: name.to_owned(), effect: effect.trim().to_owned() });
            open = true;
        } else if let Some(last) = found.last_mut().filter(|_| open) {
            last.effect = format!("{} {words}", last.effect).trim().to_owned();
        }
    }
    found.retain(|entry| !matches!(entry.name.as_str(), "help" | "-h, --help"));
    found
}

/// A table of entries; nothing without one.
fn table(heading: &str, entries: &[Entry]) -> String {
    if entries.is_empty() {
        return String::new();
    }
    let rows: Vec<String> = entries.iter().map(Entry::row).collect();
    format!("| {heading} | Effect |\n|---|---|\n{}\n\n", rows.join("\n"))
}

/// The part of a section that follows from its help.
fn section(help: &Help, shared: &[Entry]) -> String {
    let (also, own): (Vec<Entry>, Vec<Entry>) =
        help.entries.iter().filter(|e| !e.is_study()).cloned().partition(|e| shared.contains(e));
    let usage: Vec<String> = help.usage.iter().map(|line| format!("`{line}`")).collect();
    let names: Vec<String> = also
        .iter()
        .filter(|e| e.name.starts_with('-'))
        .map(|e| format!("`{}`", e.long()))
        .collect();
    let also = if names.is_empty() { "" } else { &format!("; also {}", names.join(", ")) };
    let usage = format!("{}{also}", usage.join(", "));
    match own.as_slice() {
        [one] => wrapped(&format!("{usage}. `{}`: {}.", one.name, one.effect)) + "\n\n",
        _ => format!("{}\n\n{}", wrapped(&usage), table("Option", &own)),
    }
}

/// A paragraph in lines of up to 100 characters.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last_mut().unwrap();
        if last.is_empty() {
            last.push_str(word);
        } else if last.chars().count() + 1 + word.chars().count() > 100 {
            lines.push(word.to_owned());
        } else {
            *last += &format!(" {word}");
        }
    }
    lines.join("\n")
}

/// Entries that several commands have, in the order in which they are met.
fn shared(all: &[Help]) -> Vec<Entry> {
    let mut found: Vec<Entry> = Vec::new();
    for entry in all.iter().flat_map(|help| &help.entries) {
        let count = all.iter().filter(|help| help.entries.contains(entry)).count();
        if count >= SHARED && !found.contains(entry) {
            found.push(entry.clone());
        }
    }
    found
}

/// The page with all generated parts.
fn written(page: &str) -> String {
    let names: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("### lptn ")).collect();
    assert!(names.len() >= 20, "only {} commands have a section", names.len());
    let helps: Vec<Help> = names.iter().map(|name| help(name)).collect();
    let shared = shared(&helps);
    let mut text = String::new();
    let mut kept = true;
    for line in page.lines() {
        if line.starts_with('#') {
            kept = true;
        }
        if kept {
            text += &format!("{line}\n");
        }
        if line == MANY {
            text += &format!("\n{}", table("Option", &shared));
            kept = false;
        }
    }
    let mut parts = text.split("\n### lptn ");
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for (part, help) in parts.zip(&helps) {
        let (name, rest) = part.split_once('\n').unwrap_or((part, ""));
        let said =
            rest.trim_start().lines().take_while(|l| !l.is_empty() && !l.starts_with("`lptn"));
        let said = said.collect::<Vec<_>>().join("\n");
        let next = rest.find("\n## ").map_or("", |at| rest[at..].trim_start());
        let part = format!("### lptn {name}\n{said}\n{}{next}", section(help, &shared));
        whole = format!("{}\n\n{part}", whole.trim_end());
    }
    whole.trim_end().to_owned() + "\n"
}

fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/commands.md")
}

#[test]
fn options_are_those_of_the_help() {
    let found = std::fs::read_to_string(page()).unwrap();
    let expected = written(&found);
    if found != expected && std::env::var_os("LPTN_BLESS").is_some() {
        std::fs::write(page(), &expected).unwrap();
    }
    assert!(found == expected, "LPTN_BLESS=1 writes docs/commands.md");
}
