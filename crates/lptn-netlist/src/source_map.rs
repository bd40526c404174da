//! The place of each part of a network in its files.

use std::collections::BTreeSet;
use std::ops::Range;

use foldhash::HashMap;
use lptn_data::{Files, Span};
use lptn_network::{BuildErrorKind, Field, Item, Naming, NodeId, ParameterId, TableId};

use crate::imported::Places;
use crate::places::{FieldPlaces, Written};
use crate::raw::{RawNetlist, RawTable, RawValue};

/// The sections of elements in their order: the first of each run of one section.
#[derive(Clone, Debug, Default)]
struct Sections {
    runs: Vec<(usize, &'static str)>,
    count: usize,
}

impl Sections {
    fn add(&mut self, section: &'static str) {
        if self.runs.last().is_none_or(|(_, last)| *last != section) {
            self.runs.push((self.count, section));
        }
        self.count += 1;
    }

    fn of(&self, index: usize) -> Option<&'static str> {
        let run = self.runs.partition_point(|(first, _)| *first <= index);
        run.checked_sub(1).filter(|_| index < self.count).map(|run| self.runs[run].1)
    }
}

/// Leads from the parts of a network to the places they were read from.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    places: FieldPlaces,
    select: Vec<Span>,
    /// The sections of conductors and of sources.
    conductors: Sections,
    sources: Sections,
    /// The section of each path that ends at a face.
    face_paths: Vec<&'static str>,
    /// Nodes and conductors that are parts of grids and of paths to faces, by their indices, in
    /// order.
    inner_nodes: Vec<(Range<usize>, Item)>,
    inner_conductors: Vec<(Range<usize>, Item)>,
    /// The beginning of the file.
    top: Option<Span>,
    /// `T0` of `[default]`.
    default: Option<Span>,
    /// The nodes of states.
    states: BTreeSet<NodeId>,
    /// The place at which a part first names its node.
    parts: HashMap<NodeId, Span>,
    /// The places of the elements of CSV files.
    imports: Vec<Places>,
    /// The lines of tables of two arguments, which are read from CSV files.
    maps: HashMap<TableId, RawTable>,
}

impl SourceMap {
    /// A map with room for the places of a netlist.
    pub(crate) fn of(raw: &RawNetlist) -> Self {
        let mut map = Self::default();
        let elements = raw.top.entries.iter().flat_map(|section| section.value.entries());
        // its name, its fields and a start by default
        map.places.reserve(elements.map(|element| 2 + element.value.entries().len()).sum());
        map
    }

    /// The place of a field's value, quotes included; for [`Field::Name`] the place of the key that
    /// names the item. A node without its own `T0` has the place of the default, a part of a grid
    /// or of a path to a face that of the whole. An imported element has the places of its cells;
    /// one without a name in the file has its row for a name.
    pub fn get(&self, item: Item, field: Field) -> Option<Span> {
        let of_whole = || self.places.get(self.whole(item)?, field);
        let written = self.places.get(item, field).or_else(of_whole);
        let written = written.map(|written| written.span.clone());
        written.or_else(|| self.imports.iter().find_map(|places| places.get(item, field)))
    }

    /// The grid or path to a face that a node or conductor is a part of.
    fn whole(&self, item: Item) -> Option<Item> {
        let (parts, index) = match item {
            Item::Node(id) => (&self.inner_nodes, id.index()),
            Item::Conductor(id) => (&self.inner_conductors, id.index()),
            _ => return None,
        };
        let (range, whole) = parts.get(parts.partition_point(|(range, _)| range.end <= index))?;
        range.contains(&index).then_some(*whole)
    }

    /// Notes nodes and conductors that are parts of a whole.
    pub(crate) fn parts(&mut self, (nodes, conductors): (Range<usize>, Range<usize>), whole: Item) {
        let lists = [(&mut self.inner_nodes, nodes), (&mut self.inner_conductors, conductors)];
        lists
            .into_iter()
            .filter(|(_, range)| !range.is_empty())
            .for_each(|(list, range)| list.push((range, whole)));
    }

    /// Notes the section of the next path that ends at a face.
    pub(crate) fn face_path(&mut self, section: &'static str) {
        self.face_paths.push(section);
    }

    /// The place of an item's name.
    pub fn name(&self, item: Item) -> Option<Span> {
        self.get(item, Field::Name)
    }

    /// The place of a parameter's value, for writing another one there.
    pub fn parameter(&self, id: ParameterId) -> Option<Span> {
        self.get(Item::Parameter(id), Field::Value)
    }

    /// The places of values that carry `±` although they are not parameters: nothing varies them.
    /// Each text appears once, in the order of the files.
    pub fn deviations_elsewhere(&self, files: &Files) -> Vec<Span> {
        let no_parameter =
            |item: Item, field: Field| !matches!(item, Item::Parameter(_)) && field != Field::Name;
        let carries = |span: &Span| files.at(span).contains('±') || files.at(span).contains("+-");
        let all = self.places.iter();
        let found = all.filter(|(item, field, span)| no_parameter(*item, *field) && carries(span));
        let mut spans: Vec<Span> = found.map(|(.., span)| span.clone()).collect();
        spans.sort_by_key(Span::order);
        spans.dedup_by(|a, b| a.is_same_text(b));
        spans
    }

