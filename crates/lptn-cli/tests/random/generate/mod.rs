//! Random networks of every kind of element.

mod ends;
mod grids;
mod paths;
mod rest;
mod supply;
mod values;

use super::model::{Entry, Field, Net, Piece, TOLERANCE, constant, number};
use super::random::Random;
use super::units::Kind;

/// A network under way.
pub struct Maker {
    pub random: Random,
    pub net: Net,
    /// End of the run in s.
    pub stop: f64,
    /// Nodes with capacity.
    pub states: Vec<String>,
    pub massless: Vec<String>,
    pub boundaries: Vec<String>,
    count: usize,
}

/// The network of a seed: every third is linear.
pub fn network(seed: u64) -> Net {
    let mut random = Random::new(seed);
    let stop = random.decades(300.0, 5000.0).round();
    let net = Net { linear: seed.is_multiple_of(3), ..Net::default() };
    let lists = || Vec::new();
    let mut maker = Maker {
        random,
        net,
        stop,
        states: lists(),
        massless: lists(),
        boundaries: lists(),
        count: 0,
    };
    maker.run();
    maker.boundaries();
    maker.nodes();
    maker.controls();
    maker.connect();
    maker.grid();
    maker.sources();
    maker.outputs();
    maker.net.features.sort_unstable();
    maker.net.features.dedup();
    maker.net
}

impl Maker {
    /// A name that nothing has yet.
    pub fn fresh(&mut self, stem: &str) -> String {
        self.count += 1;
        format!("{stem}{}", self.count)
    }

    pub fn add(&mut self, entry: Entry) {
        let long = self.random.chance(0.2) && entry.fields.iter().all(|(key, _)| !key.is_empty());
        let long = long && !entry.name.is_empty();
        self.net.entries.push(Entry { long, ..entry });
    }

    pub fn has(&mut self, feature: &'static str) {
        self.net.features.push(feature);
    }

    /// Whether what is not linear may be used.
    pub fn curved(&self) -> bool {
        !self.net.linear
    }

    /// A time inside the run, on a round part of it: rows and jumps may meet.
    pub fn moment(&mut self) -> f64 {
        let part = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75];
        if self.random.chance(0.5) {
            self.stop * self.random.pick(&part)
        } else {
            self.random.between(0.05 * self.stop, 0.95 * self.stop)
        }
    }

    fn run(&mut self) {
        let stop = self.stop;
        let rows = if self.random.chance(0.5) {
            self.has("output every");
            ("every".to_owned(), constant(stop / 16.0, Kind::Time))
        } else {
            self.has("output at");
            let times = (1..=16).map(|i| constant(stop * f64::from(i) / 16.0, Kind::Instant));
            ("at".to_owned(), Field::List(times.collect()))
        };
        let mut run = Entry::new("run", "")
            .with("start", constant(0.0, Kind::Instant))
            .with("stop", constant(stop, Kind::Instant))
            .with("output", Field::Table(vec![rows]));
        run = run.with("tolerance", constant(TOLERANCE, Kind::Difference));
        self.net.entries.push(run);
    }

    /// Any node or boundary.
    pub fn place(&mut self) -> String {
        let all = self.states.len() + self.boundaries.len();
        let at = self.random.below(all);
        self.states.iter().chain(&self.boundaries).nth(at).cloned().expect("a place")
    }

    pub fn state(&mut self) -> String {
        self.random.pick(&self.states).clone()
    }

    /// `NAME.T` of a node or boundary.
    pub fn temperature_of_a_place(&mut self) -> Piece {
        Piece::Name(format!("{}.T", self.place()))
    }

    pub fn degrees(&mut self, low: f64, high: f64) -> Piece {
        Piece::Number(number(self.random.between(low, high), Kind::Temperature))
    }
}
