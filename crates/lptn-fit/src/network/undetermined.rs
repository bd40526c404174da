//! Parameters that undetermined directions connect, and their determined combinations.

use crate::network::combination::{CombinationKind, combinations};

/// A parameter takes part in an undetermined direction if its share of it is larger than this.
const SHARE: f64 = 1e-4;

/// A displacement along an undetermined direction may change the residuals by this part of the
/// change that it would cause if its parameters were determined.
const UNCHANGED: f64 = 1e-2;

/// Distance by which the parameters are moved to check that a direction stays undetermined: a
/// change of a logarithm.
const MOVED: f64 = 0.2;

/// A combination of parameters that is determined although they are not.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Product or sum.
    pub kind: CombinationKind,
    /// Index among the varied parameters, and exponent or factor.
    pub terms: Vec<(usize, i32)>,
    /// Its value in SI units.
    pub value: f64,
}

/// Parameters that cannot be distinguished from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Unseparated {
    /// Their indices among the varied parameters.
    pub parameters: Vec<usize>,
    /// Number of them that have to be known from elsewhere.
    pub missing: usize,
    /// Their determined combinations; `None` if these are not simple products or sums.
    pub determined: Option<Vec<Combination>>,
    /// Changes, in SI units, that leave every column as it is to first order: one list for each
    /// missing one.
    pub directions: Vec<Vec<f64>>,
}

impl Unseparated {
    /// Parameters that would make the others distinguishable if they were known.
    pub(crate) fn held(&self) -> Vec<usize> {
        let only = |k: usize, c: usize| {
            (0..self.directions.len())
                .all(|other| other == k || self.directions[other][c].abs() <= 0.0)
        };
        let pivot =
            |(k, d): (usize, &Vec<f64>)| (0..d.len()).find(|&c| d[c].abs() > 0.0 && only(k, c));
        self.directions.iter().enumerate().filter_map(pivot).map(|c| self.parameters[c]).collect()
    }
}

/// State of the parameters.
pub(crate) struct Place<'a> {
    /// Derivatives of the residuals by the parameters, one parameter after the other.
    pub(crate) jacobian: &'a [f64],
    /// Values in SI units.
    pub(crate) values: &'a [f64],
    /// Unit of each parameter; its value if it counts as its logarithm.
    pub(crate) scales: &'a [f64],
    /// Singular values and columns below this part of the largest count as 0: derivatives are not
    /// more accurate.
    pub(crate) accuracy: f64,
    /// True if parameters `i` and `j` can be added.
    pub(crate) addable: &'a dyn Fn(usize, usize) -> bool,
}

impl Place<'_> {
    pub(crate) fn is_logarithmic(&self, i: usize) -> bool {
        self.values[i] > 0.0 && (self.scales[i] - self.values[i]).abs() <= 0.0
    }
}

/// Parameters that undetermined directions connect, with those directions in scaled parameters.
pub(crate) struct Group {
    members: Vec<usize>,
    directions: Vec<Vec<f64>>,
}

/// Parts the parameters into groups that no undetermined direction connects.
pub(crate) fn groups(felt: &[usize], unseen: &[Vec<f64>]) -> Vec<Group> {
    let n = felt.len();
    let tie = |i: usize, j: usize| unseen.iter().map(|d| d[i] * d[j]).sum::<f64>();
    let mut left: Vec<usize> = (0..n).filter(|&i| tie(i, i) > SHARE * SHARE).collect();
    let mut groups = Vec::new();
    while let Some(first) = left.first().copied() {
        let mut members = vec![first];
        let mut next = 0;
        while next < members.len() {
            let at = members[next];
            let tied = |i: &usize| !members.contains(i) && tie(at, *i).abs() > SHARE * SHARE;
            let more: Vec<usize> = left.iter().copied().filter(tied).collect();
            members.extend(more);
            next += 1;
        }
        members.sort_unstable();
        left.retain(|i| !members.contains(i));
        let directions =
            basis(unseen.iter().map(|d| members.iter().map(|&i| d[i]).collect()).collect());
        groups.push(Group { members: members.iter().map(|&i| felt[i]).collect(), directions });
    }
    groups
}

