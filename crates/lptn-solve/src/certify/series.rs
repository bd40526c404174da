//! Proven bounds for the one-step method, whose solution of a linear network is a series.
//!
//! With `p_n(s) = (-1)^n L_n(s/g)` for the Laguerre polynomials and the pole `g`, the weights of
//! the truncated series are `w_n = g (p_n + p_(n-1))`, and `w_n' = p_(n-1)` (Abramowitz and Stegun,
//! 22.8.6 and 22.5.17). So the defect of the sum of `N` terms telescopes: over a step of length `h`
//! it is
//!
//! ```text
//! h r(s) = p_N(s) g h J u_N - sum over n from 0 to N - 1 of p_n(s) e_(n+1)
//! ```
//!
//! with the amount `e_n` by which term `n` misses its equation ([`lptn_integrate::SeriesStep`]).
//! The amounts are computed, so nothing of the integrator has to be trusted. A few more terms than
//! the integrator's make the first part small; the distance of its solution from this longer series
//! is known at every time. The way joins the states of the integrator: the longer series, and a
//! straight line of its distance at the end.
//!
//! The integrator's errors have signs, and its local errors cancel each other. Therefore the way is
//! a second solution of a much smaller tolerance, from its own states on. The distance of the
//! integrator's solution from it is computed in rows, and bounded between them.
//!
//! Some steps share one bound: their largest defect, over their whole time.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{Integrator, OdeSystem, OneStep, Options, SeriesStep};

use super::along::Along;
use super::apart::{Apart, Far};
use super::bound::Bound;
use super::laguerre::{MOST, Peaks, at_end, weights};
use super::results::Results;
use super::rows::Rows;
use super::straight::Straight;
use super::{Certificate, Uncertified};
use crate::times::Segment;

/// Rounding errors of a sum of a row, as a share of the sum of the absolute values.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Most steps that share one bound.
const TOGETHER: usize = 8;

/// Steps share a bound if they miss the exact solution at rates that differ by less than this.
const ALIKE: f64 = 2.0;

/// The largest distance of `3 s^2 - 2 s^3`, with which the last weight of the integrator changes,
/// from `s`: `sqrt(3)/18`.
const SMOOTH: f64 = 0.0963;

/// The tolerance of the way, as a share of that of the run.
const FINER: f64 = 5e-4;

/// Least tolerance of the way in K.
const FINEST: f64 = 1e-10;

/// Follows a run of the one-step method.
pub(crate) struct SeriesCertifier<'a> {
    system: &'a ThermalSystem,
    bound: Bound,
    rows: Rows<'a>,
    peaks: Peaks,
    group: Group,
    /// The way, and the end of its present step in s.
    way: OneStep<Straight>,
    end: f64,
    /// Time in s up to which the integrator's solution is compared with the way.
    compared: f64,
    far: Far,
    /// Results, if they are asked for.
    along: Option<Along<'a>>,
    /// The end of the last step of the way.
    arrived: Vec<f64>,
}

/// Steps that share a bound.
struct Group {
    from: f64,
    to: f64,
    count: usize,
    /// The rate in K/s at which the first one misses the exact solution.
    rate: f64,
    /// Largest defect in W, but for the rounding.
    defect: Vec<f64>,
    /// Rounding as heat in W: a share of the capacities in K/s, and of the sums of slopes in K.
    rounding: [f64; 2],
    /// The first row whose bound is not complete.
    row: usize,
    /// For each unknown the largest distance in K of the second solution from the way.
    apart: Vec<f64>,
    /// For each recorded node the largest distance in K of the integrator's from the second.
    far: Vec<f64>,
    /// For each unknown the terms of a step.
    block: Vec<[f64; MOST]>,
}

/// Numbers of a step that serve all unknowns.
struct Numbers<'s> {
    step: &'s SeriesStep<'s>,
    peaks: [f64; MOST + 1],
    /// Weights of the distance from the way at the end, and of its largest value.
    ends: [f64; MOST],
    apart: [f64; MOST],
    truncated: [f64; MOST],
    /// s after the start of the segment.
    after: f64,
}

