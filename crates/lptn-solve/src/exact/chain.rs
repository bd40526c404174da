//! `dx/dt = A x + B u` over any time, from matrices for one length and its halves and doubles.
//!
//! With `E = exp(h A)` and `F_n = W_n(h A) B` the state goes on by `x(t + h) = E x(t) + h sum F_n
//! c_n`, c_n the Legendre coefficients of the inputs. Both are scaled and doubled: `E(2h) = E(h)^2`,
//! and since a polynomial on a whole is a sum of polynomials on each half, `P_n((x -+ 1) / 2) = sum_m
//! s_nm P_m(x)`, `F_n(2h) = (E sum_m s-_nm F_m + sum_m s+_nm F_m) / 2`. This is the modified squaring
//! of phi functions (Skaflestad and Wright, Appl. Numer. Math. 59 (2009) 783) in a basis in which
//! nothing cancels. No eigenvector is asked for, so a defective matrix is like any other.
//!
//! **Rows that sum to a leak.** In a thermal network all elements of `exp(h A)` are positive, and a
//! row sums to 1 less the share of the boundaries. So squaring adds positive numbers only, and the
//! diagonal, the one place where 1 hides small terms, is taken from the sum of the rest (the
//! elimination of Grassmann, Taksar and Heyman, Oper. Res. 33 (1985) 1107, for the exponentials of
//! Xue and Ye, Math. Comp. 82 (2013) 1577): slow nodes keep their digits next to fast ones.
//!
//! A chain of equal cells has one eigenvector. The matrices on the way up serve every length.
//! `impedance` uses them if modes coincide.

use faer::Mat;
use lptn_integrate::dense;

use super::legendre::{Rule, TERMS, value};
use super::taylor::{SMALL, add, answer, exponential};

/// The system and the lengths of time that are wanted.
pub(crate) struct Wanted {
    /// A in 1/s.
    pub(crate) rates: Mat<f64>,
    /// B: rate of each state for a unit of each input (column), per s.
    pub(crate) drive: Mat<f64>,
    /// Amount by which each row of A sums to less than 0, if it has no negative elements except its
    /// diagonal.
    pub(crate) leak: Option<Vec<f64>>,
    /// Length in s that is asked for most often, and the longest of all.
    pub(crate) unit: f64,
    pub(crate) longest: f64,
    /// Terms of the longest series of an input.
    pub(crate) terms: usize,
}

/// Matrices that advance a state by a length in s.
#[derive(Clone, Debug, PartialEq)]
struct Level {
    length: f64,
    carried: Mat<f64>,
    /// For each term of a series the effect of the inputs, per s of the length; empty above the
    /// unit.
    forced: Vec<Mat<f64>>,
}

/// Matrices for lengths that are powers of two of each other, the shortest first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    rates: Mat<f64>,
    drive: Mat<f64>,
    levels: Vec<Level>,
    rule: Rule,
}

/// Doublings at most: lengths over more decades than doubles have digits.
const MOST_LEVELS: i32 = 120;

impl Chain {
    /// `None` if the rates span more than doubles can represent.
    pub(crate) fn new(wanted: Wanted) -> Option<Self> {
        let Wanted { rates, drive, leak, unit, longest, terms } = wanted;
        let terms = terms.max(1); // without inputs too: what is forced marks lengths up to the unit
        let norm = norm(&rates);
        if !(norm.is_finite() && unit > 0.0 && unit <= longest && longest.is_finite()) {
            return None;
        }
        let down = (norm * unit / SMALL).log2().ceil().max(0.0);
        let up = (longest / unit).log2().ceil();
        if down + up > f64::from(MOST_LEVELS) {
            return None;
        }
        let mut chain = Self { rates, drive, levels: Vec::new(), rule: Rule::new() };
        let mut length = unit * (-down).exp2();
        let (mut level, mut leaked) = chain.first(length, terms, leak);
        let halves = Halves::new(&chain.rule, terms);
        while length < longest {
            let forced = if length < unit { halves.double(&level) } else { Vec::new() };
            let mut carried = dense::product(level.carried.as_ref(), level.carried.as_ref());
            if let Some(leaked) = &mut leaked {
                let before = dense::product(level.carried.as_ref(), leaked.as_ref());
                add(leaked, 1.0, before.as_ref());
                right_the_diagonal(&mut carried, leaked);
            }
            chain.levels.push(level);
            length *= 2.0;
            level = Level { length, carried, forced };
        }
        chain.levels.push(level);
        Some(chain)
    }

    /// The shortest level, by power series, and the share that its boundaries have taken.
    fn first(
        &self,
        length: f64,
        terms: usize,
        leak: Option<Vec<f64>>,
    ) -> (Level, Option<Mat<f64>>) {
        let size = self.rates.nrows();
        let z = scaled(&self.rates, length);
        let mut carried = exponential(z.as_ref(), Mat::identity(size, size));
        let leaked = leak.map(|leak| {
            let leak = Mat::from_fn(size, 1, |i, _| length * leak[i]);
            answer(z.as_ref(), leak, 0)
        });
        if let Some(leaked) = &leaked {
            right_the_diagonal(&mut carried, leaked);
        }
        let forced = (0..terms).map(|n| answer(z.as_ref(), self.drive.clone(), n)).collect();
        (Level { length, carried, forced }, leaked)
    }

