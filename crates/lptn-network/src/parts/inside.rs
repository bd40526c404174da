//! Cells and inner paths of grids by their names.

use crate::id::Item;
use crate::parts::Parts;
use crate::parts::grid::Grid;

/// The part of a name before the brackets at its end, and the indices inside them.
fn parsed(name: &str) -> Option<(&str, Vec<usize>)> {
    let (head, list) = name.strip_suffix(']')?.rsplit_once('[')?;
    let index = |text: &str| text.parse().ok().filter(|_| !text.starts_with(['+', '0']));
    let indices: Option<Vec<usize>> = list.split(',').map(index).collect();
    indices.filter(|indices| indices.len() <= 3).map(|indices| (head, indices))
}

impl Parts {
    /// The cell or the inner path of a grid with this name.
    pub(crate) fn inside_a_grid(&self, name: &str) -> Option<Item> {
        let (head, indices) = parsed(name)?;
        if let Some(grid) = self.grid_named(head) {
            return grid.cell(&indices).map(Item::Node);
        }
        let (name, direction) = head.rsplit_once('.')?;
        let grid = self.grid_named(name)?;
        let axis = grid.form().directions().iter().position(|known| *known == direction)?;
        grid.path_at(axis, &indices).map(Item::Conductor)
    }

    fn grid_named(&self, name: &str) -> Option<&Grid> {
        let grid = |item: Item| match item {
            Item::Grid(id) => self.grids.get(id.index()),
            _ => None,
        };
        let is = |item: Item| grid(item).is_some_and(|grid| grid.name == name);
        self.names.find(name, is).and_then(grid)
    }
}
