//! `include`: one netlist from several files, each value with its place.
//!
//! Includes are merged as raw trees before names are resolved, so that spans keep their file.

use std::io;
use std::path::{Component, Path, PathBuf};

use foldhash::{HashMap, HashSet, HashSetExt as _};
use lptn_data::{Diagnostic, FileId, Files, MOST_BYTES, Severity, Span};

use crate::duplicate;
use crate::fields::wrong_shape;
use crate::format::{NetlistFormat, Role};
use crate::head::check_head;
use crate::near_file::NamedFile;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
use crate::syntax;

/// Reads the bytes of a file that a netlist names: one that it includes, or a CSV file.
pub type Loader<'a> = dyn FnMut(&Path) -> io::Result<Vec<u8>> + 'a;

/// Greatest depth of files that include each other.
const DEEPEST: usize = 8;

const INCLUDE: &str = "include";

const INCLUDED: NamedFile = NamedFile {
    does: "include one",
    verb: "include",
    without_folder: "netlist::include_without_folder",
    not_found: "netlist::include_not_found",
    else_help: "",
};

/// A netlist with everything it includes.
#[derive(Debug)]
pub(crate) struct Merged {
    pub(crate) raw: RawNetlist,
    pub(crate) problems: Vec<Diagnostic>,
    /// True if a whole file is missing, so that names may be unknown.
    pub(crate) incomplete: bool,
    /// True if a text could not be read, or not as TOML.
    pub(crate) syntax: bool,
}

/// Puts the entries of included files before a netlist's own; without `include` nothing changes.
pub(crate) fn merge(
    (files, format): (&mut Files, &NetlistFormat),
    raw: RawNetlist,
    (path, file): (&Path, FileId),
    loader: Option<&mut Loader<'_>>,
) -> Merged {
    let mut merged = Merged { raw, problems: Vec::new(), incomplete: false, syntax: false };
    if merged.raw.top.get(INCLUDE).is_none() {
        return merged;
    }
    let span = merged.raw.top.span.clone();
    let own = std::mem::take(&mut merged.raw.top.entries);
    let mut work = Work {
        files,
        format,
        loader,
        stack: vec![(normal(path), file)],
        done: HashSet::new(),
        merged,
    };
    let (entries, includes) = split(own);
    work.includes(&includes, path);
    work.append(entries);
    // the file itself has no place inside a file
    work.merged.raw.top.span = span;
    work.merged
}

struct Work<'a, 'l> {
    files: &'a mut Files,
    format: &'a NetlistFormat,
    loader: Option<&'a mut Loader<'l>>,
    /// The files that are open: each includes the next.
    stack: Vec<(PathBuf, FileId)>,
    /// The files that are included: a file that several others include is added once.
    done: HashSet<PathBuf>,
    merged: Merged,
}

impl Work<'_, '_> {
    fn includes(&mut self, includes: &[RawEntry], from: &Path) {
        for entry in includes {
            let RawKind::Array(list) = &entry.value.kind else {
                self.report(shape(&entry.value));
                continue;
            };
            for value in list {
                match &value.kind {
                    RawKind::String { text, .. } => self.include(text, value, from),
                    _ => self.report(shape(value)),
                }
            }
        }
    }

    fn include(&mut self, text: &str, value: &RawValue, from: &Path) {
        let path = from.parent().unwrap_or(Path::new("")).join(text);
        let key = normal(&path);
        if let Some(first) = self.stack.iter().position(|(open, _)| *open == key) {
            let problem = self.cycle(first, value);
            return self.lost(problem);
        }
        if self.done.contains(&key) {
            return;
        }
        if self.stack.len() > DEEPEST {
            return self.lost(too_deep(value));
        }
        let bytes = match INCLUDED.load(&path, value, self.loader.as_deref_mut()) {
            Ok(bytes) => bytes,
            Err(problem) if problem.code == INCLUDED.without_folder => return self.lost(problem),
            Err(problem) => return self.unread(problem),
        };
        if bytes.len() as u64 > MOST_BYTES {
            let error =
                io::Error::other(format!("it is longer than {} MB", MOST_BYTES / 1_000_000));
            return self.unread(INCLUDED.unreadable(&path, value, &error));
        }
        let Some(text) = std::str::from_utf8(&bytes).ok().filter(|text| !text.contains('\0'))
        else {
            return self.unread(not_text(&path, value));
        };
        let file = self.files.add(path.display().to_string(), text);
        self.file(&path, key, file);
    }

