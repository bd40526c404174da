//! `[foster]`: the R-tau table of a data sheet as a node with that impedance to a boundary, written
//! out as a ladder of nodes and resistors before anything is read.

mod check;
mod read;

use lptn_data::{Diagnostic, Span};
use lptn_laws::Kind;
use lptn_units::Dimension;

pub(crate) use check::check;

use crate::format::{ABSOLUTE, Role, SectionDeclaration, Takes, key, shaped, text};
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::section::NODE;
use crate::template::Structure;
use read::Read;

/// `[foster]`, as netlists declare it.
pub(crate) const FOSTER: SectionDeclaration = SectionDeclaration {
    name: "foster",
    sentence: "A node with the thermal impedance of an R-tau table to a boundary.",
    role: Role::Element,
    keys: &[
        text("to", "name of a boundary", "the reference of the measured impedance", "\"case\"")
            .needed(),
        shaped(
            "R",
            "list of K/W",
            Takes::list(&Takes::Quantity("K/W")),
            "the resistances of the table",
            "[\"20 mK/W\", \"0.1 K/W\"]",
        )
        .needed(),
        shaped(
            "tau",
            "list of s",
            Takes::list(&Takes::Quantity("s")),
            "their time constants",
            "[\"1 ms\", \"80 ms\"]",
        )
        .needed(),
        key("T0", ABSOLUTE, "temperature at the start", "\"25 degC\"").or("`T0` of `[default]`"),
    ],
    example: "{ to = \"case\", R = [\"20 mK/W\", \"0.1 K/W\"], tau = [\"1 ms\", \"80 ms\"] }",
    elsewhere: &[
        ("from", "the chain is a node with this name: sources and paths name it"),
        ("C", "capacities follow from `R` and `tau`"),
        ("G", "the table has resistances: `R`"),
        ("P", "heat is put in by a [source]: `name = { into = \"chip\", P = \"100 W\" }`"),
    ],
    ..SectionDeclaration::NEW
};

/// A chain that was written out.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    name: String,
    /// Its nodes, the port first.
    nodes: Vec<String>,
    resistors: Vec<String>,
}

/// Replaces every chain by nodes and resistors.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &Structure,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Chain> {
    let mut chains = Vec::new();
    for entry in raw.take(FOSTER.name) {
        let read = Read::of(&entry, problems);
        chains.extend(Chain::written_out(raw, &entry, &read, structure));
    }
    chains
}

impl Chain {
    /// The nodes and resistors of a chain; `None` if it has no end.
    fn written_out(
        raw: &mut RawNetlist,
        entry: &RawEntry,
        read: &Read<'_>,
        structure: &Structure,
    ) -> Option<Self> {
        let (at, rungs) = (&entry.key_span, &read.rungs);
        let around = structure.instance_at(at).map_or(String::new(), |path| format!("{path}."));
        // the name of a rung next to the block
        let here = entry.key.strip_prefix(&around).unwrap_or(&entry.key);
        let node = |k: usize| if k == 0 { here.to_owned() } else { format!("{here}.n{}", k + 1) };
        let mut chain = Self { name: entry.key.clone(), nodes: Vec::new(), resistors: Vec::new() };
        for (k, &(capacity, resistance)) in rungs.iter().enumerate() {
            let mut fields = vec![given("C", capacity, Dimension::CAPACITY, at)];
            fields.extend(read.initial.cloned());
            chain.nodes.push(format!("{around}{}", node(k)));
            raw.push(NODE.name, element(&chain.nodes[k], fields, at));
            let next = || RawValue::text(node(k + 1), at);
            let to = if k + 1 < rungs.len() { next() } else { read.to?.clone() };
            let fields = vec![
                RawEntry::new("from", RawValue::text(node(k), at)),
                RawEntry::new("to", to),
                given("R", resistance, Dimension::RESISTANCE, at),
            ];
            chain.resistors.push(format!("{}.R{}", entry.key, k + 1));
            raw.push(
                Kind::Resistor.declaration().section,
                element(&chain.resistors[k], fields, at),
            );
        }
        Some(chain)
    }
}

/// A field with a number in SI units.
fn given(key: &str, value: f64, dimension: Dimension, at: &Span) -> RawEntry {
    RawEntry::new(key, RawValue::text(format!("{value} {}", dimension.si_unit()), at))
}

fn element(name: &str, fields: Vec<RawEntry>, at: &Span) -> RawEntry {
    let kind = RawKind::Table(RawTable { span: at.clone(), entries: fields });
    RawEntry::new(name, RawValue { span: at.clone(), kind })
}