    /// Advances a state by `length` in s, to within `slack` in s, under inputs with these Legendre
    /// series over it. Returns the time in s still to go, which may be negative.
    pub(crate) fn advance(
        &self,
        x: &mut Mat<f64>,
        series: &[Vec<f64>],
        (length, slack): (f64, f64),
    ) -> f64 {
        let mut gone = 0.0;
        for level in self.levels.iter().rev().filter(|level| !level.forced.is_empty()) {
            while length - gone > slack && level.length <= length - gone + slack {
                let part = self.part(series, (gone / length, (gone + level.length) / length));
                *x = dense::product(level.carried.as_ref(), x.as_ref());
                for (n, forced) in level.forced.iter().enumerate() {
                    let inputs = nth(&part, n);
                    let brought = dense::product(forced.as_ref(), inputs.as_ref());
                    add(x, level.length, brought.as_ref());
                }
                gone += level.length;
            }
        }
        if length - gone > slack {
            let part = self.part(series, (gone / length, 1.0));
            self.finish(x, &part, length - gone);
            gone = length;
        }
        length - gone
    }

    /// The same over less than the shortest level, by power series.
    fn finish(&self, x: &mut Mat<f64>, series: &[Vec<f64>], length: f64) {
        let z = scaled(&self.rates, length);
        *x = exponential(z.as_ref(), x.clone());
        for n in 0..series.iter().map(Vec::len).max().unwrap_or(0) {
            let brought = dense::product(self.drive.as_ref(), nth(series, n).as_ref());
            add(x, length, answer(z.as_ref(), brought, n).as_ref());
        }
    }

    /// Adds the effects of the states one, two, … units before: `x = sum_k exp(k unit A) x`, as
    /// `(1 + E)(1 + E^2)(1 + E^4) …`.
    pub(crate) fn add_repeats(&self, x: &mut Mat<f64>, unit: f64) {
        for level in self.levels.iter().filter(|level| level.length >= 0.75 * unit) {
            let before = dense::product(level.carried.as_ref(), x.as_ref());
            add(x, 1.0, before.as_ref());
        }
    }

    /// Effect of these rates of change (columns, per s) if they last for the longest time.
    pub(crate) fn lasting(&self, rates: &Mat<f64>) -> Mat<f64> {
        let first = self.levels.first().map_or(0.0, |level| level.length);
        let mut mean = answer(scaled(&self.rates, first).as_ref(), rates.clone(), 0);
        let (doubled, last) = self.levels.split_at(self.levels.len().saturating_sub(1));
        for level in doubled {
            let later = dense::product(level.carried.as_ref(), mean.as_ref());
            add(&mut mean, 1.0, later.as_ref());
            mean = scaled(&mean, 0.5);
        }
        scaled(&mean, last.first().map_or(0.0, |level| level.length))
    }

    /// Series on a part of their range, `from` to `to` of 0 to 1.
    fn part(&self, series: &[Vec<f64>], (from, to): (f64, f64)) -> Vec<Vec<f64>> {
        if from == 0.0 && (to - 1.0).abs() < 1e-15 {
            return series.to_vec();
        }
        let place = |x: f64| -1.0 + 2.0 * (from + 0.5 * (to - from) * (1.0 + x));
        let of = |series: &Vec<f64>| match series.as_slice() {
            [] | [_] => series.clone(),
            [mean, slope] => vec![mean + slope * place(0.0), slope * (to - from)],
            long => self.rule.series(&self.rule.points.map(|x| value(long, place(x)))).to_vec(),
        };
        series.iter().map(of).collect()
    }
}

/// Polynomials on a whole, made of polynomials on its halves.
struct Halves {
    /// For each `P_n` the coefficients on the first half and on the second.
    first: Vec<[f64; TERMS]>,
    second: Vec<[f64; TERMS]>,
}

impl Halves {
    fn new(rule: &Rule, terms: usize) -> Self {
        let on = |side: f64| {
            let of = |n: usize| {
                let mut unit = vec![0.0; n];
                unit.push(1.0);
                let mut series = rule.series(&rule.points.map(|x| value(&unit, 0.5 * (x + side))));
                series[n + 1..].fill(0.0); // rounding: the degree stays
                series
            };
            (0..terms).map(of).collect()
        };
        Self { first: on(-1.0), second: on(1.0) }
    }

    /// Effect of inputs over twice the length of a level.
    fn double(&self, level: &Level) -> Vec<Mat<f64>> {
        let sum = |weights: &[f64]| {
            let mut sum = Mat::zeros(level.carried.nrows(), level.forced[0].ncols());
            for (weight, forced) in weights.iter().zip(&level.forced) {
                add(&mut sum, 0.5 * weight, forced.as_ref());
            }
            sum
        };
        let of = |(first, second): (&[f64; TERMS], &[f64; TERMS])| {
            let mut both = dense::product(level.carried.as_ref(), sum(first).as_ref());
            add(&mut both, 1.0, sum(second).as_ref());
            both
        };
        self.first.iter().zip(&self.second).map(of).collect()
    }
}

/// The coefficients of `P_n` of all inputs, as a column.
fn nth(series: &[Vec<f64>], n: usize) -> Mat<f64> {
    Mat::from_fn(series.len(), 1, |i, _| series[i].get(n).copied().unwrap_or(0.0))
}

fn scaled(a: &Mat<f64>, by: f64) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| by * a[(i, j)])
}

/// The largest sum of a row's magnitudes.
fn norm(a: &Mat<f64>) -> f64 {
    let row = |i: usize| (0..a.ncols()).map(|j| a[(i, j)].abs()).sum::<f64>();
    (0..a.nrows()).map(row).fold(0.0, f64::max)
}

/// A row and the share of the boundaries sum to 1. If the diagonal is most of that, it is the rest
/// after the others.
fn right_the_diagonal(carried: &mut Mat<f64>, leaked: &Mat<f64>) {
    for i in 0..carried.nrows() {
        let beside = (0..carried.ncols()).filter(|&j| j != i);
        let others = beside.map(|j| carried[(i, j)]).sum::<f64>() + leaked[(i, 0)];
        if others < 0.5 {
            carried[(i, i)] = 1.0 - others;
        }
    }
}
