//! The result of a transient.

use std::ops::Range;
use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_integrate::Statistics;
use lptn_network::{
    BoundaryId, ConductorId, ControlId, HeatOf, Network, NodeId, ParameterId, Positions, Received,
    ReportId, SignalId, SourceId, same_time,
};

use crate::balance::Balance;
use crate::certify::{Certificate, Uncertified};
use crate::columns::Columns;
use crate::curved::MOST_REMEMBERED;
use crate::drawn::Day;
use crate::events::{ControlState, Event, EventKind, Undecided};
use crate::extremes::Extremes;
use crate::growth::TELLING;
use crate::last::LastState;
use crate::ledger::Ledger;
use crate::limit_seen::LimitSeen;
use crate::looks::Looks;
use crate::method::Method;
use crate::quantity::Quantity;
use crate::ranges::OutOfRange;
use crate::replay::Replay;
use crate::sensitivity_rows::SensitivityRows;
use crate::snapshot::Snapshot;
use crate::solution_error::SolutionError;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::unbounded::Unbounded;
use crate::watch::Watched;
use crate::window::{ReportSeen, WindowSeen};

/// This number of switches adds less than the promised ten tolerances, with the integrator's share
/// of them.
const FEW_SWITCHES: usize = 100;

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunStatus {
    /// It reached its stop.
    Reached,
    /// It was asked to end at this time in s; the rows up to then are complete.
    Interrupted(f64),
    /// It broke off at this time in s; the rows up to then are complete.
    Failed(f64),
}

/// Temperatures over time, from which heat flows follow. Times increase strictly, one row each.
#[derive(Clone, Debug)]
pub struct Solution {
    pub(crate) system: ThermalSystem,
    pub(crate) times: Vec<f64>,
    /// For each row a time inside its segment: comparisons of `t` are read there.
    pub(crate) segments: Vec<f64>,
    /// The positions of the rows, one after the other; none if nothing switches.
    pub(crate) positions: Vec<Positions>,
    /// For each row its positions, if there is any.
    pub(crate) row_positions: Vec<u32>,
    pub(crate) events: Vec<Event>,
    pub(crate) controls: Vec<ControlState>,
    /// The nodes that were recorded, ascending.
    pub(crate) recorded: Vec<NodeId>,
    /// Row by row, one temperature in K for each recorded node.
    pub(crate) temperatures: Vec<f64>,
    pub(crate) columns: Columns,
    /// Selected columns on both sides of jumps: time in s, and values in SI units.
    pub(crate) jumps: Option<Vec<(f64, Vec<f64>)>>,
    /// The days of the same columns, in order.
    pub(crate) days: Vec<Day>,
    pub(crate) extremes: Extremes,
    pub(crate) seen: Vec<Watched>,
    pub(crate) looks: Looks,
    pub(crate) limits: Vec<LimitSeen>,
    pub(crate) out_of_range: Vec<OutOfRange>,
    pub(crate) windows: Vec<WindowSeen>,
    pub(crate) reports: Vec<ReportSeen>,
    pub(crate) balance: Option<Balance>,
    pub(crate) last: LastState,
    pub(crate) ledger: Ledger,
    pub(crate) statistics: Statistics,
    pub(crate) method: Option<Method>,
    pub(crate) end: RunStatus,
    pub(crate) tolerance: f64,
    pub(crate) remembered: f64,
    /// Growth of errors, and the part of it that the tolerance of the integrator allows for.
    pub(crate) growth: f64,
    /// Bounds on the errors, if they were asked for.
    pub(crate) certificate: Option<Result<Certificate, Uncertified>>,
    /// The states at every time, if they were kept.
    pub(crate) trajectory: Option<Arc<Trajectory>>,
    /// The first time in s at which a step was accepted that passes a bend over temperature.
    pub(crate) unresolved: Option<f64>,
    /// The first switch that the error of the run decides.
    pub(crate) undecided: Option<Undecided>,
    pub(crate) made_up: f64,
    pub(crate) end_state: State,
    pub(crate) sensitivities: SensitivityRows,
}

impl Solution {
    /// The network that was run.
    pub fn network(&self) -> &Network {
        self.system.network()
    }

    /// The integrator that computed it; `None` for a network without capacities.
    pub fn method(&self) -> Option<Method> {
        self.method
    }

    /// True if the columns are known on both sides of all jumps: see [`Transient::drawn`].
    ///
    /// [`Transient::drawn`]: crate::Transient::drawn
    pub fn knows_jumps(&self) -> bool {
        self.jumps.is_some()
    }

    /// The time of each row in s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The recorded nodes, ascending.
    pub fn recorded(&self) -> &[NodeId] {
        &self.recorded
    }

    /// Temperatures of the recorded nodes in one row, in K.
    pub fn row(&self, row: usize) -> &[f64] {
        let width = self.recorded.len();
        &self.temperatures[row * width..(row + 1) * width]
    }

