//! Reports as HTML: one file that a browser opens from disk, that asks no network for anything, and
//! that can be printed and sent by mail.
//!
//! [`write()`] makes it of a [`Report`](lptn_report::Report). Curves are drawn twice: as a picture,
//! which is what is printed and what browsers without scripts show, and by a script over the same
//! values, to zoom into. Texts of the report can only become text: everything is escaped where it
//! is written, and the page allows no script but its own, which it names by its hash.
//!
//! The script is uPlot (vendored, 53 kB, MIT). The hashes of the two scripts are in a
//! `Content-Security-Policy`, so that an unescaped text could not run either; a test checks the
//! hashes. A page contains no date: the same input gives the same bytes.

mod chart;
mod page;
mod policy;
mod style;
mod text;

pub use page::write;
