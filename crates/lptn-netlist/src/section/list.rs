//! Every section. A section that is not named here is unknown.

use std::sync::LazyLock;

use lptn_data::Diagnostic;
use lptn_network::Network;

use super::boundary::BOUNDARY;
use super::capacitor::CAPACITOR;
use super::control::CONTROL;
use super::default::DEFAULT;
use super::fan::FAN;
use super::fluid::FLUID;
use super::grid::GRID;
use super::limit::LIMIT;
use super::lubricant::LUBRICANT;
use super::material::MATERIAL;
use super::named_value::VALUE;
use super::node::NODE;
use super::path_section::PATHS;
use super::signal::SIGNAL;
use super::state::STATE;
use super::table::TABLE;
use crate::case::CaseStudy;
use crate::controller::CONTROLLER;
use crate::enclosure::ENCLOSURE;
use crate::fit::FitStudy;
use crate::format::{NetlistFormat, SectionDeclaration};
use crate::foster::FOSTER;
use crate::gearbox::GEARBOX;
use crate::hydraulic::{BRANCH, JUNCTION};
use crate::import::IMPORT;
use crate::infer::InferStudy;
use crate::parameters::PARAM;
use crate::pipe::PIPE;
use crate::plan::PlanStudy;
use crate::raw::{RawNetlist, RawValue};
use crate::run::RUN;
use crate::sensor::Sensor;
use crate::size::SizeStudy;
use crate::study::{PathFrom, Study};
use crate::sweep::SweepStudy;
use crate::template::{TEMPLATE, USE};
use crate::toml_text::TomlFields;
use crate::uncertainty::UNCERTAINTY;
use crate::work::Elaboration;

/// The sections before and after those of paths and sources, in the order of messages.
static BEFORE: [&SectionDeclaration; 15] = [
    &PARAM, &TABLE, &SIGNAL, &DEFAULT, &MATERIAL, &FLUID, &LUBRICANT, &FAN, &NODE, &GRID,
    &CAPACITOR, &BOUNDARY, &FOSTER, &ENCLOSURE, &PIPE,
];
static BEHIND: [&SectionDeclaration; 13] = [
    &GEARBOX,
    &JUNCTION,
    &BRANCH,
    &CONTROL,
    &CONTROLLER,
    &STATE,
    &VALUE,
    &IMPORT,
    &LIMIT,
    &TEMPLATE,
    &USE,
    &RUN,
    &UNCERTAINTY,
];

/// The studies: the field of a netlist with those of a section, and the type of one.
macro_rules! studies {
    ($($(#[$words:meta])* $field:ident: $study:ty,)*) => {
        const STUDIES: &[&SectionDeclaration] = &[$(<$study as Study>::SECTION),*];

        /// The studies of a netlist.
        #[derive(Clone, Debug)]
        pub struct Studies { $($(#[$words])* pub $field: Vec<$study>,)* }

        impl Studies {
            /// The CSV files that they name, with their places.
            pub(crate) fn files(raw: &RawNetlist) -> impl Iterator<Item = (&str, &RawValue)> {
                std::iter::empty()$(.chain(<$study>::files(raw)))*
            }

            pub(crate) fn read(work: &mut Elaboration<'_>) -> Self {
                Self { $($field: <$study>::read(work)),* }
            }

            pub(crate) fn check(&self, network: &Network) -> Vec<Diagnostic> {
                let none = std::iter::empty();
                none$(.chain(self.$field.iter().flat_map(|study| study.check(network))))*.collect()
            }

            /// The heading and the fields of each, as they are written.
            pub(crate) fn written(
                &self,
                network: &Network,
                path: &PathFrom<'_>,
            ) -> Vec<(String, TomlFields)> {
                let none = std::iter::empty();
                none$(.chain(self.$field.iter().map(|study| study.written(network, path))))*
                    .collect()
            }
        }
    };
}

studies! {
    /// Load cases, in file order.
    cases: CaseStudy,
    /// Sizes to find, in file order.
    sizes: SizeStudy,
    /// The instruments of records, in file order.
    sensors: Sensor,
    /// Parameters to estimate from records, in file order.
    fits: FitStudy,
    /// Time histories to estimate from records, in file order.
    infers: InferStudy,
    /// Measurements to plan, in file order.
    plans: PlanStudy,
    /// Sweeps, in file order.
    sweeps: SweepStudy,
}

/// Sections that the format reserves for later: none.
static LATER: [&SectionDeclaration; 0] = [];

static FORMAT: LazyLock<NetlistFormat> = LazyLock::new(|| {
    let paths = PATHS.iter().map(|path| &path.section);
    let sections = BEFORE.into_iter().chain(paths).chain(BEHIND).chain(STUDIES.iter().copied());
    NetlistFormat { sections: sections.collect(), later: &LATER }
});

/// All sections.
pub fn format() -> &'static NetlistFormat {
    &FORMAT
}
