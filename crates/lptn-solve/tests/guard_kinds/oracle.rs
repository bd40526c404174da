//! The courses of the networks by small steps that end at every corner.

use std::cell::{Cell, RefCell};

use super::case::{AIR, Case, Node, Storage, factor};
use crate::features::Feature;

/// The error of a step in K.
const FINE: f64 = 3e-11;

/// A corner is met to within so many K.
const MET: f64 = 1e-10;

/// The balance of a massless node has to fall with its temperature by so many W/K for its
/// temperature to be the only one.
const ONLY: f64 = 0.1;

/// So far around it in K.
const AROUND: [f64; 11] = [-0.03, -0.01, -0.003, -1e-3, -3e-4, 0.0, 3e-4, 1e-3, 0.003, 0.01, 0.03];

/// It moves by no more than so many times what the others do, or it has leapt.
const LEAP: f64 = 100.0;

/// What has corners.
#[derive(Clone, Copy, Debug)]
enum Number {
    Element(usize),
    Vertex(usize),
    /// The heat content of a node over its capacity, in K.
    Content(usize),
}

/// A course on its way.
pub(crate) struct Oracle<'a> {
    case: &'a Case,
    corners: Vec<(Number, f64)>,
    narrow: Vec<(Number, &'a Feature)>,
    /// Temperatures in degC; of a node that melts its heat content over its capacity in K, from the
    /// solid at its melting point on.
    state: Vec<f64>,
    time: f64,
    step: f64,
    blows: bool,
    /// The temperatures for which a massless node was solved last; none at first.
    last: RefCell<Vec<f64>>,
    /// Those at the start of the step.
    accepted: Vec<f64>,
    doubtful: Cell<bool>,
}

impl<'a> Oracle<'a> {
    pub(crate) fn new(case: &'a Case) -> Self {
        let narrow = narrow(case);
        let mut corners: Vec<(Number, f64)> = narrow
            .iter()
            .flat_map(|(number, feature)| feature.corners().into_iter().map(|at| (*number, at)))
            .collect();
        for (i, node) in case.nodes.iter().enumerate() {
            if let Some(melt) = melt(node) {
                corners.extend([(Number::Content(i), 0.0), (Number::Content(i), melt)]);
            }
        }
        let state: Vec<f64> = case.nodes.iter().map(start).collect();
        let last = RefCell::new(Vec::new());
        let (time, step) = (0.0, 1e-3);
        let doubtful = Cell::new(false);
        let (accepted, blows) = (Vec::new(), false);
        let mut made =
            Self { case, corners, narrow, state, time, step, blows, last, accepted, doubtful };
        made.switch();
        made.accepted = made.celsius();
        made
    }

