//! A node as a body: its length, its material, the surfaces through which it gives off heat.

use crate::builder::substance::NoMaterial;
use crate::evaluation::Evaluation;
use crate::id::{ConductorId, Field, Item, MaterialId, NodeId};
use crate::input_error::{InputError, InputProblem};
use crate::law::{At, Law};
use crate::network::Network;
use crate::network::flow::place;
use crate::slot;
use crate::value::Value;

/// A surface that gives off heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Its conductance in W/K, that of radiation at the temperatures of both ends; not negative.
    pub conductance: f64,
    /// Its area in m^2, that of radiation times the view factor; `None` if it is not given.
    pub area: Option<f64>,
}

impl Network {
    /// The characteristic length of a node in m, volume over surface; `None` if it was not given.
    pub fn length(&self, id: NodeId) -> Option<f64> {
        match self.nodes()[id.index()].length.as_ref()? {
            Value::Constant(length) => Some(*length),
            value => value.at(&mut self.evaluation()).ok(),
        }
    }

    /// The one material that a node with all its parts is made of.
    ///
    /// # Errors
    /// [`NoMaterial`] if a part has none, or another one.
    pub fn material_of(&self, id: NodeId) -> Result<MaterialId, NoMaterial> {
        let node = &self.nodes()[id.index()];
        let own = node.capacity.iter().map(|_| node.lump.as_ref());
        let parts =
            self.capacitors().iter().filter(|part| part.node == id).map(|part| part.lump.as_ref());
        let materials: Option<Vec<MaterialId>> =
            own.chain(parts).map(|lump| lump.map(|lump| lump.material)).collect();
        match materials.as_deref() {
            Some([first, others @ ..]) if others.iter().all(|other| other == first) => Ok(*first),
            Some([_, ..]) => Err(NoMaterial::Several),
            _ => Err(NoMaterial::Unnamed),
        }
    }

    /// Density in kg/m^3, specific heat in J/(kg K) or conductivity in W/(m K) of a material at a
    /// temperature in K, the least if it depends on the direction; `None` if it is not known. `scope` is any [`Network::evaluation`].
    pub fn property(
        &self,
        (id, field): (MaterialId, Field),
        temperature: f64,
        scope: &mut Evaluation,
    ) -> Option<f64> {
        let material = &self.materials()[id.index()];
        let value = match field {
            Field::Density => material.density.as_ref(),
            Field::SpecificHeat => material.cp.as_ref(),
            Field::Conductivity => material.k.as_ref(),
            _ => None,
        };
        let found = self.property_of(value?, temperature, scope)?;
        let axial = material.k_axis.as_ref().filter(|_| field == Field::Conductivity);
        let axial = axial.and_then(|value| self.property_of(value, temperature, scope));
        Some(axial.map_or(found, |axial| found.min(axial)))
    }

    /// A value that may depend on its own temperature, at that temperature in K, in SI units;
    /// `None` unless it is known and positive. `scope` is any [`Network::evaluation`].
    pub fn property_of(
        &self,
        value: &Value,
        temperature: f64,
        scope: &mut Evaluation,
    ) -> Option<f64> {
        scope.set(slot::OWN, temperature);
        value.at(scope).ok().filter(|value| value.is_finite() && *value > 0.0)
    }

    /// The surface that a convection, contact or radiation is, at the time of `scope` and these
    /// temperatures of all vertices in K; `None` for any other conductor.
    ///
    /// # Errors
    /// [`InputError`] if a value fails, or is one that its field cannot have.
    pub fn surface(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Option<Surface>, InputError> {
        let conductor = &self.conductors()[id.index()];
        if conductor.kind.declaration().surface.is_none() {
            return Ok(None);
        }
        let dependence = self.parts.dependence(id);
        let ends = [conductor.from, conductor.to].map(|end| temperatures[self.vertex(end)]);
        let at = |k: usize| match ends.get(k) {
            Some(end) => *end,
            None => temperatures[dependence.vertices[k] as usize],
        };
        let result = {
            let (slots, stack) = scope.plain();
            place(slots, &dependence, &at);
            surface(&conductor.law, At::new((slots, stack)))
        };
        result.map(Some).map_err(|failed| self.failed(Item::Conductor(id), failed, scope))
    }
}

fn surface(law: &Law, mut at: At<'_, f64>) -> Result<Surface, (Field, InputProblem)> {
    let conductance = at.conductance(law)?;
    let declared = law.formula().declaration();
    let mut area = (!declared.area.is_empty()).then_some(1.0);
    for (i, field) in declared.fields.iter().enumerate() {
        if let Some(product) = area.as_mut().filter(|_| declared.area.contains(&field.key)) {
            *product *= at.get(law, i)?;
        }
    }
    if conductance.is_finite() && conductance >= 0.0 {
        return Ok(Surface { conductance, area });
    }
    Err((Field::law(law.formula(), 0), InputProblem::NegativeConductance(conductance)))
}
