//! What elements are made from: materials, fluids, tables, signals, parameters.

use super::Maker;
use crate::random::model::{Entry, Field, Piece, Side, constant, expression, number, piece};
use crate::random::units::{Kind, Number};

impl Maker {
    /// A material with that specific heat, about, and its name.
    pub(super) fn material(&mut self, cp: f64, density: f64, curved: bool) -> String {
        let name = self.fresh("mat");
        let mut entry = Entry::new("material", &name)
            .with("density", constant(density, Kind::Density))
            .with("k", constant(self.random.decades(0.2, 200.0), Kind::Conductivity));
        let form = if curved { self.random.below(4) } else { 4 };
        entry = entry.with("cp", self.specific_heat(cp, form));
        if form == 2 || form == 3 {
            let solid = self.random.between(30.0, 60.0);
            let width = if form == 2 { self.random.between(0.5, 8.0) } else { 0.0 };
            self.has(if form == 2 { "melting over a range" } else { "melting at one temperature" });
            entry = entry
                .with("solidus", constant(solid, Kind::Temperature))
                .with("liquidus", constant(solid + width, Kind::Temperature))
                .with("latent_heat", constant(self.random.between(5.0, 30.0) * cp, Kind::Latent));
        }
        self.has("material");
        self.add(entry);
        name
    }

    /// Form 0 is a table, 1 an expression; else it is constant.
    pub(super) fn specific_heat(&mut self, cp: f64, form: usize) -> Field {
        match form {
            0 => {
                self.has("cp table");
                let x = [-50.0, 20.0, 80.0, 150.0, 400.0].map(|x| constant(x, Kind::Temperature));
                let y = x
                    .each_ref()
                    .map(|_| constant(cp * self.random.between(0.7, 1.4), Kind::SpecificHeat));
                let interp = *self.random.pick(&["linear", "pchip"]);
                Field::Table(vec![
                    ("x".into(), Field::List(x.to_vec())),
                    ("y".into(), Field::List(y.to_vec())),
                    ("interp".into(), Field::Word(interp.into())),
                    ("outside".into(), Field::Word("hold".into())),
                ])
            }
            1 => {
                self.has("cp(T)");
                let slope = piece(self.random.between(0.0005, 0.003), Kind::PerKelvin);
                let parts = [
                    piece(cp, Kind::SpecificHeat),
                    slope,
                    Piece::Text("T".into()),
                    self.degrees(0.0, 30.0),
                ];
                Field::Value(expression("{} * (1 + {} * ({} - {}))", parts))
            }
            _ => constant(cp, Kind::SpecificHeat),
        }
    }

    /// A parameter that is a plain number around 1.
    pub(super) fn factor(&mut self) -> String {
        self.has("parameter");
        let name = self.fresh("k");
        let value = constant(self.random.between(0.7, 1.3), Kind::Plain);
        self.add(Entry::new("param", &name).with("", value));
        if self.random.chance(0.7) {
            return name;
        }
        self.has("parameter of a parameter");
        let other = self.fresh("k");
        let value = Field::Value(expression(
            "0.5 * ({} + {}^2)",
            [Piece::Name(name.clone()), Piece::Name(name)],
        ));
        self.add(Entry::new("param", &other).with("", value));
        other
    }

    /// A table of one argument from 0 to the last of `x`, whose values go from half to twice
    /// `size`.
    pub(super) fn table(
        &mut self,
        (x, of): (&[f64], Kind),
        (size, kind): (f64, Kind),
        rises: bool,
    ) -> String {
        let name = self.fresh("tab");
        let mut factors: Vec<f64> = x.iter().map(|_| self.random.between(0.5, 2.0)).collect();
        if rises {
            factors.sort_by(f64::total_cmp);
        }
        let interp = *self.random.pick(&["linear", "pchip"]);
        self.has(if interp == "linear" { "table" } else { "pchip table" });
        let y: Vec<Number> = factors.iter().map(|factor| number(size * factor, kind)).collect();
        let x: Vec<Number> = x.iter().map(|x| number(*x, of)).collect();
        let entry = Entry::new("table", &name);
        let entry = self.points(entry, [("x", x), ("y", y)], ["x", "value"]);
        let entry = entry.with("interp", Field::Word(interp.into()));
        self.add(entry.with("outside", Field::Word("hold".into())));
        name
    }

