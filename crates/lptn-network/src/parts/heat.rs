//! Heat flows of the results and results of laws, by name.

use crate::id::{BoundaryId, ConductorId, FacePathId, Item, SourceId};

/// A heat flow of the results in W, or a result of the law of a path or source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HeatOf {
    /// `NAME.Q` of a path that is not a stream: positive from `from` to `to`.
    Conductor(ConductorId),
    /// `NAME.Q_from` of a stream: the heat that its first end receives.
    ReceivedFrom(ConductorId),
    /// `NAME.Q_to` of a stream: the heat that its second end receives.
    ReceivedTo(ConductorId),
    /// `NAME.P` of a source: positive into its nodes.
    Source(SourceId),
    /// `NAME.Q` of a boundary: the heat that it gives to the network.
    Boundary(BoundaryId),
    /// `NAME.Q` of a path that ends at a face of a grid: the sum over its conductors.
    FacePath(FacePathId),
    /// `NAME.pressure` and the like of a path or source: a result that its law declares, by its
    /// key.
    Told(Item, &'static str),
}

impl HeatOf {
    /// The item whose heat it is.
    pub fn item(self) -> Item {
        match self {
            Self::Conductor(id) | Self::ReceivedFrom(id) | Self::ReceivedTo(id) => {
                Item::Conductor(id)
            }
            Self::Told(item, _) => item,
            Self::Source(id) => Item::Source(id),
            Self::Boundary(id) => Item::Boundary(id),
            Self::FacePath(id) => Item::FacePath(id),
        }
    }

    /// The name of its column; `name` is that of its item.
    pub(crate) fn named(self, name: &str) -> String {
        let ending = match self {
            Self::Conductor(_) | Self::Boundary(_) | Self::FacePath(_) => "Q",
            Self::ReceivedFrom(_) => "Q_from",
            Self::ReceivedTo(_) => "Q_to",
            Self::Source(_) => "P",
            Self::Told(_, key) => key,
        };
        format!("{name}.{ending}")
    }
}
