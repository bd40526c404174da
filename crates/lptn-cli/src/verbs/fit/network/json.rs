//! What came of a fit of a network, as JSON.

use lptn_fit::least_squares::Side;
use lptn_fit::network::{Combination, Unseparated};
use lptn_report::Json;
use lptn_solve::Gradient;
use lptn_study::Scalar;
use serde_json::{Map, Value, json};

use super::Answer;
use super::words::{combination, type_of, verdict};
use crate::diagnostics;

pub(crate) fn json(answer: &Answer<'_>, json: &mut Json<'_>) -> std::io::Result<()> {
    let (netlist, fit) = (&answer.input.netlist, &answer.fit);
    let warnings = [netlist.warnings.as_slice(), &answer.doubts].concat();
    let all = 0..fit.parameters.len();
    let parameters: Map<String, Value> =
        all.clone().map(|i| (answer.name(i).to_owned(), parameter(answer, i))).collect();
    let row = |i: usize| -> Map<String, Value> {
        all.clone().map(|j| (answer.name(j).to_owned(), json!(fit.correlation(i, j)))).collect()
    };
    let correlation: Map<String, Value> =
        all.clone().map(|i| (answer.name(i).to_owned(), Value::Object(row(i)))).collect();
    let known = fit.identifiability.as_ref();
    let starts = fit.starts;
    json.member("format", &1)?;
    json.member("network", &answer.input.text.stem)?;
    json.member("study", &answer.study.name)?;
    json.member("warnings", &diagnostics::list(&netlist.files, &warnings))?;
    json.member("parameters", &parameters)?;
    json.member("rms", &Scalar::new(fit.rms, "K"))?;
    json.member("samples", &fit.samples())?;
    json.member("columns", &columns(answer))?;
    json.member("correlation", &correlation)?;
    json.member("identifiable", &answer.is_whole())?;
    json.member("rank", &known.map(|known| known.rank))?;
    json.member("singular_values", &known.map(|known| &known.singular_values))?;
    json.member("unidentified", &unidentified(answer))?;
    json.member("verdict", &verdict(answer))?;
    json.member(
        "starts",
        &json!({ "tried": starts.tried, "same": starts.same, "other": starts.other, "failed": starts.failed }),
    )?;
    json.member("gradient", if fit.gradient == Gradient::Exact { "exact" } else { "differences" })
}

fn parameter(answer: &Answer<'_>, i: usize) -> Value {
    let (fitted, varied) = (&answer.fit.parameters[i], &answer.task.parameters[i]);
    let ty = answer.task.network.parameters()[varied.parameter.index()].ty;
    let unit = ty.dimension.si_unit();
    let finite = |value: f64| value.is_finite().then_some(value);
    let side = fitted.on_bound.map(|side| if side == Side::Lower { "from" } else { "to" });
    json!({
        "value": fitted.value,
        "unit": unit,
        "standard_error": fitted.standard_error,
        "start": fitted.start,
        "from": finite(varied.bounds.0),
        "to": finite(varied.bounds.1),
        "prior": varied.prior,
        "on_bound": side,
    })
}

fn columns(answer: &Answer<'_>) -> Value {
    let column = |misfit: &lptn_fit::network::ColumnMisfit| {
        let run = &answer.task.runs[misfit.run];
        json!({
            "record": run.name,
            "column": run.columns[misfit.column].name,
            "rms": Scalar::new(misfit.rms, "K"),
            "mean": Scalar::new(misfit.mean, "K"),
            "sigma": misfit.sigma.map(|sigma| Scalar::new(sigma, "K")),
            "samples": misfit.samples,
            "effective_samples": misfit.effective,
        })
    };
    answer.fit.columns.iter().map(column).collect()
}

/// What the records do not determine: parameters that nothing depends on, then those that cannot be told apart.
fn unidentified(answer: &Answer<'_>) -> Value {
    let Some(known) = &answer.fit.identifiability else { return Value::Null };
    let unfelt = known
        .unfelt
        .iter()
        .map(|&i| json!({ "parameters": [answer.name(i)], "missing": 1, "determined": [] }));
    unfelt.chain(known.unseparated.iter().map(|group| unseparated(answer, group))).collect()
}

fn unseparated(answer: &Answer<'_>, group: &Unseparated) -> Value {
    let names: Vec<&str> = group.parameters.iter().map(|&i| answer.name(i)).collect();
    let one = |c: &Combination| {
        let unit = type_of(answer, c).map_or_else(String::new, |ty| ty.dimension.si_unit());
        json!({ "combination": combination(answer, c), "value": Scalar::new(c.value, &unit) })
    };
    let determined: Option<Value> = group.determined.as_ref().map(|all| all.iter().map(one).collect());
    json!({ "parameters": names, "missing": group.missing, "determined": determined })
}
