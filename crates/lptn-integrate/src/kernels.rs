//! Vector operations as plain loops over slices, written so that the compiler vectorises them.
//!
//! Reductions keep eight partial results: a single one would have to be summed in order, which
//! forbids vector instructions. Slices given to one kernel have the same length; the shorter one
//! would govern.

const LANES: usize = 8;

/// `z = a x + b y`
pub fn linear_sum(a: f64, x: &[f64], b: f64, y: &[f64], z: &mut [f64]) {
    for ((z, x), y) in z.iter_mut().zip(x).zip(y) {
        *z = a * x + b * y;
    }
}

/// `z = b z + a x`
pub fn scale_and_add(b: f64, z: &mut [f64], a: f64, x: &[f64]) {
    if b.to_bits() == 1.0_f64.to_bits() {
        return z.iter_mut().zip(x).for_each(|(z, x)| *z += a * x);
    }
    z.iter_mut().zip(x).for_each(|(z, x)| *z = b * *z + a * x);
}

/// `z[i] = f(x[i])`
pub fn map(x: &[f64], z: &mut [f64], f: impl Fn(f64) -> f64) {
    z.iter_mut().zip(x).for_each(|(z, &x)| *z = f(x));
}

/// `z[i] = f(z[i])`
pub fn map_in_place(z: &mut [f64], f: impl Fn(f64) -> f64) {
    z.iter_mut().for_each(|z| *z = f(*z));
}

/// `z[i] = f(x[i], y[i])`
pub fn zip(x: &[f64], y: &[f64], z: &mut [f64], f: impl Fn(f64, f64) -> f64) {
    for ((z, &x), &y) in z.iter_mut().zip(x).zip(y) {
        *z = f(x, y);
    }
}

/// `z[i] = f(z[i], y[i])`
pub fn zip_in_place(z: &mut [f64], y: &[f64], f: impl Fn(f64, f64) -> f64) {
    z.iter_mut().zip(y).for_each(|(z, &y)| *z = f(*z, y));
}

/// Sum of `x[i] y[i]`.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    dot_in::<LANES>(x, y)
}

/// The same in `LANES` partial sums: few for short slices. Always inlined, so that callers which
/// are compiled for the vectors of one processor have it in them.
#[inline(always)]
pub fn dot_in<const LANES: usize>(x: &[f64], y: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (xs, x_tail) = x.as_chunks::<LANES>();
    let (ys, y_tail) = y.as_chunks::<LANES>();
    for (x, y) in xs.iter().zip(ys) {
        for k in 0..LANES {
            lanes[k] += x[k] * y[k];
        }
    }
    lanes.iter().sum::<f64>() + x_tail.iter().zip(y_tail).map(|(x, y)| x * y).sum::<f64>()
}

/// Largest `|x[i] w[i]|`, 0 for no components, infinity if any of them is not a number.
///
/// The maximum instruction drops a NaN, so a sum of `0 * a` watches for it: it is zero for finite
/// numbers and NaN otherwise. The answer is infinity rather than NaN because CVODE's tests are
/// comparisons, all of which are false for NaN, some of them meaning "converged".
pub fn weighted_max(x: &[f64], w: &[f64]) -> f64 {
    let mut largest = [0.0_f64; LANES];
    let mut watch = [0.0_f64; LANES];
    let (xs, x_tail) = x.as_chunks::<LANES>();
    let (ws, w_tail) = w.as_chunks::<LANES>();
    for (x, w) in xs.iter().zip(ws) {
        for k in 0..LANES {
            let a = (x[k] * w[k]).abs();
            largest[k] = if a > largest[k] { a } else { largest[k] };
            watch[k] += 0.0 * a;
        }
    }
    for (k, (x, w)) in x_tail.iter().zip(w_tail).enumerate() {
        let a = (x * w).abs();
        largest[k] = if a > largest[k] { a } else { largest[k] };
        watch[k] += 0.0 * a;
    }
    if watch.iter().sum::<f64>().is_nan() {
        f64::INFINITY
    } else {
        largest.iter().copied().fold(0.0, f64::max)
    }
}

/// [`weighted_max`] over the components with a positive mask.
pub fn weighted_max_masked(x: &[f64], w: &[f64], mask: &[f64]) -> f64 {
    let chosen =
        x.iter().zip(w).zip(mask).filter(|(_, mask)| **mask > 0.0).map(|((x, w), _)| (x * w).abs());
    chosen.fold(0.0, |largest, a| if a.is_nan() { f64::INFINITY } else { f64::max(largest, a) })
}

