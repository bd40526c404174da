//! The laws as CSV and JSON.

use std::io;

use lptn_fit::law::{Candidate, Coefficient, Fitted};
use lptn_report::Json;
use lptn_solve::Table;
use serde_json::{Value, json};

use super::{Answer, laws};
use crate::diagnostics;

/// A law and one of its coefficients.
type Row<'a> = (&'a Candidate, Option<(&'a Fitted, &'a Coefficient)>);

/// One row a coefficient, best law first; what there is not is NaN.
pub(crate) fn table(answer: &Answer) -> Table {
    let mut rows: Vec<Row<'_>> = Vec::new();
    for candidate in &answer.study.candidates {
        match candidate.fitted() {
            Some(fit) => rows.extend(fit.coefficients.iter().map(|c| (candidate, Some((fit, c))))),
            None => rows.push((candidate, None)),
        }
    }
    let mut table = Table::of(&rows);
    table.label("law", |(candidate, _)| candidate.law.to_string());
    table.label("coefficient", |(_, row)| row.map_or(String::new(), |(_, c)| c.name.clone()));
    table.label("unit", |(_, row)| row.map_or(String::new(), |(_, c)| c.dimension.si_unit()));
    table.label("remark", |(candidate, _)| candidate.remark().unwrap_or_default());
    let mut column = |name: &str, unit: &str, value: &dyn Fn(&Fitted, &Coefficient) -> Option<f64>| {
        table.column(name, unit, |(_, row)| row.and_then(|(f, c)| value(f, c)).unwrap_or(f64::NAN));
    };
    column("value", "SI", &|_, c| Some(c.value));
    column("standard_error", "SI", &|_, c| c.standard_error);
    column("rmse", "W", &|f, _| Some(f.rmse));
    column("leave_one_out", "W", &|f, _| f.leave_one_out);
    let squares = if answer.data.points.deviation().is_some() { "1" } else { "W^2" };
    column("squares", squares, &|f, _| Some(f.squares));
    column("aicc", "1", &|f, _| f.aicc);
    table.done()
}

/// What is common to points and folders.
pub(crate) fn members(answer: &Answer, json: &mut Json<'_>) -> io::Result<()> {
    let (data, study) = (&answer.data, &answer.study);
    let rivals: Value = study.rivals().iter().map(|c| c.law.to_string()).collect();
    json.member("format", &1)?;
    json.member("points", &json!({ "file": data.name, "count": data.points.len() }))?;
    json.member("warnings", &diagnostics::list(&data.files, &data.warnings))?;
    json.member("weighted", &data.points.deviation().is_some())?;
    json.member("laws", &study.candidates.iter().map(|c| law(answer, c)).collect::<Value>())?;
    json.member("best", &study.best().map(|c| c.law.to_string()))?;
    json.member("not_told_apart", &rivals)?;
    json.member("verdict", &study.verdict())?;
    let consistency = answer.consistency.as_ref();
    consistency.map_or(Ok(()), |found| json.member("consistency", &laws::members(found)))
}

fn law(answer: &Answer, candidate: &Candidate) -> Value {
    let watts = |value: Option<f64>| value.map(|value| json!({ "value": value, "unit": "W" }));
    let Some(fit) = candidate.fitted() else {
        return json!({ "law": candidate.law.to_string(), "remark": candidate.remark() });
    };
    let coefficient = |c: &Coefficient| {
        let shown = answer.data.unit.quantity(c.value, c.standard_error, c.dimension);
        let unit = c.dimension.si_unit();
        json!({ "name": c.name, "value": c.value, "unit": unit, "standard_error": c.standard_error, "shown": shown })
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
