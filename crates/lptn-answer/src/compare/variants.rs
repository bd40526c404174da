//! The variants of a comparison: `--set R=1K/W,2K/W`, parts from tables, and the load cases of every
//! netlist.

use std::path::{Path, PathBuf};

use lptn_netlist::{Catalogue, CsvOptions, Diagnostic};

use crate::belief::Belief;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;

/// Most variants of one netlist; more are a matter for a sweep.
pub(super) const MOST: usize = 1000;

/// Changes to a netlist.
#[derive(Clone, Debug, Default)]
pub struct Variant {
    pub(super) case: Option<String>,
    pub(super) set: Vec<String>,
    /// Label that distinguishes it: `hot, R=1K/W`; empty if there are no others.
    pub(super) label: String,
}

/// Every combination of the values in lists, the last list changing fastest.
/// `None` if there are too many.
pub fn of_sets(set: &[String]) -> Option<Vec<Variant>> {
    let mut all = vec![Variant::default()];
    for text in set {
        let (name, values) = text.split_once('=').unwrap_or((text, ""));
        let values = listed(values);
        if all.len() * values.len() > MOST {
            return None;
        }
        let one = |variant: &Variant, value: &str| {
            let mut variant = variant.clone();
            let own = if text.contains('=') { format!("{name}={value}") } else { text.clone() };
            if values.len() > 1 {
                variant.label = joined(&variant.label, own.trim());
            }
            variant.set.push(own);
            variant
        };
        all =
            all.iter().flat_map(|variant| values.iter().map(|value| one(variant, value))).collect();
    }
    Some(all)
}

/// One part of each table with every variant, the parts of the last table changing fastest.
/// A netlist that cannot be read stays unchanged. `None` if there are too many.
///
/// # Errors
/// Problems of a table for this netlist.
pub(super) fn with_parts(
    file: &Path,
    (tables, csv): (&[PathBuf], &CsvOptions),
    (variants, listener): (&[Variant], &dyn Listener),
) -> Result<Option<Vec<Variant>>, Failure> {
    let mut all = variants.to_vec();
    if tables.is_empty() {
        return Ok(Some(all));
    }
    let Ok(input) = Input::open(file, &Belief::Named, (None, &[])) else { return Ok(Some(all)) };
    for table in tables {
        let name = table.display().to_string();
        let bytes = std::fs::read(table).map_err(|error| {
            let message = format!("cannot read {name}: {error}");
            Failure::new(Exit::Input, Diagnostic::error("input::cannot_read", message))
        })?;
        let (parts, files) = input.netlist.parts((&name, &bytes), csv)?;
        parts.note.iter().for_each(|note| listener.warn(&files, std::slice::from_ref(note)));
        if all.len() * parts.parts.len() > MOST {
            return Ok(None);
        }
        all = all
            .iter()
            .flat_map(|variant| (0..parts.parts.len()).map(|part| variant.of_part(&parts, part)))
            .collect();
    }
    Ok(Some(all))
}

impl Variant {
    /// Label that distinguishes it, such as `hot, R=1K/W`; empty if there are no others.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// The same variant with the values of a part, after those already set.
    fn of_part(&self, table: &Catalogue, part: usize) -> Self {
        let set = self.set.iter().cloned().chain(table.assignments(part)).collect();
        let label = joined(&self.label, &table.parts[part]);
        Self { set, label, ..self.clone() }
    }
}

/// The variants of a netlist in each of its load cases.
/// They are unchanged if it has none or cannot be read.
pub(super) fn in_cases(file: &Path, variants: &[Variant]) -> Vec<Variant> {
    let names: Vec<String> = Input::open(file, &Belief::Named, (None, &[])).map_or_else(
        |_| Vec::new(),
        |input| input.netlist.studies.cases.iter().map(|case| case.name.clone()).collect(),
    );
    if names.is_empty() {
        return variants.to_vec();
    }
    let in_case = |variant: &Variant, name: &String| Variant {
        case: Some(name.clone()),
        set: variant.set.clone(),
        label: joined(name, &variant.label),
    };
    variants
        .iter()
        .flat_map(|variant| names.iter().map(move |name| in_case(variant, name)))
        .collect()
}

/// The parts between commas that no bracket encloses: `max(1, 2)` is one value.
fn listed(text: &str) -> Vec<&str> {
    let mut depth = 0_usize;
    text.split(|c: char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        c == ',' && depth == 0
    })
    .collect()
}

fn joined(a: &str, b: &str) -> String {
    if a.is_empty() || b.is_empty() { format!("{a}{b}") } else { format!("{a}, {b}") }
}

#[cfg(test)]
mod tests {
    use super::of_sets;

    #[test]
    fn lists_make_every_combination() {
        let set = ["R=1K/W,2K/W".to_owned(), "P=3W".to_owned(), "v=4,5".to_owned()];
        let all = of_sets(&set).unwrap();
        let labels: Vec<&str> = all.iter().map(|one| one.label.as_str()).collect();
        assert_eq!(labels, ["R=1K/W, v=4", "R=1K/W, v=5", "R=2K/W, v=4", "R=2K/W, v=5"]);
        assert_eq!(all[3].set, ["R=2K/W", "P=3W", "v=5"]);
        assert!(of_sets(&vec!["a=1,2".to_owned(); 11]).is_none());
        assert_eq!(of_sets(&["a=max(1, 2)".to_owned()]).unwrap().len(), 1);
        assert_eq!(of_sets(&["nonsense".to_owned()]).unwrap()[0].set, ["nonsense"]);
    }
}
