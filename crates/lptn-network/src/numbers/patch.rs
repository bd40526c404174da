//! Checks the places of patches on their faces.

use crate::error::BuildErrorKind;
use crate::id::{Field, GridId, Item};
use crate::numbers::Work;
use crate::numbers::grid::as_written;
use crate::parts::Parts;
use crate::parts::patch::{Outline, Patch, PatchParts, PatchProblem};
use crate::value::Value;
use lptn_laws::Range;

/// The cells that a patch covers by the parameters as they are written; a stand-in, the whole face,
/// if it has none, which is reported later.
pub(crate) fn written_parts(parts: &Parts, grid: GridId, patch: &Patch) -> PatchParts {
    let grid = &parts.grids[grid.index()];
    let own = patch.outline.values().into_iter().chain(patch.centre.iter().flatten());
    let values: Vec<&Value> = own.chain(grid.shape.values()).collect();
    let mut scope = as_written(parts, &values);
    let mut number = |value: &Value| value.at(&mut scope).unwrap_or(f64::NAN);
    grid.parts_of_patch(patch, &mut number).unwrap_or_else(|_| whole(grid.face_count(patch.face)))
}

fn whole(cells: usize) -> PatchParts {
    let number = |cell: usize| u32::try_from(cell).unwrap_or(u32::MAX);
    let shares = (0..cells).map(|cell| (number(cell), 1.0 / cells as f64)).collect();
    PatchParts { shares, portion: 1.0 }
}

impl Work<'_> {
    /// Checks that each patch lies on its face, on the cells for which the network was made.
    pub(crate) fn check_patches(&mut self) {
        let parts = self.parts;
        for (i, grid) in parts.grids.iter().enumerate() {
            for id in grid.patch_ids(GridId::from_len(i)) {
                let (item, patch, before) = (Item::Patch(id), grid.patch(id), self.errors.len());
                let (field, own) = match &patch.outline {
                    Outline::Rectangle(size) => (Field::Size, &size[..]),
                    Outline::Circle(radius) => (Field::Radius, std::slice::from_ref(radius)),
                };
                for value in own {
                    self.constant(item, field, value, Range::Positive);
                }
                for value in patch.centre.iter().flatten() {
                    self.constant(item, Field::Centre, value, Range::Finite);
                }
                if self.errors.len() > before {
                    continue;
                }
                let mut number = |value: &Value| value.at(&mut self.scope).unwrap_or(f64::NAN);
                let problem = match grid.parts_of_patch(patch, &mut number) {
                    Ok(found) if found.is_same(&patch.parts) => None,
                    Ok(_) => Some(PatchProblem::Moved),
                    // lengths of the grid that are wrong have been reported
                    Err(problem) => Some(problem).filter(|of| *of != PatchProblem::Unknown),
                };
                if let Some(problem) = problem {
                    let names = grid.form().directions();
                    let axes = patch.face.along().map(|axis| names[axis]);
                    self.error(item, BuildErrorKind::Patch { patch: id, problem, axes });
                }
            }
        }
    }
}
