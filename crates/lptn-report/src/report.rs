//! A result as a document that can be sent to a colleague.
//!
//! A report is a page with additions: claims, texts, figures and drawings, the same ones that
//! terminal, SVG and PNG show. `lptn-html` only writes them.

use lptn_plot::{Figure, Scene};

use crate::standing::Standing;
use crate::text::Text;

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
