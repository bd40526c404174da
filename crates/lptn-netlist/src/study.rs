//! What a section of studies does, `[size.NAME]` or `[fit.NAME]`: it is read, checked and written
//! back.

use lptn_data::{Diagnostic, FileId};
use lptn_network::Network;

use crate::format::SectionDeclaration;
use crate::raw::{RawNetlist, RawValue};
use crate::toml_text::{TomlFields, key};
use crate::work::Elaboration;

/// How a text names a file that another file names by a path.
pub(crate) type PathFrom<'p> = dyn Fn(FileId, &str) -> String + 'p;

/// A study, `[SECTION.NAME]`; those that there are stand in `section/list.rs`.
pub(crate) trait Study: Sized {
    /// Its section.
    const SECTION: &'static SectionDeclaration;

    /// The CSV files that such studies name, with their places: none, unless this is given.
    fn files(_: &RawNetlist) -> Vec<(&str, &RawValue)> {
        Vec::new()
    }

    /// All of them, in file order, as far as they can be read; what is wrong is reported.
    fn read(work: &mut Elaboration<'_>) -> Vec<Self>;

    /// Its name.
    fn name(&self) -> &str;

    /// What is wrong with its numbers for the parameters of a network.
    fn check(&self, network: &Network) -> Vec<Diagnostic>;

    /// Its fields as they are written.
    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields;

    /// Its heading, and its fields as they are written.
    fn written(&self, network: &Network, path: &PathFrom<'_>) -> (String, TomlFields) {
        (format!("{}.{}", Self::SECTION.name, key(self.name())), self.fields(network, path))
    }
}
