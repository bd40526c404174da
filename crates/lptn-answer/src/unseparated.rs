//! Estimated quantities by name, and texts on those that cannot be distinguished.

use lptn_fit::network::{Combination, CombinationKind, Unknown, Unseparated};
use lptn_report::significant;
use lptn_units::{Rational, Type, Unit};

use crate::input::Input;
use crate::words::spaced;

/// Digits of a value of unknown accuracy.
const DIGITS: usize = 5;

/// Estimated quantities with their names and units.
pub struct Named<'a> {
    /// The estimated quantities.
    pub unknowns: &'a [Unknown],
    /// Their names, in the order of `unknowns`.
    pub names: &'a [String],
    /// The units in which they are shown.
    pub units: &'a [Unit],
    /// In SI units.
    pub values: Vec<f64>,
}

/// Names and units of unknowns.
/// An unknown of one record has the name of the record in its own.
pub fn names_and_units(
    input: &Input,
    unknowns: &[Unknown],
    records: &[String],
) -> (Vec<String>, Vec<Unit>) {
    let name = |unknown: &Unknown| match unknown.run() {
        Some(run) => format!("{} ({})", unknown.name, records[run]),
        None => unknown.name.clone(),
    };
    let si = |ty: Type| Unit { text: ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty };
    let unit = |unknown: &Unknown| match unknown.parameter() {
        Some(parameter) => input.unit_of(parameter),
        None => si(unknown.ty),
    };
    (unknowns.iter().map(name).collect(), unknowns.iter().map(unit).collect())
}

impl Named<'_> {
    /// "`P`, `R` and `C`".
    pub fn listed(&self, of: &[usize]) -> String {
        let names: Vec<String> = of.iter().map(|&i| format!("`{}`", self.names[i])).collect();
        joined(&names)
    }

    /// "P R", "P / C", "2 G1 + G2".
    pub fn combination(&self, combination: &Combination) -> String {
        let name = |i: usize| self.names[i].to_owned();
        match combination.kind {
            CombinationKind::Product => {
                let power = |(i, c): (usize, i32)| {
                    if c == 1 { name(i) } else { format!("{}^{c}", name(i)) }
                };
                let side = |sign: i32| -> Vec<String> {
                    let terms = combination.terms.iter().filter(|(_, c)| c.signum() == sign);
                    terms.map(|&(i, c)| power((i, c.abs()))).collect()
                };
                let (above, below) = (side(1).join(" "), side(-1));
                match below.len() {
                    0 => above,
                    1 => format!("{above} / {}", below[0]),
                    _ => format!("{above} / ({})", below.join(" ")),
                }
            }
            CombinationKind::Sum => {
                let mut text = String::new();
                for &(i, c) in &combination.terms {
                    let sign = match (text.is_empty(), c < 0) {
                        (true, _) => "",
                        (false, true) => " - ",
                        (false, false) => " + ",
                    };
                    let factor = if c.abs() == 1 { String::new() } else { format!("{} ", c.abs()) };
                    text += &format!("{sign}{factor}{}", name(i));
                }
                text
            }
        }
    }

    /// The type of a combination; `None` if its exponents cannot be represented.
    pub fn type_of(&self, combination: &Combination) -> Option<Type> {
        let own = |i: usize| self.unknowns[i].ty;
        if combination.kind == CombinationKind::Sum {
            return combination.terms.first().map(|&(i, _)| own(i));
        }
        let mut dimension = Type::SCALAR.dimension;
        for &(i, c) in &combination.terms {
            let factor = own(i).dimension.checked_pow(Rational::integer(c))?;
            dimension = dimension.checked_mul(factor)?;
        }
        Some(Type::of(dimension))
    }

    /// "67.2 K".
    fn value_of(&self, combination: &Combination) -> String {
        let Some(ty) = self.type_of(combination) else {
            return significant(combination.value, DIGITS);
        };
        let unit = match combination.kind {
            CombinationKind::Sum => combination.terms.first().map(|&(i, _)| self.units[i].clone()),
            CombinationKind::Product => Unit::parse(&ty.usual_unit()).ok(),
        };
        match unit {
            Some(unit) if unit.text != "1" => {
                format!("{} {}", significant(unit.from_si(combination.value), DIGITS), unit.text)
            }
            _ => significant(combination.value, DIGITS),
        }
    }

    /// Text on parameters that cannot be distinguished: determined combinations, and remedies.
    pub fn unseparated(&self, group: &Unseparated) -> String {
        let example = group.parameters.last().map_or("", |&i| &self.names[i]);
        let fix = match group.missing {
            1 => format!("fix one, for example give {example} a prior with `±`"),
            n => format!("fix {n} of them, for example give {example} a prior with `±`"),
        };
        match &group.determined {
            Some(determined) if !determined.is_empty() => {
                let texts: Vec<String> = determined.iter().map(|c| self.combination(c)).collect();
                let values: Vec<String> = determined.iter().map(|c| self.value_of(c)).collect();
                let verb = if texts.len() == 1 { "is" } else { "are" };
                format!(
                    "only {} {verb} determined (here {}); {fix}",
                    joined(&texts),
                    joined(&values)
                )
            }
            Some(_) => {
                format!("nothing of {} is determined; {fix}", self.listed(&group.parameters))
            }
            None => {
                let change = |direction: &Vec<f64>| {
                    let parts =
                        group.parameters.iter().zip(direction).filter(|(_, d)| d.abs() > 0.0);
                    let largest = self.relative(group, direction);
                    let part = |(&i, d): (&usize, &f64)| self.percent(i, d / largest);
                    parts.map(part).collect::<Vec<_>>()
                };
                let changes: Vec<String> =
                    group.directions.iter().map(|d| joined(&change(d))).collect();
                format!(
                    "{} cannot be distinguished: {} together leave every column unchanged; {fix}",
                    self.listed(&group.parameters),
                    changes.join(", or ")
                )
            }
        }
    }

    /// Size of an unknown for relative changes, in SI units.
    /// It is 100 K for temperatures and offsets, whose zero is arbitrary, and 100 of the SI unit for
    /// a value of 0, of which there is no share.
    fn size(&self, i: usize) -> f64 {
        const ARBITRARY: f64 = 100.0;
        let value = self.values[i].abs();
        if self.unknowns[i].is_shift() || value <= 0.0 { ARBITRARY } else { value }
    }

    /// The largest relative change of a direction, so that divided by it the largest is 1 %.
    fn relative(&self, group: &Unseparated, direction: &[f64]) -> f64 {
        let all = group.parameters.iter().zip(direction).map(|(&i, d)| d.abs() / self.size(i));
        100.0 * all.fold(0.0, f64::max)
    }

    /// "R +1 %", "tc1.offset -0.5 K".
    fn percent(&self, i: usize, change: f64) -> String {
        let sign = if change < 0.0 { "" } else { "+" };
        if self.unknowns[i].is_shift() {
            return format!("{} {sign}{} K", self.names[i], significant(change, 3));
        }
        if self.values[i].abs() <= 0.0 {
            let unit = spaced(&self.unknowns[i].ty.dimension.si_unit());
            return format!("{} {sign}{}{unit}", self.names[i], significant(change, 3));
        }
        let part = significant(100.0 * change / self.size(i), 3);
        format!("{} {sign}{part} %", self.names[i])
    }
}

/// "a, b and c".
pub fn joined(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [only] => only.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}
