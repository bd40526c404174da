//! Adds patches: rectangles and circles of faces of grids.

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::builder::grid::{scaled, typed};
use crate::id::{Field, GridId, GridPatch, Item, NodeId};
use crate::numbers::patch::written_parts;
use crate::parts::grid::GridFace;
use crate::parts::patch::{Outline, Patch};
use crate::value::{Input, Value};

const LENGTH: Type = Type::of(Dimension::LENGTH);
const ANGLE: Type = Type::of(Dimension::ANGLE);

impl NetworkBuilder {
    /// Adds a rectangle or circle of a face, named `GRID.NAME`: a source into it, and a path that
    /// ends at it, reach the cells that it covers, each by its exact share of the area. `None` if
    /// the grid is not of this builder or a value has the wrong dimension. Its name has to be unique among patches and faces.
    pub fn patch(&mut self, grid: GridId, patch: Patch<Input>) -> Option<GridPatch> {
        let known = self.parts.grids.get(grid.index())?;
        let index = u32::try_from(known.patches.len()).ok()?;
        let patch_id = GridPatch { at: GridFace { grid, face: patch.face }, index };
        let item = Item::Patch(patch_id);
        let types = self.patch_types(patch_id.at);
        let name = format!("{}.{}", known.name, patch.name);
        let mut fits = true;
        let mut value = |field, input: Input, ty| {
            fits &= input.ty == ty;
            self.typed((&name, item, field), input, ty)
        };
        let outline = match patch.outline {
            Outline::Rectangle([a, b]) => Outline::Rectangle([
                value(Field::Size, a, types[0]),
                value(Field::Size, b, types[1]),
            ]),
            Outline::Circle(radius) => Outline::Circle(value(Field::Radius, radius, LENGTH)),
        };
        let centre = patch
            .centre
            .map(|[a, b]| [value(Field::Centre, a, types[0]), value(Field::Centre, b, types[1])]);
        if !fits {
            return None;
        }
        let mut patch =
            Patch { name: patch.name, face: patch.face, outline, centre, parts: patch.parts };
        patch.parts = written_parts(&self.parts, grid, &patch);
        self.parts.grids[grid.index()].patches.push(patch);
        Some(patch_id)
    }

    /// The types of places along the two axes of a face: lengths, or an angle around the axis of a
    /// cylinder.
    pub fn patch_types(&self, at: GridFace) -> [Type; 2] {
        let round = self.parts.grids.get(at.grid.index()).is_some_and(|grid| grid.rings.is_some());
        at.face.along().map(|axis| if round && axis == 1 { ANGLE } else { LENGTH })
    }

    /// The patch of this name of a grid, without the name of the grid.
    pub fn patch_named(&self, grid: GridId, name: &str) -> Option<GridPatch> {
        self.parts.grids.get(grid.index())?.patch_named(grid, name)
    }

    /// The cells of the face that a patch covers, with their shares.
    pub(super) fn shares(&self, patch: GridPatch) -> Vec<(u32, f64)> {
        let grid = self.parts.grids.get(patch.at.grid.index());
        grid.map_or_else(Vec::new, |grid| grid.patch(patch).parts.shares.clone())
    }

    /// The area of a patch, for a path whose area is that; `None` if the grid is not of this
    /// builder.
    pub fn patch_area(&self, patch: GridPatch) -> Option<Input> {
        let grid = self.parts.grids.get(patch.at.grid.index())?;
        let whole = grid.area(patch.at.face);
        Some(typed(scaled(&whole, grid.patch(patch).parts.portion), Dimension::AREA))
    }

    /// The surfaces of a patch with the share of each in its area, for a source into it.
    pub fn shares_of_patch(&mut self, patch: GridPatch) -> Vec<(NodeId, f64)> {
        let nodes = self.surfaces(patch.at.grid, patch.at.face);
        let shares = self.shares(patch).into_iter();
        shares.map(|(cell, share)| (nodes[cell as usize], share)).collect()
    }
}

impl<T> Patch<T> {
    /// A rectangle or circle of a face; in the middle of it without `centre`.
    pub fn new(
        name: &str,
        face: crate::parts::face::Face,
        outline: Outline<T>,
        centre: Option<[T; 2]>,
    ) -> Self {
        Self { name: name.to_owned(), face, outline, centre, parts: Default::default() }
    }
}

impl crate::parts::grid::Grid {
    /// The values on which the cells of a patch depend: its own, and the lengths along its face.
    pub fn values_of_patch(&self, patch: GridPatch) -> Vec<&Value> {
        let own = self.patch(patch);
        let mut values = own.outline.values();
        values.extend(own.centre.iter().flatten());
        let lengths = self.shape.values();
        match self.rings {
            Some(_) => values.extend(lengths),
            None => values.extend(patch.at.face.along().map(|axis| lengths[axis])),
        }
        values
    }
}
