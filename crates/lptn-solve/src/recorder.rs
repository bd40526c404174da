//! Writes rows while a run goes on, and evaluates the watched nodes.

mod days;
mod jump;
mod look;
mod lookout;
mod place;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::{IntegrateError, Integrator, Statistics, kernels};
use lptn_network::{NodeId, Positions};

use crate::anchor::Anchor;
use crate::balance::Balance;
use crate::certify::results::Results;
use crate::certify::rows::Rows;
use crate::certify::{Certifier, Uncertified};
use crate::columns::{Columns, Room};
use crate::error::TransientError;
use crate::events::Event;
use crate::extremes::Extremes;
use crate::heat::Heat;
use crate::last::LastState;
use crate::ledger::Ledger;
use crate::limit::{self, LimitWatch, with_limits};
use crate::looks::Looks;
use crate::method::Method;
use crate::newton_error::NewtonError;
use crate::pipe::Shared;
use crate::ranges::RangeWatch;
use crate::reading::Reading;
use crate::readings::Readings;
use crate::recorder::lookout::Lookout;
use crate::sensed::Sensed;
use crate::sensitivity_rows::SensitivityRows;
use crate::settings::Transient;
use crate::solution::{RunStatus, Solution};
use crate::state::State;
use crate::stop_reason::StopReason;
use crate::times::Segment;
use crate::tracked::Tracked;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;

pub(crate) use days::Days;
pub(crate) use jump::Jumps;

/// Writes the state at a time inside the present step.
type StateAt<'a> = dyn FnMut(f64, &mut [f64]) -> Result<(), IntegrateError> + 'a;

/// The rows of a run, written in order.
pub(crate) struct Recorder<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    /// The times of all rows, ascending; those before `next` are written.
    rows: Vec<f64>,
    next: usize,
    segment: Segment,
    readings: Readings,
    /// A time inside the stretch in which results are read now.
    inside: f64,
    segments: Vec<f64>,
    /// The positions that the rows have, one after the other.
    positions: Vec<Positions>,
    /// For each row its positions, if there is any.
    row_positions: Vec<u32>,
    recorded: Vec<NodeId>,
    temperatures: Vec<f64>,
    columns: Columns,
    /// The hottest and the coldest node of all rows, recorded or not.
    extremes: Extremes,
    lookout: Lookout,
    /// Number of times that the workspace was brought to a time.
    placed: u64,
    limits: LimitWatch<'a>,
    ranges: RangeWatch<'a>,
    /// The windows of the run, then that of the limits and reports over time if there is one.
    windows: Vec<Tracked>,
    /// The columns on both sides of jumps; `None` if no picture needs them.
    jumps: Option<Jumps>,
    /// `None` if no picture needs days.
    days: Option<Days>,
    /// A time of the present step at which something may switch, in s.
    edge: f64,
    reading: Reading<'a>,
    /// The variables of the integrator at one time.
    state: Vec<f64>,
    sensed: Option<Sensed<'a>>,
    unfold: Unfold<'a>,
    /// Starting points of evaluations of massless nodes with one solution.
    anchor: Anchor,
    tolerance: f64,
    /// Number of steps under curved inputs that the network remembers.
    pub(crate) remembered: f64,
    /// Temperatures of the massless nodes of several solutions at the start of the present step, in
    /// K: every row of the step is found from there, whatever else is evaluated.
    branch: Vec<f64>,
    /// The same at its end.
    branch_ahead: Vec<f64>,
    /// True if nothing has to be written or evaluated.
    pub(crate) idle: bool,
}

