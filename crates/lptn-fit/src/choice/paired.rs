//! Networks beside each other on what they have not seen.

use lptn_units::statistics::student_95;

use crate::choice::{Judged, UnseenRecord};

/// More records than these are no help to anybody.
const MOST: u32 = 1000;

/// How far behind the best a network is in what it has not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Behind {
    /// How many times as much it misses: the mean over the records of the logarithms, which no
    /// single record outweighs.
    pub ratio: f64,
    /// The 95 % interval of that, from Student's t over the records; `None` for a single one.
    pub interval: Option<(f64, f64)>,
    /// How many records would tell the two apart, if further ones scatter as these do; `None` where
    /// that would take more than a thousand, or nothing says how they scatter.
    pub records: Option<usize>,
}

impl Behind {
    /// Of one network over another one.
    pub(crate) fn of(own: &[UnseenRecord], best: &[UnseenRecord]) -> Self {
        let both = own.iter().zip(best);
        let logarithms: Vec<f64> =
            both.map(|(own, best)| (own.over_sigma / best.over_sigma).ln()).collect();
        let count = logarithms.len() as f64;
        let mean = logarithms.iter().sum::<f64>() / count;
        let ratio = mean.exp();
        if logarithms.len() < 2 {
            return Self { ratio, interval: None, records: None };
        }
        let squares: f64 = logarithms.iter().map(|one| (one - mean).powi(2)).sum();
        let deviation = (squares / (count - 1.0)).sqrt();
        let half = |n: f64| student_95(n - 1.0) * deviation / n.sqrt();
        let interval = ((mean - half(count)).exp(), (mean + half(count)).exp());
        let enough = (2..=MOST).find(|&n| half(f64::from(n)) < mean);
        let records = enough.filter(|_| mean > 1e-9).map(|n| n as usize);
        Self { ratio, interval: Some(interval), records }
    }
}

/// The network that misses least of what it has not seen, by the mean of the logarithms; the first
/// of equals. One whose fit has no minimum comes last.
pub(crate) fn best(judged: &[Judged]) -> usize {
    let mean = |one: &Judged| one.unseen.iter().map(|part| part.over_sigma.ln()).sum::<f64>();
    let lost = |i: usize| judged[i].fit.not_converged.is_some();
    let by = |a: &usize, b: &usize| {
        lost(*a).cmp(&lost(*b)).then(mean(&judged[*a]).total_cmp(&mean(&judged[*b])))
    };
    (0..judged.len()).min_by(by).unwrap_or(0)
}

impl Judged {
    /// Root of the mean square, over all values that it has not seen, of what it misses, in the
    /// unit of [`UnseenRecord::rms`].
    pub fn unseen_rms(&self) -> f64 {
        let samples: usize = self.unseen.iter().map(|part| part.samples).sum();
        let squares = self.unseen.iter().map(|part| part.rms * part.rms * part.samples as f64);
        (squares.sum::<f64>() / samples.max(1) as f64).sqrt()
    }
}
