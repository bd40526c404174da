//! The restricted likelihood of correlated and white noise.
//!
//! The parameters of the noise are uncertain too, so intervals are Student's with the degrees of
//! freedom of Satterthwaite. If drift takes a fifth of the record, the likelihood does not
//! determine its time. Intervals then contain 95 % of the mixture of all times (`possible`).

use faer::Mat;
use lptn_integrate::dense;
use lptn_integrate::vectors::{dot, norm, take_off};

use crate::simplex;

/// Samples are filtered four series at once.
const LANES: usize = 4;

/// Number of times of noise that may be possible, and of their pairs with logits.
const TIMES: i32 = 24;
const PLACES: f64 = 24.0 * 13.0;

/// A product of variances below this, or above its inverse, becomes a logarithm: the next variance
/// cannot take it out of the range of numbers.
const TINY: f64 = 1e-100;

/// Shape of noise, without its deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Correlated part of the variance.
    pub(crate) correlated: f64,
    /// Correlation time in s.
    pub(crate) time: f64,
}

impl Shape {
    pub(crate) const WHITE: Self = Self { correlated: 0.0, time: 0.0 };

    /// From `ln theta` and the logit of c over its greatest value: at that the spectrum of samples
    /// `spacing` apart is 0 at its upper end.
    pub(crate) fn at([time, logit]: [f64; 2], spacing: f64) -> Self {
        let decay = (-spacing / time.exp()).exp();
        let most = (1.0 + decay) / (2.0 * decay).max(1e-12);
        Self { correlated: most / (1.0 + (-logit).exp()), time: time.exp() }
    }
}

/// A likelihood, times -2 and less constants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Value {
    /// Likelihood of the part that the fitted parameters could not remove.
    pub(crate) restricted: f64,
    /// Likelihood of all samples, with the parameters at their most likely values.
    pub(crate) whole: f64,
    /// Standard deviation of the noise at the maximum of the restricted one.
    pub(crate) deviation: f64,
}

/// Residuals and the span of their derivatives, ready to be filtered.
pub(crate) struct Likelihood {
    times: Vec<f64>,
    /// An orthonormal basis of the derivatives, then the residuals, four at a time.
    series: Vec<Vec<[f64; LANES]>>,
    rank: usize,
    scale: f64,
    spacing: f64,
}

impl Likelihood {
    pub(crate) fn new(times: &[f64], residuals: &[f64], jacobian: &[f64]) -> Self {
        let n = times.len();
        let mut columns = orthonormal(jacobian, n);
        let rank = columns.len();
        let scale = (residuals.iter().map(|r| r * r).sum::<f64>() / n as f64).sqrt();
        let unit = if scale > 0.0 { scale } else { 1.0 };
        columns.push(residuals.iter().map(|r| r / unit).collect());
        let pack = |group: &[Vec<f64>]| {
            let lane = |i: usize, l: usize| group.get(l).map_or(0.0, |column| column[i]);
            (0..n).map(|i| std::array::from_fn(|l| lane(i, l))).collect()
        };
        let series = columns.chunks(LANES).map(pack).collect();
        let mut spaces: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        spaces.sort_by(f64::total_cmp);
        let spacing = spaces.get(spaces.len() / 2).copied().unwrap_or(1.0);
        Self { times: times.to_vec(), series, rank, scale, spacing }
    }

    pub(crate) fn spacing(&self) -> f64 {
        self.spacing
    }

    pub(crate) fn times(&self) -> &[f64] {
        &self.times
    }

    pub(crate) fn count(&self) -> f64 {
        self.times.len() as f64
    }

    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    /// True if three more numbers can be estimated.
    pub(crate) fn has_freedom(&self) -> bool {
        self.times.len() > self.rank + 4
    }

    /// The likelihood of a shape; infinite if it is impossible.
    pub(crate) fn at(&self, shape: Shape) -> Value {
        let (whitened, determinant) = self.filtered(shape);
        let width = self.rank + 1;
        let column = |j: usize| &whitened[j * self.times.len()..][..self.times.len()];
        let product = |i: usize, j: usize| -> f64 { dot(column(i), column(j)) };
        let mut gram = Mat::zeros(width, width);
        for i in 0..width {
            for j in 0..=i {
                gram[(i, j)] = product(i, j);
            }
        }
        let nowhere =
            Value { restricted: f64::INFINITY, whole: f64::INFINITY, deviation: f64::NAN };
        let Some(diagonal) = dense::cholesky_diagonal(gram.as_ref()) else { return nowhere };
        let squares = diagonal[self.rank] * diagonal[self.rank];
        let free = self.count() - self.rank as f64;
        let basis: f64 = diagonal[..self.rank].iter().map(|d| 2.0 * d.ln()).sum();
        Value {
            restricted: free * squares.ln() + determinant + basis,
            whole: self.count() * (squares * self.scale * self.scale).ln() + determinant,
            deviation: self.scale * (squares / free).sqrt(),
        }
    }

