//! `[foster]`: the R-tau table of a data sheet as a node with that impedance to a boundary, written
//! out as a ladder of nodes and resistors before anything is read.

mod check;
mod parameters;
mod read;

use lptn_data::{Diagnostic, Span};
use lptn_laws::Kind;
use lptn_units::{Dimension, Type};

pub(crate) use check::check;

use crate::format::{ABSOLUTE, Role, SectionDeclaration, Takes, flag, key, shaped, text};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawNetlist, RawValue};
use crate::section::NODE;
use crate::template::Structure;
use parameters::Written;
use read::{Read, Terms};

/// `[foster]`, as netlists declare it.
pub(crate) const FOSTER: SectionDeclaration = SectionDeclaration {
    name: "foster",
    sentence: "A node with the thermal impedance of an R-tau table to a boundary.",
    role: Role::Element,
    keys: &[
        text(
            "to",
            "name of a boundary or node",
            "the reference of the measured impedance",
            "\"case\"",
        )
        .needed(),
        shaped(
            "R",
            "list of K/W or expressions",
            Takes::list(&Takes::Quantity("K/W")),
            "the resistances of the table",
            "[\"20 mK/W\", \"0.1 K/W\"]",
        )
        .needed(),
        shaped(
            "tau",
            "list of s or expressions",
            Takes::list(&Takes::Quantity("s")),
            "their time constants",
            "[\"1 ms\", \"80 ms\"]",
        )
        .needed(),
        key("T0", ABSOLUTE, "temperature at the start", "\"25 degC\"").or("`T0` of `[default]`"),
        flag("series", "`to` may be a node: the ladder is an estimate of the body", "true")
            .or("false"),
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
    /// True if it may end at a node.
    series: bool,
}

/// Replaces every chain by nodes and resistors; the types that some parameters have to have.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &Structure,
    problems: &mut Vec<Diagnostic>,
) -> (Vec<Chain>, Vec<(String, Type)>) {
    let (mut chains, mut types) = (Vec::new(), Vec::new());
    for entry in raw.take(FOSTER.name) {
        let read = Read::of(&entry, problems);
        let around = structure.instance_at(&entry.key_span);
        let around = around.map_or(String::new(), |path| format!("{path}."));
        // the name next to the block
        let here = entry.key.strip_prefix(&around).unwrap_or(&entry.key).to_owned();
        let rungs = match &read.terms {
            Terms::Rungs(rungs) => rungs.iter().map(numbers).collect(),
            Terms::Expressions(terms) => {
                let written = Written::of((&entry.key, &here), terms, &entry.key_span);
                let section = ValueKind::Parameter.section();
                written.parameters.into_iter().for_each(|entry| raw.push(section, entry));
                types.extend(written.types);
                written.rungs
            }
        };
        chains.extend(Chain::written_out(raw, &entry, &read, (&around, &here, &rungs)));
    }
    (chains, types)
}

/// The texts of a rung.
fn numbers((capacity, resistance): &(f64, f64)) -> (String, String) {
    let text = |value: &f64, of: Dimension| format!("{value} {}", of.si_unit());
    (text(capacity, Dimension::CAPACITY), text(resistance, Dimension::RESISTANCE))
}

impl Chain {
    /// The nodes and resistors of a chain; `None` if it has no end.
    fn written_out(
        raw: &mut RawNetlist,
        entry: &RawEntry,
        read: &Read<'_>,
        (around, here, rungs): (&str, &str, &[(String, String)]),
    ) -> Option<Self> {
        let at = &entry.key_span;
        let node = |k: usize| if k == 0 { here.to_owned() } else { format!("{here}.n{}", k + 1) };
        let (nodes, resistors) = (Vec::new(), Vec::new());
        let mut chain = Self { name: entry.key.clone(), nodes, resistors, series: read.series };
        for (k, (capacity, resistance)) in rungs.iter().enumerate() {
            let mut fields = vec![given("C", capacity, at)];
            fields.extend(read.initial.cloned());
            chain.nodes.push(format!("{around}{}", node(k)));
            raw.push(NODE.name, element(&chain.nodes[k], fields, at));
            let next = || RawValue::text(node(k + 1), at);
            let to = if k + 1 < rungs.len() { next() } else { read.to?.clone() };
            let fields = vec![
                RawEntry::new("from", RawValue::text(node(k), at)),
                RawEntry::new("to", to),
                given("R", resistance, at),
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

/// A field with a generated text.
fn given(key: &str, text: &str, at: &Span) -> RawEntry {
    RawEntry::new(key, RawValue::text(text.to_owned(), at))
}

fn element(name: &str, fields: Vec<RawEntry>, at: &Span) -> RawEntry {
    RawEntry::new(name, RawValue::table(fields, at))
}
