//! Streams along faces of grids: `along` and `direction` of `[advection]`.

use lptn_data::{Diagnostic, list};
use lptn_laws::Kind;
use lptn_network::{Field, Form, GridFace, Item, Path};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, Owner};
use crate::raw::{RawEntry, RawKind};
use crate::section::path_section::{ALONG, DIRECTION, PATHS, PathSection};
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The nodes of streams along faces: expressions and paths may name them.
    pub(crate) fn streams_along(&mut self) {
        for of in PATHS.iter().filter(|path| path.kind == Kind::Advection) {
            for entry in self.elements(of.section.name) {
                let RawKind::Table(table) = &entry.value.kind else { continue };
                if table.get(ALONG).is_some() && self.stream_along(entry, of).is_none() {
                    self.names.hide_grid(&entry.key);
                    self.left_out.paths = true;
                }
            }
        }
    }

    fn stream_along(&mut self, entry: &'a RawEntry, of: &'static PathSection) -> Option<()> {
        let owner = Owner::element(of.section.name, &entry.key);
        let fields = Fields::of(&of.section, owner, entry, &mut Vec::new())?;
        let at = self.along_face(&fields)?;
        let way = self.direction(&fields, at)?;
        let id = self.builder.face_stream(&entry.key, at, way)?;
        for node in self.builder.stream_nodes(id) {
            self.map.insert(Item::Node(node), Field::Name, entry.key_span.clone());
        }
        self.names.streams.insert(entry.key.clone(), id);
        Some(())
    }

    /// `along = "plate.z0"`.
    fn along_face(&mut self, fields: &Fields<'a>) -> Option<GridFace> {
        let (name, raw) = self.word(fields, ALONG)?;
        let face = self.face_at(&raw.span, name);
        if face.is_none() {
            let message = format!("{} is not a face of a grid", fields.owner.field(ALONG));
            let sample = self.names.grids.iter().next();
            let sample = sample.map(|(name, grid)| format!("`{name}.{}`", grid.sample_face()));
            let help = match sample {
                Some(face) => format!("name a face, such as {face}"),
                None => "a stream flows along a face of a [grid]; without one leave it out".into(),
            };
            self.refuse("netlist::stream_along", message, &raw.span, help);
        }
        face
    }

    /// `direction = "-x"`: the axis, and true if the stream flows against it.
    fn direction(&mut self, fields: &Fields<'a>, at: GridFace) -> Option<(usize, bool)> {
        let names = self.builder.form(at.grid).unwrap_or(Form::Block).directions();
        let along = at.face.along();
        let axes = along.map(|axis| names[axis]);
        let help = format!(
            "write `direction = \"{}\"` or `direction = \"{}\"`, with `-` for a flow against it",
            axes[0], axes[1]
        );
        let Some(raw) = fields.get(DIRECTION) else {
            let message = format!("{} has `along` but no `direction`", fields.owner.words());
            let problem = Diagnostic::error("netlist::stream_direction", message);
            self.report(problem.at(fields.place.clone(), "`direction` is missing").help(help));
            return None;
        };
        let (text, _) = self.word(fields, DIRECTION)?;
        let found = axes.iter().position(|name| *name == text.trim_start_matches('-'));
        if found.is_none() {
            let message = format!(
                "{} must be an axis along the face, {}",
                fields.owner.field(DIRECTION),
                list(&axes)
            );
            self.refuse("netlist::stream_direction", message, &raw.span, help);
        }
        Some((along[found?], text.starts_with('-')))
    }

    /// The flow of a stream from row to row.
    pub(super) fn flow_along(
        &mut self,
        entry: &'a RawEntry,
        of: &'static PathSection,
        fields: &Fields<'a>,
    ) -> Option<()> {
        let (from, to) = (self.end(fields, "from"), self.end(fields, "to"));
        let path = self.path(fields, of);
        let formula = path.as_ref().map(|path| path.formula());
        self.names.learn_results(&entry.key, of.kind, formula);
        let path = path.unwrap_or_else(|| Path::stream(stand_in(Type::of(Dimension::CONDUCTANCE))));
        let (from, to) = (from?, to?);
        let id = *self.names.streams.get(&entry.key)?;
        for conductor in self.builder.flow_along(id, of.kind, (from.0, to.0), path) {
            let item = Item::Conductor(conductor);
            self.map.conductor(of.section.name);
            let ends = ((from.0.into(), from.1), (to.0.into(), to.1));
            self.map_fields((item, of), fields, ends);
            self.map.insert(item, Field::Name, entry.key_span.clone());
        }
        Some(())
    }
}
