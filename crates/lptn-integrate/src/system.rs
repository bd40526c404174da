//! Interface of a system of differential equations for the integrator.

use crate::Pattern;

/// A callback could not do its work. The system keeps the reason itself; the integrator hands the
/// system back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Retry {
    /// The system cannot evaluate the state; a smaller step may avoid it.
    SmallerStep,
    /// No smaller step can help: the integration ends.
    Stop,
}

/// `M y' = f(t, y)` with a diagonal, positive `M`; `f` may go through unknowns `z` that balances
/// `0 = g(t, y, z)` determine.
///
/// All slices have the length [`size`](Self::size) unless stated otherwise. `M` has the units of
/// `f` times time per unit of `y`. A callback that panics or that writes a value that is not finite
/// does no harm: the step is given up and the integrator returns an error with the time and, if
/// there is one, the index.
///
/// # Algebraic unknowns
///
/// A system with `m` unknowns in addition to its `n` states solves `0 = g(t, y, z)` itself, inside
/// [`flow`](Self::flow) and [`quadrature`](Self::quadrature) and more accurately than the
/// tolerance; the integrator sees `f(t, y, z(t, y))` only. [`pattern`](Self::pattern) then has
/// `n + m` rows, those of `z` after those of `y`, [`jacobian`](Self::jacobian) writes the
/// derivatives of `[f, g]` by `[y, z]`, and [`mass`](Self::mass) ends in `m` zeros. The integrator
/// factorises this larger and sparser matrix instead of the derivative of `f(t, y, z(t, y))`, in
/// which every unknown would link all of its neighbours. `dg/dz` must be regular.
///
/// # States carried as another variable
///
/// If `f` depends on a temperature `T_j(y_j)` instead of on `y_j` itself,
/// [`jacobian`](Self::jacobian) may be written by `T` and [`slope`](Self::slope) returns
/// `dT_j/dy_j`. The matrix stays symmetric if the derivatives by `T` are. The tolerance is then one
/// of `T_j` if `dT_j/dy_j` is above 1, and one of `y_j` otherwise.
pub trait OdeSystem {
    /// Number of components of `y`; at least 1 and constant.
    fn size(&self) -> usize;

    /// Diagonal of `M`, as long as the pattern: every entry positive and finite, those of the
    /// algebraic rows 0; as of the last call of `flow` or `jacobian` (so that it may depend on the
    /// state).
    fn mass(&self) -> &[f64];

    /// Writes `f(t, y)`, in units of `M` times `y` per time. Positive raises `y`.
    ///
    /// # Errors
    /// [`Retry`]: a smaller step may help or not.
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry>;

    /// Possible nonzeros of the matrix of [`jacobian`](Self::jacobian): [`size`](Self::size) rows
    /// for the states, then one for every algebraic unknown; constant over the life of the system.
    fn pattern(&self) -> &Pattern;

    /// True if the *values* written by [`jacobian`](Self::jacobian) are symmetric. They are then
    /// factorised as `M - gamma J` by Cholesky, which must be positive definite for the step sizes
    /// of interest; otherwise by LU. Read once, by the integrator when it is made.
    fn symmetric(&self) -> bool;

    /// The integrator gives the symmetric values up: from now on they are factorised by LU, and
    /// [`jacobian`](Self::jacobian) should write the exact ones. Called at most once, and only
    /// if [`symmetric`](Self::symmetric) was true and
    /// [`jacobian_is_constant`](Self::jacobian_is_constant) false; see [`crate::Integrator::step`].
    fn leave_symmetry(&mut self) {}

    /// `dT/dy` of every row of the pattern (1 for algebraic rows), not negative and finite, for a
    /// [`jacobian`](Self::jacobian) written by `T` instead of `y`, as of the last call of it; 0
    /// if `T` is constant while `y` changes. `None`: by `y`. The choice of the two is constant.
    fn slope(&self) -> Option<&[f64]> {
        None
    }

    /// Writes `df/dy` (with algebraic unknowns the derivatives of `[f, g]` by `[y, z]`; with a
    /// [`slope`](Self::slope) those by `T`) into the slots of [`pattern`](Self::pattern)
    /// (`values.len() == pattern().len()`), with the result of the previous call in `values`
    /// on entry. An approximation is allowed: it changes how fast Newton's method converges, not
    /// its solution.
    ///
    /// # Errors
    /// [`Retry`]: a smaller step may help or not.
    fn jacobian(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry>;

    /// True if one call of [`jacobian`](Self::jacobian) serves until the next
    /// [`crate::Integrator::restart`].
    fn jacobian_is_constant(&self) -> bool {
        false
    }

    /// Number of running integrals in addition to the state; constant.
    fn quadrature_count(&self) -> usize {
        0
    }

    /// Writes the integrands of the running integrals, `q.len() == quadrature_count()`.
    ///
    /// # Errors
    /// [`Retry`]: a smaller step may help or not.
    fn quadrature(&mut self, _t: f64, _y: &[f64], _q: &mut [f64]) -> Result<(), Retry> {
        Ok(())
    }

    /// Number of parameters by which the derivatives of the state are carried along; constant.
    fn sensitivity_count(&self) -> usize {
        0
    }

    /// Writes the right sides of the sensitivity equations `M s_i' = g_i` with `s_i = dy/dp_i`, for
    /// all parameters at once: `s` and `g` have [`sensitivity_count`](Self::sensitivity_count)
    /// blocks of [`size`](Self::size) values, one after the other, in units of y and of f per unit
    /// of `p_i`.
    ///
    /// Differentiating `M y' = f` by `p_i` gives
    ///
    /// ```text
    /// g_i = df/dy s_i + df/dp_i - (dM/dp_i + dM/dy s_i) y'
    /// ```
    ///
    /// where `y'` is `f / M` and the last term is the system's to add, if its mass depends on a
    /// parameter or on the state. Derivatives here must be exact, unlike those of
    /// [`jacobian`](Self::jacobian); with algebraic unknowns they are those of
    /// `f(t, y, z(t, y, p), p)`. The last [`flow`](Self::flow) before a call was at the same `t`
    /// and `y`, so that its results may be used; other callbacks may come between.
    ///
    /// Source: A. C. Hindmarsh and R. Serban, *User Documentation for CVODES*, section 2.6 (forward
    /// sensitivity analysis).
    ///
    /// # Errors
    /// [`Retry`]: a smaller step may help or not.
    fn sensitivity_flow(
        &mut self,
        _t: f64,
        _y: &[f64],
        _s: &[f64],
        _g: &mut [f64],
    ) -> Result<(), Retry> {
        Ok(())
    }

    /// Number of functions whose roots end a step; constant.
    fn root_count(&self) -> usize {
        0
    }

    /// Writes functions of time and state, `g.len() == root_count()`; finite, of any unit. A step
    /// ends when one of them changes its sign or becomes exactly zero: see [`crate::Step::roots`].
    ///
    /// Only a change over a whole step is detected: two crossings inside one step are not. A
    /// function that becomes zero and stays there has its root at the end of the step only. One
    /// that is exactly zero at a start is left out until it is not. Roots are those of the
    /// polynomial through the step, so that their time errs by about the tolerance over the slope
    /// of `y`. The functions may become others, if a [`crate::Integrator::restart`] or
    /// [`crate::Integrator::rewind`] follows.
    ///
    /// # Errors
    /// Either value ends the step with an error: the state was accepted already.
    fn roots(&mut self, _t: f64, _y: &[f64], _g: &mut [f64]) -> Result<(), Retry> {
        Ok(())
    }
}
