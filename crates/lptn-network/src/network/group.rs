//! Information that the laws of conductors and sources give: their range of validity, and results
//! in addition to their heat.

use crate::evaluation::Evaluation;
use lptn_laws::Formula;

use crate::id::{Item, LimitId};
use crate::input_error::InputError;
use crate::law::{At, Law};
use crate::network::Network;
use crate::network::flow::{name, place};
use crate::parts::heat::HeatOf;
use crate::value::Value;

impl Network {
    /// The law of a conductor or source; `None` of anything else.
    pub fn law(&self, item: Item) -> Option<&Law> {
        match item {
            Item::Conductor(id) => Some(&self.conductors()[id.index()].law),
            Item::Source(id) => Some(&self.sources()[id.index()].law),
            _ => None,
        }
    }

    /// The conductors and sources whose laws limit their range of validity by groups.
    pub fn ranged(&self) -> Vec<Item> {
        let items = self.conductor_ids().map(Item::Conductor);
        let items = items.chain(self.source_ids().map(Item::Source));
        let has = |law: &Law| !law.formula().declaration().groups.is_empty();
        items.filter(|item| self.law(*item).is_some_and(has)).collect()
    }

    /// The groups of a conductor's or source's law, in their order, at the time of `scope` and
    /// these temperatures of all vertices in K; `None` for a group that does not count there.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn groups(
        &self,
        item: Item,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<Option<f64>>, InputError> {
        self.of_law(item, scope, &|vertex| temperatures[vertex], Formula::groups)
    }

    /// The result of this key of the law of a conductor or source, in SI units at the state of
    /// `scope`, which needs temperatures: see [`Evaluation::set_temperatures`]. NaN if there is no
    /// such number.
    ///
    /// # Errors
    /// [`InputError`] if one of its values fails.
    pub fn told(&self, item: Item, key: &str, scope: &mut Evaluation) -> Result<f64, InputError> {
        let temperatures: Vec<f64> =
            scope.layout().temperatures().map(|slot| scope.slot(slot)).collect();
        let results = self.of_law(item, scope, &|vertex| temperatures[vertex], Formula::results)?;
        let declared = self.law(item).map_or(&[][..], |law| law.formula().result_declarations());
        let told = declared.iter().zip(results).find(|(result, _)| result.key == key);
        Ok(told.map(|(_, value)| value).filter(|value| value.is_finite()).unwrap_or(f64::NAN))
    }

    /// True if a limit can be judged at the state of `scope`, which needs temperatures. A limit of
    /// results without meaning there, such as the margin of gears without load, cannot.
    ///
    /// # Errors
    /// [`InputError`] if a value of a law fails.
    pub fn is_judged(&self, id: LimitId, scope: &mut Evaluation) -> Result<bool, InputError> {
        let sides = self.limits()[id.index()].sides();
        let slots: Vec<u32> = sides.into_iter().flat_map(Value::slots).collect();
        for (heat, slot) in self.parts.layout.heats() {
            let HeatOf::Told(item, _) = *heat else { continue };
            if !slots.contains(slot) {
                continue;
            }
            let temperatures: Vec<f64> =
                scope.layout().temperatures().map(|slot| scope.slot(slot)).collect();
            if !self.of_law(item, scope, &|vertex| temperatures[vertex], Formula::judges)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The results of the law of a conductor or source in addition to its heat.
    pub fn told_of(&self, item: Item) -> impl Iterator<Item = HeatOf> {
        self.parts.told_of(item)
    }

    /// A function of the values of a law and of its ends; for a source these are the hottest and
    /// the coldest of the nodes that it heats. The default value for an item without a law.
    fn of_law<R: Default>(
        &self,
        item: Item,
        scope: &mut Evaluation,
        temperature: &dyn Fn(usize) -> f64,
        function: fn(Formula, &[f64], [f64; 2]) -> R,
    ) -> Result<R, InputError> {
        let Some(law) = self.law(item) else { return Ok(R::default()) };
        let (slots, stack) = scope.plain();
        let mut heated = [f64::NAN; 2];
        match item {
            Item::Conductor(id) => {
                let (conductor, of) = (&self.conductors()[id.index()], self.parts.dependence(id));
                let ends = [conductor.from, conductor.to].map(|end| self.vertex(end));
                // a constant conductor has no dependence, but its ends
                let vertex = |k: usize| of.vertices.get(k).map_or_else(|| ends[k], |&v| v as usize);
                place(slots, &of, &|k| temperature(vertex(k)));
            }
            Item::Source(id) => {
                let of = &self.parts.source_dependence[id.index()];
                name(slots, of, &|k| temperature(of.vertices[k] as usize));
                let nodes = self.sources()[id.index()].into.iter();
                let nodes = nodes.map(|(node, _)| temperature(node.index()));
                heated = nodes.fold(heated, |[hot, cold], t| [t.max(hot), t.min(cold)]);
            }
            _ => {}
        }
        let of = |values: &[f64], ends| match item {
            Item::Source(_) => function(law.formula(), values, heated),
            _ => function(law.formula(), values, ends),
        };
        let result = At::new((slots, stack)).of_values::<{ Formula::MOST_FIELDS }, _>(law, of);
        result.map_err(|failed| self.failed(item, failed, scope))
    }
}
