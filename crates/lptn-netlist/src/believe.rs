//! A posterior instead of a netlist's own values.
//!
//! A posterior is set, not read into the network: its values are overrides, as those of a load case
//! are. Its standard errors and correlations are in `Parameters`, so that every study gets them
//! without extra code. The `±` of the netlist gives way by the rule of `--set`. A fit, which must
//! not count records twice, omits one call.

use std::path::Path;

use lptn_data::{Diagnostic, Rejected, Span};
use lptn_network::{Network, Parameters};
use lptn_units::statistics::NORMAL_95;
use lptn_units::{Distribution, Spread, format_short};

use crate::netlist::Netlist;
use crate::posterior::{Believed, PosteriorFile, PosteriorQuantity};
use crate::uncertainty::{check, joint, only_known};

/// The parameters that are taken from a posterior.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// Every parameter; the network has to have them all.
    All,
    /// The parameters that the network has, even if there are none.
    Known,
}

/// With fewer degrees of freedom than this, a normal distribution needs a warning: the 95 %
/// interval is already 12 % wider.
const FEW: f64 = 10.0;

/// Two numbers are equal if they differ by less than this share.
const SAME: f64 = 1e-6;

impl Netlist {
    /// The result of a fit, if `posterior` of `[uncertainty]` or [`Netlist::take_posterior`] names
    /// one. [`Netlist::believe`] takes its values.
    pub fn posterior(&self) -> Option<&Believed> {
        self.believed.as_ref()
    }

    /// Takes a posterior from a file that was read, instead of the one that the netlist names.
    ///
    /// # Errors
    /// [`Rejected`] if it is not a posterior, or does not fit the network.
    pub fn take_posterior(
        &mut self,
        path: &Path,
        bytes: &[u8],
        taken: Taken,
    ) -> Result<(), Rejected> {
        let mut files = self.files.clone();
        let file = files.add(path.display().to_string(), String::from_utf8_lossy(bytes));
        let mut believed = match PosteriorFile::read(&files, file, None) {
            Ok(PosteriorFile { posterior, places }) => {
                let top = Span::new(file, 0..0);
                Believed { posterior, only: None, named: None, places, top }
            }
            Err(problem) => return Err(Rejected::arranged(files, vec![problem], 0)),
        };
        if taken == Taken::Known {
            let known = only_known(&believed, &self.network);
            if known.is_empty() {
                return Ok(());
            }
            believed.only = Some(known);
        }
        let problems = check(&self.uncertainty, &self.network, Some(&believed));
        if !problems.is_empty() {
            return Err(Rejected::arranged(files, problems, 0));
        }
        self.inputs.push(file);
        (self.files, self.believed) = (files, Some(believed));
        Ok(())
    }

    /// Gives the parameters the values, errors and correlations of the posterior instead of their
    /// own. Without a posterior nothing changes. Earlier assignments are combined with it.
    ///
    /// # Errors
    /// [`Rejected`] if there is no such network, or if the joint distribution of all parameters is
    /// impossible.
    pub fn believe(&mut self) -> Result<(), Rejected> {
        let Some(believed) = &self.believed else { return Ok(()) };
        let mut new = self.assigned.clone();
        given(believed, &self.network, &mut new);
        self.uncertainty.correlate(&self.network, &mut new);
        let impossible =
            joint(&self.uncertainty, &self.network, &new).map_or(Ok(()), |p| Err(vec![p]));
        let result = impossible.and_then(|()| self.evaluated(&new));
        let (network, run) = result.map_err(|problems| {
            let place = believed.named.clone().unwrap_or_else(|| believed.top.clone());
            let problems = problems
                .into_iter()
                .map(|problem| problem.also(place.clone(), "with the values of the posterior"));
            Rejected::arranged(self.files.clone(), problems.collect(), 0)
        })?;
        let doubts = self.doubts(believed);
        (self.network, self.run, self.assigned) = (network, run, new);
        self.written.extend(doubts);
        self.judge();
        Ok(())
    }

    /// The warnings about a posterior.
    fn doubts(&self, believed: &Believed) -> Vec<Diagnostic> {
        let mut doubts: Vec<Diagnostic> = self.other_network(believed).into_iter().collect();
        for i in believed.chosen() {
            let place = &believed.places[i];
            let quantity = &believed.posterior.quantities[i];
            doubts.extend(self.unknown_prior(quantity, place));
            doubts.extend(few(quantity, place));
            doubts.extend(bound(quantity, place));
        }
        doubts
    }

