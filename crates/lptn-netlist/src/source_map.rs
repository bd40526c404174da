//! Where each part of a network stands in its files.

use std::collections::HashMap;
use std::ops::Range;

use lptn_network::{BuildErrorKind, Field, Item, NodeId, ParameterId};

use crate::file::Span;
use crate::raw::{RawKind, RawValue};

/// Leads from the parts of a network to the places they were read from.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    spans: HashMap<(Item, Field), Span>,
    /// The byte at which the content of a string begins, where no escape changes it.
    contents: HashMap<(Item, Field), usize>,
    select: Vec<Span>,
    /// The section of each conductor.
    conductors: Vec<&'static str>,
    /// The beginning of the file.
    top: Option<Span>,
    /// `T0` of `[default]`.
    default: Option<Span>,
    /// Where a part first names its node.
    parts: HashMap<NodeId, Span>,
}

impl SourceMap {
    /// The place of a field's value, quotes included; for [`Field::Name`] the place of the key that names the
    /// item. A node without a `T0` of its own has the place of the default.
    pub fn get(&self, item: Item, field: Field) -> Option<&Span> {
        self.spans.get(&(item, field))
    }

    /// The place of an item's name.
    pub fn name(&self, item: Item) -> Option<&Span> {
        self.get(item, Field::Name)
    }

    /// The place of a parameter's value, for writing another one there.
    pub fn parameter(&self, id: ParameterId) -> Option<&Span> {
        self.get(Item::Parameter(id), Field::Value)
    }

    /// The place of each pattern of `select` in `[run]`, in the order of
    /// [`RunSettings::select`](crate::RunSettings::select).
    pub fn select(&self) -> &[Span] {
        &self.select
    }

    /// How many places are known.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Whether no place is known.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The place of the field, or of the name of its item where the field is not written.
    pub(crate) fn nearest(&self, item: Item, field: Field) -> Option<&Span> {
        self.get(item, field).or_else(|| self.name(item))
    }

    /// The two places of a name that is taken twice.
    pub(crate) fn duplicate(&self, kind: &BuildErrorKind) -> Option<(&Span, &Span)> {
        let BuildErrorKind::DuplicateName { first, second } = kind else { return None };
        let (first, second) = (self.name(*first)?, self.name(*second)?);
        // the builder sees kinds one after the other, a reader sees the file
        Some(if first.order() < second.order() { (first, second) } else { (second, first) })
    }

    pub(crate) fn insert(&mut self, item: Item, field: Field, span: Span) {
        self.spans.insert((item, field), span);
    }

    /// What an item is called in a netlist, by its section.
    pub(crate) fn kind(&self, item: Item) -> &'static str {
        match item {
            Item::Parameter(_) => "parameter",
            Item::Node(_) => "node",
            Item::Boundary(_) => "boundary",
            Item::Capacitor(_) => "capacitor",
            Item::Conductor(id) => self.conductors.get(id.index()).copied().unwrap_or("path"),
            Item::Source(_) => "source",
            Item::Limit(_) => "limit",
            Item::Material(_) => "material",
            Item::Fluid(_) => "fluid",
            Item::Signal(_) => "signal",
            Item::Table(_) => "table",
            Item::Report(_) => "report",
            Item::Control(_) => "control",
        }
    }

    /// The beginning of the file, for what has no place of its own.
    pub(crate) fn top(&self) -> Option<&Span> {
        self.top.as_ref()
    }

    /// Whether the temperature at the start comes from `[default]`.
    pub(crate) fn is_default(&self, item: Item) -> bool {
        self.default.is_some() && self.get(item, Field::Initial) == self.default.as_ref()
    }

    pub(crate) fn set_top(&mut self, top: Span) {
        self.top = Some(top);
    }

    pub(crate) fn set_default(&mut self, default: Span) {
        self.default = Some(default);
    }

    /// Where a capacitor says that it belongs to this node.
    pub(crate) fn capacitor_of(&self, node: NodeId) -> Option<&Span> {
        self.parts.get(&node)
    }

    /// Notes the section of the next conductor.
    pub(crate) fn conductor(&mut self, section: &'static str) {
        self.conductors.push(section);
    }

    pub(crate) fn part_of(&mut self, node: NodeId, span: Span) {
        self.parts.entry(node).or_insert(span);
    }

    /// Notes the place of a field's value.
    pub(crate) fn value(&mut self, item: Item, field: Field, value: &RawValue) {
        self.insert(item, field, value.span.clone());
        if let RawKind::String { start: Some(start), .. } = value.kind {
            self.contents.insert((item, field), start);
        }
    }

    /// The place of some bytes of a field's string; the whole value where they cannot be told.
    pub(crate) fn part(&self, item: Item, field: Field, range: &Range<usize>) -> Option<Span> {
        let whole = self.get(item, field)?;
        match self.contents.get(&(item, field)) {
            Some(start) if !range.is_empty() && start + range.end <= whole.range.end => {
                Some(Span::new(whole.file, start + range.start..start + range.end))
            }
            _ => Some(whole.clone()),
        }
    }

    /// The byte at which the content of a field's string begins, where no escape changes it.
    pub(crate) fn content(&self, item: Item, field: Field) -> Option<usize> {
        self.contents.get(&(item, field)).copied()
    }

    pub(crate) fn set_select(&mut self, spans: Vec<Span>) {
        self.select = spans;
    }
}
