//! Figures: their content, their layout and their output.
//!
//! A [`Figure`] is the content: curves with units, limits, moments. [`chart::scene`] lays it out as
//! a [`Scene`], a drawing of paths and texts, which [`svg`] and [`png`] write; [`terminal`] draws
//! it with characters. An [`Ink`] is the meaning of a colour, and each [`Theme`] has a colour for
//! it. This crate has no notion of a node.
//!
//! A page gives figures. They are laid out once as a scene, which each writer only transcribes. SVG
//! and PNG therefore cannot differ, and other drawings, such as that of a network, use the same
//! inks and writers.

pub mod chart;
pub mod contour;
pub mod figure;
pub mod font;
mod ink;
pub mod png;
pub mod scene;
pub mod svg;
pub mod terminal;
mod thin;
mod ticks;
mod views;

pub use figure::Figure;
pub use ink::{FIELD, Ink, Rgb, SERIES, Theme, contrast};
pub use png::PngError;
pub use scene::Scene;
pub use thin::thinned;
pub use ticks::{printed, round_marks};
pub use views::LONG;
