//! When a run writes a row: said in a netlist, kept by the analyses.

/// When a run writes a row. Start and stop of the run always have one.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputTimes {
    /// Every so many seconds from the start.
    Every(f64),
    /// At these times in s, strictly increasing and inside the run.
    At(Vec<f64>),
}

impl OutputTimes {
    /// More rows than this are refused: a mistyped unit, not a wish.
    pub const MOST_ROWS: f64 = 1e7;
    /// Number of intervals of a run that does not say.
    pub const USUAL_INTERVALS: f64 = 300.0;
}
