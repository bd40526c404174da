//! A network reduced to one node, with all results.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, NodeId};
use lptn_solve::EventKind;

use crate::allowed::Allowed;
use crate::capacity::least_squares;
use crate::definition::{Definition, Judge, Pair, Recommended, recommended};
use crate::deviation::{self, Dense, Deviation, Record};
use crate::error::ReduceError;
use crate::nodes::Nodes;
use crate::norton::{Inputs, NortonEquivalent, grounded};
use crate::one_node::{OneNode, Row};
use crate::rises::Rises;
use crate::step::StepResponse;

/// The largest tolerance in K of the runs that are compared: they use a hundredth of the run's
/// tolerance if that is smaller. Their errors are right to about ten times the tolerance.
pub const TOLERANCE: f64 = 1e-7;

/// The options of a reduction.
#[derive(Clone, Debug, Default)]
pub struct ReductionOptions {
    /// The run to compare over; `None` leaves the second error out.
    pub run: Option<RunAnalysis>,
    /// Length in s of the window of [`Definition::LeastSquares`], from the step on.
    pub window: Option<f64>,
    /// The criterion for the recommended pair.
    pub judge: Judge,
    /// The largest acceptable error, which determines from when on a pair is good.
    pub allowed: Allowed,
}

/// The window of the least-squares definition, which begins with the step. Lengths in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LeastSquaresWindow {
    /// The requested length.
    Given(f64),
    /// The length of the run, by which the pairs are judged.
    Run(f64),
    /// Five of the slowest time constants.
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
    /// The dynamics, if the port sees a capacity.
    pub dynamics: Option<Dynamics>,
}

/// The results that depend on capacities.
#[derive(Clone, Debug)]
pub struct Dynamics {
    /// The step response of the port; `None` if streams go on from node to node.
    pub step: Option<StepResponse>,
    /// The window of the least-squares definition, if there is one.
    pub window: Option<LeastSquaresWindow>,
    /// One pair per definition, in the order of [`Definition::ALL`]; if streams go on from node to
    /// node only the sum and the first moment.
    pub pairs: Vec<Pair>,
    /// The pair to use.
    pub recommended: Recommended,
    /// Tolerance in K of the runs compared; `None` without a run.
    pub tolerance: Option<f64>,
    /// The port's largest change from its start over the run, in K.
    pub rise: Option<f64>,
    /// The largest acceptable error.
    pub allowed: Allowed,
}

impl Dynamics {
    /// The pair of a definition, if there is one.
    pub fn pair(&self, definition: Definition) -> Option<&Pair> {
        self.pairs.iter().find(|pair| pair.definition == definition)
    }

    /// The error that decides if a pair may represent the network: that of the run if the port
    /// rises in it, else that of a step. `None` if there is neither.
    pub fn judged(&self, pair: &Pair) -> Option<(Judge, Deviation)> {
        let run = pair.run.filter(|run| run.relative.is_some()).map(|run| (Judge::Run, run));
        run.or(pair.step.map(|step| (Judge::Step, step)))
    }

    /// True if that error is acceptable. `None` for a step with a limit in K: a step has no size of
    /// its own.
    pub fn collapses(&self, pair: &Pair) -> Option<bool> {
        match (self.judged(pair)?, self.allowed) {
            ((Judge::Step, _), Allowed::Kelvin(_)) => None,
            ((_, error), allowed) => Some(error.within(allowed)),
        }
    }

    /// Its recommended pair.
    pub fn best(&self) -> &Pair {
        self.pair(self.recommended.definition).unwrap_or(&self.pairs[0])
    }
}

impl Reduction {
    /// Reduces `system` at `port` and computes the errors of the result.
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
        let start = options.run.as_ref().map_or(0.0, |run| run.start());
        let inputs = norton.inputs(system, start).map_err(ReduceError::Input)?;
        let initial = initial(system, port, start)?;
        let step = if rises.is_symmetric() {
            StepResponse::with(system, &norton, &mut rises)?
        } else {
            None
        };
        let mut reduction = Self { norton, inputs, initial, dynamics: None };
        if reduction.norton.capacity_sum(system.network()) > 0.0 {
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
        let row = Row::one(self.norton.resistance, pair.map_or(0.0, |pair| pair.capacity));
        self.one_node(system, start).network(&row)
    }

