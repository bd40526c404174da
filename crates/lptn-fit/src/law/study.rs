//! Laws compared with each other.

use super::candidate::{Fitted, LawFit, Outcome};
use super::criteria::{aicc, dispersion};
use super::model::LossLaw;
use super::points::Points;
use super::solve;

/// Laws whose criteria differ by less than this cannot be distinguished (K. P. Burnham, D. R.
/// Anderson, Model Selection and Multimodel Inference, 2nd edition, Springer 2002, section 2.6).
pub const ALIKE: f64 = 2.0;

/// Laws that were fitted to the same points, best first.
#[derive(Clone, Debug)]
pub struct LawStudy {
    /// The points that the laws were fitted to.
    pub points: Points,
    /// The laws: those that may be the answer by AICc, then the others.
    pub candidates: Vec<LawFit>,
    /// Factor of the variance over that of the given standard errors, at least 1; see
    /// [`Fitted::aicc`](super::Fitted::aicc).
    pub dispersion: f64,
}

impl LawStudy {
    /// Fits every law to the points and ranks them.
    pub fn new(points: Points, laws: Vec<LossLaw>) -> Self {
        let fitted = |law: LossLaw| {
            let outcome = solve::fit(&law, &points);
            LawFit { law, outcome }
        };
        let mut candidates: Vec<LawFit> = laws.into_iter().map(fitted).collect();
        let dispersion = dispersion(&candidates, &points);
        for candidate in &mut candidates {
            if let Outcome::Fitted(fit) = &mut candidate.outcome {
                fit.aicc = aicc(fit, &points, dispersion);
            }
        }
        candidates
            .sort_by(|a, b| order(a).0.cmp(&order(b).0).then(order(a).1.total_cmp(&order(b).1)));
        Self { points, candidates, dispersion }
    }

    /// The law with the least AICc; `None` if no law has one.
    pub fn best(&self) -> Option<&LawFit> {
        self.candidates.first().filter(|first| first.eligible())
    }

    /// Difference of the AICc of a law from that of the best.
    pub fn behind(&self, candidate: &LawFit) -> Option<f64> {
        let aicc = |candidate: &LawFit| candidate.fitted()?.aicc;
        Some(aicc(candidate)? - aicc(self.best()?)?)
    }

    /// The laws other than the best that may be the answer too: less than [`ALIKE`] above its AICc.
    pub fn rivals(&self) -> Vec<&LawFit> {
        let close =
            |c: &&LawFit| c.eligible() && self.behind(c).is_some_and(|behind| behind < ALIKE);
        self.candidates.iter().skip(1).filter(close).collect()
    }

    /// The laws of one power with the standard exponents, best first: the kinds of loss by
    /// themselves.
    pub fn single_powers(&self) -> Vec<&LawFit> {
        let single =
            |c: &&LawFit| matches!(&c.law, LossLaw::Powers(exponents) if exponents.len() == 1);
        self.candidates.iter().filter(single).collect()
    }

    /// The law with the least root mean square residual (the paper's choice).
    pub fn least_rmse(&self) -> Option<&LawFit> {
        self.least(|fit| Some(fit.rmse))
    }

    /// The law that best predicts a point it was not fitted to.
    pub fn least_leave_one_out(&self) -> Option<&LawFit> {
        self.least(|fit| fit.leave_one_out)
    }

    fn least(&self, of: impl Fn(&Fitted) -> Option<f64>) -> Option<&LawFit> {
        let value = |c: &LawFit| c.fitted().and_then(&of).unwrap_or(f64::INFINITY);
        let eligible = self.candidates.iter().filter(|c| c.eligible());
        eligible.filter(|c| value(c).is_finite()).min_by(|a, b| value(a).total_cmp(&value(b)))
    }

    /// Values of a law at speeds in rad/s, in W, and half the width of its 95 % interval, which is
    /// NaN if no point is left over to estimate it. `None` if the law was not fitted, has no value
    /// at one of the speeds, or may use more than the speed.
    pub fn along(&self, law: &LawFit, speeds: &[f64]) -> Option<Vec<(f64, f64)>> {
        let fit = law.fitted()?;
        if matches!(law.law, LossLaw::Written(_)) && self.points.variables().len() > 1 {
            return None;
        }
        let points = self.points.at_speeds(speeds);
        let p: Vec<f64> = fit.coefficients.iter().map(|c| c.value).collect();
        let at = |point: usize| {
            let (value, slopes) = law.law.evaluate(&p, &points, point).ok()?;
            value.is_finite().then(|| (value, fit.scatter.estimate(value, &slopes).half_width))
        };
        (0..speeds.len()).map(at).collect()
    }

    /// The answer in one sentence.
    pub fn verdict(&self) -> String {
        let Some(best) = self.best() else {
            return format!("{} points are too few to choose a law", self.points.len());
        };
        let rivals = self.rivals();
        let Some(second) = self.candidates.iter().skip(1).find(|c| c.eligible()) else {
            return format!("{} is the only law that these points allow", best.law);
        };
        if rivals.is_empty() {
            let behind = self.behind(second).unwrap_or(f64::NAN);
            return format!(
                "{} is best: the next, {}, is {behind:.1} AICc behind",
                best.law, second.law
            );
        }
        let names: Vec<String> = rivals.iter().map(|c| c.law.to_string()).collect();
        let close = rivals.last().and_then(|c| self.behind(c)).unwrap_or(f64::NAN);
        format!(
            "{} and {} cannot be distinguished by these points (AICc within {close:.1})",
            best.law,
            names.join(", ")
        )
    }
}

/// Answers first, by AICc; then other fitted laws, by their residuals; then those without a fit.
fn order(candidate: &LawFit) -> (u8, f64) {
    match candidate.fitted() {
        Some(fit) if candidate.eligible() => (0, fit.aicc.unwrap_or(f64::INFINITY)),
        Some(fit) => (1, fit.rmse),
        None => (2, 0.0),
    }
}
