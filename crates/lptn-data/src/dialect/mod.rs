//! The dialect of a file: the sign between its columns, its decimal sign, and the lines above and
//! below its header.
//!
//! A file in lptn's own form (names with units, commas, decimal points, no other lines) is not
//! searched: its first three rows show that it is one. In any other file the last lines of the
//! beginning are rows of numbers; they show the separator, and the header is the nearest line of
//! names above the first of them. A few makers name the form in the first line (`makers`).

mod detect;
mod makers;
mod sample;

use std::ops::Range;

use crate::numeral::Decimal;
use crate::text::CsvText;

pub(crate) use detect::{bracketless, detect};
pub(crate) use makers::{Maker, known};
pub(crate) use sample::is_value;

/// The form of the columns, numbers and lines of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dialect {
    /// The sign between columns.
    pub(crate) separator: u8,
    pub(crate) decimal: Decimal,
    /// The byte at which the reader looks for the header.
    pub(crate) start: usize,
    /// Number of lines above the header that are not comments.
    pub(crate) titles: usize,
    /// The line with the units.
    pub(crate) units: Option<Range<usize>>,
    /// The byte at which the rows begin, if not below the header.
    pub(crate) rows: Option<usize>,
    /// The byte at which the rows end, if not at the end of the text.
    pub(crate) end: Option<usize>,
    /// The decimal sign that the file states.
    pub(crate) stated: Option<Decimal>,
    /// The name of columns in seconds.
    pub(crate) seconds: Option<&'static str>,
    /// The name of a last column that rows may leave out.
    pub(crate) remark: Option<&'static str>,
    pub(crate) maker: Option<Maker>,
}

impl Dialect {
    /// The form that lptn writes.
    pub(crate) const PLAIN: Self = Self {
        separator: b',',
        decimal: Decimal::Point,
        start: 0,
        titles: 0,
        units: None,
        rows: None,
        end: None,
        stated: None,
        seconds: None,
        remark: None,
        maker: None,
    };

    /// Words for everything that is not lptn's own form.
    pub(crate) fn told(&self, text: &CsvText) -> Vec<String> {
        let separator = match self.separator {
            b',' => None,
            b'\t' => Some("tabs between columns".to_owned()),
            other => Some(format!("`{}` between columns", char::from(other))),
        };
        let decimal = match self.decimal {
            Decimal::PointOnly if self.separator != b',' => Some("decimal points".to_owned()),
            Decimal::Point | Decimal::PointOnly => None,
            Decimal::Comma => Some("decimal commas".to_owned()),
        };
        let encoding = text.encoding.foreign().map(|name| format!("encoding {name}"));
        let titles = match self.titles {
            0 => None,
            1 => Some("one line above the header left out".to_owned()),
            titles => Some(format!("{titles} lines above the header left out")),
        };
        let units = self.units.as_ref().map(|_| "units in a separate line".to_owned());
        let maker = self.maker.map(|maker| maker.told().to_owned());
        [maker, separator, decimal, encoding, titles, units].into_iter().flatten().collect()
    }
}
