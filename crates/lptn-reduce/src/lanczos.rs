//! The modes of a symmetric operator that one vector excites.

use faer::Mat;
use lptn_integrate::dense;
use lptn_integrate::vectors::{dot, norm, take_off};

use crate::error::ReduceError;

/// An eigenvalue with the weight of the start vector in it: squared cosine times squared length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mode {
    pub(crate) value: f64,
    pub(crate) weight: f64,
    /// Upper bound of the distance of the value from an eigenvalue.
    pub(crate) error: f64,
}

/// A symmetric operator: gives its product with a vector.
pub(crate) type Operator<'a> = dyn FnMut(&[f64]) -> Result<Vec<f64>, ReduceError> + 'a;

/// Most vectors kept. A port sees few modes: those beyond are too fast or too far away to matter.
const MOST: usize = 300;

/// Coupling relative to the largest eigenvalue below which nothing new is excited.
const EXHAUSTED: f64 = 1e-14;

/// Lanczos iteration with full reorthogonalisation (C. Lanczos, J. Res. NBS 45 (1950) 255; G. H.
/// Golub and G. Meurant, Matrices, Moments and Quadrature (2010), chapter 4: values and weights are
/// the Gauss quadrature of the start vector's measure). Ends when `enough` accepts the modes found,
/// or when there are no more.
pub(crate) fn modes(
    start: &[f64],
    apply: &mut Operator<'_>,
    enough: &dyn Fn(&[Mode]) -> bool,
) -> Result<Vec<Mode>, ReduceError> {
    let length = norm(start);
    let mut basis: Vec<Vec<f64>> = vec![scaled(start, 1.0 / length)];
    let (mut diagonal, mut beside) = (Vec::<f64>::new(), Vec::<f64>::new());
    let mut largest: f64 = 0.0;
    let mut check = 4;
    loop {
        let last = basis.len() - 1;
        let mut next = apply(&basis[last])?;
        diagonal.push(dot(&basis[last], &next));
        let coupling = orthogonalise(&mut next, &basis);
        largest = largest.max(diagonal[last].abs()).max(coupling);
        let done =
            coupling <= EXHAUSTED * largest || basis.len() == start.len() || basis.len() == MOST;
        if done || basis.len() >= check {
            check += check / 4;
            let found = ritz(&diagonal, &beside, coupling, length)?;
            if done || enough(&found) {
                return Ok(found);
            }
        }
        beside.push(coupling);
        basis.push(scaled(&next, 1.0 / coupling));
    }
}

/// Subtracts the parts along `basis` from a vector and returns the remaining length. If much was
/// subtracted, it does so twice, so that rounding of the first pass does not stay.
fn orthogonalise(next: &mut [f64], basis: &[Vec<f64>]) -> f64 {
    let before = norm(next);
    for _ in 0..2 {
        take_off(next, basis);
        if norm(next) > 0.7 * before {
            break;
        }
    }
    norm(next)
}

/// Eigenvalues of the tridiagonal matrix, largest first.
fn ritz(
    diagonal: &[f64],
    beside: &[f64],
    coupling: f64,
    length: f64,
) -> Result<Vec<Mode>, ReduceError> {
    let n = diagonal.len();
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    };
    let tridiagonal = Mat::from_fn(n, n, entry);
    let (values, vectors) =
        dense::symmetric_eigen(tridiagonal.as_ref()).ok_or(ReduceError::Modes)?;
    let mode = |k: usize| Mode {
        value: values[k],
        weight: (length * vectors[(0, k)]).powi(2),
        error: (coupling * vectors[(n - 1, k)]).abs(),
    };
    let mut found: Vec<Mode> = (0..n).map(mode).collect();
    found.sort_by(|a, b| b.value.total_cmp(&a.value));
    Ok(found)
}

fn scaled(a: &[f64], factor: f64) -> Vec<f64> {
    a.iter().map(|x| factor * x).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit vector hidden under parts 1e8 times as long: the first pass leaves rounding of these,
    /// the second does not.
    #[test]
    fn a_vector_deep_within_the_basis_becomes_orthogonal_to_it() {
        let (c, s) = (0.6, 0.8);
        let basis = [vec![c, s, 0.0, 0.0], vec![-s * c, c * c, s, 0.0]];
        let hidden = [s * s, -c * s, c, 0.0];
        let mut next: Vec<f64> =
            (0..4).map(|i| 1e8 * (basis[0][i] / 3.0 + basis[1][i] / 7.0) + hidden[i]).collect();
        let length = orthogonalise(&mut next, &basis);
        assert!((length - 1.0).abs() < 1e-7, "{length}");
        for vector in &basis {
            assert!(dot(vector, &next).abs() < 1e-15, "{next:?}");
        }
    }

    /// The eigenvalues of a diagonal operator are its entries, the weights the squares of the start
    /// vector.
    #[test]
    fn modes_of_a_diagonal_operator_are_its_entries() {
        let entries = [3.0, 0.5, 7.0, 1.0, 0.01, 2.0];
        let start = [1.0, 2.0, 0.5, 1.5, 3.0, 0.0];
        let mut apply = |x: &[f64]| Ok(x.iter().zip(entries).map(|(x, e)| x * e).collect());
        let found = modes(&start, &mut apply, &|_| false).unwrap();
        let expected = [(7.0, 0.25), (3.0, 1.0), (1.0, 2.25), (0.5, 4.0), (0.01, 9.0)];
        for (mode, (value, weight)) in found.iter().zip(expected) {
            assert!(
                (mode.value - value).abs() < 1e-13 && (mode.weight - weight).abs() < 1e-11,
                "{mode:?}"
            );
            assert!(mode.error < 1e-13, "{mode:?}");
        }
        // 2 is not excited
        assert_eq!(found.len(), 5, "{found:?}");
    }
}
