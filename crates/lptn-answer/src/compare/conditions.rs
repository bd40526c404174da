//! Conditions of the candidates: ambient temperatures, heat of the sources, length. Candidates that
//! differ in them are not judged alike, so the comparison doubts itself.
//!
//! Variants of one netlist may differ on purpose: only candidates with one label are compared.

use lptn_netlist::Diagnostic;
use lptn_report::{duration, significant};
use lptn_study::{Candidate, HeatOver};

use super::{CompareAnswer, page};
use crate::input::Input;

/// Temperatures in K and other conditions, relative, that differ by less are the same.
const SAME: (f64, f64) = (0.005, 0.01);

/// A boundary with its temperature in K at the start; NaN if it is not known.
pub(super) type Ambient = (String, f64);

/// A condition with the text of each candidate that has it.
pub(super) struct Condition {
    pub(super) name: String,
    /// By row; `None` if the candidate does not have it.
    pub(super) cells: Vec<Option<(f64, String)>>,
}

impl Condition {
    /// True if two of these rows differ by more than a share, or by more than a difference.
    fn differs(&self, rows: &[usize], (apart, share): (f64, f64)) -> Option<[usize; 2]> {
        let value = |row: usize| Some(self.cells[row].as_ref()?.0).filter(|x| x.is_finite());
        let known = || rows.iter().filter_map(|&row| Some((row, value(row)?)));
        let (low, least) = known().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let (high, most) = known().max_by(|a, b| a.1.total_cmp(&b.1))?;
        (most - least > apart.max(share * most.abs())).then_some([low.min(high), low.max(high)])
    }
}

impl CompareAnswer {
    /// Ambient temperatures, one for each boundary.
    pub(super) fn ambients(&self) -> Vec<Condition> {
        let all: Vec<Vec<Ambient>> =
            self.inputs.iter().map(|input| input.as_deref().map_or(Vec::new(), ambient)).collect();
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in all.iter().flatten() {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        let text = |kelvin: f64| {
            format!("{} {}", significant(self.unit.from_si(kelvin), 5), self.unit.text)
        };
        let one = |name: &str| {
            let of = |row: &Vec<Ambient>| row.iter().find(|own| own.0 == name).map(|own| own.1);
            let cells = all.iter().map(|row| of(row).map(|kelvin| (kelvin, text(kelvin))));
            Condition { name: name.to_owned(), cells: cells.collect() }
        };
        names.into_iter().map(one).collect()
    }

    /// The mean heat flow of all sources.
    pub(super) fn duty(&self) -> Condition {
        let text = |watts: f64| format!("{} W", significant(watts, 4));
        self.condition("heat of the sources", &|c| Some((c.heat.duty, text(c.heat.duty))))
    }

    /// The time over which candidates are judged.
    pub(super) fn length(&self) -> Condition {
        let text = |of: &Candidate, length: f64| match of.heat.over {
            HeatOver::Cycle => format!("a cycle of {}", duration(length, 4)),
            _ => duration(length, 4),
        };
        self.condition("judged over", &|c| match c.heat.length {
            Some(length) => Some((length, text(c, length))),
            None => Some((0.0, "steady state".to_owned())),
        })
    }

    fn condition(
        &self,
        name: &str,
        cell: &dyn Fn(&Candidate) -> Option<(f64, String)>,
    ) -> Condition {
        let cells = self.rows.iter().map(|row| row.candidate().and_then(cell)).collect();
        Condition { name: name.to_owned(), cells }
    }

    /// A doubt for each condition in which candidates of one label differ.
    pub(super) fn conditions(&self) -> Vec<Diagnostic> {
        let names = page::names(&self.rows);
        let mut labels = self.labels.clone();
        labels.sort_unstable();
        labels.dedup();
        let groups: Vec<Vec<usize>> = labels
            .iter()
            .map(|label| (0..self.rows.len()).filter(|&row| self.labels[row] == *label).collect())
            .collect();
        let alone = |condition: &Condition, same: (f64, f64)| {
            groups.iter().find_map(|rows| condition.differs(rows, same))
        };
        let doubt = |condition: &Condition, [a, b]: [usize; 2], what: &str, help: &str| {
            let cell = |row: usize| match &condition.cells[row] {
                Some((_, text)) => format!("{text} in {}", names[row]),
                None => String::new(),
            };
            let message = format!("candidates differ in {what}: {}, {}", cell(a), cell(b));
            Diagnostic::warning("compare::conditions_differ", message).help(help)
        };
        let ambients = self.ambients().into_iter().filter_map(|of| {
            let pair = alone(&of, (SAME.0, 0.0))?;
            Some(doubt(&of, pair, &format!("the temperature of `{}`", of.name), AMBIENT))
        });
        let (duty, length) = (self.duty(), self.length());
        let heat = alone(&duty, (0.0, SAME.1))
            .map(|at| doubt(&duty, at, "the heat of their sources", DUTY));
        let time = alone(&length, (0.0, 1e-9))
            .map(|at| doubt(&length, at, "the time they are judged over", LENGTH));
        ambients.chain(heat).chain(time).collect()
    }
}

const AMBIENT: &str =
    "make it the same parameter in every netlist, and give it one value with --set";

const DUTY: &str = "give every netlist the same sources; losses that depend on temperature differ \
                    with the design";

const LENGTH: &str = "give every netlist the same `stop` in [run]";

/// The temperature of each boundary at the start.
fn ambient(input: &Input) -> Vec<Ambient> {
    let network = &input.netlist.network;
    let mut scope = network.evaluation();
    let start = input.netlist.run.as_ref().map_or(0.0, |run| run.start);
    scope.set_time(start, start);
    let value = |boundary: &lptn_network::Boundary| {
        let kelvin = boundary.temperature.at(&mut scope).unwrap_or(f64::NAN);
        (boundary.name.clone(), kelvin)
    };
    network.boundaries().iter().map(value).collect()
}
