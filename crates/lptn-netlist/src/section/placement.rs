//! The place of a face on another one: `offset` and `axes` of a path between two faces.

use lptn_data::{Diagnostic, list};
use lptn_network::{Form, GridFace, Input, Placement, Terminal};
use lptn_units::{Dimension, Type};

use crate::fields::Fields;
use crate::place::{Place, Wanted};
use crate::raw::{RawKind, RawValue};
use crate::section::end::faces;
use crate::section::path_section::{AXES, OFFSET};
use crate::work::Elaboration;

const LENGTH: Type = Type::of(Dimension::LENGTH);

impl<'a> Elaboration<'a> {
    /// The place of the face at `from` on that at `to`; faces with one middle if nothing is given.
    pub(super) fn placement(
        &mut self,
        fields: &Fields<'a>,
        ends: [&Option<(Terminal, &RawValue)>; 2],
    ) -> Placement<Input> {
        let mut placement = Placement::default();
        if !fields.known(OFFSET) {
            return placement;
        }
        let both = ends.iter().all(|end| end.is_some());
        let [_, to] = match faces(ends)[..] {
            [a, b] if self.are_blocks([a, b]) => [a, b],
            _ => {
                let why = "has no effect unless `from` and `to` are faces of blocks";
                let keys = if both { &[OFFSET, AXES][..] } else { &[] };
                self.refuse_keys(fields, keys, why);
                return placement;
            }
        };
        placement.offset = self.offset(fields);
        placement.axes = self.axes(fields, to).unwrap_or(placement.axes);
        placement
    }

    fn are_blocks(&self, faces: [GridFace; 2]) -> bool {
        faces.iter().all(|at| self.builder.form(at.grid) == Some(Form::Block))
    }

    /// `offset = ["5 mm", "-2 mm"]`.
    fn offset(&mut self, fields: &Fields<'a>) -> Option<[Input; 2]> {
        let [a, b] = self.two(fields, (OFFSET, "a list of two lengths"))?;
        let wanted = Wanted::constant(LENGTH);
        let mut read = |raw| {
            let place = Place { owner: &fields.owner, key: OFFSET, raw };
            Some(self.given(place, wanted)?.input())
        };
        let (a, b) = (read(a), read(b));
        Some([a?, b?])
    }

    /// `axes = ["y", "-x"]`.
    fn axes(&mut self, fields: &Fields<'a>, to: GridFace) -> Option<[(usize, bool); 2]> {
        let [a, b] = self.two(fields, (AXES, "a list of two axes"))?;
        let names = to.face.along().map(|axis| ["x", "y", "z"][axis]);
        let axis = |raw: &RawValue| {
            let RawKind::String { text, .. } = &raw.kind else { return None };
            let name = text.trim_start_matches('-');
            let at = names.iter().position(|known| *known == name)?;
            Some((at, text.starts_with('-')))
        };
        let read = [a, b].map(axis);
        if let [Some(a), Some(b)] = read
            && a.0 != b.0
        {
            return Some([a, b]);
        }
        let wrong = if read[0].is_none() { a } else { b };
        let [first, second] = names;
        let message = format!(
            "{} must be the two axes of the face at `to`, {}",
            fields.owner.field(AXES),
            list(&names)
        );
        let help = format!(
            "write `axes = [\"{first}\", \"{second}\"]` or `axes = [\"{second}\", \"{first}\"]`, \
             with `-` before an axis that runs the other way"
        );
        self.refuse("netlist::face_axes", message, &wrong.span, help);
        None
    }

    /// The values of a list of two.
    pub(super) fn two(
        &mut self,
        fields: &Fields<'a>,
        (key, what): (&str, &str),
    ) -> Option<[&'a RawValue; 2]> {
        match self.list(fields, (key, what))? {
            [a, b] => Some([a, b]),
            list => {
                let raw = fields.get(key)?;
                let message = format!("{} has {} values", fields.owner.field(key), list.len());
                let problem = Diagnostic::error("netlist::wrong_shape", message);
                let help =
                    format!("give two, one for each axis of the face: `{}`", fields.sample(key));
                self.report(problem.at(raw.span.clone(), "").help(help));
                None
            }
        }
    }
}
