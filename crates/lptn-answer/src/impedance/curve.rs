//! The response of one node to a step, from all modes or from a port.

use lptn_reduce::StepResponse;
use lptn_solve::StepAnswer;

use super::chain::Spectrum;

/// The response of one node.
pub(super) enum Curve<'a> {
    /// From all modes; the index of the node.
    Modes(&'a StepAnswer, usize),
    /// From the modes that a port sees.
    Port(&'a StepResponse),
}

impl<'a> From<&'a Spectrum> for Curve<'a> {
    fn from(spectrum: &'a Spectrum) -> Self {
        Self::Port(&spectrum.step)
    }
}

impl Curve<'_> {
    pub(super) fn settled(&self) -> f64 {
        match self {
            Self::Modes(answer, node) => answer.settled[*node],
            Self::Port(step) => step.resistance,
        }
    }

    pub(super) fn value(&self, time: f64) -> f64 {
        match self {
            Self::Modes(answer, node) => answer.value(*node, time),
            Self::Port(step) => {
                let parts =
                    step.terms.iter().map(|term| -term.resistance * (-time / term.tau).exp_m1());
                step.direct + parts.sum::<f64>()
            }
        }
    }

    /// See [`StepAnswer::pulse`].
    pub(super) fn pulse(&self, length: f64, share: f64) -> f64 {
        match self {
            Self::Modes(answer, node) => answer.pulse(*node, length, share),
            Self::Port(step) => {
                let left = |tau: f64| (-length / tau).exp_m1() / (-length / tau / share).exp_m1();
                let parts = step.terms.iter().map(|term| term.resistance * left(term.tau));
                step.direct + parts.sum::<f64>()
            }
        }
    }

    /// The shortest and the longest time constant in s that it shows.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        match self {
            Self::Modes(answer, node) => answer.span(*node),
            Self::Port(step) => {
                let seen =
                    step.terms.iter().filter(|term| term.resistance > 1e-6 * step.resistance);
                let taus = seen.map(|term| term.tau);
                let span =
                    taus.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), t| (a.min(t), b.max(t)));
                (span.1 > 0.0).then_some(span)
            }
        }
    }
}
