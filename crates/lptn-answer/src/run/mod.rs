//! Runs over time.

mod answer;
mod events;
pub mod figure;
mod next;
mod observed;
pub(crate) mod page;
mod report;
mod solve;
mod state;
mod task;
pub mod uncertainty;
mod windows;

pub use answer::RunAnswer;
pub use observed::{observed, record, shown};
pub use task::{NoSteady, RunQuestion, RunTask, View};
