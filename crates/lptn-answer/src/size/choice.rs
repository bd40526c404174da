//! Catalogues, and which part of each to take.

use std::io;

use lptn_netlist::{Catalogue, Goal};
use lptn_network::ParameterId;
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, duration, plain, significant,
};
use lptn_solve::Table;
use lptn_study::{Choice, ChoiceTask, Choices, Design, Parts, SiValue};
use serde_json::{Value, json};

use super::kept::Kept;
use super::{Asked, aim, figure, page};
use crate::about::{self, Known};
use crate::failure::Failure;
use crate::listener::Listener;
use crate::words::{count, unverified};

/// Cell of an unknown value.
const NOTHING: &str = "-";

/// The name of a part that is left out.
const NO_PART: &str = "none";

/// Rows of the table for people: cheaper choices that fail, and dearer ones that work.
const MOST_CHEAPER: usize = 12;
const MOST_DEARER: usize = 4;

pub(super) fn choose(
    asked: Asked,
    threads: usize,
    listener: &dyn Listener,
) -> Result<Chosen, Failure> {
    let Asked { input, study, .. } = &asked;
    let network = &input.netlist.network;
    let known = |catalogue: &Catalogue| {
        let ids = catalogue.columns.iter().filter_map(|one| network.parameter(&one.name).ok());
        let values = |part: usize| catalogue.columns.iter().map(|one| one.values[part]).collect();
        Parts {
            parameters: ids.collect(),
            values: (0..catalogue.parts.len()).map(values).collect(),
        }
    };
    let catalogues: Vec<Parts> = study.catalogues.iter().map(known).collect();
    let varied = study.ranges(network).unwrap_or_default();
    let choices = asked.demand(listener, |demand| {
        let (aim, catalogues, varied) = (aim(study), &catalogues, &varied);
        lptn_study::choose(&ChoiceTask { demand, aim, catalogues, varied, threads })
    })?;
    let set = catalogues.iter().flat_map(|parts| parts.parameters.iter().copied());
    let ids = set.chain(varied.iter().map(|(id, _)| *id)).collect();
    Ok(Chosen { asked, choices, ids })
}

/// Result of choosing parts.
#[derive(Debug)]
pub(super) struct Chosen {
    pub(super) asked: Asked,
    choices: Choices,
    /// The parameters in the order in which designs have them.
    ids: Vec<ParameterId>,
}

impl Chosen {
    fn catalogues(&self) -> &[Catalogue] {
        &self.asked.study.catalogues
    }

    fn kept(&self) -> &Kept {
        &self.asked.kept
    }

    fn best(&self) -> Option<&Choice> {
        self.choices.best.map(|best| &self.choices.judged[best])
    }

    /// "HS-120 with F80"; a part called `none` is left out next to others.
    fn parts(&self, choice: &Choice) -> String {
        let names = || {
            let parts = self.catalogues().iter().zip(&choice.parts);
            parts.map(|(one, &part)| plain(&one.parts[part]))
        };
        let told: Vec<String> = names().filter(|name| name != NO_PART).collect();
        if told.is_empty() { NO_PART.to_owned() } else { told.join(" with ") }
    }

    fn objective(&self, choice: &Choice) -> String {
        match choice.objective.is_nan() {
            true => NOTHING.to_owned(),
            false => page::objective(&self.asked, choice.objective),
        }
    }

    /// The requirement that is broken most. If all are kept, it is the closest one.
    fn worst(&self, choice: &Choice) -> usize {
        choice.judged.as_ref().map_or(0, |judged| self.choices.shortfall.worst(judged))
    }

    fn margin(&self, choice: &Choice, i: usize) -> String {
        let margin = choice.margins().get(i);
        margin.map_or_else(|| NOTHING.to_owned(), |margin| self.kept().margin(i, *margin))
    }

