//! The CVODES object: calls with their flags turned into errors.

use std::ffi::{c_int, c_long, c_void};

use sundials_sys as sys;

use crate::context::Context;
use crate::{callback, linear_solver};
use crate::{callback::Shared, linear_solver::SolverHandles, vector::Vector, vectors::Vectors};
use lptn_integrate::{Allowance, IntegrateError, OdeSystem};

/// An owned CVODES object. Its methods take the data that must be alive for the call; the owner
/// keeps it alive until the object is dropped.
pub(crate) struct Memory {
    raw: *mut c_void,
}

/// State and sensitivities are corrected together. The other way, sensitivities after a state that
/// has passed its error test (`CV_STAGGERED`), evaluates the flow once more per step and saves
/// nothing where it matters. Measured with 4 parameters to a tolerance of 1e-5 (steps, flows,
/// solves, CPU):
///
/// | network | together | staggered |
/// |---|---|---|
/// | 2 nodes | 128, 161, 790, 0.8 ms | 125, 274, 758, 0.9 ms |
/// | 100 nodes in a row | 275, 313, 1550, 16 ms | 279, 585, 1546, 15 ms |
/// | 1000 nodes in a row | 365, 408, 2025, 120 ms | 370, 773, 2027, 153 ms |
///
/// Staggered, a flow that fails after the error test also leaves the history in the middle of the
/// step.
const STRATEGY: c_int = sys::CV_SIMULTANEOUS;

/// Stands for an infinite tolerance of the running integrals.
const BOUNDLESS: f64 = 1e300;

/// Flag of a SUNDIALS function that failed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flag {
    pub(crate) function: &'static str,
    pub(crate) value: c_int,
}

/// End of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reached {
    /// At the size that the error test allowed.
    Step,
    /// At the stop time.
    Stop,
    /// At a root, or at several.
    Root,
}

fn check(function: &'static str, value: c_int) -> Result<(), Flag> {
    if value < 0 { Err(Flag { function, value }) } else { Ok(()) }
}

/// Counters of CVODES since its last (re)initialisation.
#[derive(Clone, Copy, Default)]
pub(crate) struct Counters {
    pub(crate) steps: u64,
    pub(crate) error_test_failures: u64,
    pub(crate) newton_iterations: u64,
    pub(crate) newton_failures: u64,
    pub(crate) last_order: u32,
    pub(crate) last_step: f64,
    pub(crate) current_step: f64,
}

impl Memory {
    pub(crate) fn new(context: &Context) -> Result<Self, IntegrateError> {
        // SAFETY: the context is alive.
        let raw = unsafe { sys::CVodeCreate(sys::CV_BDF, context.raw()) };
        if raw.is_null() {
            return Err(IntegrateError::OutOfMemory { function: "CVodeCreate" });
        }
        context.attach(raw);
        Ok(Self { raw })
    }

    /// Start, tolerance and user data.
    pub(crate) fn start<S: OdeSystem>(
        &self,
        (t0, y0): (f64, &Vector),
        shared: *mut Shared<S>,
    ) -> Result<(), Flag> {
        // SAFETY: the object is alive; `shared` stays alive and in place until after it is freed.
        unsafe {
            check(
                "CVodeInit",
                sys::CVodeInit(self.raw, Some(callback::derivative::<S>), t0, y0.raw()),
            )?;
            // The relative tolerance is zero: it would depend on the zero of the scale.
            check(
                "CVodeWFtolerances",
                sys::CVodeWFtolerances(self.raw, Some(callback::weights::<S>)),
            )?;
            check("CVodeSetUserData", sys::CVodeSetUserData(self.raw, shared.cast()))?;
            // Counted by the integrator; one call here is one step.
            check("CVodeSetMaxNumSteps", sys::CVodeSetMaxNumSteps(self.raw, -1))?;
            check("CVodeSetMaxHnilWarns", sys::CVodeSetMaxHnilWarns(self.raw, -1))
        }
    }

    pub(crate) fn attach_solver<S: OdeSystem>(&self, handles: &SolverHandles) -> Result<(), Flag> {
        // SAFETY: the handles stay alive until after the object is freed.
        unsafe {
            let flag = sys::CVodeSetLinearSolver(self.raw, handles.solver(), handles.matrix());
            check("CVodeSetLinearSolver", flag)?;
            let flag = sys::CVodeSetLinSysFn(self.raw, Some(linear_solver::form_matrix::<S>));
            check("CVodeSetLinSysFn", flag)
        }
    }

