//! An island without streams between its nodes: every mode responds by itself in closed form.

use super::inputs::Panel;
use super::legendre::{TERMS, responses};
use super::reduced::Reduced;
use super::spectrum::Island;

/// An island with the effects of the inputs on its modes.
pub(crate) struct Modal {
    island: Island,
    /// Mode (row) per unit of each input (column).
    drive: Vec<Vec<f64>>,
    /// Amplitude of each mode.
    amplitude: Vec<f64>,
}

impl Modal {
    pub(crate) fn new(island: Island, reduced: &Reduced, rises: &[f64]) -> Self {
        let project = |k: usize, value: &dyn Fn(usize) -> f64| -> f64 {
            let members = island.members.iter().enumerate();
            members.map(|(row, &state)| island.shapes[(row, k)] * value(state)).sum()
        };
        let modes = 0..island.rates.len();
        let inputs = reduced.feeds.ncols();
        let drive =
            |k| (0..inputs).map(|i| project(k, &|state| reduced.feeds[(state, i)])).collect();
        let amplitude = |k| project(k, &|state| reduced.capacity[state] * rises[state]);
        Self {
            drive: modes.clone().map(drive).collect(),
            amplitude: modes.map(amplitude).collect(),
            island,
        }
    }

    pub(crate) fn step(&mut self, panel: &Panel, length: f64) {
        let mut weights = [0.0; TERMS];
        let weights = &mut weights[..panel.terms()];
        let Self { island, drive, amplitude } = self;
        for ((rate, drive), y) in island.rates.iter().zip(drive).zip(amplitude) {
            *y *= (-*rate * length).exp();
            if weights.is_empty() {
                continue;
            }
            responses(0.5 * *rate * length, weights);
            let answer = |series: &Vec<f64>| -> f64 {
                series.iter().zip(&*weights).map(|(c, w)| c * w).sum()
            };
            let heat: f64 =
                panel.series.iter().zip(drive).map(|(series, f)| *f * answer(series)).sum();
            *y += length * heat;
        }
    }

    /// Forgets everything that a boundary takes: from this start the effect of a cycle shows.
    pub(crate) fn forget(&mut self) {
        let forgetful = self.island.rates.iter().zip(&mut self.amplitude);
        forgetful.filter(|(rate, _)| **rate > 0.0).for_each(|(_, y)| *y = 0.0);
    }

    /// See [`super::march::March::repeat`].
    pub(crate) fn repeat(&mut self, period: f64) {
        let forgetful = self.island.rates.iter().zip(&mut self.amplitude);
        forgetful
            .filter(|(rate, _)| **rate > 0.0)
            .for_each(|(rate, y)| *y /= -(-rate * period).exp_m1());
    }

    /// Its slowest rate above 0 in 1/s.
    pub(crate) fn slowest(&self) -> f64 {
        let rates = self.island.rates.iter().copied().filter(|rate| *rate > 0.0);
        rates.fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn add_rises(&self, sum: &mut [f64]) {
        self.superpose(sum, |k| self.amplitude[k]);
    }

    /// The rates of change of the modes.
    pub(crate) fn add_slopes(&self, inputs: &[f64], sum: &mut [f64]) {
        self.superpose(sum, |k| {
            let heat: f64 = self.drive[k].iter().zip(inputs).map(|(f, u)| f * u).sum();
            heat - self.island.rates[k] * self.amplitude[k]
        });
    }

    /// Adds the modes times `value` of each.
    fn superpose(&self, sum: &mut [f64], value: impl Fn(usize) -> f64) {
        for k in 0..self.amplitude.len() {
            let y = value(k);
            for (row, &state) in self.island.members.iter().enumerate() {
                sum[state] += self.island.shapes[(row, k)] * y;
            }
        }
    }

    /// The largest effect of heat into each state in W for `duration` in s on a member.
    pub(crate) fn largest_rise(&self, duration: f64, heat: &[f64]) -> f64 {
        let mut weight = [0.0];
        let members = &self.island.members;
        let mut rises = vec![0.0; members.len()];
        for (k, rate) in self.island.rates.iter().enumerate() {
            let of_state = |(row, &i): (usize, &usize)| self.island.shapes[(row, k)] * heat[i];
            let heat: f64 = members.iter().enumerate().map(of_state).sum();
            responses(0.5 * rate * duration, &mut weight);
            let answer = (heat * duration * weight[0]).abs();
            let add = |(row, rise): (usize, &mut f64)| {
                *rise += answer * self.island.shapes[(row, k)].abs()
            };
            rises.iter_mut().enumerate().for_each(add);
        }
        rises.into_iter().fold(0.0, f64::max)
    }
}
