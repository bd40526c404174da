//! How large an error may be.

/// The largest error that is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// In K.
    Kelvin(f64),
    /// As a share of the rise.
    Share(f64),
}

/// 5 % of the rise: what an engineer would call the same curve.
impl Default for Allowed {
    fn default() -> Self {
        Self::Share(0.05)
    }
}

impl Allowed {
    /// In K, for a rise in K.
    pub fn of(self, rise: f64) -> f64 {
        match self {
            Self::Kelvin(kelvin) => kelvin,
            Self::Share(share) => share * rise,
        }
    }

    /// As a share of a rise that has no kelvins of its own, as that of a step of 1 W: 5 % where the
    /// limit is in K.
    pub(crate) fn share(self) -> f64 {
        match self {
            Self::Kelvin(_) => Self::default().share(),
            Self::Share(share) => share,
        }
    }
}
