//! Against matrices whose decompositions are known in closed form.

use std::f64::consts::PI;

use faer::Mat;

use super::{
    Complex, GeneralEigen, Singular, cholesky_diagonal, cholesky_solve, complex_inverse,
    eigenvalue_magnitudes, general_eigen, least_squares, product, singular, solve, symmetric_eigen,
    triangle,
};

const SIZES: [usize; 8] = [1, 2, 3, 5, 16, 17, 60, 150];

/// Elements from -1 to 1 that look random.
fn noise(i: usize, j: usize) -> f64 {
    (12.9898 * (i + 1) as f64 + 78.233 * (j + 1) as f64).sin() * 43758.5453 % 1.0
}

/// One number above the diagonal, another on it, a third below it.
fn three(n: usize, [above, on, below]: [f64; 3]) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| match (i + 1).cmp(&(j + 1)) {
        std::cmp::Ordering::Equal => on,
        std::cmp::Ordering::Less if i + 1 == j => above,
        std::cmp::Ordering::Greater if j + 1 == i => below,
        _ => 0.0,
    })
}

fn apart(a: &Mat<f64>, b: impl Fn(usize, usize) -> f64) -> f64 {
    let all = (0..a.ncols()).flat_map(|j| (0..a.nrows()).map(move |i| (i, j)));
    all.map(|(i, j)| (a[(i, j)] - b(i, j)).abs()).fold(0.0, f64::max)
}

fn identity(i: usize, j: usize) -> f64 {
    f64::from(u8::from(i == j))
}

/// The largest component of `A x - lambda x` over all vectors, which have length 1.
fn left(a: &Mat<f64>, eigen: &GeneralEigen) -> f64 {
    let n = a.nrows();
    let mut most = 0.0_f64;
    for k in 0..n {
        let x = |i: usize| eigen.vectors[(i, k)];
        let length: f64 = (0..n).map(|i| x(i).norm_sqr()).sum();
        assert!((length - 1.0).abs() < 1e-13);
        for i in 0..n {
            let image: Complex = (0..n).map(|j| x(j) * a[(i, j)]).sum();
            most = most.max((image - eigen.values[k] * x(i)).norm());
        }
    }
    most
}

/// Those of the second difference are `2 - 2 cos(k pi / (n + 1))`.
#[test]
fn symmetric_matrices_with_known_values() {
    for n in SIZES {
        let a = three(n, [-1.0, 2.0, -1.0]);
        let (values, vectors) = symmetric_eigen(a.as_ref()).unwrap();
        for (k, value) in values.iter().enumerate() {
            let angle = (k + 1) as f64 * PI / (n + 1) as f64;
            assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-14, "{n} {k}");
        }
        assert!(apart(&product(vectors.transpose(), vectors.as_ref()), identity) < 2e-14);
        let image = product(a.as_ref(), vectors.as_ref());
        assert!(apart(&image, |i, k| values[k] * vectors[(i, k)]) < 1e-14);
    }
    let (values, _) = symmetric_eigen(Mat::zeros(0, 0).as_ref()).unwrap();
    assert!(values.is_empty());
    assert!(symmetric_eigen(Mat::from_fn(3, 3, |_, _| f64::NAN).as_ref()).is_none());
}

/// The values for `below, on, above` are `on + 2 sqrt(above below) cos(k pi / (n + 1))`: real ones,
/// or pairs if the signs of the two sides differ.
#[test]
fn matrices_of_three_diagonals_with_known_values() {
    for n in SIZES {
        for (above, below) in [(1.0, 1.2), (1.0, -1.1)] {
            let a = three(n, [above, -2.0, below]);
            let eigen = general_eigen(a.as_ref()).unwrap();
            assert!(left(&a, &eigen) < 2e-14);
            let root = Complex::new(above * below, 0.0).sqrt();
            for k in 1..=n {
                let known = root * 2.0 * (k as f64 * PI / (n + 1) as f64).cos() - 2.0;
                let nearest = eigen.values.iter().map(|value| (value - known).norm());
                // how far rounding moves one of them grows with (above / below)^(n / 2)
                let allowed = 1e-14 * (1.2_f64).powf(0.5 * n as f64).max(1.0);
                assert!(nearest.fold(f64::INFINITY, f64::min) < allowed, "{n} {k}");
            }
        }
    }
}

