//! Names inside grids: `wall[1,2,3]`, `wall.x1`, `wall.x1[2,3]`, `wall.mean`.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Context, Face, GridFace, GridId};

use crate::names::Names;
use crate::value::{Place, Wanted};

/// A grid as far as names need it.
#[derive(Clone, Debug)]
pub(crate) struct KnownGrid {
    pub(crate) id: GridId,
    /// How many cells there are along each axis that cells have an index of.
    pub(crate) cells: Vec<usize>,
    /// Where its name stands.
    pub(crate) span: Span,
    /// The faces that something is attached to.
    pub(crate) attached: Vec<Face>,
}

/// What a name means that begins with that of a grid.
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
    /// Nothing, for this reason and with this advice.
    Nothing(String, String),
}

/// The values that a grid has of its own.
pub(crate) const VALUES: [&str; 3] = ["mean", "min", "max"];

impl KnownGrid {
    /// What `rest`, which follows the name of the grid, means.
    fn part(&self, name: &str, rest: &str) -> GridPart {
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
    let all: Vec<String> = Face::ALL.into_iter().map(|face| format!("`{name}.{}`", face.name())).collect();
    format!("its faces are {}", all.join(", "))
}

/// Why these are no indices of cells: the reason and what to write.
fn bad_index((name, what): (&str, &str), text: &str, counts: &[usize]) -> Option<(String, String)> {
    let inner = text.strip_prefix('[').and_then(|t| t.strip_suffix(']')).unwrap_or(text);
    let indices: Vec<Option<usize>> = inner.split(',').map(|index| index.trim().parse().ok()).collect();
    let ranges: Vec<String> = counts.iter().map(|count| format!("1..{count}")).collect();
    let help = match counts {
        [] => format!("this face is one cell: `{name}`"),
        _ => format!("the {what} are `{name}[{}]`", ranges.join(", ")),
    };
    if indices.len() != counts.len() || counts.is_empty() {
        let plural = if counts.len() == 1 { "index" } else { "indices" };
        return Some((format!("`{name}{text}`: {what} have {} {plural}", counts.len()), help));
    }
    let outside = indices.iter().zip(counts).position(|(i, n)| i.is_none_or(|i| i < 1 || i > *n))?;
    let given = inner.split(',').nth(outside).unwrap_or("").trim();
    Some((format!("`{name}{text}`: index {given} is not in 1..{}", counts[outside]), help))
}

impl Names {
    /// What a name means that is that of a grid or begins with it, and the name of the grid.
    pub(crate) fn grid_part<'n>(&self, name: &'n str) -> Option<(&'n str, GridPart)> {
        let ends = name.match_indices(['.', '[']).map(|(at, _)| at).chain([name.len()]);
        let known = |end: usize| Some((end, self.grids.get(name.get(..end)?)?));
        let (end, grid) = ends.filter_map(known).next_back()?;
        let (own, rest) = name.split_at(end);
        Some((own, grid.part(own, rest)))
    }

    /// Whether a name in an expression is something of a grid that has a value in this place.
    pub(crate) fn is_of_grid(&self, name: &str, wanted: Wanted) -> bool {
        let Some((base, ending)) = name.rsplit_once('.') else { return false };
        let Some((_, part)) = self.grid_part(base) else { return false };
        let result = wanted.context == Context::Result;
        match (part, ending) {
            (GridPart::Whole(_), ending) => result && VALUES.contains(&ending),
            (GridPart::Cell, "T") => wanted.names_nodes(),
            (GridPart::Face(at), "T") => result || (wanted.names_nodes() && self.is_one_node(at)),
            (GridPart::Surface(at), "T") => wanted.names_nodes() && self.is_attached(at),
            _ => false,
        }
    }

    fn grid_of(&self, at: GridFace) -> Option<&KnownGrid> {
        self.grids.values().find(|grid| grid.id == at.grid)
    }

    fn is_attached(&self, at: GridFace) -> bool {
        self.grid_of(at).is_some_and(|grid| grid.attached.contains(&at.face))
    }

    /// Whether the whole face is one node of the name of the face.
    fn is_one_node(&self, at: GridFace) -> bool {
        let indices = |grid: &KnownGrid| at.face.along().into_iter().any(|axis| axis < grid.cells.len());
        self.is_attached(at) && self.grid_of(at).is_some_and(|grid| !indices(grid))
    }

    /// Why a name in an expression that begins with that of a grid means nothing there.
    pub(crate) fn unknown_of_grid(
        &self,
        place: Place<'_>,
        (name, at): (&str, &Span),
        wanted: Wanted,
    ) -> Option<Diagnostic> {
        let (base, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        let split = self.grid_part(base).or_else(|| self.grid_part(name));
        let (grid, part) = split?;
        let words = place.words();
        let unknown = |why: String| {
            Diagnostic::error("netlist::unknown_name", format!("{words} uses `{name}`: {why}"))
                .at(at.clone(), "unknown name")
        };
        let value = VALUES.contains(&ending) || matches!(part, GridPart::Face(_));
        Some(match part {
            GridPart::Nothing(why, help) => unknown(why).help(help),
            GridPart::Face(_) | GridPart::Whole(_) if value && wanted.names_nodes() => {
                let message = format!("{words} cannot use `{name}`, which is a result");
                Diagnostic::error("netlist::temperature_not_here", message).at(at.clone(), "").help(
                    "limits and reports may use it; name a single cell, whose temperature is that of a node",
                )
            }
            GridPart::Surface(face) if !self.is_attached(face) => {
                let face = face.face.name();
                unknown(format!("nothing is attached to face `{grid}.{face}`"))
                    .help(format!("the mean over its cells is `{grid}.{face}.T`, in limits and reports"))
            }
            _ if !wanted.names_nodes() => return None,
            GridPart::Whole(_) => {
                let values = VALUES.map(|value| format!("`{grid}.{value}`")).join(", ");
                unknown(format!("`{grid}` is a grid")).help(format!(
                    "a grid has {values}, and of each face such as `{grid}.x1` the mean `{grid}.x1.T`"
                ))
            }
            _ => unknown(format!("`{base}` has a temperature only")).help(format!("write `{base}.T`")),
        })
    }
}
