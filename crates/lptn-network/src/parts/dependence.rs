//! What a value reads, and the temperatures that an element depends on.

use crate::id::End;

/// What the slots of a value hold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Reads {
    pub(crate) time: bool,
    /// Controls, or the truth of comparisons that is held between events.
    pub(crate) positions: bool,
    pub(crate) link: bool,
    pub(crate) own: bool,
    /// Nodes and boundaries by name, ascending.
    pub(crate) temperatures: Vec<End>,
}

impl Reads {
    /// Whether it reads nothing but parameters.
    pub(crate) fn is_constant(&self) -> bool {
        !self.time && !self.positions && !self.reads_results()
    }

    /// Whether it reads any temperature.
    pub(crate) fn reads_results(&self) -> bool {
        self.link || self.own || !self.temperatures.is_empty()
    }
}

/// Which temperatures an element's heat depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dependence {
    /// Vertices, each once: nodes, then boundaries. Those of a conductor begin with its ends.
    pub(crate) vertices: Vec<u32>,
    /// Slots that hold the temperature of `vertices[.1]`.
    pub(crate) named: Vec<(u32, usize)>,
}

/// That of a conductor that depends on nothing.
pub(crate) static NONE: Dependence = Dependence { vertices: Vec::new(), named: Vec::new() };