    /// Whether some massless node may have had several temperatures.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.doubtful.get()
    }

    /// Temperatures of all vertices in degC.
    pub(crate) fn celsius(&self) -> Vec<f64> {
        self.of(&self.state)
    }

    fn of(&self, state: &[f64]) -> Vec<f64> {
        let nodes = self.case.nodes.iter().zip(state);
        let mut celsius: Vec<f64> = nodes.map(|(node, y)| temperature(node, *y)).collect();
        celsius.push(AIR);
        let massless =
            self.case.nodes.iter().position(|node| matches!(node.storage, Storage::Massless));
        if let Some(i) = massless {
            self.settle(i, &mut celsius);
        }
        celsius
    }

    /// Finds the temperature at which a massless node receives nothing, from the last one on.
    fn settle(&self, i: usize, celsius: &mut Vec<f64>) {
        let last = self.last.replace(Vec::new());
        let guess = last.get(i).copied().unwrap_or(self.case.nodes[0].start);
        let mut balance = |t: f64| {
            celsius[i] = t;
            self.case.heats(celsius, self.blows)[i]
        };
        let found = zero(&mut balance, guess);
        // a solution may end at a corner, so both sides are looked at
        let places: Vec<f64> = AROUND.iter().map(|d| found + d).collect();
        let around: Vec<f64> = places.iter().map(|t| balance(*t)).collect();
        let mut several = (1..places.len())
            .any(|k| around[k - 1] - around[k] < ONLY * (places[k] - places[k - 1]));
        if last.is_empty() {
            let mut places = (1..10_000).map(|k| 0.01 * f64::from(k));
            several |= places.any(|d| balance(found - d) < 0.0 || balance(found + d) > 0.0);
        }
        celsius[i] = found;
        let others = last.iter().zip(&*celsius).enumerate().filter(|(k, _)| *k != i);
        let moved = others.map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max);
        several |= !last.is_empty() && (found - guess).abs() > LEAP * moved + 1e-7;
        if several {
            self.doubtful.set(true);
        }
        self.last.replace(celsius.clone());
    }

    fn rates(&self, state: &[f64]) -> Vec<f64> {
        let celsius = self.of(state);
        let heats = self.case.heats(&celsius, self.blows);
        let rate = |(i, node): (usize, &Node)| match &node.storage {
            Storage::Massless => 0.0,
            Storage::Constant | Storage::Melts { .. } => heats[i] / node.capacity,
            Storage::Capacity(features) | Storage::Material(features) => {
                heats[i] / (node.capacity * factor(features, celsius[i]))
            }
        };
        self.case.nodes.iter().enumerate().map(rate).collect()
    }

    /// The classical method of Runge and Kutta.
    fn once(&self, state: &[f64], step: f64) -> Vec<f64> {
        let ahead = |rates: &[f64], part: f64| -> Vec<f64> {
            state.iter().zip(rates).map(|(y, rate)| y + part * step * rate).collect()
        };
        let k1 = self.rates(state);
        let k2 = self.rates(&ahead(&k1, 0.5));
        let k3 = self.rates(&ahead(&k2, 0.5));
        let k4 = self.rates(&ahead(&k3, 1.0));
        let mean = (0..k1.len()).map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
        ahead(&mean.collect::<Vec<f64>>(), 1.0)
    }

    /// Two half steps and the difference from a whole one, with what it tells put right.
    fn twice(&self, step: f64) -> (Vec<f64>, f64) {
        self.last.replace(self.accepted.clone());
        let whole = self.once(&self.state, step);
        self.last.replace(self.accepted.clone());
        let half = self.once(&self.once(&self.state, 0.5 * step), 0.5 * step);
        let error = half.iter().zip(&whole).map(|(a, b)| (a - b) / 15.0);
        let most = error.clone().fold(0.0, |most: f64, e| most.max(e.abs()));
        (half.iter().zip(error).map(|(y, e)| y + e).collect(), most)
    }

    fn number(&self, number: Number, celsius: &[f64], state: &[f64]) -> f64 {
        match number {
            Number::Element(i) => self.case.elements[i].number(celsius),
            Number::Vertex(vertex) => celsius[vertex],
            Number::Content(i) => state[i],
        }
    }

    /// How far each number is from its corner; the last is that of the fan.
    fn distances(&self, state: &[f64]) -> Vec<f64> {
        let celsius = self.of(state);
        let corners = self.corners.iter();
        let mut found: Vec<f64> =
            corners.map(|(number, at)| self.number(*number, &celsius, state) - at).collect();
        found.extend(self.case.fan.as_ref().map(|fan| fan.beyond(&celsius, self.blows)));
        found
    }

    /// Whether a step goes too far to see all that is narrow.
    fn goes_too_far(&self, state: &[f64]) -> bool {
        let (from, to) = (self.of(&self.state), self.of(state));
        self.narrow.iter().any(|(number, feature)| {
            let before = self.number(*number, &from, &self.state);
            (self.number(*number, &to, state) - before).abs() > feature.reach(before)
        })
    }

    /// Goes on to a time in s.
    pub(crate) fn to(&mut self, time: f64) {
        while time - self.time > 1e-12 * time && !self.is_doubtful() {
            let step = self.step.min(time - self.time);
            let (state, error) = self.twice(step);
            if step > 1e-9 && (error > FINE || self.goes_too_far(&state)) {
                self.step = 0.5 * step;
                continue;
            }
            let (taken, state) = self.cut(step, state);
            self.time += taken;
            self.state = state;
            let grown = (0.5 * FINE / error.max(1e-18)).powf(0.2).clamp(0.3, 1.5);
            self.step = self.step.min(step * grown).max(step * grown.min(1.5));
            self.switch();
            self.last.replace(self.accepted.clone());
            self.accepted = self.celsius();
        }
    }

    /// Ends a step at the first corner within.
    fn cut(&self, step: f64, state: Vec<f64>) -> (f64, Vec<f64>) {
        let before = self.distances(&self.state);
        let (mut step, mut state) = (step, state);
        for _ in 0..20 {
            let after = self.distances(&state);
            let passed = |i: &usize| {
                before[*i].abs() > 10.0 * MET
                    && after[*i].abs() > MET
                    && before[*i] * after[*i] < 0.0
            };
            let part = |i: usize| before[i] / (before[i] - after[i]);
            let Some(first) =
                (0..before.len()).filter(passed).min_by(|a, b| part(*a).total_cmp(&part(*b)))
            else {
                break;
            };
            step = self.place_of(first, [(0.0, before[first]), (step, after[first])]);
            state = self.twice(step).0;
        }
        (step, state)
    }

    /// The step after which a number meets its corner, between two.
    fn place_of(&self, number: usize, [mut a, mut b]: [(f64, f64); 2]) -> f64 {
        for _ in 0..60 {
            let step = a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1);
            let c = (step, self.distances(&self.twice(step).0)[number]);
            if c.1.abs() < MET {
                return step;
            }
            if c.1 * b.1 < 0.0 {
                a = b;
            } else {
                a.1 *= 0.5;
            }
            b = c;
        }
        b.0
    }

    fn switch(&mut self) {
        let Some(fan) = &self.case.fan else { return };
        let beyond = fan.beyond(&self.celsius(), self.blows);
        self.blows = if self.blows { beyond > MET } else { beyond >= -MET };
    }
}

