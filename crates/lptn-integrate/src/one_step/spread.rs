//! Ratio of the largest to the smallest coefficient of a system.

use crate::{OdeSystem, Retry, kernels};

/// Decrease of the flow of each row if all components rise by 1, from the flows themselves: sums of
/// the rows of the Jacobian have the rounding of their largest entry.
pub(super) fn loss(system: &mut impl OdeSystem, time: f64) -> Result<Vec<f64>, Retry> {
    let size = system.size();
    let (mut low, mut high) = (vec![0.0; size], vec![0.0; size]);
    system.flow(time, &vec![0.0; size], &mut low)?;
    system.flow(time, &vec![1.0; size], &mut high)?;
    kernels::zip_in_place(&mut low, &high, |low, high| low - high);
    Ok(low)
}

/// The largest entry of the Jacobian over the smallest one that is not zero, or the smallest loss
/// of a row; `None` if they cannot be evaluated.
pub(super) fn of(system: &mut impl OdeSystem, (time, y): (f64, &[f64])) -> Option<f64> {
    let mut values = vec![0.0; system.pattern().len()];
    system.jacobian(time, y, &mut values).ok()?;
    let losses = loss(system, time).ok()?;
    let sizes = values.iter().chain(&losses).map(|value| value.abs()).filter(|size| *size > 0.0);
    let (least, most) = sizes
        .fold((f64::INFINITY, 0.0_f64), |(least, most), size| (least.min(size), most.max(size)));
    Some(if most > 0.0 { most / least } else { 1.0 })
}
