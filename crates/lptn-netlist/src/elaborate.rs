//! [`RawNetlist`] to network: every element is read by itself, so that all problems are found at
//! once.
//!
//! Netlists are read by hand from the TOML tree with spans, not by serde's derive. serde stops at
//! the first problem of an element and loses spans in tagged and flattened forms. lptn reports all
//! problems, with the places of key and value.

use std::sync::Arc;

use foldhash::{HashMap, HashMapExt as _, HashSet, HashSetExt as _};
use lptn_data::{Diagnostic, Severity, Span};
use lptn_network::{Network, NetworkBuilder};
use lptn_units::Unit;

use crate::adrift;
use crate::compiled::Compiled;
use crate::csv_files::CsvFiles;
use crate::describe::describe;
use crate::gearbox::Gears;
use crate::head::MISSING_FORMAT;
use crate::initial::StateFile;
use crate::names::{Names, ValueKind};
use crate::raw::{RawEntry, RawNetlist};
use crate::run::RunPlan;
use crate::scales::Scales;
use crate::section::{self, Studies};
use crate::source_map::SourceMap;
use crate::template::Structure;
use crate::uncertainty::UncertaintyPlan;
use crate::work::{Elaboration, LeftOut};

/// The network of a netlist with everything else that the text defines.
pub(crate) struct Elaborated {
    pub(crate) network: Network,
    pub(crate) run: Option<RunPlan>,
    pub(crate) studies: Studies,
    pub(crate) uncertainty: UncertaintyPlan,
    pub(crate) map: SourceMap,
    pub(crate) temperature_unit: Unit,
    pub(crate) structure: Arc<Structure>,
    /// Parameters that only temperatures use which the state of a run replaces.
    pub(crate) without_effect: Vec<String>,
}

/// Problems found during elaboration.
pub(crate) struct Found {
    pub(crate) problems: Vec<Diagnostic>,
    /// Number of further problems that were not recorded.
    pub(crate) dropped: usize,
}

/// Largest number of problems of the network as a whole that are described.
const MOST_DESCRIBED: usize = 1000;

/// The network, or every error that prevents it. Warnings come with either.
pub(crate) fn elaborate(
    raw: &RawNetlist,
    (structure, gears, pipes): (&Arc<Structure>, &Gears, &[RawEntry]),
    csv: &CsvFiles,
    state: Option<&StateFile>,
) -> (Option<Elaborated>, Found) {
    let mut work = Elaboration {
        raw,
        format: section::format(),
        structure,
        gears,
        csv,
        state,
        builder: NetworkBuilder::new(),
        map: SourceMap::of(raw),
        names: Names::of(raw, structure, section::format()),
        problems: Vec::new(),
        dropped: 0,
        left_out: LeftOut::of(structure),
        scales: Scales::default(),
        compiled: Compiled::default(),
        known: HashMap::new(),
        known_fluids: HashMap::new(),
        used: HashSet::new(),
    };
    work.names.used.extend(gears.types.keys().cloned());
    work.map.set_top(raw.top.span.clone());
    work.top_level();
    work.tables();
    work.lubricants();
    work.fans();
    work.parameters();
    work.signals();
    let controls = work.controls();
    let default = work.defaults();
    work.materials();
    work.fluids();
    let import = work.import();
    let follow_states = work.nodes(default.initial.as_ref());
    work.import_nodes(import.as_ref(), default.initial.as_ref());
    work.grids(default.initial.as_ref());
    work.streams_along();
    work.boundaries();
    work.import_boundaries(import.as_ref());
    let states = work.states();
    work.named_values();
    work.capacities_of_states(follow_states);
    work.pipes(pipes, default.initial.as_ref());
    work.connections();
    work.thermostats(controls);
    work.capacitors();
    work.conductors();
    work.import_conductors(import.as_ref());
    work.sources();
    work.import_sources(import.as_ref());
    work.state_laws(states);
    work.check_state();
    work.start_the_others();
    work.limits();
    let run = work.run();
    let studies = Studies::read(&mut work);
    let uncertainty = work.uncertainty();
    work.finish((run, studies, uncertainty), default)
}

impl<'a> Elaboration<'a> {
    fn finish(
        mut self,
        (run, studies, uncertainty): (Option<RunPlan>, Studies, UncertaintyPlan),
        default: section::Default<'_>,
    ) -> (Option<Elaborated>, Found) {
        let substances = self.unused_substances();
        let (map, doubts) = (&self.map, &self.left_out);
        let network = match self.builder.build() {
            Ok(network) => Some(network),
            Err(errors) => {
                let mut new = errors.0.iter().filter(|error| !doubts.cover(error));
                self.problems
                    .extend(new.by_ref().take(MOST_DESCRIBED).map(|error| describe(error, map)));
                self.dropped += new.count();
                None
            }
        };
        if let Some(format) = &self.left_out.format {
            self.problems.retain(|p| {
                p.code == MISSING_FORMAT || !p.place().is_some_and(|at| at.is_inside(format))
            });
        }
        if self.problems.iter().any(|problem| problem.severity == Severity::Error) {
            // warnings may follow from errors
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
        let without_effect = self.names.without_effect().cloned().collect();
        let (map, structure) = (self.map, self.names.structure);
        let done = network.map(|network| Elaborated {
            network,
            run,
            studies,
            uncertainty,
            map,
            temperature_unit,
            structure,
            without_effect,
        });
        (done, Found { problems: self.problems, dropped: self.dropped })
    }
}

fn unused(kind: ValueKind, name: &str, span: &Span) -> Diagnostic {
    let code = match kind {
        ValueKind::Parameter => "netlist::unused_parameter",
        ValueKind::Signal => "netlist::unused_signal",
        ValueKind::Control => "netlist::unused_control",
        ValueKind::Table => "netlist::unused_table",
        ValueKind::State | ValueKind::Value => "netlist::unused_value",
    };
    Diagnostic::doubt(
        code,
        format!("nothing uses {} `{name}`", kind.word()),
        span,
        "use it or remove it; a misspelt name elsewhere may be the cause",
    )
}
