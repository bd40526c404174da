//! The parameters that are not certain, and their correlations.

use std::ops::Deref;

use lptn_network::{Network, ParameterId, Parameters};
use lptn_units::statistics::share_below;
use lptn_units::{Correlations, Distribution, Spread};

use crate::uncertainty::error::UncertaintyError;

/// A parameter whose value is not certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// The parameter.
    pub parameter: ParameterId,
    /// Its value in SI units, absolute temperatures in K: the mean, for a lognormal one the median.
    pub value: f64,
    /// Its uncertainty, which may follow the value.
    pub spread: Spread,
}

impl Uncertain {
    /// One standard deviation in SI units; for a lognormal one to first order.
    pub fn deviation(&self) -> f64 {
        self.spread.sigma(self.value)
    }

    /// The deviation that a normal number means, in standard deviations to first order.
    pub(crate) fn standard(&self, score: f64) -> f64 {
        match self.spread.distribution {
            Distribution::Normal | Distribution::Lognormal => score,
            Distribution::Rectangle => 3_f64.sqrt() * (2.0 * share_below(score) - 1.0),
        }
    }

    /// The value at a normal number of standard deviations.
    pub(crate) fn at(&self, score: f64) -> f64 {
        self.moved(self.value, self.standard(score))
    }

    /// Another value of the parameter, moved by this number of its standard deviations.
    pub(crate) fn moved(&self, value: f64, deviations: f64) -> f64 {
        match self.spread.distribution {
            Distribution::Normal | Distribution::Rectangle => {
                value + deviations * self.spread.sigma(value)
            }
            Distribution::Lognormal => value * (deviations * self.spread.of_logarithm(value)).exp(),
        }
    }
}

/// The parameters of a network that are not certain, in its order.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    all: Vec<Uncertain>,
    correlations: Correlations,
    /// The lower triangle that makes correlated normal numbers of independent ones, row by row;
    /// `None` if nothing is correlated.
    factor: Option<Vec<f64>>,
}

impl Deref for Inputs {
    type Target = [Uncertain];

    fn deref(&self) -> &[Uncertain] {
        &self.all
    }
}

impl Inputs {
    /// Their correlations; for a lognormal one that of its logarithm.
    pub fn correlations(&self) -> &Correlations {
        &self.correlations
    }

    /// True if any two of them are correlated.
    pub fn are_correlated(&self) -> bool {
        self.factor.is_some()
    }

    /// Covariance of an answer and each of them, in standard deviations of the parameter, from the
    /// effect of one standard deviation of each on the answer. The sum of these times the effects
    /// is the variance of the answer (ISO/IEC Guide 98-3, 5.2.2).
    pub(crate) fn together(&self, effects: &[f64]) -> Vec<f64> {
        if !self.are_correlated() {
            return effects.to_vec();
        }
        let with = |i: usize| {
            let each = effects.iter().enumerate();
            each.map(|(j, effect)| self.correlations.between(i, j) * effect).sum()
        };
        (0..effects.len()).map(with).collect()
    }

    /// The variance of an answer.
    pub(crate) fn variance(&self, effects: &[f64]) -> f64 {
        self.together(effects).iter().zip(effects).map(|(with, effect)| with * effect).sum()
    }

    /// Independent normal numbers made to be correlated as the parameters are.
    pub(crate) fn correlated(&self, scores: Vec<f64>) -> Vec<f64> {
        let Some(factor) = &self.factor else { return scores };
        let n = scores.len();
        let one = |i: usize| (0..=i).map(|j| factor[i * n + j] * scores[j]).sum();
        (0..n).map(one).collect()
    }

    /// Moves of the parameters, in their standard deviations, with each of as many independent
    /// numbers: a unit step along each of these gives the variance of an answer as the sum of
    /// squares.
    pub(crate) fn directions(&self) -> Vec<Vec<(Uncertain, f64)>> {
        let n = self.all.len();
        let triangle = self.correlations.factor().unwrap_or_default();
        let along = |k: usize| {
            let part = |i: usize| triangle.get(i * n + k).copied().unwrap_or(0.0);
            let parts = (k..n).map(|i| (self.all[i], part(i)));
            parts.filter(|(_, part)| part.abs() > 0.0).collect()
        };
        (0..n).map(along).collect()
    }

