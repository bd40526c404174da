//! Proven margins of limits in a steady state.

use lptn_assembly::ThermalSystem;
use lptn_network::LimitId;
use lptn_units::Taylor;

use super::ROUNDING;
use super::results::{Followed, Placed};
use crate::limit_seen::ProvenMargin;
use crate::quantity::Quantity;
use crate::snapshot::Snapshot;
use crate::times::just_after;

impl Snapshot {
    /// The margin of each limit in the steady state that is within these bounds of each node in K:
    /// see [`Snapshot::proven_errors`]. `None` for a limit without bounds, and for one of numbers
    /// over time.
    pub fn proven_margins(
        &self,
        system: &ThermalSystem,
        bounds: &[f64],
    ) -> Vec<Option<ProvenMargin>> {
        let network = system.network();
        let mut scope = network.evaluation();
        scope.set_positions(&self.positions);
        let here = (self.time, self.time);
        let [inputs, _] = network.input_bounds(&mut scope, here, just_after(self.time));
        let range = |id: &lptn_network::NodeId| {
            let (t, bound) = (self.temperatures[id.index()], bounds[id.index()]);
            Taylor::between(&[[t - bound, t + bound]])
        };
        let state: Vec<Taylor> = system.unknowns().iter().map(range).collect();
        let Some(mut placed) = Placed::new(system, inputs, &state) else {
            return vec![None; network.limits().len()];
        };
        let mut margin = |id: LimitId| {
            if !network.limits()[id.index()].is_of_moments() {
                return None;
            }
            let size = [0, 1].map(|side| {
                let side = Followed::Quantity(Quantity::Side(id, side));
                placed.followed(network, side).map(|side| side.largest(0))
            });
            let rounding = ROUNDING * (size[0]? + size[1]?);
            let [low, high] = placed.followed(network, Followed::Margin(id))?.range()?;
            let margin = [low - rounding, high + rounding];
            Some(ProvenMargin { margin, broken: [f64::INFINITY; 2] })
        };
        network.limit_ids().map(&mut margin).collect()
    }
}
