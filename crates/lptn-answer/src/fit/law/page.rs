//! Laws of points as a page.

use std::io;

use lptn_fit::law::{
    Coefficient, Consistency, Exponent, Fitted, LawFit, LawStudy, LossLaw, SIGNIFICANT,
};
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, decimals, fixed, plain, significant,
};
use lptn_solve::Table;
use serde_json::{Value, json};

use super::laws::{sections, verdict};
use super::shown::{chance, with_error};
use super::{FitLawAnswer, laws};
use crate::about;
use crate::messages;

impl Page for FitLawAnswer {
    fn text(&self) -> Text {
        let (data, study) = (&self.data, &self.study);
        let weights = if data.points.deviation().is_some() {
            "weighted by their standard errors"
        } else {
            "unweighted"
        };
        let range = data.unit.range(ends(data.points.speed()));
        let title =
            format!("{} over {}", plain(&data.power_name), plain(&data.points.variables()[0].name));
        let mut text = Text::titled(title);
        text.line(format!("{} points at {range}, {weights}", data.points.len()));
        text.section().table(laws(self));
        notes(study, text.section());
        intervals(self, &mut text);
        correlation(study, &mut text);
        text.section().sentence("", &study.verdict());
        if let Some(found) = &self.consistency {
            text.section().title("Do dT, t_RC and P agree?");
            text.section().table(claims(found));
            if found.derived {
                text.section().sentence("", &verdict(found, &data.unit));
            } else {
                sections(&mut text, found, &data.unit);
            }
        }
        text
    }

    /// One row per coefficient, best law first; missing values are NaN.
    fn rows(&self) -> Rows<'_> {
        let mut rows: Vec<Row<'_>> = Vec::new();
        for candidate in &self.study.candidates {
            match candidate.fitted() {
                Some(fit) => {
                    rows.extend(fit.coefficients.iter().map(|c| (candidate, Some((fit, c)))))
                }
                None => rows.push((candidate, None)),
            }
        }
        let mut table = Table::of(&rows);
        table.label("law", |(candidate, _)| candidate.law.to_string());
        table.label("coefficient", |(_, row)| row.map_or(String::new(), |(_, c)| c.name.clone()));
        table.label("unit", |(_, row)| row.map_or(String::new(), |(_, c)| c.dimension.si_unit()));
        table.label("remark", |(candidate, _)| candidate.remark().unwrap_or_default());
        let mut column =
            |name: &str, unit: &str, value: &dyn Fn(&Fitted, &Coefficient) -> Option<f64>| {
                table.column(name, unit, |(_, row)| {
                    row.and_then(|(f, c)| value(f, c)).unwrap_or(f64::NAN)
                });
            };
        column("value", "SI", &|_, c| Some(c.value));
        column("standard_error", "SI", &|_, c| c.standard_error);
        column("half_width_95", "SI", &|_, c| c.half_width);
        column("rmse", "W", &|f, _| Some(f.rmse));
        column("leave_one_out", "W", &|f, _| f.leave_one_out);
        let squares = if self.data.points.deviation().is_some() { "1" } else { "W^2" };
        column("squares", squares, &|f, _| Some(f.squares));
        column("aicc", "1", &|f, _| f.aicc);
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pictures()
    }

    fn more(&self) -> Report {
        let standing = if self.no().is_none() { Standing::Holds } else { Standing::Fails };
        let answer = about::verdict(standing, &self.study.verdict());
        Report { answer, ..about::of_command(&[], &self.command) }
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (data, study) = (&self.data, &self.study);
        let rivals: Value = study.rivals().iter().map(|c| c.law.to_string()).collect();
        json.member("format", &1)?;
        json.member("points", &json!({ "file": data.name, "count": data.points.len() }))?;
        json.member("warnings", &messages::list(&data.files, &data.warnings))?;
        json.member("weighted", &data.points.deviation().is_some())?;
        json.member("laws", &study.candidates.iter().map(|c| law(self, c)).collect::<Value>())?;
        json.member("best", &study.best().map(|c| c.law.to_string()))?;
        json.member("not_told_apart", &rivals)?;
        json.member("verdict", &study.verdict())?;
        json.optional("consistency", self.consistency.as_ref().map(laws::members))
    }

    fn no(&self) -> Option<String> {
        let found = self.consistency.as_ref().filter(|found| !found.agrees())?;
        Some(laws::verdict(found, &self.data.unit))
    }
}

