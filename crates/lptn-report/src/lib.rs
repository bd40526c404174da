//! What a result looks like: terminal tables with sparklines, CSV, JSON.
//!
//! The writers take [`lptn_solve::Table`] and give text; nothing here solves anything, prints anything or knows
//! where the text goes. In files every number is the shortest text that reads back as the same `f64`; in tables
//! for reading, numbers are rounded and say their unit.

mod csv;
mod heat;
mod json;
mod layout;
mod number;
mod sparkline;

pub use csv::{write_csv, write_rows};
pub use heat::{Flow, balance};
pub use json::JsonWriter;
pub use layout::{Align, Column, TextTable, WIDTH, differing, labelled, plain, shortened};
pub use number::{Shortest, decimals, duration, fixed, prefix, significant};
pub use sparkline::sparkline;
