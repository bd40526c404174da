//! The sections, one file each.

mod boundary;
mod capacitor;
mod conductor;
mod control;
mod curves;
mod default;
mod direction;
mod end;
mod fan;
mod fluid;
mod forms;
mod grid;
mod grid_shape;
mod keys;
mod limit;
mod list;
mod lubricant;
mod material;
mod matrix;
mod named_value;
mod node;
mod patch;
mod path;
mod path_law;
mod path_section;
mod placement;
mod property;
mod property_call;
mod signal;
mod source;
mod state;
mod stream_along;
mod table;
mod top;
mod winding;

pub(crate) use control::{CONTROL, narrow};
pub(crate) use default::{Default, Initial};
pub(crate) use forms::check_forms;
pub(crate) use keys::LUBRICANT_OF;
pub use list::{Studies, format};
pub(crate) use node::NODE;

pub(crate) use path_section::{PATHS, PathSection};
pub(crate) use signal::SIGNAL;
pub(crate) use state::STATE;
pub(crate) use table::TABLE;
