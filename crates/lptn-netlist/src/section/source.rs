//! `[source]`, and sources whose heat a law gives.

use lptn_data::{Diagnostic, Span};
use lptn_network::{End, Field, Item, Path};
use lptn_units::{Dimension, Type, format_number, parse_quantity};

use crate::fields::Fields;
use crate::grid_part::GridPart;
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::reading::all;
use crate::section::path_section::{PATHS, PathSection};
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The sources of every kind.
    pub(crate) fn sources(&mut self) {
        for kind in PATHS.iter().filter(|path| path.kind.is_source()) {
            for entry in self.elements(kind.section.name) {
                self.source(entry, kind);
            }
        }
    }

    fn source(&mut self, entry: &'a RawEntry, of: &'static PathSection) -> Option<()> {
        let mut fields = self.fields(&of.section, entry)?;
        let heated = self.heated(&fields);
        let first = heated.as_ref().and_then(|(into, _)| into.first().map(|(end, _)| *end));
        fields.oil = self.oil(&fields, first);
        // a stand-in if the law is wrong, so that the nodes still count
        let law = self.path(&fields, of);
        let formula = law.as_ref().map(|law| law.formula());
        self.names.learn_results(&entry.key, of.kind, formula);
        let law = law.unwrap_or_else(|| Path::heat(stand_in(Type::of(Dimension::POWER))));
        let (into, at) = heated?;
        let item = Item::Source(self.builder.heat(&entry.key, of.kind, &into, law));
        self.map.source(of.section.name);
        let own: Vec<Field> = of.values().filter_map(Field::of_law).collect();
        self.note(item, &entry.key_span, &fields, &own);
        self.map.insert(item, Field::Into, at.span.clone());
        Some(())
    }

    /// The nodes that a source heats, with their shares.
    fn heated(&mut self, fields: &Fields<'a>) -> Option<(Vec<(End, f64)>, &'a RawValue)> {
        if let Some(raw) = fields.get("into")
            && let RawKind::Table(table) = &raw.kind
        {
            return Some((self.shares(fields, table)?, raw));
        }
        if let Some(raw) = fields.get("into")
            && let RawKind::Array(items) = &raw.kind
        {
            self.report(list_of_nodes(fields, raw, items));
            return None;
        }
        if let Some(into) = self.heated_grid(fields) {
            return Some(into);
        }
        self.end(fields, "into").map(|(end, raw)| (vec![(end, 1.0)], raw))
    }

    /// `into = { a = 0.5, b = 0.5 }`.
    fn shares(&mut self, fields: &Fields<'a>, table: &'a RawTable) -> Option<Vec<(End, f64)>> {
        all(table.entries.iter().map(|entry| self.share(fields, entry)))
            .map(|shares| shares.concat())
    }

    /// A grid is heated by volume, a face by area.
    fn heated_grid(&mut self, fields: &Fields<'a>) -> Option<(Vec<(End, f64)>, &'a RawValue)> {
        let raw = fields.get("into")?;
        let RawKind::String { text, .. } = &raw.kind else { return None };
        Some((self.parts_of_grid(&raw.span, text)?, raw))
    }

    fn parts_of_grid(&mut self, place: &Span, name: &str) -> Option<Vec<(End, f64)>> {
        let shares = match self.part_of_grid_at(place, name)? {
            GridPart::Whole(id) => self.builder.shares_of_volume(id),
            GridPart::Face(at) => self.builder.shares_of_face(at),
            GridPart::Patch(patch) => self.builder.shares_of_patch(patch),
            _ => return None,
        };
        Some(shares.into_iter().map(|(node, share)| (node.into(), share)).collect())
    }

    fn share(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<Vec<(End, f64)>> {
        let share = self.share_number(fields, entry);
        if let Some(parts) = self.parts_of_grid(&entry.value.span, &entry.key) {
            let share = share?;
            return Some(parts.into_iter().map(|(node, part)| (node, part * share)).collect());
        }
        match self.named_end(fields, "into", (&entry.key, &entry.value)) {
            Some((end @ End::Node(_), _)) => Some(vec![(end, share?)]),
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

/// Error for `into = ["a", "b"]`, which lacks the shares.
fn list_of_nodes(fields: &Fields<'_>, raw: &RawValue, items: &[RawValue]) -> Diagnostic {
    let words = format!(
        "{} must be the name of a node or a table of shares, got a list",
        fields.owner.field("into")
    );
    let names: Vec<&str> = items
        .iter()
        .filter_map(|item| match &item.kind {
            RawKind::String { text, .. } => Some(text.trim()),
            _ => None,
        })
        .collect();
    let plain = |name: &&str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let problem = Diagnostic::error("netlist::wrong_shape", words).at(raw.span.clone(), "");
    if names.len() != items.len() || !names.iter().all(plain) || names.is_empty() {
        return problem.help("write it like this: `into = { a = 0.5, b = 0.5 }`");
    }
    #[expect(clippy::cast_precision_loss, reason = "a count of nodes")]
    let share = format_number(1.0 / names.len() as f64);
    let shares: Vec<String> = names.iter().map(|name| format!("{name} = {share}")).collect();
    problem.help(format!("write `into = {{ {} }}`, with the share of each", shares.join(", ")))
}

fn boundary(fields: &Fields<'_>, at: &Span) -> Diagnostic {
    Diagnostic::error(
        "network::source_into_boundary",
        format!("{} heats a boundary", fields.owner.words()),
    )
    .at(at.clone(), "a boundary")
    .help("a boundary keeps its temperature at any heat flow: name a node")
}

fn negative(place: Place<'_>) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::share",
        format!("the share {} is negative", place.words()),
        &place.raw.span,
        "a node from which heat is taken has its own source with a negative `P`",
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
