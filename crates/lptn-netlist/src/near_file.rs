//! Files that a netlist names: how they are read, and the file that was probably meant by a wrong
//! path.

use std::io::{self, Error, ErrorKind};
use std::path::{Component, Path, PathBuf};

use lptn_data::Diagnostic;
use lptn_units::suggest;

use crate::raw::{RawKind, RawValue};

/// The file nearest to a path that does not exist: with `/` instead of `\`, in another case, with
/// the missing extension, or, in the same folder and with the same extension, of a similar name.
pub fn similar_file(path: &Path) -> Option<PathBuf> {
    let turned = PathBuf::from(path.to_str()?.replace('\\', "/"));
    let endings = [turned.clone(), turned.with_extension("toml")];
    let bare = turned.extension().is_none();
    let mut known =
        endings.iter().take(if bare { 2 } else { 1 }).filter_map(|path| in_any_case(path));
    known.find(|found| found != path).or_else(|| of_similar_name(&turned))
}

/// A file whose path differs in case only.
fn in_any_case(path: &Path) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    for component in path.components() {
        let there = found.join(component);
        found = match component {
            Component::Normal(name) if !there.exists() => {
                let name = name.to_str()?;
                found.join(
                    names(&found)?
                        .into_iter()
                        .find(|other| other.to_lowercase() == name.to_lowercase())?,
                )
            }
            _ => there,
        };
    }
    found.is_file().then_some(found)
}

fn of_similar_name(path: &Path) -> Option<PathBuf> {
    let ending =
        path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
    let ending =
        if ["csv", "json"].contains(&ending.as_str()) { ending } else { "toml".to_owned() };
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = names(folder)?.into_iter().map(PathBuf::from).filter(|name| {
        name.extension()
            .and_then(|other| other.to_str())
            .is_some_and(|other| other.to_lowercase() == ending)
    });
    let files: Vec<PathBuf> = files.collect();
    // the extension, which all of them share, makes no two names alike
    let mut stems = files.iter().filter_map(|file| file.file_stem()?.to_str());
    let wanted = path.file_stem()?.to_str()?;
    let near = suggest(wanted, &mut stems)?;
    files
        .iter()
        .find(|file| file.file_stem().is_some_and(|stem| stem == near))
        .map(|file| folder.join(file))
}

/// The names in a folder, in alphabetical order.
fn names(folder: &Path) -> Option<Vec<String>> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(folder).ok()?;
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort_unstable();
    Some(names)
}

/// The help for a value that names an unreadable file, by a path relative to that of the netlist.
fn help(value: &RawValue, path: &Path, error: &Error) -> String {
    let RawKind::String { text: written, .. } = &value.kind else { return String::new() };
    if written.contains(char::is_control) {
        return "a backslash begins an escape in a string: write the path with `/`".to_owned();
    }
    let near = if error.kind() == ErrorKind::NotFound { similar_file(path) } else { None };
    let folder = path.to_str().and_then(|path| path.strip_suffix(written.as_str())).unwrap_or("");
    match near {
        Some(near) => {
            format!("did you mean \"{}\"?", near.strip_prefix(folder).unwrap_or(&near).display())
        }
        None => "paths are relative to the file that names it".to_owned(),
    }
}

/// Messages about a kind of file that a netlist names.
pub(crate) struct NamedFile {
    /// The use of one by the netlist: "include one", "read a CSV file".
    pub(crate) does: &'static str,
    /// The same for a certain one: "include", "read".
    pub(crate) verb: &'static str,
    pub(crate) without_folder: &'static str,
    pub(crate) not_found: &'static str,
    /// Further help if it cannot be read.
    pub(crate) else_help: &'static str,
}

impl NamedFile {
    /// The bytes of the file that a value names.
    pub(crate) fn load(
        &self,
        path: &Path,
        value: &RawValue,
        loader: Option<&mut (impl FnMut(&Path) -> io::Result<Vec<u8>> + ?Sized)>,
    ) -> Result<Vec<u8>, Diagnostic> {
        let Some(loader) = loader else {
            let message =
                format!("this netlist is not read from a file, so it cannot {}", self.does);
            let help = "save it, and give the name of the file";
            return Err(Diagnostic::wrong(self.without_folder, message, &value.span, help));
        };
        loader(path).map_err(|error| match error.kind() {
            ErrorKind::FileTooLarge if self.not_found == "netlist::csv_not_found" => {
                let message = format!("cannot read {}: {error}", path.display());
                let help = "leave out rows between which nothing changes, or split the file by its \
                    columns";
                Diagnostic::wrong("netlist::csv_too_long", message, &value.span, help)
            }
            _ => self.unreadable(path, value, &error),
        })
    }

    /// Error for a file that cannot be read.
    pub(crate) fn unreadable(&self, path: &Path, value: &RawValue, error: &Error) -> Diagnostic {
        let reason = match error.kind() {
            ErrorKind::NotFound => "there is no such file".to_owned(),
            ErrorKind::IsADirectory => "it is a folder".to_owned(),
            _ => error.to_string(),
        };
        let message = format!("cannot {} {}: {reason}", self.verb, path.display());
        let help = format!("{}{}", help(value, path, error), self.else_help);
        Diagnostic::wrong(self.not_found, message, &value.span, help)
    }
}
