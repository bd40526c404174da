//! A sized parameter as a page, and words that all pages of sizes share.

use std::io;

use lptn_netlist::{Goal, Netlist, Over, Requirement, SizeStudy};
use lptn_network::Item;
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, duration, plain, significant};
use lptn_solve::Table;
use lptn_study::{SiValue, Verdict};
use lptn_units::Unit;
use serde_json::json;

use super::Asked;
use super::kept::Kept;
use super::single::Sized;
use crate::about::{self, Known};
use crate::input;
use crate::ranges;
use crate::words::{spaced, unverified};

/// Digits of a value that is shown.
const DIGITS: usize = 6;

/// Digits of an edge, which is next to a value near to it.
const EDGE_DIGITS: usize = 8;

impl Page for Sized {
    fn text(&self) -> Text {
        let Asked { input, study, kept } = &self.asked;
        let (range, goal) = (self.range, goal(study.goal));
        let unit = &self.unit;
        let number = |si: f64| significant(unit.from_si(si), DIGITS);
        let objective = format!(
            "size {}: the {goal} {} from {} to {}{}",
            study.name,
            self.name,
            number(range.0),
            number(range.1),
            spaced(&unit.text)
        );
        let mut text = Text::titled(input.title());
        text.sentence("", &objective);
        when(&mut text, &input.netlist, (study, kept));
        text.section().table(requirements(self));
        text.conclude(13, notes(self), &verdict(self));
        text
    }

    /// One row: the value in its unit, the margin of every requirement in SI units.
    fn rows(&self) -> Rows<'_> {
        let mut table = Table::of(&[()]);
        let value = self.unit.from_si(self.sizing.trial.value);
        table.column(&self.name, &self.unit.text, |()| value);
        table.column("feasible", "-", |()| if self.sizing.feasible() { 1.0 } else { 0.0 });
        for (i, &margin) in self.sizing.trial.judged.margins.iter().enumerate() {
            table.column(self.asked.kept.text(i), self.asked.kept.unit(i), |()| margin);
        }
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        about::about(&self.asked.input, Known::default()).answered(&verdict(self))
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (network, sizing) = (&self.asked.input.netlist.network, &self.sizing);
        let si = network.parameters()[self.parameter.index()].ty.dimension.si_unit();
        let requirements = self.asked.kept.members(&sizing.trial.judged);
        let scalar = |value: f64| SiValue::new(value, &si);
        let of_margin = |value: f64| SiValue::new(value, &self.closest_unit());
        self.asked.input.head(json, &self.asked.kept.doubts())?;
        json.member("values", &json!({ (self.name.as_str()): scalar(sizing.trial.value) }))?;
        json.member("margin", &of_margin(sizing.margin()))?;
        json.member("binding", &self.binding().map(|requirement| &requirement.text))?;
        json.member("feasible", &sizing.feasible())?;
        json.member("requirements", &requirements)?;
        json.member("over", self.asked.study.over.word())?;
        json.optional("proven", self.asked.kept.proof_members())?;
        if let Some(edge) = &sizing.edge {
            let beyond = SiValue::new(edge.beyond, &self.asked.kept.unit(edge.broken));
            json.member("edge", &json!({ "value": scalar(edge.value), "beyond": beyond }))?;
        }
        json.member("error", &sizing.error.map(scalar))?;
        json.member("sensitivity", &sizing.sensitivity.map(of_margin))?;
        json.member("breaks_again", &sizing.breaks_again.map(scalar))?;
        json.member("first_guess", &sizing.first_guess.map(scalar))?;
        json.optional(
            "out_of_range",
            ranges::members(network, &sizing.trial.judged.out_of_range, false),
        )
    }

    fn no(&self) -> Option<String> {
        (!self.sizing.feasible()).then(|| verdict(self))
    }
}

/// Text on the moments and the load cases in which requirements must be kept.
pub(super) fn when(text: &mut Text, netlist: &Netlist, (study, kept): (&SizeStudy, &Kept)) {
    if let Some(over) = over(netlist, study) {
        text.sentence("", &over);
    }
    if let Some(probability) = study.probability(&netlist.network).ok().flatten() {
        let percent = significant(100.0 * probability, 6);
        text.sentence("", &format!("each with a probability of {percent} %"));
    }
    match kept.cases() {
        [] => {}
        [one] => {
            text.sentence("", &format!("in case {}", plain(one)));
        }
        several => {
            let names: Vec<String> = several.iter().map(|name| plain(name)).collect();
            text.sentence("", &format!("in each of the cases {}", names.join(", ")));
        }
    }
}

