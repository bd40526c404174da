//! The adjoint at a switch.

use lptn_integrate::vectors::add;

use super::error::BackwardError;
use super::rate::Read;
use super::way::Way;
use crate::events::EventKind;
use crate::sensitive_run::step;
use crate::stencil::slope;
use crate::trajectory::{Cause, Turn};

impl Way<'_> {
    /// Goes back through the switch at the end of a stretch, if there is one.
    pub(super) fn turn(&mut self, stretch: usize) -> Result<(), BackwardError> {
        let Some(turn) = self.asked.trajectory.stretches[stretch].end.as_ref() else {
            return Ok(());
        };
        let time = turn.time;
        // at the switch a result of this moment moves as before it
        let arrives = self.aim.is_some_and(|aim| aim.stretch == stretch);
        let later = self.later(stretch)?;
        let (point, margin) = self.read(stretch, time)?;
        let mut moves = self.waits[stretch];
        if arrives {
            moves += self.rate((stretch, time), Read::Margin)?;
        } else {
            let jumps = self.moment().jumps(turn, point.at)?;
            moves -= jumps.iter().zip(&self.adjoint).map(|(jump, x)| jump * x).sum::<f64>();
            moves += later.map_or(0.0, |later| margin - later);
        }
        match turn.cause {
            Cause::Fixed => Ok(()),
            Cause::Dwell { control, began } => self.wait((control, began), moves),
            Cause::Crossing(position) => self.cross(stretch, (turn, position), moves),
        }
    }

    /// The margin just after a stretch, if it is integrated.
    fn later(&mut self, stretch: usize) -> Result<Option<f64>, BackwardError> {
        if self.aim.is_some() {
            return Ok(None);
        }
        let Some(next) = self.asked.trajectory.stretches.get(stretch + 1) else {
            return Ok(None);
        };
        Ok(Some(self.read(stretch + 1, next.span().0)?.1))
    }

    /// The dwell of a control ends: its time moves as the switch at which it began, and with its
    /// length.
    fn wait(
        &mut self,
        (control, began): (usize, Option<usize>),
        moves: f64,
    ) -> Result<(), BackwardError> {
        if let Some(began) = began {
            self.waits[began] += moves;
        }
        let system = self.asked.margin.system;
        let network = system.network();
        let Some(id) = network.control_ids().nth(control) else { return Ok(()) };
        let Some(dwell) = network.thermostat(id).map(|of| &of.min_dwell) else { return Ok(()) };
        for (found, &parameter) in self.found.iter_mut().zip(self.asked.parameters) {
            if !network.depends_on(dwell, &[parameter]) {
                continue;
            }
            let own = network.parameter_value(parameter);
            let by = slope(step(network, parameter), |change| -> Result<f64, BackwardError> {
                let mut changed = network.given();
                changed.set(parameter, own + change);
                Ok(system.with(&changed)?.network().min_dwell(id))
            })?;
            *found += moves * by.unwrap_or(f64::NAN);
        }
        Ok(())
    }

    /// A threshold is reached; `moves` is the change of the result with the time of the switch.
    fn cross(
        &mut self,
        stretch: usize,
        (turn, position): (&Turn, usize),
        moves: f64,
    ) -> Result<(), BackwardError> {
        let network = self.asked.margin.system.network();
        let Some(kind) = EventKind::switching(network).nth(position) else { return Ok(()) };
        let name = kind.name(network);
        let speed = self.rate((stretch, turn.time), Read::Excess(kind))?;
        let (point, _) = self.read(stretch, turn.time)?;
        let weights = self.moment().excess_by_nodes(kind, &name)?;
        let mut instant = self.moment().instant(&weights)?;
        let parameters = self.asked.parameters;
        let follows = self.moment().excess_follows(kind, parameters);
        if let Some(positions) = point.positions.as_ref().filter(|_| follows) {
            for (by, &parameter) in instant.parameters.iter_mut().zip(self.asked.parameters) {
                *by += self.integrator.system().moment.excess_by((kind, positions), parameter)?;
            }
        }
        let factor = -moves / speed;
        if !factor.is_finite() {
            return Err(BackwardError::Grazes { name, time: turn.time });
        }
        add(&mut self.adjoint, factor, &instant.states);
        add(&mut self.found, factor, &instant.parameters);
        Ok(())
    }
}
