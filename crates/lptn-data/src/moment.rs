//! Dates and clock times: `2026-05-03T09:00:00.5+02:00`, `03.05.2026 09:00`, `5/3/2026 9:00:05 PM`.
//!
//! A date whose numbers may be day and month or month and day is kept as written ([`Date`]): the
//! whole column decides its order, or a key.

/// The order of the numbers of a date.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DateOrder {
    /// Day, month, year.
    DayFirst,
    /// Month, day, year.
    MonthFirst,
    /// Year, month, day.
    YearFirst,
}

/// Orders by the text of their key.
pub const DATE_ORDERS: [(&str, DateOrder); 3] = [
    ("day first", DateOrder::DayFirst),
    ("month first", DateOrder::MonthFirst),
    ("year first", DateOrder::YearFirst),
];

/// A date as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Date {
    pub(crate) numbers: [u32; 3],
    /// The order, if the form shows it.
    pub(crate) order: Option<DateOrder>,
    /// True if the year has two digits.
    pub(crate) short: bool,
}

/// A date, a clock time, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Moment {
    pub(crate) date: Option<Date>,
    /// Nanoseconds from midnight.
    pub(crate) clock: Option<i64>,
    /// Minutes by which the clock is ahead of UTC.
    pub(crate) offset: Option<i64>,
}

pub(crate) const SECOND: i64 = 1_000_000_000;
pub(crate) const DAY: i64 = 86_400 * SECOND;

/// Months in which clocks are set forward somewhere, on a Sunday.
const CHANGES: [i64; 4] = [3, 4, 9, 10];

impl Date {
    /// Year, month and day.
    fn parts(&self, order: DateOrder) -> [i64; 3] {
        let [a, b, c] = self.numbers.map(i64::from);
        match self.order.unwrap_or(order) {
            DateOrder::DayFirst => [c, b, a],
            DateOrder::MonthFirst => [c, a, b],
            DateOrder::YearFirst => [a, b, c],
        }
    }

    /// True for a Sunday on which a clock may have been set forward.
    pub(crate) fn may_change(&self, order: DateOrder) -> bool {
        // 1970-01-01 was a Thursday
        let sunday = self.day(order).is_some_and(|day| day.rem_euclid(7) == 3);
        sunday && CHANGES.contains(&self.parts(order)[1])
    }

    /// Number of days from 1970-01-01 in the Gregorian calendar; `None` if there is no such date.
    ///
    /// Source: Hinnant, chrono-compatible low-level date algorithms, `days_from_civil`.
    pub(crate) fn day(&self, order: DateOrder) -> Option<i64> {
        let [year, month, day] = self.parts(order);
        let year = if self.short { 2000 + year } else { year };
        if !(1..=12).contains(&month) || !(1..=length(year, month)).contains(&day) {
            return None;
        }
        let (shifted, years) = ((month + 9) % 12, if month <= 2 { year - 1 } else { year });
        let (era, of_era) = (years.div_euclid(400), years.rem_euclid(400));
        let of_year = (153 * shifted + 2) / 5 + day - 1;
        Some(era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468)
    }
}

