//! Positions of everything that switches in a run, and checks that the run still makes progress.
//!
//! Conditions are read at the start, after every event, at jumps of inputs and at the end of a
//! dwell, until nothing has to switch.
//!
//! The integrator gets a hundredth of the tolerance if something switches, because an error in the
//! time of one switch moves all later ones. A hundred switches with a remote sensor then stay
//! within ten tolerances. Beyond that, a run reports that its error is not bounded.

use lptn_assembly::ThermalSystem;
use lptn_network::{End, Network, Positions};

use crate::events::gates::stops;
use crate::events::{ControlState, Event, EventKind, Gates, Nearness, Stay, Undecided};
use crate::heat::Heat;
use crate::stop_reason::StopReason;

/// The most rounds of switches that cause others at one moment.
const ROUNDS: usize = 64;

/// The most changes of one comparison between two rows.
const CHATTER: usize = 20;

/// Parts of a run in which changes are counted if rows are rare.
const PARTS: f64 = 300.0;

/// The most events of a run.
const MOST_EVENTS: usize = 1_000_000;

/// The positions in a run and how they came about.
pub(crate) struct Switching<'a> {
    network: &'a Network,
    pub(crate) positions: Positions,
    /// Time of the last switch of each control, in s.
    since: Vec<f64>,
    gates: Gates,
    excess: Vec<f64>,
    tolerance: f64,
    pub(crate) events: Vec<Event>,
    /// For each comparison how often it changed since the last row.
    changes: Vec<usize>,
    /// The part of the run that was reached.
    part: f64,
    /// Kind of each position: controls, then comparisons.
    kinds: Vec<EventKind>,
    pub(crate) nearness: Nearness,
    /// The first switch that the error of the run decides.
    pub(crate) undecided: Option<Undecided>,
}

/// True if the moment of a switch depends on computed temperatures. A state at its bound does not
/// count: it stops there by its own rate, which changes nothing else at once.
fn is_computed(network: &Network, kind: EventKind) -> bool {
    match kind {
        EventKind::Control(id) => {
            network.thermostat(id).is_none_or(|of| !matches!(of.sense, End::Boundary(_)))
        }
        EventKind::Comparison(id) => !stops(network, id),
        EventKind::Limit(_) => false,
    }
}