    /// The choices that people see.
    /// The last failing ones with a better objective, the answer, the first working ones after it.
    /// If something is sized for each choice, the failing ones that come closest are last.
    fn shown(&self) -> Vec<&Choice> {
        let judged = &self.choices.judged;
        let Some(best) = self.choices.best else { return self.nearest() };
        let first = best.saturating_sub(MOST_CHEAPER);
        let dearer = judged[best + 1..].iter().filter(|choice| choice.keeps()).take(MOST_DEARER);
        let shown = judged[first..=best].iter().chain(dearer);
        match self.asked.study.varied.is_empty() {
            true => shown.collect(),
            false => shown.chain(self.nearest()).collect(),
        }
    }

    /// The choices that break a requirement, the closest first.
    fn nearest(&self) -> Vec<&Choice> {
        let broken = self.choices.judged.iter().filter(|choice| !choice.keeps());
        let mut nearest: Vec<&Choice> = broken.collect();
        nearest.sort_by(|a, b| self.least(b).total_cmp(&self.least(a)));
        nearest.truncate(MOST_CHEAPER);
        nearest
    }

    /// The margin of the worst requirement in one measure for all.
    fn least(&self, choice: &Choice) -> f64 {
        let least = choice.judged.as_ref().map(|judged| self.choices.shortfall.least(judged));
        least.unwrap_or(f64::NEG_INFINITY)
    }

    fn table(&self) -> TextTable {
        let shown = self.shown();
        let at = |choice: &Choice| {
            let judged = choice.judged.as_ref().ok()?;
            judged.worst_at.get(self.worst(choice)).copied().flatten()
        };
        let over_time = shown.iter().any(|choice| at(choice).is_some());
        let mut table = TextTable::of(&shown).left("parts", |choice| self.parts(choice));
        let first = self.ids.len() - self.asked.study.varied.len();
        for (i, range) in self.asked.study.varied.iter().enumerate() {
            let unit = self.asked.input.unit_of(self.ids[first + i]);
            let value = move |choice: &&Choice| {
                let value = choice.values.get(first + i).map(|si| unit.from_si(*si));
                value.map_or_else(|| NOTHING.to_owned(), |value| significant(value, 5))
            };
            let unit = self.asked.input.unit_of(self.ids[first + i]).text;
            table = table.right(format!("{} [{unit}]", range.name), value);
        }
        table = table.right("objective", |choice| self.objective(choice));
        if self.kept().all().len() > 1 {
            let closest = |choice: &Choice| self.kept().text(self.worst(choice));
            table = table.left("closest", move |choice| closest(choice));
        }
        table = table.right("margin", |choice| self.margin(choice, self.worst(choice)));
        if over_time {
            let text =
                move |choice: &&Choice| at(choice).map_or(NOTHING.into(), |t| duration(t, 4));
            table = table.right("at", text);
        }
        let judged = |choice: &&Choice| match choice.keeps() {
            true => Standing::Holds,
            false => Standing::Fails,
        };
        table.left("", |choice| self.word(choice)).judged(judged).into()
    }

    /// Result of a choice in a word, or the code of the error if it could not be judged.
    fn word(&self, choice: &Choice) -> String {
        match (&choice.judged, self.best()) {
            (Err(error), _) => error.code().to_owned(),
            (_, Some(best)) if std::ptr::eq(best, choice) => "the answer".to_owned(),
            _ if choice.keeps() => "works".to_owned(),
            _ => "fails".to_owned(),
        }
    }

