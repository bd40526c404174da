//! The port's temperature after a unit step of heat into it, as a sum of exponentials.

use lptn_assembly::ThermalSystem;
use lptn_integrate::vectors::dot;

use crate::error::ReduceError;
use crate::lanczos::{self, Mode};
use crate::norton::NortonEquivalent;
use crate::rises::{Rises, Way};

/// One exponential of a step response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseTerm {
    /// Its time constant in s.
    pub tau: f64,
    /// Its share of `R_eq` in K/W.
    pub resistance: f64,
    /// Upper bound of the distance of `tau` from a time constant of the network, in s.
    pub error: f64,
}

/// Rise of the port in K for 1 W into it from time 0 on: `R_eq - sum of r_i exp(-t / tau_i)`.
///
/// The terms are the modes of `C dT/dt = -G T` that heat at the port excites: eigenvalues of
/// `C^1/2 G^-1 C^1/2` found by Lanczos iteration from `C^1/2 G^-1 e_p`, so that the slowest come
/// first and modes that the port does not see never appear. For small networks they are complete.
/// For large ones the iteration ends when the curve is known to 1e-9 of `R_eq`, or after 300
/// vectors, and [`StepResponse::residual`] is the remainder.
#[derive(Clone, Debug, PartialEq)]
pub struct StepResponse {
    /// `R_eq` in K/W.
    pub resistance: f64,
    /// The immediate rise in K/W: 0 unless the port is massless.
    pub direct: f64,
    /// The terms, slowest first.
    pub terms: Vec<ResponseTerm>,
    /// Error of the terms in the rise at time 0 in K/W: the part of the fastest modes that is not
    /// resolved. The curve is least exact there, so this is the size of its largest error (an
    /// estimate, not a bound).
    pub residual: f64,
}

/// Smallest share of `R_eq` of a mode that the port sees.
const VISIBLE: f64 = 1e-9;

/// The curve is known well enough if its error is at most this share of `R_eq`.
const CURVE: f64 = 1e-9;

/// The slowest time constant is known well enough with this relative error.
const SLOWEST: f64 = 1e-13;

impl StepResponse {
    /// The response at the port of `norton`; `None` if no capacity is connected with it.
    ///
    /// # Errors
    /// [`ReduceError::Factorization`], [`ReduceError::Modes`].
    pub fn new(
        system: &ThermalSystem,
        norton: &NortonEquivalent,
    ) -> Result<Option<Self>, ReduceError> {
        Self::with(system, norton, &mut Rises::new(system)?)
    }

    pub(crate) fn with(
        system: &ThermalSystem,
        norton: &NortonEquivalent,
        rises: &mut Rises<'_>,
    ) -> Result<Option<Self>, ReduceError> {
        let known = Known {
            rise: &norton.response,
            resistance: norton.resistance,
            direct: direct(system, norton),
        };
        Self::known(system, &known, rises)
    }

    /// The response of `sum of h_n T_n` to heat of h_n W in every node n: that of a port if h is 1
    /// there, and of the sum or difference of two.
    pub(crate) fn for_heat(
        system: &ThermalSystem,
        heat: &[f64],
        rises: &mut Rises<'_>,
    ) -> Result<Self, ReduceError> {
        let rise = rises.of_nodes(heat, Way::Forth)?;
        let resistance = dot(heat, &rise);
        let known = Known { rise: &rise, resistance, direct: at_once(system, heat) };
        let none = Self { resistance, direct: known.direct, terms: Vec::new(), residual: 0.0 };
        Ok(Self::known(system, &known, rises)?.unwrap_or(none))
    }

    fn known(
        system: &ThermalSystem,
        known: &Known<'_>,
        rises: &mut Rises<'_>,
    ) -> Result<Option<Self>, ReduceError> {
        let &Known { rise, resistance, direct } = known;
        let root: Vec<f64> = system.capacity().iter().map(|c| c.sqrt()).collect();
        let rise = system.states().iter().map(|id| rise[id.index()]);
        let start: Vec<f64> = rise.zip(&root).map(|(r, c)| r * c).collect();
        if start.iter().all(|x| *x == 0.0) {
            return Ok(None);
        }
        let moved = resistance - direct;
        let enough = |modes: &[Mode]| {
            let first = modes[0];
            let sum: f64 = terms(modes).iter().map(|term| term.resistance).sum();
            (sum - moved).abs() <= CURVE * resistance && first.error <= SLOWEST * first.value
        };
        let mut apply = |x: &[f64]| {
            let heat: Vec<f64> = x.iter().zip(&root).map(|(x, c)| x * c).collect();
            let rise = rises.of_states(&heat)?;
            Ok(rise.iter().zip(&root).map(|(r, c)| r * c).collect())
        };
        let terms = terms(&lanczos::modes(&start, &mut apply, &enough)?);
        let residual = (terms.iter().map(|term| term.resistance).sum::<f64>() - moved).abs();
        Ok(Some(Self { resistance, direct, terms, residual }))
    }

