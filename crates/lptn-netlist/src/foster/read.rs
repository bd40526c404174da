//! Reads an R-tau table.

use lptn_data::Diagnostic;
use lptn_network::{Foster, LadderError};
use lptn_units::{Dimension, Expression, Quantity, Type, parse_quantity};

use super::FOSTER;
use crate::fields::{Fields, Owner};
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;

/// A chain as it is written.
pub(super) struct Read<'r> {
    /// Its table. If that is wrong, one rung of 1 J/K and 1 K/W.
    pub(super) terms: Terms,
    /// The end of the chain.
    pub(super) to: Option<&'r RawValue>,
    /// Its initial temperature, if given.
    pub(super) initial: Option<&'r RawEntry>,
    /// True if the end may be a node.
    pub(super) series: bool,
}

/// The table of a chain.
pub(super) enum Terms {
    /// Heat capacities in J/K, each with the resistance after it in K/W, of the ladder with the
    /// impedance of a table of numbers.
    Rungs(Vec<(f64, f64)>),
    /// Resistance and time constant of each row, if one of them follows from parameters or has a
    /// `±`.
    Expressions(Vec<(RawValue, RawValue)>),
}

/// A number of a column.
enum Cell {
    Exact(f64),
    /// It follows from parameters, or has a `±`.
    Open,
}

impl<'r> Read<'r> {
    /// Reads a block and reports its errors.
    pub(super) fn of(entry: &'r RawEntry, problems: &mut Vec<Diagnostic>) -> Self {
        let owner = Owner::element(FOSTER.name, &entry.key);
        let fields = Fields::of(&FOSTER, owner, entry, problems);
        let terms = fields.as_ref().and_then(|fields| Table { fields, problems }.terms());
        let fields = fields.as_ref();
        let series = fields.and_then(|fields| fields.yes_or_no("series", problems).flatten());
        Self {
            terms: terms.unwrap_or_else(|| Terms::Rungs(vec![(1.0, 1.0)])),
            series: series.unwrap_or(false),
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
    fn terms(&mut self) -> Option<Terms> {
        let resistances = self.column("R", Dimension::RESISTANCE);
        let times = self.column("tau", Dimension::TIME);
        let (resistances, times) = (resistances?, times?);
        if resistances.len() != times.len() {
            self.uneven(resistances.len(), times.len());
            return None;
        }
        let exact = |cells: &[Cell]| -> Vec<Option<f64>> {
            cells
                .iter()
                .map(|cell| if let Cell::Exact(x) = cell { Some(*x) } else { None })
                .collect()
        };
        let rows = exact(&resistances).into_iter().zip(exact(&times));
        let terms: Option<Vec<(f64, f64)>> = rows.map(|(r, tau)| r.zip(tau)).collect();
        if let Some(terms) = terms {
            let ladder = Foster::new(0.0, &terms).and_then(|foster| foster.cauer());
            let rungs = ladder.map(|ladder| Terms::Rungs(ladder.rungs));
            return rungs.map_err(|error| self.refuse(&error)).ok();
        }
        // 1 for a number that is not known yet
        let known = |cell: &Cell| if let Cell::Exact(x) = cell { *x } else { 1.0 };
        let known: Vec<_> = resistances.iter().map(known).zip(times.iter().map(known)).collect();
        Foster::new(0.0, &known).map_err(|error| self.refuse(&error)).ok()?;
        if let Some(rows) = same(&times) {
            self.same(rows);
            return None;
        }
        let item = |key, row| self.item(key, row).cloned();
        let rows = (0..known.len()).map(|row| item("R", row).zip(item("tau", row)));
        Some(Terms::Expressions(rows.collect::<Option<_>>()?))
    }

    /// The numbers of a column in SI units.
    fn column(&mut self, key: &'static str, dimension: Dimension) -> Option<Vec<Cell>> {
        let raw = self.fields.require(key, self.problems)?;
        let RawKind::Array(list) = &raw.kind else {
            self.problems.push(self.fields.wrong_shape(key, raw, "a list of quantities"));
            return None;
        };
        all(list.iter().map(|raw| self.value((key, dimension), raw)))
    }

    fn value(&mut self, (key, dimension): (&str, Dimension), raw: &RawValue) -> Option<Cell> {
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => {
                self.problems.push(self.fields.wrong_shape(key, raw, "a list of quantities"));
                return None;
            }
        };
        let found = parse_quantity(text, Some(Type::of(dimension)));
        if found.is_err() && follows(text) {
            return Some(Cell::Open);
        }
        let cell = |quantity: Quantity| match quantity.deviation {
            None => Cell::Exact(quantity.value),
            Some(_) => Cell::Open,
        };
        let place = Place { owner: &self.fields.owner, key, raw };
        found.map(cell).map_err(|e| self.problems.push(place.unit_error(&e))).ok()
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

    /// Two rows of a table with expressions are not put together.
    fn same(&mut self, (first, second): (usize, usize)) {
        let message = format!(
            "rows {} and {} of {} have the same time constant",
            first + 1,
            second + 1,
            self.fields.owner.words()
        );
        let item = |row| self.item("tau", row).map(|raw| raw.span.clone());
        let problem = Diagnostic::error("netlist::foster_same", message).at(item(second), "");
        let problem = problem.help("write one row with the sum of their resistances");
        self.problems.push(problem);
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

/// True for an expression that names something.
fn follows(text: &str) -> bool {
    Expression::parse(text).is_ok_and(|expression| !expression.names().is_empty())
}

/// Two rows whose time constants are the same number.
fn same(times: &[Cell]) -> Option<(usize, usize)> {
    let equal = |a: &Cell, b: &Cell| match (a, b) {
        (Cell::Exact(a), Cell::Exact(b)) => a.total_cmp(b).is_eq(),
        _ => false,
    };
    let first = |second: usize| times[..second].iter().position(|a| equal(a, &times[second]));
    (1..times.len()).find_map(|second| Some((first(second)?, second)))
}
