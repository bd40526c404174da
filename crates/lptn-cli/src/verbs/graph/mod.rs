//! `lptn graph`

mod args;
mod field;
mod kind;
mod output;
mod state;

pub(crate) use args::GraphArgs;

use kind::Kind;
use lptn_graph::{Diagram, Grouping, View};
use lptn_netlist::Diagnostic;
use lptn_plot::{Scene, png, svg};
use lptn_units::Unit;

use crate::console::Console;
use crate::input::Load as _;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input};

/// Pixels of a PNG for one of the drawing: 192 an inch.
const SCALE: f64 = 2.0;

pub(crate) fn graph(args: &GraphArgs, console: &Console) -> Result<Exit, Failure> {
    if console.plot.is_some() {
        let problem = Diagnostic::error("graph::format", "--plot draws curves, not the network");
        return Err(Failure::new(Exit::Input, problem.help("write -o FILE in its place")));
    }
    let (kind, place) = kind::wanted(args.format, args.output.as_deref(), args.only_a_picture())?;
    let input = Input::load(&args.source)?;
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    let (bytes, name) = if field::is_wanted(args, kind) {
        field::written(args, kind, (&input, &unit, console))?
    } else {
        network(args, kind, (&input, &unit, console))?
    };
    output::put(&bytes, (&place, &name), &input, console)?;
    let plain = !args.shows_state() && !field::is_wanted(args, kind);
    if let (true, Some(file)) = (plain, input.typed()) {
        console.next(&format!("lptn graph {file} --steady"));
    } else if let (true, Some(file)) = (args.shows_state(), input.typed()) {
        console.next(&format!("lptn run {file} --report"));
    }
    Ok(Exit::Done)
}

/// What is written of the network, and its usual name.
fn network(
    args: &GraphArgs,
    kind: Kind,
    (input, unit, console): (&Input, &Unit, &Console),
) -> Result<(Vec<u8>, String), Failure> {
    let diagram = diagram(args, input, (unit, console))?;
    let bytes = match kind {
        Kind::Dot => lptn_graph::dot(&diagram).into_bytes(),
        Kind::Mermaid => lptn_graph::mermaid(&diagram).into_bytes(),
        _ if args.sankey => {
            let scene = lptn_graph::sankey(&diagram);
            picture(kind, &scene.map_err(|error| Failure::of(&error))?)?
        }
        _ => {
            let scene = lptn_graph::scene(&diagram);
            picture(kind, &scene.map_err(|error| Failure::of(&error))?)?
        }
    };
    if !diagram.grouped.is_empty() {
        console.note(&grouped(&diagram, args.group));
    }
    let name = if args.sankey { "sankey" } else { "graph" };
    Ok((bytes, format!("{name}.{}", kind.ending())))
}

fn diagram(
    args: &GraphArgs,
    input: &Input,
    (unit, console): (&Unit, &Console),
) -> Result<Diagram, Failure> {
    let grouping = match (args.group, args.no_group) {
        (true, _) => Grouping::Yes,
        (_, true) => Grouping::No,
        _ => Grouping::Auto,
    };
    let state = match args.shows_state() {
        true => Some(state::state(args, (input, unit, console))?),
        false => None,
    };
    let title = input.title();
    let view = View { title: &title, grouping, unit, state: state.as_ref() };
    Ok(lptn_graph::diagram(&input.netlist.network, &view))
}

/// A drawing as a picture.
fn picture(kind: Kind, scene: &Scene) -> Result<Vec<u8>, Failure> {
    if kind != Kind::Png {
        return Ok(svg::write(scene).into_bytes());
    }
    png::write(scene, SCALE).map_err(|error| Failure::of(&error))
}

/// What stands as one box, and how to have it otherwise.
fn grouped(diagram: &Diagram, asked: bool) -> String {
    const SHOWN: usize = 6;
    let mut words: Vec<&str> = diagram.grouped.iter().take(SHOWN).map(String::as_str).collect();
    let more = format!("{} more", diagram.grouped.len().saturating_sub(SHOWN));
    if diagram.grouped.len() > SHOWN {
        words.push(&more);
    }
    let otherwise = if asked { "" } else { "; --no-group draws every node" };
    format!("one box each: {}{otherwise}", words.join("; "))
}
