//! `[material]` and `[fluid]`: those of the file that are used.

use std::collections::BTreeSet;
use std::sync::Arc;

use lptn_network::{Field, Fluid, FluidId, Item, Lump, Material, MaterialId, Value, Winding};
use lptn_units::{Dimension, LookupTable, TableSymbol, Type};

use super::Writer;
use super::values::over_temperature;
use crate::library;
use crate::texture::Texture;
use crate::toml_text::{TomlFields, quantity, value};

impl Writer<'_> {
    pub(super) fn materials(&mut self) {
        let (network, mut section) = (&self.network, TomlFields::default());
        let used = self.used_materials();
        for (id, material) in network.material_ids().zip(network.materials()) {
            let source = material.source.as_deref();
            let shipped = library::find(&material.name)
                .is_some_and(|record| Some(record.source.as_str()) == source);
            if shipped || !used.contains(&id) {
                continue;
            }
            let mut fields = TomlFields::default();
            if let Some(winding) = &material.winding {
                fields.put("winding", parts(winding));
                source.into_iter().for_each(|source| fields.word("source", source));
                section.put(&material.name, fields.inline());
                continue;
            }
            let properties = [
                ("density", &material.density, Dimension::DENSITY),
                ("cp", &material.cp, Dimension::SPECIFIC_HEAT),
                ("k", &material.k, Dimension::CONDUCTIVITY),
                ("k_through", &material.k_axis, Dimension::CONDUCTIVITY),
            ];
            for (key, property, dimension) in properties {
                if let Some(property) = property {
                    fields.put(key, self.property(property, key, Type::of(dimension)));
                }
            }
            if let Some(melting) = &material.melting {
                fields.put("solidus", value(&melting.solidus, Type::ABSOLUTE_TEMPERATURE));
                fields.put("liquidus", value(&melting.liquidus, Type::ABSOLUTE_TEMPERATURE));
                fields
                    .put("latent_heat", value(&melting.heat, Type::of(Dimension::SPECIFIC_ENERGY)));
            }
            if let Some(source) = source {
                fields.word("source", source);
            }
            section.put(&material.name, fields.inline());
        }
        self.section("material", &section);
    }

    pub(super) fn fluids(&mut self) {
        let (network, mut section) = (&self.network, TomlFields::default());
        let streams = network.conductors().iter().filter_map(|conductor| conductor.law.fluid());
        let films = self.properties_of_paths().into_iter().filter_map(|item| match item {
            Item::Fluid(id) => Some(id),
            _ => None,
        });
        let mut used: BTreeSet<_> = streams.chain(films).collect();
        used.extend(network.fluid_ids().filter(|id| {
            let fluid = &network.fluids()[id.index()];
            self.is_called(&fluid.name, of_fluid(fluid))
        }));
        for (id, fluid) in network.fluid_ids().zip(network.fluids()) {
            let source = fluid.source.as_deref();
            let shipped = library::fluids()
                .iter()
                .any(|record| record.name == fluid.name && Some(record.source.as_str()) == source);
            if shipped || !used.contains(&id) {
                continue;
            }
            let mut fields = TomlFields::default();
            if let Some(density) = &fluid.density {
                fields.put(
                    "density",
                    self.property(density, "density", Type::of(Dimension::DENSITY)),
                );
            }
            fields.put("cp", self.property(&fluid.cp, "cp", Type::of(Dimension::SPECIFIC_HEAT)));
            for (field, value) in &fluid.film {
                let Field::Law(declared) = field else { continue };
                fields.put(field.key(), self.property(value, field.key(), declared.ty));
            }
            if let Some(source) = source {
                fields.word("source", source);
            }
            section.put(&fluid.name, fields.inline());
        }
        self.section("fluid", &section);
    }

    /// A constant, an expression in `T`, or a table over it.
    fn property(&self, property: &Value, key: &str, ty: Type) -> String {
        if let Value::Expression(program) = property
            && program.text() == format!("{key}(T)")
            && let [call] = program.table_calls()
            && self.name_of_table(&call.table).is_none()
            && let LookupTable::One(table) = &*call.table
        {
            return over_temperature(table, ty);
        }
        match property {
            Value::Constant(number) => quantity(*number, ty),
            other => value(other, ty),
        }
    }

    fn used_materials(&self) -> BTreeSet<MaterialId> {
        let network = &self.network;
        let nodes = network.nodes().iter().map(|node| &node.lump);
        let lumps = nodes.chain(network.capacitors().iter().map(|capacitor| &capacitor.lump));
        let lumps = lumps.flatten().map(|Lump { material, .. }| *material);
        let bodies = self.properties_of_paths().into_iter().filter_map(|item| match item {
            Item::Material(id) => Some(id),
            _ => None,
        });
        let called = network.material_ids().filter(|id| {
            let material = &network.materials()[id.index()];
            self.is_called(&material.name, of_material(material))
        });
        let used: BTreeSet<MaterialId> = lumps.chain(bodies).chain(called).collect();
        let windings =
            used.iter().filter_map(|id| network.materials()[id.index()].winding.as_ref());
        let names = windings.flat_map(|of| [&of.wire, &of.resin].into_iter().chain(&of.enamel));
        let names: BTreeSet<&String> = names.collect();
        let parts = network.material_ids().zip(network.materials());
        let parts = parts.filter(|(_, material)| names.contains(&material.name)).map(|(id, _)| id);
        used.iter().copied().chain(parts).collect()
    }

    /// The direction of a path whose conductivity is this of a material of layers or wires.
    pub(super) fn direction(&self, of: Item, value: &Value) -> Option<&'static str> {
        let (Item::Material(id), Value::Expression(own)) = (of, value) else { return None };
        let material = &self.network.materials()[id.index()];
        let axial = material.k_axis.as_ref()?;
        let texture = if material.winding.is_some() { Texture::Wires } else { Texture::Layers };
        let same = matches!(axial, Value::Expression(other) if Arc::ptr_eq(own, other));
        texture.word(same)
    }

    /// True if an expression calls a property of the fluid or material of this name.
    fn is_called<'v>(&self, name: &str, properties: impl Iterator<Item = &'v Value>) -> bool {
        let own: Vec<&LookupTable> = properties.filter_map(table_of).collect();
        let mut tables = self.network.tables();
        tables.any(|(call, symbol)| {
            let of = call.rsplit_once('.').is_some_and(|(base, _)| base == name);
            of && own.contains(&&*symbol.table)
        })
    }

    /// True if a table of the network is a property of a fluid or material, which expressions call.
    pub(super) fn is_property(&self, call: &str, symbol: &TableSymbol) -> bool {
        let Some((name, key)) = call.rsplit_once('.') else { return false };
        let network = &self.network;
        let is = |table: &LookupTable| *table == *symbol.table;
        let own = |property: &Value| table_of(property).is_some_and(is);
        let shipped = library::find(name).into_iter().flat_map(|record| &record.film);
        let mut shipped = shipped.filter(|(own, _)| own == key);
        shipped.any(|(_, table)| is(&LookupTable::One(table.clone())))
            || network.fluids().iter().any(|f| f.name == name && of_fluid(f).any(own))
            || network.materials().iter().any(|m| m.name == name && of_material(m).any(own))
    }

    /// The materials and fluids whose properties paths use.
    fn properties_of_paths(&self) -> BTreeSet<Item> {
        let properties = self.network.conductors().iter().flat_map(|conductor| {
            let fields = conductor.law.formula().declaration().fields.iter();
            fields.zip(conductor.law.values()).filter(|(field, _)| field.property.is_some())
        });
        properties.filter_map(|(_, value)| self.substance_of(value)).collect()
    }

    /// The material or fluid of this property; `None` for a constant.
    pub(super) fn substance_of(&self, property: &Value) -> Option<Item> {
        let Value::Expression(program) = property else { return None };
        let network = &self.network;
        let same = |own: &Value| matches!(own, Value::Expression(own) if Arc::ptr_eq(own, program));
        let material = |id: &MaterialId| {
            let material = &network.materials()[id.index()];
            material.k.iter().chain(&material.k_axis).any(same)
        };
        let fluid = |id: &FluidId| of_fluid(&network.fluids()[id.index()]).any(same);
        let material = network.material_ids().find(material).map(Item::Material);
        material.or_else(|| network.fluid_ids().find(fluid).map(Item::Fluid))
    }
}

/// The properties of a fluid.
fn of_fluid(fluid: &Fluid) -> impl Iterator<Item = &Value> {
    let film = fluid.film.iter().map(|(_, value)| value);
    film.chain(&fluid.density).chain([&fluid.cp])
}

/// The properties of a material that may depend on temperature.
fn of_material(material: &Material) -> impl Iterator<Item = &Value> {
    material.cp.iter().chain(&material.k).chain(&material.k_axis)
}

/// The table of a property that is one over its own temperature.
fn table_of(property: &Value) -> Option<&LookupTable> {
    let Value::Expression(program) = property else { return None };
    program.table_calls().first().map(|call| &*call.table)
}

/// The parts of a winding.
fn parts(winding: &Winding) -> String {
    let mut fields = TomlFields::default();
    fields.put("fill", value(&winding.fill, Type::SCALAR));
    fields.word("wire", &winding.wire);
    fields.word("resin", &winding.resin);
    if let Some(enamel) = &winding.enamel {
        fields.word("enamel", enamel);
        fields.put("enamel_fill", value(&winding.enamel_fill, Type::SCALAR));
    }
    fields.inline()
}
