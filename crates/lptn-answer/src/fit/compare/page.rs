//! A comparison of fits as a page.

use std::io;

use lptn_fit::choice::{Apart, Held, LAGS, Whiteness};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Standing, Text, TextTable, significant};
use lptn_solve::Table;
use lptn_study::{FileHash, SiValue};
use serde_json::{Map, Value, json};

use super::FitCompareAnswer;
use super::shown::{interval, probability, ratio, share};
use super::words::{likelier, records, unseen, verdict};
use crate::about;
use crate::fit::network::{common, parameter, values};
use crate::messages;
use crate::words::count;

/// Cell of a value that does not exist.
const NOTHING: &str = "-";

impl Page for FitCompareAnswer {
    fn text(&self) -> Text {
        let samples = self.fits.first().map_or(0, |fit| fit.fit.samples());
        let mut text = Text::titled(format!(
            "{}, fitted to {} of {}",
            count(self.candidates.len(), "candidate"),
            count(samples, "value"),
            count(records(self), "record")
        ));
        let order = self.order();
        text.section().table(overview(self, &order));
        for &i in &order {
            let all: Vec<usize> = (0..self.fits[i].unknowns.len()).collect();
            text.section().line(format!("{}:", self.name(i)));
            text.table(values(&self.fits[i], &all));
        }
        if let Some(table) = whiteness(self, &order) {
            text.section().table(table);
        }
        text.conclude(10, notes(self), &verdict(self));
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.table().into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.picture()]
    }

    fn more(&self) -> Report {
        let command = self.candidates.first().map_or(&[][..], |one| &one.input.command);
        let standing = if self.no().is_none() { Standing::Holds } else { Standing::Open };
        let answer = about::verdict(standing, &verdict(self));
        Report { answer, ..about::of_command(&self.hashes(), command) }
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let all = self.candidates.iter().zip(&self.doubts);
        let warnings = all.flat_map(|(one, doubts)| {
            let netlist = &one.input.netlist;
            let all = [netlist.warnings.as_slice(), doubts].concat();
            all.iter().map(|doubt| messages::json(&netlist.files, doubt)).collect::<Vec<_>>()
        });
        json.member("format", &1)?;
        json.member("network", &())?;
        json.member("warnings", &warnings.collect::<Vec<_>>())?;
        let from = match self.choice.held {
            Held::EachRecord => None,
            Held::LastThird { from } => Some(SiValue::new(from, "s")),
        };
        json.member("unseen_from", &from)?;
        json.member(
            "candidates",
            &self.order().into_iter().map(|i| self.one(i)).collect::<Value>(),
        )?;
        let best = self.name(self.choice.best);
        json.member("best", best)?;
        json.member("told", &self.choice.rivals().is_empty())?;
        json.member("simplest", self.name(self.choice.simplest()))?;
        json.member("verdict", &verdict(self))?;
        json.table(&self.table())
    }

    fn no(&self) -> Option<String> {
        (!self.choice.rivals().is_empty()).then(|| verdict(self))
    }
}

fn overview(answer: &FitCompareAnswer, order: &[usize]) -> TextTable {
    let kelvin = |value: f64| significant(value, 3);
    let (unit, behind) = (answer.unit(), |i: usize| answer.judged(i).behind);
    let within = |i: usize| behind(i).and_then(|behind| behind.interval);
    let several = answer.choice.held == Held::EachRecord;
    let mut table = TextTable::of(order)
        .left("candidate", |&i| answer.name(i))
        .names()
        .right("numbers", |&i| answer.judged(i).likely.unknowns.to_string())
        .right(format!("misfit [{unit}]"), |&i| kelvin(answer.judged(i).fit.rms))
        .right("AICc", |&i| answer.shown_above(i))
        .right("weight", |&i| answer.judged(i).weight.map_or(NOTHING.to_owned(), share))
        .right(format!("held-out [{unit}]"), |&i| kelvin(answer.judged(i).unseen_rms()))
        .right("times best", |&i| {
            behind(i).map_or("1".to_owned(), |behind| ratio(behind.ratio, behind.interval))
        });
    if several {
        table = table.right("95 %", |&i| within(i).map_or(String::new(), interval));
    }
    table.left("", |&i| standing(answer, i).0).judged(|&i| standing(answer, i).1).into()
}

