//! Margins that are kept with a probability.

use lptn_network::ParameterId;
use lptn_units::statistics::quantile;

use crate::size::error::TrialError;
use crate::size::judge::{Care, Doubt, Judge, Judged};
use crate::size::load_case::LoadCase;
use crate::uncertainty::{Inputs, Uncertain};

impl Judge<'_> {
    /// Subtracts from every margin the part that the `±` of parameters may take with a probability:
    /// margins are linear in the parameters and normal. Each parameter, with those correlated to
    /// it, is moved by one standard deviation to either side of its value in the design and the
    /// case.
    pub(super) fn doubt(
        &self,
        judged: &mut Judged,
        (design, case): (&[(ParameterId, f64)], &LoadCase),
        (doubt, care): (Doubt<'_>, Care),
    ) -> Result<(), TrialError> {
        let (mut variances, mut left_out) =
            (vec![0.0; judged.margins.len()], vec![0.0; judged.margins.len()]);
        let value = |id: ParameterId| {
            let set = case.set.iter().chain(design).rev().find(|(other, _)| *other == id);
            set.map_or(self.base.parameter_value(id), |(_, value)| *value)
        };
        for direction in doubt.inputs.into_iter().flat_map(Inputs::directions) {
            let moved = |side: f64| {
                let to = |(input, part): &(Uncertain, f64)| {
                    (input.parameter, input.moved(value(input.parameter), side * part))
                };
                let design: Vec<_> =
                    design.iter().copied().chain(direction.iter().map(to)).collect();
                self.in_case((&design, case), care).map(|judged| judged.margins)
            };
            let (low, high) = (moved(-1.0)?, moved(1.0)?);
            for (i, margin) in judged.margins.iter().enumerate() {
                variances[i] += (0.5 * (high[i] - low[i])).powi(2);
                left_out[i] += 0.5 * (high[i] + low[i]) - margin;
            }
        }
        judged.deviations = variances.into_iter().map(f64::sqrt).collect();
        judged.left_out = left_out;
        // the deviations are estimates
        judged.proven.iter_mut().for_each(|proven| *proven = None);
        let times = quantile(doubt.probability);
        let margins = judged.margins.iter_mut().zip(&judged.deviations);
        margins.for_each(|(margin, deviation)| *margin -= times * deviation);
        Ok(())
    }
}
