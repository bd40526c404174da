//! Draws the sectors of rings of a layer of a round grid, seen along its axis.

use lptn_plot::scene::{Path, polygon};

/// The largest angle in rad that an edge of a drawn arc spans.
const EDGE: f64 = std::f64::consts::PI / 36.0;

/// A sector of a ring between two radii and two angles in rad.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sector {
    pub(crate) radii: [f64; 2],
    pub(crate) angles: [f64; 2],
}

impl Sector {
    /// Points on its outline, in the unit of its radii.
    fn outline(&self) -> Vec<(f64, f64)> {
        let [from, to] = self.angles;
        let edges = ((to - from) / EDGE).ceil().max(1.0) as usize;
        let angle = |i: usize| from + (to - from) * i as f64 / edges as f64;
        let point = |radius: f64, angle: f64| (radius * angle.cos(), radius * angle.sin());
        let outer = (0..=edges).map(|i| point(self.radii[1], angle(i)));
        let inner = (0..=edges).rev().map(|i| point(self.radii[0], angle(i)));
        outer.chain(inner).collect()
    }

    /// The lowest and the highest x and y.
    pub(crate) fn extent(&self) -> [[f64; 2]; 2] {
        let points = self.outline();
        let ends = |of: fn(&(f64, f64)) -> f64| {
            let all = || points.iter().map(of);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        };
        [ends(|point| point.0), ends(|point| point.1)]
    }

    /// Its area on the page: the axis is at `centre`, and y points upwards.
    pub(crate) fn drawn(&self, centre: (f64, f64), scale: f64) -> Path {
        let outline = self.outline().into_iter();
        polygon(outline.map(|(x, y)| (centre.0 + scale * x, centre.1 - scale * y)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use super::Sector;

    #[test]
    fn a_quarter_and_a_circle_have_their_extents() {
        let quarter = Sector { radii: [1.0, 2.0], angles: [0.0, FRAC_PI_2] };
        let [x, y] = quarter.extent();
        assert!(x[0].abs() < 1e-12 && (x[1] - 2.0).abs() < 1e-12, "{x:?}");
        assert!(y[0].abs() < 1e-12 && (y[1] - 2.0).abs() < 1e-12, "{y:?}");
        let whole = Sector { radii: [0.0, 2.0], angles: [0.0, TAU] };
        assert!(whole.extent().iter().flatten().all(|end| (end.abs() - 2.0).abs() < 1e-12));
    }
}
