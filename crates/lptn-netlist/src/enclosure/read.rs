//! Reads an enclosure.

use lptn_data::Diagnostic;

use super::ENCLOSURE;
use super::surface::Surface;
use super::view::Views;
use crate::fields::{Fields, Owner};
use crate::raw::{RawEntry, RawKind};
use crate::reading::all;

/// An enclosure as it is written.
pub(super) struct Read<'r> {
    pub(super) surfaces: Vec<Surface<'r>>,
    /// A F of each pair of surfaces that see each other, in m^2.
    pub(super) exchange: Vec<(usize, usize, f64)>,
}

impl<'r> Read<'r> {
    /// Reads an enclosure and reports its errors; `None` if there are any.
    pub(super) fn of(entry: &'r RawEntry, problems: &mut Vec<Diagnostic>) -> Option<Self> {
        let owner = Owner::element(ENCLOSURE.name, &entry.key);
        let fields = Fields::of(&ENCLOSURE, owner, entry, problems)?;
        let surfaces = surfaces(&fields, problems);
        let listed = fields.require("view_factors", problems);
        let (surfaces, listed) = (surfaces?, listed?);
        let exchange = Views { fields: &fields, surfaces: &surfaces, problems }.exchange(listed)?;
        fields.complete.then_some(Self { surfaces, exchange })
    }
}

fn surfaces<'r>(fields: &Fields<'r>, problems: &mut Vec<Diagnostic>) -> Option<Vec<Surface<'r>>> {
    let raw = fields.require("surfaces", problems)?;
    let RawKind::Table(table) = &raw.kind else {
        problems.push(fields.wrong_shape("surfaces", raw, "a table of surfaces"));
        return None;
    };
    if table.entries.len() < 2 {
        let message = format!("{} has {} surfaces", fields.owner.words(), table.entries.len());
        let problem = Diagnostic::error("netlist::enclosure_surfaces", message);
        let help = "surfaces exchange radiation with others: list at least two";
        problems.push(problem.at(raw.span.clone(), "").help(help));
        return None;
    }
    all(table.entries.iter().map(|entry| Surface::of(fields, entry, problems)))
}
