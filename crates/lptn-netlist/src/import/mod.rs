//! `[import]`: elements from CSV files, by the million. Rows are read one after the other, and only
//! the data that the network needs is kept.
//!
//! An imported element costs the memory of its contents. Names are stored once, in the nodes, with
//! an index of hashes. Conductors without a name get the number of their row as name on request.
//! The place of a row is counted from every 256th row.

mod column;
mod law;

use lptn_data::{CsvColumn, CsvRows};
use lptn_network::{Field, Path};
use lptn_units::{Dimension, Type};

use crate::csv_form::FORMED_FILES;
use crate::fields::{Fields, Owner};
use crate::format::{Role, SectionDeclaration, shaped};
use crate::imported::{Kind, Places};
use crate::raw::{RawKind, RawNetlist, RawValue};
use crate::section::Initial;
use crate::work::Elaboration;

/// The value of each key, in words.
const NAMED: &str = "file, or a list of files";

const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

pub(crate) const IMPORT: SectionDeclaration = SectionDeclaration {
    name: "import",
    sentence: "Elements from CSV files, one in each row.",
    role: Role::Import,
    keys: &[
        shaped(
            "nodes",
            NAMED,
            FORMED_FILES,
            "columns `name`, `C`, and `T0` if there is one",
            "\"nodes.csv\"",
        ),
        shaped("boundaries", NAMED, FORMED_FILES, "columns `name`, `T`", "\"boundaries.csv\""),
        shaped(
            "conductors",
            NAMED,
            FORMED_FILES,
            "columns `from`, `to`, and `name`; `G`, `R`, `Gr`, or `h` and `area`",
            "[\"lines.csv\", \"radiation.csv\"]",
        ),
        shaped(
            "sources",
            NAMED,
            FORMED_FILES,
            "columns `into`, `P`, and `name`",
            "\"sources.csv\"",
        ),
    ],
    example: "{ nodes = \"nodes.csv\", conductors = \"conductors.csv\" }",
    elsewhere: &[
        ("node", "did you mean `nodes`?"),
        ("boundary", "did you mean `boundaries`?"),
        ("conductor", "did you mean `conductors`?"),
        ("resistors", "paths between two ends are `conductors`"),
        ("source", "did you mean `sources`?"),
        ("radiation", "paths by radiation are `conductors`, with a column `Gr [m^2]`"),
        ("convection", "films are `conductors`, with columns `h [W/(m^2 K)]` and `area [m^2]`"),
    ],
    ..SectionDeclaration::NEW
};

/// The files that it names.
pub(crate) fn files(raw: &RawNetlist) -> impl Iterator<Item = (&str, &RawValue)> {
    let keys = raw.elements(IMPORT.name).iter();
    keys.flat_map(|entry| entry.value.items()).filter_map(RawValue::file)
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
    columns: &["from", "to", "G", "R", "Gr", "h", "area", "name"],
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
        self.files(import, &NODES).into_iter().for_each(|rows| self.nodes_of(rows, default));
    }

    fn nodes_of(&mut self, mut rows: CsvRows<'a>, default: Option<&Initial<'a>>) {
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
        self.files(import, &BOUNDARIES).into_iter().for_each(|rows| self.boundaries_of(rows));
    }

    fn boundaries_of(&mut self, mut rows: CsvRows<'a>) {
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
        let mut before = 0;
        for rows in self.files(import, &CONDUCTORS) {
            before += self.conductors_of(rows, before);
        }
    }

    /// The conductors of a file, and the number of its rows; `before` is that of the files before.
    fn conductors_of(&mut self, mut rows: CsvRows<'a>, before: u32) -> u32 {
        let (from, to) = (self.required_column(&rows, "from"), self.required_column(&rows, "to"));
        let name = self.optional_column(&rows, "name");
        let (Some(from), Some(to), Some((law, columns))) = (from, to, self.law_columns(&rows))
        else {
            self.left_out.paths = true;
            return 0;
        };
        let (first, kind) = (self.builder.conductor_count(), law.declaration().kinds[0]);
        while self.next_row(&mut rows) {
            let path = match columns.as_slice() {
                [one] => Path::new(law, [self.number(&mut rows, one)]),
                all => Path::new(law, self.numbers(&mut rows, all)),
            };
            let ends = (self.end_of(&mut rows, ("from", from)), self.end_of(&mut rows, ("to", to)));
            let (Some(start), Some(end)) = ends else {
                self.left_out.paths = true;
                rows.skip();
                continue;
            };
            match rows.name(name) {
                Some(name) => self.builder.conductor(name, kind, (start, end), path),
                None => {
                    let number = before + rows.count();
                    self.builder.numbered_conductor(number, kind, (start, end), path)
                }
            };
            self.map.conductor(kind.declaration().section);
        }
        let mut fields =
            vec![(Field::Name, name), (Field::From, Some(from)), (Field::To, Some(to))];
        fields.extend(law::fields(law, &columns));
        let count = rows.count();
        self.map.add_import(places(rows, (Kind::Conductor, first), &fields));
        count
    }

    pub(crate) fn import_sources(&mut self, import: Option<&Fields<'a>>) {
        let mut before = 0;
        for rows in self.files(import, &SOURCES) {
            before += self.sources_of(rows, before);
        }
    }

    /// The sources of a file, and the number of its rows; `before` is that of the files before.
    fn sources_of(&mut self, mut rows: CsvRows<'a>, before: u32) -> u32 {
        let into = self.required_column(&rows, "into");
        let power = self.number_column(&rows, "P", Type::of(Dimension::POWER));
        let name = self.optional_column(&rows, "name");
        let (Some(into), Some(power)) = (into, power) else { return 0 };
        let first = self.builder.source_count();
        while self.next_row(&mut rows) {
            let value = self.number(&mut rows, &power);
            let Some(end) = self.end_of(&mut rows, ("into", into)) else {
                rows.skip();
                continue;
            };
            match rows.name(name) {
                Some(name) => self.builder.source(name, end, value),
                None => self.builder.numbered_source(before + rows.count(), end, value),
            };
        }
        let fields =
            [(Field::Name, name), (Field::Into, Some(into)), (Field::POWER, Some(power.index))];
        let count = rows.count();
        self.map.add_import(places(rows, (Kind::Source, first), &fields));
        count
    }

    /// Notes that names may be unknown because a file is missing.
    fn lost(&mut self) {
        self.names.hide_all();
        self.left_out.sections = true;
        self.left_out.paths = true;
        self.left_out.parts = true;
    }
}
