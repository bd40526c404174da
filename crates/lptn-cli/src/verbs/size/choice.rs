//! `lptn size` with catalogues: which parts.

use std::io;

use lptn_netlist::{Catalogue, Goal};
use lptn_network::ParameterId;
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, duration, plain, significant,
};
use lptn_solve::{Table, available_threads};
use lptn_study::{Aim, Choice, ChoiceTask, Choices, Design, Parts, SiValue, choose};
use serde_json::{Map, Value, json};

use super::kept::Kept;
use super::{Asked, failed, figure, page, write};
use crate::about::{self, Known};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::words::{count, spaced, unverified};

/// The name of a part that is left out.
const NO_PART: &str = "none";

/// Rows of the table for people: what is cheaper and fails, and what is dearer and works.
const MOST_CHEAPER: usize = 12;
const MOST_DEARER: usize = 4;

pub(super) fn choice(asked: &Asked<'_>) -> Result<Exit, Failure> {
    let &Asked { input, study, .. } = asked;
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
    let aim = Aim { value: &study.objective.value, goal: study.goal };
    let threads = asked.args.threads.unwrap_or_else(available_threads);
    let choices = asked
        .demand(|demand| choose(&ChoiceTask { demand, aim, catalogues: &catalogues, threads }));
    let choices = choices.map_err(|error| failed(input, study, &error))?;
    let ids = catalogues.iter().flat_map(|parts| parts.parameters.iter().copied()).collect();
    let scale = scale(&choices);
    let answer = Answer { asked, choices, ids, scale };
    asked.show(&answer, || answer.write())
}

struct Answer<'a> {
    asked: &'a Asked<'a>,
    choices: Choices,
    /// The parameters in the order in which designs have them.
    ids: Vec<ParameterId>,
    /// The largest size of each margin.
    scale: Vec<f64>,
}

fn scale(choices: &Choices) -> Vec<f64> {
    let mut scale = vec![f64::MIN_POSITIVE; choices.judged.first().map_or(0, count_of)];
    for choice in &choices.judged {
        let sizes = choice.design.judged.margins.iter().map(|margin| margin.abs());
        scale.iter_mut().zip(sizes).for_each(|(most, size)| *most = most.max(size));
    }
    scale
}

fn count_of(choice: &Choice) -> usize {
    choice.design.judged.margins.len()
}

impl Answer<'_> {
    fn catalogues(&self) -> &[Catalogue] {
        &self.asked.study.catalogues
    }

    fn kept(&self) -> &Kept<'_> {
        &self.asked.kept
    }

    fn best(&self) -> Option<&Choice> {
        self.choices.best.map(|best| &self.choices.judged[best])
    }

    /// "HS-120 with F80"; a part called `none` is not told beside others.
    fn parts(&self, choice: &Choice) -> String {
        let names = || {
            let parts = self.catalogues().iter().zip(&choice.parts);
            parts.map(|(one, &part)| plain(&one.parts[part]))
        };
        let told: Vec<String> = names().filter(|name| name != NO_PART).collect();
        if told.is_empty() { NO_PART.to_owned() } else { told.join(" with ") }
    }

    fn objective(&self, choice: &Choice) -> String {
        let unit = self.asked.study.objective.ty.dimension.si_unit();
        format!("{}{}", significant(choice.design.objective, 6), spaced(&unit))
    }

    /// The requirement that is broken by most, in shares of the largest margin that it has anywhere;
    /// where all are kept the one that comes closest.
    fn worst(&self, choice: &Choice) -> usize {
        let shares =
            choice.design.judged.margins.iter().zip(&self.scale).map(|(m, scale)| m / scale);
        shares.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
    }

    fn margin(&self, choice: &Choice, i: usize) -> String {
        self.kept().margin(i, choice.design.judged.margins[i])
    }

    /// Those that are shown to people: the last that are better by what is sought and fail, the
    /// answer, and the first behind it that work.
    fn shown(&self) -> Vec<&Choice> {
        let judged = &self.choices.judged;
        let Some(best) = self.choices.best else {
            let mut nearest: Vec<&Choice> = judged.iter().collect();
            nearest.sort_by(|a, b| self.share(b).total_cmp(&self.share(a)));
            nearest.truncate(MOST_CHEAPER);
            return nearest;
        };
        let first = best.saturating_sub(MOST_CHEAPER);
        let dearer = judged[best + 1..].iter().filter(|choice| choice.design.judged.keeps());
        judged[first..=best].iter().chain(dearer.take(MOST_DEARER)).collect()
    }

    /// The margin of the worst requirement as a share of its size.
    fn share(&self, choice: &Choice) -> f64 {
        let i = self.worst(choice);
        choice.design.judged.margins[i] / self.scale[i]
    }

    fn table(&self) -> TextTable {
        let shown = self.shown();
        let over_time = shown.iter().any(|c| c.design.judged.worst_at.iter().any(Option::is_some));
        let word = |choice: &Choice| match self.best() {
            Some(best) if std::ptr::eq(best, choice) => "the answer",
            _ if choice.design.judged.keeps() => "works",
            _ => "fails",
        };
        let mut table = TextTable::of(&shown)
            .left("parts", |choice| self.parts(choice))
            .right("sought", |choice| self.objective(choice));
        if self.kept().all().len() > 1 {
            let closest = |choice: &Choice| self.kept().text(self.worst(choice));
            table = table.left("closest", move |choice| closest(choice));
        }
        table = table.right("margin", |choice| self.margin(choice, self.worst(choice)));
        if over_time {
            let at = |choice: &Choice| choice.design.judged.worst_at[self.worst(choice)];
            table =
                table.right("at", move |choice| at(choice).map_or("-".into(), |t| duration(t, 4)));
        }
        let judged = |choice: &&Choice| match choice.design.judged.keeps() {
            true => Standing::Holds,
            false => Standing::Fails,
        };
        table.left("", |choice| word(choice)).judged(judged).into()
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
        let better = match (self.choices.best, self.asked.study.goal) {
            (Some(0), _) => String::new(),
            (_, Goal::Minimise) => "; every choice with less of it fails".to_owned(),
            (_, Goal::Maximise) => "; every choice with more of it fails".to_owned(),
        };
        format!(
            "{} keeps every requirement, {what} = {}{better}",
            self.parts(best),
            self.objective(best)
        )
    }

    /// The values of a choice by parameter.
    fn values(&self, choice: &Choice) -> Map<String, Value> {
        let parameters = self.asked.input.netlist.network.parameters();
        let of = self.ids.iter().zip(&choice.design.values);
        of.map(|(id, &value)| {
            let parameter = &parameters[id.index()];
            let value = SiValue::new(value, &parameter.ty.dimension.si_unit());
            (parameter.name.clone(), json!(value))
        })
        .collect()
    }

    fn member(&self, choice: &Choice) -> Value {
        let names =
            self.catalogues().iter().zip(&choice.parts).map(|(one, &part)| &one.parts[part]);
        let judged = &choice.design.judged;
        let unit = self.asked.study.objective.ty.dimension.si_unit();
        json!({
            "parts": names.collect::<Vec<_>>(),
            "objective": SiValue::new(choice.design.objective, &unit),
            "feasible": judged.keeps(),
            "values": self.values(choice),
            "requirements": self.kept().members(judged),
        })
    }

    fn write(&self) -> Result<(), Failure> {
        let Some(best) = self.best() else { return Ok(()) };
        let values: Vec<_> =
            self.ids.iter().copied().zip(best.design.values.iter().copied()).collect();
        let &Asked { input, study, file, console, .. } = self.asked;
        write::write_all((input, study), &values, (file, console))
    }
}

