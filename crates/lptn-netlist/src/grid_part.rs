//! Names inside grids: `wall[1,2,3]`, `wall.x1`, `wall.x1[2,3]`.

use lptn_data::Span;
use lptn_network::{Face, GridFace, GridId};

/// The data of a grid that names need.
#[derive(Clone, Debug)]
pub(crate) struct KnownGrid {
    pub(crate) id: GridId,
    /// Number of cells along each axis that has an index.
    pub(crate) cells: Vec<usize>,
    /// The place of its name.
    pub(crate) span: Span,
    /// The faces that something is attached to.
    pub(crate) attached: Vec<Face>,
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
        let Some(face) = face.strip_prefix('.').and_then(Face::of_name) else {
            let why = format!("grid `{name}` has no face `{}`", rest.trim_start_matches('.'));
            return GridPart::Nothing(why, faces(name));
        };
        let at = GridFace { grid: self.id, face };
        if indices.is_empty() {
            return GridPart::Face(at);
        }
        let along = face.along().into_iter().filter_map(|axis| self.cells.get(axis).copied());
        let words = format!("{name}.{}", face.name());
        match bad_index((&words, "cells of the face"), indices, &along.collect::<Vec<_>>()) {
            Some((why, help)) => GridPart::Nothing(why, help),
            None => GridPart::Surface(at),
        }
    }
}

fn faces(name: &str) -> String {
    let all: Vec<String> =
        Face::ALL.into_iter().map(|face| format!("`{name}.{}`", face.name())).collect();
    format!("its faces are {}", all.join(", "))
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
