//! The states in a step of a run at every time.

use std::sync::Arc;

use lptn_integrate::SeriesStep;

/// The highest degree of the interpolant of a multistep method.
const HIGHEST: usize = 5;

/// The states in a step, or in a part of one.
#[derive(Clone, Debug)]
pub(super) enum Curve {
    /// A polynomial: point by point the variables of all states, and the number of points.
    Points(Vec<f64>, usize),
    /// A step of the one-step method, shared by its parts.
    Series(Arc<Series>),
}

/// A step of the one-step method.
#[derive(Debug)]
pub(crate) struct Series {
    begun: f64,
    length: f64,
    /// The variables of all states at its start, and then its terms.
    rows: Vec<f64>,
    states: usize,
}

/// Places on (0, 1): Chebyshev points of the second kind.
fn place(k: usize, points: usize) -> f64 {
    0.5 - 0.5 * (std::f64::consts::PI * k as f64 / (points - 1) as f64).cos()
}

/// The times in s at which a polynomial of a degree needs its values.
pub(super) fn times((from, to): (f64, f64), degree: usize) -> impl Iterator<Item = f64> {
    let points = degree.clamp(1, HIGHEST) + 1;
    let inside = (0..points - 1).map(move |k| from + place(k, points) * (to - from));
    inside.chain([to])
}

impl Curve {
    pub(super) fn series(&self) -> Option<&Arc<Series>> {
        match self {
            Self::Series(series) => Some(series),
            Self::Points(..) => None,
        }
    }

    /// True if both are parts of one step.
    pub(super) fn goes_on_in(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Series(series), Self::Series(other)) => Arc::ptr_eq(series, other),
            _ => false,
        }
    }

    pub(super) fn states(&self) -> usize {
        match self {
            Self::Points(values, points) => values.len() / points,
            Self::Series(series) => series.states,
        }
    }

    /// Memory that no other curve counts.
    pub(super) fn bytes(&self) -> usize {
        let values = match self {
            Self::Points(values, _) => values.len(),
            Self::Series(series) if Arc::strong_count(series) == 1 => series.rows.len(),
            Self::Series(_) => 0,
        };
        values * size_of::<f64>()
    }

    /// Writes the variables of all states at a time in s, or at the nearer end.
    pub(super) fn at(&self, span: (f64, f64), time: f64, out: &mut [f64]) {
        match self {
            Self::Points(values, points) => polynomial((span, values, *points), time, out),
            Self::Series(series) => series.at(time.clamp(span.0, span.1), out),
        }
    }
}

impl Series {
    pub(crate) fn of(step: &SeriesStep<'_>) -> Self {
        let terms = step.terms[..step.used].iter().flatten();
        Self {
            begun: step.span.0,
            length: step.length,
            rows: step.ends[0].iter().chain(terms).copied().collect(),
            states: step.ends[0].len(),
        }
    }

    /// True for a part of the same step.
    pub(super) fn is_of(&self, step: &SeriesStep<'_>) -> bool {
        (self.begun - step.span.0).abs() <= 0.0
            && self.rows.len() == (step.used + 1) * self.states
            && step.ends[0] == &self.rows[..self.states]
    }

    /// Writes the variables of all states at a time in s.
    pub(crate) fn at(&self, time: f64, out: &mut [f64]) {
        let (start, terms) = self.rows.split_at(self.states);
        out.copy_from_slice(start);
        let share = ((time - self.begun) / self.length).min(1.0);
        let used = terms.len() / self.states.max(1);
        for (row, weight) in terms.chunks(self.states.max(1)).zip(SeriesStep::weigh(used, share)) {
            out.iter_mut().zip(row).for_each(|(out, term)| *out += weight * term);
        }
    }
}

/// The polynomial by the barycentric formula (J.-P. Berrut and L. N. Trefethen, SIAM Rev. 46 (2004)
/// 501, equation 5.4).
fn polynomial(
    ((from, to), values, points): ((f64, f64), &[f64], usize),
    time: f64,
    out: &mut [f64],
) {
    let at = ((time - from) / (to - from)).clamp(0.0, 1.0);
    let states = out.len();
    let mut weights = [0.0; HIGHEST + 1];
    for (k, weight) in weights[..points].iter_mut().enumerate() {
        let distance = at - place(k, points);
        if distance.abs() < f64::EPSILON {
            out.copy_from_slice(&values[k * states..(k + 1) * states]);
            return;
        }
        let end = if k == 0 || k == points - 1 { 0.5 } else { 1.0 };
        *weight = if k % 2 == 0 { end } else { -end } / distance;
    }
    let sum: f64 = weights.iter().sum();
    out.fill(0.0);
    for (row, weight) in values.chunks(states.max(1)).zip(weights) {
        out.iter_mut().zip(row).for_each(|(out, value)| *out += weight / sum * value);
    }
}
