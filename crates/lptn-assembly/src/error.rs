//! Why a network could not be assembled.

use std::fmt;

use lptn_network::NodeId;

/// Why a network could not be assembled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AssemblyError {
    /// Eliminating a massless node would link too many pairs of its neighbours.
    TooManyNeighbours {
        /// The massless node.
        node: NodeId,
        /// Its name.
        name: String,
        /// How many neighbours it has when its turn comes.
        neighbours: usize,
    },
}

impl AssemblyError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooManyNeighbours { .. } => "assembly::too_many_neighbours",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Self::TooManyNeighbours { name, .. } => {
                format!("give `{name}` and its likes their capacity, so that they become states")
            }
        }
    }
}

impl fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyNeighbours { name, neighbours, .. } => write!(
                f,
                "the massless nodes are too closely meshed to be eliminated: `{name}` has {neighbours} neighbours \
                 when its turn comes, and every pair of them would be linked"
            ),
        }
    }
}

impl std::error::Error for AssemblyError {}
