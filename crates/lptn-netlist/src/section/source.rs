//! `[source]`.

use lptn_data::{Diagnostic, Span};
use lptn_network::{End, Field, Input, Item, NodeId};
use lptn_units::{Dimension, Type, parse_quantity};

use crate::fields::{Fields, Owner};
use crate::grid_part::GridPart;
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::vocabulary::SOURCE;
use crate::work::{Elaboration, stand_in};

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
            Some((table, raw)) => Ends::Several(self.shares(&fields, table), raw),
            None => match self.heated_grid(&fields) {
                Some(into) => Ends::Several(Some(into.0), into.1),
                None => Ends::One(self.end(&fields, "into")),
            },
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
            Ends::Several(nodes, raw) => (self.shared(&entry.key, &nodes?, power), raw.span.clone()),
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