fn length(year: i64, month: i64) -> i64 {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    match month {
        2 if leap => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

impl Moment {
    /// The moment in a cell; `None` if it contains anything else.
    pub(crate) fn of(cell: &str) -> Option<Self> {
        let cell = cell.trim_start_matches('\'').trim();
        if !cell.contains(|c: char| c.is_ascii_digit()) || cell.len() > 40 {
            return None;
        }
        let Some(colon) = cell.find(':') else {
            return Some(Self { date: Some(date(cell)?), ..Self::default() });
        };
        let hour = cell[..colon].trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let (before, after) = cell.split_at(hour);
        let (clock, offset) = clock(after)?;
        let before = before.trim_end();
        let before = before.strip_suffix(['T', ',', '_']).unwrap_or(before);
        let date = if before.is_empty() { None } else { Some(date(before.trim())?) };
        Some(Self { date, clock: Some(clock), offset })
    }

    /// The parts of two cells, if they do not contradict.
    pub(crate) fn with(self, other: Self) -> Option<Self> {
        let twice = (self.date.is_some() && other.date.is_some())
            || (self.clock.is_some() && other.clock.is_some());
        let (date, clock) = (self.date.or(other.date), self.clock.or(other.clock));
        (!twice).then_some(Self { date, clock, offset: self.offset.or(other.offset) })
    }
}

/// A whole number of at most this number of digits.
fn digits(text: &str, most: usize) -> Option<u32> {
    let sound = (1..=most).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    if sound { text.parse().ok() } else { None }
}

const MONTHS: [&str; 12] =
    ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];

fn date(text: &str) -> Option<Date> {
    let separator = text.chars().find(|c| "-/. ".contains(*c))?;
    let parts: Vec<&str> = text.split(separator).map(str::trim).filter(|p| !p.is_empty()).collect();
    let [a, b, c] = parts.as_slice() else { return None };
    let month = |text: &str| {
        let text = text.trim_end_matches('.').to_ascii_lowercase();
        MONTHS.iter().zip(1..).find(|(name, _)| text == **name).map(|(_, number)| number)
    };
    if let Some(month) = month(b) {
        let numbers = [digits(a, 2)?, month, digits(c, 4).filter(|_| c.len() == 4)?];
        return Some(Date { numbers, order: Some(DateOrder::DayFirst), short: false });
    }
    if separator == ' ' {
        return None;
    }
    let numbers = [digits(a, 4)?, digits(b, 2)?, digits(c, 4)?];
    let lengths = [a.len(), c.len()];
    let (order, short) = match (lengths, separator) {
        ([4, 1 | 2], _) => (Some(DateOrder::YearFirst), false),
        ([1 | 2, 4], '.') => (Some(DateOrder::DayFirst), false),
        ([1 | 2, 2], '.') => (Some(DateOrder::DayFirst), true),
        ([1 | 2, 4], _) => (None, false),
        ([1 | 2, 2], _) => (None, true),
        _ => return None,
    };
    Some(Date { numbers, order, short })
}

/// Nanoseconds from midnight, and minutes ahead of UTC.
fn clock(text: &str) -> Option<(i64, Option<i64>)> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || ":.,".contains(c)));
    let (numbers, suffix) = text.split_at(end.unwrap_or(text.len()));
    let parts: Vec<&str> = numbers.split(':').collect();
    let (hour, minute) = (digits(parts[0], 2)?, digits(parts.get(1)?, 2)?);
    let seconds = match parts.as_slice() {
        [_, _] => 0,
        [_, _, seconds] => nanoseconds(seconds)?,
        // the 34970A and 34972A write milliseconds after a colon
        [_, _, seconds, milliseconds] if milliseconds.len() == 3 => {
            i64::from(digits(seconds, 2)?) * SECOND
                + i64::from(digits(milliseconds, 3)?) * (SECOND / 1000)
        }
        _ => return None,
    };
    let suffix = suffix.trim();
    let bare = suffix.replace('.', "").to_ascii_lowercase();
    let (hour, offset) = match bare.as_str() {
        "am" | "pm" if !(1..=12).contains(&hour) => return None,
        "am" => (hour % 12, None),
        "pm" => (hour % 12 + 12, None),
        "" => (hour, None),
        _ => (hour, Some(offset(suffix)?)),
    };
    if hour > 23 || minute > 59 || seconds >= 60 * SECOND {
        return None;
    }
    Some((i64::from(hour * 60 + minute) * 60 * SECOND + seconds, offset))
}

/// Seconds with a fraction of up to nine digits.
fn nanoseconds(text: &str) -> Option<i64> {
    let (whole, fraction) = text.split_once(['.', ',']).unwrap_or((text, "0"));
    let scale = 10_i64.pow(9_u32.checked_sub(u32::try_from(fraction.len()).ok()?)?);
    Some(i64::from(digits(whole, 2)?) * SECOND + i64::from(digits(fraction, 9)?) * scale)
}

