//! How much was looked at in a run.

/// Counters of what a run looks at, for its rows and between them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// How often the temperatures of all nodes were taken from the state.
    pub placed: u64,
    /// In how many steps the peak or the level of a watched node was sought, of all such nodes
    /// together.
    pub sought: u64,
}