    /// The series less the filter's predictions, over the deviation of that; and the logarithm of
    /// the determinant.
    fn filtered(&self, shape: Shape) -> (Vec<f64>, f64) {
        let gains = Gains::new(&self.times, shape);
        let n = self.times.len();
        let mut whitened = vec![0.0; self.series.len() * LANES * n];
        for (group, out) in self.series.iter().zip(whitened.chunks_mut(LANES * n)) {
            let mut state = [0.0; LANES];
            for (i, (values, &[decay, gain, weight])) in group.iter().zip(&gains.steps).enumerate()
            {
                for l in 0..LANES {
                    let predicted = decay * state[l];
                    let residual = values[l] - predicted;
                    state[l] = predicted + gain * residual;
                    out[l * n + i] = residual * weight;
                }
            }
        }
        (whitened, gains.determinant)
    }

    /// Maximum of the restricted likelihood: `ln theta` and the logit, and its value.
    pub(crate) fn maximise(&self) -> ([f64; 2], Value) {
        let length = self.times[self.times.len() - 1] - self.times[0];
        let (least, most) = ((0.3 * self.spacing).ln(), length.max(self.spacing).ln());
        let at = |p: [f64; 2]| {
            self.at(Shape::at([p[0].clamp(least, most), p[1].clamp(-7.0, 7.0)], self.spacing))
                .restricted
        };
        let mut start = ([0.0, 0.0], f64::INFINITY);
        for multiple in [1.0_f64, 4.0, 16.0, 64.0, 256.0] {
            for logit in [-1.0, 0.5] {
                let place = [(multiple * self.spacing).ln(), logit];
                let value = at(place);
                start = if value < start.1 { (place, value) } else { start };
            }
        }
        let found = simplex::minimum(|p| at([p[0], p[1]]), &start.0, 0.6);
        let place = [found[0].clamp(least, most), found[1].clamp(-7.0, 7.0)];
        (place, self.at(Shape::at(place, self.spacing)))
    }

    /// The covariance of `ln theta` and the logit at the greatest likelihood: twice the inverse of
    /// the second derivatives of [`Likelihood::at`]. A direction without curvature is taken as
    /// known: there the noise does not depend on it. `None` if the time is known only to a factor:
    /// then the likelihood is not a parabola.
    pub(crate) fn spread(&self, [time, logit]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        /// Standard deviation of the logarithm of the time.
        const WELL: f64 = 0.4;
        const STEP: f64 = 0.1;
        let at = |a: f64, b: f64| {
            self.at(Shape::at([time + a * STEP, logit + b * STEP], self.spacing)).restricted
        };
        let middle = at(0.0, 0.0);
        let bend = |plus: f64, minus: f64| (plus - 2.0 * middle + minus) / (STEP * STEP);
        let (a, d) = (bend(at(1.0, 0.0), at(-1.0, 0.0)), bend(at(0.0, 1.0), at(0.0, -1.0)));
        let b =
            (at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)) / (4.0 * STEP * STEP);
        let determinant = a * d - b * b;
        let weak = |variance: f64| variance > WELL * WELL;
        if a > 1e-3 && d > 1e-3 && determinant > 1e-3 * a * d {
            let known = [
                [2.0 * d / determinant, -2.0 * b / determinant],
                [-2.0 * b / determinant, 2.0 * a / determinant],
            ];
            return (!weak(known[0][0])).then_some(known);
        }
        let alone = |bend: f64| if bend > 1e-3 { 2.0 / bend } else { 0.0 };
        (a > 1e-3 && !weak(alone(a))).then(|| [[alone(a), 0.0], [0.0, alone(d)]])
    }
}

/// A shape that the samples leave possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Possible {
    /// Its probability; those of all sum up to 1.
    pub(crate) weight: f64,
    pub(crate) shape: Shape,
    /// Standard deviation of the noise if it is the one.
    pub(crate) deviation: f64,
}

