//! Runs of networks of hundreds of nodes: the fewest vectors that represent the decay, by the
//! Lanczos method for `(1 + gamma A)^-1` with `A = C^-1 K` (J. van den Eshof and M. Hochbruck,
//! Preconditioning Lanczos approximations to the matrix exponential, SIAM J. Sci. Comput. 27 (2006)
//! 1438).
//!
//! With `B V = V T + beta v e^T` for the operator `B` and `H = (T^-1 - 1)/gamma` the approximation
//! `y = V g`, `g(s) = exp(-s H) g(0)` leaves `-y' - A y = (1 + gamma A) v phi(s)`, with `phi =
//! beta/gamma e^T T^-1 g`. The error is the response of the network to that, and by parts
//!
//! `|error| <= |v| (integral |phi| ds + gamma (|phi(0)| + |phi(s)| + integral |phi'| ds))`
//!
//! in the largest temperature: without heat that never grows.
//!
//! A later stretch reuses the space if it contains the remaining decay, for example if all sources
//! follow one curve.

use lptn_integrate::dense::Symmetric;

use super::modes::Modes;
use super::star::{Plan, Star};

/// The step of the operator over the longest stretch between bends of the inputs: for about this
/// value the start and the end of a stretch take as many vectors.
const STEP: f64 = 0.03;

/// Vectors at first, how many more at a time, and at most.
const FIRST: usize = 20;
const MORE: usize = 6;
const MOST: usize = 62;

/// A norm below this share of the first is rounding: the space is whole.
const WHOLE: f64 = 1e-14;

/// The first step at which the error is evaluated, over the time constant of the fastest part.
const EARLY: f64 = 0.1;

/// The residual of the equation is evaluated after 1, 2, 4, … steps: this factor allows for the
/// values in between.
const SAMPLED: f64 = 2.0;

/// A space of one candidate.
#[derive(Clone, Debug)]
pub(crate) struct Krylov {
    /// `K + C / gamma`
    shifted: Star,
    /// `C / gamma` of each node in W/K.
    weight: Vec<f64>,
    gamma: f64,
    /// Vectors with `sum of C v^2 = 1`, node by node, one after the other; the last is the
    /// remainder.
    vectors: Vec<f64>,
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    ritz: Symmetric,
    /// The Ritz vectors, slowest first.
    order: Vec<usize>,
    /// Last component of each over its value, times `beta/gamma |v|`.
    residual: Vec<f64>,
    decay: Vec<f64>,
}

impl Krylov {
    pub(crate) fn new(plan: &Plan) -> Self {
        Self {
            shifted: Star::new(plan),
            weight: Vec::new(),
            gamma: f64::NAN,
            vectors: Vec::new(),
            diagonal: Vec::new(),
            beside: Vec::new(),
            ritz: Symmetric::default(),
            order: Vec::new(),
            residual: Vec::new(),
            decay: Vec::new(),
        }
    }

    /// Begins with a candidate whose inputs bend after `longest` s at most.
    pub(crate) fn begin(
        &mut self,
        plan: &Plan,
        (conductance, capacity): (&[f64], &[f64]),
        longest: f64,
    ) -> Option<()> {
        self.gamma = STEP * longest;
        self.weight.clear();
        self.weight.extend(capacity.iter().map(|c| c / self.gamma));
        self.shifted.begin(plan, conductance);
        for (&place, weight) in plan.place.iter().zip(&self.weight) {
            self.shifted.ground[place] += weight;
        }
        self.shifted.eliminate(plan, 0..plan.order.len())
    }

    /// A space in which rises `w` in K decay over `length` s to within `allowed` K, as `modes`.
    pub(crate) fn span(
        &mut self,
        plan: &Plan,
        w: &[f64],
        (length, allowed): (f64, f64),
        modes: &mut Modes,
    ) -> Option<()> {
        let norm = self.norm(w);
        self.vectors.clear();
        self.diagonal.clear();
        self.beside.clear();
        self.vectors.extend(w.iter().map(|w| w / norm));
        let mut whole = !(norm > 0.0 && norm.is_finite());
        let (mut count, mut left) = (FIRST, Vec::new());
        while !whole && count <= MOST {
            while self.diagonal.len() < count && !whole {
                whole = self.extend(plan);
            }
            self.decompose(modes, whole)?;
            left.clear();
            left.extend(self.order.iter().map(|&k| norm * self.ritz.vector(k)[0]));
            if self.error(&modes.rates, &left, length) <= allowed {
                self.shapes(modes, w.len());
                return Some(());
            }
            count += MORE;
        }
        None
    }