    pub(crate) fn start_quadratures<S: OdeSystem>(
        &self,
        q0: &Vector,
        allowed: Allowance,
    ) -> Result<(), Flag> {
        let amount = allowed.amount.min(BOUNDLESS);
        // SAFETY: the object is alive and copies the vector.
        unsafe {
            check(
                "CVodeQuadInit",
                sys::CVodeQuadInit(self.raw, Some(callback::integrands::<S>), q0.raw()),
            )?;
            // They take part in the error test even if nothing is asked of them. Otherwise CVODES
            // raises the order of their formula with the correction of the wrong step (cvChooseEta
            // saves it only if they are in the test). The energy balance is then off by an amount
            // that grows with the tolerance: 4.5e-8 of the heat on a plate at 1e-5, instead of
            // 1e-13.
            check(
                "CVodeQuadSStolerances",
                sys::CVodeQuadSStolerances(self.raw, allowed.share, amount),
            )?;
            check("CVodeSetQuadErrCon", sys::CVodeSetQuadErrCon(self.raw, 1))
        }
    }

    /// Sensitivities from `s0` on, as accurate as `scales` (one each, or none) ask for. They take
    /// part in the error test.
    pub(crate) fn start_sensitivities<S: OdeSystem>(
        &self,
        s0: &Vectors,
        scales: &[f64],
    ) -> Result<(), Flag> {
        let mut scales = scales.to_vec();
        scales.resize(s0.len(), 1.0);
        let Ok(count) = c_int::try_from(s0.len()) else {
            return Err(Flag { function: "CVodeSensInit", value: sys::CV_MEM_FAIL });
        };
        let callback = Some(callback::sensitivities::<S> as _);
        // SAFETY: the object is alive and copies vectors and scales.
        unsafe {
            let flag = sys::CVodeSensInit(self.raw, count, STRATEGY, callback, s0.raw());
            check("CVodeSensInit", flag)?;
            check("CVodeSensEEtolerances", sys::CVodeSensEEtolerances(self.raw))?;
            // Without this the scales are not there; the parameters themselves serve difference
            // quotients only.
            let none = std::ptr::null_mut();
            let flag =
                sys::CVodeSetSensParams(self.raw, none, scales.as_mut_ptr(), std::ptr::null_mut());
            check("CVodeSetSensParams", flag)?;
            check("CVodeSetSensErrCon", sys::CVodeSetSensErrCon(self.raw, 1))
        }
    }

    /// To be called after every [`restart`](Self::restart).
    pub(crate) fn restart_sensitivities(&self, s: &Vectors) -> Result<(), Flag> {
        // SAFETY: the object is alive and copies the vectors.
        check("CVodeSensReInit", unsafe { sys::CVodeSensReInit(self.raw, STRATEGY, s.raw()) })
    }

    pub(crate) fn sensitivities(&self, s: &mut Vectors) -> Result<(), Flag> {
        let mut t = 0.0;
        // SAFETY: the object is alive, the vectors are its output.
        check("CVodeGetSens", unsafe { sys::CVodeGetSens(self.raw, &raw mut t, s.raw()) })
    }

    /// The sensitivities at a time inside the last internal step.
    pub(crate) fn sensitivities_at(&self, t: f64, s: &mut Vectors) -> Result<(), Flag> {
        // SAFETY: the object is alive, the vectors are its output.
        check("CVodeGetSensDky", unsafe { sys::CVodeGetSensDky(self.raw, t, 0, s.raw()) })
    }

