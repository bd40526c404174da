//! The colours of a terminal. Nothing is said by a colour alone.

use crate::standing::Standing;

/// Columns of a terminal that tables are made for.
pub const WIDTH: usize = 80;

/// How texts look on what they are written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Whether titles and verdicts are in colours.
    pub styled: bool,
    /// Letters that fit into a line.
    pub width: usize,
}

impl Look {
    /// Without colours, for 80 columns.
    pub const PLAIN: Self = Self { styled: false, width: WIDTH };

    /// A title.
    pub(crate) fn title(self, text: &str) -> String {
        self.paint("1", text)
    }

    /// A text that says how something stands.
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
