//! Margins that are kept with a probability.

use lptn_network::ParameterId;
use lptn_units::Distribution;
use lptn_units::statistics::quantile;

use crate::size::error::TrialError;
use crate::size::judge::{Care, Doubt, Judge, Judged};
use crate::size::load_case::LoadCase;
use crate::uncertainty::{Uncertain, joint};

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

    /// The part of a margin that a direction may take, from the margins to either side at these
    /// standard deviations. If both sides take something, each has half of the probability that is
    /// left. Also the smaller part of the two sides over the larger one.
    fn taken(&self, margin: f64, (sides, at): ([f64; 2], f64)) -> (f64, f64) {
        let [a, b] = sides.map(|side| (margin - side).max(0.0));
        let (most, least) = (a.max(b), a.min(b));
        let share = if most > 0.0 { least / most } else { 0.0 };
        (most * (self.one + (self.two - self.one) * share) / at, share)
    }
}

/// The margins of a design, then the temperatures that they read, at both ends of a direction.
struct Looked {
    /// At the deviations of one side.
    one: [Vec<f64>; 2],
    /// At those of both sides, if neither side of some margin is better.
    two: Option<[Vec<f64>; 2]>,
}

impl Looked {
    fn taken(&self, (i, margin): (usize, f64), quantiles: &Quantiles) -> f64 {
        let at = |ends: &[Vec<f64>; 2], at| {
            quantiles.taken(margin, (ends.each_ref().map(|numbers| numbers[i]), at))
        };
        let (one, _) = at(&self.one, quantiles.one);
        // a curve that begins beyond the deviations of one side counts as far as both sides lose
        let both = self.two.as_ref().map(|two| at(two, quantiles.two));
        both.map_or(one, |(two, share)| one + share * (two - one))
    }

    /// Half the change of a number from one end to the other.
    fn change(&self, i: usize) -> f64 {
        0.5 * (self.one[1][i] - self.one[0][i])
    }
}

impl Judge<'_> {
    /// Subtracts from every margin the part that the `±` of parameters may take with a probability.
    /// Each parameter, with those correlated to it, is moved to either side by the standard
    /// deviations of that probability. For one parameter in which the margin is monotonic that is
    /// exact, whatever the margin; the parts of several add as squares, as for a margin that is
    /// linear in normal parameters. Then all are moved together, in the directions in which a margin
    /// or a temperature that it reads changes most: the larger part counts.
    pub(super) fn doubt(
        &self,
        judged: &mut Judged,
        at: Place<'_>,
        (doubt, care): (Doubt<'_>, Care),
    ) -> Result<(), TrialError> {
        let Some(inputs) = doubt.inputs else { return Ok(()) };
        let quantiles = Quantiles::of(doubt.probability);
        let numbers = [judged.margins.as_slice(), &judged.reached].concat();
        let look = |direction: &Direction| self.look((direction, at), &quantiles, (&numbers, care));
        let alone: Vec<Looked> =
            inputs.directions().iter().map(|one| look(one)).collect::<Result<_, _>>()?;
        let mut together = Vec::new();
        for direction in joint::directions(&self.changes(&alone)) {
            match look(&inputs.along(&direction)) {
                // values that the network refuses are not there
                Err(TrialError::Network(_)) => {}
                found => together.push(found?),
            }
        }
        let taken = |(i, margin): (usize, &f64)| {
            let one = |looked: &Looked| looked.taken((i, *margin), &quantiles);
            let alone = alone.iter().map(|looked| one(looked).powi(2)).sum::<f64>().sqrt();
            together.iter().map(one).fold(alone, f64::max)
        };
        let bend = |(i, margin): (usize, &f64)| {
            let one = |looked: &Looked| 0.5 * (looked.one[0][i] + looked.one[1][i]) - margin;
            alone.iter().map(one).sum::<f64>() / quantiles.one.powi(2)
        };
        let taken: Vec<f64> = judged.margins.iter().enumerate().map(taken).collect();
        judged.left_out = judged.margins.iter().enumerate().map(bend).collect();
        // the deviations are estimates
        judged.proven.iter_mut().for_each(|proven| *proven = None);
        judged.margins.iter_mut().zip(&taken).for_each(|(margin, taken)| *margin -= taken);
        judged.deviations = taken.into_iter().map(|taken| taken / quantiles.one).collect();
        Ok(())
    }

    /// The numbers at both ends of a direction.
    fn look(
        &self,
        direction: (&Direction, Place<'_>),
        quantiles: &Quantiles,
        (numbers, care): (&[f64], Care),
    ) -> Result<Looked, TrialError> {
        let ends = |deviations: f64| {
            let side = |sign: f64| self.moved(direction, (sign, deviations), (numbers, care));
            Ok::<_, TrialError>([side(-1.0)?, side(1.0)?])
        };
        let mut looked = Looked { one: ends(quantiles.one)?, two: None };
        let no_better = |(i, read): (usize, Vec<usize>)| {
            let changes = read.into_iter().any(|number| looked.change(number).abs() > 0.0);
            changes && looked.one.iter().all(|end| end[i] <= numbers[i])
        };
        if self.numbers_read().enumerate().any(no_better) {
            looked.two = Some(ends(quantiles.two)?);
        }
        Ok(looked)
    }

    /// For each requirement the places of its margin, and of the temperatures that it reads.
    fn numbers_read(&self) -> impl Iterator<Item = Vec<usize>> {
        let all = &self.read.of_limits;
        let of_node = |node: &usize| all.len() + 2 * node..all.len() + 2 * node + 2;
        let of_limit = move |(i, nodes): (usize, &Vec<usize>)| {
            std::iter::once(i).chain(nodes.iter().flat_map(of_node)).collect()
        };
        all.iter().enumerate().map(of_limit)
    }

    /// For each requirement the changes of these numbers along each direction.
    fn changes(&self, alone: &[Looked]) -> Vec<Vec<Vec<f64>>> {
        let change = |i: usize| alone.iter().map(|looked| looked.change(i)).collect();
        self.numbers_read().map(|read| read.into_iter().map(change).collect()).collect()
    }

    /// The numbers if parameters are moved along a direction by this number of standard deviations.
    /// If the network refuses such values, those of one deviation, continued as a straight line. A
    /// rectangle is left no further than to its end.
    fn moved(
        &self,
        (direction, (design, case)): (&Direction, Place<'_>),
        (sign, deviations): (f64, f64),
        (numbers, care): (&[f64], Care),
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
            let judged = self.in_case((&design, case), care)?;
            Ok([judged.margins, judged.reached].concat())
        };
        let rectangle =
            direction.iter().any(|(input, _)| input.spread.distribution == Distribution::Rectangle);
        let by = if rectangle { deviations.min(RECTANGLE) } else { deviations };
        let (found, by) = match at(by) {
            Err(TrialError::Network(_)) => (at(1.0)?, 1.0),
            found => (found?, by),
        };
        let continued = |(number, found): (&f64, f64)| number + (found - number) * deviations / by;
        Ok(numbers.iter().zip(found).map(continued).collect())
    }
}
