//! Fluids: what streams are made of.

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::id::{Field, FluidId, Item};
use crate::network::Network;
use crate::value::{Input, Value};

/// A fluid with its properties, constant or depending on its own temperature `T`.
#[derive(Clone, Debug)]
pub struct Fluid {
    /// Its name; fluids have a name space of their own.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Value,
    /// Where the numbers come from.
    pub source: Option<String>,
}

impl NetworkBuilder {
    /// Adds a fluid.
    pub fn fluid(
        &mut self,
        name: &str,
        density: Option<Input>,
        cp: impl Into<Input>,
        source: Option<String>,
    ) -> FluidId {
        let id = FluidId::from_len(self.parts.fluids.len());
        let at = |field| (name, Item::Fluid(id), field);
        let density =
            density.map(|input| self.typed(at(Field::Density), input, Type::of(Dimension::DENSITY)));
        let cp = self.typed(at(Field::SpecificHeat), cp.into(), Type::of(Dimension::SPECIFIC_HEAT));
        self.parts.fluids.push(Fluid { name: name.to_owned(), density, cp, source });
        self.check_name(name, Item::Fluid(id));
        id
    }
}

impl Network {
    /// The fluids.
    pub fn fluids(&self) -> &[Fluid] {
        &self.parts.fluids
    }

    /// Ids of all fluids.
    pub fn fluid_ids(&self) -> impl ExactSizeIterator<Item = FluidId> + use<> {
        (0..self.parts.fluids.len()).map(FluidId::from_len)
    }
}
