//! Properties of substances, lumps and limits, which have to be physical before anything is
//! computed from them.

use crate::enthalpy::is_one_temperature;
use crate::error::BuildErrorKind;
use crate::id::{CapacitorId, Field, FluidId, Item, LimitId, MaterialId, NodeId};
use crate::numbers::Work;
use crate::parts::element::Node;
use crate::parts::substance::Material;
use crate::value::Value;
use lptn_laws::Range;

/// pi/sqrt(12).
const CLOSE_PACKED: f64 = 0.906_899_682_117_109;

impl<'a> Work<'a> {
    pub(crate) fn check_materials(&mut self) {
        for (i, material) in self.parts.materials.iter().enumerate() {
            let item = Item::Material(MaterialId::from_len(i));
            self.check_winding(item, material);
            let properties = [
                (Field::SpecificHeat, &material.cp),
                (Field::Conductivity, &material.k),
                (Field::AxialConductivity, &material.k_axis),
            ];
            if let Some(value) = &material.density {
                self.constant(item, Field::Density, value, Range::Positive);
            }
            for (field, value) in properties {
                if let Some(value) = value {
                    self.property(item, field, value);
                }
            }
            if let Some(melting) = &material.melting {
                let solidus =
                    self.constant(item, Field::Solidus, &melting.solidus, Range::Temperature);
                let liquidus =
                    self.constant(item, Field::Liquidus, &melting.liquidus, Range::Temperature);
                self.constant(item, Field::LatentHeat, &melting.heat, Range::Positive);
                if liquidus < solidus && !is_one_temperature(solidus, liquidus) {
                    self.error(item, BuildErrorKind::Melting { item, solidus, liquidus });
                }
            }
        }
    }

    /// Round wires that touch each other in a hexagonal order fill pi/sqrt(12) of the volume.
    fn check_winding(&mut self, item: Item, material: &Material) {
        let Some(winding) = &material.winding else { return };
        let fill = self.constant(item, Field::Fill, &winding.fill, Range::Positive);
        let enamel =
            self.constant(item, Field::EnamelFill, &winding.enamel_fill, Range::NotNegative);
        if fill + enamel > CLOSE_PACKED {
            self.error(item, BuildErrorKind::Overfilled { item, share: fill + enamel });
        }
    }

    pub(crate) fn check_fluids(&mut self) {
        for (i, fluid) in self.parts.fluids.iter().enumerate() {
            let item = Item::Fluid(FluidId::from_len(i));
            let density = fluid.density.as_ref().map(|value| (Field::Density, value));
            let film = fluid.film.iter().map(|(field, value)| (*field, value));
            let all = density.into_iter().chain([(Field::SpecificHeat, &fluid.cp)]).chain(film);
            all.for_each(|(field, value)| self.property(item, field, value));
        }
    }

    /// A property may depend on `T`; it is then checked where it is used.
    pub(crate) fn property(&mut self, item: Item, field: Field, value: &Value) {
        if self.parts.reads(value).own {
            self.check_comparisons(item, field, value);
        } else {
            self.constant(item, field, value, Range::Positive);
        }
    }

    /// A product of two negative numbers would pass for a capacity.
    pub(crate) fn check_lumps(&mut self) {
        let parts = self.parts;
        let nodes = parts.nodes.iter().enumerate();
        let nodes = nodes.map(|(i, node)| (Item::Node(NodeId::from_len(i)), &node.lump));
        let capacitors = parts.capacitors.iter().enumerate();
        let capacitors =
            capacitors.map(|(i, part)| (Item::Capacitor(CapacitorId::from_len(i)), &part.lump));
        // the volume of a cell follows from the size of its grid, which is checked by itself
        let lumps = nodes.chain(capacitors).filter(|(item, _)| parts.whole(*item).is_none());
        let sizes = lumps.filter_map(|(item, lump)| Some((item, lump.as_ref()?.size.field())));
        let length = |(i, node): (usize, &'a Node)| {
            Some((
                Item::Node(NodeId::from_len(i)),
                (Field::CharacteristicLength, node.length.as_ref()?),
            ))
        };
        for (item, (field, value)) in sizes.chain(parts.nodes.iter().enumerate().filter_map(length))
        {
            self.constant(item, field, value, Range::Positive);
        }
    }

    /// Checks the values of limits, which are constant; the rest is checked with results.
    pub(crate) fn check_limits(&mut self) {
        let limits = self.parts.limits.iter().enumerate().filter(|(_, limit)| !limit.compares);
        for (i, limit) in limits {
            let item = Item::Limit(LimitId::from_len(i));
            let range = if limit.ty.absolute { Range::Temperature } else { Range::Finite };
            self.constant(item, limit.bound.field(), &limit.value, range);
        }
    }
}
