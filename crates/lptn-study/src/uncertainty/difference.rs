//! Differences between the linear and the sampled uncertainty.

use lptn_network::NodeId;
use lptn_units::statistics::NORMAL_95;

use crate::uncertainty::answer::AnswerOf;
use crate::uncertainty::result::{Bands, Uncertainty, UncertaintyMethod};

/// Bands that differ by more than this part of half the sampled band's width are not the same.
const TENTH: f64 = 0.1;

/// The standard error of a 2.5 % quantile of n independent normal numbers is `2.67 sd / sqrt(n)`,
/// the square root of 0.025 x 0.975 over the density there. Sobol points do better; two of these
/// are not a difference.
const NOISE: f64 = 2.0 * 2.671;

/// A band that the linear method gives wrongly.
#[derive(Clone, Debug, PartialEq)]
pub struct Discrepancy {
    /// The answer whose band it is; `End` means the row at `time` here.
    pub of: AnswerOf,
    /// The time in s of a row; `None` for a maximum or a margin.
    pub time: Option<f64>,
    /// The linear band of 95 % in SI units.
    pub linear: (f64, f64),
    /// The sampled band.
    pub sampled: (f64, f64),
    /// The larger of the differences at the two ends as a part of half the sampled band.
    pub part: f64,
}

/// Differences of the two methods, for the same task, by more than a tenth of the band: for each
/// node the row where they differ most, then maxima and margins. Differences within the sampling
/// error do not count. `least` in K is the width below which a band is that of the solver.
pub fn discrepancies(linear: &Uncertainty, sampled: &Uncertainty, least: f64) -> Vec<Discrepancy> {
    let noise = match sampled.method {
        UncertaintyMethod::Sobol { samples, .. } => NOISE / (2.0 * samples as f64).sqrt(),
        UncertaintyMethod::Linear { .. } => 0.0,
    };
    let rows =
        linear.bands.iter().zip(&sampled.bands).filter_map(|(l, s)| worst(l, s, &sampled.times));
    let answers = linear.answers.iter().zip(&sampled.answers);
    let others = answers.filter(|(l, _)| !matches!(l.of, AnswerOf::End(_))).map(|(l, s)| {
        let (linear, sampled) = ((l.low.value, l.high.value), (s.low.value, s.high.value));
        Discrepancy { of: l.of, time: None, linear, sampled, part: part(linear, sampled) }
    });
    let wide = |d: &Discrepancy| (d.sampled.1 - d.sampled.0).max(d.linear.1 - d.linear.0) > least;
    rows.chain(others).filter(|d| d.part > TENTH.max(noise / NORMAL_95) && wide(d)).collect()
}

fn worst(linear: &Bands, sampled: &Bands, times: &[f64]) -> Option<Discrepancy> {
    let of: NodeId = linear.node;
    let row = |i: usize| {
        let (l, s) = ((linear.low[i], linear.high[i]), (sampled.low[i], sampled.high[i]));
        Discrepancy {
            of: AnswerOf::End(of),
            time: Some(times[i]),
            linear: l,
            sampled: s,
            part: part(l, s),
        }
    };
    (0..times.len()).map(row).max_by(|a, b| a.part.total_cmp(&b.part))
}

/// The larger difference at the two ends as a part of half the sampled band.
fn part(linear: (f64, f64), sampled: (f64, f64)) -> f64 {
    let half = 0.5 * (sampled.1 - sampled.0);
    let off = (linear.0 - sampled.0).abs().max((linear.1 - sampled.1).abs());
    if off > 0.0 { off / half } else { 0.0 }
}
