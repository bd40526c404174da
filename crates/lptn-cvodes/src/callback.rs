//! Callbacks from CVODES into the system, which let no panic and no NaN through.

use std::any::Any;
use std::ffi::{c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

use sundials_sys as sys;
use sys::{N_Vector, realtype};

use crate::vector::{values, values_mut};
use crate::vectors;
use lptn_integrate::linear::Factorization;
use lptn_integrate::{Callback, FactorError, IntegrateError, OdeSystem, Retry, kernels};

/// Return values for CVODES: done, try a smaller step, give up.
pub(crate) const DONE: c_int = 0;
const SMALLER_STEP: c_int = 1;
const GIVE_UP: c_int = -1;

/// Smallest slope: a state whose `T` is constant must not cause a division by zero. It is far below
/// all that matters next to another term, and large enough not to overflow.
const FLAT: f64 = 1e-30;

/// The share of a residual that may remain if the Jacobian changes. A Newton matrix of an earlier
/// step, or a symmetric one, leaves more. The last correction that CVODES takes is at most a tenth
/// of the tolerance, so the energy balance is off by at most 1e-5 of the tolerance.
const SHARE: f64 = 1e-4;

/// Data of the callbacks. Reached through one raw pointer only, see the crate documentation.
pub(crate) struct Shared<S> {
    pub(crate) system: S,
    /// Origin of CVODES' time.
    pub(crate) origin: f64,
    /// The matrix of [`OdeSystem::jacobian`] in the slots of the pattern.
    pub(crate) jacobian: Vec<f64>,
    /// True if `jacobian` is constant and need not be read again.
    pub(crate) jacobian_is_current: bool,
    /// The Newton matrix in the slots of the pattern.
    pub(crate) matrix: Vec<f64>,
    /// [`OdeSystem::slope`] that belongs to `jacobian`, no smaller than [`FLAT`]; empty if there is
    /// none.
    pub(crate) slopes: Vec<f64>,
    /// States and algebraic unknowns during a solve; empty if there are none of the latter.
    pub(crate) work: Vec<f64>,
    /// Input of [`OdeSystem::sensitivity_flow`], block after block; its output is in
    /// `sensitivity_flows`. Both are empty if there are no sensitivities.
    pub(crate) sensitivities: Vec<f64>,
    pub(crate) sensitivity_flows: Vec<f64>,
    pub(crate) factors: Box<dyn Factorization>,
    /// [`OdeSystem::root_count`] as it was at the start.
    pub(crate) root_count: usize,
    /// The absolute tolerance that CVODE works with.
    pub(crate) absolute: f64,
    pub(crate) counts: Counts,
    /// Time of the last Newton matrix, for messages of the linear solver.
    pub(crate) time: f64,
    /// The last failure of a callback that has not succeeded since.
    pub(crate) failure: Option<Failure>,
    /// The last failure of a callback since the time last moved, overcome or not.
    pub(crate) overcome: Option<Failure>,
}

/// Counts that CVODES does not keep, or forgets at a restart.
#[derive(Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) flow: u64,
    pub(crate) jacobian: u64,
    pub(crate) quadrature: u64,
    pub(crate) sensitivity: u64,
    pub(crate) setups: u64,
    pub(crate) factorizations: u64,
    pub(crate) solves: u64,
    /// Iterations of linear solvers that were given up.
    pub(crate) iterations: u64,
}

/// A callback that failed.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    callback: Callback,
    pub(crate) time: f64,
    cause: Cause,
}

/// Reason of the failure.
#[derive(Clone, Debug)]
pub(crate) enum Cause {
    Panic(String),
    NotFinite(usize),
    Retry(Retry),
    Linear(FactorError),
}

impl Failure {
    pub(crate) fn into_error(self) -> IntegrateError {
        let Self { callback, time, cause } = self;
        match cause {
            Cause::Panic(message) => IntegrateError::Panic { callback, time, message },
            Cause::NotFinite(index) => IntegrateError::NotFinite { callback, time, index },
            // The state was accepted before the search for roots: there is no smaller step to try.
            Cause::Retry(Retry::SmallerStep) if callback != Callback::Roots => {
                IntegrateError::Refused { callback, time }
            }
            Cause::Retry(_) => IntegrateError::Stopped { callback, time },
            Cause::Linear(cause) => IntegrateError::Linear { time, cause },
        }
    }

