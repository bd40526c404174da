//! A plan as a page.

use std::io;

use lptn_fit::network::design::{DesignSet, NextRun};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, shortened, significant};
use lptn_solve::Table;
use lptn_study::SiValue;
use lptn_units::statistics::NORMAL_95;
use serde_json::{Map, Value, json};

use super::PlanAnswer;
use super::shown::{NOTHING, cost};
use super::words::{notes, verdict};
use crate::about::{self, Known};
use crate::words::{count, symbol};

/// Runs that are shown, at most.
const MOST_RUNS: usize = 12;

/// Letters of a list of places next to the other columns.
const PLACES: usize = 24;

impl Page for PlanAnswer {
    fn text(&self) -> Text {
        let mut text = Text::titled(self.input.title());
        let (wanted, besides) = (self.wanted(), besides(self));
        text.sentence("", &format!("plan {}: know {wanted}{besides}", self.study.name));
        text.section().table(sets(self));
        if self.task.places.len() > 1 {
            text.line(searched(self));
        }
        if self.design.next.len() > 1 {
            text.section().table(next(self));
            let (all, shown) = (self.design.next.len(), MOST_RUNS);
            if all > shown {
                text.line(format!("{shown} of {all} are shown, --format json has all"));
            }
        }
        if self.design.plan.is_some() {
            text.section().table(unknowns(self));
        }
        text.conclude(13, notes(self), &verdict(self));
        text
    }

    /// The errors of the plan over the time that is measured, in the units of the unknowns.
    fn rows(&self) -> Rows<'_> {
        let points: Vec<&(f64, Vec<f64>)> = self.design.curve.iter().collect();
        let places = self.design.plan.as_ref().map_or(&[][..], |plan| &plan.places);
        let mut table = Table::of(&points);
        table.column("t", "s", |(seconds, _)| *seconds);
        for i in self.concerned(places) {
            let finite = |error: f64| if error.is_finite() { error } else { f64::NAN };
            let unit = &self.units[i].text;
            table.column(&self.names[i], unit, |(_, errors)| self.error(i, finite(errors[i])));
        }
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        about::about(&self.input, Known::default()).answered(&verdict(self))
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        self.input.head(json, &self.doubts)?;
        json.member("study", &self.study.name)?;
        json.member("known", &self.errors_of(&self.design.before, None))?;
        json.member("sets", &self.design.sets.iter().map(|set| self.set(set)).collect::<Value>())?;
        json.member("sets_looked_at", &self.design.searched.sets)?;
        json.member("every_set", &self.design.searched.all)?;
        json.member("next", &self.design.next.iter().map(|run| self.next(run)).collect::<Value>())?;
        json.member("plan", &self.plan())?;
        let reached = self.design.plan.as_ref().is_some_and(|plan| plan.reached);
        json.member("reached", &reached)?;
        json.member("verdict", &verdict(self))?;
        json.member("gradient", if self.design.exact { "exact" } else { "differences" })?;
        json.table(&self.listed())
    }

    fn no(&self) -> Option<String> {
        let reached = self.design.plan.as_ref().is_some_and(|plan| plan.reached);
        (!reached).then(|| verdict(self))
    }
}

/// ", while 2 parameters and 3 values of sensors are not known either".
fn besides(answer: &PlanAnswer) -> String {
    let of_sensors = answer.task.unknowns.iter().filter(|unknown| unknown.sensor().is_some());
    let of_sensors = of_sensors.count();
    let others = answer.task.unknowns.len() - of_sensors - answer.task.known.len();
    let mut parts = Vec::new();
    if others > 0 {
        parts.push(count(others, "parameter"));
    }
    match of_sensors {
        0 => {}
        1 => parts.push("1 value of a sensor".to_owned()),
        n => parts.push(format!("{n} values of sensors")),
    }
    match parts.is_empty() {
        true => String::new(),
        false => format!("; also not known: {}", parts.join(" and ")),
    }
}

fn searched(answer: &PlanAnswer) -> String {
    let (sets, places) = (answer.design.searched.sets, answer.task.places.len());
    let sets = count(sets, "set");
    match answer.design.searched.all {
        true => format!("the best of each number, out of all {sets} of {places} places"),
        false => format!(
            "by adding and exchanging, out of {sets} of {places} places: there may be better ones"
        ),
    }
}

fn sets(answer: &PlanAnswer) -> TextTable {
    let run = |set: &DesignSet| set.run.map_or(NOTHING, |(run, _)| answer.run(run)).to_owned();
    let mut table = TextTable::of(&answer.design.sets)
        .right("sensors", |set| set.places.len().to_string())
        .left("places", |set| shortened(&answer.places(&set.places).join(", "), PLACES))
        .left("best run", |set| shortened(&run(set), PLACES - 4));
    for known in answer.few_known() {
        let i = known.unknown;
        table = table.right(answer.names[i].as_str(), move |set| answer.part(i, set.errors[i]));
    }
    table = table.right("enough", |set| enough(answer, set.enough));
    if answer.has_costs() {
        let of = |set: &DesignSet| -> f64 {
            set.places.iter().map(|&place| answer.task.places[place].cost).sum()
        };
        table = table.right("cost", move |set| cost(of(set)));
    }
    table.into()
}

fn enough(answer: &PlanAnswer, samples: Option<usize>) -> String {
    samples.map_or(NOTHING.to_owned(), |samples| answer.lasts(samples))
}

