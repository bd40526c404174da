//! Systems whose derivatives by parameters are known.
#![allow(dead_code, reason = "every test file uses a part of it")]

use lptn_integrate::{OdeSystem, Pattern, Retry};

/// What goes wrong in `sensitivity_flow`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    Panic,
    NotFinite,
    Retry,
    Stop,
}

/// `C T' = P - T / R` from `T0`, with the derivatives by `[R, C, P, T0]` and the integrals of `P`
/// and `T / R`. Roots: `T - level`.
pub(crate) struct Body {
    pub(crate) r: f64,
    pub(crate) c: [f64; 1],
    pub(crate) p: f64,
    pub(crate) levels: Vec<f64>,
    /// From this time on.
    pub(crate) fault: Option<(f64, Fault)>,
    pattern: Pattern,
}

impl Body {
    pub(crate) fn new(r: f64, c: f64, p: f64) -> Self {
        Self {
            r,
            c: [c],
            p,
            levels: Vec::new(),
            fault: None,
            pattern: Pattern::new(1, std::iter::empty()),
        }
    }

    /// The temperature at `t` and its derivatives by `[R, C, P, T0]`.
    pub(crate) fn exact(&self, t0: f64, t: f64) -> (f64, [f64; 4]) {
        let (r, c, p) = (self.r, self.c[0], self.p);
        let decay = (-t / (r * c)).exp();
        let by_rate = (t0 - p * r) * decay * t / (r * c);
        let derivatives = [p * (1.0 - decay) + by_rate / r, by_rate / c, r * (1.0 - decay), decay];
        (p * r + (t0 - p * r) * decay, derivatives)
    }
}

impl OdeSystem for Body {
    fn size(&self) -> usize {
        1
    }
    fn mass(&self) -> &[f64] {
        &self.c
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = self.p - y[0] / self.r;
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values[0] = -1.0 / self.r;
        Ok(())
    }
    fn jacobian_is_constant(&self) -> bool {
        true
    }
    fn quadrature_count(&self) -> usize {
        2
    }
    fn quadrature(&mut self, _t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q.copy_from_slice(&[self.p, y[0] / self.r]);
        Ok(())
    }
    fn sensitivity_count(&self) -> usize {
        4
    }
    fn sensitivity_flow(
        &mut self,
        t: f64,
        y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        let (r, c) = (self.r, self.c[0]);
        let direct = [y[0] / (r * r), -(self.p - y[0] / r) / c, 1.0, 0.0];
        (0..4).for_each(|i| g[i] = direct[i] - s[i] / r);
        match self.fault.filter(|fault| t >= fault.0) {
            Some((_, Fault::Panic)) => panic!("deliberate"),
            Some((_, Fault::NotFinite)) => g[2] = f64::NAN,
            Some((_, Fault::Retry)) => return Err(Retry::SmallerStep),
            Some((_, Fault::Stop)) => return Err(Retry::Stop),
            None => {}
        }
        Ok(())
    }
    fn root_count(&self) -> usize {
        self.levels.len()
    }
    fn roots(&mut self, _t: f64, y: &[f64], g: &mut [f64]) -> Result<(), Retry> {
        g.iter_mut().zip(&self.levels).for_each(|(g, level)| *g = y[0] - level);
        Ok(())
    }
}

/// A row of nodes, each linked to the next, with a source into the first: see [`Row::new`].
pub(crate) struct Row {
    /// Nodes of the row; nothing happens to those behind them.
    active: usize,
    mass: Vec<f64>,
    pattern: Pattern,
    g: f64,
    out: f64,
    power: f64,
    symmetric: bool,
    pub(crate) books: bool,
}

impl Row {
    /// `n` nodes of capacity `c`, conductances `g` between neighbours, `out` from the last to 0,
    /// `power` into the first. Parameters: `[g, out, power, c]`.
    pub(crate) fn new(n: usize, (g, out, power, c): (f64, f64, f64, f64), symmetric: bool) -> Self {
        let pattern = Pattern::new(n, (1..n).map(|i| (i - 1, i)));
        Self { active: n, mass: vec![c; n], pattern, g, out, power, symmetric, books: false }
    }

    pub(crate) fn with_idle(mut self, count: usize) -> Self {
        self.mass.resize(self.active + count, 1.0);
        self.pattern = Pattern::new(self.mass.len(), (1..self.active).map(|i| (i - 1, i)));
        self
    }

    fn conduct(&self, g: f64, out: f64, y: &[f64], f: &mut [f64]) {
        f.fill(0.0);
        for i in 1..self.active {
            let heat = g * (y[i - 1] - y[i]);
            f[i - 1] -= heat;
            f[i] += heat;
        }
        f[self.active - 1] -= out * y[self.active - 1];
    }
}

