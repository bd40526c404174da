//! The temperatures in a grid.

use lptn_graph::{GridField, NoSlice, Shades};
use lptn_netlist::{Diagnostic, Files, Span};
use lptn_network::GridId;
use lptn_report::Shortest;
use lptn_units::{Problem as _, Unit};

use super::kind::Kind;
use super::{Asked, Parts, picture};
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::input::{Input, wrong_unit};

/// The file of a grid.
pub(super) fn written(asked: &mut Asked<'_>) -> Result<Parts, Failure> {
    let (question, input) = (asked.question, asked.input);
    let (kind, id) = (question.kind, grid(input, question.grid.as_deref())?);
    let network = &input.netlist.network;
    let name = &network.grids()[id.index()].name;
    // the question is checked before anything is computed
    let shape = GridField::of(network, id, None);
    let cut = match &question.slice {
        Some(text) => Some(shape.cut(text).map_err(|error| no_slice(text, &error))?),
        None if kind.is_of_grid() => None,
        None => return Err(which_slice(name, &shape)),
    };
    let state = asked.state()?;
    let (field, unit) = (GridField::of(network, id, Some(&state)), &asked.unit);
    let title = input.title();
    let ending = kind.ending();
    let (bytes, name) = match (kind, cut) {
        (Kind::Vtk, _) => {
            (lptn_graph::vtk(&field, &title, unit).into_bytes(), format!("{name}.{ending}"))
        }
        (_, Some(cut)) => {
            let scene = lptn_graph::slice(&field, cut, (&title, unit), Shades::default());
            let axis = field.form.directions()[cut.axis];
            (picture(kind, &scene)?, format!("{name}_{axis}{}.{ending}", cut.layer + 1))
        }
        (_, None) => (csv(&field, unit).into_bytes(), format!("{name}.{ending}")),
    };
    Ok((bytes, name, None))
}

/// One line per cell: its name, the place of its node, its temperature.
fn csv(field: &GridField, unit: &Unit) -> String {
    let mut number = Shortest::new();
    let [a, b, c] = field.form.directions();
    let (angle, factor) = if field.is_round() { ("deg", 1_f64.to_degrees()) } else { ("m", 1.0) };
    let mut out = format!("cell,{a} [m],{b} [{angle}],{c} [m],T [{}]\n", unit.text);
    for at in field.places() {
        out.push_str(&format!("\"{}\"", field.cell(at)));
        let [x, y, z] = field.centre(at);
        for value in [x, y * factor, z, unit.from_si(field.at(at))] {
            out.push(',');
            out.push_str(number.text(value));
        }
        out.push('\n');
    }
    out
}

/// The grid of this name, or the only one.
fn grid(input: &Input, name: Option<&str>) -> Result<GridId, Failure> {
    let network = &input.netlist.network;
    let file = &input.text.name;
    let names = || network.grids().iter().map(|grid| grid.name.as_str());
    let list = || names().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let found = match name {
        Some(name) => names().position(|known| known == name),
        None => (network.grids().len() == 1).then_some(0),
    };
    if let Some(id) = found.and_then(|at| network.grid_ids().nth(at)) {
        return Ok(id);
    }
    let problem = |message: String| Diagnostic::error("graph::grid", message);
    let problem = match (name, network.grids().len()) {
        (_, 0) => problem(format!("{file} has no grid"))
            .help("leave --slice, --grid and formats of grids out: the network is drawn then"),
        (Some(name), _) => {
            problem(format!("{file} has no [grid.{name}]"))
                .did_you_mean(name, names(), || format!("name one of {}", list()))
        }
        (None, _) => {
            problem(format!("{file} has several grids")).help(format!("--grid NAME: {}", list()))
        }
    };
    Err(Failure::new(Exit::Input, problem))
}

fn which_slice(name: &str, shape: &GridField) -> Failure {
    let message = format!("no slice of `{name}` is chosen");
    let axis = if shape.is_round() { 1 } else { 2 };
    let (letter, layers) = (shape.form.directions()[axis], shape.cells[axis]);
    let help = format!(
        "add --slice {letter}=1, at most {letter}={layers}, or write the whole grid: --format vtk"
    );
    Failure::refused("graph::slice", message, help)
}

fn no_slice(text: &str, error: &NoSlice) -> Failure {
    if let NoSlice::NotASlice { why: Some(why), .. } = error
        && let Some((_, place)) = text.split_once('=')
    {
        return wrong_unit("--slice", place.trim(), why);
    }
    let mut files = Files::new();
    let file = files.add("--slice", text);
    let problem = told(error).at(Span::new(file, 0..text.len()), "");
    Failure::at(error.class().into(), files, problem)
}
