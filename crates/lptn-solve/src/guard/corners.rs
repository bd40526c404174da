//! Kinks over temperature: the heat bends within a step by more than the tolerance allows.

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_integrate::{OdeSystem, Step};

use super::Stepping;
use crate::heat::Heat;

/// Samples of a step, its ends among them, and one beyond each end.
const SAMPLES: usize = 7;

/// The share of the tolerance by which a kink within a step may disturb a temperature.
const BORNE: f64 = 0.25;

/// A kink nearer to the start of a step than this share of it is at its start.
const AT_START: f64 = 0.02;

/// A kink is met exactly if the steps would have to be shorter than by this factor.
const SHORTER: f64 = 0.125;

/// Halvings in search of a kink.
const BISECTIONS: usize = 40;

/// The elements with kinks.
pub(super) struct Corners {
    elements: Vec<usize>,
    /// For each the pieces at the start of the step, and at its end.
    pieces: Vec<u64>,
    ahead: Vec<u64>,
    /// Heat capacity of each vertex in J/K; of a massless node that of the smallest.
    capacity: Vec<f64>,
    tolerance: f64,
}

/// The position of a bend of the heat.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Bend {
    /// Within the step, which has to end there, or be at most this long in s.
    In { kink: f64, longest: f64 },
    /// Just after it.
    Behind,
}

/// Temperatures of all vertices at some times of a step in K, with the times in s.
type Samples = [(f64, Vec<f64>); SAMPLES];

impl Corners {
    pub(super) fn of(system: &ThermalSystem, tolerance: f64) -> Self {
        let elements: Vec<usize> =
            (0..system.element_count()).filter(|&i| system.has_pieces(i)).collect();
        let network = system.network();
        let least = system.capacity().iter().copied().fold(f64::INFINITY, f64::min);
        let mut capacity = vec![least; network.nodes().len()];
        capacity.resize(network.nodes().len() + network.boundaries().len(), f64::INFINITY);
        for (id, own) in system.states().iter().zip(system.capacity()) {
            capacity[id.index()] = *own;
        }
        let count = elements.len();
        Self { elements, pieces: vec![0; count], ahead: vec![0; count], capacity, tolerance }
    }

    pub(super) fn are_none(&self) -> bool {
        self.elements.is_empty()
    }

    /// Takes the pieces of the state that was evaluated last.
    pub(super) fn begin(&mut self, heat: &mut Heat<'_>) {
        for (&element, pieces) in self.elements.iter().zip(&mut self.pieces) {
            *pieces = heat.pieces(element);
        }
    }

    /// The last step is accepted.
    pub(super) fn accept(&mut self) {
        self.pieces.copy_from_slice(&self.ahead);
    }

    /// True if an element is in another piece at the end of the last step than at its start.
    pub(super) fn has_changed(&self) -> bool {
        self.pieces != self.ahead
    }

    /// The bend of the heat within the step whose end was evaluated last, if there is one.
    pub(super) fn bend(
        &mut self,
        integrator: &mut Stepping<'_>,
        step: &Step,
        (ends, fresh): ([&[f64]; 2], bool),
    ) -> Option<Bend> {
        let mut changed = Vec::new();
        for (i, &element) in self.elements.iter().enumerate() {
            self.ahead[i] = integrator.system_mut().pieces(element);
            if self.ahead[i] != self.pieces[i] {
                changed.push(i);
            }
        }
        if changed.is_empty() || step.to <= step.from {
            return None;
        }
        let samples = samples(integrator, step, ends)?;
        let [before, within, behind] = self.disturbance(integrator, step, (&samples, &changed))?;
        let most = BORNE * self.tolerance;
        if within <= most && (fresh || before <= most) {
            return (behind > most).then_some(Bend::Behind);
        }
        let kink = self.first_kink(integrator, step, &changed);
        let length = step.to - step.from;
        let borne = (most / within.max(before)).sqrt();
        Some(if kink - step.from < AT_START * length && !fresh {
            Bend::In { kink: f64::INFINITY, longest: 0.5 * length }
        } else if borne > SHORTER {
            Bend::In { kink: f64::INFINITY, longest: 0.9 * borne * length }
        } else {
            Bend::In { kink, longest: f64::INFINITY }
        })
    }

