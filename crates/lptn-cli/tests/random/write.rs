//! Networks as files.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::model::{Entry, Field, Net, Piece, Side};

pub const MAIN: &str = "net.toml";
const INCLUDED: &str = "part.toml";

/// The files of a network, the netlist under [`MAIN`].
pub type Texts = BTreeMap<String, String>;

/// What stands in `[run]` though it is an entry of its own here.
const IN_RUN: [&str; 2] = ["report", "window"];

impl Net {
    pub fn texts(&self) -> Texts {
        let mut texts: Texts =
            self.sides.iter().map(|(name, side)| (name.clone(), side.text())).collect();
        let included = self.entries.iter().any(|entry| entry.included);
        let mut main =
            if included { format!("include = [\"{INCLUDED}\"]\n") } else { String::new() };
        main += &self.file(false);
        if included {
            texts.insert(INCLUDED.into(), self.file(true));
        }
        texts.insert(MAIN.into(), main);
        texts
    }

    fn file(&self, included: bool) -> String {
        let mut text = "format = 1\n".to_owned();
        let entries: Vec<&Entry> =
            self.entries.iter().filter(|entry| entry.included == included).collect();
        let mut sections: Vec<&str> = Vec::new();
        for entry in &entries {
            if !IN_RUN.contains(&&*entry.section) && !sections.contains(&&*entry.section) {
                sections.push(&entry.section);
            }
        }
        for section in sections {
            let of: Vec<&&Entry> =
                entries.iter().filter(|entry| entry.section == section).collect();
            self.section(&mut text, section, &of);
        }
        text
    }

    fn section(&self, text: &mut String, section: &str, entries: &[&&Entry]) {
        if entries.iter().any(|entry| entry.name.is_empty()) {
            // a section that is one table, such as [run]
            let _ = writeln!(text, "\n[{section}]");
            entries.iter().flat_map(|entry| &entry.fields).for_each(|field| line(text, field));
            if section == "run" {
                IN_RUN.iter().for_each(|inside| self.inside_run(text, inside));
            }
            return;
        }
        if entries.iter().any(|entry| !entry.long) {
            let _ = writeln!(text, "\n[{section}]");
        }
        for entry in entries.iter().filter(|entry| !entry.long) {
            line(text, &(entry.name.clone(), entry.value()));
        }
        for entry in entries.iter().filter(|entry| entry.long) {
            let _ = writeln!(text, "\n[{section}.{}]", entry.name);
            entry.fields.iter().for_each(|field| line(text, field));
        }
    }

    fn inside_run(&self, text: &mut String, section: &str) {
        let of = self.entries.iter().filter(|entry| entry.section == section);
        let table: Vec<(String, Field)> =
            of.map(|entry| (entry.name.clone(), entry.value())).collect();
        if !table.is_empty() {
            line(text, &(section.to_owned(), Field::Table(table)));
        }
    }
}

impl Entry {
    fn value(&self) -> Field {
        match &self.fields[..] {
            [(key, field)] if key.is_empty() => field.clone(),
            fields => Field::Table(fields.to_vec()),
        }
    }
}

fn line(text: &mut String, (key, field): &(String, Field)) {
    let _ = writeln!(text, "{key} = {}", field.text());
}

impl Field {
    pub fn text(&self) -> String {
        match self {
            Self::Value(pieces) => match &pieces[..] {
                [Piece::Number(number)] if number.unit().is_empty() => number.bare(),
                [Piece::Number(number)] => format!("\"{}\"", number.quantity()),
                pieces => format!("\"{}\"", pieces.iter().map(Piece::text).collect::<String>()),
            },
            Self::Name(name) | Self::Word(name) => format!("\"{name}\""),
            Self::Shares(shares) => {
                let shares: Vec<String> =
                    shares.iter().map(|(name, share)| format!("\"{name}\" = {share:?}")).collect();
                format!("{{ {} }}", shares.join(", "))
            }
            Self::Raw(text) => text.clone(),
            Self::List(list) => {
                format!("[{}]", list.iter().map(Self::text).collect::<Vec<_>>().join(", "))
            }
            Self::Table(table) | Self::Links(table) => {
                let inside: Vec<String> =
                    table.iter().map(|(key, field)| format!("{key} = {}", field.text())).collect();
                format!("{{ {} }}", inside.join(", "))
            }
        }
    }
}

impl Piece {
    fn text(&self) -> String {
        match self {
            Self::Text(text) | Self::Name(text) => text.clone(),
            Self::Number(number) => number.literal(),
            Self::Time => "t".into(),
        }
    }
}

impl Side {
    fn text(&self) -> String {
        let columns = match self {
            Self::Text(text) => return text.clone(),
            Self::Numbers(columns) => columns,
        };
        let head = columns.iter().map(|(name, numbers)| match numbers[0].unit() {
            "" => name.clone(),
            unit => format!("{name} [{unit}]"),
        });
        let mut text = head.collect::<Vec<_>>().join(",") + "\n";
        for row in 0..columns[0].1.len() {
            let cells: Vec<String> =
                columns.iter().map(|(_, numbers)| numbers[row].bare()).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}
