//! A plate whose cells also radiate to each other and to a boundary: nonlinear, with a symmetrised
//! Newton matrix.
#![allow(dead_code, reason = "every test file uses a part of it")]

use lptn_integrate::{OdeSystem, Pattern, Retry};

/// Cells of mass 1 linked by `g (a - b) + s (a^4 - b^4)`; the first cell of every row is linked to
/// a boundary.
pub(crate) struct Radiating {
    links: Vec<(usize, Option<usize>)>,
    mass: Vec<f64>,
    pattern: Pattern,
    power: f64,
    /// Quadratures are the heats of the source and of the boundary.
    boundary_heat: f64,
    radiation: f64,
}

const CONDUCTANCE: f64 = 0.2;
const BOUNDARY: f64 = 293.15;

impl Radiating {
    pub(crate) fn plate(rows: usize, columns: usize, power: f64, radiation: f64) -> Self {
        let at = |i: usize, j: usize| i * columns + j;
        let mut links = Vec::new();
        for i in 0..rows {
            links.push((at(i, 0), None));
            links.extend((1..columns).map(|j| (at(i, j - 1), Some(at(i, j)))));
            links.extend((0..columns).filter(|_| i > 0).map(|j| (at(i - 1, j), Some(at(i, j)))));
        }
        let size = rows * columns;
        let pattern = Pattern::new(size, links.iter().filter_map(|&(a, b)| Some((a, b?))));
        Self { links, mass: vec![1.0; size], pattern, power, boundary_heat: 0.0, radiation }
    }

    fn heat(&self, a: f64, b: f64) -> f64 {
        CONDUCTANCE * (a - b) + self.radiation * (a.powi(4) - b.powi(4))
    }

    /// Symmetrised slope of [`heat`](Self::heat), the mean of both sides.
    fn slope(&self, a: f64, b: f64) -> f64 {
        CONDUCTANCE + 2.0 * self.radiation * (a.powi(3) + b.powi(3))
    }

    /// The source acts on the last cell and begins smoothly.
    fn source(&self, t: f64) -> f64 {
        self.power * (1.0 - (-t).exp())
    }
}

impl OdeSystem for Radiating {
    fn size(&self) -> usize {
        self.mass.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f.fill(0.0);
        f[y.len() - 1] = self.source(t);
        self.boundary_heat = 0.0;
        for &(a, b) in &self.links {
            let heat = self.heat(y[a], b.map_or(BOUNDARY, |b| y[b]));
            f[a] -= heat;
            match b {
                Some(b) => f[b] += heat,
                None => self.boundary_heat -= heat,
            }
        }
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(0.0);
        for &(a, b) in &self.links {
            let slope = self.slope(y[a], b.map_or(BOUNDARY, |b| y[b]));
            values[self.pattern.diagonal_slot(a)] -= slope;
            if let Some(b) = b {
                values[self.pattern.diagonal_slot(b)] -= slope;
                for (i, j) in [(a, b), (b, a)] {
                    values[self.pattern.slot(i, j).unwrap()] += slope;
                }
            }
        }
        Ok(())
    }
    fn quadrature_count(&self) -> usize {
        3
    }
    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        let mut f = vec![0.0; y.len()];
        self.flow(t, y, &mut f)?;
        q.copy_from_slice(&[self.source(t), self.boundary_heat, self.boundary_heat.abs()]);
        Ok(())
    }
}
