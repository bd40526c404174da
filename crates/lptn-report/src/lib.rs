//! Output of results: terminal tables with sparklines, CSV, JSON, pictures.
//!
//! A command's answer is a [`Page`]. It gives a [`Text`] for reading, rows and an object for
//! programs, and figures. A format is one file, which asks the page only for the part that it
//! writes. A [`Report`] is all of a page as a document. Nothing here solves or prints anything, or
//! knows the destination of the text. In files every number is the shortest text that reads back as
//! the same `f64`. In tables for reading, numbers are rounded and have their unit.

mod clock;
mod colour;
mod columns;
mod csv;
mod families;
mod format;
mod heat;
mod json;
mod layout;
mod names;
mod number;
mod of_page;
mod page;
mod picture;
mod report;
mod rows;
mod sparkline;
mod standing;
mod text;

pub use clock::{Clock, TimeUnit};
pub use colour::{Look, WIDTH};
pub use columns::{MOST_CURVES, TEMPERATURE, bound_of, column_names, panels, proven_caption};
pub use csv::{CsvLines, write_csv, write_rows};
pub use families::{MORE_MEMBERS, family};
pub use format::{Format, write};
pub use heat::{Flow, balance};
pub use json::{Json, JsonWriter};
pub use layout::{Align, Column, TextTable, TextTableOf, labelled, stacked};
pub use names::{differing, plain, shortened, without_folders};
pub use number::{Shortest, decimals, duration, fixed, prefix, rounded_up, significant};
pub use of_page::{report_of, with_results};
pub use page::{Page, PageOf};
pub use picture::{Canvas, Picture};
pub use report::{Claim, Piece, Report, Section};
pub use rows::{Cells, RowColumn, Rows};
pub use sparkline::sparkline;
pub use standing::Standing;
pub use text::{Block, Text, words};
