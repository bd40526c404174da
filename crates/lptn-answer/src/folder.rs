//! Files of a folder.

use std::path::{Path, PathBuf};

use lptn_units::Help;

use crate::failure::Failure;

/// The files of a folder with this ending, by name.
///
/// # Errors
/// A folder that cannot be read, with this help.
pub fn of_folder(folder: &Path, ending: &str, help: impl Help) -> Result<Vec<PathBuf>, Failure> {
    let entries = std::fs::read_dir(folder);
    let entries = entries.map_err(|error| Failure::cannot_read(folder.display(), &error, help))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let is_one = |path: &PathBuf| path.is_file() && path.extension().is_some_and(|e| e == ending);
    let mut paths: Vec<PathBuf> = paths.filter(is_one).collect();
    paths.sort_unstable();
    Ok(paths)
}