    /// Moves of the parameters, in their standard deviations, along a vector of the independent
    /// numbers.
    pub(crate) fn along(&self, vector: &[f64]) -> Vec<(Uncertain, f64)> {
        let mut moves = vec![0.0; self.all.len()];
        for (direction, by) in self.directions().iter().zip(vector) {
            for (input, part) in direction {
                let place = self.all.iter().position(|one| one.parameter == input.parameter);
                moves[place.unwrap_or_default()] += by * part;
            }
        }
        let all = self.all.iter().copied().zip(moves);
        all.filter(|(_, part)| part.abs() > 0.0).collect()
    }
}

/// The parameters of `network` that are not certain, in the order of the network. A deviation in
/// `parameters`, the values set instead of its own, replaces the `±` of the network. Percents of
/// zero are certain.
///
/// # Errors
/// [`UncertaintyError::NoDeviation`] if all are certain, [`UncertaintyError::NotDefinite`] if their
/// correlations contradict each other.
pub fn uncertain(network: &Network, parameters: &Parameters) -> Result<Inputs, UncertaintyError> {
    let all = with_deviations(network, parameters).filter(|input| input.deviation() > 0.0);
    joint(network, parameters, all.collect())
}

/// The same for a study that changes values of parameters, which makes percents of zero uncertain.
///
/// # Errors
/// As for [`uncertain`].
pub fn uncertain_anywhere(
    network: &Network,
    parameters: &Parameters,
) -> Result<Inputs, UncertaintyError> {
    joint(network, parameters, with_deviations(network, parameters).collect())
}

/// The parameters with a deviation.
fn with_deviations(network: &Network, parameters: &Parameters) -> impl Iterator<Item = Uncertain> {
    let one = |(parameter, spread)| Uncertain {
        parameter,
        value: network.parameter_value(parameter),
        spread,
    };
    parameters.uncertain().into_iter().map(one)
}

fn joint(
    network: &Network,
    parameters: &Parameters,
    all: Vec<Uncertain>,
) -> Result<Inputs, UncertaintyError> {
    if all.is_empty() {
        return Err(UncertaintyError::NoDeviation);
    }
    let ids: Vec<ParameterId> = all.iter().map(|input| input.parameter).collect();
    let distributions: Vec<Distribution> =
        all.iter().map(|input| input.spread.distribution).collect();
    let correlations = parameters.correlations_of(&ids);
    let name = |i: usize| network.parameters()[ids[i].index()].name.clone();
    let impossible = |i| UncertaintyError::NotDefinite { parameter: name(i) };
    let scores = correlations.of_scores(&distributions);
    correlations.factor().map_err(impossible)?;
    let factor = scores.factor().map_err(impossible)?;
    let factor = correlations.any().then_some(factor);
    Ok(Inputs { all, correlations, factor })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(distribution: Distribution) -> Uncertain {
        let mut builder = lptn_network::NetworkBuilder::new();
        let parameter = builder.parameter("a", lptn_network::Input::number(2.0));
        Uncertain { parameter, value: 2.0, spread: Spread::of(2.0, 0.5, distribution) }
    }

    /// `scipy.stats.norm.cdf(0.7)` is 0.758036347776927; 2 + 0.5 sqrt(3) (2 x 0.758.. - 1) and
    /// 2 exp(0.7 x 0.25) by hand (mpmath, 20 digits).
    #[test]
    fn a_normal_number_moves_each_as_it_is_distributed() {
        let at = |distribution| one(distribution).at(0.7);
        assert!((at(Distribution::Normal) - 2.35).abs() < 1e-15);
        assert!((at(Distribution::Rectangle) - 2.446_932_064_549_13).abs() < 1e-12);
        assert!((at(Distribution::Lognormal) - 2.382_492_433_224_716).abs() < 1e-12);
        // the ends of a rectangle are its limits
        let ends = [-9.0, 9.0].map(|z| one(Distribution::Rectangle).at(z));
        assert!((ends[0] - (2.0 - 0.5 * 3_f64.sqrt())).abs() < 1e-15);
        assert!((ends[1] - (2.0 + 0.5 * 3_f64.sqrt())).abs() < 1e-15);
    }
}
