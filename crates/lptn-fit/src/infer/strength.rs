//! Smoothness of the time histories, noise of the columns, and jumps.

use crate::kalman::Fade;

/// The strengths of walks and noises.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Strength {
    /// For each time history the variance of its walk per s, in the units of its coordinate
    /// squared, and that of the walk of its slope.
    pub(crate) intensities: Vec<f64>,
    /// The noise of each column.
    pub(crate) noises: Vec<Noise>,
    /// Possible jumps of time histories, in ascending order.
    pub(crate) jumps: Vec<Jump>,
}

/// The noise of a column: white, and a slow part (J. L. Doob, Ann. Math. 43 (1942) 351).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Noise {
    /// Standard deviation of the white part in K, above 0.
    pub(crate) white: f64,
    /// Standard deviation of the slow part in K.
    pub(crate) drift: f64,
    /// Time in s after which 1/e of it is left.
    pub(crate) time: f64,
}

impl Noise {
    pub(crate) const fn white(white: f64) -> Self {
        Self { white, drift: 0.0, time: 1.0 }
    }

    /// Noise from the standard deviation of one reading in K, with this share of the variance in
    /// the slow part.
    pub(crate) fn split(whole: f64, share: f64, time: f64) -> Self {
        Self { white: whole * (1.0 - share).sqrt(), drift: whole * share.sqrt(), time }
    }

    /// Standard deviation of one reading in K.
    pub(crate) fn whole(&self) -> f64 {
        self.white.hypot(self.drift)
    }

    /// Transition of the slow part over a time in s.
    pub(crate) fn fade(&self, time: f64) -> Fade {
        let lost = f64::exp_m1(-2.0 * time / self.time);
        Fade { left: f64::exp(-time / self.time), variance: -self.drift * self.drift * lost }
    }
}

/// A jump of a time history between two moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Jump {
    /// Index of the second.
    pub(crate) to: usize,
    pub(crate) course: usize,
}

impl Strength {
    /// The same without walks and jumps.
    pub(crate) fn still(&self) -> Self {
        let intensities = vec![0.0; self.intensities.len()];
        Self { intensities, noises: self.noises.clone(), jumps: Vec::new() }
    }

    /// The same without walk and jumps of one time history.
    pub(crate) fn constant(&self, course: usize) -> Self {
        let mut one = self.clone();
        one.intensities[2 * course..][..2].fill(0.0);
        one.jumps.retain(|jump| jump.course != course);
        one
    }

    /// The same with white noise only.
    pub(crate) fn white(&self, sigma: impl Fn(&Noise) -> f64) -> Self {
        let noises = self.noises.iter().map(|noise| Noise::white(sigma(noise))).collect();
        Self { noises, ..self.clone() }
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
