//! The posterior of a law, for studies.

use lptn_netlist::{Posterior, PosteriorOf, PosteriorQuantity};
use lptn_units::statistics::student_95;
use lptn_units::{Correlations, Spread};

use super::candidate::{Coefficient, LawFit};

impl LawFit {
    /// The coefficients with their covariance, straight in the coefficients, as parameters of the
    /// same names. Their standard errors are those to which Student's t gives their 95 % intervals.
    /// `points` and `fit` are the names of the data and the fit. `None` if the law was not fitted,
    /// or if no point is left over to estimate errors.
    pub fn posterior(&self, points: &str, fit: &str) -> Option<Posterior> {
        let fitted = self.fitted()?;
        let left = fitted.degrees_of_freedom;
        let degrees = (left > 0).then_some(left as f64);
        let student = student_95(degrees.unwrap_or(f64::INFINITY));
        let quantity = |own: &Coefficient| {
            let half_width = own.half_width.filter(|half| *half > 0.0)?;
            let sigma = half_width / student;
            Some(PosteriorQuantity {
                name: own.name.clone(),
                of: PosteriorOf::Parameter,
                value: own.value,
                unit: own.dimension.si_unit(),
                spread: Some(Spread::normal(sigma)),
                half_width: Some(half_width),
                degrees_of_freedom: degrees,
                bounds: (f64::NEG_INFINITY, f64::INFINITY),
                prior: None,
            })
        };
        let quantities: Option<Vec<_>> = fitted.coefficients.iter().map(quantity).collect();
        let quantities = quantities?;
        let mut correlations = Correlations::none(quantities.len());
        for i in 0..quantities.len() {
            (0..i).for_each(|j| correlations.set(i, j, fitted.correlation[i][j]));
        }
        let (network, fit) = (points.to_owned(), fit.to_owned());
        Some(Posterior { network, fit, quantities, correlations })
    }
}
