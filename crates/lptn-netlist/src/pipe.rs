//! `[pipe.NAME]`: a stream through a pipe of a given content, with plug flow. It is written out as a
//! massless node, the stream into it and the stream out of it, and a state that counts the fluid.

use std::sync::Arc;

use lptn_data::Span;
use lptn_laws::Kind;
use lptn_network::{Field, Item};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::format::{ABSOLUTE, Role, SectionDeclaration, akin, key, text};
use crate::names::ValueKind;
use crate::place::Wanted;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::section::{Initial, NODE, check_forms};
use crate::template::Structure;
use crate::work::Elaboration;
use crate::written_out::here;

pub(crate) const PIPE: SectionDeclaration = SectionDeclaration {
    name: "pipe",
    sentence: "A stream through a pipe: fluid leaves after the content of the pipe has passed.",
    role: Role::Element,
    keys: &[
        text("from", "name", "the node or boundary that the stream comes from", "\"inlet\"")
            .needed(),
        text("to", "name", "the node or boundary that it goes to", "\"a\"").needed(),
        akin("mcp", "quantity or expression", "capacity rate of the stream", "\"50 W/K\""),
        akin("flow", "quantity or expression", "mass or volume flow of the fluid", "\"3 L/min\""),
        akin(
            "flow_T",
            "temperature or expression",
            "temperature at which the volume is measured",
            "\"20 degC\"",
        ),
        text("fluid", "name", "the fluid of `flow`", "\"water\""),
        key("C", "J/K", "with `mcp`: heat capacity of the content", "\"42 kJ/K\""),
        key("mass", "kg", "with a mass flow: mass of the content", "\"2 kg\""),
        key("volume", "m^3", "with a volume flow: volume of the content", "\"2 L\""),
        key("T0", ABSOLUTE, "temperature of the content at the start", "\"25 degC\"")
            .or("`T0` of `[default]`"),
    ],
    example: "{ from = \"inlet\", to = \"a\", mcp = \"50 W/K\", C = \"42 kJ/K\" }",
    elsewhere: &[
        ("delay", "the delay follows from the flow and the content, `volume`, `mass` or `C`"),
        ("length", "the content is `volume`, length times cross section"),
        ("V", "the content is `volume`"),
        ("G", "a pipe exchanges no heat: let it end at a node that a path cools"),
    ],
    ..SectionDeclaration::NEW
};

/// The keys that give the content, each with its dimension and the key of its flow.
pub(crate) const CONTENTS: [(&str, Dimension, &str); 3] = [
    ("C", Dimension::CAPACITY, "mcp"),
    ("mass", Dimension::MASS, "flow"),
    ("volume", Dimension::VOLUME, "flow"),
];

/// The keys of the forms in which a pipe may be given.
const FORMS: [&[&str]; 3] =
    [&["mcp", "C"], &["flow", "fluid", "mass"], &["flow", "fluid", "volume"]];

/// Adds the elements of every pipe; the pipes themselves, to be read.
pub(crate) fn expand(raw: &mut RawNetlist, structure: &mut Arc<Structure>) -> Vec<RawEntry> {
    let pipes = raw.take(PIPE.name);
    for entry in &pipes {
        // its problems are reported when it is read
        let mut told = Vec::new();
        let owner = Owner::element(PIPE.name, &entry.key);
        let fields = Fields::of(&PIPE, owner, entry, &mut told);
        match fields.and_then(|fields| elements((structure, entry), &fields)) {
            Some(made) => made.into_iter().for_each(|(section, entry)| raw.push(section, entry)),
            None => Arc::make_mut(structure).lose(&entry.key),
        }
    }
    pipes
}

/// The elements of a pipe with their sections; `None` if something is missing.
fn elements(
    (structure, entry): (&Structure, &RawEntry),
    fields: &Fields<'_>,
) -> Option<Vec<(&'static str, RawEntry)>> {
    let (from, to) = (fields.get("from")?, fields.get("to")?);
    let &(content, dimension, flow) = CONTENTS.iter().find(|(key, ..)| fields.has(key))?;
    let (amount, flow) = (fields.get(content)?, fields.get(flow)?);
    let at = &entry.key_span;
    let name = RawValue::text(here(structure, entry).to_owned(), at);
    let stream = |from: &RawValue, to: &RawValue| {
        let carried = ["mcp", "flow", "flow_T", "fluid"].into_iter();
        let carried = carried.filter_map(|key| Some((key, fields.get(key)?.clone())));
        table(at, [("from", from.clone()), ("to", to.clone())].into_iter().chain(carried))
    };
    let start = RawValue::text(format!("0 {}", dimension.si_unit()), at);
    let state = [("rate", flow.clone()), ("start", start), ("size", amount.clone())];
    let node = [("massless", RawValue { span: at.clone(), kind: RawKind::Boolean(true) })];
    let section = Kind::Advection.declaration().section;
    let element = |part: &str, value: RawValue| RawEntry {
        key: format!("{}{part}", entry.key),
        key_span: at.clone(),
        value,
    };
    Some(vec![
        (NODE.name, element("", table(at, node.into_iter()))),
        (section, element(INTO, stream(from, &name))),
        (section, element(OUT, stream(&name, to))),
        (ValueKind::State.section(), element(PASSED, table(at, state.into_iter()))),
    ])
}

/// The names of the parts of a pipe, after its own.
const INTO: &str = ".in";
const OUT: &str = ".out";
const PASSED: &str = ".passed";

fn table<'k>(at: &Span, keys: impl Iterator<Item = (&'k str, RawValue)>) -> RawValue {
    let entries = keys.map(|(key, value)| RawEntry::new(key, value)).collect();
    RawValue::table(entries, at)
}

impl<'a> Elaboration<'a> {
    /// Reads the pipes, whose elements are known.
    pub(crate) fn pipes(&mut self, pipes: &'a [RawEntry], default: Option<&Initial<'a>>) {
        for entry in pipes {
            if self.pipe(entry, default).is_none() {
                let item = self.builder.item(&entry.key);
                self.left_out.items.extend(item);
            }
        }
    }

    fn pipe(&mut self, entry: &'a RawEntry, default: Option<&Initial<'a>>) -> Option<()> {
        let fields = self.fields(&PIPE, entry)?;
        self.require(&fields, "from");
        self.require(&fields, "to");
        self.problems.extend(check_forms(&fields, &FORMS));
        let own = self.initial(&fields);
        let start = own.or_else(|| default.map(|(input, _)| input.clone()));
        if start.is_none() {
            self.require(&fields, "T0");
        }
        let (key, dimension, _) = CONTENTS.into_iter().find(|(key, ..)| fields.has(key))?;
        let content = self.input(&fields, key, Wanted::constant(Type::of(dimension)))?;
        if let Some(file) = self.state {
            let message = format!("{} has a content that no state file has", fields.owner.words());
            let place = file.state.place.clone();
            let help = "leave `initial` of [run] out: the run begins with `T0` in the pipe";
            self.refuse("netlist::state_pipe", message, &place, help);
        }
        let Some(Item::Node(node)) = self.builder.item(&entry.key) else { return None };
        let passed = self.builder.state_named(&format!("{}{PASSED}", entry.key))?;
        let item = Item::Node(node);
        self.map.value(item, Field::PipeContent, fields.get(key)?);
        let at_start = fields.get("T0").or(default.map(|(_, raw)| *raw));
        at_start.into_iter().for_each(|raw| self.map.value(item, Field::Initial, raw));
        self.builder.pipe(node, passed, content, start?);
        Some(())
    }
}