    /// Points as lists of quantities, or in a CSV file whose columns the keys `columns` name.
    fn points(
        &mut self,
        entry: Entry,
        points: [(&str, Vec<Number>); 2],
        columns: [&str; 2],
    ) -> Entry {
        if self.random.chance(0.3) {
            self.has("CSV file");
            let file = format!("{}.csv", entry.name);
            let heads = ["first", "second"];
            let numbers =
                heads.iter().zip(points).map(|(head, (_, numbers))| ((*head).to_owned(), numbers));
            self.net.sides.push((file.clone(), Side::Numbers(numbers.collect())));
            let entry = entry.with("csv", Field::Word(file));
            return columns
                .iter()
                .zip(heads)
                .fold(entry, |entry, (key, head)| entry.with(key, Field::Word(head.into())));
        }
        points.into_iter().fold(entry, |entry, (key, numbers)| {
            let list = numbers.into_iter().map(|number| Field::Value(vec![Piece::Number(number)]));
            entry.with(key, Field::List(list.collect()))
        })
    }

    /// A table of two plain numbers from 0 to 1, with values around 1.
    pub(super) fn map(&mut self) -> String {
        self.has("table of two arguments");
        let name = self.fresh("map");
        let axis = [0.0, 0.3, 1.0];
        let grid: Vec<(f64, f64)> = axis.iter().flat_map(|x| axis.map(|y| (*x, y))).collect();
        let column = |of: &dyn Fn(&(f64, f64)) -> f64| {
            grid.iter().map(|at| number(of(at), Kind::Plain)).collect()
        };
        let values =
            grid.iter().map(|_| number(self.random.between(0.7, 1.3), Kind::Plain)).collect();
        let columns = vec![
            ("x".to_owned(), column(&|at| at.0)),
            ("y".to_owned(), column(&|at| at.1)),
            ("value".to_owned(), values),
        ];
        let file = format!("{name}.csv");
        self.net.sides.push((file.clone(), Side::Numbers(columns)));
        let word = |text: &str| Field::Word(text.into());
        let entry = Entry::new("table", &name)
            .with("csv", word(&file))
            .with("x", word("x"))
            .with("y", word("y"));
        self.add(entry.with("value", word("value")).with("outside", word("hold")));
        name
    }

    /// A signal with values in that range.
    pub(super) fn signal(&mut self, kind: Kind, (low, high): (f64, f64)) -> String {
        let name = self.fresh("sig");
        let stop = self.stop;
        if kind == Kind::Plain && self.random.chance(0.3) {
            self.has("signal expression");
            let period = piece(self.random.between(0.3, 3.0) * stop, Kind::Time);
            let mean = piece(0.5 * (low + high), Kind::Plain);
            let value = expression("{} + 0.3 * sin(2 * pi * {} / {})", [mean, Piece::Time, period]);
            self.add(Entry::new("signal", &name).with("", Field::Value(value)));
            return name;
        }
        let after = *self.random.pick(&["error", "hold", "repeat"]);
        self.has(match after {
            "error" => "signal to the end",
            "hold" => "signal that holds",
            _ => "signal that repeats",
        });
        let reach = match after {
            "error" => stop,
            "hold" => self.random.between(0.3, 1.2) * stop,
            _ => self.random.between(0.2, 0.7) * stop,
        };
        let count = 3 + self.random.below(4);
        let t = (0..count)
            .map(|i| number(reach * i as f64 / (count - 1) as f64, Kind::Instant))
            .collect();
        let v = (0..count).map(|_| number(self.random.between(low, high), kind)).collect();
        let interp = *self.random.pick(&["linear", "pchip", "previous"]);
        self.has(match interp {
            "linear" => "linear signal",
            "pchip" => "pchip signal",
            _ => "previous signal",
        });
        let mut entry =
            self.points(Entry::new("signal", &name), [("t", t), ("v", v)], ["time", "value"]);
        entry = entry
            .with("interp", Field::Word(interp.into()))
            .with("after_end", Field::Word(after.into()));
        // its ends differ, so it has to say how long a round is
        if after == "repeat" {
            let longer = self.random.chance(0.5);
            let part = if longer { self.random.between(1.05, 1.5) } else { 1.001 };
            entry = entry.with("period", constant(part * reach, Kind::Time));
        }
        self.add(entry);
        name
    }
}