/// The values of a ring are the roots of unity; a pair is adjacent, the positive one first.
#[test]
fn a_ring_has_the_roots_of_unity() {
    for n in SIZES {
        let a = Mat::from_fn(n, n, |i, j| identity((i + 1) % n, j));
        let eigen = general_eigen(a.as_ref()).unwrap();
        assert!(left(&a, &eigen) < 2e-14, "{n}");
        for k in 0..n {
            let known = Complex::from_polar(1.0, 2.0 * PI * k as f64 / n as f64);
            let near = eigen.values.iter().map(|z| (z - known).norm()).fold(1.0, f64::min);
            assert!(near < 1e-14, "{n} {k}: {near:e}");
        }
        for (k, value) in eigen.values.iter().enumerate().filter(|(_, value)| value.im > 0.0) {
            assert_eq!(eigen.values[k + 1], value.conj());
            (0..n).for_each(|i| {
                assert_eq!(eigen.vectors[(i, k + 1)], eigen.vectors[(i, k)].conj());
            });
        }
        let sizes = eigenvalue_magnitudes(a.as_ref()).unwrap();
        assert!(sizes.iter().all(|size| (size - 1.0).abs() < 1e-14));
    }
}

#[test]
fn any_matrix_and_those_that_are_split_have_their_vectors() {
    for n in SIZES {
        let whole = Mat::from_fn(n, n, noise);
        let split = Mat::from_fn(n, n, |i, j| if i % 3 == j % 3 { noise(i, j) } else { 0.0 });
        let upper = Mat::from_fn(n, n, |i, j| if i <= j { noise(i, j) } else { 0.0 });
        for a in [&whole, &split, &upper] {
            let eigen = general_eigen(a.as_ref()).unwrap();
            assert!(left(a, &eigen) < 1e-13 * (n as f64).sqrt(), "{n}");
            let sum: Complex = eigen.values.iter().sum();
            let trace: f64 = (0..n).map(|i| a[(i, i)]).sum();
            assert!((sum - trace).norm() < 1e-13 * n as f64);
        }
        let inverse = general_eigen(whole.as_ref()).map(|eigen| eigen.vectors).unwrap();
        let turned = complex_inverse(&inverse).unwrap();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let one: Complex = (0..n).map(|k| inverse[(i, k)] * turned[(k, j)]).sum();
            assert!((one - identity(i, j)).norm() < 1e-10);
        }
    }
    assert!(general_eigen(Mat::from_fn(3, 3, |_, _| f64::INFINITY).as_ref()).is_none());
    assert!(complex_inverse(&Mat::zeros(2, 2)).is_none());
}

/// The inverse of the second difference is `(min + 1) (n - max) / (n + 1)` in row and column.
#[test]
fn equations_with_known_answers() {
    for n in SIZES {
        let inverse =
            |i: usize, j: usize| (i.min(j) + 1) as f64 * (n - i.max(j)) as f64 / (n + 1) as f64;
        let (a, one) = (three(n, [-1.0, 2.0, -1.0]), Mat::from_fn(n, n, identity));
        let allowed = 1e-14 * (n * n) as f64;
        assert!(apart(&solve(a.as_ref(), one.as_ref()).unwrap(), inverse) < allowed);
        assert!(apart(&cholesky_solve(a.as_ref(), one.as_ref()).unwrap(), inverse) < allowed);
        // rows upside down, so that none has its pivot on the diagonal
        let turned = Mat::from_fn(n, n, |i, j| a[(n - 1 - i, j)]);
        let found = solve(turned.as_ref(), one.as_ref()).unwrap();
        assert!(apart(&found, |i, j| inverse(i, n - 1 - j)) < allowed);
        // the factor of min(i, j) + 1 is all ones
        let ones = Mat::from_fn(n, n, |i, j| (i.min(j) + 1) as f64);
        let diagonal = cholesky_diagonal(ones.as_ref()).unwrap();
        assert!(diagonal.iter().all(|x| (x - 1.0).abs() < 1e-15));
    }
    let equal = Mat::from_fn(3, 3, |_, _| 1.0);
    assert!(solve(equal.as_ref(), equal.as_ref()).is_none());
    assert!(cholesky_diagonal(three(3, [-1.0, 0.5, -1.0]).as_ref()).is_none());
}

