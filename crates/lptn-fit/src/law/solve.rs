//! The coefficients of one law.

use faer::Mat;
use lptn_integrate::dense;

use super::candidate::{Coefficient, Fitted, Outcome};
use super::criteria::rms;
use super::interval::Scatter;
use super::model::LossLaw;
use super::points::Points;
use crate::Covariance;
use crate::least_squares::{self, Residuals, Settings};

/// Up to this number, each point is left out in turn and the law fitted again. Beyond it, and for
/// laws that are linear in their coefficients, the residual follows from the leverage of the point.
const REFITS: usize = 500;

/// Fits a law, without its criterion.
pub(crate) fn fit(law: &LossLaw, points: &Points) -> Outcome {
    let (needed, speeds) = (law.count(), points.distinct_speeds());
    // a user's law may use more than the speed
    let speed_alone = points.variables().len() == 1 || !matches!(law, LossLaw::Written(_));
    if points.len() < needed || (speed_alone && speeds < needed) {
        return Outcome::TooFew { needed, points: points.len(), speeds };
    }
    match search(law, points, None) {
        Ok(p) => conclude(law, points, &p),
        Err(outcome) => outcome,
    }
}

/// The law near some coefficients: residuals and derivatives, both over the standard errors.
struct Local {
    /// Law less data.
    misses: Vec<f64>,
    values: Vec<f64>,
    /// One coefficient after the other.
    jacobian: Vec<f64>,
}

impl Local {
    fn new(law: &LossLaw, points: &Points, p: &[f64]) -> Result<Self, Outcome> {
        let (mut values, mut rows) = (Vec::new(), Vec::new());
        for point in 0..points.len() {
            let found = law.evaluate(p, points, point);
            let (value, slopes) =
                found.map_err(|error| Outcome::NoValue { point, reason: error.to_string() })?;
            values.push(value);
            rows.push(slopes);
        }
        let scale = |point: usize| points.scale(point);
        let misses =
            values.iter().enumerate().map(|(i, v)| (v - points.power()[i]) / scale(i)).collect();
        let column = |j: usize| rows.iter().enumerate().map(move |(i, row)| row[j] / scale(i));
        Ok(Self { misses, values, jacobian: (0..p.len()).flat_map(column).collect() })
    }

    /// The derivatives of one point.
    fn row(&self, point: usize) -> Vec<f64> {
        self.jacobian.iter().skip(point).step_by(self.misses.len()).copied().collect()
    }

    fn column(&self, j: usize) -> &[f64] {
        let rows = self.misses.len();
        &self.jacobian[j * rows..][..rows]
    }

    /// The coefficients at which the linear model of the law is nearest to the data, by QR.
    fn solved(&self, p: &[f64]) -> Option<Vec<f64>> {
        let (rows, count) = (self.misses.len(), p.len());
        let norm = |j: usize| self.column(j).iter().map(|x| x * x).sum::<f64>().sqrt();
        let norms: Vec<f64> = (0..count).map(norm).collect();
        let scaled = Mat::from_fn(rows, count, |i, j| self.column(j)[i] / norms[j]);
        let target = Mat::from_fn(rows, 1, |i, _| -self.misses[i]);
        let step = dense::least_squares(scaled.as_ref(), target.as_ref());
        let found: Vec<f64> = (0..count).map(|j| p[j] + step[(j, 0)] / norms[j]).collect();
        found.iter().all(|x| x.is_finite()).then_some(found)
    }

    /// `(J^T J)^-1`.
    fn inverse(&self, count: usize) -> Option<Covariance> {
        Covariance::inverse(&self.jacobian, self.misses.len(), &(0..count).collect::<Vec<_>>())
    }

    /// Scatter for numbers that follow from the coefficients. Given standard errors are known, and
    /// 1 on the scale of the residuals.
    fn scatter(&self, inverse: &Covariance, points: &Points) -> Scatter {
        let known = if points.deviation().is_some() { 1.0 } else { 0.0 };
        let count = self.misses.len();
        let rows = (0..count).map(|point| self.row(point)).collect();
        Scatter::new(rows, inverse, self.misses.clone(), vec![known; count])
    }
}

/// True if the derivatives by the coefficients do not depend on them.
fn linear(law: &LossLaw, points: &Points) -> bool {
    let LossLaw::Written(written) = law else { return matches!(law, LossLaw::Powers(_)) };
    let [first, .., last] = &written.starts()[..] else {
        return written.starts().first().is_some_and(|start| {
            same_slopes(
                law,
                points,
                start,
                &start.iter().map(|x| 3.0 * x + 1.0).collect::<Vec<_>>(),
            )
        });
    };
    same_slopes(law, points, first, last)
}

fn same_slopes(law: &LossLaw, points: &Points, one: &[f64], other: &[f64]) -> bool {
    let (Ok(one), Ok(other)) = (Local::new(law, points, one), Local::new(law, points, other))
    else {
        return false;
    };
    one.jacobian
        .iter()
        .zip(&other.jacobian)
        .all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs().max(b.abs()))
}

/// Start values of the searches.
fn starts(law: &LossLaw, points: &Points) -> Vec<Vec<f64>> {
    match law {
        LossLaw::Powers(exponents) => vec![vec![0.0; exponents.len()]],
        LossLaw::Written(written) => written.starts(),
        LossLaw::FreeExponent => {
            let top = points.largest_power().max(f64::MIN_POSITIVE);
            [1.0, 2.0, 0.0].iter().map(|n| vec![top, *n]).collect()
        }
    }
}