fn over(netlist: &Netlist, study: &SizeStudy) -> Option<String> {
    let lasts = match study.over {
        Over::Steady => return None,
        Over::Run => netlist.run.as_ref().map(|run| run.stop - run.start),
        Over::Periodic => {
            let given = study.period(&netlist.network).ok().flatten();
            given.or_else(|| netlist.network.repeat_period().ok().flatten())
        }
    };
    let what = if study.over == Over::Run { "run" } else { "periodic steady state" };
    let lasts = lasts.map_or(String::new(), |lasts| format!(" of {}", duration(lasts, 6)));
    let numbers = study.requirements.iter().all(Requirement::is_over_time);
    let when = if numbers { "over" } else { "at every moment of" };
    Some(format!("{when} the {what}{lasts}"))
}

/// Noun for the solutions of a network, in the plural.
pub(super) fn solved(over: Over) -> &'static str {
    match over {
        Over::Steady => "steady states",
        Over::Run => "runs",
        Over::Periodic => "periodic steady states",
    }
}

pub(super) fn goal(goal: Goal) -> &'static str {
    match goal {
        Goal::Minimise => "least",
        Goal::Maximise => "largest",
    }
}

/// The objective as text.
pub(super) fn objective(asked: &Asked, si: f64) -> String {
    let ty = asked.study.objective.ty;
    let degrees = input::temperature_unit(None, &asked.input.netlist).ok().filter(|_| ty.absolute);
    match degrees {
        Some(unit) => format!("{}{}", significant(unit.from_si(si), DIGITS), spaced(&unit.text)),
        None => format!("{}{}", significant(si, DIGITS), spaced(&ty.dimension.si_unit())),
    }
}

/// "G_fan = 3.41 W/K".
pub(super) fn quantity(name: &str, si: f64, unit: &Unit) -> String {
    format!("{name} = {}{}", significant(unit.from_si(si), DIGITS), spaced(&unit.text))
}

/// The value, rounded so that the shown number keeps the requirements.
fn value(answer: &Sized) -> String {
    let value = answer.unit.from_si(answer.sizing.trial.value);
    let shown = if matches!(answer.sizing.verdict, Verdict::Bound | Verdict::Edge) {
        significant(rounded(value, DIGITS, answer.asked.study.goal == Goal::Minimise), DIGITS)
    } else {
        significant(value, DIGITS)
    };
    format!("{} = {shown}{}", answer.name, spaced(&answer.unit.text))
}

/// `value` with this number of digits, rounded up or down.
pub(super) fn rounded(value: f64, digits: usize, up: bool) -> f64 {
    let text = |x: f64| format!("{x:.*e}", digits.saturating_sub(1));
    let read = |text: &str| text.parse::<f64>().unwrap_or(value);
    let near = text(value);
    let nearest = read(&near);
    if (up && nearest >= value) || (!up && nearest <= value) {
        return nearest;
    }
    let exponent: i32 = near.split('e').nth(1).and_then(|e| e.parse().ok()).unwrap_or(0);
    let places = i32::try_from(digits).unwrap_or(1) - 1;
    let step = read(&format!("1e{}", exponent - places));
    read(&text(if up { nearest + step } else { nearest - step }))
}

fn requirements(answer: &Sized) -> TextTable {
    let Asked { study, kept, .. } = &answer.asked;
    let sizing = &answer.sizing;
    let binds = |i: usize| matches!(sizing.verdict, Verdict::Bound) && i == sizing.closest;
    kept.table((&sizing.trial.judged, study.over != Over::Steady), binds)
}

