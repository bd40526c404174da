//! Boundaries, nodes and capacitors.

use super::Maker;
use crate::random::model::{Entry, Field, Piece, constant, expression, piece};
use crate::random::units::Kind;

impl Maker {
    pub(super) fn boundaries(&mut self) {
        for _ in 0..1 + self.random.below(2) {
            let value = self.course_of_temperature();
            let name = self.fresh("b");
            self.add(Entry::new("boundary", &name).with("T", Field::Value(value)));
            self.boundaries.push(name);
        }
    }

    /// The temperature of a boundary.
    fn course_of_temperature(&mut self) -> Vec<Piece> {
        let degrees = self.degrees(0.0, 40.0);
        let swing = piece(self.random.between(2.0, 20.0), Kind::Difference);
        let period = piece(self.random.between(0.3, 3.0) * self.stop, Kind::Time);
        match self.random.below(6) {
            0 => {
                self.has("boundary that swings");
                expression("{} + {} * sin(2 * pi * {} / {})", [degrees, swing, Piece::Time, period])
            }
            1 => {
                self.has("boundary that jumps");
                let at = piece(self.moment(), Kind::Time);
                let then = self.degrees(0.0, 60.0);
                expression("if({} < {}, {}, {})", [Piece::Time, at, degrees, then])
            }
            2 => {
                let signal = self.signal(Kind::Temperature, (0.0, 50.0));
                vec![Piece::Name(signal)]
            }
            3 => {
                self.has("parameter of a temperature");
                let parameter = self.fresh("T_");
                self.add(Entry::new("param", &parameter).with("", Field::Value(vec![degrees])));
                expression("{} + {}", [Piece::Name(parameter), swing])
            }
            _ => {
                self.has("boundary");
                vec![degrees]
            }
        }
    }

    pub(super) fn nodes(&mut self) {
        for _ in 0..1 + self.random.below(4) {
            let name = self.fresh("n");
            let entry = Entry::new("node", &name);
            let entry = self.capacity(entry);
            let start = self.degrees(0.0, 70.0);
            self.add(entry.with("T0", Field::Value(vec![start])));
            self.states.push(name);
        }
        for _ in 0..self.random.below(3) {
            self.has("massless");
            let name = self.fresh("m");
            self.add(Entry::new("node", &name).with("massless", Field::Raw("true".into())));
            self.massless.push(name);
        }
    }

    fn capacity(&mut self, entry: Entry) -> Entry {
        let size = self.random.decades(20.0, 2000.0);
        match self.random.below(if self.curved() { 6 } else { 3 }) {
            0 => {
                self.has("capacitor");
                for _ in 0..1 + self.random.below(2) {
                    let name = self.fresh("c");
                    let part = Entry::new("capacitor", &name)
                        .with("node", Field::Name(entry.name.clone()));
                    self.add(part.with("C", constant(0.7 * size, Kind::Capacity)));
                }
                entry
            }
            1 => self.made_of(entry, size, false),
            3 => {
                self.has("C(T)");
                let slope = piece(self.random.between(0.0005, 0.004), Kind::PerKelvin);
                let zero = self.degrees(0.0, 30.0);
                let c = piece(size, Kind::Capacity);
                let value = expression(
                    "{} * (1 + {} * ({} - {}))",
                    [c, slope, Piece::Text("T".into()), zero],
                );
                entry.with("C", Field::Value(value))
            }
            4 => self.made_of(entry, size, true),
            _ => {
                self.has("node");
                entry.with("C", constant(size, Kind::Capacity))
            }
        }
    }

    /// A capacity of about `size` J/K from a material.
    fn made_of(&mut self, entry: Entry, size: f64, curved: bool) -> Entry {
        let (cp, density) =
            (self.random.between(400.0, 4000.0), self.random.between(800.0, 8000.0));
        let material = self.material(cp, density, curved);
        let entry = entry.with("material", Field::Name(material));
        if self.random.chance(0.5) {
            self.has("mass of a material");
            entry.with("mass", constant(size / cp, Kind::Mass))
        } else {
            self.has("volume of a material");
            entry.with("volume", constant(size / cp / density, Kind::Volume))
        }
    }
}
