//! Eigenvalues and vectors of square matrices: mirrors take a matrix to Hessenberg's form, double
//! steps of Francis from there to Schur's, `A = Q T Q'` with a block of two for each pair, whose
//! vectors come by substitution (`hqr2` of EISPACK, B. T. Smith et al., 1976; G. H. Golub and C. F.
//! Van Loan, Matrix Computations, 4th ed., 7.4 to 7.6).

use super::columns::{Columns, turn};
use super::mirror::Mirror;
use super::product::product;
use super::{Complex, GeneralEigen};

/// Steps that one eigenvalue may take, and those after which the shift changes.
const MOST_STEPS: usize = 60;
const UNUSUAL: usize = 10;

/// `A = Q T Q'`
pub(super) struct Schur {
    n: usize,
    t: Columns<f64>,
    q: Columns<f64>,
    /// Eigenvalues; of a pair the one with the positive imaginary part first.
    pub(super) values: Vec<Complex>,
    /// Magnitude that counts as zero next to the matrix.
    small: f64,
}

fn real(x: f64) -> Complex {
    Complex::new(x, 0.0)
}

impl Schur {
    /// `None` if the steps do not end.
    pub(super) fn of(a: Columns<f64>) -> Option<Self> {
        let n = a.rows;
        let small = f64::EPSILON * (n as f64).sqrt() * a.largest();
        let mut schur =
            Self { n, t: a, q: Columns::identity(n), values: vec![real(0.0); n], small };
        if !small.is_finite() {
            return None;
        }
        schur.hessenberg();
        schur.diagonalise()?;
        Some(schur)
    }

    fn hessenberg(&mut self) {
        for m in 1..self.n.saturating_sub(1) {
            let Some(mirror) = Mirror::of(&mut self.t.column_mut(m - 1)[m..]) else { continue };
            (m..self.n).for_each(|j| mirror.apply(&mut self.t.column_mut(j)[m..]));
            mirror.apply_to_rows(&mut self.t, m);
            mirror.apply_to_rows(&mut self.q, m);
        }
    }

    fn diagonalise(&mut self) -> Option<()> {
        let (mut end, mut steps) = (self.n, 0);
        while end > 0 {
            let last = end - 1;
            let first = self.block(last);
            match last - first {
                0 => self.values[last] = real(self.t[(last, last)]),
                1 => self.two(first),
                _ => {
                    steps += 1;
                    self.step((first, last), steps);
                    if steps > MOST_STEPS {
                        return None;
                    }
                    continue;
                }
            }
            (end, steps) = (first, 0);
        }
        Some(())
    }

    /// The first row of the block that ends with `last`, which is then separate.
    fn block(&mut self, last: usize) -> usize {
        let t = &self.t;
        let separate = |k: &usize| {
            let sides = t[(k - 1, k - 1)].abs() + t[(*k, *k)].abs();
            let sides = if sides == 0.0 { self.small } else { f64::EPSILON * sides };
            t[(*k, k - 1)].abs() <= sides
        };
        let first = (1..=last).rev().find(separate).unwrap_or(0);
        if first > 0 {
            self.t[(first, first - 1)] = 0.0;
        }
        first
    }

    /// A block of two: a pair, or two that are real, for which it becomes triangular.
    fn two(&mut self, k: usize) {
        let t = &self.t;
        let (a, b, c, d) = (t[(k, k)], t[(k, k + 1)], t[(k + 1, k)], t[(k + 1, k + 1)]);
        let half = 0.5 * (a - d);
        let square = half * half + b * c;
        if square < 0.0 {
            let root = (-square).sqrt();
            self.values[k] = Complex::new(d + half, root);
            self.values[k + 1] = Complex::new(d + half, -root);
            return;
        }
        let far = half + square.sqrt().copysign(half);
        let length = c.hypot(far);
        let by = if length == 0.0 { (1.0, 0.0) } else { (far / length, c / length) };
        self.turn(k, by);
        let near = if far == 0.0 { d } else { d - b * c / far };
        self.t[(k + 1, k)] = 0.0;
        (self.values[k], self.values[k + 1]) = (real(d + far), real(near));
    }

