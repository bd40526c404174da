//! Response of an instrument with a time constant to the quantity that it measures.

/// The response, and its derivative by the time constant.
pub(crate) struct Followed {
    pub(crate) course: Vec<f64>,
    pub(crate) by_lag: Vec<f64>,
}

/// The solution of `lag dy/dt = x - y` that begins in rest, `y = x`, at ascending `times` in s.
/// Between two of them x is the cubic through four neighbours, and y is exact for that. Without a
/// lag y is x, and its derivative by the lag is that of x by the time, reversed.
pub(crate) fn follow(times: &[f64], x: &[f64], lag: f64) -> Followed {
    let first = x.first().copied().unwrap_or(f64::NAN);
    let (mut course, mut by_lag) = (vec![first; x.len()], vec![0.0; x.len()]);
    for k in 1..x.len() {
        let apart = times[k] - times[k - 1];
        let [a0, a1, a2, a3] = cubic(times, x, k - 1);
        // y without its transient is a cubic as well
        let c = [
            a0 - lag * (a1 - 2.0 * lag * (a2 - 3.0 * lag * a3)),
            a1 - 2.0 * lag * (a2 - 3.0 * lag * a3),
            a2 - 3.0 * lag * a3,
            a3,
        ];
        let slope = |s: f64| {
            let (first, second, third) =
                (c[1] + s * (2.0 * c[2] + 3.0 * c[3] * s), 2.0 * c[2] + 6.0 * c[3] * s, 6.0 * c[3]);
            lag * (second - lag * third) - first
        };
        let decay = (-apart / lag).exp();
        let transient = course[k - 1] - c[0];
        let settled = c[0] + apart * (c[1] + apart * (c[2] + apart * c[3]));
        course[k] = settled;
        by_lag[k] = slope(apart);
        // a transient that has died away has no derivative either, however small the lag
        if decay > 0.0 {
            course[k] += transient * decay;
            let stretched = transient * apart / (lag * lag);
            by_lag[k] += (by_lag[k - 1] - slope(0.0) + stretched) * decay;
        }
    }
    Followed { course, by_lag }
}

/// The coefficients of the cubic through four neighbours of the stretch that begins at `k`, in the
/// time since then. With fewer neighbours its degree is lower.
fn cubic(times: &[f64], x: &[f64], k: usize) -> [f64; 4] {
    let others = match x.len() {
        ..=2 => [k + 1; 2],
        3 => [if k == 0 { 2 } else { 0 }; 2],
        n if k == 0 => [2, 3.min(n - 1)],
        n if k + 2 >= n => [k - 1, k - 2],
        _ => [k - 1, k + 2],
    };
    let at = |i: usize| times[i] - times[k];
    let rise = |i: usize| (x[i] - x[k]) / at(i);
    let (h, second, third) = (at(k + 1), at(others[0]), at(others[1]));
    // divided differences
    let d1 = rise(k + 1);
    let bend = |i: usize| (rise(i) - d1) / (at(i) - h);
    let d2 = if others[0] == k + 1 { 0.0 } else { bend(others[0]) };
    let d3 = if others[0] == others[1] { 0.0 } else { (bend(others[1]) - d2) / (third - second) };
    [x[k], d1 - d2 * h + d3 * h * second, d2 - d3 * (h + second), d3]
}

/// Times at which an instrument with this time constant is followed: all `times`, with more between
/// them if they are far apart.
pub(crate) fn refined(times: &[f64], lag: f64) -> Vec<f64> {
    /// Steps so fine that a rise with the instrument's own time constant is met to 1e-5 of it.
    const PARTS: f64 = 8.0;
    /// Largest number of rows.
    const MOST: f64 = 20_000.0;
    let length = times.last().copied().unwrap_or(0.0) - times.first().copied().unwrap_or(0.0);
    let step = (lag / PARTS).max(length / MOST);
    let mut all = Vec::with_capacity(times.len());
    for pair in times.windows(2) {
        let apart = pair[1] - pair[0];
        let parts = (apart / step).ceil().max(1.0);
        let between = std::iter::successors(Some(0.0), |k| Some(k + 1.0));
        let between = between.take_while(|k| *k < parts);
        all.extend(between.map(|k| pair[0] + k / parts * apart));
    }
    all.extend(times.last());
    all
}

#[cfg(test)]
mod tests {
    use super::{follow, refined};

    /// An instrument of 20 s on a body of 35 s that rises by 60 K: the difference of two
    /// exponentials. The derivative by the time constant is that of the closed form.
    #[test]
    fn analytic_a_rise_is_followed() {
        let (tau, lag, rise) = (35.0, 20.0, 60.0);
        let times = refined(&(0..11).map(|k| 30.0 * f64::from(k)).collect::<Vec<_>>(), lag);
        let x: Vec<f64> = times.iter().map(|t| rise * (1.0 - f64::exp(-t / tau))).collect();
        let found = follow(&times, &x, lag);
        for (k, t) in times.iter().enumerate() {
            let (body, own) = (f64::exp(-t / tau), f64::exp(-t / lag));
            let expected = rise * (1.0 - (tau * body - lag * own) / (tau - lag));
            assert!(
                (found.course[k] - expected).abs() < 5e-4,
                "{t}: {}",
                found.course[k] - expected
            );
            let by_lag = -rise
                * ((tau * body - lag * own) / (tau - lag).powi(2)
                    - (own + t / lag * own) / (tau - lag));
            assert!((found.by_lag[k] - by_lag).abs() < 5e-5, "{t}: {}", found.by_lag[k] - by_lag);
        }
    }

    /// A lag of nothing, and one far below the distance of rows, of a rise of 60 K in 35 s: dT/dlag
    /// is -dT/dt, from the closed form.
    #[test]
    fn analytic_a_lag_of_nothing_has_a_derivative() {
        let (tau, rise) = (35.0, 60.0);
        let times: Vec<f64> = (0..100).map(f64::from).collect();
        let x: Vec<f64> = times.iter().map(|t| rise * (1.0 - f64::exp(-t / tau))).collect();
        for lag in [0.0, f64::MIN_POSITIVE, 1e-200, 1e-20, 1e-6] {
            let found = follow(&times, &x, lag);
            for k in 1..times.len() {
                let expected = -rise / tau * f64::exp(-times[k] / tau);
                assert!((found.by_lag[k] - expected).abs() < 1e-3, "{lag}: {}", found.by_lag[k]);
                assert!((found.course[k] - x[k]).abs() < 1e-5, "{lag}: {}", found.course[k]);
            }
        }
    }

    /// A ramp is followed exactly, `lag` behind, on any times.
    #[test]
    fn analytic_a_ramp_is_followed_on_uneven_times() {
        let times = [0.0, 0.1, 5.0, 5.5, 40.0, 41.0, 90.0];
        let x: Vec<f64> = times.iter().map(|t| 20.0 + 0.5 * t).collect();
        let found = follow(&times, &x, 10.0);
        let expected = |t: f64| 20.0 + 0.5 * (t - 10.0 * (1.0 - f64::exp(-t / 10.0)));
        for (t, y) in times.iter().zip(&found.course) {
            assert!((y - expected(*t)).abs() < 1e-12, "{t}: {y}");
        }
        for few in 1..4 {
            let found = follow(&times[..few], &x[..few], 10.0);
            let (t, y) = (times[few - 1], found.course[few - 1]);
            assert!((y - expected(t)).abs() < 1e-12, "{few}: {y}");
        }
    }
}
