//! Comparison of networks on held-out records.

use lptn_units::statistics::student_95;

use crate::choice::{Judged, UnseenRecord};

/// Largest number of records that is useful.
const MOST: u32 = 1000;

/// Held-out residuals of a network relative to those of the best network.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Behind {
    /// Ratio of the residuals: the geometric mean over the records, which no single record
    /// dominates.
    pub ratio: f64,
    /// The 95 % interval of the ratio, from Student's t over the records; `None` for a single one.
    pub interval: Option<(f64, f64)>,
    /// Number of records that would distinguish the two, if further ones scatter as these do.
    /// `None` if that is more than 1000, or if the scatter is not known.
    pub records: Option<usize>,
}

impl Behind {
    /// Compares one network with the best one.
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

/// Index of the network with the smallest held-out residuals, by the mean of the logarithms. The
/// first of equals is taken. A network whose fit has no minimum comes last.
pub(crate) fn best(judged: &[Judged]) -> usize {
    let mean = |one: &Judged| one.unseen.iter().map(|part| part.over_sigma.ln()).sum::<f64>();
    let lost = |i: usize| judged[i].fit.not_converged.is_some();
    let by = |a: &usize, b: &usize| {
        lost(*a).cmp(&lost(*b)).then(mean(&judged[*a]).total_cmp(&mean(&judged[*b])))
    };
    (0..judged.len()).min_by(by).unwrap_or(0)
}

impl Judged {
    /// Root mean square of the residuals over all held-out values, in the unit of
    /// [`UnseenRecord::rms`].
    pub fn unseen_rms(&self) -> f64 {
        let samples: usize = self.unseen.iter().map(|part| part.samples).sum();
        let squares = self.unseen.iter().map(|part| part.rms * part.rms * part.samples as f64);
        (squares.sum::<f64>() / samples.max(1) as f64).sqrt()
    }
}
