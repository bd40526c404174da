//! A few nodes instead of one, and the largest error over every load.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_reduce::{Allowed, Deviation, Dynamics, Judge, Nodes, ReduceError, Reduction, Stretch};
use lptn_report::{Text, TextTable, duration, fixed, significant};
use lptn_solve::largest_of_inputs;
use lptn_units::Dimension;
use serde_json::{Value, json};

use super::limit::Limit;
use super::{ReduceAnswer, ReduceQuestion};
use crate::failure::Failure;
use crate::input;
use crate::scale;

/// Most nodes that are tried to keep a limit.
const MOST: usize = 20;

/// Errors over every load at the port: all powers between 0 and the largest, in any order.
#[derive(Debug)]
pub struct Loads {
    /// The largest power in W.
    pub power: f64,
    /// True if the question gave it.
    given: bool,
    /// The largest error over every load that is allowed, if one is given.
    pub limit: Option<Limit>,
    /// The nodes that are judged and written.
    /// `None` if no number of them keeps the limit, or no load can be judged.
    pub nodes: Option<Nodes>,
    /// Numbers of nodes that were not enough.
    pub short: Vec<Nodes>,
    /// Their error of the run or of a step, if they are more than one node.
    pub error: Option<(Judge, Deviation)>,
    /// The smallest number of nodes that keeps the limit if one node does not, with its error.
    pub more: Option<(Nodes, Judge, Deviation)>,
}

/// The question, and the equations of the network.
type Asked<'a> = (&'a ReduceQuestion, &'a ThermalSystem);

/// The run that is compared, if there is one, and its largest allowed error.
type Judging<'a> = (Option<&'a RunAnalysis>, Allowed);

impl Loads {
    pub(super) fn new(
        asked: Asked<'_>,
        judging: Judging<'_>,
        reduction: &Reduction,
        explain: &dyn Fn(ReduceError) -> Failure,
    ) -> Result<Self, Failure> {
        let (question, system) = asked;
        let given = question.power.as_deref().map(power).transpose()?;
        let limit = question.error.as_deref().map(|text| Limit::parse("--error", text));
        let limit = limit.transpose()?;
        let power = match given {
            Some(power) => power,
            None => largest((system, judging.0), reduction).map_err(|e| explain(e.into()))?,
        };
        let mut loads = Self {
            power,
            given: given.is_some(),
            limit,
            nodes: None,
            short: Vec::new(),
            error: None,
            more: None,
        };
        if let Some(dynamics) = &reduction.dynamics {
            loads.choose(question, dynamics).map_err(explain)?;
            loads.judge(asked, judging, (reduction, dynamics)).map_err(explain)?;
        }
        Ok(loads)
    }

    fn choose(
        &mut self,
        question: &ReduceQuestion,
        dynamics: &Dynamics,
    ) -> Result<(), ReduceError> {
        let Some(step) = &dynamics.step else {
            return match (question.nodes, &self.limit) {
                (None, None) => Ok(()),
                _ => Err(ReduceError::OneWay),
            };
        };
        let pair = question.definition.and_then(|d| dynamics.pair(d)).unwrap_or(dynamics.best());
        if let Some(limit) = &self.limit {
            let kelvin = limit.allowed.of(step.resistance * self.power) / self.power;
            let (found, short) = Nodes::enough(step, &dynamics.pairs, (kelvin, MOST));
            (self.nodes, self.short) = (found, short);
        } else if let Some(count) = question.nodes.filter(|count| *count > 1) {
            self.nodes = Nodes::of(step, count);
        } else {
            self.nodes = Nodes::of_pair(step, pair);
        }
        Ok(())
    }

