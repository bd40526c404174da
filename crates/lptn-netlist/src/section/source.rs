//! `[source]`.

use lptn_network::{End, Field, Input, Item, NodeId};
use lptn_units::{Dimension, Type, parse_quantity};

use crate::diagnostic::Diagnostic;
use crate::elaborate::{Elaboration, stand_in};
use crate::fields::{Fields, Owner};
use crate::file::Span;
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::value::{Place, Wanted};
use crate::vocabulary::SOURCE;

impl<'a> Elaboration<'a> {
    pub(crate) fn sources(&mut self) {
        for entry in self.elements(SOURCE.name) {
            self.source(entry);
        }
    }

    fn source(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element(SOURCE.name, &entry.key);
        let fields = Fields::of(&SOURCE, owner, entry, &mut self.problems)?;
        let shared = match fields.get("into").map(|raw| (&raw.kind, raw)) {
            Some((RawKind::Table(table), raw)) => Some((table, raw)),
            _ => None,
        };
        let ends = match shared {
            Some((table, _)) => Ends::Several(self.shares(&fields, table)),
            None => Ends::One(self.end(&fields, "into")),
        };
        let raw = fields.require("P", &mut self.problems);
        let ty = Type::of(Dimension::POWER);
        let wanted = Wanted::of_source(ty);
        let given = raw.and_then(|raw| self.given(Place { owner: &fields.owner, key: "P", raw }, wanted));
        let power = given.map_or_else(|| stand_in(ty), |given| given.input());
        let (item, at) = match ends {
            Ends::One(end) => {
                let (end, at) = end?;
                (Item::Source(self.builder.source(&entry.key, end, power)), at.span.clone())
            }
            Ends::Several(nodes) => (self.shared(&entry.key, &nodes?, power), shared?.1.span.clone()),
        };
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map.insert(item, Field::Into, at);
        if let Some(raw) = raw {
            self.map.value(item, Field::Power, raw);
        }
        Some(())
    }

    fn shared(&mut self, name: &str, nodes: &[(NodeId, f64)], power: Input) -> Item {
        Item::Source(self.builder.shared_source(name, nodes, power))
    }

    /// `into = { a = 0.5, b = 0.5 }`.
    fn shares(&mut self, fields: &Fields<'a>, table: &'a RawTable) -> Option<Vec<(NodeId, f64)>> {
        let shares: Vec<_> = table.entries.iter().map(|entry| self.share(fields, entry)).collect();
        shares.into_iter().collect()
    }

    fn share(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<(NodeId, f64)> {
        let share = self.share_number(fields, entry);
        match self.named_end(fields, "into", (&entry.key, &entry.value)) {
            Some((End::Node(id), _)) => Some((id, share?)),
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
    Several(Option<Vec<(NodeId, f64)>>),
}

fn boundary(fields: &Fields<'_>, at: &Span) -> Diagnostic {
    Diagnostic::error("network::source_into_boundary", format!("{} heats a boundary", fields.owner.words()))
        .at(at.clone(), "a boundary")
        .help("a boundary keeps its temperature whatever flows in: name a node")
}

fn negative(place: Place<'_>) -> Diagnostic {
    Diagnostic::error("netlist::share", format!("the share {} is negative", place.words()))
        .at(place.raw.span.clone(), "")
        .help("a node from which heat is taken has a source of its own with a negative `P`")
}

fn no_number(place: Place<'_>) -> Diagnostic {
    Diagnostic::error("netlist::share", format!("the share {} must be a number", place.words()))
        .at(place.raw.span.clone(), "")
        .help("shares are plain numbers that sum to 1: `into = { sun = 0.5, ring = 0.5 }`")
}