    /// Temperature of a node over the rows in K; `None` if it was not recorded.
    pub fn temperature(&self, node: NodeId) -> Option<Vec<f64>> {
        Some(self.kept(Quantity::Node(node))?.collect())
    }

    /// The recorded values of a quantity over the rows in SI units, if there are any.
    pub(crate) fn kept(&self, quantity: Quantity) -> Option<Box<dyn Iterator<Item = f64> + '_>> {
        let Quantity::Node(node) = quantity else {
            return self.columns.get(quantity).map(|values| Box::new(values) as _);
        };
        let column = self.recorded.binary_search(&node).ok()?;
        let values = self.temperatures.iter().skip(column).step_by(self.recorded.len());
        Some(Box::new(values.copied()))
    }

    /// Temperature of a node over the rows in K.
    ///
    /// # Errors
    /// [`SolutionError::NotRecorded`] if the run did not record it: see
    /// [`Transient::record`](crate::Transient::record).
    pub fn series(&self, node: NodeId) -> Result<Vec<f64>, SolutionError> {
        self.temperature(node).ok_or_else(|| {
            let known = self.network().nodes().get(node.index());
            SolutionError::NotRecorded {
                name: known.map_or(String::new(), |node| node.name.clone()),
            }
        })
    }

    /// Temperature of a node in the last row, in K.
    ///
    /// # Errors
    /// As [`Solution::series`].
    pub fn at_end(&self, node: NodeId) -> Result<f64, SolutionError> {
        // there is a row at the start at least
        Ok(self.series(node)?.last().copied().unwrap_or(f64::NAN))
    }

    /// Sensitivity of the temperature of a node to a parameter, over the rows in K per SI unit of
    /// the parameter, all other requested parameters fixed; `None` if it was not recorded or not
    /// among [`crate::Transient::sensitivities`].
    ///
    /// Its error against the exact derivative obeys the tolerance over the size of the parameter,
    /// as that of the temperature obeys the tolerance.
    pub fn sensitivity(&self, parameter: ParameterId, node: NodeId) -> Option<Vec<f64>> {
        let column = self.recorded.binary_search(&node).ok()?;
        self.sensitivities.of(parameter, (column, self.recorded.len()))
    }

    /// Heat flow of a conductor over the rows in W, positive from `from` to `to`, what `to`
    /// receives; `None` unless every node was recorded.
    pub fn conductor_heat(&self, id: ConductorId) -> Option<Vec<f64>> {
        let received = self.received(id)?;
        Some(received.into_iter().map(|[_, to]| to).collect())
    }

    /// Heat that the two ends of a conductor receive over the rows in W: equal and opposite but for
    /// a stream; `None` unless every node was recorded.
    pub fn received(&self, id: ConductorId) -> Option<Vec<Received>> {
        let mut heat = Vec::with_capacity(self.times.len());
        self.is_whole().then(|| self.replay(|at| heat.push(at.received(id))))?;
        Some(heat)
    }

    /// Heat that a boundary gives to the network over the rows in W; `None` unless every node was
    /// recorded.
    pub fn boundary_heat(&self, id: BoundaryId) -> Option<Vec<f64>> {
        self.is_whole().then(|| self.values(Quantity::Heat(HeatOf::Boundary(id))))
    }

    /// Temperature of a boundary over the rows in K.
    pub fn boundary_temperature(&self, id: BoundaryId) -> Vec<f64> {
        self.values(Quantity::BoundaryTemperature(id))
    }

    /// Heat of a source over the rows in W; if it depends on temperatures NaN unless every node was
    /// recorded.
    pub fn source_heat(&self, id: SourceId) -> Vec<f64> {
        self.values(Quantity::Heat(HeatOf::Source(id)))
    }

    /// A signal over the rows in SI units; NaN if an unused one has no value.
    pub fn signal(&self, id: SignalId) -> Vec<f64> {
        self.values(Quantity::Signal(id))
    }

    /// A report over the rows in SI units; NaN unless every node was recorded. For a number over
    /// time it is the quantity; [`Solution::reports_over_time`] has the number.
    pub fn report(&self, id: ReportId) -> Vec<f64> {
        self.values(Quantity::Report(id))
    }

    /// Temperatures and heat flows at a row; `None` unless every node was recorded.
    ///
    /// # Panics
    /// For a row that does not exist.
    pub fn snapshot(&self, row: usize) -> Option<Snapshot> {
        let mut found = None;
        if self.is_whole() {
            self.replay_rows(row..row + 1, |at| found = at.snapshot(self.times[row]));
        }
        found
    }

    /// The row at or before a time in s; times that differ by rounding are one. `None` outside of
    /// the rows.
    pub fn row_at(&self, time: f64) -> Option<usize> {
        let (first, last) = (*self.times.first()?, *self.times.last()?);
        let rounding = same_time(first, last);
        let after = self.times.partition_point(|&known| known <= time + rounding);
        after.checked_sub(1).filter(|_| time <= last + rounding)
    }

    fn values(&self, quantity: Quantity) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.times.len());
        self.replay(|at| values.push(at.value(quantity)));
        values
    }

    /// True if every node was recorded, so that heat flows can be computed.
    pub fn is_whole(&self) -> bool {
        self.recorded.len() == self.network().nodes().len()
    }

    /// Visits every row in order. Inputs and heat could be read there during the run, so they can
    /// be again; if that fails a row has no values (NaN), for columns have to be of one length.
    pub(crate) fn replay(&self, visit: impl FnMut(&mut Replay<'_>)) {
        self.replay_rows(0..self.times.len(), visit);
    }

    /// The same for some of the rows.
    pub(crate) fn replay_rows(&self, rows: Range<usize>, visit: impl FnMut(&mut Replay<'_>)) {
        let own = |row: usize, column: usize| self.row(row)[column];
        self.replay_as((&self.system, &own), (rows, &self.segments), visit);
    }

    /// The same with another system, temperatures by row and place among the recorded nodes, and for
    /// each row a time inside its stretch.
    pub(crate) fn replay_as(
        &self,
        (system, temperature): (&ThermalSystem, &dyn Fn(usize, usize) -> f64),
        (rows, insides): (Range<usize>, &[f64]),
        mut visit: impl FnMut(&mut Replay<'_>),
    ) {
        let mut at = Replay::new(system);
        let mut nodes = vec![f64::NAN; self.network().nodes().len()];
        for row in rows.clone() {
            if let Some(&at_row) = self.row_positions.get(row)
                && (row == rows.start || self.row_positions[row - 1] != at_row)
            {
                at.set_positions(&self.positions[at_row as usize]);
            }
            let places = self.recorded.iter().enumerate();
            places.for_each(|(column, id)| nodes[id.index()] = temperature(row, column));
            at.go_to((self.times[row], insides[row]), &nodes);
            visit(&mut at);
        }
    }

    /// Results of the watched nodes, between the rows too, in the order they were named.
    pub fn watched(&self) -> &[Watched] {
        &self.seen
    }

    /// Result of each limit of the network up to the end that was reached, between the rows too.
    pub fn limits(&self) -> &[LimitSeen] {
        &self.limits
    }

    /// Events at times that were not known in advance, in the order of time: controls that
    /// switched, comparisons of temperatures that changed, limits that were broken.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// States of the controls at the end that was reached, in the order of their ids.
    pub fn controls(&self) -> &[ControlState] {
        &self.controls
    }

    /// A control over the rows: 0 or 1.
    pub fn control(&self, id: ControlId) -> Vec<f64> {
        self.values(Quantity::Control(id))
    }

    /// Laws outside their ranges of validity, in the order of the conductors.
    pub fn out_of_range(&self) -> &[OutOfRange] {
        &self.out_of_range
    }

    /// Means and extremes over the requested windows, as far as the run came.
    pub fn windows(&self) -> &[WindowSeen] {
        &self.windows
    }

    /// The reports that are numbers over time, over the run as far as it came.
    pub fn reports_over_time(&self) -> &[ReportSeen] {
        &self.reports
    }

    /// The requested heat balance of a node or boundary.
    pub fn balance(&self) -> Option<&Balance> {
        self.balance.as_ref()
    }

    /// The end of the run, every node included, recorded or not: another run can start from it.
    pub fn last(&self) -> &LastState {
        &self.last
    }

    /// The energy ledger from the start to the end that was reached.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The state at the end that was reached, from which another run may begin.
    pub fn last_state(&self) -> &State {
        &self.end_state
    }

    /// Counters of the integrator; all zero for a network without state.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// Counters of evaluations.
    pub fn looks(&self) -> Looks {
        self.looks
    }

    /// The way the run ended.
    pub fn end(&self) -> RunStatus {
        self.end
    }

    /// The tolerance of the run in K.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// True if the error stays within ten times the tolerance (for tolerances from 1e-3 to 1e-5 K).
    pub fn error_is_bounded(&self) -> bool {
        self.why_unbounded().is_none()
    }

    /// Largest growth of an error of a temperature along the run; 1 if errors decay, and if it is
    /// not known because inputs change with time.
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// The reason why the tolerance does not bound the error, if it does not.
    pub fn why_unbounded(&self) -> Option<Unbounded> {
        let ungrounded: Vec<NodeId> = self.network().ungrounded().into_iter().flatten().collect();
        if !ungrounded.is_empty() {
            return Some(Unbounded::NoBoundary(ungrounded));
        }
        if let Some(undecided) = self.undecided {
            return Some(Unbounded::Switch(undecided));
        }
        let steps = self.remembered;
        if steps > MOST_REMEMBERED {
            return Some(Unbounded::LongMemory { steps });
        }
        if let Some(at) = self.unresolved {
            return Some(Unbounded::Unresolved { at });
        }
        if self.growth > TELLING * self.made_up {
            return Some(Unbounded::Grows { factor: self.growth });
        }
        let count =
            self.events.iter().filter(|event| !matches!(event.kind, EventKind::Limit(_))).count();
        (count > FEW_SWITCHES).then_some(Unbounded::Switches { count })
    }
}
