//! Switches inside a step, and the bounds of its errors.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{OdeSystem, Step};
use lptn_network::IntegratorChoice;

use super::{Break, Run};
use crate::events::{Crossings, Look, Stay, Switching, Trouble, find_crossings};
use crate::settings::Transient;
use crate::times::Segment;

impl Transient {
    /// The integrator: pieces of the run prove the times of switches, and the one-step method has
    /// none. A trajectory consists of polynomials or series.
    pub(super) fn integrator_for(&self, system: &ThermalSystem) -> IntegratorChoice {
        let switches = self.certify && system.network().has_events();
        match self.integrator {
            IntegratorChoice::Esdirk if self.trajectory && cfg!(feature = "cvodes") => {
                IntegratorChoice::Cvode
            }
            IntegratorChoice::Auto if switches && cfg!(feature = "cvodes") => {
                IntegratorChoice::Cvode
            }
            choice => choice,
        }
    }

    /// Parts between breakpoints that speak for a Runge-Kutta method. A trajectory has no curves of it.
    pub(super) fn parts(&self, segments: &[Segment]) -> usize {
        if self.trajectory { 0 } else { segments.len() }
    }
}

impl Run<'_> {
    /// Bounds the errors over a part of a step.
    pub(super) fn bound_errors(&mut self, part: (f64, f64), segment: Segment) {
        let Some(Ok(certifier)) = &mut self.certifier else { return };
        let controls = self.switching.as_ref().map_or_else(Vec::new, Switching::controls);
        let now = (segment, &controls[..]);
        if let Err(reason) = certifier.step(part, now, self.integrator.as_mut()) {
            self.certifier = Some(Err(reason));
        }
    }

    /// The events of a step.
    pub(super) fn crossings(&mut self, step: &Step) -> Result<Crossings, Break> {
        if self.switching.is_none() {
            return Ok(Crossings { due: Vec::new(), time: step.to, looks: Vec::new() });
        }
        find_crossings(self.integrator.as_mut(), step).map_err(|trouble| match trouble {
            Trouble::Integrator(error) => self.failed(error),
            Trouble::Stop(reason) => Break::Failed(reason),
        })
    }

    /// Watches how near a part of a step comes to thresholds.
    pub(super) fn watch_thresholds(&mut self, looks: &[Look], to: f64) {
        let Some(switching) = &mut self.switching else { return };
        let rooms = self.integrator.system().gates.rooms();
        let seen = looks.iter().take_while(|look| look.time <= to);
        let stays: Vec<Stay> = seen
            .flat_map(|look| switching.nearness.look(look.time, &look.excess, &rooms))
            .collect();
        self.judge_stays(&stays);
    }

    /// Judges the stays near a threshold that last until the present time, the end of the run.
    pub(super) fn end_stays(&mut self) {
        let time = self.integrator.time();
        let stays = self.switching.as_ref().map_or_else(Vec::new, |s| s.nearness.stop(time));
        self.judge_stays(&stays);
    }

    /// Judges stays by the rates that their element would change now.
    fn judge_stays(&mut self, stays: &[Stay]) {
        for stay in stays {
            let changes = self.other_rates(stay.position);
            self.judge(*stay, changes);
        }
    }

    /// Judges a stay whose element changes rates by up to `change` in K/s.
    fn judge(&mut self, stay: Stay, change: f64) {
        let (_, stop) = self.recorder.span();
        if let Some(switching) = &mut self.switching {
            switching.judge(stay, change, stop);
        }
    }

    /// The largest change of a rate in K/s if the element at this position were as it is not.
    fn other_rates(&mut self, position: usize) -> f64 {
        let Some(mut positions) = self.switching.as_ref().map(|s| s.positions.clone()) else {
            return 0.0;
        };
        let now = self.rates();
        let controls = positions.controls.len();
        let place = match position.checked_sub(controls) {
            None => &mut positions.controls[position],
            Some(switch) => &mut positions.switches[switch],
        };
        *place = !*place;
        self.integrator.system_mut().set_positions(&positions);
        let other = self.rates();
        if let Some(switching) = &self.switching {
            self.integrator.system_mut().set_positions(&switching.positions);
        }
        largest_change(&now, &other)
    }

    /// The rates of the states in K/s; NaN if they have no value.
    fn rates(&mut self) -> Vec<f64> {
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let heat = self.integrator.system_mut();
        let mut rates = vec![0.0; state.len()];
        match heat.flow(time, &state, &mut rates) {
            Ok(()) => rates.iter_mut().zip(heat.mass()).for_each(|(rate, mass)| *rate /= mass),
            Err(_) => rates.fill(f64::NAN),
        }
        rates
    }

    /// Switches what is due and everything that follows; true if anything changed.
    pub(super) fn switch(&mut self, due: &[usize], first: bool) -> Result<bool, Break> {
        if self.switching.is_none() {
            return Ok(false);
        }
        let stays = self.stays(due);
        let before = if stays.is_empty() { Vec::new() } else { self.rates() };
        let changed = self.switch_all(due, first)?;
        if !stays.is_empty() {
            let change = largest_change(&before, &self.rates());
            stays.into_iter().for_each(|stay| self.judge(stay, change));
        }
        Ok(changed)
    }

    /// The stays near a threshold that end because these positions switch.
    fn stays(&mut self, due: &[usize]) -> Vec<Stay> {
        let time = self.integrator.time();
        let Some(switching) = &mut self.switching else { return Vec::new() };
        due.iter().filter_map(|&position| switching.nearness.switch(position, time)).collect()
    }

    fn switch_all(&mut self, due: &[usize], first: bool) -> Result<bool, Break> {
        let Some(switching) = &mut self.switching else { return Ok(false) };
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let before = switching.positions.clone();
        let heat = self.integrator.system_mut();
        let switched = match first {
            true => switching.begin(heat, time, &state),
            false => switching.settle(heat, time, &state, due),
        };
        let changed = switching.positions != before;
        switched.map_err(Break::Failed).map(|()| changed)
    }
}

/// The largest difference of two lists of rates; infinite if one has no value.
fn largest_change(before: &[f64], after: &[f64]) -> f64 {
    let changes = before.iter().zip(after).map(|(before, after)| (after - before).abs());
    changes.map(|change| if change.is_nan() { f64::INFINITY } else { change }).fold(0.0, f64::max)
}
