//! Turning points of expressions of temperatures: no step goes past one undetected.
//!
//! Expressions that read a state with a balance, such as the pressure of a junction, are left out:
//! it does not go straight on while temperatures do, and flows rise with pressure differences.

use lptn_assembly::ThermalSystem;
use lptn_network::{Evaluation, Network, Pipe, Reader};

/// Range of the search for turns to both sides of a temperature, in K, and as a share of it if it
/// is far from usual temperatures.
const AROUND: f64 = 100.0;
const FAR: f64 = 0.3;

/// The narrowest turn that is searched for there, in K.
const NARROWEST: f64 = 1e-3;

/// Temperatures that change by less than this in the next steps, in K, pass nothing.
const STILL: f64 = 0.01;

/// The longest way of a temperature in the first step, in K, if more than one number is read.
const FIRST: f64 = 5.0;

/// Longest next step there, over the last one.
const LONGER: f64 = 2.0;

/// Range of the search, over that step.
const FURTHER: f64 = 1.5;

/// The expressions that turn.
pub(super) struct Turns {
    network: Network,
    /// Those that read one number, each with its family.
    single: Vec<(Reader, usize)>,
    families: Vec<Family>,
    /// All others.
    several: Vec<Reader>,
    /// The vertices that count the fluid that has passed pipes.
    counters: Vec<usize>,
    /// True if a step as long as the one before would have passed a turn whole.
    narrow: bool,
}

/// Turns of the expressions of a family.
#[derive(Clone, Debug)]
struct Family {
    reader: Reader,
    /// Searched from here to there.
    range: [f64; 2],
    /// Ascending.
    turns: Vec<[f64; 2]>,
}

/// Present temperatures and their rates.
#[derive(Clone, Copy)]
pub(super) struct Course<'a> {
    pub(super) now: &'a [f64],
    pub(super) rates: &'a [f64],
    /// Length of the last step in s; 0 if there was none.
    pub(super) last: f64,
}

impl Turns {
    pub(super) fn of(system: &ThermalSystem) -> Self {
        let network = system.network().clone();
        let given = network.nodes().len();
        let mut turns = Self {
            network,
            single: Vec::new(),
            families: Vec::new(),
            several: Vec::new(),
            counters: Vec::new(),
            narrow: false,
        };
        let states = system.network().states();
        let counter = |pipe: &Pipe| states[pipe.passed.index()].node.index();
        turns.counters = system.network().pipes().iter().map(counter).collect();
        let mut known = std::collections::BTreeMap::new();
        let balanced = |vertex: usize| {
            system.network().states().iter().any(|s| s.balanced && s.node.index() == vertex)
        };
        for reader in turns.network.readers() {
            // expressions of given temperatures are covered as those over time
            if reader.reads_only(|vertex| vertex >= given)
                || !reader.reads_only(|vertex| vertex >= given || !balanced(vertex))
            {
                continue;
            }
            let Some(family) = reader.family() else {
                turns.several.push(reader);
                continue;
            };
            let next = turns.families.len();
            let place = *known.entry(family).or_insert(next);
            if place == next {
                let family = Family { reader: reader.clone(), range: [f64::NAN; 2], turns: vec![] };
                turns.families.push(family);
            }
            turns.single.push((reader, place));
        }
        turns
    }

    pub(super) fn are_none(&self) -> bool {
        self.single.is_empty() && self.several.is_empty()
    }

    /// The longest next step in s, so that it ends where something turns.
    pub(super) fn longest(&mut self, course: Course<'_>, scope: &Evaluation) -> f64 {
        let mut longest = f64::INFINITY;
        for (reader, family) in &self.single {
            let (number, rate) = (reader.number(course.now), reader.number(course.rates));
            let family = &mut self.families[*family];
            family.reach(&self.network, scope, number);
            if rate != 0.0 {
                let [from, to] = family.next(number, rate > 0.0).map(|end| (end - number) / rate);
                // the end of the searched range has no width
                self.narrow |= from.to_bits() != to.to_bits() && from.max(to) < course.last;
                longest = longest.min(from.midpoint(to));
            }
        }
        if self.several.is_empty() { longest } else { longest.min(self.of_several(course, scope)) }
    }

    /// True if a step as long as the one before would have passed a turn whole.
    pub(super) fn were_narrow(&self) -> bool {
        self.narrow
    }

    fn of_several(&mut self, Course { now, rates, last }: Course<'_>, scope: &Evaluation) -> f64 {
        let counts = |vertex: usize| !self.counters.contains(&vertex);
        let rate = |(vertex, rate): (usize, &f64)| if counts(vertex) { rate.abs() } else { 0.0 };
        let fastest = rates.iter().enumerate().map(rate).fold(0.0, f64::max);
        let way = if last > 0.0 { LONGER * last } else { FIRST / fastest };
        if !way.is_finite() || way * fastest < STILL {
            return if last > 0.0 { way.max(STILL / fastest) } else { f64::INFINITY };
        }
        let far = FURTHER * way;
        let ahead: Vec<f64> = now.iter().zip(rates).map(|(now, rate)| now + far * rate).collect();
        let least = NARROWEST / (far * fastest);
        // the integrator chooses a step at the end of the one before, within the rest of its
        // stop: a stop at twice the last step does not let it grow
        let grows = last > 0.0 && !self.counters.is_empty();
        let mut longest = if grows { far } else { way };
        for reader in &self.several {
            let turns = self.network.turns(reader, scope, [now, &ahead], least);
            if let Some([from, to]) = turns.first() {
                self.narrow |= far * to < last;
                longest = longest.min(far * from.midpoint(*to)).max(STILL / fastest);
            }
        }
        longest
    }

    /// The share of a step after which a turn was reached that it went past, if it did.
    pub(super) fn passed(&self, [before, after]: [&[f64]; 2]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (reader, family) in &self.single {
            let (from, to) = (reader.number(before), reader.number(after));
            let (low, high) = (from.min(to), from.max(to));
            for [a, b] in &self.families[*family].turns {
                if low < *a && high > *b {
                    let share = (a.midpoint(*b) - from) / (to - from);
                    first = Some(first.map_or(share, |first| first.min(share)));
                }
            }
        }
        first
    }
}

impl Family {
    /// Searches for turns around a number, unless that was done.
    fn reach(&mut self, network: &Network, scope: &Evaluation, number: f64) {
        let [low, high] = self.range;
        let around = AROUND.max(FAR * number.abs());
        if (number - low).min(high - number) >= 0.1 * around || !number.is_finite() {
            return;
        }
        let range = [number - around, number + around];
        let least = NARROWEST / (2.0 * around);
        let turns = network.turns_between(&self.reader, scope, range, least);
        let place = |share: f64| range[0] + share * (range[1] - range[0]);
        self.turns = turns.into_iter().map(|turn| turn.map(place)).collect();
        self.range = range;
    }

    /// The next turn, or the end of the searched range.
    fn next(&self, number: f64, rises: bool) -> [f64; 2] {
        let next = match rises {
            true => self.turns.iter().find(|turn| turn[0] > number),
            false => self.turns.iter().rev().find(|turn| turn[1] < number),
        };
        next.copied().unwrap_or([self.range[usize::from(rises)]; 2])
    }
}

#[cfg(test)]
mod tests;