    fn verdict(&self) -> String {
        let what = &self.asked.study.objective.text;
        let Some(best) = self.best() else {
            let nearest = self.shown().first().copied();
            return nearest.map_or_else(String::new, |choice| {
                let i = self.worst(choice);
                format!(
                    "infeasible: none of {} keeps every requirement; {} comes closest and breaks \
                     `{}` by {}",
                    count(self.choices.count, "choice"),
                    self.parts(choice),
                    self.kept().text(i),
                    self.margin(choice, i).trim_start_matches('-')
                )
            });
        };
        let better = &self.choices.judged[..self.choices.best.unwrap_or(0)];
        let lost = match better.iter().filter(|choice| choice.judged.is_err()).count() {
            0 => String::new(),
            lost => format!(", but for {lost} that could not be judged"),
        };
        let better = match (better.is_empty(), self.asked.study.goal) {
            (true, _) => String::new(),
            (_, Goal::Minimise) => format!("; every choice with less of it fails{lost}"),
            (_, Goal::Maximise) => format!("; every choice with more of it fails{lost}"),
        };
        format!(
            "{}{} keeps every requirement, {what} = {}{better}",
            self.parts(best),
            self.sized(best),
            self.objective(best)
        )
    }

    /// " with v = 2.1 m/s".
    fn sized(&self, choice: &Choice) -> String {
        let first = self.ids.len() - self.asked.study.varied.len();
        let of = self.ids.iter().zip(&choice.values).skip(first);
        let named = of.zip(&self.asked.study.varied).map(|((id, value), range)| {
            page::quantity(&range.name, *value, &self.asked.input.unit_of(*id))
        });
        let all: Vec<String> = named.collect();
        if all.is_empty() { String::new() } else { format!(" with {}", all.join(", ")) }
    }

    /// The values of a choice in SI units by parameter.
    fn values(&self, choice: &Choice) -> Vec<(ParameterId, f64)> {
        self.ids.iter().copied().zip(choice.values.iter().copied()).collect()
    }

    fn member(&self, choice: &Choice) -> Value {
        let names =
            self.catalogues().iter().zip(&choice.parts).map(|(one, &part)| &one.parts[part]);
        let unit = self.asked.study.objective.ty.dimension.si_unit();
        let judged = choice.judged.as_ref();
        json!({
            "parts": names.collect::<Vec<_>>(),
            "objective": Some(choice.objective).filter(|o| o.is_finite()).map(|o| SiValue::new(o, &unit)),
            "feasible": choice.keeps(),
            "values": self.asked.values(&self.values(choice)),
            "requirements": judged.ok().map(|judged| self.kept().members(judged)),
            "failed": judged.err().map(|error| error.code()),
        })
    }

    /// The values of the answer in SI units by parameter.
    pub(super) fn best_values(&self) -> Option<Vec<(ParameterId, f64)>> {
        self.best().map(|best| self.values(best))
    }

    /// Its margins in SI units.
    pub(super) fn best_margins(&self) -> Option<&[f64]> {
        self.best().map(Choice::margins)
    }
}

impl Page for Chosen {
    fn text(&self) -> Text {
        let Asked { input, study, .. } = &self.asked;
        let goal = page::goal(study.goal);
        let files: Vec<String> = self.catalogues().iter().map(|one| plain(&one.csv)).collect();
        let mut text = Text::titled(input.title());
        let choices = count(self.choices.count, "choice");
        text.sentence(
            "",
            &format!(
                "size {}: the {goal} {} of {choices}",
                study.name,
                plain(&study.objective.text)
            ),
        );
        let varied: Vec<String> = study.varied.iter().map(|range| plain(&range.name)).collect();
        let sized = match varied.is_empty() {
            true => String::new(),
            false => format!(", with {} sized for each choice", varied.join(", ")),
        };
        text.sentence("", &format!("one part of {}{sized}", files.join(", one of ")));
        let kept: Vec<String> = study.requirements.iter().map(|r| plain(&r.text)).collect();
        text.sentence("", &format!("that keeps {}", kept.join(", ")));
        page::when(&mut text, &input.netlist, (study, self.kept()));
        text.section().table(self.table());
        text.section();
        if let Some(unsure) = unverified(&input.netlist.network) {
            text.sentence("note     ", &unsure);
        }
        let best = self.best().and_then(|best| self.kept().doubt(best.judged.as_ref().ok()?));
        if let Some(doubt) = best {
            text.sentence("scatter  ", &doubt);
        }
        for note in self.kept().notes() {
            text.sentence("note     ", &note);
        }
        let solved = page::solved(study.over);
        let left = self.choices.count - self.choices.judged.len();
        let rest = match left {
            0 => String::new(),
            left => format!(
                "; {} with a worse objective were not \
                evaluated",
                count(left, "choice")
            ),
        };
        let proof = format!("{} {solved} of the full network{rest}", self.choices.solved);
        text.sentence("proof    ", &proof);
        text.section().sentence("", &self.verdict());
        text
    }

