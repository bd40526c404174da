//! Positions in the lists of a system, half as long as those of the machine.

/// The positions of those that are wanted.
pub(crate) fn chosen<T>(all: &[T], is_wanted: impl Fn(&T) -> bool) -> Vec<u32> {
    (0..).zip(all).filter(|(_, item)| is_wanted(item)).map(|(i, _)| i).collect()
}

pub(crate) fn number(index: usize) -> u32 {
    u32::try_from(index).expect("ids are 32 bits wide")
}
