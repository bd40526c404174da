//! Output times and the segments between known discontinuities.

use lptn_network::OutputTimes;

use crate::settings_error::SettingsError;

/// A time at which comparisons of `t` have their truth from `time` on: a jump at the start is over,
/// as it is in the first row of a run. The distance is far below any thermal time.
pub(crate) fn just_after(time: f64) -> f64 {
    time + 1e-12 * time.abs().max(1.0)
}

/// The times of all rows, strictly increasing, from `start` to `stop`.
pub(crate) fn rows(output: &OutputTimes, start: f64, stop: f64) -> Result<Vec<f64>, SettingsError> {
    let mut rows = match output {
        OutputTimes::Every(every) => regular(*every, start, stop)?,
        OutputTimes::At(times) => listed(times, start, stop)?,
    };
    if rows.first().is_none_or(|&first| first > start) {
        rows.insert(0, start);
    }
    if rows.last().is_none_or(|&last| last < stop) {
        rows.push(stop);
    }
    Ok(rows)
}

fn listed(times: &[f64], start: f64, stop: f64) -> Result<Vec<f64>, SettingsError> {
    if let Some(&time) = times.iter().find(|t| !(start..=stop).contains(*t)) {
        return Err(SettingsError::OutputTime(time));
    }
    match times.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => Err(SettingsError::OutputTime(pair[1])),
        None => Ok(times.to_vec()),
    }
}

/// `start + k every`, without a last row that differs from the stop by rounding only.
fn regular(every: f64, start: f64, stop: f64) -> Result<Vec<f64>, SettingsError> {
    let count = (stop - start) / every;
    if !(every > 0.0 && count <= OutputTimes::MOST_ROWS) {
        return Err(SettingsError::OutputEvery(every));
    }
    let time = |k: u32| start + f64::from(k) * every;
    let margin = 1e-9 * every;
    Ok((0..).map(time).take_while(|&t| t < stop - margin).collect())
}

/// Moves breakpoints of a run to the time of a row that differs by rounding only, so that the row
/// is after the jump.
pub(crate) fn snap(breakpoints: &mut [f64], rows: &[f64], (start, stop): (f64, f64)) {
    for time in breakpoints {
        let after = rows.partition_point(|row| row < time);
        // far from 0 times are rounded more than the run is long
        let near = |row: &&f64| {
            let size = row.abs().max(time.abs());
            (**row - *time).abs() <= (1e-11 * size.min(stop - start)).max(4.0 * f64::EPSILON * size)
        };
        if let Some(&row) = rows[after.saturating_sub(1)..].iter().take(2).find(near) {
            *time = row;
        }
    }
}

/// Doubles that a run has to have between its start and its stop if something depends on the time:
/// a step of a three-hundredth of it is then still a hundred thousand of them.
const LEAST_DOUBLES: f64 = 3e7;

/// Refuses a run so far from 0 that the resolution of times inside it is too coarse for inputs that
/// depend on them.
pub(crate) fn check_resolution(start: f64, stop: f64) -> Result<(), SettingsError> {
    let far = start.abs().max(stop.abs());
    let resolution = far.next_up() - far;
    let fine = stop - start >= LEAST_DOUBLES * resolution;
    if fine { Ok(()) } else { Err(SettingsError::FarFromZero { start, stop, resolution }) }
}

/// A part of a run inside which every input is smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Segment {
    /// A time inside it, at which comparisons of `t` are read.
    pub(crate) fn inside(self) -> f64 {
        0.5 * (self.from + self.to)
    }
}

/// The segments of `start..stop` between the breakpoints, which are ascending and inside.
pub(crate) fn segments(start: f64, stop: f64, breakpoints: &[f64]) -> Vec<Segment> {
    let mut ends = breakpoints.to_vec();
    ends.push(stop);
    let mut from = start;
    ends.into_iter().map(|to| Segment { from: std::mem::replace(&mut from, to), to }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_always_hold_start_and_stop_once() {
        let rows = |o: OutputTimes| rows(&o, 0.0, 1.0).unwrap();
        assert_eq!(rows(OutputTimes::Every(0.4)), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(rows(OutputTimes::Every(0.1)).len(), 11); // 10 x 0.1 is not 1 exactly
        assert_eq!(rows(OutputTimes::At(vec![0.5])), [0.0, 0.5, 1.0]);
        assert_eq!(rows(OutputTimes::At(vec![])), [0.0, 1.0]);
    }

    #[test]
    fn output_times_outside_the_run_or_out_of_order_are_refused() {
        let at = |times: &[f64]| rows(&OutputTimes::At(times.to_vec()), 0.0, 1.0);
        assert_eq!(at(&[0.5, 1.5]), Err(SettingsError::OutputTime(1.5)));
        assert_eq!(at(&[0.5, 0.5]), Err(SettingsError::OutputTime(0.5)));
        assert_eq!(rows(&OutputTimes::Every(0.0), 0.0, 1.0), Err(SettingsError::OutputEvery(0.0)));
    }

    #[test]
    fn segments_meet_at_the_breakpoints() {
        let found = segments(0.0, 10.0, &[2.0, 5.0]);
        assert_eq!(found[0], Segment { from: 0.0, to: 2.0 });
        assert_eq!(found[2], Segment { from: 5.0, to: 10.0 });
        assert!((found[1].inside() - 3.5).abs() < 1e-15);
    }
}
