//! Reports as HTML: one file that a browser opens from disk and that loads nothing from a network.
//! It can be printed and sent by mail.
//!
//! [`write()`] makes it from a [`Report`](lptn_report::Report). Curves are drawn twice. The picture
//! is for print and for browsers without scripts. A script draws the same values so that they can
//! be zoomed. Texts of the report can only become text: everything is escaped when it is written.
//! The page allows no script but its own two, by their hashes. A live page
//! ([`write_live`]) has a third one and the core as WebAssembly.
//!
//! The script is uPlot (vendored, 53 kB, MIT). The hashes of the two scripts are in a
//! `Content-Security-Policy`, so that an unescaped text could not run either. A test checks the
//! hashes. A page contains no date: the same input gives the same bytes.

#[cfg(test)]
mod base64;
mod base85;
mod chart;
mod live;
mod page;
mod parts;
mod policy;
mod script;
mod style;
mod text;

pub use live::Live;
pub use page::{write, write_live};
pub use parts::{claims, figures, results};
