//! Paths: resistors, conduction, contacts, films, radiation, streams.

use super::Maker;
use super::values::Place;
use crate::random::model::{Entry, Field, Piece, constant, piece};
use crate::random::units::Kind;

impl Maker {
    /// Joins every node to one before it or to a boundary, and some more.
    pub(super) fn connect(&mut self) {
        let (states, junctions) = (self.states.clone(), self.massless.clone());
        for (i, node) in states.iter().enumerate() {
            let back = self.random.below(i + self.boundaries.len());
            let to =
                states[..i].iter().chain(&self.boundaries).nth(back).cloned().expect("a place");
            self.path(node, &to, false);
        }
        for node in &junctions {
            // two ends at least, and they differ
            let mut ends: Vec<String> = states.iter().chain(&self.boundaries).cloned().collect();
            self.random.shuffle(&mut ends);
            ends.iter().take(2 + self.random.below(2)).for_each(|end| self.path(node, end, true));
        }
        for _ in 0..self.random.below(3) {
            let (from, to) = (self.place(), self.state());
            if from != to {
                self.path(&from, &to, false);
            }
        }
        if self.random.chance(0.4) {
            self.stream();
        }
    }

    fn path(&mut self, from: &str, to: &str, junction: bool) {
        let (from, to) = if self.random.chance(0.5) { (from, to) } else { (to, from) };
        let conductance = self.random.decades(0.1, 5.0);
        let name = self.fresh("p");
        let ends = |kind: &str| {
            let entry = Entry::new(kind, &name);
            entry.with("from", Field::Name(from.into())).with("to", Field::Name(to.into()))
        };
        let place = Place::Path { junction };
        let entry = match self.random.below(if self.curved() { 8 } else { 6 }) {
            0 | 1 => self.resistor(ends("resistor"), conductance, place),
            2 => self.contact(ends("contact"), conductance, place),
            3 | 4 => self.conduction(ends("conduction"), conductance, place),
            5 => self.convection(ends("convection"), conductance, place),
            _ => self.radiation(ends("radiation"), conductance, place),
        };
        self.add(entry);
    }

    fn resistor(&mut self, entry: Entry, conductance: f64, place: Place) -> Entry {
        let (key, size, kind) = match self.random.chance(0.5) {
            true => ("R", 1.0 / conductance, Kind::Resistance),
            false => ("G", conductance, Kind::Conductance),
        };
        self.has(if key == "R" { "resistor R" } else { "resistor G" });
        let value = self.value(size, kind, place);
        // a resistance may fall as far as a conductance may rise
        let slope = value.slope(conductance) * if key == "R" { 3.0 } else { 1.0 };
        entry.with(key, Field::Value(value.pieces)).slope(slope)
    }

    fn contact(&mut self, entry: Entry, conductance: f64, place: Place) -> Entry {
        self.has("contact");
        let area = self.random.decades(1e-4, 1e-2);
        let value = self.value(conductance / area, Kind::Film, place);
        let slope = value.slope(conductance);
        entry
            .with("h", Field::Value(value.pieces))
            .with("area", constant(area, Kind::Area))
            .slope(slope)
    }

    fn convection(&mut self, entry: Entry, conductance: f64, place: Place) -> Entry {
        if self.random.chance(0.2) {
            self.has("convection R");
            let value = self.value(1.0 / conductance, Kind::Resistance, place);
            let slope = 3.0 * value.slope(conductance);
            return entry.with("R", Field::Value(value.pieces)).slope(slope);
        }
        self.has("convection h");
        let area = self.random.decades(0.01, 0.3);
        let value = self.value(conductance / area, Kind::Film, place);
        let slope = value.slope(conductance);
        entry
            .with("h", Field::Value(value.pieces))
            .with("area", constant(area, Kind::Area))
            .slope(slope)
    }

    fn conduction(&mut self, entry: Entry, conductance: f64, place: Place) -> Entry {
        let length = self.random.decades(0.005, 0.5);
        let (r_in, wall) = (self.random.decades(0.01, 0.1), self.random.decades(0.002, 0.05));
        let r_out = r_in + wall;
        let (shape, of_k, measures) = match self.random.below(4) {
            0 => {
                let area = self.random.decades(1e-4, 1e-1);
                let measures =
                    vec![("area", area, Kind::Area), ("thickness", length, Kind::Length)];
                ("slab", area / length, measures)
            }
            1 => {
                let shell = std::f64::consts::TAU * length / (r_out / r_in).ln();
                ("cylinder", shell, vec![("length", length, Kind::Length)])
            }
            2 => ("sphere", 2.0 * std::f64::consts::TAU / (1.0 / r_in - 1.0 / r_out), vec![]),
            _ => {
                let measures =
                    vec![("diameter", r_in, Kind::Length), ("length", length, Kind::Length)];
                ("rod", std::f64::consts::PI * r_in * r_in / (4.0 * length), measures)
            }
        };
        self.has(match shape {
            "slab" => "slab",
            "cylinder" => "cylinder",
            "sphere" => "sphere",
            _ => "rod",
        });
        let radii = [("r_in", r_in, Kind::Length), ("r_out", r_out, Kind::Length)];
        let radii = radii.into_iter().filter(|_| matches!(shape, "cylinder" | "sphere"));
        let (entry, slope) = self.conductivity(entry, (conductance, of_k), place);
        let entry = entry.with("shape", Field::Word(shape.into()));
        measures
            .into_iter()
            .chain(radii)
            .fold(entry, |entry, (key, size, kind)| entry.with(key, constant(size, kind)))
            .slope(slope)
    }

