//! The members of a stage of gears, and the relations of their speeds and torques.
//!
//! Willis: z_s w_s + z_r w_r - (z_s + z_r) w_c = 0. The torques that act on the members from
//! outside, without losses, are as z_s : z_r : -(z_s + z_r). So they and their power sum to zero. A
//! pair of gears is z_1 w_1 + z_2 w_2 = 0 with torques as z_1 : z_2; its housing takes their sum.
//! In both cases one row of weights gives speeds and torques.

lptn_units::words! {
/// A part of a stage that turns, or is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    /// The wheel in the middle of a planetary stage.
    Sun = "sun",
    /// The part on which the planets turn.
    Carrier = "carrier",
    /// The wheel with internal teeth.
    Ring = "ring",
    /// The wheels between sun and ring; their speed is that against the carrier.
    Planet = "planet",
    /// The first wheel of a pair.
    Pinion = "pinion",
    /// The second wheel of a pair.
    Wheel = "wheel",
}
/// Its name, also in netlists.
pub fn word;
}

/// The members of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Sun, planets on a carrier, and a ring.
    Planetary,
    /// Two wheels on parallel shafts.
    Pair,
}

impl Arrangement {
    /// The members that turn about fixed axes, and so may be input, output or fixed.
    pub fn shafts(self) -> &'static [Member] {
        match self {
            Self::Planetary => &[Member::Sun, Member::Carrier, Member::Ring],
            Self::Pair => &[Member::Pinion, Member::Wheel],
        }
    }

    /// The members with teeth.
    pub fn wheels(self) -> &'static [Member] {
        match self {
            Self::Planetary => &[Member::Sun, Member::Planet, Member::Ring],
            Self::Pair => self.shafts(),
        }
    }

    /// All members.
    pub fn members(self) -> &'static [Member] {
        match self {
            Self::Planetary => &[Member::Sun, Member::Planet, Member::Carrier, Member::Ring],
            Self::Pair => self.shafts(),
        }
    }
}

/// The weight of a member in sum(weight speed) = 0, to which its torque is proportional: true if it
/// is negative, and its text. `z` gives the name of the teeth of a wheel.
pub(super) fn weight(member: Member, z: impl Fn(Member) -> String) -> (bool, String) {
    match member {
        Member::Carrier => (true, format!("({} + {})", z(Member::Sun), z(Member::Ring))),
        wheel => (false, z(wheel)),
    }
}
