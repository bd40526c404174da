//! Networks as pictures.
//!
//! A [`Diagram`] is a network as it is drawn: its nodes, boundaries, paths and sources with their
//! labels, grouped into boxes on request. [`Laid`] lays it out. [`Laid::scene`] draws it with the
//! usual symbols, [`Laid::sankey`] its heat flows as bands. [`dot()`] and [`mermaid()`] write it
//! for other programs. A [`GridField`] is the temperature of the cells of a grid, drawn slice by slice
//! or written for ParaView.

mod direction;
mod dot;
mod exchange;
mod field;
mod groups;
mod labels;
mod layout;
mod legend;
mod mermaid;
mod model;
mod picture;
mod read;
mod ring;
mod sankey;
mod slice;
mod supplies;
mod symbols;
mod vtk;
mod words;

pub use dot::dot;
pub use field::{Cut, GridField, NoSlice};
pub use groups::{Grouping, MOST_PLACES};
pub use mermaid::mermaid;
pub use model::{Diagram, Link, Place, PlaceRole, Scales, Supply, Switching, Target};
pub use picture::{Laid, MOST_DRAWN, TooMany};
pub use read::{View, diagram, series};
pub use sankey::{Band, Bar, BarRole, HeatFlows, NoSankey};
pub use slice::{Shades, slice};
pub use vtk::vtk;
