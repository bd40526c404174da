//! The energy ledger of a run: heat in, heat out and stored heat.

use std::borrow::Cow;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Conductor, ConductorKind, InputError, Item, Network, NodeId};

/// Heat exchanged during a run, in J.
///
/// It checks the energy balance, not accuracy: a run at a coarse tolerance closes it as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    /// Heat of each source, positive into the network.
    pub sources: Vec<f64>,
    /// Heat that each boundary gave to the network.
    pub boundaries: Vec<f64>,
    /// Heat that each stream brought to its two ends together, in the order of the conductors.
    pub streams: Vec<f64>,
    /// Heat, over the temperature of the start, that came with the mass of each node of
    /// [`Network::state_capacities`](lptn_network::Network::state_capacities).
    pub masses: Vec<f64>,
    /// Heat that each node stored, with that of its mass: without a mass that changes, the integral
    /// of its capacity over its rise.
    pub stored: Vec<f64>,
    /// Integral of the absolute heat of every source, boundary, stream and mass, plus the absolute heat
    /// stored by each node.
    pub turned_over: f64,
    /// Largest allowed residual over the total heat: the share given for the run, else `1e-8 + 10
    /// tolerance C / turned_over` with the sum C of all capacities in J/K, at the start or at the
    /// end, whichever is larger.
    pub bound: f64,
}

/// The integrator does not control the error of the heat that enters a pipe: it affects no
/// temperature before it leaves. The content of the pipe corrects it, if it is at most this share of
/// the heat exchanged.
const PIPED: f64 = 1e-4;

impl Ledger {
    /// The part of the heat of sources.
    pub const SOURCES: &str = "sources";
    /// The part of the heat of boundaries.
    pub const BOUNDARIES: &str = "boundaries";
    /// The part of the heat of streams.
    pub const STREAMS: &str = "streams";
    /// The part of the heat that came with masses.
    pub const MASSES: &str = "masses";
    /// The part of the heat that nodes stored.
    pub const STORED: &str = "stored";

    /// From a tolerance in K and the growth in J/K of capacities that follow states.
    pub(crate) fn new(
        system: &ThermalSystem,
        integrals: &[f64],
        stored: Vec<f64>,
        (tolerance, grown): (f64, f64),
    ) -> Self {
        let network = system.network();
        let (sources, rest) = integrals.split_at(network.sources().len());
        let (boundaries, rest) = rest.split_at(network.boundaries().len());
        let (streams, rest) = rest.split_at(system.streams().len());
        let (piped, rest) = rest.split_at(network.pipes().len());
        let (masses, turned) = rest.split_at(network.state_capacities().len());
        let turned_over = turned.iter().sum::<f64>() + stored.iter().map(|q| q.abs()).sum::<f64>();
        let capacity: f64 = network.thermal_nodes().map(|id| network.capacity(id)).sum();
        let capacity = capacity + grown;
        let bound = 1e-8 + 10.0 * tolerance * capacity / turned_over;
        let [sources, boundaries, masses, mut streams] =
            [sources, boundaries, masses, streams].map(<[f64]>::to_vec);
        for (pipe, received) in network.pipes().iter().zip(piped) {
            let missed = stored[pipe.node.index()] - received;
            let stream = system.streams().binary_search(&pipe.streams[0]);
            if let (Ok(stream), true) = (stream, missed.abs() <= PIPED * turned_over) {
                streams[stream] += missed;
            }
        }
        Self { sources, boundaries, streams, masses, stored, turned_over, bound }
    }

    /// The same ledger with this share of the total heat as its bound, if there is one.
    pub(crate) fn allowing(self, share: Option<f64>) -> Self {
        Self { bound: share.unwrap_or(self.bound), ..self }
    }

    /// Heat in J that warmed a node: the stored heat less that of its mass.
    pub(crate) fn warmed(&self, network: &Network, node: NodeId) -> f64 {
        let masses = network.state_capacities().iter().zip(&self.masses);
        let mass: f64 = masses.filter(|(of, _)| of.node == node).map(|(_, heat)| heat).sum();
        self.stored[node.index()] - mass
    }

