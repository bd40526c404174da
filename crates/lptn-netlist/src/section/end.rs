//! Names of nodes and boundaries, in fields that connect something to them.

use std::sync::Arc;

use lptn_data::{Diagnostic, Span, nearest};
use lptn_network::{End, GridFace, Input, NodeId, Placement, Terminal, is_name};
use lptn_units::{Dimension, Type, suggest};

use crate::fields::{Fields, Owner};
use crate::grid_part::{GridPart, KnownGrid};
use crate::raw::{RawKind, RawValue};
use crate::template::USE;
use crate::template::{by_port, wrong_path};
use crate::work::{Elaboration, stand_in};

impl<'a> Elaboration<'a> {
    /// The node, boundary or face of a grid that a field names.
    pub(crate) fn terminal(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
    ) -> Option<(Terminal, &'a RawValue)> {
        let (name, raw) = self.required_word(fields, key)?;
        let full = self.names.structure.inside(&raw.span, name);
        if let Some(id) = full.as_deref().and_then(|name| self.names.streams.get(name)) {
            return Some((Terminal::Stream(*id), raw));
        }
        if let Some((_, GridPart::Patch(patch))) =
            full.as_deref().and_then(|n| self.part_of_grid(n))
        {
            return Some((patch.into(), raw));
        }
        match self.face_at(&raw.span, name) {
            Some(at) => Some((at.into(), raw)),
            _ => self.named_end(fields, key, (name, raw)).map(|(end, raw)| (end.into(), raw)),
        }
    }

    /// The area of the face at which a path ends, or that two faces have in common.
    pub(crate) fn area_of(
        &self,
        fields: &Fields<'_>,
        ends: [&Option<(Terminal, &RawValue)>; 2],
        placement: &Placement<Input>,
    ) -> Option<Input> {
        let patch = ends.into_iter().flatten().find_map(|(terminal, _)| match terminal {
            Terminal::Patch(patch) => Some(*patch),
            _ => None,
        });
        let area = match faces(ends)[..] {
            _ if let Some(patch) = patch => self.builder.patch_area(patch),
            [a, b] => {
                let area = self.builder.common_area([a, b], placement);
                area.or_else(|| self.builder.face_area(a))
            }
            [face] => self.builder.face_area(face),
            _ => None,
        };
        // a name that was meant to be that of a face has been reported
        let meant = |key: &str| match fields.get(key).map(|raw| &raw.kind) {
            Some(RawKind::String { text, .. }) => {
                text.contains(['.', '[']) || self.names.grids.contains_key(text)
            }
            _ => false,
        };
        let lost =
            ends.into_iter().zip(["from", "to"]).any(|(end, key)| end.is_none() && meant(key));
        area.or_else(|| lost.then(|| stand_in(Type::of(Dimension::AREA))))
    }