/// Largest `|x[i]|`, infinity if any of them is not a number.
pub fn max_norm(x: &[f64]) -> f64 {
    let mut largest = [0.0_f64; LANES];
    let mut watch = [0.0_f64; LANES];
    let (chunks, tail) = x.as_chunks::<LANES>();
    for x in chunks {
        for k in 0..LANES {
            let a = x[k].abs();
            largest[k] = if a > largest[k] { a } else { largest[k] };
            watch[k] += 0.0 * a;
        }
    }
    let largest = largest.iter().chain(tail).fold(0.0, |most, x| f64::max(most, x.abs()));
    let watched = watch.iter().chain(tail).any(|x| x.is_nan());
    if watched { f64::INFINITY } else { largest }
}

/// Largest `|f(x[i], [y[i], z[i]])|` of those that are numbers.
pub fn largest_of(x: &[f64], [y, z]: [&[f64]; 2], f: impl Fn(f64, [f64; 2]) -> f64) -> f64 {
    let mut largest = [0.0_f64; LANES];
    let ((xs, x_tail), (ys, y_tail), (zs, z_tail)) =
        (x.as_chunks::<LANES>(), y.as_chunks::<LANES>(), z.as_chunks::<LANES>());
    for ((x, y), z) in xs.iter().zip(ys).zip(zs) {
        for k in 0..LANES {
            let a = f(x[k], [y[k], z[k]]).abs();
            largest[k] = if a > largest[k] { a } else { largest[k] };
        }
    }
    let tail = x_tail.iter().zip(y_tail).zip(z_tail).map(|((&x, &y), &z)| f(x, [y, z]).abs());
    largest.into_iter().chain(tail).fold(0.0, f64::max)
}

/// Sum of `x[i]`.
pub fn sum(x: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, tail) = x.as_chunks::<LANES>();
    for x in chunks {
        for k in 0..LANES {
            lanes[k] += x[k];
        }
    }
    lanes.iter().sum::<f64>() + tail.iter().sum::<f64>()
}

/// Smallest and largest `x[i]`; `None` if any of them is not finite.
pub fn range(x: &[f64]) -> Option<(f64, f64)> {
    if x.len() < LANES {
        let range = x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), &x| {
            (if x < least { x } else { least }, if x > most { x } else { most })
        });
        return x.iter().all(|x| x.is_finite()).then_some(range);
    }
    let mut least = [f64::INFINITY; LANES];
    let mut most = [f64::NEG_INFINITY; LANES];
    let mut watch = [0.0_f64; LANES];
    let (chunks, tail) = x.as_chunks::<LANES>();
    for x in chunks {
        for k in 0..LANES {
            least[k] = if x[k] < least[k] { x[k] } else { least[k] };
            most[k] = if x[k] > most[k] { x[k] } else { most[k] };
            watch[k] += 0.0 * x[k];
        }
    }
    for (k, &x) in tail.iter().enumerate() {
        least[k] = if x < least[k] { x } else { least[k] };
        most[k] = if x > most[k] { x } else { most[k] };
        watch[k] += 0.0 * x;
    }
    let finite = !watch.iter().sum::<f64>().is_nan();
    let least = least.iter().copied().fold(f64::INFINITY, f64::min);
    finite.then(|| (least, most.iter().copied().fold(f64::NEG_INFINITY, f64::max)))
}

