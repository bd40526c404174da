//! What parts of a text mean, in the colours of a terminal.

/// What a part of a text means. Nothing is said by its colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// What a text is about.
    Title,
    /// Kept, or right.
    Good,
    /// Broken, or wrong.
    Bad,
}

impl Style {
    /// The text in its colour, where texts are `styled`.
    pub fn paint(self, text: &str, styled: bool) -> String {
        let code = match self {
            Self::Title => "1",
            Self::Good => "32",
            Self::Bad => "1;31",
        };
        match styled && !text.is_empty() {
            true => format!("\u{1b}[{code}m{text}\u{1b}[0m"),
            false => text.to_owned(),
        }
    }
}