/// Notes on everything that the table leaves out, each with its label.
fn notes(answer: &Sized) -> Vec<(&'static str, String)> {
    let (study, sizing) = (&answer.asked.study, &answer.sizing);
    let name = answer.name.as_str();
    let unit = answer.asked.kept.unit(sizing.closest);
    let mut notes = Vec::new();
    if let Some(sensitivity) = sizing.sensitivity {
        let change = significant(sensitivity, 3);
        notes.push(("sensitivity", format!("{change} {unit} of margin for 1 % more {name}")));
    }
    notes.extend(answer.asked.kept.doubt(&sizing.trial.judged).map(|doubt| ("scatter", doubt)));
    notes.extend(edge(answer).map(|edge| ("edge", edge)));
    notes.extend(answer.asked.kept.notes().into_iter().map(|note| ("note", note)));
    if let Some(guess) = sizing.first_guess {
        notes.push((
            "first guess",
            format!("{} (Norton equivalent)", quantity(name, guess, &answer.unit)),
        ));
    }
    notes.extend(unverified(&answer.asked.input.netlist.network).map(|unsure| ("note", unsure)));
    let outside =
        ranges::warnings(&answer.asked.input.netlist, &sizing.trial.judged.out_of_range, false);
    notes.extend(outside.into_iter().map(|warning| ("note", warning.message)));
    if let Some(error) = sizing.error {
        let error = format!("{:.0e}{}", error / answer.unit.scale.abs(), spaced(&answer.unit.text));
        notes.push(("error", format!("{name} is known to {error}")));
    }
    let solved = solved(study.over);
    notes.push(("proof", format!("{} {solved} of the full network", sizing.solved)));
    if let Some(value) = sizing.breaks_again {
        let least = study.goal == Goal::Minimise;
        let [way, side] = if least { ["more", "above"] } else { ["less", "below"] };
        let value = quantity(name, value, &answer.unit);
        notes.push((
            "note",
            format!("{way} is not always better: {side} {value} a requirement breaks again"),
        ));
    }
    notes
}

/// Text on the edge beyond which another steady state is reached, and the requirement that breaks.
fn edge(answer: &Sized) -> Option<String> {
    let edge = answer.sizing.edge.as_ref()?;
    let value = significant(answer.unit.from_si(edge.value), EDGE_DIGITS);
    let at = format!("{} = {value}{}", answer.name, spaced(&answer.unit.text));
    let unit = answer.asked.kept.unit(edge.broken);
    let off = significant(-edge.beyond, 4);
    let broken = format!("breaks `{}` by {off} {unit}", answer.asked.kept.text(edge.broken));
    let unit = input::temperature_unit(None, &answer.asked.input.netlist).ok();
    let Some(((node, [here, there]), unit)) = edge.states.zip(unit) else {
        return Some(format!("beyond {at} the network reaches another state, which {broken}"));
    };
    let name = answer.asked.input.netlist.network.name_of(Item::Node(node));
    let at_once = |kelvin: f64| format!("{} {}", significant(unit.from_si(kelvin), 4), unit.text);
    Some(format!(
        "several steady states: up to {at} the network reaches the one with `{name}` at {}, beyond \
         it one at {}, which {broken}",
        at_once(here),
        at_once(there)
    ))
}

/// One sentence with the answer.
pub(super) fn verdict(answer: &Sized) -> String {
    let (study, sizing) = (&answer.asked.study, &answer.sizing);
    match sizing.verdict {
        Verdict::Bound => format!("{} keeps every requirement", value(answer)),
        Verdict::Edge => {
            format!(
                "{} keeps every requirement; the edge is further away than the error of runs",
                value(answer)
            )
        }
        Verdict::BestEnd => {
            let all =
                if sizing.breaks_again.is_none() { " and so does the whole range" } else { "" };
            format!(
                "{}, the {} of the range, keeps every requirement{all}",
                value(answer),
                goal(study.goal)
            )
        }
        Verdict::Infeasible => {
            let off = significant(-sizing.margin(), 4);
            let at = quantity(&answer.name, sizing.trial.value, &answer.unit);
            let unit = answer.asked.kept.unit(sizing.closest);
            let end = end(answer).map_or(String::new(), |end| format!(", the {end} of the range"));
            let text = answer.asked.kept.text(sizing.closest);
            format!("infeasible: at best, with {at}{end}, `{text}` is broken by {off} {unit}")
        }
    }
}

/// The end of the range at which the value is.
fn end(answer: &Sized) -> Option<&'static str> {
    let (from, to) = answer.range;
    let value = answer.sizing.trial.value;
    // in a range over decades only values of its size are near the least end
    let size = |end: f64| if end == 0.0 { to - from } else { end.abs().min(to - from) };
    let near = |end: f64| (value - end).abs() <= 1e-6 * size(end);
    match (near(from), near(to)) {
        (true, _) => Some("least"),
        (_, true) => Some("largest"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn rounding_goes_the_asked_way() {
        let same = |a: f64, b: f64| assert_eq!(a.to_bits(), b.to_bits(), "{a} {b}");
        same(rounded(3.412_341, 4, true), 3.413);
        same(rounded(3.412_341, 4, false), 3.412);
        same(rounded(9.999_91, 4, true), 10.0);
        same(rounded(-3.412_341, 4, true), -3.412);
        same(rounded(0.000_341_29, 3, false), 0.000_341);
        same(rounded(0.5, 6, true), 0.5);
    }
}
