//! Modes as a page.

use std::io;

use lptn_network::Node;
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, duration, fixed, shortened};
use lptn_solve::{EventKind, Mode};
use lptn_study::SiValue;
use serde_json::{Map, Value, json};

use super::ModesAnswer;
use crate::about::{self, Known};
use crate::words::{MOST_NODES, count};

/// Most modes whose shapes are next to each other.
const MOST_SHAPES: usize = 6;

/// Nodes named for each mode.
const PARTNERS: usize = 3;

/// Letters for all of them and for one name, next to the other columns.
const PARTNERS_WIDTH: usize = 58;
const PARTNER_WIDTH: usize = 44;

impl ModesAnswer {
    /// One line per mode: its time constant, and the nodes that take most part in it.
    fn overview(&self) -> TextTable {
        let modes: Vec<(usize, &Mode)> = (1..).zip(self.modes.modes()).collect();
        let mut table = TextTable::of(&modes)
            .right("mode", |(number, _)| number.to_string())
            .right("tau", |(_, mode)| tau(mode));
        if self.modes.swing() {
            table = table.right("period", |(_, mode)| period(mode));
        }
        table.left("participation", |(_, mode)| self.partners(mode)).into()
    }

    /// The nodes that take most part, most first, those of equal part in the order of the file.
    fn partners(&self, mode: &Mode) -> String {
        let nodes = self.network().nodes();
        let mut parts: Vec<(f64, &str)> = mode
            .participation
            .iter()
            .zip(nodes)
            .map(|(&part, node)| (part, node.name.as_str()))
            .collect();
        // rounded, so that equal parts keep their order
        parts.sort_by_key(|part| std::cmp::Reverse(fixed(part.0, 6)));
        let shown = parts.iter().take(PARTNERS).filter(|(part, _)| *part >= 5e-4);
        let words = shown.map(|(part, name)| {
            format!("{} {} %", shortened(name, PARTNER_WIDTH), fixed(100.0 * part, 1))
        });
        let mut text = String::new();
        for word in words {
            let separator = if text.is_empty() { "" } else { ", " };
            if text.len() + separator.len() + word.len() <= PARTNERS_WIDTH {
                text += separator;
                text += &word;
            }
        }
        text
    }

    /// One line per node: its temperature in each of the slowest modes.
    fn shapes(&self) -> TextTable {
        let nodes: Vec<(usize, &Node)> =
            self.network().nodes().iter().take(MOST_NODES).enumerate().collect();
        let mut table = TextTable::of(&nodes).left("shape", |(_, node)| node.name.as_str());
        for (k, mode) in self.modes.modes().iter().take(MOST_SHAPES).enumerate() {
            table = table.right(format!("mode {}", k + 1), |(i, _)| fixed(mode.shape[*i], 3));
        }
        table.into()
    }

    /// Notes on everything that the tables leave out.
    fn notes(&self) -> Vec<String> {
        let mut notes = self.findings();
        let (modes, nodes) = (self.modes.modes().len(), self.network().nodes().len());
        if modes < self.all {
            notes
                .push(format!("the {modes} slowest of {} modes; --count N shows others", self.all));
        }
        if modes > MOST_SHAPES || nodes > MOST_NODES {
            notes.push("every shape and every node is in --format csv and json".to_owned());
        }
        notes
    }

    /// Notes on the modes themselves.
    fn findings(&self) -> Vec<String> {
        let lasting = self.modes.modes().iter().filter(|mode| mode.rate == 0.0).count();
        let mut notes = Vec::new();
        if self.all == 0 {
            notes.push("no node stores heat: temperatures follow the inputs at once".to_owned());
        }
        if let Some(point) = self.point.as_ref().filter(|_| self.all > 0) {
            notes.extend(point.notes(self.modes.tried()));
        }
        if self.modes.swing() {
            notes.push(
                "modes with a period oscillate: their shapes are amplitudes; --format csv and json \
                 have the phases"
                    .to_owned(),
            );
        }
        if self.modes.modes().iter().any(|mode| mode.rate < 0.0) {
            notes.push("a mode that grows: the network leaves this state by itself".to_owned());
        }
        // conductances that switch are refused, so these are sources and boundaries
        if let Some(kind) = EventKind::switching(self.network()).next() {
            let name = kind.name(self.network());
            notes.push(format!(
                "`{name}` switches heat; these modes are those between two switches"
            ));
        }
        if lasting > 0 {
            let verb = if lasting == 1 { "lasts" } else { "last" };
            let which = count(lasting, "mode");
            notes.push(format!(
                "{which} {verb} without end: no path leads from its nodes to a boundary"
            ));
        }
        notes
    }

    fn mode(&self, mode: &Mode) -> Value {
        let by_node = |values: &[f64], unit: &'static str| -> Map<String, Value> {
            let named = self.network().nodes().iter().zip(values);
            named.map(|(node, &x)| (node.name.clone(), json!(SiValue::new(x, unit)))).collect()
        };
        let mut members = json!({
            "tau": SiValue::new(mode.tau(), "s"),
            "shape": by_node(&mode.shape, "1"),
            "participation": by_node(&mode.participation, "1"),
        });
        if mode.omega != 0.0 {
            members["omega"] = json!(SiValue::new(mode.omega, "rad/s"));
            members["phase"] = json!(by_node(&mode.phase, "rad"));
        }
        members
    }
}

impl Page for ModesAnswer {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        if !self.modes.modes().is_empty() {
            text.section().table(self.overview());
            text.section().table(self.shapes());
        }
        text.section().notes(self.notes());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.modes.table(self.network()).into()
    }

    fn figures(&self) -> Vec<Figure> {
        if self.modes.modes().is_empty() { Vec::new() } else { vec![self.figure()] }
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let modes: Vec<Value> = self.modes.modes().iter().map(|mode| self.mode(mode)).collect();
        self.input.head(json, self.doubts_of_state())?;
        json.member("notes", &self.findings())?;
        json.member("count", &SiValue::new(count_as_number(self.all), "1"))?;
        if let Some(point) = &self.point {
            json.member("at", &point.json(self.modes.tried()))?;
        }
        json.member("modes", &modes)
    }
}

#[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53")]
fn count_as_number(n: usize) -> f64 {
    n as f64
}

fn tau(mode: &Mode) -> String {
    match mode.rate {
        0.0 => "infinite".to_owned(),
        rate if rate < 0.0 => format!("grows, {}", duration(-mode.tau(), 5)),
        _ => duration(mode.tau(), 5),
    }
}

fn period(mode: &Mode) -> String {
    match mode.omega {
        0.0 => "-".to_owned(),
        omega => duration(std::f64::consts::TAU / omega, 5),
    }
}
