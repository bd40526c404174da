//! The table of laws, for reading.

use lptn_report::{Align, Column, TextTable, WIDTH, decimals, fixed, plain, significant};
use lptn_study::fit::law::{Candidate, Consistency, Exponent, Fitted, Law, LawStudy};

use super::Answer;
use super::laws::{block, sentence, verdict};
use super::shown::with_error;
use crate::console::Console;

pub(crate) fn text(answer: &Answer, console: &Console) -> String {
    let (data, study) = (&answer.data, &answer.study);
    let weights =
        if data.points.deviation().is_some() { "weighted by their standard errors" } else { "unweighted" };
    let range = data.unit.range(ends(data.points.speed()));
    let title = format!("{} over {}", plain(&data.power_name), plain(&data.points.variables()[0].name));
    let count = data.points.len();
    let mut lines =
        vec![console.title(&title), format!("{count} points at {range}, {weights}"), String::new()];
    lines.extend(laws(answer));
    lines.push(String::new());
    lines.extend(notes(study));
    lines.extend(correlation(study));
    lines.push(String::new());
    lines.extend(sentence("", &[study.verdict()]));
    if let Some(found) = &answer.consistency {
        lines.push(String::new());
        lines.push(console.title("Do dT, t_RC and P agree?"));
        lines.push(String::new());
        lines.extend(claims(found));
        lines.push(String::new());
        if found.derived {
            lines.extend(sentence("", &[verdict(found, &data.unit)]));
        } else {
            lines.extend(block(found, &data.unit));
        }
    }
    lines.join("\n") + "\n"
}

pub(crate) fn ends(speeds: &[f64]) -> (f64, f64) {
    let of = |pick: fn(f64, f64) -> f64| speeds.iter().copied().reduce(pick).unwrap_or(f64::NAN);
    (of(f64::min), of(f64::max))
}

/// One line of the table.
struct Line {
    law: String,
    coefficient: String,
    numbers: [String; 4],
}

fn laws(answer: &Answer) -> Vec<String> {
    let lines: Vec<Line> = answer.study.candidates.iter().flat_map(|c| lines(answer, c)).collect();
    let number = |title: &str, i: usize| {
        Column::new(title, Align::Right, lines.iter().map(|line| line.numbers[i].clone()).collect())
    };
    let mut columns = vec![
        Column::new("law", Align::Left, lines.iter().map(|line| line.law.clone()).collect()),
        Column::new("coefficients", Align::Left, lines.iter().map(|line| line.coefficient.clone()).collect()),
        number("rmse [W]", 0),
        number("left out", 1),
    ];
    if answer.data.points.deviation().is_some() {
        columns.push(number("chi^2", 2).optional());
    }
    columns.push(number("AICc", 3));
    TextTable::new(columns).lines(WIDTH)
}

/// The lines of a law: one for each coefficient.
fn lines(answer: &Answer, candidate: &Candidate) -> Vec<Line> {
    let Some(fit) = candidate.fitted() else {
        let remark = candidate.remark().unwrap_or_default();
        let law = plain(&candidate.law.to_string());
        return vec![Line { law, coefficient: remark, numbers: [const { String::new() }; 4] }];
    };
    let laws = names(&candidate.law, fit.coefficients.len());
    let numbers = numbers(&answer.study, candidate, fit);
    let line = |(i, law): (usize, String)| Line {
        law,
        coefficient: coefficient(answer, candidate, fit, i),
        numbers: if i == 0 { numbers.clone() } else { [const { String::new() }; 4] },
    };
    laws.into_iter().enumerate().map(line).collect()
}

/// The terms of a sum below each other; another law on the first line.
fn names(law: &Law, count: usize) -> Vec<String> {
    let text = plain(&law.to_string());
    match law {
        Law::Powers(_) => {
            let terms = text.split(" + ").enumerate();
            terms.map(|(i, term)| if i == 0 { term.to_owned() } else { format!("+ {term}") }).collect()
        }
        _ => (0..count).map(|i| if i == 0 { text.clone() } else { String::new() }).collect(),
    }
}

fn coefficient(answer: &Answer, candidate: &Candidate, fit: &Fitted, i: usize) -> String {
    let c = &fit.coefficients[i];
    let unit = &answer.data.unit;
    let value = unit.quantity(c.value, c.standard_error, c.dimension);
    match (&candidate.law, i) {
        (Law::Powers(_), _) => value,
        (Law::FreeExponent, 0) => format!("{value} at {}", unit.speed(answer.data.points.largest_speed())),
        _ => format!("{} = {value}", c.name),
    }
}

