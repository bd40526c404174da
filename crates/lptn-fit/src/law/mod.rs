//! The law of the speed that a measured power follows, and a check that laws of power, temperature
//! rise and time constant can be true together.
//!
//! Losses of gearboxes at no load are sums of parts proportional to the speed (seals), to its power
//! 5/3 (bearings in oil or grease: A. Palmgren) and to its third power (gears in oil); AGMA 6123
//! and ISO/TR 14179 add them up. [`LawStudy`] fits each, every sum of them, a free exponent and the
//! user's laws, and ranks them. [`Consistency`] checks `P = C dT / t_RC` between the laws that were
//! fitted to each. [`RunsStudy`] begins with the records themselves.
//!
//! ```
//! use lptn_fit::law::{LawStudy, LossLaw, Points};
//!
//! // 87 uW/rpm^(5/3) and a disturbance of 1 W
//! let rpm = std::f64::consts::TAU / 60.0;
//! let speeds = [1000.0, 2000.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0];
//! let noise = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0];
//! let power = |(n, w): (&f64, f64)| 87e-6 * n.powf(5.0 / 3.0) + w;
//! let power = speeds.iter().zip(noise).map(power).collect();
//! let points = Points::new(speeds.map(|n| n * rpm).to_vec(), power, None)?;
//! let study = LawStudy::new(points, LossLaw::standard());
//! assert_eq!(study.best().unwrap().law.to_string(), "omega^(5/3)");
//! # Ok::<(), lptn_fit::law::LawError>(())
//! ```

mod candidate;
mod columns;
mod consistency;
mod criteria;
mod error;
mod interval;
mod model;
mod points;
mod posterior;
mod powers;
mod runs;
mod slopes;
mod solve;
mod stated;
mod study;
mod written;

pub use candidate::{Coefficient, Fitted, LawFit, Outcome};
pub use columns::{ColumnFits, RunFit};
pub use consistency::{AtSpeed, CLOSE, Consistency, Level, Measured, SIGNIFICANT, Significance};
pub use error::LawError;
pub use interval::Estimate;
pub use model::LossLaw;
pub use points::{Points, Variable};
pub use runs::{Run, RunReference, RunsError, RunsSettings, RunsStudy, Systematic};
pub use slopes::{ColumnDifference, ColumnLines};
pub use stated::{Exponent, LawOf, StatedLaw};
pub use study::{ALIKE, LawStudy};
pub use written::{Start, WrittenLaw};
