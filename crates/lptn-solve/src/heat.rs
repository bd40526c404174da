//! A thermal system as the integrator sees it: `M y' = f` with M the capacities and f the heat
//! flows.
//!
//! CVODES, not IDA, serves nonlinear massless nodes too. Balances of massless nodes that cannot be
//! eliminated are solved inside the heat flow, by the Newton method of steady states (`newton.rs`).
//! CVODES then sees an ordinary system. IDA has no quadratures, so the energy balance would need a
//! second way. Every restart has consistent temperatures by construction, also across jumps.
//!
//! Steady states, starts, rows between steps and networks without capacity use one solver. The
//! price is an inner solution at every evaluation: a few triangular solves, because the last
//! factors are reused while they contract. The Newton matrix of the integrator is `diag(M, 0) -
//! gamma K` over states and massless nodes together. It eliminates to the exact one without its
//! fill.

mod look;

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::{OdeSystem, Pattern, Retry};
use lptn_network::Positions;

use crate::balance::Books;
use crate::events::Gates;
use crate::newton_error::NewtonError;
use crate::pipe::Shared;
use crate::samples::Sampled;
use crate::stop_reason::StopReason;
use crate::tangent::Tangent;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;

/// A system with the data to evaluate it. Its running integrals are those of the ledger.
pub(crate) struct Heat<'a> {
    system: &'a ThermalSystem,
    pattern: Pattern,
    work: Workspace,
    unfold: Unfold<'a>,
    flow: Vec<f64>,
    books: Books,
    /// The form of the Jacobian.
    form: JacobianForm,
    /// Comparisons of `t` keep the truth they have here while a segment lasts.
    segment: f64,
    /// The time at which inputs are fixed, and one inside its segment.
    pub(crate) held: Option<(f64, f64)>,
    /// Reason why the heat could not be computed.
    pub(crate) failure: Option<NewtonError>,
    /// The same, overcome by a smaller step or not, until it is taken.
    pub(crate) refused: Option<NewtonError>,
    /// The earliest time in s at which a massless node could not go on, until it is taken.
    pub(crate) fold: Option<f64>,
    /// Switching conditions.
    pub(crate) gates: Gates,
    /// The sensitivities that are followed.
    pub(crate) tangent: Option<Tangent<'a>>,
    /// The sampled states, which keep their values; empty on the way to a steady state.
    pub(crate) samples: Vec<Sampled>,
}

impl<'a> Heat<'a> {
    pub(crate) fn new(
        system: &'a ThermalSystem,
        segment: f64,
        books: Books,
    ) -> Result<Self, NewtonError> {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let form =
            if system.is_symmetric() { JacobianForm::Symmetric } else { JacobianForm::Exact };
        let flow = vec![0.0; system.unknowns().len()];
        let (work, unfold) = (system.workspace(), Unfold::new(system)?);
        let gates = Gates::new(system);
        Ok(Self {
            system,
            pattern,
            work,
            unfold,
            flow,
            books,
            form,
            segment,
            held: None,
            failure: None,
            refused: None,
            fold: None,
            gates,
            tangent: None,
            samples: Vec::new(),
        })
    }

    /// Reads the inputs and takes the state; a failure may come from the guess of a step that is
    /// too long.
    fn place(&mut self, time: f64, y: &[f64]) -> Result<(), Retry> {
        let (at, segment) = self.held.unwrap_or((time, self.segment));
        let inputs = self.system.read_inputs(&mut self.work, at, segment);
        inputs.map_err(|error| self.failed(NewtonError::Input(error), Retry::Stop))?;
        let unfolded = self.unfold.temperatures(&mut self.work, y).map(|_| ());
        unfolded.map_err(|error| {
            if let NewtonError::Fold { .. } = error {
                self.fold = Some(self.fold.map_or(time, |earlier| earlier.min(time)));
            }
            self.failed(error, Retry::SmallerStep)
        })
    }

    /// Enters a segment: inputs may jump, and massless nodes with them.
    pub(crate) fn enter(&mut self, segment: f64) {
        self.segment = segment;
        self.unfold.may_leap();
    }

    /// Reads the inputs at the two ends of a segment, or of the rest of it, as straight lines; not
    /// if they are fixed, at a time unrelated to the segment.
    pub(crate) fn draw_line(&mut self, (from, to): (f64, f64)) {
        if self.held.is_some() {
            return;
        }
        self.work.draw_line(self.system.network(), (from, to), self.segment);
    }

    /// Sets which controls are on and which comparisons are true.
    pub(crate) fn set_positions(&mut self, positions: &Positions) {
        self.work.set_positions(positions);
        self.unfold.may_leap();
    }

    /// Capacity of each state at its start in J/K.
    pub(crate) fn capacities(&self) -> &[f64] {
        self.system.capacity()
    }

    /// Takes the temperatures of pipes from their content.
    pub(crate) fn read_pipes(&mut self, pipes: &Shared) -> Result<(), NewtonError> {
        self.unfold.read_pipes(pipes)
    }

