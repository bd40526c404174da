//! The slots that a value reads, and the temperatures that an element depends on.

use smallvec::SmallVec;

use crate::id::End;

/// Vertices that a conductor depends on: seldom more than its two ends, which take no memory.
pub type Vertices = SmallVec<[u32; 4]>;

/// Kinds of slots that a value reads.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Reads {
    pub(crate) time: bool,
    /// Controls, or comparisons whose truth is fixed between events.
    pub(crate) positions: bool,
    pub(crate) link: bool,
    pub(crate) own: bool,
    /// Nodes and boundaries by name, ascending.
    pub(crate) temperatures: Vec<End>,
}

impl Reads {
    /// True if it reads nothing but parameters.
    pub(crate) fn is_constant(&self) -> bool {
        !self.time && !self.positions && !self.reads_results()
    }

    /// True if it reads any temperature.
    pub(crate) fn reads_results(&self) -> bool {
        self.link || self.own || !self.temperatures.is_empty()
    }
}

/// The temperatures that an element's heat depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dependence {
    /// Vertices, each once: nodes, then boundaries. Those of a conductor begin with its ends.
    pub(crate) vertices: Vertices,
    /// Slots with the temperature of `vertices[.1]`.
    pub(crate) named: Vec<(u32, usize)>,
}

/// The dependence of a conductor. It takes no separate memory if the heat depends on nothing but
/// the temperatures of the ends, as in a body of a million cells.
#[derive(Clone, Debug)]
pub(crate) enum OfConductor {
    Nothing,
    Ends,
    /// A position in the list of those that depend on more.
    More(u32),
}

impl Dependence {
    /// True if it names no vertices but two.
    pub(crate) fn is_ends(&self) -> bool {
        self.vertices.len() == 2 && self.named.is_empty()
    }
}
