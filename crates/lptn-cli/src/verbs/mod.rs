//! The verbs of the command line, each in a folder with its options, its work and what it shows.

pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod fit;
pub(crate) mod materials;
pub(crate) mod modes;
pub(crate) mod new;
pub(crate) mod reduce;
pub(crate) mod run;
pub(crate) mod size;
pub(crate) mod steady;
pub(crate) mod units;
pub(crate) mod verify;
