//! [`RawNetlist`] to network: every element is read by itself, so that all problems are found at once.

use std::collections::{HashMap, HashSet};

use lptn_network::{BuildError, BuildErrorKind, End, Input, Item, Network, NetworkBuilder};
use lptn_units::{Quantity, Type, Unit};

use crate::csv_file::CsvFiles;
use crate::describe::describe;
use crate::diagnostic::{Diagnostic, Severity};
use crate::file::Span;
use crate::names::{Names, ValueKind};
use crate::raw::{RawEntry, RawNetlist};
use crate::run::RunPlan;
use crate::section;
use crate::size::SizeStudy;
use crate::source_map::SourceMap;

pub(crate) const MISSING_FORMAT: &str = "netlist::missing_format";

/// What a netlist means.
pub(crate) struct Elaborated {
    pub(crate) network: Network,
    pub(crate) run: Option<RunPlan>,
    pub(crate) sizes: Vec<SizeStudy>,
    pub(crate) map: SourceMap,
    pub(crate) temperature_unit: Unit,
}

/// Work in progress: the network as far as it is built, and everything found on the way.
pub(crate) struct Elaboration<'a> {
    pub(crate) raw: &'a RawNetlist,
    pub(crate) csv: &'a CsvFiles,
    pub(crate) builder: NetworkBuilder,
    pub(crate) map: SourceMap,
    pub(crate) names: Names,
    /// Nodes and boundaries by name.
    pub(crate) ends: HashMap<&'a str, (End, &'a Span)>,
    pub(crate) problems: Vec<Diagnostic>,
    pub(crate) doubts: Doubts,
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
    fn cover(&self, error: &BuildError) -> bool {
        use BuildErrorKind as K;
        let item = error.place().is_some_and(|(item, _)| self.items.contains(&item));
        match error.kind {
            K::NoCapacity { .. } => item || self.parts,
            K::NoInitialTemperature { .. } | K::MasslessWithCapacity { .. } => item,
            K::FloatingIsland { ref nodes, .. } => {
                self.paths || self.parts || nodes.iter().any(|&n| self.items.contains(&Item::Node(n)))
            }
            K::Empty => self.sections,
            _ => false,
        }
    }
}

/// The network, or every reason why there is none. Warnings come with either.
pub(crate) fn elaborate(raw: &RawNetlist, csv: &CsvFiles) -> (Option<Elaborated>, Vec<Diagnostic>) {
    let mut work = Elaboration {
        raw,
        csv,
        builder: NetworkBuilder::new(),
        map: SourceMap::default(),
        names: Names::of(raw),
        ends: HashMap::new(),
        problems: Vec::new(),
        doubts: Doubts::default(),
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
    let default = work.defaults();
    work.materials();
    work.fluids();
    work.nodes(default.initial.as_ref());
    work.boundaries();
    work.capacitors();
    work.conductors();
    work.sources();
    work.limits();
    let run = work.run();
    let sizes = work.sizes();
    work.finish((run, sizes), default)
}

impl<'a> Elaboration<'a> {
    /// The elements of a section, in file order.
    pub(crate) fn elements(&self, kind: &str) -> &'a [RawEntry] {
        crate::names::section(self.raw, kind).map_or(&[], |table| &table.entries)
    }

    pub(crate) fn report(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    fn finish(
        mut self,
        (run, sizes): (Option<RunPlan>, Vec<SizeStudy>),
        default: section::Default<'_>,
    ) -> (Option<Elaborated>, Vec<Diagnostic>) {
        let mut substances = self.unused_materials();
        substances.extend(self.unused_fluids());
        let (map, doubts) = (&self.map, &self.doubts);
        let network = match self.builder.build() {
            Ok(network) => Some(network),
            Err(errors) => {
                let new = errors.0.iter().filter(|error| !doubts.cover(error));
                self.problems.extend(new.map(|error| describe(error, map)));
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
            return (None, self.problems);
        }
        self.problems.extend(substances);
        self.problems.extend(self.names.unused().map(|(kind, name, span)| unused(kind, name, span)));
        let temperature_unit = default.temperature_unit;
        let done = network.map(|network| Elaborated { network, run, sizes, map: self.map, temperature_unit });
        (done, self.problems)
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
        ValueKind::Table => "netlist::unused_table",
    };
    Diagnostic::warning(code, format!("nothing uses {} `{name}`", kind.word()))
        .at(span.clone(), "")
        .help("use it or remove it; a misspelt name elsewhere may be the cause")
}
