//! Slots that every expression of a network shares. Those of parameters, signals, nodes and
//! boundaries follow in the order in which these were added.

/// The run's time `t` in s.
pub const TIME: u32 = 0;
/// The time that comparisons see: a point inside the present segment. The truth of a comparison of
/// `t` thus never changes while a step is being computed; the segments end where it does change.
pub const SEGMENT: u32 = 1;
/// `T_from` of a conductor in K.
pub const FROM: u32 = 2;
/// `T_to` of a conductor in K.
pub const TO: u32 = 3;
/// `T_mean` of a conductor in K.
pub const MEAN: u32 = 4;
/// `dT` of a conductor in K.
pub const DIFFERENCE: u32 = 5;
/// `T` of the node or material at hand in K.
pub const OWN: u32 = 6;
/// True if it is a temperature of the path or body at hand.
pub(crate) fn is_of_path(slot: u32) -> bool {
    (FROM..=OWN).contains(&slot)
}

/// Number of slots before the first part of a network.
pub(crate) const FIXED: usize = 7;
