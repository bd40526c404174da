//! Reads an R-tau table.

use lptn_data::Diagnostic;
use lptn_network::{Cauer, Foster, LadderError};
use lptn_units::{Dimension, Type, parse_quantity};

use super::FOSTER;
use crate::fields::{Fields, Owner};
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;

/// A chain as it is written.
pub(super) struct Read<'r> {
    /// Heat capacities in J/K, each with the resistance after it in K/W, of the ladder with the
    /// impedance of the table. If the table is wrong, one rung of 1 J/K and 1 K/W.
    pub(super) rungs: Vec<(f64, f64)>,
    /// The end of the chain.
    pub(super) to: Option<&'r RawValue>,
    /// Its initial temperature, if given.
    pub(super) initial: Option<&'r RawEntry>,
}

impl<'r> Read<'r> {
    /// Reads a block and reports its errors.
    pub(super) fn of(entry: &'r RawEntry, problems: &mut Vec<Diagnostic>) -> Self {
        let owner = Owner::element(FOSTER.name, &entry.key);
        let fields = Fields::of(&FOSTER, owner, entry, problems);
        let ladder = fields.as_ref().and_then(|fields| Table { fields, problems }.ladder());
        let fields = fields.as_ref();
        Self {
            rungs: ladder.map_or_else(|| vec![(1.0, 1.0)], |ladder| ladder.rungs),
            to: fields.and_then(|fields| fields.require("to", problems)),
            initial: fields.and_then(|fields| fields.entry("T0")),
        }
    }
}

/// The columns of a table; reports the errors of each.
struct Table<'f, 'r> {
    fields: &'f Fields<'r>,
    problems: &'f mut Vec<Diagnostic>,
}

impl<'r> Table<'_, 'r> {
    fn ladder(&mut self) -> Option<Cauer> {
        let resistances = self.column("R", Dimension::RESISTANCE);
        let times = self.column("tau", Dimension::TIME);
        let (resistances, times) = (resistances?, times?);
        if resistances.len() != times.len() {
            self.uneven(resistances.len(), times.len());
            return None;
        }
        let terms: Vec<(f64, f64)> = resistances.into_iter().zip(times).collect();
        let ladder = Foster::new(0.0, &terms).and_then(|foster| foster.cauer());
        ladder.map_err(|error| self.refuse(&error)).ok()
    }

    /// The numbers of a column in SI units.
    fn column(&mut self, key: &'static str, dimension: Dimension) -> Option<Vec<f64>> {
        let raw = self.fields.require(key, self.problems)?;
        let RawKind::Array(list) = &raw.kind else {
            self.problems.push(self.fields.wrong_shape(key, raw, "a list of quantities"));
            return None;
        };
        all(list.iter().map(|raw| self.value((key, dimension), raw)))
    }

    fn value(&mut self, (key, dimension): (&str, Dimension), raw: &RawValue) -> Option<f64> {
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => {
                self.problems.push(self.fields.wrong_shape(key, raw, "a list of quantities"));
                return None;
            }
        };
        let found = parse_quantity(text, Some(Type::of(dimension)));
        let place = Place { owner: &self.fields.owner, key, raw };
        found
            .map(|quantity| quantity.value)
            .map_err(|e| self.problems.push(place.unit_error(&e)))
            .ok()
    }

    fn uneven(&mut self, resistances: usize, times: usize) {
        let message =
            format!("{} has {resistances} of `R` and {times} of `tau`", self.fields.owner.words());
        let places = ["R", "tau"]
            .into_iter()
            .filter_map(|key| Some((self.fields.key(key)?.clone(), format!("`{key}` here"))));
        let problem = Diagnostic::error("netlist::foster_rows", message).places(places);
        self.problems.push(problem.help("each row of the table has one of both"));
    }

    /// Reports that there is no ladder, at the wrong number if there is one.
    fn refuse(&mut self, error: &LadderError) {
        let at = match error {
            LadderError::NotPositive { what: "time constant", row, .. } => self.item("tau", *row),
            LadderError::NotPositive { row, .. } => self.item("R", *row),
            _ => self.fields.get("R"),
        };
        let message = format!("{}: {error}", self.fields.owner.words());
        let place = at.map_or(self.fields.place, |raw| &raw.span);
        let problem = Diagnostic::error(error.code(), message).at(place.clone(), "");
        self.problems.push(problem.help(error.help()));
    }

    fn item(&self, key: &str, row: usize) -> Option<&'r RawValue> {
        match &self.fields.get(key)?.kind {
            RawKind::Array(list) => list.get(row),
            _ => None,
        }
    }
}
