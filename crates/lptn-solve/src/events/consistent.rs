//! Steady states in which nothing has to switch.

use std::collections::HashSet;

use lptn_assembly::ThermalSystem;
use lptn_network::{InputError, Positions};

use crate::error::SteadyError;
use crate::events::{EventKind, Gates};
use crate::steady::SteadyState;
use crate::times::just_after;

/// The most positions that are tried.
const MOST: usize = 64;

/// Finds positions in whose steady state nothing has to switch. From the start on, everything that
/// has to switch does. If that returns to earlier positions, all other positions are tried in turn.
pub(crate) fn find(system: &ThermalSystem, time: f64) -> Result<SteadyState, SteadyError> {
    let mut search =
        Search { system, time, tried: HashSet::new(), failure: None, restless: Vec::new() };
    let mut next = Some(system.network().initial_positions());
    while let Some(positions) = next {
        match search.attempt(positions)? {
            Attempt::Settled(steady) => return Ok(*steady),
            Attempt::Leads(to) => next = Some(to),
            Attempt::Nowhere => break,
        }
    }
    for positions in every(system) {
        if let Attempt::Settled(steady) = search.attempt(positions)? {
            return Ok(*steady);
        }
    }
    Err(search.nothing())
}

/// All positions, as far as they are tried; the first ones count up like binary numbers.
fn every(system: &ThermalSystem) -> impl Iterator<Item = Positions> + use<> {
    let Positions { controls, switches } = system.network().initial_positions();
    let count = controls.len() + switches.len();
    let all = if count < 6 { 1_usize << count } else { MOST };
    (0..all).map(move |number| {
        let bit = |i: usize| i < 6 && number & (1 << i) != 0;
        Positions {
            controls: (0..controls.len()).map(bit).collect(),
            switches: (controls.len()..count).map(bit).collect(),
        }
    })
}

/// Result of one attempt.
enum Attempt {
    Settled(Box<SteadyState>),
    /// The switches that are due there lead to these positions.
    Leads(Positions),
    /// They were tried before, have no steady state, or too many were tried.
    Nowhere,
}

struct Search<'a> {
    system: &'a ThermalSystem,
    time: f64,
    tried: HashSet<(Vec<bool>, Vec<bool>)>,
    /// Reason why positions have no steady state at all.
    failure: Option<SteadyError>,
    /// Names of the elements that had to switch in the steady states of other positions.
    restless: Vec<String>,
}

impl Search<'_> {
    fn attempt(&mut self, positions: Positions) -> Result<Attempt, SteadyError> {
        let key = (positions.controls.clone(), positions.switches.clone());
        if self.tried.len() >= MOST || !self.tried.insert(key) {
            return Ok(Attempt::Nowhere);
        }
        let steady = match SteadyState::with_positions(self.system, self.time, &positions) {
            Ok(steady) => steady,
            Err(error) => {
                self.failure.get_or_insert(error);
                return Ok(Attempt::Nowhere);
            }
        };
        let beyond = self.beyond(&steady)?;
        if beyond.is_empty() {
            return Ok(Attempt::Settled(Box::new(steady)));
        }
        let mut next = positions;
        let controls = next.controls.len();
        for position in beyond {
            let kind = match position.checked_sub(controls) {
                None => {
                    next.controls[position] = !next.controls[position];
                    self.system.network().control_ids().nth(position).map(EventKind::Control)
                }
                Some(switch) => {
                    next.switches[switch] = !next.switches[switch];
                    self.system.network().switch_ids().nth(switch).map(EventKind::Comparison)
                }
            };
            self.restless.extend(kind.map(|kind| kind.name(self.system.network())));
        }
        Ok(Attempt::Leads(next))
    }

    /// Positions that have to switch in a steady state: controls, then comparisons.
    fn beyond(&self, steady: &SteadyState) -> Result<Vec<usize>, InputError> {
        let (system, gates) = (self.system, Gates::new(self.system));
        let mut work = system.workspace();
        work.set_positions(&steady.positions);
        system.read_inputs(&mut work, self.time, just_after(self.time))?;
        system.place(&mut work, &steady.temperatures);
        let mut excess = vec![0.0; gates.count()];
        gates.excess(system, &mut work, &mut excess)?;
        let beyond = excess.iter().enumerate().filter(|(_, excess)| **excess > 0.0);
        Ok(beyond.map(|(position, _)| position).collect())
    }

    fn nothing(mut self) -> SteadyError {
        if self.restless.is_empty()
            && let Some(failure) = self.failure
        {
            return failure;
        }
        self.restless.sort_unstable();
        self.restless.dedup();
        SteadyError::Cycles { names: self.restless, tried: self.tried.len() }
    }
}
