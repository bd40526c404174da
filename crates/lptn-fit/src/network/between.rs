//! Check that records differ by more than their noise explains.
//!
//! The scatter from run to run is not visible in the rows of one record. From three records on, an
//! error is the larger of two sandwiches: one with the noise of the rows, one clustered by record.
//! No test decides between them. At 0.1 % a test left 85 % coverage when the scatter equals the
//! noise. The larger of the two gives 92 to 97 % at any scatter (also in closed form, for normal
//! values of 3 to 20 records).
//!
//! Variances of a model with random effects (REML) would need the scatter of each parameter to be
//! named. They give the same result if records are equally informative. Degrees of freedom come
//! from the shares of the records in a parameter, not from their estimated noise, which contains a
//! record's misfit.

use lptn_units::statistics::chi_square_999;

/// Scatter of a parameter between records: mounting, oil or a slow drift change from run to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetweenRecords {
    /// Root mean square distance of the records over that expected from their noise.
    pub ratio: f64,
    /// The standard error that follows from the scatter of the records, in SI units.
    pub standard_error: f64,
    /// Its degrees of freedom: the number of records that count, less one.
    pub degrees_of_freedom: f64,
    /// True if chance alone causes such a scatter in less than one of 1000 fits.
    pub differ: bool,
}

/// Effect of one record on a parameter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Told {
    /// Distance by which it pulls the parameter.
    pub(crate) pull: f64,
    /// Change of the parameter per unit of its change in this record: those of all records and of
    /// prior knowledge add up to 1.
    pub(crate) share: f64,
    /// The variance that its noise adds.
    pub(crate) variance: f64,
}

impl BetweenRecords {
    /// The mean of the squares of the pulls is the variance of the parameter if records are drawn
    /// by chance (K.-Y. Liang, S. L. Zeger, Biometrika 73 (1986) 13), with as many degrees of
    /// freedom as records that have a share (R. M. Bell, D. F. McCaffrey, Survey Methodology 28
    /// (2002) 169), less one. `None` if less than two and a half records count.
    pub(crate) fn of(records: &[Told]) -> Option<Self> {
        const LEAST: f64 = 1.5;
        let told = || records.iter().filter(|told| told.variance > 0.0 && told.share > 0.0);
        let sum = |of: &dyn Fn(&Told) -> f64| told().map(of).sum::<f64>();
        let (all, shares) = (sum(&|told| told.pull), sum(&|told| told.share));
        let degrees = shares * shares / sum(&|told| told.share * told.share) - 1.0;
        if degrees.is_nan() || degrees < LEAST {
            return None;
        }
        let others = told().count() as f64 - 1.0;
        let noise = sum(&|told| told.variance);
        let squares = sum(&|told| told.pull * told.pull / told.variance) - all * all / noise;
        // prior knowledge pulls against all of them
        let off = sum(&|told| (told.pull - all * told.share / shares).powi(2));
        Some(Self {
            ratio: (squares / others).max(0.0).sqrt(),
            standard_error: (off * (degrees + 1.0) / degrees).sqrt(),
            degrees_of_freedom: degrees,
            differ: squares > chi_square_999(others),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{BetweenRecords, Told};

    /// Records with equal shares: the standard error of a mean of 4 values.
    #[test]
    fn analytic_equal_records_have_the_error_of_their_mean() {
        let off = [3.0, -1.0, -4.0, 2.0_f64];
        let records = |variance: f64| {
            off.map(|off| Told { pull: off / 4.0, share: 0.25, variance: variance / 16.0 })
        };
        let found = BetweenRecords::of(&records(0.01)).unwrap();
        let squares = off.iter().map(|x| x * x).sum::<f64>();
        assert!((found.standard_error - (squares / 12.0).sqrt()).abs() < 1e-12);
        assert!((found.degrees_of_freedom - 3.0).abs() < 1e-12);
        assert!((found.ratio - (squares / 0.01 / 3.0).sqrt()).abs() < 1e-9);
        assert!(found.differ && !BetweenRecords::of(&records(30.0)).unwrap().differ);
        assert!(BetweenRecords::of(&records(0.01)[..2]).is_none());
    }
}
