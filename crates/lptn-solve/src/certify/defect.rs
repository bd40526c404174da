//! The defect of a way: the heat that would have to enter a node in addition to that of the
//! network, so that the way were its temperature.
//!
//! Its values at the samples of a step make up a polynomial. The rest follows from the form of the
//! laws: a function of which a Taylor coefficient is known to be small everywhere is close to a
//! polynomial.

use std::f64::consts::PI;

use lptn_units::Taylor;

use super::way::{SAMPLES, places};

/// Interpolation at the samples enlarges a function at most by this: the Lebesgue constant of eight
/// extrema of a Chebyshev polynomial is at most `2/pi (ln 7 + 0.5772 + ln(8/pi))` (H. Ehlich,
/// K. Zeller, Math. Ann. 164 (1966) 105).
const LEBESGUE: f64 = 2.21;

/// A bound on the distance of a function over a step from the polynomial through its samples, from
/// bounds on its Taylor coefficients over the whole step.
///
/// With the coefficient of order 8 it is that times the product of the distances from the samples,
/// at most `2^-6`. A polynomial of lower degree `m - 1` is at most `2^(1 - m)` times the
/// coefficient of order `m` away from the function, and interpolation adds the Lebesgue constant
/// times that (P. J. Davis, Interpolation and Approximation, Dover 1975, sections 3.1 and 3.3).
pub(super) fn rest(whole: &Taylor) -> f64 {
    let largest = |order: usize| {
        let [low, high] = whole.term(order);
        low.abs().max(high.abs())
    };
    let [low, high] = whole.term(0);
    let mut share = 2.0 * (1.0 + LEBESGUE);
    let mut least = 0.25 * share * (high - low);
    for order in 1..SAMPLES {
        share *= 0.5;
        least = least.min(share * largest(order));
    }
    least.min(largest(SAMPLES) / 64.0)
}

/// Bounds on polynomials from their values at `N` [`places`].
pub(super) struct Largest<const N: usize> {
    /// For each place the Chebyshev coefficients of the polynomial that is 1 there and 0 at the
    /// others.
    basis: [[f64; N]; N],
}

impl<const N: usize> Largest<N> {
    pub(super) fn new() -> Self {
        let last = (N - 1) as f64;
        let end = |k: usize| if k == 0 || k == N - 1 { 0.5 } else { 1.0 };
        let places = places::<N>();
        let basis = std::array::from_fn(|place| {
            std::array::from_fn(|k| {
                let angle = k as f64 * places[place].clamp(-1.0, 1.0).acos();
                2.0 / last * end(k) * end(place) * angle.cos()
            })
        });
        Self { basis }
    }

    /// As a function of an angle the polynomial is `sum of c_k cos(k x)`. Between its largest
    /// value, at which its slope is 0, and the next place, at most half of their distance away, it
    /// falls by at most half the square of that times the largest second derivative, which is at
    /// most the sum of `k^2 |c_k|`.
    pub(super) fn of(&self, values: &[f64; N]) -> f64 {
        let mut coefficients = [0.0; N];
        let mut most = 0.0_f64;
        for (value, weights) in values.iter().zip(&self.basis) {
            most = most.max(value.abs());
            coefficients.iter_mut().zip(weights).for_each(|(c, w)| *c += w * value);
        }
        let squares = (0..N).map(|k| (k * k) as f64);
        let bend: f64 = squares.zip(&coefficients).map(|(square, c)| square * c.abs()).sum();
        let half = 0.5 * PI / (N - 1) as f64;
        most + 0.5 * half * half * bend
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest(p: impl Fn(f64) -> f64) -> f64 {
        Largest::<SAMPLES>::new().of(&places().map(p))
    }

    /// A Chebyshev polynomial of degree 5 reaches 1 six times.
    #[test]
    fn a_polynomial_is_bounded_closely() {
        let bound = largest(|s| ((16.0 * s * s - 20.0) * s * s + 5.0) * s);
        assert!((1.0..2.0).contains(&bound), "{bound}");
        let square = largest(|s| s * s - 0.25);
        assert!((0.75..0.82).contains(&square), "{square}");
    }

    /// The same at 13 places: a Chebyshev polynomial of degree 5, and `s^2 - 1/4`.
    #[test]
    fn more_places_bound_more_closely() {
        let bound = |p: &dyn Fn(f64) -> f64| Largest::<13>::new().of(&places().map(p));
        let chebyshev = bound(&|s| ((16.0 * s * s - 20.0) * s * s + 5.0) * s);
        assert!((1.0..1.3).contains(&chebyshev), "{chebyshev}");
        let square = bound(&|s| s * s - 0.25);
        assert!((0.75..0.78).contains(&square), "{square}");
    }

    /// exp(3 s): the distance from its interpolant, sampled, is below the bound and of its size.
    #[test]
    fn the_rest_of_a_function_is_bounded_closely() {
        let three = Taylor::constant(3.0);
        let bound = rest(&(Taylor::variable(-1.0, 1.0) * three).exp());
        let places = places::<SAMPLES>();
        let through = |s: f64| {
            let term = |i: usize| {
                let others = places.iter().enumerate().filter(|(j, _)| *j != i);
                let product: f64 = others.map(|(_, p)| (s - p) / (places[i] - p)).product();
                (3.0 * places[i]).exp() * product
            };
            (0..SAMPLES).map(term).sum::<f64>()
        };
        let apart = |i: i32| {
            let s = f64::from(i) / 500.0;
            ((3.0 * s).exp() - through(s)).abs()
        };
        let right = (-500..=500).map(apart).fold(0.0, f64::max);
        assert!(right < bound && bound < 30.0 * right, "{right} {bound}");
        assert!(rest(&Taylor::between(&[[-2.0, 7.0], [3.0, 4.0], [1.0, 1.0]])) < 1e-300);
    }
}
