//! Limit of the first step after a start.

/// A flow and its change per time.
#[derive(Clone, Debug)]
pub(super) struct Jump {
    pub(super) flow: Vec<f64>,
    pub(super) slope: Vec<f64>,
}

impl Jump {
    /// From these to those.
    pub(super) fn to(mut self, flow: &[f64], slope: &[f64]) -> Self {
        self.flow.iter_mut().zip(flow).for_each(|(before, now)| *before = now - *before);
        self.slope.iter_mut().zip(slope).for_each(|(before, now)| *before = now - *before);
        self
    }

    /// The longest step whose sixth term is not above the tolerance, by each row alone: infinite
    /// if nothing jumps. Rows are masses and diagonal entries of the Jacobian.
    ///
    /// A row with the time constant `c = M / |J|` that is to move by `d` has terms of the order of
    /// `d (h / 8c)^n`.
    pub(super) fn longest(&self, rows: impl Iterator<Item = (f64, f64)>, tolerance: f64) -> f64 {
        let mut longest = f64::INFINITY;
        for ((mass, diagonal), (flow, slope)) in rows.zip(self.flow.iter().zip(&self.slope)) {
            let constant = mass / diagonal.abs();
            let moves = (flow.abs() + slope.abs() * constant) / diagonal.abs();
            if moves > tolerance && constant.is_finite() {
                longest = longest.min(8.0 * constant * (tolerance / moves).powf(1.0 / 6.0));
            }
        }
        longest
    }
}
