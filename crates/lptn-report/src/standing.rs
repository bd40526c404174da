//! How something that was asked stands.
//!
//! It is data until a format writes it. Terminal and page use their own colours and always write
//! the state in words too.

/// How a claim stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It was checked, and holds.
    Holds,
    /// It was not checked, or a reader has to know of it.
    Open,
    /// It was checked, and does not hold.
    Fails,
}