fn next(answer: &PlanAnswer) -> TextTable {
    let shown = &answer.design.next[..answer.design.next.len().min(MOST_RUNS)];
    let mut table = TextTable::of(shown)
        .left("next run", |next| shortened(answer.run(next.run.0), 2 * PLACES))
        .right("lasts", |next| answer.lasts(next.run.1));
    for known in answer.few_known() {
        let i = known.unknown;
        table = table.right(answer.names[i].as_str(), move |next| answer.part(i, next.errors[i]));
    }
    table = table.right("enough", |next| enough(answer, next.enough));
    if answer.has_costs() {
        table = table.right("cost", |next| cost(next.cost));
    }
    table.into()
}

/// Errors after the plan, of parameters and of sensors that it has.
fn unknowns(answer: &PlanAnswer) -> TextTable {
    let plan = answer.design.plan.as_ref();
    let (places, errors) =
        plan.map_or((&[][..], &[][..]), |plan| (&plan.places[..], &plan.errors[..]));
    let shown = |i: usize, si: f64| match si.is_finite() {
        true => significant(answer.error(i, si), 2),
        false => NOTHING.to_owned(),
    };
    let limit = |i: usize| plan.and_then(|plan| plan.limits.as_ref()).map(|limits| limits[i]);
    let cause = |i: usize| {
        let cause = plan.and_then(|plan| plan.causes[i]).filter(|(_, share)| *share > 0.1);
        cause.map_or(String::new(), |(of, share)| {
            format!("{} ({} %)", answer.names[of], significant(100.0 * share, 2))
        })
    };
    let all = answer.concerned(places);
    let table = TextTable::of(&all)
        .left("known then", |&i| answer.names[i].as_str())
        .names()
        .right("value", |&i| significant(answer.units[i].from_si(answer.task.values[i]), 4))
        .right("std. error", |&i| shown(i, errors[i]))
        .right("95 % ±", |&i| shown(i, NORMAL_95 * errors[i]))
        .left("unit", |&i| symbol(&answer.units[i].text))
        .right("wanted", |&i| answer.target(i).map_or(String::new(), |error| shown(i, error)))
        .right("limit", |&i| limit(i).map_or(String::new(), |limit| shown(i, limit)));
    match all.iter().all(|&i| cause(i).is_empty()) {
        true => table.into(),
        false => table.left("most by ± of", |&i| cause(i)).optional().into(),
    }
}

impl PlanAnswer {
    fn listed(&self) -> Table {
        let mut table = Table::of(&self.design.curve);
        table.column("t", "s", |(seconds, _)| *seconds);
        for known in &self.task.known {
            let i = known.unknown;
            let finite = |error: f64| if error.is_finite() { error } else { f64::NAN };
            let unit = self.task.unknowns[i].ty.dimension.si_unit();
            table.column(&self.names[i], &unit, |(_, errors)| finite(errors[i]));
        }
        table.done()
    }

    /// Standard errors in SI units: `null` if nothing determines one.
    fn errors_of(&self, errors: &[f64], of: Option<&[usize]>) -> Value {
        let all: Vec<usize> = match of {
            Some(places) => self.concerned(places),
            None => (0..self.names.len()).collect(),
        };
        let one = |i: usize| {
            let unit = self.task.unknowns[i].ty.dimension.si_unit();
            let error = errors[i].is_finite().then(|| SiValue::new(errors[i], &unit));
            (self.names[i].clone(), json!(error))
        };
        Value::Object(all.into_iter().map(one).collect::<Map<String, Value>>())
    }

    fn timed(&self, (run, samples): (usize, usize)) -> Value {
        let lasts = SiValue::new(self.task.lasts(samples), "s");
        json!({ "run": self.run(run), "duration": lasts, "samples": samples })
    }

    fn after(&self, samples: Option<usize>) -> Option<SiValue> {
        samples.map(|samples| SiValue::new(self.task.lasts(samples), "s"))
    }

    fn set(&self, set: &DesignSet) -> Value {
        json!({
            "places": self.places(&set.places),
            "best_run": set.run.map(|run| self.timed(run)),
            "standard_errors": self.errors_of(&set.errors, Some(&set.places)),
            "enough_after": self.after(set.enough),
        })
    }

    fn next(&self, next: &NextRun) -> Value {
        let places = self.design.plan.as_ref().map(|plan| &plan.places[..]);
        json!({
            "run": self.timed(next.run),
            "standard_errors": self.errors_of(&next.errors, places),
            "enough_after": self.after(next.enough),
            "cost": next.cost,
        })
    }

    fn plan(&self) -> Value {
        let Some(plan) = &self.design.plan else { return Value::Null };
        let cause = |&i: &usize| {
            let (of, part) = plan.causes[i]?;
            let cause = json!({ "of": self.names[of], "part": part });
            Some((self.names[i].clone(), cause))
        };
        let all = self.concerned(&plan.places);
        let causes: Map<String, Value> = all.iter().filter_map(cause).collect();
        let limits = plan.limits.as_ref();
        json!({
            "places": self.places(&plan.places),
            "runs": plan.runs.iter().map(|&run| self.timed(run)).collect::<Vec<_>>(),
            "standard_errors": self.errors_of(&plan.errors, Some(&plan.places)),
            "wanted": self.targets(),
            "limits": limits.map(|limits| self.errors_of(limits, Some(&plan.places))),
            "most_by": causes,
            "cost": plan.cost,
        })
    }

    fn targets(&self) -> Value {
        let one = |known: &lptn_fit::network::design::Known| {
            let unit = self.task.unknowns[known.unknown].ty.dimension.si_unit();
            (self.names[known.unknown].clone(), json!(SiValue::new(known.error, &unit)))
        };
        Value::Object(self.task.known.iter().map(one).collect::<Map<String, Value>>())
    }
}
