//! Proven bounds for any integrator: pieces of a run, each with polynomials of its own.

use lptn_assembly::ThermalSystem;
use lptn_integrate::Pattern;
use lptn_network::{Evaluation, Item};
use lptn_units::Taylor;

use super::bound::{Bound, Line};
use super::collocation::Collocation;
use super::course::{Course, StateAt};
use super::defect::{Largest, rest};
use super::results::Results;
use super::rows::Rows;
use super::way::{self, SAMPLES, Way};
use super::{Certificate, ROUNDING, Uncertified};
use crate::readings::pieces;

/// Times that a tube around the way is widened before the step counts as lost.
const WIDENED: usize = 24;

/// Most halvings of a piece.
const HALVINGS: usize = 16;

/// The share of the tolerance that a piece may add to a bound.
const SHARE: f64 = 5e-3;

/// A sweep over the samples that corrects less than this share of that is the last one.
const ENOUGH: f64 = 0.1;

/// A piece that adds less than this share of that lets the next ones be longer.
const LITTLE: f64 = 0.1;

/// The next pieces are longer by this.
const LONGER: f64 = 1.5;

/// The first tube is this much wider than the bounds at the start of a piece.
const WIDER: f64 = 2.0;

/// Least half-width of a tube in K.
const LEAST_WIDTH: f64 = 1e-12;

/// Follows a run and bounds its errors.
pub(crate) struct Pieces<'a> {
    system: &'a ThermalSystem,
    scope: Evaluation,
    basis: [[f64; SAMPLES]; SAMPLES],
    collocation: Collocation<'a>,
    largest: Largest<SAMPLES>,
    /// The most in K that a piece may add to a bound without being halved.
    allowed: f64,
    /// The most in K that a piece may add in addition, from the bounds at the start.
    moves: f64,
    bound: Bound,
    rows: Rows<'a>,
    /// Bounds on results, if they are asked for.
    results: Option<Results<'a>>,
    /// The integrator's steps since the last piece, and a time in s inside their segment.
    course: Course,
    inside: f64,
    /// Length in s that the next piece may have.
    length: f64,
    /// The slopes of a system without elements, which are the same everywhere.
    constant: Option<Vec<f64>>,
    /// The way at the end of the last piece.
    arrived: Vec<f64>,
    samples: [Vec<f64>; SAMPLES],
    way: Way<SAMPLES>,
}

impl<'a> Pieces<'a> {
    /// From a start on whose temperatures, in K, are exact.
    pub(super) fn new(
        system: &'a ThermalSystem,
        (rows, results, start): (Rows<'a>, Option<Results<'a>>, &[f64]),
        (from, tolerance): (f64, f64),
    ) -> Result<Self, Uncertified> {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let lost = |_| Uncertified::Lost { time: from };
        let basis = way::basis();
        let collocation = Collocation::new(system, &pattern, &basis).map_err(lost)?;
        let mut bound = Bound::new(&pattern, system.mass()).map_err(lost)?;
        let constant = system.is_linear().then(|| {
            let mut slopes = vec![0.0; system.pattern().entries()];
            system.jacobian(&mut slopes);
            slopes
        });
        constant.iter().for_each(|slopes| bound.set_matrix(slopes));
        Ok(Self {
            system,
            scope: system.network().evaluation(),
            basis,
            collocation,
            largest: Largest::new(),
            allowed: SHARE * tolerance,
            moves: 0.0,
            bound,
            rows,
            results,
            course: Course::new(start.len()),
            inside: from,
            length: 0.0,
            constant,
            arrived: start.to_vec(),
            samples: std::array::from_fn(|_| start.to_vec()),
            way: Way::default(),
        })
    }

    pub(super) fn begin_within(&mut self, bounds: &[f64]) {
        // differences at the start move from node to node
        self.moves = SHARE * bounds.iter().copied().fold(0.0, f64::max);
        self.bound.set(bounds.to_vec());
    }

