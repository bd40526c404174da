//! A system at one time and state of a run that has ended.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::Pattern;
use lptn_network::{NodeId, ParameterId, Positions, Tangents};

use super::error::BackwardError;
use super::transposed::Transposed;
use crate::events::EventKind;
use crate::margin::{BentMargin, KELVIN};
use crate::sensitive_run::step;
use crate::stencil::slope;
use crate::trajectory::Turn;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;

/// A system at a moment, its Jacobian there, and the derivatives of its heats by parameters.
pub(super) struct Moment<'a> {
    pub(super) system: &'a ThermalSystem,
    pub(super) work: Workspace,
    unfold: Unfold<'a>,
    tangents: Tangents,
    /// True if the tangents keep the heats of this moment.
    kept: bool,
    jacobian: Vec<f64>,
    pub(super) turned: Transposed,
    /// Time in s, one inside the segment, and the variables of the states.
    at: (f64, f64),
    state: Vec<f64>,
    /// Without heat and with boundaries at 0 K, for constant conductances between states alone.
    still: Option<Workspace>,
    /// For the response to heat that no source puts in.
    response: Workspace,
    /// Weights of the temperatures of all nodes of which `response` has the heat.
    applied: Vec<f64>,
}

/// The derivatives of a sum of temperatures at one moment.
pub(super) struct Instant {
    /// By the heat content of each state, in 1/J times the unit of the sum.
    pub(super) states: Vec<f64>,
    /// By each parameter while heat contents stay.
    pub(super) parameters: Vec<f64>,
}

impl<'a> Moment<'a> {
    pub(super) fn new(
        system: &'a ThermalSystem,
        parameters: &[ParameterId],
    ) -> Result<Self, BackwardError> {
        let network = system.network();
        let tangents = network.tangents_between_events(parameters)?;
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let unfold = Unfold::new(system).map_err(|error| Unsolved::new(system, error))?;
        let is_whole = system.unknowns().len() == system.states().len();
        let plain = system.is_linear() && !unfold.carries_heat() && is_whole;
        let still = plain.then(|| {
            let mut still = system.workspace();
            let boundaries = vec![0.0; system.network().boundaries().len()];
            system.apply(&mut still, &vec![0.0; system.network().nodes().len()], &boundaries);
            still
        });
        Ok(Self {
            system,
            work: system.workspace(),
            unfold,
            tangents,
            kept: false,
            jacobian: vec![0.0; pattern.len()],
            turned: Transposed::new(&pattern, system.states().len())?,
            at: (f64::NAN, f64::NAN),
            state: vec![f64::NAN; system.states().len()],
            still,
            response: system.workspace(),
            applied: Vec::new(),
        })
    }

    pub(super) fn set_positions(&mut self, positions: Option<&Positions>) {
        if let Some(positions) = positions {
            self.work.set_positions(positions);
            self.at = (f64::NAN, f64::NAN);
        }
    }

    /// True for a network with constant coefficients.
    pub(super) fn is_constant(&self) -> bool {
        self.system.is_linear() && !self.unfold.carries_heat()
    }

    /// True if the heat content of a node changes with a parameter.
    pub(super) fn changes_contents(&self) -> bool {
        self.tangents.change_contents()
    }

    /// Begins at these temperatures in K of the massless nodes that are solved for.
    pub(super) fn stand(&mut self, branch: &[f64]) {
        if !branch.is_empty() {
            self.unfold.seed(branch);
        }
    }

    /// Goes to a time in s, with one inside the segment, and to the variables of the states.
    pub(super) fn go(&mut self, at: (f64, f64), state: &[f64]) -> Result<(), BackwardError> {
        (self.at, self.kept) = (at, false);
        self.state.copy_from_slice(state);
        self.system.read_inputs(&mut self.work, at.0, at.1)?;
        let unknowns = self.unfold.temperatures(&mut self.work, state);
        let unknowns = unknowns.map_err(|error| Unsolved::new(self.system, error))?;
        self.system.recover(&mut self.work, unknowns);
        Ok(())
    }

    pub(super) fn nodes(&self) -> &[f64] {
        self.system.node_temperatures(&self.work)
    }