    /// The place of each pattern of `select` in `[run]`, in the order of
    /// [`RunSettings::select`](crate::RunSettings::select).
    pub fn select(&self) -> &[Span] {
        &self.select
    }

    /// Number of known places.
    pub fn len(&self) -> usize {
        self.places.len() + self.imports.iter().map(Places::len).sum::<usize>()
    }

    /// True if no place is known.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place of the field, or of the name of its item if the field is not written.
    pub(crate) fn nearest(&self, item: Item, field: Field) -> Option<Span> {
        self.get(item, field).or_else(|| self.name(item))
    }

    /// The two places of a name that is taken twice.
    pub(crate) fn duplicate(&self, kind: &BuildErrorKind) -> Option<(Span, Span)> {
        let BuildErrorKind::DuplicateName { first, second } = kind else { return None };
        let (first, second) = (self.name(*first)?, self.name(*second)?);
        // the builder sees kinds one after the other, a reader sees the file
        Some(if first.order() < second.order() { (first, second) } else { (second, first) })
    }

    pub(crate) fn insert(&mut self, item: Item, field: Field, span: Span) {
        self.places.insert(item, field, Written::at(span));
    }

    /// The beginning of the file, for problems without a place.
    pub(crate) fn top(&self) -> Option<&Span> {
        self.top.as_ref()
    }

    /// True if the initial temperature comes from `[default]`.
    pub(crate) fn is_default(&self, item: Item) -> bool {
        self.default.is_some() && self.get(item, Field::Initial) == self.default
    }

    pub(crate) fn set_top(&mut self, top: Span) {
        self.top = Some(top);
    }

    pub(crate) fn set_default(&mut self, default: Span) {
        self.default = Some(default);
    }

    /// The place at which a capacitor names this node.
    pub(crate) fn capacitor_of(&self, node: NodeId) -> Option<&Span> {
        self.parts.get(&node)
    }

    /// Notes the section of the next conductor.
    pub(crate) fn conductor(&mut self, section: &'static str) {
        self.conductors.add(section);
    }

    /// Notes the node of a state, with the places of its start.
    pub(crate) fn state(&mut self, node: NodeId, name: &Span, start: &RawValue) {
        self.states.insert(node);
        self.insert(Item::Node(node), Field::Name, name.clone());
        self.value(Item::Node(node), Field::Initial, start);
    }

    /// Notes the section of the next source; one that was imported has none.
    pub(crate) fn source(&mut self, section: &'static str) {
        self.sources.add(section);
    }

    /// Notes the line of a table of two arguments.
    pub(crate) fn set_csv_map(&mut self, table: TableId, line: RawTable) {
        self.maps.insert(table, line);
    }

    /// The line of a table of two arguments.
    pub(crate) fn csv_map(&self, table: TableId) -> Option<&RawTable> {
        self.maps.get(&table)
    }

    pub(crate) fn part_of(&mut self, node: NodeId, span: Span) {
        self.parts.entry(node).or_insert(span);
    }

    /// Notes the place of a field's value.
    pub(crate) fn value(&mut self, item: Item, field: Field, value: &RawValue) {
        self.places.insert(item, field, Written::of(value));
    }

    /// The place of some bytes of a field's string; the whole value if it is unknown.
    pub(crate) fn part(&self, item: Item, field: Field, range: &Range<usize>) -> Option<Span> {
        let whole = self.get(item, field)?;
        match self.content(item, field) {
            Some(start) if !range.is_empty() && start + range.end <= whole.range.end => {
                Some(whole.with(start + range.start..start + range.end))
            }
            _ => Some(whole),
        }
    }

    /// The byte at which the content of a field's string begins, if no escape changes it.
    pub(crate) fn content(&self, item: Item, field: Field) -> Option<usize> {
        let content = |item: Item| self.places.get(item, field)?.content();
        content(item).or_else(|| content(self.whole(item)?))
    }

    /// True if an item is in a CSV file of `[import]`.
    pub fn is_imported(&self, item: Item) -> bool {
        self.imports.iter().any(|places| places.holds(item))
    }

    /// Notes the places of the elements of a CSV file.
    pub(crate) fn add_import(&mut self, places: Places) {
        self.imports.push(places);
    }

    pub(crate) fn set_select(&mut self, spans: Vec<Span>) {
        self.select = spans;
    }
}

impl Naming for SourceMap {
    /// By its section.
    fn kind(&self, item: Item) -> &'static str {
        match item {
            Item::Node(_) if self.whole(item).is_some() => "grid",
            Item::Node(id) if self.states.contains(&id) => "state",
            Item::Conductor(id) => self.conductors.of(id.index()).unwrap_or("path"),
            Item::Source(id) => self.sources.of(id.index()).unwrap_or("source"),
            Item::FacePath(id) => self.face_paths.get(id.index()).copied().unwrap_or("path"),
            other => other.word(),
        }
    }

    fn key(&self, item: Item, field: Field) -> &'static str {
        let field = match (self.kind(item), field) {
            ("state", Field::Initial) => Field::Start,
            ("state", field) if field == Field::POWER => Field::Rate,
            (_, field) => field,
        };
        field.key()
    }

    fn elsewhere(&self, item: Item, field: Field) -> Option<&'static str> {
        (field == Field::Initial && self.is_default(item)).then_some("`T0` of [default]")
    }
}
