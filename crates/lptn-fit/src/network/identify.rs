//! What data determine of the parameters, and what they do not.

use crate::Spectrum;
use crate::network::combination::{CombinationKind, combinations};

/// A parameter takes part in an undetermined direction if its share of it is larger than this.
const SHARE: f64 = 1e-4;

/// A displacement along an undetermined direction may change the residuals by this part of what it
/// would do to them if its parameters were determined.
const UNCHANGED: f64 = 1e-2;

/// How far the parameters are moved to see whether a direction stays undetermined: a change of a
/// logarithm.
const MOVED: f64 = 0.2;

/// A combination of parameters that is determined where they are not.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Whether it is a product or a sum.
    pub kind: CombinationKind,
    /// Place among the varied parameters, and exponent or factor.
    pub terms: Vec<(usize, i32)>,
    /// Its value in SI units.
    pub value: f64,
}

/// Parameters that cannot be told from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Unseparated {
    /// Their places among the varied parameters.
    pub parameters: Vec<usize>,
    /// How many more of them have to be known from elsewhere.
    pub missing: usize,
    /// What is determined of them; `None` if that is not a simple product or sum.
    pub determined: Option<Vec<Combination>>,
    /// Changes, in SI units, that leave every column as it is to first order: one list for each
    /// missing one.
    pub directions: Vec<Vec<f64>>,
}

impl Unseparated {
    /// Parameters that, were they known, would let the others be told apart.
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

/// What the data determine.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Singular values of the derivatives of the residuals by the scaled parameters, largest first.
    /// A parameter is in units of its own value (so that it is about its logarithm), a temperature
    /// in units of 10 K.
    pub singular_values: Vec<f64>,
    /// How many directions are determined.
    pub rank: usize,
    /// Places of the parameters that no column and no prior depends on.
    pub unfelt: Vec<usize>,
    /// Those that are felt, but not apart.
    pub unseparated: Vec<Unseparated>,
}

impl Identifiability {
    /// Whether every parameter is determined.
    pub fn is_whole(&self) -> bool {
        self.unfelt.is_empty() && self.unseparated.is_empty()
    }

    /// Whether the data determine this one.
    pub fn determines(&self, parameter: usize) -> bool {
        let among = |group: &Unseparated| group.parameters.contains(&parameter);
        !self.unfelt.contains(&parameter) && !self.unseparated.iter().any(among)
    }
}

/// Where the parameters stand.
pub(crate) struct Place<'a> {
    /// Derivatives of the residuals by the parameters, one parameter after the other.
    pub(crate) jacobian: &'a [f64],
    /// Values in SI units.
    pub(crate) values: &'a [f64],
    /// In units of which each is seen; its value where that is about its logarithm.
    pub(crate) scales: &'a [f64],
    /// Singular values and columns below this part of the largest count as 0: derivatives are as
    /// accurate as that and no more.
    pub(crate) accuracy: f64,
    /// Whether parameters `i` and `j` can be added.
    pub(crate) addable: &'a dyn Fn(usize, usize) -> bool,
}

impl Place<'_> {
    fn is_logarithmic(&self, i: usize) -> bool {
        self.values[i] > 0.0 && (self.scales[i] - self.values[i]).abs() <= 0.0
    }
}

/// What is determined at `place`. `misfit` gives the residuals for other values, or nothing where
/// there are none.
pub(crate) fn identify(
    place: &Place<'_>,
    misfit: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
) -> Option<Identifiability> {
    let n = place.values.len();
    let rows = place.jacobian.len().checked_div(n)?;
    let column = |i: usize| &place.jacobian[i * rows..(i + 1) * rows];
    let length = |i: usize| column(i).iter().map(|x| x * x).sum::<f64>().sqrt() * place.scales[i];
    let longest = (0..n).map(length).fold(0.0, f64::max);
    let (felt, unfelt): (Vec<usize>, Vec<usize>) =
        (0..n).partition(|&i| length(i) > place.accuracy * longest);
    if felt.is_empty() {
        return Some(Identifiability {
            singular_values: vec![0.0; n],
            rank: 0,
            unfelt,
            unseparated: Vec::new(),
        });
    }
    let jacobian: Vec<f64> = felt.iter().flat_map(|&i| column(i).iter().copied()).collect();
    let scales: Vec<f64> = felt.iter().map(|&i| place.scales[i]).collect();
    let spectrum = Spectrum::new(&jacobian, &scales, place.accuracy)?;
    let mut singular_values = spectrum.values.clone();
    singular_values.resize(n, 0.0);
    let before = misfit(place.values);
    let unseparated = groups(&felt, spectrum.unseen())
        .into_iter()
        .map(|group| group.named(place, (before.as_deref(), &length), misfit))
        .collect();
    Some(Identifiability { singular_values, rank: spectrum.rank, unfelt, unseparated })
}

/// Parameters that undetermined directions tie together, with those directions in scaled
/// parameters.
struct Group {
    members: Vec<usize>,
    directions: Vec<Vec<f64>>,
}

