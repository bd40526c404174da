//! Controls that switch: the exact solution switches at some time of a proven interval.
//!
//! Let the integrator's solution, and with it the way `u`, go from the state `a` of a control to
//! `b` at `t_s`. Each of these statements is checked with bounds:
//!
//! 1. Up to `t_1 <= t_s` the temperatures within the bounds reach no threshold. So nothing
//!    switches.
//! 2. Go on in state `a` beyond `t_s`. As long as the exact solution has not switched, it is near
//!    this one, and at `t_2 >= t_s` everything near it is beyond the threshold. So the exact
//!    solution switches at a time `t*` between `t_1` and `t_2`. A control with a dwell has to be
//!    free to switch by then.
//! 3. From `t_1` to `t_2` the exact solution obeys the inclusion `C T' in {q_a(T), q_b(T)}`. With
//!    `J >= |q_b - q_a|` in the tube, `C |e|' <= A |e| + |r| + J`: the bound of `bound.rs` is valid
//!    with the defect `|r| + J` (inclusions: A. F. Filippov, Differential Equations with
//!    Discontinuous Righthand Sides, Kluwer 1988, chapter 2). `J` counts only before `t_s` if `t*`
//!    is before, and only after it if `t*` is after: both are computed, and the larger one counts.
//! 4. Inside the tube no other control reaches a threshold, and this one does not reach that of
//!    `b`. So from `t_2` on both are in state `b`.
//!
//! The temperature that is sensed is known at `t*`: it is the threshold `h`, if the control was free
//! to switch before and `h` reads no temperature. With its rates `R` in state `b` inside the tube
//! and those of the way, `V`,
//!
//! ```text
//! |e(t_2)| <= |h - u(t_s)| + max |R| max(t_s - t_1, t_2 - t_s) + max |R - V| (t_2 - t_s)
//! ```
//!
//! Without this, the bound of a thermostat would grow at each switch.
//!
//! If the temperature runs along the threshold, no such `t_1` or `t_2` is found, and the run has no
//! proven bounds.

use lptn_network::{ControlId, Positions};
use lptn_units::Taylor;

use super::Pieces;
use super::written::most;
use crate::certify::bound::Line;
use crate::certify::gates::{GRAZES, Gates, TOGETHER, Tube};
use crate::certify::of_solution::farthest;
use crate::certify::way::{SAMPLES, Way};
use crate::certify::{ROUNDING, Uncertified};
use crate::events::ControlState;

/// The first continuation is this much longer than the time before the switch.
const LONGER: f64 = 4.0;

/// Least length of a continuation as a share of the pieces.
const SHORT: f64 = 1e-9;

/// Most doublings of the continuation.
const DOUBLINGS: usize = 40;

/// The controls during a run.
pub(super) struct Switches<'a> {
    pub(super) gates: Gates<'a>,
    begun: bool,
    /// The times in s of the last switches of the integrator's solution.
    since: Vec<f64>,
    /// A control that may switch from the first time on whose bounds are not known.
    pub(super) held: Option<ControlId>,
    pub(super) pending: Option<Pending>,
    /// The time in s from which on inputs are smooth.
    pub(super) entered: f64,
    /// The times in s between which each switch lies.
    pub(super) found: Vec<[f64; 2]>,
}

/// A switch whose interval is not over.
#[derive(Clone)]
pub(super) struct Pending {
    pub(super) id: ControlId,
    /// `t_1`, `t_s` and `t_2` in s.
    pub(super) times: [f64; 3],
    pub(super) to: Positions,
}

impl<'a> Switches<'a> {
    pub(super) fn new(gates: Gates<'a>) -> Self {
        let (since, found) = (Vec::new(), Vec::new());
        let entered = f64::NEG_INFINITY;
        Self { gates, begun: false, since, held: None, pending: None, entered, found }
    }

    /// The switch that is under way.
    pub(super) fn open(&self) -> Option<ControlId> {
        self.held.or(self.pending.as_ref().map(|pending| pending.id))
    }

    /// Error of a switch that is under way.
    pub(super) fn clear(&self, time: f64, because: &'static str) -> Result<(), Uncertified> {
        self.open().map_or(Ok(()), |id| Err(self.gates.unclear(id, time, because)))
    }