    /// `k`, or a material that has one, for a conductance of `of_k` times k.
    fn conductivity(
        &mut self,
        entry: Entry,
        (conductance, of_k): (f64, f64),
        place: Place,
    ) -> (Entry, f64) {
        if self.random.chance(0.8) {
            let value = self.value(conductance / of_k, Kind::Conductivity, place);
            let slope = value.slope(conductance);
            return (entry.with("k", Field::Value(value.pieces)), slope);
        }
        self.has("conduction of a material");
        let name = self.fresh("mat");
        let k = constant(conductance / of_k, Kind::Conductivity);
        self.add(Entry::new("material", &name).with("k", k));
        (entry.with("material", Field::Name(name)), conductance)
    }

    fn radiation(&mut self, entry: Entry, conductance: f64, place: Place) -> Entry {
        // 4 sigma T^3 is 6 W/(m^2 K) at 300 K and 63 at 650 K
        let exchange = conductance / 6.0;
        let slope = 63.0 * exchange;
        match self.random.below(3) {
            0 => {
                self.has("radiation Gr");
                let value = self.value(exchange, Kind::Area, place);
                let slope = value.slope(slope);
                entry.with("Gr", Field::Value(value.pieces)).slope(slope)
            }
            1 => {
                self.has("radiation of an emissivity");
                let (e, view) = (self.random.between(0.2, 0.95), self.random.between(0.3, 1.0));
                let entry = entry.with("emissivity", constant(e, Kind::Plain));
                let entry = entry.with("area", constant(exchange / e / view, Kind::Area));
                entry.with("view_factor", constant(view, Kind::Plain)).slope(slope)
            }
            _ => {
                self.has("radiation of two plates");
                let plates = [0.0; 2].map(|_| self.random.between(0.2, 0.95));
                let e = 1.0 / (1.0 / plates[0] + 1.0 / plates[1] - 1.0);
                let plates = plates.map(|e| constant(e, Kind::Plain));
                let entry = entry.with("emissivity", Field::List(plates.to_vec()));
                entry.with("area", constant(exchange / e, Kind::Area)).slope(slope)
            }
        }
    }

    /// A stream from a boundary through some nodes to a boundary.
    fn stream(&mut self) {
        let rate = self.random.decades(0.2, 5.0);
        let (mut stops, first) = (self.states.clone(), self.random.pick(&self.boundaries).clone());
        self.random.shuffle(&mut stops);
        stops.truncate(1 + self.random.below(2));
        let last = self.random.pick(&self.boundaries).clone();
        let (keys, slope) = self.flow(rate);
        let ends: Vec<String> = [first].into_iter().chain(stops).chain([last]).collect();
        for pair in ends.windows(2) {
            let name = self.fresh("f");
            let entry = Entry::new("advection", &name);
            let entry = entry
                .with("from", Field::Name(pair[0].clone()))
                .with("to", Field::Name(pair[1].clone()));
            let entry =
                keys.iter().fold(entry, |entry, (key, field)| entry.with(key, field.clone()));
            self.add(entry.slope(slope));
        }
    }

    /// The keys of a stream with that capacity rate, about, and a bound on it.
    fn flow(&mut self, rate: f64) -> (Vec<(&'static str, Field)>, f64) {
        if self.random.chance(0.4) {
            self.has("advection mcp");
            let value = self.value(rate, Kind::Conductance, Place::Shared);
            let slope = value.slope(rate);
            return (vec![("mcp", Field::Value(value.pieces))], slope);
        }
        let (cp, density) =
            (self.random.between(1000.0, 4200.0), self.random.between(700.0, 1100.0));
        let fluid = self.fresh("flu");
        let form = if self.curved() { self.random.below(3) } else { 2 };
        self.has(if form == 2 { "fluid" } else { "fluid of cp(T)" });
        let heat = self.specific_heat(cp, form);
        let entry = Entry::new("fluid", &fluid)
            .with("cp", heat)
            .with("density", constant(density, Kind::Density));
        self.add(entry);
        let fluid = ("fluid", Field::Name(fluid));
        if self.random.chance(0.5) {
            self.has("mass flow");
            return (vec![fluid, ("flow", constant(rate / cp, Kind::MassFlow))], 3.0 * rate);
        }
        self.has("volume flow");
        let flow = Field::Value(vec![piece(rate / cp / density, Kind::VolumeFlow)]);
        let at: Piece = self.degrees(10.0, 60.0);
        (vec![fluid, ("flow", flow), ("flow_T", Field::Value(vec![at]))], 3.0 * rate)
    }
}
