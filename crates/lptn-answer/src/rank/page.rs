//! A ranking as a page.

use std::io;

use lptn_network::{Item, list_of};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, duration, shortened, significant};
use lptn_solve::{Influence, Table};
use lptn_study::{Ranking, SiValue, effect, has_effect};
use serde_json::{Value, json};

use super::RankAnswer;
use crate::about::{self, Known};
use crate::words::{MOST_NODES, difference, some_of, spaced};

/// Letters of a name next to the other columns.
const NAME_WIDTH: usize = 30;

/// A feedback below this is not worth a sentence.
const WEAK: f64 = 1e-6;

impl RankAnswer {
    /// "steel, 71.9 degC in steady state".
    fn answering(&self) -> String {
        let temperature = significant(self.unit.from_si(self.ranking.temperature), 5);
        let when = match self.ranking.at {
            None => "in steady state".to_owned(),
            Some(at) => format!("at most, at {}", duration(at, 4)),
        };
        format!("{}: {temperature} {} {when}", self.node(), self.unit.text)
    }

    fn table(&self, heading: &str, influences: &[&Influence]) -> TextTable {
        let rows = &influences[..influences.len().min(MOST_NODES)];
        TextTable::of(rows)
            .left(heading, |i| shortened(&self.name(i), NAME_WIDTH))
            .right("value", |i| {
                let (value, unit) = self.value(i);
                format!("{}{}", significant(value, 5), spaced(&unit))
            })
            .left("changed by", |i| self.change(i))
            .right(
                format!("{} [{}]", shortened(self.node(), NAME_WIDTH), difference(&self.unit)),
                |i| signed(self.effect(i)),
            )
            .into()
    }

    /// Text on the distance of the network from thermal runaway.
    fn comes_back(&self) -> Option<String> {
        let network = &self.input.netlist.network;
        let feedback = self.ranking.feedback.as_ref().filter(|f| f.gain > WEAK)?;
        let source = network.sources()[feedback.source.index()].name();
        let node = &network.nodes()[feedback.node.index()].name;
        if feedback.gain >= 1.0 {
            let times = significant(feedback.gain, 3);
            return Some(format!(
                "heat of `{source}` comes back {times} times as `{node}` warms: this state is \
                 unstable"
            ));
        }
        let (share, steeper) =
            (significant(100.0 * feedback.gain, 3), significant(feedback.gain.recip(), 3));
        let tau = self.ranking.slowest.map(|rate| {
            format!("; disturbances decay with {} at the slowest", duration(rate.recip(), 3))
        });
        Some(format!(
            "{share} % of the heat comes back as more heat, most by `{source}`, which grows with \
             `{node}`: it would run away if losses grew {steeper} times as fast with \
             temperature{}",
            tau.unwrap_or_default()
        ))
    }

