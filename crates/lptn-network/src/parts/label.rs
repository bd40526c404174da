//! Names of conductors and sources: their own, or one made of their number on request.

use std::borrow::Cow;
use std::sync::Arc;

use crate::parts::grid_names::PathNames;

/// Name of conductors without their own, before their number in brackets.
pub(crate) const CONDUCTOR: &str = "import.conductor";

/// Name of sources without their own.
const SOURCE: &str = "import.source";

/// Its own name, a number, or a place in a grid.
#[derive(Clone, Debug)]
pub(crate) enum Label {
    Own(Box<str>),
    Number(u32),
    /// The place among the inner paths of a grid along an axis.
    Inner(Arc<PathNames>, u32),
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
            Self::Inner(names, place) => Cow::Owned(names.name(*place)),
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

/// True if a name is made of a number.
pub(crate) fn is_numbered(name: &str) -> bool {
    parsed(name).is_some()
}
