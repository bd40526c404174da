//! `--live`: pages that solve their netlist again.

use lptn_answer::failure::Failure;
use lptn_answer::run::RunAnswer;
use lptn_live::{Changes, contents, sliders};
use serde_json::{Value, json};

use super::RunArgs;
use crate::console::Console;
use crate::core_of_live::CORE;

/// Refuses `--live` before anything is computed, if this program cannot write such pages.
pub(crate) fn check(args: &RunArgs) -> Result<(), Failure> {
    if args.live && CORE.is_none() {
        return Err(Failure::refused(
            "report::no_core",
            "this lptn was built without the core of live pages",
            "make the core by `make live`, then build lptn by `make build`; or leave out --live",
        ));
    }
    Ok(())
}

/// Makes the page of a run live, if that was requested.
pub(crate) fn page(args: &RunArgs, answer: &RunAnswer, console: &Console) {
    if !args.live {
        return;
    }
    let (input, question) = (&answer.task.input, args.question(console));
    let (case, set) = args.source.settings();
    let (stop, every) = (args.times.stop.as_deref(), args.times.every.as_deref());
    let changes = Changes { case, set, stop, every };
    let parameters: Vec<Value> = sliders(input).into_iter().map(Value::from).collect();
    console.live_page(json!({
        "file": args.source.file.display().to_string(),
        "words": words(args, &changes),
        "parameters": parameters,
        "contents": contents(&input.netlist, &changes, &question),
    }));
}

/// The options of the command that the answers of a page depend on.
fn words(args: &RunArgs, changes: &Changes<'_>) -> Vec<String> {
    let scale = args.shown.scale.temperature_unit.as_deref();
    let one = |option: &str, value: Option<&str>| {
        value.map(|value| [option.to_owned(), value.to_owned()])
    };
    let named = [
        one("--case", changes.case),
        one("--stop", changes.stop),
        one("--every", changes.every),
        one("--tolerance", args.tolerance.as_deref()),
        one("--temperature-unit", scale),
    ];
    let lists = [("--select", &args.shown.select), ("--set", &args.source.set)];
    let lists = lists
        .into_iter()
        .flat_map(|(option, list)| list.iter().flat_map(move |value| one(option, Some(value))));
    named.into_iter().flatten().chain(lists).flatten().collect()
}
