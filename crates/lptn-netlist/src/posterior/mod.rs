//! What a fit left behind: values with their covariance, as the file `posterior.json` holds them.

mod read;
mod write;

pub(crate) use read::{PosteriorFile, problem};

use lptn_data::Span;
use lptn_units::{Correlations, Distribution, Spread};

/// The version of the file's form.
pub(crate) const FORMAT: &str = "1";

lptn_units::words! {
/// What a quantity of a posterior belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PosteriorOf {
    /// It is a parameter of the network.
    Parameter = "parameter",
    /// It is a value of a sensor, which no run depends on.
    Sensor = "sensor",
}
/// Its word in the file.
pub(crate) fn word;
}

impl PosteriorOf {
    fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.word() == word)
    }
}

/// What was known of a quantity before the fit, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosteriorPrior {
    /// The value.
    pub value: f64,
    /// How far it may be off.
    pub spread: Spread,
}

/// A quantity that a fit found, in SI units, an absolute temperature in K.
#[derive(Clone, Debug, PartialEq)]
pub struct PosteriorQuantity {
    /// Its name: a parameter's, or `tc1.offset`.
    pub name: String,
    /// What it belongs to.
    pub of: PosteriorOf,
    /// What the fit found.
    pub value: f64,
    /// Its SI unit.
    pub unit: String,
    /// How far it may be off; `None` on a bound, where nothing tells it. Normal, or lognormal where
    /// the fit moved in its logarithm.
    pub spread: Option<Spread>,
    /// Half the width of its 95 % interval.
    pub half_width: Option<f64>,
    /// The degrees of freedom of its standard error; `None` where the error is known.
    pub degrees_of_freedom: Option<f64>,
    /// The least and the greatest value that the fit allowed; infinite where there is none.
    pub bounds: (f64, f64),
    /// What was known of it before.
    pub prior: Option<PosteriorPrior>,
}

/// What a fit found: values, how far each may be off, and how far two are off together.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    /// What the network is called: its file without the ending.
    pub network: String,
    /// The name of the fit.
    pub fit: String,
    /// What was found, in the order of the fit.
    pub quantities: Vec<PosteriorQuantity>,
    /// The correlations of those that have a spread, in their order; of a lognormal one that of its
    /// logarithm.
    pub correlations: Correlations,
}

impl PosteriorQuantity {
    /// What the covariance is of: `alpha`, or `ln alpha`.
    fn coordinate(&self) -> Option<String> {
        let spread = self.spread?;
        Some(match spread.distribution {
            Distribution::Lognormal => format!("ln {}", self.name),
            Distribution::Normal | Distribution::Rectangle => self.name.clone(),
        })
    }

    /// The standard deviation of that.
    fn sigma(&self) -> Option<f64> {
        let spread = self.spread?;
        Some(match spread.distribution {
            Distribution::Lognormal => spread.of_logarithm(self.value),
            Distribution::Normal | Distribution::Rectangle => spread.sigma,
        })
    }
}

impl Posterior {
    /// The quantities that the covariance is of, as places among all.
    pub fn uncertain(&self) -> Vec<usize> {
        (0..self.quantities.len()).filter(|&i| self.quantities[i].spread.is_some()).collect()
    }

    /// The covariance of the uncertain quantities, row by row, of a lognormal one that of its
    /// logarithm.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let sigmas: Vec<f64> =
            self.quantities.iter().filter_map(PosteriorQuantity::sigma).collect();
        let entry = |i: usize, j: usize| sigmas[i] * sigmas[j] * self.correlations.between(i, j);
        (0..sigmas.len()).map(|i| (0..sigmas.len()).map(|j| entry(i, j)).collect()).collect()
    }
}

/// A posterior that a netlist takes: where it came from, and what of it counts.
#[derive(Clone, Debug)]
pub struct Believed {
    /// The posterior.
    pub posterior: Posterior,
    /// The parameters that are taken; all unless named.
    pub only: Option<Vec<String>>,
    /// Where the netlist names it; `None` for one of the command line.
    pub(crate) named: Option<Span>,
    /// The places of the quantities in its file.
    pub(crate) places: Vec<Span>,
    /// The beginning of its file.
    pub(crate) top: Span,
}
