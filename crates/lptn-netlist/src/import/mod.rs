//! `[import]`: elements from CSV files, by the million. Rows are read one after the other, and only
//! the data that the network needs is kept.
//!
//! An imported element costs the memory of its contents. Names are stored once, in the nodes, with
//! an index of hashes. Conductors without a name get the number of their row as name on request.
//! The place of a row is counted from every 256th row.

mod column;

use lptn_data::{CsvColumn, CsvRows};
use lptn_network::{ConductorKind, Field, Path};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::format::{Role, SectionDeclaration, text};
use crate::imported::{Kind, Places};
use crate::raw::{RawKind, RawNetlist, RawValue};
use crate::section::Initial;
use crate::work::Elaboration;

const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

pub(crate) const IMPORT: SectionDeclaration = SectionDeclaration {
    name: "import",
    sentence: "Elements from CSV files, one in each row.",
    role: Role::Import,
    keys: &[
        text("nodes", "file", "columns `name`, `C`, and `T0` if there is one", "\"nodes.csv\""),
        text("boundaries", "file", "columns `name`, `T`", "\"boundaries.csv\""),
        text(
            "conductors",
            "file",
            "columns `from`, `to`, `G` or `R`, and `name`",
            "\"conductors.csv\"",
        ),
        text("sources", "file", "columns `into`, `P`, and `name`", "\"sources.csv\""),
    ],
    example: "{ nodes = \"nodes.csv\", conductors = \"conductors.csv\" }",
    elsewhere: &[
        ("node", "did you mean `nodes`?"),
        ("boundary", "did you mean `boundaries`?"),
        ("conductor", "did you mean `conductors`?"),
        ("resistors", "paths between two ends are `conductors`"),
        ("source", "did you mean `sources`?"),
    ],
    ..SectionDeclaration::NEW
};

/// The files that it names.
pub(crate) fn files(raw: &RawNetlist) -> impl Iterator<Item = (&str, &RawValue)> {
    raw.elements(IMPORT.name).iter().filter_map(|entry| match &entry.value.kind {
        RawKind::String { text, .. } => Some((text.as_str(), &entry.value)),
        _ => None,
    })
}

/// The contents of a file: the key that names it, and its columns.
pub(crate) struct Contents {
    key: &'static str,
    columns: &'static [&'static str],
    /// A header as it could be.
    example: &'static str,
}

const NODES: Contents =
    Contents { key: "nodes", columns: &["name", "C", "T0"], example: "name,C [J/K],T0 [degC]" };
const BOUNDARIES: Contents =
    Contents { key: "boundaries", columns: &["name", "T"], example: "name,T [degC]" };
const CONDUCTORS: Contents = Contents {
    key: "conductors",
    columns: &["from", "to", "G", "R", "name"],
    example: "from,to,G [W/K]",
};
const SOURCES: Contents =
    Contents { key: "sources", columns: &["into", "P", "name"], example: "into,P [W]" };

/// The way back from the elements, the first of which is given, to their rows.
fn places(
    rows: CsvRows<'_>,
    (kind, first): (Kind, usize),
    fields: &[(Field, Option<usize>)],
) -> Places {
    let columns = fields.iter().filter_map(|(field, column)| Some((*field, (*column)?))).collect();
    Places { kind, first, columns, marks: rows.marks() }
}

