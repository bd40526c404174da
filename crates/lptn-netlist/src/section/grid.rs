//! `[grid]`: bodies that are cut into cells, and connections at their faces.

use lptn_data::Diagnostic;
use lptn_network::{Field, Form, GridId, Input, Item, Substance};
use lptn_units::{Dimension, Type};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, Takes, key, shaped, words};
use crate::grid_part::{GridPart, KnownGrid};
use crate::place::Wanted;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;
use crate::section::default::Initial;
use crate::section::direction::AXIS_OF;
use crate::section::grid_shape::{Made, SHAPES};
use crate::section::keys::{CP, DENSITY, MATERIAL_OF};
use crate::section::node::START;
use crate::section::patch::PATCHES;
use crate::section::path_section::PATHS;
use crate::work::{Elaboration, stand_in};

/// A body that is cut into cells.
pub(crate) const GRID: SectionDeclaration = SectionDeclaration {
    name: "grid",
    sentence: "A block or a cylinder that is cut into cells.",
    role: Role::Element,
    keys: &[
        words("shape", &SHAPES, "its shape", "\"cylinder\"").or("`\"block\"`"),
        shaped(
            "size",
            "list of three lengths",
            Takes::List(&Takes::Quantity("m"), 3, 3),
            "of a block, along x, y and z",
            "[\"0.5 m\", \"0.5 m\", \"20 mm\"]",
        ),
        key("r_in", "m", "inner radius of a cylinder; 0 without a hole", "\"8 mm\"")
            .or("`\"0 m\"`"),
        key("r_out", "m", "outer radius of a cylinder", "\"21 mm\""),
        key("length", "m", "length of a cylinder along its axis", "\"70 mm\""),
        key("angle", "deg", "angle of a sector of a cylinder, less than 360 deg", "\"90 deg\"")
            .or("the full circle, closed"),
        shaped(
            "cells",
            "list of one to three whole numbers",
            Takes::List(&Takes::Whole, 1, 3),
            "numbers of cells along x, y and z, or along r, around the axis and along z",
            "[20, 20, 4]",
        )
        .needed(),
        MATERIAL_OF,
        AXIS_OF,
        shaped(
            "k",
            "W/(m K), or three",
            Takes::Either(&[
                Takes::Property("W/(m K)"),
                Takes::List(&Takes::Quantity("W/(m K)"), 3, 3),
            ]),
            "conductivity, or those along x, y and z, or r, phi and z",
            "\"46.6 W/(m K)\"",
        ),
        DENSITY,
        CP,
        START,
        PATCHES,
    ],
    either: &[&["material", "k"], &["size", "shape"], &["size", "r_out"], &["size", "length"]],
    example: "{ size = [\"0.5 m\", \"0.5 m\", \"20 mm\"], cells = [20, 20, 4], material = \
        \"steel_8620\" }",
    elsewhere: &[
        ("rho", "the density is `density`"),
        ("lambda", "the thermal conductivity is `k`"),
        (
            "C",
            "the capacity of a grid follows from its size and its `material`, or `density` and \
             `cp`",
        ),
        ("T", "the temperature at the start is `T0`"),
        ("area", "the areas follow from the lengths"),
        ("diameter", "the outer radius of a cylinder is `r_out`"),
        ("radius", "the outer radius of a cylinder is `r_out`"),
        ("R", "the outer radius of a cylinder is `r_out`"),
        ("height", "the length of a cylinder along its axis is `length`"),
        ("patches", "rectangles and circles of its faces are in `patch`"),
    ],
    ..SectionDeclaration::NEW
};

const LENGTH: Type = Type::of(Dimension::LENGTH);
const CONDUCTIVITY: Type = Type::of(Dimension::CONDUCTIVITY);

/// The fields of a grid whose places are noted, without radii and length.
const FIELDS: [Field; 8] = [
    Field::Size,
    Field::Sector,
    Field::Cells,
    Field::Material,
    Field::Conductivity,
    Field::Density,
    Field::SpecificHeat,
    Field::Initial,
];

impl<'a> Elaboration<'a> {
    /// The grids, and the surfaces of all faces that are named: expressions may use their
    /// temperatures before the path that ends there is read.
    pub(crate) fn grids(&mut self, default: Option<&Initial<'a>>) {
        for entry in self.elements(GRID.name) {
            if self.grid(entry, default).is_none() {
                self.names.hide_grid(&entry.key);
                self.left_out.paths = true;
                self.left_out.sections = true;
            }
        }
        if self.names.grids.is_empty() {
            return;
        }
        let sections = PATHS.iter().map(|path| path.section.name);
        let entries: Vec<&'a RawEntry> = sections.flat_map(|name| self.elements(name)).collect();
        for entry in entries {
            if let RawKind::Table(table) = &entry.value.kind {
                let named = table
                    .entries
                    .iter()
                    .filter(|f| matches!(f.key.as_str(), "from" | "to" | "into"));
                named.for_each(|field| self.attach(&field.value));
            }
        }
    }

