//! `[junction]` and `[branch]`: a flow network, written out as named values and states before
//! anything is read.
//!
//! A branch gives its mass flow as an explicit function of the pressure difference between its ends
//! and of temperatures. It becomes a `[value]` of its name. The pressure of a junction becomes a
//! `[state]` whose balance is the sum of the flows of its branches, so that Newton's method solves
//! pressures and temperatures together. Mass is balanced, not volume, because a density may depend
//! on temperature. Streams, sources and limits read a flow by the name of its branch.

mod branch;
mod check;
mod declaration;
mod law;
mod pump;

use std::sync::Arc;

use lptn_data::Diagnostic;
use lptn_units::{Dimension, Type};

pub(crate) use declaration::{BRANCH, JUNCTION};

use crate::fields::{Fields, Owner};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::template::Structure;
use crate::written_out::WrittenOut;
use branch::Branch;

/// Values `NAME.KEY` that are not results.
pub(crate) const INNER: [&str; 11] = [
    "dp",
    "density",
    "viscosity",
    "flow_T",
    "relative",
    "clipped",
    "root",
    "excess",
    "f_Re_squared",
    "laminar_part",
    "sqrt_f_Re",
];

/// Pressures in Pa.
const PRESSURE: Type = Type::of(Dimension::PRESSURE);

/// The pressure at which the search for a junction begins, and its usual size.
const START: &str = "0 bar";
const SIZE: &str = "1 bar";

/// Replaces junctions and branches by values and states; the types that some of these have to have.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &mut Arc<Structure>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(String, Type)> {
    let (junctions, entries) = (raw.take(JUNCTION.name), raw.take(BRANCH.name));
    let mut made = Vec::new();
    let mut branches = Vec::new();
    let before = problems.len();
    for entry in &entries {
        let owner = Owner::element(BRANCH.name, &entry.key);
        let Some(fields) = Fields::of(&BRANCH, owner, entry, problems) else { continue };
        let out = WrittenOut::new((raw, structure), entry);
        match Branch::read((structure, &junctions), (entry, &fields), out, problems) {
            Some((branch, out)) => {
                branches.push(branch);
                made.push((out.made, out.types));
            }
            None => lose(structure, entry),
        }
    }
    for entry in &junctions {
        let owner = Owner::element(JUNCTION.name, &entry.key);
        let Some(fields) = Fields::of(&JUNCTION, owner, entry, problems) else { continue };
        let out = WrittenOut::new((raw, structure), entry);
        match junction((structure, &branches), (entry, &fields), out) {
            Some(out) => made.push((out.made, out.types)),
            None => lose(structure, entry),
        }
    }
    // a branch that cannot be read leaves its junctions alone
    if problems.len() == before {
        check::check(&junctions, &branches, problems);
    }
    let mut types = Vec::new();
    for (elements, own) in made {
        elements.into_iter().for_each(|(section, entry)| raw.push(section, entry));
        types.extend(own);
    }
    types
}

fn lose(structure: &mut Arc<Structure>, entry: &RawEntry) {
    Arc::make_mut(structure).lose(&entry.key);
}

/// A junction with a given pressure is a value, any other a state; `None` without a branch.
fn junction<'r>(
    (structure, branches): (&Structure, &[Branch]),
    (entry, fields): (&RawEntry, &Fields<'_>),
    mut out: WrittenOut<'r>,
) -> Option<WrittenOut<'r>> {
    if let Some(p) = fields.get("p") {
        out.given("", p);
        out.typed("", PRESSURE);
        return Some(out);
    }
    let around = structure.instance_at(&entry.key_span);
    // the name of a branch at the place of the junction
    let near = |name: &str| match around.and_then(|path| name.strip_prefix(path)?.strip_prefix('.'))
    {
        Some(own) => own.to_owned(),
        None => name.to_owned(),
    };
    let mut balance = String::new();
    for branch in branches {
        for (end, sign) in [(&branch.ends[0], '-'), (&branch.ends[1], '+')] {
            if *end == entry.key {
                balance += &format!(" {sign} {}", near(&branch.name));
            }
        }
    }
    let balance = balance.trim_start().trim_start_matches("+ ").to_owned();
    if balance.is_empty() {
        return None;
    }
    let state = out.state(fields, balance);
    out.put(ValueKind::State.section(), "", state);
    Some(out)
}

impl WrittenOut<'_> {
    /// The state of a junction.
    fn state(&self, fields: &Fields<'_>, balance: String) -> RawValue {
        let (start, size) = (START.to_owned(), SIZE.to_owned());
        let mut state = self.table(&[("balance", balance), ("start", start), ("size", size)]);
        if let RawKind::Table(table) = &mut state.kind {
            for entry in &mut table.entries {
                fields.entry(&entry.key).into_iter().for_each(|given| *entry = given.clone());
            }
        }
        state
    }
}
