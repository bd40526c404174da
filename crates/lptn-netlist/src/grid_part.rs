//! Names inside grids: `wall[1,2,3]`, `wall.x1`, `wall.x1[2,3]`.

use lptn_data::Span;
use lptn_network::{Face, Form, GridFace, GridId, GridPatch};

/// The data of a grid that names need.
#[derive(Clone, Debug)]
pub(crate) struct KnownGrid {
    pub(crate) id: GridId,
    /// The directions and faces that it has.
    pub(crate) form: Form,
    /// Number of cells along each axis that has an index.
    pub(crate) cells: Vec<usize>,
    /// The place of its name.
    pub(crate) span: Span,
    /// The faces that something is attached to.
    pub(crate) attached: Vec<Face>,
    /// Rectangles and circles of its faces, by name.
    pub(crate) patches: Vec<(String, GridPatch)>,
}

/// The meaning of a name that begins with the name of a grid.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum GridPart {
    /// The grid itself.
    Whole(GridId),
    /// A cell.
    Cell,
    /// A face.
    Face(GridFace),
    /// A rectangle or circle of a face.
    Patch(GridPatch),
    /// One cell of a face.
    Surface(GridFace),
    /// Nothing, with the reason and the help.
    Nothing(String, String),
}

impl KnownGrid {
    /// The part that `rest`, which follows the name of the grid, means.
    pub(crate) fn part(&self, name: &str, rest: &str) -> GridPart {
        if rest.is_empty() {
            return GridPart::Whole(self.id);
        }
        if rest.starts_with('[') {
            let problem = bad_index((name, "cells"), rest, &self.cells);
            return problem.map_or(GridPart::Cell, |(why, help)| GridPart::Nothing(why, help));
        }
        let (face, indices) = match rest.find('[') {
            Some(at) => rest.split_at(at),
            None => (rest, ""),
        };
        let word = face.trim_start_matches('.');
        if let Some((_, patch)) =
            self.patches.iter().find(|(own, _)| rest.strip_prefix('.') == Some(own))
        {
            return GridPart::Patch(*patch);
        }
        let Some(face) = self.form.face_named(word).filter(|_| face.starts_with('.')) else {
            let why = format!("grid `{name}` has no face `{}`", rest.trim_start_matches('.'));
            return GridPart::Nothing(why, self.faces(name, word));
        };
        let at = GridFace { grid: self.id, face };
        if indices.is_empty() {
            return GridPart::Face(at);
        }
        let along = face.along().into_iter().filter_map(|axis| self.cells.get(axis).copied());
        let words = format!("{name}.{}", self.form.face_name(face));
        match bad_index((&words, "cells of the face"), indices, &along.collect::<Vec<_>>()) {
            Some((why, help)) => GridPart::Nothing(why, help),
            None => GridPart::Surface(at),
        }
    }

    /// A face as an example.
    pub(crate) fn sample_face(&self) -> &'static str {
        self.form.face_name(Face::X1)
    }

    /// Help for a face that it does not have.
    fn faces(&self, name: &str, word: &str) -> String {
        if let Some(why) = self.absent(word) {
            return why.to_owned();
        }
        let meant = match self.form {
            Form::Block => Form::Cylinder { solid: false, closed: false }.face_named(word),
            Form::Cylinder { .. } => Face::of_name(word),
        };
        if let Some(face) = meant.filter(|face| self.form.has(*face)) {
            return format!("did you mean `{name}.{}`?", self.form.face_name(face));
        }
        let face = |face| format!("`{name}.{}`", self.form.face_name(face));
        let all: Vec<String> = self.form.faces().map(face).collect();
        let own = self.patches.iter().map(|(own, _)| format!("`{name}.{own}`"));
        let own: Vec<String> = own.collect();
        match own.is_empty() {
            true => format!("its faces are {}", all.join(", ")),
            false => format!("its faces are {}, its patches {}", all.join(", "), own.join(", ")),
        }
    }

    /// The reason why a cylinder lacks a face that others have.
    fn absent(&self, word: &str) -> Option<&'static str> {
        let Form::Cylinder { .. } = self.form else { return None };
        let whole = Form::Cylinder { solid: false, closed: false };
        let face = whole.face_named(word).or(Face::of_name(word));
        match face.filter(|face| !self.form.has(*face))? {
            Face::INNER => Some("a cylinder has an inner face if `r_in` is given"),
            _ => Some("a full circle is closed; a sector with `angle` has the faces phi0 and phi1"),
        }
    }
}

/// The reason why these are not indices of cells, and the correction.
fn bad_index((name, what): (&str, &str), text: &str, counts: &[usize]) -> Option<(String, String)> {
    let inner = text.strip_prefix('[').and_then(|t| t.strip_suffix(']')).unwrap_or(text);
    let indices: Vec<Option<usize>> =
        inner.split(',').map(|index| index.trim().parse().ok()).collect();
    let ranges: Vec<String> = counts.iter().map(|count| format!("1..{count}")).collect();
    let help = match counts {
        [] => format!("this face is one cell: `{name}`"),
        _ => format!("the {what} are `{name}[{}]`", ranges.join(", ")),
    };
    if indices.len() != counts.len() || counts.is_empty() {
        let plural = if counts.len() == 1 { "index" } else { "indices" };
        return Some((format!("`{name}{text}`: {what} have {} {plural}", counts.len()), help));
    }
    let outside =
        indices.iter().zip(counts).position(|(i, n)| i.is_none_or(|i| i < 1 || i > *n))?;
    let given = inner.split(',').nth(outside).unwrap_or("").trim();
    Some((format!("`{name}{text}`: index {given} is not in 1..{}", counts[outside]), help))
}