    /// Turns rows and columns `k` and `k + 1`.
    fn turn(&mut self, k: usize, (c, s): (f64, f64)) {
        let n = self.n;
        for j in k..n {
            let pair = &mut self.t.column_mut(j)[k..k + 2];
            (pair[0], pair[1]) = (c * pair[0] + s * pair[1], c * pair[1] - s * pair[0]);
        }
        for (a, rows) in [(&mut self.t, k + 2), (&mut self.q, n)] {
            let (before, rest) = a.split(k + 1);
            turn(&mut before[k * n..k * n + rows], &mut rest[..rows], (c, s));
        }
    }

    /// A double step on a block of three or more.
    fn step(&mut self, (first, last): (usize, usize), steps: usize) {
        let shifts = self.shifts(last, steps);
        let (begin, mut x) = self.beginning((first, last), shifts);
        for k in begin + 2..=last {
            self.t[(k, k - 2)] = 0.0;
            if k > begin + 2 {
                self.t[(k, k - 3)] = 0.0;
            }
        }
        for k in begin..last {
            let size = if k + 1 == last { 2 } else { 3 };
            if k > begin {
                let column = &self.t.column(k - 1)[k..k + size];
                x = [0.0; 3];
                x[..size].copy_from_slice(column);
            }
            let Some(mirror) = Mirror::of(&mut x[..size]) else { continue };
            if k > begin {
                self.t.column_mut(k - 1)[k..k + size].copy_from_slice(&x[..size]);
            } else if k > first {
                self.t[(k, k - 1)] *= mirror.first();
            }
            self.mirror((k, last), &mirror);
        }
    }

    /// Mirrors rows and columns from `k` on.
    fn mirror(&mut self, (k, last): (usize, usize), mirror: &Mirror) {
        let size = mirror.size();
        (k..self.n).for_each(|j| mirror.apply_to_few(&mut self.t.column_mut(j)[k..k + size]));
        mirror.apply_to_few_rows(&mut self.t, (k, last.min(k + 3) + 1));
        mirror.apply_to_few_rows(&mut self.q, (k, self.n));
    }

    /// Sum and product of the two shifts are those of the last block of two, as `(x, y, w)` for
    /// `x + y` and `x y - w`.
    fn shifts(&self, last: usize, steps: usize) -> [f64; 3] {
        let t = &self.t;
        if steps.is_multiple_of(UNUSUAL) {
            let size = t[(last, last - 1)].abs() + t[(last - 1, last - 2)].abs();
            let x = t[(last, last)] + 0.75 * size;
            return [x, x, -0.4375 * size * size];
        }
        let across = t[(last, last - 1)] * t[(last - 1, last)];
        [t[(last, last)], t[(last - 1, last - 1)], across]
    }

    /// The row at which a step may begin, and the first column of the shifted square from there.
    fn beginning(&self, (first, last): (usize, usize), [x, y, w]: [f64; 3]) -> (usize, [f64; 3]) {
        let t = &self.t;
        let mut m = last - 2;
        loop {
            let here = t[(m, m)];
            let (r, s) = (x - here, y - here);
            let p = (r * s - w) / t[(m + 1, m)] + t[(m, m + 1)];
            let q = t[(m + 1, m + 1)] - here - r - s;
            let column = [p, q, t[(m + 2, m + 1)]];
            let size: f64 = column.iter().map(|x| x.abs()).sum();
            let [p, q, r] = column.map(|x| x / size);
            if m == first {
                return (m, [p, q, r]);
            }
            let beside = t[(m, m - 1)].abs() * (q.abs() + r.abs());
            let around = t[(m - 1, m - 1)].abs() + here.abs() + t[(m + 1, m + 1)].abs();
            if beside <= f64::EPSILON * p.abs() * around {
                return (m, [p, q, r]);
            }
            m -= 1;
        }
    }

