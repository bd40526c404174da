//! Standing of a claim: holds, open or fails.
//!
//! It is data until a format writes it. Terminal and page use their own colours and always write
//! the state in words too.

/// Standing of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It was checked, and holds.
    Holds,
    /// It was not checked, or the reader must know of it.
    Open,
    /// It was checked, and does not hold.
    Fails,
}
