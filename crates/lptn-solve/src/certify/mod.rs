//! A proven bound on the error of every temperature of a run.
//!
//! In addition to the integrator's solution there is a second one, the way: polynomials that obey the
//! balances much better. Put into the network they leave a defect, the heat that is missing at each
//! node, and its largest value over a step is bounded. Thermal networks are cooperative: a warmer
//! neighbour warms. So the defect bounds the error of the way node by node (`bound.rs`), also if
//! laws depend on temperature; a slope of the wrong sign counts with its absolute value, which only
//! widens the bound. The distance of the integrator's solution from the way is known. The bound of
//! a massless node is the mean of those around it.
//!
//! For the one-step method the way is that method with a smaller tolerance, whose defect follows
//! from its series (`series.rs`). For others it is found by collocation over some of their steps
//! (`pieces.rs`), and the defect from its samples and the form of the laws (`defect.rs`).
//!
//! A control switches inside a proven interval of time, through which the bound is carried
//! (`pieces/window.rs`).
//!
//! Nothing is taken from the integrator but numbers, and each bound is checked after it is found.
//! Covered are networks without comparisons of temperatures, pipes, heat contents over
//! temperature, capacities that follow states, and balances of massless nodes; [`Uncertified`] names the others. Rounding is
//! not directed: margins of some rounding errors of each sum are added.

mod along;
mod apart;
mod bound;
mod collocation;
mod course;
mod defect;
mod gates;
mod laguerre;
mod margins;
mod memory;
mod of_solution;
mod pieces;
mod polynomial;
pub(crate) mod results;
pub(crate) mod rows;
mod series;
mod shifted;
mod steady;
mod straight;
mod way;

use lptn_assembly::ThermalSystem;
use lptn_integrate::{Integrator, OdeSystem};
use lptn_network::{Item, Network, NodeId};

use crate::events::ControlState;
use crate::method::Method;
use crate::times::Segment;
pub(crate) use memory::shrinking;
pub(crate) use of_solution::farthest;
use pieces::Pieces;
use results::{ResultBounds, Results};
use rows::Rows;
use series::SeriesCertifier;

/// Rounding errors of a sum of heats, as a share of the sum of their absolute values.
pub(crate) const ROUNDING: f64 = 64.0 * f64::EPSILON;

