//! Steps that end where a function of the state changes its sign, and the way back into a step.

use std::cmp::Ordering;
use std::ffi::c_int;

use sundials_sys as sys;

use super::Cvodes;
use crate::memory::{Flag, Reached};
use lptn_integrate::{Callback, OdeSystem};

/// Times that differ by this part of their size are one time, as in CVODES' search for roots.
const SAME: f64 = 100.0 * f64::EPSILON;

/// CVODES refuses to start so close to a stop time, relative to the time.
const TOO_CLOSE: f64 = 4.0 * f64::EPSILON;

/// State of the functions whose roots end a step.
pub(super) struct Roots {
    /// 1 rising, -1 falling, 0 none; for the last step that ended at a root.
    pub(super) directions: Vec<c_int>,
    /// True if the last step ended at a root.
    met: bool,
    /// True if CVODES must restart before it goes on: its values of the functions are outdated.
    stale: bool,
    before: Vec<f64>,
    now: Vec<f64>,
}

impl Roots {
    pub(super) fn new(count: usize) -> Self {
        let (directions, before, now) = (vec![0; count], vec![0.0; count], vec![0.0; count]);
        Self { directions, met: false, stale: false, before, now }
    }

    pub(super) fn are_none(&self) -> bool {
        self.directions.is_empty()
    }

    pub(super) fn met(&self) -> bool {
        self.met
    }

    /// True if a function has a root between `before` and `now`; then the directions are set.
    fn compare(&mut self) -> bool {
        let pairs = || self.before.iter().zip(&self.now);
        let met = pairs().any(|(&before, &now)| direction(before, now) != 0);
        if met {
            self.directions = pairs().map(|(&before, &now)| direction(before, now)).collect();
        }
        met
    }
}

fn direction(before: f64, now: f64) -> c_int {
    match before.partial_cmp(&0.0) {
        Some(Ordering::Less) if now >= 0.0 => 1,
        Some(Ordering::Greater) if now <= 0.0 => -1,
        _ => 0,
    }
}

/// False if one is infinite.
fn is_within(part: f64, a: f64, b: f64) -> bool {
    (a - b).abs() < part * a.abs().max(b.abs())
}

impl<S: OdeSystem> Cvodes<S> {
    /// State, running integrals and sensitivities at a time inside the last step.
    pub(super) fn read_at(&mut self, t: f64) -> Result<(), Flag> {
        self.memory.interpolate(t, &mut self.scratch)?;
        if let Some(quadratures) = &mut self.quadratures {
            self.memory.quadratures_at(t, quadratures)?;
        }
        self.read_sensitivities_at(t)?;
        self.state.as_mut_slice().copy_from_slice(self.scratch.as_slice());
        Ok(())
    }

    /// To be called at every start of CVODES.
    pub(super) fn start_roots(&mut self) -> Result<(), Flag> {
        (self.roots.stale, self.roots.met) = (false, false);
        match c_int::try_from(self.roots.directions.len()) {
            Ok(0) => Ok(()),
            Ok(count) => self.memory.start_roots::<S>(count),
            Err(_) => Err(Flag { function: "CVodeRootInit", value: sys::CV_MEM_FAIL }),
        }
    }

    /// A start so close to the stop time that CVODES would refuse it, as may happen after a root:
    /// moves to the stop time.
    pub(super) fn starts_at_stop(&mut self) -> bool {
        let is_close = self.from >= self.time && is_within(TOO_CLOSE, self.time, self.stop);
        let starts =
            is_close && self.memory.counters().steps == 0 && self.memory_at(self.stop).is_ok();
        if starts {
            (self.time, self.from) = (self.stop, self.stop);
            (self.shown.time, self.shown.from) = (self.shown.stop, self.shown.stop);
        }
        starts
    }

    /// Lets CVODES start from the present state at another time.
    pub(super) fn memory_at(&mut self, t: f64) -> Result<(), Flag> {
        self.memory.restart(t, &self.state, self.quadratures.as_ref())?;
        self.restart_sensitivities()?;
        self.start_roots()
    }

    /// After a root, CVODES is at the end of its internal step and returns that end next. If a stop
    /// time comes first, or if its values of the functions are outdated, it restarts at the root.
    pub(super) fn leave_rest(&mut self) -> Result<(), Flag> {
        if self.roots.are_none() {
            return Ok(());
        }
        if self.roots.stale || self.memory.internal_time()? > self.stop {
            self.read_running()?;
            self.begin_anew()?;
        }
        Ok(())
    }

    /// Handles the result of a step of CVODES with roots.
    pub(super) fn look_for_roots(
        &mut self,
        towards: f64,
        mut reached: Result<Reached, Flag>,
    ) -> Result<Reached, Flag> {
        let was_met = std::mem::take(&mut self.roots.met);
        let given_up = reached.as_ref().err().map(|flag| flag.value);
        if given_up == Some(sys::CV_RTFUNC_FAIL) {
            self.put_state_back()?;
        } else if was_met && given_up == Some(sys::CV_ILL_INPUT) {
            // A function stays exactly zero after its root: a start leaves it out, CVODES itself
            // gives up.
            self.put_state_back()?;
            self.read_running()?;
            self.begin_anew()?;
            reached = self.take_step(towards);
        }
        let reached = reached?;
        self.roots.met = match reached {
            Reached::Root => self.take_roots()?,
            Reached::Stop => self.roots_at_stop()?,
            Reached::Step => false,
        };
        Ok(reached)
    }

    /// CVODES uses the output for the states it tries while it looks for roots.
    fn put_state_back(&mut self) -> Result<(), Flag> {
        self.memory.interpolate(self.time, &mut self.state)
    }

    /// A root within rounding of the stop time is at the stop time: a start just before it would be
    /// refused.
    fn take_roots(&mut self) -> Result<bool, Flag> {
        self.memory.root_directions(&mut self.roots.directions)?;
        if is_within(SAME, self.time, self.stop) {
            self.time = self.stop;
            self.roots.stale = true;
        }
        Ok(true)
    }

    /// CVODES looks for roots up to the end of its step, which may lie some rounding errors before
    /// the stop time.
    fn roots_at_stop(&mut self) -> Result<bool, Flag> {
        let end = self.memory.internal_time()?;
        if end >= self.time {
            return Ok(false);
        }
        self.memory.interpolate(end, &mut self.scratch)?;
        let Roots { before, now, .. } = &mut self.roots;
        let places =
            [(end, self.scratch.as_slice(), before), (self.time, self.state.as_slice(), now)];
        for (t, y, out) in places {
            let t = self.origin + t;
            let flag =
                self.shared.get_mut().guard(Callback::Roots, t, |shared| shared.roots(t, y, out));
            if flag != crate::callback::DONE {
                return Err(Flag { function: "CVode", value: sys::CV_RTFUNC_FAIL });
            }
        }
        self.roots.stale = self.roots.compare();
        Ok(self.roots.stale)
    }
}
