//! Gears as a page.

use std::io;

use lptn_netlist::{Arrangement, Gearbox, Member};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, RowColumn, Rows, Text, significant};
use lptn_study::{GearState, MemberState, MeshTeeth, PartLoss, SiValue};
use serde_json::{Value, json};

use super::tables::{of_all, rpm, warmest};
use super::{Block, GearAnswer};
use crate::about::{self, Known};
use crate::ranges;

/// A piece of a table: name and unit of its column, and the value, if it has one.
type Cell = (String, String, Option<f64>);

impl GearAnswer {
    /// Text on a stage: `planetary, ring held, 18/42/102 teeth, 3 planets, ratio 6.667`.
    fn stage(&self, gearbox: &Gearbox) -> String {
        let network = &self.input.netlist.network;
        let teeth = |member: &Member| {
            let id = network.parameter(&gearbox.teeth_of(*member));
            id.map_or(f64::NAN, |id| network.parameter_value(id))
        };
        let teeth: Vec<String> =
            gearbox.arrangement.wheels().iter().map(|m| significant(teeth(m), 6)).collect();
        let teeth = teeth.join("/");
        match (gearbox.arrangement, gearbox.held) {
            (Arrangement::Planetary, Some(held)) => format!(
                "{}: planetary, {} held, {teeth} teeth, {} planets",
                gearbox.name,
                held.word(),
                gearbox.planets
            ),
            _ => format!("{}: a pair of gears, {teeth} teeth", gearbox.name),
        }
    }

    /// Speed of the input over that of the output.
    fn ratio(&self) -> Option<f64> {
        let (_, _, state) = self.states().next()?;
        let (first, last) = (self.task().stages[0], self.task().stages.len() - 1);
        let of = |stage: usize, member: Member| {
            state.members.iter().find(|m| m.stage == stage && m.member == member)
        };
        let output = of(last, self.task().stages[last].output)?.speed;
        let ratio = of(0, first.input)?.speed / output;
        ratio.is_finite().then_some(ratio)
    }

    /// Text on the load and the temperatures of a block.
    pub(super) fn said(&self, block: &Block) -> String {
        let mut torques = block.states.iter().map(|(_, state)| state.torque(&self.task()));
        let first = torques.next().flatten();
        let load = match first {
            Some(torque) if torques.all(|other| other == first) => {
                format!("{} N m on the input", significant(torque, 6))
            }
            Some(_) => "the torque of the input follows its speed".to_owned(),
            None => "without load".to_owned(),
        };
        match block.temperature {
            Some(kelvin) => {
                let held = significant(self.unit.from_si(kelvin), 6);
                format!("{load}, all nodes at {held} {}", self.unit.text)
            }
            None => format!("{load}, in steady state"),
        }
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.states().any(|(_, _, s)| s.losses.iter().any(|part| !part.outside.is_empty())) {
            notes.push("* outside the range in which its formula is known".to_owned());
        }
        if self.task().network.has_time_dependent_inputs() {
            notes.push(format!(
                "inputs change with time: except for the speed their values at {} s are used",
                self.task().time
            ));
        }
        if self.task().stages[0].loaded {
            notes.push("torques and losses of meshes do not include losses elsewhere".into());
        } else {
            notes.push("no torque is given: meshes lose nothing and are left out".into());
        }
        notes
    }

    fn cells(&self, speed: f64, state: &GearState) -> Vec<Cell> {
        let task = self.task();
        let cell = |name: &str, unit: &str, value| (name.to_owned(), unit.to_owned(), value);
        let mut cells = vec![
            cell("speed", "rpm", Some(rpm(speed))),
            cell("torque", "N m", state.torque(&task)),
            cell("warmest node", &self.unit.text, Some(self.unit.from_si(warmest(state)))),
            cell("loss", "W", Some(state.loss())),
            cell("exponent", "1", of_all(state, |part| part.exponent)),
            cell("exponent settled", "1", of_all(state, |part| part.followed)),
            cell("efficiency", "1", state.efficiency(&task)),
            cell("drag", "N m", state.drag(&task)),
        ];
        for part in &state.losses {
            let settled = format!("{} exponent settled", part.name);
            cells.push(cell(&part.name, "W", Some(part.heat)));
            cells.push(cell(&format!("{} exponent", part.name), "1", part.exponent));
            cells.push(cell(&settled, "1", part.followed));
        }
        cells
    }

