//! The unit in which times are shown.

use crate::number::{duration, significant};

lptn_units::words! {
/// A unit of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeUnit {
    /// Seconds.
    Second = "s",
    /// Minutes.
    Minute = "min",
    /// Hours.
    Hour = "h",
    /// Days.
    Day = "d",
}
/// Its symbol.
pub fn symbol;
}

impl TimeUnit {
    /// Its length in s.
    pub fn seconds(self) -> f64 {
        match self {
            Self::Second => 1.0,
            Self::Minute => 60.0,
            Self::Hour => 3600.0,
            Self::Day => 86_400.0,
        }
    }
}

/// Unit of shown times: one for all, or `None` for a suitable one for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clock(pub Option<TimeUnit>);

impl Clock {
    /// A time in s with up to `digits` significant digits, and its unit.
    pub fn text(self, seconds: f64, digits: usize) -> String {
        match self.0 {
            None => duration(seconds, digits),
            Some(unit) => {
                format!("{} {}", significant(seconds / unit.seconds(), digits), unit.symbol())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Clock, TimeUnit};

    #[test]
    fn a_unit_that_was_asked_for_is_kept() {
        let hours = Clock(Some(TimeUnit::Hour));
        assert_eq!(
            (hours.text(1500.0, 3).as_str(), hours.text(0.0, 3).as_str()),
            ("0.417 h", "0 h")
        );
        assert_eq!(Clock::default().text(1500.0, 3), "25 min");
        for unit in TimeUnit::ALL {
            assert_eq!(Clock(Some(unit)).text(unit.seconds(), 3), format!("1 {}", unit.symbol()));
        }
    }
}
