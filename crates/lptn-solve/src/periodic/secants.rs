//! The map from the start of a cycle to its end, by differences of the cycles up to now.
//!
//! With `f = g - y`, y the start of a cycle and g its end, the next start is `g - dG c`, in which c
//! makes `f - dF c` smallest and dG, dF are the differences between cycles: Anderson's mixing (D.
//! G. Anderson, J. ACM 12 (1965) 547) in its multisecant form (H. Fang and Y. Saad, Numer. Linear
//! Algebra Appl. 16 (2009) 197). For a linear map it is GMRES on `y - Phi(y) = 0` (H. F. Walker and
//! P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715), and it needs no extra differences.
//! Norms are weighted by capacity: a conductive network forgets in that norm.

use std::collections::VecDeque;

use faer::Mat;
use lptn_integrate::dense;

/// Differences that are kept.
const MOST: usize = 30;

/// A difference counts if its new part is this many times its possible error.
const CLEAR: f64 = 3.0;

/// The map of a network that is not linear bends: over a difference of this size in K its slope is
/// another one.
const BEND: f64 = 300.0;

/// Differences between two cycles, in K.
struct Pair {
    start: Vec<f64>,
    end: Vec<f64>,
    /// The tolerance of the coarser one of the two.
    noise: f64,
}

/// A cycle from `start` to `end`, integrated to `noise` in K.
#[derive(Clone)]
pub(super) struct Shot {
    pub(super) start: Vec<f64>,
    pub(super) end: Vec<f64>,
    pub(super) noise: f64,
}

impl Shot {
    pub(super) fn residual(&self) -> f64 {
        self.start.iter().zip(&self.end).map(|(y, g)| (g - y).abs()).fold(0.0, f64::max)
    }
}

/// The differences between the last cycles.
pub(super) struct Secants {
    /// Positive, sum 1.
    weights: Vec<f64>,
    bend: f64,
    /// The latest first.
    pairs: VecDeque<Pair>,
    last: Option<Shot>,
}

/// One of several orthonormal vectors, with its partner.
struct Direction {
    vector: Vec<f64>,
    /// The same combination of the given partners.
    partner: Vec<f64>,
    /// Its possible error, as a part of its length.
    doubt: f64,
}

impl Secants {
    /// For a network with these capacities of its states in J/K; `bends` if it is not linear.
    pub(super) fn new(capacity: &[f64], bends: bool) -> Self {
        let total: f64 = capacity.iter().sum();
        let weights = capacity.iter().map(|c| c / total).collect();
        let bend = if bends { BEND } else { f64::INFINITY };
        Self { weights, bend, pairs: VecDeque::new(), last: None }
    }

    /// Restarts without any differences.
    pub(super) fn forget(&mut self) {
        self.pairs.clear();
        self.last = None;
    }

    /// Takes in a cycle.
    pub(super) fn push(&mut self, shot: Shot) {
        if let Some(last) = &self.last {
            let (start, end) = (minus(&shot.start, &last.start), minus(&shot.end, &last.end));
            self.pairs.push_front(Pair { start, end, noise: shot.noise.max(last.noise) });
            self.pairs.truncate(MOST);
        }
        self.last = Some(shot);
    }

    /// The best start of the next cycle, after this one: no further away from its end than `most`
    /// in K. `None` if no difference helps.
    pub(super) fn next(&self, shot: &Shot, most: f64) -> Option<Vec<f64>> {
        let directions = self.directions(|pair| (minus(&pair.end, &pair.start), pair.end.clone()));
        let residual = minus(&shot.end, &shot.start);
        let shares: Vec<f64> =
            directions.iter().map(|d| self.product(&d.vector, &residual)).collect();
        // the last ones are those of the cycles longest ago
        for count in (1..=directions.len()).rev() {
            let mut step = vec![0.0; residual.len()];
            for (direction, share) in directions[..count].iter().zip(&shares) {
                step.iter_mut().zip(&direction.partner).for_each(|(y, g)| *y -= share * g);
            }
            if step.iter().all(|y| y.abs() <= most) {
                return Some(shot.end.iter().zip(&step).map(|(g, step)| g + step).collect());
            }
        }
        None
    }

    /// The residual of a cycle in the norm that is minimised, in K.
    pub(super) fn size(&self, shot: &Shot) -> f64 {
        self.length(&minus(&shot.end, &shot.start))
    }

    /// The largest factor by which a cycle multiplies a disturbance, of those that the differences
    /// show: Ritz values of the map (W. E. Arnoldi, Quart. Appl. Math. 9 (1951) 17). `None` if
    /// there is no difference that shows one.
    pub(super) fn multiplier(&self) -> Option<f64> {
        let directions = self.directions(|pair| (pair.start.clone(), pair.end.clone()));
        let n = directions.len();
        let entry =
            |i: usize, j: usize| self.product(&directions[i].vector, &directions[j].partner);
        if n == 0 {
            return None;
        }
        let sizes = dense::eigenvalue_magnitudes(Mat::from_fn(n, n, entry).as_ref())?;
        let largest = sizes.into_iter().fold(0.0, f64::max);
        largest.is_finite().then_some(largest)
    }

    /// Orthonormal combinations of the first value of `of` for each difference, the latest first,
    /// without those that may consist of the errors of the differences.
    fn directions(&self, of: impl Fn(&Pair) -> (Vec<f64>, Vec<f64>)) -> Vec<Direction> {
        let mut known: Vec<Direction> = Vec::new();
        for pair in &self.pairs {
            let (mut vector, mut partner) = of(pair);
            let mut wrong =
                pair.noise + self.length(&vector) * self.length(&pair.start) / self.bend;
            // twice is enough
            for _ in 0..2 {
                for direction in &known {
                    let share = self.product(&direction.vector, &vector);
                    wrong += share.abs() * direction.doubt;
                    vector.iter_mut().zip(&direction.vector).for_each(|(v, k)| *v -= share * k);
                    partner.iter_mut().zip(&direction.partner).for_each(|(v, k)| *v -= share * k);
                }
            }
            let rest = self.length(&vector);
            if rest > CLEAR * wrong {
                vector.iter_mut().chain(&mut partner).for_each(|v| *v /= rest);
                known.push(Direction { vector, partner, doubt: wrong / rest });
            }
        }
        known
    }

    fn length(&self, a: &[f64]) -> f64 {
        self.product(a, a).sqrt()
    }

    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.weights).map(|((a, b), w)| a * b * w).sum()
    }
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