    /// The control that switched since this was asked last.
    fn flipped(
        &mut self,
        time: f64,
        now: &[ControlState],
    ) -> Result<Option<ControlId>, Uncertified> {
        let ids = self.gates.ids();
        let differs = |(id, control): &(ControlId, &ControlState)| {
            control.since.to_bits() != self.since[id.index()].to_bits()
        };
        let flipped: Vec<_> = ids.zip(now).filter(differs).collect();
        let Some((id, control)) = flipped.first() else { return Ok(None) };
        let known = self.pending.as_ref().map_or(&self.gates.positions, |pending| &pending.to);
        if flipped.len() > 1 || known.controls[id.index()] == control.on {
            return Err(self.gates.unclear(*id, time, TOGETHER));
        }
        self.since[id.index()] = control.since;
        Ok(Some(*id))
    }
}

impl Pieces<'_> {
    /// Takes the states of the controls from a time in s on.
    pub(super) fn follow(
        &mut self,
        (time, inside): (f64, f64),
        now: &[ControlState],
    ) -> Result<(), Uncertified> {
        if !self.switches.begun {
            self.switches.begun = true;
            self.switches.since = now.iter().map(|control| control.since).collect();
            self.switches.gates.begin(now);
            self.set_positions(&self.switches.gates.positions.clone());
            return Ok(());
        }
        let Some(id) = self.switches.flipped(time, now)? else { return Ok(()) };
        self.close_window()?;
        if let Some(pending) = &self.switches.pending {
            return Err(self.switches.gates.unclear(pending.id, time, TOGETHER));
        }
        if self.switches.held.is_none() {
            self.flush()?;
        }
        let mut to = self.switches.gates.positions.clone();
        to.controls[id.index()] = !to.controls[id.index()];
        match inside.to_bits() == self.inside.to_bits() {
            true => self.begin_window(id, time, to),
            false => self.jump_at((time, inside), id, &to),
        }
    }

    /// A control that switches because its threshold jumps: the exact one does so at that time.
    fn jump_at(
        &mut self,
        (time, inside): (f64, f64),
        id: ControlId,
        to: &Positions,
    ) -> Result<(), Uncertified> {
        self.switches.clear(time, TOGETHER)?;
        self.way.put_still(&self.arrived);
        let now = self.bound.now();
        let (span, way) = ((time, time), &self.way);
        let tube = Tube { span, inside, way, most: &|i| now[i] };
        let gates = &mut self.switches.gates;
        if gates.leaves(&mut self.scope, &tube, id)?.is_none() {
            return Err(gates.unclear(id, time, TOGETHER));
        }
        gates.since[id.index()] = [time; 2];
        gates.positions = to.clone();
        self.switches.found.push([time; 2]);
        self.set_positions(to);
        Ok(())
    }

    pub(super) fn set_positions(&mut self, positions: &Positions) {
        self.scope.set_positions(positions);
        self.collocation.set_positions(positions);
    }

    /// Finds the interval of a switch at a time in s.
    fn begin_window(&mut self, id: ControlId, at: f64, to: Positions) -> Result<(), Uncertified> {
        let other = |held: &ControlId| *held != id;
        if let Some(other) = self.switches.held.filter(other) {
            return Err(self.switches.gates.unclear(other, at, TOGETHER));
        }
        let held = self.switches.held.and(self.course.span());
        let first = held.map_or(at, |(from, _)| from);
        let least = (SHORT * self.length).max(1e-12 * at.abs().max(1.0));
        let armed = self.switches.gates.armed(id)[1];
        let mut length = (LONGER * (at - first)).max(armed - first).max(least);
        for _ in 0..DOUBLINGS {
            if let Some(last) = self.left((first, first + length), id)? {
                self.switches.held = None;
                let times = [first, at, last.max(at)];
                self.switches.pending = Some(Pending { id, times, to });
                return Ok(());
            }
            length *= 2.0;
        }
        Err(self.switches.gates.unclear(id, at, GRAZES))
    }

    /// A time in s at which a control has left its state, if everything goes on as it is.
    fn left(&mut self, span: (f64, f64), id: ControlId) -> Result<Option<f64>, Uncertified> {
        let before = self.bound.now().to_vec();
        let line = self.over(span);
        self.bound.set(before);
        let Ok(line) = line else {
            return Err(self.switches.gates.unclear(id, span.0, GRAZES));
        };
        let most = line.most();
        let tube = Tube { span, inside: self.inside, way: &self.way, most: &most };
        self.switches.gates.leaves(&mut self.scope, &tube, id)
    }

    /// Bounds the errors over the interval of a switch, if the integrator is beyond it.
    pub(super) fn close_window(&mut self) -> Result<(), Uncertified> {
        let reached = self.course.span().map_or(f64::NEG_INFINITY, |(_, to)| to);
        let over = |pending: &mut Pending| pending.times[2] <= reached;
        match self.switches.pending.take_if(over) {
            Some(pending) => self.window(&pending, true),
            None => Ok(()),
        }
    }

    /// Bounds the errors up to the end of the run, if something may switch there.
    pub(super) fn last_window(&mut self) -> Result<(), Uncertified> {
        let Some((from, end)) = self.course.span() else { return Ok(()) };
        if let Some(id) = self.switches.held.take() {
            let mut to = self.switches.gates.positions.clone();
            to.controls[id.index()] = !to.controls[id.index()];
            return self.window(&Pending { id, times: [from, end, end], to }, false);
        }
        match self.switches.pending.take() {
            Some(Pending { id, times: [first, at, last], to }) => {
                self.window(&Pending { id, times: [first, at, last.min(end)], to }, false)
            }
            None => Ok(()),
        }
    }

    /// Bounds the errors over the interval of a switch; `closes` if it is over at its end.
    pub(super) fn window(&mut self, of: &Pending, closes: bool) -> Result<(), Uncertified> {
        let [first, at, last] = of.times;
        let before = self.switches.gates.positions.clone();
        let mut sensed = if closes { self.sensed((first, last), of.id) } else { None };
        let mut ends = [self.bound.now().to_vec(), self.bound.now().to_vec()];
        for (span, [mode, other]) in
            [((first, at), [&before, &of.to]), ((at, last), [&of.to, &before])]
        {
            if span.0 < span.1 {
                self.set_positions(mode);
                let tube = self.part_of_window((span, of), (mode, other), &mut ends)?;
                if let Some(sensed) = &mut sensed {
                    let flow = self.flows(span, &tube, &of.to)?[sensed.unknown];
                    let mass = self.system.mass()[sensed.unknown];
                    sensed.take(flow.map(|flow| flow / mass), &self.way, (span, at));
                }
            }
        }
        self.set_positions(&of.to);
        let [early, late] = ends;
        let mut now: Vec<f64> = early.iter().zip(&late).map(|(a, b)| a.max(*b)).collect();
        if let Some(sensed) = sensed {
            now[sensed.unknown] = now[sensed.unknown].min(sensed.bound(of.times));
        }
        self.bound.set(now);
        self.course.forget_before(last);
        if closes {
            self.switches.gates.since[of.id.index()] = [first, last];
            self.switches.gates.positions = of.to.clone();
            self.switches.found.push([first, last]);
        }
        Ok(())
    }

    /// The temperature that a control senses, if it is at the threshold when the control switches
    /// between two times in s: the control was free to switch before and did not.
    fn sensed(&mut self, span: (f64, f64), id: ControlId) -> Option<Sensed> {
        let gates = &self.switches.gates;
        let free = self.switches.entered.max(gates.armed(id)[1]) < span.0;
        let (unknown, threshold) = gates.threshold(&mut self.scope, (span, self.inside), id)?;
        free.then(|| Sensed::new(unknown, threshold, self.arrived[unknown]))
    }

    /// One side of the integrator's switch: the bounds if the exact solution switches before it,
    /// and after it.
    fn part_of_window(
        &mut self,
        (span, of): ((f64, f64), &Pending),
        (mode, other): (&Positions, &Positions),
        ends: &mut [Vec<f64>; 2],
    ) -> Result<Vec<[f64; 2]>, Uncertified> {
        let gaps = self.prepare(span)?;
        let early = *mode != of.to;
        let mut lines: Vec<Line> = Vec::with_capacity(2);
        for (place, end) in ends.iter_mut().enumerate() {
            self.bound.set(end.clone());
            self.bound.widen(gaps.iter().copied());
            // the exact solution is in the other state before `t_s` if it switches early
            let other = (early == (place == 0)).then_some(other);
            let line = self.line(span, other)?;
            self.bound.go(&line);
            end.copy_from_slice(self.bound.now());
            lines.push(line);
        }
        let most = most(&lines);
        let tube = Tube { span, inside: self.inside, way: &self.way, most: &most };
        self.switches.gates.stay(&mut self.scope, &tube, (of.id, of.times[0]))?;
        let tube = tube.box_of();
        self.write(span, &lines, Some(of.id));
        self.arrive();
        Ok(tube)
    }

    /// The ranges of the heat into each unknown in W inside a box of temperatures in K, in some
    /// positions.
    pub(super) fn flows(
        &mut self,
        span: (f64, f64),
        tube: &[[f64; 2]],
        positions: &Positions,
    ) -> Result<Vec<[f64; 2]>, Uncertified> {
        let network = self.system.network();
        let mode = self.scope.positions();
        self.scope.set_positions(positions);
        let [over, _] = network.input_bounds(&mut self.scope, span, self.inside);
        self.scope.set_positions(&mode);
        let still: Vec<Taylor> = tube.iter().map(|range| Taylor::between(&[*range])).collect();
        let found = self.system.enclose_flow(&mut over.still(), &still);
        let found = found.map_err(|item| self.no_law(item, span.0))?;
        let wide = |(flow, spread): (&Taylor, &f64)| {
            let [low, high] = flow.range().unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let rounding = ROUNDING * low.abs().max(high.abs());
            [low - spread - rounding, high + spread + rounding]
        };
        Ok(found.flow.iter().zip(&found.spread).map(wide).collect())
    }

    /// For each unknown the largest difference in W of its heat in the present positions from that in
    /// others, inside a box of temperatures in K.
    pub(super) fn difference(
        &mut self,
        span: (f64, f64),
        tube: &[[f64; 2]],
        other: &Positions,
    ) -> Result<Vec<f64>, Uncertified> {
        let mode = self.scope.positions();
        let (one, other) = (self.flows(span, tube, &mode)?, self.flows(span, tube, other)?);
        let most = |(a, b): (&[f64; 2], &[f64; 2])| (a[1] - b[0]).max(b[1] - a[0]);
        Ok(one.iter().zip(&other).map(most).collect())
    }
}

