//! The sections, one file each.

mod boundary;
mod capacitor;
mod conductor;
mod default;
mod end;
mod limit;
mod material;
mod node;
mod source;
mod top;

pub(crate) use default::Default;
pub(crate) use material::Known;
pub(crate) use top::{check_head, empty};