impl OdeSystem for Row {
    fn size(&self) -> usize {
        self.mass.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        self.conduct(self.g, self.out, y, f);
        f[0] += self.power;
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        self.symmetric
    }
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(0.0);
        let n = self.active;
        for i in 1..n {
            for (row, column, sign) in
                [(i - 1, i - 1, -1.0), (i, i, -1.0), (i, i - 1, 1.0), (i - 1, i, 1.0)]
            {
                values[self.pattern.slot(row, column).unwrap()] += sign * self.g;
            }
        }
        values[self.pattern.diagonal_slot(n - 1)] -= self.out;
        Ok(())
    }
    fn jacobian_is_constant(&self) -> bool {
        true
    }
    fn quadrature_count(&self) -> usize {
        usize::from(self.books)
    }
    fn quadrature(&mut self, _t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q[0] = self.power - self.out * y[self.active - 1];
        Ok(())
    }
    fn sensitivity_count(&self) -> usize {
        4
    }
    fn sensitivity_flow(
        &mut self,
        t: f64,
        y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        let n = y.len();
        let (mut direct, mut flow) = (vec![0.0; n], vec![0.0; n]);
        self.flow(t, y, &mut flow)?;
        for (i, (s, g)) in s.chunks_exact(n).zip(g.chunks_exact_mut(n)).enumerate() {
            self.conduct(self.g, self.out, s, g);
            match i {
                0 => self.conduct(1.0, 0.0, y, &mut direct),
                1 => self.conduct(0.0, 1.0, y, &mut direct),
                2 => direct
                    .iter_mut()
                    .enumerate()
                    .for_each(|(k, d)| *d = f64::from(u8::from(k == 0))),
                _ => {
                    direct.iter_mut().zip(&flow).zip(&self.mass).for_each(|((d, f), m)| *d = -f / m)
                }
            }
            g.iter_mut().zip(&direct).for_each(|(g, d)| *g += d);
        }
        Ok(())
    }
}

/// `y' = -k y^2` from `y0`, with the derivatives by `[k, y0]`.
pub(crate) struct Quadratic {
    pub(crate) k: f64,
    pattern: Pattern,
}

impl Quadratic {
    pub(crate) fn new(k: f64) -> Self {
        Self { k, pattern: Pattern::new(1, std::iter::empty()) }
    }
}

impl OdeSystem for Quadratic {
    fn size(&self) -> usize {
        1
    }
    fn mass(&self) -> &[f64] {
        &[1.0]
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = -self.k * y[0] * y[0];
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values[0] = -2.0 * self.k * y[0];
        Ok(())
    }
    fn sensitivity_count(&self) -> usize {
        2
    }
    fn sensitivity_flow(
        &mut self,
        _t: f64,
        y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        let slope = -2.0 * self.k * y[0];
        g.copy_from_slice(&[slope * s[0] - y[0] * y[0], slope * s[1]]);
        Ok(())
    }
}

/// Equal bodies of mass 1, each with a massless skin behind the conductance 1 that radiates `a z^4`
/// to nothing: `y' = z - y` with `0 = y - z - a z^4`. One parameter, `a`.
pub(crate) struct Skins {
    pub(crate) a: f64,
    mass: Vec<f64>,
    pattern: Pattern,
    symmetric: bool,
}

impl Skins {
    pub(crate) fn new(n: usize, a: f64, symmetric: bool) -> Self {
        let mass = (0..2 * n).map(|i| if i < n { 1.0 } else { 0.0 }).collect();
        Self { a, mass, pattern: Pattern::new(2 * n, (0..n).map(|i| (i, n + i))), symmetric }
    }

    /// The skin of a body at `y`: Newton's method on a convex function, from above.
    pub(crate) fn skin(&self, y: f64) -> f64 {
        let mut z = y;
        for _ in 0..200 {
            z -= (z + self.a * z.powi(4) - y) / (1.0 + 4.0 * self.a * z.powi(3));
        }
        z
    }
}

impl OdeSystem for Skins {
    fn size(&self) -> usize {
        self.mass.len() / 2
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f.iter_mut().zip(y).for_each(|(f, &y)| *f = self.skin(y) - y);
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        self.symmetric
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        let n = y.len();
        for (i, &y) in y.iter().enumerate() {
            let slope = 1.0 + 4.0 * self.a * self.skin(y).powi(3);
            let entries = [(i, i, -1.0), (i, n + i, 1.0), (n + i, i, 1.0), (n + i, n + i, -slope)];
            for (row, column, value) in entries {
                values[self.pattern.slot(row, column).unwrap()] = value;
            }
        }
        Ok(())
    }
    fn sensitivity_count(&self) -> usize {
        1
    }
    fn sensitivity_flow(
        &mut self,
        _t: f64,
        y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        for ((&y, &s), g) in y.iter().zip(s).zip(g) {
            let z = self.skin(y);
            let of_skin = (s - z.powi(4)) / (1.0 + 4.0 * self.a * z.powi(3));
            *g = of_skin - s;
        }
        Ok(())
    }
}
