//! Growth of an error of one state by itself, and its magnification by massless nodes.
//!
//! If a node loses less heat when it is warmer, its error grows at its own rate, however fast the
//! rest of the network is. The largest speed ([`growth`](crate::growth)) does not show it then. In
//! a network in which heat flows from warm to cold the errors grow at least as fast as the largest
//! of these rates, and in one that comes to rest none of them is positive.
//!
//! This takes a Jacobian, 40 % of a step of 400 nodes. It is therefore evaluated only if a kink was
//! passed or a temperature becomes faster, and in every 16th step, or every 4th if something turns.
//! If the form of the network excludes a growth of errors it is not evaluated at all.

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_integrate::{OdeSystem, Pattern};

use crate::heat::Heat;

/// A massless node magnifies no more than this: beyond it the node is about to jump.
const MOST: f64 = 100.0;

/// Every 4th step is evaluated if something turns, else every 16th, if nothing asks for it.
const SELDOM: [usize; 2] = [4, 16];

/// If something turns, a speed that grows by more than this in a step asks for an evaluation.
const FASTER: f64 = 1.02;

/// The growth of the error of each state, as far as it is that state's own.
pub(super) struct Errors {
    capacity: Vec<f64>,
    pattern: Pattern,
    values: Vec<f64>,
    /// State, massless node that is solved for, and the slots in which each receives heat by the
    /// other's temperature.
    pairs: Vec<(usize, usize, [usize; 2])>,
    /// Rate of growth of each error, in 1/s, and the slope of each temperature over its state.
    rates: Vec<f64>,
    slopes: Vec<f64>,
    /// Growth of each error since it was smallest, and its maximum.
    now: Vec<f64>,
    most: f64,
    /// The speeds of all vertices in the last step in K/s.
    speeds: Vec<f64>,
    /// True if something grew or was magnified in the last evaluation, and steps since then.
    grows: bool,
    unseen: usize,
    /// Time since then in s.
    elapsed: f64,
}

impl Errors {
    /// False if the form of the network excludes that an error grows at the rate of its own state
    /// or is magnified by a massless node: every heat falls with the temperature of the node that
    /// receives it, and every state is the temperature of a node.
    pub(super) fn may_grow(system: &ThermalSystem) -> bool {
        let heats = || system.states().iter().any(|&id| system.network().enthalpy(id).is_some());
        !system.is_monotone() || !system.algebraic().is_empty() || heats()
    }

    pub(super) fn of(heat: &Heat<'_>) -> Self {
        let (pattern, capacity) = (heat.pattern().clone(), heat.capacities().to_vec());
        let states = capacity.len();
        let mut pairs = Vec::new();
        for massless in states..pattern.size() {
            for slot in pattern.column(massless) {
                let state = pattern.row_indices()[slot];
                if let (true, Some(back)) = (state < states, pattern.slot(massless, state)) {
                    pairs.push((state, massless, [slot, back]));
                }
            }
        }
        Self {
            values: vec![0.0; pattern.len()],
            rates: vec![0.0; states],
            slopes: vec![1.0; states],
            now: vec![1.0; states],
            most: 1.0,
            speeds: Vec::new(),
            grows: false,
            unseen: 0,
            elapsed: 0.0,
            capacity,
            pattern,
            pairs,
        }
    }

    /// The largest growth of an error.
    pub(super) fn most(&self) -> f64 {
        self.most
    }

    /// Takes in a step of `length` in s between temperatures of all vertices. The flags say if
    /// anything turns and if a kink was passed. Returns true if its end has to be evaluated. If
    /// errors grow, a temperature becomes faster sooner or later, or a kink was passed.
    pub(super) fn goes_on(
        &mut self,
        [before, after]: [&[f64]; 2],
        (length, [turns, changed]): (f64, [bool; 2]),
    ) -> bool {
        let changes = before.iter().zip(after).map(|(before, after)| (after - before).abs());
        let speeds: Vec<f64> = changes.map(|change| change / length).collect();
        let faster = self.speeds.iter().zip(&speeds).any(|(last, now)| *now > FASTER * last);
        self.speeds = speeds;
        self.unseen += 1;
        self.elapsed = if changed { length } else { self.elapsed + length };
        self.grows || changed || turns && faster || self.unseen >= SELDOM[usize::from(!turns)]
    }

    /// Takes in the state that was evaluated last.
    pub(super) fn step(&mut self, heat: &mut Heat<'_>) {
        if heat.jacobian_here(JacobianForm::Exact, &mut self.values).is_err() {
            return;
        }
        let states = self.capacity.len();
        let slopes = heat.slope().map_or(vec![1.0; states], |slopes| slopes[..states].to_vec());
        let length = std::mem::take(&mut self.elapsed);
        self.unseen = 0;
        let diagonal = |i: usize| self.values[self.pattern.diagonal_slot(i)];
        let mut own: Vec<f64> = (0..states).map(diagonal).collect();
        for (state, massless, [to, from]) in &self.pairs {
            if diagonal(*massless) < 0.0 {
                own[*state] -= self.values[*to] * self.values[*from] / diagonal(*massless);
            }
        }
        for i in 0..states {
            let rate = own[i] * slopes[i] / self.capacity[i];
            // below 1 the tolerance is one of the state
            let slope = slopes[i].max(1.0);
            let grown = (0.5 * length * (rate + self.rates[i])).exp() * slope / self.slopes[i];
            (self.rates[i], self.slopes[i]) = (rate, slope);
            self.now[i] = (self.now[i] * grown).max(1.0);
            self.most = self.most.max(self.now[i]);
        }
        let magnified = self.magnified();
        self.most = self.most.max(magnified);
        self.grows = magnified > 1.01 || self.rates.iter().any(|rate| *rate > 0.0);
    }

    /// The largest error of a massless node.
    fn magnified(&self) -> f64 {
        let diagonal = |i: usize| self.values[self.pattern.diagonal_slot(i)];
        let mut errors = vec![0.0; self.pattern.size()];
        for (state, massless, [_, from]) in &self.pairs {
            let share = (self.values[*from] / diagonal(*massless)).abs();
            errors[*massless] += share * self.now[*state];
        }
        errors.into_iter().filter(|error| *error < MOST).fold(1.0, f64::max)
    }
}

#[cfg(test)]
mod tests;
