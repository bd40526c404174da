//! One step inside the box and the trust region.

use super::estimate::Side;
use super::linear::Triangle;

/// Range in which every parameter may move: least (not positive) and most (not negative).
pub(crate) type Room = Vec<(f64, f64)>;

/// A step, and the bounds it ends on.
#[derive(Clone, Debug)]
pub(crate) struct BoxStep {
    pub(crate) step: Vec<f64>,
    pub(crate) sides: Vec<Option<Side>>,
}

/// The linear model with the scales of its parameters.
pub(crate) struct Region<'a> {
    pub(crate) model: &'a Triangle,
    pub(crate) scales: &'a [f64],
    pub(crate) room: &'a Room,
}

impl Region<'_> {
    /// Length in scaled parameters.
    pub(crate) fn length(&self, step: &[f64]) -> f64 {
        length(step, self.scales)
    }

    /// The step that lowers the linear model most among those no longer than `radius`, to a tenth,
    /// and true if the radius bounds it. `None` if no singular values could be computed.
    ///
    /// The length falls with the damping, and its inverse is nearly a straight line (M. D. Hebden,
    /// AERE Harwell TP 515 (1973)), which the secant follows.
    pub(crate) fn step(&self, radius: f64) -> Option<(BoxStep, bool)> {
        let full = self.inside_box(0.0)?;
        let length = self.length(&full.step);
        if length <= radius * 1.1 {
            return Some((full, false));
        }
        let gradient = self.model.gradient(&vec![0.0; self.scales.len()]);
        let steepest =
            gradient.iter().zip(self.scales).map(|(g, d)| (g / d) * (g / d)).sum::<f64>().sqrt();
        let (mut low, mut high) = ((0.0, 1.0 / length), (steepest / radius, f64::NAN));
        let mut best = full;
        let mut damping = 1e-3 * high.0;
        for _ in 0..60 {
            best = self.inside_box(damping)?;
            let length = self.length(&best.step);
            if (0.9 * radius..=1.1 * radius).contains(&length) {
                break;
            }
            let here = (damping, 1.0 / length);
            let (a, b) = (low, here);
            if length > radius {
                low = here
            } else {
                high = here
            }
            let secant = a.0 + (1.0 / radius - a.1) * (b.0 - a.0) / (b.1 - a.1);
            let inside = secant > low.0 && secant < high.0;
            let middle = if low.0 > 0.0 { (low.0 * high.0).sqrt() } else { 1e-3 * high.0 };
            damping = if inside && secant > 0.0 { secant } else { middle };
        }
        Some((best, true))
    }

    /// The minimum of the damped model inside the box, by an active set that begins with a zero
    /// step.
    pub(crate) fn inside_box(&self, damping: f64) -> Option<BoxStep> {
        let n = self.scales.len();
        let mut at = BoxStep { step: vec![0.0; n], sides: vec![None; n] };
        for j in 0..n {
            at.sides[j] = self.standing(j, &at.step, damping);
        }
        for _ in 0..10 * n + 10 {
            let free: Vec<usize> = (0..n).filter(|&j| at.sides[j].is_none()).collect();
            let wanted = self.free_minimum(&free, &at.step, damping)?;
            if self.move_towards(&mut at, &free, &wanted) {
                continue; // one more parameter came to its bound
            }
            let Some(loose) = self.release(&at, damping) else { break };
            at.sides[loose] = None;
        }
        Some(at)
    }

    /// The bound on which the parameter stays if the model pushes it there.
    fn standing(&self, j: usize, step: &[f64], damping: f64) -> Option<Side> {
        let push = self.push(step, damping)[j];
        match self.room[j] {
            (low, _) if step[j] <= low && push < 0.0 => Some(Side::Lower),
            (_, high) if step[j] >= high && push > 0.0 => Some(Side::Upper),
            _ => None,
        }
    }

    /// Direction of each parameter: the negative derivative of the damped model.
    fn push(&self, step: &[f64], damping: f64) -> Vec<f64> {
        let gradient = self.model.gradient(step);
        let damped = step.iter().zip(self.scales).map(|(s, d)| damping * s * d * d);
        gradient.iter().zip(damped).map(|(g, d)| -(g + d)).collect()
    }

    fn free_minimum(&self, free: &[usize], step: &[f64], damping: f64) -> Option<Vec<f64>> {
        if free.is_empty() {
            return Some(Vec::new());
        }
        let mut held = step.to_vec();
        free.iter().for_each(|&j| held[j] = 0.0);
        self.model.solve(free, &self.model.misses(&held), self.scales, damping)
    }

    /// Goes to `wanted`, or up to the first bound, which then fixes its parameter: true.
    fn move_towards(&self, at: &mut BoxStep, free: &[usize], wanted: &[f64]) -> bool {
        let mut part = 1.0;
        let mut first = None;
        for (&j, &to) in free.iter().zip(wanted) {
            let (low, high) = self.room[j];
            let (bound, side) = if to < low { (low, Side::Lower) } else { (high, Side::Upper) };
            if to < low || to > high {
                let reached = (bound - at.step[j]) / (to - at.step[j]);
                if reached < part || first.is_none() {
                    part = reached;
                    first = Some((j, side, bound));
                }
            }
        }
        for (&j, &to) in free.iter().zip(wanted) {
            at.step[j] += part * (to - at.step[j]);
        }
        if let Some((j, side, bound)) = first {
            at.step[j] = bound;
            at.sides[j] = Some(side);
        }
        first.is_some()
    }

    /// The parameter that is fixed by a bound and is pushed away from it most.
    fn release(&self, at: &BoxStep, damping: f64) -> Option<usize> {
        let push = self.push(&at.step, damping);
        let away = |j: usize| match at.sides[j] {
            Some(Side::Lower) => push[j] / self.scales[j],
            Some(Side::Upper) => -push[j] / self.scales[j],
            None => 0.0,
        };
        let least = 1e-14 * self.model.inside.iter().map(|q| q * q).sum::<f64>().sqrt();
        (0..push.len()).filter(|&j| away(j) > least).max_by(|&a, &b| away(a).total_cmp(&away(b)))
    }
}

/// Length of a step, or of parameters, times their scales.
pub(crate) fn length(step: &[f64], scales: &[f64]) -> f64 {
    step.iter().zip(scales).map(|(s, d)| (s * d) * (s * d)).sum::<f64>().sqrt()
}
