//! Why a network could not be assembled.

use lptn_network::NodeId;

lptn_units::errors! {
/// Why a network could not be assembled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AssemblyError {
    /// Eliminating a massless node would link too many pairs of its neighbours.
    TooManyNeighbours { node: NodeId, name: String, neighbours: usize } =
        "assembly::too_many_neighbours",
        format!(
            "the massless nodes are too closely meshed to be eliminated: `{name}` has {neighbours} \
             neighbours when its turn comes, and every pair of them would be linked"
        ),
        help format!("give `{name}` and nodes like it a capacity, so that they become states");
}
}