lptn_units::errors! {
/// Reason why a run has no proven bounds.
#[derive(Clone, Debug, PartialEq)]
pub enum Uncertified {
    /// Something switches that is not covered; its name and the reason.
    Switches { name: String, because: &'static str } = "certify::switches",
        format!("`{name}` {because}: the time of its switches has no proven bound"),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// The interval of a switch is not proven; its control, the time in s and the reason.
    SwitchTime { name: String, time: f64, because: &'static str } = "certify::switch_time",
        format!(
            "the switch of `{name}` near {} s has no proven time: {because}",
            lptn_units::format_six(*time)
        ),
        help "choose a smaller tolerance, `--tolerance`, or run without --certify",
        class lptn_units::Class::Numbers;
    /// A kind of node that is not covered: its name.
    Node { name: String, because: String } = "certify::node",
        format!("`{name}` {because}: its error has no proven bound"),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// The law of an element has no bounds, as between two regimes or near a division by zero; its
    /// name and the time in s.
    Law { name: String, time: f64 } = "certify::law",
        format!(
            "the heat of `{name}` has no bounds at {} s: its law decides by a value there, or has \
             none nearby",
            lptn_units::format_six(*time)
        ),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// The bound grows without limit from this time in s on.
    Lost { time: f64 } = "certify::lost",
        format!("no bound on the errors was found from {} s on", lptn_units::format_six(*time)),
        help "choose a smaller tolerance, `--tolerance`, or run without --certify",
        class lptn_units::Class::Numbers;
    /// A cycle does not bring differences of its start together: the node that keeps the largest
    /// share of its difference, and that share.
    Cycle { name: String, share: f64 } = "certify::cycle",
        format!(
            "by its bounds a cycle leaves {} % of a difference at `{name}`, and only a smaller \
             share than 100 % proves a periodic steady state",
            lptn_units::format_six(100.0 * *share)
        ),
        help "choose a smaller tolerance, `--tolerance`, or search without --certify",
        class lptn_units::Class::Numbers;
}
}

impl Uncertified {
    /// The reason for a network in which nothing stores heat.
    pub(crate) fn without_state(system: &ThermalSystem) -> Self {
        let first = system.network().nodes().first();
        let name = first.map_or_else(String::new, |node| node.name.clone());
        Self::Node { name, because: "stores no heat".to_owned() }
    }
}

/// Proven bounds on the errors of the temperatures of a run.
#[derive(Clone, Debug, Default)]
pub struct Certificate {
    /// Row by row, one bound in K for each recorded node.
    pub(crate) rows: Vec<f64>,
    /// For each recorded node a bound in K over the whole run, rows or not.
    pub(crate) most: Vec<f64>,
    /// Bounds on the results that follow from temperatures.
    pub(crate) results: ResultBounds,
    /// For each switch of a control the times in s between which the exact solution switches.
    pub(crate) switches: Vec<[f64; 2]>,
    /// The way at the end of the run in K, and its bounds, of each unknown.
    pub(crate) end: [Vec<f64>; 2],
}

/// Follows a run and bounds its errors.
pub(crate) enum Certifier<'a> {
    Series(Box<SeriesCertifier<'a>>),
    Pieces(Box<Pieces<'a>>),
}

impl<'a> Certifier<'a> {
    /// A certifier from a start on whose temperatures, in K, are exact.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        method: Method,
        (rows, results): (Rows<'a>, Option<Results<'a>>),
        (start, tolerance): (&[f64], f64),
    ) -> Result<Self, Uncertified> {
        is_covered(system)?;
        let from = (rows.time(0), tolerance);
        let begin = (rows, results, start);
        let switches = system.network().has_events();
        Ok(match method {
            Method::OneStep if switches => return Err(of_one_step(system)),
            Method::OneStep => Self::Series(Box::new(SeriesCertifier::new(system, begin, from)?)),
            _ => Self::Pieces(Box::new(Pieces::new(system, begin, from)?)),
        })
    }

    /// Begins with bounds in K on the distance of the exact solution from the start.
    pub(crate) fn begin_within(&mut self, bounds: &[f64]) {
        match self {
            Self::Series(certifier) => certifier.begin_within(bounds),
            Self::Pieces(certifier) => certifier.begin_within(bounds),
        }
    }

    /// Takes a part of the last step of an integrator, with these states of the controls.
    pub(crate) fn step<S: OdeSystem>(
        &mut self,
        part: (f64, f64),
        (segment, controls): (Segment, &[ControlState]),
        integrator: &mut (dyn Integrator<S> + '_),
    ) -> Result<(), Uncertified> {
        match self {
            Self::Series(certifier) => match integrator.series() {
                Some(series) => certifier.step(&series, segment),
                None => Err(Uncertified::Lost { time: part.0 }),
            },
            Self::Pieces(certifier) => {
                let state_at = &mut |time: f64, y: &mut [f64]| integrator.interpolate(time, y);
                certifier.step((part, segment.inside()), controls, state_at)
            }
        }
    }

    /// The bounds at the end of the run.
    pub(crate) fn finish(self) -> Result<Certificate, Uncertified> {
        match self {
            Self::Series(certifier) => certifier.finish(),
            Self::Pieces(certifier) => certifier.finish(),
        }
    }
}

/// Refuses states that change at their samples.
fn no_samples(network: &Network) -> Result<(), Uncertified> {
    network
        .first_sampled()
        .map_or(Ok(()), |name| Err(Uncertified::Node { name, because: "is sampled".to_owned() }))
}

/// The reason if controls switch during the one-step method, whose series have no pieces.
fn of_one_step(system: &ThermalSystem) -> Uncertified {
    let network = system.network();
    let control = network.control_ids().next().map(Item::Control);
    let name = control.map_or_else(String::new, |item| network.name_of(item).into_owned());
    Uncertified::Switches { name, because: "switches during the one-step method" }
}

/// Refuses the parts of a network that have no bounds.
pub(crate) fn is_covered(system: &ThermalSystem) -> Result<(), Uncertified> {
    let network = system.network();
    let name = |id: NodeId| network.nodes()[id.index()].name.clone();
    if let Some(id) = network.switch_ids().next() {
        let (item, _) = network.place_of_switch(id);
        let name = network.name_of(item).into_owned();
        return Err(Uncertified::Switches { name, because: "compares temperatures" });
    }
    let node = |id: NodeId, because: &str| {
        Err(Uncertified::Node { name: name(id), because: because.to_owned() })
    };
    no_samples(network)?;
    if let Some(pipe) = network.pipes().first() {
        return node(pipe.node, "is a pipe, whose fluid entered earlier");
    }
    if let Some(id) = network.first_varying_capacity() {
        return node(id, "has a capacity that changes");
    }
    if let Some(id) = network.state_capacities().first().map(|of| of.node) {
        return node(id, "has a capacity that follows a state");
    }
    match system.algebraic().first() {
        Some(id) => node(*id, "has no capacity, and a stream or a heat that is not linear in it"),
        None => Ok(()),
    }
}

#[cfg(test)]
mod at_rest;
