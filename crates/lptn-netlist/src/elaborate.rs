//! [`RawNetlist`] to network: every element is read by itself, so that all problems are found at once.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use lptn_data::{Diagnostic, Severity, Span};
use lptn_network::{BuildError, BuildErrorKind, Input, Item, Naming, Network, NetworkBuilder};
use lptn_units::{Quantity, Type, Unit};

use crate::adrift;
use crate::csv_files::CsvFiles;
use crate::describe::describe;
use crate::fit::FitStudy;
use crate::initial::StateFile;
use crate::names::{Names, ValueKind};
use crate::raw::{RawEntry, RawNetlist};
use crate::run::RunPlan;
use crate::scales::Scales;
use crate::section;
use crate::size::SizeStudy;
use crate::source_map::SourceMap;
use crate::template::Structure;

pub(crate) const MISSING_FORMAT: &str = "netlist::missing_format";

/// What a netlist means.
pub(crate) struct Elaborated {
    pub(crate) network: Network,
    pub(crate) run: Option<RunPlan>,
    pub(crate) sizes: Vec<SizeStudy>,
    pub(crate) fits: Vec<FitStudy>,
    pub(crate) map: SourceMap,
    pub(crate) temperature_unit: Unit,
    pub(crate) structure: Arc<Structure>,
}

/// Work in progress: the network as far as it is built, and everything found on the way.
pub(crate) struct Elaboration<'a> {
    pub(crate) raw: &'a RawNetlist,
    /// What templates made of it.
    pub(crate) structure: &'a Structure,
    pub(crate) csv: &'a CsvFiles,
    /// The state that the run starts from.
    pub(crate) state: Option<&'a StateFile>,
    pub(crate) builder: NetworkBuilder,
    pub(crate) map: SourceMap,
    pub(crate) names: Names,
    pub(crate) problems: Vec<Diagnostic>,
    /// How many problems of imported rows were not even written down.
    pub(crate) dropped: usize,
    pub(crate) doubts: Doubts,
    pub(crate) scales: Scales,
    /// Materials by name: those of the file, and those of the library that are used.
    pub(crate) known: HashMap<String, section::Known>,
    pub(crate) used_materials: HashSet<String>,
    /// Fluids by name, in the same way.
    pub(crate) known_fluids: HashMap<String, section::KnownFluid>,
    pub(crate) used_fluids: HashSet<String>,
}

/// What was left out because of an error, so that its absence is not reported as another one.
#[derive(Debug, Default)]
pub(crate) struct Doubts {
    /// A section is not known or not a table: what it holds may be what is missing.
    pub(crate) sections: bool,
    /// `format = 1` below a heading: it is no element of that section.
    pub(crate) format: Option<Span>,
    /// A path is missing: islands cannot be told.
    pub(crate) paths: bool,
    /// A part of a capacity is missing: nodes may only seem to have none.
    pub(crate) parts: bool,
    /// Items with unknown keys or missing values.
    pub(crate) items: HashSet<Item>,
}

impl Doubts {
    /// What an instance would have held may be what is missing.
    fn of(structure: &Structure) -> Self {
        let lost = structure.has_lost();
        Self { sections: lost, paths: lost, parts: lost, ..Self::default() }
    }

    fn cover(&self, error: &BuildError) -> bool {
        use BuildErrorKind as K;
        let item = error.place().is_some_and(|(item, _)| self.items.contains(&item));
        match error.kind {
            K::NoCapacity { .. } => item || self.parts,
            K::NoInitialTemperature { .. } | K::MasslessWithCapacity { .. } | K::NoThermostat { .. } => item,
            K::FloatingIsland { ref nodes, .. } => {
                self.paths || self.parts || nodes.iter().any(|&n| self.items.contains(&Item::Node(n)))
            }
            K::Empty => self.sections,
            _ => false,
        }
    }
}

/// What was found on the way.
pub(crate) struct Found {
    pub(crate) problems: Vec<Diagnostic>,
    /// How many more there are that were not written down.
    pub(crate) dropped: usize,
}

/// So many problems of the network as a whole are described.
const MOST_DESCRIBED: usize = 1000;