impl<'a> Switching<'a> {
    /// Begins with these states of the controls, or with those of the network if there are none.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        controls: &[ControlState],
        tolerance: f64,
    ) -> Self {
        let (network, gates) = (system.network(), Gates::new(system));
        let kinds: Vec<EventKind> = EventKind::switching(network).collect();
        let mut positions = network.initial_positions();
        let mut since = vec![f64::NEG_INFINITY; positions.controls.len()];
        for ((on, since), state) in positions.controls.iter_mut().zip(&mut since).zip(controls) {
            (*on, *since) = (state.on, state.since);
        }
        Self {
            network,
            positions,
            since,
            gates,
            excess: vec![0.0; kinds.len()],
            tolerance,
            events: Vec::new(),
            changes: vec![0; network.switches().len()],
            part: 0.0,
            nearness: Nearness::new(kinds.iter().map(|kind| is_computed(network, *kind)).collect()),
            undecided: None,
            kinds,
        }
    }

    /// Notes the first stay near a threshold that matters: see [`Stay::matters`].
    pub(crate) fn judge(&mut self, stay: Stay, change: f64, stop: f64) {
        let kind = self.kinds[stay.position];
        if self.undecided.is_none() {
            self.undecided = stay.matters(change, (stop, self.tolerance), kind);
        }
    }

    /// Finds the positions at the start: comparisons as they are, controls outside their dead band
    /// by their condition.
    pub(crate) fn begin(
        &mut self,
        heat: &mut Heat<'_>,
        time: f64,
        state: &[f64],
    ) -> Result<(), StopReason> {
        self.arm(time);
        let controls = self.positions.controls.len();
        let mut changed = Vec::new();
        for _ in 0..ROUNDS {
            self.install(heat);
            let holds = heat.comparisons(time, state)?;
            let differ = holds
                .iter()
                .zip(&self.positions.switches)
                .enumerate()
                .filter(|(_, (now, was))| now != was);
            changed = differ.map(|(switch, _)| controls + switch).collect();
            if changed.is_empty() {
                return self.settle(heat, time, state, &[]);
            }
            self.positions.switches = holds;
        }
        Err(self.restless(&changed))
    }

    /// Switches what is due, by its position, and all that follows from it at the same moment.
    pub(crate) fn settle(
        &mut self,
        heat: &mut Heat<'_>,
        time: f64,
        state: &[f64],
        due: &[usize],
    ) -> Result<(), StopReason> {
        let mut flips = due.to_vec();
        for _ in 0..ROUNDS {
            flips.iter().for_each(|&position| self.flip(position, time));
            self.arm(time);
            self.install(heat);
            heat.set_margins(time, state, self.tolerance)?;
            self.gates.margins.clone_from(&heat.gates.margins);
            heat.excess(time, state, &mut self.excess)?;
            let beyond = self.excess.iter().enumerate().filter(|(_, excess)| **excess > 0.0);
            let next: Vec<usize> = beyond.map(|(position, _)| position).collect();
            if next.is_empty() {
                return self.check_count();
            }
            flips = next;
        }
        Err(self.restless(&flips))
    }

    fn flip(&mut self, position: usize, time: f64) {
        // one that follows from another has no stay of its own
        self.nearness.switch(position, time);
        let state = match position.checked_sub(self.positions.controls.len()) {
            None => {
                self.since[position] = time;
                &mut self.positions.controls[position]
            }
            Some(switch) => {
                self.changes[switch] += 1;
                &mut self.positions.switches[switch]
            }
        };
        *state = !*state;
        self.events.push(Event::new(time, self.kinds[position], *state));
    }

    fn install(&self, heat: &mut Heat<'_>) {
        heat.set_positions(&self.positions);
        heat.gates.clone_from(&self.gates);
    }

    /// Arms the controls whose time to stay is over.
    fn arm(&mut self, time: f64) {
        for (i, id) in self.network.control_ids().enumerate() {
            self.gates.armed[i] = time >= self.since[i] + self.network.min_dwell(id);
        }
    }

    /// The next time after `time` at which a control may switch again.
    pub(crate) fn next_armed(&self, time: f64) -> f64 {
        let ends = self.network.control_ids().zip(&self.since);
        let ends =
            ends.map(|(id, since)| since + self.network.min_dwell(id)).filter(|end| *end > time);
        ends.fold(f64::INFINITY, f64::min)
    }

    /// The control whose dwell ends at a time of [`Switching::next_armed`].
    pub(crate) fn control_armed_at(&self, time: f64) -> Option<usize> {
        let ends = self.network.control_ids().zip(&self.since);
        let mut ends = ends.map(|(id, since)| since + self.network.min_dwell(id));
        ends.position(|end| (end - time).abs() <= 0.0)
    }

    /// The name of a position.
    pub(crate) fn name(&self, position: usize) -> String {
        self.kinds[position].name(self.network)
    }

    /// The states of the controls.
    pub(crate) fn controls(&self) -> Vec<ControlState> {
        let states = self.positions.controls.iter().zip(&self.since);
        states.map(|(&on, &since)| ControlState { on, since }).collect()
    }

    /// The run goes on to `time`. Changes before a row no longer count, nor, if rows are rare,
    /// those before the present part of the run.
    pub(crate) fn reach(&mut self, time: f64, (start, stop): (f64, f64), row: bool) {
        let part = (PARTS * (time - start) / (stop - start)).floor();
        if row || part > self.part {
            self.part = part;
            self.changes.fill(0);
        }
    }

    /// Refuses a run that makes no more progress.
    fn check_count(&self) -> Result<(), StopReason> {
        if let Some(switch) = self.changes.iter().position(|&changes| changes > CHATTER) {
            let name = self.kinds[self.positions.controls.len() + switch].name(self.network);
            let at = &self.network.switches()[switch];
            let place = (at.item, at.field);
            return Err(StopReason::Chatter { name, changes: self.changes[switch], place });
        }
        match self.events.len() {
            0..MOST_EVENTS => Ok(()),
            count => Err(StopReason::TooManyEvents { count }),
        }
    }

    /// Error of elements that switch back and forth at one moment.
    fn restless(&self, flips: &[usize]) -> StopReason {
        let names = flips.iter().map(|&position| self.kinds[position].name(self.network));
        StopReason::Restless { names: names.collect() }
    }
}
