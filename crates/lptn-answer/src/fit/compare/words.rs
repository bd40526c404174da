//! Sentences of a comparison of fits.

use lptn_fit::choice::{Behind, Held, MARGIN, UnseenRecord};
use lptn_netlist::Diagnostic;
use lptn_report::{duration, fixed, significant};

use super::FitCompareAnswer;
use super::shown::{interval, ratio};
use crate::words::count;

/// Largest difference between two equal runs, in K (or another SI unit).
const SAME: f64 = 1e-5;

/// "each of the 5 records in its turn".
pub(super) fn unseen(answer: &FitCompareAnswer) -> String {
    let of_sensors = answer
        .choice
        .contenders
        .iter()
        .any(|one| one.task.unknowns().iter().any(|unknown| unknown.run().is_some()));
    let offsets = if of_sensors {
        "; an offset that a sensor has in that record alone takes its prior value"
    } else {
        ""
    };
    match answer.choice.held {
        Held::EachRecord => format!(
            "each of the {} in turn is predicted by a fit to the others{offsets}",
            count(records(answer), "record")
        ),
        Held::LastThird { from } => format!(
            "the last third of the record, after {}, is predicted by a fit to the part before",
            duration(from, 3)
        ),
    }
}

pub(super) fn records(answer: &FitCompareAnswer) -> usize {
    answer.choice.contenders.first().map_or(0, |one| one.task.runs.len())
}

/// Ratio of held-out errors, "2.05 times (1.86 to 2.26)".
fn times(behind: &Behind) -> String {
    let within =
        behind.interval.map_or(String::new(), |ends| format!(" (95 % {})", interval(ends)));
    format!("{} times{within}", ratio(behind.ratio, behind.interval))
}

/// The last line: the candidate that the records favour.
pub(super) fn verdict(answer: &FitCompareAnswer) -> String {
    let rivals = answer.choice.rivals();
    match rivals.is_empty() {
        true => told(answer),
        false => open(answer, &rivals),
    }
}

fn told(answer: &FitCompareAnswer) -> String {
    let best = answer.choice.best;
    let next = answer.order().get(1).copied().unwrap_or(best);
    let (name, rms) = (answer.name(best), significant(answer.judged(best).unseen_rms(), 2));
    let behind = answer.judged(next).behind.as_ref().map_or(String::new(), times);
    let text = format!(
        "the data favour `{name}`: it predicts held-out data to {rms} {} rms; the error of `{}` is \
         {behind} as large",
        answer.unit(),
        answer.name(next)
    );
    match answer.choice.held {
        Held::EachRecord => text,
        Held::LastThird { .. } => text + "; this is one record, and another may disagree",
    }
}

fn open(answer: &FitCompareAnswer, rivals: &[usize]) -> String {
    let (best, simplest) = (answer.choice.best, answer.choice.simplest());
    let names: Vec<String> = rivals.iter().map(|&i| answer.name(i).to_owned()).collect();
    let mut text = format!(
        "the records cannot distinguish {} from `{}`{}",
        lptn_network::list_of(&names, "candidates"),
        answer.name(best),
        why(answer, rivals[0])
    );
    if answer.judged(simplest).likely.unknowns < most(answer, rivals) {
        text += &format!("; `{}` needs the fewest numbers", answer.name(simplest));
    }
    text + &what_would(answer, rivals[0])
}

/// Largest number of unknowns of the best candidate and its rivals.
fn most(answer: &FitCompareAnswer, rivals: &[usize]) -> usize {
    let all = rivals.iter().chain([&answer.choice.best]);
    all.map(|&i| answer.judged(i).likely.unknowns).max().unwrap_or(0)
}

