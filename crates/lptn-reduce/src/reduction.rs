//! A network reduced to one node: everything there is to say about it.

use lptn_assembly::ThermalSystem;
use lptn_network::{Network, NodeId};
use lptn_solve::{EventKind, Transient, TransientError};

use crate::capacity::least_squares;
use crate::definition::{Definition, Pair, Recommended, recommended};
use crate::deviation::{self, Dense, Deviation, Record};
use crate::error::ReduceError;
use crate::norton::{Inputs, NortonEquivalent, grounded};
use crate::one_node::OneNode;
use crate::rises::Rises;
use crate::step::StepResponse;

/// The largest tolerance in K of the runs that are compared; a run with a tighter one keeps a
/// hundredth of that. The errors they give are right to about ten times as much.
pub const TOLERANCE: f64 = 1e-7;

/// What a reduction needs to know besides the network.
#[derive(Clone, Debug, Default)]
pub struct ReductionOptions {
    /// The run to compare over; `None` leaves the second error out.
    pub run: Option<Transient>,
    /// Length in s of the window of [`Definition::LeastSquares`], from the step on; else that of
    /// the run.
    pub window: Option<f64>,
}

/// The window of the least-squares definition, which begins with the step. Lengths in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LeastSquaresWindow {
    /// As it was asked for.
    Given(f64),
    /// As long as the run.
    Run(f64),
    /// Five of the slowest time constants: there is no run.
    TimeConstants(f64),
}

impl LeastSquaresWindow {
    /// Its length in s.
    pub fn length(self) -> f64 {
        let (Self::Given(length) | Self::Run(length) | Self::TimeConstants(length)) = self;
        length
    }
}

/// A network as one node.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// The exact part: resistance and weights.
    pub norton: NortonEquivalent,
    /// Inputs at the start of the run, or at 0 s.
    pub inputs: Inputs,
    /// Temperature of the port at the start in K.
    pub initial: f64,
    /// Where the port sees a capacity: its dynamics.
    pub dynamics: Option<Dynamics>,
}

/// What depends on capacities.
#[derive(Clone, Debug)]
pub struct Dynamics {
    /// The step response of the port.
    pub step: StepResponse,
    /// The window of the least-squares definition.
    pub window: LeastSquaresWindow,
    /// One pair a definition, in the order of [`Definition::ALL`].
    pub pairs: [Pair; 4],
    /// The pair to use.
    pub recommended: Recommended,
    /// Tolerance in K of the runs compared; `None` without a run.
    pub tolerance: Option<f64>,
    /// The port's largest change from its start over the run, in K.
    pub rise: Option<f64>,
}

impl Dynamics {
    /// The pair of a definition.
    pub fn pair(&self, definition: Definition) -> &Pair {
        self.pairs.iter().find(|pair| pair.definition == definition).unwrap_or(&self.pairs[0])
    }
}

impl Reduction {
    /// Reduces `system` at `port` and measures what the result is worth.
    ///
    /// # Errors
    /// [`ReduceError`], in particular for a port without a path to a boundary, and for a run of a
    /// network that switches; without a run its inputs are those of [`Network::initial_positions`].
    pub fn new(
        system: &ThermalSystem,
        port: NodeId,
        options: &ReductionOptions,
    ) -> Result<Self, ReduceError> {
        if let Some(window) = options.window.filter(|w| !(w.is_finite() && *w > 0.0)) {
            return Err(ReduceError::Window(window));
        }
        if options.run.is_some() {
            still(system.network())?;
        }
        grounded(system.network(), port)?;
        let mut rises = Rises::new(system)?;
        let norton = NortonEquivalent::with(system, port, &mut rises)?;
        let start = options.run.as_ref().map_or(0.0, |run| run.start);
        let inputs = norton.inputs(system, start).map_err(ReduceError::Input)?;
        let initial = initial(system, port, start)?;
        let step = StepResponse::with(system, &norton, &mut rises)?;
        let mut reduction = Self { norton, inputs, initial, dynamics: None };
        if let Some(step) = step {
            reduction.dynamics = Some(reduction.dynamics(system, step, options)?);
        }
        Ok(reduction)
    }

