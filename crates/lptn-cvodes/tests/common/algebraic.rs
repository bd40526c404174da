//! Nonlinear systems with algebraic unknowns, with states carried as another variable, and with a
//! bad Jacobian.
#![allow(dead_code, reason = "every test file uses a part of it")]

use lptn_integrate::{OdeSystem, Pattern, Retry};

/// Surfaces that radiate: every state of mass 1 feeds its own massless surface through the
/// conductance 1, and a surface at `z` gives `s (z^4 - a^4)` to the surroundings at `a`. The
/// surfaces also conduct to the next one.
///
/// Quadrature: the heat given to the surroundings.
pub(crate) struct Surfaces {
    pub(crate) unknowns: Vec<f64>,
    mass: Vec<f64>,
    pattern: Pattern,
    radiation: f64,
    surroundings: f64,
    between: f64,
    symmetric: bool,
}

impl Surfaces {
    pub(crate) fn new(
        n: usize,
        (radiation, surroundings, between): (f64, f64, f64),
        symmetric: bool,
    ) -> Self {
        let skin = (0..n).map(|i| (i, n + i));
        let pattern = Pattern::new(2 * n, skin.chain((1..n).map(|i| (n + i - 1, n + i))));
        let mass = (0..2 * n).map(|i| if i < n { 1.0 } else { 0.0 }).collect();
        Self {
            unknowns: vec![surroundings; n],
            mass,
            pattern,
            radiation,
            surroundings,
            between,
            symmetric,
        }
    }

    fn emitted(&self, z: f64) -> f64 {
        self.radiation * (z.powi(4) - self.surroundings.powi(4))
    }

    fn emitted_slope(&self, z: f64) -> f64 {
        4.0 * self.radiation * z.powi(3)
    }

    /// Newton's method on the tridiagonal balances of the surfaces, to rounding.
    fn solve(&mut self, y: &[f64]) {
        for _ in 0..60 {
            let change = self.newton_change(y);
            let size = change.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            self.unknowns.iter_mut().zip(&change).for_each(|(z, d)| *z += d);
            if size < 1e-12 * self.surroundings.max(1.0) {
                return;
            }
        }
    }

    fn newton_change(&self, y: &[f64]) -> Vec<f64> {
        let (n, z, g) = (y.len(), &self.unknowns, self.between);
        let neighbours =
            |i: usize| [i.checked_sub(1), (i + 1 < n).then_some(i + 1)].into_iter().flatten();
        let mut diagonal: Vec<f64> = (0..n)
            .map(|i| 1.0 + self.emitted_slope(z[i]) + g * neighbours(i).count() as f64)
            .collect();
        let balance = |i: usize| {
            neighbours(i).fold(y[i] - z[i] - self.emitted(z[i]), |b, j| b + g * (z[j] - z[i]))
        };
        let mut change: Vec<f64> = (0..n).map(balance).collect();
        for i in 1..n {
            let factor = g / diagonal[i - 1];
            diagonal[i] -= factor * g;
            change[i] += factor * change[i - 1];
        }
        for i in (0..n).rev() {
            let above = if i + 1 < n { g * change[i + 1] } else { 0.0 };
            change[i] = (change[i] + above) / diagonal[i];
        }
        change
    }
}

impl OdeSystem for Surfaces {
    fn size(&self) -> usize {
        self.unknowns.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        self.solve(y);
        f.iter_mut().zip(y).zip(&self.unknowns).for_each(|((f, y), z)| *f = z - y);
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        self.symmetric
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        self.solve(y);
        values.fill(0.0);
        let n = y.len();
        let mut link = |i: usize, j: usize, g: f64| {
            for (row, column, value) in [(i, i, -g), (j, j, -g), (i, j, g), (j, i, g)] {
                values[self.pattern.slot(row, column).unwrap()] += value;
            }
        };
        (0..n).for_each(|i| link(i, n + i, 1.0));
        (1..n).for_each(|i| link(n + i - 1, n + i, self.between));
        for (i, &z) in self.unknowns.iter().enumerate() {
            values[self.pattern.diagonal_slot(n + i)] -= self.emitted_slope(z);
        }
        Ok(())
    }
    fn quadrature_count(&self) -> usize {
        1
    }
    fn quadrature(&mut self, _t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        self.solve(y);
        q[0] = self.unknowns.iter().map(|&z| self.emitted(z)).sum();
        Ok(())
    }
}

