//! Reasons why nothing can be inferred.

use lptn_analysis::RunError;
use lptn_assembly::ChangeError;
use lptn_solve::{TransientError, Unsolved};
use lptn_units::{Class, EvalError, format_short as short};

use crate::network::NetworkFitError;

lptn_units::errors! {
/// Reasons why no time history can be inferred from a record.
#[derive(Debug)]
pub enum InferError {
    /// The measurements of the record cannot be compared with the network.
    Record => NetworkFitError;
    /// A number of the study has no value.
    Plan => EvalError;
    /// The network, with its own or other time histories.
    Network => ChangeError;
    /// The run near which the record is evaluated.
    Run => Box<TransientError>;
    /// The rates at one of its moments.
    Rates => Unsolved as Class::of_numbers;
    /// A value of the estimated signal of this name is 0 or less.
    NotPositive { signal: String, value: f64 } = "infer::not_positive",
        format!("the logarithm of `{signal}` is estimated, but its values in the netlist reach \
            {value}"),
        help "give it values above 0 in the netlist, or leave `positive` out";
    /// The record has fewer than two rows after its start.
    Short = "infer::short", "the record has fewer than two rows that count",
        help "an inference over time needs a record: a row for each moment";
    /// No column depends on an estimated signal.
    Unfelt { signal: String } = "infer::unfelt",
        format!("no column depends on `{signal}`, so the record does not determine it"),
        help "measure a node that it heats or cools, or use it in an element";
    /// Controls or comparisons of temperatures switch.
    Events = "infer::events",
        "the network has controls or comparisons of temperatures, which switch: a signal cannot be \
         estimated across a switch",
        help "write their state as a signal of the record, `signal = { fan = \"fan_state\" }`";
    /// The network has too many nodes with capacity to follow all their covariances.
    Large { nodes: usize, most: usize } = "infer::large",
        format!("the network has {nodes} nodes with capacity; at most {most} are possible, since \
            every pair of them has a covariance"),
        help "make a smaller network of it: `lptn reduce FILE --keep NODES`";
    /// The time constant of this instrument is not known.
    Lag { sensor: String } = "infer::lag",
        format!("the time constant of sensor `{sensor}` is not known exactly"),
        help "find it by `lptn fit network` and write it as a plain value, `lag = \"20 s\"`";
    /// The offset or gain of this instrument, which a signal follows, is not known.
    Input { sensor: String } = "infer::input",
        format!("a signal follows the readings of sensor `{sensor}`, whose offset or gain is not \
            known exactly"),
        help "find it by `lptn fit network` and write it as a plain value, `offset = \"1.2 K\"`";
    /// The change of a time history must be given.
    Smoothness { signal: String } = "infer::smoothness",
        format!("rows are answered as they come, so the change of `{signal}` must be given"),
        help format!(
            "write it, `find = {{ {signal} = {{ change = \"50 W\", within = \"1 min\" }} }}`: without \
             --follow `lptn infer` finds it from a whole record"
        );
    /// Jumps are seen only in the rows after them.
    Jumps { signal: String } = "infer::jumps",
        format!("rows are answered as they come, and a jump of `{signal}` is seen only after it"),
        help "leave `jumps` out: a surprise beyond 5 shows a jump";
    /// The noise of a column must be given.
    Noise { column: String } = "infer::noise",
        format!("rows are answered as they come, so the noise of column `{column}` must be given"),
        help "write the scatter of one value, for example `sigma = \"0.2 K\"`";
    /// The estimates follow the record to a state that no run reaches. Near it this column changes
    /// from one value to the other within a row, which ends at this time in s.
    Unfollowed {
        column: String,
        time: f64,
        values: [f64; 2],
        unit: String,
        error: Box<TransientError>
    } = "infer::unfollowed",
        format!(
            "no run follows column `{column}` from {} to {} {unit}, which it reads at {} s: {error}",
            short(values[0]), short(values[1]), short(*time)
        ),
        help "`outliers = \"drop\"` leaves out readings that are far from their neighbours: empty the \
            cells of others that are wrong",
        class Class::Numbers;
    /// The time histories did not converge in this number of rounds.
    NotSettled { rounds: usize } = "infer::not_settled",
        format!("the estimates have not converged after {rounds} rounds, each linear near the one \
            before"),
        help "begin nearer to the expected values, or give the smoothness by `change` and `within`",
        class Class::Numbers;
    /// The inference was interrupted.
    Interrupted = "infer::interrupted", "the inference was interrupted",
        class Class::Interrupted;
}
}

impl From<RunError> for InferError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Failed(error) => Self::Run(error),
            RunError::Interrupted { .. } => Self::Interrupted,
        }
    }
}
