//! Shapes of grids, and the names of their directions and faces.

use crate::parts::face::Face;
use crate::value::Value;

/// The shape of a body that is cut into cells, with its lengths.
#[derive(Clone, Debug)]
pub enum Shape<T = Value> {
    /// Lengths along x, y and z in m.
    Block([T; 3]),
    /// A cylinder, or a sector of one.
    Cylinder {
        /// Inner radius in m; `None` without a hole.
        r_in: Option<T>,
        /// Outer radius in m.
        r_out: T,
        /// Length along the axis in m.
        length: T,
        /// Angle of a sector in rad; `None` for the full circle, which is closed.
        angle: Option<T>,
    },
}

/// The directions and faces that a grid has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// x, y, z.
    Block,
    /// r, phi, z.
    Cylinder {
        /// True without a hole.
        solid: bool,
        /// True for the full circle.
        closed: bool,
    },
}

impl<T> Shape<T> {
    /// Its directions and faces.
    pub fn form(&self) -> Form {
        match self {
            Self::Block(_) => Form::Block,
            Self::Cylinder { r_in, angle, .. } => {
                Form::Cylinder { solid: r_in.is_none(), closed: angle.is_none() }
            }
        }
    }

    /// Its lengths and its angle.
    pub fn values(&self) -> Vec<&T> {
        match self {
            Self::Block(size) => size.iter().collect(),
            Self::Cylinder { r_in, r_out, length, angle } => {
                r_in.iter().chain([r_out, length]).chain(angle).collect()
            }
        }
    }
}

impl Form {
    /// The names of its directions, as the names of inner paths have them.
    pub fn directions(self) -> [&'static str; 3] {
        match self {
            Self::Block => ["x", "y", "z"],
            Self::Cylinder { .. } => ["r", "phi", "z"],
        }
    }

    /// The name of a face.
    pub fn face_name(self, face: Face) -> &'static str {
        match self {
            Self::Block => face.name(),
            Self::Cylinder { .. } => ["inner", "outer", "phi0", "phi1", "z0", "z1"][face as usize],
        }
    }

    /// False for the inner face of a body without a hole, and for the cuts of a full circle.
    pub fn has(self, face: Face) -> bool {
        match self {
            Self::Block => true,
            Self::Cylinder { solid, closed } => match face.axis() {
                0 => face.is_far() || !solid,
                1 => !closed,
                _ => true,
            },
        }
    }

    /// The faces that it has.
    pub fn faces(self) -> impl Iterator<Item = Face> {
        Face::ALL.into_iter().filter(move |face| self.has(*face))
    }

    /// The face of this name.
    pub fn face_named(self, name: &str) -> Option<Face> {
        self.faces().find(|face| self.face_name(*face) == name)
    }

    /// True if its cells follow one another around the axis.
    pub(crate) fn is_closed(self) -> bool {
        matches!(self, Self::Cylinder { closed: true, .. })
    }
}