    /// `dT/dH` of each state in K/J.
    pub(super) fn slopes(&self) -> impl Iterator<Item = f64> + '_ {
        let capacities = self.system.capacity().iter();
        capacities.zip(self.unfold.slopes()).map(|(capacity, slope)| slope / capacity)
    }

    /// `dT/dy` of each state in K/K.
    pub(super) fn unfolded(&self) -> &[f64] {
        &self.unfold.slopes()[..self.state.len()]
    }

    /// Takes the Jacobian here.
    pub(super) fn linearise(&mut self) -> Result<(), BackwardError> {
        let at = (&mut self.work, self.unfold.last());
        self.kept = self.system.linearise(at, &mut self.tangents, &mut self.jacobian)?;
        self.turned.take(&self.jacobian);
        Ok(())
    }

    /// Completes `x` in 1/J by the values of the massless nodes, and writes the rows of the states of
    /// `J^T x + weights`. Constant conductances are symmetric: their flows are differences, so that
    /// small losses keep their digits if conductances are large.
    pub(super) fn balance(
        &mut self,
        weights: &[f64],
        x: &mut [f64],
        rows: &mut [f64],
    ) -> Result<(), BackwardError> {
        match &self.still {
            Some(still) => {
                self.system.linear_flow(still, x, rows);
                rows.iter_mut().zip(weights).for_each(|(row, weight)| *row += weight);
                Ok(())
            }
            None => Ok(self.turned.balance(weights, x, rows)?),
        }
    }

    /// Heat into each state in W.
    pub(super) fn flow(&mut self) -> Result<Vec<f64>, BackwardError> {
        let mut flow = vec![0.0; self.system.unknowns().len()];
        self.system.flow(&mut self.work, self.unfold.last(), &mut flow)?;
        flow.truncate(self.state.len());
        Ok(flow)
    }

    /// Rate of the variable of each state in K/s.
    pub(super) fn rates(&mut self) -> Result<Vec<f64>, BackwardError> {
        let capacities = self.system.capacity().iter();
        Ok(self.flow()?.iter().zip(capacities).map(|(heat, capacity)| heat / capacity).collect())
    }

    /// The variables of the states.
    pub(super) fn state(&self) -> &[f64] {
        &self.state
    }

    /// The change in W of the heat into each state at a switch. Afterwards positions are those after
    /// it.
    pub(super) fn jumps(&mut self, turn: &Turn, at: (f64, f64)) -> Result<Vec<f64>, BackwardError> {
        let (before, state) = (self.flow()?, self.state.clone());
        self.set_positions(Some(&turn.after));
        self.stand(&turn.branch);
        self.go(at, &state)?;
        Ok(self.flow()?.iter().zip(before).map(|(after, before)| after - before).collect())
    }

    /// Weights of the temperatures of all nodes as weights of the unknowns.
    pub(super) fn handed(&mut self, weights: &[f64]) -> Vec<f64> {
        self.apply(weights);
        let mut handed = vec![0.0; self.system.unknowns().len()];
        self.system.linear_flow(&self.response, &vec![0.0; handed.len()], &mut handed);
        handed
    }

    fn apply(&mut self, weights: &[f64]) {
        if self.applied != weights {
            self.applied = weights.to_vec();
            let boundaries = vec![0.0; self.system.network().boundaries().len()];
            self.system.apply(&mut self.response, weights, &boundaries);
        }
    }

    /// Adds the derivatives by the parameters of the heat into every node times `rise`, which is
    /// known of the unknowns, and of the heat contents of the states times `held`.
    pub(super) fn add_driven(
        &mut self,
        (weights, rise): (&[f64], &[f64]),
        held: &[f64],
        out: &mut [f64],
    ) -> Result<(), BackwardError> {
        self.apply(weights);
        let system = self.system;
        system.recover(&mut self.response, rise);
        let nodes = system.node_temperatures(&self.response);
        let mut all = nodes.to_vec();
        all.resize(nodes.len() + system.network().boundaries().len(), 0.0);
        match self.kept {
            true => self.tangents.add_kept_against(&all, out),
            false => system.add_tangent_heat(&mut self.tangents, &self.work, &all, out)?,
        }
        if !self.changes_contents() {
            return Ok(());
        }
        let mut contents = vec![0.0; nodes.len()];
        let states = system.states().iter().zip(held);
        states.for_each(|(id, held)| contents[id.index()] = *held);
        let at = (system.network(), system.node_temperatures(&self.work));
        self.tangents.add_contents_against(at, &contents, out);
        Ok(())
    }

    /// The derivatives of a sum of temperatures of nodes with these weights.
    pub(super) fn instant(&mut self, weights: &[f64]) -> Result<Instant, BackwardError> {
        self.linearise()?;
        let handed = self.handed(weights);
        let mut rise = vec![0.0; handed.len()];
        let mut states = vec![0.0; self.state.len()];
        self.balance(&handed, &mut rise, &mut states)?;
        states.iter_mut().zip(self.slopes()).for_each(|(state, slope)| *state *= slope);
        let mut parameters = vec![0.0; self.tangents.variables().len()];
        let held: Vec<f64> = states.iter().map(|state| -state).collect();
        self.add_driven((weights, &rise), &held, &mut parameters)?;
        Ok(Instant { states, parameters })
    }

    /// Distance of a control or comparison from its switching point, in its own unit.
    pub(super) fn excess(&mut self, kind: EventKind) -> Result<f64, BackwardError> {
        excess(self.system, &mut self.work, kind)
    }

    /// Derivatives of that distance by the temperature of each node; `name` is that of the event.
    pub(super) fn excess_by_nodes(
        &mut self,
        kind: EventKind,
        name: &str,
    ) -> Result<Vec<f64>, BackwardError> {
        let mut nodes = self.nodes().to_vec();
        let mut weights = vec![0.0; nodes.len()];
        for id in self.read_by(kind) {
            let own = nodes[id.index()];
            let found = slope(KELVIN, |change| {
                nodes[id.index()] = own + change;
                self.system.place(&mut self.work, &nodes);
                self.excess(kind)
            })?;
            nodes[id.index()] = own;
            weights[id.index()] = found.ok_or_else(|| self.bends(name, id))?;
        }
        self.system.place(&mut self.work, &nodes);
        Ok(weights)
    }

    fn bends(&self, name: &str, by: NodeId) -> BackwardError {
        let by = &self.system.network().nodes()[by.index()].name;
        BentMargin::Bends { name: name.to_owned(), by: format!("{by}.T") }.into()
    }

    /// The nodes whose temperatures that distance may read.
    fn read_by(&self, kind: EventKind) -> Vec<NodeId> {
        let network = self.system.network();
        match kind {
            EventKind::Control(id) => network.node_of_control(id).into_iter().collect(),
            EventKind::Comparison(id) => network.nodes_of_switch(id),
            EventKind::Limit(_) => Vec::new(),
        }
    }

    /// True if that distance changes with one of these parameters while temperatures stay.
    pub(super) fn excess_follows(&self, kind: EventKind, parameters: &[ParameterId]) -> bool {
        let network = self.system.network();
        match kind {
            EventKind::Control(id) => network.control_follows(id, parameters),
            EventKind::Comparison(id) => network.comparison_follows(id, parameters),
            EventKind::Limit(_) => false,
        }
    }

    /// Its derivative by a parameter while temperatures stay.
    pub(super) fn excess_by(
        &self,
        (kind, positions): (EventKind, &Positions),
        parameter: ParameterId,
    ) -> Result<f64, BackwardError> {
        let network = self.system.network();
        if !self.excess_follows(kind, &[parameter]) {
            return Ok(0.0);
        }
        let own = network.parameter_value(parameter);
        let at = |change: f64| {
            let mut changed = network.given();
            changed.set(parameter, own + change);
            let system = self.system.with(&changed)?;
            let mut work = system.workspace();
            work.set_positions(positions);
            system.read_inputs(&mut work, self.at.0, self.at.1)?;
            system.place(&mut work, self.nodes());
            excess(&system, &mut work, kind)
        };
        let found = slope(step(network, parameter), at)?;
        let by = || network.parameters()[parameter.index()].name.clone();
        found.ok_or_else(|| BentMargin::Bends { name: kind.name(network), by: by() }.into())
    }
}

fn excess(
    system: &ThermalSystem,
    work: &mut Workspace,
    kind: EventKind,
) -> Result<f64, BackwardError> {
    match kind {
        EventKind::Control(id) => Ok(system.control_excess(work, id)?),
        EventKind::Comparison(id) => Ok(system.switch_difference(work, id)?.0),
        EventKind::Limit(_) => Ok(f64::NAN),
    }
}