/// Where a falling function is zero, from a guess on.
fn zero(function: &mut impl FnMut(f64) -> f64, guess: f64) -> f64 {
    let mut a = (guess, function(guess));
    let mut b = a;
    for k in 0..40 {
        b.0 = a.0 + 1e-3 * 1.6_f64.powi(k) * a.1.signum();
        b.1 = function(b.0);
        if a.1 * b.1 <= 0.0 {
            break;
        }
        a = b;
    }
    for _ in 0..100 {
        if a.1.abs() < 1e-12 || (a.0 - b.0).abs() < 1e-13 {
            break;
        }
        let t = a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1);
        let c = (t, function(t));
        // Illinois: the end that stays counts half
        b = if a.1 * c.1 <= 0.0 { a } else { (b.0, 0.5 * b.1) };
        a = c;
    }
    a.0
}

/// What is narrow, with what it reads.
fn narrow(case: &Case) -> Vec<(Number, &Feature)> {
    let mut narrow = Vec::new();
    for (i, element) in case.elements.iter().enumerate() {
        for feature in &element.features {
            if element.kind.is_property() {
                narrow.push((Number::Vertex(element.from), feature));
                narrow.push((Number::Vertex(element.to), feature));
            } else {
                narrow.push((Number::Element(i), feature));
            }
        }
    }
    if let Some(fan) = &case.fan {
        narrow.extend(fan.features.iter().map(|feature| (Number::Vertex(fan.other), feature)));
    }
    for (i, node) in case.nodes.iter().enumerate() {
        if let Storage::Capacity(features) | Storage::Material(features) = &node.storage {
            narrow.extend(features.iter().map(|feature| (Number::Vertex(i), feature)));
        }
    }
    narrow
}

/// The content of the liquid at its melting point over the capacity, in K.
fn melt(node: &Node) -> Option<f64> {
    let Storage::Melts { from, to, latent } = node.storage else { return None };
    Some(to - from + latent / node.capacity)
}

fn temperature(node: &Node, y: f64) -> f64 {
    let (Storage::Melts { from, to, .. }, Some(melt)) = (&node.storage, melt(node)) else {
        return y;
    };
    if y < 0.0 { from + y } else { (to - from) * (y / melt).min(1.0) + from + (y - melt).max(0.0) }
}

fn start(node: &Node) -> f64 {
    match (&node.storage, melt(node)) {
        (Storage::Melts { to, .. }, Some(melt)) if node.start > *to => node.start - to + melt,
        (Storage::Melts { from, .. }, _) => node.start - from,
        _ => node.start,
    }
}

/// The lowest and the highest of a number of temperatures in a run.
pub(crate) fn range(case: &Case, number: impl Fn(&[f64]) -> f64) -> (f64, f64) {
    let mut oracle = Oracle::new(case);
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for k in 0..=50 {
        oracle.to(case.stop * f64::from(k) / 50.0);
        let found = number(&oracle.celsius());
        range = (range.0.min(found), range.1.max(found));
    }
    range
}