    /// Starts the search for roots of `count` functions, all of them active. CVODES leaves out a
    /// function that was exactly zero at a start, and keeps doing so at a restart. Only another
    /// number of functions resets this.
    pub(crate) fn start_roots<S: OdeSystem>(&self, count: c_int) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        unsafe {
            check("CVodeRootInit", sys::CVodeRootInit(self.raw, 0, None))?;
            check(
                "CVodeRootInit",
                sys::CVodeRootInit(self.raw, count, Some(callback::roots::<S>)),
            )?;
            check("CVodeSetNoInactiveRootWarn", sys::CVodeSetNoInactiveRootWarn(self.raw))
        }
    }

    /// Root of each function at the end of the last step: 1 rising, -1 falling, 0 none.
    ///
    /// `directions` must be as long as the number of functions.
    pub(crate) fn root_directions(&self, directions: &mut [c_int]) -> Result<(), Flag> {
        // SAFETY: the object is alive and writes one value per function.
        check("CVodeGetRootInfo", unsafe {
            sys::CVodeGetRootInfo(self.raw, directions.as_mut_ptr())
        })
    }

    /// The end of the last internal step, which is after the present time if a root was met.
    pub(crate) fn internal_time(&self) -> Result<f64, Flag> {
        let mut t = 0.0;
        // SAFETY: the object is alive and writes to the place given.
        check("CVodeGetCurrentTime", unsafe { sys::CVodeGetCurrentTime(self.raw, &raw mut t) })?;
        Ok(t)
    }

    pub(crate) fn restart(
        &self,
        t: f64,
        y: &Vector,
        quadratures: Option<&Vector>,
    ) -> Result<(), Flag> {
        // SAFETY: the object is alive and copies the vectors.
        unsafe {
            check("CVodeReInit", sys::CVodeReInit(self.raw, t, y.raw()))?;
            match quadratures {
                Some(q) => check("CVodeQuadReInit", sys::CVodeQuadReInit(self.raw, q.raw())),
                None => Ok(()),
            }
        }
    }

    pub(crate) fn set_newton_coefficient(&self, coefficient: f64) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetNonlinConvCoef", unsafe {
            sys::CVodeSetNonlinConvCoef(self.raw, coefficient)
        })
    }

    /// A new Newton matrix for every step and every change of gamma, with a new Jacobian.
    pub(crate) fn always_set_up(&self) -> Result<(), Flag> {
        self.always_match_gamma()?;
        // SAFETY: the object is alive and has its linear solver.
        unsafe {
            check("CVodeSetLSetupFrequency", sys::CVodeSetLSetupFrequency(self.raw, 1 as c_long))?;
            check("CVodeSetJacEvalFrequency", sys::CVodeSetJacEvalFrequency(self.raw, 1 as c_long))
        }
    }

    /// New factors at every change of gamma, so that no solve uses stale ones. It costs nothing:
    /// CVODES changes the step by half at least, and its own threshold for new factors is 0.3.
    pub(crate) fn always_match_gamma(&self) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetDeltaGammaMaxLSetup", unsafe {
            sys::CVodeSetDeltaGammaMaxLSetup(self.raw, 0.0)
        })
    }

    pub(crate) fn set_initial_step(&self, step: f64) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetInitStep", unsafe { sys::CVodeSetInitStep(self.raw, step) })
    }

    pub(crate) fn set_max_step(&self, step: f64) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetMaxStep", unsafe { sys::CVodeSetMaxStep(self.raw, step) })
    }

    /// Sets the number of failed attempts, other than by the error, before CVODES gives a step up.
    pub(crate) fn set_attempts(&self, attempts: c_int) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetMaxConvFails", unsafe { sys::CVodeSetMaxConvFails(self.raw, attempts) })
    }

    pub(crate) fn set_stop(&self, t: f64) -> Result<(), Flag> {
        // SAFETY: the object is alive.
        check("CVodeSetStopTime", unsafe { sys::CVodeSetStopTime(self.raw, t) })
    }

    /// One internal step, or the part of it up to the next root; `t` becomes the time reached.
    pub(crate) fn step(&self, towards: f64, y: &mut Vector, t: &mut f64) -> Result<Reached, Flag> {
        // SAFETY: the object and all that its callbacks reach are alive; `y` is its output and
        // not one of its vectors.
        let flag = unsafe { sys::CVode(self.raw, towards, y.raw(), t, sys::CV_ONE_STEP) };
        check("CVode", flag)?;
        Ok(match flag {
            sys::CV_TSTOP_RETURN => Reached::Stop,
            sys::CV_ROOT_RETURN => Reached::Root,
            _ => Reached::Step,
        })
    }

    pub(crate) fn interpolate(&self, t: f64, y: &mut Vector) -> Result<(), Flag> {
        // SAFETY: the object is alive, `y` is its output.
        check("CVodeGetDky", unsafe { sys::CVodeGetDky(self.raw, t, 0, y.raw()) })
    }

    pub(crate) fn quadratures(&self, q: &mut Vector) -> Result<(), Flag> {
        let mut t = 0.0;
        // SAFETY: the object is alive, `q` is its output.
        check("CVodeGetQuad", unsafe { sys::CVodeGetQuad(self.raw, &raw mut t, q.raw()) })
    }

    /// The running integrals at a time inside the last internal step.
    pub(crate) fn quadratures_at(&self, t: f64, q: &mut Vector) -> Result<(), Flag> {
        // SAFETY: the object is alive, `q` is its output.
        check("CVodeGetQuadDky", unsafe { sys::CVodeGetQuadDky(self.raw, t, 0, q.raw()) })
    }

    /// Estimated local errors of the last step tried.
    pub(crate) fn local_errors(&self, y: &mut Vector) -> Result<(), Flag> {
        // SAFETY: the object is alive, `y` is its output.
        check("CVodeGetEstLocalErrors", unsafe { sys::CVodeGetEstLocalErrors(self.raw, y.raw()) })
    }

    pub(crate) fn counters(&self) -> Counters {
        let mut long = [0 as c_long; 5];
        let (mut order, mut last_step, mut current_step) = (0, 0.0, 0.0);
        let [steps, errors, iterations, failures, _] = &mut long;
        // SAFETY: the object is alive and writes to the places given. A flag can only mean "no
        // memory object".
        unsafe {
            sys::CVodeGetNumSteps(self.raw, steps);
            sys::CVodeGetNumErrTestFails(self.raw, errors);
            sys::CVodeGetNumNonlinSolvIters(self.raw, iterations);
            sys::CVodeGetNumNonlinSolvConvFails(self.raw, failures);
            sys::CVodeGetLastOrder(self.raw, &raw mut order);
            sys::CVodeGetLastStep(self.raw, &raw mut last_step);
            sys::CVodeGetCurrentStep(self.raw, &raw mut current_step);
        }
        let [steps, error_test_failures, newton_iterations, newton_failures, _] =
            long.map(|count| u64::try_from(count).unwrap_or(0));
        let last_order = u32::try_from(order).unwrap_or(0);
        Counters {
            steps,
            error_test_failures,
            newton_iterations,
            newton_failures,
            last_order,
            last_step,
            current_step,
        }
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: made by CVodeCreate, freed once, before everything it refers to (field order of
        // the owner).
        unsafe { sys::CVodeFree(&raw mut self.raw) };
    }
}

