//! Limits on errors.

/// The largest acceptable error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// In K.
    Kelvin(f64),
    /// A share of the rise.
    Share(f64),
}

/// 5 % of the rise: an engineer would call the curves the same.
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

    /// The limit as a share for a step of 1 W: 5 % if it is in K, since such a step is of no
    /// particular size.
    pub(crate) fn share(self) -> f64 {
        match self {
            Self::Kelvin(_) => Self::default().share(),
            Self::Share(share) => share,
        }
    }
}