    /// A row for each choice that was judged, the best first.
    /// It has parts, values in the units of the files, and margins in SI units.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&self.choices.judged);
        for (k, catalogue) in self.catalogues().iter().enumerate() {
            table.label(&catalogue.csv, |choice| catalogue.parts[choice.parts[k]].clone());
        }
        let unit = self.asked.study.objective.ty.dimension.si_unit();
        let first = self.ids.len() - self.asked.study.varied.len();
        for (i, range) in self.asked.study.varied.iter().enumerate() {
            let unit = self.asked.input.unit_of(self.ids[first + i]);
            let value = |choice: &Choice| choice.values.get(first + i).map(|si| unit.from_si(*si));
            let text = unit.text.clone();
            table.column(&range.name, text, |choice| value(choice).unwrap_or(f64::NAN));
        }
        table.column(&self.asked.study.objective.text, unit, |choice| choice.objective);
        let columns = self.catalogues().iter().flat_map(|one| &one.columns);
        for (i, column) in columns.enumerate() {
            let value = |choice: &Choice| column.unit.from_si(choice.values[i]);
            table.column(&column.name, &column.unit.text, value);
        }
        let feasible = |choice: &Choice| if choice.keeps() { 1.0 } else { 0.0 };
        table.column("feasible", "-", feasible);
        if self.choices.judged.iter().any(|choice| choice.judged.is_err()) {
            let code = |choice: &Choice| choice.judged.as_ref().err().map(|error| error.code());
            table.label("failed", move |choice| code(choice).unwrap_or_default().to_owned());
        }
        for i in self.kept().all() {
            let margin = |choice: &Choice| choice.margins().get(i).copied().unwrap_or(f64::NAN);
            table.column(self.kept().text(i), self.kept().unit(i), margin);
        }
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        let design = |choice: &Choice| {
            let (values, objective) = (choice.values.clone(), choice.objective);
            Some(Design { values, objective, judged: choice.judged.as_ref().ok()?.clone() })
        };
        let all: Vec<Design> = self.choices.judged.iter().filter_map(design).collect();
        let best = self.best().and_then(design);
        vec![figure::designs(&self.asked, &all.iter().collect::<Vec<_>>(), best.as_ref())]
    }

    fn more(&self) -> Report {
        about::about(&self.asked.input, Known::default()).answered(&self.verdict())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let best = self.best();
        let shown = best.or_else(|| self.shown().first().copied());
        let worst = shown.map(|choice| self.worst(choice));
        let margin = shown
            .zip(worst)
            .and_then(|(c, i)| Some(SiValue::new(*c.margins().get(i)?, &self.kept().unit(i))));
        self.asked.input.head(json, &self.kept().doubts())?;
        json.member("values", &shown.map(|choice| self.asked.values(&self.values(choice))))?;
        json.member("margin", &margin)?;
        json.member("binding", &worst.map(|i| &self.kept().requirement(i).text))?;
        json.member("feasible", &best.is_some())?;
        json.member("over", self.asked.study.over.word())?;
        json.optional("proven", self.kept().proof_members())?;
        json.member("objective", &self.asked.study.objective.text)?;
        json.member("count", &self.choices.count)?;
        let all: Vec<Value> =
            self.choices.judged.iter().map(|choice| self.member(choice)).collect();
        json.member("choices", &all)
    }

    fn no(&self) -> Option<String> {
        self.best().is_none().then(|| self.verdict())
    }
}
