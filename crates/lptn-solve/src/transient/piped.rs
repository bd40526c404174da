//! Pipes with plug flow during a run.

use std::cell::RefCell;
use std::rc::Rc;

use lptn_assembly::ThermalSystem;

use crate::heat::Heat;
use crate::interval::{NODES, POINTS, polynomial, time_of};
use crate::newton_error::NewtonError;
use crate::pipe::{Entering, Filled, Leaving, Pipes, Shared, vertices};
use crate::recorder::Recorder;
use crate::state::State;
use crate::transient::{Break, Care, Run};

/// Halvings of a stretch between two points of a step in search of a reversal.
const HALVINGS: usize = 60;

/// The pipes of a run, read by the integrator and by the recorder. The way to a steady state knows
/// none: there the fluid leaves as it enters.
pub(super) fn attach(
    system: &ThermalSystem,
    (heat, recorder): (&mut Heat<'_>, &mut Recorder<'_>),
    (from, tolerance, care): (&State, f64, Care),
) -> Result<Option<Shared>, NewtonError> {
    let pipes = Pipes::of(system, from.contents(), tolerance).filter(|_| care != Care::Way);
    let Some(pipes) = pipes else { return Ok(None) };
    let shared = Rc::new(RefCell::new(pipes));
    heat.read_pipes(&shared)?;
    recorder.read_pipes(&shared)?;
    Ok(Some(shared))
}

impl Run<'_> {
    /// The latest end of the next step for pipes, up to `stop`, and its greatest length in s.
    pub(super) fn hold_for_pipes(&mut self, stop: f64) -> Result<(f64, f64), Break> {
        let Some(pipes) = &self.pipes else { return Ok((stop, f64::INFINITY)) };
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let mut rates = vec![0.0; state.len()];
        let heat = self.integrator.system_mut();
        heat.flow_at(time, &state, &mut rates).map_err(Break::Failed)?;
        rates.iter_mut().zip(heat.capacities()).for_each(|(rate, capacity)| *rate /= capacity);
        let [jump, longest] = pipes.borrow().horizon((time, &state), &rates);
        Ok((if jump > time { stop.min(jump) } else { stop }, longest))
    }

    /// The time in s that a step reaches, up to `to`, before an edge leaves a pipe or its flow
    /// reverses; the edge if one leaves there.
    pub(super) fn pipes_reach(
        &mut self,
        from: f64,
        to: f64,
    ) -> Result<(f64, Option<Leaving>), Break> {
        let Some(pipes) = self.pipes.clone() else { return Ok((to, None)) };
        let pipes = pipes.borrow();
        let mut end = to;
        for pipe in pipes.filled() {
            let passed = self.passed((from, to), pipe.state)?;
            end = end.min(first_turn((from, to), &passed).unwrap_or(to));
        }
        let mut leaves = None;
        for pipe in pipes.filled() {
            if let Some((time, edge)) = self.next_to_leave(pipe, (from, end))? {
                (end, leaves) = (time, Some(edge));
            }
        }
        Ok((end, leaves))
    }

    /// The next edge that leaves a pipe between two times in s, and the time.
    fn next_to_leave(
        &mut self,
        pipe: &Filled,
        (from, to): (f64, f64),
    ) -> Result<Option<(f64, Leaving)>, Break> {
        let mut state = self.integrator.state().to_vec();
        let mut passed = |run: &mut Self, time: f64| {
            run.integrator.interpolate(time, &mut state).map_err(|e| run.failed(e))?;
            Ok(state[pipe.state])
        };
        let (start, end) = (passed(self, from)?, passed(self, to)?);
        let reversed = end < start;
        let Some(edge) = pipe.content.next_edge(reversed) else { return Ok(None) };
        if start.to_bits() == end.to_bits() || !pipe.content.has_come(edge, end, reversed) {
            return Ok(None);
        }
        let (mut before, mut after) = (from, to);
        while after - before > 2.0 * f64::EPSILON * after.abs().max(to - from) {
            let middle = 0.5 * (before + after);
            match pipe.content.has_come(edge, passed(self, middle)?, reversed) {
                true => after = middle,
                false => before = middle,
            }
        }
        Ok(Some((after, edge)))
    }

    /// The values of a state at the points of a step.
    fn passed(&mut self, step: (f64, f64), state: usize) -> Result<[f64; POINTS], Break> {
        let mut values = [0.0; POINTS];
        let mut all = self.integrator.state().to_vec();
        for (point, value) in values.iter_mut().enumerate() {
            let read = self.integrator.interpolate(time_of(step, point), &mut all);
            read.map_err(|e| self.failed(e))?;
            *value = all[state];
        }
        Ok(values)
    }

    /// Fills the pipes with the fluid that entered between two times of the last step.
    pub(super) fn fill_pipes(&mut self, from: f64, to: f64) -> Result<(), Break> {
        let Some(pipes) = self.pipes.clone() else { return Ok(()) };
        let known = pipes.borrow();
        let filled = known.filled();
        let nothing = Entering { passed: [0.0; POINTS], temperatures: [0.0; POINTS] };
        let mut entering = vec![nothing; filled.len()];
        let mut state = self.integrator.state().to_vec();
        self.integrator.interpolate(to, &mut state).map_err(|e| self.failed(e))?;
        let back = |pipe: &Filled| state[pipe.state] < pipe.content.passed();
        let reversed: Vec<bool> = filled.iter().map(back).collect();
        for point in 0..POINTS {
            let time = time_of((from, to), point);
            self.integrator.interpolate(time, &mut state).map_err(|e| self.failed(e))?;
            let heat = self.integrator.system_mut();
            let system = heat.system();
            let (_, work) = heat.temperatures(time, &state).map_err(Break::Failed)?;
            let vertices = vertices(system, work);
            for ((pipe, entering), reversed) in filled.iter().zip(&mut entering).zip(&reversed) {
                entering.passed[point] = state[pipe.state];
                entering.temperatures[point] = pipe.entering(&vertices, *reversed);
            }
        }
        drop(known);
        pipes.borrow_mut().enter(entering, std::mem::take(&mut self.bends));
        Ok(())
    }
}

/// The first time in s inside a step at which a curve through its points turns.
fn first_turn(step: (f64, f64), values: &[f64; POINTS]) -> Option<f64> {
    let slope = |x: f64| {
        let h = 1e-5;
        polynomial(values, (x + h).min(1.0)) - polynomial(values, (x - h).max(-1.0))
    };
    let changes = values.windows(2).map(|pair| pair[1] - pair[0]);
    let largest = changes.clone().fold(0.0, |most: f64, change| most.max(change.abs()));
    let signs: Vec<f64> = changes.filter(|change| change.abs() > 1e-9 * largest).collect();
    let first = signs.first()?.signum();
    let turns = signs.iter().any(|change| change * first < 0.0);
    if !turns {
        return None;
    }
    let after = (1..POINTS).find(|&i| (values[i] - values[i - 1]) * first < -1e-9 * largest)?;
    let (mut a, mut b) = (NODES[after.saturating_sub(2)], NODES[after]);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (a + b);
        match slope(middle) * first > 0.0 {
            true => a = middle,
            false => b = middle,
        }
    }
    let time = step.0 + 0.5 * (b + 1.0) * (step.1 - step.0);
    (time > step.0 && time < step.1).then_some(time)
}
