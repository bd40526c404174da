//! Number of evaluations in a run.

/// Counters of the evaluations of a run, for its rows and between them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Looks {
    /// Number of times that the temperatures of all nodes were taken from the state.
    pub placed: u64,
    /// Number of steps in which the peak or the level of a watched node was searched for, of all
    /// such nodes together.
    pub searched: u64,
}
