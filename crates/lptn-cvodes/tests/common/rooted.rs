//! One node whose temperature is watched.
#![allow(clippy::unwrap_used, reason = "a test may")]

use lptn_cvodes::Cvodes;
use lptn_integrate::{Integrator, OdeSystem, Options, Pattern, Retry, Step};

/// One function of time and state.
pub(crate) type Root = Box<dyn Fn(f64, f64) -> f64>;

/// `C T' = P - G T`, with the heats `P`, `G T` and their difference as running integrals.
pub(crate) struct Node {
    pattern: Pattern,
    mass: [f64; 1],
    pub(crate) power: Box<dyn Fn(f64) -> f64>,
    conductance: f64,
    pub(crate) roots: Vec<Root>,
    pub(crate) fault: Option<Retry>,
}

impl OdeSystem for Node {
    fn size(&self) -> usize {
        1
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = (self.power)(t) - self.conductance * y[0];
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values[0] = -self.conductance;
        Ok(())
    }
    fn jacobian_is_constant(&self) -> bool {
        true
    }
    fn quadrature_count(&self) -> usize {
        2
    }
    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q.copy_from_slice(&[(self.power)(t), self.conductance * y[0]]);
        Ok(())
    }
    fn root_count(&self) -> usize {
        self.roots.len()
    }
    fn roots(&mut self, t: f64, y: &[f64], g: &mut [f64]) -> Result<(), Retry> {
        if let Some(fault) = self.fault.filter(|_| t > 1.0) {
            return Err(fault);
        }
        g.iter_mut().zip(&self.roots).for_each(|(g, root)| *g = root(t, y[0]));
        Ok(())
    }
}

/// Capacity 2, conductance 1: time constant 2.
pub(crate) fn node(power: impl Fn(f64) -> f64 + 'static, roots: Vec<Root>) -> Node {
    let pattern = Pattern::new(1, std::iter::empty());
    Node { pattern, mass: [2.0], power: Box::new(power), conductance: 1.0, roots, fault: None }
}

pub(crate) fn started(system: Node, y0: f64, tolerance: f64) -> Cvodes<Node> {
    let options = Options { tolerance, ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, &[y0], &options).unwrap();
    integrator.set_stop(20.0);
    integrator
}

pub(crate) fn level(level: f64) -> Root {
    Box::new(move |_, y| y - level)
}

/// The next step that ends at a root or at the stop; no step between may be without length.
pub(crate) fn next_root(integrator: &mut Cvodes<Node>) -> Step {
    loop {
        let step = integrator.step().unwrap();
        assert!(step.to > step.from);
        if step.roots || step.at_stop {
            return step;
        }
    }
}

/// Stored minus booked heat.
pub(crate) fn off(integrator: &mut Cvodes<Node>, y0: f64) -> f64 {
    let stored = 2.0 * (integrator.state()[0] - y0);
    let q = integrator.quadratures().unwrap();
    stored - (q[0] - q[1])
}
