//! Margins that are kept with a probability.

use lptn_network::ParameterId;
use lptn_units::Distribution;
use lptn_units::statistics::quantile;

use crate::size::error::TrialError;
use crate::size::judge::{Care, Doubt, Judge, Judged};
use crate::size::load_case::LoadCase;
use crate::uncertainty::{Inputs, Uncertain};

/// The most standard deviations to the end of a rectangle.
const RECTANGLE: f64 = 1.732_050_807_568_877_2;

/// Parameters that move together, each by this share of its standard deviation.
type Direction = [(Uncertain, f64)];

/// A design and the load case it is in.
type Place<'a> = (&'a [(ParameterId, f64)], &'a LoadCase);

/// Standard deviations that a probability means.
struct Quantiles {
    /// On one side.
    one: f64,
    /// On both sides together.
    two: f64,
}

impl Quantiles {
    fn of(probability: f64) -> Self {
        Self { one: quantile(probability), two: quantile(0.5 * (1.0 + probability)) }
    }

    /// The part of a margin that a direction may take, from the margin and those to either side. If
    /// both sides take something, each has half of the probability that is left.
    fn taken(&self, margin: f64, sides: [f64; 2]) -> f64 {
        let [a, b] = sides.map(|side| (margin - side).max(0.0));
        let (most, least) = (a.max(b), a.min(b));
        let share = if most > 0.0 { least / most } else { 0.0 };
        most * (1.0 + (self.two / self.one - 1.0) * share)
    }
}

impl Judge<'_> {
    /// Subtracts from every margin the part that the `±` of parameters may take with a probability.
    /// Each parameter, with those correlated to it, is moved to either side by the standard
    /// deviations of that probability. For one parameter in which the margin is monotonic that is
    /// exact, whatever the margin; the parts of several add as squares, as for a margin that is
    /// linear in normal parameters.
    pub(super) fn doubt(
        &self,
        judged: &mut Judged,
        at: Place<'_>,
        (doubt, care): (Doubt<'_>, Care),
    ) -> Result<(), TrialError> {
        let count = judged.margins.len();
        let (mut squares, mut left_out) = (vec![0.0; count], vec![0.0; count]);
        let quantiles = Quantiles::of(doubt.probability);
        for direction in doubt.inputs.into_iter().flat_map(Inputs::directions) {
            let side = |sign: f64| {
                self.moved((&direction, at), (sign, quantiles.one), (&judged.margins, care))
            };
            let (low, high) = (side(-1.0)?, side(1.0)?);
            for (i, margin) in judged.margins.iter().enumerate() {
                squares[i] += quantiles.taken(*margin, [low[i], high[i]]).powi(2);
                left_out[i] += (0.5 * (high[i] + low[i]) - margin) / quantiles.one.powi(2);
            }
        }
        judged.left_out = left_out;
        // the deviations are estimates
        judged.proven.iter_mut().for_each(|proven| *proven = None);
        let taken: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
        judged.margins.iter_mut().zip(&taken).for_each(|(margin, taken)| *margin -= taken);
        judged.deviations = taken.into_iter().map(|taken| taken / quantiles.one).collect();
        Ok(())
    }

    /// The margins if parameters are moved along a direction by this number of standard deviations.
    /// If the network refuses such values, those of one deviation, continued as a straight line. A
    /// rectangle is left no further than to its end.
    fn moved(
        &self,
        (direction, (design, case)): (&Direction, Place<'_>),
        (sign, deviations): (f64, f64),
        (margins, care): (&[f64], Care),
    ) -> Result<Vec<f64>, TrialError> {
        let value = |id: ParameterId| {
            let set = case.set.iter().chain(design).rev().find(|(other, _)| *other == id);
            set.map_or(self.base.parameter_value(id), |(_, value)| *value)
        };
        let at = |by: f64| {
            let to = |(input, part): &(Uncertain, f64)| {
                (input.parameter, input.moved(value(input.parameter), sign * by * part))
            };
            let design: Vec<_> = design.iter().copied().chain(direction.iter().map(to)).collect();
            self.in_case((&design, case), care).map(|judged| judged.margins)
        };
        let rectangle =
            direction.iter().any(|(input, _)| input.spread.distribution == Distribution::Rectangle);
        let by = if rectangle { deviations.min(RECTANGLE) } else { deviations };
        let (found, by) = match at(by) {
            Err(TrialError::Network(_)) => (at(1.0)?, 1.0),
            found => (found?, by),
        };
        let continued = |(margin, found): (&f64, f64)| margin + (found - margin) * deviations / by;
        Ok(margins.iter().zip(found).map(continued).collect())
    }
}
