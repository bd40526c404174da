//! Laws outside their ranges of validity during a run.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_laws::{Group, THIN_OIL};
use lptn_network::{InputError, Item, Network};

use crate::snapshot::Snapshot;

/// A stretch of time in which a group of a law was outside its range, on one side of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// The conductor or source of the law.
    pub item: Item,
    /// The group with its range.
    pub group: &'static Group,
    /// Its value that was furthest outside.
    pub value: f64,
    /// Time of that value in s.
    pub at: f64,
    /// Start in s, interpolated between the times of evaluations.
    pub from: f64,
    /// End in s; that of the last evaluation if it was outside to the end.
    pub to: f64,
}

impl OutOfRange {
    fn begins(item: Item, group: &'static Group, (time, value): Point) -> Self {
        Self { item, group, value, at: time, from: time, to: time }
    }

    /// True if a value is outside, on the same side.
    fn goes_on(&self, value: f64) -> bool {
        !self.group.contains(value) && (value < self.group.from) == (self.value < self.group.from)
    }

    fn take_in(&mut self, (time, value): Point) {
        let further =
            if self.value < self.group.from { value < self.value } else { value > self.value };
        if further {
            (self.value, self.at) = (value, time);
        }
        self.to = time;
    }

    /// The groups outside their range in a steady state, each with the one time of its inputs.
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    pub fn of_steady(network: &Network, steady: &Snapshot) -> Result<Vec<Self>, InputError> {
        let mut scope = steady.evaluation(network);
        let vertices = [&steady.temperatures[..], &steady.boundary_temperatures].concat();
        let mut found = Vec::new();
        for item in network.ranged() {
            let values = network.groups(item, &mut scope, &vertices)?;
            let all = groups_of(network, item).iter().zip(values);
            let outside = all.filter_map(|(group, value)| Some((group, value?)));
            let outside = outside.filter(|(group, value)| !group.contains(*value));
            let one = |(group, value)| Self::begins(item, group, (steady.time, value));
            found.extend(outside.map(one));
        }
        Ok(found)
    }
}

fn groups_of(network: &Network, item: Item) -> &'static [Group] {
    network.law(item).map_or(&[], |law| law.formula().declaration().groups)
}

/// True if groups change no faster than temperatures do.
fn are_slow(groups: &[Group]) -> bool {
    groups.iter().all(|group| *group == THIN_OIL)
}

/// A time in s with the value of a group.
type Point = (f64, f64);

/// A group of a conductor or source while a run goes on.
struct Track {
    item: Item,
    group: &'static Group,
    /// The last evaluation in this stretch of smooth inputs.
    last: Option<Point>,
    /// The present stretch outside the range.
    now: Option<OutOfRange>,
}

impl Track {
    /// Takes in the next evaluation; returns a stretch that ended.
    fn look(&mut self, time: f64, value: Option<f64>) -> Option<OutOfRange> {
        let last = std::mem::replace(&mut self.last, value.map(|value| (time, value)));
        let value = value.filter(|value| !self.group.contains(*value));
        if let (Some(now), Some(value)) = (&mut self.now, value)
            && now.goes_on(value)
        {
            now.take_in((time, value));
            return None;
        }
        let edge = |now: &OutOfRange| self.edge(last, self.last, now.value < self.group.from);
        let ended = self.now.map(|now| OutOfRange { to: edge(&now).unwrap_or(now.to), ..now });
        self.now = value.map(|value| {
            let begun = OutOfRange::begins(self.item, self.group, (time, value));
            OutOfRange { from: edge(&begun).unwrap_or(time), ..begun }
        });
        ended
    }

    /// The time in s between two evaluations at which a straight line passed an end of the range.
    fn edge(&self, before: Option<Point>, after: Option<Point>, low: bool) -> Option<f64> {
        let ((t0, y0), (t1, y1)) = (before?, after?);
        let end = if low { self.group.from } else { self.group.to };
        let share = (end - y0) / (y1 - y0);
        (0.0..=1.0).contains(&share).then_some(t0 + (t1 - t0) * share)
    }
}

/// All groups of a network during a run, evaluated at the same times as its limits.
pub(crate) struct RangeWatch<'a> {
    system: &'a ThermalSystem,
    items: Vec<Item>,
    /// One for each group of each of these.
    tracks: Vec<Track>,
    /// Stretches that ended, each with the place of its track.
    found: Vec<(usize, OutOfRange)>,
}

