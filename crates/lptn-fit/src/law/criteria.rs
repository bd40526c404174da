//! Comparison of laws with different numbers of coefficients.

use super::candidate::{Fitted, LawFit};
use super::points::Points;

/// Root mean square of residuals: the divisor is their number.
pub(crate) fn rms(misses: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = misses.len() as f64;
    (misses.map(|residual| residual * residual).sum::<f64>() / count).sqrt()
}

/// The factor of the variance of weighted residuals over the given standard errors: chi^2 over
/// degrees of freedom of the law with the most coefficients, at least 1 (K. P. Burnham, D. R.
/// Anderson, Model Selection and Multimodel Inference, 2nd edition, Springer 2002, section 2.5). It
/// is 1 without standard errors, when it is part of each fit.
pub(crate) fn dispersion(candidates: &[LawFit], points: &Points) -> f64 {
    if points.deviation().is_none() {
        return 1.0;
    }
    let fits =
        candidates.iter().filter_map(LawFit::fitted).filter(|fit| fit.degrees_of_freedom > 0);
    let ratio = |fit: &Fitted| fit.squares / fit.degrees_of_freedom as f64;
    let general = fits.min_by(|a, b| {
        a.degrees_of_freedom.cmp(&b.degrees_of_freedom).then(ratio(a).total_cmp(&ratio(b)))
    });
    general.map_or(1.0, |fit| ratio(fit).max(1.0))
}

/// Akaike's criterion with the correction of C. M. Hurvich and C.-L. Tsai (Biometrika 76 (1989)
/// 297), up to a term that all laws share. Without standard errors the variance counts as a
/// parameter, with them only if it was estimated.
pub(crate) fn aicc(fit: &Fitted, points: &Points, dispersion: f64) -> Option<f64> {
    let weighted = points.deviation().is_some();
    let own = !weighted || dispersion > 1.0;
    let k = fit.coefficients.len() + usize::from(own);
    let left = points.len().checked_sub(k + 1).filter(|left| *left > 0)?;
    let (n, k, left) = (points.len() as f64, k as f64, left as f64);
    let misfit =
        if weighted { fit.squares / dispersion } else { n * (least(fit, points) / n).ln() };
    Some(misfit + 2.0 * k + 2.0 * k * (k + 1.0) / left)
}

/// The sum of squares, but at least that of rounding: points without noise do not prove an infinite
/// weight.
fn least(fit: &Fitted, points: &Points) -> f64 {
    let rounding = 16.0 * f64::EPSILON * points.largest_power();
    fit.squares.max(points.len() as f64 * rounding * rounding)
}
