//! The temperature in a grid, and slices through it.

use lptn_network::{Form, GridAxis, GridId, Network};
use lptn_report::significant;
use lptn_solve::Snapshot;
use lptn_units::{Dimension, Type, UnitError, parse_quantity};

use crate::words;

/// The temperatures of the cells of a grid.
#[derive(Clone, Debug)]
pub struct GridField {
    /// The name of the grid.
    pub name: String,
    /// Its directions and faces.
    pub form: Form,
    /// Number of cells along each axis.
    pub cells: [usize; 3],
    /// Number of indices of its cells.
    pub axes: usize,
    /// The positions of its cells along each axis in m, along phi in rad.
    pub along: [GridAxis; 3],
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
    NoLayer { text: String, grid: String, axis: &'static str, layers: usize } = "graph::slice",
        format!("`{text}` lies outside of `{grid}`: it has {layers} layers along {axis}"),
        help format!("name one from 1 to {layers}, {axis}={layers}");
    /// The grid ends before; `ends` in m, along phi in rad.
    NoPlace { text: String, grid: String, axis: &'static str, ends: [f64; 2] } = "graph::slice",
        match ends[0] > 0.0 {
            true => format!(
                "`{text}` lies outside of `{grid}`: it reaches from {} to {} along {axis}",
                position(axis, ends[0]), position(axis, ends[1])
            ),
            false => format!(
                "`{text}` lies outside of `{grid}`: it is {} long along {axis}",
                position(axis, ends[1])
            ),
        },
        help format!(
            "name a place from {} to \"{axis}={}\"",
            if ends[0] > 0.0 { position(axis, ends[0]) } else { "0".to_owned() },
            position(axis, ends[1])
        );
}}

/// A position along an axis, with its unit.
pub(crate) fn position(axis: &str, at: f64) -> String {
    match axis {
        PHI => format!("{} deg", significant(at.to_degrees(), 4)),
        _ => words::si(at, "m"),
    }
}

/// The axis whose positions are angles.
pub(crate) const PHI: &str = "phi";

impl GridField {
    /// The field of a grid in a state; its temperatures are NaN without one.
    pub fn of(network: &Network, id: GridId, state: Option<&Snapshot>) -> Self {
        let grid = &network.grids()[id.index()];
        Self {
            name: grid.name.clone(),
            cells: grid.cells,
            form: grid.form(),
            axes: grid.axes,
            along: network.grid_axes(id),
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

    /// The first and the last position along an axis in m, along phi in rad.
    pub fn ends(&self, axis: usize) -> [f64; 2] {
        let borders = &self.along[axis].borders;
        [borders[0], borders[borders.len() - 1]]
    }

    /// True for a cylinder.
    pub fn is_round(&self) -> bool {
        self.form != Form::Block
    }

    /// The position of the node of a cell in m, along phi in rad, by its indices from 0.
    pub fn centre(&self, at: [usize; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.along[axis].nodes[at[axis]])
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

    /// The indices of the hottest cell from 0; `None` without temperatures.
    pub fn hottest(&self) -> Option<[usize; 3]> {
        let known = self.places().filter(|at| self.at(*at).is_finite());
        known.reduce(|best, at| if self.at(at) > self.at(best) { at } else { best })
    }

    /// Layers through the hottest cell, the largest first: those with at least three cells along
    /// both sides, or the largest one.
    pub fn cuts(&self) -> Vec<Cut> {
        let Some(at) = self.hottest() else { return Vec::new() };
        let sides = |axis: usize| (0..3).filter(move |own| *own != axis).map(|own| self.cells[own]);
        let mut axes = [2, 1, 0];
        axes.sort_by_key(|axis| std::cmp::Reverse(sides(*axis).product::<usize>()));
        let wide = |(place, axis): &(usize, usize)| *place == 0 || sides(*axis).all(|n| n >= 3);
        let kept = axes.into_iter().enumerate().filter(wide);
        kept.map(|(_, axis)| Cut { axis, layer: at[axis] }).collect()
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
        let directions = self.form.directions();
        let axis = directions.iter().position(|direction| axis.trim() == *direction);
        let axis = axis.ok_or_else(|| not_a_slice(None))?;
        let (grid, letter) = (self.name.clone(), directions[axis]);
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
        let angle = letter == PHI;
        let wanted = Type::of(if angle { Dimension::ANGLE } else { Dimension::LENGTH });
        let place = parse_quantity(place.trim(), Some(wanted));
        let place = place.map_err(|why| not_a_slice(Some(Box::new(why))))?.value;
        let ends = self.ends(axis);
        if !(ends[0]..=ends[1]).contains(&place) {
            let text = text.to_owned();
            return Err(NoSlice::NoPlace { text, grid, axis: letter, ends });
        }
        let layer = self.along[axis].borders.partition_point(|border| *border <= place);
        Ok(Cut { axis, layer: layer.saturating_sub(1).min(layers - 1) })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use lptn_network::{Form, GridAxis};

    use super::{Cut, GridField, NoSlice};

    /// 2 x 3 x 4 cells of 10, 20 and 5 mm; the temperature in K is 100 i + 10 j + k.
    pub(crate) fn block() -> GridField {
        let mut field = GridField {
            name: "block".into(),
            cells: [2, 3, 4],
            axes: 3,
            form: Form::Block,
            along: [(0.02, 2), (0.06, 3), (0.02, 4)].map(|(size, n)| GridAxis::even(size, n)),
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