impl<'a> RangeWatch<'a> {
    pub(crate) fn new(system: &'a ThermalSystem) -> Self {
        let network = system.network();
        let items = network.ranged();
        let of = |&item: &Item| {
            let groups = groups_of(network, item).iter();
            groups.map(move |group| Track { item, group, last: None, now: None })
        };
        let tracks = items.iter().flat_map(of).collect();
        Self { system, items, tracks, found: Vec::new() }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Begins a stretch of smooth inputs at `time` in s: no line leads there.
    pub(crate) fn enter(&mut self, work: &mut Workspace, time: f64) -> Result<(), InputError> {
        self.tracks.iter_mut().for_each(|track| track.last = None);
        self.sample(work, time)
    }

    /// Evaluates all groups at the state of the workspace, at `time` in s.
    pub(crate) fn sample(&mut self, work: &mut Workspace, time: f64) -> Result<(), InputError> {
        self.sample_of(work, time, |_| true)
    }

    /// The same inside a step: those that change no faster than temperatures do wait for its end.
    pub(crate) fn sample_inside(
        &mut self,
        work: &mut Workspace,
        time: f64,
    ) -> Result<(), InputError> {
        self.sample_of(work, time, |groups| !are_slow(groups))
    }

    fn sample_of(
        &mut self,
        work: &mut Workspace,
        time: f64,
        asked: impl Fn(&[Group]) -> bool,
    ) -> Result<(), InputError> {
        let mut first = 0;
        for &item in &self.items {
            let groups = groups_of(self.system.network(), item);
            let tracks = self.tracks.iter_mut().enumerate().skip(first);
            first += groups.len();
            if !asked(groups) {
                continue;
            }
            let values = self.system.groups(work, item)?;
            for (value, (place, track)) in values.into_iter().zip(tracks) {
                self.found.extend(track.look(time, value).map(|ended| (place, ended)));
            }
        }
        Ok(())
    }

    /// True if evaluations at the ends of steps suffice.
    pub(crate) fn is_slow(&self) -> bool {
        let network = self.system.network();
        self.items.iter().all(|item| are_slow(groups_of(network, *item)))
    }

    /// The results, in the order of paths and sources, their groups and the time.
    pub(crate) fn into_found(mut self) -> Vec<OutOfRange> {
        let now = self.tracks.iter().enumerate();
        self.found.extend(now.filter_map(|(place, track)| Some((place, track.now?))));
        self.found.sort_by_key(|(place, _)| *place);
        self.found.into_iter().map(|(_, found)| found).collect()
    }
}

#[cfg(test)]
mod tests {
    use lptn_network::{Input, Law, NetworkBuilder};

    use super::*;

    const GROUP: Group = Group { name: "Ra", meaning: "Rayleigh number", from: 10.0, to: 100.0 };

    fn looked(points: &[(f64, Option<f64>)]) -> Vec<OutOfRange> {
        static KNOWN: Group = GROUP;
        let mut b = NetworkBuilder::new();
        let (one, other) = (b.massless("a"), b.massless("b"));
        let conductor = b.resistor("r", one, other, Law::conductance(Input::number(1.0)));
        let mut track =
            Track { item: Item::Conductor(conductor), group: &KNOWN, last: None, now: None };
        let mut found: Vec<OutOfRange> =
            points.iter().filter_map(|(time, value)| track.look(*time, *value)).collect();
        found.extend(track.now);
        found
    }

    #[test]
    fn a_stretch_begins_and_ends_where_the_value_passes_the_range() {
        let found = looked(&[
            (0.0, Some(50.0)),
            (1.0, Some(150.0)),
            (2.0, Some(300.0)),
            (3.0, Some(50.0)),
            (4.0, Some(5.0)),
            (5.0, Some(1.0)),
        ]);
        let seen: Vec<[f64; 4]> = found.iter().map(|f| [f.value, f.at, f.from, f.to]).collect();
        assert_eq!(seen, [[300.0, 2.0, 0.5, 2.8], [1.0, 5.0, 3.0 + 40.0 / 45.0, 5.0]]);
    }

    #[test]
    fn one_side_follows_the_other_and_what_does_not_count_ends_a_stretch() {
        let found = looked(&[(0.0, Some(0.0)), (1.0, Some(200.0)), (2.0, None), (3.0, Some(0.0))]);
        let seen: Vec<[f64; 3]> = found.iter().map(|f| [f.value, f.from, f.to]).collect();
        assert_eq!(seen, [[0.0, 0.0, 0.05], [200.0, 0.5, 1.0], [0.0, 3.0, 3.0]]);
        assert!(looked(&[(0.0, Some(10.0)), (1.0, Some(100.0)), (2.0, None)]).is_empty());
    }
}
