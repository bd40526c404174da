//! The map from the start of a cycle to its end.

use lptn_assembly::ThermalSystem;
use lptn_network::{ControlId, OutputTimes, StateId};

use super::error::PeriodicError;
use super::secants::Shot;
use crate::events::{ControlState, Event, EventKind};
use crate::selection::RecordedNodes;
use crate::settings::{Around, Proceed, Progress, Transient};
use crate::solution::{RunStatus, Solution};
use crate::state::State;

/// An observer that may interrupt.
pub(super) type Observer<'a> = dyn FnMut(Progress) -> Proceed + 'a;

/// Integrates cycles and counts them.
pub(super) struct Cycles<'a> {
    pub(super) system: &'a ThermalSystem,
    settings: &'a Transient,
    observer: &'a mut Observer<'a>,
    /// Cycles integrated to their end.
    pub(super) count: usize,
    /// Steps of the integrator in all of them.
    pub(super) steps: u64,
    /// Evaluations of the heat flows in all of them.
    pub(super) flow_evaluations: u64,
    /// Start less end of the last cycle in K.
    last: Option<f64>,
    /// States of the controls at the start of the next cycle.
    controls: Vec<ControlState>,
    /// Temperatures of massless nodes of several solutions there, in K.
    stood: Vec<f64>,
    /// True if the controls had these states at the start of the last cycle too, and everything
    /// switched as in the cycle before it.
    pub(super) repeats: bool,
    /// True if their remaining dwell times were the same then.
    pub(super) same_times: bool,
    /// Switches of the last cycle, in order.
    switched: Vec<(EventKind, u8)>,
    /// The places of the states of one's own, with their bounds in K.
    bounds: Vec<(usize, [f64; 2])>,
}

/// The places of the states of one's own among the states, with their bounds in K.
fn bounds(system: &ThermalSystem) -> Vec<(usize, [f64; 2])> {
    let network = system.network();
    let bounded = |id: StateId| {
        let node = network.states()[id.index()].node;
        let place = system.states().iter().position(|state| *state == node)?;
        Some((place, network.state_bounds(id)))
    };
    network.state_ids().filter_map(bounded).collect()
}

impl<'a> Cycles<'a> {
    pub(super) fn new(
        system: &'a ThermalSystem,
        settings: &'a Transient,
        observer: &'a mut Observer<'a>,
    ) -> Self {
        let repeats = !system.network().has_events();
        let (controls, switched) = (settings.controls.clone(), Vec::new());
        Self {
            system,
            settings,
            observer,
            count: 0,
            steps: 0,
            flow_evaluations: 0,
            last: None,
            controls,
            stood: Vec::new(),
            repeats,
            same_times: repeats,
            switched,
            bounds: bounds(system),
        }
    }

    /// Start and length of the cycle in s.
    pub(super) fn span(&self) -> (f64, f64) {
        (self.settings.start, self.settings.stop - self.settings.start)
    }

    /// Integrates one cycle to a tolerance in K and keeps nothing but its end.
    pub(super) fn shoot(&mut self, start: Vec<f64>, tolerance: f64) -> Result<Shot, PeriodicError> {
        self.run(&self.bare(tolerance), start).map(|(shot, _)| shot)
    }

    /// The cycle from the network's own start, with its ledger.
    pub(super) fn first(&mut self) -> Result<Solution, PeriodicError> {
        let bare = self.bare(self.settings.tolerance);
        self.run(&bare, self.system.initial()).map(|(_, solution)| solution)
    }

    fn bare(&self, tolerance: f64) -> Transient {
        Transient {
            output: OutputTimes::At(Vec::new()),
            record: RecordedNodes::Nodes(Vec::new()),
            watch: Vec::new(),
            windows: Vec::new(),
            drawn: None,
            balance: None,
            tolerance,
            certify: false,
            ..self.settings.clone()
        }
    }

    /// The end of a cycle with proven bounds, around a start; with all
    /// requested results or none.
    pub(super) fn certified(
        &mut self,
        (start, tolerance): (Vec<f64>, f64),
        (around, results): (Around, bool),
    ) -> Result<Solution, PeriodicError> {
        let asked = match results {
            true => Transient { tolerance, ..self.settings.clone() },
            false => Transient { certified: None, ..self.bare(tolerance) },
        };
        let asked = Transient { certify: true, around: Some(around), ..asked };
        self.run(&asked, start).map(|(_, solution)| solution)
    }

