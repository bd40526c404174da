//! The temperature in a grid, and slices through it.

use lptn_network::{GridId, Network};
use lptn_solve::Snapshot;
use lptn_units::{Dimension, Type, UnitError, parse_quantity};

use crate::words;

/// The letters of the axes.
pub(crate) const AXES: [char; 3] = ['x', 'y', 'z'];

/// The temperatures of the cells of a grid.
#[derive(Clone, Debug)]
pub struct GridField {
    /// The name of the grid.
    pub name: String,
    /// Number of cells along x, y and z.
    pub cells: [usize; 3],
    /// Number of indices of its cells.
    pub axes: usize,
    /// Its lengths along x, y and z in m.
    pub size: [f64; 3],
    /// The temperature of each cell in K, the last index running fastest.
    pub kelvin: Vec<f64>,
    /// Caption below its pictures.
    pub caption: String,
}

/// A layer of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The axis it is perpendicular to: 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// Index of the layer, from 0.
    pub layer: usize,
}

lptn_units::errors! {
/// A slice that a grid does not have.
#[derive(Clone, Debug)]
pub enum NoSlice {
    /// Its place is not given.
    NotASlice { text: String, why: Option<Box<UnitError>> } = "graph::slice",
        match why {
            Some(why) => format!("`{text}` is not a slice: {why}"),
            None => format!("`{text}` is not a slice"),
        },
        help "name an axis and the number of a layer, or a place: z=3, or \"z=5 mm\"";
    /// The grid has fewer layers.
    NoLayer { text: String, grid: String, axis: char, layers: usize } = "graph::slice",
        format!("`{text}` lies outside of `{grid}`: it has {layers} layers along {axis}"),
        help format!("name one from 1 to {layers}, {axis}={layers}");
    /// The grid is shorter; `length` is in m.
    NoPlace { text: String, grid: String, axis: char, length: f64 } = "graph::slice",
        format!(
            "`{text}` lies outside of `{grid}`: it is {} long along {axis}",
            words::si(*length, "m")
        ),
        help format!("name a place from 0 to \"{axis}={}\"", words::si(*length, "m"));
}}

impl GridField {
    /// The field of a grid in a state; its temperatures are NaN without one.
    pub fn of(network: &Network, id: GridId, state: Option<&Snapshot>) -> Self {
        let grid = &network.grids()[id.index()];
        let mut scope = network.evaluation();
        let mut length =
            |axis: usize| words::number(network, &grid.size[axis], &mut scope).unwrap_or(f64::NAN);
        Self {
            name: grid.name.clone(),
            cells: grid.cells,
            axes: grid.axes,
            size: [length(0), length(1), length(2)],
            kelvin: grid
                .nodes()
                .map(|id| state.map_or(f64::NAN, |state| state.temperatures[id.index()]))
                .collect(),
            caption: state.map_or(String::new(), |state| words::caption(network, state)),
        }
    }

    /// The temperature of a cell in K, by its indices from 0.
    pub fn at(&self, [i, j, k]: [usize; 3]) -> f64 {
        self.kelvin[(i * self.cells[1] + j) * self.cells[2] + k]
    }