/// Reason why a rival cannot be distinguished from the best.
fn why(answer: &FitCompareAnswer, rival: usize) -> String {
    let (judged, best) = (answer.judged(rival), answer.judged(answer.choice.best));
    let Some(behind) = &judged.behind else { return String::new() };
    let missed = format!("the held-out error of `{}` is {}", answer.name(rival), times(behind));
    match (behind.interval, judged.likely.aicc, best.likely.aicc) {
        (Some(_), _, _) => format!(": {missed} as large"),
        (None, Some(own), Some(least)) => format!(
            ": {missed} as large, and its AICc is {} {}; with one record, rejection needs a larger \
             error and an AICc higher by {MARGIN}",
            fixed((own - least).abs(), 1),
            if own < least { "lower" } else { "higher" }
        ),
        (None, _, _) => format!(": {missed} as large, and there are too few values for AICc"),
    }
}

/// Text on data that would distinguish the two.
fn what_would(answer: &FitCompareAnswer, rival: usize) -> String {
    let judged = answer.judged(rival);
    let mut text = String::new();
    if let Some(apart) = judged.apart {
        if apart.by < SAME {
            return ". They compute the same, so no record can distinguish them".to_owned();
        }
        let run = &judged.task.runs[apart.run];
        text += &format!(
            ". They differ most by {} {}, in {} at {} of {}",
            significant(apart.by, 2),
            run.columns[apart.column].ty.dimension.si_unit(),
            run.columns[apart.column].name,
            duration(apart.time, 3),
            run.name
        );
    }
    if let Some(records) = judged.behind.and_then(|behind| behind.records) {
        text += &format!("; about {records} records like these would distinguish them");
    }
    text + ". `lptn plan` finds a more informative run"
}

/// Doubts in a candidate's fit and in its held-out predictions.
pub(super) fn doubts(answer: &FitCompareAnswer, i: usize) -> Vec<Diagnostic> {
    let (one, judged) = (&answer.candidates[i], answer.judged(i));
    let within = |is: &dyn Fn(&UnseenRecord) -> bool| {
        let found = judged.unseen.iter().filter(|part| is(part));
        let name = |part: &UnseenRecord| judged.task.runs[part.run].name.clone();
        let records: Vec<String> = found.map(name).collect();
        (!records.is_empty()).then(|| match answer.choice.held {
            Held::EachRecord => lptn_network::list_of(&records, "records"),
            Held::LastThird { .. } => "the last third".to_owned(),
        })
    };
    let mut doubts = Vec::new();
    if let Some(stop) = &judged.fit.not_converged {
        let message = format!("{}: the fit did not converge: {}", one.name, stop.text());
        let doubt = Diagnostic::warning("fit::not_converged", message);
        doubts.push(
            doubt.help("it is not used: give start values nearer to the expected ones, and bounds"),
        );
    }
    if let Some(records) = within(&|part| !part.converged) {
        let message = format!("{}: the fit without {records} found no minimum", one.name);
        let doubt = Diagnostic::warning("fit::unseen_search", message);
        doubts.push(doubt.help("its predictions use the best values that were tried"));
    }
    if let Some(records) = within(&|part| !part.whole).filter(|_| answer.fits[i].is_whole()) {
        let message =
            format!("{}: without {records} the rest does not determine every value", one.name);
        let doubt = Diagnostic::warning("fit::unseen_open", message);
        doubts.push(doubt.help(
            "its predictions then depend on the start of the search: add records, or give the \
             varied parameters a `±`",
        ));
    }
    doubts.into_iter().map(|doubt| doubt.at(one.study.span.clone(), "")).collect()
}

/// Note on a candidate that fits better but predicts worse.
pub(super) fn likelier(answer: &FitCompareAnswer) -> Option<String> {
    let other = answer.choice.likeliest_instead()?;
    let below = answer.above(answer.choice.best)?;
    let (name, below) = (answer.name(other), fixed(below, 1));
    Some(match answer.choice.held {
        Held::EachRecord => format!(
            "`{name}` fits the records better (AICc {below} lower) but predicts held-out ones \
             worse: it follows effects that do not repeat"
        ),
        Held::LastThird { .. } => format!(
            "`{name}` fits the whole record better (AICc {below} lower) but predicts its last \
             third worse: the two contradict each other"
        ),
    })
}
