//! The work in progress: the network as far as it is built, and everything found on the way.

use foldhash::{HashMap, HashSet};
use lptn_data::{Diagnostic, Span};
use lptn_network::{
    BuildError, BuildErrorKind, FluidId, Input, Item, MaterialId, Naming, NetworkBuilder,
};
use lptn_units::{Quantity, Type};

use crate::compiled::Compiled;
use crate::csv_files::CsvFiles;
use crate::format::NetlistFormat;
use crate::gearbox::Gears;
use crate::initial::StateFile;
use crate::names::Names;
use crate::raw::{RawEntry, RawNetlist};
use crate::scales::Scales;
use crate::source_map::SourceMap;
use crate::template::Structure;
use crate::texture::Texture;

/// Work in progress: the network as far as it is built, and everything found on the way.
pub(crate) struct Elaboration<'a> {
    pub(crate) raw: &'a RawNetlist,
    /// The sections there are.
    pub(crate) format: &'static NetlistFormat,
    /// The expanded templates.
    pub(crate) structure: &'a Structure,
    /// The expanded gearboxes.
    pub(crate) gears: &'a Gears,
    pub(crate) csv: &'a CsvFiles,
    /// The state that the run starts from.
    pub(crate) state: Option<&'a StateFile>,
    pub(crate) builder: NetworkBuilder,
    pub(crate) map: SourceMap,
    pub(crate) names: Names,
    pub(crate) problems: Vec<Diagnostic>,
    /// Number of problems of imported rows that were not recorded.
    pub(crate) dropped: usize,
    pub(crate) left_out: LeftOut,
    pub(crate) scales: Scales,
    pub(crate) compiled: Compiled,
    /// Materials by name: those of the file, and those of the library that are used.
    pub(crate) known: HashMap<String, Known>,
    /// Fluids by name, in the same way.
    pub(crate) known_fluids: HashMap<String, KnownFluid>,
    /// Materials and fluids that something names, by section.
    pub(crate) used: HashSet<(&'static str, String)>,
}

/// Parts that were left out because of an error, so that their absence is not another error.
#[derive(Debug, Default)]
pub(crate) struct LeftOut {
    /// A section is unknown or not a table: missing names may be in it.
    pub(crate) sections: bool,
    /// `format = 1` below a heading: it is not an element of that section.
    pub(crate) format: Option<Span>,
    /// A path is missing: islands cannot be determined.
    pub(crate) paths: bool,
    /// A part of a capacity is missing: nodes may only seem to have none.
    pub(crate) parts: bool,
    /// Items with unknown keys or missing values.
    pub(crate) items: HashSet<Item>,
}

impl LeftOut {
    /// The parts that may be missing because a use could not be read.
    pub(crate) fn of(structure: &Structure) -> Self {
        let lost = structure.has_lost();
        Self { sections: lost, paths: lost, parts: lost, ..Self::default() }
    }

    pub(crate) fn cover(&self, error: &BuildError) -> bool {
        use BuildErrorKind as K;
        let item = error.place().is_some_and(|(item, _)| self.items.contains(&item));
        match error.kind {
            K::NoCapacity { .. } => item || self.parts,
            K::NoInitialTemperature { .. }
            | K::MasslessWithCapacity { .. }
            | K::NoThermostat { .. }
            | K::NoRate { .. } => item,
            K::FloatingIsland { ref nodes, .. } => {
                self.paths
                    || self.parts
                    || nodes.iter().any(|&n| self.items.contains(&Item::Node(n)))
            }
            K::Empty => self.sections,
            _ => false,
        }
    }
}

/// A material in use or ready to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    pub(crate) id: MaterialId,
    pub(crate) density: bool,
    pub(crate) cp: bool,
    pub(crate) k: bool,
    pub(crate) texture: Texture,
}

/// A fluid in use or ready to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KnownFluid {
    pub(crate) id: FluidId,
    pub(crate) density: bool,
}

impl<'a> Elaboration<'a> {
    /// The elements of a section, in file order.
    pub(crate) fn elements(&self, kind: &str) -> &'a [RawEntry] {
        self.raw.elements(kind)
    }

    /// The section of the element of this name, imported ones included.
    pub(crate) fn kind_of(&self, name: &str) -> Option<&'static str> {
        let imported = || self.builder.item(name).map(|item| self.map.kind(item));
        self.names.kind_of(name).or_else(imported)
    }

    pub(crate) fn report(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }
}

/// A value instead of one that has been reported.
pub(crate) fn stand_in(ty: Type) -> Input {
    Quantity { value: 1.0, deviation: None, ty }.into()
}
