//! The tables of gears: members, and parts over speed.

use std::f64::consts::PI;

use lptn_report::{TextTable, fixed, significant};
use lptn_study::{GearState, PartLoss};

use super::{Block, GearAnswer};

/// Digits of heats and torques.
const DIGITS: usize = 4;

/// Most speeds next to each other.
const ACROSS: usize = 5;

/// A speed in rpm.
pub(super) fn rpm(speed: f64) -> f64 {
    speed * 30.0 / PI
}

/// A number of rpm as people say it.
pub(super) fn in_rpm(speed: f64) -> String {
    significant(rpm(speed), 5)
}

/// A row of a table over speeds.
struct Row {
    name: String,
    cells: Vec<String>,
}

impl GearAnswer {
    /// Every member at one point: its speed, and without losses its torque and power.
    pub(super) fn members(&self, state: &GearState) -> TextTable {
        let several = self.task().stages.len() > 1;
        let name = |stage: usize, word: &str| match several {
            true => format!("{}.{word}", self.task().stages[stage].name),
            false => word.to_owned(),
        };
        let or_dash =
            |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, DIGITS));
        let mut table = TextTable::of(&state.members)
            .left("member", |m| name(m.stage, m.member.word()))
            .right("speed [rpm]", |m| in_rpm(m.speed));
        if self.task().stages[0].loaded {
            table = table
                .right("torque [N m]", |m| or_dash(m.torque))
                .right("power [W]", |m| or_dash(m.power()));
        }
        let role = |stage: usize, member| {
            let gearbox = self.task().stages[stage];
            match member {
                _ if member == gearbox.input => "input",
                _ if member == gearbox.output => "output",
                _ if Some(member) == gearbox.held => "held",
                _ => "against the carrier",
            }
        };
        table.left("", |m| role(m.stage, m.member)).into()
    }

    /// Teeth of every mesh at its working centre distance; `None` without meshes.
    pub(super) fn teeth(&self) -> Option<TextTable> {
        let meshes = self.task().meshes();
        let or_dash = |value: f64, decimals: usize| match value.is_finite() {
            true => fixed(value, decimals),
            false => "-".to_owned(),
        };
        let table = TextTable::of(&meshes)
            .left("mesh", |mesh| mesh.name.as_str())
            .right("a [mm]", |mesh| or_dash(1e3 * mesh.at.distance, 3))
            .right("alpha_w [deg]", |mesh| or_dash(mesh.at.angle.to_degrees(), 3))
            .right("eps_alpha", |mesh| or_dash(mesh.contact_ratio(), 3))
            .right("eps_beta", |mesh| or_dash(mesh.at.overlap, 3))
            .right("H_V", |mesh| or_dash(mesh.loss_factor(), 4));
        (!meshes.is_empty()).then(|| table.into())
    }

    /// Tables over the speeds of a block, [`ACROSS`] in each: heats, and both exponents.
    pub(super) fn over_speed(&self, block: &Block) -> Vec<TextTable> {
        let mut tables = Vec::new();
        for states in block.states.chunks(ACROSS) {
            let rows = self.heats(block, states);
            tables.push(self.table("loss [W]", states, &rows));
        }
        for states in block.states.chunks(ACROSS) {
            let of = |part: &PartLoss| part.exponent;
            let rows = exponents(states, of);
            tables.push(self.table("exponent, temperatures fixed", states, &rows));
            if block.temperature.is_none() {
                let rows = exponents(states, |part| part.followed);
                tables.push(self.table("exponent, steady", states, &rows));
            }
        }
        tables
    }

    fn table(&self, title: &str, states: &[(f64, GearState)], rows: &[Row]) -> TextTable {
        let mut table = TextTable::of(rows).left(title, |row| row.name.as_str());
        for (at, (speed, _)) in states.iter().enumerate() {
            table = table
                .right(format!("{} rpm", in_rpm(*speed)), move |row: &Row| row.cells[at].clone());
        }
        table.into()
    }

    /// Heats of parts, their sum, the output as a share of the input, and the warmest node.
    /// A heat is marked if a formula is outside its range.
    fn heats(&self, block: &Block, states: &[(f64, GearState)]) -> Vec<Row> {
        let mut rows: Vec<Row> = parts(states)
            .map(|(at, name)| {
                let cell = |state: &GearState| {
                    let part = &state.losses[at];
                    let mark = if part.outside.is_empty() { "" } else { "*" };
                    format!("{}{mark}", significant(part.heat, DIGITS))
                };
                Row { name, cells: states.iter().map(|(_, state)| cell(state)).collect() }
            })
            .collect();
        let mut sum = |name: &str, cell: &dyn Fn(&GearState) -> String| {
            let cells = states.iter().map(|(_, state)| cell(state)).collect();
            rows.push(Row { name: name.to_owned(), cells });
        };
        sum("all", &|state| significant(state.loss(), DIGITS));
        let drag = |state: &GearState| state.drag(&self.task());
        sum("drag at the input [N m]", &|state| {
            drag(state).map_or("-".into(), |drag| significant(drag, DIGITS))
        });
        if self.task().stages[0].loaded {
            sum("efficiency [%]", &|state| {
                let efficiency = state.efficiency(&self.task());
                efficiency.map_or("-".into(), |efficiency| fixed(100.0 * efficiency, 2))
            });
        }
        if block.temperature.is_none() {
            sum(&format!("warmest node [{}]", self.unit.text), &|state| {
                fixed(self.unit.from_si(warmest(state)), 1)
            });
        }
        rows
    }
}

/// The highest temperature in K.
pub(super) fn warmest(state: &GearState) -> f64 {
    state.temperatures.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The parts with their positions, and how many of one there are.
fn parts(states: &[(f64, GearState)]) -> impl Iterator<Item = (usize, String)> {
    let losses = states.first().map_or(&[][..], |(_, state)| &state.losses);
    losses.iter().enumerate().map(|(at, part)| {
        let count = if part.count > 1 { format!(" ({})", part.count) } else { String::new() };
        (at, format!("{}{count}", part.name))
    })
}

/// d ln P / d ln speed of every part, and of their sum.
fn exponents(states: &[(f64, GearState)], of: impl Fn(&PartLoss) -> Option<f64>) -> Vec<Row> {
    let shown = |value: Option<f64>| value.map_or("-".to_owned(), |value| fixed(value, 2));
    let mut rows: Vec<Row> = parts(states)
        .map(|(at, name)| {
            let cells = states.iter().map(|(_, state)| shown(of(&state.losses[at]))).collect();
            Row { name, cells }
        })
        .collect();
    let all = states.iter().map(|(_, state)| shown(of_all(state, &of))).collect();
    rows.push(Row { name: "all".to_owned(), cells: all });
    rows
}

/// The exponent of a sum is the mean of those of its terms, weighted by their shares.
pub(super) fn of_all(state: &GearState, of: impl Fn(&PartLoss) -> Option<f64>) -> Option<f64> {
    let loss = state.loss();
    let terms = state.losses.iter().filter(|part| part.heat > 0.0);
    let slopes: Option<Vec<f64>> = terms.map(|part| Some(part.heat * of(part)?)).collect();
    (loss > 0.0).then_some(slopes?.iter().sum::<f64>() / loss)
}
