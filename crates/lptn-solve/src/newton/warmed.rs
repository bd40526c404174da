//! Newton's method from warmer temperatures, if the start of the search does not matter.
//!
//! Free convection carries nothing if a body is as warm as the air, and its slope is 0 there too. A
//! network that begins so has a singular Jacobian, and pseudo-time took 250 steps to leave it. From
//! warmer temperatures Newton's method takes a few iterations.

use lptn_assembly::Workspace;

use super::Newton;

/// Rises in K at which all free unknowns begin.
const WARMER: [f64; 2] = [30.0, 300.0];

impl Newton<'_> {
    /// Solves the balances from warmer temperatures, if they have one solution at most. True if that
    /// succeeded; else `temperatures` (all unknowns, in K) are as before.
    pub(super) fn warmed(&mut self, work: &mut Workspace, temperatures: &mut [f64]) -> bool {
        if !self.system.is_monotone() {
            return false;
        }
        let start = temperatures.to_vec();
        for warmer in WARMER {
            self.free.iter().for_each(|&i| temperatures[i] = start[i] + warmer);
            self.bring_inside(work, temperatures);
            if self.damped(work, temperatures).is_ok() {
                return true;
            }
            temperatures.copy_from_slice(&start);
        }
        false
    }
}
