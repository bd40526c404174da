//! Where laws are known: the groups of their conductors.

use crate::evaluation::Evaluation;
use crate::id::{ConductorId, Item};
use crate::input_error::InputError;
use crate::law::At;
use crate::network::Network;
use crate::network::flow::place;
use lptn_laws::Formula;

impl Network {
    /// The conductors whose laws say by groups where they hold.
    pub fn ranged_conductors(&self) -> Vec<ConductorId> {
        let has = |id: &ConductorId| {
            let formula = self.conductors()[id.index()].law.formula();
            !formula.declaration().groups.is_empty()
        };
        self.conductor_ids().filter(has).collect()
    }

    /// What the groups of a conductor's law are, in their order, at the time of `scope` and these
    /// temperatures of all vertices in K; `None` for one that does not count there.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn groups(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<Option<f64>>, InputError> {
        let conductor = &self.conductors()[id.index()];
        let (law, dependence) = (&conductor.law, self.parts.dependence(id));
        let ends = [conductor.from, conductor.to].map(|end| self.vertex(end));
        // a constant conductor has no dependence, but its ends
        let vertex = |k: usize| dependence.vertices.get(k).map_or_else(|| ends[k], |&v| v as usize);
        let result = {
            let (slots, stack) = scope.plain();
            place(slots, dependence, &|k| temperatures[vertex(k)]);
            let groups = |values: &[f64], ends| law.formula().groups(values, ends);
            At { slots, stack }.of_values::<{ Formula::MOST_FIELDS }, _>(law, groups)
        };
        result.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))
    }
}
