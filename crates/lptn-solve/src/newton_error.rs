//! Reasons why the balances of some unknowns have no solution, unknowns by their number.

use lptn_integrate::FactorError;
use lptn_network::InputError;

/// Reason why balances could not be solved.
#[derive(Clone, Debug)]
pub(crate) enum NewtonError {
    /// A value of an element fails.
    Input(InputError),
    /// Nothing determines the temperature of an unknown.
    Singular {
        /// The unknown.
        unknown: usize,
    },
    /// No memory, or another failure of the factorisation.
    Factorization(FactorError),
    /// The balances are solved, but the least disturbance leads away from there.
    Unstable {
        /// The unknown that moves most.
        unknown: usize,
        /// True if it oscillates from one side to the other.
        swings: bool,
    },
    /// The solution that was followed ends here: beyond, the balances have another one, elsewhere.
    Fold {
        /// The unknown that cannot go on.
        unknown: usize,
    },
    /// A step asks for fluid that had not entered its pipe when the step began.
    NotEntered {
        /// The unknown of the pipe.
        unknown: usize,
    },
    /// No solution was found.
    Stalled {
        /// The unknown that still moved most.
        unknown: usize,
        /// Its change in K.
        change: f64,
    },
}
