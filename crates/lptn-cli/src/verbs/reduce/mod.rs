//! `lptn reduce`

mod args;
mod keep;

pub(crate) use args::ReduceArgs;

use std::path::Path;
use std::sync::Arc;

use lptn_answer::answer::Answer;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::reduce::{ReduceAnswer, ReduceQuestion, not_near_a_state};
use lptn_report::{Format, plain};

use args::ReduceFormat;

use crate::console::Console;
use crate::files;
use crate::input::Load as _;

/// The netlist that goes to a place, or that is printed.
type Netlist<'a> = dyn Fn(Option<&Path>) -> Result<String, Failure> + 'a;

pub(crate) fn reduce(args: &ReduceArgs, console: &Console) -> Result<Exit, Failure> {
    if let Some(names) = &args.keep {
        return keep::keep(args, console, names);
    }
    if args.recover.is_some() {
        return Err(keep::recovers_nothing());
    }
    let question = ReduceQuestion {
        port: args.port.clone(),
        max_error: args.max_error.clone(),
        error: args.error.clone(),
        power: args.power.clone(),
        nodes: args.nodes,
        judge: args.judge,
        definition: args.definition,
        bias: args.bias,
        window: args.window.clone(),
        at: args.at.at.clone(),
        temperature_unit: args.scale.temperature_unit.clone(),
    };
    let input = Arc::new(Input::load(&args.source)?);
    if let (Some(option), Some(_)) = (args.netlist_option(), &question.at) {
        return Err(not_near_a_state(option));
    }
    let answer = question.ask(Arc::clone(&input), &console.listening())?;
    console.warn(answer.files(), &answer.doubts());
    if let (Some(path), Some(text)) = (&args.worst, answer.loads.csv()) {
        files::write_new(path, &text, "reduce::exists")?;
        console.note(&signal_of(path));
    }
    let netlist = |place: Option<&Path>| answer.netlist(place);
    args.write(&netlist)?;
    args.print(console, &answer, (&netlist, &|| answer.beside_rows()))?;
    if let Some(path) = &args.write {
        let nodes = match answer.count() {
            1 => "one node that replaces".to_owned(),
            many => format!("{many} nodes that replace"),
        };
        wrote((path, &nodes), &input, console);
    } else if args.format == ReduceFormat::Of(Format::Table) {
        next(&answer, &input, console);
    }
    answer.too_large().iter().for_each(|text| console.message(text));
    Ok(answer.exit())
}

impl ReduceArgs {
    /// The option that asks for a netlist, if one does.
    fn netlist_option(&self) -> Option<&'static str> {
        let toml = self.format == ReduceFormat::Toml;
        self.write.is_some().then_some("--write").or(toml.then_some("--format toml"))
    }

    /// Writes the netlist if that is requested.
    fn write(&self, netlist: &Netlist<'_>) -> Result<(), Failure> {
        let Some(path) = &self.write else { return Ok(()) };
        files::write_new(path, &netlist(Some(path))?, "reduce::exists")
    }

    /// Prints an answer or its netlist, and next to rows of CSV the notes that they leave out.
    fn print(
        &self,
        console: &Console,
        answer: &dyn Answer,
        (netlist, beside_rows): (&Netlist<'_>, &dyn Fn() -> Vec<String>),
    ) -> Result<(), Failure> {
        match self.format {
            ReduceFormat::Of(format) => drop(console.show(answer, format)?),
            ReduceFormat::Toml => drop(console.print(&netlist(None)?)?),
        }
        if self.format == ReduceFormat::Of(Format::Csv) {
            beside_rows().iter().for_each(|line| console.note(line));
        }
        Ok(())
    }
}

/// Says that a netlist was written, and how to run it.
fn wrote((path, nodes): (&Path, &str), input: &Input, console: &Console) {
    console.note(&format!("wrote  {}: {nodes} {}", path.display(), input.text.name));
    if input.netlist.run.is_some() {
        console.next(&format!("lptn run {}", quoted(&path.display().to_string())));
    }
}

/// Says how to write the netlist, of a network that has one.
fn next(answer: &ReduceAnswer, input: &Input, console: &Console) {
    let writes = !input.netlist.network.has_events() && !answer.is_near_a_state();
    if let (Some(file), true) = (input.typed(), writes) {
        let port = quoted(answer.port());
        console.next(&format!("lptn reduce {file} --port {port} --write {port}.toml"));
    }
}

/// Text that shows how a netlist uses the file of a load.
fn signal_of(path: &Path) -> String {
    format!(
        "in a netlist: worst = {{ csv = \"{}\", time = \"t\", value = \"P\", interp = \"previous\", \
         after_end = \"hold\" }}",
        plain(&path.display().to_string())
    )
}
