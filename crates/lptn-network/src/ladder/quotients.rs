//! The quotients and differences of a ladder, and how they change with a pole.

/// `q_i = 1/(R_i C_i)` and `e_i = 1/(R_i C_(i+1))` in 1/s, port first; the last `e` is 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Quotients {
    pub(super) q: Vec<f64>,
    pub(super) e: Vec<f64>,
}

impl Quotients {
    /// Quotients of a ladder of (capacity, resistance).
    pub(super) fn of_ladder(rungs: &[(f64, f64)]) -> Self {
        let next = rungs.iter().skip(1).map(|rung| rung.0).chain([f64::INFINITY]);
        Self {
            q: rungs.iter().map(|(capacity, resistance)| 1.0 / (resistance * capacity)).collect(),
            e: rungs.iter().zip(next).map(|((_, resistance), c)| 1.0 / (resistance * c)).collect(),
        }
    }

    /// Quotients of terms (resistance, time constant), fastest first and no time constant twice,
    /// with the sum of their weights.
    pub(super) fn of_terms(terms: &[(f64, f64)]) -> (Self, f64) {
        let mut quotients = Self::default();
        let (mut total, mut last) = (0.0, f64::INFINITY);
        for &(resistance, tau) in terms {
            if total > 0.0 {
                quotients.move_origin((tau - last) / tau / last);
            }
            let weight = resistance / tau;
            quotients.add_at_origin(weight / (total + weight), total / (total + weight));
            total += weight;
            last = tau;
        }
        quotients.move_origin(1.0 / last);
        (quotients, total)
    }

    /// The ladder as (capacity, resistance), given the sum of the weights.
    pub(super) fn ladder(&self, total: f64) -> Vec<(f64, f64)> {
        let mut capacity = 1.0 / total;
        let rung = |(q, e): (&f64, &f64)| {
            let conductance = q * capacity;
            let rung = (capacity, 1.0 / conductance);
            capacity = conductance / e;
            rung
        };
        self.q.iter().zip(&self.e).map(rung).collect()
    }

    /// All rates become larger by `d > 0`.
    fn move_origin(&mut self, d: f64) {
        let mut added = d;
        for (q, e) in self.q.iter_mut().zip(&mut self.e) {
            let old = *q;
            *q += added;
            let ratio = *e / *q;
            *e = old * ratio;
            added = added * ratio + d;
        }
    }

    /// A pole at rate 0 that has this share of the weight, the others the rest.
    fn add_at_origin(&mut self, share: f64, rest: f64) {
        let (mut share, mut rest) = (share, rest);
        for (q, e) in self.q.iter_mut().zip(&mut self.e) {
            let moved = *q * share;
            *q *= rest;
            let sum = *e + moved;
            (share, rest) = (moved / sum, *e / sum);
            *e = sum;
        }
        self.q.push(0.0);
        self.e.push(0.0);
    }
}