    /// Integrates one cycle with all requested results, but to this tolerance in K.
    pub(super) fn record(
        &mut self,
        start: Vec<f64>,
        tolerance: f64,
    ) -> Result<(Shot, Solution), PeriodicError> {
        self.run(&Transient { tolerance, certify: false, ..self.settings.clone() }, start)
    }

    fn run(
        &mut self,
        settings: &Transient,
        start: Vec<f64>,
    ) -> Result<(Shot, Solution), PeriodicError> {
        let from = State::of_carried(self.bounded(start)).standing(self.stood.clone());
        let settings = &Transient { controls: self.controls.clone(), ..settings.clone() };
        let solution =
            settings.solve_from(self.system, &from, self.observer).map_err(PeriodicError::Cycle)?;
        self.steps += solution.statistics().steps;
        self.flow_evaluations += solution.statistics().flow_evaluations;
        if let RunStatus::Interrupted(_) = solution.end() {
            return Err(PeriodicError::Interrupted { cycles: self.count, residual: self.last });
        }
        self.count += 1;
        self.stood = solution.last_state().stood().to_vec();
        if self.system.network().has_events() {
            self.compare(settings, &solution);
        }
        let (start, end) = (from.carried().to_vec(), solution.last_state().carried().to_vec());
        let shot = Shot { start, end, noise: settings.tolerance };
        self.last = Some(shot.residual());
        Ok((shot, solution))
    }

    /// A start with each state of one's own between its bounds: beyond a bound its rate is zero, so
    /// that a cycle would lead back to any value.
    fn bounded(&self, mut start: Vec<f64>) -> Vec<f64> {
        self.bounds
            .iter()
            .for_each(|(i, [least, most])| start[*i] = start[*i].max(*least).min(*most));
        start
    }

    /// True if a state of one's own would begin a cycle beyond a bound.
    pub(super) fn leaves_bounds(&self, start: &[f64]) -> bool {
        self.bounds.iter().any(|(i, [least, most])| start[*i] < *least || start[*i] > *most)
    }

    /// True if a state of one's own is at a bound, to the tolerance.
    pub(super) fn is_at_bound(&self, state: &[f64]) -> bool {
        let near = |i: usize, bound: f64| (state[i] - bound).abs() <= self.settings.tolerance;
        self.bounds.iter().any(|(i, [least, most])| near(*i, *least) || near(*i, *most))
    }

    /// Compares the states of controls at the end with those at the start, their remaining dwell
    /// times, and the switches with those before.
    fn compare(&mut self, settings: &Transient, solution: &Solution) {
        let (network, period) = (self.system.network(), settings.stop - settings.start);
        let back = |state: &ControlState| ControlState { since: state.since - period, ..*state };
        let next: Vec<ControlState> = solution.controls().iter().map(back).collect();
        // the rest of the time for which each has to stay
        let rest = |(id, state): (ControlId, &ControlState)| {
            (state.since + network.min_dwell(id) - settings.start).max(0.0)
        };
        let stays = |states: &[ControlState]| -> Vec<f64> {
            network.control_ids().zip(states).map(rest).collect()
        };
        let (before, after) = (stays(&self.controls), stays(&next));
        let long = before
            .iter()
            .zip(&after)
            .all(|(a, b)| (a - b).abs() <= SAME_TIME * settings.tolerance * period);
        let on = |states: &[ControlState]| -> Vec<bool> {
            states.iter().map(|state| state.on).collect()
        };
        let limit = |event: &&Event| !matches!(event.kind, EventKind::Limit(_));
        let switched: Vec<(EventKind, u8)> =
            solution.events().iter().filter(limit).map(|event| (event.kind, event.after)).collect();
        self.same_times = long;
        self.repeats = on(&self.controls) == on(&next) && switched == self.switched;
        (self.controls, self.switched) = (next, switched);
    }
}

/// Times of controls that differ by at most this part of a cycle per K of tolerance are the same.
const SAME_TIME: f64 = 0.1;
