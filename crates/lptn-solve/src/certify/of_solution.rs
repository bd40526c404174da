//! The bounds of a solution.

use lptn_network::NodeId;

use super::{Certificate, ROUNDING, Uncertified};
use crate::solution::Solution;

impl Solution {
    /// Proven bounds on the errors of the temperatures; `None` unless they were asked for
    /// ([`Transient::certify`]).
    ///
    /// [`Transient::certify`]: crate::Transient::certify
    pub fn certificate(&self) -> Option<&Result<Certificate, Uncertified>> {
        self.certificate.as_ref()
    }

    /// Proven bounds on the error of a node in the rows in K; `None` if there are none.
    pub fn bounds(&self, node: NodeId) -> Option<Vec<f64>> {
        let column = self.recorded.binary_search(&node).ok()?;
        let certificate = self.certificate.as_ref()?.as_ref().ok()?;
        let bounds = certificate.rows.iter().skip(column).step_by(self.recorded.len());
        // a recovered temperature is rounded too
        let rounded = |(bound, value): (&f64, f64)| bound + ROUNDING * value;
        // a run that broke off may have rows without one
        let bounds = bounds.chain(std::iter::repeat(&f64::NAN));
        Some(bounds.zip(self.temperature(node)?).map(rounded).collect())
    }

    /// A proven bound on the error of a node at every time of the run in K; `None` if there is
    /// none.
    pub fn largest_bound(&self, node: NodeId) -> Option<f64> {
        let column = self.recorded.binary_search(&node).ok()?;
        let most = *self.certificate.as_ref()?.as_ref().ok()?.most.get(column)?;
        let hottest = self.temperature(node)?.into_iter().fold(0.0, f64::max);
        Some(most + ROUNDING * hottest)
    }
}
