//! `lptn reduce --keep a,b`

use std::path::Path;
use std::sync::Arc;

use lptn_answer::answer::Answer as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::reduce::KeepQuestion;
use lptn_report::write_rows;

use super::args::ReduceArgs;
use super::wrote;
use crate::console::Console;
use crate::files;
use crate::input::Load as _;

pub(super) fn keep(args: &ReduceArgs, console: &Console, names: &str) -> Result<Exit, Failure> {
    let question = KeepQuestion {
        keep: listed(names),
        nodes: args.nodes,
        max_error: args.max_error.clone(),
        error: args.error.clone(),
        power: args.power.clone(),
        temperature_unit: args.scale.temperature_unit.clone(),
    };
    let input = Arc::new(Input::load(&args.source)?);
    let answer = question.ask(Arc::clone(&input))?;
    console.warn(answer.files(), &answer.doubts());
    let netlist = |place: Option<&Path>| answer.netlist(place);
    args.write(&netlist)?;
    if let Some(path) = &args.recover {
        let mut text = Vec::new();
        // a vector takes everything
        drop(write_rows(&answer.recovery()?, &mut text));
        files::write_new(path, &String::from_utf8_lossy(&text), "reduce::exists")?;
    }
    args.print(console, &answer, (&netlist, &|| answer.beside_rows()))?;
    if let Some(path) = &args.recover {
        console.note(&format!("wrote  {}: all temperatures from the kept", path.display()));
    }
    if let Some(path) = &args.write {
        wrote((path, "nodes that represent"), &input, console);
    }
    answer.too_large().iter().for_each(|text| console.message(text));
    Ok(answer.exit())
}

/// `a,b` or `bar[1,1,1],b`: a comma within brackets is part of a name.
fn listed(text: &str) -> Vec<String> {
    let mut names = vec![String::new()];
    let mut depth = 0_i32;
    for c in text.chars() {
        depth += i32::from(c == '[') - i32::from(c == ']');
        match names.last_mut() {
            Some(name) if c != ',' || depth > 0 => name.push(c),
            _ => names.push(String::new()),
        }
    }
    let names = names.iter().map(|name| name.trim()).filter(|name| !name.is_empty());
    names.map(str::to_owned).collect()
}

/// Failure of a recovery without nodes to recover from.
pub(super) fn recovers_nothing() -> Failure {
    Failure::refused(
        "reduce::nodes",
        "--recover follows from nodes that are kept",
        "write for example --keep steel,housing --recover all.csv",
    )
}
