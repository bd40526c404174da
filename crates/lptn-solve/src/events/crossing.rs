//! When something has to switch inside a step.

use lptn_integrate::{IntegrateError, Integrator, Step};

use crate::error::StopReason;
use crate::heat::Heat;

/// An integrator on the way.
type Stepping<'a> = dyn Integrator<Heat<'a>> + 'a;

/// Looks inside a step, besides those of the integrator at its ends: what comes and goes between
/// them is found too.
const LOOKS: u32 = 4;

/// Halvings of the interval in which something begins to be due: to the rounding of the time.
const BISECTIONS: usize = 60;

/// Why a step could not be looked into.
pub(crate) enum Trouble {
    Integrator(IntegrateError),
    Stop(StopReason),
}

impl From<IntegrateError> for Trouble {
    fn from(error: IntegrateError) -> Self {
        Self::Integrator(error)
    }
}

impl From<StopReason> for Trouble {
    fn from(reason: StopReason) -> Self {
        Self::Stop(reason)
    }
}

/// What has to switch inside a step or at its end, by its position, and when that is; nothing at
/// the end of a step without an event.
pub(crate) fn find(
    integrator: &mut Stepping<'_>,
    step: &Step,
) -> Result<(Vec<usize>, f64), Trouble> {
    let mut look = Look::new(integrator);
    let mut before = step.from;
    for k in 1..=LOOKS {
        let last = k == LOOKS;
        if last && step.roots {
            break; // the integrator knows better
        }
        let share = f64::from(k) / f64::from(LOOKS);
        let time = if last { step.to } else { step.from + share * (step.to - step.from) };
        if look.is_due(integrator, time)? {
            return look.first(integrator, (before, time));
        }
        before = time;
    }
    let rising =
        integrator.root_directions().iter().enumerate().filter(|(_, direction)| **direction > 0);
    let due = if step.roots { rising.map(|(position, _)| position).collect() } else { Vec::new() };
    Ok((due, step.to))
}

/// Evaluates what switches inside a step.
struct Look {
    state: Vec<f64>,
    excess: Vec<f64>,
}

impl Look {
    fn new(integrator: &Stepping<'_>) -> Self {
        let count = integrator.system().gates.count();
        Self { state: integrator.state().to_vec(), excess: vec![0.0; count] }
    }

    fn is_due(&mut self, integrator: &mut Stepping<'_>, time: f64) -> Result<bool, Trouble> {
        integrator.interpolate(time, &mut self.state)?;
        integrator.system_mut().excess(time, &self.state, &mut self.excess)?;
        Ok(self.excess.iter().any(|excess| *excess > 0.0))
    }

    /// The first moment between a time at which nothing is due and one at which something is.
    fn first(
        &mut self,
        integrator: &mut Stepping<'_>,
        (mut before, mut after): (f64, f64),
    ) -> Result<(Vec<usize>, f64), Trouble> {
        for _ in 0..BISECTIONS {
            let middle = before + 0.5 * (after - before);
            match self.is_due(integrator, middle)? {
                true => after = middle,
                false => before = middle,
            }
        }
        self.is_due(integrator, after)?;
        let due = self.excess.iter().enumerate().filter(|(_, excess)| **excess > 0.0);
        Ok((due.map(|(position, _)| position).collect(), after))
    }
}
