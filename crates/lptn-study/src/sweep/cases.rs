//! The values of each candidate: case `k` follows from the study and `k` alone.
//!
//! A Latin hypercube comes from a permutation that is computed and not stored. Threads, stops and
//! parts of a cluster cannot change a row, and memory does not grow with the number of candidates.

use lptn_netlist::{AxisNumbers, SweepMethod, SweepPlan};
use lptn_network::{ParameterId, Parameters};

use crate::sweep::latin;
use crate::uncertainty::points;

/// The candidates of a sweep.
#[derive(Clone, Debug)]
pub struct Cases {
    plan: SweepPlan,
    /// For each axis of a grid, the number of candidates with one value before the next value.
    strides: Vec<u64>,
}

impl Cases {
    /// The candidates of a plan.
    pub fn new(plan: SweepPlan) -> Self {
        let mut strides = vec![1_u64; plan.axes.len()];
        for axis in (1..plan.axes.len()).rev() {
            // only a grid has strides, and those of one are no more than its cases
            strides[axis - 1] = strides[axis].saturating_mul(plan.axes[axis].1.count());
        }
        Self { plan, strides }
    }

    /// Number of candidates.
    pub fn count(&self) -> u64 {
        self.plan.cases
    }

    /// The plan they follow.
    pub fn plan(&self) -> &SweepPlan {
        &self.plan
    }

    /// The parameters that differ, in the order of the axes.
    pub fn parameters(&self) -> impl ExactSizeIterator<Item = ParameterId> + '_ {
        self.plan.axes.iter().map(|(id, _)| *id)
    }

    /// The value of each axis for a candidate, in SI units; candidates are counted from 0.
    pub fn values(&self, case: u64, out: &mut [f64]) {
        for (axis, value) in out.iter_mut().enumerate().take(self.plan.axes.len()) {
            *value = self.value(case, axis);
        }
    }

    fn value(&self, case: u64, axis: usize) -> f64 {
        let numbers: &AxisNumbers = &self.plan.axes[axis].1;
        match self.plan.method {
            SweepMethod::Grid => numbers.value(case / self.strides[axis] % numbers.count()),
            SweepMethod::List | SweepMethod::Csv => numbers.value(case),
            SweepMethod::LatinHypercube => {
                numbers.at(latin::sample(case, self.plan.cases, axis, self.plan.seed))
            }
            SweepMethod::Sobol => {
                // there are never more than 2^16 points
                let index = usize::try_from(case).unwrap_or(0);
                numbers.at(points::uniform(index, axis, self.plan.seed))
            }
        }
    }

    /// Gives the parameters the values of a candidate.
    pub fn set(&self, case: u64, parameters: &mut Parameters) {
        for (axis, id) in self.parameters().enumerate() {
            parameters.set(id, self.value(case, axis));
        }
    }
}