pub(super) fn ends(speeds: &[f64]) -> (f64, f64) {
    let of = |pick: fn(f64, f64) -> f64| speeds.iter().copied().reduce(pick).unwrap_or(f64::NAN);
    (of(f64::min), of(f64::max))
}

/// One line of the table.
struct Line {
    law: String,
    coefficient: String,
    numbers: [String; 4],
}

fn laws(answer: &FitLawAnswer) -> TextTable {
    let lines: Vec<Line> = answer.study.candidates.iter().flat_map(|c| lines(answer, c)).collect();
    let mut table = TextTable::of(&lines)
        .left("law", |line| line.law.as_str())
        .left("coefficients", |line| line.coefficient.as_str())
        .right("rmse [W]", |line| line.numbers[0].as_str())
        .right("left out", |line| line.numbers[1].as_str());
    if answer.data.points.deviation().is_some() {
        table = table.right("chi^2", |line| line.numbers[2].as_str()).optional();
    }
    table.right("AICc", |line| line.numbers[3].as_str()).into()
}

/// The lines of a law: one for each coefficient.
fn lines(answer: &FitLawAnswer, candidate: &LawFit) -> Vec<Line> {
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
fn names(law: &LossLaw, count: usize) -> Vec<String> {
    let text = plain(&law.to_string());
    match law {
        LossLaw::Powers(_) => {
            let terms = text.split(" + ").enumerate();
            terms
                .map(|(i, term)| if i == 0 { term.to_owned() } else { format!("+ {term}") })
                .collect()
        }
        _ => (0..count).map(|i| if i == 0 { text.clone() } else { String::new() }).collect(),
    }
}

pub(super) fn coefficient(
    answer: &FitLawAnswer,
    candidate: &LawFit,
    fit: &Fitted,
    i: usize,
) -> String {
    let c = &fit.coefficients[i];
    with_unit(answer, candidate, (i, c), c.standard_error)
}

/// A coefficient with an error of some kind.
fn with_unit(
    answer: &FitLawAnswer,
    candidate: &LawFit,
    (i, c): (usize, &Coefficient),
    error: Option<f64>,
) -> String {
    let unit = &answer.data.unit;
    let value = unit.quantity(c.value, error, c.dimension);
    match (&candidate.law, i) {
        (LossLaw::Powers(_), _) => value,
        (LossLaw::FreeExponent, 0) => {
            format!("{value} at {}", unit.speed(answer.data.points.largest_speed()))
        }
        _ => format!("{} = {value}", c.name),
    }
}

fn numbers(study: &LawStudy, candidate: &LawFit, fit: &Fitted) -> [String; 4] {
    let least =
        study.candidates.iter().filter_map(LawFit::fitted).map(|fit| fit.rmse).reduce(f64::min);
    let digits = |value: f64| fixed(value, decimals(least.unwrap_or(value), 3, 1));
    let behind = match study.behind(candidate) {
        Some(behind) if candidate.eligible() && behind == 0.0 => "best".to_owned(),
        Some(behind) if candidate.eligible() => {
            format!("+{}", fixed(behind, usize::from(behind < 100.0)))
        }
        _ if fit.aicc.is_none() => "few points".to_owned(),
        _ => "negative".to_owned(),
    };
    let left_out = fit.leave_one_out.map_or("-".to_owned(), digits);
    [digits(fit.rmse), left_out, fixed(fit.squares, 1), behind]
}

/// Notes that explain the columns, as far as these points need them.
fn notes(study: &LawStudy, text: &mut Text) {
    text.sentence(
        "rmse      ",
        "root of the mean square over all points; left out: each point predicted by the others",
    );
    let negative = study
        .candidates
        .iter()
        .any(|c| c.fitted().is_some_and(|f| f.aicc.is_some()) && !c.eligible());
    if negative {
        let why = "a coefficient is below 0, so the law is not a sum of losses; the best is one of the \
             others";
        text.sentence("negative  ", why);
    }
    if study.dispersion > 1.0 {
        let scatter = format!(
            "the points scatter {} times as far as their standard errors: AICc and errors include \
             it",
            significant(study.dispersion.sqrt(), 2)
        );
        text.sentence("scatter   ", &scatter);
    }
    if let (Some(least), Some(best)) = (study.least_rmse(), study.best())
        && least.law.to_string() != best.law.to_string()
    {
        let least = format!("is least for {}, which has more coefficients", least.law);
        text.sentence("rmse      ", &least);
    }
    let singles = study.single_powers();
    if let [first, others @ ..] = &singles[..]
        && let Some(start) = first.fitted().and_then(|f| f.aicc)
    {
        let behind =
            |c: &&LawFit| Some(format!("{} +{}", c.law, significant(c.fitted()?.aicc? - start, 3)));
        let others: Vec<String> = others.iter().filter_map(behind).collect();
        let all = others.join(", ");
        let alone = format!("{} is best of the single powers: AICc {all}", first.law);
        text.sentence("alone     ", &alone);
    }
}

/// The 95 % intervals of the best law.
fn intervals(answer: &FitLawAnswer, text: &mut Text) {
    let Some((best, fit)) = answer.study.best().and_then(|best| Some((best, best.fitted()?)))
    else {
        return;
    };
    let interval = |(i, c): (usize, &Coefficient)| {
        c.half_width?;
        Some(with_unit(answer, best, (i, c), c.half_width))
    };
    let all: Option<Vec<String>> = fit.coefficients.iter().enumerate().map(interval).collect();
    if let Some(all) = all {
        let law = plain(&best.law.to_string());
        text.sentence("95 %      ", &format!("{law}: {}", all.join("; ")));
    }
}

/// Correlations between the coefficients of the best law.
fn correlation(study: &LawStudy, text: &mut Text) {
    let Some((best, fit)) = study.best().and_then(|best| Some((best, best.fitted()?))) else {
        return;
    };
    let count = fit.coefficients.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let name = |i: usize| &fit.coefficients[i].name;
    let pair =
        |(i, j)| format!("{} and {}: {};", name(i), name(j), fixed(fit.correlation[i][j], 3));
    let mut pieces: Vec<String> = pairs.map(pair).collect();
    if pieces.is_empty() {
        return;
    }
    pieces.push(format!("coefficients of {} in their order", best.law));
    text.sentence("correlated", &format!(" {}", pieces.join(" ")));
}

/// Usual claims about the three, against the fitted exponents.
fn claims(found: &Consistency) -> TextTable {
    type Claim = (&'static str, Exponent, f64, &'static str);
    let claims: [Claim; 4] = [
        ("dT", found.rise, 1.0, "proportional to the speed"),
        ("t_RC", found.time_constant, 0.0, "constant"),
        ("P", found.power, 1.0, "proportional to the speed"),
        ("P", found.power, 5.0 / 3.0, "with omega^(5/3)"),
    ];
    let probability = |claim: &Claim| found.claim(claim.1, claim.2).map(|s| s.probability);
    let shown = |p: Option<f64>| p.map_or("-".to_owned(), chance);
    let refuted = |claim: &Claim| probability(claim).is_some_and(|p| p < SIGNIFICANT);
    TextTable::of(&claims)
        .left("of", |claim| claim.0)
        .left("exponent", |claim| with_error(claim.1.value, claim.1.standard_error))
        .left("claim", |claim| claim.3)
        .left("by chance", |claim| shown(probability(claim)))
        .left("", |claim| if refuted(claim) { "refuted" } else { "possible" })
        .into()
}

/// A law and one of its coefficients.
type Row<'a> = (&'a LawFit, Option<(&'a Fitted, &'a Coefficient)>);