    /// The network of a few nodes, started as the whole one is at its port; that node has the name
    /// of the port.
    ///
    /// # Errors
    /// As [`Reduction::network`].
    pub fn network_of(
        &self,
        system: &ThermalSystem,
        start: f64,
        nodes: &Nodes,
    ) -> Result<Network, ReduceError> {
        still(system.network())?;
        self.one_node(system, start).network(&Row::from(&nodes.ladder))
    }

    /// The error of a few nodes: that of the run, if there is one in which the port rises, else
    /// that of a step. `None` if streams go on from node to node.
    ///
    /// # Errors
    /// [`ReduceError::Run`], and as [`Reduction::network`].
    pub fn judged(
        &self,
        system: &ThermalSystem,
        nodes: &Nodes,
        (run, allowed): (Option<&RunAnalysis>, Allowed),
    ) -> Result<Option<(Judge, Deviation)>, ReduceError> {
        let whole = run.map(|run| Whole::new(self, system, run)).transpose()?;
        self.error_of(whole.as_ref(), nodes, allowed)
    }

    /// The smallest number of nodes, from two to eight, whose error is acceptable; `None` if there
    /// is none, for example if the heat goes in elsewhere.
    ///
    /// # Errors
    /// As [`Reduction::judged`].
    pub fn fewest(
        &self,
        system: &ThermalSystem,
        (run, allowed): (Option<&RunAnalysis>, Allowed),
    ) -> Result<Option<(Nodes, Judge, Deviation)>, ReduceError> {
        const MOST: usize = 8;
        /// One more node has to reduce the error to this share, else more will not help.
        const LESS: f64 = 0.9;
        let Some(step) = self.dynamics.as_ref().and_then(|dynamics| dynamics.step.as_ref()) else {
            return Ok(None);
        };
        let whole = run.map(|run| Whole::new(self, system, run)).transpose()?;
        let mut before = f64::INFINITY;
        for nodes in (2..=MOST).filter_map(|count| Nodes::of(step, count)) {
            let Some((judge, error)) = self.error_of(whole.as_ref(), &nodes, allowed)? else {
                return Ok(None);
            };
            if error.within(allowed) {
                return Ok(Some((nodes, judge, error)));
            }
            if error.kelvin > LESS * before {
                return Ok(None);
            }
            before = error.kelvin;
        }
        Ok(None)
    }

    fn error_of(
        &self,
        whole: Option<&Whole<'_>>,
        nodes: &Nodes,
        allowed: Allowed,
    ) -> Result<Option<(Judge, Deviation)>, ReduceError> {
        if let Some(whole) = whole {
            let error = whole.deviation(&Row::from(&nodes.ladder), allowed)?;
            if error.relative.is_some() {
                return Ok(Some((Judge::Run, error)));
            }
        }
        let step = self.dynamics.as_ref().and_then(|dynamics| dynamics.step.as_ref());
        let taus = nodes.foster.terms.iter().map(|term| term.1);
        let span = taus.fold((f64::INFINITY, 0.0), |(a, b), tau| (tau.min(a), tau.max(b)));
        let rise = |time: f64| nodes.foster.step(time);
        let of_step = |step| deviation::of_curve(step, &rise, Some(span), allowed.share());
        Ok(step.map(|step| (Judge::Step, of_step(step))))
    }

    fn one_node<'a>(&'a self, system: &'a ThermalSystem, start: f64) -> OneNode<'a> {
        OneNode { system, norton: &self.norton, initial: self.initial, start }
    }

    fn dynamics(
        &self,
        system: &ThermalSystem,
        step: Option<StepResponse>,
        options: &ReductionOptions,
    ) -> Result<Dynamics, ReduceError> {
        let window = step.as_ref().map(|step| window(step, options));
        let capacities = self.capacities(system.network(), step.as_ref().zip(window));
        // in a window far from every time constant rounding hides the change of the port
        if let Some((window, (_, capacity))) = window.zip(capacities.last())
            && !capacity.is_finite()
        {
            return Err(ReduceError::Window(window.length()));
        }
        let run = options.run.as_ref().map(|run| self.compare(system, run, &capacities, options));
        let run = run.transpose()?;
        let share = options.allowed.share();
        let pair = |(k, &(definition, capacity)): (usize, &(Definition, f64))| Pair {
            definition,
            capacity,
            step: step.as_ref().map(|step| deviation::of_step(step, capacity, share)),
            run: run.as_ref().map(|run| run.deviations[k]),
        };
        let pairs: Vec<Pair> = capacities.iter().enumerate().map(pair).collect();
        let tolerance = run.as_ref().map(|run| run.tolerance);
        let noise = (10.0 * tolerance.unwrap_or(0.0), 1e-9 * self.norton.resistance);
        let recommended = recommended(&pairs, options.judge, noise);
        let rise = run.map(|run| run.rise);
        let allowed = options.allowed;
        Ok(Dynamics { step, window, pairs, recommended, tolerance, rise, allowed })
    }