/// The values of the first difference, with both ends, are `2 sin(k pi / (2 (n + 1)))`.
#[test]
fn singular_values_that_are_known() {
    for n in SIZES {
        let tall = Mat::from_fn(n + 1, n, |i, j| identity(i, j) - identity(i, j + 1));
        for a in [&tall, &tall.transpose().to_owned()] {
            let Singular { u, values, v } = singular(a.as_ref()).unwrap();
            for (k, value) in values.iter().enumerate() {
                let known = 2.0 * ((n - k) as f64 * PI / (2 * (n + 1)) as f64).sin();
                assert!((value - known).abs() < 1e-14, "{n} {k}");
            }
            let scaled = Mat::from_fn(u.nrows(), n, |i, k| u[(i, k)] * values[k]);
            let whole = product(scaled.as_ref(), v.transpose());
            assert!(apart(&whole, |i, j| a[(i, j)]) < 2e-14);
            assert!(apart(&product(u.transpose(), u.as_ref()), identity) < 2e-14);
            assert!(apart(&product(v.transpose(), v.as_ref()), identity) < 2e-14);
        }
    }
}

/// One direction only, and none.
#[test]
fn singular_values_of_zero() {
    for n in SIZES {
        let one = Mat::from_fn(n, n, |i, j| ((i + 1) * (j + 1)) as f64);
        let square = (n * (n + 1) * (2 * n + 1)) as f64 / 6.0;
        for (a, largest) in [(one, square), (Mat::zeros(n, n), 0.0)] {
            let Singular { u, values, v } = singular(a.as_ref()).unwrap();
            assert!((values[0] - largest).abs() <= 1e-14 * largest * n as f64);
            assert!(values[1..].iter().all(|value| *value <= 1e-14 * largest * n as f64));
            assert!(apart(&product(u.transpose(), u.as_ref()), identity) < 2e-14);
            assert!(apart(&product(v.transpose(), v.as_ref()), identity) < 2e-14);
        }
    }
}

/// A line through points that lie on it, and the triangle of its matrix.
#[test]
fn least_squares_of_points_on_a_curve() {
    let t = |i: usize| i as f64 / 40.0;
    let a = Mat::from_fn(200, 4, |i, j| t(i).powi(i32::try_from(j).unwrap()));
    let b = Mat::from_fn(200, 1, |i, _| 3.0 - 2.0 * t(i) + 0.5 * t(i).powi(3));
    let found = least_squares(a.as_ref(), b.as_ref());
    assert!(apart(&found, |j, _| [3.0, -2.0, 0.0, 0.5][j]) < 1e-12);
    for some in [a.as_ref(), a.as_ref().subrows(0, 3)] {
        let r = triangle(some);
        assert_eq!((r.nrows(), r.ncols()), (some.nrows().min(4), 4));
        let squares = product(r.transpose(), r.as_ref());
        let known = product(some.transpose(), some);
        assert!(apart(&squares, |i, j| known[(i, j)]) < 1e-13 * (known[(0, 0)] + known[(3, 3)]));
    }
}

/// Products of any shape are the sums of their definition.
#[test]
fn products_are_their_sums() {
    for (rows, depth, columns) in [(1, 1, 1), (3, 8, 2), (5, 9, 1), (300, 131, 7), (2, 0, 2)] {
        let (a, b) = (Mat::from_fn(rows, depth, noise), Mat::from_fn(depth, columns, noise));
        let found = product(a.as_ref(), b.as_ref());
        let sum = |i: usize, j: usize| (0..depth).fold(0.0, |sum, k| sum + b[(k, j)] * a[(i, k)]);
        assert!(apart(&found, sum) <= 0.0);
        assert!(apart(&product(b.transpose(), a.transpose()), |j, i| found[(i, j)]) < 1e-13);
    }
}
