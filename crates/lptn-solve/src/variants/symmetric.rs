//! Eigenvalues and vectors of small symmetric matrices: Householder's reduction to a tridiagonal
//! matrix and the QL method with implicit shifts, as `tred2` and `tql2` of EISPACK (B. T. Smith et
//! al., Matrix Eigensystem Routines, 1976; in the form of JAMA, which NIST put in the public
//! domain). A library would choose its kernels by the processor, and with them the last digits.

/// Rotations that an eigenvalue may take.
const MOST_ITERATIONS: usize = 60;

/// Room for one matrix after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Symmetric {
    n: usize,
    /// The matrix, then the vectors one after the other.
    pub(crate) vectors: Vec<f64>,
    /// The eigenvalue of each.
    pub(crate) values: Vec<f64>,
    /// What stands beside the diagonal.
    beside: Vec<f64>,
}

impl Symmetric {
    /// Begins with a matrix of zeros.
    pub(crate) fn begin(&mut self, n: usize) {
        self.n = n;
        self.vectors.clear();
        self.vectors.resize(n * n, 0.0);
        self.values.resize(n, 0.0);
        self.beside.resize(n, 0.0);
    }

    /// Adds to an element and to the one across the diagonal.
    pub(crate) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.vectors[i * self.n + j] += value;
        if i != j {
            self.vectors[j * self.n + i] += value;
        }
    }

    /// Finds values and vectors; `None` where that does not come to an end.
    pub(crate) fn solve(&mut self) -> Option<()> {
        self.reduce();
        self.accumulate();
        self.beside.rotate_left(1);
        self.beside[self.n - 1] = 0.0;
        let (mut shift, mut size) = (0.0, 0.0_f64);
        for l in 0..self.n {
            size = size.max(self.values[l].abs() + self.beside[l].abs());
            self.isolate(l, size, &mut shift)?;
            self.values[l] += shift;
            self.beside[l] = 0.0;
        }
        Some(())
    }

    /// To a tridiagonal matrix, from the last row on.
    fn reduce(&mut self) {
        let n = self.n;
        let Self { vectors: v, values: d, beside: e, .. } = self;
        for (j, d) in d.iter_mut().enumerate() {
            *d = v[j * n + n - 1];
        }
        for i in (1..n).rev() {
            let scale: f64 = d[..i].iter().map(|x| x.abs()).sum();
            let mut h = 0.0;
            if scale == 0.0 {
                e[i] = d[i - 1];
                for j in 0..i {
                    d[j] = v[j * n + i - 1];
                    v[j * n + i] = 0.0;
                    v[i * n + j] = 0.0;
                }
            } else {
                for x in &mut d[..i] {
                    *x /= scale;
                    h += *x * *x;
                }
                let f = d[i - 1];
                let g = if f > 0.0 { -h.sqrt() } else { h.sqrt() };
                e[i] = scale * g;
                h -= f * g;
                d[i - 1] = f - g;
                reflect((n, i, h), v, (d, e));
            }
            d[i] = h;
        }
    }

    /// The product of all reflections.
    fn accumulate(&mut self) {
        let n = self.n;
        let Self { vectors: v, values: d, .. } = self;
        for i in 0..n - 1 {
            v[i * n + n - 1] = v[i * n + i];
            v[i * n + i] = 1.0;
            let h = d[i + 1];
            let (before, rest) = v.split_at_mut((i + 1) * n);
            let mirror = &mut rest[..=i];
            if h != 0.0 {
                d[..=i].iter_mut().zip(&*mirror).for_each(|(d, x)| *d = x / h);
                for row in before.chunks_exact_mut(n) {
                    let row = &mut row[..=i];
                    let g: f64 = row.iter().zip(&*mirror).map(|(a, b)| a * b).sum();
                    row.iter_mut().zip(&d[..=i]).for_each(|(x, d)| *x -= g * d);
                }
            }
            mirror.fill(0.0);
        }
        for j in 0..n {
            d[j] = v[j * n + n - 1];
            v[j * n + n - 1] = 0.0;
        }
        v[n * n - 1] = 1.0;
    }

    /// Rotates until the `l`-th value stands alone.
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
        }
        Some(())
    }

    /// One implicit QL step on the block from `l` to `m`.
    fn rotate(&mut self, l: usize, m: usize, shift: &mut f64) {
        let n = self.n;
        let Self { vectors: v, values: d, beside: e, .. } = self;
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
            let (low, high) = v[i * n..(i + 2) * n].split_at_mut(n);
            for (a, b) in low.iter_mut().zip(high) {
                let h = *b;
                *b = s * *a + c * h;
                *a = c * *a - s * h;
            }
        }
        p = -s * s2 * c3 * first * e[l] / next;
        e[l] = s * p;
        d[l] = c * p;
    }
}

/// A similarity transformation by the Householder vector that stands in `d`.
fn reflect((n, i, h): (usize, usize, f64), v: &mut [f64], (d, e): (&mut [f64], &mut [f64])) {
    let (d, e) = (&mut d[..i], &mut e[..i]);
    let (rows, mirror) = v.split_at_mut(i * n);
    mirror[..i].copy_from_slice(d);
    e.fill(0.0);
    for (j, row) in rows.chunks_exact(n).enumerate() {
        let (f, column) = (d[j], &row[j..i]);
        let mut g = column[0] * f;
        for ((x, d), e) in column[1..].iter().zip(&d[j + 1..]).zip(&mut e[j + 1..]) {
            g += x * d;
            *e += x * f;
        }
        e[j] += g;
    }
    let mut f = 0.0;
    for (e, d) in e.iter_mut().zip(&*d) {
        *e /= h;
        f += *e * d;
    }
    let half = f / (h + h);
    e.iter_mut().zip(&*d).for_each(|(e, d)| *e -= half * d);
    for (j, row) in rows.chunks_exact_mut(n).enumerate() {
        let (f, g) = (d[j], e[j]);
        let column = &mut row[j..i];
        for ((x, e), d) in column.iter_mut().zip(&e[j..]).zip(&d[j..]) {
            *x -= f * e + g * d;
        }
        d[j] = row[i - 1];
        row[i] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::Symmetric;

    /// The second difference of n points has the values 2 - 2 cos(k pi / (n + 1)); with a far
    /// larger element beside them, and for matrices that are diagonal already.
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
