//! Systems with known solutions, shared by the tests and the bench.
#![allow(dead_code, reason = "every test file uses a part of it")]

use lptn_cvodes::Cvodes;
use lptn_integrate::{IntegrateError, Integrator, OdeSystem, Options, Pattern, Retry};

/// Source of a [`Linear`] system.
pub(crate) type Source = Box<dyn Fn(f64, &mut [f64])>;

/// `M y' = b(t) + A y` with constant `M` and `A`. Quadratures: the total of `b + A y`.
pub(crate) struct Linear {
    pub(crate) mass: Vec<f64>,
    pub(crate) pattern: Pattern,
    pub(crate) matrix: Vec<f64>,
    pub(crate) source: Source,
    pub(crate) symmetric: bool,
    /// Whether the books are kept.
    pub(crate) books: bool,
    work: Vec<f64>,
}

impl Linear {
    /// From the entries `(row, column, value)` of `A`, which are summed.
    pub(crate) fn new(mass: Vec<f64>, entries: &[(usize, usize, f64)], source: Source) -> Self {
        let n = mass.len();
        let pattern = Pattern::new(n, entries.iter().map(|&(i, j, _)| (i, j)));
        let mut matrix = vec![0.0; pattern.len()];
        for &(i, j, value) in entries {
            matrix[pattern.slot(i, j).unwrap()] += value;
        }
        Self { mass, pattern, matrix, source, symmetric: true, books: false, work: vec![0.0; n] }
    }

    /// Every link `(a, b, g)` is a conductance between two components, or to zero if `b` is `None`.
    pub(crate) fn network(
        mass: Vec<f64>,
        links: &[(usize, Option<usize>, f64)],
        source: Source,
    ) -> Self {
        let mut entries = Vec::new();
        for &(a, b, g) in links {
            entries.push((a, a, -g));
            if let Some(b) = b {
                entries.extend([(b, b, -g), (a, b, g), (b, a, g)]);
            }
        }
        Self::new(mass, &entries, source)
    }

    /// `count` components of mass 1 that nothing happens to, appended.
    pub(crate) fn with_idle(self, count: usize) -> Self {
        let n = self.mass.len();
        let mut entries: Vec<_> = (n..n + count).map(|i| (i, i, 0.0)).collect();
        for column in 0..n {
            let slots = self.pattern.column(column);
            entries.extend(
                slots.map(|slot| (self.pattern.row_indices()[slot], column, self.matrix[slot])),
            );
        }
        let mut mass = self.mass;
        mass.resize(n + count, 1.0);
        Self::new(mass, &entries, self.source)
    }

    pub(crate) fn total_heat(&self, y: &[f64]) -> f64 {
        self.mass.iter().zip(y).map(|(m, y)| m * y).sum()
    }
}

impl OdeSystem for Linear {
    fn size(&self) -> usize {
        self.mass.len()
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        self.work.fill(0.0);
        (self.source)(t, &mut self.work);
        self.pattern.multiply(&self.matrix, y, f);
        f.iter_mut().zip(&self.work).for_each(|(f, b)| *f += b);
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        self.symmetric
    }
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.copy_from_slice(&self.matrix);
        Ok(())
    }
    fn jacobian_is_constant(&self) -> bool {
        true
    }
    fn quadrature_count(&self) -> usize {
        usize::from(self.books)
    }
    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        let mut f = vec![0.0; y.len()];
        self.flow(t, y, &mut f)?;
        q[0] = f.iter().sum();
        Ok(())
    }
}

/// Calls `look` with the state at each of the ascending times, the last of which is a stop time.
pub(crate) fn sample<S: OdeSystem>(
    integrator: &mut Cvodes<S>,
    times: &[f64],
    mut look: impl FnMut(f64, &[f64]),
) -> Result<(), IntegrateError> {
    let mut y = vec![0.0; integrator.state().len()];
    integrator.set_stop(*times.last().unwrap());
    for &t in times {
        while integrator.time() < t {
            integrator.step()?;
        }
        integrator.interpolate(t, &mut y)?;
        look(t, &y);
    }
    Ok(())
}

/// Largest error of `system` against `exact(t, i)` at the given times.
pub(crate) fn largest_error(
    system: Linear,
    y0: &[f64],
    (times, tolerance): (&[f64], f64),
    exact: impl Fn(f64) -> Vec<f64>,
) -> f64 {
    let options = Options { tolerance, ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, y0, &options).unwrap();
    let mut largest = 0.0_f64;
    sample(&mut integrator, times, |t, y| {
        for (y, exact) in y.iter().zip(exact(t)) {
            largest = largest.max((y - exact).abs());
        }
    })
    .unwrap();
    largest
}

pub(crate) fn equal_times(end: f64, count: usize) -> Vec<f64> {
    (1..=count).map(|k| if k == count { end } else { end * k as f64 / count as f64 }).collect()
}

/// `n` by `n` plate of unit cells with unit conductances, one side at 0, a source of `power` in its
/// middle cells.
pub(crate) fn plate(n: usize, power: f64) -> Linear {
    let at = |i: usize, j: usize| i * n + j;
    let mut links = Vec::new();
    for i in 0..n {
        for j in 0..n {
            if i + 1 < n {
                links.push((at(i, j), Some(at(i + 1, j)), 1.0));
            }
            if j + 1 < n {
                links.push((at(i, j), Some(at(i, j + 1)), 1.0));
            }
        }
        links.push((at(i, 0), None, 1.0));
    }
    let middle: Vec<usize> = (0..n * n)
        .filter(|k| (k / n).abs_diff(n / 2) < n / 10 + 1 && (k % n).abs_diff(n / 2) < n / 10 + 1)
        .collect();
    let each = power / middle.len() as f64;
    Linear::network(
        vec![1.0; n * n],
        &links,
        Box::new(move |_, b| middle.iter().for_each(|&k| b[k] = each)),
    )
}
