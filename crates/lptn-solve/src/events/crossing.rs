//! Times inside a step at which something has to switch.
//!
//! CVODES finds roots at the ends of its steps; lptn searches inside too. It evaluates three
//! places, and more wherever the second difference leaves room for a maximum above the threshold. A
//! threshold that is passed twice within a step is not missed: the run goes back to the first
//! passage. A quantity exactly at its threshold at the start of a step, which root finding skips,
//! is found as well.

use lptn_integrate::{IntegrateError, Integrator, Step};

use crate::bracket::Bracket;
use crate::heat::Heat;
use crate::stop_reason::StopReason;

/// An integrator on the way.
type Stepping<'a> = dyn Integrator<Heat<'a>> + 'a;

/// Parts of a step at whose ends the excess is evaluated first.
const PARTS: usize = 4;

/// Most halvings of such a part in search of an excess that comes and goes within it.
const HALVINGS: usize = 40;

/// Most evaluations inside one step in that search.
const LOOKS: usize = 400;

/// Reason why a step could not be searched.
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

/// Events of a step.
pub(crate) struct Crossings {
    /// Positions that have to switch inside the step or at its end; none without an event.
    pub(crate) due: Vec<usize>,
    /// Their time in s, or the end of the step.
    pub(crate) time: f64,
    /// All evaluations up to that time, in order of time.
    pub(crate) looks: Vec<Look>,
}

/// Searches a step for the first moment at which something has to switch.
///
/// An excess that becomes positive and ends again between two evaluations is searched for: more are
/// made if its second difference allows a top above zero.
pub(crate) fn find(integrator: &mut Stepping<'_>, step: &Step) -> Result<Crossings, Trouble> {
    let mut search = Search::new(integrator);
    let (due, time) = search.first_of(integrator, step)?;
    let mut looks = search.seen;
    looks.retain(|look| look.time <= time);
    looks.sort_by(|a, b| a.time.total_cmp(&b.time));
    Ok(Crossings { due, time, looks })
}

/// Excess of everything that switches over its switching point at a time.
#[derive(Clone)]
pub(crate) struct Look {
    pub(crate) time: f64,
    pub(crate) excess: Vec<f64>,
}

impl Look {
    fn is_due(&self) -> bool {
        self.excess.iter().any(|excess| *excess > 0.0)
    }

    fn most(&self) -> f64 {
        self.excess.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    fn due(&self) -> Vec<usize> {
        let due = self.excess.iter().enumerate().filter(|(_, excess)| **excess > 0.0);
        due.map(|(position, _)| position).collect()
    }
}

/// Evaluates the excess inside a step.
struct Search {
    state: Vec<f64>,
    /// Bends below this do not count.
    rooms: Vec<f64>,
    seen: Vec<Look>,
}

impl Search {
    fn new(integrator: &Stepping<'_>) -> Self {
        let rooms = integrator.system().gates.rooms();
        Self { state: integrator.state().to_vec(), rooms, seen: Vec::new() }
    }

    /// Positions that have to switch, and the time in s; none at the end of a step without an
    /// event.
    fn first_of(
        &mut self,
        integrator: &mut Stepping<'_>,
        step: &Step,
    ) -> Result<(Vec<usize>, f64), Trouble> {
        let place = |k: usize| match k {
            PARTS => step.to,
            _ => step.from + k as f64 / PARTS as f64 * (step.to - step.from),
        };
        let mut before = self.at(integrator, step.from)?;
        for k in (2..=PARTS).step_by(2) {
            let middle = self.at(integrator, place(k - 1))?;
            let after = self.at(integrator, place(k))?;
            // at a root the integrator's result is better
            let counts = !(k == PARTS && step.roots);
            let found = self.first([&before, &middle, &after], (HALVINGS, counts), integrator)?;
            if let Some(between) = found {
                return self.narrow(integrator, between);
            }
            before = after;
        }
        let rising = integrator
            .root_directions()
            .iter()
            .enumerate()
            .filter(|(_, direction)| **direction > 0);
        let due =
            if step.roots { rising.map(|(position, _)| position).collect() } else { Vec::new() };
        Ok((due, step.to))
    }

    fn at(&mut self, integrator: &mut Stepping<'_>, time: f64) -> Result<Look, Trouble> {
        integrator.interpolate(time, &mut self.state)?;
        let mut excess = vec![0.0; self.rooms.len()];
        integrator.system_mut().excess(time, &self.state, &mut excess)?;
        let look = Look { time, excess };
        self.seen.push(look.clone());
        Ok(look)
    }

    /// Two evaluations between which something becomes due: not at the first, but at the second.
    /// `counts` is false if the last of three evaluations at even distances does not count.
    fn first(
        &mut self,
        [before, middle, after]: [&Look; 3],
        (halvings, counts): (usize, bool),
        integrator: &mut Stepping<'_>,
    ) -> Result<Option<(Look, Look)>, Trouble> {
        if halvings > 0 && self.seen.len() < LOOKS && self.may_rise([before, middle, after]) {
            let left = self.at(integrator, before.time.midpoint(middle.time))?;
            let found = self.first([before, &left, middle], (halvings - 1, true), integrator)?;
            if found.is_some() {
                return Ok(found);
            }
            let right = self.at(integrator, middle.time.midpoint(after.time))?;
            return self.first([middle, &right, after], (halvings - 1, counts), integrator);
        }
        let pairs = [(before, middle, true), (middle, after, counts)];
        let due = pairs.into_iter().find(|(_, look, counts)| *counts && look.is_due());
        Ok(due.map(|(before, after, _)| (before.clone(), after.clone())))
    }

    /// True if something that is due at none of three evaluations may be due between them. A
    /// parabola rises above the highest by no more than an eighth of their second difference.
    fn may_rise(&self, [before, middle, after]: [&Look; 3]) -> bool {
        let one = |(((a, b), c), room): (((&f64, &f64), &f64), &f64)| {
            let (highest, bend) = (a.max(*b).max(*c), (a - 2.0 * b + c).abs());
            highest <= 0.0 && highest + bend > 0.0 && bend > *room
        };
        let looks = before.excess.iter().zip(&middle.excess).zip(&after.excess);
        looks.zip(&self.rooms).any(one)
    }

    /// The first moment between a time at which nothing is due and one at which something is.
    fn narrow(
        &mut self,
        integrator: &mut Stepping<'_>,
        (before, mut after): (Look, Look),
    ) -> Result<(Vec<usize>, f64), Trouble> {
        let ends = [&before, &after].map(|look| (look.time, look.most()));
        let mut bracket = Bracket::straight(ends);
        while let Some(time) = bracket.next() {
            let look = self.at(integrator, time)?;
            if bracket.put(time, look.most()) {
                after = look;
            }
        }
        Ok((after.due(), after.time))
    }
}

#[cfg(test)]
mod tests;
