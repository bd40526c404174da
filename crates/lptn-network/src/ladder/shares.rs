//! Share of each rate of a ladder in the weight: squared first entries of eigenvectors.

use super::quotients::Quotients;

/// Largest correction of a rate relative to it; a larger one would lead to another.
const NEAR: f64 = 1e-12;

/// The rate of a pole in 1/s, corrected in its last digits, and the part of the whole weight that
/// it has, from 0 to 1. The rate has to be known to 1e-12.
pub(super) fn pole(ladder: &Quotients, rate: f64) -> (f64, f64) {
    let first = Pair::at(ladder, rate);
    if first.correction.abs() <= NEAR * rate {
        let rate = rate + first.correction;
        return (rate, Pair::at(ladder, rate).share);
    }
    (rate, first.share)
}

/// The part of an eigenvector that is needed.
struct Pair {
    /// Its squared first entry, its length 1.
    share: f64,
    /// Its Rayleigh quotient less the rate.
    correction: f64,
}

impl Pair {
    /// `T - rate` is factorised from the port on, pivots `q_i + s_i`, and from the end on, pivots
    /// `e_i + p_(i+1)`. The two meet in the row with the smallest remainder, `s_i + p_i + rate`,
    /// which is where the eigenvector is largest.
    fn at(ladder: &Quotients, rate: f64) -> Self {
        let (s, above) = from_port(ladder, rate);
        let (p, below) = from_end(ladder, rate);
        let left: Vec<f64> = s.iter().zip(&p).map(|(s, p)| s + p + rate).collect();
        let known = (0..left.len()).filter(|i| !left[*i].is_nan());
        let meet = known.min_by(|i, j| left[*i].abs().total_cmp(&left[*j].abs())).unwrap_or(0);
        // squares of the entries, that where the two meet being 1
        let (first, before) = entries(above[..meet].iter().rev());
        let (_, behind) = entries(below[meet..].iter());
        let sum = 1.0 + before + behind;
        Self { share: first / sum, correction: left[meet] / sum }
    }
}

/// The last of the entries whose ratios these are, and the sum of all but that which is 1.
fn entries<'a>(ratios: impl Iterator<Item = &'a f64>) -> (f64, f64) {
    ratios.fold((1.0, 0.0), |(entry, sum), ratio| (entry * ratio, sum + entry * ratio))
}

/// Pivots of the stationary transform less `q`, and the square of each entry over the next one's.
fn from_port(ladder: &Quotients, rate: f64) -> (Vec<f64>, Vec<f64>) {
    let mut s = -rate;
    let row = |(q, e): (&f64, &f64)| {
        let here = s;
        let pivot = not_zero(q + s, *q);
        let ratio = e / pivot;
        s = s * ratio - rate;
        (here, q / pivot * ratio)
    };
    ladder.q.iter().zip(&ladder.e).map(row).unzip()
}

/// The `p_i` of the progressive transform from the end, and the square of each entry over the one
/// before.
fn from_end(ladder: &Quotients, rate: f64) -> (Vec<f64>, Vec<f64>) {
    let last = ladder.q.len() - 1;
    let mut p = vec![ladder.q[last] - rate; last + 1];
    let mut squares = vec![0.0; last];
    for i in (0..last).rev() {
        let (q, e) = (ladder.q[i], ladder.e[i]);
        let pivot = not_zero(e + p[i + 1], e);
        let ratio = q / pivot;
        p[i] = p[i + 1] * ratio - rate;
        squares[i] = e / pivot * ratio;
    }
    (p, squares)
}

/// A pivot, or instead of zero a number too small to change the sum that it came from.
fn not_zero(pivot: f64, part: f64) -> f64 {
    if pivot == 0.0 { part * f64::EPSILON * f64::EPSILON } else { pivot }
}