    /// Takes the part of a step from `from` to `to` in s, with comparisons of time as they are at
    /// `inside`. Pieces end at the bends and jumps of results.
    pub(super) fn step(
        &mut self,
        (span, inside): ((f64, f64), f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Uncertified> {
        let breaks = self.results.as_ref().map_or(&[][..], Results::breaks);
        for (part, begins) in pieces(breaks, span) {
            if begins {
                self.flush()?;
            }
            self.part((part, inside), state_at)?;
        }
        Ok(())
    }

    fn part(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Uncertified> {
        let (begun, _) = self.course.span().unwrap_or((from, to));
        let is_long = to - begun > self.length || self.course.is_full();
        if inside.to_bits() != self.inside.to_bits() || is_long {
            self.flush()?;
        }
        self.inside = inside;
        self.course.add((from, to), state_at).map_err(|_| Uncertified::Lost { time: from })
    }

    /// Bounds the errors over all steps that are known.
    fn flush(&mut self) -> Result<(), Uncertified> {
        let Some((from, to)) = self.course.span() else { return Ok(()) };
        let before = self.length;
        self.length = to - from;
        self.piece((from, to), 0)?;
        let halved = self.length < to - from;
        self.length = if halved { self.length } else { self.length.max(before) };
        self.course.clear();
        Ok(())
    }

    /// A piece, which is halved until its own share of the bounds is small.
    fn piece(&mut self, (from, to): (f64, f64), halvings: usize) -> Result<(), Uncertified> {
        let found = self.over((from, to));
        let adds = found.as_ref().map_or(f64::INFINITY, Line::adds);
        let middle = 0.5 * (from + to);
        let halves = halvings < HALVINGS && from < middle && middle < to;
        let allowed = self.allowed + self.moves;
        if halves && (adds.is_nan() || adds > allowed) {
            self.length = 0.5 * (to - from);
            self.piece((from, middle), halvings + 1)?;
            return self.piece((middle, to), halvings + 1);
        }
        let line = found?;
        if adds <= LITTLE * allowed && halvings == 0 {
            self.length *= LONGER;
        }
        self.write_rows((from, to), &line);
        if let Some(results) = &mut self.results {
            results.take(&mut self.scope, (from, to), (&self.way, &line.most()));
        }
        self.bound.go(&line);
        let way = &self.way;
        self.arrived.iter_mut().enumerate().for_each(|(i, t)| *t = way.at(i, 1.0));
        Ok(())
    }

    /// The way over a piece, and the bounds around it.
    fn over(&mut self, (from, to): (f64, f64)) -> Result<Line, Uncertified> {
        let lost = || Uncertified::Lost { time: from };
        let half = 0.5 * (to - from);
        let times =
            way::places::<SAMPLES>().map(|place| (from + half * (1.0 + place)).clamp(from, to));
        for (sample, time) in self.samples.iter_mut().zip(times) {
            self.course.write(time, sample);
        }
        // the way goes on as it arrived, and its distance from the integrator's solution lasts
        for (i, arrived) in self.arrived.iter().enumerate() {
            let apart = arrived - self.samples[0][i];
            self.samples[1..].iter_mut().for_each(|sample| sample[i] += apart);
            self.samples[0][i] = *arrived;
        }
        let enough = ENOUGH * self.allowed;
        let corrected = self.collocation.correct((&times, self.inside), &mut self.samples, enough);
        corrected.ok_or_else(lost)?;
        self.way.put(&self.samples, &self.basis);
        let before = self.bound.now().to_vec();
        let way = &self.way;
        let gaps = self.arrived.iter().enumerate().map(|(i, t)| (way.at(i, -1.0) - t).abs());
        self.bound.widen(gaps);
        let line = self.line((from, to));
        if line.is_err() {
            self.bound.set(before);
        }
        line
    }

    /// The bounds over a piece: those that hold in a tube which they do not leave.
    fn line(&mut self, (from, to): (f64, f64)) -> Result<Line, Uncertified> {
        let lost = || Uncertified::Lost { time: from };
        let whole: Vec<Taylor> =
            (0..self.arrived.len()).map(|unknown| self.way.whole(unknown)).collect();
        let [mut over, _] =
            self.system.network().input_bounds(&mut self.scope, (from, to), self.inside);
        let rests = self.system.enclose_rest(&mut over, &whole, &rest);
        let mut defect = rests.map_err(|item| self.no_law(item, from))?;
        self.add_defect(2.0 / (to - from), &whole, &mut defect);
        if !defect.iter().all(|defect| defect.is_finite()) {
            return Err(lost());
        }
        if self.constant.is_some() {
            self.round(&whole, &mut defect);
            return self.bound.over(to - from, &defect).ok_or_else(lost);
        }
        let mut still = over.still();
        let mut widths: Vec<f64> =
            self.bound.now().iter().map(|w| (WIDER * w).max(LEAST_WIDTH)).collect();
        for _ in 0..WIDENED {
            let ranges = whole.iter().map(|bounds| bounds.range().unwrap_or([f64::NAN; 2]));
            let tube: Vec<[f64; 2]> =
                ranges.zip(&widths).map(|([low, high], w)| [low - w, high + w]).collect();
            let slopes = self.system.enclose_slopes(&mut still, &tube);
            let slopes = slopes.map_err(|item| self.no_law(item, from))?;
            let mut all = defect.clone();
            all.iter_mut().zip(&slopes.jumps).for_each(|(all, jump)| *all += jump);
            self.bound.set_matrix(&slopes.worst(self.system));
            self.round(&whole, &mut all);
            let line = self.bound.over(to - from, &all).ok_or_else(lost)?;
            let reached: Vec<f64> = (0..widths.len()).map(line.most()).collect();
            if !reached.iter().all(|most| most.is_finite()) {
                return Err(lost());
            }
            if reached.iter().zip(&widths).all(|(most, width)| most <= width) {
                return Ok(line);
            }
            let wider = reached.iter().zip(&widths);
            widths = wider.map(|(most, width)| (WIDER * most).max(*width)).collect();
        }
        Err(lost())
    }

    /// Adds the largest defect of each unknown in W over a piece, as far as it is a polynomial.
    fn add_defect(&self, per_second: f64, whole: &[Taylor], defect: &mut [f64]) {
        let places = way::places::<SAMPLES>();
        let flows = self.collocation.flows();
        for (i, mass) in self.system.mass().iter().enumerate() {
            let values = std::array::from_fn(|sample| {
                flows[sample][i] - mass * per_second * self.way.slope(i, places[sample])
            });
            let stored = mass * per_second * whole[i].largest(1);
            defect[i] += self.largest.of(&values) + ROUNDING * stored;
        }
    }

    /// Adds the rounding of the heats.
    fn round(&self, whole: &[Taylor], defect: &mut [f64]) {
        let sizes = whole.iter().map(|bounds| bounds.largest(0));
        self.bound.add_sizes(ROUNDING, sizes, defect);
    }

    /// Writes the bounds of the rows up to the end of a piece, and of the run so far.
    fn write_rows(&mut self, (from, to): (f64, f64), line: &Line) {
        let way = &self.way;
        let place = |time: f64| (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0);
        let mut far = vec![0.0_f64; self.rows.asked()];
        let largest = &self.largest;
        for part in self.course.steps().iter().filter(|part| part.from < to && part.to > from) {
            let (first, last) = (part.from.max(from), part.to.min(to));
            let times = way::places::<SAMPLES>().map(|s| first + 0.5 * (1.0 + s) * (last - first));
            self.rows.for_each_unknown(|node, i| {
                let apart = times.map(|time| part.at(i, time) - way.at(i, place(time)));
                let most = apart.iter().fold(0.0_f64, |most, apart| most.max(apart.abs()));
                // most steps add nothing to the largest one
                if 2.21 * most > far[node] {
                    far[node] = far[node].max(largest.of(&apart));
                }
            });
        }
        let most = line.most();
        self.rows.note(most, &far);
        for row in self.rows.up_to(to) {
            let time = self.rows.time(row).max(from);
            let (part, line) = (self.course.step_at(time), line.at(time - from));
            let apart = |i: usize| part.at(i, time) - way.at(i, place(time));
            self.rows.push(apart);
            self.rows.add(row, &line);
            if let Some(results) = &mut self.results {
                let state: Vec<f64> = (0..way.len()).map(|i| part.at(i, time)).collect();
                let bounds: Vec<f64> = (0..way.len()).map(|i| line(i) + apart(i).abs()).collect();
                results.row(&mut self.scope, time, (&state, &bounds));
            }
        }
    }

    fn no_law(&self, item: Item, time: f64) -> Uncertified {
        Uncertified::Law { name: self.system.network().name_of(item).into_owned(), time }
    }

    pub(super) fn finish(mut self) -> Result<Certificate, Uncertified> {
        self.flush()?;
        let results = self.results.map(Results::into_found).unwrap_or_default();
        let end = [self.arrived, self.bound.now().to_vec()];
        Ok(Certificate { results, end, ..self.rows.into_certificate() })
    }
}

#[cfg(test)]
mod mutants;
