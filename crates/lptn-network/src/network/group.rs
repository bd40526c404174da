//! Where laws are known: the groups of conductors and sources.

use crate::evaluation::Evaluation;
use crate::id::Item;
use crate::input_error::InputError;
use crate::law::{At, Law};
use crate::network::Network;
use crate::network::flow::{name, place};
use lptn_laws::Formula;

impl Network {
    /// The law of a conductor or source; `None` of anything else.
    pub fn law(&self, item: Item) -> Option<&Law> {
        match item {
            Item::Conductor(id) => Some(&self.conductors()[id.index()].law),
            Item::Source(id) => Some(&self.sources()[id.index()].law),
            _ => None,
        }
    }

    /// The conductors and sources whose laws say by groups where they hold.
    pub fn ranged(&self) -> Vec<Item> {
        let items = self.conductor_ids().map(Item::Conductor);
        let items = items.chain(self.source_ids().map(Item::Source));
        let has = |law: &Law| !law.formula().declaration().groups.is_empty();
        items.filter(|item| self.law(*item).is_some_and(has)).collect()
    }

    /// What the groups of a conductor's or source's law are, in their order, at the time of `scope`
    /// and these temperatures of all vertices in K; `None` for one that does not count there.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn groups(
        &self,
        item: Item,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<Option<f64>>, InputError> {
        let Some(law) = self.law(item) else { return Ok(Vec::new()) };
        let result = {
            let (slots, stack) = scope.plain();
            match item {
                Item::Conductor(id) => {
                    let (conductor, of) =
                        (&self.conductors()[id.index()], self.parts.dependence(id));
                    let ends = [conductor.from, conductor.to].map(|end| self.vertex(end));
                    // a constant conductor has no dependence, but its ends
                    let vertex =
                        |k: usize| of.vertices.get(k).map_or_else(|| ends[k], |&v| v as usize);
                    place(slots, of, &|k| temperatures[vertex(k)]);
                }
                Item::Source(id) => {
                    let of = &self.parts.source_dependence[id.index()];
                    name(slots, of, &|k| temperatures[of.vertices[k] as usize]);
                }
                _ => {}
            }
            let groups = |values: &[f64], ends| law.formula().groups(values, ends);
            At { slots, stack }.of_values::<{ Formula::MOST_FIELDS }, _>(law, groups)
        };
        result.map_err(|failed| self.failed(item, failed, scope))
    }
}