    /// True if there are pipes whose content is read.
    pub(crate) fn has_pipes(&self) -> bool {
        self.unfold.has_pipes()
    }

    /// True if massless nodes may have several solutions; see [`Heat::branch`].
    pub(crate) fn is_guarded(&self) -> bool {
        self.unfold.is_guarded()
    }

    /// The temperatures of the massless nodes that are solved for, in K, at a state that was
    /// reached. They have to be ones at which the nodes stay.
    pub(crate) fn branch(&mut self, time: f64, y: &[f64]) -> Result<Vec<f64>, StopReason> {
        self.arrive(time, y)?;
        let now = self.unfold.algebraic().to_vec();
        let stays = self.unfold.stays(&mut self.work, &now);
        stays.map_err(|error| StopReason::Unsolved(Unsolved::new(self.system, error)))?;
        Ok(now)
    }

    /// Temperatures of the massless nodes that are solved for in K, as they were last.
    pub(crate) fn algebraic(&self) -> &[f64] {
        self.unfold.algebraic()
    }

    /// The matrix of the factors with which they were found; empty if there are none.
    pub(crate) fn matrix(&self) -> &[f64] {
        self.unfold.matrix()
    }

    /// Begins a run with massless nodes at these earlier temperatures in K.
    pub(crate) fn stand_at(&mut self, stood: &[f64]) {
        self.unfold.stand_at(stood);
    }

    /// Begins the next evaluation with massless nodes at these temperatures in K.
    pub(crate) fn seed(&mut self, branch: &[f64]) {
        self.unfold.seed(branch);
    }

    /// Brings massless nodes from these temperatures in K to this state without a jump.
    ///
    /// # Errors
    /// The reason why they do not reach it.
    pub(crate) fn comes_to(
        &mut self,
        (time, y): (f64, &[f64]),
        branch: &[f64],
    ) -> Result<(), StopReason> {
        self.unfold.seed(branch);
        self.branch(time, y).map(drop)
    }

    /// Temperatures of all unknowns in K at a state that was reached.
    pub(crate) fn temperatures(
        &mut self,
        time: f64,
        y: &[f64],
    ) -> Result<(&[f64], &mut Workspace), StopReason> {
        self.arrive(time, y)?;
        Ok((self.unfold.last(), &mut self.work))
    }

    /// Heat that each state receives in W at a state that was reached.
    pub(crate) fn flow_at(
        &mut self,
        time: f64,
        y: &[f64],
        flow: &mut [f64],
    ) -> Result<(), StopReason> {
        self.arrive(time, y)?;
        let heat = self.system.flow(&mut self.work, self.unfold.last(), &mut self.flow);
        heat.map_err(StopReason::Input)?;
        flow.copy_from_slice(&self.flow[..flow.len()]);
        self.samples.iter().for_each(|sampled| sampled.hold(flow));
        Ok(())
    }

    /// The system.
    pub(crate) fn system(&self) -> &'a ThermalSystem {
        self.system
    }

    /// Lets massless nodes jump as they do at `beyond`, and brings them back to `here`; both are a
    /// time and a state. True if they are then on another branch; if not, nothing has changed.
    pub(crate) fn leap(&mut self, beyond: (f64, &[f64]), here: (f64, &[f64])) -> bool {
        let before = self.unfold.algebraic().to_vec();
        self.unfold.may_leap();
        let leapt = self.place(beyond.0, beyond.1).is_ok() && self.place(here.0, here.1).is_ok();
        // at one state two solutions at which the nodes rest are two branches, however near
        if leapt && self.unfold.is_apart(&before) && self.branch(here.0, here.1).is_ok() {
            self.fold = None;
            return true;
        }
        self.unfold.seed(&before);
        false
    }

    /// Takes a state and recovers the temperatures of all nodes.
    fn recover(&mut self, time: f64, y: &[f64]) -> Result<(), Retry> {
        self.place(time, y)?;
        self.system.recover(&mut self.work, self.unfold.last());
        Ok(())
    }

    /// Goes to a state of an event; a failure there ends the run.
    fn arrive(&mut self, time: f64, y: &[f64]) -> Result<(), StopReason> {
        self.recover(time, y).map_err(|_| match self.failure.take() {
            Some(NewtonError::Input(input)) => StopReason::Input(input),
            Some(other) => StopReason::Unsolved(Unsolved::new(self.system, other)),
            None => StopReason::Unsolved(Unsolved::new(
                self.system,
                NewtonError::Singular { unknown: 0 },
            )),
        })
    }

    /// Writes [`Gates::excess`] from the states alone and returns true, if they suffice.
    fn excess_is_plain(&self, y: &[f64], out: &mut [f64]) -> bool {
        let plain = self.gates.are_plain() && !self.unfold.carries_heat();
        if plain {
            self.gates.plain_excess(self.work.positions(), y, out);
        }
        plain
    }

    /// Writes the excess of everything that switches over its switching point; see
    /// [`Gates::excess`].
    pub(crate) fn excess(
        &mut self,
        time: f64,
        y: &[f64],
        out: &mut [f64],
    ) -> Result<(), StopReason> {
        if self.excess_is_plain(y, out) {
            return Ok(());
        }
        self.arrive(time, y)?;
        self.gates.excess(self.system, &mut self.work, out).map_err(StopReason::Input)
    }

    /// Sets the least difference of the sides of comparisons; see [`Gates::set_margins`].
    pub(crate) fn set_margins(
        &mut self,
        time: f64,
        y: &[f64],
        tolerance: f64,
    ) -> Result<(), StopReason> {
        self.arrive(time, y)?;
        self.gates.set_margins(self.system, &mut self.work, tolerance).map_err(StopReason::Input)
    }

    /// For each comparison true if it is true at present.
    pub(crate) fn comparisons(&mut self, time: f64, y: &[f64]) -> Result<Vec<bool>, StopReason> {
        self.arrive(time, y)?;
        let network = self.system.network();
        let mut holds = Vec::with_capacity(network.switches().len());
        for (id, switch) in network.switch_ids().zip(network.switches()) {
            let (difference, _) =
                self.system.switch_difference(&mut self.work, id).map_err(StopReason::Input)?;
            holds.push(switch.holds(difference));
        }
        Ok(holds)
    }

    /// Begins to follow sensitivities; returns their carried values if every node starts from `y`.
    /// `own_start` is true if `y` is the start of the network itself.
    pub(crate) fn follow(
        &mut self,
        mut tangent: Tangent<'a>,
        (time, y, own_start): (f64, &[f64], bool),
    ) -> Result<Vec<f64>, NewtonError> {
        let mut carried = vec![0.0; y.len() * tangent.parameters().len()];
        if !own_start {
            self.recover(time, y)
                .map_err(|_| self.failure.take().unwrap_or(NewtonError::Singular { unknown: 0 }))?;
            tangent.carried_at(&self.work, &mut carried);
        }
        self.tangent = Some(tangent);
        Ok(carried)
    }

    fn failed(&mut self, error: NewtonError, retry: Retry) -> Retry {
        self.refused = Some(error.clone());
        self.failure = Some(error);
        retry
    }
}

