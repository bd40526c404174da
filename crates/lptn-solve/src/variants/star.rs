//! Steady states of small networks: nodes are taken out one after the other, each leaving
//! conductances between its neighbours (the star-mesh transformation). Sums and products of positive
//! numbers, so that nothing cancels however far conductances are apart.

/// Conductances between nodes, to the surroundings, and the heat of each node.
#[derive(Clone, Debug)]
pub(crate) struct Star {
    nodes: usize,
    /// Conductances in W/K between every two nodes, row by row.
    among: Vec<f64>,
    /// Conductance of each node to all surroundings in W/K.
    ground: Vec<f64>,
    /// Heat into each node in W, with what its surroundings bring.
    heat: Vec<f64>,
    /// What each node that was taken out had to all others together, in W/K.
    total: Vec<f64>,
}

impl Star {
    pub(crate) fn new(nodes: usize) -> Self {
        let of = |count: usize| vec![0.0; count];
        Self {
            nodes,
            among: of(nodes * nodes),
            ground: of(nodes),
            heat: of(nodes),
            total: of(nodes),
        }
    }

    pub(crate) fn clear(&mut self) {
        for numbers in [&mut self.among, &mut self.ground, &mut self.heat] {
            numbers.fill(0.0);
        }
    }

    pub(crate) fn join(&mut self, a: usize, b: usize, g: f64) {
        self.among[a * self.nodes + b] += g;
        self.among[b * self.nodes + a] += g;
    }

    /// Joins a node to surroundings that are this much warmer than the reference.
    pub(crate) fn ground(&mut self, a: usize, g: f64, rise: f64) {
        self.ground[a] += g;
        self.heat[a] += g * rise;
    }

    pub(crate) fn heat(&mut self, a: usize, power: f64) {
        self.heat[a] += power;
    }

    /// Writes the rises over the reference in K; `None` for a node that nothing determines.
    pub(crate) fn solve(&mut self, rises: &mut [f64]) -> Option<()> {
        let n = self.nodes;
        for k in (0..n).rev() {
            let (before, rest) = self.among.split_at_mut(k * n);
            let row = &rest[..k];
            let total = row.iter().sum::<f64>() + self.ground[k];
            if !(total > 0.0 && total.is_finite()) {
                return None;
            }
            self.total[k] = total;
            for i in (0..k).filter(|&i| row[i] > 0.0) {
                let share = row[i] / total;
                let others = &mut before[i * n..i * n + k];
                others.iter_mut().zip(row).for_each(|(g, to)| *g += share * to);
                others[i] = 0.0;
                self.ground[i] += share * self.ground[k];
                self.heat[i] += share * self.heat[k];
            }
        }
        for k in 0..n {
            let row = &self.among[k * n..k * n + k];
            let brought: f64 = row.iter().zip(&rises[..k]).map(|(g, rise)| g * rise).sum();
            rises[k] = (self.heat[k] + brought) / self.total[k];
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::Star;

    /// A chain of three: rises are sums of heat times the resistances that it passes.
    #[test]
    fn a_chain_with_conductances_far_apart() {
        let mut star = Star::new(3);
        for _ in 0..2 {
            star.clear();
            star.join(0, 1, 1e9);
            star.join(1, 2, 1e-3);
            star.ground(2, 2.0, 10.0);
            star.heat(0, 5.0);
            star.heat(2, 1.0);
            let mut rises = [0.0; 3];
            star.solve(&mut rises).unwrap();
            let last = 10.0 + 6.0 / 2.0;
            let expected = [last + 5.0 * (1e3 + 1e-9), last + 5.0 * 1e3, last];
            for (rise, expected) in rises.iter().zip(expected) {
                assert!((rise - expected).abs() < 1e-14 * expected, "{rise} {expected}");
            }
        }
        let mut island = Star::new(2);
        island.ground(0, 1.0, 0.0);
        assert!(island.solve(&mut [0.0; 2]).is_none());
    }
}
