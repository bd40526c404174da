//! A result for reading: a title, and sections of lines, sentences and tables.

use std::io::{self, Write};

use crate::colour::Look;
use crate::layout::{TextTable, labelled};
use crate::standing::Standing;

/// A result for a person, from the title to the verdict.
#[derive(Clone, Debug, Default)]
pub struct Text {
    sections: Vec<Vec<Block>>,
}

/// A part of a section.
#[derive(Clone, Debug)]
pub enum Block {
    /// Subject of the result.
    Title(String),
    /// A line as it is.
    Line(String),
    /// A line that shows a standing.
    Marked(Standing, String),
    /// A table.
    Table(TextTable),
    /// A label and the pieces after it, which are not broken.
    Labelled(String, Vec<String>),
}

impl Text {
    /// A text without a title.
    pub fn new() -> Self {
        Self::default()
    }

    /// A text with a title. Blocks added before the first section follow directly below it.
    pub fn titled(title: impl Into<String>) -> Self {
        Self { sections: vec![vec![Block::Title(title.into())]] }
    }

    /// Begins a section, with an empty line before it. A section that stays empty is not shown.
    pub fn section(&mut self) -> &mut Self {
        self.sections.push(Vec::new());
        self
    }

    /// Adds a title inside the text.
    pub fn title(&mut self, title: &str) -> &mut Self {
        self.add(Block::Title(title.to_owned()))
    }

    /// Adds the sections of another text.
    pub fn append(&mut self, other: Self) -> &mut Self {
        self.sections.extend(other.sections);
        self
    }

    /// Adds a line.
    pub fn line(&mut self, line: impl Into<String>) -> &mut Self {
        self.add(Block::Line(line.into()))
    }

    /// Adds a line that shows a standing.
    pub fn marked(&mut self, standing: Standing, line: impl Into<String>) -> &mut Self {
        self.add(Block::Marked(standing, line.into()))
    }

    /// Adds lines.
    pub fn lines(&mut self, lines: impl IntoIterator<Item = String>) -> &mut Self {
        for line in lines {
            self.line(line);
        }
        self
    }

    /// Adds a table.
    pub fn table(&mut self, table: impl Into<TextTable>) -> &mut Self {
        self.add(Block::Table(table.into()))
    }

    /// Adds a sentence after a label such as `note: `, wrapped between words.
    /// Further lines begin below its first word.
    pub fn sentence(&mut self, label: &str, text: &str) -> &mut Self {
        self.labelled(label, words(text))
    }

    /// Adds sentences, each after `note: `.
    pub fn notes<S: AsRef<str>>(&mut self, notes: impl IntoIterator<Item = S>) -> &mut Self {
        for note in notes {
            self.sentence("note: ", note.as_ref());
        }
        self
    }

    /// Ends a page with a section of notes and one of the verdict.
    /// The label of each note is padded to `width`.
    pub fn conclude<'a>(
        &mut self,
        width: usize,
        notes: impl IntoIterator<Item = (&'a str, String)>,
        verdict: &str,
    ) {
        self.section();
        for (label, note) in notes {
            self.sentence(&format!("{label:width$}"), &note);
        }
        self.section().sentence("", verdict);
    }

    /// Adds a sentence in pieces that are not broken.
    pub fn labelled(&mut self, label: &str, pieces: Vec<String>) -> &mut Self {
        self.add(Block::Labelled(label.to_owned(), pieces))
    }

    /// Adds a block.
    pub(crate) fn add(&mut self, block: Block) -> &mut Self {
        match self.sections.last_mut() {
            Some(section) => section.push(block),
            None => self.sections.push(vec![block]),
        }
        self
    }

    /// Sections that are not empty.
    pub fn sections(&self) -> impl Iterator<Item = &[Block]> {
        self.sections.iter().map(Vec::as_slice).filter(|section| !section.is_empty())
    }
}

/// The words of a text.
pub fn words(text: &str) -> Vec<String> {
    text.split(' ').map(str::to_owned).collect()
}

/// Widest sentence in columns, however wide the terminal is: longer lines are hard to read.
const WIDEST_SENTENCE: usize = 100;

/// Writes a text for a terminal.
pub(crate) fn write(text: &Text, look: Look, out: &mut dyn Write) -> io::Result<()> {
    for (i, section) in text.sections().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        section
            .iter()
            .flat_map(|block| lines(block, look))
            .try_for_each(|line| writeln!(out, "{line}"))?;
    }
    Ok(())
}

fn lines(block: &Block, look: Look) -> Vec<String> {
    match block {
        Block::Title(title) => vec![look.title(title)],
        Block::Marked(standing, line) => vec![look.standing(*standing, line)],
        Block::Line(line) => vec![line.clone()],
        Block::Table(table) => table.clone().lines(look),
        Block::Labelled(label, pieces) => labelled(label, pieces, look.width.min(WIDEST_SENTENCE)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Text, write};
    use crate::{Look, TextTable};

    fn written(text: &Text, styled: bool) -> String {
        let mut out = Vec::new();
        write(text, Look { styled, width: 80 }, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn sections_stand_apart_and_empty_ones_vanish() {
        let mut text = Text::titled("motor");
        text.line("2 nodes").section().section().notes(["hot", "cold"]);
        let table =
            TextTable::of(&[92.7, 25.0]).left("", |_| "steel").right("T", |t: &f64| t.to_string());
        text.section().table(table).section();
        let shown =
            "motor\n2 nodes\n\nnote: hot\nnote: cold\n\n          T\nsteel  92.7\nsteel    25\n";
        assert_eq!(written(&text, false), shown);
        assert!(written(&text, true).starts_with("\u{1b}[1mmotor\u{1b}[0m\n2 nodes\n"));
        assert_eq!(written(&Text::new(), false), "");
    }
}