    /// The grid with which `name` begins, and the part that it means; `None` for other names.
    pub(crate) fn part_of_grid<'n>(&self, name: &'n str) -> Option<(&'n str, GridPart)> {
        let part = self.names.grid_part(name)?;
        let other = self.builder.end(name).is_some_and(|end| !self.builder.is_part(end.into()));
        (!other).then_some(part)
    }

    /// The face that a name means at `place`, also the end of a rod, whose one surface has the same
    /// name.
    pub(crate) fn face_at(&self, place: &Span, name: &str) -> Option<GridFace> {
        let full = self.names.structure.inside(place, name)?;
        match self.names.grid_part(&full)? {
            (_, GridPart::Face(at)) => Some(at),
            _ => None,
        }
    }

    /// The part of a grid that a name means at `place`; inside a template it has to be one of the
    /// template's.
    pub(crate) fn part_of_grid_at(&self, place: &Span, name: &str) -> Option<GridPart> {
        let full = self.names.structure.inside(place, name)?;
        self.part_of_grid(&full).map(|(_, part)| part)
    }

    /// The name of a face after that of its grid.
    fn face_word(&self, at: GridFace) -> &'static str {
        self.builder.form(at.grid).map_or("", |form| form.face_name(at.face))
    }

    /// The node of a cell or of one cell of a face.
    fn end_in_grid(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        (name, raw): (&str, &'a RawValue),
        (grid, part): (&str, GridPart),
    ) -> Option<(End, &'a RawValue)> {
        let (code, message, help) = match part {
            GridPart::Surface(at) if self.builder.node_named(name).is_none() => (
                "netlist::unknown_cell",
                format!(
                    "{}: nothing is attached to face `{grid}.{}`",
                    fields.owner.field(key),
                    self.face_word(at)
                ),
                format!("name a cell of `{grid}` itself, or attach a path to the face"),
            ),
            GridPart::Cell | GridPart::Surface(_) => {
                let node = self.builder.node_named(name)?;
                return Some((End::Node(node), raw));
            }
            GridPart::Nothing(why, help) => {
                ("netlist::unknown_cell", format!("{}: {why}", fields.owner.field(key)), help)
            }
            GridPart::Whole(_) => (
                "netlist::not_an_end",
                format!("{} names a grid as a whole", fields.owner.field(key)),
                format!(
                    "name a face such as `{grid}.{}`, or a cell by its indices",
                    self.names.grids.get(grid).map_or("x1", KnownGrid::sample_face)
                ),
            ),
            GridPart::Face(_) | GridPart::Patch(_) => {
                let part = if matches!(part, GridPart::Face(_)) { "face" } else { "patch" };
                (
                    "netlist::not_a_node",
                    format!("{} names a {part} of a grid", fields.owner.field(key)),
                    "name one cell by its indices".to_owned(),
                )
            }
        };
        let problem = Diagnostic::error(code, message).at(raw.span.clone(), "");
        let problem = match self.names.grids.get(grid) {
            Some(known) => problem.also(known.span.clone(), "the grid"),
            None => problem,
        };
        self.report(problem.help(help));
        None
    }

    /// The node or boundary that a field names.
    pub(crate) fn end(&mut self, fields: &Fields<'a>, key: &str) -> Option<(End, &'a RawValue)> {
        let (name, raw) = self.required_word(fields, key)?;
        self.named_end(fields, key, (name, raw))
    }

    /// The node or boundary of this name.
    pub(crate) fn named_end(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        (name, raw): (&str, &'a RawValue),
    ) -> Option<(End, &'a RawValue)> {
        let structure = Arc::clone(&self.names.structure);
        let meant = structure.meaning(&raw.span, name);
        if let (None, Some(template)) = (&meant, structure.template_at(&raw.span)) {
            let problem = self.not_inside(fields, key, (name, raw), template);
            self.report(problem);
            return None;
        }
        let name = meant.as_deref().unwrap_or(name);
        if self.names.is_hidden(name) && self.builder.end(name).is_none() {
            return None; // the reason has been reported
        }
        if let Some(part) = self.part_of_grid(name) {
            return self.end_in_grid(fields, key, (name, raw), part);
        }
        match self.builder.end(name) {
            Some(end) => Some((end, raw)),
            None => {
                let problem = self.unknown_end((&fields.owner.field(key), key), (name, &raw.span));
                self.report(problem);
                None
            }
        }
    }

    /// Checks that every port leads to a node or boundary; others are reported once, here only.
    pub(crate) fn connections(&mut self) {
        for (line, connection) in self.structure.connections() {
            let (owner, value) = (Owner::element(USE.name, &line.key), &connection.value);
            let Some(fields) = Fields::of(&USE, owner.inside("connect"), line, &mut Vec::new())
            else {
                continue;
            };
            let RawKind::String { text, .. } = &value.kind else { continue };
            if self.named_end(&fields, &connection.port, (text, value)).is_none() {
                self.names.hide_name(&connection.target);
            }
        }
    }

    /// Error for a name in a template that is not one of its own.
    fn not_inside(
        &self,
        fields: &Fields<'_>,
        key: &str,
        (name, raw): (&str, &RawValue),
        template: &str,
    ) -> Diagnostic {
        let words = fields.owner.field(key);
        if self.builder.end(name).is_some() {
            let message = format!("{words} names `{name}`, which is not in template `{template}`");
            let problem = Diagnostic::error("netlist::outside_template", message);
            return problem.at(raw.span.clone(), "not in the template").help(by_port(name));
        }
        let message = format!(
            "template `{template}` has no node, boundary or port `{name}`, which {words} refers to"
        );
        let problem = Diagnostic::error("netlist::unknown_node", message).at(raw.span.clone(), "");
        let names = self.structure.names_at(&raw.span);
        problem.help(nearest(name, names.iter().copied(), "its names are"))
    }

    /// The node that a field names; a boundary is refused.
    pub(crate) fn node_end(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
    ) -> Option<(NodeId, &'a RawValue)> {
        let (end, raw) = self.end(fields, key)?;
        match end {
            End::Node(id) => Some((id, raw)),
            End::Boundary(_) => {
                let message = format!(
                    "{} names a boundary, which needs no capacity",
                    fields.owner.field(key)
                );
                let problem = Diagnostic::error("netlist::not_a_node", message)
                    .at(raw.span.clone(), "a boundary")
                    .help("a boundary keeps its temperature at any heat flow: name a node");
                self.report(problem);
                None
            }
        }
    }

    /// Error for a name, as in `from`, that no node or boundary has.
    pub(crate) fn unknown_end(
        &mut self,
        (from, key): (&str, &str),
        (name, at): (&str, &Span),
    ) -> Diagnostic {
        let wanted = if matches!(key, "node" | "into") { "node" } else { "node or boundary" };
        let message = format!("no {wanted} named `{name}`, which {from} refers to");
        let error = Diagnostic::error("netlist::unknown_node", message)
            .at(at.clone(), format!("no such {wanted}"));
        if let Some(wrong) = self.structure.wrong_path(name) {
            return wrong_path((from, name), at.clone(), wrong);
        }
        if let Some(near) = self.similar_end(name, wanted == "node") {
            let error = error.help(format!("did you mean `{near}`?"));
            return error.also(
                self.builder.end(&near).and_then(|end| self.map.name(end.into())),
                "similar name",
            );
        }
        let value = || self.names.value_kind(name).map(|kind| kind.word());
        match self.kind_of(name).or_else(value) {
            Some(kind) => error.help(format!("`{name}` is a {kind}; name the {wanted} itself")),
            None if self.similar_grid(name).is_some() => {
                let near = self.similar_grid(name).unwrap_or_default();
                error.help(format!("did you mean grid `{near}`?"))
            }
            None if is_name(name) => {
                error.help(format!("add it, for example {}", example(name, wanted)))
            }
            None => error.help("write the name as it is below [node] or [boundary]"),
        }
    }

    /// The grid that the beginning of a name resembles.
    fn similar_grid(&self, name: &str) -> Option<&str> {
        let (base, _) = name.split_once(['.', '['])?;
        suggest(base, self.names.grids.keys().map(String::as_str))
    }

    /// The most similar name of an end; in a tie, the first in the alphabet.
    fn similar_end(&mut self, name: &str, only_nodes: bool) -> Option<String> {
        if !self.names.may_search(self.builder.node_count()) {
            return None;
        }
        let mut candidates: Vec<&str> = self.builder.end_names(only_nodes).collect();
        candidates.sort_unstable();
        suggest(name, candidates.into_iter()).map(str::to_owned)
    }
}

/// The faces among the ends of a path.
pub(crate) fn faces(ends: [&Option<(Terminal, &RawValue)>; 2]) -> Vec<GridFace> {
    let face = |(terminal, _): &(Terminal, &RawValue)| match terminal {
        Terminal::Face(at) => Some(*at),
        Terminal::End(_) | Terminal::Stream(_) | Terminal::Patch(_) => None,
    };
    ends.into_iter().flatten().filter_map(face).collect()
}

fn example(name: &str, wanted: &str) -> String {
    let node = format!("`{name} = {{ T0 = \"25 degC\", C = \"500 J/K\" }}` below [node]");
    match wanted {
        "node" => node,
        _ => format!(
            "{node}, or, if its temperature is given, `{name} = {{ T = \"25 degC\" }}` below \
             [boundary]"
        ),
    }
}