/// `Z`, `UTC`, `+02:00`, `-0530`, `+02`.
fn offset(text: &str) -> Option<i64> {
    if ["Z", "z", "UTC", "GMT"].contains(&text) {
        return Some(0);
    }
    let sign = match text.as_bytes().first()? {
        b'+' => 1,
        b'-' => -1,
        _ => return None,
    };
    let bare = text.get(1..)?.replacen(':', "", 1);
    let (hours, minutes) = bare.split_at_checked(2)?;
    let minutes = if minutes.is_empty() { 0 } else { digits(minutes, 2).filter(|m| *m < 60)? };
    let hours = digits(hours, 2).filter(|h| *h <= 14)?;
    Some(sign * i64::from(hours * 60 + minutes))
}

#[cfg(test)]
mod tests {
    use super::{DAY, DateOrder, Moment, SECOND};

    fn at(cell: &str, order: DateOrder) -> Option<(Option<i64>, Option<i64>, Option<i64>)> {
        let moment = Moment::of(cell)?;
        let day = match moment.date {
            Some(date) => Some(date.day(order)?),
            None => None,
        };
        Some((day, moment.clock, moment.offset))
    }

    /// Days from 1970-01-01 by `date -d 2026-05-03 +%s`: 1777766400 s are 20576 days.
    #[test]
    fn one_moment_in_the_forms_of_many_loggers() {
        const NOON: i64 = DAY / 2 + 5 * SECOND;
        let day = Some(20_576);
        for cell in [
            "2026-05-03 12:00:05",
            "2026/05/03 12:00:05",
            "03.05.2026 12:00:05",
            "3.5.26 12:00:05",
            "03-May-2026 12:00:05",
            "5/3/2026 12:00:05 PM",
            "05/03/2026, 12:00:05 p.m.",
            "05/03/2026 12:00:05:000",
        ] {
            let found = at(cell, DateOrder::MonthFirst);
            assert_eq!(found, Some((day, Some(NOON), None)), "{cell}");
        }
        let zoned = at("2026-05-03T12:00:05.5+02:00", DateOrder::DayFirst);
        assert_eq!(zoned, Some((day, Some(NOON + SECOND / 2), Some(120))));
        assert_eq!(
            at("12:00:05,25", DateOrder::DayFirst),
            Some((None, Some(NOON + SECOND / 4), None))
        );
        assert_eq!(at("03/05/2026", DateOrder::DayFirst), Some((day, None, None)));
        assert_eq!(at("12:30 AM", DateOrder::DayFirst), Some((None, Some(1800 * SECOND), None)));
    }

    /// Days by `date -d 2000-02-29 +%s` and so on, divided by 86400.
    #[test]
    fn days_are_those_of_the_calendar() {
        for (cell, day) in
            [("1970-01-01", 0), ("2000-02-29", 11_016), ("2024-12-31", 20_088), ("1969-12-31", -1)]
        {
            assert_eq!(at(cell, DateOrder::DayFirst), Some((Some(day), None, None)), "{cell}");
        }
        assert_eq!(at("2025-02-29", DateOrder::DayFirst), None);
        assert_eq!(at("31.04.2026", DateOrder::DayFirst), None);
    }

    #[test]
    fn other_texts_are_none() {
        for cell in [
            "",
            "25.5",
            "1.2.3.4",
            "24:00:00",
            "12:60",
            "12:00:61",
            "13:00 PM",
            "-12:00",
            "1:2:3:4",
            "10:00 CET",
            "12:00:05.1234567891",
            "a/b/c",
            "3/5",
            "2026-05-03 12",
            "12:00:05x",
        ] {
            assert_eq!(Moment::of(cell), None, "{cell}");
        }
    }
}
