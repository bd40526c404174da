//! The colours of a terminal. No information is in a colour alone.

use crate::standing::Standing;

/// Width of a terminal in columns for which tables are made.
pub const WIDTH: usize = 80;

/// Look of texts on their output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// True if titles and verdicts are in colours.
    pub styled: bool,
    /// Columns of a line.
    pub width: usize,
}

impl Look {
    /// Without colours, for 80 columns.
    pub const PLAIN: Self = Self { styled: false, width: WIDTH };

    /// A title.
    pub(crate) fn title(self, text: &str) -> String {
        self.paint("1", text)
    }

    /// A text in the colour of a standing.
    pub(crate) fn standing(self, standing: Standing, text: &str) -> String {
        match standing {
            Standing::Holds => self.paint("32", text),
            Standing::Open => text.to_owned(),
            Standing::Fails => self.paint("1;31", text),
        }
    }

    fn paint(self, code: &str, text: &str) -> String {
        match self.styled && !text.is_empty() {
            true => format!("\u{1b}[{code}m{text}\u{1b}[0m"),
            false => text.to_owned(),
        }
    }
}
