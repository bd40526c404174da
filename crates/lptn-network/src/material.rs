//! Materials: capacities from masses and volumes.

use std::sync::Arc;

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::error::BuildErrorKind;
use crate::id::{Field, Item, MaterialId, NodeId};
use crate::network::Network;
use crate::value::{Input, Value};

/// A solid with its properties, each where it is known.
#[derive(Clone, Debug)]
pub struct Material {
    /// Its name; materials have a name space of their own.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Option<Value>,
    /// Thermal conductivity in W/(m K).
    pub k: Option<Value>,
    /// How it melts.
    pub melting: Option<Melting>,
    /// Where the numbers come from.
    pub source: Option<String>,
}

/// The properties of a material as the builder takes them.
#[derive(Clone, Debug, Default)]
pub struct Properties {
    /// Density.
    pub density: Option<Input>,
    /// Specific heat capacity.
    pub cp: Option<Input>,
    /// Thermal conductivity.
    pub k: Option<Input>,
    /// How it melts.
    pub melting: Option<Melting<Input>>,
    /// Where the numbers come from.
    pub source: Option<String>,
}

/// A change of phase: latent heat, taken up evenly from the solidus to the liquidus.
#[derive(Clone, Debug)]
pub struct Melting<T = Value> {
    /// Absolute temperature in K at which melting begins.
    pub solidus: T,
    /// Absolute temperature in K at which all is molten; not below the solidus, and equal to it for a pure substance.
    pub liquidus: T,
    /// Latent heat in J/kg.
    pub heat: T,
}

/// How much of a material there is.
#[derive(Clone, Debug)]
pub enum Size<T = Value> {
    /// By mass; in kg.
    Mass(T),
    /// By volume; in m^3.
    Volume(T),
}

/// A lump of a material, from which a capacity was computed.
#[derive(Clone, Debug)]
pub struct Lump {
    /// The material.
    pub material: MaterialId,
    /// How much of it.
    pub size: Size,
}

impl Size {
    pub(crate) fn field(&self) -> (Field, &Value) {
        match self {
            Self::Mass(mass) => (Field::Mass, mass),
            Self::Volume(volume) => (Field::Volume, volume),
        }
    }
}

impl NetworkBuilder {
    /// Adds a material.
    pub fn material(&mut self, name: &str, properties: Properties) -> MaterialId {
        let id = MaterialId::from_len(self.parts.materials.len());
        let mut value = |field, input: Option<Input>, dimension| {
            input.map(|input| self.typed((name, Item::Material(id), field), input, Type::of(dimension)))
        };
        let density = value(Field::Density, properties.density, Dimension::DENSITY);
        let cp = value(Field::SpecificHeat, properties.cp, Dimension::SPECIFIC_HEAT);
        let k = value(Field::Conductivity, properties.k, Dimension::CONDUCTIVITY);
        let melting = properties.melting.map(|m| {
            let mut value = |field, input, ty| self.typed((name, Item::Material(id), field), input, ty);
            Melting {
                solidus: value(Field::Solidus, m.solidus, Type::ABSOLUTE_TEMPERATURE),
                liquidus: value(Field::Liquidus, m.liquidus, Type::ABSOLUTE_TEMPERATURE),
                heat: value(Field::LatentHeat, m.heat, LATENT_HEAT),
            }
        });
        let source = properties.source;
        let material = Material { name: name.to_owned(), density, cp, k, melting, source };
        self.parts.materials.push(material);
        self.check_name(name, Item::Material(id));
        id
    }

    /// Says how much of a node is molten at its start, from 0 to 1; the start then has to be the one temperature at
    /// which it melts.
    pub fn molten(&mut self, node: NodeId, share: f64) {
        if !(0.0..=1.0).contains(&share) {
            let name = self.parts.nodes[node.index()].name.clone();
            let (item, field) = (Item::Node(node), Field::LatentHeat);
            self.error(&name, BuildErrorKind::NotAFraction { item, field, value: share });
        }
        self.parts.nodes[node.index()].molten = share;
    }

    /// The conductivity of a material, for a [`Path`](crate::Path) of conduction; it may depend on the
    /// temperature, which is then the mean of the ends.
    pub fn conductivity(&self, material: MaterialId) -> Option<Input> {
        let value = self.parts.materials[material.index()].k.clone()?;
        Some(Input { value, ty: Type::of(Dimension::CONDUCTIVITY), deviation: None, lump: None })
    }

    /// The capacity of a lump, `mass cp` or `volume density cp`, for a node or capacitor; `None` if the material
    /// lacks a property that this takes.
    pub fn lump(&self, material: MaterialId, size: Size<Input>) -> Option<Input> {
        let properties = &self.parts.materials[material.index()];
        let cp = properties.cp.clone()?;
        let (ty, factors, size) = match size {
            Size::Mass(mass) => {
                let ty = product(mass.ty, Dimension::SPECIFIC_HEAT)?;
                (ty, vec![mass.value.clone(), cp], Size::Mass(mass.value))
            }
            Size::Volume(volume) => {
                let ty = product(volume.ty, Dimension::VOLUMETRIC_HEAT_CAPACITY)?;
                let density = properties.density.clone()?;
                (ty, vec![volume.value.clone(), density, cp], Size::Volume(volume.value))
            }
        };
        let value = Value::Product(Arc::new(factors));
        Some(Input { value, ty, deviation: None, lump: Some(Lump { material, size }) })
    }
}

/// J/kg.
const LATENT_HEAT: Type = Type::of(Dimension::SPECIFIC_ENERGY);

fn product(ty: Type, dimension: Dimension) -> Option<Type> {
    ty.dimension.checked_mul(dimension).map(Type::of)
}

impl Network {
    /// The materials.
    pub fn materials(&self) -> &[Material] {
        &self.parts.materials
    }

    /// Ids of all materials.
    pub fn material_ids(&self) -> impl ExactSizeIterator<Item = MaterialId> + use<> {
        (0..self.parts.materials.len()).map(MaterialId::from_len)
    }

    /// The mass of a node with all its parts in kg; `None` if it has none, or the mass of a part is not known.
    pub fn mass(&self, id: NodeId) -> Option<f64> {
        let node = &self.nodes()[id.index()];
        let parts = self.capacitors().iter().filter(|part| part.node == id);
        let mut masses: Vec<Option<f64>> = parts.map(|part| self.lump_mass(part.lump.as_ref())).collect();
        if node.capacity.is_some() {
            masses.push(self.lump_mass(node.lump.as_ref()));
        }
        if masses.is_empty() { None } else { masses.into_iter().sum() }
    }

    /// The values were evaluated when the network was built, so they can be again.
    fn lump_mass(&self, lump: Option<&Lump>) -> Option<f64> {
        let Lump { material, size } = lump?;
        let mut scope = self.evaluation();
        match size {
            Size::Mass(mass) => mass.at(&mut scope).ok(),
            Size::Volume(volume) => {
                let density = self.materials()[material.index()].density.as_ref()?.at(&mut scope).ok()?;
                Some(density * volume.at(&mut scope).ok()?)
            }
        }
    }
}
