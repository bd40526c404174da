//! Results for the time histories.

use lptn_network::NodeId;

/// A number and its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Value in SI units.
    pub value: f64,
    /// Standard deviation in the units of a difference.
    pub deviation: f64,
}

/// Time histories inferred from a record.
#[derive(Clone, Debug)]
pub struct Inferred {
    /// The moments in s: the rows of the record, and the start of the run if it is known.
    pub times: Vec<f64>,
    /// Number of moments before the first row of the record.
    pub before: usize,
    /// Each estimated time history.
    pub courses: Vec<InferredCourse>,
    /// Temperature of each node at each moment, measured or not: value in K.
    pub nodes: Vec<(NodeId, Vec<Known>)>,
    /// The values of instruments that were not known exactly.
    pub sensors: Vec<InferredSensor>,
    /// The parameters with a `±`, updated by the record.
    pub parameters: Vec<Known>,
    /// The columns.
    pub columns: Vec<InferredColumn>,
    /// The logarithm of the probability density of the record, in readings per K.
    pub log_likelihood: f64,
    /// Jumps of time histories, in ascending order.
    pub jumps: Vec<InferredJump>,
    /// Number of rounds, each linear near the time histories of the one before.
    pub rounds: usize,
}

/// One time history.
#[derive(Clone, Debug)]
pub struct InferredCourse {
    /// Its most probable value at each moment, in SI units, and the band that contains it with a
    /// probability of 95 %.
    pub band: Vec<Band>,
    /// `None` if the record determines it, else the unknowns that the record cannot distinguish it
    /// from. The band must not depend on the deviation assumed for an unknown value. Values with a
    /// `±` must not make it wider than the size of the time history.
    pub rivals: Option<Vec<Rival>>,
    /// Its mean over the record; `None` if its logarithm walks.
    pub mean: Option<Known>,
    /// Prior value at the start, or of its logarithm: almost without information.
    pub before: Known,
    /// Variance of its walk per s, in SI units; 0 if the record does not show that it walks.
    pub intensity: f64,
    /// Variance of the walk of its slope per s.
    pub slope_intensity: f64,
    /// Its value if it does not change at all, with the least deviation that any method can reach
    /// (C. R. Rao, Bull. Calcutta Math. Soc. 37 (1945) 81; H. Cramer, 1946), and the logarithm of
    /// the probability density of the record then.
    pub still: (Known, f64),
}

/// An unknown that the record may not distinguish from a time history.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rival {
    /// Another time history, by its index in the task.
    Estimated(usize),
    /// A parameter with a `±`, by its index among the uncertain ones of the task.
    Parameter(usize),
    /// A value of an instrument.
    Sensor {
        /// Index of the sensor in the task.
        sensor: usize,
        /// True for its gain; false for its offset.
        gain: bool,
    },
    /// The temperature of a node at the start.
    Start(NodeId),
}

impl InferredCourse {
    /// True if the record determines it.
    pub fn is_determined(&self) -> bool {
        self.rivals.is_none()
    }
}

/// Estimate of a time history at a moment, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The most probable value.
    pub value: f64,
    /// The ends of the interval of 95 %.
    pub ends: (f64, f64),
}

/// A jump of a time history between two rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InferredJump {
    /// Index of the time history in the task.
    pub course: usize,
    /// The interval in s that contains it with a probability of 95 %, from row to row.
    pub between: (f64, f64),
    /// Its height in SI units, or that of the logarithm if the logarithm walks.
    pub by: Known,
    /// Decrease of the log-likelihood without it.
    pub gain: f64,
}

/// A value of an instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InferredSensor {
    /// Index of the sensor in the task.
    pub sensor: usize,
    /// True for its gain; false for its offset in K.
    pub gain: bool,
    /// Prior value.
    pub before: Known,
    /// Value updated by the record.
    pub now: Known,
}

/// Readings of a column compared with their predictions from all readings before.
#[derive(Clone, Debug, PartialEq)]
pub struct InferredColumn {
    /// Number of readings.
    pub readings: usize,
    /// The index of the moment of each reading, and the reading less its prediction in standard
    /// deviations of that difference.
    pub surprises: Vec<(usize, f64)>,
    /// Standard deviation of the noise of one reading in K, given or estimated.
    pub sigma: f64,
    /// Standard deviation of its slow part in K, and the time in s until 1/e of it is left; `None`
    /// if all is white.
    pub slow: Option<(f64, f64)>,
    /// Surprise of the first reading in standard deviations.
    pub first: f64,
    /// Mean surprise in standard deviations: 0 but for chance, which is 1 / root of the number of
    /// readings.
    pub mean: f64,
    /// Root mean square of the surprise: 1 but for chance.
    pub rms: f64,
    /// Correlation of neighbours: 0 but for chance, which is 1 / root of their number.
    pub neighbours: f64,
    /// Drift of the instrument over the record in K, if its offset drifts at a steady rate, as
    /// determined by the other columns. `None` if there is no other.
    pub drift: Option<Known>,
}
