//! `patch` of a grid: rectangles and circles of its faces, by their place.

use lptn_data::Diagnostic;
use lptn_network::{Field, Form, GridFace, GridId, Input, Item, Outline, Patch, is_name};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::format::{KeyDeclaration, SectionDeclaration, Takes, key, shaped, text};
use crate::grid_names::VALUES;
use crate::place::Wanted;
use crate::raw::{RawEntry, RawValue};
use crate::work::Elaboration;

/// The patches of a grid.
pub(super) const PATCHES: KeyDeclaration = shaped(
    "patch",
    "table of patches",
    Takes::Each(&Takes::Table(&PATCH)),
    "rectangles and circles of its faces, by name",
    "{ chip = { on = \"z1\", centre = [\"15 mm\", \"24 mm\"], size = [\"10 mm\", \"8 mm\"] } }",
);

const PATCH: SectionDeclaration = SectionDeclaration {
    name: "patch",
    sentence: "A rectangle or circle of a face of a grid.",
    keys: &[
        text("on", "face of the grid", "the face on which it lies", "\"z1\"").needed(),
        shaped(
            "centre",
            "list of two places",
            Takes::List(&Takes::Quantity(""), 2, 2),
            "its middle along the two axes of the face, in the order x, y, z or r, phi, z",
            "[\"15 mm\", \"24 mm\"]",
        )
        .or("the middle of the face"),
        shaped(
            "size",
            "list of two lengths",
            Takes::List(&Takes::Quantity(""), 2, 2),
            "of a rectangle, along the two axes of the face; an angle along phi",
            "[\"10 mm\", \"8 mm\"]",
        ),
        key("radius", "m", "of a circle", "\"5 mm\""),
    ],
    either: &[&["size", "radius"]],
    example: "{ on = \"z1\", centre = [\"15 mm\", \"24 mm\"], size = [\"10 mm\", \"8 mm\"] }",
    elsewhere: &[
        ("center", "the middle is `centre`"),
        ("offset", "the middle is `centre`, counted from where the axes of the grid begin"),
        ("position", "the middle is `centre`"),
        ("diameter", "a circle has a `radius`"),
        ("r", "a circle has a `radius`"),
        ("face", "the face is `on`"),
        ("width", "a rectangle has a `size` of two lengths"),
    ],
    ..SectionDeclaration::NEW
};

const LENGTH: Type = Type::of(Dimension::LENGTH);

impl<'a> Elaboration<'a> {
    /// The lines of the patches of a grid.
    pub(super) fn patch_entries(&mut self, fields: &Fields<'a>) -> Option<&'a [RawEntry]> {
        if fields.get(PATCHES.name).is_none() {
            return Some(&[]);
        }
        Some(&self.table_of(fields, (PATCHES.name, "a table of patches"))?.entries)
    }

    /// The patches of a grid; `None` if one of them is wrong.
    pub(super) fn patches(
        &mut self,
        (owner, grid): (&Owner<'_>, &str),
        id: GridId,
        entries: &'a [RawEntry],
    ) -> Option<()> {
        let mut wrong = false;
        for entry in entries {
            if self.patch((owner, grid), id, entry).is_none() {
                self.names.hide_name(&format!("{grid}.{}", entry.key));
                wrong = true;
            }
        }
        (!wrong).then_some(())
    }

    fn patch(
        &mut self,
        (owner, grid): (&Owner<'_>, &str),
        id: GridId,
        entry: &'a RawEntry,
    ) -> Option<()> {
        let owner = owner.inside(&format!("patch.{}", entry.key));
        let fields = self.inner(&PATCH, owner, entry)?;
        let form = self.builder.form(id).unwrap_or(Form::Block);
        self.patch_name(&fields, entry, form)?;
        let face = self.patch_face(&fields, form)?;
        let at = GridFace { grid: id, face };
        let (types, before) = (self.builder.patch_types(at), self.problems.len());
        let outline = self.outline(&fields, types)?;
        let centre = match fields.get("centre") {
            Some(_) => Some(self.two_places(&fields, "centre", types)?),
            None => None,
        };
        if self.problems.len() > before {
            return None;
        }
        let patch = self.builder.patch(id, Patch::new(&entry.key, face, outline, centre))?;
        let noted = [Field::Centre, Field::Size, Field::Radius];
        self.note(Item::Patch(patch), &entry.key_span, &fields, &noted);
        let known = self.names.grids.get_mut(grid)?;
        known.patches.push((entry.key.clone(), patch));
        Some(())
    }

    /// Checks that the name of a patch is not that of another part of the grid.
    fn patch_name(&mut self, fields: &Fields<'a>, entry: &RawEntry, form: Form) -> Option<()> {
        let name = entry.key.as_str();
        let taken = form.face_named(name).is_some()
            || form.directions().contains(&name)
            || VALUES.contains(&name)
            || name == "T";
        if is_name(name) && !taken {
            return Some(());
        }
        let why = if taken { "the name of another part of a grid" } else { "not a name" };
        let message = format!("{}: `{name}` is {why}", fields.owner.words());
        let help = "name it after the part on it, for example `chip`";
        self.refuse("netlist::patch_name", message, &entry.key_span, help);
        None
    }

    /// `on = "z1"`.
    fn patch_face(&mut self, fields: &Fields<'a>, form: Form) -> Option<lptn_network::Face> {
        let (word, raw) = self.required_word(fields, "on")?;
        let face = form.face_named(word);
        if face.is_none() {
            let all: Vec<String> =
                form.faces().map(|face| format!("`\"{}\"`", form.face_name(face))).collect();
            let message = format!("{} is not a face of the grid", fields.owner.field("on"));
            let help = format!("its faces are {}", all.join(", "));
            self.refuse("netlist::patch_face", message, &raw.span, help);
        }
        face
    }

    /// `size = ["10 mm", "8 mm"]` or `radius = "5 mm"`.
    fn outline(&mut self, fields: &Fields<'a>, types: [Type; 2]) -> Option<Outline<Input>> {
        match (fields.get("size"), fields.get("radius")) {
            (Some(_), None) => Some(Outline::Rectangle(self.two_places(fields, "size", types)?)),
            (None, Some(_)) => {
                self.input(fields, "radius", Wanted::constant(LENGTH)).map(Outline::Circle)
            }
            (Some(_), Some(_)) => {
                let message = "has both `size` and `radius`".to_owned();
                let problem = fields.several("netlist::patch_outline", message, ["size", "radius"]);
                self.report(problem.help("a rectangle has a `size`, a circle a `radius`"));
                None
            }
            (None, None) => {
                if fields.complete {
                    let message =
                        format!("{} has neither `size` nor `radius`", fields.owner.words());
                    let problem = Diagnostic::error("netlist::patch_outline", message);
                    let help =
                        format!("add `{}` or `{}`", fields.sample("size"), fields.sample("radius"));
                    self.report(problem.at(fields.place.clone(), "has no outline").help(help));
                }
                None
            }
        }
    }

    /// Two lengths, or a length and an angle.
    fn two_places(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        types: [Type; 2],
    ) -> Option<[Input; 2]> {
        let [a, b] = self.two(fields, (key, "a list of two places"))?;
        let mut read = |raw: &RawValue, ty| self.input_at(fields, key, raw, Wanted::constant(ty));
        Some([read(a, types[0]), read(b, types[1])])
    }
}
