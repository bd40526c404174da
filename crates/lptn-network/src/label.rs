//! Names of conductors and sources: their own, or one that is made of their number when someone asks.

use std::borrow::Cow;

use crate::id::{ConductorId, Item, SourceId};
use crate::parts::Parts;

/// What conductors without a name of their own are called, before their number in brackets.
const CONDUCTOR: &str = "import.conductor";
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
fn parsed(name: &str) -> Option<(&str, u32)> {
    let (kind, number) = name.strip_suffix(']')?.split_once('[')?;
    let number = number.parse().ok().filter(|_| !number.starts_with(['+', '0']))?;
    [CONDUCTOR, SOURCE].contains(&kind).then_some((kind, number))
}

/// Whether a name is one of those that are made.
pub(crate) fn is_numbered(name: &str) -> bool {
    parsed(name).is_some()
}

impl Parts {
    /// The conductor or source whose name is made of its number.
    pub(crate) fn numbered(&self, name: &str) -> Option<Item> {
        let (kind, number) = parsed(name)?;
        if kind == CONDUCTOR {
            let at = position(self.conductors.iter().map(|c| &c.label), self.numbered_conductors, number)?;
            return Some(Item::Conductor(ConductorId::from_len(at)));
        }
        let at = position(self.sources.iter().map(|s| &s.label), self.numbered_sources, number)?;
        Some(Item::Source(SourceId::from_len(at)))
    }
}

/// Where the label with this number is; as a rule each next one has the next number after the one at `first`.
fn position<'a>(
    mut labels: impl ExactSizeIterator<Item = &'a Label> + Clone,
    first: Option<(usize, u32)>,
    number: u32,
) -> Option<usize> {
    let is = |label: &Label| matches!(label, Label::Number(other) if *other == number);
    let (first, at_first) = first?;
    let guess = first + number.checked_sub(at_first)? as usize;
    if labels.clone().nth(guess).is_some_and(is) { Some(guess) } else { labels.position(is) }
}
