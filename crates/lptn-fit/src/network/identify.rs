//! Parameters that data determine, and those that they do not.
//!
//! The identifiable combinations follow from singular values in logarithms of the parameters. A
//! product or a sum is accepted only after a move along it.

use crate::Spectrum;
use crate::network::undetermined::{Place, Unseparated, groups};

/// Identifiability of parameters by data.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Singular values of the derivatives of the residuals by the scaled parameters, largest first.
    /// A parameter is in units of its value (so that it is about its logarithm), a temperature
    /// in units of 10 K.
    pub singular_values: Vec<f64>,
    /// Number of determined directions.
    pub rank: usize,
    /// Indices of the parameters that no column and no prior depends on.
    pub unfelt: Vec<usize>,
    /// Parameters that have an effect, but cannot be separated.
    pub unseparated: Vec<Unseparated>,
}

impl Identifiability {
    /// True if every parameter is determined.
    pub fn is_whole(&self) -> bool {
        self.unfelt.is_empty() && self.unseparated.is_empty()
    }

    /// True if the data determine this one.
    pub fn determines(&self, parameter: usize) -> bool {
        let among = |group: &Unseparated| group.parameters.contains(&parameter);
        !self.unfelt.contains(&parameter) && !self.unseparated.iter().any(among)
    }
}

/// Identifiability at `place`. `misfit` gives the residuals for other values, or nothing if there
/// are none.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::combination::CombinationKind;

    /// The result of `identify` for columns as a function of the parameters.
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