    /// Makes the surfaces of a face that is named here.
    fn attach(&mut self, raw: &RawValue) {
        let names = match &raw.kind {
            RawKind::String { text, .. } => vec![text.as_str()],
            RawKind::Table(table) => table.entries.iter().map(|entry| entry.key.as_str()).collect(),
            _ => Vec::new(),
        };
        for name in names {
            let Some(full) = self.names.structure.inside(&raw.span, name) else { continue };
            let (own, at) = match self.names.grid_part(&full) {
                Some((own, GridPart::Face(at) | GridPart::Surface(at))) => (own, at),
                Some((own, GridPart::Patch(patch))) => (own, patch.at),
                _ => continue,
            };
            let before = self.builder.sizes();
            self.builder.surfaces(at.grid, at.face);
            self.note_parts(before, Item::Grid(at.grid), GRID.name);
            if let Some(known) = self.names.grids.get_mut(own)
                && !known.attached.contains(&at.face)
            {
                known.attached.push(at.face);
            }
        }
    }

    /// Notes that the nodes and conductors made since `before` are parts of `whole`.
    pub(crate) fn note_parts(
        &mut self,
        before: (usize, usize),
        whole: Item,
        section: &'static str,
    ) {
        let (nodes, conductors) = self.builder.sizes();
        self.map.parts((before.0..nodes, before.1..conductors), whole);
        (before.1..conductors).for_each(|_| self.map.conductor(section));
    }

    fn grid(&mut self, entry: &'a RawEntry, default: Option<&Initial<'a>>) -> Option<()> {
        let fields = self.fields(&GRID, entry)?;
        let round = self.is_round(&fields);
        let lengths = round.and_then(|round| self.shape(&fields, round));
        let cells = self.cell_counts(&fields);
        let made = self.substance(&fields, round);
        let own = self.initial(&fields);
        let initial_at = fields.get("T0").or(default.map(|(_, raw)| *raw));
        let initial = own.or_else(|| default.map(|(input, _)| input.clone()));
        let initial =
            initial.or_else(|| (!fields.complete).then(|| stand_in(Type::ABSOLUTE_TEMPERATURE)));
        let patches = self.patch_entries(&fields);
        let (made, cells) = (made?, cells?);
        let before = self.builder.sizes();
        let id = self.builder.grid(&entry.key, lengths?.body(cells.clone(), made, initial));
        let item = Item::Grid(id);
        self.note_parts(before, item, GRID.name);
        let of_laws = ["r_in", "r_out", "length"].into_iter().filter_map(Field::of_law);
        let noted: Vec<Field> = FIELDS.into_iter().chain(of_laws).collect();
        self.note(item, &entry.key_span, &fields, &noted);
        if let Some(raw) = initial_at {
            self.map.value(item, Field::Initial, raw);
        }
        self.know_grid(entry, id, cells);
        self.patches((&fields.owner, &entry.key), id, patches?)
    }

    fn know_grid(&mut self, entry: &RawEntry, id: GridId, cells: Vec<usize>) {
        let form = self.builder.form(id).unwrap_or(Form::Block);
        let span = entry.key_span.clone();
        let known = KnownGrid { id, form, cells, span, attached: Vec::new(), patches: Vec::new() };
        self.names.grids.entry(entry.key.clone()).or_insert(known);
    }

    /// `size = ["0.5 m", "0.5 m", "20 mm"]`.
    pub(super) fn lengths(&mut self, fields: &Fields<'a>) -> Option<[Input; 3]> {
        let raw = self.require(fields, "size")?;
        let list = self.list(fields, ("size", "a list of three lengths"))?;
        let [x, y, z] = list else {
            let message =
                format!("{} has {}, not three", fields.owner.field("size"), lengths(list.len()));
            let help = "a block has three lengths, along x, y and z, even if it is not divided";
            let help = format!("{help}: `{}`", fields.sample("size"));
            self.refuse("netlist::grid_size", message, &raw.span, help);
            return None;
        };
        Some([x, y, z].map(|raw| self.input_at(fields, "size", raw, Wanted::constant(LENGTH))))
    }

