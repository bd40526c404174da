//! The core of a live page: a netlist that a browser solves again with other parameters.
//!
//! The page of a run with `--live` contains this crate as WebAssembly, and the netlist with its
//! files ([`contents`]). The page opens them ([`Live::open`]) and asks for an answer to each set of
//! values ([`Live::answer`]). Questions and answers are JSON. Answers come from `lptn-answer` and
//! are written by `lptn-html`, as those of the program: a page makes no number and no text itself.
//!
//! WebAssembly has no CVODES. A run that is neither linear nor suited to the Runge-Kutta method is
//! refused with a reason; its steady state is there.
//!
//! # Why this crate may use `unsafe`
//! A module of WebAssembly exports functions by name (`abi`), and replaces `exp` and the others
//! by name (`elementary`, as in `lptn-cvodes`). Rust calls an exported name unsafe because it
//! could collide with another. No pointer is read or written in `abi`; the page writes into a
//! buffer that a Rust value owns.

#[cfg(target_family = "wasm")]
#[allow(unsafe_code)]
mod abi;
mod contents;
#[cfg(target_family = "wasm")]
#[allow(unsafe_code)]
#[path = "../../lptn-cvodes/src/elementary.rs"]
mod elementary;
mod live;
mod sliders;

pub use contents::{Changes, contents};
pub use live::Live;
pub use sliders::{Slider, sliders};