/// A reduced basis of the span of some directions: each has a 1 at a place where the others have a
/// 0. Parts of directions below [`SHARE`] count as 0.
fn basis(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..columns {
        let place = |rows: &[Vec<f64>]| {
            let all = rows
                .iter()
                .enumerate()
                .flat_map(|(r, row)| row.iter().enumerate().map(move |(c, x)| (r, c, x.abs())));
            all.max_by(|a, b| a.2.total_cmp(&b.2))
        };
        let Some((row, column, size)) = place(&rows) else { break };
        if size <= SHARE {
            break;
        }
        let pivot = rows.swap_remove(row);
        let pivot: Vec<f64> = pivot.iter().map(|x| x / pivot[column]).collect();
        let clear = |row: &mut Vec<f64>| {
            let factor = row[column];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            row[column] = 0.0;
        };
        rows.iter_mut().for_each(clear);
        found.iter_mut().for_each(clear);
        found.push(pivot);
    }
    found
}

impl Group {
    /// The determined combinations of the group, if these are products or sums of whole numbers.
    pub(crate) fn named(
        self,
        place: &Place<'_>,
        (before, length): (Option<&[f64]>, &dyn Fn(usize) -> f64),
        misfit: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
    ) -> Unseparated {
        let changes = |direction: &Vec<f64>| -> Vec<f64> {
            direction.iter().zip(&self.members).map(|(d, &i)| d * place.scales[i]).collect()
        };
        let plain: Vec<Vec<f64>> = self.directions.iter().map(changes).collect();
        let products = self.members.iter().all(|&i| place.is_logarithmic(i));
        let sums = self.members.iter().all(|&i| (place.addable)(self.members[0], i));
        let mut determined = None;
        for (kind, possible, directions) in [
            (CombinationKind::Product, products, &self.directions),
            (CombinationKind::Sum, sums, &plain),
        ] {
            if !possible || determined.is_some() {
                continue;
            }
            let Some(found) = combinations(directions, self.members.len()) else { continue };
            let holds = self.directions.iter().all(|direction| {
                let moved = self.moved(place, kind, direction);
                stays(
                    before,
                    moved.as_deref().and_then(&mut *misfit).as_deref(),
                    self.expected(direction, length),
                )
            });
            if holds {
                determined = Some(found.iter().map(|c| self.combination(place, kind, c)).collect());
            }
        }
        Unseparated {
            missing: self.directions.len(),
            parameters: self.members,
            determined,
            directions: plain,
        }
    }

    /// The parameters moved along a direction so that their combinations of this kind stay exactly
    /// the same.
    fn moved(
        &self,
        place: &Place<'_>,
        kind: CombinationKind,
        direction: &[f64],
    ) -> Option<Vec<f64>> {
        let largest = direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        let mut values = place.values.to_vec();
        for (&i, d) in self.members.iter().zip(direction) {
            let step = MOVED * d / largest;
            values[i] = match kind {
                CombinationKind::Product => values[i] * step.exp(),
                CombinationKind::Sum => values[i] + step * place.scales[i],
            };
        }
        values.iter().all(|v| v.is_finite()).then_some(values)
    }

    /// Expected change of the residuals if the parameters were moved one by one.
    fn expected(&self, direction: &[f64], length: &dyn Fn(usize) -> f64) -> f64 {
        let largest = direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        let each = self
            .members
            .iter()
            .zip(direction)
            .map(|(&i, d)| (MOVED * d / largest * length(i)).powi(2));
        each.sum::<f64>().sqrt()
    }

    fn combination(&self, place: &Place<'_>, kind: CombinationKind, c: &[i32]) -> Combination {
        let terms: Vec<(usize, i32)> =
            self.members.iter().copied().zip(c.iter().copied()).filter(|(_, c)| *c != 0).collect();
        let value = match kind {
            CombinationKind::Product => {
                terms.iter().map(|&(i, c)| place.values[i].powi(c)).product()
            }
            CombinationKind::Sum => {
                terms.iter().map(|&(i, c)| place.values[i] * f64::from(c)).sum()
            }
        };
        Combination { kind, terms, value }
    }
}

fn stays(before: Option<&[f64]>, after: Option<&[f64]>, expected: f64) -> bool {
    let (Some(before), Some(after)) = (before, after) else { return false };
    let changed: f64 = before.iter().zip(after).map(|(a, b)| (a - b) * (a - b)).sum();
    changed.sqrt() <= UNCHANGED * expected
}