fn law(answer: &FitLawAnswer, candidate: &LawFit) -> Value {
    let watts = |value: Option<f64>| value.map(|value| json!({ "value": value, "unit": "W" }));
    let Some(fit) = candidate.fitted() else {
        return json!({ "law": candidate.law.to_string(), "remark": candidate.remark() });
    };
    let coefficient = |c: &Coefficient| {
        let shown = answer.data.unit.quantity(c.value, c.standard_error, c.dimension);
        let unit = c.dimension.si_unit();
        json!({
            "name": c.name,
            "value": c.value,
            "unit": unit,
            "standard_error": c.standard_error,
            "half_width_95": c.half_width,
            "shown": shown,
        })
    };
    let weighted = answer.data.points.deviation().is_some();
    json!({
        "law": candidate.law.to_string(),
        "coefficients": fit.coefficients.iter().map(coefficient).collect::<Vec<_>>(),
        "correlation": fit.correlation,
        "rmse": watts(Some(fit.rmse)),
        "leave_one_out": watts(fit.leave_one_out),
        "chi_squared": weighted.then_some(fit.squares),
        "degrees_of_freedom": fit.degrees_of_freedom,
        "aicc": fit.aicc,
        "behind": answer.study.behind(candidate),
        "remark": candidate.remark(),
    })
}