    /// The lengths of a cell in m.
    pub fn spacing(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.size[axis] / self.cells[axis] as f64)
    }

    /// The middle of a cell in m, by its indices from 0.
    pub fn centre(&self, at: [usize; 3]) -> [f64; 3] {
        let spacing = self.spacing();
        [0, 1, 2].map(|axis| spacing[axis] * (at[axis] as f64 + 0.5))
    }

    /// The name of a cell, by its indices from 0.
    pub fn cell(&self, at: [usize; 3]) -> String {
        let indices: Vec<String> = at[..self.axes].iter().map(|i| (i + 1).to_string()).collect();
        format!("{}[{}]", self.name, indices.join(","))
    }

    /// The indices of all cells from 0, the last running fastest.
    pub fn places(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [x, y, z] = self.cells;
        (0..x).flat_map(move |i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k])))
    }

    /// The coldest and the hottest temperature in K.
    pub fn span(&self) -> [f64; 2] {
        let fold = |of: fn(f64, f64) -> f64| self.kelvin.iter().copied().reduce(of);
        [fold(f64::min), fold(f64::max)].map(|end| end.unwrap_or(f64::NAN))
    }

    /// The layer that a text names, `z=3`, or the one in which a place lies, `z=5 mm`.
    ///
    /// # Errors
    /// [`NoSlice`] for a text that names none.
    pub fn cut(&self, text: &str) -> Result<Cut, NoSlice> {
        let not_a_slice = |why| NoSlice::NotASlice { text: text.to_owned(), why };
        let (axis, place) = text.split_once('=').ok_or_else(|| not_a_slice(None))?;
        let axis = AXES.iter().position(|letter| axis.trim().eq(&letter.to_string()));
        let axis = axis.ok_or_else(|| not_a_slice(None))?;
        let (grid, letter) = (self.name.clone(), AXES[axis]);
        let layers = self.cells[axis];
        if let Ok(number) = place.trim().parse::<i64>() {
            let found = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
            let layer = found.filter(|layer| *layer < layers);
            let text = text.to_owned();
            return layer.map(|layer| Cut { axis, layer }).ok_or(NoSlice::NoLayer {
                text,
                grid,
                axis: letter,
                layers,
            });
        }
        let length = Type::of(Dimension::LENGTH);
        let place = parse_quantity(place.trim(), Some(length));
        let place = place.map_err(|why| not_a_slice(Some(Box::new(why))))?.value;
        if !(0.0..=self.size[axis]).contains(&place) {
            let text = text.to_owned();
            return Err(NoSlice::NoPlace { text, grid, axis: letter, length: self.size[axis] });
        }
        let layer = (place / self.spacing()[axis]).floor() as usize;
        Ok(Cut { axis, layer: layer.min(layers - 1) })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{Cut, GridField, NoSlice};

    /// 2 x 3 x 4 cells of 10, 20 and 5 mm; the temperature in K is 100 i + 10 j + k.
    pub(crate) fn block() -> GridField {
        let mut field = GridField {
            name: "block".into(),
            cells: [2, 3, 4],
            axes: 3,
            size: [0.02, 0.06, 0.02],
            kelvin: Vec::new(),
            caption: "steady state".into(),
        };
        field.kelvin = field.places().map(|[i, j, k]| (100 * i + 10 * j + k) as f64).collect();
        field
    }

    #[test]
    fn cells_have_the_places_of_their_indices() {
        let field = block();
        assert!((field.at([1, 2, 3]) - 123.0).abs() < 1e-12);
        let centre = field.centre([1, 2, 3]).map(|x| (x * 1e6).round() as i64);
        assert_eq!(centre, [15_000, 50_000, 17_500]);
        assert_eq!(field.cell([1, 2, 3]), "block[2,3,4]");
    }

    #[test]
    fn slices_are_named_by_layer_or_place() {
        let field = block();
        assert_eq!(field.cut("z=4").unwrap(), Cut { axis: 2, layer: 3 });
        assert_eq!(field.cut("y = 25 mm").unwrap(), Cut { axis: 1, layer: 1 });
        assert_eq!(field.cut("x=0.02 m").unwrap(), Cut { axis: 0, layer: 1 });
        for wrong in ["z=0", "z=5", "z=-1"] {
            assert!(matches!(field.cut(wrong), Err(NoSlice::NoLayer { .. })), "{wrong}");
        }
        assert!(matches!(field.cut("z=21 mm"), Err(NoSlice::NoPlace { .. })));
        for wrong in ["z", "w=1", "z=warm", "z=3 s", ""] {
            assert!(matches!(field.cut(wrong), Err(NoSlice::NotASlice { .. })), "{wrong}");
        }
    }
}