    /// The capacity of every available definition, in J/K.
    fn capacities(
        &self,
        network: &Network,
        step: Option<(&StepResponse, LeastSquaresWindow)>,
    ) -> Vec<(Definition, f64)> {
        let r = self.norton.resistance;
        let mut all = vec![
            (Definition::Sum, self.norton.capacity_sum(network)),
            (Definition::FirstMoment, self.norton.first_moment(network) / (r * r)),
        ];
        if let Some((step, window)) = step {
            all.push((Definition::DominantPole, step.slowest().tau / r));
            all.push((Definition::LeastSquares, least_squares(step, window.length())));
        }
        all
    }

    fn compare(
        &self,
        system: &ThermalSystem,
        run: &RunAnalysis,
        capacities: &[(Definition, f64)],
        options: &ReductionOptions,
    ) -> Result<Comparison, ReduceError> {
        let whole = Whole::new(self, system, run)?;
        let resistance = self.norton.resistance;
        let deviation = |&(_, capacity): &(Definition, f64)| {
            whole.deviation(&Row::one(resistance, capacity), options.allowed)
        };
        let deviations = capacities.iter().map(deviation).collect::<Result<_, _>>()?;
        Ok(Comparison { deviations, tolerance: whole.tolerance, rise: whole.record.rise() })
    }
}

/// The whole network's run, for the comparison with reduced ones.
struct Whole<'a> {
    one_node: OneNode<'a>,
    run: Dense,
    record: Record,
    tolerance: f64,
}

impl<'a> Whole<'a> {
    fn new(
        reduction: &'a Reduction,
        system: &'a ThermalSystem,
        run: &RunAnalysis,
    ) -> Result<Self, ReduceError> {
        let tolerance = TOLERANCE.min(0.01 * run.tolerance());
        let mut one_node = reduction.one_node(system, run.start());
        let run = Dense::new(system, run, tolerance)?;
        let record = Record::of(system, reduction.norton.port, &run)?;
        one_node.initial = record.first().unwrap_or(one_node.initial);
        Ok(Self { one_node, run, record, tolerance })
    }

    fn deviation(&self, row: &Row, allowed: Allowed) -> Result<Deviation, ReduceError> {
        let network = self.one_node.network(row)?;
        let port = network.node_ids().next().unwrap_or(self.one_node.norton.port); // the first
        let reduced = ThermalSystem::assemble(&network)
            .map_err(|error| ReduceError::Equivalent(error.to_string()))?;
        Ok(self.record.deviation(&Record::of(&reduced, port, &self.run)?, allowed))
    }
}

/// The window of the least-squares definition: it follows the run only if the run judges.
pub(crate) fn window(step: &StepResponse, options: &ReductionOptions) -> LeastSquaresWindow {
    match (options.window, &options.run, options.judge) {
        (Some(length), _, _) => LeastSquaresWindow::Given(length),
        (None, Some(run), Judge::Run) => LeastSquaresWindow::Run(run.stop() - run.start()),
        _ => LeastSquaresWindow::TimeConstants(5.0 * step.slowest().tau),
    }
}

/// Nothing may switch by itself in a network that one node has to follow over time.
pub(crate) fn still(network: &Network) -> Result<(), ReduceError> {
    match EventKind::switching(network).next() {
        Some(kind) => Err(ReduceError::Switches { name: kind.name(network) }),
        None => Ok(()),
    }
}

/// The results of the runs of the four pairs.
struct Comparison {
    deviations: Vec<Deviation>,
    tolerance: f64,
    rise: f64,
}

/// Temperature of a node at the start, a massless one with the inputs on.
pub(crate) fn initial(
    system: &ThermalSystem,
    node: NodeId,
    start: f64,
) -> Result<f64, ReduceError> {
    let stop = start + 1.0;
    let segments = system.network().breakpoints(start, stop).map_err(ReduceError::Input)?;
    let inside = 0.5 * (start + segments.first().copied().unwrap_or(stop));
    let mut work = system.workspace();
    system.read_inputs(&mut work, start, inside).map_err(ReduceError::Input)?;
    system.recover(&mut work, &system.initial());
    Ok(system.node_temperatures(&work)[node.index()])
}
