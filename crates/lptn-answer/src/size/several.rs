//! Several parameters, and their objective.

use std::io;

use lptn_network::ParameterId;
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, plain, significant};
use lptn_solve::Table;
use lptn_study::{Design, Several, SeveralTask, SiValue, size_several};
use lptn_units::Unit;
use serde_json::json;

use super::kept::Kept;
use super::{Asked, aim, figure, page};
use crate::about::{self, Known};
use crate::failure::Failure;
use crate::listener::Listener;
use crate::ranges;
use crate::words::unverified;

/// Digits of a value that is shown.
const DIGITS: usize = 6;

/// Relative distance from an end of its range within which a value is at the end.
const AT_END: f64 = 1e-6;

pub(super) fn size(
    asked: Asked,
    threads: usize,
    listener: &dyn Listener,
) -> Result<Sized, Failure> {
    let Asked { input, study, .. } = &asked;
    let ranges = study.ranges(&input.netlist.network).unwrap_or_default();
    let (aim, varied) = (aim(study), ranges.clone());
    let found = asked
        .demand(listener, |demand| size_several(&SeveralTask { demand, aim, varied, threads }))?;
    let units = ranges.iter().map(|(id, _)| input.unit_of(*id)).collect();
    Ok(Sized { asked, found, ranges, units })
}

/// Result of sizing several parameters.
#[derive(Debug)]
pub(super) struct Sized {
    pub(super) asked: Asked,
    found: Several,
    ranges: Vec<(ParameterId, (f64, f64))>,
    units: Vec<Unit>,
}

impl Sized {
    fn kept(&self) -> &Kept {
        &self.asked.kept
    }

    /// The values in SI units by parameter.
    pub(super) fn values(&self) -> Vec<(ParameterId, f64)> {
        let of = self.ranges.iter().zip(&self.found.design.values);
        of.map(|((id, _), value)| (*id, *value)).collect()
    }

    /// The margins in SI units.
    pub(super) fn margins(&self) -> &[f64] {
        &self.found.design.judged.margins
    }

    fn name(&self, i: usize) -> &str {
        &self.asked.study.varied[i].name
    }

    fn parameters(&self) -> TextTable {
        let places: Vec<usize> = (0..self.ranges.len()).collect();
        let number = |i: usize, si: f64| significant(self.units[i].from_si(si), DIGITS);
        let range = |&i: &usize| {
            let (from, to) = self.ranges[i].1;
            format!("{} .. {}", number(i, from), number(i, to))
        };
        let end = |&i: &usize| {
            let ((from, to), value) = (self.ranges[i].1, self.found.design.values[i]);
            match (value - from, to - value) {
                (low, _) if low <= AT_END * (to - from) => "the least of its range",
                (_, high) if high <= AT_END * (to - from) => "the largest of its range",
                _ => "",
            }
        };
        TextTable::of(&places)
            .left("parameter", |&i| self.name(i).to_owned())
            .right("value", |&i| number(i, self.found.design.values[i]))
            .left("", |&i| self.units[i].text.clone())
            .left("range", range)
            .left("", end)
            .into()
    }

    fn requirements(&self) -> TextTable {
        let judged = &self.found.design.judged;
        let times = judged.worst_at.iter().any(Option::is_some);
        self.kept().table((judged, times), |i| self.found.binding.contains(&i))
    }

    fn objective(&self) -> String {
        let text = plain(&self.asked.study.objective.text);
        format!("{text} = {}", page::objective(&self.asked, self.found.design.objective))
    }

    fn verdict(&self) -> String {
        if self.found.feasible {
            let goal = page::goal(self.asked.study.goal);
            return format!(
                "{}, the {goal} that was found, keeps every requirement",
                self.objective()
            );
        }
        let i = self.found.worst;
        let off = self.kept().margin(i, -self.found.design.judged.margins[i]);
        let text = self.kept().text(i);
        format!("infeasible: at the closest values that were found `{text}` is broken by {off}")
    }
}

impl Page for Sized {
    fn text(&self) -> Text {
        let Asked { input, study, .. } = &self.asked;
        let goal = page::goal(study.goal);
        let mut text = Text::titled(input.title());
        let objective = plain(&study.objective.text);
        text.sentence("", &format!("size {}: the {goal} {objective}", study.name));
        page::when(&mut text, &input.netlist, (study, self.kept()));
        text.section().table(self.parameters());
        text.section().table(self.requirements());
        text.section();
        if let Some(unsure) = unverified(&input.netlist.network) {
            text.sentence("note     ", &unsure);
        }
        if let Some(doubt) = self.kept().doubt(&self.found.design.judged) {
            text.sentence("scatter  ", &doubt);
        }
        for note in self.kept().notes() {
            text.sentence("note     ", &note);
        }
        let outside = &self.found.design.judged.out_of_range;
        for warning in ranges::warnings(&input.netlist, outside, false) {
            text.sentence("note     ", &warning.message);
        }
        let proof = format!(
            "{} {} of the full network; none of the {} points evaluated is better",
            self.found.solved,
            page::solved(study.over),
            self.found.looked_at.len()
        );
        text.sentence("proof    ", &proof);
        text.section().sentence("", &self.verdict());
        text
    }

    /// One row: the values in their units, the objective and the margins in SI units.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&[()]);
        for (i, unit) in self.units.iter().enumerate() {
            let value = unit.from_si(self.found.design.values[i]);
            table.column(self.name(i), &unit.text, |()| value);
        }
        let objective = &self.asked.study.objective;
        let value = self.found.design.objective;
        table.column(&objective.text, objective.ty.dimension.si_unit(), |()| value);
        table.column("feasible", "-", |()| if self.found.feasible { 1.0 } else { 0.0 });
        for (i, &margin) in self.found.design.judged.margins.iter().enumerate() {
            table.column(self.kept().text(i), self.kept().unit(i), |()| margin);
        }
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        let all: Vec<&Design> = self.found.looked_at.iter().chain([&self.found.design]).collect();
        let answer = Some(&self.found.design).filter(|_| self.found.feasible);
        vec![figure::designs(&self.asked, &all, answer)]
    }

    fn more(&self) -> Report {
        about::about(&self.asked.input, Known::default()).answered(&self.verdict())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (judged, worst) = (&self.found.design.judged, self.found.worst);
        let mut requirements = self.kept().members(judged);
        for (i, member) in requirements.iter_mut().enumerate() {
            member["binds"] = self.found.binding.contains(&i).into();
        }
        let objective = &self.asked.study.objective;
        let value = SiValue::new(self.found.design.objective, &objective.ty.dimension.si_unit());
        let binding = self.found.binding.first().map(|&i| &self.kept().requirement(i).text);
        self.asked.input.head(json, &self.kept().doubts())?;
        json.member("values", &self.asked.values(&self.values()))?;
        json.member("margin", &SiValue::new(judged.margins[worst], &self.kept().unit(worst)))?;
        json.member("binding", &binding)?;
        json.member("feasible", &self.found.feasible)?;
        json.member("over", self.asked.study.over.word())?;
        json.optional("proven", self.kept().proof_members())?;
        json.member("objective", &json!({ "text": objective.text, "value": value }))?;
        json.member("requirements", &requirements)
    }

    fn no(&self) -> Option<String> {
        (!self.found.feasible).then(|| self.verdict())
    }
}
