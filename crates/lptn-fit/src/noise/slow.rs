//! Drift as slow as the record.
//!
//! The curve absorbs drift as slow as the record, which therefore cannot be tested for. The
//! interval of a single record is widened for such drift if it is as likely as none. The thresholds
//! keep clean records below 98 % coverage and bring 0.05 K over 1000 s above 92 %. A fit of a
//! network with one record is widened too. Each column is treated separately, and the half widths
//! add in squares. Two records are widened in the same way, at a stricter threshold. From three
//! records on, the differences between records cover such drift.

use super::likelihood::{Likelihood, Possible};

/// Times of slow drift, in lengths of the record. Below the first a record distinguishes drift from
/// its curve; beyond the last drift is a straight line with an offset.
const TIMES: [f64; 2] = [0.3, 5.0];
const PLACES: i32 = 12;

/// Logits of the drift's part of the variance, from the least that is felt next to white noise.
const LOGITS: std::ops::RangeInclusive<i32> = 0..=9;

/// Allowed distance of slow drift below white noise, in twice the log-likelihood, for one
/// exponential: nearly as likely is likely enough.
pub(super) const BEHIND_OF_STEP: f64 = 0.15;

/// The same for a network with a known start: its curve absorbs less of a drift, so that fewer
/// clean records look as if they drifted.
pub(super) const BEHIND_OF_NETWORK: f64 = 2.0;

/// The same for one of two records of a network, each of which shows the drift of the other.
pub(super) const BEHIND_OF_TWO: f64 = 0.0;

/// Allowed distance of slow drift below the likeliest noise.
const BEHIND: f64 = 4.0;

impl Likelihood {
    /// All shapes of drift as slow as the record, if that is as likely as white noise and not
    /// refuted by a faster drift. `white` and `likeliest` are twice the negative logarithms of the
    /// likelihoods of white noise and of the likeliest.
    ///
    /// A fit absorbs most of such drift, so its residual is small even if its error is several
    /// times that of the noise. A test for it finds half of them at 5 % of false alarms; so no test
    /// is made. Drift counts if it is as likely as none, or less likely by at most `behind`.
    pub(super) fn slow(
        &self,
        (white, likeliest): (f64, f64),
        behind: f64,
    ) -> Option<Vec<Possible>> {
        let [least, most] = TIMES.map(|part| (part * self.length()).ln());
        let time = |k: i32| least + (most - least) * f64::from(k) / f64::from(PLACES - 1);
        let places = (0..PLACES).flat_map(|k| LOGITS.map(move |l| [time(k), f64::from(l)]));
        let (possible, best) = self.mixture(places);
        (best < white + behind && best < likeliest + BEHIND).then_some(possible)
    }
}
