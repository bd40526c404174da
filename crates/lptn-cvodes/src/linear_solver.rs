//! The SUNLinearSolver and the token SUNMatrix through which CVODES reaches the factorisation.
//!
//! CVODES keeps its own rules for when to set up and how to rescale with a stale gamma; it hands
//! over gamma and whether the Jacobian may be reused. The matrix is a token with nothing but a
//! type: without one CVODES would not accept the function that forms the Newton matrix.

use std::ffi::{c_int, c_void};

use sundials_sys as sys;
use sys::{N_Vector, SUNLinearSolver, SUNMatrix, realtype};

use crate::callback::Shared;
use crate::context::Context;
use crate::vector::{values, values_mut};
use lptn_integrate::{Callback, IntegrateError, OdeSystem};

/// The pair, freed together.
pub(crate) struct SolverHandles {
    solver: SUNLinearSolver,
    matrix: SUNMatrix,
}

impl SolverHandles {
    /// `shared` must outlive the handles.
    pub(crate) fn new<S: OdeSystem>(
        context: &Context,
        shared: *mut Shared<S>,
    ) -> Result<Self, IntegrateError> {
        // SAFETY: the context is alive; a handle that is not null has a table of operations.
        unsafe {
            let solver = sys::SUNLinSolNewEmpty(context.raw());
            let matrix = sys::SUNMatNewEmpty(context.raw());
            let handles = Self { solver, matrix };
            if solver.is_null() || matrix.is_null() {
                return Err(IntegrateError::OutOfMemory { function: "SUNLinSolNewEmpty" });
            }
            (*solver).content = shared.cast();
            let ops = &mut *(*solver).ops;
            ops.gettype = Some(solver_type);
            ops.getid = Some(solver_id);
            ops.setup = Some(factorize::<S>);
            ops.solve = Some(solve::<S>);
            (*(*matrix).ops).getid = Some(matrix_id);
            Ok(handles)
        }
    }

    pub(crate) fn solver(&self) -> SUNLinearSolver {
        self.solver
    }

    pub(crate) fn matrix(&self) -> SUNMatrix {
        self.matrix
    }
}

impl Drop for SolverHandles {
    fn drop(&mut self) {
        // SAFETY: made by the matching functions, freed once, both accept null. The contents belong
        // to the integrator.
        unsafe {
            if !self.solver.is_null() {
                (*self.solver).content = std::ptr::null_mut();
                sys::SUNLinSolFreeEmpty(self.solver);
            }
            if !self.matrix.is_null() {
                sys::SUNMatFreeEmpty(self.matrix);
            }
        }
    }
}

unsafe extern "C" fn solver_type(_: SUNLinearSolver) -> sys::SUNLinearSolver_Type {
    sys::SUNLinearSolver_Type_SUNLINEARSOLVER_DIRECT
}

unsafe extern "C" fn solver_id(_: SUNLinearSolver) -> sys::SUNLinearSolver_ID {
    sys::SUNLinearSolver_ID_SUNLINEARSOLVER_CUSTOM
}

unsafe extern "C" fn matrix_id(_: SUNMatrix) -> sys::SUNMatrix_ID {
    sys::SUNMatrix_ID_SUNMATRIX_CUSTOM
}

/// Forms the Newton matrix, for CVodeSetLinSysFn.
#[allow(clippy::too_many_arguments, reason = "the signature is CVODES'")]
pub(crate) unsafe extern "C" fn form_matrix<S: OdeSystem>(
    t: realtype,
    y: N_Vector,
    _flow: N_Vector,
    _matrix: SUNMatrix,
    jacobian_ok: c_int,
    jacobian_is_current: *mut c_int,
    gamma: realtype,
    data: *mut c_void,
    _work1: N_Vector,
    _work2: N_Vector,
    _work3: N_Vector,
) -> c_int {
    // SAFETY: `data` is the `Shared<S>` given to CVodeSetUserData, to which no reference exists
    // while CVODES runs; `y` is ours, only read; the flag is a place to write to.
    let (shared, y, current) =
        unsafe { (&mut *data.cast::<Shared<S>>(), values(y), &mut *jacobian_is_current) };
    let t = shared.origin + t;
    shared.guard(Callback::Jacobian, t, |shared| {
        let renewed = shared.form_matrix((t, y), gamma, jacobian_ok != 0)?;
        // A constant Jacobian is as good as new: CVODES must not ask for another because Newton is
        // slow.
        *current = c_int::from(renewed || shared.jacobian_is_current);
        Ok(())
    })
}

unsafe extern "C" fn factorize<S: OdeSystem>(solver: SUNLinearSolver, _matrix: SUNMatrix) -> c_int {
    // SAFETY: `content` is the `Shared<S>` given to `SolverHandles::new`, to which no reference
    // exists now.
    let shared = unsafe { &mut *(*solver).content.cast::<Shared<S>>() };
    let time = shared.time;
    shared.guard(Callback::LinearSolver, time, Shared::factorize)
}

unsafe extern "C" fn solve<S: OdeSystem>(
    solver: SUNLinearSolver,
    _matrix: SUNMatrix,
    x: N_Vector,
    b: N_Vector,
    _tolerance: realtype,
) -> c_int {
    // SAFETY: `content` as in `factorize`.
    let shared = unsafe { &mut *(*solver).content.cast::<Shared<S>>() };
    let time = shared.time;
    // SAFETY: two different vectors of ours: CVODES solves from its residual into a vector of its
    // linear solver.
    let (b, x) = unsafe { (values(b), values_mut(x)) };
    shared.guard(Callback::LinearSolver, time, |shared| shared.solve(b, x))
}
