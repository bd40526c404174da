//! An impedance as a page.

use std::io;

use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, duration, significant};
use lptn_solve::{Drive, Table};
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::{Found, ImpedanceAnswer, Stepped, Swung};
use crate::about::{self, Known};

impl ImpedanceAnswer {
    /// The unit of an answer.
    pub(super) fn unit(&self) -> &'static str {
        if matches!(self.drive, Drive::Boundary(_)) { "K/K" } else { "K/W" }
    }

    fn headline(&self) -> String {
        let (to, name, unit) = (&self.to, &self.name, self.unit());
        match &self.found {
            Found::Step { settled, .. } => {
                format!(
                    "`{to}` rises by {} {unit} of `{name}`, in steady \
                    state",
                    significant(*settled, 5)
                )
            }
            Found::Swing(_) => {
                format!("`{to}` in {unit} of `{name}`, which oscillates as cos(omega t)")
            }
            Found::Chain(chain) => self.chain_line(chain),
        }
    }

    fn shown(&self) -> TextTable {
        let unit = self.unit();
        match &self.found {
            Found::Step { settled, rows } => {
                let mut table = TextTable::of(rows)
                    .right("time [s]", |row| significant(row.time, 4))
                    .right(format!("rise [{unit}]"), |row| significant(row.rise, 5))
                    .right("settled", |row| percent(row.rise / settled));
                for (k, share) in self.shares.iter().enumerate() {
                    table = table
                        .right(format!("D = {share}"), move |row| significant(row.pulses[k], 5));
                }
                table.into()
            }
            Found::Swing(rows) => TextTable::of(rows)
                .right("omega [rad/s]", |row| significant(row.omega, 5))
                .right("period", |row| period(row.omega))
                .right(format!("amplitude [{unit}]"), |row| significant(row.answer.norm(), 5))
                .right("phase [deg]", |row| significant(row.answer.arg().to_degrees(), 4))
                .into(),
            Found::Chain(chain) => self.chain_shown(chain),
        }
    }

    fn table(&self) -> Table {
        let unit = self.unit();
        match &self.found {
            Found::Step { rows, .. } => {
                let mut table = Table::of(rows);
                table.column("time", "s", |row: &Stepped| row.time);
                table.column("rise", unit, |row| row.rise);
                for (k, share) in self.shares.iter().enumerate() {
                    table.column(format!("duty {share}"), unit, |row| row.pulses[k]);
                }
                table.done()
            }
            Found::Swing(rows) => {
                let mut table = Table::of(rows);
                table.column("omega", "rad/s", |row: &Swung| row.omega);
                table.column("re", unit, |row| row.answer.re);
                table.column("im", unit, |row| row.answer.im);
                table.done()
            }
            Found::Chain(chain) => self.chain_table(chain),
        }
    }

    fn points(&self) -> Vec<Value> {
        let of = |value: f64| SiValue::new(value, self.unit());
        match &self.found {
            Found::Step { rows, .. } => rows.iter().map(|row| {
                let pulses = self.shares.iter().zip(&row.pulses);
                let pulses: Vec<Value> = pulses
                    .map(|(share, rise)| json!({ "duty": SiValue::new(*share, "1"), "rise": of(*rise) }))
                    .collect();
                json!({ "time": SiValue::new(row.time, "s"), "rise": of(row.rise), "pulses": pulses })
            }).collect(),
            Found::Swing(rows) => rows.iter().map(|row| {
                let omega = SiValue::new(row.omega, "rad/s");
                json!({ "omega": omega, "re": of(row.answer.re), "im": of(row.answer.im) })
            }).collect(),
            Found::Chain(_) => Vec::new(),
        }
    }

    fn notes(&self) -> Vec<String> {
        let mut notes =
            self.point.as_ref().map(|point| point.notes(self.tried)).unwrap_or_default();
        if let Found::Chain(chain) = &self.found {
            notes.extend(self.chain_note(chain));
        }
        notes
    }
}

impl Page for ImpedanceAnswer {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        text.section().sentence("", &self.headline());
        text.section().table(self.shown());
        text.section().notes(self.notes());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.table().into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        self.input.head(json, self.doubts_of_state())?;
        json.member("port", &self.name)?;
        json.member("to", &self.to)?;
        if let Some(point) = &self.point {
            json.member("at", &point.json(self.tried))?;
        }
        if let Found::Step { settled, .. } = &self.found {
            json.member("settled", &SiValue::new(*settled, self.unit()))?;
        }
        if let Found::Chain(chain) = &self.found {
            return self.chain_json(chain, json);
        }
        json.member("points", &self.points())
    }
}

fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 4))
}

fn period(omega: f64) -> String {
    if omega == 0.0 { "-".to_owned() } else { duration(std::f64::consts::TAU / omega, 4) }
}
