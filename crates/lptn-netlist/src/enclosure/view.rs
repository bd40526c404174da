//! View factors of an enclosure: reciprocity, and sums of 1.

use lptn_data::Diagnostic;
use lptn_units::{Type, format_short, parse_quantity, suggest};

use super::surface::Surface;
use crate::fields::Fields;
use crate::raw::{RawKind, RawValue};
use crate::reading::all;

/// The view factors of a surface sum to 1 within this; published factors have two or three digits.
const ROUNDED: f64 = 5e-3;

/// Reads the view factors of these surfaces.
pub(super) struct Views<'v, 'r> {
    pub(super) fields: &'v Fields<'r>,
    pub(super) surfaces: &'v [Surface<'r>],
    pub(super) problems: &'v mut Vec<Diagnostic>,
}

/// A row of the list: two surfaces and the factor from the first to the second.
struct Row<'r> {
    pair: [usize; 2],
    factor: f64,
    raw: &'r RawValue,
}

impl<'r> Views<'_, 'r> {
    /// A F of each pair in m^2; `None` if a row is wrong or the enclosure is open.
    pub(super) fn exchange(mut self, raw: &'r RawValue) -> Option<Vec<(usize, usize, f64)>> {
        let RawKind::Array(rows) = &raw.kind else {
            self.problems.push(self.fields.wrong_shape(
                "view_factors",
                raw,
                "a list of [from, to, F]",
            ));
            return None;
        };
        let rows = all(rows.iter().map(|row| self.row(row)))?;
        let mut known: Vec<&Row<'_>> = Vec::new();
        let mut fits = true;
        for row in &rows {
            match known.iter().find(|other| same(other.pair, row.pair)) {
                Some(other) => fits &= self.agrees(other, row),
                None => known.push(row),
            }
        }
        fits.then_some(())?;
        let exchange = |row: &&Row<'_>| {
            let [i, j] = row.pair;
            (i, j, self.surfaces[i].area * row.factor)
        };
        let all: Vec<_> = known.iter().map(exchange).collect();
        self.closed(&all, raw)?;
        Some(all.into_iter().filter(|(i, j, area)| i != j && *area > 0.0).collect())
    }

    fn row(&mut self, raw: &'r RawValue) -> Option<Row<'r>> {
        let parts = match &raw.kind {
            RawKind::Array(list) => list.as_slice(),
            _ => &[],
        };
        let [from, to, factor] = parts else {
            let problem = self.fields.wrong_shape("view_factors", raw, "a list of [from, to, F]");
            self.problems.push(problem);
            return None;
        };
        let (from, to, factor) = (self.surface(from), self.surface(to), self.factor(factor));
        Some(Row { pair: [from?, to?], factor: factor?, raw })
    }

    fn surface(&mut self, raw: &RawValue) -> Option<usize> {
        let name = match &raw.kind {
            RawKind::String { text, .. } => text.as_str(),
            _ => "",
        };
        let found = self.surfaces.iter().position(|surface| surface.name == name);
        if found.is_none() {
            let message = format!("{} has no surface `{name}`", self.fields.owner.words());
            let problem = Diagnostic::error("netlist::enclosure_view", message);
            let names: Vec<&str> = self.surfaces.iter().map(|surface| surface.name).collect();
            let help = match suggest(name, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("its surfaces are `{}`", names.join("`, `")),
            };
            self.problems.push(problem.at(raw.span.clone(), "").help(help));
        }
        found
    }

    fn factor(&mut self, raw: &RawValue) -> Option<f64> {
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => "",
        };
        let found = parse_quantity(text, Some(Type::SCALAR)).ok().map(|found| found.value);
        let found = found.filter(|value| (0.0..=1.0).contains(value));
        if found.is_none() {
            let message = format!(
                "a view factor of {} must be a number from 0 to 1",
                self.fields.owner.words()
            );
            let problem = Diagnostic::error("netlist::enclosure_view", message);
            let help = "view factors are geometry: numbers, without parameters";
            self.problems.push(problem.at(raw.span.clone(), "").help(help));
        }
        found
    }

    /// A pair that is given twice has to obey A_i F_ij = A_j F_ji.
    fn agrees(&mut self, first: &Row<'_>, second: &Row<'_>) -> bool {
        let area = |row: &Row<'_>| self.surfaces[row.pair[0]].area * row.factor;
        let (a, b) = (area(first), area(second));
        let again = first.pair == second.pair;
        if !again && (a - b).abs() <= ROUNDED * a.max(b) {
            return true;
        }
        let [i, j] = second.pair.map(|i| self.surfaces[i].name);
        let message = match again {
            true => format!("the view factor from `{i}` to `{j}` is given twice"),
            false => format!(
                "the view factors between `{j}` and `{i}` do not fit: A F is {} and {} m^2",
                format_short(a),
                format_short(b)
            ),
        };
        let problem = Diagnostic::error("netlist::enclosure_view", message);
        let problem = problem.at(second.raw.span.clone(), "").also(first.raw.span.clone(), "first");
        self.problems
            .push(problem.help("give one direction only: the other follows from the areas"));
        false
    }

    /// Checks that each surface sees surfaces of the enclosure only.
    fn closed(&mut self, exchange: &[(usize, usize, f64)], raw: &RawValue) -> Option<()> {
        let mut open = false;
        for (k, surface) in self.surfaces.iter().enumerate() {
            let seen = exchange.iter().filter(|(i, j, _)| *i == k || *j == k);
            let sum = seen.map(|(_, _, area)| area).sum::<f64>() / surface.area;
            let sees_others =
                exchange.iter().any(|(i, j, area)| (*i == k) != (*j == k) && *area > 0.0);
            if (sum - 1.0).abs() <= ROUNDED && sees_others {
                continue;
            }
            open = true;
            let problem = self.not_closed(surface, (sum, sees_others));
            self.problems
                .push(problem.at(surface.at.clone(), "").also(raw.span.clone(), "view factors"));
        }
        (!open).then_some(())
    }

    fn not_closed(&self, surface: &Surface<'_>, (sum, sees_others): (f64, bool)) -> Diagnostic {
        let (name, of) = (surface.name, self.fields.owner.words());
        let rest = format_short(1.0 - sum);
        let (message, help) = match sees_others {
            false => (
                format!("surface `{name}` of {of} sees no other surface"),
                "add its view factors, or leave it out".to_owned(),
            ),
            true if sum > 1.0 => (
                format!(
                    "the view factors of surface `{name}` of {of} sum to {}",
                    format_short(sum)
                ),
                "they sum to 1, those that follow from other rows by A_i F_ij = A_j F_ji included"
                    .to_owned(),
            ),
            true => (
                format!(
                    "the view factors of surface `{name}` of {of} sum to {}",
                    format_short(sum)
                ),
                format!(
                    "add the {rest} that is missing: of itself, `[\"{name}\", \"{name}\", {rest}]`, \
                     or of another surface, such as a boundary for the surroundings"
                ),
            ),
        };
        Diagnostic::error("netlist::enclosure_open", message).help(help)
    }
}

/// True for the same two surfaces, in any order.
fn same([a, b]: [usize; 2], other: [usize; 2]) -> bool {
    other == [a, b] || other == [b, a]
}
