//! Eigenvalues and vectors of small symmetric matrices: Householder's reduction to a tridiagonal
//! matrix and the QL method with implicit shifts, as `tred2` and `tql2` of EISPACK (B. T. Smith et
//! al., Matrix Eigensystem Routines, 1976; in the form of JAMA, which NIST put in the public
//! domain).

use pulp::{Arch, NullaryFnOnce};

use crate::kernels::dot_in;

/// Partial sums of products of short rows.
const LANES: usize = 4;

/// Largest number of QL steps for an eigenvalue.
const MOST_ITERATIONS: usize = 60;

/// Number of turns that are taken together, and of elements of the vectors that take them at once.
const MOST_TURNS: usize = 8192;
const AT_ONCE: usize = 64;

/// Room for one matrix after the other.
#[derive(Clone, Debug, Default)]
pub struct Symmetric {
    n: usize,
    /// The matrix, then the orthonormal vectors one after the other.
    pub vectors: Vec<f64>,
    /// The eigenvalue of each, in no order.
    pub values: Vec<f64>,
    /// Elements next to the diagonal.
    beside: Vec<f64>,
    /// Turns that the vectors still have to take: the first of two, cosine and sine.
    turns: Vec<(usize, f64, f64)>,
}

struct Whole<'a>(&'a mut Symmetric);

impl NullaryFnOnce for Whole<'_> {
    type Output = Option<()>;

    #[inline(always)]
    fn call(self) -> Option<()> {
        self.0.reduce();
        self.0.accumulate();
        self.0.beside.rotate_left(1);
        self.0.diagonalise()
    }
}

struct Rest<'a>(&'a mut Symmetric);

impl NullaryFnOnce for Rest<'_> {
    type Output = Option<()>;

    #[inline(always)]
    fn call(self) -> Option<()> {
        self.0.diagonalise()
    }
}

impl Symmetric {
    /// Begins with a matrix of zeros.
    pub fn begin(&mut self, n: usize) {
        self.n = n;
        self.vectors.clear();
        self.vectors.resize(n * n, 0.0);
        self.values.resize(n, 0.0);
        self.beside.resize(n, 0.0);
        self.turns.clear();
    }

    /// Adds to an element and to the one across the diagonal.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        self.vectors[i * self.n + j] += value;
        if i != j {
            self.vectors[j * self.n + i] += value;
        }
    }

    /// Finds values and vectors; `None` if there is no convergence.
    #[must_use]
    pub fn solve(&mut self) -> Option<()> {
        // wider vectors if the processor has them: the same sums in the same order
        Arch::new().dispatch(Whole(self))
    }

    /// Finds those of a tridiagonal matrix, `None` if there is no convergence. `beside[k]` is the
    /// element between rows `k` and `k + 1`; the last one is not used.
    pub fn tridiagonal(&mut self, diagonal: &[f64], beside: &[f64]) -> Option<()> {
        self.begin(diagonal.len());
        self.values.copy_from_slice(diagonal);
        self.beside.copy_from_slice(beside);
        for vector in self.vectors.chunks_exact_mut(self.n + 1) {
            vector[0] = 1.0;
        }
        if let Some(last) = self.vectors.last_mut() {
            *last = 1.0;
        }
        Arch::new().dispatch(Rest(self))
    }

    /// The vector of value `k`, a number per row.
    #[must_use]
    pub fn vector(&self, k: usize) -> &[f64] {
        &self.vectors[k * self.n..(k + 1) * self.n]
    }

    #[inline(always)]
    fn diagonalise(&mut self) -> Option<()> {
        self.beside[self.n - 1] = 0.0;
        let (mut shift, mut size) = (0.0, 0.0_f64);
        for l in 0..self.n {
            size = size.max(self.values[l].abs() + self.beside[l].abs());
            self.isolate(l, size, &mut shift)?;
            self.values[l] += shift;
            self.beside[l] = 0.0;
        }
        self.turn();
        Some(())
    }

    /// Turns the vectors, some elements of all of them after the others, which stay in the cache.
    #[inline(always)]
    fn turn(&mut self) {
        let n = self.n;
        for from in (0..n).step_by(AT_ONCE) {
            let to = n.min(from + AT_ONCE);
            for &(i, c, s) in &self.turns {
                let (low, high) = self.vectors[i * n..(i + 2) * n].split_at_mut(n);
                for (a, b) in low[from..to].iter_mut().zip(&mut high[from..to]) {
                    let h = *b;
                    *b = s * *a + c * h;
                    *a = c * *a - s * h;
                }
            }
        }
        self.turns.clear();
    }

    /// Reduces the matrix to a tridiagonal one, from the last row on: each row is taken to two
    /// elements by a mirror, whose vector stays in the row with half its square in `values`.
    #[inline(always)]
    fn reduce(&mut self) {
        let n = self.n;
        let Self { vectors: v, values: d, beside: e, .. } = self;
        for i in (1..n).rev() {
            let (rows, row) = v.split_at_mut(i * n);
            let row = &mut row[..i];
            let scale: f64 = row.iter().map(|x| x.abs()).sum();
            if scale == 0.0 || i == 1 {
                e[i] = row[i - 1];
                d[i] = 0.0;
                continue;
            }
            row.iter_mut().for_each(|x| *x /= scale);
            let square: f64 = row.iter().map(|x| x * x).sum();
            let f = row[i - 1];
            let g = if f > 0.0 { -square.sqrt() } else { square.sqrt() };
            e[i] = scale * g;
            d[i] = square - f * g;
            row[i - 1] = f - g;
            reflect(rows, (n, d[i]), row, &mut e[..i]);
        }
    }

    /// The product of all mirrors, a row for each vector.
    #[inline(always)]
    fn accumulate(&mut self) {
        let n = self.n;
        let Self { vectors: v, values: d, .. } = self;
        for i in 0..n {
            let (before, rest) = v.split_at_mut(i * n);
            let h = std::mem::replace(&mut d[i], rest[i]);
            let mirror = &mut rest[..i];
            if h != 0.0 {
                for row in before.chunks_exact_mut(n) {
                    let row = &mut row[..i];
                    let share = dot_in::<LANES>(row, mirror) / h;
                    row.iter_mut().zip(&*mirror).for_each(|(x, u)| *x -= share * u);
                }
            }
            mirror.fill(0.0);
            rest[i] = 1.0;
            before.chunks_exact_mut(n).for_each(|row| row[i] = 0.0);
        }
    }

    /// Rotates until the `l`-th value is isolated.
    #[inline(always)]
    fn isolate(&mut self, l: usize, size: f64, shift: &mut f64) -> Option<()> {
        let small = f64::EPSILON * size;
        let m = (l..self.n).find(|&m| self.beside[m].abs() <= small)?;
        let mut iterations = 0;
        while m > l && (iterations == 0 || self.beside[l].abs() > small) {
            iterations += 1;
            if iterations > MOST_ITERATIONS {
                return None;
            }
            self.rotate(l, m, shift);
            if self.turns.len() >= MOST_TURNS {
                self.turn();
            }
        }
        Some(())
    }

    /// One implicit QL step on the block from `l` to `m`.
    #[inline(always)]
    fn rotate(&mut self, l: usize, m: usize, shift: &mut f64) {
        let Self { values: d, beside: e, turns, .. } = self;
        let g = d[l];
        let p = (d[l + 1] - g) / (2.0 * e[l]);
        let root = (p * p + 1.0).sqrt();
        let r = if p < 0.0 { -root } else { root };
        d[l] = e[l] / (p + r);
        d[l + 1] = e[l] * (p + r);
        let (next, moved) = (d[l + 1], g - d[l]);
        d[l + 2..].iter_mut().for_each(|d| *d -= moved);
        *shift += moved;
        let (mut p, first) = (d[m], e[l + 1]);
        let (mut c, mut c2, mut c3, mut s, mut s2) = (1.0, 1.0, 1.0, 0.0, 0.0);
        for i in (l..m).rev() {
            (c3, c2, s2) = (c2, c, s);
            let (g, h) = (c * e[i], c * p);
            let r = (p * p + e[i] * e[i]).sqrt();
            e[i + 1] = s * r;
            (s, c) = (e[i] / r, p / r);
            p = c * d[i] - s * g;
            d[i + 1] = h + s * (c * g + s * d[i]);
            turns.push((i, c, s));
        }
        p = -s * s2 * c3 * first * e[l] / next;
        e[l] = s * p;
        d[l] = c * p;
    }
}

