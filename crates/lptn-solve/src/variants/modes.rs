//! The modes of one candidate after the other.

use lptn_network::{End, Network, Variants};

use super::symmetric::Symmetric;

/// Rates and shapes, slowest first: the amplitudes of modes are `sum of C x (T - reference)`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Modes {
    room: Symmetric,
    /// Rate of each mode in 1/s.
    pub(crate) rates: Vec<f64>,
    /// Temperature of each node in each mode, mode by mode, such that the sum of `C x^2` is 1 J K.
    pub(crate) shapes: Vec<f64>,
    root: Vec<f64>,
    order: Vec<usize>,
}

impl Modes {
    /// The modes of a candidate whose nodes all store heat; `None` where the numbers fail.
    pub(crate) fn find(&mut self, network: &Network, variants: &Variants<'_>) -> Option<()> {
        let n = variants.capacity.len();
        self.root.clear();
        self.root.extend(variants.capacity.iter().map(|c| c.sqrt()));
        self.room.begin(n);
        let root = &self.root;
        for (conductor, &g) in network.conductors().iter().zip(&variants.conductance) {
            let (from, to) = (conductor.from, conductor.to);
            for end in [from, to] {
                if let End::Node(a) = end {
                    let a = a.index();
                    self.room.add(a, a, g / (root[a] * root[a]));
                }
            }
            if let (End::Node(a), End::Node(b)) = (from, to) {
                let (a, b) = (a.index(), b.index());
                self.room.add(a, b, -g / (root[a] * root[b]));
            }
        }
        self.room.solve()?;
        let values = &self.room.values;
        self.order.clear();
        self.order.extend(0..n);
        self.order.sort_unstable_by(|a, b| values[*a].total_cmp(&values[*b]));
        self.shapes.clear();
        for &k in &self.order {
            let vector = &self.room.vectors[k * n..(k + 1) * n];
            self.shapes.extend(vector.iter().zip(root).map(|(x, root)| x / root));
        }
        self.rates.clear();
        self.rates.extend(self.shapes.chunks_exact(n).map(|x| rate(network, variants, x)));
        self.rates.iter().all(|rate| rate.is_finite() && *rate > 0.0).then_some(())
    }

    /// The slowest and the fastest rate in 1/s.
    pub(crate) fn span(&self) -> (f64, f64) {
        let span = |(low, high): (f64, f64), rate: &f64| (low.min(*rate), high.max(*rate));
        self.rates.iter().fold((f64::INFINITY, 0.0), span)
    }
}

/// Rayleigh's quotient as a sum of the heat of every path: positive terms, so that slow modes keep
/// their digits beside fast ones, which the eigenvalues of a dense solver do not.
fn rate(network: &Network, variants: &Variants<'_>, x: &[f64]) -> f64 {
    let at = |end: End| if let End::Node(id) = end { x[id.index()] } else { 0.0 };
    let conductors = network.conductors().iter().zip(&variants.conductance);
    let heat: f64 = conductors
        .map(|(conductor, g)| {
            let difference = at(conductor.from) - at(conductor.to);
            g * difference * difference
        })
        .sum();
    let norm: f64 = x.iter().zip(&variants.capacity).map(|(x, c)| c * x * x).sum();
    heat / norm
}
