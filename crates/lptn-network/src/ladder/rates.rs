//! The rates of a ladder: eigenvalues to a small relative error, by dqds.

use super::quotients::Quotients;

/// Square of rounding: an `e` below this part of an eigenvalue moves it by no more than rounding.
const NEGLIGIBLE: f64 = f64::EPSILON * f64::EPSILON;

/// Most steps per eigenvalue; it takes three to six as a rule.
const MOST: usize = 60;

/// The rates of a ladder in 1/s, largest first; `None` if they are not found, because the numbers
/// do not suffice.
pub(super) fn rates(ladder: &Quotients) -> Option<Vec<f64>> {
    let mut steps = MOST * ladder.q.len();
    let mut found = Vec::with_capacity(ladder.q.len());
    let mut blocks = vec![Block { rest: ladder.clone(), origin: 0.0 }];
    while let Some(mut block) = blocks.pop() {
        while let Some(last) = block.rest.q.len().checked_sub(1) {
            if block.ends() {
                found.push(block.origin + block.rest.q[last]);
                block.rest.q.pop();
                block.rest.e.pop();
            } else if let Some(rest) = block.split() {
                blocks.push(rest);
            } else {
                steps = steps.checked_sub(1)?;
                block.advance()?;
            }
        }
    }
    found.sort_by(|a, b| b.total_cmp(a));
    Some(found)
}

/// A part of the matrix that is joined to no other, and how far its eigenvalues are shifted.
struct Block {
    rest: Quotients,
    origin: f64,
}

impl Block {
    /// True if the last row is joined to no other.
    fn ends(&self) -> bool {
        let last = self.rest.q.len() - 1;
        last == 0 || self.rest.e[last - 1] <= NEGLIGIBLE * (self.origin + self.rest.q[last])
    }

    /// Takes off the rows after the last joint that no longer joins: there the smallest eigenvalue
    /// may be that of either part.
    fn split(&mut self) -> Option<Self> {
        let joints = &self.rest.e[..self.rest.e.len() - 1];
        let joint = joints.iter().rposition(|e| *e <= NEGLIGIBLE * self.origin)?;
        let rest =
            Quotients { q: self.rest.q.split_off(joint + 1), e: self.rest.e.split_off(joint + 1) };
        Some(Self { rest, origin: self.origin })
    }

    /// One step with the best shift that is safe. Should rounding have made it too large, one
    /// without a shift, which takes no difference and always succeeds.
    fn advance(&mut self) -> Option<()> {
        let shift = below_least(&self.rest);
        let shifted = progressive(&self.rest, shift);
        let (next, shift) = match shifted {
            Some(next) => (next, shift),
            None => (progressive(&self.rest, 0.0)?, 0.0),
        };
        self.rest = next;
        self.origin += shift;
        Some(())
    }
}

/// The factors exchanged, `R L - shift`, as factors again; the smallest eigenvalue comes nearer to
/// the end. `None` if the shift is above it.
fn progressive(old: &Quotients, shift: f64) -> Option<Quotients> {
    let mut next = Quotients { q: Vec::with_capacity(old.q.len()), e: vec![0.0; old.e.len()] };
    let mut d = old.q[0] - shift;
    for i in 1..old.q.len() {
        let q = d + old.e[i - 1];
        let ratio = old.q[i] / q;
        next.e[i - 1] = old.e[i - 1] * ratio;
        next.q.push(q);
        if d < 0.0 || d.is_nan() {
            return None;
        }
        d = d * ratio - shift;
    }
    next.q.push(d);
    (d >= 0.0).then_some(next)
}

/// A bound below the smallest eigenvalue that is close to it: Laguerre's, from the traces of the
/// inverse and of its square. With `b_i` the diagonal of the inverse and `rho_i = e_i/q_i`,
/// `b_i = 1/q_i + rho_i b_(i+1)`; the second trace is `sum of b_i^2 + 2 rho_i a_(i+1)` with
/// `a_i = b_i^2 + rho_i a_(i+1)`.
fn below_least(block: &Quotients) -> f64 {
    let (mut b, mut a, mut first, mut second) = (0.0, 0.0, 0.0, 0.0);
    for (q, e) in block.q.iter().zip(&block.e).rev() {
        let inverse = 1.0 / q;
        let ratio = e * inverse;
        b = inverse + ratio * b;
        let carried = ratio * a;
        a = b * b + carried;
        first += b;
        second += a + carried;
    }
    let n = f64::from(u32::try_from(block.q.len()).unwrap_or(u32::MAX));
    let rounding = 8.0 * n * f64::EPSILON;
    let spread = (n * second - first * first).max(0.0) + rounding * n * second;
    n / (first + ((n - 1.0) * spread).sqrt()) * (1.0 - rounding)
}