/// The temperature that a control senses, during the interval of its switch.
struct Sensed {
    unknown: usize,
    /// The range of the threshold in K.
    threshold: [f64; 2],
    /// Its rates in K/s after the switch, and those of the way.
    rates: [f64; 2],
    of_way: [f64; 2],
    /// The distance of the way from the threshold at `t_s` in K.
    off: f64,
}

impl Sensed {
    fn new(unknown: usize, threshold: [f64; 2], of_way: f64) -> Self {
        let rates = [f64::INFINITY, f64::NEG_INFINITY];
        let off = farthest(of_way, threshold);
        Self { unknown, threshold, rates, of_way: rates, off }
    }

    /// Takes the rates in K/s over a part of the interval, and the way, which is in the other state
    /// up to `at` in s.
    fn take(
        &mut self,
        [low, high]: [f64; 2],
        way: &Way<SAMPLES>,
        ((from, to), at): ((f64, f64), f64),
    ) {
        self.rates = [self.rates[0].min(low), self.rates[1].max(high)];
        let end = if to <= at { 1.0 } else { -1.0 };
        self.off = farthest(way.at(self.unknown, end), self.threshold);
        let per_second = 2.0 / (to - from);
        self.of_way = way.whole(self.unknown).term(1).map(|slope| per_second * slope);
    }

    /// A bound on its error at the end of the interval in K.
    fn bound(&self, [first, at, last]: [f64; 3]) -> f64 {
        let ([low, high], after) = (self.rates, last - at);
        let moved = low.abs().max(high.abs()) * after.max(at - first);
        let [least, most] = self.of_way;
        let bends = if after > 0.0 { (high - least).max(most - low) * after } else { 0.0 };
        self.off + moved + bends + ROUNDING * self.threshold[1]
    }
}

#[cfg(test)]
mod mutants;
