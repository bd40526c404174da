//! The sections, one file each.

mod boundary;
mod capacitor;
mod conductor;
mod control;
mod default;
mod end;
mod fluid;
mod forms;
mod grid;
mod limit;
mod material;
mod node;
mod path;
mod property;
mod signal;
mod source;
mod table;
mod top;

pub(crate) use control::narrow;
pub(crate) use default::{Default, Initial};
pub(crate) use top::{check_head, empty};
