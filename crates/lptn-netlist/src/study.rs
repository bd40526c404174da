//! The interface of a section of studies, `[size.NAME]` or `[fit.NAME]`: it is read, checked and
//! written back.

use lptn_data::{Diagnostic, FileId};
use lptn_network::Network;
use lptn_units::Type;

use crate::format::SectionDeclaration;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::toml_text::{TomlFields, key};
use crate::work::Elaboration;

/// Maps a path that a file names to the path that a new text has to name.
pub(crate) type PathFrom<'p> = dyn Fn(FileId, &str) -> String + 'p;

/// The type of a parameter.
pub(crate) fn type_of(network: &Network, parameter: &str) -> Type {
    let id = network.parameter(parameter).ok();
    id.map_or(Type::SCALAR, |id| network.parameters()[id.index()].ty)
}

/// The files that a key of a section names, as strings or as `csv` of a table, with their places.
fn files<'r>(raw: &'r RawNetlist, (section, key): (&str, &str)) -> Vec<(&'r str, &'r RawValue)> {
    let tables = raw.elements(section).iter().filter_map(|entry| match &entry.value.kind {
        RawKind::Table(table) => table.get(key),
        _ => None,
    });
    tables.flat_map(|entry| entry.value.items()).filter_map(RawValue::file).collect()
}

/// A key right below the heading of a section of studies.
fn unnamed(section: &str, words: [&'static str; 4], first: &RawEntry) -> Diagnostic {
    let [code, what, label, name] = words;
    let message = format!("`{}` belongs to {what} with a name", first.key);
    let help = format!("give it one in its heading, for example `[{section}.{name}]`");
    Diagnostic::error(code, message).at(first.key_span.clone(), label).help(help)
}

/// A study, `[SECTION.NAME]`; `section/list.rs` lists all of them.
pub(crate) trait Study: Sized {
    /// Its section.
    const SECTION: &'static SectionDeclaration;

    /// The key that names CSV files, if one does.
    const FILES: &'static str = "";

    /// The CSV files that such studies name, with their places.
    fn files(raw: &RawNetlist) -> Vec<(&str, &RawValue)> {
        files(raw, (Self::SECTION.name, Self::FILES))
    }

    /// Words about one without a name: code, kind, label of its first key, and a sample name. By
    /// default it is reported as any other element.
    const UNNAMED: Option<[&'static str; 4]> = None;

    /// One study, `None` if it cannot be read; errors are reported.
    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self>;

    /// All of them, in file order.
    fn read(work: &mut Elaboration<'_>) -> Vec<Self> {
        let entries = work.elements(Self::SECTION.name);
        let key = entries.iter().find(|entry| Self::SECTION.key(&entry.key).is_some());
        if let (Some(first), Some(words)) = (key, Self::UNNAMED) {
            work.report(unnamed(Self::SECTION.name, words, first));
            return Vec::new();
        }
        entries.iter().filter_map(|entry| Self::one(work, entry)).collect()
    }

    /// Its name.
    fn name(&self) -> &str;

    /// The errors of its numbers for the parameters of a network.
    fn check(&self, network: &Network) -> Vec<Diagnostic>;

    /// Its fields as they are written.
    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields;

    /// Its heading, and its fields as they are written.
    fn written(&self, network: &Network, path: &PathFrom<'_>) -> (String, TomlFields) {
        (format!("{}.{}", Self::SECTION.name, key(self.name())), self.fields(network, path))
    }
}