/// Verdict on a candidate in a word.
fn standing(answer: &FitCompareAnswer, i: usize) -> (&'static str, Standing) {
    let told = answer.choice.rivals().is_empty();
    match (i == answer.choice.best, told) {
        (true, true) => ("taken", Standing::Holds),
        (true, false) => ("open", Standing::Open),
        (false, _) if answer.judged(i).fit.not_converged.is_some() => {
            ("no minimum", Standing::Fails)
        }
        (false, _) if answer.choice.is_told(i) => ("worse", Standing::Fails),
        (false, _) => ("open", Standing::Open),
    }
}

fn whiteness(answer: &FitCompareAnswer, order: &[usize]) -> Option<TextTable> {
    /// Most columns next to each other.
    const MOST: usize = 5;
    let columns = &answer.judged(order[0]).task.runs.first()?.columns;
    let known = |column: usize| answer.judged(order[0]).whiteness.get(column)?.as_ref();
    if !(0..columns.len()).any(|column| known(column).is_some()) {
        return None;
    }
    let cell = |i: usize, column: usize| {
        let found = answer.judged(i).whiteness.get(column).copied().flatten();
        found.map_or(NOTHING.to_owned(), |white| probability(white.p))
    };
    let mut table = TextTable::of(order).left("white, with p", |&i| answer.name(i)).names();
    for (column, measured) in columns.iter().enumerate().take(MOST) {
        table = table.right(measured.name.as_str(), move |&i| cell(i, column));
    }
    Some(table.into())
}

fn notes(answer: &FitCompareAnswer) -> Vec<(&'static str, String)> {
    let means = answer.judged(answer.choice.best).likely.means;
    let of_noise = |&i: &usize| answer.judged(i).likely.of_noise.to_string();
    let noise: Vec<String> = answer.order().iter().map(of_noise).collect();
    let mut notes = vec![
        ("held-out", unseen(answer)),
        (
            "AICc",
            format!(
                "above the least, from {}; the noise needs {} numbers more",
                count(means, "mean"),
                noise.join(", ")
            ),
        ),
    ];
    if answer.judged(answer.choice.best).whiteness.iter().any(Option::is_some) {
        let text =
            format!("p of Ljung and Box, {LAGS} lags: below 0.05 the residuals are correlated");
        notes.push(("white", text));
    }
    notes.extend(likelier(answer).map(|text| ("but", text)));
    notes
}

impl FitCompareAnswer {
    /// A row for each candidate.
    pub fn table(&self) -> Table {
        let order = self.order();
        let unit = common(&self.choice.contenders[0].task);
        let nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let ends = |i: usize| self.judged(i).behind.and_then(|behind| behind.interval);
        let mut table = Table::of(&order);
        table.label("candidate", |&i| self.name(i).to_owned());
        table.label("state", |&i| standing(self, i).0.to_owned());
        table.column("numbers", "1", |&i| self.judged(i).likely.unknowns as f64);
        table.column("misfit", &unit, |&i| self.judged(i).fit.rms);
        table.column("log_likelihood", "1", |&i| -0.5 * self.judged(i).likely.misfit);
        table.column("AICc", "1", |&i| nan(self.judged(i).likely.aicc));
        table.column("weight", "1", |&i| nan(self.judged(i).weight));
        table.column("unseen", &unit, |&i| self.judged(i).unseen_rms());
        table.column("times_best", "1", |&i| {
            self.judged(i).behind.map_or(1.0, |behind| behind.ratio)
        });
        table.column("times_best_low", "1", |&i| nan(ends(i).map(|ends| ends.0)));
        table.column("times_best_high", "1", |&i| nan(ends(i).map(|ends| ends.1)));
        table.done()
    }

