//! Names inside grids in expressions: `wall[1,2,3].T`, `wall.x1.T`, `wall.mean`.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Context, GridFace};

use crate::grid_part::{GridPart, KnownGrid};
use crate::names::Names;
use crate::place::{Place, Wanted};

/// The values of a whole grid.
pub(crate) const VALUES: [&str; 3] = ["mean", "min", "max"];

impl Names {
    /// The name of the grid with which `name` begins, and the part of it that `name` means.
    pub(crate) fn grid_part<'n>(&self, name: &'n str) -> Option<(&'n str, GridPart)> {
        if self.grids.is_empty() {
            return None; // most files have none
        }
        let ends = name.match_indices(['.', '[']).map(|(at, _)| at).chain([name.len()]);
        let known = |end: usize| Some((end, self.grids.get(name.get(..end)?)?));
        let (end, grid) = ends.filter_map(known).next_back()?;
        let (own, rest) = name.split_at(end);
        Some((own, grid.part(own, rest)))
    }

    /// True if a name in an expression is a part of a grid that has a value in this place.
    pub(crate) fn is_of_grid(&self, name: &str, wanted: Wanted) -> bool {
        let Some((base, ending)) = name.rsplit_once('.') else { return false };
        let Some((_, part)) = self.grid_part(base) else { return false };
        let result = wanted.context == Context::Result;
        match (part, ending) {
            (GridPart::Whole(_), ending) => result && VALUES.contains(&ending),
            (GridPart::Cell, "T") => wanted.names_nodes(),
            (GridPart::Patch(_), "T") => result,
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

    /// True if the whole face is one node with the name of the face.
    fn is_one_node(&self, at: GridFace) -> bool {
        let indices =
            |grid: &KnownGrid| at.face.along().into_iter().any(|axis| axis < grid.cells.len());
        self.is_attached(at) && self.grid_of(at).is_some_and(|grid| !indices(grid))
    }

    /// The reason why a name in an expression that begins with that of a grid is unknown there.
    pub(crate) fn unknown_of_grid(
        &self,
        place: Place<'_>,
        (name, at): (&str, &Span),
        wanted: Wanted,
    ) -> Option<Diagnostic> {
        let (base, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        let split = self.grid_part(base).or_else(|| self.grid_part(name));
        let (grid, part) = split?;
        let known = self.grids.get(grid);
        let sample = known.map_or("x1", KnownGrid::sample_face);
        let words = place.words();
        let unknown = |why: String| {
            Diagnostic::error("netlist::unknown_name", format!("{words} uses `{name}`: {why}"))
                .at(at.clone(), "unknown name")
        };
        let value =
            VALUES.contains(&ending) || matches!(part, GridPart::Face(_) | GridPart::Patch(_));
        Some(match part {
            GridPart::Nothing(why, help) => unknown(why).help(help),
            GridPart::Face(_) | GridPart::Patch(_) | GridPart::Whole(_)
                if value && wanted.names_nodes() =>
            {
                let message = format!("{words} cannot use `{name}`, which is a result");
                Diagnostic::wrong(
                    "netlist::temperature_not_here",
                    message,
                    at,
                    "limits and reports may use it; name a single cell, whose temperature is that \
                     of a node",
                )
            }
            GridPart::Surface(face) if !self.is_attached(face) => {
                let face = known.map_or("", |grid| grid.form.face_name(face.face));
                unknown(format!("nothing is attached to face `{grid}.{face}`")).help(format!(
                    "the mean over its cells is `{grid}.{face}.T`, in limits and reports"
                ))
            }
            _ if !wanted.names_nodes() => return None,
            GridPart::Whole(_) => {
                let values = VALUES.map(|value| format!("`{grid}.{value}`")).join(", ");
                unknown(format!("`{grid}` is a grid")).help(format!(
                    "a grid has {values}, and of each face such as `{grid}.{sample}` the mean \
                     `{grid}.{sample}.T`"
                ))
            }
            _ => unknown(format!("`{base}` has a temperature only"))
                .help(format!("write `{base}.T`")),
        })
    }
}
