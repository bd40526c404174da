//! Capacities that change during a run.

use lptn_units::Scalar;

use crate::evaluation::{Evaluation, PASS};
use crate::id::{Field, Item, NodeId};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::network::flow::seeded;
use crate::parts::state_capacity::StateCapacity;

impl Network {
    /// The nodes whose capacity follows states, ascending.
    pub fn state_capacities(&self) -> &[StateCapacity] {
        &self.numbers.state_capacities
    }

    /// True if the capacity of a node changes during a run: with its temperature or with states.
    pub fn capacity_varies(&self, node: NodeId) -> bool {
        self.enthalpy(node).is_some() || self.capacity_of_states(node).is_some()
    }

    /// The capacity of a node, if it follows states.
    pub fn capacity_of_states(&self, node: NodeId) -> Option<&StateCapacity> {
        self.state_capacities().iter().find(|of| of.node == node)
    }

    /// The first node whose capacity changes during a run.
    pub fn first_varying_capacity(&self) -> Option<NodeId> {
        self.node_ids().find(|id| self.capacity_varies(*id))
    }

    /// The capacity in J/K at these temperatures of all nodes in K.
    ///
    /// # Errors
    /// [`InputError`] if it has no value or is not positive.
    pub fn capacity_at(
        &self,
        of: &StateCapacity,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        for (slot, node) in of.slots.iter().zip(&of.states) {
            scope.set(*slot, temperatures[node.index()]);
        }
        let mut sum = 0.0;
        for (item, value) in &of.parts {
            let capacity = value.at(scope);
            sum += self.positive(capacity.map_err(InputProblem::from), *item, scope)?;
        }
        Ok(sum)
    }

    /// The same; also writes its derivatives in J/K^2 by the temperatures of the nodes of
    /// [`StateCapacity::states`].
    ///
    /// # Errors
    /// As [`Network::capacity_at`].
    pub fn capacity_slopes(
        &self,
        of: &StateCapacity,
        scope: &mut Evaluation,
        temperatures: &[f64],
        slopes: &mut Vec<f64>,
    ) -> Result<f64, InputError> {
        slopes.clear();
        slopes.resize(of.states.len(), 0.0);
        let mut sum = 0.0;
        for first in (0..of.states.len()).step_by(PASS) {
            sum = 0.0;
            for (item, value) in &of.parts {
                let (slots, stack) = scope.dual();
                for (k, (slot, node)) in of.slots.iter().zip(&of.states).enumerate() {
                    slots[*slot as usize] = seeded(temperatures[node.index()], k, first);
                }
                let capacity = value.on(slots, stack).map_err(InputProblem::from);
                let capacity = self.positive(capacity, *item, scope)?;
                sum += capacity.value();
                let pass = slopes[first..].iter_mut().zip(capacity.derivatives);
                pass.for_each(|(slope, own)| *slope += own);
            }
        }
        Ok(sum)
    }

    /// A capacity, or the reason why it is none.
    fn positive<S: Scalar>(
        &self,
        capacity: Result<S, InputProblem>,
        item: Item,
        scope: &Evaluation,
    ) -> Result<S, InputError> {
        let problem = match capacity {
            Ok(found) if !found.is_finite() => InputProblem::NotFinite(found.value()),
            Ok(found) if found.value() <= 0.0 => InputProblem::NoCapacity(found.value()),
            Ok(found) => return Ok(found),
            Err(problem) => problem,
        };
        Err(self.failed(item, (Field::Capacity, problem), scope))
    }
}