impl<'a> Recorder<'a> {
    pub(crate) fn new(
        system: &'a ThermalSystem,
        (rows, readings): (Vec<f64>, Readings),
        settings: &Transient,
    ) -> Result<Self, TransientError> {
        let network = system.network();
        let Room { recorded, temperatures, columns } =
            Room::new(system, &settings.record, rows.len()).map_err(TransientError::Settings)?;
        let (start, stop) = (rows[0], rows[rows.len() - 1]);
        let unfold =
            Unfold::new(system).map_err(|e| TransientError::Start(Unsolved::new(system, e)))?;
        let windows = settings.windows.iter().cloned().chain(limit::window(network, (start, stop)));
        let windows = windows.map(|window| Tracked::new(window, network));
        Ok(Self {
            system,
            work: system.workspace(),
            segments: Vec::with_capacity(rows.len()),
            positions: Vec::new(),
            row_positions: Vec::new(),
            temperatures,
            columns,
            extremes: Extremes::default(),
            rows,
            next: 0,
            segment: Segment { from: start, to: stop },
            inside: readings.inside(start),
            readings,
            recorded,
            lookout: Lookout::new(settings),
            placed: 0,
            limits: LimitWatch::new(system),
            ranges: RangeWatch::new(system),
            windows: windows.collect(),
            jumps: settings.drawn.clone().map(|drawn| Jumps::new(drawn, (start, stop))),
            days: settings.drawn.as_ref().and_then(|d| Days::new(d, (start, stop), network)),
            edge: f64::INFINITY,
            reading: Reading::new(system),
            state: vec![0.0; system.states().len()],
            sensed: Sensed::of(system, &settings.sensitivities)?,
            unfold,
            anchor: Anchor::default(),
            tolerance: settings.tolerance,
            remembered: 0.0,
            branch: Vec::new(),
            branch_ahead: Vec::new(),
            idle: false,
        })
    }

    /// Takes the temperatures of pipes from their content.
    pub(crate) fn read_pipes(&mut self, pipes: &Shared) -> Result<(), NewtonError> {
        self.unfold.read_pipes(pipes)
    }