/// Enthalpies `y` of bodies in a row, each linked by `g` to the next and the first to an end at
/// `hot`; mass 1. The temperature is `y` up to 0, 0 while the body melts (`y` up to `latent`),
/// `y - latent` beyond.
///
/// Quadrature: the heat from the hot end.
pub(crate) struct Melting {
    pub(crate) latent: f64,
    pub(crate) hot: f64,
    pub(crate) conductance: f64,
    mass: Vec<f64>,
    slopes: Vec<f64>,
    pattern: Pattern,
    symmetric: bool,
}

impl Melting {
    pub(crate) fn new(
        n: usize,
        (latent, hot, conductance): (f64, f64, f64),
        symmetric: bool,
    ) -> Self {
        let pattern = Pattern::new(n, (1..n).map(|i| (i - 1, i)));
        Self {
            latent,
            hot,
            conductance,
            mass: vec![1.0; n],
            slopes: vec![1.0; n],
            pattern,
            symmetric,
        }
    }

    pub(crate) fn temperature(&self, y: f64) -> f64 {
        if y < 0.0 { y } else { (y - self.latent).max(0.0) }
    }
}

impl OdeSystem for Melting {
    fn size(&self) -> usize {
        self.mass.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f.fill(0.0);
        f[0] = self.conductance * (self.hot - self.temperature(y[0]));
        for i in 1..y.len() {
            let heat = self.conductance * (self.temperature(y[i - 1]) - self.temperature(y[i]));
            f[i - 1] -= heat;
            f[i] += heat;
        }
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        self.symmetric
    }
    fn slope(&self) -> Option<&[f64]> {
        Some(&self.slopes)
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(0.0);
        values[self.pattern.diagonal_slot(0)] -= self.conductance;
        for i in 1..y.len() {
            for (row, column, sign) in
                [(i - 1, i - 1, -1.0), (i, i, -1.0), (i, i - 1, 1.0), (i - 1, i, 1.0)]
            {
                values[self.pattern.slot(row, column).unwrap()] += sign * self.conductance;
            }
        }
        let melts = |y: f64| (0.0..self.latent).contains(&y);
        self.slopes = y.iter().map(|&y| f64::from(u8::from(!melts(y)))).collect();
        Ok(())
    }
    fn quadrature_count(&self) -> usize {
        1
    }
    fn quadrature(&mut self, _t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q[0] = self.conductance * (self.hot - self.temperature(y[0]));
        Ok(())
    }
}

/// A stream through a row of cells: `y_i' = k (y_{i-1} - y_i)`, entered at `inlet(t)`. As long as
/// it is held to be symmetric, its Jacobian is that of conductances `hold k`, which is wrong.
///
/// Quadratures: what enters and what leaves.
pub(crate) struct Stream {
    pub(crate) rate: f64,
    pub(crate) hold: f64,
    pub(crate) inlet: fn(f64) -> f64,
    pub(crate) left_at: usize,
    /// Values of the last cell that end a step.
    pub(crate) levels: Vec<f64>,
    mass: Vec<f64>,
    pattern: Pattern,
}

impl Stream {
    pub(crate) fn new(n: usize, rate: f64, hold: f64, inlet: fn(f64) -> f64) -> Self {
        let pattern = Pattern::new(n, (1..n).map(|i| (i - 1, i)));
        Self { rate, hold, inlet, left_at: 0, levels: Vec::new(), mass: vec![1.0; n], pattern }
    }
}

impl OdeSystem for Stream {
    fn size(&self) -> usize {
        self.mass.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        let mut before = (self.inlet)(t);
        for (f, &y) in f.iter_mut().zip(y) {
            *f = self.rate * (before - y);
            before = y;
        }
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn leave_symmetry(&mut self) {
        self.left_at += 1;
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(0.0);
        let exact = self.left_at > 0;
        for i in 0..y.len() {
            values[self.pattern.diagonal_slot(i)] =
                if exact { -self.rate } else { -self.hold * self.rate };
            if exact && i > 0 {
                values[self.pattern.slot(i, i - 1).unwrap()] = self.rate;
            }
        }
        Ok(())
    }
    fn quadrature_count(&self) -> usize {
        2
    }
    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q.copy_from_slice(&[self.rate * (self.inlet)(t), self.rate * y[y.len() - 1]]);
        Ok(())
    }
    fn root_count(&self) -> usize {
        self.levels.len()
    }
    fn roots(&mut self, _t: f64, y: &[f64], g: &mut [f64]) -> Result<(), Retry> {
        g.iter_mut().zip(&self.levels).for_each(|(g, level)| *g = y[y.len() - 1] - level);
        Ok(())
    }
}
