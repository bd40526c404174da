//! Householder's mirrors, and `A = Q R` by them.

use pulp::{Arch, NullaryFnOnce};

use super::columns::{Columns, add, dot};

/// `I - beta u u'`
pub(super) struct Mirror {
    u: Vec<f64>,
    beta: f64,
}

impl Mirror {
    /// The mirror that takes `x` to its first axis, and takes it there; `None` if it lies on it.
    pub(super) fn of(x: &mut [f64]) -> Option<Self> {
        let scale = x.iter().skip(1).fold(0.0, |most: f64, x| f64::max(most, x.abs()));
        if scale == 0.0 {
            return None;
        }
        let scale = scale.max(x[0].abs());
        let mut u: Vec<f64> = x.iter().map(|x| x / scale).collect();
        let length = dot(&u, &u).sqrt().copysign(u[0]);
        let beta = 1.0 / (length * (length + u[0]));
        u[0] += length;
        x.fill(0.0);
        x[0] = -length * scale;
        Some(Self { u, beta })
    }

    /// Mirrors a column.
    pub(super) fn apply(&self, column: &mut [f64]) {
        add(column, -self.beta * dot(&self.u, column), &self.u);
    }

    /// Mirrors the rows of a matrix, of which `first` is the column that belongs to the first axis.
    pub(super) fn apply_to_rows(&self, a: &mut Columns<f64>, first: usize) {
        let mut along = vec![0.0; a.rows];
        for (k, &u) in self.u.iter().enumerate() {
            add(&mut along, self.beta * u, a.column(first + k));
        }
        for (k, &u) in self.u.iter().enumerate() {
            add(a.column_mut(first + k), -u, &along);
        }
    }

    /// Number of axes.
    pub(super) fn size(&self) -> usize {
        self.u.len()
    }

    /// Component of the mirrored first axis along itself.
    pub(super) fn first(&self) -> f64 {
        1.0 - self.beta * self.u[0] * self.u[0]
    }

    /// Mirrors two or three rows, in which no loop is worth a call.
    pub(super) fn apply_to_few(&self, column: &mut [f64]) {
        let along: f64 = self.u.iter().zip(&*column).map(|(u, x)| u * x).sum();
        column.iter_mut().zip(&self.u).for_each(|(x, u)| *x -= self.beta * along * u);
    }

    /// Mirrors the rows before `end` in two or three columns.
    pub(super) fn apply_to_few_rows(&self, a: &mut Columns<f64>, (k, end): (usize, usize)) {
        let n = a.rows;
        let (_, columns) = a.split(k);
        let (one, rest) = columns.split_at_mut(n);
        let (two, three) = rest.split_at_mut(n);
        let columns = [&mut one[..end], &mut two[..end]];
        let arch = Arch::new();
        match self.u[..] {
            [u, v] => arch.dispatch(Two { columns, u: [u, v], beta: self.beta }),
            [u, v, w] => {
                let third = &mut three[..end];
                arch.dispatch(Three { columns, third, u: [u, v, w], beta: self.beta });
            }
            _ => {}
        }
    }
}

struct Two<'a> {
    columns: [&'a mut [f64]; 2],
    u: [f64; 2],
    beta: f64,
}

impl NullaryFnOnce for Two<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let ([one, two], [u, v]) = (self.columns, self.u);
        for (x, y) in one.iter_mut().zip(two) {
            let along = self.beta * (*x * u + *y * v);
            (*x, *y) = (*x - along * u, *y - along * v);
        }
    }
}

struct Three<'a> {
    columns: [&'a mut [f64]; 2],
    third: &'a mut [f64],
    u: [f64; 3],
    beta: f64,
}

impl NullaryFnOnce for Three<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let ([one, two], [u, v, w]) = (self.columns, self.u);
        for ((x, y), z) in one.iter_mut().zip(two).zip(self.third) {
            let along = self.beta * (*x * u + *y * v + *z * w);
            (*x, *y, *z) = (*x - along * u, *y - along * v, *z - along * w);
        }
    }
}

/// R in the upper triangle of A; `also` is mirrored too.
pub(super) fn triangle(a: &mut Columns<f64>, also: &mut Columns<f64>) {
    for k in 0..a.rows.min(a.count) {
        let Some(mirror) = Mirror::of(&mut a.column_mut(k)[k..]) else { continue };
        (k + 1..a.count).for_each(|j| mirror.apply(&mut a.column_mut(j)[k..]));
        (0..also.count).for_each(|j| mirror.apply(&mut also.column_mut(j)[k..]));
    }
}

/// `R^-1 x` for the triangle R in the first rows of a matrix.
pub(super) fn backwards(r: &Columns<f64>, x: &mut [f64]) {
    for k in (0..x.len()).rev() {
        let (above, rest) = x.split_at_mut(k);
        rest[0] /= r[(k, k)];
        add(above, -rest[0], &r.column(k)[..k]);
    }
}