    fn code(&self) -> c_int {
        match self.cause {
            Cause::Panic(_) | Cause::Retry(Retry::Stop) => GIVE_UP,
            // A smaller gamma makes the matrix positive definite, and a smaller step may avoid an
            // overflow of the flow.
            Cause::NotFinite(_) | Cause::Retry(Retry::SmallerStep) | Cause::Linear(_) => {
                SMALLER_STEP
            }
        }
    }
}

impl From<Retry> for Cause {
    fn from(retry: Retry) -> Self {
        Self::Retry(retry)
    }
}

impl<S: OdeSystem> Shared<S> {
    /// Runs one callback and turns its outcome into a flag for CVODES, keeping the reason.
    pub(crate) fn guard(
        &mut self,
        callback: Callback,
        time: f64,
        work: impl FnOnce(&mut Self) -> Result<(), Cause>,
    ) -> c_int {
        // A panic may leave the system half changed, but no callback enters it again. Arrays are
        // written before they are read.
        let outcome = catch_unwind(AssertUnwindSafe(|| work(self)));
        let cause = match outcome {
            Ok(Ok(())) => {
                self.overcome = self
                    .failure
                    .take_if(|failure| failure.callback == callback)
                    .or(self.overcome.take());
                return DONE;
            }
            Ok(Err(cause)) => cause,
            Err(payload) => Cause::Panic(text_of(payload.as_ref())),
        };
        let failure = Failure { callback, time, cause };
        let code = failure.code();
        self.failure = Some(failure);
        code
    }

