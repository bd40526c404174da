//! Proven margins of a design.

use lptn_assembly::ThermalSystem;
use lptn_network::ParameterId;
use lptn_solve::{ProvenMargin, SteadyState, Uncertified};

use crate::size::error::SizeError;
use crate::size::judge::{Care, Demand, Judge, Judged};

/// The margins of every requirement with proven bounds, in the network with the values of a design
/// in SI units.
///
/// # Errors
/// As [`crate::size::judge()`].
pub fn certify(demand: Demand<'_>, design: &[(ParameterId, f64)]) -> Result<Judged, SizeError> {
    Judge::new(demand)?.judge(design, Care::Certified)
}

impl Judge<'_> {
    /// Proven bounds on the margin of each requirement, or the reason why there are none.
    pub(super) fn proofs(
        &self,
        system: &ThermalSystem,
        steady: &SteadyState,
    ) -> (Vec<Option<ProvenMargin>>, Option<Uncertified>) {
        let own = self.demand.network.limits().len();
        match steady.proven_errors(system) {
            Ok(bounds) => (steady.proven_margins(system, &bounds).split_off(own), None),
            Err(reason) => (vec![None; self.demand.requirements.len()], Some(reason)),
        }
    }
}

impl Judged {
    /// True if everything is kept with proof.
    pub fn is_proven(&self) -> bool {
        let kept = |proven: &Option<ProvenMargin>| proven.and_then(|of| of.kept()) == Some(true);
        self.proven.len() == self.margins.len() && self.proven.iter().all(kept)
    }
}
