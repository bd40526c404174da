//! The CSV files that a netlist names: which there are, and how they are loaded.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn_data::{CsvFile, CsvText, Diagnostic, Files, Span};

use crate::include::{Loader, reason};
use crate::near_file;
use crate::raw::{RawKind, RawNetlist, RawTable, RawValue};
use crate::vocabulary::IMPORT;

/// The sections in which `csv` names a file of numbers.
const READERS: [&str; 4] = ["table", "signal", "material", "fluid"];

/// The key that names the file.
const CSV: &str = "csv";

/// The CSV files of a netlist, by the place that names each.
#[derive(Debug, Default)]
pub(crate) struct CsvFiles {
    files: HashMap<Span, Result<Arc<CsvFile>, Diagnostic>>,
    /// Those of `[import]`, which are too long to be held as cells, and of `[fit]`, which are read by column.
    texts: HashMap<Span, Result<CsvText, Diagnostic>>,
}

impl CsvFiles {
    /// Reads every file that the netlist names, through the loader that reads what it includes.
    pub(crate) fn read(files: &mut Files, raw: &RawNetlist, mut loader: Option<&mut Loader<'_>>) -> Self {
        let mut named = Vec::new();
        for entry in raw.top.entries.iter().filter(|entry| READERS.contains(&entry.key.as_str())) {
            if let RawKind::Table(table) = &entry.value.kind {
                table.entries.iter().for_each(|element| find(&element.value, &mut named));
            }
        }
        let (mut read, mut done) = (Self::default(), HashMap::new());
        for (text, value) in named {
            let path = path(files, text, value);
            let result = match done.get(&path) {
                Some(file) => Ok(Arc::clone(file)),
                None => load(files, &path, value, loader.as_deref_mut()),
            };
            if let Ok(file) = &result {
                done.insert(path, Arc::clone(file));
            }
            read.files.insert(value.span.clone(), result);
        }
        for (text, value) in imported(raw).chain(crate::fit::files(raw)) {
            let result = load_text(files, &path(files, text, value), value, loader.as_deref_mut());
            read.texts.insert(value.span.clone(), result);
        }
        read
    }

    /// The text of the file of `[import]` or `[fit]` that a value names, as for [`CsvFiles::get`].
    pub(crate) fn text(&self, value: &RawValue) -> Option<Result<&CsvText, &Diagnostic>> {
        self.texts.get(&value.span).map(Result::as_ref)
    }

    /// The file that a value names; `None` if none was read for it, because the netlist is broken elsewhere.
    pub(crate) fn get(&self, value: &RawValue) -> Option<Result<Arc<CsvFile>, Diagnostic>> {
        self.files.get(&value.span).cloned()
    }
}

/// The values of every `csv` below this one.
fn find<'a>(value: &'a RawValue, named: &mut Vec<(&'a str, &'a RawValue)>) {
    let RawKind::Table(RawTable { entries, .. }) = &value.kind else { return };
    for entry in entries {
        match &entry.value.kind {
            RawKind::String { text, .. } if entry.key == CSV => named.push((text, &entry.value)),
            _ => find(&entry.value, named),
        }
    }
}

/// The files that `[import]` names.
fn imported(raw: &RawNetlist) -> impl Iterator<Item = (&str, &RawValue)> {
    let entries = raw.elements(IMPORT.name).iter();
    entries.filter_map(|entry| match &entry.value.kind {
        RawKind::String { text, .. } => Some((text.as_str(), &entry.value)),
        _ => None,
    })
}

/// The path of a file, which is relative to the file that names it.
fn path(files: &Files, text: &str, value: &RawValue) -> PathBuf {
    Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new("")).join(text)
}

fn load(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<Arc<CsvFile>, Diagnostic> {
    let text = load_text(files, path, value, loader)?;
    CsvFile::open(&text, &value.span).map(Arc::new)
}

fn load_text(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<CsvText, Diagnostic> {
    let refused = |code, message: String, help: &str| {
        Err(Diagnostic::error(code, message).at(value.span.clone(), "").help(help))
    };
    let name = path.display();
    let Some(loader) = loader else {
        let message = "this netlist is not read from a file, so it cannot read a CSV file";
        return refused(
            "netlist::csv_without_folder",
            message.into(),
            "save it, and give the name of the file",
        );
    };
    let bytes = match loader(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::FileTooLarge => {
            let help = "leave out rows between which nothing changes, or split the file by its columns";
            return refused("netlist::csv_too_long", format!("cannot read {name}: {error}"), help);
        }
        Err(error) => {
            let message = format!("cannot read {name}: {}", reason(&error));
            return refused("netlist::csv_not_found", message, &near_file::help(value, path, &error));
        }
    };
    let text = CsvText::of(files, name.to_string(), &bytes);
    text.map_err(|problem| problem.also(value.span.clone(), "read here"))
}
