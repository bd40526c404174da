//! Values of paths and sources: constant, over time, and over temperatures.

use super::Maker;
use crate::random::model::{Piece, expression, name, piece};
use crate::random::units::Kind;

/// A value, how much larger than its size it may become, and its relative change for 1 K.
pub struct Varied {
    pub pieces: Vec<Piece>,
    pub most: f64,
    pub per_kelvin: f64,
}

/// Where a value stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Of a path between nodes that store heat, or with a junction at an end.
    Path { junction: bool },
    /// Of a source of one node.
    Source,
    /// Of a source of several nodes.
    Shared,
}

impl Varied {
    /// A bound on the change of the heat of a path of that conductance for 1 K at one end, in W/K.
    pub fn slope(&self, conductance: f64) -> f64 {
        conductance * (self.most + WIDEST * self.per_kelvin)
    }
}

/// No two temperatures are further apart than this, in K.
const WIDEST: f64 = 300.0;

fn text(words: &str) -> Piece {
    Piece::Text(words.into())
}

impl Maker {
    /// A value of about `size`.
    pub(super) fn value(&mut self, size: f64, kind: Kind, place: Place) -> Varied {
        let number = piece(size, kind);
        if self.random.chance(0.45) {
            self.has("constant value");
            return Varied { pieces: vec![number], most: 1.0, per_kelvin: 0.0 };
        }
        if self.curved() && self.random.chance(0.5) {
            return self.over_temperature((size, kind), place);
        }
        Varied { pieces: self.over_time(number), most: 2.0, per_kelvin: 0.0 }
    }

    fn over_time(&mut self, number: Piece) -> Vec<Piece> {
        let period = piece(self.random.between(0.3, 3.0) * self.stop, Kind::Time);
        match self.random.below(6) {
            0 => {
                self.has("sine of t");
                expression("{} * (1 + 0.4 * sin(2 * pi * {} / {}))", [number, Piece::Time, period])
            }
            1 => {
                self.has("comparison of t");
                let at = piece(self.moment(), Kind::Time);
                let factor = piece(self.random.between(0.3, 1.9), Kind::Plain);
                expression("{} * if({} < {}, 1, {})", [number, Piece::Time, at, factor])
            }
            2 => {
                let signal = self.signal(Kind::Plain, (0.3, 1.7));
                expression("{} * {}", [number, name(signal)])
            }
            3 => {
                let map = self.map();
                let (x, y) = (piece(self.random.between(0.0, 1.0), Kind::Plain), self.stop);
                let part = [number, name(map), x, Piece::Time, piece(y, Kind::Time)];
                expression("{} * {}({}, {} / {})", part)
            }
            4 => match self.control() {
                Some(control) => expression("{} * (1 + 0.8 * {})", [number, name(control)]),
                None => vec![number],
            },
            _ => {
                let factor = self.factor();
                expression("{} * {}", [number, name(factor)])
            }
        }
    }

    fn over_temperature(&mut self, (size, kind): (f64, Kind), place: Place) -> Varied {
        let number = piece(size, kind);
        let zero = self.degrees(0.0, 40.0);
        let other = self.temperature_of_a_place();
        let choice = self.random.below(5);
        let (pieces, most, per_kelvin) = match (choice, place) {
            (0, Place::Path { junction }) => {
                self.has("table of dT");
                // where a film falls with dT faster than dT grows, a junction can have more than
                // one temperature
                let table = self.table(
                    (&[0.0, 15.0, 40.0, 90.0, 200.0], Kind::Difference),
                    (size, kind),
                    junction,
                );
                (expression("{}(abs(dT))", [name(table)]), 2.0, 0.15)
            }
            (1, Place::Path { .. }) if kind != Kind::Resistance => {
                self.has("power of dT");
                (expression("{} * (abs(dT) / 10 [K])^(1/4)", [number]), 3.0, 0.0)
            }
            (2, _) => {
                self.has("temperature of another place");
                let width = piece(self.random.between(10.0, 40.0), Kind::Difference);
                let parts = [number, other, zero, width];
                (expression("{} * (1 + 0.3 * tanh(({} - {}) / {}))", parts), 1.3, 0.03)
            }
            (3, Place::Path { junction: false }) if kind != Kind::Resistance => {
                self.has("comparison of temperatures");
                let warm = self.degrees(25.0, 60.0);
                // less cooling where it is hot: what works against itself would chatter
                let parts = [number, Piece::Name(format!("{}.T", self.state())), warm];
                (expression("{} * if({} > {}, 0.8, 1)", parts), 1.0, 0.0)
            }
            (3, Place::Source) => {
                self.has("comparison of temperatures");
                let warm = self.degrees(25.0, 60.0);
                (expression("{} * if(T > {}, 1.1, 1)", [number, warm]), 1.1, 0.0)
            }
            _ => {
                self.has("temperature coefficient");
                let own = match place {
                    Place::Path { .. } => text("T_mean"),
                    Place::Source => text("T"),
                    Place::Shared => other,
                };
                let slope = piece(self.random.between(0.0005, 0.004), Kind::PerKelvin);
                (expression("{} * (1 + {} * ({} - {}))", [number, slope, own, zero]), 2.0, 0.004)
            }
        };
        Varied { pieces, most, per_kelvin }
    }
}
