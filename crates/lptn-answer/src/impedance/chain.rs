//! An impedance as an R-tau table or a ladder.

use lptn_assembly::ThermalSystem;
use lptn_network::{Cauer, Foster};
use lptn_reduce::{Nodes, NortonEquivalent, ResponseTerm, StepResponse};
use lptn_solve::StepAnswer;

use crate::failure::Failure;
use crate::input::Input;

/// Terms below this share of the largest are rounding.
const VISIBLE: f64 = 1e-9;

/// Most terms that are shown as they are; of more, as few as keep [`LIMIT`].
const SHOWN: usize = 12;

/// The error over every load of the terms that are chosen, as a share of the settled rise.
const LIMIT: f64 = 1e-3;

/// The imaginary part of a rate that is rounding, as a share of its size.
const REAL: f64 = 1e-9;

/// An impedance as elements.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Resistance in K/W and time constant in s of each term, fastest first.
    /// Between two places resistances may be negative.
    pub terms: Vec<(f64, f64)>,
    /// Part of the rise that comes at once, in K/W.
    pub direct: f64,
    /// The ladder, if that was requested.
    pub ladder: Option<Cauer>,
    /// Number of terms of the whole response.
    pub all: usize,
    /// The largest error over every load in K/W, if there are fewer terms.
    pub error: Option<f64>,
}

/// Step response of a place, as far as it is known.
pub(super) struct Spectrum {
    pub(super) step: StepResponse,
    /// True if the place that responds is the heated one.
    own: bool,
}

impl Spectrum {
    /// The response of the modes at a node.
    pub(super) fn of(answer: &StepAnswer, (node, own): (usize, bool)) -> Result<Self, Failure> {
        let terms: Vec<_> = answer.terms(node).collect();
        let size = |(_, weight): &(_, lptn_solve::Complex)| weight.norm();
        let largest = terms.iter().map(size).fold(0.0, f64::max);
        let seen = terms.into_iter().filter(|term| size(term) > VISIBLE * largest);
        let seen: Vec<_> = seen.filter(|(rate, _)| rate.re > 0.0).collect();
        if seen.iter().any(|(rate, _)| rate.im.abs() > REAL * rate.norm()) {
            return Err(swings());
        }
        let term = |(rate, weight): &(lptn_solve::Complex, lptn_solve::Complex)| ResponseTerm {
            tau: rate.re.recip(),
            resistance: weight.re,
            error: 0.0,
        };
        let mut terms: Vec<ResponseTerm> = seen.iter().map(term).collect();
        terms.sort_by(|a, b| b.tau.total_cmp(&a.tau));
        let (resistance, direct) = (answer.settled[node], answer.direct(node));
        Ok(Self { step: StepResponse { resistance, direct, terms, residual: 0.0 }, own })
    }

    /// The response of a large network of constants, by Lanczos iteration.
    pub(super) fn of_large(
        input: &Input,
        system: &ThermalSystem,
        port: lptn_network::NodeId,
    ) -> Result<Self, Failure> {
        let failed = |error: &lptn_reduce::ReduceError| input.failure(error, None);
        let norton = NortonEquivalent::new(system, port).map_err(|error| failed(&error))?;
        let step = StepResponse::new(system, &norton).map_err(|error| failed(&error))?;
        Ok(Self { step: step.ok_or_else(at_once)?, own: true })
    }

    /// An R-tau table of `count` terms, with a ladder if that is wanted.
    pub(super) fn chain(&self, count: Option<usize>, ladder: bool) -> Result<Chain, Failure> {
        if self.step.terms.is_empty() {
            return Err(at_once());
        }
        let all = self.step.terms.len();
        match (self.own, count) {
            (false, _) if ladder => Err(between("a ladder")),
            (false, Some(_)) => Err(between("a chain of fewer terms")),
            (false, None) => Ok(self.between()),
            (true, Some(count)) => self.few(self.nodes(count)?, all, ladder),
            (true, None) if all <= SHOWN => self.few(self.nodes(all)?, all, ladder),
            (true, None) => self.few(self.enough(all)?, all, ladder),
        }
    }

    /// All terms, as they are.
    fn between(&self) -> Chain {
        let terms = self.step.terms.iter().rev().map(|term| (term.resistance, term.tau)).collect();
        let (direct, all) = (self.step.direct, self.step.terms.len());
        Chain { terms, direct, ladder: None, all, error: None }
    }

    fn nodes(&self, count: usize) -> Result<Nodes, Failure> {
        Nodes::of(&self.step, count).ok_or_else(|| too_close(count))
    }

    /// The fewest terms that keep [`LIMIT`].
    fn enough(&self, all: usize) -> Result<Nodes, Failure> {
        let limit = LIMIT * self.step.resistance;
        let (found, _) = Nodes::enough(&self.step, &[], (limit, all));
        found.ok_or_else(|| too_close(all))
    }

    fn few(&self, nodes: Nodes, all: usize, ladder: bool) -> Result<Chain, Failure> {
        let Foster { direct, terms, .. } = nodes.foster;
        let error = (terms.len() < all).then(|| nodes.worst.most());
        Ok(Chain { terms, direct, ladder: ladder.then_some(nodes.ladder), all, error })
    }
}

fn swings() -> Failure {
    Failure::refused(
        "impedance::swings",
        "the response oscillates as it settles, which a chain of resistances and capacities cannot",
        "streams that return cause this: ask for the curve, without --foster and --cauer",
    )
}

fn at_once() -> Failure {
    Failure::refused(
        "impedance::at_once",
        "the port sees no heat capacity: it responds at once, without a time constant",
        "`lptn reduce` gives its resistance",
    )
}

fn between(what: &str) -> Failure {
    Failure::refused(
        "impedance::between",
        format!("{what} is defined only for the node that is heated: leave --to out"),
        "between two places `--foster` without a number lists all terms, of either sign",
    )
}

fn too_close(count: usize) -> Failure {
    Failure::refused(
        "impedance::too_close",
        format!("{count} terms lie too close together to be distinguished"),
        "ask for fewer: --foster 4",
    )
}
