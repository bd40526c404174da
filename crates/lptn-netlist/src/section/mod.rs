//! The sections, one file each.

mod advection;
mod boundary;
mod capacitor;
mod conduction;
mod conductor;
mod control;
mod default;
mod end;
mod grid;
mod limit;
mod material;
mod node;
mod property;
mod radiation;
mod signal;
mod source;
mod table;
mod top;

pub(crate) use advection::KnownFluid;
pub(crate) use control::{control_not_here, narrow};
pub(crate) use default::{Default, Initial};
pub(crate) use material::Known;
pub(crate) use top::{check_head, empty};