/// The name of a flag of CVODES.
pub(crate) fn name_of(flag: c_int) -> &'static str {
    match flag {
        sys::CV_TOO_MUCH_WORK => "CV_TOO_MUCH_WORK",
        sys::CV_TOO_MUCH_ACC => "CV_TOO_MUCH_ACC",
        sys::CV_ERR_FAILURE => "CV_ERR_FAILURE",
        sys::CV_CONV_FAILURE => "CV_CONV_FAILURE",
        sys::CV_LINIT_FAIL => "CV_LINIT_FAIL",
        sys::CV_LSETUP_FAIL => "CV_LSETUP_FAIL",
        sys::CV_LSOLVE_FAIL => "CV_LSOLVE_FAIL",
        sys::CV_RHSFUNC_FAIL => "CV_RHSFUNC_FAIL",
        sys::CV_FIRST_RHSFUNC_ERR => "CV_FIRST_RHSFUNC_ERR",
        sys::CV_REPTD_RHSFUNC_ERR => "CV_REPTD_RHSFUNC_ERR",
        sys::CV_UNREC_RHSFUNC_ERR => "CV_UNREC_RHSFUNC_ERR",
        sys::CV_RTFUNC_FAIL => "CV_RTFUNC_FAIL",
        sys::CV_NLS_INIT_FAIL => "CV_NLS_INIT_FAIL",
        sys::CV_NLS_SETUP_FAIL => "CV_NLS_SETUP_FAIL",
        sys::CV_NLS_FAIL => "CV_NLS_FAIL",
        sys::CV_MEM_FAIL => "CV_MEM_FAIL",
        sys::CV_MEM_NULL => "CV_MEM_NULL",
        sys::CV_ILL_INPUT => "CV_ILL_INPUT",
        sys::CV_NO_MALLOC => "CV_NO_MALLOC",
        sys::CV_BAD_K => "CV_BAD_K",
        sys::CV_BAD_T => "CV_BAD_T",
        sys::CV_BAD_DKY => "CV_BAD_DKY",
        sys::CV_TOO_CLOSE => "CV_TOO_CLOSE",
        sys::CV_VECTOROP_ERR => "CV_VECTOROP_ERR",
        sys::CV_QRHSFUNC_FAIL => "CV_QRHSFUNC_FAIL",
        sys::CV_FIRST_QRHSFUNC_ERR => "CV_FIRST_QRHSFUNC_ERR",
        sys::CV_REPTD_QRHSFUNC_ERR => "CV_REPTD_QRHSFUNC_ERR",
        sys::CV_UNREC_QRHSFUNC_ERR => "CV_UNREC_QRHSFUNC_ERR",
        sys::CV_SRHSFUNC_FAIL => "CV_SRHSFUNC_FAIL",
        sys::CV_FIRST_SRHSFUNC_ERR => "CV_FIRST_SRHSFUNC_ERR",
        sys::CV_REPTD_SRHSFUNC_ERR => "CV_REPTD_SRHSFUNC_ERR",
        sys::CV_UNREC_SRHSFUNC_ERR => "CV_UNREC_SRHSFUNC_ERR",
        sys::CV_CONTEXT_ERR => "CV_CONTEXT_ERR",
        _ => "unnamed",
    }
}
