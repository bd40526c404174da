//! A step as a series, for those who bound its error: with terms beyond those of its solution.

use super::OneStep;
use super::series::{self, MOST, POLE};
use crate::calls::linear_trouble;
use crate::{IntegrateError, OdeSystem, kernels};

/// Most terms beyond those that the solution uses.
const FURTHER: usize = 1;

/// Share of the last term that a further one is to be below.
const SMALL: f64 = 0.03;

/// A step of [`OneStep`] whose solution is, after a share `s` of the step, the start plus the first
/// terms `u_n` times [`SeriesStep::weights`] of `s`. With the pole `g`, the length `h`, and `y'`,
/// `y''` of the inputs at the start, the terms obey, up to the rounding of the solver,
///
/// ```text
/// (M - g h J) u_1 = h M y' + g h^2 M y'',  (M - g h J) (u_2 + u_1) = M u_1 + g h^2 M y'',
/// (M - g h J) (u_(n+1) + u_n) = M u_n
/// ```
#[derive(Debug)]
pub struct SeriesStep<'a> {
    /// Its start and its end in units of t.
    pub span: (f64, f64),
    /// The share of the series at its end: less than 1 if a stop cuts it.
    pub share: f64,
    /// The length `h` of the whole series in units of t.
    pub length: f64,
    /// The state at its start and at the present time.
    pub ends: [&'a [f64]; 2],
    /// The terms of the solution, and further ones.
    pub terms: &'a [Vec<f64>],
    /// Number of terms of the solution.
    pub used: usize,
    /// The flow at the start, `M y'`.
    pub flow: &'a [f64],
    /// Its change per time at a constant state, `M y''`.
    pub slope: &'a [f64],
}

impl SeriesStep<'_> {
    /// The pole `g`.
    pub const POLE: f64 = POLE;

    /// Most terms of a step, further ones included.
    pub const MOST: usize = MOST + FURTHER;

    /// The weights of the terms of the solution after a share of the step from 0 to 1.
    #[must_use]
    pub fn weights(&self, share: f64) -> [f64; MOST] {
        Self::weigh(self.used, share)
    }

    /// The weights of the terms of a solution with this many of them, at most 12, after a share of
    /// the step from 0 to 1.
    #[must_use]
    pub fn weigh(used: usize, share: f64) -> [f64; MOST] {
        series::change(used, share)
    }
}

impl<S: OdeSystem> OneStep<S> {
    /// The present series up to its end or the stop.
    pub(super) fn present_series(&self) -> Option<SeriesStep<'_>> {
        let begun = self.begun?;
        let end = (begun + self.series.length).min(self.clock.stop);
        Some(SeriesStep {
            span: (self.clock.shown_of(begun), self.clock.shown_of(end)),
            share: self.share(begun, end),
            length: self.series.length,
            ends: [&self.series.start, &self.state],
            terms: &self.series.terms[..self.series.count],
            used: self.series.count,
            flow: &self.flow,
            slope: &self.slope,
        })
    }

    /// The present series with the further terms of [`OneStep::extend`].
    #[must_use]
    pub fn longer_series(&self) -> Option<SeriesStep<'_>> {
        let terms = &self.series.terms[..self.series.known];
        self.present_series().map(|present| SeriesStep { terms, ..present })
    }

    /// Adds terms to the present series until they are small.
    ///
    /// # Errors
    /// Those of the linear solver.
    pub fn extend(&mut self) -> Result<(), IntegrateError> {
        let time = self.clock.shown;
        self.add_terms().map_err(|cause| linear_trouble(time, cause))
    }

    fn add_terms(&mut self) -> Result<(), crate::FactorError> {
        let series = &mut self.series;
        let used = series.count;
        let enough = SMALL * kernels::max_norm(&series.terms[used - 1]);
        let factors = self.levels.factors(series.level)?;
        series.known = used;
        while series.known < used + FURTHER {
            series.next(self.system.mass(), factors)?;
            if kernels::max_norm(&series.terms[series.known - 1]) <= enough {
                break;
            }
        }
        Ok(())
    }
}
