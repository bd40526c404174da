//! Names of conductors and sources: their own, or one that is made of their number when someone
//! asks.

use std::borrow::Cow;

/// What conductors without a name of their own are called, before their number in brackets.
pub(crate) const CONDUCTOR: &str = "import.conductor";

/// What sources without a name of their own are called.
const SOURCE: &str = "import.source";

/// A name of its own, or a number.
#[derive(Clone, Debug)]
pub(crate) enum Label {
    Own(Box<str>),
    Number(u32),
}

impl Label {
    /// The name of a conductor.
    pub(crate) fn of_conductor(&self) -> Cow<'_, str> {
        self.text(CONDUCTOR)
    }

    /// The name of a source.
    pub(crate) fn of_source(&self) -> Cow<'_, str> {
        self.text(SOURCE)
    }

    fn text(&self, kind: &str) -> Cow<'_, str> {
        match self {
            Self::Own(name) => Cow::Borrowed(name),
            Self::Number(number) => Cow::Owned(format!("{kind}[{number}]")),
        }
    }
}

impl From<&str> for Label {
    fn from(name: &str) -> Self {
        Self::Own(name.into())
    }
}

/// The kind and the number of such a name.
pub(crate) fn parsed(name: &str) -> Option<(&str, u32)> {
    let (kind, number) = name.strip_suffix(']')?.split_once('[')?;
    let number = number.parse().ok().filter(|_| !number.starts_with(['+', '0']))?;
    [CONDUCTOR, SOURCE].contains(&kind).then_some((kind, number))
}

/// Whether a name is one of those that are made.
pub(crate) fn is_numbered(name: &str) -> bool {
    parsed(name).is_some()
}