    fn derivative(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Cause> {
        self.counts.flow += 1;
        self.system.flow(t, y, out)?;
        kernels::zip_in_place(out, self.system.mass(), |flow, mass| flow / mass);
        expect_finite(out)
    }

    /// The weights of the error test. The tolerance is one of `T` if a state is carried as another
    /// variable. If `T` moves less than the state, it is one of the state, which must not get lost
    /// either.
    fn weights(&self, out: &mut [f64]) {
        out.fill(1.0 / self.absolute);
        if let Some(slopes) = self.system.slope() {
            kernels::zip_in_place(out, slopes, |weight, slope| {
                weight * if slope > 1.0 { slope } else { 1.0 }
            });
        }
    }

    fn integrands(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Cause> {
        self.counts.quadrature += 1;
        self.system.quadrature(t, y, out)?;
        expect_finite(out)
    }

    /// From `sensitivities` to `sensitivity_flows`, divided by the mass.
    fn sensitivity_flow(&mut self, t: f64, y: &[f64]) -> Result<(), Cause> {
        self.counts.sensitivity += 1;
        self.system.sensitivity_flow(t, y, &self.sensitivities, &mut self.sensitivity_flows)?;
        let mass = self.system.mass();
        for block in self.sensitivity_flows.chunks_exact_mut(y.len()) {
            kernels::zip_in_place(block, mass, |flow, mass| flow / mass);
        }
        expect_finite(&self.sensitivity_flows)
    }

    pub(crate) fn roots(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Cause> {
        self.system.roots(t, y, out)?;
        expect_finite(out)
    }

    /// Forms the Newton matrix; returns true if the Jacobian was read again.
    ///
    /// CVODE asks for the solution `x` of `(M - gamma J) x = r` with `r = M b`, where `J` is the
    /// derivative of `f(t, y, z(t, y))`. With `0 = g(t, y, z)` and subscripts for derivatives, a
    /// change `x` of the states changes the unknowns by `w` with `g_y x + g_z w = 0`, so that
    /// `J x = f_y x + f_z w`. Both together, the second line times `-gamma`:
    ///
    /// ```text
    /// M x - gamma (f_y x + f_z w) = r
    ///     - gamma (g_y x + g_z w) = 0
    /// ```
    ///
    /// This is `(diag(M, 0) - gamma K) [x, w] = [r, 0]` with `K` the derivatives of `[f, g]` by
    /// `[y, z]`: eliminating `w` gives back `M - gamma J` exactly. The matrix is symmetric if `K`
    /// is, and positive definite if `-K` is.
    ///
    /// If `K` is written by `T(y)` with the slopes `S = diag(dT/dy)`, the Jacobian is `K S`. With
    /// `u = S x` the equation `(M - gamma K S) x = r` becomes `(M / S - gamma K) u = r`, symmetric
    /// again, and `x = u / S`.
    pub(crate) fn form_matrix(
        &mut self,
        (t, y): (f64, &[f64]),
        gamma: f64,
        reuse: bool,
    ) -> Result<bool, Cause> {
        self.counts.setups += 1;
        self.time = t;
        let renew = !(reuse || self.jacobian_is_current);
        if renew {
            self.counts.jacobian += 1;
            self.system.jacobian(t, y, &mut self.jacobian)?;
            expect_finite(&self.jacobian)?;
            self.keep_slopes()?;
            self.jacobian_is_current = self.system.jacobian_is_constant();
        }
        kernels::map(&self.jacobian, &mut self.matrix, |slope| -gamma * slope);
        let diagonal = self.system.pattern().diagonal().iter().zip(self.system.mass());
        if self.slopes.is_empty() {
            diagonal.for_each(|(&slot, mass)| self.matrix[slot] += mass);
        } else {
            diagonal
                .zip(&self.slopes)
                .for_each(|((&slot, mass), slope)| self.matrix[slot] += mass / slope);
        }
        Ok(renew)
    }

    /// The slopes must be those of the Jacobian that is kept, not of a later one.
    fn keep_slopes(&mut self) -> Result<(), Cause> {
        if let Some(slope) = self.system.slope() {
            expect_finite(slope)?;
            self.slopes.clear();
            self.slopes.extend(slope.iter().map(|&slope| slope.max(FLAT)));
        }
        Ok(())
    }

    /// Goes on with these factors, which must be for any values, and with the exact Jacobian.
    pub(crate) fn leave_symmetry(&mut self, factors: Box<dyn Factorization>) {
        self.counts.iterations += self.factors.iterations();
        self.factors = factors;
        self.jacobian_is_current = false;
        (self.failure, self.overcome) = (None, None);
        self.system.leave_symmetry();
    }

    pub(crate) fn factorize(&mut self) -> Result<(), Cause> {
        self.counts.factorizations += 1;
        self.factors.factorize(&self.matrix).map_err(Cause::Linear)
    }

    /// Solves `(M - gamma J) x = M b`, see [`form_matrix`](Self::form_matrix).
    pub(crate) fn solve(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), Cause> {
        self.counts.solves += 1;
        kernels::zip(b, self.system.mass(), x, |b, mass| b * mass);
        if self.work.is_empty() {
            self.correct(x)?;
        } else {
            let (states, algebraic) = self.work.split_at_mut(x.len());
            states.copy_from_slice(x);
            algebraic.fill(0.0);
            let mut work = std::mem::take(&mut self.work);
            let corrected = self.correct(&mut work);
            self.work = work;
            corrected?;
            x.copy_from_slice(&self.work[..x.len()]);
        }
        // Nothing happens if there are no slopes.
        kernels::zip_in_place(x, &self.slopes, |u, slope| u / slope);
        Ok(())
    }
}

impl<S> Shared<S> {
    /// Solves with the Newton matrix: to the last digits if it is constant, so that one iteration
    /// is enough.
    fn correct(&mut self, b: &mut [f64]) -> Result<(), Cause> {
        let solved = match self.jacobian_is_current {
            true => self.factors.solve_in_place(b),
            false => self.factors.solve_share(b, SHARE),
        };
        solved.map_err(Cause::Linear)
    }
}

fn expect_finite(x: &[f64]) -> Result<(), Cause> {
    kernels::first_not_finite(x).map_or(Ok(()), |index| Err(Cause::NotFinite(index)))
}

fn text_of(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let owned = || payload.downcast_ref::<String>().cloned();
    text.map(str::to_owned).or_else(owned).unwrap_or_else(|| "panic without a text".to_owned())
}

/// `y' = f(t, y) / M`, for CVodeInit.
pub(crate) unsafe extern "C" fn derivative<S: OdeSystem>(
    t: realtype,
    y: N_Vector,
    out: N_Vector,
    data: *mut c_void,
) -> c_int {
    // SAFETY: `data` is the `Shared<S>` given to CVodeSetUserData, to which no reference exists
    // while CVODES runs; the vectors are ours and different, one to be read, one to be written.
    let (shared, y, out) = unsafe { (&mut *data.cast::<Shared<S>>(), values(y), values_mut(out)) };
    let t = shared.origin + t;
    shared.guard(Callback::Flow, t, |shared| shared.derivative(t, y, out))
}

/// The integrands, for CVodeQuadInit.
pub(crate) unsafe extern "C" fn integrands<S: OdeSystem>(
    t: realtype,
    y: N_Vector,
    out: N_Vector,
    data: *mut c_void,
) -> c_int {
    // SAFETY: as in `derivative`.
    let (shared, y, out) = unsafe { (&mut *data.cast::<Shared<S>>(), values(y), values_mut(out)) };
    let t = shared.origin + t;
    shared.guard(Callback::Quadrature, t, |shared| shared.integrands(t, y, out))
}

/// The derivatives of the sensitivities by time, for CVodeSensInit.
#[allow(clippy::too_many_arguments, reason = "the signature is CVODES'")]
pub(crate) unsafe extern "C" fn sensitivities<S: OdeSystem>(
    count: c_int,
    t: realtype,
    y: N_Vector,
    _flow: N_Vector,
    s: *mut N_Vector,
    out: *mut N_Vector,
    data: *mut c_void,
    _work1: N_Vector,
    _work2: N_Vector,
) -> c_int {
    let count = usize::try_from(count).unwrap_or(0);
    // SAFETY: as in `derivative`; `s` and `out` are arrays of CVODES with `count` of our vectors
    // each.
    let (shared, y, s, out) = unsafe {
        let shared = &mut *data.cast::<Shared<S>>();
        (shared, values(y), slice::from_raw_parts(s, count), slice::from_raw_parts(out, count))
    };
    // SAFETY: no one writes to the vectors of `s` during the call.
    unsafe { vectors::gather(s, &mut shared.sensitivities) };
    let t = shared.origin + t;
    let flag = shared.guard(Callback::Sensitivity, t, |shared| shared.sensitivity_flow(t, y));
    if flag == DONE {
        // SAFETY: no one else uses the vectors of `out` now; none of them is `y`.
        unsafe { vectors::scatter(&shared.sensitivity_flows, out) };
    }
    flag
}

/// The functions whose roots are searched for, for CVodeRootInit.
pub(crate) unsafe extern "C" fn roots<S: OdeSystem>(
    t: realtype,
    y: N_Vector,
    out: *mut realtype,
    data: *mut c_void,
) -> c_int {
    // SAFETY: as in `derivative`; `out` is an array of CVODES with one value per function, not
    // initialised.
    let (shared, y, out) = unsafe {
        let shared = &mut *data.cast::<Shared<S>>();
        out.write_bytes(0, shared.root_count);
        let out = slice::from_raw_parts_mut(out, shared.root_count);
        (shared, values(y), out)
    };
    let t = shared.origin + t;
    shared.guard(Callback::Roots, t, |shared| shared.roots(t, y, out))
}

/// The weights of the error test, for CVodeWFtolerances.
pub(crate) unsafe extern "C" fn weights<S: OdeSystem>(
    _y: N_Vector,
    out: N_Vector,
    data: *mut c_void,
) -> c_int {
    // SAFETY: as in `derivative`.
    let (shared, out) = unsafe { (&mut *data.cast::<Shared<S>>(), values_mut(out)) };
    let time = shared.time;
    shared.guard(Callback::Flow, time, |shared| {
        shared.weights(out);
        expect_finite(out)
    })
}