    /// `cells = [20, 20, 4]`.
    fn cell_counts(&mut self, fields: &Fields<'a>) -> Option<Vec<usize>> {
        let raw = self.require(fields, "cells")?;
        let list = self.list(fields, ("cells", "a list of one to three whole numbers"))?;
        if list.is_empty() || list.len() > 3 {
            let words = fields.owner.field("cells");
            let message = format!("{words} has {} counts, not one to three", list.len());
            let help = format!("give one for each direction: `{}`", fields.sample("cells"));
            self.refuse("netlist::grid_cells", message, &raw.span, help);
            return None;
        }
        all(list.iter().map(|raw| self.cell_count(fields, raw)))
    }

    fn cell_count(&mut self, fields: &Fields<'a>, raw: &RawValue) -> Option<usize> {
        let text = match &raw.kind {
            RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => {
                self.report(fields.wrong_shape("cells", raw, "a list of whole numbers"));
                return None;
            }
        };
        let count = text.parse().ok().filter(|count: &usize| *count > 0);
        if count.is_none() {
            let words = fields.owner.field("cells");
            let message = format!("{words} must be whole numbers of at least 1, got {text}");
            let help = "a direction in which the body is not divided has 1 cell";
            self.refuse("netlist::grid_cells", message, &raw.span, help);
        }
        count
    }

    /// The substance of the grid, and its conductivity in each direction.
    fn substance(&mut self, fields: &Fields<'a>, round: Option<bool>) -> Option<Made> {
        let k = fields.get("k").map(|raw| self.conductivities(fields, raw));
        if fields.get("material").is_some() {
            self.refuse_keys(fields, &["density", "cp"], "is that of the material");
            return self.of_material(fields, k, round);
        }
        if fields.complete && ["k", "density", "cp"].iter().all(|key| fields.get(key).is_none()) {
            let message = format!(
                "{} has neither a `material` nor `k`, `density` and `cp`",
                fields.owner.words()
            );
            let problem = Diagnostic::error("netlist::missing_field", message);
            self.report(problem.at(fields.place.clone(), "has no properties").help(format!(
                "add `{}`, or the properties themselves",
                fields.sample("material")
            )));
            return None;
        }
        self.refuse_keys(fields, &[AXIS_OF.name], "has no effect without `material`");
        for key in ["k", "density", "cp"] {
            self.require(fields, key);
        }
        let density =
            self.property(fields, "density", Wanted::constant(Type::of(Dimension::DENSITY)));
        let cp = self.property(fields, "cp", Wanted::own(Type::of(Dimension::SPECIFIC_HEAT)));
        Some((Substance::Properties { density: density?, cp: cp? }, k?))
    }

    fn of_material(
        &mut self,
        fields: &Fields<'a>,
        k: Option<[Input; 3]>,
        round: Option<bool>,
    ) -> Option<Made> {
        let (name, raw) = self.word(fields, "material")?;
        let known = self.known_material(fields, ("material", name), raw)?;
        let needs = [("density", known.density), ("cp", known.cp), ("k", known.k || k.is_some())];
        let missing: Vec<&str> =
            needs.into_iter().filter(|(_, has)| !has).map(|(key, _)| key).collect();
        for property in &missing {
            let problem = self.without_property(fields, (name, raw), known.id, property);
            self.report(problem);
        }
        if !missing.is_empty() {
            return None;
        }
        let k = match k {
            Some(k) => {
                self.refuse_keys(fields, &[AXIS_OF.name], "has no effect: `k` is given");
                k
            }
            None => self.along_axes(fields, (name, known), round?)?,
        };
        Some((Substance::Material(known.id), k))
    }

    /// One conductivity, or those in each direction.
    fn conductivities(&mut self, fields: &Fields<'a>, raw: &'a RawValue) -> [Input; 3] {
        let wanted = Wanted::own(CONDUCTIVITY);
        let RawKind::Array(list) = &raw.kind else {
            let k = self.property(fields, "k", wanted).unwrap_or_else(|| stand_in(CONDUCTIVITY));
            return [k.clone(), k.clone(), k];
        };
        let [x, y, z] = list.as_slice() else {
            let message = format!("{} has {} values", fields.owner.field("k"), list.len());
            let help = format!(
                "give one for all directions, `{}`, or one for each of the three",
                fields.sample("k")
            );
            self.refuse("netlist::grid_conductivity", message, &raw.span, help);
            return [(); 3].map(|()| stand_in(CONDUCTIVITY));
        };
        [x, y, z].map(|raw| self.input_at(fields, "k", raw, wanted))
    }
}

fn lengths(count: usize) -> String {
    if count == 1 { "one length".into() } else { format!("{count} lengths") }
}
