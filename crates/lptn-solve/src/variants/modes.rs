//! The modes of one candidate after the other.

use lptn_integrate::dense::Symmetric;

use super::star::{Plan, Star};

/// Rates and shapes: the rise of a network without heat is a sum of shapes that decay at them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Modes {
    room: Symmetric,
    /// Rate of each mode in 1/s, slowest first.
    pub(crate) rates: Vec<f64>,
    /// Temperature of each node in each mode, mode by mode, such that the sum of `C x^2` is 1 J K.
    pub(crate) shapes: Vec<f64>,
    root: Vec<f64>,
    order: Vec<usize>,
}

impl Modes {
    /// All modes of a candidate whose nodes without capacity are taken out; `None` if the numbers
    /// fail.
    pub(crate) fn find(&mut self, plan: &Plan, star: &Star, capacity: &[f64]) -> Option<()> {
        let massless = plan.massless;
        let count = plan.order.len() - massless;
        self.root.clear();
        self.root.extend(plan.order[massless..].iter().map(|&node| capacity[node].sqrt()));
        self.room.begin(count);
        let root = &self.root;
        for (a, g) in star.ground[massless..].iter().enumerate() {
            self.room.add(a, a, g / (root[a] * root[a]));
        }
        for (a, b, slot) in plan.between_all(massless) {
            let (a, b, g) = (a - massless, b - massless, star.among[slot]);
            self.room.add(a, a, g / (root[a] * root[a]));
            self.room.add(b, b, g / (root[b] * root[b]));
            self.room.add(a, b, -g / (root[a] * root[b]));
        }
        self.room.solve()?;
        self.sort();
        self.take(plan, star);
        self.rates.iter().all(|rate| rate.is_finite() && *rate > 0.0).then_some(())
    }

    fn sort(&mut self) {
        let values = &self.room.values;
        self.order.clear();
        self.order.extend(0..values.len());
        self.order.sort_unstable_by(|a, b| values[*a].total_cmp(&values[*b]));
    }

    /// Shapes with all nodes, and their rates.
    fn take(&mut self, plan: &Plan, star: &Star) {
        let (n, massless) = (plan.order.len(), plan.massless);
        self.rates.clear();
        self.shapes.resize(n * self.order.len(), 0.0);
        for (&k, shape) in self.order.iter().zip(self.shapes.chunks_exact_mut(n)) {
            let vector = self.room.vector(k);
            let parts = plan.order[massless..].iter().zip(vector).zip(&self.root);
            parts.for_each(|((&node, x), root)| shape[node] = x / root);
            self.rates.push(rate(plan, star, shape) / vector.iter().map(|x| x * x).sum::<f64>());
            star.recover(plan, shape);
        }
    }

    /// Deletes all modes.
    pub(crate) fn forget(&mut self) {
        self.rates.clear();
        self.shapes.clear();
    }

    /// The slowest and the fastest rate in 1/s.
    pub(crate) fn span(&self) -> (f64, f64) {
        let span = |(low, high): (f64, f64), rate: &f64| (low.min(*rate), high.max(*rate));
        self.rates.iter().fold((f64::INFINITY, 0.0), span)
    }
}

/// Rayleigh's quotient, but for its norm, as a sum of the heat of every path: positive terms, so
/// that slow modes keep their digits next to fast ones, unlike the eigenvalues of a dense solver.
fn rate(plan: &Plan, star: &Star, shape: &[f64]) -> f64 {
    let massful = plan.massless..plan.order.len();
    let ground = massful.map(|k| star.ground[k] * shape[plan.order[k]] * shape[plan.order[k]]);
    let among = plan.between_all(plan.massless).map(|(a, b, slot)| {
        let difference = shape[plan.order[a]] - shape[plan.order[b]];
        star.among[slot] * difference * difference
    });
    ground.sum::<f64>() + among.sum::<f64>()
}