impl<'a> Elaboration<'a> {
    /// The fields of `[import]`.
    pub(crate) fn import(&mut self) -> Option<Fields<'a>> {
        let entry = self.raw.top.get(IMPORT.name)?;
        if !matches!(entry.value.kind, RawKind::Table(_)) {
            self.lost(); // which has been reported
            return None;
        }
        let fields = self.inner(&IMPORT, Owner::section(IMPORT.name), entry);
        if fields.as_ref().is_none_or(|fields| !fields.complete) {
            self.lost(); // the unknown key may be what names the nodes
        }
        fields
    }

    pub(crate) fn import_nodes(
        &mut self,
        import: Option<&Fields<'a>>,
        default: Option<&Initial<'a>>,
    ) {
        let Some(mut rows) = self.rows(import, &NODES) else { return };
        let name = self.required_column(&rows, "name");
        let capacity = self.number_column(&rows, "C", Type::of(Dimension::CAPACITY));
        let initial = rows.has("T0").then(|| self.number_column(&rows, "T0", ABSOLUTE));
        let (Some(name), Some(capacity), Some(initial)) =
            (name, capacity, initial.map_or(Some(None), |column| column.map(Some)))
        else {
            return self.lost();
        };
        let first = self.builder.node_count();
        while self.next_row(&mut rows) {
            let given = |column: &CsvColumn| !(rows.sound && rows.cell(column.index).is_empty());
            let (stores, starts) = (given(&capacity), initial.as_ref().is_some_and(given));
            let own =
                initial.as_ref().filter(|_| starts).map(|column| self.number(&mut rows, column));
            let capacity = stores.then(|| self.number(&mut rows, &capacity));
            let initial = own.or_else(|| default.map(|(input, _)| input.clone()));
            if self.is_named(&mut rows, name) {
                self.builder.add_node(rows.cell(name), capacity, initial, !stores);
            }
        }
        let initial = initial.map(|column| column.index);
        let fields = [
            (Field::Name, Some(name)),
            (Field::Capacity, Some(capacity.index)),
            (Field::Initial, initial),
        ];
        self.map.add_import(places(rows, (Kind::Node, first), &fields));
    }

    pub(crate) fn import_boundaries(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut rows) = self.rows(import, &BOUNDARIES) else { return };
        let (name, temperature) =
            (self.required_column(&rows, "name"), self.number_column(&rows, "T", ABSOLUTE));
        let (Some(name), Some(temperature)) = (name, temperature) else { return self.lost() };
        let first = self.builder.boundary_count();
        while self.next_row(&mut rows) {
            let value = self.number(&mut rows, &temperature);
            if self.is_named(&mut rows, name) {
                self.builder.boundary(rows.cell(name), value);
            }
        }
        let fields = [(Field::Name, Some(name)), (Field::Temperature, Some(temperature.index))];
        self.map.add_import(places(rows, (Kind::Boundary, first), &fields));
    }

    pub(crate) fn import_conductors(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut rows) = self.rows(import, &CONDUCTORS) else { return };
        let (from, to) = (self.required_column(&rows, "from"), self.required_column(&rows, "to"));
        let name = self.optional_column(&rows, "name");
        let (Some(from), Some(to), Some((column, law))) = (from, to, self.law_column(&rows)) else {
            self.left_out.paths = true;
            return;
        };
        let first = self.builder.conductor_count();
        while self.next_row(&mut rows) {
            let value = self.number(&mut rows, &column);
            let path = Path::new(law, [value]);
            let ends = (self.end_of(&mut rows, ("from", from)), self.end_of(&mut rows, ("to", to)));
            let (Some(start), Some(end)) = ends else {
                self.left_out.paths = true;
                rows.skip();
                continue;
            };
            let kind = ConductorKind::Resistor;
            match rows.name(name) {
                Some(name) => self.builder.conductor(name, kind, (start, end), path),
                None => self.builder.numbered_conductor(rows.count(), kind, (start, end), path),
            };
            self.map.conductor("resistor");
        }
        let key = law.declaration().fields[0].key;
        let fields = [
            (Field::Name, name),
            (Field::From, Some(from)),
            (Field::To, Some(to)),
            (Field::of_law(key).unwrap_or(Field::Value), Some(column.index)),
        ];
        self.map.add_import(places(rows, (Kind::Conductor, first), &fields));
    }

    pub(crate) fn import_sources(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut rows) = self.rows(import, &SOURCES) else { return };
        let into = self.required_column(&rows, "into");
        let power = self.number_column(&rows, "P", Type::of(Dimension::POWER));
        let name = self.optional_column(&rows, "name");
        let (Some(into), Some(power)) = (into, power) else { return };
        let first = self.builder.source_count();
        while self.next_row(&mut rows) {
            let value = self.number(&mut rows, &power);
            let Some(end) = self.end_of(&mut rows, ("into", into)) else {
                rows.skip();
                continue;
            };
            match rows.name(name) {
                Some(name) => self.builder.source(name, end, value),
                None => self.builder.numbered_source(rows.count(), end, value),
            };
        }
        let fields =
            [(Field::Name, name), (Field::Into, Some(into)), (Field::POWER, Some(power.index))];
        self.map.add_import(places(rows, (Kind::Source, first), &fields));
    }

    /// Notes that names may be unknown because a file is missing.
    fn lost(&mut self) {
        self.names.hide_all();
        self.left_out.sections = true;
        self.left_out.paths = true;
        self.left_out.parts = true;
    }
}
