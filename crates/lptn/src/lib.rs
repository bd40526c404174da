//! Lumped-parameter thermal networks: simulated, with units checked and energy accounted for.
//!
//! ```
//! use lptn::prelude::*;
//!
//! # fn main() -> Result<(), lptn::Error> {
//! let mut b = NetworkBuilder::new();
//! let steel = b.node("steel", HeatCapacity(2659.0), Temperature::celsius(25.5));
//! let bed = b.boundary("bed", Temperature::celsius(25.5));
//! b.resistor("R_eq", steel, bed, Resistance(0.3046));
//! b.source("losses", steel, HeatFlow(220.6));
//! let system = ThermalSystem::assemble(&b.build()?)?;
//!
//! let steady = SteadyState::solve(&system, 0.0)?;
//! assert!((steady[steel] - (273.15 + 25.5 + 220.6 * 0.3046)).abs() < 1e-9);
//!
//! let run = Transient::until(Time::minutes(25.0)).solve(&system)?;
//! assert!(run.at_end(steel)? < steady[steel] && run.ledger().closes());
//! # Ok(())
//! # }
//! ```
//!
//! Every error becomes an [`Error`], which `main` can return. Many candidates of one network need
//! no second assembly from text: [`ThermalSystem::with`](assembly::ThermalSystem::with) takes other
//! values of its parameters.
//!
//! A network comes from a TOML netlist ([`read`], [`parse`]) or from a
//! [`NetworkBuilder`](network::NetworkBuilder). Each module is a crate of its own; ARCHITECTURE.md
//! says what each of them owns. All numbers are in SI units, temperatures in K, heat positive into
//! a node and from `from` to `to`.

pub use lptn_analysis as analysis;
pub use lptn_answer as answer;
pub use lptn_assembly as assembly;
pub use lptn_fit as fit;
pub use lptn_graph as graph;
pub use lptn_integrate as integrate;
pub use lptn_laws as laws;
pub use lptn_netlist as netlist;
pub use lptn_network as network;
pub use lptn_plot as plot;
pub use lptn_reduce as reduce;
pub use lptn_report as report;
pub use lptn_solve as solve;
pub use lptn_study as study;
pub use lptn_units as units;

mod error;

pub use error::Error;
pub use lptn_netlist::{parse, read};

/// What a program that uses the library most often needs.
pub mod prelude {
    pub use lptn_assembly::ThermalSystem;
    pub use lptn_network::{
        Conductance, HeatCapacity, HeatFlow, Network, NetworkBuilder, Resistance, Temperature, Time,
    };
    pub use lptn_solve::{Ledger, OutputTimes, Selection, Solution, SteadyState, Table, Transient};
}