impl<'a> SeriesCertifier<'a> {
    pub(super) fn new(
        system: &'a ThermalSystem,
        (rows, results, start): (Rows<'a>, Option<Results<'a>>, &[f64]),
        (from, tolerance): (f64, f64),
    ) -> Result<Self, Uncertified> {
        let lost = Uncertified::Lost { time: from };
        let straight = Straight::new(system, start);
        let bound = Bound::constant(&straight.pattern, system.mass(), &straight.slopes);
        let bound = bound.map_err(|_| lost.clone())?;
        let tolerance = (FINER * tolerance).max(FINEST.min(tolerance));
        let options = Options { tolerance, ..Options::default() };
        let way = OneStep::new(straight, from, start, &options).map_err(|_| lost)?;
        let (count, recorded) = (start.len(), rows.asked());
        let group = Group::new(from, (count, recorded));
        Ok(Self {
            system,
            bound,
            rows,
            peaks: Peaks::new(),
            group,
            way,
            end: from,
            compared: from,
            far: Far::new(recorded),
            along: results.map(|results| Along::new(system, results)),
            arrived: start.to_vec(),
        })
    }

    pub(super) fn begin_within(&mut self, bounds: &[f64]) {
        self.bound.set(bounds.to_vec());
    }

    /// Takes the present step of the integrator inside a segment.
    pub(super) fn step(
        &mut self,
        step: &SeriesStep<'_>,
        segment: Segment,
    ) -> Result<(), Uncertified> {
        let (from, to) = step.span;
        if to <= self.compared {
            return Ok(()); // a part of the same step
        }
        let lost = || Uncertified::Lost { time: from };
        if self.compared.to_bits() != from.to_bits() {
            return Err(lost()); // it does not begin where the last one ended
        }
        if self.way.system().segment != segment {
            self.enter(segment)?;
        }
        while self.compared < to {
            if self.end <= self.compared {
                self.take_finished()?;
                self.way.step().map_err(|_| lost())?;
                self.end = self.way.series().ok_or_else(lost)?.span.1;
            }
            let both = (self.compared, to.min(self.end));
            let way = self.way.series().ok_or_else(lost)?;
            let apart = Apart::new([step, &way], both);
            for row in self.rows.up_to(both.1) {
                let weights = apart.at(self.rows.time(row));
                self.rows.push(|unknown| apart.of(&weights, unknown));
            }
            self.far.take(&apart, &self.rows);
            self.compared = both.1;
        }
        Ok(())
    }

    fn enter(&mut self, segment: Segment) -> Result<(), Uncertified> {
        let lost = Uncertified::Lost { time: segment.from };
        self.take_finished()?;
        self.way.restart(None).map_err(|_| lost.clone())?;
        self.way.set_stop(segment.to);
        let state = self.arrived.clone();
        let entered = self.way.system_mut().enter(self.system, segment, &state);
        entered.ok_or(lost)
    }

    /// Takes the step of the way that ends with the comparison.
    fn take_finished(&mut self) -> Result<(), Uncertified> {
        let lost = Uncertified::Lost { time: self.group.to };
        while self.way.time() < self.end {
            self.way.step().map_err(|_| lost.clone())?;
        }
        if self.end <= self.group.to {
            return Ok(());
        }
        self.way.extend().map_err(|_| lost.clone())?;
        let (group, straight) = (&mut self.group, self.way.system());
        let step = self.way.longer_series().ok_or_else(|| lost.clone())?;
        if group.to.to_bits() != step.span.0.to_bits() || self.arrived != step.ends[0] {
            return Err(lost); // it does not begin where the last one ended
        }
        let numbers = Numbers::new(&step, &self.peaks, step.span.0 - straight.segment.from);
        let rate = numbers.rate();
        let alike = rate <= ALIKE * group.rate && group.rate <= ALIKE * rate;
        if group.count > 0 && (group.count >= TOGETHER || !alike) {
            let results = (&mut self.rows, &mut self.along);
            group.close(&mut self.bound, results, self.system.mass())?;
        }
        group.take(&numbers, straight).ok_or(lost)?;
        if let Some(along) = &mut self.along {
            along.take(&step);
        }
        if group.count == 0 {
            group.rate = rate;
        }
        group.count += 1;
        self.far.hand_over(&mut group.far);
        group.to = step.span.1;
        self.arrived.copy_from_slice(step.ends[1]);
        Ok(())
    }

