//! `[pipe]`.

use lptn_units::Type;

use super::Writer;
use crate::pipe::{CONTENTS, PIPE};
use crate::toml_text::{TomlFields, value};

impl Writer<'_> {
    pub(super) fn pipes(&mut self) {
        let (network, mut section) = (self.network, TomlFields::default());
        for (part, pipe) in network.pipe_parts().iter().zip(network.pipes()) {
            let [into, out] = pipe.streams.map(|id| &network.conductors()[id.index()]);
            let mut fields = TomlFields::default();
            fields.word("from", &self.name(into.from));
            fields.word("to", &self.name(out.to));
            self.law(&mut fields, out.kind, &out.law);
            let ty = network.states()[part.passed.index()].ty;
            let key = CONTENTS.iter().find(|(_, dimension, _)| *dimension == ty.dimension);
            key.into_iter().for_each(|(key, ..)| fields.put(key, value(&part.content, ty)));
            fields.put("T0", value(&part.start, Type::ABSOLUTE_TEMPERATURE));
            section.put(&network.nodes()[part.node.index()].name, fields.inline());
        }
        self.section(PIPE.name, &section);
    }
}
