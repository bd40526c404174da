//! Blocks that are cut into cells.

use super::Maker;
use crate::random::model::{Entry, Field, constant, piece};
use crate::random::units::Kind;

impl Maker {
    pub(super) fn grid(&mut self) {
        if !self.random.chance(0.2) {
            return;
        }
        let grid = self.fresh("g");
        let size = [0.0; 3].map(|_| self.random.decades(0.01, 0.1));
        let counts: Vec<usize> =
            (0..1 + self.random.below(2)).map(|_| 1 + self.random.below(3)).collect();
        self.has(if counts.len() > 1 { "grid in two dimensions" } else { "grid" });
        let lengths = size.map(|length| constant(length, Kind::Length)).to_vec();
        let start = self.degrees(10.0, 60.0);
        let (k, density) = (self.random.decades(0.5, 100.0), self.random.between(800.0, 4000.0));
        let entry = Entry::new("grid", &grid)
            .with("size", Field::List(lengths))
            .with("cells", Field::Raw(format!("{counts:?}")))
            .with("k", constant(k, Kind::Conductivity))
            .with("density", constant(density, Kind::Density))
            .with("cp", constant(self.random.between(500.0, 2000.0), Kind::SpecificHeat))
            .with("T0", Field::Value(vec![start]));
        self.add(entry);
        let (film, to) = (self.random.decades(5.0, 500.0), self.place());
        let skin = self.fresh("p");
        let (from, to) = (Field::Name(format!("{grid}.x1")), Field::Name(to));
        let entry = Entry::new("convection", &skin).with("from", from).with("to", to);
        let entry = entry.with("h", Field::Value(vec![piece(film, Kind::Film)]));
        self.add(entry.slope(film * size[1] * size[2]));
        let into = [format!("{grid}.x0"), grid.clone()];
        let into = self.random.pick(&into).clone();
        let source = self.fresh("s");
        let heat = constant(self.random.decades(0.1, 5.0), Kind::Heat);
        self.add(Entry::new("source", &source).with("into", Field::Name(into)).with("P", heat));
    }
}