    fn member(&self, member: &MemberState) -> Value {
        json!({
            "gearbox": self.task().stages[member.stage].name,
            "member": member.member.word(),
            "speed": SiValue::new(member.speed, "rad/s"),
            "torque": member.torque.map(|torque| SiValue::new(torque, "N m")),
            "power": member.power().map(|power| SiValue::new(power, "W")),
        })
    }

    fn point(&self, block: &Block, speed: f64, state: &GearState) -> Value {
        let part = |part: &PartLoss| {
            json!({
                "name": part.name,
                "count": part.count,
                "heat": SiValue::new(part.heat, "W"),
                "exponent": part.exponent,
                "exponent_settled": part.followed,
                "out_of_range": !part.outside.is_empty(),
            })
        };
        let task = self.task();
        let thermal = task.network.thermal_nodes();
        let nodes =
            thermal.map(|id| (&task.network.nodes()[id.index()], &state.temperatures[id.index()]));
        let nodes: serde_json::Map<String, Value> = nodes
            .map(|(node, &t)| {
                let value = SiValue::new(self.unit.from_si(t), &self.unit.text);
                (node.name.clone(), json!(value))
            })
            .collect();
        json!({
            "speed": SiValue::new(speed, "rad/s"),
            "torque": state.torque(&self.task()).map(|torque| SiValue::new(torque, "N m")),
            "settled": block.temperature.is_none(),
            "members": state.members.iter().map(|m| self.member(m)).collect::<Vec<_>>(),
            "losses": state.losses.iter().map(part).collect::<Vec<_>>(),
            "loss": SiValue::new(state.loss(), "W"),
            "exponent": of_all(state, |part| part.exponent),
            "exponent_settled": of_all(state, |part| part.followed),
            "drag": state.drag(&self.task()).map(|drag| SiValue::new(drag, "N m")),
            "efficiency": state.efficiency(&self.task()),
            "temperatures": nodes,
        })
    }
}

/// A mesh as JSON.
fn teeth(mesh: &MeshTeeth) -> Value {
    json!({
        "name": mesh.name,
        "centre_distance": SiValue::new(mesh.at.distance, "m"),
        "pressure_angle": SiValue::new(mesh.at.angle, "rad"),
        "transverse_contact_ratio": mesh.contact_ratio(),
        "overlap_ratio": mesh.at.overlap,
        "loss_factor": mesh.loss_factor(),
    })
}

impl Page for GearAnswer {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        text.lines(self.task().stages.iter().map(|gearbox| self.stage(gearbox)));
        if let Some(ratio) = self.ratio() {
            text.line(format!("ratio {}", significant(ratio, 5)));
        }
        // members turn in proportion: the last point shows them at their own speed
        if let Some((_, _, state)) = self.states().last() {
            text.section().table(self.members(state));
        }
        if let Some(teeth) = self.teeth() {
            text.section().table(teeth);
        }
        for block in &self.blocks {
            text.section().line(self.said(block));
            for table in self.over_speed(block) {
                text.section().table(table);
            }
        }
        text.section().notes(self.notes());
        text
    }

    fn rows(&self) -> Rows<'_> {
        let mut columns: Vec<(String, String, Vec<f64>)> = Vec::new();
        for (_, speed, state) in self.states() {
            let cells = self.cells(speed, state);
            if columns.is_empty() {
                let empty =
                    cells.iter().map(|(name, unit, _)| (name.clone(), unit.clone(), vec![]));
                columns = empty.collect();
            }
            for ((_, _, values), (_, _, value)) in columns.iter_mut().zip(cells) {
                values.push(value.unwrap_or(f64::NAN));
            }
        }
        let columns = columns.into_iter();
        Rows::Columns(columns.map(|(name, unit, of)| RowColumn::numbers(name, unit, of)).collect())
    }

    fn figures(&self) -> Vec<Figure> {
        self.drawn()
    }

    fn more(&self) -> Report {
        let claims = about::laws(&self.input.netlist.network, &self.outside());
        about::about(&self.input, Known { claims, ..Known::default() })
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (netlist, outside) = (&self.input.netlist, self.outside());
        self.input.head(json, &self.doubts_of_ranges())?;
        json.optional("out_of_range", ranges::members(&netlist.network, &outside, false))?;
        json.member("gearbox", &self.task().stages[0].name)?;
        json.member("ratio", &self.ratio())?;
        let meshes = self.task().meshes();
        json.member("meshes", &meshes.iter().map(teeth).collect::<Vec<_>>())?;
        let points = self.states().map(|(block, speed, state)| self.point(block, speed, state));
        json.member("points", &points.collect::<Vec<_>>())
    }
}
