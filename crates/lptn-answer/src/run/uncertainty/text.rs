//! Uncertain results for reading.

use lptn_network::{Item, Network};
use lptn_report::{Align, Column, Text, TextTable, WIDTH, decimals, duration, fixed, significant};
use lptn_study::uncertainty::{
    Answer, AnswerOf, Bent, Contribution, Discrepancy, Estimate, Uncertainty, UncertaintyMethod,
};
use lptn_units::Unit;

use super::Study;
use super::files::{parameter, unit_of};
use super::inputs;
use crate::families::{self, Row};
use crate::words::{MOST_NODES, count, difference, spaced};

/// Parameters that a ranking names.
const MOST_RANKED: usize = 12;

/// A parameter with less of the variance is not named.
const LEAST_SHARE: f64 = 0.0005;

/// Most results whose rankings are next to each other.
const MOST_RANKINGS: usize = 3;

/// A section with the bands, one with the limits and one with the ranking.
/// With `fold`, large families are their worst member.
pub(crate) fn sections(
    text: &mut Text,
    (network, fold): (&Network, bool),
    (study, unit): (&Study, &Unit),
) {
    let found = &study.found;
    text.section().sentence("uncertainty: ", &heading(found));
    for (label, words) in inputs::described(network, found) {
        text.sentence(label, &words);
    }
    temperatures(text.section(), (network, fold), (found, unit));
    margins(text.section(), (network, fold), (found, unit));
    ranking(text.section(), (network, unit), found);
}

fn heading(found: &Uncertainty) -> String {
    let parameters = inputs::counted(found);
    match &found.method {
        UncertaintyMethod::Linear { differences, .. } => {
            let exact =
                if differences.is_none() { "exact sensitivities" } else { "differences of runs" };
            format!("{parameters}, straight lines from {exact}")
        }
        UncertaintyMethod::Sobol { samples, seed, runs, .. } => {
            format!("{parameters}, {samples} Sobol points, seed {seed}, {runs} runs")
        }
    }
}

/// Answers by name, with `fold` each large family as its largest `worst`.
fn rows<'a>(
    answers: impl Iterator<Item = &'a Answer>,
    (network, fold): (&Network, bool),
    worst: impl Fn(&Answer) -> f64,
) -> Vec<Row<&'a Answer>> {
    let named = |answer: &&Answer| (name(network, answer.of), 0);
    families::folded(answers.collect(), fold, named, |answer| worst(answer))
}

fn temperatures(
    text: &mut Text,
    (network, fold): (&Network, bool),
    (found, unit): (&Uncertainty, &Unit),
) {
    let is = |of: fn(&AnswerOf) -> bool| found.answers.iter().filter(move |answer| of(&answer.of));
    let mut nodes = rows(is(|of| matches!(of, AnswerOf::End(_))), (network, fold), |a| a.value);
    let all = nodes.len();
    nodes.truncate(MOST_NODES);
    if nodes.is_empty() {
        return;
    }
    let ends: Vec<&Answer> = nodes.iter().map(|row| row.item).collect();
    // the same node has both numbers
    let peak_of = |end: &&Answer| match end.of {
        AnswerOf::End(id) => found.answers.iter().find(|other| other.of == AnswerOf::Max(id)),
        _ => None,
    };
    let peaks: Vec<&Answer> = ends.iter().filter_map(peak_of).collect();
    let widest = ends.iter().chain(&peaks).map(|answer| answer.deviation.value).fold(0.0, f64::max);
    let digits = decimals(widest / unit.scale, 3, 1);
    let names = nodes.iter().map(|row| row.name.clone()).collect();
    let mut columns = vec![Column::new(format!("T [{}]", unit.text), Align::Left, names)];
    if nodes.iter().any(|row| !row.member.is_empty()) {
        let members = nodes.iter().map(|row| row.member.clone()).collect();
        columns.push(Column::new("hottest", Align::Left, members));
    }
    let numbers = columns.len();
    let end = duration(found.times.last().copied().unwrap_or(0.0), 4);
    columns.extend(band(&ends, &end, (unit, digits)));
    let peak = band(&peaks, "peak", (unit, digits));
    // in a network that only warms, the peak is at the end
    let same = peak.iter().zip(&columns[numbers..]).all(|(peak, end)| peak.cells == end.cells);
    if !same {
        columns.extend(peak);
    }
    text.table(TextTable::new(columns));
    let more = all - nodes.len();
    if more > 0 {
        text.line(format!("not shown: {}, which uncertainty.csv has", count(more, "more node")));
    }
}

