//! `[sweep.NAME]`: many candidates, and the reports about each.

mod axis;
mod declaration;
mod measure;
mod plan;
mod read;
mod write;

use lptn_data::{CsvOptions, Diagnostic, Span};
use lptn_network::{Network, Value};

use crate::format::SectionDeclaration;
use crate::raw::RawEntry;
use crate::study::{PathFrom, Study};
use crate::toml_text::TomlFields;
use crate::work::Elaboration;
use axis::AxisValues;
use declaration::SWEEP;

pub use crate::size::Over as SweepOver;
pub use measure::Measure;
pub use plan::{AxisNumbers, MOST_CASES, SweepPlan};

/// The choice of the candidates of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepMethod {
    /// Every combination of the values of all axes, the last axis fastest.
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    List,
    /// The rows of a file.
    Csv,
    /// Latin hypercube: each axis is cut into as many cells as there are samples, one in each.
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

    /// True if the candidates are sampled from ranges.
    pub fn is_sampled(self) -> bool {
        matches!(self, Self::LatinHypercube | Self::Sobol)
    }
}

/// A parameter that a sweep gives values.
#[derive(Clone, Debug)]
pub struct SweepAxis {
    /// The parameter.
    pub name: String,
    /// The place of its name.
    pub span: Span,
    values: AxisValues,
}

/// The file of the candidates of a sweep.
#[derive(Clone, Debug)]
struct SweepFile {
    /// Its name as it was written.
    csv: String,
    /// The place of its name.
    span: Span,
    /// Statements about its form.
    options: CsvOptions,
}

/// One `[sweep.NAME]`.
#[derive(Clone, Debug)]
pub struct SweepStudy {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The choice of the candidates.
    pub method: SweepMethod,
    /// The parameters that differ between them; at least one.
    pub axes: Vec<SweepAxis>,
    /// Number of sampled candidates; 0 if they are not sampled.
    pub samples: u64,
    /// The seed of the samples.
    pub seed: u32,
    /// The results that are reported.
    pub over: SweepOver,
    /// The length of the cycle, if given.
    pub period: Option<Value>,
    /// The reports; at least one.
    pub reports: Vec<Measure>,
    /// The positions of two reports: the Pareto-optimal candidates in both are listed.
    pub front: Option<[usize; 2]>,
    /// The file of the candidates.
    file: Option<SweepFile>,
}

impl Study for SweepStudy {
    const SECTION: &'static SectionDeclaration = &SWEEP;
    const FILES: &'static str = "file";

    const UNNAMED: Option<[&'static str; 4]> =
        Some(["netlist::sweep_without_name", "a sweep", "below [sweep]", "fans"]);

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.sweep_study(entry)
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
