//! Adds materials and fluids; capacities from masses and volumes.

use std::sync::Arc;

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::error::BuildErrorKind;
use crate::id::{Field, FluidId, Item, LawField, MaterialId, NodeId};
use crate::parts::substance::{Fluid, Material, Melting, Winding};
use crate::value::{Input, Lump, Size, Value};

/// The properties of a material as the builder takes them.
#[derive(Clone, Debug, Default)]
pub struct Properties {
    /// Density.
    pub density: Option<Input>,
    /// Specific heat capacity.
    pub cp: Option<Input>,
    /// Thermal conductivity; of layers in their plane, of wires across them.
    pub k: Option<Input>,
    /// Thermal conductivity along its axis, if it differs: across layers, along wires.
    pub k_axis: Option<Input>,
    /// The wires that it is made of, if it is a winding.
    pub winding: Option<Winding<Input>>,
    /// Its melting, if it melts.
    pub melting: Option<Melting<Input>>,
    /// Source of the numbers.
    pub source: Option<String>,
}

impl NetworkBuilder {
    /// Adds a material.
    pub fn material(&mut self, name: &str, properties: Properties) -> MaterialId {
        let id = MaterialId::from_len(self.parts.materials.len());
        let mut value = |field, input: Option<Input>, dimension| {
            input.map(|input| {
                self.typed((name, Item::Material(id), field), input, Type::of(dimension))
            })
        };
        let density = value(Field::Density, properties.density, Dimension::DENSITY);
        let cp = value(Field::SpecificHeat, properties.cp, Dimension::SPECIFIC_HEAT);
        let k = value(Field::Conductivity, properties.k, Dimension::CONDUCTIVITY);
        let k_axis = value(Field::AxialConductivity, properties.k_axis, Dimension::CONDUCTIVITY);
        let mut value = |field, input, ty| self.typed((name, Item::Material(id), field), input, ty);
        let winding = properties.winding.map(|w| Winding {
            fill: value(Field::Fill, w.fill, Type::SCALAR),
            enamel_fill: value(Field::EnamelFill, w.enamel_fill, Type::SCALAR),
            wire: w.wire,
            enamel: w.enamel,
            resin: w.resin,
        });
        let melting = properties.melting.map(|m| Melting {
            solidus: value(Field::Solidus, m.solidus, Type::ABSOLUTE_TEMPERATURE),
            liquidus: value(Field::Liquidus, m.liquidus, Type::ABSOLUTE_TEMPERATURE),
            heat: value(Field::LatentHeat, m.heat, LATENT_HEAT),
        });
        let source = properties.source;
        let name_of = name.to_owned();
        let material = Material { name: name_of, density, cp, k, k_axis, winding, melting, source };
        self.parts.materials.push(material);
        self.check_name(name, Item::Material(id));
        id
    }

    /// Says how much of a node is molten at its start, from 0 to 1; the start then has to be the
    /// one temperature at which it melts.
    pub fn molten(&mut self, node: NodeId, share: f64) {
        if !(0.0..=1.0).contains(&share) {
            let name = self.parts.nodes[node.index()].name.clone();
            let (item, field) = (Item::Node(node), Field::LatentHeat);
            self.error(&name, BuildErrorKind::NotAFraction { item, field, value: share });
        }
        self.parts.nodes[node.index()].body_mut().molten = share;
    }

    /// A material with its properties.
    pub fn properties_of(&self, material: MaterialId) -> &Material {
        &self.parts.materials[material.index()]
    }

    /// The conductivity of a material along its axis, if it differs, as
    /// [`NetworkBuilder::conductivity`].
    pub fn axial_conductivity(&self, material: MaterialId) -> Option<Input> {
        let value = self.parts.materials[material.index()].k_axis.clone()?;
        Some(Input { value, ty: Type::of(Dimension::CONDUCTIVITY), deviation: None, lump: None })
    }

    /// The conductivity of a material, for a [`Path`](crate::Path) of conduction; if it depends on
    /// the temperature, its mean between the ends counts.
    pub fn conductivity(&self, material: MaterialId) -> Option<Input> {
        let value = self.parts.materials[material.index()].k.clone()?;
        Some(Input { value, ty: Type::of(Dimension::CONDUCTIVITY), deviation: None, lump: None })
    }

    /// The capacity of a lump, `mass cp` or `volume density cp`, for a node or capacitor; `None` if
    /// the material lacks a property that this takes.
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
        let density = density
            .map(|input| self.typed(at(Field::Density), input, Type::of(Dimension::DENSITY)));
        let cp = self.typed(at(Field::SpecificHeat), cp.into(), Type::of(Dimension::SPECIFIC_HEAT));
        let film = Vec::new();
        self.parts.fluids.push(Fluid { name: name.to_owned(), density, cp, film, source });
        self.check_name(name, Item::Fluid(id));
        id
    }

    /// Gives a fluid a property that films of it take, a field of their laws; it may depend on `T`.
    pub fn film_property(&mut self, fluid: FluidId, property: LawField, value: Input) {
        let name = self.parts.fluids[fluid.index()].name.clone();
        let field = Field::Law(property);
        let value = self.typed((&name, Item::Fluid(fluid), field), value, property.ty);
        self.parts.fluids[fluid.index()].film.push((field, value));
    }

    /// The property of a fluid for a [`Path`](crate::Path) whose law takes it; it may depend on the
    /// temperature, which is then the mean of the ends. `None` if it is not known.
    pub fn property_of(&self, fluid: FluidId, property: LawField) -> Option<Input> {
        let value = self.parts.fluids[fluid.index()].film_property(property.key)?.clone();
        Some(Input { value, ty: property.ty, deviation: None, lump: None })
    }
}

/// Why a node has not one material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoMaterial {
    /// Its capacity is given as a number.
    Unnamed,
    /// Its parts are of several materials.
    Several,
}

impl NetworkBuilder {
    /// Gives a node its characteristic length, volume over surface, so that it can be checked for
    /// being a lump.
    pub fn length(&mut self, node: NodeId, length: impl Into<Input>) {
        let name = self.parts.nodes[node.index()].name.clone();
        let at = (name.as_str(), Item::Node(node), Field::CharacteristicLength);
        let length = self.typed(at, length.into(), Type::of(Dimension::LENGTH));
        self.parts.nodes[node.index()].body_mut().length = Some(length);
    }
}