    /// The one-node network with the capacity of `pair` (a massless one without, or with a capacity
    /// of 0), started as the whole one is; its node has the name of the port.
    ///
    /// # Errors
    /// [`ReduceError::Equivalent`] if an input cannot be expressed in it,
    /// [`ReduceError::Switches`].
    pub fn network(
        &self,
        system: &ThermalSystem,
        start: f64,
        pair: Option<&Pair>,
    ) -> Result<Network, ReduceError> {
        still(system.network())?;
        let capacity = pair.map(|pair| pair.capacity).filter(|capacity| *capacity > 0.0);
        self.one_node(system, start).network(capacity)
    }

    fn one_node<'a>(&'a self, system: &'a ThermalSystem, start: f64) -> OneNode<'a> {
        OneNode { system, norton: &self.norton, initial: self.initial, start }
    }

    fn dynamics(
        &self,
        system: &ThermalSystem,
        step: StepResponse,
        options: &ReductionOptions,
    ) -> Result<Dynamics, ReduceError> {
        let slowest = step.slowest().tau;
        let window = match (options.window, &options.run) {
            (Some(length), _) => LeastSquaresWindow::Given(length),
            (None, Some(run)) => LeastSquaresWindow::Run(run.stop - run.start),
            (None, None) => LeastSquaresWindow::TimeConstants(5.0 * slowest),
        };
        let (network, r) = (system.network(), self.norton.resistance);
        let capacities = Definition::ALL.map(|definition| match definition {
            Definition::Sum => self.norton.capacity_sum(network),
            Definition::FirstMoment => self.norton.first_moment(network) / (r * r),
            Definition::DominantPole => slowest / r,
            Definition::LeastSquares => least_squares(&step, window.length()),
        });
        // in a window far from every time constant the change of the port is lost in rounding
        if !capacities[3].is_finite() {
            return Err(ReduceError::Window(window.length()));
        }
        let run =
            options.run.as_ref().map(|run| self.compare(system, run, capacities)).transpose()?;
        let mut k = 0;
        let pairs = Definition::ALL.map(|definition| {
            let (capacity, run) = (capacities[k], run.as_ref().map(|run| run.deviations[k]));
            k += 1;
            Pair { definition, capacity, step: deviation::of_step(&step, capacity), run }
        });
        let tolerance = run.as_ref().map(|run| run.tolerance);
        let recommended = recommended(&pairs, (10.0 * tolerance.unwrap_or(0.0), 1e-9 * r));
        let rise = run.map(|run| run.rise);
        Ok(Dynamics { step, window, pairs, recommended, tolerance, rise })
    }

    fn compare(
        &self,
        system: &ThermalSystem,
        run: &Transient,
        capacities: [f64; 4],
    ) -> Result<Comparison, ReduceError> {
        let tolerance = TOLERANCE.min(0.01 * run.tolerance);
        let one_node = self.one_node(system, run.start);
        let mut deviations = [Deviation { kelvin: 0.0, relative: None, time: run.start }; 4];
        let run = Dense::new(system, run, tolerance)?;
        let whole = Record::of(system, self.norton.port, &run)?;
        for (capacity, deviation) in capacities.into_iter().zip(&mut deviations) {
            let network = one_node.network(Some(capacity).filter(|capacity| *capacity > 0.0))?;
            let port = network.node_ids().next().unwrap_or(self.norton.port); // its only node
            let reduced = ThermalSystem::assemble(&network)
                .map_err(|error| ReduceError::Equivalent(error.to_string()))?;
            *deviation = whole.deviation(&Record::of(&reduced, port, &run)?);
        }
        Ok(Comparison { deviations, tolerance, rise: whole.rise() })
    }
}

/// Nothing may switch by itself in a network that one node is to follow over time.
fn still(network: &Network) -> Result<(), ReduceError> {
    match EventKind::switching(network).next() {
        Some(kind) => Err(ReduceError::Switches { name: kind.name(network) }),
        None => Ok(()),
    }
}

/// What the runs of the four pairs gave.
struct Comparison {
    deviations: [Deviation; 4],
    tolerance: f64,
    rise: f64,
}

/// Temperature of a node at the start, a massless one with the inputs on.
fn initial(system: &ThermalSystem, node: NodeId, start: f64) -> Result<f64, ReduceError> {
    let stop = start + 1.0;
    let segments = system.network().breakpoints(start, stop).map_err(TransientError::Input)?;
    let inside = 0.5 * (start + segments.first().copied().unwrap_or(stop));
    let mut work = system.workspace();
    system.read_inputs(&mut work, start, inside).map_err(ReduceError::Input)?;
    system.recover(&mut work, &system.initial());
    Ok(system.node_temperatures(&work)[node.index()])
}
