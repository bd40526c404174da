//! Reads a file that a netlist names: a string, or a table with statements about its form.

use lptn_data::{CsvOptions, Diagnostic};

use crate::csv_form::options;
use crate::fields::{Fields, unknown};
use crate::format::SectionDeclaration;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::toml_text::string;
use crate::work::Elaboration;

/// A file that a netlist names, and the statements about its form.
pub(crate) struct FormedFile<'a> {
    pub(crate) csv: &'a str,
    pub(crate) raw: &'a RawValue,
    pub(crate) options: CsvOptions,
    /// True if the file is named by a string, without room for statements.
    plain: bool,
}

impl FormedFile<'_> {
    /// The error of its contents; if they can be read in two ways, with the place of the key that
    /// decides.
    pub(crate) fn explained(&self, problem: Diagnostic) -> Diagnostic {
        match self.plain && problem.code == "netlist::csv_decimal" {
            true => problem.note(format!(
                "the file then is a table: `{{ csv = {}, decimal = \",\" }}`",
                string(self.csv)
            )),
            false => problem,
        }
    }
}

impl<'a> Elaboration<'a> {
    /// The file that an item of `key` names: a string, or `csv` of a table with the keys of
    /// `section`. Errors are reported.
    pub(crate) fn formed_file(
        &mut self,
        fields: &Fields<'a>,
        (key, section): (&str, &SectionDeclaration),
        item: &'a RawValue,
    ) -> Option<FormedFile<'a>> {
        let (mut form, before) = (CsvOptions::default(), self.problems.len());
        if let RawKind::Table(table) = &item.kind {
            let owner = fields.owner.inside(key);
            let (given, wrong) = options(table);
            form = given;
            self.problems.extend(wrong.iter().map(|wrong| wrong.told(&owner)));
            let other = |entry: &&RawEntry| section.key(&entry.key).is_none();
            let others = table.entries.iter().filter(other);
            self.problems.extend(others.map(|entry| unknown(section, &owner, entry)));
        }
        let sound = self.problems.len() == before;
        match item.file() {
            Some((csv, raw)) => {
                let plain = std::ptr::eq(item, raw);
                sound.then_some(FormedFile { csv, raw, options: form, plain })
            }
            None => {
                if sound {
                    let wanted = "a CSV file or a table with `csv`";
                    self.report(fields.wrong_shape(key, item, wanted));
                }
                None
            }
        }
    }
}
