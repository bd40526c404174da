//! Errors, with numbers that show where they occurred.

use std::fmt;

/// A callback of [`crate::OdeSystem`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Callback {
    /// [`crate::OdeSystem::flow`]
    Flow,
    /// [`crate::OdeSystem::jacobian`]
    Jacobian,
    /// [`crate::OdeSystem::quadrature`]
    Quadrature,
    /// [`crate::OdeSystem::roots`]
    Roots,
    /// [`crate::OdeSystem::sensitivity_flow`]
    Sensitivity,
    /// The factorisation or the solve of the Newton system, which are not the user's code.
    LinearSolver,
}

/// A matrix could not be factorised or solved with. Indices are rows of the matrix as given; those
/// of algebraic unknowns follow those of the states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FactorError {
    /// Elimination found a pivot that is not positive.
    NotPositiveDefinite {
        /// Row of the pivot.
        index: usize,
    },
    /// No usable pivot, or a solution that is not finite.
    Singular {
        /// Row of the pivot, or of the first component that is not finite, or of the largest one.
        index: usize,
    },
    /// Cholesky was asked for a system whose matrix is not symmetric.
    NotSymmetric,
    /// `solve_in_place` was called before a successful `factorize`.
    NotFactorized,
    /// A slice has the wrong length.
    WrongLength {
        /// Length that fits the pattern.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// Not enough memory, or the factors have more entries than an index can count.
    OutOfMemory,
}

/// Why an integration could not start or go on. Times are in units of t.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrateError {
    /// A slice or a pattern does not fit the size of the system.
    WrongLength {
        /// Name of the slice or pattern.
        what: &'static str,
        /// Length that fits.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// An option, a start time or a stop time is outside its range.
    InvalidOption {
        /// Name of the field or argument.
        option: &'static str,
        /// Its value.
        value: f64,
    },
    /// A component of a start state, or of start sensitivities, is not finite.
    InvalidState {
        /// The component.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An entry of `M` is not positive and finite.
    InvalidMass {
        /// The component.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The entry of `M` of an algebraic row is not 0.
    AlgebraicMass {
        /// Row of the pattern.
        row: usize,
        /// Its value.
        value: f64,
    },
    /// The stop time lies before the present time.
    StopBehind {
        /// Present time.
        time: f64,
        /// Stop time.
        stop: f64,
    },
    /// A time outside the last step was asked for.
    OutsideLastStep {
        /// Time asked for.
        time: f64,
        /// Start of the last step.
        from: f64,
        /// End of the last step.
        to: f64,
    },
    /// The number of steps allowed by [`crate::Options::max_steps`] is used up.
    TooManySteps {
        /// Time reached.
        time: f64,
        /// Steps taken.
        steps: u64,
    },
    /// The tolerance is below the rounding of a state of this size.
    ToleranceTooSmall {
        /// Time reached.
        time: f64,
        /// Component with the largest value.
        index: usize,
    },
    /// The estimated error stays too large however small the step.
    ErrorTest {
        /// Time reached.
        time: f64,
        /// Size of the last step tried.
        step: f64,
        /// Component with the largest estimated error.
        index: usize,
    },
    /// Steps have become so small that the time no longer moves, as at a jump or a singularity of
    /// `f`.
    Stalled {
        /// Time reached.
        time: f64,
        /// Size of the last step.
        step: f64,
        /// Component with the largest estimated error.
        index: usize,
    },
    /// Newton's method does not converge however small the step.
    Newton {
        /// Time reached.
        time: f64,
        /// Size of the last step tried.
        step: f64,
        /// Component with the largest estimated error.
        index: usize,
    },
    /// The Newton matrix cannot be factorised however small the step.
    Linear {
        /// Time of the attempt.
        time: f64,
        /// Reason.
        cause: FactorError,
    },
    /// A callback wrote a value that is not finite, however small the step.
    NotFinite {
        /// The callback.
        callback: Callback,
        /// Time of the call.
        time: f64,
        /// First component that is not finite (for the Jacobian: slot; for sensitivities: in all
        /// blocks together).
        index: usize,
    },
    /// A callback asked for smaller steps until none was left.
    Refused {
        /// The callback.
        callback: Callback,
        /// Time of the last call.
        time: f64,
    },
    /// A callback returned [`crate::Retry::Stop`], or [`crate::OdeSystem::roots`] failed, for which
    /// there is no smaller step to try.
    Stopped {
        /// The callback.
        callback: Callback,
        /// Time of the call.
        time: f64,
    },
    /// A callback panicked.
    Panic {
        /// The callback.
        callback: Callback,
        /// Time of the call.
        time: f64,
        /// Text of the panic.
        message: String,
    },
    /// SUNDIALS or the linear solver could not allocate.
    OutOfMemory {
        /// Function that failed.
        function: &'static str,
    },
    /// SUNDIALS returned a flag that correct use excludes: a mistake in this crate.
    Sundials {
        /// Function that failed.
        function: &'static str,
        /// Its flag.
        flag: i32,
        /// Name of the flag.
        name: &'static str,
        /// Last message of SUNDIALS.
        message: String,
        /// Time reached.
        time: f64,
    },
}

impl fmt::Display for Callback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Flow => "flow",
            Self::Jacobian => "jacobian",
            Self::Quadrature => "quadrature",
            Self::Roots => "roots",
            Self::Sensitivity => "sensitivity",
            Self::LinearSolver => "linear solver",
        })
    }
}

