//! The derivatives by the parameters along the way, for an adjoint without running integrals.

use lptn_integrate::OdeSystem;
use lptn_integrate::vectors::add;

use super::error::BackwardError;
use super::way::Way;
use crate::trajectory::Series;

/// Points and weights of Gauss and Legendre's rule on (-1, 1), exact to degree 9; the last number is
/// the weight of the rule through three of them, exact to degree 3.
pub(super) const GAUSS: [[f64; 3]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_08, 0.405_928_877_095_966_4],
    [-0.538_469_310_105_683_1, 0.478_628_670_499_366_47, 0.0],
    [0.0, 0.568_888_888_888_888_9, 1.188_142_245_808_067_3],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_47, 0.0],
    [0.906_179_845_938_664, 0.236_926_885_056_189_08, 0.405_928_877_095_966_4],
];

/// Halvings of a part.
const HALVINGS: usize = 20;

impl Way<'_> {
    /// Adds the derivatives of a step of the adjoint: over each part in which the run and the adjoint
    /// are smooth.
    pub(super) fn add_step(
        &mut self,
        stretch: usize,
        (adjoint, span): (&Series, (f64, f64)),
    ) -> Result<(), BackwardError> {
        let known = &self.asked.trajectory.stretches[stretch];
        let ends: Vec<f64> =
            [span.0].into_iter().chain(known.joints(span)).chain([span.1]).collect();
        for part in ends.windows(2).rev() {
            self.add_part(adjoint, (part[0], part[1]), HALVINGS)?;
        }
        Ok(())
    }

    /// The two rules differ by at most such a part of the integral of the absolute value so far that
    /// the finer one errs by the tolerance of the adjoint: by the power 10/4 of that part. Both are
    /// norms over the parameters, each times its step, so that their units are the same.
    fn add_part(
        &mut self,
        adjoint: &Series,
        (from, to): (f64, f64),
        halvings: usize,
    ) -> Result<(), BackwardError> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let count = self.found.len();
        let [mut fine, mut apart, mut size] = std::array::from_fn(|_| vec![0.0; count]);
        let system = self.integrator.system_mut();
        let (mut state, mut rates) = (vec![0.0; system.size()], vec![0.0; count]);
        let by = half / system.scale;
        for [place, weight, other] in GAUSS {
            let time = middle + half * place;
            adjoint.at(-time, &mut state);
            system.integrands(time, &state, &mut rates)?;
            add(&mut fine, by * weight, &rates);
            add(&mut apart, by * (weight - other), &rates);
            rates.iter_mut().for_each(|rate| *rate = rate.abs());
            add(&mut size, by * weight, &rates);
        }
        let size = self.size + self.norm(&size);
        let share = self.norm(&apart) / size.max(f64::MIN_POSITIVE);
        if share * share * share.sqrt() <= self.tolerance {
            add(&mut self.found, 1.0, &fine);
            self.size = size;
            return Ok(());
        }
        let Some(left) = halvings.checked_sub(1) else { return Err(self.asked.unresolved()) };
        self.add_part(adjoint, (middle, to), left)?;
        self.add_part(adjoint, (from, middle), left)
    }

    /// The norm of derivatives by the parameters, each times its step.
    fn norm(&self, slopes: &[f64]) -> f64 {
        let squares = slopes.iter().zip(&self.steps).map(|(slope, step)| (slope * step).powi(2));
        squares.sum::<f64>().sqrt()
    }
}