    /// The heats in J, each with its part of the ledger and the name of its giver or taker.
    pub fn heats<'n>(&self, network: &'n Network) -> Vec<(&'static str, Cow<'n, str>, f64)> {
        let named = |item: Item| network.name_of(item);
        let sources = network.heat_sources();
        let sources = sources.map(|id| (named(Item::Source(id)), self.sources[id.index()]));
        let boundaries = network.boundary_ids().zip(&self.boundaries);
        let boundaries = boundaries.map(|(id, heat)| (named(Item::Boundary(id)), *heat));
        let streams = network.conductors().iter().filter(|c| c.kind == ConductorKind::Advection);
        let streams = streams.map(Conductor::name).zip(self.streams.iter().copied());
        let masses = network.state_capacities().iter().map(|of| named(Item::Node(of.node)));
        let masses = masses.zip(self.masses.iter().copied());
        let nodes = network.thermal_nodes();
        let stored = nodes.map(|id| (named(Item::Node(id)), self.stored[id.index()]));
        let of = |part: &'static str| move |(name, heat)| (part, name, heat);
        (sources.map(of(Self::SOURCES)).chain(boundaries.map(of(Self::BOUNDARIES))))
            .chain(streams.map(of(Self::STREAMS)))
            .chain(masses.map(of(Self::MASSES)))
            .chain(stored.map(of(Self::STORED)))
            .collect()
    }

    /// Sources plus boundaries plus streams plus masses less stored heat, in J: zero but for rounding and the
    /// residual of Newton's method.
    pub fn residual(&self) -> f64 {
        let sum = |q: &[f64]| q.iter().sum::<f64>();
        let given = sum(&self.sources) + sum(&self.boundaries) + sum(&self.streams);
        given + sum(&self.masses) - sum(&self.stored)
    }

    /// The residual over the total heat; `None` if no heat was exchanged.
    pub fn relative_residual(&self) -> Option<f64> {
        (self.turned_over > 0.0).then(|| self.residual() / self.turned_over)
    }

    /// True if the energy balance closes within its bound.
    pub fn closes(&self) -> bool {
        self.check().is_ok()
    }

    /// Checks that the energy balance closes within its bound.
    ///
    /// # Errors
    /// [`LedgerError`]
    pub fn check(&self) -> Result<(), LedgerError> {
        let Some(residual) = self.relative_residual().map(f64::abs) else { return Ok(()) };
        match residual <= self.bound {
            true => Ok(()),
            false => Err(LedgerError::Open { residual, bound: self.bound }),
        }
    }
}

lptn_units::errors! {
/// Reason why the numbers of a run must not be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LedgerError {
    /// Its energy balance does not close: the residual over the total heat, and its bound.
    Open { residual: f64, bound: f64 } = "run::ledger",
        format!(
            "heat in, out and stored differ by {residual:.1e} of the heat exchanged, more than the \
             {bound:.1e} allowed"
        ),
        help "do not use the result: `balance_error` of [run] is below the rounding error, the \
              numbers of the network are extreme, or lptn has a bug",
        class lptn_units::Class::Numbers;
}
}

/// Number of running integrals a run of `system` needs.
pub(crate) fn integrals(system: &ThermalSystem) -> usize {
    let network = system.network();
    let ends = network.sources().len() + network.boundaries().len();
    let inside = network.pipes().len() + network.state_capacities().len();
    ends + system.streams().len() + inside + 1
}

/// The integrands at the inputs of `work` and the temperatures `y` of the unknowns: sources,
/// boundaries, streams, pipes, masses, sum of absolute values, in W.
pub(crate) fn integrands(
    system: &ThermalSystem,
    work: &mut Workspace,
    y: &[f64],
    q: &mut [f64],
) -> Result<(), InputError> {
    let (sources, rest) = q.split_at_mut(system.network().sources().len());
    let (boundaries, rest) = rest.split_at_mut(system.network().boundaries().len());
    let (streams, rest) = rest.split_at_mut(system.streams().len());
    let (piped, rest) = rest.split_at_mut(system.network().pipes().len());
    let (masses, turned) = rest.split_at_mut(system.network().state_capacities().len());
    system.boundary_heat(work, y, boundaries)?;
    system.stream_heat(work, streams)?;
    for (heat, pipe) in piped.iter_mut().zip(system.network().pipes()) {
        let [into, out] = pipe.streams;
        *heat = system.received(work, into)?[1] + system.received(work, out)?[0];
    }
    system.mass_heat(work, y, masses)?;
    sources.copy_from_slice(system.source_powers(work));
    system.network().without_states(sources);
    turned[0] =
        [&*sources, boundaries, streams, masses].into_iter().flatten().map(|q| q.abs()).sum();
    Ok(())
}