    /// Warns about a fit of another netlist, unless the netlist names parameters.
    fn other_network(&self, believed: &Believed) -> Option<Diagnostic> {
        let (name, _) = self.inputs().next()?;
        let own = Path::new(name).file_stem()?.to_string_lossy();
        let (network, fit) = (&believed.posterior.network, &believed.posterior.fit);
        if believed.only.is_some() || *network == own || name.starts_with('<') {
            return None;
        }
        let message = format!(
            "the posterior is that of fit `{fit}` of `{network}`, and this is `{own}`: names may \
             mean something else there"
        );
        let place = believed.named.as_ref().unwrap_or(&believed.top);
        let help = "name the parameters to take in [uncertainty]: `posterior = { file = \"..\", \
            only = [\"..\"] }`";
        Some(Diagnostic::doubt("posterior::other_network", message, place, help))
    }

    /// Warns about a `±` that the fit did not know: it does not count.
    fn unknown_prior(&self, quantity: &PosteriorQuantity, place: &Span) -> Option<Diagnostic> {
        let id = self.network.parameter(&quantity.name).ok()?;
        let own =
            self.network.parameters()[id.index()].deviation.filter(|own| !own.is_certain())?;
        let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
        let known = quantity.prior.is_some_and(|prior| {
            let [known, own_sigma] = [prior.spread, own].map(|spread| spread.sigma(prior.value));
            same(known, own_sigma) && prior.spread.distribution == own.distribution
        });
        if known {
            return None;
        }
        let message = format!(
            "`{}` has a `±` that the fit did not use: that of the posterior counts",
            quantity.name
        );
        let written = self.source_map.parameter(id).unwrap_or_else(|| place.clone());
        let help = "leave the `±` out, or fit again: a fit counts it as one more measurement";
        let doubt = Diagnostic::doubt("posterior::prior", message, &written, help);
        Some(doubt.also(place.clone(), "the posterior"))
    }
}

/// Puts the values of the posterior, their errors and correlations into `new`.
fn given(believed: &Believed, network: &Network, new: &mut Parameters) {
    let posterior = &believed.posterior;
    let uncertain = posterior.uncertain();
    let mut taken = Vec::new();
    for i in believed.chosen() {
        let quantity = &posterior.quantities[i];
        let Ok(id) = network.parameter(&quantity.name) else { continue };
        new.set(id, quantity.value);
        // the error of a value on a bound is unknown
        new.set_deviation(id, quantity.spread.unwrap_or(Spread::normal(0.0)));
        if let Ok(row) = uncertain.binary_search(&i) {
            taken.push((id, row));
        }
    }
    for (at, &(a, i)) in taken.iter().enumerate() {
        for &(b, j) in &taken[..at] {
            new.correlate([a, b], posterior.correlations.between(i, j));
        }
    }
}

fn few(quantity: &PosteriorQuantity, place: &Span) -> Option<Diagnostic> {
    let (spread, degrees) = (quantity.spread?, quantity.degrees_of_freedom?);
    if degrees >= FEW {
        return None;
    }
    let (half, normal) = (quantity.half_width?, NORMAL_95 * spread.sigma(quantity.value));
    let message = format!(
        "the standard error of `{}` is known with {} degrees of freedom only: its 95 % interval is \
         ± {} {}, and a normal one ± {}",
        quantity.name,
        rounded(degrees),
        rounded(half),
        quantity.unit,
        rounded(normal)
    );
    let help = "bands are too narrow by as much: fit a longer record, or more of them";
    Some(Diagnostic::doubt("posterior::few_degrees", message, place, help))
}

/// Two digits.
fn rounded(value: f64) -> String {
    format_short(format!("{value:.1e}").parse().unwrap_or(value))
}

/// Warns about a value on a bound, or one whose distribution reaches beyond it.
fn bound(quantity: &PosteriorQuantity, place: &Span) -> Option<Diagnostic> {
    let name = &quantity.name;
    let (message, help) = match quantity.spread {
        None => (
            format!(
                "`{name}` was on a bound of the fit, so its error is not known: it counts as \
                exact"
            ),
            "give it a `±` with `--set`, or fit again with a wider range",
        ),
        Some(spread) if reaches(quantity, spread) => (
            format!("two standard errors of `{name}` reach beyond the bound of the fit"),
            "the distribution is not cut off there; more informative records make it narrower",
        ),
        Some(_) => return None,
    };
    Some(Diagnostic::doubt("posterior::bound", message, place, help))
}

fn reaches(quantity: &PosteriorQuantity, spread: Spread) -> bool {
    let (low, high) = quantity.bounds;
    let value = quantity.value;
    if spread.distribution == Distribution::Lognormal {
        let s = 2.0 * spread.of_logarithm(value);
        return value * (-s).exp() < low || value * s.exp() > high;
    }
    let two = 2.0 * spread.sigma(value);
    value - two < low || value + two > high
}
