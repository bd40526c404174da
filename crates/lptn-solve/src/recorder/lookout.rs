//! The watched nodes of a run.
//!
//! If only the hottest node is reported, only that node is searched (`Transient::hottest_only`). A
//! node whose curve stays below another node's value in this or an earlier step is skipped. The
//! reported peak is the same to the last digit.

use lptn_integrate::kernels;
use lptn_network::NodeId;

use crate::interval::{POINTS, time_of};
use crate::settings::Transient;
use crate::watch::{LASTS, Watch, Watched};

/// The share of its temperature by which a node has to stay below the hottest to be skipped: more
/// than peaks leave out as rounding.
const BELOW: f64 = 4.0 * LASTS;

/// The watched nodes, and their temperatures in the present step.
pub(super) struct Lookout {
    watch: Vec<Watch>,
    /// Results of each, except for its present temperature.
    seen: Vec<Watched>,
    /// End of these results in s.
    time: f64,
    /// The temperatures of all in K at each point of the present step; the first is the present
    /// state.
    points: [Vec<f64>; POINTS],
    /// True if a level is searched for.
    levels: bool,
    /// The highest temperature in K of all up to now, if only the hottest counts.
    highest: Option<f64>,
    /// Number of steps in which a node was evaluated more closely.
    searched: u64,
}

impl Lookout {
    pub(super) fn new(settings: &Transient) -> Self {
        Self {
            watch: settings.watch.clone(),
            seen: Vec::new(),
            time: f64::NAN,
            points: Default::default(),
            levels: settings.watch.iter().any(|watch| watch.level.is_some()),
            highest: settings.hottest_only.then_some(f64::NEG_INFINITY),
            searched: 0,
        }
    }

    /// True if no node is watched.
    pub(super) fn is_empty(&self) -> bool {
        self.watch.is_empty()
    }

    /// Begins at these temperatures of all nodes, or goes on from a jump to them.
    pub(super) fn start(&mut self, time: f64, nodes: &[f64]) {
        if self.seen.is_empty() {
            let new = |&watch: &Watch| Watched::new(watch, time, nodes[watch.node.index()]);
            self.seen = self.watch.iter().map(new).collect();
        } else {
            self.settle();
            self.seen.iter_mut().for_each(|seen| seen.jump(time, nodes[seen.watch.node.index()]));
        }
        self.time = time;
        self.take(0, nodes);
    }

    /// Takes the temperatures of all nodes at a point of the step.
    pub(super) fn take(&mut self, point: usize, nodes: &[f64]) {
        let points = &mut self.points[point];
        points.clear();
        points.extend(self.watch.iter().map(|watch| nodes[watch.node.index()]));
        if let Some(known) = &mut self.highest
            && let Some((_, high)) = kernels::range(points)
        {
            *known = f64::max(*known, high);
        }
    }

    /// Takes in the points of the step, and returns the tops between them: the node, and the
    /// interpolated height in K with its time in s.
    pub(super) fn tops(&mut self, step: (f64, f64)) -> Vec<(usize, (f64, f64))> {
        let times: [f64; POINTS] = std::array::from_fn(|point| time_of(step, point));
        let (floor, levels) = (self.floor(), self.levels);
        let all: [&[f64]; POINTS] = self.points.each_ref().map(|points| &points[..]);
        let mut tops = Vec::new();
        for (i, seen) in self.seen.iter_mut().enumerate() {
            let values: [f64; POINTS] = std::array::from_fn(|point| all[point][i]);
            let (low, reach) = range(&values);
            if !(levels && seen.may_cross(low, reach)) && (reach <= floor || seen.is_above(reach)) {
                continue;
            }
            let points: [(f64, f64); POINTS] = std::array::from_fn(|k| (times[k], values[k]));
            self.searched += 1;
            seen.go_to(points[0]);
            seen.look(&points);
            tops.extend(seen.top(step, &values, &points).map(|top| (i, top)));
        }
        self.time = step.1;
        self.points.swap(0, POINTS - 1);
        tops
    }

    /// No peak up to this temperature in K counts: if only the hottest does, one that another node
    /// exceeds in this step or did before. A node that gets hotter later is seen then.
    fn floor(&self) -> f64 {
        self.highest.map_or(f64::NEG_INFINITY, |highest| highest - BELOW * highest.abs())
    }

    /// Number of steps in which a node was evaluated more closely.
    pub(super) fn searched(&self) -> u64 {
        self.searched
    }

    pub(super) fn node(&self, watched: usize) -> NodeId {
        self.watch[watched].node
    }

    /// Takes in a temperature that may be the highest of a node.
    pub(super) fn peak_at(&mut self, watched: usize, (time, temperature): (f64, f64)) {
        self.seen[watched].peak_at((time, temperature));
    }

    /// Sets the present temperature of all.
    fn settle(&mut self) {
        let stand = self.seen.iter_mut().zip(&self.points[0]);
        stand.for_each(|(seen, &temperature)| seen.go_to((self.time, temperature)));
    }

    pub(super) fn into_seen(mut self) -> Vec<Watched> {
        self.settle();
        self.seen
    }
}

/// The lowest of some temperatures, and the upper limit of a curve that they resolve: none leaves
/// their range by as much again.
fn range(values: &[f64; POINTS]) -> (f64, f64) {
    let (mut low, mut high) = (values[0], values[0]);
    for &value in values {
        low = if value < low { value } else { low };
        high = if value > high { value } else { high };
    }
    (low, high + (high - low))
}

#[cfg(test)]
mod tests;
