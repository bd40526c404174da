//! The tests of `lptn-solve` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod accuracy;
mod backward;
mod balance;
mod between_kinks;
mod beyond_tables;
mod certificate;
mod certified_cycles;
mod certified_switches;
mod common;
mod cycles;
mod elements;
#[path = "common/elements.rs"]
mod elements_helper;
mod events;
mod exact;
mod exact_streams;
mod failures;
mod families;
mod features;
mod filling;
mod flow_networks;
mod folds;
mod guard;
mod guard_kinds;
mod integrals;
mod levels;
mod limits;
mod lumping;
mod methods;
mod modes;
mod modes_near;
mod near_state;
mod near_thresholds;
mod out_of_range;
mod outputs;
mod own_states;
mod periodic;
mod periodic_events;
mod pipes;
mod properties;
mod response;
mod sampled;
mod sensitive;
mod snapshot;
mod state_bounds;
mod steady;
mod steady_events;
mod without_state;
mod work;