    /// Ends the run.
    pub(super) fn finish(mut self) -> Result<Certificate, Uncertified> {
        self.take_finished()?;
        if self.group.count > 0 {
            let results = (&mut self.rows, &mut self.along);
            self.group.close(&mut self.bound, results, self.system.mass())?;
        }
        let results = self.along.map(|along| along.into_results().into_found());
        let results = results.unwrap_or_default();
        let end = [self.arrived, self.bound.now().to_vec()];
        Ok(Certificate { results, end, ..self.rows.into_certificate() })
    }
}

impl Group {
    /// A group without steps, for some unknowns and recorded nodes.
    fn new(from: f64, (unknowns, recorded): (usize, usize)) -> Self {
        Self {
            from,
            to: from,
            count: 0,
            rate: 0.0,
            defect: vec![0.0; unknowns],
            rounding: [0.0; 2],
            row: 0,
            apart: vec![0.0; unknowns],
            far: vec![0.0; recorded],
            block: Vec::new(),
        }
    }

    /// Adds a step to the group; `None` if a number is not finite.
    fn take(&mut self, numbers: &Numbers<'_>, straight: &Straight) -> Option<()> {
        let mass = straight.mass();
        let (pattern, at) = (&straight.pattern, &straight.at);
        let (start, terms) = (numbers.step.ends[0], numbers.step.terms);
        self.block.resize(mass.len(), [0.0; MOST]);
        for (i, own) in self.block.iter_mut().enumerate() {
            own.iter_mut().zip(terms).for_each(|(own, term)| *own = term[i]);
            own[terms.len()..].fill(0.0);
        }
        for (i, own) in self.block.iter().enumerate() {
            let mut flows = [0.0; MOST];
            let mut heat = straight.heat[i] + straight.rate[i] * numbers.after;
            let rounding = ROUNDING * heat.abs();
            for slot in pattern.column(i) {
                let (column, slope) = (pattern.row_indices()[slot], straight.slopes[slot]);
                heat += slope * (start[column] - at[column]);
                let near = &self.block[column];
                flows.iter_mut().zip(near).for_each(|(flow, term)| *flow += slope * term);
            }
            let defect = numbers.defect(i, mass[i], (own, &flows), [heat, straight.rate[i]]);
            let defect = defect + rounding;
            if !defect.is_finite() {
                return None;
            }
            self.defect[i] = self.defect[i].max(defect);
            let apart: f64 = own.iter().zip(&numbers.apart).map(|(own, w)| w * own.abs()).sum();
            self.apart[i] = self.apart[i].max(apart);
        }
        let pairs = self.rounding.iter_mut().zip(numbers.rounding());
        pairs.for_each(|(most, rounding)| *most = most.max(rounding));
        Some(())
    }

    /// Bounds the errors of the group, and begins another one at its end.
    fn close(
        &mut self,
        bound: &mut Bound,
        (rows, along): (&mut Rows<'_>, &mut Option<Along<'_>>),
        mass: &[f64],
    ) -> Result<(), Uncertified> {
        for ((defect, mass), sum) in self.defect.iter_mut().zip(mass).zip(bound.sums()) {
            *defect += self.rounding[0] * mass + self.rounding[1] * sum;
        }
        let line = bound.over(self.to - self.from, &self.defect);
        let line = line.ok_or(Uncertified::Lost { time: self.from })?;
        if let Some(along) = along {
            along.close(&line, self.from, rows);
        }
        let apart = &self.apart;
        while self.row < rows.written() && rows.time(self.row) <= self.to {
            let line = line.at((rows.time(self.row) - self.from).max(0.0));
            rows.add(self.row, |unknown| line(unknown) + apart[unknown]);
            self.row += 1;
        }
        let most = line.most();
        rows.note(|unknown| most(unknown) + apart[unknown], &self.far);
        bound.go(&line);
        self.defect.fill(0.0);
        self.apart.fill(0.0);
        self.far.fill(0.0);
        self.rounding = [0.0; 2];
        (self.from, self.count) = (self.to, 0);
        Ok(())
    }
}

