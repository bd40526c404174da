//! Questions to a netlist, and their answers.
//!
//! A question is a plain value, such as [`run::RunQuestion`] or [`rank::RankQuestion`]. Its `ask`
//! takes an [`input::Input`], a netlist with everything that was set in it, and a
//! [`listener::Listener`], which hears progress and may interrupt. The answer owns everything and
//! implements [`answer::Answer`]: doubts, exit class, and a [`Page`](lptn_report::Page) that is
//! written as a text, CSV, JSON, a figure or a part of a report. If there is no answer,
//! [`failure::Failure`] has the problems.
//!
//! A doubt is a [`Diagnostic`](lptn_netlist::Diagnostic) of severity warning with its code,
//! sentence, place in the netlist, and help. Clients print the texts of this crate.

pub mod about;
pub mod answer;
pub mod balance;
pub mod belief;
pub mod bound;
pub mod check;
pub mod compare;
pub mod cycle;
mod example;
pub mod exit;
pub mod failure;
pub mod families;
pub(crate) mod fields;
pub mod fit;
pub mod folder;
mod gaps;
mod gathered;
pub mod gear;
pub mod graph;
pub mod impedance;
pub mod infer;
pub mod input;
pub mod known_columns;
pub mod limits;
pub mod listener;
pub mod loaded;
pub mod lumping;
pub mod memory_files;
pub mod messages;
pub mod modes;
pub mod operating_point;
mod over_time;
mod overridden;
mod parameter;
pub mod period;
pub mod plan;
pub mod plot;
mod proven;
pub mod ranges;
pub mod rank;
pub mod reduce;
pub mod refused;
pub mod run;
pub mod scale;
pub mod select;
pub mod size;
pub mod steady;
pub mod studies;
pub mod sweep;
pub mod taken;
pub mod trust;
pub mod unseparated;
pub mod verify;
pub mod words;
pub mod written;

pub use gaps::gaps;
