//! Distance of a comparison of temperatures from changing.
//!
//! A comparison changes only if its sides differ by a hundredth of the tolerance. Without this
//! margin, rounding at the time of an event would decide its truth. A comparison whose two truths
//! drive each other would go unnoticed. With the margin it switches repeatedly and stops the run as
//! chatter.

use std::borrow::Cow;

use crate::evaluation::{Evaluation, PASS};
use crate::id::{Item, NodeId, SwitchId};
use crate::input_error::InputError;
use crate::network::Network;
use crate::network::flow::{name, place, seeded};
use crate::parts::dependence::Dependence;
use crate::parts::switch::Switch;

impl Network {
    /// Left side minus right side of a switch, at the time of `scope` and these temperatures of all
    /// vertices in K, and its largest change, to first order, if each temperature changes by 1 K.
    ///
    /// # Errors
    /// [`InputError`] if a side fails or gives no number.
    pub fn switch_difference(
        &self,
        id: SwitchId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<(f64, f64), InputError> {
        let switch = &self.switches()[id.index()];
        let (dependence, link) = self.switch_dependence(switch);
        let (mut value, mut slope) = (0.0, 0.0);
        for first in (0..dependence.vertices.len().max(1)).step_by(PASS) {
            let at = |k: usize| seeded(temperatures[dependence.vertices[k] as usize], k, first);
            let (slots, stack) = scope.dual();
            if link {
                place(slots, &dependence, &at)
            } else {
                name(slots, &dependence, &at)
            }
            let result = switch.difference.eval(slots, stack);
            let found = self.finite(result, (switch.item, switch.field), scope)?;
            value = found.value;
            slope += found.derivatives.iter().map(|d| d.abs()).sum::<f64>();
        }
        Ok((value, slope))
    }

    /// The nodes whose temperatures the sides of a switch may read.
    pub fn nodes_of_switch(&self, id: SwitchId) -> Vec<NodeId> {
        let (dependence, _) = self.switch_dependence(&self.switches()[id.index()]);
        let nodes = dependence.vertices.iter().map(|vertex| *vertex as usize);
        nodes.filter(|vertex| *vertex < self.nodes().len()).map(NodeId::from_len).collect()
    }

    fn switch_dependence(&self, switch: &Switch) -> (Cow<'_, Dependence>, bool) {
        match switch.item {
            Item::Conductor(id) => (self.parts.dependence(id), true),
            Item::Source(id) => (Cow::Borrowed(&self.parts.source_dependence[id.index()]), false),
            _ => (Cow::default(), false),
        }
    }
}