    /// Values and vectors.
    pub(super) fn vectors(self) -> Option<GeneralEigen> {
        let mut of_t = Columns::zeros(self.n, self.n);
        for k in 0..self.n {
            let pair = usize::from(self.values[k].im != 0.0);
            if self.values[k].im < 0.0 {
                continue;
            }
            for (i, x) in self.vector(k + pair).into_iter().enumerate() {
                of_t[(i, k)] = x.re;
                if pair == 1 {
                    of_t[(i, k + 1)] = x.im;
                }
            }
        }
        let vectors = product(&self.q, &of_t);
        let whole = |i: usize, k: usize| match self.values[k].im {
            0.0 => real(vectors[(i, k)]),
            im if im > 0.0 => Complex::new(vectors[(i, k)], vectors[(i, k + 1)]),
            _ => Complex::new(vectors[(i, k - 1)], -vectors[(i, k)]),
        };
        let length = |k: usize| (0..self.n).map(|i| whole(i, k).norm_sqr()).sum::<f64>().sqrt();
        let lengths: Vec<f64> = (0..self.n).map(length).collect();
        let vectors = faer::Mat::from_fn(self.n, self.n, |i, k| whole(i, k) / lengths[k]);
        let finite = vectors.is_all_finite();
        finite.then_some(GeneralEigen { values: self.values, vectors })
    }

    /// The vector of T for the value in row `last`; of a pair, whose second row this is, the first.
    fn vector(&self, last: usize) -> Vec<Complex> {
        let t = &self.t;
        let mut x = vec![real(0.0); last + 1];
        let mut top = last;
        let mut value = self.values[last];
        x[last] = real(1.0);
        if value.im != 0.0 {
            value = value.conj();
            top -= 1;
            let (b, c) = (t[(top, last)], t[(last, top)]);
            if c.abs() > b.abs() {
                x[top] = (value - t[(last, last)]) / c;
            } else {
                x[top] = real(1.0);
                x[last] = (value - t[(top, top)]) / b;
            }
        }
        (top..=last).for_each(|j| self.take(&mut x, (top, j)));
        while top > 0 {
            top = self.substitute(&mut x, top, value);
        }
        x
    }

    /// `x[i] -= T[i, j] x[j]` for the rows above `top`.
    fn take(&self, x: &mut [Complex], (top, j): (usize, usize)) {
        let by = x[j];
        for (x, t) in x[..top].iter_mut().zip(self.t.column(j)) {
            x.re -= t * by.re;
            x.im -= t * by.im;
        }
    }

    /// Solves the last row above `top`, or the last two of a pair; returns the next row.
    fn substitute(&self, x: &mut [Complex], top: usize, value: Complex) -> usize {
        let (t, i) = (&self.t, top - 1);
        let rest = if self.values[i].im == 0.0 {
            x[i] /= self.away(t[(i, i)] - value, self.small);
            i
        } else {
            let (a, d) = (t[(i - 1, i - 1)] - value, t[(i, i)] - value);
            let (b, c) = (t[(i - 1, i)], t[(i, i - 1)]);
            let determinant = self.away(a * d - b * c, self.small * self.small);
            let (one, two) = (x[i - 1], x[i]);
            x[i - 1] = (d * one - b * two) / determinant;
            x[i] = (a * two - c * one) / determinant;
            i - 1
        };
        let size = (rest..top).map(|k| x[k].re.abs().max(x[k].im.abs())).fold(0.0, f64::max);
        if f64::EPSILON * size * size > 1.0 {
            x.iter_mut().for_each(|x| *x /= size);
        }
        (rest..top).for_each(|j| self.take(x, (rest, j)));
        rest
    }

    /// A divisor that is not zero.
    fn away(&self, z: Complex, small: f64) -> Complex {
        if z.re.abs() + z.im.abs() > small { z } else { real(small.max(f64::MIN_POSITIVE)) }
    }
}