    fn judge(
        &mut self,
        (question, system): Asked<'_>,
        judging: Judging<'_>,
        (reduction, dynamics): (&Reduction, &Dynamics),
    ) -> Result<(), ReduceError> {
        let free = self.limit.is_none() && question.definition.is_none();
        match &self.nodes {
            Some(nodes) if nodes.count() > 1 => {
                self.error = reduction.judged(system, nodes, judging)?;
            }
            _ if free && dynamics.collapses(dynamics.best()) == Some(false) => {
                self.more = reduction.fewest(system, judging)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// The largest error of some nodes over every load, in K.
    pub fn kelvin(&self, nodes: &Nodes) -> f64 {
        nodes.worst.most() * self.power
    }

    /// True if the limit over every load is kept; `None` without one.
    pub fn kept(&self) -> Option<bool> {
        self.limit.as_ref().map(|_| self.nodes.is_some())
    }

    /// "2 nodes keep 0.1K over every load up to 220.6 W (0.012 K)".
    pub(super) fn verdict(&self) -> Option<String> {
        let (limit, power) = (self.limit.as_ref()?, significant(self.power, 4));
        Some(match (&self.nodes, self.short.last()) {
            (Some(nodes), _) => {
                let (count, verb) = match nodes.count() {
                    1 => ("one node".to_owned(), "keeps"),
                    count => (format!("{count} nodes"), "keep"),
                };
                let kelvin = if exact(nodes) {
                    "exactly".to_owned()
                } else {
                    format!("{} K", significant(self.kelvin(nodes), 3))
                };
                format!("{count} {verb} {} over every load up to {power} W ({kelvin})", limit.text)
            }
            (None, Some(last)) => format!(
                "no number of nodes up to {} keeps {} over every load up to {power} W: the last \
                 misses {} K",
                last.count(),
                limit.text,
                significant(self.kelvin(last), 3)
            ),
            (None, None) => return None,
        })
    }

    /// The load with the largest error as a signal, in rows of CSV: the power from each time on.
    /// `None` if no load was judged.
    pub fn csv(&self) -> Option<String> {
        let nodes = self.nodes.as_ref()?;
        let (stretches, end) = nodes.worst.load();
        let mut text = "t [s],P [W]\n".to_owned();
        for (from, on) in stretches {
            text += &format!("{from},{}\n", if on { self.power } else { 0.0 });
        }
        text += &format!("{end},0\n");
        Some(text)
    }
}

impl ReduceAnswer {
    /// Text on the errors over every load.
    pub(super) fn loads_text(&self) -> Text {
        let mut text = Text::new();
        let loads = &self.loads;
        let mut rows: Vec<&Nodes> = loads.short.iter().collect();
        rows.extend(&loads.nodes);
        if loads.limit.is_some() && !rows.is_empty() {
            text.section().table(self.numbers(&rows));
        }
        if let Some(nodes) = loads.nodes.as_ref().filter(|nodes| !exact(nodes)) {
            text.section().sentence("any load: ", &self.any_load(nodes));
        }
        text
    }

    fn numbers(&self, rows: &[&Nodes]) -> TextTable {
        let rise = self.reduction.norton.resistance * self.loads.power;
        TextTable::of(rows)
            .right("nodes", |nodes| nodes.count().to_string())
            .right("any load [K]", |nodes| significant(self.loads.kelvin(nodes), 3))
            .right("[%]", |nodes| fixed(100.0 * self.loads.kelvin(nodes) / rise, 3))
            .left("", |nodes| nodes.definition.map_or("", |d| d.key()))
            .into()
    }

    /// "0 to 220.6 W errs by at most 0.894 K, 1.3 % of R_eq P: reads too cold after …"
    fn any_load(&self, nodes: &Nodes) -> String {
        let loads = &self.loads;
        let rise = self.reduction.norton.resistance * loads.power;
        let kelvin = loads.kelvin(nodes);
        let whence = if loads.given { "" } else { ", the largest Q_N" };
        let mut text = format!(
            "between 0 and {} W{whence}, it errs by at most {} K, {} % of R_eq times that. It reads \
             too cold by as much after {}",
            significant(loads.power, 4),
            significant(kelvin, 3),
            significant(100.0 * kelvin / rise, 3),
            lengths(&nodes.worst.load())
        );
        if nodes.worst.missed > 0.0 {
            let missed = significant(nodes.worst.missed * loads.power, 2);
            text += &format!("; {missed} K of it are a bound for turns that were not found");
        }
        text
    }

    pub(super) fn loads_json(&self) -> Value {
        let loads = &self.loads;
        let si = |value: f64, unit: &str| json!({ "value": value, "unit": unit });
        let of = |nodes: &Nodes| {
            json!({
                "nodes": nodes.count(),
                "definition": nodes.definition.map(|d| d.key()),
                "error": scale::of_difference(loads.kelvin(nodes), &self.unit),
                "bound": scale::of_difference(nodes.worst.missed * loads.power, &self.unit),
            })
        };
        let chosen = loads.nodes.as_ref().map(|nodes| {
            let (stretches, end) = nodes.worst.load();
            let load: Vec<Value> = stretches
                .iter()
                .map(|(from, on)| {
                    let power = if *on { loads.power } else { 0.0 };
                    json!({ "from": si(*from, "s"), "P": si(power, "W") })
                })
                .collect();
            json!({
                "any_load": of(nodes),
                "direct": si(nodes.ladder.direct, "K/W"),
                "C": nodes.ladder.rungs.iter().map(|rung| si(rung.0, "J/K")).collect::<Vec<_>>(),
                "R": nodes.ladder.rungs.iter().map(|rung| si(rung.1, "K/W")).collect::<Vec<_>>(),
                "load": load,
                "end": si(end, "s"),
            })
        });
        json!({
            "power": si(loads.power, "W"),
            "limit": loads.limit.as_ref().map(|limit| limit.text.clone()),
            "kept": loads.kept(),
            "not_enough": loads.short.iter().map(of).collect::<Vec<_>>(),
            "chosen": chosen,
        })
    }
}

/// "5.15 d on, 23.3 h off, 7.7 h on and 3 shorter ones": the last are short and close to the end.
fn lengths((stretches, end): &(Vec<Stretch>, f64)) -> String {
    const SHOWN: usize = 5;
    let ends = stretches.iter().skip(1).map(|stretch| stretch.0).chain([*end]);
    let length = |((from, on), to): (&Stretch, f64)| {
        format!("{} {}", duration(to - from, 3), if *on { "on" } else { "off" })
    };
    let all: Vec<String> = stretches.iter().zip(ends).map(length).collect();
    let shown = all.len().min(SHOWN);
    match all.len() - shown {
        0 => all.join(", "),
        more => format!("{} and {more} shorter ones", all[..shown].join(", ")),
    }
}

/// True if the largest error over every load is rounding.
fn exact(nodes: &Nodes) -> bool {
    nodes.worst.most() <= 1e-9 * nodes.ladder.resistance()
}

/// The largest heat at the port over the run, or at its start; 1 W if there is none.
fn largest(
    (system, run): (&ThermalSystem, Option<&RunAnalysis>),
    reduction: &Reduction,
) -> Result<f64, lptn_network::InputError> {
    let norton = &reduction.norton;
    let most = match run {
        Some(run) => largest_of_inputs(system, (run.start(), run.stop()), &|system, work| {
            norton.heat(system.source_powers(work))
        })?,
        None => reduction.inputs.heat,
    };
    let most = most.max(reduction.inputs.heat);
    Ok(if most > 0.0 { most } else { 1.0 })
}

pub(super) fn power(text: &str) -> Result<f64, Failure> {
    let what = (Dimension::POWER, "reduce::power", "250W");
    Ok(input::positive("--power", text, what)?.value)
}