impl Likelihood {
    /// The shapes that the samples leave possible. Before any measurement, all factors of the time,
    /// up to a time as long as the record, and all steps of the logit are equally likely.
    pub(crate) fn possible(&self) -> Vec<Possible> {
        let (least, most) = ((0.3 * self.spacing).ln(), self.length().ln());
        let time = |k: i32| least + (most - least) * f64::from(k) / f64::from(TIMES - 1);
        let places = (0..TIMES).flat_map(|k| (-6..=6).map(move |l| [time(k), f64::from(l)]));
        self.mixture(places).0
    }

    /// The same, and white noise, which is a priori `prior` times as likely as all of them
    /// together.
    pub(super) fn white_or_possible(&self, prior: f64) -> Vec<Possible> {
        let white = self.at(Shape::WHITE);
        let mut all = self.possible();
        let Some(first) = all.first() else { return all };
        // their mean likelihood over that of white noise; weights sum up to 1 over the whole grid
        let own = self.at(first.shape).restricted;
        let mean = (-0.5 * (own - white.restricted)).exp() / (first.weight * PLACES);
        let share = prior / (prior + mean);
        all.iter_mut().for_each(|one| one.weight *= 1.0 - share);
        all.push(Possible { weight: share, shape: Shape::WHITE, deviation: white.deviation });
        all
    }

    /// From the first time to the last, or the distance of two samples.
    pub(super) fn length(&self) -> f64 {
        (self.times[self.times.len() - 1] - self.times[0]).max(self.spacing)
    }

    /// The shapes of these places (`ln theta` and the logit), all equally likely a priori, and the
    /// least restricted `Value` among them.
    pub(super) fn mixture(&self, places: impl Iterator<Item = [f64; 2]>) -> (Vec<Possible>, f64) {
        let shape = |place: [f64; 2]| Shape::at(place, self.spacing);
        let all: Vec<(Shape, Value)> =
            places.map(shape).map(|shape| (shape, self.at(shape))).collect();
        let best = all.iter().map(|(_, value)| value.restricted).fold(f64::INFINITY, f64::min);
        let weight = |value: &Value| (0.5 * (best - value.restricted)).exp();
        let sum: f64 = all.iter().map(|(_, value)| weight(value)).filter(|w| w.is_finite()).sum();
        let possible = all.iter().map(|(shape, value)| Possible {
            weight: weight(value) / sum,
            shape: *shape,
            deviation: value.deviation,
        });
        (possible.filter(|one| one.weight > 1e-4).collect(), best)
    }
}

/// The filter's numbers for every sample: remaining part of the state, gain, and weight of the
/// residual.
pub(super) struct Gains {
    pub(super) steps: Vec<[f64; 3]>,
    determinant: f64,
}

impl Gains {
    pub(super) fn new(times: &[f64], shape: Shape) -> Self {
        let (c, white) = (shape.correlated, 1.0 - shape.correlated);
        let mut steps = Vec::with_capacity(times.len());
        let (mut determinant, mut product, mut total) = (0.0, 1.0_f64, 1.0);
        let (mut variance, mut before, mut decay) = (c, f64::NAN, 0.0);
        let mut settled = false;
        for (i, &time) in times.iter().enumerate() {
            let apart = if i == 0 { f64::INFINITY } else { time - times[i - 1] };
            let same = (apart - before).abs() <= 1e-6 * apart;
            if !(same && settled) {
                if !same {
                    decay = if shape.time > 0.0 { (-apart / shape.time).exp() } else { 0.0 };
                }
                let predicted = decay * decay * variance + c * (1.0 - decay * decay);
                total = predicted + white;
                let gain = predicted / total;
                let next = predicted * (1.0 - gain);
                settled = same && (next - variance).abs() <= 1e-13 * next;
                variance = next;
                steps.push([decay, gain, total.sqrt().recip()]);
            } else {
                steps.push(steps[i - 1]);
            }
            before = apart;
            // one logarithm for many samples
            product *= total;
            if !(TINY..1.0 / TINY).contains(&product) {
                determinant += product.ln();
                product = 1.0;
            }
        }
        Self { steps, determinant: determinant + product.ln() }
    }
}

/// An orthonormal basis of the columns (Gram and Schmidt, each twice), without columns that are
/// combinations of others.
pub(crate) fn orthonormal(columns: &[f64], rows: usize) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns.chunks(rows.max(1)) {
        let length = norm(column);
        let mut left = column.to_vec();
        for _ in 0..2 {
            take_off(&mut left, &basis);
        }
        let rest = norm(&left);
        if rest > 1e-9 * length && rest.is_normal() {
            basis.push(left.into_iter().map(|x| x / rest).collect());
        }
    }
    basis
}
