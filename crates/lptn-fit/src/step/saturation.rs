//! Stretches in which an instrument was at the end of its range.

use lptn_reduce::fit_exponential;

use super::error::StepError;

/// Minimum number of samples in a stretch of equal extreme values.
const FEWEST: usize = 10;

/// Refuses a record that is constant at its least or greatest value although, by the exponential
/// through the rest of it, it should be elsewhere. The mean distance must exceed five times the
/// larger of that exponential's residual in the rest and the instrument's `step`. A record that has
/// settled to within a step is not refused.
pub(super) fn check(times: &[f64], values: &[f64], first: f64, step: f64) -> Result<(), StepError> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for extreme in [least, most] {
        let (from, to) = longest(values, extreme);
        if to - from < FEWEST {
            continue;
        }
        let rest = |all: &[f64]| [&all[..from], &all[to..]].concat();
        let Ok(fit) = fit_exponential(&rest(times), &rest(values)) else { continue };
        let curve = |t: &f64| fit.settled + (fit.initial - fit.settled) * (-t / fit.tau).exp();
        let samples = to - from;
        let apart =
            times[from..to].iter().map(|t| curve(t) - extreme).sum::<f64>() / samples as f64;
        if apart.abs() > 5.0 * fit.rms.max(step).max(1e-6 * (most - least)) {
            let (from, to) = (first + times[from], first + times[to - 1]);
            return Err(StepError::Saturated { value: extreme, from, to, samples });
        }
    }
    Ok(())
}

/// The longest stretch of this value, as a range.
fn longest(values: &[f64], wanted: f64) -> (usize, usize) {
    let (mut best, mut from) = ((0, 0), 0);
    for (i, value) in values.iter().enumerate() {
        #[expect(
            clippy::float_cmp,
            reason = "an instrument at the end of its range prints one number"
        )]
        if *value != wanted {
            from = i + 1;
        } else if i + 1 - from > best.1 - best.0 {
            best = (from, i + 1);
        }
    }
    best
}
