//! What is known of the courses.

use lptn_network::NodeId;

/// A number and its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// In SI units.
    pub value: f64,
    /// In the units of a difference.
    pub deviation: f64,
}

/// What a record tells of courses over time.
#[derive(Clone, Debug)]
pub struct Inferred {
    /// The moments in s: the rows of the record, and the start of the run where that is known.
    pub times: Vec<f64>,
    /// How many moments stand before the first row of the record.
    pub before: usize,
    /// Each course that was sought.
    pub courses: Vec<InferredCourse>,
    /// Temperature of each node at each moment, measured or not: value in K.
    pub nodes: Vec<(NodeId, Vec<Known>)>,
    /// The values of instruments that were not known exactly.
    pub sensors: Vec<InferredSensor>,
    /// The parameters with a `±`: what the record adds to what was known.
    pub parameters: Vec<Known>,
    /// The columns.
    pub columns: Vec<InferredColumn>,
    /// The logarithm of the probability density of the record, in readings per K.
    pub log_likelihood: f64,
    /// Where courses jump, in ascending order.
    pub jumps: Vec<InferredJump>,
    /// How many rounds it took, each linear near the courses of the one before.
    pub rounds: usize,
}

/// One course.
#[derive(Clone, Debug)]
pub struct InferredCourse {
    /// Its most probable value at each moment, in SI units, and the band that holds it with a
    /// probability of 95 %.
    pub band: Vec<Band>,
    /// Whether the record tells it: the band does not hang on what was taken for something of which
    /// nothing is known, and what is known with a `±` does not make it wider than the course is
    /// large.
    pub determined: bool,
    /// Its mean over the record; `None` where it is the logarithm that walks.
    pub mean: Option<Known>,
    /// What was known of it at the start, or of its logarithm: next to nothing.
    pub before: Known,
    /// Variance of its walk per s, in SI units: 0 where nothing in the record says that it walks.
    pub intensity: f64,
    /// Variance of the walk of its slope per s.
    pub slope_intensity: f64,
    /// Its value if it does not change at all, with the least deviation that any method can reach
    /// (C. R. Rao, Bull. Calcutta Math. Soc. 37 (1945) 81; H. Cramer, 1946), and the logarithm of
    /// the probability density of the record then.
    pub still: (Known, f64),
}

/// What is known of a course at a moment, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The most probable value.
    pub value: f64,
    /// The ends of the interval of 95 %.
    pub ends: (f64, f64),
}

/// A course jumps, somewhere between two rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InferredJump {
    /// The place of the course in the task.
    pub course: usize,
    /// The interval in s that holds it with a probability of 95 %, from row to row.
    pub between: (f64, f64),
    /// By how much, in SI units; of its logarithm where it is that which walks.
    pub by: Known,
    /// By how much the logarithm of the likelihood falls without it.
    pub gain: f64,
}

/// A value of an instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InferredSensor {
    /// Its place in the task.
    pub sensor: usize,
    /// Whether it is the gain; its offset in K otherwise.
    pub gain: bool,
    /// What was known beforehand.
    pub before: Known,
    /// What is known now.
    pub now: Known,
}

/// What the readings of a column were like beside what was expected of each from all before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InferredColumn {
    /// How many there were.
    pub readings: usize,
    /// Standard deviation of the noise of one reading in K, said or found.
    pub sigma: f64,
    /// That of the part of it that dies away slowly, and after how many s 1/e of it is left; `None`
    /// where all is white.
    pub slow: Option<(f64, f64)>,
    /// By how many standard deviations the first reading surprised.
    pub first: f64,
    /// Mean of what each reading surprised by, over its standard deviation: 0 but for chance, which
    /// is 1 / root of their number.
    pub mean: f64,
    /// Root of the mean of its square: 1 but for chance.
    pub rms: f64,
    /// Correlation of neighbours: 0 but for chance, which is 1 / root of their number.
    pub neighbours: f64,
    /// By how many K the instrument moves over the record if its offset drifts at a steady rate, as
    /// far as the other columns tell; `None` where there is no other.
    pub drift: Option<Known>,
}
