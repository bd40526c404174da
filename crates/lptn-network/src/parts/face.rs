//! Faces of grids.

/// A face of a grid: the axis it is perpendicular to, and whether it is the near or the far one. The
/// axes of a cylinder are r, phi and z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// At the start of x.
    X0,
    /// At the end of x.
    X1,
    /// At the start of y.
    Y0,
    /// At the end of y.
    Y1,
    /// At the start of z.
    Z0,
    /// At the end of z.
    Z1,
}

impl Face {
    /// The inner face of a cylinder with a hole.
    pub const INNER: Self = Self::X0;
    /// The mantle of a cylinder.
    pub const OUTER: Self = Self::X1;
    /// The cut at which a sector of a cylinder begins.
    pub const PHI0: Self = Self::Y0;
    /// The cut at which it ends.
    pub const PHI1: Self = Self::Y1;

    /// All six.
    pub const ALL: [Self; 6] = [Self::X0, Self::X1, Self::Y0, Self::Y1, Self::Z0, Self::Z1];

    /// Its name on a block: `x0`, `x1`, …
    pub fn name(self) -> &'static str {
        ["x0", "x1", "y0", "y1", "z0", "z1"][self as usize]
    }

    /// The face of a block with this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|face| face.name() == name)
    }

    /// The axis it is perpendicular to: 0 for x, 1 for y, 2 for z.
    pub fn axis(self) -> usize {
        self as usize / 2
    }

    /// The two axes along it.
    pub fn along(self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis()]
    }

    pub(crate) fn is_far(self) -> bool {
        self as usize % 2 == 1
    }
}