/// The best coefficients, or why there are none; the search begins at `near` if it is given.
fn search(law: &LossLaw, points: &Points, near: Option<&[f64]>) -> Result<Vec<f64>, Outcome> {
    let starts = near.map_or_else(|| starts(law, points), |near| vec![near.to_vec()]);
    if linear(law, points) {
        let start = &starts[0];
        return Local::new(law, points, start)?.solved(start).ok_or(Outcome::NotDetermined);
    }
    let mut best: Option<(f64, Vec<f64>)> = None;
    let mut why = None;
    for start in &starts {
        match descend(law, points, start) {
            Ok((squares, p)) if best.as_ref().is_none_or(|(least, _)| squares < *least) => {
                best = Some((squares, p));
            }
            Ok(_) => {}
            Err(outcome) => why = why.or(Some(outcome)),
        }
    }
    best.map(|(_, p)| p).ok_or_else(|| why.unwrap_or(Outcome::NotDetermined))
}

struct Search<'a> {
    law: &'a LossLaw,
    points: &'a Points,
}

impl Residuals for Search<'_> {
    fn parameters(&self) -> usize {
        self.law.count()
    }

    fn evaluate(&mut self, p: &[f64], _: bool) -> least_squares::Evaluated {
        // if the law has no value, the search takes a shorter step
        let rows = self.points.len();
        let nowhere = |_| (vec![f64::NAN; rows], vec![f64::NAN; rows * p.len()]);
        let local = Local::new(self.law, self.points, p);
        Ok(local.map_or_else(nowhere, |local| (local.misses, local.jacobian)))
    }
}

fn descend(law: &LossLaw, points: &Points, start: &[f64]) -> Result<(f64, Vec<f64>), Outcome> {
    Local::new(law, points, start)?;
    match least_squares::minimise(&mut Search { law, points }, start, &Settings::default()) {
        Ok(found) => match found.outcome {
            least_squares::Termination::Converged(_) => Ok((found.squares, found.parameters)),
            least_squares::Termination::NotConverged(stop) => Err(Outcome::NotConverged(stop)),
        },
        Err(_) => Err(Outcome::NotDetermined),
    }
}

/// A coefficient whose standard error is this many times its value was not found.
const DRIFT: f64 = 1e3;

/// All results of a law with these coefficients except its criterion.
fn conclude(law: &LossLaw, points: &Points, p: &[f64]) -> Outcome {
    let local = match Local::new(law, points, p) {
        Ok(local) => local,
        Err(outcome) => return outcome,
    };
    let Some(inverse) = local.inverse(p.len()) else { return Outcome::NotDetermined };
    let scatter = local.scatter(&inverse, points);
    let coefficients = coefficients(law, p, &scatter);
    let drifts = |c: &Coefficient| c.standard_error.is_some_and(|e| e > DRIFT * c.value.abs());
    if !linear(law, points) && coefficients.iter().any(drifts) {
        return Outcome::NotDetermined; // the search ran off to where a coefficient has no effect
    }
    let all = 0..p.len();
    let row =
        |i: usize| all.clone().map(|j| inverse.correlation(i, j).unwrap_or(f64::NAN)).collect();
    Outcome::Fitted(Box::new(Fitted {
        coefficients,
        correlation: all.clone().map(row).collect(),
        rmse: rms(local.values.iter().zip(points.power()).map(|(value, power)| value - power)),
        leave_one_out: leave_one_out(law, points, (p, &local), &scatter),
        values: local.values,
        squares: local.misses.iter().map(|residual| residual * residual).sum(),
        degrees_of_freedom: points.len() - p.len(),
        aicc: None,
        scatter,
    }))
}

/// The coefficients of a law with their errors.
fn coefficients(law: &LossLaw, p: &[f64], scatter: &Scatter) -> Vec<Coefficient> {
    let coefficient = |(j, (name, dimension)): (usize, (String, _))| {
        let mut slopes = vec![0.0; p.len()];
        slopes[j] = 1.0;
        let found = scatter.estimate(p[j], &slopes);
        let told = |error: f64| (!error.is_nan()).then_some(error);
        Coefficient {
            name,
            value: p[j],
            standard_error: told(found.standard_error),
            half_width: told(found.half_width),
            dimension,
        }
    };
    law.coefficients().into_iter().enumerate().map(coefficient).collect()
}

fn leave_one_out(
    law: &LossLaw,
    points: &Points,
    (p, local): (&[f64], &Local),
    scatter: &Scatter,
) -> Option<f64> {
    if points.len() <= p.len() {
        return None;
    }
    let missed: Option<Vec<f64>> = if linear(law, points) || points.len() > REFITS {
        let leverages = scatter.leverages();
        let residual = |(i, h): (usize, &f64)| {
            (*h < 1.0 - 1e-9).then(|| local.misses[i] * points.scale(i) / (1.0 - h))
        };
        leverages.iter().enumerate().map(residual).collect()
    } else {
        let residual = |i: usize| {
            let p = search(law, &points.without(i), Some(p)).ok()?;
            Some(law.evaluate(&p, points, i).ok()?.0 - points.power()[i])
        };
        (0..points.len()).map(residual).collect()
    };
    missed.map(|misses| rms(misses.into_iter()))
}