    /// Disturbance of a temperature by the bends of some elements, in K, if they were missed:
    /// around the start of the step, within it and around its end. It follows from the fourth
    /// differences of their heat, which are small if it is smooth.
    fn disturbance(
        &self,
        integrator: &mut Stepping<'_>,
        step: &Step,
        (samples, changed): (&Samples, &[usize]),
    ) -> Option<[f64; 3]> {
        let heat = integrator.system_mut();
        let mut heats = vec![vec![0.0; self.capacity.len()]; SAMPLES];
        for ((time, temperatures), heats) in samples.iter().zip(&mut heats) {
            let elements = changed.iter().map(|&i| self.elements[i]);
            heat.heat_of(elements, (*time, temperatures), heats)?;
        }
        let length = step.to - step.from;
        let mut capacity = self.capacity.clone();
        let mut found = fourth_differences(&heats, (length, &capacity));
        if found.iter().any(|d| *d > BORNE * self.tolerance) {
            // heat that a vertex gives off during the step
            heat.add_slopes(length, &mut capacity);
            found = fourth_differences(&heats, (length, &capacity));
        }
        Some(found)
    }

    /// The time of the first kink in a step.
    fn first_kink(&self, integrator: &mut Stepping<'_>, step: &Step, changed: &[usize]) -> f64 {
        let (mut before, mut behind) = (step.from, step.to);
        let mut state = integrator.state().to_vec();
        for _ in 0..BISECTIONS {
            let middle = before.midpoint(behind);
            if !(before < middle && middle < behind) {
                break;
            }
            let read = integrator.interpolate(middle, &mut state).is_ok();
            let heat = integrator.system_mut();
            if !read || heat.look(middle, &state).is_none() {
                break;
            }
            let same = changed.iter().all(|&i| heat.pieces(self.elements[i]) == self.pieces[i]);
            if same { before = middle } else { behind = middle }
        }
        behind
    }
}

/// Temperatures at even distances, at both ends of a step and a quarter of it beyond them.
fn samples(
    integrator: &mut Stepping<'_>,
    step: &Step,
    [first, last]: [&[f64]; 2],
) -> Option<Samples> {
    let length = step.to - step.from;
    let time = |k: usize| step.from + (k as f64 - 1.0) * 0.25 * length;
    let mut state = integrator.state().to_vec();
    let mut inner = Vec::with_capacity(SAMPLES);
    inner.push(first.to_vec());
    for k in 2..5 {
        integrator.interpolate(time(k), &mut state).ok()?;
        inner.push(integrator.system_mut().look(time(k), &state)?.to_vec());
    }
    inner.push(last.to_vec());
    let beyond = |order: [usize; 5]| {
        let one = |i: usize| {
            let [a, b, c, d, e] = order.map(|k| inner[k][i]);
            5.0 * (a - d) - 10.0 * (b - c) + e
        };
        (0..first.len()).map(one).collect::<Vec<f64>>()
    };
    let (before, behind) = (beyond([0, 1, 2, 3, 4]), beyond([4, 3, 2, 1, 0]));
    let [a, b, c, d, e] = <[Vec<f64>; 5]>::try_from(inner).ok()?;
    let (from, to) = (step.from, step.to);
    Some([
        (from, before),
        (from, a),
        (time(2), b),
        (time(3), c),
        (time(4), d),
        (to, e),
        (to, behind),
    ])
}

/// The largest half of a fourth difference over capacities, from each of the first three samples.
fn fourth_differences(heats: &[Vec<f64>], (length, capacity): (f64, &[f64])) -> [f64; 3] {
    std::array::from_fn(|k| {
        let one = |i: usize| {
            let [a, b, c, d, e] = std::array::from_fn(|j| heats[k + j][i]);
            0.5 * (a + e - 4.0 * (b + d) + 6.0 * c).abs() * length / capacity[i]
        };
        (0..capacity.len()).map(one).fold(0.0, f64::max)
    })
}

impl Heat<'_> {
    /// Adds to the capacity of every node in J/K the heat per K that it gives off in `length` s.
    fn add_slopes(&mut self, length: f64, capacity: &mut [f64]) {
        let pattern = self.pattern().clone();
        let mut values = vec![0.0; pattern.len()];
        if self.jacobian_here(JacobianForm::Exact, &mut values).is_err() {
            return;
        }
        for (column, id) in self.system().unknowns().iter().enumerate() {
            let own = pattern.column(column).find(|slot| pattern.row_indices()[*slot] == column);
            if let Some(slot) = own {
                capacity[id.index()] += length * (-values[slot]).max(0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests;
