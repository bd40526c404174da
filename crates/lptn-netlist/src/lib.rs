//! Netlists: TOML text to a [`Network`](lptn_network::Network), with every problem named by its
//! place.
//!
//! [`parse`] reads the text into a [`RawNetlist`] (the text with places), and that into a
//! [`Netlist`] (its meaning). Nothing stops at the first problem: a [`Rejected`] netlist lists them
//! all, each a [`Diagnostic`] with a stable code, the places in the [`Files`] and, if possible, the
//! text to paste.
//!
//! ```
//! let text = r#"
//! format = 1
//!
//! [node]
//! block = { T0 = "25 degC", C = "500 J/K" }
//!
//! [boundary]
//! air = { T = "25 degC" }
//!
//! [resistor]
//! cooling = { from = "block", to = "air", R = "0.3 K/W" }
//! "#;
//! let netlist = lptn_netlist::parse("block.toml", text)?;
//! let block = netlist.network.node("block")?;
//! assert_eq!(netlist.network.capacity(block), 500.0);
//!
//! let rejected = lptn_netlist::parse("block.toml", &text.replace("K/W", "W/K")).unwrap_err();
//! assert_eq!(rejected.diagnostics[0].code, "units::dimension");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adrift;
mod assign;
mod assumed;
mod believe;
mod case;
mod compiled;
mod controller;
mod course_text;
mod csv_files;
mod csv_form;
mod describe;
mod duplicate;
mod elaborate;
mod enclosure;
mod expand;
mod fields;
mod fit;
mod foreign;
mod format;
mod formed_file;
mod foster;
mod functional;
mod gearbox;
mod grid_names;
mod grid_part;
mod habit;
mod head;
mod hydraulic;
mod import;
mod imported;
mod include;
mod infer;
mod initial;
mod json;
pub mod library;
mod listed;
mod misplaced;
mod names;
mod near_file;
mod netlist;
mod outputs;
mod overhang;
mod parameters;
mod pipe;
mod place;
mod places;
mod plain;
mod plan;
mod plausible;
mod points;
mod posterior;
mod raw;
mod reading;
mod result_names;
mod run;
mod run_times;
mod scales;
mod schema;
mod scope;
mod section;
mod sensor;
mod settable;
mod setting;
mod size;
mod source_map;
mod state;
mod streams;
mod study;
mod sweep;
mod syntax;
mod syntax_error;
mod template;
mod texture;
mod toml_1_1;
mod toml_text;
mod uncertainty;
mod unlikely;
mod value;
mod value_help;
mod work;
mod write_back;
mod written_out;

pub use believe::Taken;
pub use case::CaseStudy;
pub use expand::{Derived, WrittenError, prove};
pub use fit::{FitInitial, FitPlan, FitRecord, FitSignal, FitStudy, Observed, VariedName};
pub use format::{KeyDeclaration, NetlistFormat, Role, SectionDeclaration, Takes};
pub use gearbox::{Arrangement, Gearbox, GearboxPart, Member};
pub use include::Loader;
pub use infer::{EstimatedSignal, InferStart, InferStudy};
pub use initial::InitialState;
pub use lptn_data::{
    CsvOptions, CsvText, DATE_ORDERS, DECIMALS, DataSheet, DateOrder, Decimal, Diagnostic, FileId,
    Files, Label, MOST_BYTES, MOST_CSV_BYTES, MOST_PROBLEMS, ReadError, Record, RecordColumn,
    RecordLine, RecordLines, RecordName, RecordQuery, RecordRow, Rejected, Saturation, Severity,
    Span, read_bytes, read_named, read_record, read_sheet, read_text, revolutions_option,
    unit_option,
};
pub use lptn_network::{Functional, RunSettings, WindowSettings};
pub use near_file::similar_file;
pub use netlist::{Netlist, parse, parse_bytes, parse_file, parse_raw, parse_with, read};
pub use plan::{
    KnownTo, PlaceNumbers, PlanNumbers, PlanPlace, PlanRun, PlanStudy, RunNumbers, Target,
};
pub use posterior::{Believed, Posterior, PosteriorOf, PosteriorPrior, PosteriorQuantity};
pub use raw::{RawEntry, RawKind, RawNetlist, RawTable, RawValue};
pub use run_times::{GivenTime, RunTime};
pub use schema::schema;
pub use section::{Studies, format};
pub use sensor::{Certainty, Sensor, SensorValue};
pub use size::{
    Catalogue, CatalogueColumn, Goal, Objective, Over, RangeOf, Requirement, SizeRange, SizeStudy,
};
pub use source_map::SourceMap;
pub use state::{SavedState, StateControl, StateEnd};
pub use streams::unbalanced_streams;
pub use sweep::{
    AxisNumbers, MOST_CASES, Measure, SweepAxis, SweepMethod, SweepOver, SweepPlan, SweepStudy,
};
pub use write_back::WrittenNumber;
