//! `[source]`.

use lptn_data::{Diagnostic, Span};
use lptn_network::{End, Field, Input, Item, NodeId};
use lptn_units::{Dimension, Type, parse_quantity};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, key};
use crate::grid_part::GridPart;
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::work::{Elaboration, stand_in};

pub(crate) const SOURCE: SectionDeclaration = SectionDeclaration {
    name: "source",
    sentence: "Heat that goes into a node, into several, or into a grid.",
    role: Role::Element,
    keys: &[
        key(
            "into",
            "name, or table of shares",
            "the node, grid or face that is heated",
            "\"name of a node\"",
        ),
        key(
            "P",
            "W",
            "heat flow, may depend on time, signals, controls and temperatures",
            "\"100 W\"",
        ),
    ],
    example: "{ into = \"a\", P = \"100 W\" }",
    elsewhere: &[
        ("node", "the node that is heated is `into`"),
        ("to", "the node that is heated is `into`"),
    ],
    ..SectionDeclaration::NEW
};

impl<'a> Elaboration<'a> {
    pub(crate) fn sources(&mut self) {
        for entry in self.elements(SOURCE.name) {
            self.source(entry);
        }
    }

    fn source(&mut self, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&SOURCE, entry)?;
        let shared = match fields.get("into").map(|raw| (&raw.kind, raw)) {
            Some((RawKind::Table(table), raw)) => Some((table, raw)),
            _ => None,
        };
        let ends = match shared {
            Some((table, raw)) => Ends::Several(self.shares(&fields, table), raw),
            None => match self.heated_grid(&fields) {
                Some(into) => Ends::Several(Some(into.0), into.1),
                None => Ends::One(self.end(&fields, "into")),
            },
        };
        let ty = Type::of(Dimension::POWER);
        self.require(&fields, "P");
        let power = self.input(&fields, "P", Wanted::of_source(ty)).unwrap_or_else(|| stand_in(ty));
        let (item, at) = match ends {
            Ends::One(end) => {
                let (end, at) = end?;
                (Item::Source(self.builder.source(&entry.key, end, power)), at.span.clone())
            }
            Ends::Several(nodes, raw) => {
                (self.shared(&entry.key, &nodes?, power), raw.span.clone())
            }
        };
        self.note(item, &entry.key_span, &fields, &[Field::Power]);
        self.map.insert(item, Field::Into, at);
        Some(())
    }

    fn shared(&mut self, name: &str, nodes: &[(NodeId, f64)], power: Input) -> Item {
        Item::Source(self.builder.shared_source(name, nodes, power))
    }

    /// `into = { a = 0.5, b = 0.5 }`.
    fn shares(&mut self, fields: &Fields<'a>, table: &'a RawTable) -> Option<Vec<(NodeId, f64)>> {
        let shares: Vec<_> = table.entries.iter().map(|entry| self.share(fields, entry)).collect();
        shares.into_iter().collect::<Option<Vec<_>>>().map(|shares| shares.concat())
    }

    /// A grid is heated by volume, a face by area.
    fn heated_grid(&mut self, fields: &Fields<'a>) -> Option<(Vec<(NodeId, f64)>, &'a RawValue)> {
        let raw = fields.get("into")?;
        let RawKind::String { text, .. } = &raw.kind else { return None };
        Some((self.parts_of_grid(&raw.span, text)?, raw))
    }

    fn parts_of_grid(&mut self, place: &Span, name: &str) -> Option<Vec<(NodeId, f64)>> {
        match self.part_of_grid_at(place, name)? {
            GridPart::Whole(id) => Some(self.builder.shares_of_volume(id)),
            GridPart::Face(at) => Some(self.builder.shares_of_face(at)),
            _ => None,
        }
    }

    fn share(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<Vec<(NodeId, f64)>> {
        let share = self.share_number(fields, entry);
        if let Some(parts) = self.parts_of_grid(&entry.value.span, &entry.key) {
            let share = share?;
            return Some(parts.into_iter().map(|(node, part)| (node, part * share)).collect());
        }
        match self.named_end(fields, "into", (&entry.key, &entry.value)) {
            Some((End::Node(id), _)) => Some(vec![(id, share?)]),
            Some((End::Boundary(_), _)) => {
                self.report(boundary(fields, &entry.key_span));
                None
            }
            None => None,
        }
    }

    fn share_number(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<f64> {
        let owner = fields.owner.inside("into");
        let place = Place { owner: &owner, key: &entry.key, raw: &entry.value };
        let problem = match &entry.value.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
                match parse_quantity(text, Some(Type::SCALAR)) {
                    Ok(quantity) if quantity.value >= 0.0 => return Some(quantity.value),
                    Ok(_) => negative(place),
                    Err(_) => no_number(place),
                }
            }
            _ => no_number(place),
        };
        self.report(problem);
        None
    }
}

/// Where the heat of a source goes.
enum Ends<'a> {
    One(Option<(End, &'a RawValue)>),
    Several(Option<Vec<(NodeId, f64)>>, &'a RawValue),
}

fn boundary(fields: &Fields<'_>, at: &Span) -> Diagnostic {
    Diagnostic::error(
        "network::source_into_boundary",
        format!("{} heats a boundary", fields.owner.words()),
    )
    .at(at.clone(), "a boundary")
    .help("a boundary keeps its temperature whatever flows in: name a node")
}

fn negative(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::share",
        format!("the share {} is negative", place.words()),
        &place.raw.span,
        "a node from which heat is taken has a source of its own with a negative `P`",
    )
}

fn no_number(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::share",
        format!("the share {} must be a number", place.words()),
        &place.raw.span,
        "shares are plain numbers that sum to 1: `into = { sun = 0.5, ring = 0.5 }`",
    )
}