    /// A row for each held-out record of each candidate.
    pub fn unseen(&self) -> Table {
        let rows: Vec<(usize, usize)> = self
            .order()
            .into_iter()
            .flat_map(|i| (0..self.judged(i).unseen.len()).map(move |part| (i, part)))
            .collect();
        let unit = common(&self.choice.contenders[0].task);
        let part = |&(i, part): &(usize, usize)| &self.judged(i).unseen[part];
        let mut table = Table::of(&rows);
        table.label("candidate", |&(i, _)| self.name(i).to_owned());
        table.label("record", |row| self.judged(row.0).task.runs[part(row).run].name.clone());
        table.column("values", "1", |row| part(row).samples as f64);
        table.column("missed", &unit, |row| part(row).rms);
        table.column("missed_over_sigma", "1", |row| part(row).over_sigma);
        table.done()
    }

    /// Every file that was read, each once.
    pub fn hashes(&self) -> Vec<FileHash> {
        let mut all: Vec<FileHash> = Vec::new();
        for hash in self.candidates.iter().flat_map(|one| about::hashes(&one.input.netlist)) {
            if all.iter().all(|known| known.name != hash.name) {
                all.push(hash);
            }
        }
        all
    }

    fn one(&self, i: usize) -> Value {
        let (one, judged, fit) = (&self.candidates[i], self.judged(i), &self.fits[i]);
        let parameters: Map<String, Value> =
            (0..fit.unknowns.len()).map(|j| (fit.name(j).to_owned(), parameter(fit, j))).collect();
        let (behind, unit) = (judged.behind, common(&judged.task));
        let part = |part: &lptn_fit::choice::UnseenRecord| {
            json!({
                "record": judged.task.runs[part.run].name,
                "samples": part.samples,
                "rms": SiValue::new(part.rms, &unit),
                "over_sigma": part.over_sigma,
                "converged": part.converged,
                "identifiable": part.whole,
            })
        };
        json!({
            "name": one.name,
            "file": one.input.text.name,
            "study": one.study.name,
            "state": standing(self, i).0,
            "parameters": parameters,
            "identifiable": fit.is_whole(),
            "rms": SiValue::new(judged.fit.rms, &unit),
            "log_likelihood": -0.5 * judged.likely.misfit,
            "means": judged.likely.means,
            "numbers": judged.likely.unknowns,
            "numbers_of_noise": judged.likely.of_noise,
            "aicc": judged.likely.aicc,
            "weight": judged.weight,
            "whiteness": self.whiteness_of(i),
            "unseen": judged.unseen.iter().map(part).collect::<Vec<_>>(),
            "unseen_rms": SiValue::new(judged.unseen_rms(), &unit),
            "times_best": behind.map(|behind| behind.ratio),
            "times_best_95": behind.and_then(|behind| behind.interval),
            "records_enough": behind.and_then(|behind| behind.records),
            "apart": judged.apart.map(|apart| self.apart(i, apart)),
        })
    }

    fn whiteness_of(&self, i: usize) -> Value {
        let judged = self.judged(i);
        let columns = judged.task.runs.first().map_or(&[][..], |run| &run.columns);
        let one = |white: &Whiteness| json!({ "statistic": white.statistic, "degrees": white.degrees, "p": white.p });
        let named = columns.iter().zip(&judged.whiteness);
        Value::Object(
            named.map(|(c, white)| (c.name.clone(), json!(white.as_ref().map(one)))).collect(),
        )
    }

    fn apart(&self, i: usize, apart: Apart) -> Value {
        let run = &self.judged(i).task.runs[apart.run];
        json!({
            "record": run.name,
            "column": run.columns[apart.column].name,
            "time": SiValue::new(apart.time, "s"),
            "by": SiValue::new(apart.by, &run.columns[apart.column].ty.dimension.si_unit()),
        })
    }
}
