//! How smooth the courses are, how large the noise of a column, and where courses jump.

/// The strengths of walks and noises.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Strength {
    /// For each course the variance of its walk per s, in the units of its coordinate squared, and
    /// that of the walk of its slope.
    pub(crate) intensities: Vec<f64>,
    /// Standard deviation of the noise of each column in K.
    pub(crate) sigmas: Vec<f64>,
    /// Where courses may jump, in ascending order.
    pub(crate) jumps: Vec<Jump>,
}

/// A course jumps somewhere between two moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Jump {
    /// The place of the second.
    pub(crate) to: usize,
    pub(crate) course: usize,
}

impl Strength {
    /// The same with walks that stand still.
    pub(crate) fn still(&self) -> Self {
        let intensities = vec![0.0; self.intensities.len()];
        Self { intensities, sigmas: self.sigmas.clone(), jumps: Vec::new() }
    }

    /// The same with one jump more.
    pub(crate) fn with(&self, jump: Jump) -> Self {
        let mut more = self.clone();
        let place = more.jumps.partition_point(|other| *other < jump);
        more.jumps.insert(place, jump);
        more
    }

    /// The same without a jump.
    pub(crate) fn without(&self, jump: Jump) -> Self {
        let mut less = self.clone();
        less.jumps.retain(|other| *other != jump);
        less
    }
}
