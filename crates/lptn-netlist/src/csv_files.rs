//! The CSV files that a netlist names, and how they are loaded.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use foldhash::{HashMap, HashMapExt as _};
use lptn_data::{CsvFile, CsvOptions, CsvText, Diagnostic, Files, Span};

use crate::csv_form::options;
use crate::format::{NetlistFormat, Role};
use crate::include::Loader;
use crate::near_file::NamedFile;
use crate::raw::{RawKind, RawNetlist, RawValue};

/// The section of load cases, whose signals may name files.
pub(crate) const CASES: &str = "case";

const NAMED: NamedFile = NamedFile {
    does: "read a CSV file",
    verb: "read",
    without_folder: "netlist::csv_without_folder",
    not_found: "netlist::csv_not_found",
    else_help: "",
};

/// The layouts of a CSV file of a table.
pub(crate) const LAYOUTS: [(&str, bool); 2] = [("columns", false), ("matrix", true)];
/// The key and the word of a matrix.
pub(crate) const LAYOUT: &str = "layout";
const MATRIX: &str = LAYOUTS[1].0;

/// The key that names the file.
const CSV: &str = "csv";

/// The CSV files of a netlist, by the place that names each.
#[derive(Debug, Default)]
pub(crate) struct CsvFiles {
    files: HashMap<Span, Result<Arc<CsvFile>, Diagnostic>>,
    /// Files of `[import]`, which are too long to be stored as cells, of `[fit]`, which are read by
    /// column, and matrices, which have no header.
    texts: HashMap<Span, Result<CsvText, Diagnostic>>,
}

impl CsvFiles {
    /// Reads every file of tables, signals and properties that the netlist names, and the given
    /// ones of `[import]` and `[fit]`, through the loader of included files.
    pub(crate) fn read<'r>(
        files: &mut Files,
        (raw, format): (&RawNetlist, &NetlistFormat),
        long: impl Iterator<Item = (&'r str, &'r RawValue)>,
        mut loader: Option<&mut Loader<'_>>,
    ) -> Self {
        let (mut named, mut matrices) = (Vec::new(), Vec::new());
        let curves = |key: &str| {
            key == CASES || matches!(format.role(key), Some(Role::Value | Role::Substance))
        };
        for entry in raw.top.entries.iter().filter(|entry| curves(&entry.key)) {
            if let RawKind::Table(table) = &entry.value.kind {
                let elements = table.entries.iter().map(|element| &element.value);
                elements.for_each(|element| find(element, (&mut named, &mut matrices)));
            }
        }
        let (mut read, mut done) = (Self::default(), HashMap::new());
        for (text, value, options) in named {
            let key = (path(files, text, value), options);
            let result = match done.get(&key) {
                Some(file) => Ok(Arc::clone(file)),
                None => load(files, &key, value, loader.as_deref_mut()),
            };
            if let Ok(file) = &result {
                done.insert(key, Arc::clone(file));
            }
            read.files.insert(value.span.clone(), result);
        }
        let mut keep = |text: &str, value: &RawValue| {
            let result = load_text(files, &path(files, text, value), value, loader.as_deref_mut());
            read.texts.insert(value.span.clone(), result);
        };
        matrices.into_iter().for_each(|(text, value, _)| keep(text, value));
        long.for_each(|(text, value)| keep(text, value));
        read
    }

    /// The text of the file of `[import]` or `[fit]` that a value names, as for [`CsvFiles::get`].
    pub(crate) fn text(&self, value: &RawValue) -> Option<Result<&CsvText, &Diagnostic>> {
        self.texts.get(&value.span).map(Result::as_ref)
    }

    /// The file that a value names; `None` if none was read for it, because the netlist is broken
    /// elsewhere.
    pub(crate) fn get(&self, value: &RawValue) -> Option<Result<Arc<CsvFile>, Diagnostic>> {
        self.files.get(&value.span).cloned()
    }
}

fn text(value: &RawValue) -> Option<(&str, &RawValue)> {
    match &value.kind {
        RawKind::String { text, .. } => Some((text, value)),
        _ => None,
    }
}

type Named<'a> = Vec<(&'a str, &'a RawValue, CsvOptions)>;

/// The values of every `csv` below this one, with the statements next to it: of files with columns,
/// and of matrices.
fn find<'a>(value: &'a RawValue, (named, matrices): (&mut Named<'a>, &mut Named<'a>)) {
    let RawKind::Table(table) = &value.kind else { return };
    let layout = table.get(LAYOUT).map(|entry| &entry.value.kind);
    let is_matrix = matches!(layout, Some(RawKind::String { text, .. }) if text == MATRIX);
    let form = || options(table).0;
    for entry in &table.entries {
        match &entry.value.kind {
            RawKind::String { text, .. } if entry.key == CSV && is_matrix => {
                matrices.push((text, &entry.value, form()));
            }
            RawKind::String { text, .. } if entry.key == CSV => {
                named.push((text, &entry.value, form()));
            }
            RawKind::Array(items) if entry.key == CSV => {
                let items = items.iter().filter_map(text);
                named.extend(items.map(|(text, value)| (text, value, form())));
            }
            _ => find(&entry.value, (named, matrices)),
        }
    }
}

/// The path of a file, which is relative to the file that names it.
fn path(files: &Files, text: &str, value: &RawValue) -> PathBuf {
    Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new("")).join(text)
}

fn load(
    files: &mut Files,
    (path, options): &(PathBuf, CsvOptions),
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<Arc<CsvFile>, Diagnostic> {
    let text = load_text(files, path, value, loader)?;
    CsvFile::open(&text, &value.span, options).map(Arc::new)
}

fn load_text(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<CsvText, Diagnostic> {
    let bytes = NAMED.load(path, value, loader)?;
    let name = path.display();
    let text = CsvText::of(files, name.to_string(), &bytes);
    text.map_err(|problem| problem.also(value.span.clone(), "read here"))
}
