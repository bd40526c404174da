//! Results of each run: the tables of the paper's Figures 7, 8 and 9, and the same as JSON.

use std::io;

use lptn_fit::law::{RunFit, Systematic};
use lptn_report::{Json, Page as _};
use lptn_solve::{Table, TableOf};
use lptn_study::SiValue;
use serde_json::{Map, Value, json};

use super::{FitRunsAnswer, lines};

impl FitRunsAnswer {
    /// The rise of each run in K over its speed, with its errors: Figure 7.
    pub fn rises(&self) -> Table {
        each(
            self,
            &[
                ("dT", "K", &|f| f.power.rise.value),
                ("dT_sd", "K", &|f| f.power.rise.random),
                ("dT_systematic", "K", &|f| f.power.rise.systematic),
            ],
        )
    }

    /// The time constant of each run in min over its speed, with its errors: Figure 8.
    pub fn time_constants(&self) -> Table {
        each(
            self,
            &[
                ("t_RC", "min", &|f| f.fit.tau.value / 60.0),
                ("t_RC_sd", "min", &|f| f.fit.tau.standard_error / 60.0),
                ("t_RC_95", "min", &|f| f.fit.tau.half_width / 60.0),
            ],
        )
    }

    /// The power of each run in W over its speed, with the value of each law: Figure 9.
    pub fn powers(&self) -> Table {
        let first = self.columns().first().map_or(&[][..], |column| &column.fits);
        let rows = rows(self);
        let mut table = table(self, &rows);
        let mut column = |name: &str, unit: &str, value: &dyn Fn(&RunFit) -> f64| {
            table.column(name, unit, |&row| first.get(row).map_or(f64::NAN, value));
        };
        column("dT", "K", &|f| f.power.rise.value);
        column("t_RC", "min", &|f| f.fit.tau.value / 60.0);
        column("P", "W", &|f| f.power.power.value);
        column("P_sd", "W", &|f| f.power.power.random);
        column("P_systematic", "W", &|f| f.power.power.systematic);
        for candidate in &self.answer.study.candidates {
            if let Some(fit) = candidate.fitted() {
                let value = |&row: &usize| fit.values.get(row).copied().unwrap_or(f64::NAN);
                table.column(candidate.law.to_string(), "W", value);
            }
        }
        table.done()
    }

    /// Lines through rises and time constants of all runs, and how columns differ in them.
    pub fn slopes(&self) -> Table {
        lines::sheet(self)
    }
}

/// A table of runs and their speeds, for other columns: one value per run.
fn table<'a>(found: &FitRunsAnswer, rows: &'a [usize]) -> TableOf<'a, usize> {
    let (unit, runs) = (&found.answer.data.unit, &found.study.runs);
    let mut table = Table::of(rows);
    table.label("run", |&row| runs[row].0.clone());
    table.column("omega", &unit.0.text, |&row| unit.0.from_si(runs[row].1));
    table
}

fn rows(found: &FitRunsAnswer) -> Vec<usize> {
    (0..found.study.runs.len()).collect()
}

/// Name, unit and values of a column.
type Part<'a> = (&'a str, &'a str, &'a dyn Fn(&RunFit) -> f64);

/// Columns of every thermocouple.
fn each(found: &FitRunsAnswer, parts: &[Part<'_>]) -> Table {
    let rows = rows(found);
    let mut table = table(found, &rows);
    for (of, part) in found.columns().iter().flat_map(|of| parts.iter().map(move |part| (of, part)))
    {
        let value = |&row: &usize| of.fits.get(row).map_or(f64::NAN, part.2);
        table.column(format!("{}.{}", of.column, part.0), part.1, value);
    }
    table.done()
}

pub(super) fn json(found: &FitRunsAnswer, json: &mut Json<'_>) -> io::Result<()> {
    found.answer.json(json)?;
    json.member("runs", &runs(found))?;
    json.member("slopes", &lines::json(found))?;
    let part = |e: &Systematic| {
        let total = e.total();
        json!({ "capacity": e.capacity, "offset": e.offset, "gain": e.gain, "total": total })
    };
    let systematic = found.best().and_then(|(best, fit)| {
        let named = fit.coefficients.iter().zip(found.study.systematic(best)?);
        Some(named.map(|(c, e)| (c.name.clone(), part(&e))).collect::<Map<String, Value>>())
    });
    json.member("systematic", &systematic)
}

fn number(value: f64, unit: &str, error: f64) -> Value {
    json!({ "value": value, "unit": unit, "standard_error": error })
}

fn runs(found: &FitRunsAnswer) -> Value {
    let column = |f: &RunFit| {
        let parted = |p: lptn_fit::step::Parted, unit: &str| {
            json!({
                "value": p.value,
                "unit": unit,
                "standard_error": p.random,
                "systematic": p.systematic,
            })
        };
        json!({
            "T_i": number(f.fit.initial.value, "K", f.fit.initial.standard_error),
            "T_f": number(f.fit.settled.value, "K", f.fit.settled.standard_error),
            "t_RC": number(f.fit.tau.value, "s", f.fit.tau.standard_error),
            "rms": SiValue::new(f.fit.rms, "K"),
            "dT": parted(f.power.rise, "K"),
            "R_eq": parted(f.power.resistance, "K/W"),
            "P_disp": parted(f.power.power, "W"),
            "reference": f.power.reference,
        })
    };
    let run = |(i, (name, speed)): (usize, &(String, f64))| {
        let columns = found.columns().iter().map(|of| (of.column.clone(), column(&of.fits[i])));
        let columns: Map<_, _> = columns.collect();
        json!({ "run": name, "speed": SiValue::new(*speed, "rad/s"), "columns": columns })
    };
    found.study.runs.iter().enumerate().map(run).collect()
}
