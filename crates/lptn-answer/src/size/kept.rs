//! Requirements to keep, in every load case.

use lptn_netlist::{Netlist, Requirement, SizeStudy};
use lptn_report::{Standing, TextTable, duration, plain, significant};
use lptn_study::{Judged, LoadCase, SiValue};
use serde_json::{Value, json};

use super::proof::Proof;
use crate::words::spaced;

/// Margins below this share of a unit are rounding.
const ZERO: f64 = 1e-9;

/// The requirements of the first case, then those of the next; in the order of margins.
#[derive(Debug)]
pub(super) struct Kept {
    requirements: Vec<Requirement>,
    cases: Vec<String>,
    /// The proof of the answer, if it was asked for.
    pub(super) proof: Option<Proof>,
}

impl Kept {
    pub(super) fn of(netlist: &Netlist, study: &SizeStudy) -> Self {
        let cases = cases(netlist, study).into_iter().map(|case| case.name).collect();
        Self { requirements: study.requirements.clone(), cases, proof: None }
    }

    /// Their positions.
    pub(super) fn all(&self) -> Vec<usize> {
        (0..self.requirements.len() * self.cases.len().max(1)).collect()
    }

    /// The cases by name; none if the network is taken as it is.
    pub(super) fn cases(&self) -> &[String] {
        &self.cases
    }

    pub(super) fn requirement(&self, i: usize) -> &Requirement {
        &self.requirements[i % self.requirements.len()]
    }

    /// The name of its case.
    pub(super) fn case(&self, i: usize) -> Option<&str> {
        self.cases.get(i / self.requirements.len()).map(String::as_str)
    }

    /// "hot: chip.T <= 75 [degC]".
    pub(super) fn text(&self, i: usize) -> String {
        let text = plain(&self.requirement(i).text);
        self.case(i).map_or(text.clone(), |case| format!("{}: {text}", plain(case)))
    }

    pub(super) fn unit(&self, i: usize) -> String {
        self.requirement(i).ty.dimension.si_unit()
    }

    /// The result of each requirement as an object.
    pub(super) fn members(&self, judged: &Judged) -> Vec<Value> {
        let one = |i: usize| {
            let at = judged.worst_at[i].map(|at| SiValue::new(at, "s"));
            let mut member = json!({
                "requirement": self.requirement(i).text,
                "margin": SiValue::new(judged.margins[i], &self.unit(i)),
                "worst_at": at,
            });
            if let (Some(deviation), Some(left_out)) =
                (judged.deviations.get(i), judged.left_out.get(i))
            {
                member["deviation"] = json!(SiValue::new(*deviation, &self.unit(i)));
                member["left_out"] = json!(SiValue::new(*left_out, &self.unit(i)));
            }
            if let Some(case) = self.case(i) {
                member["case"] = case.into();
            }
            member
        };
        self.all().into_iter().map(one).collect()
    }

    /// Scatter of margins, and the error of the first order, if a probability is required.
    pub(super) fn doubt(&self, judged: &Judged) -> Option<String> {
        let most = |list: &[f64]| {
            let sizes = list.iter().enumerate().map(|(i, value)| (i, value.abs()));
            sizes.max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let (i, deviation) = most(&judged.deviations)?;
        let (k, left_out) = most(&judged.left_out)?;
        let said =
            |i: usize, value: f64| format!("{}{}", significant(value, 2), spaced(&self.unit(i)));
        Some(format!(
            "by the ± of parameters margins scatter by up to {}; terms of second order move \
             them by up to {}",
            said(i, deviation),
            said(k, left_out)
        ))
    }

    /// The result of each requirement: its margin, with `times` the time of that, and a word:
    /// broken, binds or kept.
    pub(super) fn table(
        &self,
        (judged, times): (&Judged, bool),
        binds: impl Fn(usize) -> bool,
    ) -> TextTable {
        let word = |i: usize| match judged.margins[i] {
            margin if margin < 0.0 => "broken",
            _ if binds(i) => "binds",
            _ => "kept",
        };
        let rows = self.all();
        let mut table = TextTable::of(&rows)
            .left("requirement", |&i| self.text(i))
            .right("margin", |&i| self.margin(i, judged.margins[i]));
        if self.proof.is_some() {
            table = table.right("proven error", |&i| self.proven_error(i));
        }
        if times {
            let at = |&i: &usize| judged.worst_at[i].map_or("-".into(), |at| duration(at, 4));
            table = table.right("at", at);
        }
        table
            .left("", |&i| format!("{}{}", word(i), self.is_proven(i)))
            .judged(|&i| if judged.margins[i] < 0.0 { Standing::Fails } else { Standing::Holds })
            .into()
    }

    /// "0.4 K".
    pub(super) fn margin(&self, i: usize, margin: f64) -> String {
        let margin = if margin.abs() < ZERO { 0.0 } else { margin };
        format!("{}{}", significant(margin, 4), spaced(&self.unit(i)))
    }
}

/// The load cases of a study with their values.
pub(super) fn cases(netlist: &Netlist, study: &SizeStudy) -> Vec<LoadCase> {
    let counts = |name: &String| study.cases.as_ref().is_none_or(|names| names.contains(name));
    let all = netlist.studies.cases.iter().filter(|case| counts(&case.name));
    all.filter_map(|case| {
        let set = case.values(&netlist.network).ok()?;
        let signals = case.courses(&netlist.network);
        Some(LoadCase { name: case.name.clone(), set, signals })
    })
    .collect()
}
