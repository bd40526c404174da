//! The rings that a round body is cut into.
//!
//! The nodes of n rings are at the middles of n equal widths, `rho_i = r_in + (i - 1/2) h` with
//! `h = (r_out - r_in) / n`. Two rings meet at the radius r between their nodes with
//!
//! ```text
//! r^2 = (rho_2^2 - rho_1^2) / (2 ln(rho_2 / rho_1))
//! ```
//!
//! A steady temperature of a round body with a uniform heat is `a + b ln r + c r^2`. The flow
//! `2 pi k L (T_1 - T_2) / ln(rho_2 / rho_1)` between two nodes is exact for `b ln r` at every
//! radius, and for `c r^2` at this one only. The rings that meet there get the heat that this flow
//! carries, so that both parts are exact at the nodes. Borders at equal distances, which are larger
//! by `h^2 / (24 r)`, would leave an error of `g h^2 ln(n) / (24 k)` at the axis for a heat g a
//! volume.
//!
//! The innermost ring of a body without a hole is a disc. Around the axis, its rings conduct so that
//! a uniform gradient, `r cos(phi)`, keeps its exact flows along r; those of a body with a hole so
//! that a temperature which depends on the angle alone is exact.

/// Radii of rings as shares of the outer radius.
#[derive(Clone, Debug)]
pub(crate) struct Rings {
    /// The inner radius; 0 without a hole.
    pub(crate) hole: f64,
    /// Radius of each node.
    nodes: Vec<f64>,
    /// Squares of the radii at which they meet, with those of both faces: one more than rings.
    squares: Vec<f64>,
}

/// Square of the radius between two others at which the flow between them is exact for `r^2`:
/// their logarithmic mean, of squares.
fn between(inner: f64, outer: f64) -> f64 {
    let step = outer - inner;
    step * (outer + inner) / (2.0 * (step / inner).ln_1p())
}

/// Radius at which the flow between two others is exact for a temperature `r cos(phi)`: their
/// logarithmic mean.
fn arm(inner: f64, outer: f64) -> f64 {
    let step = outer - inner;
    step / (step / inner).ln_1p()
}

impl Rings {
    /// `count` rings between two radii in m; the inner one is not negative and less than the outer.
    pub(crate) fn new([inner, outer]: [f64; 2], count: usize) -> Self {
        let (hole, width) = (inner / outer, (outer - inner) / outer);
        let node = |i: usize| hole + width * (i as f64 + 0.5) / count as f64;
        let nodes: Vec<f64> = (0..count).map(node).collect();
        let borders = nodes.windows(2).map(|pair| between(pair[0], pair[1]));
        let squares = [hole * hole].into_iter().chain(borders).chain([1.0]).collect();
        Self { hole, nodes, squares }
    }

    /// Number of rings.
    pub(crate) fn count(&self) -> usize {
        self.nodes.len()
    }

    /// Radius of the node of a ring.
    pub(crate) fn node(&self, ring: usize) -> f64 {
        self.nodes[ring]
    }

    /// Radii of the two borders of a ring.
    pub(crate) fn borders(&self, ring: usize) -> [f64; 2] {
        [ring, ring + 1].map(|i| self.squares[i].sqrt())
    }

    /// Area of a ring a radian of its angle.
    pub(crate) fn area(&self, ring: usize) -> f64 {
        0.5 * (self.squares[ring + 1] - self.squares[ring])
    }

    /// Area of all rings a radian.
    pub(crate) fn whole(&self) -> f64 {
        0.5 * (1.0 - self.squares[0])
    }

    /// Width through which a ring conducts along its angle, over the arc at its node. With a hole
    /// `rho ln(r_2 / r_1)`, exact for a temperature that depends on the angle alone. Without one, the
    /// widths sum to the radius, and a uniform gradient is exact.
    pub(crate) fn width(&self, ring: usize) -> f64 {
        let nodes = &self.nodes;
        if self.hole > 0.0 {
            let [inner, outer] = self.borders(ring);
            return nodes[ring] * (outer / inner).ln();
        }
        let inner = if ring > 0 { arm(nodes[ring - 1], nodes[ring]) } else { 0.0 };
        let outer = nodes.get(ring + 1).map_or(1.0, |next| arm(nodes[ring], *next));
        outer - inner
    }

    /// The part of a cut along the radius that belongs to a ring.
    pub(crate) fn part_of_cut(&self, ring: usize) -> f64 {
        let [inner, outer] = self.borders(ring);
        (outer - inner) / (1.0 - self.hole)
    }

    /// The part of the volume, by the area of the rings.
    pub(crate) fn part(&self, ring: usize) -> f64 {
        self.area(ring) / self.whole()
    }

    /// The parts of a uniform heat that flow to the inner and the outer face without passing a
    /// node.
    pub(crate) fn parts_of_faces(&self) -> [f64; 2] {
        let (first, last) = (self.nodes[0], self.nodes[self.nodes.len() - 1]);
        let inner = if self.hole > 0.0 { between(self.hole, first) - self.squares[0] } else { 0.0 };
        let outer = 1.0 - between(last, 1.0);
        [inner, outer].map(|square| 0.5 * square / self.whole())
    }
}
