//! An island that streams pass: all its states go on together by the exponential of their matrix.

use faer::Mat;

use super::ExactError;
use super::chain::{Chain, Wanted};
use super::inputs::Panel;
use super::reduced::Reduced;

/// The expected lengths of panels, and the terms of their series.
#[derive(Clone, Copy)]
pub(crate) struct Lengths {
    /// The most frequent one in s.
    pub(crate) unit: f64,
    /// The whole time in s.
    pub(crate) duration: f64,
    pub(crate) terms: usize,
}

/// One way from row to row.
struct Way {
    chain: Chain,
    rises: Mat<f64>,
    /// Time still to go in s, from the rounding of times.
    owed: f64,
}

/// States that streams join, with their rises.
pub(crate) struct Carried<'a> {
    reduced: &'a Reduced,
    members: Vec<usize>,
    /// By the length of a panel, and by thirds of it: matrices without a common product, so that
    /// their difference shows the effect of rounding.
    ways: [Way; 2],
    rates: Mat<f64>,
    drive: Mat<f64>,
    /// The largest difference of the two ways up to now in K.
    apart: f64,
}

/// Rounding of the time of a row, in its last places.
const LAST_PLACES: f64 = 8.0;

impl<'a> Carried<'a> {
    pub(crate) fn new(
        (reduced, boundaries): (&'a Reduced, usize),
        members: Vec<usize>,
        rises: &[f64],
        lengths: Lengths,
    ) -> Result<Self, ExactError> {
        let (rates, leak) = rates(reduced, boundaries, &members);
        let drive = Mat::from_fn(members.len(), reduced.feeds.ncols(), |row, i| {
            reduced.feeds[(members[row], i)] / reduced.capacity[members[row]]
        });
        let rises = Mat::from_fn(members.len(), 1, |row, _| rises[members[row]]);
        let way = |unit: f64| {
            let wanted = Wanted {
                rates: rates.clone(),
                drive: drive.clone(),
                leak: Some(leak.clone()),
                unit,
                longest: lengths.duration,
                terms: lengths.terms,
            };
            let chain = Chain::new(wanted).ok_or(ExactError::Rates)?;
            Ok::<_, ExactError>(Way { chain, rises: rises.clone(), owed: 0.0 })
        };
        let ways = [way(lengths.unit)?, way(lengths.unit / 3.0)?];
        Ok(Self { reduced, members, ways, rates, drive, apart: 0.0 })
    }

    pub(crate) fn step(&mut self, panel: &Panel, (from, to): (f64, f64)) {
        let slack = LAST_PLACES * f64::EPSILON * from.abs().max(to.abs());
        for way in &mut self.ways {
            let length = to - from + way.owed;
            way.owed = way.chain.advance(&mut way.rises, &panel.series, (length, slack));
        }
        let [one, other] = &self.ways;
        let apart =
            (0..self.members.len()).map(|i| (one.rises[(i, 0)] - other.rises[(i, 0)]).abs());
        self.apart = apart.fold(self.apart, f64::max);
    }

    pub(crate) fn add_rises(&self, sum: &mut [f64]) {
        self.members
            .iter()
            .enumerate()
            .for_each(|(row, &i)| sum[i] += self.ways[0].rises[(row, 0)]);
    }

    pub(crate) fn add_slopes(&self, inputs: &[f64], sum: &mut [f64]) {
        let rises = &self.ways[0].rises;
        for (row, &i) in self.members.iter().enumerate() {
            let of_states = (0..self.members.len()).map(|j| self.rates[(row, j)] * rises[(j, 0)]);
            let of_inputs = inputs.iter().enumerate().map(|(k, u)| self.drive[(row, k)] * u);
            sum[i] += of_states.sum::<f64>() + of_inputs.sum::<f64>();
        }
    }

    /// The most that heat into each state in W, of either sign, can do to a member over the whole
    /// time: no element of the exponential is negative.
    pub(crate) fn largest_rise(&self, heat: &[f64]) -> f64 {
        let rates = Mat::from_fn(self.members.len(), 1, |row, _| {
            let i = self.members[row];
            heat[i].abs() / self.reduced.capacity[i]
        });
        let rises = self.ways[0].chain.lasting(&rates);
        (0..self.members.len()).map(|i| rises[(i, 0)]).fold(0.0, f64::max)
    }

    /// Effect of rounding up to now in K, by the difference of the two ways.
    pub(crate) fn rounding(&self) -> f64 {
        self.apart
    }

    /// Number of states.
    pub(crate) fn states(&self) -> usize {
        self.members.len()
    }
}

/// `C^-1` times the conductances, and by how much each row sums to less than 0.
fn rates(reduced: &Reduced, boundaries: usize, members: &[usize]) -> (Mat<f64>, Vec<f64>) {
    let mut heat = Mat::<f64>::zeros(members.len(), members.len());
    let place = |i: usize| members.binary_search(&i).ok();
    let both = reduced.links.iter().flat_map(|&(a, b, g)| [(a, b, g), (b, a, g)]);
    for (to, from, g) in both.chain(reduced.streams.iter().copied()) {
        if let (Some(to), Some(from)) = (place(to), place(from)) {
            heat[(to, from)] += g;
        }
    }
    let ties = reduced.ties(boundaries);
    let of = |row: usize, heat: f64| heat / reduced.capacity[members[row]];
    let leak: Vec<f64> = (0..members.len()).map(|row| of(row, ties[members[row]])).collect();
    let mut rates = Mat::from_fn(members.len(), members.len(), |i, j| of(i, heat[(i, j)]));
    for (row, leak) in leak.iter().enumerate() {
        rates[(row, row)] = -((0..members.len()).map(|j| rates[(row, j)]).sum::<f64>() + leak);
    }
    (rates, leak)
}
