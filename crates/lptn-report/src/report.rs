//! A result as a document that can be sent to a colleague.

use lptn_plot::{Figure, Scene};

use crate::page::Page;
use crate::text::{Block, Text};

/// What a document says of a result: first how far it can be trusted, then what it is.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What files about it are called.
    pub name: String,
    /// What it is about.
    pub title: String,
    /// What is known of its trustworthiness.
    pub claims: Vec<Claim>,
    /// What it shows, in order.
    pub sections: Vec<Section>,
}

/// A sentence on whether a result can be believed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// How it stands.
    pub standing: Standing,
    /// The sentence.
    pub text: String,
}

/// How a claim stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It was checked, and holds.
    Holds,
    /// It was not checked, or a reader has to know of it.
    Open,
    /// It was checked, and does not hold.
    Fails,
}

/// A part of a report under a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading; empty for none.
    pub title: String,
    /// What stands below it.
    pub pieces: Vec<Piece>,
    /// Whether it is folded away until somebody wants to see it.
    pub folded: bool,
}

/// A piece of a section.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Lines, sentences and tables.
    Text(Text),
    /// Curves.
    Figure(Figure),
    /// A drawing, with what is to be known of it below.
    Drawing(Scene, String),
    /// A text whose lines stay as they are.
    Verbatim(String),
}

impl Section {
    /// A section with one piece.
    pub fn of(title: impl Into<String>, piece: Piece) -> Self {
        Self { title: title.into(), pieces: vec![piece], folded: false }
    }

    /// The same, folded away.
    #[must_use]
    pub fn folded(self) -> Self {
        Self { folded: true, ..self }
    }
}

impl Claim {
    /// A claim that holds or not.
    pub fn checked(holds: bool, text: impl Into<String>) -> Self {
        let standing = if holds { Standing::Holds } else { Standing::Fails };
        Self { standing, text: text.into() }
    }

    /// A claim that nothing was checked of.
    pub fn open(text: impl Into<String>) -> Self {
        Self { standing: Standing::Open, text: text.into() }
    }
}

impl Report {
    /// What a page shows, with all that it has for a report besides.
    pub fn of(page: &dyn Page) -> Self {
        let (title, text) = titled(&page.text());
        let mut report = Self { title, ..page.more() };
        report.claims.extend(page.no().map(|no| Claim::checked(false, no)));
        let mut own: Vec<Section> = Vec::new();
        for mut figure in page.figures().into_iter().filter(|figure| !figure.panels.is_empty()) {
            if figure.title == report.title {
                figure.title = String::new();
            }
            own.push(Section::of("", Piece::Figure(figure)));
        }
        own.push(Section::of("Results", Piece::Text(text)));
        report.sections.splice(0..0, own);
        report
    }
}

/// A text without its title, and that.
fn titled(text: &Text) -> (String, Text) {
    let mut title = String::new();
    let mut rest = Text::new();
    for section in text.sections() {
        rest.section();
        for block in section {
            match block {
                Block::Title(own) if title.is_empty() => title.clone_from(own),
                block => drop(rest.add(block.clone())),
            }
        }
    }
    (title, rest)
}
