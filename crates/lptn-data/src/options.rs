//! Statements about the form of a file, where its contents do not show it.

use crate::moment::DateOrder;
use crate::numeral::Decimal;

/// Statements of a netlist or a command about the form of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct CsvOptions {
    /// The decimal sign; by default the one that the numbers show.
    pub decimal: Option<Decimal>,
    /// The order of dates such as `01/02/2026`; by default the one that the column shows.
    pub dates: Option<DateOrder>,
    /// The date and clock time that is 0 s; by default that of the first row.
    pub start: Option<String>,
    /// Columns with their units, in place of those of the header.
    pub units: Vec<(String, String)>,
}
