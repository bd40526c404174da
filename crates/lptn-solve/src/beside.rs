//! Results next to a run: a parameter has another value, and temperatures follow their
//! sensitivities.

use std::ops::Range;

use lptn_assembly::ChangeError;
use lptn_network::{InputError, LimitId, ParameterId, Value};

use crate::replay::Replay;
use crate::solution::Solution;

impl Solution {
    /// [`Solution::result`] with another value of a parameter. Every temperature changes by its
    /// sensitivity, so that only the first order in the change is correct.
    ///
    /// # Errors
    /// [`ChangeError`] if the network does not take the value.
    pub(crate) fn result_beside(
        &self,
        value: &Value,
        changed: (ParameterId, f64),
    ) -> Result<Vec<f64>, ChangeError> {
        let mut values = Vec::with_capacity(self.times.len());
        let Some(insides) = self.insides_of(value) else {
            return Ok(vec![f64::NAN; self.times.len()]);
        };
        let rows = (0..self.times.len(), &*insides);
        self.replay_beside(changed, rows, |at| values.push(at.result(value)))?;
        Ok(values)
    }

    /// The margin of a limit in a row, in SI units; NaN unless every node was recorded.
    pub(crate) fn margin_in_row(&self, limit: LimitId, row: usize) -> Result<f64, InputError> {
        let mut margin = Ok(f64::NAN);
        self.replay_rows(row..row + 1, |at| margin = at.margin(limit));
        margin
    }

    /// The margin for that value, as [`Solution::result_beside`] has results.
    pub(crate) fn margin_beside(
        &self,
        (limit, row): (LimitId, usize),
        changed: (ParameterId, f64),
    ) -> Result<Result<f64, InputError>, ChangeError> {
        let mut margin = Ok(f64::NAN);
        let rows = (row..row + 1, &self.segments[..]);
        self.replay_beside(changed, rows, |at| margin = at.margin(limit))?;
        Ok(margin)
    }

    fn replay_beside(
        &self,
        (parameter, to): (ParameterId, f64),
        rows: (Range<usize>, &[f64]),
        visit: impl FnMut(&mut Replay<'_>),
    ) -> Result<(), ChangeError> {
        let network = self.network();
        let by = to - network.parameter_value(parameter);
        let mut changed = network.given();
        changed.set(parameter, to);
        let system = self.system.with(&changed)?;
        let slopes: Vec<Option<Vec<f64>>> =
            self.recorded.iter().map(|&node| self.sensitivity(parameter, node)).collect();
        let moved = |row: usize, column: usize| {
            let slope = slopes[column].as_ref().map_or(f64::NAN, |slopes| slopes[row]);
            self.row(row)[column] + by * slope
        };
        self.replay_as((&system, &moved), rows, visit);
        Ok(())
    }
}
