//! Records that determine no time constant.

use lptn_units::statistics;

use super::Estimated;
use super::error::Lack;
use crate::noise::stretches;

/// Number of stretches whose means show the slow part of a misfit.
const STRETCHES: usize = 12;

/// A curve that has settled before the second sample: the first alone determines `T_i`, and the
/// second alone `t_RC`.
pub(super) fn between(times: &[f64], tau: f64) -> Option<Lack> {
    let spacing = times[1] - times[0];
    (tau < spacing).then_some(Lack::Spacing { spacing })
}

/// A time constant whose interval contains 0, or a curve that is not the record's: its slow
/// `residuals` (curve less record, in means of twelfths of the record) are larger in the square
/// than the changes of the curve itself.
pub(super) fn of(tau: &Estimated, values: &[f64], residuals: &[f64]) -> Option<Lack> {
    if tau.half_width >= tau.value {
        return Some(Lack::Interval { half_width: tau.half_width });
    }
    let size = (values.len() / STRETCHES).max(1);
    let curve: Vec<f64> = values.iter().zip(residuals).map(|(v, r)| v + r).collect();
    let (curve, missed) = (stretches::means(&curve, size), stretches::means(residuals, size));
    let count = curve.len() as f64;
    let changed = (statistics::squares_about_mean(&curve) / count).sqrt();
    let missed = (missed.iter().map(|m| m * m).sum::<f64>() / count).sqrt();
    (missed > changed).then_some(Lack::Shape { missed, changed })
}