/// Parts the parameters into groups that no undetermined direction connects.
fn groups(felt: &[usize], unseen: &[Vec<f64>]) -> Vec<Group> {
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

/// A basis of what some directions span, reduced: each has a 1 where the others have a 0. Parts of
/// directions below [`SHARE`] are nothing.
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
    /// What is determined of the group, in words if a product or a sum of whole numbers says it.
    fn named(
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

    /// The parameters moved along a direction, as far as their combinations of this kind stay the
    /// same exactly.
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

    /// What moving the parameters one by one would do to the residuals.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the columns for parameters, and what `identify` makes of them.
    fn told(values: &[f64], model: impl Fn(&[f64]) -> Vec<f64>) -> Identifiability {
        let step = 1e-6;
        let by = |i: usize| {
            let moved = |sign: f64| {
                let mut p = values.to_vec();
                p[i] += sign * step * p[i];
                model(&p)
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            up.iter()
                .zip(&down)
                .map(|(a, b)| (a - b) / (2.0 * step * values[i]))
                .collect::<Vec<f64>>()
        };
        let jacobian: Vec<f64> = (0..values.len()).flat_map(by).collect();
        let place = Place {
            jacobian: &jacobian,
            values,
            scales: values,
            accuracy: 1e-6,
            addable: &|_, _| true,
        };
        identify(&place, &mut |p| Some(model(p))).unwrap()
    }

    fn names(found: &Identifiability) -> Vec<(CombinationKind, Vec<(usize, i32)>)> {
        let all = found.unseparated.iter().flat_map(|group| group.determined.iter().flatten());
        all.map(|c| (c.kind, c.terms.clone())).collect()
    }

    #[test]
    fn a_rise_and_a_time_constant_do_not_tell_three_parameters() {
        // T = P R (1 - exp(-t / (R C)))
        let model = |p: &[f64]| {
            (1..40)
                .map(|k| p[0] * p[1] * (1.0 - f64::exp(-50.0 * f64::from(k) / (p[1] * p[2]))))
                .collect()
        };
        let found = told(&[220.6, 0.3046, 2659.0], model);
        assert_eq!((found.rank, found.unfelt.len()), (2, 0));
        assert_eq!(
            names(&found),
            [
                (CombinationKind::Product, vec![(0, 1), (1, 1)]),
                (CombinationKind::Product, vec![(1, 1), (2, 1)])
            ]
        );
        let values: Vec<f64> =
            found.unseparated[0].determined.iter().flatten().map(|c| c.value).collect();
        assert!(
            (values[0] - 220.6 * 0.3046).abs() < 1e-9 && (values[1] - 0.3046 * 2659.0).abs() < 1e-9
        );
    }

    /// Equal ones too, whose product is stationary as their sum is.
    #[test]
    fn parallel_conductances_are_known_as_a_sum() {
        for values in [[2.0, 2.0, 50.0], [1.3, 4.1, 50.0]] {
            let model = |p: &[f64]| {
                (1..40).map(|k| f64::exp(-f64::from(k) * (p[0] + p[1]) / p[2])).collect()
            };
            let model = |p: &[f64]| -> Vec<f64> {
                let cooled: Vec<f64> = model(p);
                cooled.iter().map(|e| (1.0 - e) * 7.0 / (p[0] + p[1])).collect()
            };
            let found = told(&values, model);
            assert_eq!(names(&found), [(CombinationKind::Sum, vec![(0, 1), (1, 1)])], "{values:?}");
            assert_eq!(found.unseparated[0].parameters, [0, 1]);
            assert!(found.determines(2) && !found.determines(0));
        }
    }

    #[test]
    fn two_pairs_are_two_groups_and_an_idle_parameter_is_named() {
        let model = |p: &[f64]| {
            (1..30)
                .map(|k| p[0] * p[1] + f64::from(k) * (p[2] + p[3]) + 0.0 * p[4])
                .collect::<Vec<f64>>()
        };
        let found = told(&[3.0, 5.0, 2.0, 7.0, 1.0], model);
        assert_eq!(found.unfelt, [4]);
        assert_eq!(
            names(&found),
            [
                (CombinationKind::Product, vec![(0, 1), (1, 1)]),
                (CombinationKind::Sum, vec![(2, 1), (3, 1)])
            ]
        );
        assert_eq!(found.singular_values.len(), 5);
    }

    #[test]
    fn what_is_neither_a_product_nor_a_sum_keeps_its_direction() {
        let model =
            |p: &[f64]| (1..30).map(|k| f64::from(k) * (p[0] * p[0] + p[1]).sqrt()).collect();
        let found = told(&[3.0, 5.0], model);
        let group = &found.unseparated[0];
        assert!(group.determined.is_none() && group.missing == 1);
        // 2 p0 dp0 + dp1 = 0
        let d = &group.directions[0];
        assert!((6.0 * d[0] + d[1]).abs() < 1e-4 * d[1].abs(), "{d:?}");
    }

    #[test]
    fn what_is_determined_is_whole() {
        let model = |p: &[f64]| (1..30).map(|k| p[0] + f64::from(k) * p[1]).collect();
        assert!(told(&[3.0, 5.0], model).is_whole());
    }
}