impl OdeSystem for Heat<'_> {
    fn size(&self) -> usize {
        self.system.states().len()
    }

    fn mass(&self) -> &[f64] {
        self.system.mass()
    }

    fn slope(&self) -> Option<&[f64]> {
        self.unfold.carries_heat().then(|| self.unfold.slopes())
    }

    fn flow(&mut self, time: f64, y: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        self.place(time, y)?;
        let heat = self.system.flow(&mut self.work, self.unfold.last(), &mut self.flow);
        heat.map_err(|error| self.failed(NewtonError::Input(error), Retry::SmallerStep))?;
        flow.copy_from_slice(&self.flow[..flow.len()]);
        self.samples.iter().for_each(|sampled| sampled.hold(flow));
        self.failure = None;
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn symmetric(&self) -> bool {
        self.form == JacobianForm::Symmetric
    }

    fn leave_symmetry(&mut self) {
        self.form = JacobianForm::Exact;
    }

    fn jacobian(&mut self, time: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        if self.system.is_linear() {
            self.system.jacobian(values);
            return Ok(());
        }
        self.place(time, y)?;
        let slopes = self.system.jacobian_at(&mut self.work, self.unfold.last(), self.form, values);
        slopes.map_err(|error| self.failed(NewtonError::Input(error), Retry::SmallerStep))?;
        self.unfold.clear_pipes(values);
        self.samples.iter().for_each(|sampled| sampled.hold_slopes(values));
        Ok(())
    }

    fn jacobian_is_constant(&self) -> bool {
        self.system.is_linear() && !self.unfold.carries_heat()
    }

    fn sensitivity_count(&self) -> usize {
        self.tangent.as_ref().map_or(0, |tangent| tangent.parameters().len())
    }

    fn sensitivity_flow(
        &mut self,
        time: f64,
        y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        self.recover(time, y)?;
        let Self { tangent, work, unfold, .. } = self;
        let Some(tangent) = tangent else { return Ok(()) };
        let driven = tangent.flow(work, unfold, s, g);
        driven.map_err(|error| self.failed(error, Retry::SmallerStep))
    }

    fn root_count(&self) -> usize {
        self.gates.count()
    }

    fn roots(&mut self, time: f64, y: &[f64], g: &mut [f64]) -> Result<(), Retry> {
        if self.excess_is_plain(y, g) {
            return Ok(());
        }
        self.recover(time, y)?;
        let excess = self.gates.excess(self.system, &mut self.work, g);
        excess.map_err(|error| self.failed(NewtonError::Input(error), Retry::Stop))
    }

    fn quadrature_count(&self) -> usize {
        self.books.integrals(self.system)
    }

    fn quadrature(&mut self, time: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        self.place(time, y)?;
        let heat = self.books.integrands(self.system, &mut self.work, self.unfold.last(), q);
        heat.map_err(|error| self.failed(NewtonError::Input(error), Retry::SmallerStep))
    }
}