/// Smallest `x[i]`.
pub fn min(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Index of the largest `|x[i] w[i]|`; a component that is not a number counts as the largest.
pub fn worst(x: &[f64], w: &[f64]) -> usize {
    let mut worst = (0, -1.0);
    for (i, (x, w)) in x.iter().zip(w).enumerate() {
        let a = (x * w).abs();
        if a.is_nan() {
            return i;
        }
        if a > worst.1 {
            worst = (i, a);
        }
    }
    worst.0
}

/// Index of the first component that is not finite.
pub fn first_not_finite(x: &[f64]) -> Option<usize> {
    let mut watch = [0.0; LANES];
    let (chunks, tail) = x.as_chunks::<LANES>();
    for x in chunks {
        for k in 0..LANES {
            watch[k] += 0.0 * x[k];
        }
    }
    let suspicious = watch.iter().chain(tail).any(|x| !x.is_finite());
    if suspicious { x.iter().position(|x| !x.is_finite()) } else { None }
}

/// CVODE's constraint test: 2 means positive, 1 not negative, -1 not positive, -2 negative. Writes
/// 1 into `mask` if a constraint is broken, else 0; returns true if none is broken.
pub fn constraints_hold(constraint: &[f64], x: &[f64], mask: &mut [f64]) -> bool {
    let mut all = true;
    for ((mask, &c), &x) in mask.iter_mut().zip(constraint).zip(x) {
        let broken = (c.abs() > 1.5 && x * c <= 0.0) || (c.abs() > 0.5 && x * c < 0.0);
        *mask = f64::from(u8::from(broken));
        all &= !broken;
    }
    all
}

/// Smallest `x[i] / y[i]` over the nonzero `y[i]`, the largest double if there is none.
pub fn min_quotient(x: &[f64], y: &[f64]) -> f64 {
    let quotients = x.iter().zip(y).filter(|(_, y)| y.abs() > 0.0).map(|(x, y)| x / y);
    quotients.fold(f64::MAX, f64::min)
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "the results are exact")]
mod tests {
    use super::*;

    fn numbers(n: usize, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            f64::from((state >> 40) as u32) / f64::from(1 << 23) - 1.0
        };
        (0..n).map(|_| next()).collect()
    }

    #[test]
    fn reductions_agree_with_plain_formulas() {
        for n in 0..40 {
            let (x, w, mask) = (numbers(n, 1), numbers(n, 2), numbers(n, 3));
            let plain = x.iter().zip(&w).map(|(x, w)| (x * w).abs()).fold(0.0, f64::max);
            assert!((weighted_max(&x, &w) - plain).abs() <= 0.0);
            let masked =
                (0..n).filter(|&i| mask[i] > 0.0).map(|i| (x[i] * w[i]).abs()).fold(0.0, f64::max);
            assert!((weighted_max_masked(&x, &w, &mask) - masked).abs() <= 0.0);
            assert!((max_norm(&x) - x.iter().map(|x| x.abs()).fold(0.0, f64::max)).abs() <= 0.0);
            let sum: f64 = x.iter().zip(&w).map(|(x, w)| x * w).sum();
            assert!((dot(&x, &w) - sum).abs() < 1e-14);
            assert!((super::sum(&x) - x.iter().sum::<f64>()).abs() < 1e-14);
        }
    }

    #[test]
    fn a_nan_anywhere_makes_the_norms_infinite() {
        for n in 1..40 {
            for i in 0..n {
                let mut x = numbers(n, 7);
                x[i] = f64::NAN;
                let ones = vec![1.0; n];
                assert_eq!(weighted_max(&x, &ones), f64::INFINITY);
                assert_eq!(weighted_max_masked(&x, &ones, &ones), f64::INFINITY);
                assert_eq!(max_norm(&x), f64::INFINITY);
                assert_eq!(first_not_finite(&x), Some(i));
                assert_eq!(worst(&x, &ones), i);
            }
        }
        assert_eq!(weighted_max(&[f64::INFINITY], &[1.0]), f64::INFINITY);
        assert_eq!(first_not_finite(&[1.0; 33]), None);
    }

    #[test]
    fn the_range_is_that_of_finite_numbers() {
        for n in 1..40 {
            let mut x = numbers(n, 5);
            let sorted = {
                let mut sorted = x.clone();
                sorted.sort_by(f64::total_cmp);
                (sorted[0], sorted[n - 1])
            };
            assert_eq!(range(&x), Some(sorted));
            for wrong in [f64::NAN, f64::INFINITY] {
                x[n / 2] = wrong;
                assert_eq!(range(&x), None);
            }
        }
    }

    #[test]
    fn constraints_as_in_the_manual() {
        let mut mask = [9.0; 4];
        assert!(!constraints_hold(&[2.0, 1.0, -1.0, 0.0], &[0.0, 0.0, 0.0, -5.0], &mut mask));
        assert_eq!(mask, [1.0, 0.0, 0.0, 0.0]);
        assert!(constraints_hold(&[-2.0, 1.0], &[-1.0, 2.0], &mut mask[..2]));
        assert_eq!(min_quotient(&[1.0, 4.0, -1.0], &[2.0, 0.0, 4.0]), -0.25);
        assert_eq!(min_quotient(&[1.0], &[0.0]), f64::MAX);
    }
}
