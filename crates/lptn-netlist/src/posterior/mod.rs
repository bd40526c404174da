//! The result of a fit: values with their covariance, as the file `posterior.json` contains them.

mod read;
mod write;

pub(crate) use read::{PosteriorFile, problem};

use lptn_data::Span;
use lptn_units::{Correlations, Distribution, Spread};

/// The version of the file's form.
pub(crate) const FORMAT: &str = "1";

lptn_units::words! {
/// The owner of a quantity of a posterior.
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

/// Knowledge of a quantity before the fit, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosteriorPrior {
    /// The value.
    pub value: f64,
    /// Its uncertainty.
    pub spread: Spread,
}

/// A quantity that a fit estimated, in SI units, an absolute temperature in K.
#[derive(Clone, Debug, PartialEq)]
pub struct PosteriorQuantity {
    /// Its name: a parameter's, or `tc1.offset`.
    pub name: String,
    /// Its owner.
    pub of: PosteriorOf,
    /// The estimate of the fit.
    pub value: f64,
    /// Its SI unit.
    pub unit: String,
    /// Its uncertainty; `None` on a bound, as it is unknown. Normal, or lognormal if the fit
    /// varied its logarithm.
    pub spread: Option<Spread>,
    /// Half the width of its 95 % interval.
    pub half_width: Option<f64>,
    /// The degrees of freedom of its standard error; `None` if the error is known.
    pub degrees_of_freedom: Option<f64>,
    /// The least and the greatest value that the fit allowed; infinite if there is none.
    pub bounds: (f64, f64),
    /// Its prior.
    pub prior: Option<PosteriorPrior>,
}

/// The result of a fit: values, the uncertainty of each, and their correlations.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    /// The name of the network: its file without the extension.
    pub network: String,
    /// The name of the fit.
    pub fit: String,
    /// The quantities, in the order of the fit.
    pub quantities: Vec<PosteriorQuantity>,
    /// The correlations of the quantities that have a spread, in their order; those of lognormal
    /// ones are of their logarithms.
    pub correlations: Correlations,
}

impl PosteriorQuantity {
    /// The coordinate of its covariance: `alpha`, or `ln alpha`.
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
            Distribution::Normal | Distribution::Rectangle => spread.sigma(self.value),
        })
    }
}

impl Posterior {
    /// The quantities of the covariance, as positions among all.
    pub fn uncertain(&self) -> Vec<usize> {
        (0..self.quantities.len()).filter(|&i| self.quantities[i].spread.is_some()).collect()
    }

    /// The covariance of the uncertain quantities, row by row; that of lognormal ones is of their
    /// logarithms.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let sigmas: Vec<f64> =
            self.quantities.iter().filter_map(PosteriorQuantity::sigma).collect();
        let entry = |i: usize, j: usize| sigmas[i] * sigmas[j] * self.correlations.between(i, j);
        (0..sigmas.len()).map(|i| (0..sigmas.len()).map(|j| entry(i, j)).collect()).collect()
    }
}

/// A posterior that a netlist takes, with its origin and the parameters that count.
#[derive(Clone, Debug)]
pub struct Believed {
    /// The posterior.
    pub posterior: Posterior,
    /// The parameters that are taken; all unless named.
    pub only: Option<Vec<String>>,
    /// The place that names it in the netlist; `None` for one of the command line.
    pub(crate) named: Option<Span>,
    /// The places of the quantities in its file.
    pub(crate) places: Vec<Span>,
    /// The beginning of its file.
    pub(crate) top: Span,
}