/// The weights with which the terms make up the distance of the integrator's solution from the
/// longer series after a share of the step; those of its terms but the last one are equal.
fn beyond(step: &SeriesStep<'_>, share: f64) -> [f64; MOST] {
    let (longer, own) = (weights(share), step.weights(share));
    let mut beyond = longer.map(|weight| -weight);
    beyond[..step.used - 1].fill(0.0);
    beyond[step.used - 1] += own[step.used - 1];
    beyond
}

impl<'s> Numbers<'s> {
    fn new(step: &'s SeriesStep<'s>, peaks: &Peaks, after: f64) -> Self {
        let peaks = *peaks.up_to(step.share);
        let pole = SeriesStep::POLE;
        let mut apart = [0.0; MOST];
        for n in step.used..step.terms.len() {
            // both parts of w_n, and those of its value at the end
            apart[n] = 2.0 * pole * (peaks[n] + peaks[n + 1]);
        }
        let smooth = if step.share < 1.0 { 1.0 } else { SMOOTH };
        apart[step.used - 1] = smooth * pole * at_end(step.used).abs();
        let ends = beyond(step, step.share);
        Self { step, peaks, ends, apart, truncated: weights(step.share), after }
    }

    /// The rate in K/s at which the integrator leaves the exact solution, roughly.
    fn rate(&self) -> f64 {
        let used = self.step.used - 1;
        let last = self.step.terms[used].iter();
        let most = last.fold(0.0_f64, |most, term| most.max(term.abs()));
        most * self.ends[used].abs() / (self.step.share * self.step.length)
    }

    /// The largest defect of an unknown in W over the step, from its capacity, its terms, their
    /// flows and its heat at the start in W, with the change of that per s.
    fn defect(
        &self,
        unknown: usize,
        mass: f64,
        (own, flows): (&[f64; MOST], &[f64; MOST]),
        [heat, rate]: [f64; 2],
    ) -> f64 {
        let SeriesStep { length, share, terms, .. } = *self.step;
        let (reach, count) = (SeriesStep::POLE * length, terms.len());
        let (flow, slope) = (self.step.flow[unknown], self.step.slope[unknown]);
        let mut missed: [f64; MOST] = std::array::from_fn(|n| mass * own[n] - reach * flows[n]);
        (1..MOST).for_each(|n| missed[n] -= reach * flows[n - 1]);
        let straight = reach * length * slope;
        missed[0] -= length * flow + straight;
        missed[1] -= straight;
        // the last flow, beyond the terms, is that of the longer series itself
        let pairs = missed.iter().zip(&self.peaks);
        let mut sum: f64 = pairs.map(|(missed, peak)| peak * missed.abs()).sum();
        if count == MOST {
            sum += self.peaks[MOST] * (reach * flows[MOST - 1]).abs();
        }
        sum += length * ((flow - heat).abs() + length * share * (slope - rate).abs());
        let [start, end] = self.step.ends;
        let known: f64 = self.truncated.iter().zip(own).map(|(w, term)| w * term).sum();
        let apart = end[unknown] - start[unknown] - known;
        let flow: f64 = self.ends.iter().zip(flows).map(|(w, flow)| w * flow).sum();
        let stored = mass * apart / share;
        (sum + stored.abs().max((length * flow - stored).abs())) / length
    }

    /// Rounding as heat: a share of the capacities in K/s, and of the sums of slopes in K.
    fn rounding(&self) -> [f64; 2] {
        let SeriesStep { length, share, ends, terms, .. } = self.step;
        let largest = |x: &[f64]| x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut stored = 0.0;
        let mut flows = 0.0;
        let mut before = 0.0;
        for (n, term) in terms.iter().enumerate() {
            let size = largest(term);
            stored += (self.peaks[n] + self.truncated[n].abs() / share) * size;
            flows += self.peaks[n] * SeriesStep::POLE * (size + before);
            before = size;
        }
        let hottest = largest(ends[0]).max(largest(ends[1]));
        [ROUNDING * stored / length, ROUNDING * (flows + 2.0 * hottest)]
    }
}

#[cfg(test)]
mod mutants;
