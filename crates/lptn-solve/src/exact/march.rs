//! From row to row: every mode answers to the inputs of a panel in closed form.

use lptn_network::InputError;

use super::ExactError;
use super::inputs::{Inputs, Panel};
use super::legendre::{TERMS, responses};
use super::reduced::Reduced;
use super::spectrum::Island;

/// What the series in place of the inputs may cost, in K.
const TARGET: f64 = 1e-10;

/// Panels in all; more are a sign of an input that no series follows.
const MOST_PANELS: u64 = 5_000_000;

/// Panels at least, where a series stands for an input.
const LEAST_PANELS: f64 = 300.0;

/// An island with what the inputs do to its modes.
struct Driven<'a> {
    island: &'a Island,
    /// Mode (row) per unit of each input (column).
    drive: Vec<Vec<f64>>,
    /// Amplitude of each mode.
    amplitude: Vec<f64>,
}

/// What one unit of an input's error can do to a temperature.
#[derive(Clone, Copy)]
struct Gain {
    /// K per unit that lasts.
    lasting: f64,
    /// K/s per unit, at the node it acts on first.
    at_once: f64,
}

pub(crate) struct March<'a> {
    reduced: &'a Reduced,
    inputs: Inputs<'a>,
    islands: Vec<Driven<'a>>,
    gains: Vec<Gain>,
    duration: f64,
    panels: u64,
    /// No panel is longer where a series stands for an input: what is between its points might be
    /// missed.
    longest: f64,
    /// Largest error of the series so far, in K: that of panels on which it lasts, and the sum of
    /// those on which it is made short instead.
    lasting: f64,
    summed: f64,
}

impl<'a> March<'a> {
    /// Starts from the rises of the states over the reference of the inputs.
    pub(crate) fn new(
        inputs: Inputs<'a>,
        (reduced, islands): (&'a Reduced, &'a [Island]),
        rises: &[f64],
        duration: f64,
    ) -> Self {
        let driven = |island| Driven::new(island, reduced, rises);
        let islands: Vec<Driven<'a>> = islands.iter().map(driven).collect();
        let columns = 0..reduced.feeds.ncols();
        let gains = columns.map(|i| gain(reduced, &islands, i, duration)).collect();
        let longest =
            if inputs.need_quadrature() { duration / LEAST_PANELS } else { f64::INFINITY };
        Self {
            reduced,
            inputs,
            islands,
            gains,
            duration,
            panels: 0,
            longest,
            lasting: 0.0,
            summed: 0.0,
        }
    }

    /// Enters a segment: comparisons of `t` are read inside it.
    pub(crate) fn enter(&mut self, inside: f64) {
        self.inputs.inside = inside;
    }

    /// All inputs at a time.
    pub(crate) fn inputs(&mut self, time: f64) -> Result<Vec<f64>, InputError> {
        self.inputs.at(time)
    }

    /// What series in place of inputs may have cost so far, in K; `None` where every input is
    /// constant or a straight line, so that there is no such error.
    pub(crate) fn series_error(&self) -> Option<f64> {
        self.inputs.need_quadrature().then_some(self.lasting + self.summed)
    }

    /// Goes on to a later time of the same segment, in as many panels as the inputs need.
    pub(crate) fn advance(&mut self, from: f64, to: f64) -> Result<(), ExactError> {
        let mut open = vec![(from, to)];
        while let Some((from, to)) = open.pop() {
            self.panels += 1;
            let panel = self.inputs.panel((from, to))?;
            let middle = 0.5 * (from + to);
            let divisible = from < middle && middle < to;
            if !divisible || self.accepts(&panel, to - from) {
                self.step(&panel, to - from);
            } else if self.panels < MOST_PANELS {
                open.extend([(middle, to), (from, middle)]);
            } else {
                return Err(ExactError::Quadrature { time: from });
            }
        }
        Ok(())
    }

    /// Whether the series are good enough: they cost little however long, or so little in this
    /// short time.
    fn accepts(&mut self, panel: &Panel, length: f64) -> bool {
        if length > self.longest {
            return false;
        }
        let sum = |gain: &dyn Fn(&Gain) -> f64| -> f64 {
            panel.errors.iter().zip(&self.gains).map(|(error, g)| error * gain(g)).sum()
        };
        let lasting = sum(&|g| g.lasting);
        let short = sum(&|g| g.at_once * length);
        if lasting <= TARGET {
            self.lasting = self.lasting.max(lasting);
        } else if short <= 1e-3 * TARGET {
            self.summed += short;
        } else {
            return false;
        }
        true
    }

    fn step(&mut self, panel: &Panel, length: f64) {
        let mut weights = [0.0; TERMS];
        let weights = &mut weights[..panel.terms()];
        for Driven { island, drive, amplitude } in &mut self.islands {
            for ((rate, drive), y) in island.rates.iter().zip(drive).zip(amplitude) {
                *y *= (-rate * length).exp();
                if weights.is_empty() {
                    continue;
                }
                responses(0.5 * rate * length, weights);
                let answer = |series: &Vec<f64>| -> f64 {
                    series.iter().zip(&*weights).map(|(c, w)| c * w).sum()
                };
                let heat: f64 =
                    panel.series.iter().zip(drive).map(|(series, f)| *f * answer(series)).sum();
                *y += length * heat;
            }
        }
    }

