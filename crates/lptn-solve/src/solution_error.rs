//! Reasons why a solution has no answer.

lptn_units::errors! {
/// A question that a solution cannot answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SolutionError {
    /// The temperatures of this node were not recorded.
    NotRecorded { name: String } = "solve::not_recorded",
        format!("the run kept no temperatures of node `{name}`"),
        help "name the node in `Transient::record`, or leave that out to keep all of them";
}
}
