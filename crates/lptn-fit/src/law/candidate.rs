//! One law, and the result of its fit.

use lptn_units::Dimension;

use super::interval::Scatter;
use super::model::LossLaw;
use crate::least_squares::Stop;

/// A law and the result of its fit.
#[derive(Clone, Debug)]
pub struct LawFit {
    /// The law that was fitted.
    pub law: LossLaw,
    /// The result of the fit.
    pub outcome: Outcome,
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The coefficients with the least sum of squares.
    Fitted(Box<Fitted>),
    /// There are fewer points, or fewer different speeds, than coefficients.
    TooFew {
        /// Required number of each.
        needed: usize,
        /// Number of points.
        points: usize,
        /// Number of different speeds.
        speeds: usize,
    },
    /// The points do not determine all coefficients.
    NotDetermined,
    /// The search found no minimum.
    NotConverged(Stop),
    /// The law has no value, or none that is finite.
    NoValue {
        /// Index of the point.
        point: usize,
        /// Reason.
        reason: String,
    },
}

/// A coefficient of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficient {
    /// Its name: `a`, `b`, `c` in the order of the law's powers, `P_top` (power at the highest
    /// speed) and `n` of the free exponent, or as the user wrote it.
    pub name: String,
    /// Its value in SI units.
    pub value: f64,
    /// Its standard error in SI units; `None` if no point is left over to estimate it.
    pub standard_error: Option<f64>,
    /// Half the width of its 95 % interval in SI units, also valid if points scatter unevenly: see
    /// [`Estimate::half_width`](super::Estimate::half_width).
    pub half_width: Option<f64>,
    /// Its dimension: power over a power of the speed, for example.
    pub dimension: Dimension,
}

/// A fitted law.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The coefficients in the order of the law.
    pub coefficients: Vec<Coefficient>,
    /// Their correlations, row by row, in -1..1.
    pub correlation: Vec<Vec<f64>>,
    /// Value of the law at every point, in W.
    pub values: Vec<f64>,
    /// Root mean square of the residuals in W: the divisor is the number of points, and weights do
    /// not count.
    pub rmse: f64,
    /// The same for each point if the law is fitted to the others, in W; `None` if the others do
    /// not determine the law.
    pub leave_one_out: Option<f64>,
    /// Sum of the squares of the residuals, each over its standard error; without standard errors
    /// in W^2.
    pub squares: f64,
    /// Points less coefficients.
    pub degrees_of_freedom: usize,
    /// Akaike's criterion with the correction for few points; smaller is better, only differences
    /// count. `None` if there are too few points for it.
    pub aicc: Option<f64>,
    /// Scatter of the points, for numbers that follow from the coefficients.
    pub(crate) scatter: Scatter,
}

impl Fitted {
    /// True if a coefficient is below 0. Then a part of the loss would feed heat back, and another
    /// sum fits as well as this one can without it. The exponent of [`LossLaw::FreeExponent`] does
    /// not count.
    pub fn negative(&self) -> bool {
        self.coefficients.iter().any(|c| c.value < 0.0 && !c.dimension.is_none())
    }

    /// The coefficient of this name.
    pub fn coefficient(&self, name: &str) -> Option<&Coefficient> {
        self.coefficients.iter().find(|coefficient| coefficient.name == name)
    }
}

impl LawFit {
    /// The fit, if there is one.
    pub fn fitted(&self) -> Option<&Fitted> {
        match &self.outcome {
            Outcome::Fitted(fitted) => Some(fitted.as_ref()),
            _ => None,
        }
    }

    /// True if it may be the answer: fitted, with its criterion. A sum of powers must have no
    /// negative coefficient; the coefficients of a user's law may have any sign.
    pub fn eligible(&self) -> bool {
        let fitted = self.fitted().filter(|fitted| fitted.aicc.is_some());
        fitted.is_some_and(|fitted| matches!(self.law, LossLaw::Written(_)) || !fitted.negative())
    }

    /// The reason why there is no result, or why it is not an answer; `None` if there is nothing to
    /// report.
    pub fn remark(&self) -> Option<String> {
        match &self.outcome {
            Outcome::Fitted(fitted)
                if !matches!(self.law, LossLaw::Written(_)) && fitted.negative() =>
            {
                Some("a coefficient is negative".to_owned())
            }
            Outcome::Fitted(fitted) if fitted.aicc.is_none() => Some(format!(
                "too few points for AICc and a choice: {} coefficients",
                fitted.coefficients.len()
            )),
            Outcome::Fitted(_) => None,
            Outcome::TooFew { needed, points, .. } if points < needed => {
                Some(format!("too few points: {points} for {needed} coefficients"))
            }
            Outcome::TooFew { needed, speeds, .. } => {
                Some(format!("too few different speeds: {speeds} for {needed} coefficients"))
            }
            Outcome::NotDetermined => {
                Some("the points do not determine its coefficients".to_owned())
            }
            Outcome::NotConverged(stop) => {
                Some(format!("the fit did not converge: {}", stop.text()))
            }
            Outcome::NoValue { point, reason } => {
                Some(format!("no value at point {}: {reason}", point + 1))
            }
        }
    }
}
