//! Time histories from records: the dissipated heat over time, a flow, a heat transfer coefficient,
//! or any other signal of a network.
//!
//! An estimated signal is a random walk. Its smoothness makes the record most likely, or is given.
//! Near a run of the network everything is linear. A Kalman filter and smoother then estimate every
//! moment from all readings ([`crate::kalman`]). If a network is not linear in the signals, rounds
//! follow, each near the time histories of the one before, until nothing moves (iterated smoother;
//! B. M. Bell, SIAM J. Optim. 4 (1994) 626). That is the Gauss-Newton method for the most probable
//! time histories. Parameters and instruments with a `±` are estimated too, so they widen every
//! band.
//!
//! A quantity that is estimated over time is a signal. Parameters do not change in a run, and the
//! network knows its constant parts. The estimated time history is therefore one that a run can
//! have, and every round is such a run. The states of the filter are distances from that run.
//!
//! Derivatives by time histories and parameters are differences of whole rates (`StateRates`), not
//! dual numbers. The derivative of a round only determines the start of the next, and for linear
//! networks differences are exact.

mod answer;
mod begin;
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
mod unfollowed;

pub use answer::infer;
pub use error::InferError;
pub use follow::{Followed, Follower, Row, Unexpected};
pub use inferred::{
    Band, Inferred, InferredColumn, InferredCourse, InferredJump, InferredSensor, Known, Rival,
};
pub use reference::InferObserver;
pub use task::{Drift, Estimated, InferTask, Start, Uncertain};
