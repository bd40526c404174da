//! Nodes, and all elements between and on them.

use lptn_laws::Kind;
use lptn_network::{
    Bound, Conductor, End, Item, Law, Limit, LimitSeverity, Lump, Size, Source, Value,
};
use lptn_units::{Dimension, Type, format_number};

use super::Writer;
use crate::toml_text::{TomlFields, like, string, value};

impl Writer<'_> {
    pub(super) fn nodes(&mut self) {
        let mut section = TomlFields::default();
        for id in self.network.thermal_nodes().filter(|id| self.network.pipe_at(*id).is_none()) {
            let node = &self.network.nodes()[id.index()];
            let mut fields = TomlFields::default();
            self.capacity(&mut fields, node.capacity.as_ref(), node.lump.as_ref());
            if node.massless {
                fields.put("massless", "true");
            }
            if let Some(initial) = &node.initial {
                fields.put("T0", value(initial, Type::ABSOLUTE_TEMPERATURE));
            }
            if let Some(length) = &node.length {
                fields.put("L_char", value(length, Type::of(Dimension::LENGTH)));
            }
            section.put(&node.name, fields.inline());
        }
        self.section("node", &section);
    }

    /// `C`, or material and size of the lump.
    fn capacity(&self, fields: &mut TomlFields, capacity: Option<&Value>, lump: Option<&Lump>) {
        if let Some(Lump { material, size }) = lump {
            fields.word("material", &self.name(Item::Material(*material)));
            match size {
                Size::Mass(mass) => fields.put("mass", value(mass, Type::of(Dimension::MASS))),
                Size::Volume(volume) => {
                    fields.put("volume", value(volume, Type::of(Dimension::VOLUME)))
                }
            }
        } else if let Some(capacity) = capacity {
            fields.put("C", value(capacity, Type::of(Dimension::CAPACITY)));
        }
    }

    pub(super) fn capacitors(&mut self) {
        let mut section = TomlFields::default();
        for capacitor in self.network.capacitors() {
            let mut fields = TomlFields::default();
            fields.word("node", &self.name(Item::Node(capacitor.node)));
            self.capacity(&mut fields, Some(&capacitor.capacity), capacitor.lump.as_ref());
            section.put(&capacitor.name, fields.inline());
        }
        self.section("capacitor", &section);
    }

    pub(super) fn boundaries(&mut self) {
        let mut section = TomlFields::default();
        for boundary in self.network.boundaries() {
            let mut fields = TomlFields::default();
            fields.put("T", value(&boundary.temperature, Type::ABSOLUTE_TEMPERATURE));
            section.put(&boundary.name, fields.inline());
        }
        self.section("boundary", &section);
    }

    /// Paths and sources.
    pub(super) fn conductors(&mut self) {
        for kind in Kind::ALL {
            let mut section = TomlFields::default();
            let conductors = self.network.conductors().iter();
            let conductors = conductors.filter(|conductor| !self.is_of_pipe(conductor));
            for conductor in conductors.filter(|conductor| conductor.kind == *kind) {
                section.put(&conductor.name(), self.conductor(conductor));
            }
            let network = self.network;
            let sources = network.heat_sources().map(|id| &network.sources()[id.index()]);
            for source in sources.filter(|source| source.kind == *kind) {
                section.put(&source.name(), self.source(source));
            }
            self.section(kind.declaration().section, &section);
        }
    }

    /// True for the streams into and out of a pipe.
    fn is_of_pipe(&self, conductor: &Conductor) -> bool {
        let is_pipe = |end| match end {
            End::Node(node) => self.network.pipe_at(node).is_some(),
            End::Boundary(_) => false,
        };
        is_pipe(conductor.from) || is_pipe(conductor.to)
    }

    fn conductor(&self, conductor: &Conductor) -> String {
        let mut fields = TomlFields::default();
        fields.word("from", &self.name(conductor.from));
        fields.word("to", &self.name(conductor.to));
        self.law(&mut fields, conductor.kind, &conductor.law);
        fields.inline()
    }

    fn source(&self, source: &Source) -> String {
        let mut fields = TomlFields::default();
        match source.into.as_slice() {
            [(node, _)] => fields.word("into", &self.name(Item::Node(*node))),
            nodes => {
                let mut into = TomlFields::default();
                for (node, share) in nodes {
                    into.put(&self.name(Item::Node(*node)), format_number(*share));
                }
                fields.put("into", into.inline());
            }
        }
        self.law(&mut fields, source.kind, &source.law);
        fields.inline()
    }

    pub(super) fn law(&self, fields: &mut TomlFields, kind: Kind, law: &Law) {
        if let Some(fluid) = law.fluid() {
            fields.word("fluid", &self.name(Item::Fluid(fluid)));
        }
        let declared = law.formula().declaration();
        let parts: Vec<(&lptn_laws::FieldDeclaration, &Value)> =
            declared.fields.iter().zip(law.values()).collect();
        let mut selector = kind.declaration().selector.filter(|_| declared.named);
        for same in parts.chunk_by(|(a, _), (b, _)| a.key == b.key) {
            // the word that chooses the law follows the keys that all laws take
            let shared = kind.laws().all(|law| law.field(same[0].0.key).is_some());
            if let Some(key) = selector.take_if(|_| !shared) {
                fields.word(key, declared.name);
            }
            // a default of 0 would count as given when it is read: a shift beside a centre distance
            let absent = matches!(same, [(field, Value::Constant(value))]
                if *value == 0.0 && field.default == Some(0.0));
            if !absent {
                self.part(fields, same);
            }
        }
        selector.into_iter().for_each(|key| fields.word(key, declared.name));
    }

    /// The values of one key.
    fn part(&self, fields: &mut TomlFields, same: &[(&lptn_laws::FieldDeclaration, &Value)]) {
        let (field, first) = same[0];
        let substance = field.property.and_then(|of| Some((of.key(), self.substance_of(first)?)));
        match (substance, same) {
            (Some((key, _)), _) if fields.has(key) => {}
            (Some((key, substance)), _) => {
                fields.word(key, &self.name(substance));
                let direction = self.direction(substance, first);
                direction.into_iter().for_each(|word| fields.word("direction", word));
            }
            (None, [_]) => fields.put(field.key, value(first, field.ty)),
            _ => {
                let values: Vec<String> =
                    same.iter().map(|(field, part)| value(part, field.ty)).collect();
                fields.put(field.key, format!("[{}]", values.join(", ")));
            }
        }
    }

    pub(super) fn limits(&mut self) {
        let mut section = TomlFields::default();
        for limit in self.network.limits() {
            let mut fields = TomlFields::default();
            fields.put("of", string(&whole(limit)));
            let bound = match limit.bound {
                Bound::Below => "below",
                Bound::Above => "above",
            };
            fields.put(bound, like(&limit.value, limit.ty));
            if limit.severity == LimitSeverity::Warning {
                fields.word("severity", "warning");
            }
            section.put(&limit.name, fields.inline());
        }
        self.section("limit", &section);
    }
}

/// The limited quantity with every instance of its families.
fn whole(limit: &Limit) -> String {
    match (&limit.of, limit.text.contains("[*]")) {
        (Value::Expression(program), true) if limit.is_of_moments() => {
            program.text().trim().to_owned()
        }
        _ => limit.text.clone(),
    }
}
