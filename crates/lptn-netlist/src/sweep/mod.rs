//! `[sweep.NAME]`: many candidates, and what is reported of each.

mod axis;
mod declaration;
mod measure;
mod plan;
mod read;
mod write;

use lptn_data::{Diagnostic, Span};
use lptn_network::{Network, Value};
use lptn_units::Type;

use crate::format::SectionDeclaration;
use crate::raw::{RawKind, RawNetlist, RawValue};
use crate::study::{PathFrom, Study};
use crate::toml_text::TomlFields;
use crate::work::Elaboration;
use axis::AxisValues;
use declaration::SWEEP;

pub use measure::{Functional, Measure};
pub use plan::{AxisNumbers, MOST_CASES, SweepPlan};

/// How the candidates of a sweep are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepMethod {
    /// Every combination of the values of all axes, the last axis fastest.
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    List,
    /// The rows of a file.
    Csv,
    /// Samples of which each axis has one in each of as many cells.
    LatinHypercube,
    /// Points of a scrambled Sobol sequence.
    Sobol,
}

impl SweepMethod {
    /// The words for them.
    pub const WORDS: [(&str, Self); 5] = [
        ("grid", Self::Grid),
        ("list", Self::List),
        ("csv", Self::Csv),
        ("latin_hypercube", Self::LatinHypercube),
        ("sobol", Self::Sobol),
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::WORDS.into_iter().find(|(_, method)| *method == self).map_or("", |(word, _)| word)
    }

    /// Whether the candidates are sampled from ranges.
    pub fn is_sampled(self) -> bool {
        matches!(self, Self::LatinHypercube | Self::Sobol)
    }
}

/// Which results of a candidate are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepOver {
    /// Those of its steady state.
    Steady,
    /// Those of its run, as `[run]` says.
    Run,
    /// Those of the cycle that it settles into.
    Periodic,
}

impl SweepOver {
    /// The words for them, the usual one first.
    pub const WORDS: [(&str, Self); 3] =
        [("steady", Self::Steady), ("run", Self::Run), ("periodic", Self::Periodic)];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::WORDS.into_iter().find(|(_, over)| *over == self).map_or("", |(word, _)| word)
    }
}

/// A parameter that a sweep gives values.
#[derive(Clone, Debug)]
pub struct SweepAxis {
    /// The parameter.
    pub name: String,
    /// Where it is named.
    pub span: Span,
    values: AxisValues,
}

/// One `[sweep.NAME]`.
#[derive(Clone, Debug)]
pub struct SweepStudy {
    /// Its name.
    pub name: String,
    /// Where it stands.
    pub span: Span,
    /// How the candidates are chosen.
    pub method: SweepMethod,
    /// The parameters that differ between them; at least one.
    pub axes: Vec<SweepAxis>,
    /// How many candidates are sampled; 0 where they are not.
    pub samples: u64,
    /// The seed of the samples.
    pub seed: u32,
    /// Which results are reported.
    pub over: SweepOver,
    /// The length of the cycle, where it is given.
    pub period: Option<Value>,
    /// What is reported; at least one.
    pub reports: Vec<Measure>,
    /// The places of two reports among them: candidates that none betters in both are told.
    pub front: Option<[usize; 2]>,
    /// The file of the candidates as it was written, and its place.
    file: Option<(String, Span)>,
}

impl SweepStudy {
    /// The type of the parameter of an axis.
    fn type_of(network: &Network, axis: &SweepAxis) -> Type {
        let id = network.parameter(&axis.name).ok();
        id.map_or(Type::SCALAR, |id| network.parameters()[id.index()].ty)
    }
}

impl Study for SweepStudy {
    const SECTION: &'static SectionDeclaration = &SWEEP;

    fn files(raw: &RawNetlist) -> Vec<(&str, &RawValue)> {
        let sweeps = raw.elements(SWEEP.name).iter();
        let file = sweeps.filter_map(|sweep| match &sweep.value.kind {
            RawKind::Table(table) => table.get("file").map(|entry| &entry.value),
            _ => None,
        });
        file.filter_map(|value| match &value.kind {
            RawKind::String { text, .. } => Some((text.as_str(), value)),
            _ => None,
        })
        .collect()
    }

    fn read(work: &mut Elaboration<'_>) -> Vec<Self> {
        work.sweeps()
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        self.plan(network).err().unwrap_or_default()
    }

    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields {
        self.as_written(network, path)
    }
}