    fn notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = self.comes_back().into_iter().collect();
        if let Some(why) = &self.ranking.not_ranked {
            notes.push(format!("parameters are not ranked: {why}"));
        }
        notes.extend(self.without_effect());
        notes.extend(self.fixed());
        if let Some(why) = &self.ranking.differences {
            notes.push(format!("by differences of runs, since {why}"));
        }
        if self.ranking.at.is_some() {
            notes.push(
                "over a run parameters are ranked; write a value as a parameter to rank it too"
                    .to_owned(),
            );
        }
        notes
    }

    /// Parameters that are numbers and change nothing.
    fn without_effect(&self) -> Option<String> {
        let all = self.ranking.parameters.iter().chain(&self.ranking.zeros);
        let idle = all.filter(|influence| !has_effect(influence));
        let names: Vec<String> = idle.map(|influence| self.name(influence)).collect();
        (!names.is_empty())
            .then(|| format!("no effect on {}: {}", self.node(), list_of(&names, "parameters")))
    }

    /// Parameters that are not ranked, because a part of them cannot be added.
    fn fixed(&self) -> Option<String> {
        let network = &self.input.netlist.network;
        let names: Vec<String> = self
            .ranking
            .fixed
            .iter()
            .map(|(id, _)| network.name_of(Item::Parameter(*id)).into())
            .collect();
        (!names.is_empty()).then(|| {
            format!(
                "not ranked: {}, as no value next to theirs is allowed; compare others with --set",
                list_of(&names, "parameters")
            )
        })
    }

    fn verdict(&self) -> String {
        let own = |all: &'_ [Influence]| all.iter().find(|i| !i.absolute && has_effect(i)).copied();
        let first = own(&self.ranking.parameters);
        let element = own(&self.ranking.elements);
        let size = |i: &Influence| effect(i).abs();
        let most = match (first, element) {
            (Some(first), Some(element)) if size(&element) > size(&first) => Some(element),
            (first, element) => first.or(element),
        };
        match most {
            Some(most) => format!("change first: {}", self.said(&most)),
            None if self.ranking.zeros.iter().any(has_effect) => {
                format!("{} responds to no value that is not 0", self.node())
            }
            None => format!("{} responds to no value", self.node()),
        }
    }

    fn said(&self, influence: &Influence) -> String {
        let warmer = self.effect(influence);
        let (more, cooler) = if warmer > 0.0 { ("less", -warmer) } else { ("more", warmer) };
        let name = self.name(influence);
        let (by, unit) = (significant(-cooler, 3), difference(&self.unit));
        format!("10 % {more} of {name} makes {} {by} {unit} colder", self.node())
    }

    /// The values that change something: parameters, then values of elements; those of 0 are last.
    pub(super) fn effects(&self) -> [(&'static str, Vec<&Influence>); 2] {
        let Ranking { parameters, elements, zeros, .. } = &self.ranking;
        let (of_parameters, of_elements): (Vec<_>, Vec<_>) =
            zeros.iter().partition(|zero| is_parameter(zero));
        let [of_parameters, of_elements] = [(parameters, of_parameters), (elements, of_elements)]
            .map(|(all, zeros)| {
                all.iter().chain(zeros).filter(|i| has_effect(i)).collect::<Vec<_>>()
            });
        [("parameter", of_parameters), ("element", of_elements)]
    }

    fn all(&self) -> Vec<(&'static str, &Influence)> {
        let Ranking { parameters, elements, zeros, .. } = &self.ranking;
        let of = |own: bool| zeros.iter().filter(move |zero| is_parameter(zero) == own);
        let all = parameters.iter().chain(of(true)).chain(elements).chain(of(false));
        all.map(|i| (kind(i), i)).collect()
    }

    fn listed(&self) -> Table {
        let all = self.all();
        let mut table = Table::of(&all);
        table.label("name", |(_, i)| self.name(i));
        table.label("kind", |(kind, _)| (*kind).to_owned());
        table.label("unit", |(_, i)| self.value(i).1);
        table.label("changed_by", |(_, i)| self.change(i));
        table.column("value", "-", |(_, i)| self.value(i).0);
        table.column("effect", difference(&self.unit), |(_, i)| self.effect(i));
        table.done()
    }
}

impl Page for RankAnswer {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        text.line(self.answering());
        let how = "--format csv and json have all";
        for (heading, influences) in self.effects() {
            some_of(&mut text, self.table(heading, &influences), (influences.len(), how));
        }
        text.notes(self.notes());
        text.section().sentence("", &self.verdict());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.listed().into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        let known = Known { unit: Some(&self.unit), ..Known::default() };
        about::about(&self.input, known).answered(&self.verdict())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let ranking = &self.ranking;
        self.input.head(json, &self.doubts)?;
        json.member("node", self.node())?;
        json.member(
            "temperature",
            &json!({ "value": self.unit.from_si(ranking.temperature), "unit": self.unit.text }),
        )?;
        json.member("at", &ranking.at.map(|at| SiValue::new(at, "s")))?;
        json.table(&self.listed())?;
        let network = &self.input.netlist.network;
        let feedback: Option<Value> = ranking.feedback.as_ref().map(|feedback| {
            json!({
                "gain": SiValue::new(feedback.gain, "1"),
                "source": network.sources()[feedback.source.index()].name(),
                "node": network.nodes()[feedback.node.index()].name,
            })
        });
        json.member("feedback", &feedback)?;
        json.member("slowest_rate", &ranking.slowest.map(|rate| SiValue::new(rate, "1/s")))?;
        json.member("notes", &self.notes())
    }
}

fn is_parameter(influence: &Influence) -> bool {
    matches!(influence.of, Item::Parameter(_))
}

fn kind(influence: &Influence) -> &'static str {
    match influence.of {
        Item::Parameter(_) => "parameter",
        Item::Boundary(_) => "boundary",
        Item::Source(_) => "source",
        _ => "path",
    }
}

fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", significant(value, 3))
}