    /// Root of the sum of `C v^2`, but for gamma.
    fn norm(&self, v: &[f64]) -> f64 {
        (dot(&self.weight, v, v) * self.gamma).sqrt()
    }

    /// Adds a vector; returns true if there are no more.
    fn extend(&mut self, plan: &Plan) -> bool {
        let n = self.weight.len();
        let last = self.vectors.len() - n;
        let mut next: Vec<f64> =
            self.weight.iter().zip(&self.vectors[last..]).map(|(c, v)| c * v).collect();
        self.shifted.solve(plan, &mut next);
        self.diagonal.push(dot(&self.weight, &self.vectors[last..], &next) * self.gamma);
        // the remainder is small, so that one pass would leave as much of the others in it
        for _ in 0..2 {
            for v in self.vectors.chunks_exact(n).rev() {
                let part = dot(&self.weight, v, &next) * self.gamma;
                next.iter_mut().zip(v).for_each(|(next, v)| *next -= part * v);
            }
        }
        let beta = self.norm(&next);
        let whole = beta <= WHOLE * self.diagonal[0].abs();
        let scale = if whole { 0.0 } else { 1.0 / beta };
        self.beside.push(beta);
        self.vectors.extend(next.iter().map(|next| scale * next));
        whole
    }

    /// Rates of the space, and their residuals.
    fn decompose(&mut self, modes: &mut Modes, whole: bool) -> Option<()> {
        let (n, count) = (self.weight.len(), self.diagonal.len());
        self.ritz.tridiagonal(&self.diagonal, &self.beside)?;
        let values = &self.ritz.values;
        self.order.clear();
        self.order.extend(0..count);
        self.order.sort_unstable_by(|a, b| values[*b].total_cmp(&values[*a]));
        let over = self.vectors[count * n..].iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let over = if whole { 0.0 } else { over * self.beside[count - 1] / self.gamma };
        modes.rates.clear();
        self.residual.clear();
        for &k in &self.order {
            modes.rates.push((1.0 / values[k] - 1.0) / self.gamma);
            self.residual.push(over * self.ritz.vector(k)[count - 1] / values[k]);
        }
        modes.rates.iter().all(|rate| rate.is_finite() && *rate > 0.0).then_some(())
    }

    /// Largest error of temperatures within `length` s in K, if the modes begin with `left`.
    pub(crate) fn error(&mut self, rates: &[f64], left: &[f64], length: f64) -> f64 {
        let mut parts: Vec<f64> = self.residual.iter().zip(left).map(|(r, y)| r * y).collect();
        let mut step = (EARLY / rates.last().copied().unwrap_or(1.0)).min(length);
        self.decay.clear();
        self.decay.extend(rates.iter().map(|rate| (-rate * step).exp()));
        let first: f64 = parts.iter().sum();
        let (mut phi, mut at, mut area, mut path) = (first, 0.0, 0.0, first.abs());
        while at < length {
            if at > 0.0 {
                // as far again as all steps before it
                step = at;
                parts.iter_mut().zip(&self.decay).for_each(|(part, decay)| *part *= decay);
                self.decay.iter_mut().for_each(|decay| *decay *= *decay);
            } else {
                parts.iter_mut().zip(&self.decay).for_each(|(part, decay)| *part *= decay);
            }
            at += step;
            let next: f64 = parts.iter().sum();
            area += 0.5 * step * (next.abs() + phi.abs());
            path += (next - phi).abs();
            phi = next;
        }
        SAMPLED * (area + self.gamma * (path + phi.abs()))
    }

    fn shapes(&self, modes: &mut Modes, n: usize) {
        modes.shapes.clear();
        modes.shapes.resize(n * self.order.len(), 0.0);
        for (&k, shape) in self.order.iter().zip(modes.shapes.chunks_exact_mut(n)) {
            for (share, v) in self.ritz.vector(k).iter().zip(self.vectors.chunks_exact(n)) {
                shape.iter_mut().zip(v).for_each(|(x, v)| *x += share * v);
            }
        }
    }
}

/// Sum of `c x y`, in eight partial sums.
fn dot(c: &[f64], x: &[f64], y: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut lanes = [0.0; LANES];
    let (cs, c_tail) = c.as_chunks::<LANES>();
    let (xs, x_tail) = x.as_chunks::<LANES>();
    let (ys, y_tail) = y.as_chunks::<LANES>();
    for ((c, x), y) in cs.iter().zip(xs).zip(ys) {
        for k in 0..LANES {
            lanes[k] += c[k] * x[k] * y[k];
        }
    }
    let tail = c_tail.iter().zip(x_tail).zip(y_tail);
    lanes.iter().sum::<f64>() + tail.map(|((c, x), y)| c * x * y).sum::<f64>()
}