    /// Bounds on the errors of the recorded nodes and of the certified columns in the rows, for a
    /// run from this state.
    pub(crate) fn certifier(
        &self,
        method: Method,
        state: &[f64],
        settings: &Transient,
    ) -> Result<Certifier<'a>, Uncertified> {
        let results = settings.certified.as_ref().map(|columns| {
            let columns = columns.quantities().to_vec();
            Results::new(self.system, (&self.recorded, columns), self.readings.clone())
        });
        let rows = Rows::new(self.system, &self.recorded, &self.rows);
        let around = settings.around.as_ref();
        let tolerance = around.map_or(1.0, |around| around.share) * self.tolerance;
        let state = around.map_or(state, |around| &around.centre);
        let mut certifier =
            Certifier::new(self.system, method, (rows, results), (state, tolerance))?;
        around.iter().for_each(|around| certifier.begin_within(&around.bounds));
        Ok(certifier)
    }

    pub(crate) fn system(&self) -> &'a ThermalSystem {
        self.system
    }

    pub(crate) fn span(&self) -> (f64, f64) {
        (self.rows[0], self.rows[self.rows.len() - 1])
    }

    /// The times at which results are read.
    pub(crate) fn readings(&self) -> &Readings {
        &self.readings
    }

    pub(crate) fn rows(&self) -> &[f64] {
        &self.rows
    }

    pub(crate) fn state_name(&self, state: usize) -> String {
        let network = self.system.network();
        self.system
            .states()
            .get(state)
            .map_or(String::new(), |id| network.nodes()[id.index()].name.clone())
    }

    /// Enters the next segment: from here on inputs are read as they are inside it, in these
    /// positions.
    pub(crate) fn enter(&mut self, segment: Segment, positions: Option<&Positions>) {
        self.segment = segment;
        self.windows.iter_mut().for_each(Tracked::jump);
        self.days.iter_mut().for_each(Days::jump);
        self.unfold.may_leap();
        if let Some(positions) = positions {
            self.work.set_positions(positions);
            let known = self.positions.last() == Some(positions);
            self.positions.extend((!known).then(|| positions.clone()));
        }
    }

    /// Reads the inputs at the two ends of the segment as straight lines.
    pub(crate) fn draw_line(&mut self) {
        if self.idle {
            return;
        }
        let Segment { from, to } = self.segment;
        self.work.draw_line(self.system.network(), (from, to), self.readings.inside(from));
    }

    /// Ends the segment at `cut`, if there is one: a row at this time is left to the next segment.
    /// At `armed` something may switch.
    pub(crate) fn edges(&mut self, cut: Option<f64>, armed: f64) {
        self.segment.to = cut.unwrap_or(self.segment.to);
        self.edge = armed;
    }

    /// Number of rows that are written.
    pub(crate) fn written(&self) -> usize {
        self.next
    }

    /// Writes the row at the start of the segment, if there is one, and starts to watch.
    pub(crate) fn start(&mut self, state: &[f64], sensitivities: &[f64]) -> Result<(), StopReason> {
        if self.idle {
            return Ok(());
        }
        let from = self.segment.from;
        self.inside = self.readings.inside(from);
        self.state.copy_from_slice(state);
        self.sensed.iter_mut().for_each(|sensed| sensed.carry(sensitivities));
        self.place(from)?;
        self.anchor.stand(from, self.unfold.algebraic());
        self.lookout.start(from, self.system.node_temperatures(&self.work));
        self.limits.enter(&mut self.work, (from, self.inside)).map_err(StopReason::Input)?;
        self.ranges.enter(&mut self.work, from).map_err(StopReason::Input)?;
        self.edge = f64::INFINITY;
        if self.due(from) {
            self.check_heat()?;
            return self.push();
        }
        self.keep_after(from)
    }

    /// Checks that a row is complete: its heat can be computed too. Before the first step nothing
    /// else has checked that, and a row lies between two evaluations of the integrator. A linear
    /// system always has its heat.
    fn check_heat(&mut self) -> Result<(), StopReason> {
        if self.system.is_linear() {
            return Ok(());
        }
        let at = (self.rows[self.next], self.inside);
        self.reading.place(&mut self.work, at).map_err(StopReason::Input)?;
        self.reading.check_heat(&mut self.work).map_err(StopReason::Input)
    }

    /// Writes the rows inside the step from `from` to `to`; one at the end of the segment is left
    /// to the next segment, whose inputs apply there.
    pub(crate) fn step(
        &mut self,
        integrator: &mut dyn Integrator<Heat<'a>>,
        from: f64,
        to: f64,
    ) -> Result<(), StopReason> {
        if self.idle {
            return Ok(());
        }
        self.lean_on(integrator.system(), (from, to));
        while self.due(to) && (self.rows[self.next] < self.segment.to || self.is_last()) {
            let time = self.rows[self.next];
            self.inside = self.readings.inside(time);
            self.place_at(time, &mut |time, state| integrator.interpolate(time, state))?;
            if let Some(sensed) = &mut self.sensed {
                let read = integrator.interpolate_sensitivities(time, sensed.carried());
                read.map_err(|error| StopReason::Integrator { error, node: None })?;
            }
            if self.is_whole() || self.columns.ask_for_heat() {
                self.check_heat()?;
            }
            self.push()?;
        }
        let state_at: &mut StateAt<'_> = &mut |time, state| integrator.interpolate(time, state);
        self.keep_between((from, to), state_at)?;
        self.look_between((from, to), state_at)
    }

    /// Evaluates the watched nodes of a system without state between two times.
    pub(crate) fn look_without_state(&mut self, from: f64, to: f64) -> Result<(), StopReason> {
        self.walk((from, to));
        self.keep_between((from, to), &mut |_, _| Ok(()))?;
        self.look_between((from, to), &mut |_, _| Ok(()))
    }

    /// Writes a row from the inputs at `time` for a system without state.
    pub(crate) fn push_without_state(&mut self, time: f64) -> Result<(), StopReason> {
        self.inside = self.readings.inside(time);
        self.place(time)?;
        self.check_heat()?;
        self.push()
    }

    /// True if every node is recorded, so that heat flows are required.
    fn is_whole(&self) -> bool {
        self.recorded.len() == self.system.network().nodes().len()
    }

    fn is_last(&self) -> bool {
        self.next + 1 == self.rows.len()
    }

    /// True if the next row is not after `time`.
    fn due(&self, time: f64) -> bool {
        self.rows.get(self.next).is_some_and(|&row| row <= time)
    }

    fn push(&mut self) -> Result<(), StopReason> {
        let nodes = self.system.node_temperatures(&self.work);
        let range = kernels::range(nodes);
        if range.is_none_or(|(least, _)| least < 0.0)
            && let Some(i) = self.system.network().first_below_zero(nodes)
        {
            let name = self.system.network().nodes()[i].name.clone();
            return Err(StopReason::BelowAbsoluteZero { name, temperature: nodes[i] });
        }
        let time = self.rows[self.next];
        self.extremes.take_in_all(time, (self.system.network(), nodes), range);
        self.temperatures.extend(self.recorded.iter().map(|id| nodes[id.index()]));
        if let Some(sensed) = &mut self.sensed {
            let pushed = sensed.push(&mut self.work, &self.unfold, &self.recorded);
            pushed.map_err(|e| StopReason::Unsolved(Unsolved::new(self.system, e)))?;
        }
        let at = (self.rows[self.next], self.inside);
        self.columns.push(self.system, (&mut self.reading, &mut self.work), at);
        self.segments.push(self.inside);
        let position = self.positions.len().checked_sub(1).and_then(|i| u32::try_from(i).ok());
        self.row_positions.extend(position);
        self.next += 1;
        Ok(())
    }

    pub(crate) fn into_solution(
        mut self,
        (ledger, balance): (Ledger, Option<Balance>),
        (statistics, events): (Statistics, Vec<Event>),
        end: RunStatus,
    ) -> Solution {
        let network = self.system.network();
        let time = match end {
            RunStatus::Reached => self.span().1,
            RunStatus::Interrupted(time) | RunStatus::Failed(time) => time,
        };
        let last = LastState::new(self.system, &self.work, (time, &self.state));
        let span = (self.rows[0], self.rows[self.rows.len() - 1]);
        let whole = limit::window(network, span).and_then(|_| self.windows.pop());
        let whole = whole.and_then(|w| w.into_seen(network, self.tolerance));
        let windows = self.windows.into_iter().filter_map(|w| w.into_seen(network, self.tolerance));
        self.rows.truncate(self.next);
        let limits = self.limits.into_seen((self.tolerance, whole.as_ref()));
        Solution {
            controls: Vec::new(),
            method: None,
            positions: self.positions,
            row_positions: self.row_positions,
            events: with_limits(events, &limits),
            system: self.system.clone(),
            times: self.rows,
            segments: self.segments,
            recorded: self.recorded,
            temperatures: self.temperatures,
            columns: self.columns,
            jumps: self.jumps.and_then(Jumps::into_sides),
            days: self.days.map_or_else(Vec::new, Days::into_past),
            extremes: self.extremes,
            looks: Looks { placed: self.placed, searched: self.lookout.searched() },
            seen: self.lookout.into_seen(),
            limits,
            out_of_range: self.ranges.into_found(),
            windows: windows.collect(),
            reports: whole.map_or_else(Vec::new, |whole| whole.reports),
            balance,
            last,
            ledger,
            statistics,
            end,
            tolerance: self.tolerance,
            remembered: self.remembered,
            growth: 1.0,
            certificate: None,
            trajectory: None,
            unresolved: None,
            undecided: None,
            made_up: 1.0,
            sensitivities: self.sensed.map_or_else(SensitivityRows::default, Sensed::into_rows),
            end_state: State::of_carried(Vec::new()),
        }
    }
}
