//! Quantities, dimensions and expressions with units checked.
//!
//! A value in a netlist is a string: a *quantity* such as `"0.3 K/W"` or `"87 ± 15 uW/rpm^(5/3)"`,
//! or an *expression* such as `"20 [W/K] + 60 [W/K] * fan"`. [`parse_value`] distinguishes them,
//! checks their dimensions, and for a mistake reports the place, the problem and the correct text.
//!
//! An expression is compiled once, against the names in scope, into a flat [`Program`] that is
//! evaluated on `f64` or, for derivatives, on [`Dual`] numbers.
//!
//! ```
//! use lptn_units::{Dimension, Type, parse_quantity};
//!
//! let resistance = parse_quantity("0.42 degC/W", Some(Type::of(Dimension::RESISTANCE)))?;
//! assert_eq!(resistance.value, 0.42); // K/W: inside a compound unit a temperature is a difference
//!
//! let film = Some(Type::of(Dimension::FILM_COEFFICIENT));
//! let mistake = parse_quantity("12 W/m2K", film).unwrap_err();
//! assert_eq!(mistake.help().as_deref(), Some("did you mean \"12 W/(m^2 K)\"?"));
//! # Ok::<(), lptn_units::UnitError>(())
//! ```

mod bounded;
mod bracket;
mod correlations;
mod declare_errors;
mod declare_words;
mod deviation;
mod dimension;
mod distribution;
mod dual;
mod error;
mod error_words;
mod expr;
mod format;
mod kin;
mod kinship;
mod naming;
mod number;
mod problems;
mod quantity;
mod rational;
mod repair;
mod scalar;
mod separators;
mod spread;
pub mod statistics;
mod suggest;
pub mod table;
mod taylor;
mod temperature;
mod traced;
mod types;
mod unit;
mod unit_parser;
mod unit_table;
mod value;

pub use bounded::Bounded;
pub use correlations::Correlations;
pub use declare_errors::Help;
pub use dimension::Dimension;
pub use dual::Dual;
pub use error::{UnitError, UnitErrorKind};
pub use expr::{
    Comparison, Degree, EvalError, Expression, LANES, Lanes, NoNames, Program, RESERVED, Scope,
    SlotKind, Split, Symbol, TableCall, Trend, is_function,
};
pub use format::{number as format_number, short as format_short, six as format_six};
pub use problems::{Class, Problem, Problems};
pub use quantity::{Quantity, WrittenQuantity, kelvin_alone, parse_quantity, written_quantity};
pub use rational::Rational;
pub use scalar::Scalar;
pub use spread::{Distribution, Spread};
pub use suggest::suggest;
pub use table::{
    DoubleLog, Interpolation, LookupTable, Outside, PowerLaw, Table1, Table2, TableError,
    TableSymbol,
};
pub use taylor::Taylor;
pub use temperature::TemperatureScale;
pub use traced::Traced;
pub use types::Type;
pub use unit::Unit;
pub use value::{Written, parse_value};