fn name(network: &Network, of: AnswerOf) -> String {
    match of {
        AnswerOf::End(id) | AnswerOf::Max(id) => network.name_of(Item::Node(id)).into_owned(),
        AnswerOf::Margin(id) => network.name_of(Item::Limit(id)).into_owned(),
    }
}

fn band(answers: &[&Answer], title: &str, (unit, digits): (&Unit, usize)) -> Vec<Column> {
    let column = |title: &str, text: &dyn Fn(&Answer) -> String| {
        Column::new(title, Align::Right, answers.iter().map(|answer| text(answer)).collect())
    };
    let shown = |kelvin: f64| fixed(unit.from_si(kelvin), digits);
    vec![
        column(title, &|a| shown(a.value)),
        column(&format!("sd [{}]", difference(unit)), &|a| {
            fixed(a.deviation.value / unit.scale, digits)
        }),
        column("2.5 %", &|a| shown(a.low.value)),
        column("97.5 %", &|a| shown(a.high.value)),
    ]
}

fn margins(
    text: &mut Text,
    (network, fold): (&Network, bool),
    (found, unit): (&Uncertainty, &Unit),
) {
    let margins = found.answers.iter().filter(|answer| matches!(answer.of, AnswerOf::Margin(_)));
    let margins = rows(margins, (network, fold), |answer| -answer.value);
    if margins.is_empty() {
        return;
    }
    let number = |answer: &Answer, value: f64| {
        let of = unit_of((network, unit), answer.of);
        let digits = decimals(of.from_si(answer.deviation.value), 3, 1);
        format!("{} {}", fixed(of.from_si(value), digits), of.text)
    };
    let table = TextTable::of(&margins).left("limit", |row| row.name.as_str());
    let table = families::members(table, &margins, "worst")
        .right("margin", |row| number(row.item, row.item.value))
        .right("sd", |row| number(row.item, row.item.deviation.value))
        .right("2.5 %", |row| number(row.item, row.item.low.value))
        .right("97.5 %", |row| number(row.item, row.item.high.value))
        .right("P(broken)", |row| probability(row.item.below_zero, sampled(found)));
    text.table(table);
}

/// Number of samples with a result; 0 if nothing is sampled.
fn sampled(found: &Uncertainty) -> usize {
    match &found.method {
        UncertaintyMethod::Linear { .. } => 0,
        UncertaintyMethod::Sobol { samples, lost, .. } => {
            samples.saturating_sub(lost.iter().map(|lost| lost.count).sum::<usize>())
        }
    }
}

/// A probability in percent, with its standard error if it was sampled.
/// For none or all of the samples it is the 95 % bound (1 - 0.05^(1/n), the rule of three: J. A.
/// Hanley, A. Lippman-Hand, JAMA 249 (1983) 1743).
fn probability(of: Estimate, samples: usize) -> String {
    let percent = |share: f64| fixed(100.0 * share, if share >= 0.1 { 0 } else { 1 });
    if of.error.is_some() && samples > 0 && (of.value <= 0.0 || of.value >= 1.0) {
        let bound = 100.0 * (1.0 - 0.05_f64.powf(1.0 / samples as f64));
        // a bound is rounded up
        let digits = decimals(bound, 1, 1);
        let step = 0.1_f64.powi(i32::try_from(digits).unwrap_or(1));
        let bound = (bound / step).ceil() * step;
        return match of.value <= 0.0 {
            true => format!("< {} %", fixed(bound, digits)),
            false => format!("> {} %", fixed(100.0 - bound, digits)),
        };
    }
    match of.error {
        Some(error) => format!("{} ± {} %", percent(of.value), significant(100.0 * error, 2)),
        // the far end of a distribution is not known
        None if of.value > 0.0 && of.value < 1e-5 => "< 0.001 %".into(),
        None if of.value > 0.0 && of.value < 5e-4 => {
            format!("{} %", significant(100.0 * of.value, 2))
        }
        None => format!("{} %", percent(of.value)),
    }
}

