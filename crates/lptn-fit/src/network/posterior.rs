//! The posterior of a fit, for studies.

use lptn_netlist::{Posterior, PosteriorOf, PosteriorPrior, PosteriorQuantity};
use lptn_units::{Correlations, Distribution, Spread};

use crate::network::coordinates::Coordinates;
use crate::network::fitted::NetworkFit;
use crate::network::task::NetworkFitTask;
use crate::network::unknown::{Unknown, UnknownOf};

impl NetworkFit {
    /// The values with their covariance: normal, or lognormal if the search moved in logarithms (to
    /// first order the standard error of the logarithm is that of the value over the value).
    /// `network` and `fit` are their names, `names` those of the unknowns of the task. `None` if a
    /// value is not determined, or if no error can be estimated.
    pub fn posterior(
        &self,
        task: &NetworkFitTask,
        (network, fit): (&str, &str),
        names: &[String],
    ) -> Option<Posterior> {
        let whole = self.identifiability.as_ref().is_some_and(|known| known.is_whole());
        if !whole || self.not_converged.is_some() {
            return None;
        }
        let unknowns = task.unknowns();
        let coordinates = Coordinates::new(&unknowns);
        let quantity = |(i, unknown): (usize, &Unknown)| {
            let logarithmic = coordinates.is_logarithmic(i);
            self.quantity(i, unknown, (names[i].clone(), logarithmic))
        };
        let quantities: Vec<_> = unknowns.iter().enumerate().map(quantity).collect();
        let uncertain: Vec<usize> =
            (0..quantities.len()).filter(|&i| quantities[i].spread.is_some()).collect();
        let mut correlations = Correlations::none(uncertain.len());
        for (row, &i) in uncertain.iter().enumerate() {
            for (column, &j) in uncertain[..row].iter().enumerate() {
                correlations.set(row, column, self.correlation(i, j)?);
            }
        }
        let (network, fit) = (network.to_owned(), fit.to_owned());
        (!uncertain.is_empty()).then_some(Posterior { network, fit, quantities, correlations })
    }

    fn quantity(
        &self,
        i: usize,
        unknown: &Unknown,
        (name, logarithmic): (String, bool),
    ) -> PosteriorQuantity {
        let fitted = &self.parameters[i];
        let distribution = if logarithmic { Distribution::Lognormal } else { Distribution::Normal };
        let spread = |sigma: f64| PosteriorPrior {
            value: unknown.own,
            spread: Spread::of(unknown.own, sigma, unknown.distribution),
        };
        PosteriorQuantity {
            name,
            of: match unknown.of {
                UnknownOf::Parameter(_) => PosteriorOf::Parameter,
                _ => PosteriorOf::Sensor,
            },
            value: fitted.value,
            unit: unknown.ty.dimension.si_unit(),
            spread: fitted
                .standard_error
                .filter(|error| *error > 0.0)
                .map(|sigma| Spread::of(fitted.value, sigma, distribution)),
            half_width: fitted.half_width,
            degrees_of_freedom: fitted.degrees_of_freedom.filter(|degrees| degrees.is_finite()),
            bounds: unknown.bounds,
            prior: unknown.prior.map(spread),
        }
    }
}
