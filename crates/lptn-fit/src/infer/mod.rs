//! Courses over time from records: the heat that is dissipated while it is, or a flow, a film
//! coefficient, whatever signal a network has.
//!
//! What is sought is a random walk, so smooth that the record is most likely, or as smooth as is
//! said. Near a run of the network everything is linear, and a Kalman filter and smoother give what
//! all readings together say of every moment ([`crate::kalman`]). Networks that are not linear in
//! what is sought are followed in rounds, each near the courses of the one before, until nothing
//! moves (iterated smoother; B. M. Bell, SIAM J. Optim. 4 (1994) 626): that is the Gauss-Newton
//! method for the most probable courses. Parameters with a `±` and instruments with one are
//! estimated along, so what is not known of them widens every band.
//!
//! A quantity that is estimated over time is a signal. Parameters do not change in a run, and the
//! network knows its constant parts. The estimated time history is therefore one that a run can
//! have, and every round is such a run. The states of the filter are distances from that run.
//!
//! Derivatives by time histories and parameters are differences of whole rates (`StateRates`), not
//! dual numbers. The derivative of a round only determines the start of the next, and for linear
//! networks differences are exact.

mod answer;
mod carried;
mod determined;
mod discrete;
mod error;
mod follow;
mod guess;
mod inferred;
mod jumps;
mod linear;
mod model;
mod noises;
mod open;
mod prior;
mod reference;
mod rounds;
mod search;
mod states;
mod strength;
mod study;
mod surprise;
mod task;

pub use answer::infer;
pub use error::InferError;
pub use follow::{Followed, Follower, Row, Unexpected};
pub use inferred::{
    Band, Inferred, InferredColumn, InferredCourse, InferredJump, InferredSensor, Known,
};
pub use reference::InferObserver;
pub use task::{Drift, InferTask, Sought, Start, Uncertain};
