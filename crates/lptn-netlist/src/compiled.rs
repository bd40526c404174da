//! Expressions of paths and sources by their text: scripts write one many times.
//!
//! Only these are shared. A property of a material is known by its place in memory
//! (`expand/substances.rs`), and a name inside a template has another meaning in each instance.

use std::sync::Arc;

use foldhash::HashMap;
use lptn_data::CopyId;
use lptn_network::Context;
use lptn_units::Program;

use crate::place::{Place, Wanted};
use crate::raw::RawKind;

/// Expressions that were compiled without a problem.
#[derive(Debug, Default)]
pub(crate) struct Compiled {
    known: HashMap<String, Vec<(Wanted, Arc<Program>)>>,
}

impl Compiled {
    /// The program of a value whose text was compiled before.
    pub(crate) fn get(&self, place: Place<'_>, wanted: Wanted) -> Option<&Arc<Program>> {
        let same = self.known.get(shared(place, wanted)?)?;
        same.iter().find(|(other, _)| *other == wanted).map(|(_, program)| program)
    }

    /// Notes the program of a value.
    pub(crate) fn insert(&mut self, place: Place<'_>, wanted: Wanted, program: &Arc<Program>) {
        if let Some(text) = shared(place, wanted) {
            let same = self.known.entry(text.to_owned()).or_default();
            same.push((wanted, Arc::clone(program)));
        }
    }
}

/// The text of a value whose program may be shared.
fn shared(place: Place<'_>, wanted: Wanted) -> Option<&str> {
    let RawKind::String { text, .. } = &place.raw.kind else { return None };
    let law = matches!(wanted.context, Context::Link | Context::Source);
    (law && place.raw.span.copy == CopyId::WRITTEN).then_some(text)
}
