//! A sum of exponentials as a ladder of capacities and resistances: what a port sees, with positive
//! elements.

/// Nodes in a row from the port to the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// Heat capacity of each node in J/K, that next to the port first.
    pub capacity: Vec<f64>,
    /// Resistance from each node to the next in K/W, from the last to the reference.
    pub resistance: Vec<f64>,
}

impl Ladder {
    /// The ladder whose first node rises by `sum of r_i (1 - exp(-t / tau_i))` for 1 W, of pairs of
    /// time constants in s and resistances in K/W, all positive. `None` where rounding leaves an
    /// element that is not positive.
    ///
    /// W. Cauer's form of the second kind, from the weights `r_i / tau_i` at the rates `1 / tau_i`
    /// by the rotations of W. B. Gragg and W. J. Harwood (Numer. Math. 44 (1984) 317, RKPW; W.
    /// Gautschi, Orthogonal Polynomials (2004), section 2.2.3), the fastest first; long division
    /// loses all digits at some 20 terms. The elements are quotients and differences of the
    /// quotient-difference scheme.
    pub(crate) fn new(terms: &[(f64, f64)]) -> Option<Self> {
        let mut terms = terms.to_vec();
        terms.sort_by(|a, b| a.0.total_cmp(&b.0));
        let points: Vec<(f64, f64)> = terms.iter().map(|&(tau, r)| (1.0 / tau, r / tau)).collect();
        let (alpha, beta) = recurrence(&points)?;
        let mut capacity = vec![1.0 / beta[0]];
        let mut conductance = vec![alpha[0] * capacity[0]];
        for i in 1..alpha.len() {
            let before = conductance[i - 1];
            let here = before * before / (beta[i] * capacity[i - 1]);
            capacity.push(here);
            conductance.push(alpha[i] * here - before);
        }
        let positive = |values: &[f64]| values.iter().all(|v| v.is_finite() && *v > 0.0);
        let is_ladder = positive(&capacity) && positive(&conductance);
        let resistance = conductance.iter().map(|g| g.recip()).collect();
        is_ladder.then_some(Self { capacity, resistance })
    }

    /// The same with another sum of resistances in K/W, all time constants kept: takes away what
    /// rounding did to the steady state.
    pub(crate) fn with_sum(mut self, sum: f64) -> Self {
        let factor = sum / self.resistance.iter().sum::<f64>();
        self.resistance.iter_mut().for_each(|r| *r *= factor);
        self.capacity.iter_mut().for_each(|c| *c /= factor);
        self
    }
}

/// Coefficients of the recurrence of the polynomials that are orthogonal on points with weights:
/// the diagonal, and the squares beside it behind the sum of the weights.
fn recurrence(points: &[(f64, f64)]) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut alpha: Vec<f64> = points.iter().map(|point| point.0).collect();
    let mut beta = vec![0.0; points.len()];
    *beta.first_mut()? = points.first()?.1;
    for (last, &(point, weight)) in points.iter().enumerate().skip(1) {
        let (mut weight, mut cosine, mut sine, mut shift) = (weight, 1.0, 0.0, 0.0);
        for k in 0..=last {
            let sum: f64 = beta[k] + weight;
            let (kept, before) = (cosine * sum, sine);
            (cosine, sine) = if sum > 0.0 { (beta[k] / sum, weight / sum) } else { (1.0, 0.0) };
            let next = sine * (alpha[k] - point) - cosine * shift;
            alpha[k] -= next - shift;
            shift = next;
            weight = if sine > 0.0 { shift * shift / sine } else { before * beta[k] };
            beta[k] = kept;
        }
    }
    Some((alpha, beta))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two nodes: 1235 J/K with 0.1 K/W to 1424 J/K with 0.3 K/W to the reference. Time constants
    /// and resistances by NumPy's eigh.
    #[test]
    fn two_nodes_are_found_again() {
        let terms =
            [(859.8407293851664, 0.37723642602539775), (61.35927061483318, 0.022763573974602137)];
        let ladder = Ladder::new(&terms).unwrap();
        let expected = [1235.0, 1424.0, 0.1, 0.3];
        let found = ladder.capacity.iter().chain(&ladder.resistance);
        for (found, expected) in found.zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-11, "{ladder:?}");
        }
        let doubled = ladder.with_sum(0.8);
        assert!((doubled.resistance[0] - 0.2).abs() < 1e-11 && doubled.capacity[0] < 618.0);
    }

    #[test]
    fn what_is_no_ladder_is_none() {
        assert_eq!(Ladder::new(&[]), None);
        assert_eq!(Ladder::new(&[(1.0, -1.0)]), None);
    }
}