impl fmt::Display for FactorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositiveDefinite { index } => {
                write!(f, "matrix is not positive definite at row {index}")
            }
            Self::Singular { index } => write!(f, "matrix is singular at row {index}"),
            Self::NotSymmetric => f.write_str("Cholesky needs a symmetric matrix"),
            Self::NotFactorized => f.write_str("no factors to solve with"),
            Self::WrongLength { expected, found } => {
                write!(f, "{found} values instead of {expected}")
            }
            Self::OutOfMemory => f.write_str("out of memory"),
        }
    }
}

/// A number in a message: with an exponent if it would be long.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(x) = self;
        if *x == 0.0 || (1e-3..1e6).contains(&x.abs()) {
            write!(f, "{x}")
        } else {
            write!(f, "{x:e}")
        }
    }
}

impl fmt::Display for IntegrateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongLength { what, expected, found } => {
                write!(f, "{what} has length {found} instead of {expected}")
            }
            Self::InvalidOption { option, value } => {
                write!(f, "{option} = {} is out of range", Short(*value))
            }
            Self::InvalidState { index, value } => {
                write!(f, "component {index} of the state starts at {}", Short(*value))
            }
            Self::InvalidMass { index, value } => {
                write!(f, "mass {} of component {index} is not positive", Short(*value))
            }
            Self::AlgebraicMass { row, value } => {
                write!(f, "mass {} of algebraic row {row} is not 0", Short(*value))
            }
            Self::StopBehind { time, stop } => {
                write!(
                    f,
                    "stop time {} lies before the present time {}",
                    Short(*stop),
                    Short(*time)
                )
            }
            Self::OutsideLastStep { time, from, to } => {
                write!(
                    f,
                    "time {} is outside the last step, {} to {}",
                    Short(*time),
                    Short(*from),
                    Short(*to)
                )
            }
            Self::OutOfMemory { function } => write!(f, "out of memory in {function}"),
            Self::Sundials { function, flag, name, message, time } => {
                write!(f, "{function} returned {flag} ({name}) at time {}: {message}", Short(*time))
            }
            failure => failure.write_failure(f),
        }
    }
}

impl IntegrateError {
    /// The component of the state that caused the failure, if one is known to be worst.
    #[must_use]
    pub fn component(&self) -> Option<usize> {
        match self {
            Self::InvalidState { index, .. }
            | Self::InvalidMass { index, .. }
            | Self::ToleranceTooSmall { index, .. }
            | Self::ErrorTest { index, .. }
            | Self::Newton { index, .. }
            | Self::Stalled { index, .. }
            | Self::NotFinite { callback: Callback::Flow, index, .. } => Some(*index),
            _ => None,
        }
    }

    /// The second half of `Display`: errors of a step.
    fn write_failure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManySteps { time, steps } => {
                write!(f, "{steps} steps taken, time {} reached", Short(*time))
            }
            Self::ToleranceTooSmall { time, index } => {
                write!(
                    f,
                    "tolerance is below the rounding error of component {index} at time {}",
                    Short(*time)
                )
            }
            Self::ErrorTest { time, step, index } => {
                write!(
                    f,
                    "error of component {index} stays too large at time {} with step {}",
                    Short(*time),
                    Short(*step)
                )
            }
            Self::Stalled { time, step, index } => {
                write!(
                    f,
                    "no progress at time {} with step {}, worst component {index}",
                    Short(*time),
                    Short(*step)
                )
            }
            Self::Newton { time, step, index } => {
                write!(
                    f,
                    "no convergence at time {} with step {}, worst component {index}",
                    Short(*time),
                    Short(*step)
                )
            }
            Self::Linear { time, cause } => write!(f, "{cause}, at time {}", Short(*time)),
            Self::NotFinite { callback, time, index } => {
                write!(f, "{callback} is not finite at time {}, component {index}", Short(*time))
            }
            Self::Refused { callback, time } => {
                write!(f, "{callback} asks for smaller and smaller steps at time {}", Short(*time))
            }
            Self::Stopped { callback, time } => {
                write!(f, "{callback} stopped the integration at time {}", Short(*time))
            }
            Self::Panic { callback, time, message } => {
                write!(f, "{callback} panicked at time {}: {message}", Short(*time))
            }
            _ => Ok(()),
        }
    }
}

impl std::error::Error for FactorError {}
impl std::error::Error for IntegrateError {}
