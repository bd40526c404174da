//! A result as a document that can be sent to a colleague.
//!
//! A report is a page with additions: claims, texts, figures and drawings, the same ones that
//! terminal, SVG and PNG show. `lptn-html` only writes them.

use lptn_plot::{Figure, Scene};

use crate::standing::Standing;
use crate::text::Text;

/// A result as a document: how far it can be trusted, then its sections.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Name of its files.
    pub name: String,
    /// Its subject.
    pub title: String,
    /// Claims on its trustworthiness.
    pub claims: Vec<Claim>,
    /// The answer in short, before its figures.
    pub answer: Vec<Section>,
    /// The text below the figures; `None` for that of the page.
    pub results: Option<Text>,
    /// Its parts, in order.
    pub sections: Vec<Section>,
}

/// A sentence on how far a result can be trusted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Its standing.
    pub standing: Standing,
    /// The sentence.
    pub text: String,
}

/// A part of a report under a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading; empty for none.
    pub title: String,
    /// Its content.
    pub pieces: Vec<Piece>,
    /// True if it is collapsed until a reader opens it.
    pub folded: bool,
}

/// A piece of a section.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Lines, sentences and tables.
    Text(Text),
    /// Curves.
    Figure(Figure),
    /// A drawing and its caption.
    Drawing(Scene, String),
    /// Drawings of one thing at several times, each with its time; the last is shown first.
    Frames(Vec<(String, Scene)>),
    /// A text whose lines stay as they are.
    Verbatim(String),
}

impl Report {
    /// The same with a sentence that the page begins with.
    #[must_use]
    pub fn answered(mut self, sentence: &str) -> Self {
        let mut text = Text::new();
        text.sentence("", sentence);
        self.answer.push(Section::of("", Piece::Text(text)));
        self
    }
}

impl Section {
    /// A section with one piece.
    pub fn of(title: impl Into<String>, piece: Piece) -> Self {
        Self { title: title.into(), pieces: vec![piece], folded: false }
    }

    /// True if it has nothing but small figures, which are next to each other.
    pub fn is_of_small(&self) -> bool {
        let is_small = |piece: &Piece| matches!(piece, Piece::Figure(figure) if figure.is_small());
        self.pieces.iter().all(is_small)
    }

    /// The same section, collapsed.
    #[must_use]
    pub fn folded(self) -> Self {
        Self { folded: true, ..self }
    }
}

impl Claim {
    /// A claim that was checked and holds or fails.
    pub fn checked(holds: bool, text: impl Into<String>) -> Self {
        let standing = if holds { Standing::Holds } else { Standing::Fails };
        Self { standing, text: text.into() }
    }

    /// A claim that was not checked.
    pub fn open(text: impl Into<String>) -> Self {
        Self { standing: Standing::Open, text: text.into() }
    }
}