/// The ranking for the ends of as many nodes as fit.
/// If no temperature is requested, it is for the margins.
fn ranking(text: &mut Text, network: (&Network, &Unit), found: &Uncertainty) {
    let ends: Vec<&Answer> =
        found.answers.iter().filter(|answer| matches!(answer.of, AnswerOf::End(_))).collect();
    let all = if ends.is_empty() { found.answers.iter().collect() } else { ends };
    let varied: Vec<&Answer> =
        all.into_iter().filter(|answer| answer.deviation.value > 0.0).collect();
    let most = varied.len().min(MOST_RANKINGS);
    let tables =
        (1..=most).rev().map(|count| (count, side_by_side(network, found, &varied[..count])));
    let fits =
        |(count, (table, _)): &(usize, (TextTable, _))| *count == 1 || table.width() <= WIDTH;
    let Some((shown, (table, others))) = tables.into_iter().find(fits) else { return };
    text.table(table).lines(others);
    let more = varied.len() - shown;
    if more > 0 {
        let results = if more == 1 { "result" } else { "results" };
        text.line(format!(
            "not shown: the rankings of {more} more {results}, which ranking.csv has"
        ));
    }
}

fn side_by_side(
    (network, unit): (&Network, &Unit),
    found: &Uncertainty,
    answers: &[&Answer],
) -> (TextTable, Option<String>) {
    let part = |answer: &Answer, input: usize| -> Option<Contribution> {
        answer.ranking.iter().copied().find(|part| part.input == input)
    };
    let weight = |input: &usize| {
        let weights = answers
            .iter()
            .filter_map(|answer| part(answer, *input))
            .map(|part| part.weight().abs());
        weights.fold(0.0, f64::max)
    };
    let mut inputs: Vec<usize> = (0..found.inputs.len()).collect();
    inputs.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    let named =
        inputs.iter().take_while(|input| weight(input) >= LEAST_SHARE).take(MOST_RANKED).count();
    let (shown, others) = inputs.split_at(named);
    let mut table = TextTable::of(shown)
        .left("parameter", |input| parameter(network, found, *input))
        .right("±", |input| inputs::deviation(network, found, *input));
    for answer in answers {
        let own = unit_of((network, unit), answer.of);
        let digits = decimals(own.from_si(answer.deviation.value), 3, 1);
        let of = |input: usize, text: &dyn Fn(Contribution) -> String| {
            part(answer, input).map_or("-".into(), text)
        };
        let title = format!("{} [{}]", name(network, answer.of), own.text);
        let linear = matches!(found.method, UncertaintyMethod::Linear { .. })
            || found.inputs.are_correlated();
        table = table
            .right(title, |i| of(*i, &|part| signed(own.from_si(part.effect), digits)))
            .right(if linear { "share" } else { "alone" }, |i| {
                of(*i, &|part| percent(part.share.value))
            });
        if !linear {
            let total =
                |part: Contribution| part.total.map_or("-".into(), |total| percent(total.value));
            table = table.right("in all", |i| of(*i, &total));
        }
    }
    (table.into(), left_out(found, answers, others))
}

/// Share of the variance of the parameters that are not named.
fn left_out(found: &Uncertainty, answers: &[&Answer], others: &[usize]) -> Option<String> {
    if others.is_empty() {
        return None;
    }
    let sum = |answer: &&Answer| -> f64 {
        let parts = answer.ranking.iter().filter(|part| others.contains(&part.input));
        parts.map(|part| part.weight().abs()).sum()
    };
    let most = answers.iter().map(sum).fold(0.0, f64::max);
    let which = if others.len() == found.inputs.len() { "all" } else { "the other" };
    Some(format!("{which} {}: {} together", others.len(), percent(most)))
}

fn signed(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    if value > 0.0 && text.chars().any(|c| c.is_ascii_digit() && c != '0') {
        format!("+{text}")
    } else {
        text
    }
}

fn percent(share: f64) -> String {
    format!("{} %", fixed(100.0 * share, 1))
}

/// Relative standard deviation from which a straight line is doubted.
const WIDE: f64 = 0.35;

/// Parameters that may be far from their value, or of the other sign.
fn wide<'a>(network: &'a Network, found: &'a Uncertainty) -> impl Iterator<Item = String> + 'a {
    let inputs = found.inputs.iter().filter(|input| {
        let parameter = &network.parameters()[input.parameter.index()];
        !parameter.ty.absolute
            && input.deviation() >= WIDE * input.value.abs()
            && input.value.abs() > 0.0
    });
    inputs.map(|input| {
        let name = &network.parameters()[input.parameter.index()].name;
        let part = fixed(100.0 * input.deviation() / input.value.abs(), 0);
        format!(
            "`{name}` is known to {part} % only: bands of straight lines are rough, see \
             --uncertainty sobol"
        )
    })
}

