//! Controls, sources, limits, reports and windows.

use super::Maker;
use super::values::Place;
use crate::random::model::{Entry, Field, Piece, constant, expression, name, piece};
use crate::random::units::Kind;

impl Maker {
    pub(super) fn controls(&mut self) {
        if !self.curved() || !self.random.chance(0.35) {
            return;
        }
        let fan = self.fresh("fan");
        let middle = self.random.between(25.0, 60.0);
        let half = self.random.between(1.0, 8.0);
        let cools = self.random.chance(0.5);
        let keys = if cools { ["on_above", "off_below"] } else { ["off_above", "on_below"] };
        self.has(if cools { "control that cools" } else { "control that heats" });
        let mut entry = Entry::new("control", &fan).with("sense", Field::Name(self.state()));
        for (key, at) in keys.iter().zip([middle + half, middle - half]) {
            entry = entry.with(key, constant(at, Kind::Temperature));
        }
        if self.random.chance(0.3) {
            self.has("dwell time");
            entry = entry.with(
                "min_dwell",
                constant(self.random.between(0.01, 0.05) * self.stop, Kind::Time),
            );
        }
        if self.random.chance(0.3) {
            entry = entry.with("start", Field::Word("on".into()));
        }
        self.add(entry);
    }

    /// A control that may be used.
    pub(super) fn control(&mut self) -> Option<String> {
        let names: Vec<String> = self.net.of("control").map(|entry| entry.name.clone()).collect();
        if names.is_empty() { None } else { Some(self.random.pick(&names).clone()) }
    }

    pub(super) fn sources(&mut self) {
        for _ in 0..1 + self.random.below(2) {
            let source = self.fresh("s");
            let entry = Entry::new("source", &source);
            let shared = self.states.len() > 1 && self.random.chance(0.3);
            let (into, place) = if shared {
                self.has("source with shares");
                let share = self.random.between(0.1, 0.9);
                let mut nodes = self.states.clone();
                self.random.shuffle(&mut nodes);
                // the two shares have to sum to 1
                let shares = [share, 1.0 - share];
                (Field::Shares(nodes.into_iter().zip(shares).collect()), Place::Shared)
            } else {
                (Field::Name(self.state()), Place::Source)
            };
            let heat = self.random.decades(1.0, 40.0);
            let (value, slope) = self.heat(heat, place);
            self.add(entry.with("into", into).with("P", Field::Value(value)).slope(slope));
        }
        // a heater that the control switches
        if let Some(control) = self.control() {
            let cools = self.net.of("control").any(|entry| entry.get("on_above").is_some());
            let (heat, into, source) =
                (self.random.decades(5.0, 60.0), self.state(), self.fresh("s"));
            let heat = piece(if cools { -0.2 * heat } else { heat }, Kind::Heat);
            let value = Field::Value(expression("{} * {}", [heat, name(control)]));
            let entry = Entry::new("source", &source).with("into", Field::Name(into));
            self.add(entry.with("P", value));
        }
    }

    fn heat(&mut self, heat: f64, place: Place) -> (Vec<Piece>, f64) {
        match self.random.below(5) {
            0 => {
                self.has("signal of heat");
                (vec![name(self.signal(Kind::Heat, (0.0, 2.0 * heat)))], 0.0)
            }
            1 => {
                self.has("table of a signal");
                let speed = self.signal(Kind::Speed, (0.0, 3000.0));
                let table = self.table(
                    (&[0.0, 1000.0, 2000.0, 4000.0], Kind::Speed),
                    (heat, Kind::Heat),
                    false,
                );
                (expression("{}({})", [name(table), name(speed)]), 0.0)
            }
            _ => {
                self.has("source");
                let value = self.value(heat, Kind::Heat, place);
                let slope = value.per_kelvin * heat;
                (value.pieces, slope)
            }
        }
    }

    pub(super) fn outputs(&mut self) {
        if self.random.chance(0.4) {
            self.has("limit");
            let limit = self.fresh("lim");
            let of = Field::Value(vec![Piece::Name(format!("{}.T", self.state()))]);
            let at = constant(self.random.between(40.0, 120.0), Kind::Temperature);
            let key = *self.random.pick(&["below", "above"]);
            let entry = Entry::new("limit", &limit).with("of", of).with(key, at);
            self.add(entry.with("severity", Field::Word("warning".into())).slope(1.0));
        }
        if self.random.chance(0.4) {
            self.has("report");
            let report = self.fresh("rep");
            let places = [self.temperature_of_a_place(), self.temperature_of_a_place()];
            self.net.entries.push(
                Entry::new("report", &report)
                    .with("", Field::Value(expression("{} - {}", places)))
                    .slope(2.0),
            );
        }
        if self.random.chance(0.4) {
            self.has("window");
            let window = self.fresh("win");
            let (from, to) = (self.random.between(0.0, 0.4), self.random.between(0.5, 1.0));
            let at = |part: f64| constant(part * self.stop, Kind::Instant);
            let entry = Entry::new("window", &window).with("from", at(from)).with("to", at(to));
            self.net.entries.push(entry);
        }
    }
}
