//! A network as a flat netlist in SI units: no includes, no templates, every value where it
//! belongs.
//!
//! It is written from the network that was built, not from the text that was read. So every element
//! appears as itself, whatever made it. The result can be read again.
//!
//! The expansion shows the network that is computed, not the intention of the file. Grids and
//! imports go to the builder directly. One writer serves the expansion and the networks that are
//! derived from a netlist.

mod controls;
mod elements;
mod flat;
mod pipes;
mod proof;
mod questions;
mod states;
mod substances;
mod values;

use std::path::{Component, Path, PathBuf};

use lptn_data::FileId;
use lptn_network::{Network, RunSettings};

use crate::netlist::Netlist;
use crate::toml_text::{TomlFields, string};
pub use proof::{WrittenError, prove};

/// A network that was derived from that of a netlist, with its title, run and folder.
#[derive(Clone, Copy, Debug)]
pub struct Derived<'a> {
    /// The network; its tables are those of the netlist.
    pub network: &'a Network,
    /// Its title.
    pub title: &'a str,
    /// The run that goes with it.
    pub run: Option<&'a RunSettings>,
    /// The folder of the text, which paths of CSV files are relative to; `None` for the folder of
    /// the netlist.
    pub folder: Option<&'a Path>,
}

/// The netlist as far as it is written.
struct Writer<'n> {
    network: &'n Network,
    /// The netlist that the network comes from, for facts that only a file contains.
    origin: &'n Netlist,
    /// The folder that paths are relative to.
    folder: PathBuf,
    text: String,
}

impl<'n> Writer<'n> {
    fn new(network: &'n Network, origin: &'n Netlist, folder: Option<&Path>) -> Self {
        let own = || origin.inputs().next().map(|(name, _)| parent(name)).unwrap_or_default();
        let folder = folder.map_or_else(own, Path::to_owned);
        Self { network, origin, folder, text: "format = 1\n".to_owned() }
    }

    fn title(&mut self, title: &str) {
        self.text += &format!("title = {}\n", string(title));
    }

    /// A path of a file, as the text has to name it.
    fn path(&self, file: FileId, path: &str) -> String {
        if Path::new(path).is_absolute() {
            return path.to_owned();
        }
        let path = parent(self.origin.files.name(file)).join(path);
        relative(&path, &self.folder).display().to_string()
    }
}

fn parent(file: &str) -> PathBuf {
    Path::new(file).parent().unwrap_or(Path::new("")).to_owned()
}

/// A path as it is named from a folder.
fn relative(path: &Path, folder: &Path) -> PathBuf {
    if let Ok(inside) = path.strip_prefix(folder) {
        return inside.to_owned();
    }
    let (Ok(path), Ok(folder)) = (std::path::absolute(path), std::path::absolute(folder)) else {
        return path.to_owned();
    };
    let (path, folder) = (resolved(&path), resolved(&folder));
    let shared = path.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(path.components().skip(shared)).collect()
}

/// An absolute path without `..`.
fn resolved(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut all, part| {
        match part {
            Component::ParentDir => drop(all.pop()),
            Component::CurDir => {}
            part => all.push(part),
        }
        all
    })
}

impl Netlist {
    /// The network as a flat netlist, with everything that was set. Includes, templates and other
    /// short forms are written out, quantities are in SI units, temperatures in K. Parameters and
    /// expressions are kept. Materials of the library are named; those of the file are written if
    /// they are used. Read again, it is the same network and is written as the same text.
    ///
    /// A table of two arguments, and a fit, still name their CSV files, which have to be next to
    /// the text.
    pub fn expanded(&self) -> String {
        let mut writer = Writer::new(&self.network, self, None);
        if let Some(title) = self.network.title() {
            writer.title(title);
        }
        writer.elements();
        writer.run();
        writer.uncertainty();
        writer.studies();
        writer.text
    }

    /// A network that was made from this one as a flat netlist, in the same form, with its run.
    pub fn derived(&self, made: &Derived<'_>) -> String {
        let mut writer = Writer::new(made.network, self, made.folder);
        writer.title(made.title);
        writer.elements();
        made.run.into_iter().for_each(|run| writer.settings(run));
        writer.text
    }
}

impl Writer<'_> {
    /// All elements, without run and studies.
    fn elements(&mut self) {
        self.parameters();
        self.tables();
        self.signals();
        self.default();
        self.materials();
        self.fluids();
        self.lubricants();
        self.fans();
        self.nodes();
        self.capacitors();
        self.boundaries();
        self.controls();
        self.states();
        self.named_values();
        self.conductors();
        self.pipes();
        self.limits();
    }

    /// A section with one line for each element; none if it is empty.
    fn section(&mut self, heading: &str, fields: &TomlFields) {
        if !fields.is_empty() {
            self.text += &format!("\n[{heading}]\n{}", fields.lines());
        }
    }
}
