//! Response to a step of a network whose modes coincide: by the exponential of its matrix.

use faer::Mat;

use crate::exact::{Chain, Wanted};
use crate::linearised::{Linearised, LinearisedError};

/// Rises of the states after a step, without modes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CarriedAnswer {
    /// A in 1/s, and the amount by which each row sums to less than 0, if its other elements are
    /// not negative.
    rates: Mat<f64>,
    leak: Option<Vec<f64>>,
    /// Rates of change at the step in K/s per unit.
    start: Mat<f64>,
    /// Covers all times in which something changes.
    chain: Chain,
    longest: f64,
    /// Temperature of each node (row) that follows from those of the states.
    nodes: Mat<f64>,
}

/// Doublings of the fastest time after which everything has to be over, tried in this order.
const DOUBLINGS: [i32; 5] = [10, 20, 30, 40, 50];

/// The share of a rise that may be left then.
const LEFT: f64 = 1e-9;

impl CarriedAnswer {
    /// With the rises of the states that stay; `None` if they are never reached.
    pub(super) fn new(
        linear: &Linearised<'_>,
        settled: &[f64],
    ) -> Result<Option<Self>, LinearisedError> {
        let (jacobian, follow) = linear.dense()?;
        let size = settled.len();
        let rates = Mat::from_fn(size, size, |i, j| jacobian[(i, j)] / linear.capacity()[i]);
        let leak = leak(&rates);
        let row = |i: usize| (0..size).map(|j| rates[(i, j)] * settled[j]).sum::<f64>();
        let start = Mat::from_fn(size, 1, |i, _| -row(i));
        let nodes = nodes(linear, &follow, size);
        let fastest =
            (0..size).map(|i| (0..size).map(|j| rates[(i, j)].abs()).sum()).fold(0.0, f64::max);
        for doublings in DOUBLINGS {
            let longest = f64::from(doublings).exp2() / fastest;
            let wanted = wanted((&rates, leak.as_ref()), &start, (longest, longest));
            let Some(chain) = Chain::new(wanted) else { return Ok(None) };
            let mut left = Mat::from_fn(size, 1, |i, _| settled[i]);
            chain.advance(&mut left, &[vec![0.0]], (longest, 0.0));
            if largest(&left) <= LEFT * settled.iter().fold(0.0, |most, t| f64::max(most, t.abs()))
            {
                return Ok(Some(Self { rates, leak, start, chain, longest, nodes }));
            }
        }
        Ok(None)
    }

    /// Rise of a node by heat that is stored, at a time in s after the step.
    pub(super) fn value(&self, node: usize, time: f64) -> f64 {
        self.of_states(node, self.rises(time).col_as_slice(0))
    }

    /// The same at the end of pulses of `length` in s in periods of `period`: `sum_k exp(k period
    /// A)` of the rises of one pulse.
    pub(super) fn pulse(&self, node: usize, length: f64, period: f64) -> f64 {
        let mut rises = self.rises(length);
        let longest = self.longest.max(period);
        let wanted = wanted((&self.rates, self.leak.as_ref()), &self.start, (period, longest));
        match Chain::new(wanted) {
            Some(chain) => chain.add_repeats(&mut rises, period),
            None => return f64::NAN,
        }
        self.of_states(node, rises.col_as_slice(0))
    }

    /// The first time in s, to a thousandth, at which a node has risen to a value that it reaches.
    pub(super) fn reached(&self, node: usize, value: f64) -> f64 {
        let there = |time: f64| self.value(node, time) / value >= 1.0;
        let mut early = self.longest;
        while early > f64::MIN_POSITIVE && there(early) {
            early *= 0.5;
        }
        let mut late = 2.0 * early;
        while late > 1.001 * early {
            let middle = (early * late).sqrt();
            if there(middle) { late = middle } else { early = middle }
        }
        late
    }

    fn rises(&self, time: f64) -> Mat<f64> {
        let mut rises = Mat::zeros(self.start.nrows(), 1);
        if time > 0.0 {
            // later there is no further change
            let time = time.min(8.0 * self.longest);
            self.chain.advance(&mut rises, &[vec![1.0]], (time, 1e-15 * time));
        }
        rises
    }

    /// Rise of a node for temperatures of the states.
    pub(super) fn of_states(&self, node: usize, states: &[f64]) -> f64 {
        states.iter().enumerate().map(|(j, t)| self.nodes[(node, j)] * t).sum()
    }
}

fn wanted(
    (rates, leak): (&Mat<f64>, Option<&Vec<f64>>),
    start: &Mat<f64>,
    (unit, longest): (f64, f64),
) -> Wanted {
    let (rates, drive, leak) = (rates.clone(), start.clone(), leak.cloned());
    Wanted { rates, drive, leak, unit, longest, terms: 1 }
}

/// Shortfall of each row sum below 0, if the elements are those of a thermal network.
fn leak(rates: &Mat<f64>) -> Option<Vec<f64>> {
    let size = rates.nrows();
    let thermal = (0..size).all(|i| (0..size).all(|j| i == j || rates[(i, j)] >= 0.0));
    let lacks = |i: usize| {
        let lacks = -(0..size).map(|j| rates[(i, j)]).sum::<f64>();
        let rounding = size as f64 * f64::EPSILON * rates[(i, i)].abs();
        if lacks.abs() <= rounding { 0.0 } else { lacks }
    };
    let leak: Vec<f64> = (0..size).map(lacks).collect();
    (thermal && leak.iter().all(|lacks| *lacks >= 0.0)).then_some(leak)
}

/// Response of every node to a unit of each state.
fn nodes(linear: &Linearised<'_>, follow: &Mat<f64>, states: usize) -> Mat<f64> {
    let columns: Vec<Vec<f64>> = (0..states)
        .map(|state| {
            let mut unknowns = vec![0.0; states];
            unknowns[state] = 1.0;
            unknowns.extend((0..follow.nrows()).map(|i| follow[(i, state)]));
            linear.recover(&unknowns)
        })
        .collect();
    let nodes = linear.system().network().nodes().len();
    Mat::from_fn(nodes, states, |i, j| columns[j][i])
}

fn largest(x: &Mat<f64>) -> f64 {
    (0..x.nrows()).map(|i| x[(i, 0)].abs()).fold(0.0, f64::max)
}