fn numbers(study: &LawStudy, candidate: &Candidate, fit: &Fitted) -> [String; 4] {
    let least = study.candidates.iter().filter_map(Candidate::fitted).map(|fit| fit.rmse).reduce(f64::min);
    let digits = |value: f64| fixed(value, decimals(least.unwrap_or(value), 3, 1));
    let behind = match study.behind(candidate) {
        Some(behind) if candidate.eligible() && behind == 0.0 => "best".to_owned(),
        Some(behind) if candidate.eligible() => format!("+{}", fixed(behind, usize::from(behind < 100.0))),
        _ if fit.aicc.is_none() => "few points".to_owned(),
        _ => "negative".to_owned(),
    };
    let left_out = fit.leave_one_out.map_or("-".to_owned(), digits);
    [digits(fit.rmse), left_out, fixed(fit.squares, 1), behind]
}

/// What the columns mean, as far as these points make it worth saying.
fn notes(study: &LawStudy) -> Vec<String> {
    let mut lines = sentence(
        "rmse      ",
        &["root of the mean square over all points; left out: each point foretold by the others".to_owned()],
    );
    let negative =
        study.candidates.iter().any(|c| c.fitted().is_some_and(|f| f.aicc.is_some()) && !c.eligible());
    if negative {
        let text = "a coefficient is below 0: no sum of losses; the best without is one of the others";
        lines.extend(sentence("negative  ", &[text.to_owned()]));
    }
    if study.dispersion > 1.0 {
        let text = format!(
            "the points scatter {} times as far as their standard errors say: AICc and errors count it",
            significant(study.dispersion.sqrt(), 2)
        );
        lines.extend(sentence("scatter   ", &[text]));
    }
    if let (Some(least), Some(best)) = (study.least_rmse(), study.best())
        && least.law.to_string() != best.law.to_string()
    {
        let text = format!("is least for {}, which has more coefficients to reach it with", least.law);
        lines.extend(sentence("rmse      ", &[text]));
    }
    let singles = study.single_powers();
    if let [first, others @ ..] = &singles[..]
        && let Some(start) = first.fitted().and_then(|f| f.aicc)
    {
        let behind =
            |c: &&Candidate| Some(format!("{} +{}", c.law, significant(c.fitted()?.aicc? - start, 3)));
        let others: Vec<String> = others.iter().filter_map(behind).collect();
        lines.extend(sentence(
            "alone     ",
            &[format!("{} is best of the single powers: AICc {}", first.law, others.join(", "))],
        ));
    }
    lines
}

/// How the coefficients of the best law depend on each other.
fn correlation(study: &LawStudy) -> Vec<String> {
    let Some((best, fit)) = study.best().and_then(|best| Some((best, best.fitted()?))) else {
        return Vec::new();
    };
    let count = fit.coefficients.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let name = |i: usize| &fit.coefficients[i].name;
    let pair = |(i, j)| format!("{} and {}: {};", name(i), name(j), fixed(fit.correlation[i][j], 3));
    let mut pieces: Vec<String> = pairs.map(pair).collect();
    if pieces.is_empty() {
        return Vec::new();
    }
    pieces.push(format!("coefficients of {} in their order", best.law));
    sentence("correlated", &[format!(" {}", pieces.join(" "))])
}

/// What is usually claimed of the three, against what was fitted.
fn claims(found: &Consistency) -> Vec<String> {
    let claims: [(&str, Exponent, f64, &str); 4] = [
        ("dT", found.rise, 1.0, "proportional to the speed"),
        ("t_RC", found.time_constant, 0.0, "constant"),
        ("P", found.power, 1.0, "proportional to the speed"),
        ("P", found.power, 5.0 / 3.0, "with omega^(5/3)"),
    ];
    let cell =
        |(_, exponent, claimed, _): &(&str, Exponent, f64, &str)| match found.claim(*exponent, *claimed) {
            Some(s) if s.probability < 1e-4 => "p < 0.0001".to_owned(),
            Some(s) => format!("p = {}", significant(s.probability, 2)),
            None => "-".to_owned(),
        };
    let word = |(_, exponent, claimed, _): &(&str, Exponent, f64, &str)| {
        let p = found.claim(*exponent, *claimed).map(|s| s.probability);
        if p.is_some_and(|p| p < lptn_study::fit::law::SIGNIFICANT) { "refuted" } else { "possible" }
            .to_owned()
    };
    let table = TextTable::new(vec![
        Column::new("of", Align::Left, claims.iter().map(|c| c.0.to_owned()).collect()),
        Column::new(
            "exponent",
            Align::Left,
            claims.iter().map(|c| with_error(c.1.value, c.1.standard_error)).collect(),
        ),
        Column::new("claim", Align::Left, claims.iter().map(|c| c.3.to_owned()).collect()),
        Column::new("by chance", Align::Left, claims.iter().map(cell).collect()),
        Column::new("", Align::Left, claims.iter().map(word).collect()),
    ]);
    table.lines(WIDTH)
}
