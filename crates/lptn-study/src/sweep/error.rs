//! Why nothing is swept.

use lptn_network::Changing;
use lptn_solve::PeriodicError;

lptn_units::errors! {
/// Why nothing is swept. A candidate that fails is an answer and not an error.
#[derive(Debug)]
pub enum SweepError {
    /// A report of a steady state depends on inputs that change with time. At least one.
    Changing(inputs: Vec<Changing>) = "sweep::inputs_change",
        "the reports depend on inputs that change with time, but a steady state is one moment of \
         them",
        help "write `over = \"run\"` or `over = \"periodic\"`, with a functional such as `max(..)` \
              in every report";
    /// The length of the cycle is not known.
    NoPeriod = "sweep::no_period",
        "no signal is repeated, so the length of the cycle is not known",
        help "give the time after which all inputs repeat: `period = \"10 min\"`";
    /// There is no cycle at the netlist's own values.
    Periodic => PeriodicError;
}
}
