//! Results along the steps of the one-step method.
//!
//! Over a part of a step the way is a polynomial of a degree of up to 13. Results need one of
//! degree 7: that through its values at eight places. The terms of the series from the eighth on
//! are not in it exactly. The rest of each is found once for a length of steps.

use std::f64::consts::PI;

use lptn_assembly::ThermalSystem;
use lptn_integrate::SeriesStep;
use lptn_network::Evaluation;

use super::bound::Line;
use super::laguerre::{MOST, weights};
use super::results::Results;
use super::rows::Rows;
use super::way::{self, SAMPLES, Way};
use crate::readings::pieces;

/// The first weight whose degree, its index and one, is above that of a polynomial through the
/// samples.
const FIRST: usize = SAMPLES - 1;

/// Intervals between the places at which a rest is computed.
const PLACES: usize = 48;

/// A polynomial of degree 13 is at most this much larger between the places than there:
/// `1/cos(13 pi/(2 PLACES))` (H. Ehlich, K. Zeller, Math. Z. 86 (1964) 41).
const BETWEEN: f64 = 1.1;

/// Results during a run of the one-step method.
pub(super) struct Along<'a> {
    results: Results<'a>,
    scope: Evaluation,
    basis: [[f64; SAMPLES]; SAMPLES],
    rests: Rests,
    samples: [Vec<f64>; SAMPLES],
    apart: Vec<f64>,
    /// Parts of steps whose bound is not known yet: the first `count` of them.
    parts: Vec<Part>,
    count: usize,
    /// The first row without a range.
    row: usize,
}

/// A part of a step.
#[derive(Default)]
struct Part {
    /// From a time in s to another.
    span: (f64, f64),
    way: Way<SAMPLES>,
    /// For each unknown the largest distance of the polynomial from the way in K.
    rest: Vec<f64>,
}

impl Part {
    fn place(&self, time: f64) -> f64 {
        let (from, to) = self.span;
        (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0)
    }
}

impl<'a> Along<'a> {
    pub(super) fn new(system: &'a ThermalSystem, results: Results<'a>) -> Self {
        Self {
            results,
            scope: system.network().evaluation(),
            basis: way::basis(),
            rests: Rests::default(),
            samples: std::array::from_fn(|_| vec![0.0; system.unknowns().len()]),
            apart: vec![0.0; system.unknowns().len()],
            parts: Vec::new(),
            count: 0,
            row: 0,
        }
    }

    /// Takes a step of the way, in parts between the bends and jumps of results.
    pub(super) fn take(&mut self, step: &SeriesStep<'_>) {
        for (span, _) in pieces(self.results.breaks(), step.span) {
            self.part(step, span);
        }
    }

    fn part(&mut self, step: &SeriesStep<'_>, (from, to): (f64, f64)) {
        if self.parts.len() == self.count {
            self.parts.push(Part::default());
        }
        let part = &mut self.parts[self.count];
        self.count += 1;
        part.span = (from, to);
        let share = |time: f64| ((time - step.span.0) / step.length).clamp(0.0, step.share);
        let [start, end] = step.ends;
        // the change over the step that the terms leave
        add_up(&weights(step.share), step.terms, &mut self.apart);
        for ((apart, end), start) in self.apart.iter_mut().zip(end).zip(start) {
            *apart = end - start - *apart;
        }
        for (sample, place) in self.samples.iter_mut().zip(way::places::<SAMPLES>()) {
            let at = share(from + 0.5 * (1.0 + place) * (to - from));
            let past = at / step.share;
            add_up(&weights(at), step.terms, sample);
            for ((t, apart), start) in sample.iter_mut().zip(&self.apart).zip(start) {
                *t = start + (*t + past * apart);
            }
        }
        part.way.put(&self.samples, &self.basis);
        let rests = self.rests.over([share(from), share(to)], &self.basis);
        part.rest.clear();
        part.rest.extend((0..start.len()).map(|unknown| {
            let terms = rests.iter().zip(step.terms).skip(FIRST);
            terms.map(|(rest, term)| rest * term[unknown].abs()).sum::<f64>()
        }));
    }

