//! Derivatives of a smooth function from five values, exact for polynomials of the fourth degree
//! (M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 1964, table 25.2).

/// Places in steps and their weights: on both sides, above, below.
const STENCILS: [[(f64, f64); 5]; 3] = [
    [(-2.0, 1.0), (-1.0, -8.0), (0.0, 0.0), (1.0, 8.0), (2.0, -1.0)],
    [(0.0, -25.0), (1.0, 48.0), (2.0, -36.0), (3.0, 16.0), (4.0, -3.0)],
    [(0.0, 25.0), (-1.0, -48.0), (-2.0, 36.0), (-3.0, -16.0), (-4.0, 3.0)],
];

/// A function is not smooth if its fourth difference is more than this part of its change: over
/// steps of 1e-3 that of a smooth one is below 1e-6, that of a bend is as large as the change.
const SMOOTH: f64 = 1e-3;

/// Fourth differences below this part of the value are rounding.
const ROUNDING: f64 = 1e-12;

/// The derivative of `of` at 0, from values at multiples of `step`: on both sides, or on one if the
/// function has no values on the other. `None` if it is not smooth there.
///
/// # Errors
/// The error of `of`, if it has no values on either side.
pub(crate) fn slope<E>(step: f64, of: impl FnMut(f64) -> Result<f64, E>) -> Result<Option<f64>, E> {
    slope_of_size((step, 0.0), of)
}

/// The same for a function of this typical size: if it is far smaller here it may bend.
///
/// # Errors
/// As [`slope`].
pub(crate) fn slope_of_size<E>(
    (step, typical): (f64, f64),
    mut of: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    let mut last = None;
    for stencil in &STENCILS {
        match by(stencil, (step, typical), &mut of) {
            Err(error) => last = Some(error),
            found => return found,
        }
    }
    last.map_or(Ok(None), Err)
}

/// The same from values at 0 and below.
///
/// # Errors
/// The error of `of`.
pub(crate) fn slope_below<E>(
    step: f64,
    mut of: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    by(&STENCILS[2], (step, 0.0), &mut of)
}

fn by<E>(
    stencil: &[(f64, f64); 5],
    (step, typical): (f64, f64),
    of: &mut impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    let values: Result<Vec<f64>, E> = stencil.iter().map(|(place, _)| of(place * step)).collect();
    Ok(smooth(stencil, &values?, (step, typical)))
}

fn smooth(stencil: &[(f64, f64); 5], values: &[f64], (step, typical): (f64, f64)) -> Option<f64> {
    // the weights add up to 0; so a constant has a slope of exactly 0
    let rises = values.iter().map(|value| value - values[0]);
    let sum: f64 = stencil.iter().zip(rises).map(|((_, weight), rise)| weight * rise).sum();
    let mut along: Vec<(f64, f64)> =
        stencil.iter().map(|(place, _)| *place).zip(values.iter().copied()).collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    let fourth: f64 = along.iter().zip(FOURTH).map(|((_, value), weight)| weight * value).sum();
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let size = most.abs().max(least.abs()).max(typical);
    let smooth = fourth.abs() <= SMOOTH * (most - least) + ROUNDING * size;
    let slope = sum / (12.0 * step);
    (smooth && slope.is_finite()).then_some(slope)
}

/// The fourth difference of neighbours.
const FOURTH: [f64; 5] = [1.0, -4.0, 6.0, -4.0, 1.0];

#[cfg(test)]
mod tests {
    use super::{slope, slope_below};

    type Found = Result<Option<f64>, ()>;

    #[test]
    fn smooth_functions_have_their_derivative() {
        // d exp(x)/dx = 1 at 0
        let both: Found = slope(1e-3, |x| Ok(x.exp()));
        assert!((both.ok().flatten().unwrap_or(0.0) - 1.0).abs() < 1e-11);
        for side in [1.0, -1.0] {
            let one: Found = slope(1e-3, |x| if x * side < 0.0 { Err(()) } else { Ok(x.exp()) });
            assert!((one.ok().flatten().unwrap_or(0.0) - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn values_above_are_not_read() {
        let found: Found = slope_below(1e-3, |x| if x > 0.0 { Err(()) } else { Ok(x.exp()) });
        assert!((found.ok().flatten().unwrap_or(0.0) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_constant_has_no_slope() {
        for value in [1e-7, 0.1, 22_181.100_573_844_64, 1e9 / 7.0] {
            let found: Found = slope(1e-3, |_| Ok(value));
            assert!(found.ok().flatten().is_some_and(|slope| slope.abs() <= 0.0));
        }
    }

    #[test]
    fn a_maximum_is_smooth() {
        let found: Found = slope(1e-3, |x| Ok(1.0 - x * x));
        assert!(found.ok().flatten().is_some_and(|slope| slope.abs() < 1e-12));
    }

    #[test]
    fn bends_have_none() {
        let bend: Found = slope(1e-3, |x| Ok(x.abs()));
        assert_eq!(bend, Ok(None));
        let jump: Found = slope(1e-3, |x| Ok(if x > 1.5e-3 { 1.0 + x } else { x }));
        assert_eq!(jump, Ok(None));
        assert_eq!(slope(1e-3, |_| Err(1)), Err(1));
    }
}
