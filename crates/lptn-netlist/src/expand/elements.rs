//! Nodes, and everything that stands between and on them.

use lptn_network::{
    Bound, Conductor, ConductorKind, Emissivity, Exchange, Field, Item, Law, Lump, Severity, Shape, Size,
    Stream, Value,
};
use lptn_units::{Dimension, Type, format_number};

use super::Writer;
use super::text::{Fields, like, string, value};

const KINDS: [(&str, ConductorKind); 6] = [
    ("resistor", ConductorKind::Resistor),
    ("conduction", ConductorKind::Conduction),
    ("convection", ConductorKind::Convection),
    ("contact", ConductorKind::Contact),
    ("radiation", ConductorKind::Radiation),
    ("advection", ConductorKind::Advection),
];

impl Writer<'_> {
    pub(super) fn nodes(&mut self) {
        let mut section = Fields::default();
        for node in self.network.nodes() {
            let mut fields = Fields::default();
            self.capacity(&mut fields, node.capacity.as_ref(), node.lump.as_ref());
            if node.massless {
                fields.put("massless", "true");
            } else if let Some(initial) = &node.initial {
                fields.put("T0", value(initial, Type::ABSOLUTE_TEMPERATURE));
            }
            if let Some(length) = &node.length {
                fields.put("L_char", value(length, Type::of(Dimension::LENGTH)));
            }
            section.put(&node.name, fields.inline());
        }
        self.section("node", &section);
    }

    /// `C`, or what the lump is made of.
    fn capacity(&self, fields: &mut Fields, capacity: Option<&Value>, lump: Option<&Lump>) {
        if let Some(Lump { material, size }) = lump {
            fields.word("material", &self.name(Item::Material(*material)));
            match size {
                Size::Mass(mass) => fields.put("mass", value(mass, Type::of(Dimension::MASS))),
                Size::Volume(volume) => fields.put("volume", value(volume, Type::of(Dimension::VOLUME))),
            }
        } else if let Some(capacity) = capacity {
            fields.put("C", value(capacity, Type::of(Dimension::CAPACITY)));
        }
    }

    pub(super) fn capacitors(&mut self) {
        let mut section = Fields::default();
        for capacitor in self.network.capacitors() {
            let mut fields = Fields::default();
            fields.word("node", &self.name(Item::Node(capacitor.node)));
            self.capacity(&mut fields, Some(&capacitor.capacity), capacitor.lump.as_ref());
            section.put(&capacitor.name, fields.inline());
        }
        self.section("capacitor", &section);
    }

    pub(super) fn boundaries(&mut self) {
        let mut section = Fields::default();
        for boundary in self.network.boundaries() {
            let mut fields = Fields::default();
            fields.put("T", value(&boundary.temperature, Type::ABSOLUTE_TEMPERATURE));
            section.put(&boundary.name, fields.inline());
        }
        self.section("boundary", &section);
    }

    pub(super) fn conductors(&mut self) {
        for (heading, kind) in KINDS {
            let mut section = Fields::default();
            let conductors = self.network.conductors().iter();
            for conductor in conductors.filter(|conductor| conductor.kind == kind) {
                section.put(&conductor.name(), self.conductor(conductor));
            }
            self.section(heading, &section);
        }
    }

    fn conductor(&self, conductor: &Conductor) -> String {
        let mut fields = Fields::default();
        fields.word("from", &self.name(conductor.from));
        fields.word("to", &self.name(conductor.to));
        match &conductor.law {
            Law::Conduction { conductivity, shape } => {
                match self.material_of(conductivity) {
                    Some(material) => fields.word("material", &self.name(Item::Material(material))),
                    None => fields.put("k", value(conductivity, Type::of(Dimension::CONDUCTIVITY))),
                }
                fields.word("shape", name_of(shape));
                put_all(&mut fields, shape.parts(), None);
            }
            law @ Law::Radiation(exchange) => {
                let Exchange::Surfaces { emissivity, area, view_factor } = &**exchange else {
                    put_all(&mut fields, law.parts(), None);
                    return fields.inline();
                };
                let emissivity = match emissivity {
                    Emissivity::Effective(emissivity) => value(emissivity, Type::SCALAR),
                    Emissivity::Plates(a, b) => {
                        format!("[{}, {}]", value(a, Type::SCALAR), value(b, Type::SCALAR))
                    }
                };
                fields.put("emissivity", emissivity);
                fields.put("area", value(area, Type::of(Dimension::AREA)));
                fields.put("view_factor", value(view_factor, Type::SCALAR));
            }
            law @ Law::Advection(stream) => {
                if let Some(fluid) = stream.fluid() {
                    fields.word("fluid", &self.name(Item::Fluid(fluid)));
                }
                put_all(&mut fields, law.parts(), Some(stream));
            }
            law => put_all(&mut fields, law.parts(), None),
        }
        fields.inline()
    }

    pub(super) fn sources(&mut self) {
        let mut section = Fields::default();
        for source in self.network.sources() {
            let mut fields = Fields::default();
            match source.into.as_slice() {
                [(node, _)] => fields.word("into", &self.name(Item::Node(*node))),
                nodes => {
                    let mut into = Fields::default();
                    for (node, share) in nodes {
                        into.put(&self.name(Item::Node(*node)), format_number(*share));
                    }
                    fields.put("into", into.inline());
                }
            }
            fields.put("P", value(&source.power, Type::of(Dimension::POWER)));
            section.put(&source.name(), fields.inline());
        }
        self.section("source", &section);
    }

    pub(super) fn limits(&mut self) {
        let mut section = Fields::default();
        for limit in self.network.limits() {
            let mut fields = Fields::default();
            fields.put("of", string(&limit.text));
            let bound = match limit.bound {
                Bound::Below => "below",
                Bound::Above => "above",
            };
            fields.put(bound, like(&limit.value, limit.ty));
            if limit.severity == Severity::Warning {
                fields.word("severity", "warning");
            }
            section.put(&limit.name, fields.inline());
        }
        self.section("limit", &section);
    }
}

fn put_all(fields: &mut Fields, parts: Vec<(Field, &Value)>, stream: Option<&Stream>) {
    for (field, part) in parts {
        fields.put(field.key(), value(part, type_of(field, stream)));
    }
}

fn type_of(field: Field, stream: Option<&Stream>) -> Type {
    Type::of(match field {
        Field::Resistance => Dimension::RESISTANCE,
        Field::Conductance | Field::StreamCapacity => Dimension::CONDUCTANCE,
        Field::FilmCoefficient => Dimension::FILM_COEFFICIENT,
        Field::Area | Field::Exchange => Dimension::AREA,
        Field::Emissivity | Field::ViewFactor => Dimension::NONE,
        Field::FlowTemperature => return Type::ABSOLUTE_TEMPERATURE,
        Field::Flow if matches!(stream, Some(Stream::Volume { .. })) => Dimension::VOLUME_FLOW,
        Field::Flow => Dimension::MASS_FLOW,
        _ => Dimension::LENGTH,
    })
}

fn name_of(shape: &Shape) -> &'static str {
    match shape {
        Shape::Slab { .. } => "slab",
        Shape::Cylinder { .. } => "cylinder",
        Shape::Sphere { .. } => "sphere",
        Shape::Rod { .. } => "rod",
    }
}