    fn file(&mut self, path: &Path, key: PathBuf, file: FileId) {
        let (raw, broken) = syntax::read(self.files, file, self.format);
        if !broken.is_empty() {
            self.merged.syntax = true;
            self.merged.incomplete = true;
            self.merged.problems.extend(broken);
            return;
        }
        self.merged.problems.extend(check_head(&raw.top.entries, Span::new(file, 0..0)));
        let (entries, includes) = split(raw.top.entries);
        self.stack.push((key.clone(), file));
        self.includes(&includes, path);
        self.stack.pop();
        self.done.insert(key);
        let (refused, entries): (Vec<_>, Vec<_>) = entries
            .into_iter()
            .partition(|entry| self.format.role(&entry.key) == Some(Role::Study));
        self.merged.problems.extend(refused.iter().map(study));
        // title and format are the file's own
        let own = ["format", "title", "description"];
        self.append(
            entries.into_iter().filter(|entry| !own.contains(&entry.key.as_str())).collect(),
        );
    }

    /// Adds the entries of a file after the existing ones.
    fn append(&mut self, entries: Vec<RawEntry>) {
        for entry in entries {
            let top = &mut self.merged.raw.top.entries;
            let Some(there) = top.iter_mut().find(|there| there.key == entry.key) else {
                top.push(entry);
                continue;
            };
            match (&mut there.value.kind, entry.value.kind) {
                (RawKind::Table(table), RawKind::Table(more)) => {
                    self.merged.problems.extend(append_table(table, more));
                }
                // the first one is reported
                (_, kind) => {
                    let value = RawValue { span: entry.value.span, kind };
                    top.push(RawEntry { key: entry.key, key_span: entry.key_span, value });
                }
            }
        }
    }

    fn report(&mut self, problem: Diagnostic) {
        self.merged.problems.push(problem);
    }

    /// Reports a missing file, whose contents are missing.
    fn lost(&mut self, problem: Diagnostic) {
        self.merged.incomplete = true;
        self.report(problem);
    }

    /// Reports a file without a text: as wrong as one that is not TOML.
    fn unread(&mut self, problem: Diagnostic) {
        self.merged.syntax = true;
        self.lost(problem);
    }

    fn cycle(&self, first: usize, value: &RawValue) -> Diagnostic {
        let files = self.stack.get(first..).unwrap_or_default();
        let mut chain: Vec<&str> = files.iter().map(|(_, file)| self.files.name(*file)).collect();
        chain.extend(chain.first().copied());
        let message = match chain.as_slice() {
            [one, _] => format!("{one} includes itself"),
            _ => format!("files include each other: {}", chain.join(" -> ")),
        };
        Diagnostic::wrong(
            "netlist::include_cycle",
            message,
            &value.span,
            "move the common parts into a separate file",
        )
    }
}

/// The entries of a file, and its `include`.
fn split(entries: Vec<RawEntry>) -> (Vec<RawEntry>, Vec<RawEntry>) {
    entries.into_iter().partition(|entry| entry.key != INCLUDE)
}

/// Adds entries of the same section of another file; a key of both is kept once.
fn append_table(table: &mut RawTable, more: RawTable) -> Vec<Diagnostic> {
    let first: HashMap<String, Span> =
        table.entries.iter().map(|entry| (entry.key.clone(), entry.key_span.clone())).collect();
    let mut problems = Vec::new();
    for entry in more.entries {
        match first.get(&entry.key) {
            None => table.entries.push(entry),
            Some(place) => {
                let message = format!("`{}` is given in two files", entry.key);
                problems.push(
                    Diagnostic::error(duplicate::CODE, message)
                        .at(entry.key_span, "given again")
                        .also(place.clone(), "first given here")
                        .help("remove one of the two, or give one another name"),
                );
            }
        }
    }
    problems
}

/// The path without `.` and `name/..`, so that one file has one name.
fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(normal.components().next_back(), Some(Component::Normal(_))) =>
            {
                normal.pop();
            }
            other => normal.push(other),
        }
    }
    normal
}

fn shape(value: &RawValue) -> Diagnostic {
    wrong_shape("`include`", value, "a list of file names", "include = [\"materials.toml\"]")
}

fn study(entry: &RawEntry) -> Diagnostic {
    let message = format!("`[{}]` cannot be in an included file", entry.key);
    Diagnostic::wrong(
        "netlist::study_in_include",
        message,
        &entry.key_span,
        "move it to the file that is run: a run or a study is not a part of a network",
    )
}

fn too_deep(value: &RawValue) -> Diagnostic {
    let message = format!("files are included more than {DEEPEST} deep");
    Diagnostic::wrong(
        "netlist::include_depth",
        message,
        &value.span,
        "include the innermost file directly",
    )
}

fn not_text(path: &Path, value: &RawValue) -> Diagnostic {
    Diagnostic::wrong(
        "netlist::not_text",
        format!("{} is not a text file in UTF-8", path.display()),
        &value.span,
        "a netlist is a TOML file in UTF-8; choose UTF-8 when your editor saves it",
    )
}

/// True if any problem makes the netlist unusable.
pub(crate) fn any_error(problems: &[Diagnostic]) -> bool {
    problems.iter().any(|problem| problem.severity == Severity::Error)
}
