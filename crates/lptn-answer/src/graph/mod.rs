//! A drawing of a network, of its heat flows, or of the temperatures in a grid.

mod field;
mod kind;

pub use kind::Kind;

use std::sync::Arc;

use lptn_graph::{Diagram, Grouping, Laid, View};
use lptn_netlist::{Diagnostic, Files};
use lptn_plot::{Scene, png, svg};
use lptn_solve::Snapshot;
use lptn_units::Unit;

use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::operating_point::{at, steady};

/// Pixels of a PNG per pixel of the drawing: 192 per inch.
const SCALE: f64 = 2.0;

/// The question for a drawing of a network, of its heat flows, or of the temperatures in a grid.
#[derive(Clone, Debug, Default)]
pub struct GraphQuestion {
    /// Format of the file.
    pub kind: Kind,
    /// The temperatures and heat flows on it.
    pub state: Drawn,
    /// True if heat flows are bands of their width.
    pub sankey: bool,
    /// True if each grid, instance and family is one box; `None` for true if there are many nodes.
    pub group: Option<bool>,
    /// The layer of a grid that is drawn, by number or place: `z=3`, `z=5 mm`.
    /// `None` for the network, or the whole grid.
    pub slice: Option<String>,
    /// The grid; `None` for the only one.
    pub grid: Option<String>,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
}

/// Temperatures and heat flows that are drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Drawn {
    /// None on the network; those of the steady state in grids and on bands.
    #[default]
    Usual,
    /// Those of the steady state.
    Steady,
    /// Those at a time of the run: `10min`.
    At(String),
}

/// A drawing as it is written.
#[derive(Debug)]
pub struct GraphAnswer {
    input: Arc<Input>,
    /// The file.
    pub bytes: Vec<u8>,
    /// Its usual name: `graph.svg`.
    pub name: String,
    /// Note on the groups that are one box each, and on the option against it.
    pub note: Option<String>,
    /// Doubts in the temperatures.
    doubts: Vec<Diagnostic>,
}

/// The question with its netlist and unit.
struct Asked<'a> {
    question: &'a GraphQuestion,
    input: &'a Input,
    unit: Unit,
    listener: &'a dyn Listener,
    doubts: Vec<Diagnostic>,
}

/// A file, its usual name, and a note on groups.
type Parts = (Vec<u8>, String, Option<String>);

impl GraphQuestion {
    /// Asks a netlist. The listener hears doubts as they come up.
    ///
    /// # Errors
    /// A grid or layer that does not exist, a state that cannot be computed, and a drawing that
    /// would be too large.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<GraphAnswer, Failure> {
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), &input.netlist)?;
        listener.warn(&input.netlist.files, &input.netlist.warnings);
        let mut asked = Asked { question: self, input: &input, unit, listener, doubts: Vec::new() };
        let (bytes, name, note) =
            if self.is_of_grid() { field::written(&mut asked)? } else { asked.network()? };
        let doubts = asked.doubts;
        Ok(GraphAnswer { input, bytes, name, note, doubts })
    }

    /// True if a grid is drawn instead of the network.
    pub fn is_of_grid(&self) -> bool {
        self.slice.is_some() || self.grid.is_some() || self.kind.is_of_grid()
    }

    /// True if temperatures and heat flows are drawn on the network.
    pub fn shows_state(&self) -> bool {
        self.sankey || self.state != Drawn::Usual
    }
}

impl GraphAnswer {
    /// The files that places of doubts are in.
    pub fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    /// All doubts in it, those of the netlist first.
    pub fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts].concat()
    }
}

impl Asked<'_> {
    /// The state at the requested time, else the steady state.
    fn state(&mut self) -> Result<Snapshot, Failure> {
        let (state, doubts) = match &self.question.state {
            Drawn::At(text) => at(text, self.input, self.listener)?,
            _ => {
                let (steady, doubts) = steady(self.input, &self.unit)?;
                (steady.state, doubts)
            }
        };
        self.listener.warn(&self.input.netlist.files, &doubts);
        self.doubts = doubts;
        Ok(state)
    }

    /// The file of the network.
    fn network(&mut self) -> Result<Parts, Failure> {
        let diagram = self.diagram()?;
        let (kind, sankey) = (self.question.kind, self.question.sankey);
        let bytes = match kind {
            Kind::Dot => lptn_graph::dot(&diagram).into_bytes(),
            Kind::Mermaid => lptn_graph::mermaid(&diagram).into_bytes(),
            _ if sankey => {
                let scene = Laid::of(&diagram).sankey();
                picture(kind, &scene.map_err(|error| Failure::of(&error))?)?
            }
            _ => {
                let scene = Laid::of(&diagram).scene();
                picture(kind, &scene.map_err(|error| Failure::of(&error))?)?
            }
        };
        let asked = self.question.group == Some(true);
        let note = (!diagram.grouped.is_empty()).then(|| grouped(&diagram, asked));
        let name = if sankey { "sankey" } else { "graph" };
        Ok((bytes, format!("{name}.{}", kind.ending()), note))
    }

    fn diagram(&mut self) -> Result<Diagram, Failure> {
        let grouping = match self.question.group {
            Some(true) => Grouping::Yes,
            Some(false) => Grouping::No,
            None => Grouping::Auto,
        };
        let state = self.question.shows_state().then(|| self.state()).transpose()?;
        let title = self.input.title();
        let view = View {
            title: &title,
            grouping,
            unit: &self.unit,
            state: state.as_ref(),
            marked: false,
        };
        Ok(lptn_graph::diagram(&self.input.netlist.network, &view))
    }
}

/// A drawing as a picture.
fn picture(kind: Kind, scene: &Scene) -> Result<Vec<u8>, Failure> {
    if kind != Kind::Png {
        return Ok(svg::write(scene).into_bytes());
    }
    png::write(scene, SCALE).map_err(|error| Failure::of(&error))
}

/// Note on the groups that are one box each, and on the option against it.
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
