//! Effects of the `±` of parameters on the results of a run.
//!
//! Every parameter with `±` is normal by default, and independent of those with which no
//! correlation is known; a posterior of a fit gives both. [`UncertaintyTask::sobol`] runs the
//! network at scrambled Sobol points of the parameters: no assumption about how the results depend
//! on them. [`UncertaintyTask::linear`] takes the exact sensitivities of one run and assumes that
//! results are straight lines in the parameters within their deviations. [`discrepancies`] lists
//! where the two disagree.

mod answer;
mod difference;
mod error;
mod estimate;
mod input;
pub(crate) mod joint;
mod linear;
mod lost;
pub(crate) mod points;
mod result;
mod sample;
mod sobol;
mod task;

pub use answer::{Answer, AnswerOf, Contribution};
pub use difference::{Discrepancy, discrepancies};
pub use error::UncertaintyError;
pub use estimate::Estimate;
pub use input::{Inputs, Uncertain, uncertain, uncertain_anywhere};
pub use lost::Lost;
pub use result::{Bands, Bent, Uncertainty, UncertaintyMethod};
pub use sobol::{GROUPS, Sobol};
pub use task::UncertaintyTask;
