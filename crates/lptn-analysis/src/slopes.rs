//! Runs with their sensitivities.

use lptn_network::{Network, ParameterId};
use lptn_solve::{Proceed, Progress, SensitiveError, SensitiveRun, sensitive_run_observed};

use crate::run::RunAnalysis;
use crate::trust::Trust;
use crate::trusted::Trusted;

impl RunAnalysis {
    /// Runs a network and follows how its temperatures change with parameters: exactly, or by
    /// differences of runs; see [`sensitive_run_observed`].
    ///
    /// # Errors
    /// [`SensitiveError`] if one of the runs fails or is interrupted.
    pub fn with_slopes(
        &self,
        (network, parameters): (&Network, &[ParameterId]),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Trusted<SensitiveRun>, SensitiveError> {
        let result = sensitive_run_observed(network, (self.transient(), parameters), observer)?;
        Ok(Trusted { trust: Trust::of_run(&result.solution), result })
    }
}
