//! `[import]`: elements from CSV files, by the million. Rows are read one after the other and nothing is kept of them
//! but what the network needs.

mod column;
mod places;
mod sheet;

use lptn_network::{ConductorKind, Field, Path};
use lptn_units::{Dimension, Type};

pub(crate) use places::Places;

use crate::elaborate::Elaboration;
use crate::fields::{Fields, Owner};
use crate::import::column::Column;
use crate::import::places::Kind;
use crate::raw::RawKind;
use crate::section::Initial;
use crate::vocabulary::IMPORT;

const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

/// What a file holds: the key that names it, and its columns.
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
const CONDUCTORS: Contents =
    Contents { key: "conductors", columns: &["from", "to", "G", "R", "name"], example: "from,to,G [W/K]" };
const SOURCES: Contents = Contents { key: "sources", columns: &["into", "P", "name"], example: "into,P [W]" };

impl<'a> Elaboration<'a> {
    /// The fields of `[import]`.
    pub(crate) fn import(&mut self) -> Option<Fields<'a>> {
        let entry = self.raw.top.get(IMPORT.name)?;
        if !matches!(entry.value.kind, RawKind::Table(_)) {
            self.lost(); // which has been reported
            return None;
        }
        let fields = Fields::of(&IMPORT, Owner::section(IMPORT.name), entry, &mut self.problems);
        if fields.as_ref().is_none_or(|fields| !fields.complete) {
            self.lost(); // the unknown key may be what names the nodes
        }
        fields
    }

    pub(crate) fn import_nodes(&mut self, import: Option<&Fields<'a>>, default: Option<&Initial<'a>>) {
        let Some(mut sheet) = self.sheet(import, &NODES) else { return };
        let name = self.required_column(&sheet, "name");
        let capacity = self.number_column(&sheet, "C", Type::of(Dimension::CAPACITY));
        let initial = sheet.has("T0").then(|| self.number_column(&sheet, "T0", ABSOLUTE));
        let (Some(name), Some(capacity), Some(initial)) =
            (name, capacity, initial.map_or(Some(None), |column| column.map(Some)))
        else {
            return self.lost();
        };
        sheet.first = self.builder.node_count();
        while self.next_row(&mut sheet) {
            let given = |column: &Column| !(sheet.sound && sheet.cell(column.index).is_empty());
            let (stores, starts) = (given(&capacity), initial.as_ref().is_some_and(given));
            let own = initial.as_ref().filter(|_| starts).map(|column| self.number(&mut sheet, column));
            let capacity = stores.then(|| self.number(&mut sheet, &capacity));
            let initial = own.or_else(|| default.map(|(input, _)| input.clone()));
            if self.is_named(&mut sheet, name) {
                self.builder.add_node(sheet.cell(name), capacity, initial, !stores);
            }
        }
        let fields = [(Field::Capacity, Some(capacity.index)), (Field::Initial, initial.map(|c| c.index))];
        self.map.add_import(sheet.places(Kind::Node, Some(name), &fields));
    }

    pub(crate) fn import_boundaries(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut sheet) = self.sheet(import, &BOUNDARIES) else { return };
        let (name, temperature) =
            (self.required_column(&sheet, "name"), self.number_column(&sheet, "T", ABSOLUTE));
        let (Some(name), Some(temperature)) = (name, temperature) else { return self.lost() };
        sheet.first = self.builder.boundary_count();
        while self.next_row(&mut sheet) {
            let value = self.number(&mut sheet, &temperature);
            if self.is_named(&mut sheet, name) {
                self.builder.boundary(sheet.cell(name), value);
            }
        }
        let fields = [(Field::Temperature, Some(temperature.index))];
        self.map.add_import(sheet.places(Kind::Boundary, Some(name), &fields));
    }

    pub(crate) fn import_conductors(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut sheet) = self.sheet(import, &CONDUCTORS) else { return };
        let (from, to) = (self.required_column(&sheet, "from"), self.required_column(&sheet, "to"));
        let name = self.optional_column(&sheet, "name");
        let (Some(from), Some(to), Some((column, law))) = (from, to, self.law_column(&sheet)) else {
            self.doubts.paths = true;
            return;
        };
        sheet.first = self.builder.conductor_count();
        while self.next_row(&mut sheet) {
            let value = self.number(&mut sheet, &column);
            let path = Path::new(law, [value]);
            let ends = (self.end_of(&mut sheet, ("from", from)), self.end_of(&mut sheet, ("to", to)));
            let (Some(start), Some(end)) = ends else {
                self.doubts.paths = true;
                sheet.skip();
                continue;
            };
            let kind = ConductorKind::Resistor;
            match sheet.name(name) {
                Some(name) => self.builder.conductor(name, kind, (start, end), path),
                None => self.builder.numbered_conductor(sheet.number(), kind, (start, end), path),
            };
            self.map.conductor("resistor");
        }
        let key = law.declaration().fields[0].key;
        let fields = [
            (Field::From, Some(from)),
            (Field::To, Some(to)),
            (Field::of_law(key).unwrap_or(Field::Value), Some(column.index)),
        ];
        self.map.add_import(sheet.places(Kind::Conductor, name, &fields));
    }

    pub(crate) fn import_sources(&mut self, import: Option<&Fields<'a>>) {
        let Some(mut sheet) = self.sheet(import, &SOURCES) else { return };
        let into = self.required_column(&sheet, "into");
        let power = self.number_column(&sheet, "P", Type::of(Dimension::POWER));
        let name = self.optional_column(&sheet, "name");
        let (Some(into), Some(power)) = (into, power) else { return };
        sheet.first = self.builder.source_count();
        while self.next_row(&mut sheet) {
            let value = self.number(&mut sheet, &power);
            let Some(end) = self.end_of(&mut sheet, ("into", into)) else {
                sheet.skip();
                continue;
            };
            match sheet.name(name) {
                Some(name) => self.builder.source(name, end, value),
                None => self.builder.numbered_source(sheet.number(), end, value),
            };
        }
        let fields = [(Field::Into, Some(into)), (Field::Power, Some(power.index))];
        self.map.add_import(sheet.places(Kind::Source, name, &fields));
    }

    /// What the absence of a file makes uncertain.
    fn lost(&mut self) {
        self.names.hide_all();
        self.doubts.sections = true;
        self.doubts.paths = true;
        self.doubts.parts = true;
    }
}
