//! Proven bounds for any integrator: pieces of a run, each with its polynomials.

mod window;
mod written;

use lptn_assembly::ThermalSystem;
use lptn_integrate::Pattern;
use lptn_network::{ControlId, Evaluation, InputBounds, Item, Positions};
use lptn_units::Taylor;

use super::bound::{Bound, Line};
use super::collocation::Collocation;
use super::course::{Course, StateAt};
use super::defect::{Largest, rest};
use super::gates::{GRAZES, Gates, TOGETHER, Tube};
use super::results::Results;
use super::rows::Rows;
use super::way::{self, SAMPLES, Way};
use super::{Certificate, ROUNDING, Uncertified};
use crate::events::ControlState;
use crate::readings::pieces;
use window::Switches;

/// Times that a tube around the way is widened before the step counts as lost.
const WIDENED: usize = 24;

/// Most halvings of a piece.
const HALVINGS: usize = 16;

/// The share of the tolerance that a piece may add to a bound.
const SHARE: f64 = 5e-3;

/// A sweep over the samples that corrects less than this share of that is the last one.
const ENOUGH: f64 = 0.1;

/// After a switch a piece may add this share of the largest bound.
const PASSES: f64 = 0.1;

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
    /// The times in s, ascending, at which results may bend or jump, and at which a cubic of a signal
    /// ends.
    breaks: Vec<f64>,
    /// The slopes of a system without elements, which are the same everywhere.
    constant: Option<Vec<f64>>,
    /// The way at the end of the last piece.
    arrived: Vec<f64>,
    samples: [Vec<f64>; SAMPLES],
    way: Way<SAMPLES>,
    switches: Switches<'a>,
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
        let cubics = system.network().ends_of_cubics(from, rows.end().unwrap_or(from));
        let mut breaks = results.as_ref().map_or(Vec::new(), |results| results.breaks().to_vec());
        breaks.extend(cubics);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
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
            breaks,
            constant,
            arrived: start.to_vec(),
            samples: std::array::from_fn(|_| start.to_vec()),
            way: Way::default(),
            switches: Switches::new(Gates::new(system)),
        })
    }

    pub(super) fn begin_within(&mut self, bounds: &[f64]) {
        // differences at the start move from node to node
        self.moves = SHARE * bounds.iter().copied().fold(0.0, f64::max);
        self.bound.set(bounds.to_vec());
    }

    /// Takes the part of a step from `from` to `to` in s, with comparisons of time as they are at
    /// `inside`, and controls in these states. Pieces end at the breaks.
    pub(super) fn step(
        &mut self,
        (span, inside): ((f64, f64), f64),
        controls: &[ControlState],
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Uncertified> {
        self.follow((span.0, inside), controls)?;
        for (part, begins) in pieces(&self.breaks, span) {
            if begins {
                self.flush_all(part.0)?;
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
        self.close_window()?;
        if inside.to_bits() != self.inside.to_bits() {
            self.flush_all(from)?;
            self.switches.entered = from;
        }
        let (begun, _) = self.course.span().unwrap_or((from, to));
        let is_long = to - begun > self.length || self.course.is_full();
        if is_long && self.switches.open().is_none() {
            self.flush()?;
        }
        if self.course.is_full() {
            self.switches.clear(from, GRAZES)?;
        }
        self.inside = inside;
        self.course.add((from, to), state_at).map_err(|_| Uncertified::Lost { time: from })
    }

    /// Bounds the errors over all steps before a time in s.
    fn flush_all(&mut self, time: f64) -> Result<(), Uncertified> {
        self.close_window()?;
        if self.switches.open().is_none() {
            self.flush()?;
        }
        self.switches.clear(time, TOGETHER)
    }

    /// Bounds the errors over all steps that are known, up to a time from which on something may
    /// switch.
    fn flush(&mut self) -> Result<(), Uncertified> {
        let Some((from, to)) = self.course.span() else { return Ok(()) };
        if from >= to {
            return Ok(());
        }
        let before = self.length;
        self.length = to - from;
        let reached = self.piece((from, to), 0)?;
        let halved = self.length < to - from;
        self.length = if halved { self.length } else { self.length.max(before) };
        self.course.forget_before(reached);
        Ok(())
    }

    /// A piece, which is halved until its own share of the bounds is small; gives the time in s up
    /// to which nothing switches.
    fn piece(&mut self, (from, to): (f64, f64), halvings: usize) -> Result<f64, Uncertified> {
        let found = self.over((from, to));
        let adds = found.as_ref().map_or(f64::INFINITY, Line::adds);
        let middle = 0.5 * (from + to);
        let halves = halvings < HALVINGS && from < middle && middle < to;
        let allowed = self.allowed() + self.moves;
        if halves && (adds.is_nan() || adds > allowed) {
            self.length = 0.5 * (to - from);
            return self.both([from, middle, to], halvings + 1);
        }
        let line = found?;
        if let Some((id, time)) = self.may_switch((from, to), &line)? {
            self.bound.set(line.start().to_vec());
            if time <= from || time >= to || halvings >= 2 * HALVINGS {
                self.switches.held = Some(id);
                return Ok(from);
            }
            return self.both([from, time, to], halvings + 1);
        }
        if adds <= LITTLE * (self.allowed + self.moves) && halvings == 0 {
            self.length *= LONGER;
        }
        self.bound.go(&line);
        self.write((from, to), &[line], None);
        self.arrive();
        Ok(to)
    }

    /// The most in K that a piece may add to a bound. After a switch the bounds of some nodes pass
    /// into others, however short the pieces are.
    fn allowed(&self) -> f64 {
        let passes = !self.switches.found.is_empty();
        let largest = self.bound.now().iter().copied().fold(0.0, f64::max);
        if passes { self.allowed.max(PASSES * largest) } else { self.allowed }
    }

    /// Two pieces, the second one unless something may switch in the first.
    fn both(&mut self, [from, middle, to]: [f64; 3], halvings: usize) -> Result<f64, Uncertified> {
        let reached = self.piece((from, middle), halvings)?;
        if reached < middle { Ok(reached) } else { self.piece((middle, to), halvings) }
    }

    /// A control that may switch over a piece, and a time in s before which nothing does.
    fn may_switch(
        &mut self,
        span: (f64, f64),
        line: &Line,
    ) -> Result<Option<(ControlId, f64)>, Uncertified> {
        let most = line.most();
        let tube = Tube { span, inside: self.inside, way: &self.way, most: &most };
        self.switches.gates.first(&mut self.scope, &tube)
    }

    /// Goes to the end of the way.
    fn arrive(&mut self) {
        let way = &self.way;
        self.arrived.iter_mut().enumerate().for_each(|(i, t)| *t = way.at(i, 1.0));
    }

    /// The way over a piece, and the bounds around it.
    fn over(&mut self, span: (f64, f64)) -> Result<Line, Uncertified> {
        let gaps = self.prepare(span)?;
        let before = self.bound.now().to_vec();
        self.bound.widen(gaps.into_iter());
        let line = self.line(span, None);
        if line.is_err() {
            self.bound.set(before);
        }
        line
    }

    /// The way over a piece; gives the distances in K of its start from the end of the last one.
    fn prepare(&mut self, (from, to): (f64, f64)) -> Result<Vec<f64>, Uncertified> {
        let half = 0.5 * (to - from);
        let times =
            way::places::<SAMPLES>().map(|place| (from + half * (1.0 + place)).clamp(from, to));
        for (sample, time) in self.samples.iter_mut().zip(times) {
            match self.course.span() {
                Some(_) => self.course.write(time, sample),
                None => sample.copy_from_slice(&self.arrived),
            }
        }
        // the way goes on as it arrived, and its distance from the integrator's solution lasts
        for (i, arrived) in self.arrived.iter().enumerate() {
            let apart = arrived - self.samples[0][i];
            self.samples[1..].iter_mut().for_each(|sample| sample[i] += apart);
            self.samples[0][i] = *arrived;
        }
        let enough = ENOUGH * self.allowed;
        let corrected = self.collocation.correct((&times, self.inside), &mut self.samples, enough);
        corrected.ok_or(Uncertified::Lost { time: from })?;
        self.way.put(&self.samples, &self.basis);
        let way = &self.way;
        Ok(self.arrived.iter().enumerate().map(|(i, t)| (way.at(i, -1.0) - t).abs()).collect())
    }

    /// The bounds over a piece: those that hold in a tube which they do not leave. The exact
    /// solution may have other positions than the way.
    fn line(
        &mut self,
        (from, to): (f64, f64),
        other: Option<&Positions>,
    ) -> Result<Line, Uncertified> {
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
        if self.constant.is_some() && other.is_none() {
            self.round(&whole, &mut defect);
            return self.bound.over(to - from, &defect).ok_or_else(lost);
        }
        let mut widths: Vec<f64> =
            self.bound.now().iter().map(|w| (WIDER * w).max(LEAST_WIDTH)).collect();
        for _ in 0..WIDENED {
            let line =
                self.within(((from, to), &mut over.still()), (&whole, &widths, &defect), other)?;
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

    /// The bounds over a piece as long as they stay inside a tube of these widths in K.
    fn within(
        &mut self,
        (span, still): ((f64, f64), &mut InputBounds),
        (whole, widths, defect): (&[Taylor], &[f64], &[f64]),
        other: Option<&Positions>,
    ) -> Result<Line, Uncertified> {
        let ranges = whole.iter().map(|bounds| bounds.range().unwrap_or([f64::NAN; 2]));
        let tube: Vec<[f64; 2]> =
            ranges.zip(widths).map(|([low, high], w)| [low - w, high + w]).collect();
        let slopes = self.system.enclose_slopes(still, &tube);
        let slopes = slopes.map_err(|item| self.no_law(item, span.0))?;
        let mut all = defect.to_vec();
        all.iter_mut().zip(&slopes.jumps).for_each(|(all, jump)| *all += jump);
        if let Some(other) = other {
            let jumps = self.difference(span, &tube, other)?;
            all.iter_mut().zip(jumps).for_each(|(all, jump)| *all += jump);
        }
        self.bound.set_matrix(&slopes.worst(self.system));
        self.round(whole, &mut all);
        self.bound.over(span.1 - span.0, &all).ok_or(Uncertified::Lost { time: span.0 })
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

    fn no_law(&self, item: Item, time: f64) -> Uncertified {
        Uncertified::Law { name: self.system.network().name_of(item).into_owned(), time }
    }

    pub(super) fn finish(mut self) -> Result<Certificate, Uncertified> {
        self.close_window()?;
        if self.switches.open().is_none() {
            self.flush()?;
        }
        self.last_window()?;
        let switches = std::mem::take(&mut self.switches.found);
        let results = self.results.map(Results::into_found).unwrap_or_default();
        let end = [self.arrived, self.bound.now().to_vec()];
        Ok(Certificate { results, switches, end, ..self.rows.into_certificate() })
    }
}

#[cfg(test)]
mod mutants;
