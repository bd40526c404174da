//! Materials whose conductivity depends on the direction: layers, and the wires of a winding.
//!
//! Both have one axis, along which the conductivity differs.

/// The directions that a material distinguishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Texture {
    /// None: it conducts equally in all directions.
    Even,
    /// The plane of its layers, and the axis across them.
    Layers,
    /// Across its wires, and the axis along them.
    Wires,
}

/// A word for a direction: the texture that has it, and whether it is that of the axis.
pub(crate) type Direction = (&'static str, (Texture, bool));

/// The words of every texture.
pub(crate) const DIRECTIONS: [Direction; 4] = [
    ("in_plane", (Texture::Layers, false)),
    ("through_plane", (Texture::Layers, true)),
    ("across_wires", (Texture::Wires, false)),
    ("along_wires", (Texture::Wires, true)),
];

impl Texture {
    /// The words for its two directions.
    pub(crate) fn words(self) -> Vec<&'static str> {
        let own = DIRECTIONS.iter().filter(|(_, (texture, _))| *texture == self);
        own.map(|(word, _)| *word).collect()
    }

    /// The word for a direction.
    pub(crate) fn word(self, axial: bool) -> Option<&'static str> {
        DIRECTIONS.iter().find(|(_, meaning)| *meaning == (self, axial)).map(|(word, _)| *word)
    }

    /// The texture as the predicate of a sentence.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Self::Even => "conducts equally in all directions",
            Self::Layers => "has layers",
            Self::Wires => "is a winding",
        }
    }
}
