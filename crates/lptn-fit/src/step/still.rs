//! Records that are constant before their step begins.

/// Share of its whole change within which a column counts as constant.
const STILL: f64 = 0.02;

/// Time of the last of the first values that are constant, if that is more than a tenth of the time
/// constant after the first. An exponential would have completed `STILL` of its change after 0.02
/// tau.
pub(super) fn until(times: &[f64], values: &[f64], tau: f64) -> Option<f64> {
    let (start, first) = (times.first()?, values.first()?);
    let change = values.iter().fold(0.0, |most: f64, value| most.max((value - first).abs()));
    let count = values.iter().take_while(|value| (*value - first).abs() <= STILL * change).count();
    let end = *times.get(count.checked_sub(1)?)?;
    (count > 3 && end - start > 0.1 * tau).then_some(end)
}
