//! Numbers of a comparison of fits as they are shown.

use lptn_fit::choice::Judged;
use lptn_report::{decimals, fixed, significant};

use super::FitCompareAnswer;

/// Intervals of ratios are not shown finer than this.
const LEAST: f64 = 0.02;

impl FitCompareAnswer {
    /// Indices of the candidates: the best first, the others by their ratio to its held-out error.
    pub(super) fn order(&self) -> Vec<usize> {
        let behind = |i: usize| self.judged(i).behind.map_or(0.0, |behind| behind.ratio);
        let mut order: Vec<usize> = (0..self.candidates.len()).collect();
        order.sort_by(|&a, &b| {
            let best = |i: usize| i != self.choice.best;
            best(a).cmp(&best(b)).then(behind(a).total_cmp(&behind(b)))
        });
        order
    }

    pub(super) fn judged(&self, i: usize) -> &Judged {
        &self.choice.contenders[i]
    }

    /// Unit of the held-out errors: that of all columns, else standard deviations.
    pub(super) fn unit(&self) -> String {
        let unit = self.choice.contenders[0].task.unit();
        unit.map_or_else(|| "sigma".to_owned(), |ty| ty.dimension.si_unit())
    }

    pub(super) fn name(&self, i: usize) -> &str {
        &self.candidates[i].name
    }

    /// Difference between its AICc and the lowest one.
    pub(super) fn above(&self, i: usize) -> Option<f64> {
        let all = self.choice.contenders.iter().filter_map(|one| one.likely.aicc);
        Some(self.judged(i).likely.aicc? - all.fold(f64::INFINITY, f64::min))
    }

    pub(super) fn shown_above(&self, i: usize) -> String {
        self.above(i).map_or("-".to_owned(), |above| fixed(above, 1))
    }
}

/// "1.86 to 2.26", with digits that suit its width.
pub(super) fn interval((low, high): (f64, f64)) -> String {
    if high > 1e3 * low {
        return format!("{} to {}", significant(low, 2), significant(high, 2));
    }
    let digits = decimals((high - low).max(LEAST), 2, 0);
    format!("{} to {}", fixed(low, digits), fixed(high, digits))
}

/// A ratio, with the digits of its interval.
pub(super) fn ratio(value: f64, interval: Option<(f64, f64)>) -> String {
    match interval {
        Some((low, high)) if high <= 1e3 * low => {
            fixed(value, decimals((high - low).max(LEAST), 2, 0))
        }
        _ => significant(value, 3),
    }
}

/// "< 0.001", "0.14".
pub(super) fn probability(p: f64) -> String {
    if p < 1e-3 { "< 0.001".to_owned() } else { significant(p, 2) }
}

/// "< 0.1 %", "42 %".
pub(super) fn share(weight: f64) -> String {
    match 100.0 * weight {
        percent if percent < 0.1 => "< 0.1 %".to_owned(),
        percent if percent > 99.9 => "> 99.9 %".to_owned(),
        percent if percent > 99.0 => format!("{} %", fixed(percent, 1)),
        percent => format!("{} %", significant(percent, 2)),
    }
}