/// Results that straight lines get wrong: the worst, and how many others.
pub(crate) fn bends((network, unit): (&Network, &Unit), bent: &[Bent]) -> Option<String> {
    let worst = bent.iter().max_by(|a, b| {
        let ratio = |of: &Bent| (of.found - of.linear) / of.found;
        ratio(a).total_cmp(&ratio(b))
    })?;
    let of = unit_of((network, unit), worst.of);
    let [found, linear] = [worst.found, worst.linear].map(|by| significant(of.from_si(by), 2));
    let unit = spaced(&of.text);
    let others = match bent.len() - 1 {
        0 => String::new(),
        1 => " (and one other result)".into(),
        count => format!(" (and {count} other results)"),
    };
    let of = match worst.of {
        AnswerOf::End(_) => "the end of",
        AnswerOf::Max(_) => "the peak of",
        AnswerOf::Margin(_) => "the margin of",
    };
    Some(format!(
        "straight lines are wrong for {of} `{}`{others}: it changes by up to {found}{unit} within \
         95 % of the parameters, not by {linear}{unit}; use --uncertainty sobol",
        name(network, worst.of)
    ))
}

/// Notes on everything that the tables leave out.
pub(crate) fn notes(network: &Network, study: &Study, unit: &Unit) -> Vec<String> {
    let found = &study.found;
    let lost = match &found.method {
        UncertaintyMethod::Linear { differences, bent } => {
            let note = |why: &String| {
                format!(
                    "no exact sensitivities, they are differences of runs: {why}; the further a \
                     parameter moves, the less accurate a straight line is: use --uncertainty \
                     sobol"
                )
            };
            let more =
                inputs::shares(found).into_iter().chain(inputs::far_from_normal(network, found));
            let rough = bends((network, unit), bent).into_iter().chain(wide(network, found));
            return differences.iter().map(note).chain(rough).chain(more).collect();
        }
        UncertaintyMethod::Sobol { lost, .. } => lost,
    };
    let parts = found.answers.iter().flat_map(|answer| &answer.ranking);
    let errors =
        parts.flat_map(|part| [part.share.error, part.total.and_then(|total| total.error)]);
    let worst = percent(errors.flatten().fold(0.0, f64::max));
    let mut notes =
        vec![format!("shares have standard errors of up to {worst}; more --samples, smaller ones")];
    notes.extend(inputs::shares(found));
    notes.extend(lost.iter().map(|lost| {
        let cut = if lost.refused {
            "the distribution ends there"
        } else {
            "the bands are those of the others"
        };
        format!("{lost}: {cut}")
    }));
    match &study.linear {
        Some(Ok(differ)) if differ.is_empty() => {
            notes.push("the linear bands are the same within a tenth".into());
        }
        Some(Ok(differ)) => notes.extend(differ.iter().map(|one| differs(network, one, unit))),
        Some(Err(why)) => notes.push(format!("there are no linear bands to compare with: {why}")),
        None => {}
    }
    notes
}

/// "steel.T at 25 min is not linear: 59.4 to 105.6 degC by straight lines, 60 to 104.9 degC
/// sampled".
fn differs(network: &Network, one: &Discrepancy, unit: &Unit) -> String {
    let what = match (one.of, one.time) {
        (AnswerOf::End(_), Some(time)) => {
            format!("{}.T at {}", name(network, one.of), duration(time, 4))
        }
        (of, _) => of.name(network),
    };
    let by = unit_of((network, unit), one.of);
    let digits = decimals(by.from_si(0.5 * (one.sampled.1 - one.sampled.0)), 3, 1);
    let shown = if matches!(one.of, AnswerOf::Margin(_)) { &by } else { unit };
    let band = |(low, high): (f64, f64)| {
        let [low, high] = [low, high].map(|si| fixed(shown.from_si(si), digits));
        format!("{low} to {high} {}", shown.text)
    };
    format!(
        "{what} is not linear: {} by straight lines, {} sampled",
        band(one.linear),
        band(one.sampled)
    )
}
