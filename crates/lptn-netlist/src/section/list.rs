//! Every section there is. A section that is not named here is not known.

use std::sync::LazyLock;

use super::boundary::BOUNDARY;
use super::capacitor::CAPACITOR;
use super::control::CONTROL;
use super::default::DEFAULT;
use super::fluid::FLUID;
use super::grid::GRID;
use super::limit::LIMIT;
use super::material::MATERIAL;
use super::node::NODE;
use super::path::PATHS;
use super::signal::SIGNAL;
use super::source::SOURCE;
use super::table::TABLE;
use crate::fit::FIT;
use crate::format::{Format, Role, SectionDeclaration};
use crate::import::IMPORT;
use crate::parameters::PARAM;
use crate::run::RUN;
use crate::size::SIZE;
use crate::template::{TEMPLATE, USE};

/// The sections before and behind those of paths, in the order in which they are named to people.
static BEFORE: [&SectionDeclaration; 10] =
    [&PARAM, &TABLE, &SIGNAL, &DEFAULT, &MATERIAL, &FLUID, &NODE, &GRID, &CAPACITOR, &BOUNDARY];
static BEHIND: [&SectionDeclaration; 9] =
    [&SOURCE, &CONTROL, &IMPORT, &LIMIT, &TEMPLATE, &USE, &RUN, &SIZE, &FIT];

/// What the format has for later.
static LATER: [&SectionDeclaration; 1] = [&SectionDeclaration {
    name: "sweep",
    sentence: "Runs over values of parameters.",
    role: Role::Study,
    ..SectionDeclaration::NEW
}];

static FORMAT: LazyLock<Format> = LazyLock::new(|| {
    let paths = PATHS.iter().map(|path| &path.section);
    Format { sections: BEFORE.into_iter().chain(paths).chain(BEHIND).collect(), later: &LATER }
});

/// All sections.
pub fn format() -> &'static Format {
    &FORMAT
}