/// Mirrors the first rows on both sides: `A - u q' - q u'` with `q = p - (u p / 2 h) u` and
/// `p = A u / h`, in all elements, so that every loop runs along a row.
#[inline(always)]
fn reflect(rows: &mut [f64], (n, h): (usize, f64), mirror: &[f64], q: &mut [f64]) {
    let i = mirror.len();
    q.fill(0.0);
    for (row, u) in rows.chunks_exact(n).zip(mirror) {
        q.iter_mut().zip(&row[..i]).for_each(|(p, x)| *p += x * u);
    }
    let half = 0.5 * dot_in::<LANES>(q, mirror) / (h * h);
    q.iter_mut().zip(mirror).for_each(|(p, u)| *p = *p / h - half * u);
    for ((row, u), p) in rows.chunks_exact_mut(n).zip(mirror).zip(&*q) {
        row[..i].iter_mut().zip(&*q).zip(mirror).for_each(|((x, q), v)| *x -= u * q + p * v);
    }
}

#[cfg(test)]
mod tests {
    use super::Symmetric;

    /// The second difference of n points has the values 2 - 2 cos(k pi / (n + 1)). Also with a far
    /// larger last element, and for a matrix that is diagonal already (n = 1).
    #[test]
    fn values_that_are_known_and_vectors_that_have_them() {
        let mut room = Symmetric::default();
        for n in [1, 2, 3, 8, 20, 48] {
            for large in [0.0, 1e6] {
                let matrix = |i: usize, j: usize| match i.abs_diff(j) {
                    0 if i + 1 == n => 2.0 + large,
                    0 => 2.0,
                    1 => -1.0,
                    _ => 0.0,
                };
                room.begin(n);
                (0..n).for_each(|i| (0..=i).for_each(|j| room.add(i, j, matrix(i, j))));
                room.solve().unwrap();
                let size = 4.0 + large;
                for k in 0..n {
                    let vector = &room.vectors[k * n..(k + 1) * n];
                    let length: f64 = vector.iter().map(|x| x * x).sum();
                    assert!((length - 1.0).abs() < 1e-13);
                    for i in 0..n {
                        let product: f64 = (0..n).map(|j| matrix(i, j) * vector[j]).sum();
                        assert!(
                            (product - room.values[k] * vector[i]).abs() < 1e-14 * size * n as f64
                        );
                    }
                }
                if large == 0.0 {
                    room.values.sort_by(f64::total_cmp);
                    for (k, value) in room.values.iter().enumerate() {
                        let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
                        assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-14);
                    }
                }
            }
        }
    }
}