    /// Forgets everything that a boundary takes: a start from which a cycle shows what it brings.
    pub(crate) fn forget(&mut self) {
        for Driven { island, amplitude, .. } in &mut self.islands {
            island
                .rates
                .iter()
                .zip(amplitude)
                .filter(|(rate, _)| **rate > 0.0)
                .for_each(|(_, y)| *y = 0.0);
        }
    }

    /// After a cycle of `period` in s from [`March::forget`]: the amplitudes that it leads back to.
    /// With what the cycle brings, c, they obey `y = exp(-r period) y + c`.
    pub(crate) fn repeat(&mut self, period: f64) {
        for Driven { island, amplitude, .. } in &mut self.islands {
            let forgetful = island.rates.iter().zip(amplitude).filter(|(rate, _)| **rate > 0.0);
            forgetful.for_each(|(rate, y)| *y /= -(-rate * period).exp_m1());
        }
    }

    /// Rises of the states.
    pub(crate) fn rises(&self) -> Vec<f64> {
        self.superposed(|island, k| island.amplitude[k])
    }

    /// What is wrong with the modes, in K: the rates of change that they give at `time` are put
    /// into the heat balance of every node, path by path, and what is left over is taken as heat
    /// that lasts for the whole run. An eigenvector or a rate that is off shows here, whatever the
    /// reason.
    pub(crate) fn defect(&mut self, time: f64) -> Result<f64, InputError> {
        let inputs = self.inputs.at(time)?;
        let rises = self.rises();
        let slopes = self.superposed(|island, k| {
            let heat: f64 = island.drive[k].iter().zip(&inputs).map(|(f, u)| f * u).sum();
            heat - island.island.rates[k] * island.amplitude[k]
        });
        let boundaries = self.inputs.boundaries();
        let mut left: Vec<f64> =
            slopes.iter().zip(&self.reduced.capacity).map(|(slope, c)| -c * slope).collect();
        for &(a, b, g) in &self.reduced.links {
            let heat = g * (rises[a] - rises[b]);
            left[a] -= heat;
            left[b] += heat;
        }
        for (i, left) in left.iter_mut().enumerate() {
            for (j, u) in inputs.iter().enumerate() {
                let u = if j < boundaries { u - rises[i] } else { *u };
                *left += self.reduced.feeds[(i, j)] * u;
            }
        }
        let rise = |island: &Driven<'_>| {
            let members = &island.island.members;
            island.largest_rise(self.duration, |k| {
                members
                    .iter()
                    .enumerate()
                    .map(|(row, &i)| island.island.shapes[(row, k)] * left[i])
                    .sum()
            })
        };
        Ok(self.islands.iter().map(rise).fold(0.0, f64::max))
    }

    /// The modes times what `value` gives for each.
    fn superposed(&self, value: impl Fn(&Driven<'_>, usize) -> f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.reduced.states.len()];
        for island in &self.islands {
            for k in 0..island.amplitude.len() {
                let y = value(island, k);
                for (row, &state) in island.island.members.iter().enumerate() {
                    sum[state] += island.island.shapes[(row, k)] * y;
                }
            }
        }
        sum
    }
}

impl<'a> Driven<'a> {
    fn new(island: &'a Island, reduced: &Reduced, rises: &[f64]) -> Self {
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
            island,
            drive: modes.clone().map(drive).collect(),
            amplitude: modes.map(amplitude).collect(),
        }
    }

    /// The most that `heat` into each mode for `duration` can do to a member.
    fn largest_rise(&self, duration: f64, heat: impl Fn(usize) -> f64) -> f64 {
        let mut weight = [0.0];
        let mut rises = vec![0.0; self.island.members.len()];
        for (k, rate) in self.island.rates.iter().enumerate() {
            responses(0.5 * rate * duration, &mut weight);
            let answer = (heat(k) * duration * weight[0]).abs();
            let add = |(row, rise): (usize, &mut f64)| {
                *rise += answer * self.island.shapes[(row, k)].abs()
            };
            rises.iter_mut().enumerate().for_each(add);
        }
        rises.into_iter().fold(0.0, f64::max)
    }
}

fn gain(reduced: &Reduced, islands: &[Driven<'_>], input: usize, duration: f64) -> Gain {
    let lasting = islands
        .iter()
        .map(|island| island.largest_rise(duration, |k| island.drive[k][input]))
        .fold(0.0, f64::max);
    let states = 0..reduced.states.len();
    let at_once =
        states.map(|i| reduced.feeds[(i, input)] / reduced.capacity[i]).fold(0.0, f64::max);
    Gain { lasting, at_once }
}
