//! `--posterior FILE` of fits that write no folder.

use std::path::Path;

use lptn_netlist::Posterior;

use crate::console::Console;
use crate::files;
use lptn_answer::failure::Failure;

/// Writes the posterior of a fit, and replaces a file that exists.
pub(crate) fn write(posterior: &Posterior, file: &Path, console: &Console) -> Result<(), Failure> {
    let mut text = Vec::new();
    // into memory, which does not fail
    if posterior.write(&mut text).is_ok() {
        files::replace(file, &text)?;
        console.note(&format!("wrote  {}", file.display()));
    }
    Ok(())
}
