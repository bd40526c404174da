//! Figures: what they show, how they are laid out, and how they are written.
//!
//! A [`Scene`] is a drawing of paths and texts; [`svg`] and [`png`] write one. What a colour means
//! is said by an [`Ink`], and each [`Theme`] has a colour for it. Nothing here knows what a node is.

pub mod font;
mod ink;
pub mod png;
pub mod scene;
pub mod svg;

pub use ink::{FIELD, Ink, Rgb, SERIES, Theme, contrast};
pub use scene::Scene;
