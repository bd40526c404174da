//! The largest error that is allowed.

use lptn_reduce::Allowed;
use lptn_units::Dimension;

use crate::failure::Failure;
use crate::input;

/// The largest error that is allowed.
#[derive(Clone, Debug)]
pub struct Limit {
    /// In K, or as a share of the rise.
    pub allowed: Allowed,
    /// The limit as it was written: `0.5K`, `2%`.
    pub text: String,
}

impl Limit {
    /// Reads `0.5K` or `2%` of an option.
    pub(super) fn parse(option: &str, text: &str) -> Result<Self, Failure> {
        let share = text.trim().ends_with('%');
        if text.trim().parse::<f64>().is_ok() {
            let message = format!("`{option}` has no unit: `{text}`");
            let help = format!("write {option} {0}% of the rise, or {option} {0}K", text.trim());
            return Err(Failure::refused("reduce::max_error", message, help));
        }
        let wanted = if share { Dimension::NONE } else { Dimension::TEMPERATURE };
        let what = (wanted, "reduce::max_error", "0.5K or 2%");
        let value = input::positive(option, text, what)?.value;
        let allowed = if share { Allowed::Share(value) } else { Allowed::Kelvin(value) };
        Ok(Self { allowed, text: text.trim().to_owned() })
    }

    pub(super) fn is_in_kelvin(&self) -> bool {
        matches!(self.allowed, Allowed::Kelvin(_))
    }
}
