//! A result and the trust in it.

use std::ops::Deref;

use crate::trust::Trust;

/// The result of an analysis with the trust in it. It lends the fields of its result.
#[derive(Clone, Debug)]
pub struct Trusted<T> {
    /// The numbers.
    pub result: T,
    /// The trust in them.
    pub trust: Trust,
}

impl<T> Deref for Trusted<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.result
    }
}
