//! The sections of netlists with their keys, for help in Python.

use lptn::netlist_format;
use pyo3::prelude::*;

/// A key: name, type, meaning, default, example, true if it is required.
type Key = (&'static str, String, &'static str, &'static str, &'static str, bool);

/// A section: name, contents, example of an entry, keys.
type Section = (&'static str, &'static str, &'static str, Vec<Key>);

/// All sections of a netlist.
#[pyfunction]
pub(crate) fn sections() -> Vec<Section> {
    let sections = netlist_format().sections.iter().map(|section| {
        let keys = section.keys.iter().map(|key| {
            let takes = key.takes().replace('`', "");
            (key.name, takes, key.meaning, key.default, key.example, key.needed)
        });
        (section.name, section.sentence, section.example, keys.collect())
    });
    sections.collect()
}