impl Page for Answer<'_> {
    fn text(&self) -> Text {
        let (input, study) = (self.asked.input, self.asked.study);
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
        text.sentence("", &format!("one part of {}", files.join(", one of ")));
        let kept: Vec<String> = study.requirements.iter().map(|r| plain(&r.text)).collect();
        text.sentence("", &format!("that keeps {}", kept.join(", ")));
        page::when(&mut text, &input.netlist, (study, self.kept()));
        text.section().table(self.table());
        text.section();
        if let Some(unsure) = unverified(&input.netlist.network) {
            text.sentence("note     ", &unsure);
        }
        let best = self.best().and_then(|best| self.kept().doubt(&best.design.judged));
        if let Some(doubt) = best {
            text.sentence("scatter  ", &doubt);
        }
        let solved = page::solved(study.over);
        let left = self.choices.count - self.choices.judged.len();
        let rest = match left {
            0 => String::new(),
            left => format!("; {} with more to lose were not looked at", count(left, "choice")),
        };
        let proof = format!("{} {solved} of the full network{rest}", self.choices.solved);
        text.sentence("proof    ", &proof);
        text.section().sentence("", &self.verdict());
        text
    }

    /// A row for each choice that was judged, the best first: parts, values in the units of the
    /// files, margins in SI units.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&self.choices.judged);
        for (k, catalogue) in self.catalogues().iter().enumerate() {
            table.label(&catalogue.csv, |choice| catalogue.parts[choice.parts[k]].clone());
        }
        let unit = self.asked.study.objective.ty.dimension.si_unit();
        table.column(&self.asked.study.objective.text, unit, |choice| choice.design.objective);
        let columns = self.catalogues().iter().flat_map(|one| &one.columns);
        for (i, column) in columns.enumerate() {
            let value = |choice: &Choice| column.unit.from_si(choice.design.values[i]);
            table.column(&column.name, &column.unit.text, value);
        }
        let feasible = |choice: &Choice| if choice.design.judged.keeps() { 1.0 } else { 0.0 };
        table.column("feasible", "-", feasible);
        for i in self.kept().all() {
            let margin = |choice: &Choice| choice.design.judged.margins[i];
            table.column(self.kept().text(i), self.kept().unit(i), margin);
        }
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        let all: Vec<&Design> = self.choices.judged.iter().map(|choice| &choice.design).collect();
        vec![figure::designs(self.asked, &all, self.best().map(|best| &best.design))]
    }

    fn more(&self) -> Report {
        about::about(self.asked.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let best = self.best();
        let shown = best.or_else(|| self.shown().first().copied());
        let worst = shown.map(|choice| self.worst(choice));
        let margin = shown
            .zip(worst)
            .map(|(choice, i)| SiValue::new(choice.design.judged.margins[i], &self.kept().unit(i)));
        self.asked.input.head(json, &[])?;
        json.member("values", &shown.map(|choice| self.values(choice)))?;
        json.member("margin", &margin)?;
        json.member("binding", &worst.map(|i| &self.kept().requirement(i).text))?;
        json.member("feasible", &best.is_some())?;
        json.member("over", self.asked.study.over.word())?;
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
