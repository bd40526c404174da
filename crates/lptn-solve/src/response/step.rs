//! Temperatures of all nodes after one input has stepped from 0 to 1.

use lptn_integrate::dense::Complex;

use super::carried::CarriedAnswer;
use super::{Drive, Effect, FrequencyResponse, ResponseError, grounded};
use crate::linearised::Linearised;
use crate::modes::{ModesError, Shapes, shapes};

/// The share of the largest above which a mode is visible.
const VISIBLE: f64 = 1e-6;

/// `T(t) = T_direct + sum of Re(c_k x_k (1 - exp(-t s_k)))`, the modes `x_k` over all nodes, from
/// the dense eigenproblem: exact to rounding. If modes coincide, as in a chain of equal cells that
/// a stream passes, the exponential of the matrix replaces their sum.
#[derive(Clone, Debug, PartialEq)]
pub struct StepAnswer {
    /// Steady rise of each node, in K per unit.
    pub settled: Vec<f64>,
    /// Immediate rise: zero for nodes that store heat.
    direct: Vec<f64>,
    /// For each mode its rate `s_k` in 1/s, and the missing rise of each node at time 0.
    terms: Vec<(Complex, Vec<Complex>)>,
    /// Replaces the terms.
    carried: Option<CarriedAnswer>,
}

impl StepAnswer {
    /// The response to an input, of a network of at most 2000 nodes with capacity.
    ///
    /// # Errors
    /// [`ResponseError`]
    pub fn new(linear: &Linearised<'_>, drive: Drive) -> Result<Self, ResponseError> {
        let effect = Effect::of(linear, drive)?;
        grounded(linear.system(), &effect)?;
        // first, since it refuses networks that are too large
        let shapes = match shapes(linear) {
            Err(ModesError::Defective) => None,
            found => Some(found?),
        };
        let settled = FrequencyResponse::new(linear, drive)?.at(0.0)?;
        let settled: Vec<f64> = settled.iter().map(|z| z.re).collect();
        let states: Vec<f64> =
            linear.system().states().iter().map(|id| settled[id.index()]).collect();
        let Some(Shapes { rates, right, left }) = shapes else {
            return Self::carried(linear, settled, &states);
        };
        if rates.iter().any(|rate| rate.re < 0.0) {
            return Err(ResponseError::Grows);
        }
        let mut terms = Vec::with_capacity(rates.len());
        for (rate, (right, left)) in rates.into_iter().zip(right.into_iter().zip(left)) {
            let missing: Complex = left.iter().zip(&states).map(|(y, t)| y * t).sum();
            let nodes: Vec<Complex> = right.iter().map(|x| x * missing).collect();
            terms.push((rate, nodes));
        }
        let mut direct = settled.clone();
        for (i, direct) in direct.iter_mut().enumerate() {
            *direct -= terms.iter().map(|(_, nodes)| nodes[i].re).sum::<f64>();
        }
        linear.system().states().iter().for_each(|id| direct[id.index()] = 0.0);
        Ok(Self { settled, direct, terms, carried: None })
    }

    fn carried(
        linear: &Linearised<'_>,
        settled: Vec<f64>,
        states: &[f64],
    ) -> Result<Self, ResponseError> {
        let carried = CarriedAnswer::new(linear, states)?.ok_or(ResponseError::Grows)?;
        let mut direct: Vec<f64> = settled.clone();
        let of_states = |node| carried.of_states(node, states);
        direct.iter_mut().enumerate().for_each(|(node, direct)| *direct -= of_states(node));
        linear.system().states().iter().for_each(|id| direct[id.index()] = 0.0);
        Ok(Self { settled, direct, terms: Vec::new(), carried: Some(carried) })
    }

    /// Rise of a node (its number) in K per unit, at a time in s after the step; at 0 the immediate
    /// rise.
    pub fn value(&self, node: usize, time: f64) -> f64 {
        if let Some(carried) = &self.carried {
            return self.direct[node] + carried.value(node, time);
        }
        let of = |(rate, nodes): &(Complex, Vec<Complex>)| (nodes[node] * gone(rate * time)).re;
        self.direct[node] + self.terms.iter().map(of).sum::<f64>()
    }

    /// The rise in K per unit at the end of pulses of a length in s that take a share of their
    /// period, between 0 and 1, once they have settled: the highest one at the node that is heated.
    /// It is the sum of the steps up and down of all pulses before, a geometric series for each
    /// mode.
    pub fn pulse(&self, node: usize, length: f64, share: f64) -> f64 {
        if let Some(carried) = &self.carried {
            return self.direct[node] + carried.pulse(node, length, length / share);
        }
        let of = |(rate, nodes): &(Complex, Vec<Complex>)| {
            let left = match *rate == Complex::new(0.0, 0.0) {
                true => Complex::new(share, 0.0),
                false => gone(rate * length) / gone(rate * (length / share)),
            };
            (nodes[node] * left).re
        };
        self.direct[node] + self.terms.iter().map(of).sum::<f64>()
    }

    /// Immediate rise of a node, in K per unit.
    pub fn direct(&self, node: usize) -> f64 {
        self.direct[node]
    }

    /// True if it is a sum over modes; else [`StepAnswer::terms`] has none.
    pub fn has_terms(&self) -> bool {
        self.carried.is_none()
    }

    /// The rate in 1/s of each mode, with its missing part of a node's rise at time 0, in K per
    /// unit; the real parts of all and the immediate rise make the steady rise.
    pub fn terms(&self, node: usize) -> impl Iterator<Item = (Complex, Complex)> {
        self.terms.iter().map(move |(rate, nodes)| (*rate, nodes[node]))
    }

    /// The shortest and the longest time constant in s that a node sees: those of the modes with at
    /// least a millionth of its largest share. If modes coincide, those of exponentials that reach
    /// a tenth, or all but exp(-5), as soon as the node does. `None` if it responds at once, or not
    /// at all.
    pub fn span(&self, node: usize) -> Option<(f64, f64)> {
        if let Some(carried) = &self.carried {
            let stored = self.settled[node] - self.direct[node];
            let tau = |share: f64| carried.reached(node, share * stored) / -(-share).ln_1p();
            return (stored != 0.0).then(|| (tau(0.1), tau(-(-5.0_f64).exp_m1())));
        }
        let share = |term: &(Complex, Vec<Complex>)| term.1[node].norm();
        let largest = self.terms.iter().map(share).fold(0.0, f64::max);
        let seen = self.terms.iter().filter(|term| share(term) > VISIBLE * largest);
        let taus = seen.map(|(rate, _)| rate.re.recip()).filter(|tau| tau.is_finite());
        taus.fold(None, |span: Option<(f64, f64)>, tau| {
            Some(span.map_or((tau, tau), |(least, most)| (least.min(tau), most.max(tau))))
        })
    }
}

/// `1 - exp(-z)`, with all digits near 0.
fn gone(z: Complex) -> Complex {
    let (sine, half) = (z.im.sin(), (0.5 * z.im).sin());
    let decayed = (-z.re).exp();
    // 1 - e^-a cos b = (1 - e^-a) + e^-a (1 - cos b)
    Complex::new(-(-z.re).exp_m1() + decayed * 2.0 * half * half, decayed * sine)
}