    /// Takes the bound over all parts that are kept, which begins at a time in s.
    pub(super) fn close(&mut self, line: &Line, from: f64, rows: &Rows<'_>) {
        let parts = &self.parts[..self.count];
        let most = line.most();
        for part in parts {
            let bound = |i: usize| most(i) + part.rest[i];
            self.results.take(&mut self.scope, part.span, (&part.way, &bound), None);
        }
        let end = parts.last().map_or(from, |part| part.span.1);
        while self.row < rows.count() && rows.time(self.row) <= end {
            let time = rows.time(self.row);
            let place = parts.partition_point(|part| part.span.1 < time);
            let part = &parts[place.min(parts.len() - 1)];
            let (place, bound) = (part.place(time), line.at((time - from).max(0.0)));
            let unknowns = 0..part.way.len();
            let state: Vec<f64> = unknowns.clone().map(|i| part.way.at(i, place)).collect();
            let bounds: Vec<f64> = unknowns.map(|i| bound(i) + part.rest[i]).collect();
            self.results.row(&mut self.scope, (time, None), (&state, &bounds));
            self.row += 1;
        }
        self.count = 0;
    }

    pub(super) fn into_results(self) -> Results<'a> {
        self.results
    }
}

/// The sum of the terms of a series with these weights, for each unknown.
fn add_up(weights: &[f64; MOST], terms: &[Vec<f64>], sum: &mut [f64]) {
    sum.fill(0.0);
    for (weight, term) in weights.iter().zip(terms) {
        for (sum, term) in sum.iter_mut().zip(term) {
            *sum += weight * term;
        }
    }
}

/// The largest distances of weights from the polynomials through their samples, over the shares of
/// a step that were asked for last.
#[derive(Default)]
struct Rests {
    shares: [f64; 2],
    found: [f64; MOST],
}

impl Rests {
    fn over(&mut self, shares: [f64; 2], basis: &[[f64; SAMPLES]; SAMPLES]) -> &[f64; MOST] {
        if self.shares.map(f64::to_bits) != shares.map(f64::to_bits) {
            (self.shares, self.found) = (shares, largest(shares, basis));
        }
        &self.found
    }
}

fn largest([from, to]: [f64; 2], basis: &[[f64; SAMPLES]; SAMPLES]) -> [f64; MOST] {
    let at = |place: f64| weights(from + 0.5 * (1.0 + place) * (to - from));
    let known = way::places::<SAMPLES>().map(at);
    let mut largest = [0.0_f64; MOST];
    for k in 0..=PLACES {
        let place = (PI * k as f64 / PLACES as f64).cos();
        let through = basis.map(|of| of.iter().rev().fold(0.0, |sum, c| sum * place + c));
        for (n, (largest, weight)) in largest.iter_mut().zip(at(place)).enumerate().skip(FIRST) {
            let found: f64 = through.iter().zip(&known).map(|(share, at)| share * at[n]).sum();
            *largest = largest.max(BETWEEN * (weight - found).abs());
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weight of the eighth term has degree 8. Its distance from the polynomial through eight
    /// places is its first coefficient times the product of the distances from these places.
    #[test]
    fn the_rest_of_a_weight_is_bounded_closely() {
        let (shares, places) = ([0.25, 0.75], way::places::<SAMPLES>());
        let product = |s: f64| places.iter().map(|place| s - place).product::<f64>();
        let most = (0..=20_000).map(|i| product(f64::from(i) / 10_000.0 - 1.0).abs());
        // g (-1)^7 (L_8 - L_7) has the coefficient -g/8! of (s/g)^8, and s goes from -1 to 1 over half
        let first = (0.25 / SeriesStep::POLE).powi(8) / 40_320.0 * SeriesStep::POLE;
        let (right, found) = (first * most.fold(0.0, f64::max), largest(shares, &way::basis()));
        assert!((right..1.11 * right).contains(&found[FIRST]), "{} {right}", found[FIRST]);
        assert!(found[FIRST - 1] < f64::MIN_POSITIVE, "the seventh has degree 7");
    }
}
