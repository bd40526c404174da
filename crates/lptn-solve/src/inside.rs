//! Temperatures at which every value can be computed: a search may begin outside the range of a
//! table or fluid, though the solution is inside.
//!
//! Before Newton's method begins, each value is moved into the range of its tables, and the search
//! is damped there. Tables with constant ends would let the search leave their range too, but every
//! value would need a second kind of evaluation.

use lptn_assembly::Workspace;
use lptn_network::{InputError, InputProblem, Item, Vertices};
use lptn_units::EvalError;

use crate::newton::Newton;
use crate::newton_error::NewtonError;

/// Most values that are brought into their range, one after the other.
const ROUNDS: usize = 200;

/// Share of its range by which a value is brought inside it.
const INSIDE: f64 = 0.05;

/// The first distance in K by which temperatures are moved for a value that does not report how far
/// it is outside its range.
const STRIDE: f64 = 5.0;

/// The furthest such distance in K.
const FURTHEST: f64 = 3000.0;

/// The lowest temperature in K to which a search is moved.
const COLDEST: f64 = 1.0;

impl Newton<'_> {
    /// Moves free temperatures at which a value fails to others at which it succeeds; true if any
    /// were found. Each value moves the nodes that it depends on, all by the same distance.
    pub(crate) fn bring_inside(&mut self, work: &mut Workspace, temperatures: &mut [f64]) -> bool {
        let (mut last, mut stride) = (None, STRIDE);
        for _ in 0..ROUNDS {
            let failed = match self.residual(work, temperatures) {
                Ok(_) => return self.linearize(work, temperatures).is_ok(),
                Err(NewtonError::Input(failed)) => failed,
                Err(_) => return false,
            };
            let places = self.places_of(failed.item);
            let again = last == Some(failed.item);
            // a value that is still outside after this move depends on the temperatures otherwise
            stride = if again { 1.5 * stride } else { STRIDE };
            last = Some(failed.item);
            let moved = lacks(&failed).filter(|_| !again).unwrap_or_else(|| match lacks(&failed) {
                Some(lacks) => stride.copysign(lacks),
                None => stride,
            });
            if places.is_empty() || stride > FURTHEST {
                return false;
            }
            for i in places {
                temperatures[i] = (temperatures[i] + moved).max(COLDEST);
            }
        }
        false
    }

    /// The free unknowns on which an element depends.
    fn places_of(&self, item: Item) -> Vec<usize> {
        let network = self.system.network();
        let read = match item {
            Item::Conductor(id) => network.conductor_variables(id),
            Item::Source(id) => network.source_variables(id).into(),
            _ => Vertices::new(),
        };
        let unknowns = self.system.unknowns();
        let reads = |i: &&usize| read.iter().any(|&v| v as usize == unknowns[**i].index());
        self.free.iter().filter(reads).copied().collect()
    }
}

/// The increase that brings a value well inside its range, if it reports that range.
pub(crate) fn lacks(error: &InputError) -> Option<f64> {
    let into = |value: f64, (from, to): (f64, f64)| {
        let room = INSIDE * (to - from);
        value.clamp(from + room, to - room) - value
    };
    match &error.problem {
        InputProblem::Evaluation(problem) => match problem.as_ref() {
            EvalError::OutsideTable { value, from, to, .. } => Some(into(*value, (*from, *to))),
            _ => None,
        },
        InputProblem::OutsideFluid { temperature, range } => Some(into(*temperature, *range)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