    /// The rise in K/W at `time` in s; at 0 the immediate rise.
    pub fn value(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return self.direct;
        }
        self.resistance
            - self.terms.iter().map(|t| t.resistance * (-time / t.tau).exp()).sum::<f64>()
    }

    /// The slowest time constant that the port sees: the slowest mode that has at least 1e-9 of
    /// `R_eq`.
    pub fn slowest(&self) -> ResponseTerm {
        let seen = self.terms.iter().find(|term| term.resistance >= VISIBLE * self.resistance);
        seen.or(self.terms.first()).copied().unwrap_or(ResponseTerm {
            tau: f64::NAN,
            resistance: 0.0,
            error: 0.0,
        })
    }

    /// Shortest and longest time constant in s.
    pub(crate) fn span(&self) -> (f64, f64) {
        let taus = self.terms.iter().map(|term| term.tau);
        taus.fold((f64::INFINITY, 0.0), |(least, most), tau| (least.min(tau), most.max(tau)))
    }
}

/// Modes as terms: the weight in the measure of `C^1/2 G^-1 e_p` is `tau r`. Values within rounding
/// of zero are not time constants.
fn terms(modes: &[Mode]) -> Vec<ResponseTerm> {
    let least = 1e-15 * modes.first().map_or(0.0, |mode| mode.value);
    let real = modes.iter().filter(|mode| mode.value > least && mode.weight > 0.0);
    real.map(|m| ResponseTerm { tau: m.value, resistance: m.weight / m.value, error: m.error })
        .collect()
}

/// The known properties of a step response.
struct Known<'a> {
    /// Final rise of every node in K.
    rise: &'a [f64],
    resistance: f64,
    direct: f64,
}

/// The rise of a massless port in K/W while every capacity still has its old temperature.
fn direct(system: &ThermalSystem, norton: &NortonEquivalent) -> f64 {
    let network = system.network();
    if !network.nodes()[norton.port.index()].massless {
        return 0.0;
    }
    let mut heat = vec![0.0; network.nodes().len()];
    heat[norton.port.index()] = 1.0;
    at_once(system, &heat)
}

/// `sum of h_n T_n` in K for these heats in W while every capacity still has its old temperature.
fn at_once(system: &ThermalSystem, heat: &[f64]) -> f64 {
    let mut work = system.workspace();
    system.apply(&mut work, heat, &vec![0.0; system.network().boundaries().len()]);
    system.recover(&mut work, &vec![0.0; system.states().len()]);
    dot(heat, system.node_temperatures(&work))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_terms(terms: &[(f64, f64)]) -> StepResponse {
        let terms = terms
            .iter()
            .map(|&(tau, resistance)| ResponseTerm { tau, resistance, error: 0.0 })
            .collect();
        StepResponse { resistance: 0.5, direct: 0.0, terms, residual: 0.0 }
    }

    #[test]
    fn the_slowest_time_constant_is_one_that_the_port_sees() {
        assert!(
            (of_terms(&[(100.0, 1e-12), (10.0, 0.3), (1.0, 0.2)]).slowest().tau - 10.0).abs()
                < 1e-15
        );
        assert!((of_terms(&[(100.0, 0.5e-9), (10.0, 0.5)]).slowest().tau - 100.0).abs() < 1e-15);
        // no visible one: the slowest of all
        assert!((of_terms(&[(100.0, 1e-12), (10.0, 1e-12)]).slowest().tau - 100.0).abs() < 1e-15);
        assert!(of_terms(&[]).slowest().tau.is_nan());
    }

    #[test]
    fn the_span_is_from_the_shortest_to_the_longest_time_constant() {
        assert_eq!(of_terms(&[(100.0, 0.1), (0.02, 0.2), (3.0, 0.2)]).span(), (0.02, 100.0));
    }

    /// Eigenvalues are not negative and have a weight. Values from rounding that differ are not
    /// time constants.
    #[test]
    fn what_rounding_leaves_is_no_term() {
        let mode = |value, weight| Mode { value, weight, error: 0.25 };
        let modes =
            [mode(4.0, 2.0), mode(3.0, 0.0), mode(1.0, 0.5), mode(3e-15, 1.0), mode(-1e-16, 1.0)];
        let found: Vec<(f64, f64)> =
            terms(&modes).iter().map(|term| (term.tau, term.resistance)).collect();
        assert_eq!(found, [(4.0, 0.5), (1.0, 0.5)]);
    }
}
