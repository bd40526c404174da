//! What a system of differential equations has to tell the integrator.

use crate::Pattern;

/// A callback could not do its work. The system keeps the reason itself; the integrator hands the system back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Retry {
    /// The state is outside what the system can evaluate; a smaller step may stay inside.
    SmallerStep,
    /// No smaller step can help: the integration ends.
    Stop,
}

/// `M y' = f(t, y)` with a diagonal, positive `M`.
///
/// All slices have the length [`size`](Self::size) unless stated otherwise. `M` has the units of `f` times time per
/// unit of `y`. A callback that panics or that writes a value that is not finite does no harm: the step is given up
/// and the integrator returns an error with the time and, where there is one, the index.
pub trait OdeSystem {
    /// Number of components of `y`; at least 1 and constant.
    fn size(&self) -> usize;

    /// Diagonal of `M`, every entry positive and finite, as of the last call of `flow` or `jacobian` (so that it may
    /// depend on the state).
    fn mass(&self) -> &[f64];

    /// Writes `f(t, y)`, in units of `M` times `y` per time. Positive raises `y`.
    ///
    /// # Errors
    /// Whether a smaller step may help.
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry>;

    /// Where `df/dy` can be nonzero; constant over the life of the system.
    fn pattern(&self) -> &Pattern;

    /// Whether the *values* written by [`jacobian`](Self::jacobian) are symmetric. They then are factorised as
    /// `M - gamma J` by Cholesky, which must be positive definite for the step sizes of interest; otherwise by LU.
    fn symmetric(&self) -> bool;

    /// Writes `df/dy` into the slots of [`pattern`](Self::pattern) (`values.len() == pattern().len()`), with `values`
    /// holding the result of the previous call on entry. An approximation is allowed: it changes how fast Newton's
    /// method converges, not what it converges to.
    ///
    /// # Errors
    /// Whether a smaller step may help.
    fn jacobian(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry>;

    /// Whether one call of [`jacobian`](Self::jacobian) serves until the next [`crate::Integrator::restart`].
    fn jacobian_is_constant(&self) -> bool {
        false
    }

    /// Number of running integrals kept beside the state; constant.
    fn quadrature_count(&self) -> usize {
        0
    }

    /// Writes the integrands of the running integrals, `q.len() == quadrature_count()`.
    ///
    /// # Errors
    /// Whether a smaller step may help.
    fn quadrature(&mut self, _t: f64, _y: &[f64], _q: &mut [f64]) -> Result<(), Retry> {
        Ok(())
    }
}