/// The network, or every reason why there is none. Warnings come with either.
pub(crate) fn elaborate(
    raw: &RawNetlist,
    structure: &Arc<Structure>,
    csv: &CsvFiles,
    state: Option<&StateFile>,
) -> (Option<Elaborated>, Found) {
    let mut work = Elaboration {
        raw,
        structure,
        csv,
        state,
        builder: NetworkBuilder::new(),
        map: SourceMap::default(),
        names: Names::of(raw, structure),
        problems: Vec::new(),
        dropped: 0,
        doubts: Doubts::of(structure),
        scales: Scales::default(),
        known: HashMap::new(),
        used_materials: HashSet::new(),
        known_fluids: HashMap::new(),
        used_fluids: HashSet::new(),
    };
    work.map.set_top(raw.top.span.clone());
    work.top_level();
    work.tables();
    work.parameters();
    work.signals();
    let controls = work.controls();
    let default = work.defaults();
    work.materials();
    work.fluids();
    let import = work.import();
    work.nodes(default.initial.as_ref());
    work.import_nodes(import.as_ref(), default.initial.as_ref());
    work.grids(default.initial.as_ref());
    work.boundaries();
    work.import_boundaries(import.as_ref());
    work.connections();
    work.thermostats(controls);
    work.capacitors();
    work.conductors();
    work.import_conductors(import.as_ref());
    work.sources();
    work.import_sources(import.as_ref());
    work.check_state();
    work.start_the_others();
    work.limits();
    let run = work.run();
    let sizes = work.sizes();
    let fits = work.fits();
    work.finish((run, sizes, fits), default)
}

impl<'a> Elaboration<'a> {
    /// The elements of a section, in file order.
    pub(crate) fn elements(&self, kind: &str) -> &'a [RawEntry] {
        crate::names::section(self.raw, kind).map_or(&[], |table| &table.entries)
    }

    /// The section of the element of this name, imported ones included.
    pub(crate) fn kind_of(&self, name: &str) -> Option<&'static str> {
        let imported = || self.builder.item(name).map(|item| self.map.kind(item));
        self.names.kind_of(name).or_else(imported)
    }

    pub(crate) fn report(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    fn finish(
        mut self,
        (run, sizes, fits): (Option<RunPlan>, Vec<SizeStudy>, Vec<FitStudy>),
        default: section::Default<'_>,
    ) -> (Option<Elaborated>, Found) {
        let mut substances = self.unused_materials();
        substances.extend(self.unused_fluids());
        let (map, doubts) = (&self.map, &self.doubts);
        let network = match self.builder.build() {
            Ok(network) => Some(network),
            Err(errors) => {
                let mut new = errors.0.iter().filter(|error| !doubts.cover(error));
                self.problems.extend(new.by_ref().take(MOST_DESCRIBED).map(|error| describe(error, map)));
                self.dropped += new.count();
                None
            }
        };
        if let Some(format) = &self.doubts.format {
            self.problems
                .retain(|p| p.code == MISSING_FORMAT || !p.place().is_some_and(|at| at.is_inside(format)));
        }
        if self.problems.iter().any(|problem| problem.severity == Severity::Error) {
            // what is odd may follow from what is wrong
            self.problems.retain(|problem| problem.severity == Severity::Error);
            return (None, Found { problems: self.problems, dropped: self.dropped });
        }
        self.problems.extend(substances);
        self.problems.extend(self.scales.doubts());
        let values = self.names.unused().map(|(kind, name, span)| unused(kind, name, span));
        self.problems.extend(values);
        if let Some(network) = &network {
            let is_read = |name: &str| self.names.reads(name);
            self.problems.extend(adrift::warnings(network, &self.map, &is_read));
        }
        let temperature_unit = default.temperature_unit;
        let (map, structure) = (self.map, self.names.structure);
        let done =
            network.map(|network| Elaborated { network, run, sizes, fits, map, temperature_unit, structure });
        (done, Found { problems: self.problems, dropped: self.dropped })
    }
}

/// A value in place of one that has been reported.
pub(crate) fn stand_in(ty: Type) -> Input {
    Quantity { value: 1.0, deviation: None, ty }.into()
}

fn unused(kind: ValueKind, name: &str, span: &Span) -> Diagnostic {
    let code = match kind {
        ValueKind::Parameter => "netlist::unused_parameter",
        ValueKind::Signal => "netlist::unused_signal",
        ValueKind::Control => "netlist::unused_control",
        ValueKind::Table => "netlist::unused_table",
    };
    Diagnostic::warning(code, format!("nothing uses {} `{name}`", kind.word()))
        .at(span.clone(), "")
        .help("use it or remove it; a misspelt name elsewhere may be the cause")
}
