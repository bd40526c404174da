//! Changes of the heat flows of elements with the values of their laws.

use lptn_laws::Formula;

use crate::evaluation::{Evaluation, PASS, Slope};
use crate::id::{ConductorId, Item, SourceId};
use crate::input_error::InputError;
use crate::law::{At, Law, Received};
use crate::network::Network;
use crate::network::flow::{Failed, name, place};

/// More fields than any law has.
const MOST: usize = Formula::MOST_FIELDS;

/// One value of a law, and the change of heat with it in W: `v dq/dv`, a hundred times the change
/// for 1 %; for an absolute temperature `dq/dv`, in W/K, and for a value of 0 in W per SI unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueChange<H> {
    /// The value in SI units.
    pub value: f64,
    /// The change of the heat.
    pub heat: H,
}

impl Network {
    /// Change of the heat that the two ends of a conductor receive with each value of its law, in
    /// their order, at the time of `scope` and these temperatures of all vertices in K.
    ///
    /// # Errors
    /// As [`Network::exchange`].
    pub fn exchange_by_values(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<ValueChange<Received>>, InputError> {
        let conductor = &self.conductors()[id.index()];
        let dependence = &self.parts.conductor_dependence(conductor);
        let at = |k: usize| Slope::constant(temperatures[dependence.vertices[k] as usize]);
        let mut changes = Vec::new();
        for first in (0..conductor.law.values().len()).step_by(PASS) {
            let result = {
                let (slots, stack) = scope.dual();
                place(slots, dependence, &at);
                let mut here = At::path((slots, stack), self.along(id));
                seeded(&mut here, &conductor.law, first).and_then(|(own, value)| {
                    let heat = self.received_of((&conductor.law, value), here, at(0), at(1))?;
                    Ok((own, heat))
                })
            };
            let (own, [from, to]) =
                result.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))?;
            let heats = from.derivatives.into_iter().zip(to.derivatives);
            let pairs = own.into_iter().zip(heats);
            changes.extend(pairs.map(|(value, (a, b))| ValueChange { value, heat: [a, b] }));
        }
        Ok(changes)
    }

    /// The same for the heat of a source.
    ///
    /// # Errors
    /// As [`Network::source_heat`].
    pub fn source_by_values(
        &self,
        id: SourceId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<ValueChange<f64>>, InputError> {
        let law = &self.sources()[id.index()].law;
        let dependence = &self.parts.source_dependence[id.index()];
        let at = |k: usize| Slope::constant(temperatures[dependence.vertices[k] as usize]);
        let mut changes = Vec::new();
        for first in (0..law.values().len()).step_by(PASS) {
            let result = {
                let (slots, stack) = scope.dual();
                name(slots, dependence, &at);
                seeded(&mut At::new((slots, stack)), law, first)
            };
            let (own, heat) =
                result.map_err(|failed| self.failed(Item::Source(id), failed, scope))?;
            let pairs = own.into_iter().zip(heat.derivatives);
            changes.extend(pairs.map(|(value, heat)| ValueChange { value, heat }));
        }
        Ok(changes)
    }

    /// Change in W/K of the heat that the two ends of a conductor of any kind receive with the
    /// temperature of each vertex that it depends on.
    ///
    /// # Errors
    /// As [`Network::exchange`].
    pub fn exchange_by_temperatures(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Vec<(usize, Received)>, InputError> {
        let dependence = self.parts.conductor_dependence(&self.conductors()[id.index()]);
        let mut slopes = Vec::new();
        self.slopes_by((id, &dependence), scope, temperatures, &mut slopes)?;
        Ok(dependence.vertices.iter().map(|&vertex| vertex as usize).zip(slopes).collect())
    }
}

/// Some values of a law from `first` on, and the value of the law with derivatives by them.
fn seeded(at: &mut At<'_, Slope>, law: &Law, first: usize) -> Result<(Vec<f64>, Slope), Failed> {
    let fields = law.formula().declaration().fields;
    at.of_values::<MOST, _>(law, |values, ends| {
        let mut values = values.to_vec();
        let mut own = Vec::new();
        let mine = values.iter_mut().zip(fields).enumerate().skip(first).take(PASS);
        for (k, (value, field)) in mine {
            own.push(value.value);
            *value = match field.ty.absolute || value.value.abs() <= 0.0 {
                true => *value + Slope::variable(0.0, k - first),
                false => *value * Slope::variable(1.0, k - first),
            };
        }
        let of_law = match law.formula() {
            Formula::Given => values[0],
            formula => formula.value(&values, ends),
        };
        (own, of_law)
    })
}
