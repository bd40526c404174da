//! A netlist that is read once and asked many times.

use std::io::{Error, ErrorKind};
use std::path::Path;
use std::sync::Arc;

use lptn_answer::answer::Answer as _;
use lptn_answer::belief::Belief;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Given, Input};
use lptn_answer::listener::Nobody;
use lptn_answer::lumping::Detail;
use lptn_answer::run::{RunAnswer, RunQuestion, View};
use lptn_answer::steady::{SteadyAnswer, SteadyQuestion};
use lptn_html::{claims, figures, results};
use lptn_netlist::{Diagnostic, parse_with};
use lptn_report::{Page as _, TimeUnit, write_csv};
use serde_json::{Map, Value, json};

use crate::sliders::sliders;

/// A netlist that a page solves again.
#[derive(Clone, Debug)]
pub struct Live {
    input: Input,
    run: RunQuestion,
    steady: SteadyQuestion,
}

impl Live {
    /// Reads [`contents`](crate::contents).
    ///
    /// # Errors
    /// All problems of the netlist or of the changes.
    pub fn open(contents: &str) -> Result<Self, Failure> {
        let contents: Value = serde_json::from_str(contents).unwrap_or_default();
        let input = input(&contents)?;
        let select = texts(&contents["select"]);
        let temperature_unit = text(&contents["temperature_unit"]);
        let balance = text(&contents["balance"]);
        let unit = contents["time_unit"].as_str();
        let steady = SteadyQuestion {
            temperature_unit: temperature_unit.clone(),
            ..SteadyQuestion::default()
        };
        let run = RunQuestion {
            tolerance: text(&contents["tolerance"]),
            select,
            temperature_unit,
            time_unit: TimeUnit::ALL.into_iter().find(|known| Some(known.symbol()) == unit),
            balance,
            picture: true,
            view: View::of_page(),
            detail: detail(&contents["detail"]),
            ..RunQuestion::default()
        };
        Ok(Self { input, run, steady })
    }

    /// The answer to a question: `set` has values such as `R=0.3K/W`. With `rows`, the rows are in
    /// it as CSV.
    ///
    /// It has the values of all parameters, and the parts of the page as HTML: claims, figures,
    /// results, the steady state. `problems` are errors and doubts.
    pub fn answer(&self, question: &str) -> String {
        let question: Value = serde_json::from_str(question).unwrap_or_default();
        let set = texts(&question["set"]);
        let set: Vec<&str> = set.iter().map(String::as_str).collect();
        let input = match self.input.clone().set(&set) {
            Ok(input) => Arc::new(input),
            Err(failure) => return refused(&failure).to_string(),
        };
        let rows = question["rows"].as_bool().unwrap_or_default();
        let parameters: Vec<Value> = sliders(&input).into_iter().map(Value::from).collect();
        let mut answer = json!({ "parameters": parameters });
        let mut problems = Vec::new();
        match self.run.ask(Arc::clone(&input), &Nobody) {
            Ok(run) => {
                add(&mut answer, of_run(&run, rows));
                problems.extend(told(&run.doubts()));
                problems.extend(run.failed().iter().flat_map(|failed| told(&failed.diagnostics)));
            }
            Err(failure) => problems.extend(told(&failure.diagnostics)),
        }
        match self.steady.ask(input, &Nobody) {
            Ok(steady) => add(&mut answer, of_steady(&steady)),
            Err(failure) => answer["no_steady"] = told(&failure.diagnostics).collect(),
        }
        answer["problems"] = problems.into();
        answer.to_string()
    }
}

/// The answer to values that cannot be set.
pub(crate) fn refused(failure: &Failure) -> Value {
    json!({ "refused": told(&failure.diagnostics).collect::<Value>() })
}

fn of_run(run: &RunAnswer, rows: bool) -> Value {
    let report = run.live();
    let mut value = json!({
        "claims": claims(&report),
        "figures": figures(&report),
        "results": results(&report),
        "integrator": run.solution.method().map(|method| method.name()),
    });
    if rows {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write_csv(&run.shown_table(), &mut bytes));
        value["rows"] = String::from_utf8(bytes).unwrap_or_default().into();
    }
    value
}

fn of_steady(steady: &SteadyAnswer) -> Value {
    let report = lptn_report::with_results(&steady.text(), Vec::new(), Default::default());
    json!({ "steady": results(&report) })
}

fn told(diagnostics: &[Diagnostic]) -> impl Iterator<Item = Value> {
    diagnostics.iter().map(
        |problem| json!({ "code": problem.code, "message": problem.message, "help": problem.help }),
    )
}

fn add(answer: &mut Value, members: Value) {
    if let (Some(answer), Value::Object(members)) = (answer.as_object_mut(), members) {
        answer.extend::<Map<String, Value>>(members);
    }
}

fn detail(value: &Value) -> Detail {
    let all = [Detail::Brief, Detail::Usual, Detail::Verbose];
    all.into_iter().find(|known| value.as_u64() == Some(*known as u64)).unwrap_or(Detail::Brief)
}

fn text(value: &Value) -> Option<String> {
    value.as_str().map(str::to_owned)
}

fn texts(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().filter_map(text).collect()
}

fn bytes_of(file: &Value) -> Vec<u8> {
    let bytes = || file["bytes"].as_array().into_iter().flatten();
    let byte = |value: &Value| u8::try_from(value.as_u64()?).ok();
    file["text"].as_str().map_or_else(|| bytes().filter_map(byte).collect(), |text| text.into())
}

/// The netlist of a page with the changes of its command line.
fn input(contents: &Value) -> Result<Input, Failure> {
    let files = contents["files"].as_array().map_or(&[][..], Vec::as_slice);
    let Some(first) = files.first() else {
        let problem = Diagnostic::error("input::cannot_read", "the page has no netlist");
        return Err(Failure::new(Exit::Input, problem));
    };
    let name = text(&first["name"]).unwrap_or_default();
    let bytes = bytes_of(first);
    let mut loader = |path: &Path| {
        let named = |file: &&Value| file["name"].as_str().is_some_and(|own| Path::new(own) == path);
        files.iter().find(named).map(bytes_of).ok_or_else(|| Error::from(ErrorKind::NotFound))
    };
    let netlist = parse_with(&name, &String::from_utf8_lossy(&bytes), &mut loader)?;
    let stem = Path::new(&name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let given = Given { bytes, name, stem: stem.unwrap_or_else(|| "netlist".into()) };
    let (case, set) = (contents["case"].as_str(), texts(&contents["set"]));
    let times = ["stop", "every"].map(|name| contents[name].as_str());
    Input::of_run((Arc::new(given), netlist), (&Belief::Named, times), (case, &set))
}
