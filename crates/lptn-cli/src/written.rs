//! Netlists that are written over.

use std::path::Path;

use lptn_answer::failure::Failure;

use crate::files;

pub(crate) use lptn_answer::written::{can_be_written, proven, with_numbers};

/// Replaces a netlist by another text.
pub(crate) fn put(file: &Path, text: &str) -> Result<(), Failure> {
    let help = "the netlist is as it was: write the value into it by hand";
    files::replace(file, text.as_bytes()).map_err(|failure| failure.with_help(help))
}
